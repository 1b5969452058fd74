"""JavaScript as a page carries it: without comments and spaces, with short names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from string import ascii_letters

# The tokens of a script, with the brackets that belong together.
#
# For our own templates: statements end in semicolons, there is no literal of a regular
# expression, and no brace within a place of a template.

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


# Which names of a script mean one variable, and short ones in their place.
#
# A part of JavaScript is read, that of our own templates: functions, arrows and methods;
# ``const`` and ``let`` with patterns; blocks, ``for`` and ``catch``. A name may be given again
# where what it meant is not used: of an inner scope most names have one letter.

_WORDS = """break catch const continue delete do else false finally for function if in instanceof
let new null of return this throw true try typeof undefined void while"""
_UNKNOWN = "async await case class export import super switch var with yield"
WORDS, UNKNOWN = frozenset(_WORDS.split()), frozenset(_UNKNOWN.split())
"""The words of the language, and those that are not read."""

BEFORE_BLOCK = frozenset((")", "else", "try", "finally", "do", ";", "{", "}", "=>", ""))
"""After these a brace opens a block; after all others an object, or a pattern."""


@dataclass(eq=False)
class Scope:
    """A part of a script that variables belong to: ``own``, each with its tokens; ``outer``, the
    variables of others that are used within, and names that belong to no part of the script."""

    parent: Scope | None
    own: dict[str, list[int]] = field(default_factory=dict)
    outer: set[tuple[Scope | None, str]] = field(default_factory=set)


class Reader:
    """The scopes of a script, outer ones first; ``shorthand``: tokens that are a key as well."""

    def __init__(self, tokens: Sequence[str]):
        self.tokens, self.mate = tokens, mates(tokens)
        self.scopes: list[Scope] = []
        self.used: list[tuple[int, Scope]] = []
        self.shorthand: set[int] = set()
        for k, x in enumerate(tokens):
            if x in UNKNOWN and not self._is_property(k) and self._at(k + 1) != ":":
                raise ValueError(f"not read: {x}")
        self._visit(0, len(tokens), self._inside(None))
        for k, scope in self.used:
            self._resolve(k, scope)

    def _inside(self, parent: Scope | None) -> Scope:
        self.scopes.append(Scope(parent))
        return self.scopes[-1]

    def _at(self, k: int) -> str:
        return self.tokens[k] if 0 <= k < len(self.tokens) else ""

    def _is_property(self, k: int) -> bool:
        return self._at(k - 1) in (".", "?.")

    def _is_name(self, k: int) -> bool:
        x = self._at(k)
        return bool(NAME.fullmatch(x)) and x not in WORDS and not self._is_property(k)

    def _after(self, k: int) -> int:
        """The token after this one, or after what it opens."""
        return self.mate[k] + (self.tokens[self.mate[k]] in ")]}") if k in self.mate else k + 1

    def _until(self, k: int, stops: str, end: int) -> int:
        """The first of some tokens from k on that is in no brackets of its own."""
        while k < end and self.tokens[k] not in stops.split():
            k = self._after(k)
        return k

    def _resolve(self, k: int, scope: Scope) -> None:
        """Give a token to the variable that it means."""
        name, within = self.tokens[k], []
        home: Scope | None = scope
        while home is not None and name not in home.own:
            within.append(home)
            home = home.parent
        for x in within:
            x.outer.add((home, name))
        if home is not None:
            home.own[name].append(k)

    # -- what is read

    def _visit(self, k: int, end: int, scope: Scope) -> None:
        """Statements, or an expression."""
        while k < end:
            k = self._one(k, end, scope)

    def _one(self, k: int, end: int, scope: Scope) -> int:
        """What begins at token k; the token after it."""
        x = self.tokens[k]
        if x == "function" and not self._is_property(k):
            scope.own.setdefault(self.tokens[k + 1], []).append(k + 1)
            return self._function(k + 2, scope)
        if x == "catch" and self._at(k + 1) == "(":
            return self._function(k + 1, scope)
        if x in ("const", "let"):
            stop = self._until(k, ";", end)
            self._bind(k + 1, stop, scope)
            return stop
        if x == "for":
            stop = min(end, self._statement(k))
            self._visit(k + 1, stop, self._inside(scope))
            return stop
        if x == "(" and self._at(self.mate[k] + 1) == "=>":
            return self._arrow(k, self.mate[k] + 2, end, scope)
        if self._is_name(k) and self._at(k + 1) == "=>":
            return self._arrow(k, k + 2, end, scope)
        if x == "{":
            if self._at(k - 1) in BEFORE_BLOCK:
                self._visit(k + 1, self.mate[k], self._inside(scope))
            else:
                self._object(k + 1, self.mate[k], scope)
            return self.mate[k] + 1
        if self._is_name(k):
            self.used.append((k, scope))
        return k + 1

    def _function(self, k: int, scope: Scope) -> int:
        """What takes the pattern at k, with the block after it."""
        own, body = self._inside(scope), self.mate[k] + 1
        self._bind(k + 1, self.mate[k], own)
        self._visit(body + 1, self.mate[body], own)
        return self.mate[body] + 1

    def _arrow(self, k: int, body: int, end: int, scope: Scope) -> int:
        own = self._inside(scope)
        self._bind(*((k + 1, self.mate[k]) if k in self.mate else (k, k + 1)), own)
        if self.tokens[body] == "{":
            self._visit(body + 1, self.mate[body], own)
            return self.mate[body] + 1
        stop = self._expression(body, end)
        self._visit(body, stop, own)
        return stop

    def _expression(self, k: int, end: int) -> int:
        """Where an expression ends that begins at k."""
        choices = 0
        while k < end and self.tokens[k] not in (",", ";"):
            choices += {"?": 1, ":": -1}.get(self.tokens[k], 0)
            if choices < 0:
                break
            k = self._after(k)
        return k

    def _statement(self, k: int) -> int:
        """Where a statement ends that begins at k."""
        if self.tokens[k] == "{":
            return self.mate[k] + 1
        if self.tokens[k] in ("for", "if", "while"):
            stop = self._statement(self.mate[k + 1] + 1)
            return self._statement(stop + 1) if self._at(stop) == "else" else stop
        return self._until(k, ";", len(self.tokens)) + 1

    def _object(self, k: int, end: int, scope: Scope) -> None:
        """The entries of an object."""
        while k < end:
            stop = self._until(k, ",", end)
            if self._at(k) in ("get", "set") and NAME.fullmatch(self._at(k + 1)):
                k += 1
            if self._at(k + 1) == "(" and self._at(self.mate[k + 1] + 1) == "{":
                self._function(k + 1, scope)
            elif self._at(k + 1) == ":":
                self._visit(k + 2, stop, scope)
            else:
                if stop == k + 1 and self._is_name(k):
                    self.shorthand.add(k)
                self._visit(k, stop, scope)
            k = stop + 1

    def _bind(self, k: int, end: int, scope: Scope, keys: bool = False) -> None:
        """Patterns with their values; in braces names are ``keys``."""
        while k < end:
            x = self.tokens[k]
            if x == "=":
                stop = self._until(k, ",", end)
                self._visit(k + 1, stop, scope)
                k = stop
            elif x == "of":
                self._visit(k + 1, end, scope)
                k = end
            elif x in ("{", "["):
                self._bind(k + 1, self.mate[k], scope, x == "{")
                k = self.mate[k] + 1
            else:
                if keys and self._at(k + 1) == ":":
                    k += 1
                elif self._is_name(k):
                    scope.own.setdefault(x, []).append(k)
                    if keys and self._at(k - 1) in ("{", ","):
                        self.shorthand.add(k)
                k += 1


def renamed(tokens: Sequence[str]) -> list[str]:
    """The tokens with short names for the variables, the most used the shortest."""
    script, found = Reader(tokens), [*tokens]
    short: dict[tuple[Scope | None, str], str] = {}
    for scope in script.scopes:
        taken = {short[x] if x[0] else x[1] for x in scope.outer}
        free = (x for x in _short() if x not in taken)
        often = Counter({name: len(places) for name, places in scope.own.items()})
        for name, _ in sorted(often.items(), key=lambda x: (-x[1], x[0])):
            short[scope, name] = new = next(free)
            for k in scope.own[name]:
                found[k] = f"{name}:{new}" if k in script.shorthand and new != name else new
    return found


def _short() -> Iterator[str]:
    """The names of one letter, of two, of three."""
    words = WORDS | UNKNOWN | {"as", "get", "set"}
    for n in (1, 2, 3):
        yield from (x for x in map("".join, product(ascii_letters, repeat=n)) if x not in words)


# JavaScript as a page carries it: without comments and spaces, what is not called left out, its
# own names short, and constants that follow each other in one statement.
#
# For our own templates: functions and tables of a module begin and end at the first column, and
# no statement is empty.

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
