"""Executives: what is due next, to look, to plan or to move."""
