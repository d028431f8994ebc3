"""The thesis's figures and tables again, drawn from this project's own results."""
