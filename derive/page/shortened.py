"""JavaScript as a page carries it: without comments and spaces, what is not called left out, its
own names short.

For our own templates: functions begin and end at the first column, statements end in semicolons,
there is no literal of a regular expression, and no brace within a place of a template.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from string import ascii_letters

TOKEN = re.compile(
    r"""/\*.*?\*/|(?:(?<=\s)|^)//[^\n]*|"(?:[^"\\\n]|\\.)*"|`[^`]*`
    |(?:\d|\.\d)[\w.]*(?:(?<=e)[-+]\d+)?|[^\W\d][\w$]*|\s+|\.\.\.|\?\.|\+\+|--|.""",
    re.DOTALL | re.VERBOSE | re.MULTILINE,
)
NAME = re.compile(r"[^\W\d]\w*")
DEFINED = re.compile(r"^(?:function (\w+).*?\n\}\n|const (\w+).*?;\n)", re.DOTALL | re.MULTILINE)
OPENING, CLOSING = ("(", "[", "{"), (")", "]", "}")
PLACE = re.compile(r"\$\{(.*?)\}")


def called(source: str, names: Sequence[str]) -> str:
    """The functions and tables of a module that are needed for some of them."""
    plain = "".join(x for x in TOKEN.findall(source) if not x.startswith(("/*", "//")))
    defined = {m[1] or m[2]: m[0] for m in DEFINED.finditer(plain)}
    needed, left = set[str](), [*names]
    while left:
        name = left.pop()
        if name not in needed and name in defined:
            needed.add(name)
            left += NAME.findall(defined[name])
    return "".join(text for name, text in defined.items() if name in needed)


def shortened(source: str) -> str:
    """A script that does the same in fewer characters."""
    tokens = [x for x in TOKEN.findall(source) if not x.startswith(("/*", "//"))]
    return "".join(_in_one([*_spaced(_renamed(tokens))]))


def _spaced(tokens: Sequence[str]) -> Iterator[str]:
    """The tokens with a space between two where it is needed, and no others."""
    before = ""
    for x in tokens:
        if not x.isspace():
            word = before[-1:].isalnum() or before[-1:] in ("_", "$")
            sign = before[-1:] in ("+", "-") and x[0] == before[-1]
            if (word and (x[0].isalnum() or x[0] in "_$")) or sign:
                yield " "
            yield x
            before = x


def _in_one(tokens: list[str]) -> list[str]:
    """Constants that follow each other, in one statement."""
    found: list[str] = []
    constant = [False]
    for k, x in enumerate(tokens):
        if x == "const":
            if found[-1:] == [","] and constant[-1]:
                continue
            constant[-1] = True
        elif x in OPENING:
            constant.append(False)
        elif x in CLOSING:
            constant.pop()
        elif x == ";":
            if constant[-1] and tokens[k + 1 : k + 2] == ["const"]:
                x = ","
            else:
                constant[-1] = False
        if not (x == " " and found[-1:] == [","]):
            found.append(x)
    return found


def _renamed(tokens: Sequence[str]) -> list[str]:
    """The names that the script declares, short, where they are no properties as well."""
    inside = [x for text in tokens if text[0] == "`" for x in TOKEN.findall(text.strip("`"))]
    solid = [x for x in (*tokens, *inside) if not x.isspace()]
    kept = {b for a, b in pairwise(solid) if a in (".", "?.")}
    triples = zip(solid, solid[1:], solid[2:], strict=False)
    kept |= {b for a, b, c in triples if a in "{," and c == ":"}
    kept |= {
        x
        for inside in re.findall(r"\{([^}]*)\} = Math", "".join(tokens))
        for x in NAME.findall(inside)
    }
    used = Counter(x for text in tokens for x in _names(text))
    own = {x for x in _declared("".join(tokens)) if x in used} - kept
    order = sorted(own, key=lambda x: (-used[x], x))
    free = (x for x in _short() if x not in used or x in own)
    short = dict(zip(order, free, strict=False))
    return [_with(short, x) for x in tokens]


def _names(token: str) -> list[str]:
    """The names in a token: itself, or those in the places of a template."""
    if token[0] == "`":
        return [x for place in PLACE.findall(token) for x in NAME.findall(place)]
    return [token] if NAME.fullmatch(token) else []


def _with(short: dict[str, str], token: str) -> str:
    """A token with short names."""
    if token[0] != "`":
        return short.get(token, token)
    return PLACE.sub(lambda m: "".join(short.get(x, x) for x in TOKEN.findall(m[0])), token)


def _declared(source: str) -> Iterator[str]:
    """The names of constants, variables, functions and what they take."""
    yield from re.findall(r"\b(?:const|let|function) (\w+)", source)
    lists = re.findall(r"\b(?:const|let) [\[{]([^;]*?)[\]}] (?:=|of)", source)
    lists += re.findall(r"\bfunction \w+\(([^)]*)\)", source)
    lists += re.findall(r"\(([\w\s,=\[\]{}:]*)\) =>", source)
    for inside in lists:
        yield from NAME.findall(re.sub("=[^,]*", "", inside))


def _short() -> Iterator[str]:
    """The names of one letter, of two, of three."""
    words = {"as", "do", "if", "in", "is", "of", "for", "get", "let", "new", "set", "try", "var"}
    for n in (1, 2, 3):
        yield from (x for x in map("".join, product(ascii_letters, repeat=n)) if x not in words)
