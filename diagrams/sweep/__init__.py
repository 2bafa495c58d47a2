"""Sweeps: a scenario many times, its fields drawn or listed, in one table."""
