"""An algorithm as text of a language: what the languages have in common."""

from __future__ import annotations

import ast
import itertools
import re
import textwrap
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, ClassVar

from .source import COMPARED, LANES, OPERATORS, Given, PatternArgument, Source, Type, arguments

CHOICE, OR, AND, COMPARE, SUM, PRODUCT, UNARY, ATOM = range(8)
"""How closely an expression binds, from the least."""
LEVELS = {"*": PRODUCT, "/": PRODUCT, "//": PRODUCT, "%": PRODUCT, "+": SUM, "-": SUM}
WIDTH = 110

Lines = Iterator[str]


class Printer(ABC):
    """The printer of a language, of one source; ``given``: what a name in capitals, or a routine
    that the file has, is called there."""

    close, end, otherwise = "}", ";", "} else {"
    gap = "\n\n"
    spaced = True
    """Do spaces stand about * and /?"""
    counter = ""
    """What stands before the index of a loop as C has it."""
    words: ClassVar[Mapping[str, str]] = {}
    logic: ClassVar[Mapping[str, str]] = {"and": "&&", "or": "||", "not": "!"}
    builtin: ClassVar[Mapping[str, str]] = {}
    lanes = ""
    """The head of a loop over the eight stages."""
    lane_given: ClassVar[Sequence[str]] = ()

    def __init__(self, source: Source, given: Given):
        self.source = source
        self.given = given
        self.routine = ""
        self.types: dict[str, Type] = {}
        self.arguments: dict[str, Type] = {}
        self.lane_locals: set[str] = set()  # lanes that are known in one loop alone
        self.hoisted: dict[str, str] = {}
        """Local table, or array → its name before the routine, where a language has it there."""
        self.before: list[str] = []
        self.of_lanes = self.in_lanes = False  # is the routine, or the statement, one for each?

    # -- routines and statements -------------------------------------------------------------------
    def text(self, roots: Sequence[str]) -> str:
        """The routines that some of them need."""
        return self.gap.join("\n".join(self.function(f)) for f in self.source.written(roots)) + "\n"

    def function(self, f: ast.FunctionDef) -> Lines:
        """One routine: what it is for, its head, its body."""
        body = self.body(f)
        yield from self.before
        yield from self.documented(f)
        yield from self.head(f, Type.of(f.returns) if f.returns else None)
        yield from body
        yield from self.closed(0)

    def body(self, f: ast.FunctionDef) -> list[str]:
        """The lines of a routine after its head; what stands before that is in ``before``."""
        self.hoisted, self.before = {}, []
        self.routine, self.arguments = f.name, arguments(f)
        self.types, self.lane_locals = dict(self.arguments), set()
        returns = Type.of(f.returns) if f.returns else None
        self.of_lanes = self.in_lanes = returns is not None and returns.is_lanes
        body = [*self.block(f.body[1:], 1)]
        read = "\n".join(body)
        unread = [x for x in self.arguments if not re.search(rf"\b{x}\b", read)]
        return [*filter(None, map(self.unread, unread)), *body]

    def documented(self, f: ast.FunctionDef) -> Lines:
        """What stands before a routine."""
        return self.comment(self.with_numbers(ast.get_docstring(f) or ""))

    def with_numbers(self, text: str) -> str:
        """A comment, with the names in capitals as the language has them."""
        text = " ".join(text.split())
        return re.sub(r"\b[A-Z][A-Z_]{2,}\b", lambda x: self.bare(ast.Name(x[0])), text)

    @abstractmethod
    def head(self, f: ast.FunctionDef, returns: Type | None) -> Lines:
        """The lines that begin a routine."""

    def fields(self, name: str) -> Iterator[tuple[str, Type, str]]:
        """The fields of a record, each with its type and what is told of it."""
        self.types, self.arguments = {}, {}
        for x in self.source.records[name].body:
            if isinstance(x, ast.AnnAssign):
                told = self.with_numbers(" ".join(self.source.comments.get(x, ())))
                yield ast.unparse(x.target), Type.of(x.annotation), told

    def doc_of(self, name: str) -> str:
        """What is said of a record."""
        return self.with_numbers(ast.get_docstring(self.source.records[name]) or "")

    @abstractmethod
    def record(self, name: str, more: str = "") -> Lines:
        """The type of a record, or what makes one; ``more``: fields that no algorithm reads."""

    def tables(self, *only: str) -> Lines:
        """The tables of numbers, known in the whole file, or some of them."""
        self.types, self.arguments, self.hoisted = {}, {}, {}
        for name, kind in self.source.tables.items():
            if only and name not in only:
                continue
            values = self.given[self.source.values[name]]
            yield from self.known_table(self.name(name), kind, values)

    @abstractmethod
    def known_table(self, name: str, kind: Type, values: Any) -> Lines:
        """A table that is known in the whole file."""

    def with_defaults(
        self, f: ast.FunctionDef, name: Callable[[str], str], sign: str = " = "
    ) -> list[str]:
        """The arguments of a routine by their names, with the values that some have."""
        plain = [None] * (len(f.args.args) - len(f.args.defaults))
        return [
            name(a.arg) + (sign + self.bare(value) if value else "")
            for a, value in zip(f.args.args, [*plain, *f.args.defaults], strict=True)
        ]

    def unread(self, name: str) -> str:
        """What keeps a compiler quiet about an argument that is not read."""
        return ""

    def block(self, body: Sequence[ast.stmt], depth: int) -> Lines:
        """The lines of some statements."""
        for lanes, run in itertools.groupby(body, self.is_for_lanes):
            loop = self.lanes if lanes and not self.of_lanes else ""
            if loop:
                yield "    " * depth + loop
            self.in_lanes = lanes or self.of_lanes
            for x in run:
                yield from self.commented(x, depth + bool(loop))
            self.in_lanes = self.of_lanes
            if loop:
                yield from self.closed(depth)

    def commented(self, x: ast.stmt, depth: int) -> Lines:
        """The lines of a statement, after its comments."""
        for comment in self.source.comments.get(x, ()):
            yield "    " * depth + self.remark(self.with_numbers(comment))
        for line in self.statement(x, depth):
            yield from self.wrapped(line)

    def is_for_lanes(self, x: ast.stmt) -> bool:
        """Is what a statement finds one for each lane?"""
        match x:
            case ast.AnnAssign():
                return x.value is not None and Type.of(x.annotation).is_lanes
            case ast.Assign(targets=[left]) | ast.AugAssign(target=left):
                return self.has_lanes(left)
        return False

    def has_lanes(self, x: ast.expr) -> bool:
        """Is an expression one number for each lane?"""
        return (t := self.type_of(x)) is not None and t.is_lanes

    def type_of(self, x: ast.expr) -> Type | None:
        """The type of an expression, where that is stated."""
        return self.source.type_of(x, self.types)

    def closed(self, depth: int) -> Lines:
        """The end of a block."""
        if self.close:
            yield "    " * depth + self.close

    def statement(self, x: ast.stmt, depth: int) -> Lines:
        """The lines of a statement."""
        pad = "    " * depth
        match x:
            case ast.If() | ast.While():
                yield pad + self.branch(type(x).__name__.lower(), self.bare(x.test))
                yield from self.block(x.body, depth + 1)
                if x.orelse:
                    yield pad + self.otherwise
                    yield from self.block(x.orelse, depth + 1)
                yield from self.closed(depth)
            case ast.For(
                target=ast.Name(id=i), iter=ast.Call(func=ast.Name(id=order), args=limits)
            ):
                self.types[i] = Type("index")
                yield pad + self.loop(i, order, limits)
                yield from self.block(x.body, depth + 1)
                yield from self.closed(depth)
            case ast.AnnAssign(target=ast.Name(id=name)):
                if text := self.local(name, Type.of(x.annotation), x.value):
                    yield pad + text + self.end
            case ast.Assign(targets=[ast.Subscript(value=left, slice=ast.Slice())]):
                yield pad + self.copied(left, x.value) + self.end
            case ast.Assign(targets=[left]):
                yield pad + f"{self.target(left)} = {self.widened(x.value)}{self.end}"
            case ast.AugAssign():
                op = OPERATORS[type(x.op)]
                yield pad + f"{self.target(x.target)} {op}= {self.bare(x.value)}{self.end}"
            case ast.Return():
                yield pad + f"return {self.bare(x.value) if x.value else ''}".rstrip() + self.end
            case ast.Break() | ast.Continue():
                yield pad + type(x).__name__.lower() + self.end
            case ast.Expr(ast.Call(ast.Name("written"), [ast.Constant(part)])):
                for line in self.given["written"][part]:
                    yield pad + line.replace("\n", "\n" + pad[4:])
            case ast.Expr():
                if text := self.bare(x.value):
                    yield pad + text + self.end
            case _:
                raise ValueError(f"no statement of a routine: {ast.unparse(x)}")

    def local(self, name: str, kind: Type, value: ast.expr | None) -> str:
        """A local number, array, record or table."""
        self.types[name] = kind
        if self.in_lanes and value is not None:
            self.lane_locals.add(name)
            return self.declared(name, Type("lane", (), kind.written), self.widened(value))
        if kind.name == "table":
            assert isinstance(value, ast.Name)
            self.types[name] = kind.of_entries
            return self.table(name, kind.of_entries, self.given[value.id], 1)
        return self.declared(name, kind, self.bare(value) if value is not None else None)

    def sizes(self, kind: Type) -> list[str]:
        """The sizes of an array, as the language says them."""
        return [self.bare(ast.parse(n, mode="eval").body) for n in kind.sizes] + self.lane_sizes(
            kind
        )

    def lane_sizes(self, kind: Type) -> list[str]:
        """What lanes add to the sizes of an array."""
        return ["8"] * (kind.name in LANES)

    # -- expressions -------------------------------------------------------------------------------
    def bare(self, x: ast.expr) -> str:
        """The text of an expression that stands alone."""
        return self.expression(x)[0]

    def at(self, x: ast.expr, level: int) -> str:
        """The same, in parentheses where it binds less closely."""
        text, binds = self.expression(x)
        return text if binds >= level else f"({text})"

    def outside(self, x: ast.expr) -> str:
        """The text of an expression that is no number of each lane."""
        before, self.in_lanes = self.in_lanes, False
        text = self.bare(x)
        self.in_lanes = before
        return text

    def expression(self, x: ast.expr) -> tuple[str, int]:
        """The text of an expression, and how closely it binds."""
        match x:
            case ast.Name() | ast.Attribute() | ast.Subscript() if self.in_lanes and self.has_lanes(
                x
            ):
                return self.lane(x), ATOM
            case ast.Subscript() if self.has_lanes(x.value):
                return self.lane_entry(x), ATOM
            case ast.BinOp():
                return self.operation(x)
            case ast.Compare(ops=[op], comparators=[right]):
                sign = COMPARED[type(op)]
                return (
                    f"{self.at(x.left, SUM)} {self.words.get(sign, sign)} {self.at(right, SUM)}",
                    COMPARE,
                )
            case ast.BoolOp():
                word = type(x.op).__name__.lower()
                level = AND if word == "and" else OR
                inner = COMPARE  # parentheses about and within or, for compilers that ask for them
                return f" {self.logic[word]} ".join(self.at(y, inner) for y in x.values), level
            case ast.UnaryOp(op=ast.USub()):
                return "-" + self.at(x.operand, UNARY), UNARY
            case ast.UnaryOp():
                return self.logic["not"] + self.at(x.operand, UNARY), UNARY
            case ast.IfExp():
                return self.chosen(
                    self.at(x.test, OR), self.at(x.body, OR), self.bare(x.orelse)
                ), CHOICE
            case ast.Subscript():
                return f"{self.at(x.value, ATOM)}[{self.place(x.slice)}]", ATOM
            case ast.Attribute():
                return f"{self.bare(x.value)}{self.member(x.value)}{x.attr}", ATOM
            case ast.Call(func=ast.Name(id=name)):
                return self.called(name, x.args), ATOM
            case ast.Constant(value=value):
                return self.constant(value), UNARY if str(value).startswith("-") else ATOM
            case ast.Name(id=name) if name in self.types:
                return self.name(name), ATOM
            case ast.Name(id=name):
                return self.words.get(name) or str(self.given.get(name, self.name(name))), ATOM
        raise ValueError(f"no expression of a routine: {ast.unparse(x)}")

    def operation(self, x: ast.BinOp) -> tuple[str, int]:
        """A sum, a product, a quotient."""
        op = OPERATORS[type(x.op)]
        level = LEVELS[op]
        left, right = self.at(x.left, level), self.at(x.right, level + 1)
        if op == "//":
            return self.quotient(left, right), level
        gap = " " if self.spaced or level == SUM or op == "%" else ""
        return f"{left}{gap}{op}{gap}{right}", level

    def constant(self, value: Any) -> str:
        """A number or a truth value; whole numbers without a point in what is not ``spaced``, as
        they stand among others that are none."""
        whole = isinstance(value, float) and abs(value) < 1e15 and value == int(value)
        if whole and not self.spaced:
            return str(int(value))
        return self.words.get(str(value)) or repr(value).replace("e-0", "e-")

    def called(self, name: str, given: Sequence[ast.expr]) -> str:
        """A call; nothing where a language has nothing of it."""
        if name in self.builtin:
            pattern = self.builtin[name]
            return pattern.format(*(PatternArgument(self.bare(y), self.at(y, ATOM)) for y in given))
        if name not in self.source.routines:
            return f"{name}({', '.join(map(self.outside, given))})"  # one that is handed over
        f = self.source.routines[name]
        handed = [self.passed(y, t) for y, t in zip(given, arguments(f).values(), strict=True)]
        for_lane = f.returns is not None and Type.of(f.returns).is_lanes
        last = ["s"] * (for_lane and bool(self.lane_given))
        return f"{self.given.get(name) or self.name(name)}({', '.join([*handed, *last])})"

    def passed(self, x: ast.expr, kind: Type) -> str:
        """An argument of a call."""
        return self.outside(x)

    def lane(self, x: ast.expr) -> str:
        """What lane s of an expression is."""
        if isinstance(x, ast.Name) and x.id in self.lane_locals:
            return x.id
        return f"{self.outside(x)}[{self.place(ast.Name('s'))}]"

    def lane_entry(self, x: ast.Subscript) -> str:
        """A number of one lane."""
        return f"{self.outside(x.value)}[{self.place(x.slice)}]"

    def widened(self, x: ast.expr) -> str:
        """The text of what a lane becomes."""
        return self.bare(x)

    def target(self, x: ast.expr) -> str:
        """The text of what is written to."""
        return self.bare(x)

    def quotient(self, a: str, b: str) -> str:
        """That of natural numbers."""
        return f"{a} / {b}"

    def name(self, x: str) -> str:
        """A name as the language has it."""
        return x

    def place(self, x: ast.expr) -> str:
        """An index."""
        return self.bare(x)

    def member(self, _: ast.expr) -> str:
        """What stands between a record and its field."""
        return "."

    def chosen(self, test: str, yes: str, no: str) -> str:
        """One of two values."""
        return f"{test} ? {yes} : {no}"

    def branch(self, word: str, test: str) -> str:
        """The head of a condition, or of a loop with one."""
        return f"{word} ({test}) {{"

    def loop(self, i: str, order: str, limits: Sequence[ast.expr]) -> str:
        """The head of a loop over a range, or back over one."""
        back = order == "reversed"
        texts = [
            *map(self.bare, limits[0].args if back and isinstance(limits[0], ast.Call) else limits)
        ]
        first, last, *by = texts if len(texts) > 1 else ("0", *texts)
        return self.loop_over(i, first, last, by[0] if by else "1", back)

    def loop_over(self, i: str, first: str, last: str, by: str, back: bool) -> str:
        """The same, of texts."""
        if back:
            begin = str(int(last) - 1) if last.isdigit() else f"{last} - 1"
            return f"for ({self.counter} {i} = {begin}; {i} >= {first}; --{i}) {{"
        step = f"++{i}" if by == "1" else f"{i} += {by}"
        return f"for ({self.counter} {i} = {first}; {i} < {last}; {step}) {{"

    @abstractmethod
    def declared(self, name: str, kind: Type, value: str | None) -> str:
        """A local with its type."""

    @abstractmethod
    def table(self, name: str, kind: Type, values: Any, depth: int = 0) -> str:
        """A local table of numbers that are known."""

    def hoist(self, name: str, value: str) -> str:
        """Have a local before the routine."""
        self.hoisted[name] = f"{self.routine}_{name}"
        self.before += self.wrapped(f"const {self.hoisted[name]} = {value}{self.end}")
        return ""

    @abstractmethod
    def copied(self, to: ast.expr, of: ast.expr) -> str:
        """An array becomes another one."""

    # -- comments and long lines -------------------------------------------------------------------
    def comment(self, text: str) -> Lines:
        """What a routine is for."""
        lines = self.paragraph(text)
        for line in lines:
            begin = "/* " if line is lines[0] else " * "
            yield begin + line + " */" * (line is lines[-1])

    def paragraph(self, text: str) -> list[str]:
        """A text in lines."""
        return textwrap.wrap(text, WIDTH - 10)

    def remark(self, text: str) -> str:
        """What a statement is for."""
        return f"// {text}"

    def wrapped(self, line: str) -> Lines:
        """A line in as many as it takes."""
        for x in line.split("\n"):
            pad = " " * (len(x) - len(x.lstrip()) + 4)
            while len(x) > WIDTH and (at := self.broken_at(x)):
                yield x[:at].rstrip()
                x = pad + x[at:].lstrip()
            yield x

    def broken_at(self, line: str) -> int:
        """Where a line that is too long goes on in the next one: after a comma or before an
        operator, if it has such; 0 where it cannot."""
        indent = len(line) - len(line.lstrip())
        places = [x.start() for x in BREAKS.finditer(line, indent + 8, WIDTH)]
        return places[-1] if places else max(line.rfind(" ", indent + 8, WIDTH), 0)


BREAKS = re.compile(r"(?<=,) | (?=[-+*/?:] |&& |\|\| |and |or |if |else )")
"""The spaces where a line is broken."""
