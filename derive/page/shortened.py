"""JavaScript as a page carries it: without comments and spaces, what is not called left out, its
own names short, and constants that follow each other in one statement.

For our own templates: functions and tables of a module begin and end at the first column, and no
statement is empty.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from .scopes import renamed
from .tokens import CLOSING, NAME, OPENING, plain, spaced, tokens

TAKEN = re.compile(r"(?:(?<![\w$.])|(?<=\.\.\.))[^\W\d][\w$]*")
"""A name that is not that of a property."""

OFTEN = ("Math", "Number", "Object", "Float64Array", "document")
"""What is named where it is used often."""

DEFINED = re.compile(
    r"^(?:function (\w+).*?\n\}\n|const (\w+|\{[^}]*\}).*?;\n(?=\n*(?:[^\s})\]]|\Z)))",
    re.DOTALL | re.MULTILINE,
)


def called(source: str, names: Sequence[str]) -> str:
    """The functions and tables of a module that are needed for some of them."""
    parts = [(NAME.findall(m[1] or m[2]), m[0]) for m in DEFINED.finditer(plain(source))]
    defined = {name: text for own, text in parts for name in own}
    needed, left = set[str](), [*names]
    while left:
        name = left.pop()
        if name not in needed and name in defined:
            needed.add(name)
            taken = defined[name].startswith("const {")
            left += TAKEN.findall(defined[name].partition("=")[2] if taken else defined[name])
    return "".join(_of(own, text, needed) for own, text in parts if needed & {*own})


def _of(own: Sequence[str], text: str, needed: Collection[str]) -> str:
    """A part of a module; of a pattern, the names that are needed."""
    if not text.startswith("const {"):
        return text
    return f"const {{ {', '.join(x for x in own if x in needed)} }} ={text.partition('=')[2]}"


def shortened(source: str) -> str:
    """A script that does the same in fewer characters."""
    plain_tokens = [_literal(x) for x in tokens(source)]
    return "".join(spaced(_in_one(_bare(renamed(_called_once(plain_tokens))))))


def _called_once(found: Sequence[str]) -> list[str]:
    """The tokens with constants for what is used often of the language's own, after the first
    statement, which may say how strict the script is."""
    places = {
        x: [k for k, y in enumerate(found) if y == x and found[k - 1] not in (".", "?.")]
        for x in OFTEN
    }
    often = {x: ks for x, ks in places.items() if len(ks) * (len(x) - 2) > len(x) + 4}
    kept = [*found]
    for x, ks in often.items():
        for k in ks:
            kept[k] = f"own_{x}"
    head = 2 if kept[:1] == ['"use strict"'] else 0
    own = [y for x in often for y in ("const", f"own_{x}", "=", x, ";")]
    return [*kept[:head], *own, *kept[head:]]


def _literal(token: str) -> str:
    """0.5 as .5, 2.0 as 2, and truth as the negation of a number."""
    if token in ("true", "false"):
        return "!0" if token == "true" else "!1"
    return re.sub(r"^0(?=\.)", "", token.removesuffix(".0")) if token[0].isdigit() else token


def _bare(found: Sequence[str]) -> list[str]:
    """The tokens without the parentheses about a parameter that is alone."""
    alone = [
        k
        for k, x in enumerate(found)
        if x == "(" and NAME.fullmatch(found[k + 1]) and [*found[k + 2 : k + 4]] == [")", "=>"]
    ]
    left_out = {*alone, *(k + 2 for k in alone)}
    return [x for k, x in enumerate(found) if k not in left_out]


def _in_one(found: Sequence[str]) -> list[str]:
    """Constants that follow each other, in one statement, and no comma before an end."""
    kept: list[str] = []
    constant = [False]
    for k, x in enumerate(found):
        after = found[k + 1] if k + 1 < len(found) else ""
        if x == "const":
            if kept[-1:] == [","] and constant[-1]:
                continue
            constant[-1] = True
        elif x in OPENING:
            constant.append(False)
        elif x in CLOSING:
            constant.pop()
        elif x == ";":
            if constant[-1] and after == "const":
                x = ","
            else:
                constant[-1] = False
        last = x == "," and after in CLOSING and kept[-1] not in (",", "[")
        if not last and not (x == ";" and after == "}"):
            kept.append(x)
    return kept
