"""Ctrl-C and SIGTERM, by which a run is ended early but in good order."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Self


class StopSignals:
    """While it is entered, SIGINT and SIGTERM raise KeyboardInterrupt.

    The handlers that were there come back when it is left. A signal that the process
    ignores, as one in the background may Ctrl-C, stays ignored.
    """

    def __init__(self) -> None:
        """Changes nothing yet."""
        self.received: int | None = None
        """The first of the signals that came, None before."""
        self._held = False
        self._previous: dict[int, signal._HANDLER] = {}

    def __enter__(self) -> Self:
        """Takes the signals over; in the main thread, as Python allows no other."""
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) is not signal.SIG_IGN:
                self._previous[number] = signal.signal(number, self._handle)
        return self

    def __exit__(self, *_: object) -> None:
        """Gives them back."""
        for number, handler in self._previous.items():
            signal.signal(number, handler)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Only notes the signals that come meanwhile."""
        self._held = True
        try:
            yield
        finally:
            self._held = False

    def exit_status(self) -> int:
        """Gives the exit status of a process that a signal ended: 128 and its number.

        Of a KeyboardInterrupt that no signal raised, that of Ctrl-C.
        """
        return 128 + (self.received or signal.SIGINT)

    def _handle(self, number: int, _: FrameType | None) -> None:
        self.received = self.received or number
        if not self._held:
            raise KeyboardInterrupt
