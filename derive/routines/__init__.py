"""Run-time algorithms, each written once (``algorithms/``) and printed in every language."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from .c import C
from .javascript import JavaScript
from .julia import Julia
from .printer import Printer
from .python import Python
from .rust import Rust
from .source import Source

PRINTERS: dict[str, type[Printer]] = {
    "c": C,
    "rust": Rust,
    "javascript": JavaScript,
    "julia": Julia,
}
"""The languages whose functions of plain numbers may have loops: in others such take arrays of any
library, and are written by these."""


@cache
def text_of(name: str) -> str:
    """An algorithm, as it is written."""
    folder = Path(__file__).parent / "algorithms"
    return (folder / f"{name}.py").read_text(encoding="utf-8")


def printer_of(
    language: str, texts: Iterable[str], given: Mapping[str, Any], prefix: str, real: str
) -> Printer:
    """The printer of algorithms that work with plain numbers of a type, ``real`` as the language
    calls it, in JavaScript always double; ``given``: what they know of the file."""
    known = {
        "prefix": prefix,
        "real": "Float64Array" if language == "javascript" else real,
        "inline": "static inline",
        "public": (),
        "generic": True,
        "named": (),
        "returned": {},
        **given,
    }
    source = Source()
    for text in texts:
        source.read(text, known)
    return PRINTERS.get(language, Python)(source, known)
