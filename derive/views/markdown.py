"""The walk as Markdown with formulas between dollars."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ..record.record import Derivation, Step, Symbol
from .escape import markdown_text, prose
from .layout import blocks
from .letters import names_of
from .outline import FORMULAS_CONVENTIONS, PAPER, capitalised, notes, sections, subtitle, title


def markdown(d: Derivation) -> str:
    """Headings, prose and display formulas; no raw HTML."""
    names = names_of(d.symbols)
    heading = " — ".join(filter(None, (title(d), subtitle(d))))
    parts = [f"# {markdown_text(heading)}", f"{FORMULAS_CONVENTIONS} {markdown_text(PAPER)}"]
    for section, steps in sections(d):
        parts.append(f"## {markdown_text(section)}")
        for step in steps:
            parts.extend(_step(step, names))
    return "\n\n".join(parts) + "\n"


def step_markdown(step: Step, symbols: Iterable[Symbol]) -> str:
    """One step as Markdown."""
    return "\n\n".join(_step(step, names_of(symbols))) + "\n"


def _step(step: Step, names: Mapping[str, str]) -> Iterator[str]:
    beside = "".join(f", {markdown_text(note)}" for note in notes(step))
    yield f"### {markdown_text(capitalised(step.rule))}{beside} — {code(step.label)}"
    used = ", ".join(map(code, step.uses))
    yield prose(step.prose, markdown_text) + (f" (from {used})" if used else "")
    for block in blocks(step.equations, names):
        rows = [row for equation in block for row in equation]
        body = " \\\\\n".join(rows)
        yield f"$$\n\\begin{{aligned}}\n{body}\n\\end{{aligned}}\n$$"


def code(label: str) -> str:
    """A label as a span of code."""
    return f"`{' '.join(label.replace('`', ' ').split())}`"
