"""What each simplification of the light model costs and buys, measured."""
