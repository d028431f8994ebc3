"""Runnable examples; start them from the repository's root with `python -m examples.NAME`."""
