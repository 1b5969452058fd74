"""A word to whoever waits, from what may take long: to nobody, unless a command listens."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar

LISTENER: ContextVar[Callable[[str], None]] = ContextVar("LISTENER")


def tell(text: str) -> None:
    """Say one line to the listener, if there is one."""
    if listener := LISTENER.get(None):
        listener(text)
