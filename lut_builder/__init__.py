"""Builds, checks and writes look-up tables of skin over its tanning states."""
