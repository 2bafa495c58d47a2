"""Paths and footsteps through a room (room paper)."""
