"""Emitted code with loops, read into terms.

To the terms of straight-line code come, of expressions, ("item", array, i), ("field", row, name),
("call", name, …), ("cond", test, a, b), ("real", a), ("mod" | "and" | "or" | "ne" | "ge", a, b);
of statements, ("declare", kind, name, a), ("array", name, sizes, number or ``None``), ("table",
name, rows), ("assign", sign, targets, a), ("if", test, body, otherwise), ("loop", declarations,
name, bound, steps, body), ("do", call).  A kind is "int", "size_t", "real", the inner sizes of an
array, or ``None`` where the language does not say it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..code_expressions import INTEGER
from ..code_reader import Reader
from ..terms import CodeError, Expression, Statement

Kind = Any
WHOLE = ("int", "size_t")
COMPARED = {"<": "lt", "<=": "le", ">": "gt", ">=": "ge", "==": "eq", "!=": "ne"}
COMPARED |= {"===": "eq", "!==": "ne"}
PRODUCTS = {"*": "mul", "/": "div", "%": "mod"}
ASSIGNED = ("=", "+=", "-=", "*=")


@dataclass
class Routine:
    """A function: its arguments with their kinds, what it returns, its statements, what it
    calls."""

    name: str
    arguments: list[tuple[str, Kind]]
    returns: Kind
    body: tuple[Statement, ...]
    calls: set[str]


class LoopReader(Reader):
    """The reader of one file; ``routines``: its functions by name, ``tables``: its lists of
    numbers."""

    products = PRODUCTS
    by_columns = False
    """Has a matrix its columns one after the other?"""

    def __init__(self, *given: Any):
        super().__init__(*given)
        self.types: dict[str, tuple[int, ...]] = {}
        self.kinds: dict[str, Kind] = {}
        self.routines: dict[str, Routine] = {}
        self.tables: list[Statement] = []
        self.calls: set[str] = set()
        self.straight = False  # is the function read without loops?

    def spelt(self, name: str) -> str:
        """The name in this file of a function of the contract."""
        return self._heads(name)[0].partition(" (")[0].split()[-1]

    # -- the file ----------------------------------------------------------------------------

    def _leave(self, read: set[str]) -> None:
        """Pass a word that is not read, or a table or function of the file's own."""
        start, kinds = self.at, dict(self.kinds)
        try:
            if not self._table_or_function():
                super()._leave(read)
        except CodeError:
            self.at, self.kinds = start, kinds
            super()._leave(read)

    def _table_or_function(self) -> bool:
        """Read a table of numbers, or a function, where one stands here."""
        if self.tokens[self.at].column != 0:
            return False
        self.name = " "
        if self.took("const"):
            self.at -= 1
            self._declaration(self.tables)
            return True
        if not self.took("fn", "function"):
            return False
        self.writes = []
        self._routine(self.naming(), self._parameters(), None)
        return True

    def function(self, name: str) -> None:
        """The statements of a function of the contract."""
        spelt, plain = self.spelt(name), {"t": "real", "n": "size_t"}
        self.straight = name == "constants" and self.language != "c"
        if self.straight:
            super().function(name)
            f, self.straight = self.functions[name], False
            arrays: list[tuple[str, Kind]] = [(x, ()) for x in f.arguments]
            self.routines[spelt] = Routine(spelt, arrays, None, f.body, set())
            return
        self.functions[name] = None  # type: ignore[assignment]
        arguments = [(x, plain.get(x, ())) for x in self.arguments]
        returns = "int" if name == "constants" else None if self.writes else "real"
        self._routine(spelt, arguments, returns)

    def _parameters(self) -> list[tuple[str, Kind]]:
        """The names and kinds of what a function takes."""
        self.take("(")
        found = []
        while not self.took(")"):
            found.append(self._parameter())
            if not self.took(",") and self.word != ")":
                self.unknown()
        return found

    def _parameter(self) -> tuple[str, Kind]:
        name = self.naming()
        if self.language != "rust":
            return name, None
        self.take(":")
        pointer = self.took("& mut", "&")
        kind = self._type()
        return name, kind[1:] if pointer else kind

    def _routine(self, name: str, arguments: list[tuple[str, Kind]], returns: Kind) -> None:
        if name in self.routines:
            self.unknown(f"{name} is defined twice")
        outer = dict(self.kinds)
        self.kinds |= dict(arguments)
        self.arguments, self.calls = [x for x, _ in arguments], set()
        self.names = {*self.arguments}
        self._opened()
        body = self._block()
        self.kinds = outer
        self.routines[name] = Routine(name, arguments, returns, body, self.calls)

    def _opened(self) -> None:
        """Pass what begins the statements of a function."""
        self.take("{")

    # -- declarations ------------------------------------------------------------------------

    def _type(self) -> Kind:
        """The kind that a type stands for: of a number, or the sizes of an array."""
        if self.took("real"):
            return "real"
        if self.took("usize", "bool"):
            return "int"
        self.take("[")
        inner = self._type()
        self.take(";")
        size = self.integer() if INTEGER.fullmatch(self.word) else ("int", self.next())
        self.take("]")
        return (size[1], *(() if inner == "real" else inner))

    def _declaration(self, body: list[Statement]) -> None:
        """A name with its value, or an array of zeros."""
        whole, kind = self.word == "const", None
        self.take(self.word)
        varies = (self.language == "rust" and self.took("mut")) or not whole
        name = self.naming()
        if name in self.kinds:
            self.unknown(f"{name} is declared twice")
        if self.language == "rust":
            self.take(":")
            kind = self._type()
        elif varies:
            kind = "real"
        self.take("=")
        if self.language == "rust" and isinstance(kind, tuple) and not whole:
            if self._zeros() != kind:
                self.unknown("an array of other sizes")
            body.append(("array", name, kind, 0))
        elif self.language == "javascript" and self.word in ("new", "Array"):
            kind = self._zeros()  # that of a module has other numbers when it is used again
            body.append(("array", name, kind, None if body is self.tables else 0))
        elif self.took("["):
            rows = self._numbers()
            kind = (len(rows),)
            body.append(("table", name, rows))
        else:
            value = self.expression()
            if value[0] == "list":
                self.unknown("a table of steps")
            body.append(("declare", kind, name, value))
        self.kinds[name] = kind
        self.take(";")

    def _numbers(self) -> list[tuple[Kind, Expression]]:
        """The entries of a table, which has one index: others are those of steps."""
        found = self.listed("]")
        if any(x[0] == "list" for x in found):
            self.unknown("a table of rows")
        return [("real", x) for x in found]

    def _zeros(self) -> tuple[int, ...]:
        """The sizes of an array that is made of zeros."""
        if self.took("new real ("):
            size = self.integer()[1]
            self.take(")")
            return (size,)
        if self.took("Array . from ( { length :"):
            size = self.integer()[1]
            self.take("} , ( ) =>")
            inner = self._zeros()
            self.take(")")
            return (size, *inner)
        self.take("[")
        inner = () if self.took("0.0") else self._zeros()
        self.take(";")
        size = self.integer()[1]
        self.take("]")
        return (size, *inner)

    # -- statements --------------------------------------------------------------------------

    def _block(self) -> tuple[Statement, ...]:
        """Statements, and the bracket after them, where their names end."""
        outer, body = dict(self.kinds), list[Statement]()
        while not self.took("}"):
            self._do(body)
        self.kinds = outer
        return tuple(body)

    def _do(self, body: list[Statement]) -> None:
        if self.took(*self.syntax.ignored) or self._refuses():
            return
        if self.took("if"):
            body.append(self._branch())
        elif self.took("for"):
            body.append(self._repeat())
        elif self.language == "javascript" and self.word == "return":
            self._return(body)
        elif self.took("return"):
            body.append(("return", self.expression()))
            self.take(";")
        elif self._declares:
            self._declaration(body)
        else:
            self._assignment(body)

    def _refuses(self) -> bool:
        """Pass an error check of JavaScript, where one stands here."""
        start = self.at
        try:
            return self.language == "javascript" and self.word == "if" and self._check()
        except CodeError:
            self.at = start
            return False

    @property
    def _declares(self) -> bool:
        return self.word in ("let", "const")

    def _tested(self) -> Expression:
        """A condition, and the bracket after it."""
        if self.language != "rust":
            self.take("(")
        test = self.expression()
        self.take("{" if self.language == "rust" else ") {")
        return test

    def _branch(self) -> Statement:
        test, then = self._tested(), self._block()
        otherwise: tuple[Statement, ...] = ()
        if self.took("else if"):
            otherwise = (self._branch(),)
        elif self.took("else {"):
            otherwise = self._block()
        return ("if", test, then, otherwise)

    def _repeat(self) -> Statement:
        """What follows ``for``; the name that is tested must grow."""
        outer = dict(self.kinds)
        if self.language == "rust":
            first, name, bound, steps = self._range()
        else:
            self.take("(")
            first = self._counters()
            name = self.word
            if self._kind_of(("var", name)) not in WHOLE:
                self.unknown()
            self.at += 1
            self.take("<")
            bound = self._sum()
            self.take(";")
            steps = [self._step()]
            while self.took(","):
                steps.append(self._step())
            self.take(")")
        self.take("{")
        body = self._block()
        self.kinds = outer
        return ("loop", tuple(first), name, bound, tuple(steps), body)

    def _range(self) -> tuple[list[Statement], str, Expression, list[tuple[str, Expression]]]:
        """``i in a..b``, or ``i in (a..b).step_by(n)``."""
        name = self.naming()
        self.take("in")
        stepped = self.took("(")
        start = self._sum()
        self.take("..")
        bound, step = self._sum(), ("int", 1)
        if stepped:
            self.take(") . step_by (")
            step = self.integer()
            self.take(")")
        self.kinds[name] = "int"
        return [("declare", "int", name, start)], name, bound, [(name, step)]

    def _counters(self) -> list[Statement]:
        """``let i = 0;`` of a loop."""
        self.take("let")
        name = self.naming()
        self.take("=")
        found = [("declare", "int", name, self.expression())]
        self.kinds[name] = "int"
        self.take(";")
        return found

    def _step(self) -> tuple[str, Expression]:
        """What is added to a whole number at the end of each turn."""
        if self.took("++"):
            name, added = self.naming(), ("int", 1)
        else:
            name = self.naming()
            self.take("+=")
            added = self.expression()
        if self._kind_of(("var", name)) not in WHOLE:
            self.unknown()
        return name, added

    def _assignment(self, body: list[Statement]) -> None:
        """A call, or what is assigned to a number, or to several the same; Rust's last expression,
        which is returned."""
        targets = [self.expression()]
        if self.language == "rust" and self.word == "}":
            body.append(("return", targets[0]))
            return
        if targets[0][0] == "call":
            self.end()
            body.append(("do", targets[0]))
            return
        sign, value = self._assigned_to(targets[0]), self.expression()
        while sign == "=" and self.word == "=":
            targets.append(value)
            self._assigned_to(value)
            value = self.expression()
        body.append(("assign", sign, tuple(targets), value))
        self.end()

    def _assigned_to(self, target: Expression) -> str:
        """The sign after what is assigned to, an entry of an array or a number that varies."""
        varies = target[0] == "item" or self._kind_of(target) == "real"
        if self.word not in ASSIGNED or not varies:
            self.unknown()
        return self.next()

    # -- expressions -------------------------------------------------------------------------

    def expression(self) -> Expression:
        """A choice of two, or less."""
        if self.language == "rust" and self.took("if"):
            test = self.expression()
            self.take("{")
            one = self.expression()
            self.take("} else {")
            other = self.expression()
            self.take("}")
            return ("cond", test, one, other)
        test = self._chain({"||": "or"}, lambda: self._chain({"&&": "and"}, self._comparison))
        if self.language == "rust" or not self.took("?"):
            return test
        one = self.expression()
        self.take(":")
        return ("cond", test, one, self.expression())

    def _comparison(self) -> Expression:
        left = self._sum()
        return (COMPARED[self.next()], left, self._sum()) if self.word in COMPARED else left

    def _exact(self, op: str, a: Expression, b: Expression) -> None:
        """``CodeError`` for a difference of sizes: one less than 0 is large."""
        if op == "sub" and "size_t" in (self._kind_of(a), self._kind_of(b)):
            self.unknown("a difference of sizes")

    def _kind_of(self, e: Expression) -> Kind:
        """The kind of a name; a size, where one is in an expression."""
        if e[0] == "var":
            return self.kinds.get(e[1])
        parts = (x for x in e[1:] if isinstance(x, tuple))
        whole = e[0] in ("neg", "add", "sub", "mul", "mod") and any(
            self._kind_of(x) == "size_t" for x in parts
        )
        return "size_t" if whole else None

    def _signed(self) -> Expression:
        if self.language != "c" and self.took("!"):
            return ("not", self._signed())
        if self.language == "c" and self.took("( real )"):
            return ("real", self._signed())
        if self.language == "rust" and self.took("& mut", "&"):
            return self._atom()
        found = super()._signed()
        return ("real", found) if self.language == "rust" and self.took("as real") else found

    def _literal(self) -> Expression:
        return ("int", int(self.next())) if INTEGER.fullmatch(self.word) else super()._literal()

    def _call(self) -> Expression | None:
        return None if self.word in self.routines else super()._call()

    def _entry(self) -> Expression:
        """A name, or what is in the array or the row that it stands for."""
        if self.straight:
            return super()._entry()
        if self.language != "c" and self.took("true", "false"):
            return ("int", int(self.near(-1) == "true"))
        if self.word in self.sizes:
            return ("int", self.sizes[self.next()])
        name = self.naming()
        if name in self.routines and self.took("("):
            self.calls.add(name)
            return ("call", name, *self.listed(")"))
        if name not in self.kinds:
            self.at -= 1
            self.unknown()
        return self._within(("var", name))

    def _within(self, found: Expression) -> Expression:
        """What is at places in an array, where some stand here."""
        while self.word == "[" or (self.language == "c" and self.word == "."):
            if self.took("."):
                found = ("field", found, self.naming())
            else:
                self.take("[")
                found = ("item", found, self.expression())
                self.take("]")
        return found
