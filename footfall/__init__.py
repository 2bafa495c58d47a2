"""Drake systems with which a humanoid sees stairs and clutter, and walks them.

The subpackages `models`, `systems` and `diagrams` are folders of the repository's top
level, linked to from here; `python -m footfall` is the command line.
"""
