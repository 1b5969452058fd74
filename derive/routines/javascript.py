"""Algorithms in JavaScript: lanes are parts of flat arrays; arrays that a routine works with are
kept in the motion, or the module, as to make them takes long."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any, ClassVar

from .printer import PRODUCT, Lines, Printer
from .source import LANES, Type, flat


class JavaScript(Printer):
    """A module of ECMAScript 2020."""

    spaced = False
    counter = "let"
    words: ClassVar = {
        "True": "true",
        "False": "false",
        "INFINITY": "Infinity",
        "NOTHING": "[]",
        "==": "===",
        "!=": "!==",
    }
    builtin: ClassVar = {
        "abs": "Math.abs({})",
        "real": "{:.}",
        "whole": "Math.floor({})",
        "sqrt": "Math.sqrt({})",
        "sin": "Math.sin({})",
        "atan2": "Math.atan2({}, {})",
        "power": "{:.}**({})",
        "fused": "({2} + {0:.}*{1:.})",
        "in_memory": "",
        "is_held": "!m.inputs",
        "no_inputs": "m.inputs = null",
    }
    lanes = "for (let s = 0; s < 8; ++s) {"
    lane_given: ClassVar = ("s",)

    def __init__(self, source: Any, given: Any):
        super().__init__(source, given)
        self.work: dict[str, int] = {}
        """Array that a routine works with → its place among those that a motion keeps."""

    # -- heads -------------------------------------------------------------------------------------
    def documented(self, f: ast.FunctionDef) -> Lines:
        if f.name not in self.given["public"]:
            yield from super().documented(f)
            return
        yield "/**"
        for line in self.paragraph(self.with_numbers(ast.get_docstring(f) or "")):
            yield f" * {line}"
        yield " *"
        optional = {a.arg for a in f.args.args[len(f.args.args) - len(f.args.defaults) :]}
        for name in self.arguments:
            said = self.given["tags"].get(name, f"{{number}} {name}")
            said = said.replace(f" {name}", f" [{name}]") if name in optional else said
            yield f" * @param {said}"
        yield f" * @returns {{number}} {self.given['status']}"
        yield " */"

    def head(self, f: ast.FunctionDef, returns: Type | None) -> Lines:
        given = self.with_defaults(f, self.argument)
        public = f.name in self.given["public"]
        name = self.given.get(f.name, f.name)
        given += [*self.lane_given] * self.of_lanes
        yield from self.wrapped(f"{'export ' * public}function {name}({', '.join(given)}) {{")
        if public:
            yield from self.given["entry"]

    def argument(self, name: str) -> str:
        """An argument; lanes by an array and where they begin in it."""
        return f"{name}, {name}_at" if self.arguments[name].is_lanes else name

    # -- statements --------------------------------------------------------------------------------
    def statement(self, x: ast.stmt, depth: int) -> Lines:
        """A loop over a few numbers is written out in a routine that is called for each lane."""
        match x:
            case ast.For(target=ast.Name(id=i), iter=ast.Call(args=limits)) if self.of_lanes:
                outer = self.given
                for n in range(*map(ast.literal_eval, limits)):
                    self.given = {**outer, i: n}
                    yield from self.block(x.body, depth)
                self.given = outer
            case _:
                yield from super().statement(x, depth)

    def declared(self, name: str, kind: Type, value: str | None) -> str:
        word = "let" if kind.written else "const"
        if value is None:
            motion = next((a for a, t in self.arguments.items() if t.name == "Motion"), None)
            value = self.made(kind)
            if motion:
                place = self.work.setdefault(f"{self.routine} {name}", len(self.work))
                value = f"({motion}.work[{place}] ??= {value})"
            elif kind.sizes:
                return self.hoist(name, value)
        return f"{word} {name} = {value}"

    def made(self, t: Type) -> str:
        """What a number, an array or a record is before it is computed."""
        if t.name in self.source.records:
            return f"{t.name}()"
        if t.name in LANES:
            return f"new Float64Array({'*'.join([*self.sizes(t)])})"
        if not t.sizes:
            return "false" if t.name == "flag" else "0"
        *outer, last = self.sizes(t)
        found = f"new {self.given['real'] if t.name == 'real' else 'Int32Array'}({last})"
        for n in reversed(outer):
            found = f"Array.from({{ length: {n} }}, () => {found})"
        return found

    def table(self, name: str, kind: Type, values: Any, depth: int = 0) -> str:
        return self.hoist(name, self.rows(values, kind))

    def rows(self, values: Any, kind: Type) -> str:
        """Numbers, by rows; lanes one after the other."""
        if kind.name in LANES:
            return f"Float64Array.of({', '.join(map(self.constant, flat(values)))})"
        if not isinstance(values, (list, tuple)):
            return self.constant(values)
        inner = ", ".join(self.rows(x, kind) for x in values)
        return f"[{inner}]"

    def name(self, x: str) -> str:
        return self.hoisted.get(x, x)

    def copied(self, to: ast.expr, of: ast.expr) -> str:
        return f"{self.outside(to)}.set({self.outside(of)})"

    # -- expressions -------------------------------------------------------------------------------
    def quotient(self, a: str, b: str) -> str:
        return f"Math.floor({a}/{b})"

    def called(self, name: str, given: Sequence[ast.expr]) -> str:
        if name == "projected":
            return f"{self.given['project']}({', '.join(map(self.outside, given))})"
        return super().called(name, given)

    # -- lanes -------------------------------------------------------------------------------------
    def flat(self, x: ast.expr) -> tuple[str, str]:
        """The array that lanes are of, and where they begin."""
        if isinstance(x, ast.Subscript):
            known = self.known(x.slice)
            begin = f"8*{self.at(x.slice, PRODUCT + 1)}" if known is None else str(8 * known)
            return self.outside(x.value), begin
        given = isinstance(x, ast.Name) and x.id in self.arguments
        return self.outside(x), f"{self.outside(x)}_at" if given else "0"

    def lane(self, x: ast.expr) -> str:
        if isinstance(x, ast.Name) and x.id in self.lane_locals:
            return x.id
        array, begin = self.flat(x)
        return f"{array}[{begin} + s]" if begin != "0" else f"{array}[s]"

    def lane_entry(self, x: ast.Subscript) -> str:
        array, begin = self.flat(x.value)
        known = self.known(x.slice)
        place = self.bare(x.slice) if known is None else str(known)
        if "0" in (begin, place):
            return f"{array}[{place if begin == '0' else begin}]"
        return f"{array}[{begin} + {place}]"

    def known(self, x: ast.expr) -> int | None:
        """The value of an index that is known when a file is written."""
        match x:
            case ast.Constant(value=int(value)):
                return value
            case ast.Name(id=name) if isinstance(given := self.given.get(name), int):
                return int(given)
            case ast.BinOp(left, ast.Add(), right):
                a, b = self.known(left), self.known(right)
                return None if a is None or b is None else a + b
        return None

    def passed(self, x: ast.expr, kind: Type) -> str:
        return ", ".join(self.flat(x)) if kind.is_lanes else super().passed(x, kind)

    # -- records, tables ---------------------------------------------------------------------------
    def record(self, name: str, more: str = "") -> Lines:
        """A function that makes a record; ``more``: fields that no algorithm reads."""
        yield from self.comment(self.doc_of(name))
        yield f"function {name}() {{"
        yield "    return {"
        for field, t, told in self.fields(name):
            yield f"        {field}: {self.made(t)}," + f" // {told}" * bool(told)
        yield from more.splitlines()
        yield "    };"
        yield "}"

    def known_table(self, name: str, kind: Type, values: Any) -> Lines:
        halved = _halved(values) if kind.name in LANES and kind.sizes else None
        text = f"{halved[0]}({', '.join(map(self.constant, halved[1]))})" if halved else ""
        return self.wrapped(f"const {name} = {text or self.rows(values, kind)};")


def _halved(rows: Sequence[Sequence[float]]) -> tuple[str, list[float]] | None:
    """Of eight rows that half of their numbers tell without rounding, the function that makes them
    of these, and these; ``None`` for others."""
    span = range(8)
    if all(rows[n][7 - j] == (-1) ** n * rows[n][j] for n in span for j in span):
        return "mirrored", [x for row in rows for x in row[:4]]
    if all(rows[j][i] == 1 - rows[i][j] for i in span for j in span):
        return "completed", [rows[i][j] for i in span for j in range(i)]
    return None
