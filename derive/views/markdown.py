"""The walk as Markdown with formulas between dollars."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial

from ..printing.escape import markdown_text
from ..printing.letters import names_of
from ..printing.macros import standard
from ..printing.sentences import between_dollars, dollars, prose
from ..record.record import Derivation, Equation, Step, Symbol
from .language import ENGLISH, Language
from .layout import blocks
from .outline import (
    PAPER,
    TRANSPOSES,
    capitalised,
    conventions,
    latex_names,
    notes,
    sections,
    subtitle,
    title,
)


def markdown(d: Derivation, *, language: Language = ENGLISH) -> str:
    """The walk: headings, prose and display formulas; no raw HTML."""
    names = latex_names(d)
    heading = " — ".join(filter(None, (title(d, language), subtitle(d, language))))
    meant = " ".join(
        between_dollars(language.word(x), markdown_text)
        for x in (TRANSPOSES["bar"], conventions([d]))
    )
    parts = [f"# {markdown_text(heading)}", f"{meant} {markdown_text(language.word(PAPER))}"]
    for section, steps in sections(d, language):
        parts.append(f"## {markdown_text(section)}")
        for step in steps:
            parts.extend(_step(step, names, language))
    return "\n\n".join(parts) + "\n"


def step_markdown(step: Step, symbols: Iterable[Symbol], *, language: Language = ENGLISH) -> str:
    """One step as Markdown."""
    return "\n\n".join(_step(step, names_of(symbols), language)) + "\n"


def _step(step: Step, names: Mapping[str, str], language: Language) -> Iterator[str]:
    told = partial(prose, escape=markdown_text, formula=partial(dollars, names=names))
    beside = "".join(f", {told(note)}" for note in notes(step, language))
    rule = markdown_text(capitalised(language.word(step.rule)))
    yield f"### {rule}{beside} — {code(step.label)}"
    used = ", ".join(map(code, step.uses))
    from_these = f" ({language.word('from')} {used})" if used else ""
    yield told(language.of(step.prose)) + from_these
    for block in _aligned(step.equations, names, language):
        yield f"$$\n{block}\n$$"


def formula(
    equations: Sequence[Equation], symbols: Iterable[Symbol], *, language: Language = ENGLISH
) -> str:
    """Equations as aligned LaTeX, without dollars."""
    return "\n".join(_aligned(equations, names_of(symbols), language))


def _aligned(
    equations: Sequence[Equation], names: Mapping[str, str], language: Language
) -> Iterator[str]:
    for block in blocks(equations, names, language):
        body = " \\\\\n".join(row for equation in block for row in equation)
        yield standard(f"\\begin{{aligned}}\n{body}\n\\end{{aligned}}")


def code(label: str) -> str:
    """A label as a span of code."""
    return f"`{' '.join(label.replace('`', ' ').split())}`"
