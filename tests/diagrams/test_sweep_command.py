"""What a sweep tells while it goes on."""

from footfall.diagrams.sweep_command import time_left


def test_what_is_left_takes_as_long_as_what_was() -> None:
    """In minutes, whatever goes on beside; nothing at the end."""
    assert time_left(120.0, 4, 12) == "; about 6 min left"
    assert time_left(10.0, 4, 12) == "; a minute left"
    assert time_left(120.0, 4, 0) == ""
