"""Leg model, link tree and joint motion of a plan."""
