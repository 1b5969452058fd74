"""The tables of a problem file as TOML has them, and where in them a name or a mistake stands."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ..language.limits import TABLES
from ..schema.lagrangian_kinds import SECTIONS
from .problem import ProblemError

LIKE_A_PLACE = re.compile(r"[rv][0-9]+_\w+")


def tables(data: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """The tables of an array [[key]]; not more than their limit."""
    tables = data.get(key, [])
    if not isinstance(tables, list) or not all(isinstance(t, dict) for t in tables):
        raise ProblemError(f"key {key!r} must be written [[{key}]]")
    most = TABLES[key]
    if len(tables) > most:
        more = "; give their moments in [body]" if key == "point" else ""
        raise ProblemError(f"more than {most} tables [[{key}]]{more}")
    return tables


def used_at(data: Mapping[str, Any], name: str, *but: str) -> str:
    """The first table and key, but some, in which a name stands, as other messages say it."""
    word = re.compile(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])")
    for kind in (*TABLES, "body", *SECTIONS):
        listed = isinstance(data.get(kind), list)
        for k, table in enumerate(data[kind] if listed else [data.get(kind, {})], 1):
            for key, value in table.items():
                if key not in but and word.search(str(value)):
                    return f"{kind} {k}, key {key!r}" if listed else f"{kind}, key {key!r}"
    return "file"
