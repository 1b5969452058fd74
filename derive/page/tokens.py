"""The tokens of a script, with the brackets that belong together.

For our own templates: statements end in semicolons, there is no literal of a regular expression,
and no brace within a place of a template.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

TOKEN = re.compile(
    r"""/\*.*?\*/|(?:(?<=\s)|^)//[^\n]*|"(?:[^"\\\n]|\\.)*"|`[^`]*`
    |(?:\d|\.\d)[\w.]*(?:(?<=e)[-+]\d+)?|[^\W\d][\w$]*|\s+|\.\.\.|\?\.|\?\?=?|=>|\+\+|--|.""",
    re.DOTALL | re.VERBOSE | re.MULTILINE,
)
NAME = re.compile(r"[^\W\d][\w$]*")
PLACE = re.compile(r"(?<=\$\{)(.*?)(?=\})")
OPENING, CLOSING = ("(", "[", "{"), (")", "]", "}")


def plain(source: str) -> str:
    """A script without its comments."""
    return "".join(x for x in TOKEN.findall(source) if not x.startswith(("/*", "//")))


def tokens(source: str) -> list[str]:
    """The tokens of a script but its spaces and comments; a template in pieces, ```a${``, ``}b${``
    and ``}c```, with the tokens of its places between them."""
    found: list[str] = []
    for x in TOKEN.findall(source):
        if x[0] == "`" and "${" in x:
            for k, piece in enumerate(PLACE.split(x)):
                found += tokens(piece) if k % 2 else [piece]
        elif not x.isspace() and not x.startswith(("/*", "//")):
            found.append(x)
    return found


def opens(token: str) -> bool:
    """Does it open what a later token closes?"""
    return token in OPENING or (token[0] in "`}" and token.endswith("${"))


def closes(token: str) -> bool:
    """Does it close what an earlier token opened?"""
    return token in CLOSING or (token[0] == "}" and len(token) > 1)


def mates(found: Sequence[str]) -> dict[int, int]:
    """Where what each token opens is closed; ``ValueError`` where something is left open."""
    pairs: dict[int, int] = {}
    stack: list[int] = []
    for k, x in enumerate(found):
        if closes(x):
            pairs[stack.pop()] = k
        if opens(x):
            stack.append(k)
    if stack:
        raise ValueError(f"{found[stack[-1]]!r} is not closed")
    return pairs


def spaced(found: Sequence[str]) -> Iterator[str]:
    """The tokens with a space between two where it is needed, and no others."""
    before = ""
    for x in found:
        word = before[-1:].isalnum() or before[-1:] in ("_", "$")
        sign = before[-1:] in ("+", "-") and x[0] == before[-1]
        if (word and (x[0].isalnum() or x[0] in "_$")) or sign:
            yield " "
        yield x
        before = x
