"""The walk as text for a terminal, and as Markdown with formulas between dollars."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import groupby

from ..language.show import in_quotes, show, show_name, unclear
from ..language.tree import names
from ..record.record import Derivation, Equation, Step, Symbol
from . import outline
from .language import ENGLISH, TABLE, Language, cell
from .layout import blocks
from .printing import typeset
from .printing.letters import names_of, standard
from .printing.sentences import QUOTED, dollars, prose
from .printing.signs import NO_BREAK, markdown_text

MARGIN, EQUATION, INSIDE = 2, 6, 4
NAME = 8
OPENING, CLOSING = "([⟨", ")]⟩"
BREAKS = {" + ": typeset.SUM, " − ": typeset.SUM, " ∧ ": typeset.WEDGE}


def text(d: Derivation, width: int = typeset.WIDTH, *, language: Language = ENGLISH) -> str:
    """The record as text, no line longer than ``width`` columns (at least 40)."""
    width, quoted = max(width, 40), clashing(d)
    blocks = [
        [*_underlined(outline.headline(d, language), "=", width)],
        [
            *paragraph(
                f"{outline.plain_conventions(d, language)} {language.word(outline.PAPER)}", 0, width
            )
        ],
    ]
    for section, steps in outline.sections(d, language):
        blocks.append([*_underlined(section, "-", width)])
        blocks.extend([*_step(step, width, quoted, language)] for step in steps)
    if d.symbols:
        blocks.append([*_underlined(language.word("Names"), "-", width)])
        named = (outline.Letter((s.name,), language.of(s.meaning)) for s in d.symbols)
        blocks.append([y for x in named for y in letter_lines(x, quoted, language, width)])
    if own := [*outline.parameters(d, language)]:
        blocks.append([*_underlined(language.word("Parameters"), "-", width)])
        blocks.append([y for x in own for y in letter_lines(x, quoted, language, width)])
    return page(blocks)


def page(blocks: Iterable[Iterable[str]]) -> str:
    """Blocks of lines as one text, without characters that do not print."""
    lines = "\n\n".join("\n".join(line.rstrip() for line in block) for block in blocks)
    return "".join(c for c in lines if c in f"\n{NO_BREAK}" or c.isprintable()) + "\n"


def step_text(
    step: Step,
    width: int = typeset.WIDTH,
    *,
    language: Language = ENGLISH,
    quoted: frozenset[str] = frozenset(),
) -> str:
    """One step as text, with these parameters in quotes."""
    lines = _step(step, width, quoted, language)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def equation_text(e: Equation, width: int = typeset.WIDTH) -> str:
    """One equation as text, its lines at most ``width`` columns wide."""
    return textwrap.dedent("\n".join(equation_lines((e,), width, ENGLISH)))


def letter_lines(
    x: outline.Letter, quoted: frozenset[str], language: Language, width: int
) -> Iterator[str]:
    """The lines of letters with their meaning, with these parameters in quotes."""
    shown = (show_name(y) if isinstance(y, str) else show(in_quotes(y, quoted)) for y in x.names)
    names, column = ", ".join(shown), NAME - MARGIN - 1
    about = unquoted(x.meaning + x.after(language, "[{}]".format), quoted)
    if typeset.display_width(names) > column:
        first, *others = paragraph(f"{names}  {about}", NAME, width)
        yield first[NAME - MARGIN :]
    else:
        first, *others = paragraph(about, NAME, width)
        yield f"{'':{MARGIN}}{padded(names, column)} {first[NAME:]}"
    yield from others


def clashing(d: Derivation, letters: Iterable[str] | None = None) -> frozenset[str]:
    """The parameters that would read like a name of the walk, or like one of these ``letters``;
    text sets them in quotes."""
    body = d.problem.get("body")
    symbolic = isinstance(body, Mapping) and body.get("kind") == "moments"
    own = {"g", *(s.name for s in d.symbols)} if letters is None else {*letters}
    return unclear(own, outline.named_numbers(d), symbolic)


def letters_of(d: Derivation, language: Language) -> frozenset[str]:
    """The letters that the steps of a record have, in their equations and as words of their
    sentences that are symbols."""
    sides = [t for s in d.steps for e in s.equations for t in (e.lhs, e.rhs)]
    words = " ".join(QUOTED.sub("", language.of(s.prose)) for s in d.steps)
    said = {*re.findall(r"\w+", words)}
    symbols = ("g", *(s.name for s in d.symbols))
    return frozenset(x for t in sides for x in names(t)) | said.intersection(symbols)


def unquoted(words: str, quoted: frozenset[str]) -> str:
    """Words whose parameters stand in quotes, without these but for the parameters ``quoted``."""
    kept = {*map(show_name, quoted)}
    return QUOTED.sub(lambda x: x[0] if x[0][1:-1] in kept else x[0][1:-1], words)


def _step(step: Step, width: int, quoted: frozenset[str], language: Language) -> Iterator[str]:
    """The lines of a step: heading, sentences, what it uses, equations."""
    head = [step.label, language.word(step.rule), *outline.notes(step, language)]
    yield from paragraph(unquoted("  ·  ".join(head), quoted), 0, width)
    yield from paragraph(unquoted(language.of(step.prose), quoted), MARGIN, width)
    if step.uses:
        used = language.word("From {labels}.", labels=", ".join(step.uses))
        yield from paragraph(used, MARGIN, width)
    yield from equation_lines(with_quotes(step.equations, quoted), width - EQUATION, language)


def with_quotes(equations: Iterable[Equation], quoted: frozenset[str]) -> tuple[Equation, ...]:
    """The equations with these parameters in quotes."""
    return tuple(
        replace(e, lhs=in_quotes(e.lhs, quoted), rhs=in_quotes(e.rhs, quoted)) for e in equations
    )


def equation_lines(equations: tuple[Equation, ...], room: int, language: Language) -> Iterator[str]:
    """The equations of a step, aligned at their signs; many short ones stand side by side."""
    runs = [[*run] for _, run in groupby(equations, key=lambda e: bool(cell(e)))]
    if len(runs) > 1 and any(len(run) > TABLE and cell(run[0]) for run in runs):
        for run in runs:
            yield from equation_lines(tuple(run), room, language)
        return
    if len(equations) > TABLE and cell(equations[0]) and len(runs) == 1:
        yield from _table([cell(e) for e in equations], room)
        return
    left, along = [show(e.lhs) for e in equations], outline.moving(equations)
    widest = max(map(typeset.display_width, left))
    column = widest if widest <= room * 2 // 5 else 0
    for lhs, e in zip(left, equations, strict=True):
        for line in _equation(lhs, e, column, room, _clause(e, along, language), language):
            yield " " * EQUATION + line


def _table(cells: list[str], room: int) -> Iterator[str]:
    """The lines of short equations in columns, row by row."""
    widest = max(map(typeset.display_width, cells)) + 4
    columns = max(1, min(4, room // widest))
    for k in range(0, len(cells), columns):
        row = (padded(x, widest) for x in cells[k : k + columns])
        yield " " * EQUATION + "".join(row)


def padded(words: str, width: int) -> str:
    """Words with spaces behind them up to a width."""
    return words + " " * max(width - typeset.display_width(words), 0)


def _equation(
    lhs: str, e: Equation, column: int, room: int, clause: str, language: Language
) -> Iterator[str]:
    """The lines of an equation whose left side has ``column`` columns; 0: its own lines."""
    right = show(e.rhs)
    if isinstance(e.rhs, tuple) and e.rhs[0] == "par" and right == lhs:
        right += f"  {language.word('(a parameter)')}"
    lead = " " * (column - typeset.display_width(lhs)) + lhs
    if column == 0 and typeset.display_width(f"{lhs} = {right}") > room:
        *before, lead = _broken(lhs, room, 0)
        yield from before
        if typeset.display_width(lead) > room // 2:
            yield lead
            lead = " " * INSIDE
    indent = typeset.display_width(lead) + 3
    first, *others = [*_broken(right, room - indent, indent)]
    lines = [f"{lead} = {first[indent:]}", *others]
    if clause and typeset.display_width(f"{lines[-1]}  {clause}") <= room:
        lines[-1] += f"  {clause}"
        clause = ""
    yield from lines
    if clause:
        yield from paragraph(clause, indent, room)


def _clause(e: Equation, along: Collection[Equation], language: Language) -> str:
    """For which names an equation holds: every one, or some; or along the motion, as those
    ``along`` it do; empty where nothing is said."""
    clauses = []
    if names := outline.quantified(e, along):
        shown, space = ", ".join(map(show_name, names)), outline.domain(names)
        shown = f"({shown})" if len(names) > 1 and space else shown
        within = f" ∈ {space}" if space else ""
        clauses.append(f"{language.word('for every')} {shown}{within}")
    if e.exists:
        clauses.append(f"{language.word('for some')} {', '.join(map(show_name, e.exists))}")
    if e in along:
        clauses.append(language.word("along the motion"))
    return ", ".join(clauses)


def _broken(formula: str, room: int, indent: int) -> list[str]:
    """The lines of a formula, which start at column ``indent`` or deeper."""
    lines = typeset.fill(pieces(formula), room, typeset.display_width, INSIDE)
    shown = [" " * (indent + INSIDE * line.inside) + line.text for line in lines]
    return [part for line in shown for part in _cut(line, room + indent)]


def pieces(formula: str) -> list[typeset.Piece]:
    """The pieces of a formula, cut before its operators and after its commas, with their depth."""
    found, start, depth, strength = [], 0, 0, 0.0
    stroke = ""
    for k, c in enumerate(formula):
        if c in OPENING:
            depth += 1
        elif c in CLOSING:
            depth -= 1
        elif c in "‖|" and stroke in ("", c):
            stroke = "" if stroke else c
        elif c in " ·" and k > start:
            after = {",": typeset.COMMA, ";": typeset.ROW}.get(formula[k - 1])
            here = BREAKS.get(formula[k : k + 3], typeset.FACTOR) if after is None else after
            if formula[max(k - 2, 0) : k + 1] in BREAKS:
                continue
            found.append(typeset.Piece(formula[start:k], strength))
            start, strength = k, depth + bool(stroke) + here
    return [*found, typeset.Piece(formula[start:], strength)]


def _cut(line: str, width: int) -> list[str]:
    """A line cut by force into ones of ``width`` where nothing else made it short enough."""
    if typeset.display_width(line) <= width:
        return [line]
    columns = 0
    for k, c in enumerate(line):
        columns += 0 if typeset.MARK.match(c) else 1
        if columns > width:
            return [line[:k], *_cut(line[k:], width)]
    return [line]


def paragraph(words: str, margin: int, width: int) -> Iterator[str]:
    """Words filled into lines; runs of spaces inside a line stay."""
    line = ""
    for word in words.strip().split(" "):
        if line.strip() and typeset.display_width(f"{line} {word}") > width - margin:
            yield " " * margin + line.strip()
            line = word
        else:
            line = f"{line} {word}" if line else word
        *whole, line = _cut(line, width - margin)
        yield from (" " * margin + part for part in whole)
    yield " " * margin + line.strip()


def _underlined(heading: str, mark: str, width: int) -> list[str]:
    """A heading with a line of ``mark`` below it."""
    lines = [*paragraph(heading, 0, width)]
    return [*lines, mark * max(map(typeset.display_width, lines))]


# The walk as Markdown with formulas between dollars.


def markdown(d: Derivation, *, language: Language = ENGLISH) -> str:
    """The walk: headings, prose and display formulas; no raw HTML."""
    names = outline.latex_names(d)
    meant = " ".join(
        prose(language.marked.word(x), markdown_text)
        for x in (outline.TRANSPOSES["bar"], outline.conventions([d]))
    )
    parts = [
        f"# {markdown_text(outline.headline(d, language))}",
        f"{meant} {markdown_text(language.word(outline.PAPER))}",
    ]
    for section, steps in outline.sections(d, language):
        parts.append(f"## {markdown_text(section)}")
        for step in steps:
            parts.extend(_step_in_markdown(step, names, language))
    return "\n\n".join(parts) + "\n"


def step_markdown(step: Step, symbols: Iterable[Symbol], *, language: Language = ENGLISH) -> str:
    """One step as Markdown."""
    return "\n\n".join(_step_in_markdown(step, names_of(symbols), language)) + "\n"


def _step_in_markdown(step: Step, names: Mapping[str, str], language: Language) -> Iterator[str]:
    told = partial(prose, escape=markdown_text, formula=partial(dollars, names=names))
    beside = "".join(f", {told(note)}" for note in outline.notes(step, language.marked))
    rule = markdown_text(outline.capitalised(language.word(step.rule)))
    yield f"### {rule}{beside} — {code(step.label)}"
    used = ", ".join(map(code, step.uses))
    from_these = f" ({language.word('from')} {used})" if used else ""
    yield told(language.marked.of(step.prose)) + from_these
    for block in aligned(step.equations, names, language):
        yield f"$$\n{block}\n$$"


def formula(
    equations: Sequence[Equation], symbols: Iterable[Symbol], *, language: Language = ENGLISH
) -> str:
    """Equations as aligned LaTeX, without dollars."""
    return "\n".join(aligned(equations, names_of(symbols), language))


def aligned(
    equations: Sequence[Equation], names: Mapping[str, str], language: Language = ENGLISH
) -> Iterator[str]:
    """Alignments of equations, by the LaTeX of their names."""
    for block in blocks(equations, names, language):
        body = " \\\\\n".join(row for equation in block for row in equation)
        yield standard(f"\\begin{{aligned}}\n{body}\n\\end{{aligned}}")


def code(label: str) -> str:
    """A label as a span of code."""
    return f"`{' '.join(label.replace('`', ' ').split())}`"
