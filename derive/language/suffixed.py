"""The names of the entries of an array, as files and emitted code have them."""

from __future__ import annotations


def suffixed(name: str, *index: int) -> str:
    """The name of an entry: ``I_12``; where an index is above 9, ``I_1_12``."""
    digits = "".join(map(str, index)) if max(index) < 10 else "_".join(map(str, index))
    return f"{name}_{digits}"
