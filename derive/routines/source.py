"""What an algorithm is written in: a small typed part of Python, read as a tree and never run.

A routine is a function with types on its arguments and locals; it has loops over ranges,
conditions, assignments, copies of arrays (``a[:] = b``) and calls; no objects, closures, aliases or
memory.  A routine whose body is ``...`` is one that the file has already.  A class is a record, a
module's annotated name a table of numbers.

What is known when a file is written is written in capitals and is gone before anything is printed:
conditions on it; ``for i in unrolled(N)``, whose body is repeated; ``weighted(ROW, f, s)``, the sum
of the numbers of a row that are not 0, each times ``f[j][s]``.  ``written("part")`` are lines that
the file brings.
"""

from __future__ import annotations

import ast
import copy
import io
import tokenize
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

Given = Mapping[str, Any]
"""Name in capitals → what it is in the file that is written: a number, a table, another name."""


@dataclass(frozen=True)
class Type:
    """``name`` of an entry or a record; ``sizes`` of an array; is it written to?"""

    name: str
    sizes: tuple[str, ...] = ()
    written: bool = False

    @classmethod
    def of(cls, node: ast.expr | None, written: bool = False) -> Type:
        """The type that an annotation says: real, real[n, m], out[…], var[…]."""
        if isinstance(node, ast.Name):
            return cls(node.id, (), written)
        if not isinstance(node, ast.Subscript) or not isinstance(node.value, ast.Name):
            raise ValueError(f"no type: {ast.unparse(node) if node else 'nothing'}")
        if node.value.id in ("out", "var"):
            return cls.of(node.slice, True)
        sizes = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return cls(node.value.id, tuple(map(ast.unparse, sizes)), written)

    @property
    def element(self) -> Type:
        """What an index leaves of it."""
        if not self.sizes and self.name in LANES:
            return Type("real")
        return Type(self.name, self.sizes[1:])

    @property
    def of_entries(self) -> Type:
        """The type of the array that a table is."""
        return Type(self.sizes[0], self.sizes[1:]) if self.name == "table" else self

    @property
    def is_lanes(self) -> bool:
        """Is it one number for each lane?"""
        return self.name in LANES and not self.sizes


INDICES = ("i", "j")
"""The names that count what is unrolled, which are known then."""

LANES = ("lanes", "eight")
"""Eight numbers, one for each stage, or motion: in registers where a language has such, and in
memory."""

OPERATORS = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
}
COMPARED = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}


@dataclass
class Source:
    """Algorithms that go into one file, all that is known of that file put in."""

    routines: dict[str, ast.FunctionDef] = field(default_factory=dict)
    records: dict[str, ast.ClassDef] = field(default_factory=dict)
    tables: dict[str, Type] = field(default_factory=dict)
    values: dict[str, str] = field(default_factory=dict)
    """Table → the name of its numbers, among what is given."""
    comments: dict[ast.stmt, list[str]] = field(default_factory=dict)
    """Statement → the lines of comments before it."""

    def read(self, text: str, given: Given) -> None:
        """Add what a text says."""
        tree = ast.parse(text)
        alone, after = _comments(text)
        for node in ast.walk(tree):
            if isinstance(node, ast.stmt) and (found := _before(node, alone, after)):
                self.comments[node] = found
        for node in _Known(given, self.comments).body(tree.body):
            match node:
                case ast.FunctionDef(name=name):
                    if not is_stub(node):
                        self.routines.pop(name, None)  # where one stood that the file was to have
                    self.routines.setdefault(name, node)
                case ast.ClassDef():
                    self.records[node.name] = node
                case ast.AnnAssign(target=ast.Name(id=name), value=ast.Name(id=numbers)):
                    self.tables[name] = Type.of(node.annotation).of_entries
                    self.values[name] = numbers

    def leave(self, *names: str) -> None:
        """Leave routines to the file, which has them otherwise."""
        for name in {*names} & {*self.routines}:
            self.routines[name].body = [ast.Expr(ast.Constant(...))]

    def fields(self, record: str) -> dict[str, Type]:
        """The fields of a record with their types."""
        if record not in self.records:
            return {}
        stated = (x for x in self.records[record].body if isinstance(x, ast.AnnAssign))
        return {ast.unparse(x.target): Type.of(x.annotation) for x in stated}

    def type_of(self, x: ast.expr, types: Mapping[str, Type]) -> Type | None:
        """The type of an expression, where that is stated; ``types``: of the names of a routine."""
        match x:
            case ast.Name(id=name):
                return types.get(name) or self.tables.get(name)
            case ast.Attribute(value=value, attr=field) if t := self.type_of(value, types):
                return self.fields(t.name).get(field)
            case ast.Subscript(value=value) if t := self.type_of(value, types):
                return t if isinstance(x.slice, ast.Slice) else t.element
            case ast.BinOp(left=left, right=right):
                found = (self.type_of(y, types) for y in (left, right))
                return next((t for t in found if t and t.is_lanes), None)
            case ast.Call(func=ast.Name(id="fused")):
                return Type("lanes")
            case ast.Call(func=ast.Name(id=name)) if f := self.routines.get(name):
                return Type.of(f.returns) if f.returns else None
        return None

    def written(self, roots: Sequence[str]) -> Iterator[ast.FunctionDef]:
        """The routines that some of them need, in the order of the sources; not those that the file
        has."""
        needed, open_ = set[str](), [x for x in roots if x in self.routines]
        while open_:
            name = open_.pop()
            needed.add(name)
            names = {x.id for x in ast.walk(self.routines[name]) if isinstance(x, ast.Name)}
            open_ += [x for x in names & {*self.routines} - needed if x not in open_]
        return (f for name, f in self.routines.items() if name in needed and not is_stub(f))


