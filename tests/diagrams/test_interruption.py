"""Signals that end a run: taken over for a while, and given back."""

import os
import signal
from collections.abc import Iterator

import pytest

from footfall.diagrams.interruption import StopSignals

BOTH = (signal.SIGINT, signal.SIGTERM)


@pytest.fixture(autouse=True)
def handlers() -> Iterator[None]:
    """Whatever a test does, the next one has the handlers that were there."""
    before = {number: signal.getsignal(number) for number in BOTH}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize(("number", "status"), [(BOTH[0], 130), (BOTH[1], 143)])
def test_a_signal_interrupts_and_gives_the_exit_status(number, status) -> None:
    """The first one does, whatever comes after it."""
    stop = StopSignals()
    with stop, pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), number)
    assert (stop.received, stop.exit_status()) == (number, status)
    other = BOTH[1 - BOTH.index(number)]
    with stop, pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), other)
    assert stop.exit_status() == status


def test_handlers_come_back() -> None:
    """Making one changes nothing; after leaving it nothing is changed."""
    before = [signal.getsignal(number) for number in BOTH]
    stop = StopSignals()
    assert [signal.getsignal(number) for number in BOTH] == before
    with stop:
        assert [signal.getsignal(number) for number in BOTH] != before
    assert [signal.getsignal(number) for number in BOTH] == before


def test_held_signals_are_only_noted() -> None:
    """And interrupt again when they are held no more."""
    with StopSignals() as stop:
        with stop.held():
            os.kill(os.getpid(), signal.SIGTERM)
        assert stop.received == signal.SIGTERM
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGTERM)


def test_what_the_process_ignores_stays_ignored() -> None:
    """As Ctrl-C of one in the background."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with StopSignals() as stop:
        os.kill(os.getpid(), signal.SIGINT)
        assert stop.received is None
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_an_interrupt_without_a_signal_is_ctrl_c() -> None:
    """As one that a System raised."""
    assert StopSignals().exit_status() == 130
