"""Algorithms in Julia: loops and indices count from 1; the last of several indices stands first, as
what lies side by side in memory has the same last one there."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from typing import Any, ClassVar

from .printer import ATOM, COMPARE, SUM, WIDTH, Lines, Printer
from .source import COMPARED, LANES, Type, arguments, flat, is_matrix

KEYWORDS = ("begin", "end")
"""Names of the algorithms that are words of Julia."""


class Julia(Printer):
    """A module that needs nothing but Base; ``functions``, of what is given: the functions of the
    file that have its own order of arguments, by their names in the algorithms."""

    close, end, otherwise = "end", "", "else"
    words: ClassVar = {
        "True": "true",
        "False": "false",
        "NOTHING": "()",
        "SIZE_U": "N_INPUTS",
        "SIZE_K": "N_CONSTANTS",
    }
    builtin: ClassVar = {
        "abs": "abs({})",
        "whole": "trunc(Int, {})",
        "sqrt": "sqrt({})",
        "atan2": "atan({}, {})",
        "power": "{:.}^({})",
        "fused": "muladd({}, {}, {})",
        "in_memory": "",
        "is_held": "!(u isa Function)",
        "no_inputs": "",
    }
    lanes = "for s in 1:8"
    lane_given: ClassVar = ("s",)

    def __init__(self, source: Any, given: Any):
        super().__init__(source, given)
        self.real = given["real"]
        self.given = {**given, "INFINITY": "Inf32" if self.real == "Float32" else "Inf"}
        self.counted: set[str] = set()
        """The indices of loops, which count from 1."""

    def name(self, x: str) -> str:
        if x in self.hoisted:
            return self.hoisted[x]
        f = None if x in self.types else self.source.routines.get(x)
        written = f is not None and any(t.written for t in arguments(f).values())
        return self.field(x) + "!" * written

    def field(self, x: str) -> str:
        """A name that is no word of the language."""
        return x + "_" * (x in KEYWORDS)

    # -- types -------------------------------------------------------------------------------------
    def entry_type(self, t: Type) -> str:
        """The type of the entries of an array; where those of any type are taken, that of what a
        routine is given."""
        if t.name not in ("real", *LANES):
            return "Int"
        if self.given.get("generic"):
            numbers = [x for x, of in self.arguments.items() if of.name == "real" and x != "t"]
            of_one = next((x for x in numbers if self.arguments[x].sizes), "")
            of_one = self.given.get("typed", of_one)
            return f"float(eltype({of_one}))" if of_one else f"typeof({' + '.join(numbers)})"
        return str(self.real)

    def kind(self, t: Type) -> str:
        """The type of a field."""
        plain = {"flag": "Bool", "real": str(self.real)}
        sizes = self.sizes(t)
        if t.name in self.source.records:
            return t.name
        return f"Array{{{self.entry_type(t)}, {len(sizes)}}}" if sizes else plain.get(t.name, "Int")

    def made(self, t: Type) -> str:
        """What a number, an array or a record is before it is computed."""
        if t.name in self.source.records:
            return f"{t.name}()"
        if sizes := self.sizes(t):
            return f"zeros({self.entry_type(t)}, {', '.join(reversed(sizes))})"
        return {"flag": "false", "real": self.constant(0.0)}.get(t.name, "0")

    # -- heads -------------------------------------------------------------------------------------
    def comment(self, text: str) -> Lines:
        for line in self.paragraph(text):
            yield f"# {line}"

    def documented(self, f: ast.FunctionDef) -> Lines:
        if f.name not in self.given["public"]:
            yield from super().documented(f)
            return
        text = self.with_numbers(ast.get_docstring(f) or "")
        lines = self.paragraph(f"{text}  {self.given['status']}")
        yield from ('"""', f"    {self.signature(f)}", "", *lines, '"""')

    def signature(self, f: ast.FunctionDef) -> str:
        """The name of a routine and its arguments; inputs by their name in what is public."""
        given = self.with_defaults(f, self.name)
        inputs = ""
        if f.name in self.given["public"]:
            given.remove("u")
            inputs = "; u = nothing"
        given += [*self.lane_given] * self.of_lanes
        return f"{self.given.get(f.name) or self.name(f.name)}({', '.join(given)}{inputs})"

    def head(self, f: ast.FunctionDef, returns: Type | None) -> Lines:
        yield from self.wrapped(f"function {self.signature(f)}")
        if f.name in self.given["public"]:
            yield from self.given["entry"]
            for x, t in self.arguments.items():  # as time is kept in two numbers of this type
                if t == Type("real"):
                    yield f"    {x} = {self.real}({x})"

    def body(self, f: ast.FunctionDef) -> list[str]:
        self.counted = set()
        return super().body(f)

    def function(self, f: ast.FunctionDef) -> Lines:
        *lines, end = super().function(f)
        yield from lines
        if f.returns is None:
            yield "    return nothing"
        yield end

    # -- statements --------------------------------------------------------------------------------
    def statement(self, x: ast.stmt, depth: int) -> Lines:
        match x:
            case ast.Assign(targets=[left], value=value) if (
                t := self.type_of(left)
            ) and t.name == "label":
                yield "    " * depth + f"{self.target(left)} = {self.place(value)}"
            case _:
                yield from super().statement(x, depth)

    def local(self, name: str, kind: Type, value: ast.expr | None) -> str:
        self.counted.discard(name)
        return super().local(name, kind, value)

    def declared(self, name: str, kind: Type, value: str | None) -> str:
        value = self.made(kind) if value is None else value
        return f"{self.name(name)} = {f'({value})' if chr(10) in value else value}"

    def table(self, name: str, kind: Type, values: Any, depth: int = 0) -> str:
        return self.hoist(name, self.entries(values, kind))

    def entries(self, values: Any, kind: Type) -> str:
        """The numbers of a table as an array."""
        sizes = ", ".join(reversed(self.sizes(kind)))
        listed = f"[{', '.join(map(self.constant, flat(values)))}]"
        return f"reshape({listed}, {sizes})" if "," in sizes else listed

    def copied(self, to: ast.expr, of: ast.expr) -> str:
        return f"copyto!({self.outside(to)}, {self.outside(of)})"

    def branch(self, word: str, test: str) -> str:
        # a sum in parentheses, as some readers take its sign for that of another statement
        return f"{word} ({test})" if re.match(r"[\w.]+ [-+]", test) else f"{word} {test}"

    def loop(self, i: str, order: str, limits: Sequence[ast.expr]) -> str:
        if order == "reversed" and isinstance(limits[0], ast.Call):
            limits = limits[0].args
        first, last, *by = limits if len(limits) > 1 else (ast.Constant(0), *limits)
        self.counted.discard(i)
        begin, end = self.place(first), self.bare(last)
        self.counted.add(i)
        if order == "reversed":
            return f"for {i} in {end}:-1:{begin}"
        step = f"{self.bare(by[0])}:" if by else ""
        return f"for {i} in {begin}:{step}{end}"

    # -- expressions -------------------------------------------------------------------------------
    def expression(self, x: ast.expr) -> tuple[str, int]:
        match x:
            case ast.Name(id=i) if i in self.counted:
                return f"{i} - 1", SUM
            case ast.Compare(left=ast.Name(id=i), ops=[op], comparators=[right]) if (
                i in self.counted
            ):
                return f"{i} {COMPARED[type(op)]} {self.place(right)}", COMPARE
            case ast.BinOp(op=ast.Add() | ast.Sub(), right=ast.Constant(value=int())):
                return self.more(x, 0), SUM
            case ast.Subscript() if not (self.in_lanes and self.has_lanes(x)):
                return self.entry(x), ATOM
            case ast.Attribute(value=value, attr=field) if not (
                self.in_lanes and self.has_lanes(x)
            ):
                return f"{self.bare(value)}.{self.field(field)}", ATOM
        return super().expression(x)

    def entry(self, x: ast.expr, *before: str) -> str:
        """An entry of an array, or a part of it; ``before``: its first indices."""
        places = [*before]
        while isinstance(x, ast.Subscript):
            places.append(self.place(x.slice))
            x = x.value
        kind, array = self.type_of(x), self.outside(x)
        assert kind is not None
        if left := len(kind.sizes) + (kind.name in LANES) - len(places):
            return f"view({', '.join([array, *[':'] * left, *places])})"
        return f"{array}[{', '.join(places)}]"

    def lane(self, x: ast.expr) -> str:
        if isinstance(x, ast.Name) and x.id in self.lane_locals:
            return self.name(x.id)
        return self.entry(x, "s")

    def place(self, x: ast.expr) -> str:
        return self.more(x, 1)

    def more(self, x: ast.expr, by: int) -> str:
        """A whole number and so much."""
        match x:
            case ast.Constant(value=int(value)):
                return str(value + by)
            case ast.Name(id=i) if i in self.counted:
                text, by = i, by - 1
            case ast.BinOp(left, (ast.Add() | ast.Sub()) as op, ast.Constant(value=int(value))):
                return self.more(left, by + value if isinstance(op, ast.Add) else by - value)
            case ast.BinOp(left, ast.Add(), right):
                text, by = f"{self.at(left, SUM)} + {self.more(right, by)}", 0
            case _:
                text = self.at(x, SUM)
        return text + (f" + {by}" if by > 0 else f" - {-by}" if by else "")

    def constant(self, value: Any) -> str:
        text = super().constant(value)
        if self.real != "Float32" or not isinstance(value, float):
            return text
        return text.replace("e", "f") if "e" in text else f"{text}f0"

    def quotient(self, a: str, b: str) -> str:
        return f"div({a}, {b})"

    def called(self, name: str, given: Sequence[ast.expr]) -> str:
        if name == "real":
            return f"{self.real}({self.bare(given[0])})"
        texts = [*map(self.outside, given)]
        if name in self.given.get("functions", {}):  # what is written stands first, the time last
            names = [*arguments(self.source.routines[name])]
            of = dict(zip(names, texts, strict=True))
            first, time, inputs = of.pop(names[-1]), of.pop("t", ""), of.pop("u", "")
            if is_matrix(self.source.routines[name]):  # which is written by rows
                (size,) = arguments(self.source.routines[name])[names[-1]].sizes
                rows, columns = size.split(" * ")
                columns = self.bare(ast.parse(columns, mode="eval").body)
                first = f"PermutedDimsArray(reshape({first}, {columns}, {rows}), (2, 1))"
            listed = ", ".join([first, *of.values(), *[time] * bool(time)])
            return (
                f"{self.given['functions'][name]}!({listed}{f'; u = {inputs}' if inputs else ''})"
            )
        if (t := self.types.get(name)) and t.name == "Steps":
            m, k, u, *rest = texts
            return f"{name}({', '.join([m, k, *rest])}; u = {u})"
        return super().called(name, given)

    # -- records, tables, lines --------------------------------------------------------------------
    def record(self, name: str, more: str = "") -> Lines:
        """The type of a record, and what one is before it is computed."""
        yield from self.comment(self.doc_of(name))
        yield f"Base.@kwdef mutable struct {name}"
        for x, t, told in self.fields(name):
            field = self.field(x)
            # inputs that are held may be a function
            kind = "Any" if field == "u" and self.given["INPUTS"] else self.kind(t)
            yield f"    {field}::{kind} = {self.made(t)}" + f" # {told}" * bool(told)
        yield "end"

    def known_table(self, name: str, kind: Type, values: Any) -> Lines:
        return self.wrapped(f"const {name} = {self.entries(values, kind)}")

    def remark(self, text: str) -> str:
        return f"# {text}"

    def wrapped(self, line: str) -> Lines:
        """A line goes on in the next one where it cannot end: within parentheses, as few as can be,
        or else, after a comma, within brackets."""
        for x in line.split("\n"):
            yield from self.broken(x) if len(x) > WIDTH else [x]

    def broken(self, line: str) -> Lines:
        """A line that is too long in several."""
        places = _breaks(line)
        if not places and (m := ASSIGNED.match(line)):
            line = f"{m[0]}({line[m.end() :]})"
            places = _breaks(line)
        pad, start, before = " " * (len(line) - len(line.lstrip()) + 4), 0, ""
        while len(line) - start > (width := WIDTH - len(before)):
            near = [x for x in places if start < x[2] < start + width]
            if not near:
                break
            at = max(near)[2]
            yield before + line[start:at]
            start, before = at + 1, pad
        yield before + line[start:]


ASSIGNED = re.compile(r" *[\w.]+(?:\[[^]]*\])? [-+*/]?= ")
BREAKS = re.compile(r"(?<=,) | (?=[-+*/] |&& |\|\| )")
"""The spaces where a line may be broken."""


def _breaks(line: str) -> list[tuple[bool, int, int]]:
    """Where a line may go on in the next one, before that is that within parentheses, and minus
    within how many."""
    open_, found = [""], []
    places = {x.start() for x in BREAKS.finditer(line)}
    for at, letter in enumerate(line):
        if letter in "([":
            open_.append(letter)
        elif letter in ")]" and open_[1:]:
            open_.pop()
        elif at in places and (open_[-1] == "(" or (open_[-1] and line[at - 1] == ",")):
            found.append((open_[-1] == "(", -len(open_), at))
    return found
