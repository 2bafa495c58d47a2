"""What draws: figures, film strips, replays and block diagrams of runs."""
