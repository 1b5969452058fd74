"""The bounds of a command: a limit on its processor time, and one printable line for a message."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..language.limits import MESSAGE

AGAIN = 0.1
"""After so many seconds it is raised again: Python drops what is raised while it collects garbage,
and at the end of an import."""


class StoppedError(BaseException):
    """The time is over. Not an ``Exception``, so that nothing on the way catches it."""


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """A context that raises ``StoppedError`` after so many seconds of processor time; no limit for
    ``None``.

    It is raised at once where there are no such timers, or outside the main thread.
    """
    if seconds is None:
        yield
        return
    main = threading.current_thread() is threading.main_thread()
    if not (main and hasattr(signal, "setitimer")):
        raise StoppedError("--seconds needs the timers of Unix and the main thread")

    over = StoppedError(f"stopped after {seconds:g} s of processor time (--seconds)")
    rung = False

    def stop(*_: object) -> None:
        nonlocal rung
        rung = True
        raise over

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds, AGAIN)
    try:
        yield
    except Exception as error:
        if rung:  # what is raised within a library of C may come out of it as another error
            raise over from error
        raise
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@contextmanager
def heard() -> Iterator[Callable[[], bool]]:
    """A context in which the first Ctrl-C is noted, to be asked for, and the second one stops."""
    asked = False

    def note(*_: object) -> None:
        nonlocal asked
        if asked:
            raise KeyboardInterrupt
        asked = True

    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: asked
    finally:
        signal.signal(signal.SIGINT, before)


def one_line(words: object) -> str:
    """A message, which may quote a file, as one line that a terminal can only print."""
    shown = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(words)[: 2 * MESSAGE])
    return shown if len(shown) <= MESSAGE else f"{shown[: MESSAGE - 1]}…"
