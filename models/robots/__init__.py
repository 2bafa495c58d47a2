"""Robots: their descriptions, and what Drake simulates of them."""
