"""Time against error of tables: measured, drawn, and used to choose settings."""
