"""What stands in the world: robots, staircases, obstacles and rooms."""
