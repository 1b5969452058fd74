"""The bounds of a command: a limit on its processor time, and one printable line for a message."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from ..language.limits import MESSAGE


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

    def stop(*_: object) -> None:
        raise StoppedError(f"stopped after {seconds:g} s of processor time (--seconds)")

    before = signal.signal(signal.SIGPROF, stop)
    # and again each second: Python drops what is raised while it collects garbage
    signal.setitimer(signal.ITIMER_PROF, seconds, 1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def one_line(words: object) -> str:
    """A message, which may quote a file, as one line that a terminal can only print."""
    shown = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(words)[: 2 * MESSAGE])
    return shown if len(shown) <= MESSAGE else f"{shown[: MESSAGE - 1]}…"