def is_stub(f: ast.FunctionDef) -> bool:
    """Is it a routine that the file has already?"""
    return ast.unparse(f.body[-1]) == "..."


def is_matrix(f: ast.FunctionDef) -> bool:
    """Is what a routine of the file writes, the last of its arguments, a matrix by rows?"""
    return " * " in ast.unparse(f.args.args[-1])


def arguments(f: ast.FunctionDef) -> dict[str, Type]:
    """The types of the arguments of a routine."""
    return {a.arg: Type.of(a.annotation) for a in f.args.args}


def _comments(text: str) -> tuple[dict[int, str], dict[int, str]]:
    """Line → the comment that it is, and line → the comment that ends it."""
    alone, after = dict[int, str](), dict[int, str]()
    for x in tokenize.generate_tokens(io.StringIO(text).readline):
        if x.type == tokenize.COMMENT:
            found = alone if x.line.lstrip().startswith("#") else after
            found[x.start[0]] = x.string.lstrip("# ")
    return alone, after


def _before(node: ast.stmt, alone: Mapping[int, str], after: Mapping[int, str]) -> list[str]:
    """The comments on the lines before a statement, and on its first."""
    line, found = node.lineno - 1, list[str]()
    while line in alone:
        found.insert(0, alone[line])
        line -= 1
    return found + ([after[node.lineno]] if node.lineno in after else [])


STRIDES = ("DOWN", "DOWN_PARAMETERS", "ALONG")
"""How far the next row of a matrix is in memory, and the next column: one of them is 1."""


