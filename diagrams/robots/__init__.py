"""Robots of one's own: read from files, put into scenarios, tried out."""
