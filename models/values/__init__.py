"""Values that travel on ports, and the checks of parameters."""
