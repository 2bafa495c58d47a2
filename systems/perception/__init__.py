"""Perception: from scans to planes, staircases and boxes. Knows no robot."""
