"""Emitted C with loops, read: each function as one in a prime field.

What C has as ``double`` is an integer modulo p here; what it has as ``int``, on which alone places
and conditions may depend, is the integer.  So a function that is read is one rational function of
what it is given.  An array is a map of its places: what is outside it, or was not written before,
has no value.  The statements become those of a Python function, whose text has numbers, names with
a ``v_`` before them, and nothing else of the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from ...check.values.evaluate import ELEMENTARY
from ..degree_bounds import Measured
from ..read_c import SIGNATURES, CReader
from ..terms import CodeError

Kind = Any
"""The type of a value: "int", "size_t", "real"; ("to", kind) a pointer, or an array as C hands it
over; ("of", size, kind) an array in an array; ("row", {name: kind}) a structure."""
WHOLE = ("int", "size_t")
COMPARED = ("<", "<=", ">", ">=", "==", "!=")
LOOPS, SPACE = 64, "    "
"""The most loops in each other; one step of indentation."""


class Shifted:
    """A pointer into an array, to read from."""

    def __init__(self, array: Any, place: int):
        self.array, self.place = array, place

    def __getitem__(self, i: int) -> Any:
        return self.array[self.place + i]


def remainder(a: int, b: int) -> int:
    """a % b in C, of numbers that are not negative."""
    if a < 0 or b <= 0:
        raise CodeError("a remainder of a negative number")
    return a % b


class LoopReader(CReader):
    """The reader of one file; ``literal``: the residue of a decimal, ``elementary``: of a function
    at one, ``p``: the modulus."""

    def __init__(
        self,
        c: Any,
        prefix: str,
        p: int,
        literal: Callable[[str], int],
        elementary: Callable[[str, int], Any],
    ):
        super().__init__(c, prefix)
        self.p, self.literal = p, literal
        self.types: dict[str, Any] = {}
        self.kinds: dict[str, Kind] = {}
        self.returned: dict[str, tuple[Kind, list[Kind]]] = {}
        self.arrays: list[tuple[dict[int, Any], int]] = []
        self.space: dict[str, Any] = {
            "__builtins__": {},
            "Shifted": Shifted,
            "remainder": remainder,
            "inverse": self._inverse,
            "elementary": lambda name, x: elementary(name, Measured.of(x).value % p),
            "new": self._new,
        }
        self.largest = 0  # the largest degree of a number that was given out
        self.lines: list[str] = []
        self.depth, self.tested = 0, set[str]()
        self.name = ""

    def _inverse(self, x: Any) -> Measured:
        if not Measured.of(x).value % self.p:
            raise CodeError("a division by zero")
        return Measured.of(x).inverse(self.p)

    def _new(self, *sizes: int) -> dict[int, Any]:
        """An array of these sizes, without values."""
        if len(sizes) > 1:
            return {i: self._new(*sizes[1:]) for i in range(sizes[0])}
        found: dict[int, Any] = {}
        self.arrays.append((found, sizes[0]))
        return found

    def call(self, name: str, *arguments: Any) -> Any:
        """What a function returns; ``CodeError`` where it has no value, or writes outside of an
        array."""
        try:
            value = self.space[f"v_{self.prefix}_{name}"](*arguments)
        except (LookupError, NameError, TypeError, AttributeError) as error:
            raise CodeError(f"{name}: no value: {error}") from None
        arrays, self.arrays = self.arrays, []
        if any(not 0 <= i < size for array, size in arrays for i in array):
            raise CodeError(f"{name}: it writes outside of an array")
        return value

    def numbers(self, values: Sequence[Any]) -> list[int]:
        """What a function gave, without the degrees, which are noted."""
        found = [Measured.of(x) for x in values]
        self.largest = max([self.largest, *(x.degree for x in found)])
        return [x.value % self.p for x in found]

    def written(self, array: Mapping[int, Any], size: int, name: str) -> list[int]:
        """The numbers of an array that a function has written."""
        if set(array) != set(range(size)):
            raise CodeError(f"{name} is not written, or not all of it and nothing else")
        return self.numbers([array[i] for i in range(size)])

    @contextmanager
    def replaced(self, name: str, caller: str, f: Callable[..., Any]) -> Iterator[None]:
        """Another function in the place of one, if ``caller`` calls it."""
        key = f"v_{self.prefix}_{name}"
        own = self.space[key]
        if key in self.space[f"v_{self.prefix}_{caller}"].__code__.co_names:
            self.space[key] = f
        try:
            yield
        finally:
            self.space[key] = own

    # -- the file ----------------------------------------------------------------------------

    def _of_integrals(self, node: Any) -> bool:
        """Is a definition a type of arrays, which is noted?"""
        if isinstance(node, self.c.Typedef) and isinstance(node.type, self.c.ArrayDecl):
            self.types[node.name] = node.type
            return True
        return False

    def _declaration(self, node: Any) -> None:
        c = self.c
        if isinstance(node.type, c.ArrayDecl) and node.storage == ["static"]:
            self._begin()
            self._table(node)
            self._run()
        else:
            super()._declaration(node)

    def _function(self, node: Any) -> None:
        name = node.decl.name
        own = name.removeprefix(f"{self.prefix}_")
        if own in SIGNATURES:
            self._arguments(node.decl)
        if f"v_{name}" in self.space or own in ("", name):
            raise CodeError(f"the function {name} stands twice, or has another prefix")
        kept = dict(self.kinds)
        params = node.decl.type.args.params
        for x in params:
            self.kinds[x.name] = self._kind(x.type)
        kind = self._kind(node.decl.type.type)
        self._begin(f"def {self._v(name)}({', '.join(self._v(x.name) for x in params)}):")
        self.depth, self.name = 1, own
        self._block(node.body)
        self._say("pass")
        self._run()
        self.returned[name] = kind, [self.kinds[x.name] for x in params]
        self.kinds = kept
        self.functions[own] = None  # type: ignore[assignment]

    def _begin(self, *lines: str) -> None:
        self.lines, self.depth = [*lines], 0

    def _run(self) -> None:
        text = "\n".join(self.lines)
        try:
            exec(compile(text, "<emitted C>", "exec"), self.space)
        except (SyntaxError, RecursionError, MemoryError, LookupError, TypeError) as error:
            raise CodeError(f"not read: {error}") from None

    def _say(self, line: str) -> None:
        self.lines.append(SPACE * self.depth + line)

    def _v(self, name: str) -> str:
        if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII):
            raise CodeError(f"the name {name[:40]!r} is not read")
        return f"v_{name}"

    # -- types and declarations --------------------------------------------------------------

    def _kind(self, node: Any) -> Kind:
        """The kind of a variable."""
        kind = self._declared(node)
        return _handed_over(kind)

    def _declared(self, node: Any) -> Kind:
        c = self.c
        if isinstance(node, c.PtrDecl):
            return ("to", self._declared(node.type))
        if isinstance(node, c.ArrayDecl):
            size = "" if node.dim is None else self._read(node.dim)[1]
            return ("of", size, self._declared(node.type))
        if isinstance(node, c.TypeDecl) and isinstance(node.type, c.Struct):
            return ("row", {x.name: self._kind(x.type) for x in node.type.decls})
        names: Any = getattr(getattr(node, "type", None), "names", ())
        if len(names) == 1 and names[0] in self.types:
            return self._declared(self.types[names[0]])
        return self._type(node)

    def _dimensions(self, node: Any) -> list[str]:
        c = self.c
        if isinstance(node, c.ArrayDecl):
            if node.dim is None:
                raise self._unknown(node)
            kind, text = self._read(node.dim)
            if kind != "int":
                raise self._unknown(node)
            return [text, *self._dimensions(node.type)]
        names: Any = getattr(getattr(node, "type", None), "names", ())
        if len(names) == 1 and names[0] in self.types:
            return self._dimensions(self.types[names[0]])
        return []

    def _declare(self, node: Any, *, loop: bool = False) -> None:
        """A variable: a whole number that is kept, or of a loop; a number, an array, a pointer."""
        c, kind = self.c, self._kind(node.type)
        if node.name in self.sizes or node.name in self.kinds:
            raise CodeError(f"{node.name} is declared twice")
        if isinstance(node.init, c.InitList):
            self._table(node)
        elif node.init is None:
            sizes = self._dimensions(node.type)
            if not sizes:
                raise self._unknown(node)
            self._say(f"{self._v(node.name)} = new({', '.join(sizes)})")
        else:
            if kind in WHOLE and not loop and "const" not in node.type.quals:
                raise self._unknown(node)
            self._say(f"{self._v(node.name)} = {self._as(kind, node.init)}")
        self.kinds[node.name] = kind

    def _table(self, node: Any) -> None:
        """An array of numbers, or of rows of them, in a list."""
        c, kind = self.c, self._kind(node.type)
        if "const" not in (*node.quals, *node.storage) or kind[0] != "to":
            raise self._unknown(node)
        if not isinstance(node.init, c.InitList):
            raise self._unknown(node)
        rows = [self._entry(kind[1], x) for x in node.init.exprs]
        if node.type.dim is not None and self._read(node.type.dim)[1] != str(len(rows)):
            raise CodeError(f"{node.name} has {len(rows)} entries")
        entries = ", ".join(f"{i}: {x}" for i, x in enumerate(rows))
        self._say(f"{self._v(node.name)} = {{{entries}}}")
        self.kinds[node.name] = kind

    def _entry(self, kind: Kind, node: Any) -> str:
        if kind[0] != "row":
            return self._as(kind, node)
        fields = kind[1]
        if not isinstance(node, self.c.InitList) or len(node.exprs) != len(fields):
            raise self._unknown(node)
        pairs = zip(fields.items(), node.exprs, strict=True)
        return "{" + ", ".join(f"{name!r}: {self._as(k, x)}" for (name, k), x in pairs) + "}"

    # -- statements --------------------------------------------------------------------------

    def _block(self, node: Any) -> None:
        if not isinstance(node, self.c.Compound):
            raise self._unknown(node)
        for x in node.block_items or ():
            self._do(x)

    def _do(self, node: Any) -> None:
        c = self.c
        if isinstance(node, c.Decl):
            self._declare(node)
        elif isinstance(node, c.Assignment):
            self._assign(node)
        elif isinstance(node, c.If):
            self._branch(node)
        elif isinstance(node, c.For):
            self._repeat(node)
        elif isinstance(node, c.Return) and node.expr is not None:
            self._say(f"return {self._read(node.expr)[1]}")
        elif isinstance(node, c.FuncCall):
            self._say(self._read(node)[1])
        elif not self._unused(node):
            raise self._unknown(node)

    def _assign(self, node: Any) -> str:
        """An assignment to a number; its left side, for one in another."""
        value = node.rvalue
        kind, left = self._read(node.lvalue)
        if kind != "real" or node.op not in ("=", "+=", "-=", "*="):
            raise self._unknown(node)
        if isinstance(value, self.c.Assignment):
            right = self._assign(value)
        else:
            right = self._as("real", value)
        before = f"{left} {node.op[0]} " if node.op != "=" else ""
        self._say(f"{left} = ({before}{right}) % {self.p}")
        return left

    def _branch(self, node: Any) -> None:
        kind, test = self._read(node.cond)
        if kind != "int":
            raise self._unknown(node)
        self._say(f"if {test}:")
        self._inside(node.iftrue)
        if isinstance(node.iffalse, self.c.If):
            self._say("else:")
            self.depth += 1
            self._branch(node.iffalse)
            self.depth -= 1
        elif node.iffalse is not None:
            self._say("else:")
            self._inside(node.iffalse)

    def _inside(self, node: Any) -> None:
        """A block of its own; its names end with it."""
        kept = dict(self.kinds)
        self.depth += 1
        if self.depth > LOOPS:
            raise self._unknown(node)
        self._say("pass")
        self._block(node)
        self.depth -= 1
        self.kinds = kept

    def _repeat(self, node: Any) -> None:
        """``for (int i = …; i < bound; ++i, …)``: i grows, so that it ends."""
        c, kept = self.c, dict(self.kinds)
        if not isinstance(node.init, c.DeclList) or not isinstance(node.cond, c.BinaryOp):
            raise self._unknown(node)
        for x in node.init.decls:
            self._declare(x, loop=True)
        test, nexts = node.cond, [node.next]
        if isinstance(node.next, c.ExprList):
            nexts = node.next.exprs
        if test.op != "<" or not isinstance(test.left, c.ID):
            raise self._unknown(node)
        i = test.left.name
        if i in self.tested or not any(self._grows(x, i) for x in nexts):
            raise self._unknown(node)
        (first, left), (second, right) = self._read(test.left), self._read(test.right)
        if first not in WHOLE or second not in WHOLE:
            raise self._unknown(node)
        self._say(f"while {left} < {right}:")
        before, self.tested = self.tested, self.tested | {i}
        self._inside(node.stmt)
        self.tested = before
        self.depth += 1
        for x in nexts:
            self._next(x, i)
        self.depth -= 1
        self.kinds = kept

    def _grows(self, node: Any, i: str) -> bool:
        c = self.c
        if isinstance(node, c.UnaryOp):
            return node.op in ("++", "p++") and getattr(node.expr, "name", "") == i
        steps = isinstance(node, c.Assignment) and node.op == "+="
        return (
            steps
            and getattr(node.lvalue, "name", "") == i
            and isinstance(node.rvalue, c.Constant)
            and self._integer(node.rvalue)[1] > 0
        )

    def _next(self, node: Any, i: str) -> None:
        """What is done at the end of each turn; a name that a loop tests only grows."""
        c = self.c
        target = node.expr if isinstance(node, c.UnaryOp) else getattr(node, "lvalue", None)
        if not isinstance(target, c.ID) or self.kinds.get(target.name) not in WHOLE:
            raise self._unknown(node)
        name = target.name
        if self._grows(node, name):
            by = "1" if isinstance(node, c.UnaryOp) else str(self._integer(node.rvalue)[1])
        elif isinstance(node, c.Assignment) and node.op == "+=" and name not in {*self.tested, i}:
            by = self._as("int", node.rvalue)
        else:
            raise self._unknown(node)
        self._say(f"{self._v(name)} += {by}")

    # -- expressions -------------------------------------------------------------------------

    def _as(self, kind: Kind, node: Any) -> str:
        """The text of an expression that is to be of a kind."""
        found, text = self._read(node)
        if found == kind or (found in WHOLE and kind in (*WHOLE, "real")):
            return text
        raise self._unknown(node)

    def _read(self, node: Any) -> tuple[Kind, str]:
        """The kind of an expression, and its text."""
        c = self.c
        if isinstance(node, c.Constant):
            if node.type == "int":
                return "int", str(self._integer(node)[1])
            return "real", str(self.literal(self._decimal(node)[1]))
        if isinstance(node, c.ID):
            if node.name in self.sizes:
                return "int", str(self.sizes[node.name])
            if node.name in self.kinds:
                return self.kinds[node.name], self._v(node.name)
        elif isinstance(node, c.ArrayRef):
            kind, array = self._read(node.name)
            place, i = self._read(node.subscript)
            if kind[0] == "to" and place in WHOLE:
                return _handed_over(kind[1]), f"{array}[{i}]"
        elif isinstance(node, c.StructRef) and node.type == ".":
            kind, row = self._read(node.name)
            if kind[0] == "row" and node.field.name in kind[1]:
                return kind[1][node.field.name], f"{row}[{node.field.name!r}]"
        elif isinstance(node, c.Cast):
            return self._type(node.to_type.type), self._as("real", node.expr)
        elif isinstance(node, c.UnaryOp) and node.op in "-!":
            kind, x = self._read(node.expr)
            if kind == "int" or (kind == "real" and node.op == "-"):
                return kind, f"(-{x})" if node.op == "-" else f"(not {x})"
        elif isinstance(node, c.BinaryOp):
            return self._operation(node)
        elif isinstance(node, c.TernaryOp):
            (one, a), (other, b) = self._read(node.iftrue), self._read(node.iffalse)
            if one == other or {one, other} == {"int", "real"}:
                kind = "real" if "real" in (one, other) else one
                return kind, f"({a} if {self._as('int', node.cond)} else {b})"
        elif isinstance(node, c.FuncCall) and isinstance(node.name, c.ID):
            return self._called(node)
        raise self._unknown(node)

    def _operation(self, node: Any) -> tuple[Kind, str]:
        (one, a), (other, b), op = self._read(node.left), self._read(node.right), node.op
        if one in WHOLE and other in WHOLE:
            size = "size_t" in (one, other)
            if op in ("&&", "||") and not size:
                return "int", f"({a} {'and' if op == '&&' else 'or'} {b})"
            if op in COMPARED:
                return "int", f"({a} {op} {b})"
            if op in "+*" or (op == "-" and not size):  # one less than 0 is large as a size
                return "size_t" if size else "int", f"({a} {op} {b})"
            if op == "%" and not size:
                return "int", f"remainder({a}, {b})"
        elif {one, other} <= {"real", *WHOLE}:
            if op in "+-*":
                return "real", f"({a} {op} {b})"
            if op == "/":
                return "real", f"({a} * inverse({b}))"
            if op == "==" and self.name == "constants":
                return "int", f"(({a} - {b}) % {self.p} == 0)"
        elif one[0] == "to" and other in WHOLE and op == "+":
            return one, f"Shifted({a}, {b})"
        raise self._unknown(node)

    def _called(self, node: Any) -> tuple[Kind, str]:
        name, given = node.name.name, node.args.exprs if node.args else []
        if name in self.returned:
            kind, kinds = self.returned[name]
            if len(kinds) == len(given):
                pairs = zip(kinds, given, strict=True)
                return kind, f"{self._v(name)}({', '.join(self._as(k, x) for k, x in pairs)})"
        plain = name.removesuffix("f") if self.real == "float" else name
        if plain in ELEMENTARY and len(given) == 1:
            return "real", f"elementary({plain!r}, {self._as('real', given[0])})"
        raise self._unknown(node)


def _handed_over(kind: Kind) -> Kind:
    """The kind as which a value is read: an array is a pointer to its first entry."""
    return ("to", kind[2]) if kind[0] == "of" else kind
