"""Emitted code of any language read into terms; nothing of the text is ever run.

Read are the functions of the contract, lists of names, sizes, defaults and the basis.  What is not
known in these is an error; what stands beside them, as the steps in time, is ``unread``, to be
compared with what is emitted.
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

from .code_expressions import CLOSE, NAME, OPEN, ExpressionReader
from .syntax import CONTRACT, END, Token
from .terms import CodeError, CodeFunction, Expression, Module, Statement, apply_operation

LISTS = ("STATE", "PARAMETERS", "INPUTS", "CONSTANTS", "CONSERVED", "OUTPUTS", "STATE_BY_BLOCK")
DATA = (*LISTS, "BASIS", "DEFAULTS")
SIZES = (*LISTS, "ALGEBRA", "REDUCED", "MATRIX", "EVENTS")
DEFINING = ("def", "class", "as", "import", "function", "const")
REPEATING = ("velocity", "momentum_rhs")
"""Beside ``velocity_step`` these repeat it, in a loop, and are not read."""
MADE = (
    "new real ( size )",
    "Vector { promote_type ( eltype ( p ) , Float64 ) } ( undef , N_CONSTANTS )",
    "Vector { promote_type ( eltype ( p ) , Float32 ) } ( undef , N_CONSTANTS )",
)
"""Arrays whose numbers are still to be written."""
LETTERS = {"xp", "t", "x", "k", "u", *(x for y in CONTRACT.values() for z in y for x in z.split())}
NO_NUMBERS = ("NAN", "f64 :: NAN", "f32 :: NAN", "Float64 ( NaN )", "Float32 ( NaN )")
"""What stands in a table of defaults for a parameter that has none."""
FAILING = ("throw new RangeError ( … )", "throw ( … )", "return Err ( … )")
PURE = re.compile(
    "if|end|throw|new|return|Err|Refused|NotFinite|Singular|RangeError|DomainError|"
    "DimensionMismatch|length|Array|prototype|every|some|call|Number|is_?[fF]inite|all|any|iter|"
    "chain|entry|margins?"
)
"""The words of error checks, beside the names of the function: none changes a number."""
CHANGING = ("=", "+=", "-=", "*=", "/=", "++", "--", "??=")


def by_name(parameters: Any, defaults: tuple[Any, ...]) -> dict[str, Any]:
    """Those of a table that has one for each parameter; ``CodeError`` where it has not."""
    if len(defaults) != len(parameters) or not all(
        isinstance(x, Fraction | None) for x in defaults
    ):
        raise CodeError("the defaults are not a number, or none, for each parameter")
    pairs = zip(parameters, defaults, strict=True)
    return {name: x for name, x in pairs if x is not None}


class Reader(ExpressionReader):
    """The reader of one file."""

    def __init__(self, *given: Any):
        super().__init__(*given)
        self.values: dict[str, Any] = {}
        self.functions: dict[str, CodeFunction] = {}
        self.unread: list[Token] = []
        self.writes = [""]  # the arrays that the function writes

    # -- the file ----------------------------------------------------------------------------

    def module(self) -> Module:
        """The functions and lists of a file; ``CodeError`` for a name defined twice."""
        present = {x.text.strip("_!") for x in self.tokens}
        left = REPEATING if "velocity_step" in present else ()
        read = {self._heads(f)[0].split()[1]: f for f in CONTRACT if f not in left}
        while self.word:
            if not self._data() and not self._contract_function(read):
                self._leave({*read, *DATA, "abs"})
        return self._module()

    def _heads(self, f: str) -> list[str]:
        return self.syntax.heads(f, self.prefix, *(x.split() for x in CONTRACT[f]))

    def _leave(self, read: set[str]) -> None:
        """Pass a word that is not read; ``CodeError`` where it gives a name that is read another
        meaning."""
        token = self.tokens[self.at]
        # what ends with a word, as in Julia, has its own names where it is indented
        own = token.column is None or (token.column > 0 and bool(self.syntax.body[1]))
        set_here = self.near(1) == "=" and not own
        if token.text in read and self.syntax.lines and (self.near(-1) in DEFINING or set_here):
            self.unknown(f"{token.text} is defined twice")
        self.unread.append(token)
        self.at += 1

    def _data(self) -> bool:
        """Read a list of names or numbers, or a size, where one stands here."""
        token, start = self.tokens[self.at], self.at
        named = token.text in DATA or token.text.startswith("N_")
        first = self.tokens[max(start - (self.near(-1) == "const"), 0)]
        # N_u_56 of a function is a number of its own
        if not named or (first.column != 0 and self.near(-2) not in ("export", "pub")):
            return False
        self.at += 1
        while self.near(1 - (self.at - start)) == ":" and self.word not in ("=", ""):
            self.at += 1  # a type
        if not self.took("="):
            self.at = start
            return False
        if token.text in self.values:
            self.unknown(f"{token.text} is defined twice", start)
        self.name = ""
        self.values[token.text] = found = self.value()
        if token.text not in DATA and not isinstance(found, Fraction):
            self.unknown(f"{token.text} is no size", start)
        return True

    def value(self) -> Any:
        """Names and numbers in tuples, lists, dictionaries."""
        if self.took("Object . freeze (", "numpy . array ("):
            found = self.value()
            self.at = self.closed(self.at)
            self.take(")")
            return found
        if self.word.startswith('"'):
            return self.next().strip('"')
        if self.took(*NO_NUMBERS):
            return None
        if NAME.fullmatch(self.word) and self.near(1) == ":":
            return self.next()
        if self.word not in OPEN:
            return self._number(self.expression())
        opened, items, keys = self.next(), list[Any](), list[Any]()
        closed = CLOSE[OPEN.index(opened)]
        while not self.took(closed):
            items.append(self.value())
            if self.took(":"):
                keys.append(items.pop())
                items.append(self.value())
            if not self.took(",") and self.word != closed:
                self.unknown()
        if opened == "{" and self.language != "c":
            if len(keys) != len(items) or not all(isinstance(x, Fraction) for x in items):
                self.unknown("no numbers by their names")
            return dict(zip(keys, items, strict=True))
        return tuple(items)

    def _number(self, e: Expression) -> Fraction:
        if e[0] == "int" or e[0] == "lit":
            return Fraction(e[1])
        if e[0] not in ("neg", "div"):
            self.unknown()
        return Fraction(apply_operation(e[0], [self._number(x) for x in e[1:]]))

    def _module(self) -> Module:
        stated = {x.removeprefix("N_"): int(n) for x, n in self.values.items() if x not in DATA}
        lists = {x: found for x in LISTS if isinstance(found := self.values.get(x), tuple)}
        for name in LISTS[:3]:
            if not all(isinstance(x, str) for x in lists.setdefault(name, (0,))):
                raise CodeError(f"{name} is no tuple of names")
        counted = {x: len(found) for x, found in lists.items()}
        for x, n in stated.items():
            if counted.get(x, n) != n:
                raise CodeError(f"N_{x} is {n}, not {counted[x]}")
        sizes = {"CONSERVED": 0, **stated, **counted}
        state, parameters, inputs = (lists[x] for x in LISTS[:3])
        basis, defaults = self.values.get("BASIS"), self.values.get("DEFAULTS")
        if isinstance(defaults, tuple):
            defaults = by_name(parameters, defaults)
        if not isinstance(defaults, (dict, type(None))):
            raise CodeError("DEFAULTS are no numbers by their names")
        further = lists.get("OUTPUTS"), lists.get("STATE_BY_BLOCK")
        return Module(state, parameters, inputs, self.functions, sizes, defaults, basis, *further)

    # -- functions ---------------------------------------------------------------------------

    def _contract_function(self, read: dict[str, str]) -> bool:
        """Read a function of the contract, where one stands here; its head is not read."""
        start = self.at
        if self.word not in ("def", "fn", "function") or self.near(1) not in read:
            return False
        if self.syntax.lines and (self.tokens[start].column != 0 or self._decorated()):
            self.unknown(f"{self.near(1)} is not defined for itself")
        name = read[self.near(1)]
        self.head(name)
        self.unread += self.tokens[start : self.at]
        self.function(name)
        return True

    def _decorated(self) -> bool:
        """Is the line before that of a decorator?"""
        at = self.at - 1
        while at > 0 and self.tokens[at - 1].text != END:
            at -= 1
        return self.tokens[max(at, 0)].text == "@"

    def head(self, name: str) -> None:
        """Pass the head of a function, which must be one of its possible ones."""
        for head in self._heads(name):
            if self.took(head):
                self.name, self.writes = name, CONTRACT[name][1].split()
                self.arguments = [x for x in head.split() if x in LETTERS]
                return
        self.unknown(f"{name} has other arguments here")

    def function(self, name: str) -> None:
        """Read the statements of a function, after its head."""
        if name in self.functions:
            self.unknown(f"{name} is defined twice")
        self.counters = {"n"} if name == "rhs_batch" else set()
        self.names = {*self.arguments}
        opened, closed = self.syntax.body
        if opened:
            self.take(opened)
        if self.syntax.lines:
            self.take(END)
        body = _by_rows(self.body())
        if closed:
            self.take(closed)
        self.functions[name] = CodeFunction(name, tuple(self.arguments), tuple(body))

    @property
    def _ended(self) -> bool:
        """Does the body end here?"""
        if self.syntax.body[1] or not self.word:
            return self.word in ("", self.syntax.body[1])
        return self.tokens[self.at].column == 0

    def body(self) -> list[Statement]:
        """The statements of a function, of which one that returns something is the last."""
        body: list[Statement] = []
        returned = False
        while not self._ended:
            if returned:
                self.unknown("a statement after the last")
            start = self.at
            if self.took(*self.syntax.ignored):
                self.unread += self.tokens[start : self.at]
                if self.syntax.lines:
                    self.end()
            elif not self._check():
                returned = self._return(body)
                if not returned:
                    self.statement(body)
        made = self.language == "javascript" or self.name == "constants"
        if made and self.writes and not returned and self.language != "c":
            self.unknown("what is written is not returned")
        return body

    def end(self) -> None:
        """Pass the end of a statement."""
        if not self.syntax.lines:
            self.take(";")
        elif not self._ended:
            self.take(END)

    # -- statements --------------------------------------------------------------------------

    def statement(self, body: list[Statement]) -> None:
        """Read an assignment, to a name, to an entry of an array, or to names from an array."""
        if self.near(1) == "[":
            array, place = self.naming(), self.place()
            self.take("=")
            body.append(("store", array, place, self.expression()))
        elif self.language == "python" and self.took("("):
            body.append(self._unpacked())
        elif not self.syntax.declaration or self.took(self.syntax.declaration):
            self.constant(body)
        else:
            self.unknown()
        self.end()

    def naming(self) -> str:
        """A name, which is no other's."""
        if not NAME.fullmatch(self.word) or self.word in ("_", "abs", *self.sizes):
            self.unknown()
        return self.next()

    def constant(self, body: list[Statement]) -> None:
        """Read a name and its value; an array that is returned is one that is written."""
        name = self.naming()
        if self.syntax.typed:
            self.took(self.syntax.typed, ": [ real ; … ]")
        self.take("=")
        self.names.add(name)
        if name not in self.writes or name in self.arguments:
            body.append(("set", name, self.expression()))
            return
        self.arguments.append(name)
        start = self.at
        if self.took(*MADE):
            self.unread += self.tokens[start : self.at]
        else:
            value = self.expression()
            if value[0] != "list":
                self.unknown(f"{name} is no list of numbers")
            body += (("store", name, ("int", i), x) for i, x in enumerate(value[1:]))

    def _unpacked(self) -> Statement:
        """What follows a bracket: names of the entries of an argument, or ``_``."""
        names = []
        while not self.took(")"):
            names.append(self.next() if self.word == "_" else self.naming())
            if not self.took(",") and self.word != ")":
                self.unknown()
        self.take("=")
        if self.word not in self.arguments:
            self.unknown()
        return ("unpack", tuple(names), self.next())

    def _return(self, body: list[Statement]) -> bool:
        """Read what is returned, numbers or arrays that were written, where it stands here."""
        if self.language == "rust":
            if self.word == "let" or (self.near(1) == "[" and self.word in self.writes):
                return False
            if self.took("Ok ("):
                self._written()
                self.take(")")
            else:
                body.append(("return", self.expression()))
            return True
        if not self.took("return"):
            return False
        if self.word and self.tokens[self.at].column is not None:
            self.unknown("what is returned stands in another line")
        if self.language == "javascript" and self.took("{"):
            self.take(f"{' , '.join(self.writes)} }}")
        elif self.language not in ("c", "python") and self.writes:
            if self.language == "javascript" or self.name == "constants":
                self._written()
            else:
                self.take("nothing")
        else:
            found = self.expression()
            if self.language == "python" and self.took(", tests"):
                self.unread.append(self.tokens[self.at - 1])
            body.append(("return", found))
        self.end()
        return True

    def _written(self) -> None:
        """Pass the name of the array that a function writes."""
        if [self.word] != self.writes or self.word not in self.arguments:
            self.unknown()
        self.at += 1

    def _check(self) -> bool:
        """Pass an error check, a condition under which there is no value, where one stands here."""
        start, opened = self.at, self.syntax.body[0] or END
        under = self.word == "if"
        if self.language in ("c", "python") or not (under or self._throws()):
            return False
        while self.word not in (opened if under else "throw", ""):
            self.at = self.closed(self.at + 1) + 1 if self.word in OPEN else self.at + 1
        if under:
            self.take(opened)
        if not self.took(*FAILING):
            self.unknown()
        self.end()
        if under:
            self.take(self.syntax.body[1])
            if self.syntax.lines:
                self.end()
        for i in range(start, self.at):
            x = self.tokens[i].text
            foreign = NAME.fullmatch(x) and not PURE.fullmatch(x) and x not in self.names
            if foreign or x in CHANGING:
                self.unknown(f"{x} in an error check is not known here", i)
        self.unread += self.tokens[start : self.at]
        return True

    def _throws(self) -> bool:
        """Is there an error where what stands in this line is not so?"""
        at = self.at
        while at < len(self.tokens) and self.tokens[at].text not in (END, "throw", "="):
            at += 1
        return at < len(self.tokens) and [x.text for x in self.tokens[at - 1 : at + 1]] == [
            "||",
            "throw",
        ]


def _by_rows(body: list[Statement]) -> list[Statement]:
    """Statements with the entries of matrices as those of arrays, row by row."""
    rows = [s[2] for s in body if s[0] == "store" and s[2][0] == "row"]
    columns = max((j for _, _, (_, j) in rows), default=0) + 1
    found: list[Statement] = []
    for s in body:
        if s[0] == "store" and s[2][0] == "row":
            _, (_, i), (_, j) = s[2]
            s = (*s[:2], ("int", i * columns + j), s[3])
        found.append(s)
    return found
