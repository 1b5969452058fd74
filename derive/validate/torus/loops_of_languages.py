"""Emitted C with loops, read with its types, tables and lists of names; emitted Julia with loops,
whose blocks end with a word and whose indices count from 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..read_file import CReader
from ..syntax import CONTRACT, END
from ..terms import Expression, Statement
from .loop_reader import WHOLE, Kind, LoopReader


class CLoopReader(LoopReader, CReader):
    """The reader of C, with its types."""

    def spelt(self, name: str) -> str:
        """The name in this file of a function of the contract."""
        return f"{self.prefix}_{name}"

    def _further(self) -> bool:
        """Read a type of arrays, a table, or a function of the file's own."""
        self.name = " "
        if self.took("typedef real"):
            name = self.next()
            self.types[name] = self._sizes()
            self.take(";")
            return True
        if self.took("static const"):
            self.at -= 2
            self._declaration(self.tables)
            return True
        if not self.took("static") and self.near(1).removeprefix(f"{self.prefix}_") in CONTRACT:
            return False
        returns = self._type()
        self._routine(self.naming(), self._parameters(), None if returns == "void" else returns)
        return True

    def _parameter(self) -> tuple[str, Kind]:
        self.took("const")
        kind = self._type()
        if self.took("( *"):
            name = self.naming()
            self.take(")")
            return name, self._sizes()
        pointer = self.took("*")
        name = self.naming()
        return name, () if pointer else kind[1:] if isinstance(kind, tuple) else kind

    def _type(self) -> Kind:
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
            found.append(0 if self.word == "]" else self.integer()[1])
            self.take("]")
        return tuple(found)

    @property
    def _declares(self) -> bool:
        return self.word in ("static", "const", *WHOLE, *self.types, *self.syntax.reals)

    def _counters(self) -> list[Statement]:
        """The declaration in the head of a loop."""
        found = list[Statement]()
        self._declaration(found, loop=True)
        return found

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
            sizes = self._sizes() + (base if isinstance(base, tuple) else ())
            if sizes and self.took("="):
                body.append(self._table(name, base, sizes, constant=constant))
            elif sizes:
                body.append(("array", name, sizes, None))
            elif isinstance(base, dict) or (base in WHOLE and not constant and not loop) or fixed:
                self.unknown()
            else:
                self.take("=")
                body.append(("declare", () if pointer else base, name, self.expression()))
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
            rows.append(self._row(base) if isinstance(base, dict) else (base, self.expression()))
            if not self.took(",") and self.word != "}":
                self.unknown()
        if not constant or len(sizes) != 1 or sizes[0] not in (0, len(rows)):
            self.unknown(f"{name} has {len(rows)} entries")
        return ("table", name, rows)

    def _row(self, fields: Mapping[str, Kind]) -> dict[str, tuple[Kind, Expression]]:
        self.take("{")
        entries = self.listed("}")
        if len(entries) != len(fields):
            self.unknown("a row with another number of entries")
        pairs = zip(fields.items(), entries, strict=True)
        return {field: (kind, x) for (field, kind), x in pairs}


REALS = ("Float64", "Float32")


