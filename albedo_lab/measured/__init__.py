"""Measured reflectance: the files it comes in, and the coordinates that they are sorted by."""
