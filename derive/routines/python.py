"""Algorithms in Python with NumPy: loops over entries alone are over whole arrays."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any, ClassVar

from .printer import ATOM, BREAKS, WIDTH, Lines, Printer
from .source import Type, is_matrix


class Python(Printer):
    """A module that needs NumPy alone."""

    close, end, otherwise = "", "", "else:"
    words: ClassVar = {"True": "True", "False": "False", "INFINITY": "math.inf", "NOTHING": "()"}
    logic: ClassVar = {"and": "and", "or": "or", "not": "not "}
    builtin: ClassVar = {
        "abs": "abs({})",
        "real": "float({})",
        "whole": "int({})",
        "sqrt": "math.sqrt({})",
        "sin": "math.sin({})",
        "atan2": "math.atan2({}, {})",
        "power": "{:.} ** ({})",
        "fused": "({2} + {0:.} * {1:.})",
        "in_memory": "",
        "is_held": "not callable(u)",
        "no_inputs": "",
    }
    gap = "\n\n\n"

    def __init__(self, source: Any, given: Any):
        super().__init__(source, given)
        self.rows: dict[str, str] = {}
        """The index of a loop that is over whole arrays → the part of them, "" for all."""
        self.vectors: set[str] = set()
        """Names of such a loop that are one number for each index."""

    # -- heads -------------------------------------------------------------------------------------
    def documented(self, f: ast.FunctionDef) -> Lines:
        """Nothing: what a function is for stands in it."""
        return iter(())

    def head(self, f: ast.FunctionDef, returns: Type | None) -> Lines:
        given = self.with_defaults(f, str, "=")
        yield f"def {self.given.get(f.name, self.name(f.name))}({', '.join(given)}):"
        public = f.name in self.given["public"]
        text = self.with_numbers(ast.get_docstring(f) or "")
        text += "  " + self.given["status"] if public else ""
        yield from self.docstring(text)
        if public:
            yield from self.given["entry"]

    def docstring(self, text: str) -> Lines:
        """What something is for."""
        lines = self.paragraph(text)
        for i, line in enumerate(lines):
            yield "    " + '"""' * (i == 0) + line + '"""' * (line is lines[-1])

    def function(self, f: ast.FunctionDef) -> Lines:
        """A routine; of those that are public without warnings."""
        lines = [*super().function(f)]
        if f.name in self.given["public"]:
            begin = lines.index(self.given["entry"][-1]) + 1
            lines[begin:] = [
                '    with numpy.errstate(all="ignore"):',
                *("    " * bool(x) + x for x in lines[begin:]),
            ]
        yield from lines

    def name(self, x: str) -> str:
        if x in self.hoisted:
            return self.hoisted[x]
        public = x in self.given["public"] or x in self.given["named"]
        private = x not in self.types and not public and not x.isupper()
        return "_" * private + x

    # -- statements --------------------------------------------------------------------------------
    def statement(self, x: ast.stmt, depth: int) -> Lines:
        """A loop over entries alone is over whole arrays."""
        match x:
            case ast.For(
                target=ast.Name(id=i), iter=ast.Call(func=ast.Name(id="range"), args=limits)
            ):
                if len(limits) < 3 and not self.rows and self.is_elementwise(x.body, i):
                    yield from self.over_arrays(x.body, i, limits, depth)
                    return
            case ast.AugAssign(op=ast.Add(), target=ast.Name(id=name)) if self.rows:
                if name not in self.vectors and not self.in_lanes:
                    # in the order of its terms, as it is added in other languages
                    yield "    " * depth + f"{name} += numpy.cumsum({self.bare(x.value)})[-1]"
                    return
                if self.in_lanes:
                    yield "    " * depth + f"{name} += ({self.bare(x.value)}).sum(axis=0)"
                    return
            case ast.Assign(
                targets=[ast.Subscript(value=ast.Attribute() as field, slice=place)]
            ) if self.rows.get(ast.unparse(place)) == "" and {
                ast.unparse(place),
                *self.vectors,
            } & _names(x.value):  # a new array: one that was seen stays
                yield "    " * depth + f"{self.outside(field)} = {self.bare(x.value)}"
                return
            case ast.Assign(targets=[left], value=ast.IfExp() as chosen) if self.rows:
                if found := self.extreme(left, chosen):
                    yield "    " * depth + found
                    return
        yield from super().statement(x, depth)

    def is_elementwise(self, body: Sequence[ast.stmt], i: str) -> bool:
        """Does each statement find one number for each i, or add or compare them all?  What is
        added or compared is not read by another one."""
        found: list[str] = []
        for x in body:
            match x:
                case ast.AnnAssign(value=ast.expr()):
                    pass
                case ast.Assign(targets=[left]) | ast.AugAssign(target=left):
                    own = isinstance(left, ast.Subscript) and i in self.last_two(left)
                    largest = isinstance(x, ast.Assign) and self.is_extreme(left, x.value)
                    added = isinstance(x, ast.AugAssign) and isinstance(x.op, ast.Add)
                    summed = added and isinstance(left, ast.Name)
                    if not (own or summed or largest):
                        return False
                    found += [ast.unparse(left)] * (not own)
                case _:
                    return False
            if not self.is_index_alone(x, i):
                return False
        read = [name for x in body for name in _names(x)]
        return all(read.count(name) <= 1 for name in found)

    def last_two(self, x: ast.Subscript) -> list[str]:
        """The last index of an entry, and that before it."""
        before = [ast.unparse(x.value.slice)] if isinstance(x.value, ast.Subscript) else []
        return [*before, ast.unparse(x.slice)]

    def sliced(self, x: ast.Subscript, whole: str = "") -> str | None:
        """The text of the entries that a loop over whole arrays goes through, if it does;
        ``whole``: the index of all."""
        *before, last = self.last_two(x)
        if last in self.rows:
            part = self.rows[last] or whole
            return self.outside(x.value) + (f"[{part}]" if part else "")
        if before and before[0] in self.rows and isinstance(x.value, ast.Subscript):
            part = self.rows[before[0]] or ":"
            return f"{self.outside(x.value.value)}[{part}, {self.bare(x.slice)}]"
        return None

    def is_index_alone(self, x: ast.stmt, i: str) -> bool:
        """Is i in a statement nothing but the last index of arrays, or that before the last?"""
        entries = [y for y in ast.walk(x) if isinstance(y, ast.Subscript)]
        indices = {id(y.slice) for y in entries}
        named = (y for y in ast.walk(x) if isinstance(y, ast.Name) and y.id == i)
        deep = any(
            isinstance(y, ast.Subscript)
            and isinstance(y.value, ast.Subscript)
            and isinstance(y.value.value, ast.Subscript)
            and ast.unparse(y.value.value.slice) == i
            for y in ast.walk(x)
        )
        # an index that is read from a table, or a diagonal
        looked_up = any(isinstance(z, ast.Subscript) for y in entries for z in ast.walk(y.slice))
        twice = any(self.last_two(y) == [i, i] for y in entries)
        calls = {ast.unparse(y.func) for y in ast.walk(x) if isinstance(y, ast.Call)}
        alone = all(id(y) in indices for y in named) and not (deep or looked_up or twice)
        return alone and calls <= ELEMENTWISE

    def is_extreme(self, left: ast.expr, chosen: ast.expr) -> bool:
        """a if a > left else left, or left if a <= left else a."""
        if not isinstance(chosen, ast.IfExp):
            return False
        said = ast.unparse(left)
        a, test = ast.unparse(chosen.body), ast.unparse(chosen.test)
        b = ast.unparse(chosen.orelse)
        return (b == said and test == f"{a} > {said}") or (a == said and test == f"{b} <= {said}")

    def extreme(self, left: ast.expr, chosen: ast.IfExp) -> str:
        """The largest of what a loop compares, where it does; NaN as the comparison takes it."""
        if isinstance(left, ast.Subscript) and ast.unparse(left.slice) in self.rows:
            return ""
        if not self.is_extreme(left, chosen):
            return ""
        said = self.outside(left)
        first = ast.unparse(chosen.orelse) == ast.unparse(left)
        values = self.bare(chosen.body if first else chosen.orelse)
        return f"{said} = numpy.{'fmax' if first else 'maximum'}.reduce({values}, initial={said})"

    def over_arrays(
        self, body: Sequence[ast.stmt], i: str, limits: Sequence[ast.expr], depth: int
    ) -> Lines:
        """The statements of a loop, each of whole arrays."""
        texts = [*map(self.bare, limits)]
        first, last = texts if len(texts) == 2 else ("0", *texts)
        whole = first == "0" and last == str(self.given["N_STATE"])
        self.rows, self.vectors = {i: "" if whole else f"{first}:{last}"}, set()
        for x in body:
            if isinstance(x, ast.AnnAssign):
                self.vectors.add(ast.unparse(x.target))
            self.in_lanes = self.is_for_lanes(x)
            yield from self.commented(x, depth)
            self.in_lanes = False
        self.rows, self.vectors = {}, set()

    def declared(self, name: str, kind: Type, value: str | None) -> str:
        return f"{name} = {self.made(kind) if value is None else value}"

    def made(self, t: Type) -> str:
        """What a number, an array or a record is before it is computed."""
        if t.name in self.source.records:
            return f"{self.name(t.name) if t.name != 'Motion' else 'Motion'}()"
        sizes = self.sizes(t)
        if not sizes:
            return {"flag": "False", "index": "0", "count": "0", "label": "None"}.get(t.name, "0.0")
        shape = ", ".join(sizes) + "," * (len(sizes) == 1)
        return f"numpy.zeros(({shape}){', int' * (t.name == 'index')})"

    def local(self, name: str, kind: Type, value: ast.expr | None) -> str:
        if kind.name == "table":
            assert isinstance(value, ast.Name)
            self.types[name] = kind.of_entries
            return self.table(name, kind.of_entries, self.given[value.id])
        self.types[name] = kind
        text = self.bare(value) if value is not None else None
        part = name in self.vectors and isinstance(value, ast.Subscript)  # which may be written to
        return self.declared(name, kind, f"{text}.copy()" if part else text)

    def table(self, name: str, kind: Type, values: Any, depth: int = 0) -> str:
        self.hoisted[name] = f"_{self.routine}_{name}".upper()
        values = (
            f"numpy.array({self.rows_of(values)})" if len(kind.sizes) > 1 else self.rows_of(values)
        )
        self.before += [*self.wrapped(f"{self.hoisted[name]} = {values}"), "", ""]
        return ""

    def rows_of(self, values: Any) -> str:
        """Numbers, by rows."""
        if not isinstance(values, (list, tuple)):
            return self.constant(values)
        return f"({', '.join(map(self.rows_of, values))},)"

    def copied(self, to: ast.expr, of: ast.expr) -> str:
        left = self.outside(to)
        if isinstance(to, ast.Attribute):  # a new array: one that was seen stays
            return f"{left} = {self.outside(of)}.copy()"
        return f"{left}[:] = {self.outside(of)}"

    def target(self, x: ast.expr) -> str:
        text = self.sliced(x, ":") if isinstance(x, ast.Subscript) else None
        return super().target(x) if text is None else text

    def loop_over(self, i: str, first: str, last: str, by: str, back: bool) -> str:
        if back:
            return f"for {i} in reversed(range({first}, {last})):"
        limits = [first, last, by] if by != "1" else [first, last] if first != "0" else [last]
        return f"for {i} in range({', '.join(limits)}):"

    def branch(self, word: str, test: str) -> str:
        return f"{word} {test}:"

    # -- expressions -------------------------------------------------------------------------------
    def expression(self, x: ast.expr) -> tuple[str, int]:
        match x:
            case ast.Subscript(value=value, slice=ast.Name(id=i)) if (
                i in self.rows and self.in_lanes
            ):
                if self.has_lanes(x):
                    return self.lane(x), ATOM
                return f"{self.outside(value)}[{self.rows[i] or ':'}, None]", ATOM
            case ast.Subscript() if (text := self.sliced(x)) is not None:
                return text, ATOM
            case ast.IfExp() if self.rows:
                parts = ", ".join(map(self.bare, (x.test, x.body, x.orelse)))
                return f"numpy.where({parts})", ATOM
        return super().expression(x)

    def chosen(self, test: str, yes: str, no: str) -> str:
        return f"{yes} if {test} else {no}"

    def quotient(self, a: str, b: str) -> str:
        return f"{a} // {b}"

    def called(self, name: str, given: Sequence[ast.expr]) -> str:
        last = self.outside(given[-1]) if given else ""
        back = self.given["returned"].get(name)
        if back:
            call = f"{back}{', '.join(map(self.outside, given[:-1]))})"
            flat = is_matrix(self.source.routines[name])
            return f"{last}[:] = {f'{call}.ravel()' if flat else call}"
        if name.endswith("_added"):  # one product of matrices takes less time than many sums
            b, f, to = map(self.outside, given)
            return f"{to} += {b} @ {f}"
        if name in ELEMENTWISE and self.rows and name in self.source.routines:
            return f"{self.name(name)}({', '.join(map(self.bare, given))})"
        return super().called(name, given)

    # -- lanes: arrays, of which all is computed at once -------------------------------------------
    def lane(self, x: ast.expr) -> str:
        match x:
            case ast.Subscript(slice=ast.Name(id=i)) if i in self.rows:
                part = self.rows[i]
                return self.outside(x.value) + (f"[{part}]" if part else "")
        return self.outside(x)

    def lane_entry(self, x: ast.Subscript) -> str:
        each = ", None" if self.of_lanes else ""
        given = isinstance(x.value, ast.Name) and x.value.id in self.arguments
        dots = "..., " if given and self.arguments[self.bare(x.value)].is_lanes else ""
        return f"{self.outside(x.value)}[{dots}{self.bare(x.slice)}{each}]"

    # -- records, tables, lines --------------------------------------------------------------------
    def record(self, name: str, more: str = "") -> Lines:
        """The class of a record; ``more``: fields that no algorithm reads."""
        yield f"class {'_' * (name != 'Motion')}{name}:"
        yield from self.docstring(self.doc_of(name))
        yield ""
        yield "    def __init__(self):"
        for field, t, told in self.fields(name):
            yield f"        self.{field} = {self.made(t)}" + f"  # {told}" * bool(told)
        yield from more.splitlines()

    def known_table(self, name: str, kind: Type, values: Any) -> Lines:
        return self.wrapped(f"{name} = numpy.array({self.rows_of(values)})")

    def remark(self, text: str) -> str:
        return f"# {text}"

    def broken_at(self, line: str) -> int:
        """The last place within brackets where a line may go on in the next one; 0 for none."""
        depth, found = 0, 0
        places = {x.start() for x in BREAKS.finditer(line, 0, WIDTH)}
        for at, letter in enumerate(line[:WIDTH]):
            depth += (letter in "([{") - (letter in ")]}")
            if at in places and depth > 0 and line[:at].strip():
                found = at
        return found


ELEMENTWISE = {"abs", "combination", "summed", "fused", "is_held"}
"""What may be called on arrays."""


def _names(x: ast.AST) -> set[str]:
    """The names of an expression or a statement."""
    return {y.id for y in ast.walk(x) if isinstance(y, ast.Name)}