class JuliaLoopReader(LoopReader):
    """The reader of Julia, where a name is declared by what it becomes first: one that begins as a
    decimal varies, others are constants; D is a matrix."""

    by_columns = True

    def naming(self) -> str:
        """A name, also of a function that writes what it is given."""
        return self.next() if self.word.endswith("!") else super().naming()

    # -- the file ----------------------------------------------------------------------------

    def function(self, name: str) -> None:
        """The statements of a function of the contract, whose arguments are in its order."""
        order = " ".join(CONTRACT[name]).split()
        self.arguments = [x for x in order if x in self.arguments]
        super().function(name)

    def _routine(self, name: str, arguments: list[tuple[str, Kind]], returns: Kind) -> None:
        super()._routine(name, arguments, returns)
        self.take("end")

    def _opened(self) -> None:
        self.take(END)

    def _declaration(self, body: list[Statement]) -> None:
        """A table of numbers."""
        self.take("const")
        name = self.naming()
        self.take("= [")
        rows = self._numbers()
        self.take(END)
        body.append(("table", name, rows))
        self.kinds[name] = (len(rows),)

    # -- statements --------------------------------------------------------------------------

    def _block(self) -> tuple[Statement, ...]:
        """Statements up to the word that ends them, where their names end."""
        outer, body = dict(self.kinds), list[Statement]()
        while self.word not in ("end", "else"):
            self._do(body)
        self.kinds = outer
        return tuple(body)

    def _do(self, body: list[Statement]) -> None:
        if self.took(*self.syntax.ignored):
            pass
        elif self.took("if"):
            body.append(self._branch())
        elif self.took("for"):
            body.append(self._repeat())
        elif self.took("return nothing"):
            body.append(("return", ("int", 0)))
        elif self.took("return"):
            body.append(("return", self.expression()))
        elif self._throws():
            self._check()
            return
        elif self.near(1) == "=" and self.word not in self.kinds:
            self._first(body)
        else:
            self._assignment(body)
            return
        self.take(END)

    def _first(self, body: list[Statement]) -> None:
        """A name with its first value, or an array of zeros."""
        name, kind = super().naming(), None
        self.take("=")
        if self.took("zeros ( float ( eltype ( argument ) ) ,"):
            sizes = tuple(x[1] if x[0] == "int" else self.unknown() for x in self.listed(")"))
            body.append(("array", name, sizes, 0))
            self.kinds[name] = sizes
            return
        value = self.expression()
        kind = "real" if value[0] == "lit" else None
        body.append(("declare", kind, name, value))
        self.kinds[name] = kind

    def _branch(self) -> Statement:
        test = self.expression()
        self.take(END)
        then, otherwise = self._block(), tuple[Statement, ...]()
        if self.took("else"):
            self.take(END)
            otherwise = self._block()
        self.take("end")
        return ("if", test, then, otherwise)

    def _repeat(self) -> Statement:
        """``i in a:b``, or ``i in a:n:b``; i is no name of something else."""
        name, outer = self.naming(), dict(self.kinds)
        if name in outer:
            self.unknown(f"{name} is declared twice")
        self.take("in")
        start = self._sum()
        self.take(":")
        bound, step = self._sum(), ("int", 1)
        if self.took(":"):
            if bound[0] != "int":
                self.unknown()
            bound, step = self._sum(), bound
        self.take(END)
        self.kinds[name] = "int"
        body = self._block()
        self.kinds = outer
        self.take("end")
        first = ("declare", "int", name, start)
        return ("loop", (first,), name, ("add", bound, ("int", 1)), ((name, step),), body)

    # -- expressions -------------------------------------------------------------------------

    def _call(self) -> Expression | None:
        if not self.straight and self.word in REALS and self.near(1) == "(":
            if not self._of_kind(REALS.index(self.word)):
                self.unknown()
            self.at += 2
            return ("real", self._argument())
        return super()._call()

    def _entry(self) -> Expression:
        """A name, an entry of an array, or a call of a function of the file's own."""
        if not self.straight and self.near(1) == "(" and self.word in map(self.spelt, CONTRACT):
            self.unknown()  # whose arguments stand in another order
        return super()._entry()

    def _within(self, found: Expression) -> Expression:
        """An entry of an array, by all its places, of D column by column."""
        if self.took("["):
            first, *others = self.listed("]")
            if found == ("var", "D") and others:
                rows = ("int", int(self.values.get("N_STATE", 0)))
                first = ("add", first, ("mul", rows, ("sub", others.pop(), ("int", 1))))
            for place in (first, *others):
                found = ("item", found, ("sub", place, ("int", 1)))
        return found
