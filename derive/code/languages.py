"""The languages of the emitted code: how each writes numbers, statements, functions."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from . import program
from .ellipsoid import BUNDLES, is_item

# Expressions as text: precedence and numbers, nothing else.

SUM, PRODUCT, ATOM = 1, 2, 3


@dataclass(frozen=True)
class SourcePrinter:
    """How a language writes a number, |x|, and 1 where x is 0, else 0.

    ``integrals``: how a call of a function of integrals over an ellipsoid begins, of ``{prefix}``
    and ``{function}``; ``item``: one of them, counted from ``first``.  The rest is common to all
    that have + − * /.
    """

    number: Callable[[Fraction], str]
    absolute: str = "abs"
    function: Callable[[str], str] = str
    none: str = "({} == 0)"
    integrals: str = "{function}("
    item: str = "{}[{}]"
    first: int = 0
    prefix: str = ""

    def __call__(self, e: program.Expression) -> str:
        """An expression as source text."""
        return self._print(e)[0]

    def _print(self, e: program.Expression) -> tuple[str, int]:
        if isinstance(e, (int, Fraction)):
            text = self.number(Fraction(e))
            return text, ATOM if e >= 0 and "/" not in text else SUM
        if isinstance(e, str):
            return e, ATOM
        op, *operands = e
        if op == "fun" and is_item(e[1]):
            return self.item.format(self(e[2]), int(e[1][-1]) + self.first), ATOM
        if op == "fun" and e[1] in BUNDLES:
            given = ", ".join(self(x) for x in e[2:])
            return f"{self.integrals.format(prefix=self.prefix, function=e[1])}{given})", ATOM
        if op == "fun":
            return f"{self.function(e[1])}({self(e[2])})", ATOM
        if op == "abs":
            return f"{self.absolute}({self(e[1])})", ATOM
        if op == "none":
            return self.none.format(self(e[1])), ATOM
        if op == "add" or program.is_negated(e):
            return self._sum(operands if op == "add" else [e]), SUM
        if op == "mul":
            return "*".join(self._at(x, PRODUCT) for x in operands), PRODUCT
        return f"{self._at(e[1], PRODUCT)}/{self._at(e[2], ATOM)}", PRODUCT

    def _at(self, e: program.Expression, level: int) -> str:
        text, own = self._print(e)
        return text if own >= level else f"({text})"

    def _sum(self, terms: Sequence[Any]) -> str:
        text = ""
        for term in terms:
            sign, size = ("-", term[2]) if program.is_negated(term) else ("+", term)
            shown = self._at(size, PRODUCT)
            text += f" {sign} {shown}" if text else shown if sign == "+" else f"-{shown}"
        return text


def decimal(q: Fraction, suffix: str = "") -> str:
    """The decimal literal nearest to q; a quotient of small integers stays one.

    ``LoweringError`` for a number larger than 1e308.
    """
    try:
        value = float(q)
    except OverflowError:
        raise program.LoweringError(
            "a number of the equations is larger than 1e308; scale it"
        ) from None
    short = Fraction(repr(value)) == q  # a decimal number such as 9.81
    if short or max(abs(q.numerator), q.denominator) >= 10**6:
        return f"{value!r}{suffix}"
    return f"{float(q.numerator)!r}{suffix}/{float(q.denominator)!r}{suffix}"


def wrapped(text: str, width: int, indent: str) -> str:
    """The text broken before + and -, every line at most ``width`` wide where it can be."""
    line, *terms = re.split(r" (?=[+-] )", text)
    lines = []
    for term in terms:
        if len(line) + 1 + len(term) > width:
            lines.append(line)
            line = indent + term
        else:
            line = f"{line} {term}"
    return "\n".join([*lines, line])


@dataclass(frozen=True)
class TargetLanguage:
    """A language: an entry of the table below, and a folder of templates.

    ``files``: for each form of emission, ``source`` and ``header`` both, what follows the prefix in
    the names of the files: ``.rs`` is made of the template ``problem.rs``, ``.inline.h:.h`` is the
    file ``.h`` made of ``problem.inline.h``.
    ``declare``: a constant, of ``{real}``, ``{name}`` and ``{text}``; ``bundle``: the integrals
    over an ellipsoid, where that is otherwise, with ``{prefix}`` as well; ``nan``: what is no
    number, in a table of ``{real}``; ``load`` reads entry
    ``{index}`` (counted from ``first``) of an array; ``batch`` the same of state s of n.
    ``parenthesised``: a statement of several lines needs parentheses; ``continued``: what ends a
    line of it that goes on.
    ``reserved``: words, with spaces, that no name is in this language alone; ``caseless``: capitals
    and small letters are the same.
    ``mutates``: how the name of a function ends that writes what it is given.
    ``needs``: a language whose files these ones include.  ``framed``: are there templates of
    what finds a principal frame?  ``steps``: the steps in time that it has, ``step_files`` those of
    their files that are apart.
    """

    name: str
    files: Mapping[str, tuple[str, ...]]
    printer: Callable[[str], SourcePrinter]
    declare: str
    comment: tuple[str, str, str]
    reals: Mapping[str, str]
    bundle: str = ""
    nan: str = "NAN"
    load: str = "{array}[{index}]"
    batch: str = ""
    first: int = 0
    parenthesised: bool = False
    continued: str = ""
    reserved: str = ""
    caseless: bool = False
    mutates: str = ""
    needs: str = ""
    framed: bool = False
    steps: tuple[str, ...] = ()
    step_files: tuple[str, ...] = ()


def _c(real: str) -> SourcePrinter:
    """The printer of C: suffix f for float."""
    suffix = "f" if real == "float" else ""
    return SourcePrinter(
        lambda q: decimal(q, suffix),
        "fabs" + suffix,
        lambda name: f"{name}{suffix}",
        integrals="{prefix}_{function}(",
        item="{}.v[{}]",
    )


def _plain(function: str, absolute: str, none: str) -> Callable[[str], SourcePrinter]:
    """Printers of a language whose numbers have no suffix and whose functions are a pattern."""
    integrals = "_{function}(xp, " if function.startswith("xp.") else "{function}("
    return lambda real: SourcePrinter(
        decimal, absolute, lambda name: function.format(name), none, integrals
    )


def _rust(real: str) -> SourcePrinter:
    none = f"{'f32' if real == 'float' else 'f64'}::from(u8::from({{}} == 0.0))"
    return SourcePrinter(decimal, "abs", none=none)


def _julia(real: str) -> SourcePrinter:
    def number(q: Fraction) -> str:
        text = decimal(q)
        if real == "double":
            return text
        return "/".join(x.replace("e", "f") if "e" in x else f"{x}f0" for x in text.split("/"))

    return SourcePrinter(number, none="iszero({})", first=1)


HASH, SLASH = ("# ", "# ", ""), ("// ", "// ", "")
C = TargetLanguage(
    "c",
    {"source": (".h", ".c"), "header": (".inline.h:.h",)},
    _c,
    "const {real} {name} = {text};",
    ("/* ", " * ", " */"),
    {"double": "double", "float": "float"},
    bundle="const {prefix}_integrals {name} = {text};",
    batch="{array}[{index}*n + s]",
    framed=True,
    steps=("gauss", "rk4", "vern9", "discrete"),
    step_files=("_steps.h",),
)


def _one_file(ending: str) -> dict[str, tuple[str, ...]]:
    """The same file in both forms."""
    return {"source": (ending,), "header": (ending,)}


_LANGUAGES = (
    C,
    replace(C, name="cpp", files=_one_file(".hpp"), batch="", needs="c", step_files=()),
    replace(C, name="cvode", files=_one_file("_cvode.h"), batch="", needs="c", step_files=()),
    replace(
        C,
        name="fmu",
        files=dict.fromkeys(("source", "header"), ("_fmu.c", "_fmu.xml", "_fmi2.xml")),
        batch="",
        needs="c",
        framed=False,
        steps=("gauss", "vern9"),
        step_files=(),
    ),
    TargetLanguage(
        "python",
        _one_file(".py"),
        _plain("xp.{}", "abs", "_is_zero(xp, {})"),
        "{name} = {text}",
        HASH,
        {"double": "float64", "float": "float32"},
        parenthesised=True,
        framed=True,
        steps=("gauss", "rk4", "vern9", "discrete", "gauss_jax"),
    ),
    TargetLanguage(
        "rust",
        _one_file(".rs"),
        _rust,
        "let {name}: {real} = {text};",
        SLASH,
        {"double": "f64", "float": "f32"},
        bundle="let {name} = {text};",
        nan="{real}::NAN",
        batch="{array}[{index}][s]",
        steps=("gauss", "rk4", "vern9", "discrete"),
    ),
    TargetLanguage(
        "julia",
        _one_file(".jl"),
        _julia,
        "{name} = {text}",
        HASH,
        {"double": "Float64", "float": "Float32"},
        nan="{real}(NaN)",
        first=1,
        batch="{array}[s, {index}]",
        parenthesised=True,
        mutates="!",
        steps=("gauss", "rk4", "vern9", "discrete"),
    ),
    TargetLanguage(
        "javascript",
        _one_file(".mjs"),
        _plain("Math.{}", "Math.abs", "Number({} === 0)"),
        "const {name} = {text};",
        SLASH,
        {"double": "Float64Array", "float": "Float32Array"},
        batch="{array}[8*{index} + s]",
        steps=("gauss", "rk4", "vern9", "discrete"),
    ),
)
LANGUAGES = {x.name: x for x in _LANGUAGES}
"""Name → language, as ``--lang`` takes them."""


# Functions of a program as lines of a language, ready for its templates.

TEXT, EQUATION = 96, 92


@dataclass(frozen=True)
class Statements:
    """How one language writes the parts of a function, for ``double`` or ``float``."""

    language: TargetLanguage
    real: str
    sizes: Mapping[str, int]
    """Array → how many numbers it holds."""
    prefix: str = ""

    @property
    def printer(self) -> SourcePrinter:
        """What writes expressions."""
        return replace(self.language.printer(self.real), prefix=self.prefix)

    def function(self, f: program.EmittedFunction) -> dict[str, Any]:
        """Name of a template's field → lines of text: loads, sections, outputs, checks."""
        printer = self.printer
        loads = [x for x in f.loads if x.array != "t"]
        return {
            "arrays": sorted({x.array for x in f.loads}),
            "loads": [self._load(x, self.language.load) for x in loads if x.array != "u"],
            "input_loads": [self._load(x, self.language.load) for x in loads if x.array == "u"],
            "unpacked": {array: self._unpacked(array, f) for array in self.sizes},
            "blocks": [self._block(x) for x in program.blocks(f)] if self.language.batch else [],
            "sections": [self._section(s) for s in f.sections],
            "outputs": [self._wrapped(printer(e), TEXT - 12) for e in f.outputs],
            "titles": [self._comment(f.titles.get(i, "")) for i in range(len(f.outputs))],
            "checks": [self._check(c) for c in f.checks],
            "calls": sorted(f.calls()),
            "operations": operations(f),
        }

    def part(self, f: program.EmittedFunction, array: str = "") -> dict[str, list[str]]:
        """Statements and outputs of what is a part of a function, with what it reads of an
        array."""
        written = self.function(f)
        lines = [self._load(x, self.language.load) for x in f.loads if x.array == array]
        lines += [x for s in written["sections"] for x in s["statements"]]
        return {"statements": lines, "outputs": written["outputs"]}

    def _wrapped(self, text: str, width: int) -> str:
        """An expression on several lines where it is wider than ``width``."""
        return wrapped(text, width, " " * 8).replace("\n", f"{self.language.continued}\n")

    def _declared(self, name: str, text: str) -> str:
        real = self.language.reals[self.real]
        return self.language.declare.format(real=real, name=name, text=text)

    def _load(self, x: program.Load, pattern: str) -> str:
        index = x.index + self.language.first
        return self._declared(x.name, pattern.format(array=x.array, index=index))

    def _unpacked(self, array: str, f: program.EmittedFunction) -> str:
        """The names of all entries of an array with commas, _ for those that are not read."""
        names = ["_"] * self.sizes[array]
        for x in f.loads:
            if x.array == array:
                names[x.index] = x.name
        if all(name == "_" for name in names):
            return ""
        listed = ", ".join(names) + "," * (len(names) == 1)
        return textwrap.fill(listed, TEXT - 8, subsequent_indent=" " * 8)

    def _block(self, block: program.SectionValues) -> dict[str, Any]:
        """The lines of a block, of one state and of a batch, and its outputs."""
        told = self._section(block.section)
        values = [*told["comment"], *told["statements"]] if told["statements"] else []

        def among(pattern: str) -> list[str]:
            first, last = (self._loads(x, pattern) for x in (block.loads, block.output_loads))
            return [*first, *values, *last]

        return {
            "lines": among(self.language.load),
            "batch_lines": among(self.language.batch),
            "outputs": block.outputs,
        }

    def _loads(self, loads: Iterable[program.Load], pattern: str) -> list[str]:
        """Loads of a batch by ``pattern``; constants are the same for each of its states."""
        plain = self.language.load
        return [
            self._load(x, plain if x.array == "k" else pattern) for x in loads if x.array != "t"
        ]

    def _section(self, s: program.Section) -> dict[str, Any]:
        cost = operations(program.EmittedFunction((), (s,), ()))
        return {
            "comment": self._comment(f"{s.label}: {cost}" if s.label else cost, s.equation),
            "statements": [self._statement(v.name, v.expression) for v in s.values],
        }

    def _comment(self, *texts: str) -> list[str]:
        """The lines of a comment; each text is cut at 200 letters."""
        short = (comment(x if len(x) <= 200 else x[:197] + "...") for x in texts)
        rows = [row for x in short for row in textwrap.wrap(x, EQUATION, break_long_words=False)]
        if not rows:
            return []
        first, between, last = self.language.comment
        lines = [first + rows[0], *(between + x for x in rows[1:])]
        return [*lines[:-1], lines[-1] + last]

    def _statement(self, name: str, expression: Any) -> str:
        text = self.printer(expression)
        if isinstance(expression, tuple) and expression[0] == "fun" and expression[1] in BUNDLES:
            pattern = self.language.bundle or self.language.declare
            return pattern.format(prefix=self.prefix, name=name, text=text)
        if not self.language.parenthesised:
            return self._declared(name, self._wrapped(text, TEXT - 22 - len(name)))
        if len(text) + len(name) > TEXT - 8:
            text = f"(\n        {self._wrapped(text, TEXT - 10)}\n    )"
        return self._declared(name, text)

    def _check(self, c: program.Check) -> dict[str, str]:
        """Value and scale, and by how much that is to be more than a part of this."""
        printer, tolerance = self.printer, Fraction(program.TOLERANCE[self.real])
        scale = printer(c.scale) if c.scale is not None else ""
        value = printer(c.value)
        value = f"({value})" if " " in value else value
        scale = self._wrapped(scale, TEXT - 44 - len(value))
        scale = f"({scale})" if "+" in scale else scale
        margin = f"{value} - {printer.number(tolerance)}*{scale}" if scale else value
        return {"value": value, "scale": scale, "margin": margin}


def comment(text: str) -> str:
    """Text that is safe inside a comment or a docstring of any language."""
    plain = "".join(ch if ch.isprintable() else " " for ch in text).replace("\\", "/")
    return plain.replace("*/", "* /").replace("/*", "/ *").replace('"""', "'''")


def operations(f: program.EmittedFunction) -> str:
    """The operation counts of a function in words."""
    return ", ".join(f"{n} {name}" for name, n in f.operations().items() if n) or "none"
