"""Diagrams that wire the systems to a robot in a scene, and the command line."""
