"""Algorithms in Rust: a status is a ``Result``, tables are constants, nothing is shared."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any, ClassVar

from .printer import Lines, Printer
from .source import LANES, Type, by_rows

STEPS = {"Step": ("{real}", "bool"), "Steps": ("usize", "Result<(), Stopped>")}
"""Functions that are handed over: the type of their last argument, and what they return."""


class Rust(Printer):
    """Rust of the edition 2021, without the standard library where that is not asked for."""

    words: ClassVar = {
        "True": "true",
        "False": "false",
        "OK": "Ok(())",
        "NOT_FINITE": "Err(Stopped::NotFinite)",
        "NOT_CONVERGED": "Err(Stopped::NotConverged)",
        "EVENT": "Err(Stopped::AtEvent)",
        "NO_SOLUTION": "Err(Stopped::NoSolution)",
        "NOTHING": "[]",
        "SIZE_U": "N_INPUTS",
        "SIZE_K": "N_CONSTANTS",
    }
    builtin: ClassVar = {
        "abs": "abs({})",
        "sqrt": "{:.}.sqrt()",
        "sin": "{:.}.sin()",
        "atan2": "{:.}.atan2({})",
        "power": "{:.}.powf({})",
        "fused": "({2} + {0:.} * {1:.})",
        "in_memory": "",
    }
    lanes = "for s in 0..8 {"
    lane_given: ClassVar = ("s: usize",)

    def __init__(self, source: Any, given: Any):
        super().__init__(source, given)
        self.real = given["real"]
        self.given = {**given, "INFINITY": f"{self.real}::INFINITY"}

    def name(self, x: str) -> str:
        return x.upper() if x in self.source.tables and x not in self.types else x

    def kind(self, t: Type) -> str:
        """A type, of an array entry by entry."""
        plain = dict.fromkeys(("index", "count", "label"), "usize")
        plain |= dict.fromkeys((*LANES, "lane"), "f64")
        plain |= {"real": self.real, "flag": "bool", "sign": "i8", "status": "Result<(), Stopped>"}
        found = plain.get(t.name, t.name)
        for n in reversed(self.sizes(t)):
            found = f"[{found}; {n}]"
        return found

    def is_reference(self, t: Type) -> bool:
        """Is it handed over by reference?"""
        return bool(t.sizes) or t.name in LANES or t.name in self.source.records

    # -- heads -------------------------------------------------------------------------------------
    def comment(self, text: str) -> Lines:
        for line in self.paragraph(text):
            yield f"/// {line}"
        yield from self.given["item"]

    def head(self, f: ast.FunctionDef, returns: Type | None) -> Lines:
        given = [self.argument(*x) for x in self.arguments.items()] + [
            *self.lane_given
        ] * self.of_lanes
        public = "pub " * (f.name in self.given["public"])
        back = f" -> {self.real if self.of_lanes else self.kind(returns)}" if returns else ""
        name = self.given.get(f.name) or f.name
        yield from self.wrapped(f"{public}fn {name}({', '.join(given)}){back} {{")

    def argument(self, name: str, t: Type) -> str:
        """An argument with its type."""
        if t.name in STEPS:
            last, back = STEPS[t.name]
            arrays = f"&[{self.real}; N_CONSTANTS], &[{self.real}; N_INPUTS]"
            last = last.format(real=self.real)
            return f"{name}: fn(&mut Motion, {arrays}, {self.real}, {last}) -> {back}"
        reference = ("&mut " if t.written else "&") * self.is_reference(t)
        return f"{name}: {reference}{self.kind(t)}"

    # -- statements --------------------------------------------------------------------------------
    def declared(self, name: str, kind: Type, value: str | None) -> str:
        if value is None:
            value = f"{kind.name}::new()" if kind.name in self.source.records else self.zero(kind)
            kind = Type(kind.name, kind.sizes, True)
        return f"let {'mut ' * kind.written}{name}: {self.kind(kind)} = {value}"

    def zero(self, t: Type) -> str:
        """What a number or an array is before it is computed."""
        plain = {"index": "0", "count": "0", "label": "0", "flag": "false"}
        found = plain.get(t.name, "0.0")
        if t.name in self.source.records:
            found = f"{t.name}::new()"
        for n in reversed(self.sizes(t)):
            found = f"[{found}; {n}]"
        return found

    def table(self, name: str, kind: Type, values: Any, depth: int = 0) -> str:
        whole = kind.name in ("index", "sign", "count")
        text = by_rows(values, depth, lambda x: self.constant(int(x) if whole else float(x)))
        return f"let {name}: {self.kind(kind)} = {text}"

    def copied(self, to: ast.expr, of: ast.expr) -> str:
        left, right = self.outside(to), self.outside(of)
        return f"{'*' * (left in self.arguments)}{left} = {'*' * (right in self.arguments)}{right}"

    def loop_over(self, i: str, first: str, last: str, by: str, back: bool) -> str:
        if back:
            return f"for {i} in ({first}..{last}).rev() {{"
        return (
            f"for {i} in {first}..{last} {{"
            if by == "1"
            else f"for {i} in ({first}..{last}).step_by({by}) {{"
        )

    def branch(self, word: str, test: str) -> str:
        return f"{word} {test} {{"

    # -- expressions -------------------------------------------------------------------------------
    def chosen(self, test: str, yes: str, no: str) -> str:
        return f"if {test} {{ {yes} }} else {{ {no} }}"

    def called(self, name: str, given: Sequence[ast.expr]) -> str:
        if name == "real":
            return f"({self.bare(given[0])}) as {self.real}"
        if name == "whole":
            return f"({self.bare(given[0])}) as usize"
        if name == "projected":
            return f"{self.outside(given[1])} = {self.given['project']}(&{self.outside(given[0])})"
        return super().called(name, given)

    def passed(self, x: ast.expr, kind: Type) -> str:
        text = self.outside(x)
        held = text in self.arguments or not self.is_reference(kind)
        return ("" if held else "&mut " if kind.written else "&") + text

    # -- records, tables ---------------------------------------------------------------------------
    def record(self, name: str, more: str = "") -> Lines:
        """The type of a record, and one that is nothing yet."""
        public = "pub " * (name == "Motion")
        yield from (x for x in self.comment(self.doc_of(name)) if x.startswith("///"))
        yield "#[allow(dead_code, non_snake_case)]"
        yield "#[derive(Clone, Debug)]"
        yield f"{public}struct {name} {{"
        for field, t, told in self.fields(name):
            seen = "pub " * (field in self.given["public"])
            yield f"    {seen}{field}: {self.kind(t)}," + f" // {told}" * bool(told)
        yield "}"
        yield ""
        yield f"impl {name} {{"
        yield "    fn new() -> Self {"
        yield "        Self {"
        for field, t, _ in self.fields(name):
            yield f"            {field}: {self.zero(t)},"
        yield from ("        }", "    }", "}")

    def known_table(self, name: str, kind: Type, values: Any) -> Lines:
        yield "#[rustfmt::skip]"
        yield from self.wrapped("const" + self.table(name, kind, values).removeprefix("let") + ";")
