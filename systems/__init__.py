"""The algorithms of footfall, one Drake system a file."""
