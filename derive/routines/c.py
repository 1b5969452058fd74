"""Algorithms in C: every name with the prefix of the file, lanes as vectors of the compiler."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any, ClassVar

from .printer import ATOM, SUM, Lines, Printer
from .source import LANES, Type, arguments, by_rows, is_stub

STEPS = {"Step": "real", "Steps": "count"}
"""Functions that are handed over: the type of their last argument, after a size of steps."""


class C(Printer):
    """C99, and C++ and CUDA alike."""

    spaced = False
    counter = "int"
    words: ClassVar = {"True": "1", "False": "0", "INFINITY": "HUGE_VAL", "OK": "0", "NOTHING": "0"}
    builtin: ClassVar = {
        "sqrt": "sqrt({})",
        "power": "pow({}, {})",
        "no_inputs": "m->inputs = 0, m->data = 0",
    }
    lane_given: ClassVar = ("int s",)

    def __init__(self, source: Any, given: Any):
        super().__init__(source, given)
        self.prefix = given["prefix"]
        self.real = given["real"]
        self.lanes = f"for (int s = 0; s < {self.prefix}_GROUPS; ++s) {{"
        self.defined: set[str] = set()

    # -- names and types ---------------------------------------------------------------------------
    def name(self, x: str) -> str:
        local = x in self.types or not (
            x.isupper() or x in self.source.routines or x in self.source.tables
        )
        return x if local else f"{self.prefix}_{x}"

    def kind(self, t: Type) -> str:
        """The name of a type of entries."""
        lane = f"{self.prefix}_lane"
        plain = dict.fromkeys(("index", "flag", "status", "label", "sign"), "int")
        plain |= {
            "real": self.real,
            "eight": "double",
            "lanes": lane,
            "lane": lane,
            "count": "size_t",
        }
        return plain.get(t.name) or f"{self.prefix}_{t.name.lower()}"

    def lane_sizes(self, kind: Type) -> list[str]:
        return {"lanes": [f"{self.prefix}_GROUPS"], "eight": ["8"]}.get(kind.name, [])

    def is_record(self, t: Type) -> bool:
        """Is it one of the records, or of an array of them?"""
        return t.name in self.source.records

    # -- heads -------------------------------------------------------------------------------------
    def function(self, f: ast.FunctionDef) -> Lines:
        """A routine, after prototypes of those that it calls and that come later."""
        self.defined.add(f.name)
        names = {x.id for x in ast.walk(f) if isinstance(x, ast.Name)}
        for later in self.source.routines.values():
            if later.name in names - self.defined and not is_stub(later):
                self.defined.add(later.name)
                self.types = {}
                yield self.signature(later) + ";"
                yield ""
        yield from super().function(f)

    def signature(self, f: ast.FunctionDef) -> str:
        """The head of a routine."""
        before, self.types = self.types, {}
        returns = Type.of(f.returns) if f.returns else None
        given = [self.argument(*x) for x in arguments(f).items()]
        given += list(self.lane_given) * (returns is not None and returns.is_lanes)
        begin = f"{self.given['inline']} {self.kind(returns) if returns else 'void'}".lstrip()
        self.types = before
        return "\n".join(self.wrapped(f"{begin} {self.name(f.name)}({', '.join(given)})"))

    def heads(self, names: Sequence[str]) -> str:
        """The prototypes of some routines, each with what it is for."""
        each = map(self.source.routines.__getitem__, names)
        parts = ([*self.documented(f), f"{self.signature(f)};"] for f in each)
        return "\n\n".join(map("\n".join, parts))

    def head(self, f: ast.FunctionDef, returns: Type | None) -> Lines:
        yield self.signature(f)
        yield "{"

    def argument(self, name: str, t: Type) -> str:
        """An argument with its type."""
        if t.name in STEPS:
            last = self.kind(Type(STEPS[t.name]))
            real = self.real
            arrays = f"const {real} *, const {real} *"
            return f"int (*{name})({self.prefix}_motion *, {arrays}, {real}, {last})"
        sizes = self.sizes(t)
        alone = f"{self.prefix}_RESTRICT " * (t.name == "lanes" and bool(t.sizes))
        const = "const " * (not t.written and not alone)
        if len(sizes) > 1:  # with const an array of arrays is another type: tables alone are such
            const *= t.name in LANES
            return f"{const}{self.kind(t)} (*{alone}{name}){''.join(f'[{n}]' for n in sizes[1:])}"
        by_place = bool(sizes) or self.is_record(t)
        return f"{const * by_place}{self.kind(t)} {'*' * by_place}{name}"

    def unread(self, name: str) -> str:
        return f"    (void){name};"

    # -- statements --------------------------------------------------------------------------------
    def statement(self, x: ast.stmt, depth: int) -> Lines:
        """The same; behind a ``pragma`` loops whose first index is known when a file is written.

        Those over a part of the state are known when the parts are unrolled.
        """
        match x:
            case ast.For(iter=ast.Call(args=[_] | [ast.Constant(), *_])) if "pragma" in self.given:
                yield self.given["pragma"]
        yield from super().statement(x, depth)

    def declared(self, name: str, kind: Type, value: str | None) -> str:
        const = "const " * (value is not None and not kind.written)
        sizes = "".join(f"[{n}]" for n in self.sizes(kind))
        return f"{const}{self.kind(kind)} {name}{sizes}" + (f" = {value}" if value else "")

    def table(self, name: str, kind: Type, values: Any, depth: int = 0) -> str:
        sizes = "".join(f"[{n}]" for n in self.sizes(kind))
        text = by_rows(values, depth, self.entry_text, "{}")
        return f"static const {self.kind(kind)} {name}{sizes} = {text}"

    def entry_text(self, value: Any) -> str:
        """A number of a table, or what stands for one."""
        return value if isinstance(value, str) else self.constant(value)

    def copied(self, to: ast.expr, of: ast.expr) -> str:
        t = self.type_of(to)
        assert t is not None
        place, begin = self.outside(to), self.outside(of)
        size = f"sizeof {place}"
        if place in self.arguments:
            size = "*".join([*self.sizes(t), f"sizeof {place}[0]"])
        return f"memcpy({place}, {begin}, {size})"

    # -- expressions -------------------------------------------------------------------------------
    def constant(self, value: Any) -> str:
        """A number, of float with its suffix."""
        text = super().constant(value)
        return text + "f" * (self.real == "float" and ("." in text or "e" in text))

    def operation(self, x: ast.BinOp) -> tuple[str, int]:
        if (
            isinstance(x.op, ast.Div)
            and isinstance(x.left, ast.Constant)
            and isinstance(x.right, ast.Constant)
        ):
            raise ValueError(f"of two whole numbers C takes the quotient whole: {ast.unparse(x)}")
        return super().operation(x)

    def called(self, name: str, given: Sequence[ast.expr]) -> str:
        match name:
            case "sqrt" | "sin" | "atan2" | "hypot" if self.real == "float":
                return f"{name}f({', '.join(map(self.bare, given))})"
            case "abs":
                return f"{self.given['fabs']}({self.bare(given[0])})"
            case "real" | "whole":
                kind = self.real if name == "real" else "int"
                return f"({kind})" + self.at(given[0], ATOM)
            case "fused" | "in_memory" | "larger":
                had = {"in_memory": "IN_MEMORY"}.get(name, name)
                return f"{self.prefix}_{had}({', '.join(map(self.bare, given))})"
            case "is_held":
                return "!m->inputs"
        return super().called(name, given)

    def member(self, x: ast.expr) -> str:
        return "->" if self.bare(x) in self.arguments else "."

    def passed(self, x: ast.expr, kind: Type) -> str:
        text, own = self.outside(x), self.type_of(x)
        if self.is_record(kind):
            return text if text in self.arguments else f"&{text}"
        if kind.name != "eight" or kind.written:
            return text
        inner = "".join(f"[{n}]" for n in self.sizes(kind)[1:])
        if inner and text not in (*self.arguments, *map(self.name, self.source.tables)):
            return f"(const double (*){inner}){text}"
        in_lanes = own is not None and own.name == "lanes" and not inner
        return f"(const double *){text}" if in_lanes else text

    # -- lanes -------------------------------------------------------------------------------------
    def lane(self, x: ast.expr) -> str:
        t = self.type_of(x)
        in_memory = t is not None and t.name == "eight"
        if in_memory:
            return f"{self.prefix}_loaded({self.outside(x)} + s*{self.prefix}_LANES)"
        return super().lane(x)

    def lane_entry(self, x: ast.Subscript, const: str = "const ") -> str:
        t = self.type_of(x.value)
        inner = self.outside(x.value)
        held = f"(({const}double *){inner})" if t and t.name == "lanes" else inner
        return f"{held}[{self.place(x.slice)}]"

    def target(self, x: ast.expr) -> str:
        entry = isinstance(x, ast.Subscript) and not self.in_lanes and self.has_lanes(x.value)
        return (
            self.lane_entry(x, "") if entry and isinstance(x, ast.Subscript) else super().target(x)
        )

    def widened(self, x: ast.expr) -> str:
        if not self.in_lanes or self.has_lanes(x):
            return self.bare(x)
        zero = f"{self.prefix}_zero_lanes()"
        none = isinstance(x, ast.Constant) and not x.value
        return zero if none else f"{self.at(x, SUM)} + {zero}"

    # -- records, tables ---------------------------------------------------------------------------
    def record(self, name: str, more: str = "") -> Lines:
        """The type of a record; ``more``: fields that no algorithm reads."""
        yield from self.comment(self.doc_of(name))
        yield "typedef struct {"
        for field, t, told in self.fields(name):
            yield f"    {self.declared(field, t, None)};" + f" /* {told} */" * bool(told)
        yield from more.splitlines()
        yield f"}} {self.kind(Type(name))};"

    def known_table(self, name: str, kind: Type, values: Any) -> Lines:
        return self.wrapped(self.table(name, kind, values) + ";")

    def remark(self, text: str) -> str:
        return f"/* {text} */"
