"""Which names of a script mean one variable, and short ones in their place.

A part of JavaScript is read, that of our own templates: functions, arrows and methods; ``const``
and ``let`` with patterns; blocks, ``for`` and ``catch``.  A name may be given again where what it
meant is not used: of an inner scope most names have one letter.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from string import ascii_letters

from .tokens import NAME, mates

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
