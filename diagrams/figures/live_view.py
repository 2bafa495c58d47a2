"""Meshcat, where it may be seen from."""

from pydrake.geometry import Meshcat, MeshcatParams

LOCAL_HOST = "127.0.0.1"
"""Reached from this machine alone."""


def meshcat_at(host: str = LOCAL_HOST) -> Meshcat:
    """Starts Meshcat on one interface, at the first free port from 7000.

    Drake's own default is every interface of the machine.

    Args:
        host: name or address of the interface; "*" for every one.

    Raises:
        RuntimeError: there is no such interface, or no free port.
    """
    return Meshcat(MeshcatParams(host=host))
