"""Speed for accuracy: measured, drawn, and chosen from."""
