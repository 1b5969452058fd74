"""Emitted C with loops, read into terms and run in a prime field.

What C has as ``double`` is a residue modulo p here; what it has as ``int``, on which alone places
and conditions may depend, is an integer.  So a function that is read is one rational function of
what it is given.  An array has no value where nothing was written, nor outside of it.

To the terms of straight-line code come, of expressions, ("item", array, i), ("field", row, name),
("call", name, …), ("cond", test, a, b), ("real", a), ("mod" | "and" | "or" | "ne" | "ge", a, b);
of statements, ("declare", kind, name, a), ("array", name, sizes), ("table", name, rows), ("assign",
sign, targets, a), ("if", test, body, otherwise), ("loop", declarations, name, bound, steps, body),
("do", call).  A kind is "int", "size_t", "real", or the inner sizes of an array.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..code_expressions import NAME, SUMS
from ..read_file import CReader
from ..syntax import CONTRACT, Token
from ..terms import Expression, Statement

Kind = Any
WHOLE = ("int", "size_t")
COMPARED = {"<": "lt", "<=": "le", ">": "gt", ">=": "ge", "==": "eq", "!=": "ne"}
PRODUCTS = {"*": "mul", "/": "div", "%": "mod"}
ASSIGNED = ("=", "+=", "-=", "*=")


@dataclass
class Routine:
    """A function: its arguments with their kinds, what it returns, its statements, what it
    calls."""

    name: str
    arguments: list[tuple[str, Kind]]
    returns: Kind
    body: tuple[Statement, ...]
    calls: set[str]


class LoopReader(CReader):
    """The reader of one file; ``routines``: its functions by name, ``tables``: its lists of
    numbers."""

    def __init__(self, words: Iterable[Token], prefix: str):
        super().__init__("c", words, prefix)
        self.types: dict[str, tuple[int, ...]] = {}
        self.kinds: dict[str, Kind] = {}
        self.routines: dict[str, Routine] = {}
        self.tables: list[Statement] = []
        self.calls: set[str] = set()

    # -- the file ----------------------------------------------------------------------------

    def _further(self) -> bool:
        """Read a type of arrays, a table, or a function of the file's own."""
        if self.took("typedef real"):
            name = self.next()
            self.types[name] = self._sizes()
            self.take(";")
            return True
        if self.took("static const"):
            self.at -= 1
            self._declaration(self.tables)
            return True
        if not self.took("static") and self.near(1).removeprefix(f"{self.prefix}_") in CONTRACT:
            return False
        returns = self._type()
        self._routine(self.naming(), self._parameters(), returns)
        return True

    def function(self, name: str) -> None:
        """The statements of a function of the contract."""
        self.functions[name] = None  # type: ignore[assignment]
        plain = {"t": "real", "n": "size_t"}
        arguments = [(x, plain.get(x, ())) for x in self.arguments]
        returns = "int" if name == "constants" else "void" if self.writes else "real"
        self._routine(f"{self.prefix}_{name}", arguments, returns)

    def _parameters(self) -> list[tuple[str, Kind]]:
        """The names and kinds of what a function takes."""
        self.take("(")
        found = []
        while not self.took(")"):
            self.took("const")
            kind = self._type()
            if self.took("( *"):
                name = self.naming()
                self.take(")")
                kind = self._sizes()
            elif self.took("*"):
                name, kind = self.naming(), ()
            else:
                name = self.naming()
                kind = kind[1:] if isinstance(kind, tuple) else kind
            found.append((name, kind))
            if not self.took(",") and self.word != ")":
                self.unknown()
        return found

    def _routine(self, name: str, arguments: list[tuple[str, Kind]], returns: Kind) -> None:
        if name in self.routines:
            self.unknown(f"the function {name} stands twice")
        outer = dict(self.kinds)
        self.kinds |= dict(arguments)
        self.names, self.calls = {x for x, _ in arguments}, set()
        self.take("{")
        body = self._block()
        self.kinds = outer
        self.routines[name] = Routine(name, arguments, returns, body, self.calls)

    # -- declarations ------------------------------------------------------------------------

    def _type(self) -> Kind:
        """The kind that a type stands for: of a number, or the sizes of an array."""
        if self.took("real"):
            return "real"
        if self.word in (*WHOLE, "void"):
            return self.next()
        if self.word not in self.types:
            self.unknown()
        return self.types[self.next()]

    def _sizes(self) -> tuple[int, ...]:
        found = []
        while self.took("["):
            if self.word == "]":
                found.append(0)
            else:
                found.append(self.integer()[1])
            self.take("]")
        return tuple(found)

    def _declaration(self, body: list[Statement], *, loop: bool = False) -> None:
        """Names with their values, or arrays without; whole numbers are constants, but in the head
        of a loop."""
        fixed = self.took("static")
        constant = self.took("const")
        base = self._fields() if self.took("struct {") else self._type()
        while True:
            pointer = self.took("* const")
            name = self.naming()
            if name in self.kinds:
                self.unknown(f"{name} is declared twice")
            sizes = self._sizes()
            sizes += base if isinstance(base, tuple) else ()
            if sizes and self.took("="):
                body.append(self._table(name, base, sizes, constant=constant))
            elif sizes:
                body.append(("array", name, sizes))
            elif isinstance(base, dict) or (base in WHOLE and not constant and not loop) or fixed:
                self.unknown()
            else:
                kind = () if pointer else base
                self.take("=")
                body.append(("declare", kind, name, self.expression()))
            self.kinds[name] = sizes or (() if pointer else base)
            if not self.took(","):
                break
        self.take(";")

    def _fields(self) -> dict[str, Kind]:
        """The fields of a structure, each with its kind."""
        found = {}
        while not self.took("}"):
            kind = self._type()
            found[self.naming()] = kind
            while self.took(","):
                found[self.naming()] = kind
            self.take(";")
        return found

    def _table(self, name: str, base: Kind, sizes: tuple[int, ...], *, constant: bool) -> Statement:
        """A list of numbers, or of rows of them."""
        rows: list[Any] = []
        self.take("{")
        while not self.took("}"):
            if isinstance(base, dict):
                self.take("{")
                entries = self.listed("}")
                if len(entries) != len(base):
                    self.unknown("a row with another number of entries")
                pairs = zip(base.items(), entries, strict=True)
                rows.append({field: (kind, x) for (field, kind), x in pairs})
            else:
                rows.append((base, self.expression()))
            if not self.took(",") and self.word != "}":
                self.unknown()
        if not constant or len(sizes) != 1 or sizes[0] not in (0, len(rows)):
            self.unknown(f"{name} has {len(rows)} entries")
        return ("table", name, rows)

    # -- statements --------------------------------------------------------------------------

    def _block(self) -> tuple[Statement, ...]:
        """Statements, and the bracket after them, where their names end."""
        outer, body = dict(self.kinds), list[Statement]()
        while not self.took("}"):
            self._do(body)
        self.kinds = outer
        return tuple(body)

    def _do(self, body: list[Statement]) -> None:
        if self.took("( void ) argument ;"):
            return
        if self.took("if ("):
            body.append(self._branch())
        elif self.took("for ("):
            body.append(self._repeat())
        elif self.took("return"):
            body.append(("return", self.expression()))
            self.take(";")
        elif self.word in ("static", "const", *WHOLE, *self.types, *self.syntax.reals):
            self._declaration(body)
        else:
            body.append(self._assignment())
            self.take(";")

    def _branch(self) -> Statement:
        test = self.expression()
        self.take(") {")
        then = self._block()
        otherwise: tuple[Statement, ...] = ()
        if self.took("else if ("):
            otherwise = (self._branch(),)
        elif self.took("else {"):
            otherwise = self._block()
        return ("if", test, then, otherwise)

    def _repeat(self) -> Statement:
        """What follows ``for (``; the name that is tested must grow."""
        outer, first = dict(self.kinds), list[Statement]()
        self._declaration(first, loop=True)
        name = self.word
        if self._kind_of(("var", name)) not in WHOLE:
            self.unknown()
        self.at += 1
        self.take("<")
        bound = self._sum()
        self.take(";")
        steps = [self._step()]
        while self.took(","):
            steps.append(self._step())
        self.take(") {")
        body = self._block()
        self.kinds = outer
        return ("loop", tuple(first), name, bound, tuple(steps), body)

    def _step(self) -> tuple[str, Expression]:
        """What is added to a whole number at the end of each turn."""
        if self.took("++"):
            name, added = self.naming(), ("int", 1)
        else:
            name = self.naming()
            self.take("+=")
            added = self.expression()
        if self._kind_of(("var", name)) not in WHOLE:
            self.unknown()
        return name, added

    def _assignment(self) -> Statement:
        """A call, or what is assigned to a number, or to several the same."""
        targets = [self.expression()]
        if targets[0][0] == "call" and self.word == ";":
            return ("do", targets[0])
        if self.word not in ASSIGNED:
            self.unknown()
        sign, value = self.next(), self.expression()
        while sign == "=" and self.took("="):
            targets.append(value)
            value = self.expression()
        for target in targets:
            if target[0] != "item" and self._kind_of(target) != "real":
                self.unknown()
        return ("assign", sign, tuple(targets), value)

    # -- expressions -------------------------------------------------------------------------

    def expression(self) -> Expression:
        """A choice of two, or less."""
        test = self._chain({"||": "or"}, lambda: self._chain({"&&": "and"}, self._comparison))
        if not self.took("?"):
            return test
        one = self.expression()
        self.take(":")
        return ("cond", test, one, self.expression())

    def _comparison(self) -> Expression:
        left = self._sum()
        return (COMPARED[self.next()], left, self._sum()) if self.word in COMPARED else left

    def _sum(self) -> Expression:
        return self._chain(SUMS, lambda: self._chain(PRODUCTS, self._signed))

    def _exact(self, op: str, a: Expression, b: Expression) -> None:
        """``CodeError`` for a difference of sizes: one less than 0 is large."""
        if op == "sub" and "size_t" in (self._kind_of(a), self._kind_of(b)):
            self.unknown("a difference of sizes")

    def _kind_of(self, e: Expression) -> Kind:
        """The kind of a name; a size, where one is in an expression."""
        if e[0] == "var":
            return self.kinds.get(e[1])
        parts = (x for x in e[1:] if isinstance(x, tuple))
        whole = e[0] in ("neg", "add", "sub", "mul", "mod") and any(
            self._kind_of(x) == "size_t" for x in parts
        )
        return "size_t" if whole else None

    def _signed(self) -> Expression:
        if self.took("-"):
            return ("neg", self._signed())
        if self.took("!"):
            return ("not", self._signed())
        if self.took("( real )"):
            return ("real", self._signed())
        return self._atom()

    def _call(self) -> Expression | None:
        return None if self.word in self.routines else super()._call()

    def _entry(self) -> Expression:
        """A name, or what is in the array or the row that it stands for."""
        if not NAME.fullmatch(self.word):
            self.unknown()
        name = self.next()
        if name in self.sizes:
            return ("int", self.sizes[name])
        if name in self.routines and self.took("("):
            self.calls.add(name)
            return ("call", name, *self.listed(")"))
        if name not in self.kinds:
            self.at -= 1
            self.unknown()
        found: Expression = ("var", name)
        while self.word in ("[", "."):
            if self.took("."):
                found = ("field", found, self.naming())
            else:
                self.take("[")
                found = ("item", found, self.expression())
                self.take("]")
        return found
