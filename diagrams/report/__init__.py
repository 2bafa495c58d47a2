"""A run, or a sweep, as one page that needs nothing beside it."""
