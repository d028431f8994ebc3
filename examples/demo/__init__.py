"""Tan lines on a body: from a specimen of skin to pictures, a video and the colours measured."""
