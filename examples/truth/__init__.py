"""What Cycles shows of a tan beside what the light model says: `make truth`."""
