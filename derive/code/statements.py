"""Functions of a program as lines of a language, ready for its templates."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from .blocks import Block, blocks
from .ellipsoid import BUNDLES
from .languages import TargetLanguage
from .printers import SourcePrinter, wrapped
from .program import Check, EmittedFunction, Load, Section

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

    def function(self, f: EmittedFunction) -> dict[str, Any]:
        """Name of a template's field → lines of text: loads, sections, outputs, checks."""
        printer = self.printer
        loads = [x for x in f.loads if x.array != "t"]
        return {
            "arrays": sorted({x.array for x in f.loads}),
            "loads": [self._load(x, self.language.load) for x in loads if x.array != "u"],
            "input_loads": [self._load(x, self.language.load) for x in loads if x.array == "u"],
            "unpacked": {array: self._unpacked(array, f) for array in self.sizes},
            "blocks": [self._block(x) for x in blocks(f)] if self.language.batch else [],
            "sections": [self._section(s) for s in f.sections],
            "outputs": [self._wrapped(printer(e), TEXT - 12) for e in f.outputs],
            "titles": [self._comment(f.titles.get(i, "")) for i in range(len(f.outputs))],
            "checks": [self._check(c) for c in f.checks],
            "calls": sorted(f.calls()),
            "operations": operations(f),
        }

    def part(self, f: EmittedFunction) -> dict[str, list[str]]:
        """Statements and outputs of what is a part of a function."""
        written = self.function(f)
        lines = [x for s in written["sections"] for x in s["statements"]]
        return {"statements": lines, "outputs": written["outputs"]}

    def _wrapped(self, text: str, width: int) -> str:
        """An expression on several lines where it is wider than ``width``."""
        return wrapped(text, width, " " * 8).replace("\n", f"{self.language.continued}\n")

    def _declared(self, name: str, text: str) -> str:
        real = self.language.reals[self.real]
        return self.language.declare.format(real=real, name=name, text=text)

    def _load(self, x: Load, pattern: str) -> str:
        index = x.index + self.language.first
        return self._declared(x.name, pattern.format(array=x.array, index=index))

    def _unpacked(self, array: str, f: EmittedFunction) -> str:
        """The names of all entries of an array with commas, _ for those that are not read."""
        names = ["_"] * self.sizes[array]
        for x in f.loads:
            if x.array == array:
                names[x.index] = x.name
        if all(name == "_" for name in names):
            return ""
        listed = ", ".join(names) + "," * (len(names) == 1)
        return textwrap.fill(listed, TEXT - 8, subsequent_indent=" " * 8)

    def _block(self, block: Block) -> dict[str, Any]:
        loads = {"loads": block.loads, "output_loads": block.output_loads}
        return {
            **{name: self._loads(xs, self.language.load) for name, xs in loads.items()},
            **{f"batch_{name}": self._loads(xs, self.language.batch) for name, xs in loads.items()},
            **self._section(block.section),
            "outputs": block.outputs,
        }

    def _loads(self, loads: Iterable[Load], pattern: str) -> list[str]:
        """Loads of a batch by ``pattern``; constants are the same for each of its states."""
        plain = self.language.load
        return [
            self._load(x, plain if x.array == "k" else pattern) for x in loads if x.array != "t"
        ]

    def _section(self, s: Section) -> dict[str, Any]:
        cost = operations(EmittedFunction((), (s,), ()))
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

    def _check(self, c: Check) -> dict[str, str]:
        printer = self.printer
        scale = printer(c.scale) if c.scale is not None else ""
        value = printer(c.value)
        value = f"({value})" if " " in value else value
        scale = self._wrapped(scale, TEXT - 44 - len(value))
        return {"value": value, "scale": f"({scale})" if "+" in scale else scale}


def comment(text: str) -> str:
    """Text that is safe inside a comment or a docstring of any language."""
    plain = "".join(ch if ch.isprintable() else " " for ch in text).replace("\\", "/")
    return plain.replace("*/", "* /").replace("/*", "/ *").replace('"""', "'''")


def operations(f: EmittedFunction) -> str:
    """The operation counts of a function in words."""
    return ", ".join(f"{n} {name}" for name, n in f.operations().items() if n) or "none"
