"""The words of a file, one after the other, and the expressions among them, of any language."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import NoReturn

from ..check.values.evaluate import ELEMENTARY
from .exact_points import BUNDLES, MOST
from .exact_points import NAME as INTEGRALS
from .syntax import END, SYNTAX, Token
from .terms import DECIMAL, CodeError, Expression

SUMS, PRODUCTS = {"+": "add", "-": "sub"}, {"*": "mul", "/": "div"}
COMPARED = {">": "gt", "<": "lt", "<=": "le", "==": "eq"}
INTEGER = re.compile(r"0|[1-9][0-9]{0,6}")
SIZE = re.compile(r"N_[A-Z]+|[0-9]+")
NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
OPEN, CLOSE = ("(", "[", "{"), (")", "]", "}")
words_of = cache(str.split)


class ExpressionReader:
    """The words of a file in a language, at one of them; ``prefix``: of its names.

    ``real``: are its numbers float, 1, or double, 0; -1 before one of them was met.  ``sizes``:
    integers that have a name.  Of the function that is read, ``name``, ``arguments``, and
    ``counters``, the names of whole numbers.
    """

    products: Mapping[str, str] = PRODUCTS

    def __init__(self, language: str, words: Iterable[Token], prefix: str = ""):
        self.language, self.syntax, self.prefix = language, SYNTAX[language], prefix
        self.tokens, self.at, self.real = [*words], 0, -1
        self.sizes: dict[str, int] = {}
        self.name, self.arguments, self.counters = "", [""], set[str]()
        self.names: set[str] = set()

    # -- words -------------------------------------------------------------------------------

    def near(self, steps: int) -> str:
        """The word so many steps away; empty outside of the file."""
        at = self.at + steps
        return self.tokens[at].text if 0 <= at < len(self.tokens) else ""

    @property
    def word(self) -> str:
        """The next word; empty at the end."""
        return self.near(0)

    def unknown(self, why: str = "", at: int | None = None) -> NoReturn:
        """Raise ``CodeError`` for the next word, or that at a place."""
        at = self.at if at is None else at
        if at >= len(self.tokens):
            raise CodeError("the file ends too early")
        token = self.tokens[at]
        shown = repr(token.text[:40]) if token.text != END else "the end of the line"
        why = why or f"{shown} is not known here"
        raise CodeError(f"{token.file}, line {token.line}: {why}")

    def next(self) -> str:
        """The next word, which is passed."""
        if not self.word:
            self.unknown()
        self.at += 1
        return self.near(-1)

    def take(self, pattern: str) -> None:
        """Pass the words of a pattern, which must stand here."""
        if not self.took(pattern):
            self.unknown()

    def took(self, *patterns: str) -> bool:
        """Does one of some patterns stand here?  Then it is passed."""
        for pattern in patterns:
            if (end := self._matched(pattern)) is not None:
                self.at = end
                return True
        return False

    def _matched(self, pattern: str) -> int | None:
        """Where a pattern that stands here ends."""
        start, at = self.at, self.at
        for wanted in words_of(pattern) or [END]:
            word = self.near(at - start)
            if wanted == ")" and word == ",":  # after the last argument
                at, word = at + 1, self.near(at + 1 - start)
            if wanted == "…":
                at = self.closed(at)
            elif not self._is(word, wanted):
                return None
            else:
                at += 1
        return at

    def _is(self, word: str, wanted: str) -> bool:
        if wanted == "size":
            return bool(SIZE.fullmatch(word))
        if wanted == "argument":
            return word in self.arguments
        if wanted != "real" or not word or word not in self.syntax.reals:
            return word == wanted
        return self._of_kind(self.syntax.reals.index(word))

    def _of_kind(self, real: int) -> bool:
        """Are the numbers of this kind, as before?"""
        if self.real < 0:
            self.real = real
        return self.real == real

    def closed(self, at: int) -> int:
        """The place of the bracket that closes what is open at a place."""
        depth = 0
        while at < len(self.tokens) and (depth or self.tokens[at].text not in CLOSE):
            word = self.tokens[at].text
            depth += (word in OPEN) - (word in CLOSE)
            at += 1
        return at

    # -- expressions -------------------------------------------------------------------------

    def expression(self) -> Expression:
        """A sum, or in C a comparison of two."""
        left = self._sum()
        if self.language != "c" or self.word not in COMPARED:
            return left
        op, right = COMPARED[self.next()], self._sum()
        self._exact(op, left, right)
        with_zero = op == "eq" and left[0] == "var" and right == ("int", 0)
        return ("none", left) if with_zero else (op, left, right)

    def _sum(self) -> Expression:
        return self._chain(SUMS, lambda: self._chain(self.products, self._signed))

    def _chain(self, signs: Mapping[str, str], part: Callable[[], Expression]) -> Expression:
        """What is joined by signs of one level, from the left."""
        left = part()
        while self.word in signs:
            op, right = signs[self.next()], part()
            self._exact(op, left, right)
            left = (op, left, right)
        return left

    def _exact(self, op: str, a: Expression, b: Expression) -> None:
        """``CodeError`` where an operation has two integers of C."""
        del op
        if self.language == "c" and _is_integer(a) and _is_integer(b):
            self.unknown("C cuts off a quotient of integers, and their sums and products")

    def _signed(self) -> Expression:
        if self.took("-"):
            return ("neg", self._signed())
        if self.language == "c" and self.took("!"):
            return ("not", self._signed())
        return self._atom()

    def _atom(self) -> Expression:
        """A number, a name, an entry, a call, or what stands in brackets."""
        before, after = self.syntax.zero
        if before and self.took(before):
            found = self.expression()
            self.take(after)
            return ("none", found)
        if self.took("("):
            found = self.expression()
            if "(" in self.syntax.lists and self.took(","):
                return ("list", found, *self.listed(")"))
            self.take(")")
            return found
        for opening in self.syntax.lists:
            if self.took(opening):
                return ("list", *self.listed(CLOSE[OPEN.index(opening[-1])]))
        if self.word[:1].isdigit() or self.word[:1] == ".":
            return self._literal()
        return self._call() or self._entry()

    def listed(self, closed: str) -> list[Expression]:
        """Expressions up to a bracket, which is passed."""
        found = []
        while not self.took(closed):
            found.append(self.expression())
            if not self.took(",") and self.word != closed:
                self.unknown()
        return found

    def _call(self) -> Expression | None:
        """The call of a known function, where one stands here."""
        start = self.at
        suffix = "f" if self.language == "c" and self.real == 1 else ""
        if self.took(f"{self.syntax.absolute}{suffix} ("):
            return ("abs", self._argument())
        before, after = self.syntax.integrals
        for name in BUNDLES:
            if self.took(f"{before.format(prefix=self.prefix)}{name} {after}"):
                return ("fun", name, *self.listed(")"))
        if (self.syntax.calls and not self.took(self.syntax.calls)) or self.near(1) != "(":
            self.at = start
            return None
        name = self.next()
        plain = name.removesuffix(suffix)
        if plain not in ELEMENTARY or plain + suffix != name:
            self.unknown(f"the function {name[:40]} is not known here", start)
        self.take("(")
        return ("fun", plain, self._argument())

    def _argument(self) -> Expression:
        found = self.expression()
        self.take(")")
        return found

    def _entry(self) -> Expression:
        """A name, an entry of an array, or one of the integrals that a name stands for."""
        start, c = self.at, self.language == "c"
        if not NAME.fullmatch(self.word):
            self.unknown()
        name = self.next()
        if name in self.counters:
            self.unknown(f"the integer {name} stands for a number", start)
        if name in self.sizes:
            return ("int", self.sizes[name])
        held = c and self.took(". v")
        if not held and self.word != "[":
            return ("var", name)
        place = self.place()
        if name in self.arguments and not held:
            return ("at", name, place)
        if place[0] != "int" or not 0 <= place[1] < MOST or held != c:
            self.unknown(at=start)
        return ("fun", f"{INTEGRALS}_{place[1]}", ("var", name))

    def place(self) -> Expression:
        """What stands in square brackets: a place, or a row and a column, counted from 0."""
        self.take("[")
        found = self._from_first()
        if self.language == "julia" and self.took(","):
            found = ("row", found, self._from_first())
        self.take("]")
        return found

    def _from_first(self) -> Expression:
        """A whole number, less that of the first entry."""
        found = self.integer_sum()
        if not self.syntax.first:
            return found
        if found[0] != "int" or found[1] < self.syntax.first:
            self.unknown("no place of an entry")
        return ("int", found[1] - self.syntax.first)

    def integer_sum(self) -> Expression:
        """An integer, or of counters sums and multiples, without overflow."""
        terms = [self._multiple()]
        while self.took("+"):
            terms.append(self._multiple())
        found = terms[0]
        for x in terms[1:]:
            found = ("add", found, x)
        return found

    def _multiple(self) -> Expression:
        found = self.integer()
        while self.took("*"):
            other = self.integer()
            if "var" not in (found[0], other[0]):
                self.unknown("a product of integers")
            found = ("mul", found, other)
        return found

    def integer(self) -> Expression:
        """An integer, or a name of one."""
        if self.word in self.counters:
            return ("var", self.next())
        if self.word in self.sizes:
            return ("int", self.sizes[self.next()])
        if not INTEGER.fullmatch(self.word):
            self.unknown()
        return ("int", int(self.next()))

    def _literal(self) -> Expression:
        """A number without sign; an integer in C and in data alone."""
        word, short = self.word, self.syntax.suffix
        if INTEGER.fullmatch(word) and (self.language == "c" or not self.name):
            return ("int", int(self.next()))
        text = word
        if short and self._of_kind(int(short in word)):
            text = word.removesuffix(short) if self.language == "c" else word.replace(short, "e")
        if not DECIMAL.fullmatch(text):
            self.unknown(f"the number {word[:40]!r} is not read")
        self.at += 1
        return ("lit", text.removesuffix("e0"))


def _is_integer(e: Expression) -> bool:
    """Is an expression of an integer type?"""
    if e[0] in ("neg", "add", "sub", "mul"):
        return all(map(_is_integer, e[1:]))
    return bool(e[0] == "int")
