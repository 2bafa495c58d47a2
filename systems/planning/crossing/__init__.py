"""Stepping over obstacles (obstacle paper): from feasibility to feet adaptor."""
