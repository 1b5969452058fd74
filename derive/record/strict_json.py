"""A reader of strict JSON (RFC 8259): no NaN, no infinities, every key of an object once."""

from __future__ import annotations

import json
from typing import Any


def loads(text: str) -> Any:
    """The data of a text; ``ValueError`` says in one line what cannot be read."""
    try:
        return json.loads(text, parse_constant=_no_constant, object_pairs_hook=_object)
    except RecursionError:
        raise ValueError("nested deeper than can be read") from None
    except ValueError as error:  # Python reads no integer of thousands of digits
        if "set_int_max_str_digits" in str(error):
            raise ValueError("an integer of thousands of digits") from None
        raise


def _no_constant(name: str) -> Any:
    """``ValueError`` for NaN and the infinities, which are no JSON."""
    raise ValueError(f"{name} is no number of JSON")


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object from its keys and values; ``ValueError`` for a key that occurs twice."""
    found = dict(pairs)
    if len(found) < len(pairs):
        twice = next(key for k, (key, _) in enumerate(pairs) if key in dict(pairs[:k]))
        raise ValueError(f"key {twice[:40]!r} stands twice")
    return found
