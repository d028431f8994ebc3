"""What the command `lut-builder` does, a file for each of its commands."""
