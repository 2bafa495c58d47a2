"""Starts the command line, so that it ends in one line whatever the machine does."""

import contextlib
import os
import signal
import sys

BAD_OUTPUT, INTERRUPTED = 2, 130
"""Exit status: nothing can be printed; Ctrl-C (by the shell's rule 128 + SIGINT)."""


def main() -> None:
    """Runs the command line."""
    # What simulates takes seconds to import, and some of it catches KeyboardInterrupt.
    # Nothing is written yet; `run`, which has something to keep, takes Ctrl-C over.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    from footfall.diagrams.cli.app import main as run_command_line

    try:
        run_command_line()
    except OSError as error:  # Bad input has been told of; this is the output.
        with contextlib.suppress(OSError):
            print(f"footfall: cannot print: {error.strerror}", file=sys.stderr)
        sys.exit(BAD_OUTPUT)


if __name__ == "__main__":
    main()
