"""The names of the entries of an array, as files and emitted code have them."""

from __future__ import annotations

from collections.abc import Iterable


def suffixed(name: str, *index: int) -> str:
    """The name of an entry: ``I_12``; where an index is above 9, ``I_1_12``."""
    digits = "".join(map(str, index)) if max(index) < 10 else "_".join(map(str, index))
    return f"{name}_{digits}"


def letter_and_suffix(name: str) -> tuple[str, str]:
    """What such a name is of, and the rest: ``("zeta", "1")``, ``("re", "m1_2")``."""
    letter, _, suffix = name.partition("_")
    return letter, suffix


def by_letter(names: Iterable[str]) -> dict[str, list[str]]:
    """The names of each letter."""
    found: dict[str, list[str]] = {}
    for name in names:
        found.setdefault(letter_and_suffix(name)[0], []).append(name)
    return found
