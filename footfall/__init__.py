"""The command `footfall` as a module: `python -m footfall`.

The library itself is in the packages `diagrams`, `systems` and `models`.
"""