class _Known(ast.NodeTransformer):
    """Puts what is known when a file is written into a tree."""

    def __init__(self, given: Given, comments: dict[ast.stmt, list[str]]):
        self.given = {x: value for x, value in given.items() if x[0].isupper() or x in INDICES}
        self.comments = comments

    def body(self, statements: Sequence[ast.stmt]) -> list[ast.stmt]:
        """Statements without conditions on what is known."""
        return [y for x in statements for y in self._known(x)]

    def _known(self, x: ast.stmt) -> list[ast.stmt]:
        match x:
            case ast.If(test=test) if self._is_known(test):
                return self.body(x.body if self._value(test) else x.orelse)
            case ast.For(
                target=ast.Name(id=i),
                iter=ast.Call(func=ast.Name(id="unrolled"), args=[count]),
            ):
                return [
                    y
                    for number in range(self._value(count))
                    for y in _Known({**self.given, i: number}, self.comments).body(x.body)
                ]
        made = self._copied(x)
        if x in self.comments:
            self.comments[made] = self.comments[x]
        return [made]

    def _copied(self, x: ast.stmt) -> ast.stmt:
        """A statement with what is known in its expressions and blocks."""
        fields: dict[str, Any] = {}
        for name, value in ast.iter_fields(x):
            if name in ("body", "orelse"):
                fields[name] = self.body(value)
            elif isinstance(value, list):
                fields[name] = [self._expression(y) for y in value]
            else:
                fields[name] = self._expression(value)
        made = type(x)(**fields)
        return ast.copy_location(made, x)

    def _expression(self, x: Any) -> Any:
        if not isinstance(x, ast.AST):
            return x
        # what is unrolled is read once more, for the next turn
        return self.visit(copy.deepcopy(x) if {*INDICES} & {*self.given} else x)

    def visit_Name(self, x: ast.Name) -> ast.expr:
        """A number that is known; other names stay, as the language says them."""
        value = self.given.get(x.id)
        return ast.Constant(value) if type(value) in (int, float, bool) else x

    def visit_Subscript(self, x: ast.Subscript) -> ast.expr:
        """An entry of a table that is known."""
        if self._is_known(x):
            return ast.Constant(self._value(x))
        self.generic_visit(x)
        return x

    def visit_BinOp(self, x: ast.BinOp) -> ast.expr:
        """The sum of whole numbers that are known; a place times a stride that is 1."""
        match x:
            case ast.BinOp(left, ast.Mult(), ast.Name(id)) if id in STRIDES:
                if self.given.get(id) == 1:
                    return self.visit(left)  # type: ignore[no-any-return]
        self.generic_visit(x)
        match x:
            case ast.BinOp(ast.Constant(value=int(a)), ast.Add(), ast.Constant(value=int(b))):
                return ast.Constant(a + b)
        return x

    def visit_Call(self, x: ast.Call) -> ast.expr:
        """A sum of multiples of what rows of an array have."""
        if not isinstance(x.func, ast.Name) or x.func.id != "weighted":
            self.generic_visit(x)
            return x
        row, array, index = x.args
        entry = f"{ast.unparse(array)}[{{}}][{ast.unparse(index)}]"
        terms = [
            ast.parse(
                f"{number!r} * {entry.format(j)}" if number != 1 else entry.format(j), mode="eval"
            )
            for j, number in enumerate(self._value(row))
            if number
        ]
        found: ast.expr = terms[0].body
        for term in terms[1:]:
            found = ast.BinOp(found, ast.Add(), term.body)
        return found

    def _is_known(self, x: ast.expr) -> bool:
        names = [y.id for y in ast.walk(x) if isinstance(y, ast.Name)]
        plain = (ast.Name, ast.Subscript, ast.Constant, ast.UnaryOp, ast.BoolOp, ast.Compare)
        return bool(names) and isinstance(x, plain) and all(y in self.given for y in names)

    def _value(self, x: ast.expr) -> Any:
        """The value of an expression in what is known."""
        match x:
            case ast.Constant(value=value):
                return value
            case ast.Name(id=name) if name in self.given:
                return self.given[name]
            case ast.Subscript():
                return self._value(x.value)[self._value(x.slice)]
            case ast.UnaryOp(op=ast.Not()):
                return not self._value(x.operand)
            case ast.BoolOp(op=ast.And()):
                return all(map(self._value, x.values))
            case ast.BoolOp(op=ast.Or()):
                return any(map(self._value, x.values))
        raise ValueError(f"not known when a file is written: {ast.unparse(x)}")


def flat(values: Any) -> list[float]:
    """All numbers of rows."""
    if not isinstance(values, (list, tuple)):
        return [values]
    return [x for row in values for x in flat(row)]


def by_rows(values: Any, depth: int, number: Callable[[Any], str], ends: str = "[]") -> str:
    """The text of numbers, by rows, each on lines of its own, between two brackets."""
    if not isinstance(values, (list, tuple)):
        return number(values)
    inner = [by_rows(x, depth + 1, number, ends) for x in values]
    if not any(isinstance(x, (list, tuple)) for x in values):
        return ends[0] + ", ".join(inner) + ends[1]
    pad = "\n" + "    " * (depth + 1)
    return ends[0] + pad + ("," + pad).join(inner) + ends[1]


class PatternArgument:
    """An argument of a pattern: {} between commas or parentheses, {:.} within an expression."""

    def __init__(self, bare: str, atom: str):
        self.bare, self.atom = bare, atom

    def __format__(self, spec: str) -> str:
        return self.atom if spec else self.bare
