"""Checking what a cloud file claims to hold against what it can hold."""

MAX_POINTS = 100_000_000
"""More would take gigabytes of memory and hours to segment."""


def check_claim(points: int, needed: int, held: int) -> None:
    """Checks a header before memory is taken for what it promises.

    Args:
        points: how many points the header promises.
        needed: least size of their data, bytes.
        held: what the file has left for them, bytes.

    Raises:
        ValueError: the file is too small for its header, or larger than can be read.
    """
    if needed > held:
        raise ValueError(
            f"is cut short or damaged: its header promises {points:,} points "
            f"({needed:,} bytes), and {held:,} bytes follow"
        )
    if points > MAX_POINTS:
        raise ValueError(
            f"has {points:,} points, more than the {MAX_POINTS:,} that are read: "
            "thin it out first"
        )
