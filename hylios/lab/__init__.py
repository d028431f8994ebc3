"""What a laboratory needs and a scene never does: colour, fits, pictures, earlier models."""
