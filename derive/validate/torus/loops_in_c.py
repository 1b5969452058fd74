"""Emitted C with loops, read with its types, tables and lists of names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..read_file import CReader
from ..syntax import CONTRACT
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
