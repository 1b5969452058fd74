"""The walk as a LaTeX document."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ..record.record import Derivation, Step
from ..templating import environment
from .escape import prose, tex_text
from .layout import blocks
from .letters import names_of, parameter
from .outline import (
    FORMULAS_CONVENTIONS,
    PAPER,
    capitalised,
    equation_label,
    notes,
    sections,
    subtitle,
    title,
)
from .tex import latex_tree

__all__ = ["latex", "latex_tree"]

DELIMITERS = {
    "block_start_string": "<%", "block_end_string": "%>",
    "variable_start_string": "<<", "variable_end_string": ">>",
    "comment_start_string": "<#", "comment_end_string": "#>",
}  # fmt: skip


def latex(d: Derivation) -> str:
    """A document for pdflatex; every equation bears its label."""
    names = names_of(d.symbols)
    template = environment("latex", **DELIMITERS).get_template("walk.tex.jinja")
    return template.render(
        title=tex_text(title(d)),
        subtitle=tex_text(capitalised(subtitle(d))),
        conventions=f"{FORMULAS_CONVENTIONS} {tex_text(PAPER)}",
        walk="\n".join(line for part in _walk(d, names) for line in part),
        names="\n".join(_names(d, names)),
    )


def _walk(d: Derivation, names: Mapping[str, str]) -> Iterator[list[str]]:
    last = {step.label: equation_label(step, len(step.equations) - 1) for step in d.steps}
    for heading, steps in sections(d):
        yield [rf"\section{{{tex_text(heading)}}}", ""]
        for step in steps:
            yield [*_step(step, names, last), ""]


def reference(label: str, last: Mapping[str, str]) -> str:
    """The numbers of all the equations of a step."""
    first, final = anchor(label), anchor(last[label])
    span = "" if first == final else rf"--\eqref{{{final}}}"
    return rf"\eqref{{{first}}}{span}"


def _step(step: Step, names: Mapping[str, str], last: Mapping[str, str]) -> Iterator[str]:
    beside = "".join(f", {tex_text(note)}" for note in notes(step))
    yield rf"\step{{{tex_text(capitalised(step.rule))}}}{{{beside}}}{{{spelt(step.label)}}}"
    used = ", ".join(reference(label, last) for label in step.uses)
    yield prose(step.prose) + (rf" \from{{{used}}}" if used else "")
    k = 0
    for block in blocks(step.equations, names):
        yield r"\begin{align}"
        rows: list[str] = []
        for equation in block:
            label = rf"\label{{{anchor(equation_label(step, k))}}}"
            rows += [*(rf"{row} \notag" for row in equation[:-1]), f"{equation[-1]} {label}"]
            k += 1
        yield " \\\\\n".join(rows)
        yield r"\end{align}"


def anchor(label: str) -> str:
    r"""A label as the argument of ``\label``: letters, digits and a few marks."""
    return re.sub(r"[^A-Za-z0-9_.:-]", "-", label)


def spelt(label: str) -> str:
    """A label to be read, which may break after its stops."""
    return re.sub(r"(\.|\\_)", r"\1\\allowbreak{}", tex_text(label))


def _names(d: Derivation, names: Mapping[str, str]) -> Iterator[str]:
    """The letters of the record with their meanings, then the parameters of the problem."""
    for symbol in d.symbols:
        yield rf"\name{{{latex_tree(symbol.name, names)}}}{{{prose(symbol.meaning)}}}"
    parameters = d.problem.get("parameters")
    for name, about in parameters.items() if isinstance(parameters, Mapping) else ():
        about = about if isinstance(about, Mapping) else {}
        meaning = tex_text(str(about.get("meaning") or "parameter"))
        unit = _unit(str(about.get("unit") or ""))
        yield rf"\name{{{parameter(str(name))}}}{{{meaning}{f' [{unit}]' if unit else ''}}}"


def _unit(unit: str) -> str:
    """A unit, its exponents raised."""
    raised = re.sub(r"\\textasciicircum\{\}(-?[0-9]+)", r"$^{\1}$", tex_text(unit))
    return raised.replace(" ", r"\,")
