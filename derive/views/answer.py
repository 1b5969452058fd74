"""The answer of a record: the equations of motion of its problem, with what their letters are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from ..language.show import show_name
from ..language.tree import Tree, names, nodes
from ..record.record import Derivation, Equation, Step
from .language import ENGLISH, Language
from .outline import latex_names, subtitle, title
from .printing.line_breaking import WIDTH
from .printing.signs import Notation
from .printing.tex import formula as of_tree
from .printing.typeset import literal
from .text import (
    EQUATION,
    clashing,
    equation_lines,
    formula,
    name_lines,
    paragraph,
    parameters,
    unquoted,
    with_quotes,
)

SOLVED = ("kinematics", "coadjoint", "kernel", "equations", "motion")
"""The steps that may tell the motion, the better ones later."""
EXPANDED = ("components", "explicit")
"""The steps that tell it entry by entry."""


def steps_of_answer(d: Derivation) -> tuple[Step, ...]:
    """The steps in which the equations of motion stand: solved, then entry by entry."""
    there = {s.label.removeprefix(f"{d.name}."): s for s in d.steps}
    solved = [there[x] for x in SOLVED if x in there]
    return (*solved[-1:], *(there[x] for x in EXPANDED if x in there))


def equations_of_motion(d: Derivation) -> tuple[Equation, ...]:
    """The equations of the answer, without those of a vector whose entries are told."""
    solved, *expanded = steps_of_answer(d)
    rates = {x for e in solved.equations for x in names(e.lhs)}
    told = [e for step in expanded for e in step.equations if rates & {*names(e.lhs)}]
    parts = [x for e in told for x in nodes(e.lhs) if isinstance(x, tuple)]
    in_entries = {x[1] for x in parts if x[0] == "entry"}
    return (*(e for e in solved.equations if e.lhs not in in_entries), *told)


def definitions(d: Derivation, equations: Sequence[Equation]) -> tuple[Equation, ...]:
    """What the record says of the letters of equations, and of those in it, by its own steps."""
    known: dict[Tree, Equation] = {}
    told = {x for e in equations for x in (e.lhs, *nodes(e.lhs))}
    left = [e.rhs for e in equations]
    while left:
        x = left.pop(0)
        if x in told or x in known:
            continue
        step, equation = d.definition(x) or (None, None)
        if step and equation and step.label.startswith(f"{d.name}.") and not equation.for_all:
            known[x] = equation
            left.append(equation.rhs)
        elif isinstance(x, tuple):
            left += x[1:]
    return tuple(known.values())


def answer(d: Derivation, width: int = WIDTH, *, language: Language = ENGLISH) -> str:
    """The equations of motion as text, what their letters are, and the steps that prove them."""
    width, quoted = max(width, 40), clashing(d)
    motion = equations_of_motion(d)
    defined = definitions(d, motion)
    heading = " — ".join(filter(None, (title(d, language), subtitle(d, language))))
    blocks = [
        [*paragraph(heading, 0, width)],
        [*equation_lines(with_quotes(motion, quoted), width - EQUATION, language)],
    ]
    if defined:
        lines = equation_lines(with_quotes(defined, quoted), width - EQUATION, language)
        blocks.append([language.word("where"), *lines])
    blocks.append([*_letters(d, (*motion, *defined), quoted, width, language)])
    labels = ", ".join(s.label for s in steps_of_answer(d))
    blocks.append([*paragraph(language.word("From {labels}.", labels=labels), 0, width)])
    return "\n\n".join("\n".join(x.rstrip() for x in block) for block in blocks if block) + "\n"


def answer_markdown(d: Derivation, *, language: Language = ENGLISH) -> str:
    """The equations of motion in Markdown, and what their letters are, as display formulas."""
    motion = equations_of_motion(d)
    defined, symbols = definitions(d, motion), d.symbols
    parts = [f"$$\n{formula(motion, symbols, language=language)}\n$$"]
    if defined:
        shown = formula(defined, symbols, language=language)
        parts += [language.word("where"), f"$$\n{shown}\n$$"]
    return "\n\n".join(parts) + "\n"


def answer_mathml(d: Derivation) -> tuple[str, ...]:
    """The equations of motion as MathML, one element each."""
    names = latex_names(d)
    typeset = partial(of_tree, names=names, notation=Notation())
    return tuple(
        (typeset(e.lhs) + literal(" = ") + typeset(e.rhs)).plain().mathml()
        for e in equations_of_motion(d)
    )


def _letters(
    d: Derivation,
    equations: Sequence[Equation],
    quoted: frozenset[str],
    width: int,
    language: Language,
) -> Iterator[str]:
    """The names and the parameters that occur, with their meaning."""
    there = {x for e in equations for x in nodes(e.rhs)}
    for s in d.symbols:
        if s.name in there:
            meaning = unquoted(language.of(s.meaning), quoted)
            yield from name_lines(show_name(s.name), meaning, width)
    for name, shown, about in parameters(d, quoted, language):
        if ("par", name) in there:
            yield from name_lines(shown, about, width)
