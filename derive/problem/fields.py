"""Fields of a problem file: one of the right type, or one line that says what is wrong."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from ..algebra.groups import Group
from ..language.expression import ExpressionError, parse
from ..language.limits import TABLES, TEXT
from ..language.reserved import WORDS
from ..language.tree import Tree
from ..schema.table import nearest
from .problem import ProblemError

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
LIKE_A_PLACE = re.compile(r"[rv][0-9]+_\w+")


def identifier(name: str, where: str) -> str:
    """A name that every emitted language can take."""
    if not NAME.fullmatch(name):
        raise ProblemError(
            f"{where}: letters, digits and _ only, starting with a letter, at most 64"
        )
    if name in WORDS:
        raise ProblemError(f"{where}: {name!r} is {WORDS[name]}; call it {name + '_'!r}, say")
    return name


def known(data: Mapping[str, Any], keys: set[str], where: str) -> None:
    """Refuse a key that has no meaning, with the nearest that has one."""
    for key in data:
        if key not in keys:
            listed = ", ".join(sorted(keys))
            hint = nearest(key, keys)
            raise ProblemError(f"{where}: unknown key {key[:40]!r}{hint} (known: {listed})")


def text(data: Mapping[str, Any], key: str, where: str) -> str:
    """A string."""
    if key not in data:
        raise ProblemError(f"{where}: key {key!r} is missing")
    if not isinstance(data[key], str):
        raise ProblemError(f"{where}: key {key!r} must be a string")
    if len(data[key]) > TEXT:
        raise ProblemError(f"{where}: key {key!r} is longer than {TEXT} letters")
    return str(data[key])


def choice(
    data: Mapping[str, Any], key: str, allowed: tuple[str, ...], where: str, default: str = ""
) -> str:
    """One of a few strings."""
    if default and key not in data:
        return default
    value = text(data, key, where)
    if value not in allowed:
        hint = nearest(value, allowed)
        raise ProblemError(f"{where}: key {key!r} must be one of {', '.join(allowed)}{hint}")
    return value


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


def expression(value: Any, where: str) -> Tree:
    """A number or a string of the grammar."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ProblemError(f"{where}: expected a number or an expression in quotes")
    if isinstance(value, float) and not math.isfinite(value):
        raise ProblemError(f"{where}: {value} is not a finite number")
    try:
        return parse(value if isinstance(value, str) else repr(value))
    except ExpressionError as error:
        raise ProblemError(f"{where}: {error}") from None


def vector(value: Any, n: int, where: str) -> tuple[Tree, ...]:
    """A list of n expressions."""
    if not isinstance(value, list) or len(value) != n:
        raise ProblemError(f"{where}: expected a list of {n} expressions")
    return tuple(expression(x, where) for x in value)


def whole(value: Any, least: int, most: int, where: str) -> int:
    """An integer in a range."""
    if type(value) is not int or not least <= value <= most:
        raise ProblemError(f"{where}: expected an integer from {least} to {most}")
    return value


def block(data: Mapping[str, Any], group: Group, where: str) -> int:
    """The factor of a product, counted from 1; without a product there is one."""
    most, value = len(group.places), data.get("block", 1)
    if most == 1 and value != 1:
        raise ProblemError(f"{where}, block: {group.name} is no product: there is one block")
    return whole(value, 1, most, f"{where}, block")


def missing(data: Mapping[str, Any], key: str, where: str) -> Any:
    """A value that must be there."""
    if key not in data:
        raise ProblemError(f"{where}: key {key!r} is missing")
    return data[key]


def unread(raw: bytes, error: ValueError) -> str:
    """What is wrong with a text that is not TOML, and the remedy where it is known."""
    if isinstance(error, UnicodeDecodeError):
        line = raw[: error.start].count(b"\n") + 1
        return f"line {line} has a byte that is not UTF-8; save the file as UTF-8"
    said = str(error)
    if said.startswith(("Cannot overwrite", "Cannot declare", "Cannot mutate")):
        said += "; a key or a table stands twice, where a list of tables is written [[…]]"
    at = re.search(r"at line ([0-9]+)", said)
    lines = raw.decode("utf-8-sig", "replace").split("\n")
    if at and not lines[int(at[1]) - 1].partition("=")[0].isascii():
        said += "; names have the letters A to Z, a to z, digits and _ only"
    return said


def used_at(data: Mapping[str, Any], name: str, *but: str) -> str:
    """The first table and key, but some, in which a name stands, as other messages say it."""
    word = re.compile(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])")
    for kind in (*TABLES, "body"):
        listed = isinstance(data.get(kind), list)
        for k, table in enumerate(data[kind] if listed else [data.get(kind, {})], 1):
            for key, value in table.items():
                if key not in but and word.search(str(value)):
                    return f"{kind} {k}, key {key!r}" if listed else f"{kind}, key {key!r}"
    return "file"
