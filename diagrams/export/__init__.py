"""A run as a file for other tools: MCAP, which Foxglove and PlotJuggler open."""
