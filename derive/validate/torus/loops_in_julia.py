"""Emitted Julia with loops, whose blocks end with a word and whose indices count from 1."""

from __future__ import annotations

from ..syntax import CONTRACT, END
from ..terms import Expression, Statement
from .loop_reader import Kind, LoopReader

REALS = ("Float64", "Float32")


class JuliaLoopReader(LoopReader):
    """The reader of Julia, where a name is declared by what it becomes first: one that begins as a
    decimal varies, others are constants."""

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
        if self.took("if"):
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
        if self.straight or self.word in ("true", "false"):
            return super()._entry()
        name = self.naming()
        if name in self.routines and self.took("("):
            if name in map(self.spelt, CONTRACT):
                self.unknown()  # whose arguments stand in another order
            self.calls.add(name)
            return ("call", name, *self.listed(")"))
        if name not in self.kinds:
            self.at -= 1
            self.unknown()
        found: Expression = ("var", name)
        if self.took("["):
            for place in self.listed("]"):
                found = ("item", found, ("sub", place, ("int", 1)))
        return found
