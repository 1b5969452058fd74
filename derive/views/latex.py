"""The walk as a LaTeX document."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import accumulate, pairwise

from ..language.templating import environment
from ..language.tree import Tree
from ..record.record import Derivation, Step
from .answer import Summary
from .book import MOTION, REGULAR, BookPart, Passage, book, corrections, steps
from .figure.drawing import Scene, tikz
from .figure.scene import scene
from .language import ENGLISH, Language
from .layout import blocks
from .outline import (
    PAPER,
    TRANSPOSES,
    Letter,
    assumed,
    capitalised,
    conventions,
    keys,
    latex_names,
    printed,
    references,
    road,
    subtitle,
    title,
)
from .paper.findings import PaperFinding
from .printing.letters import definitions, styled
from .printing.sentences import dollars, prose
from .printing.signs import Notation, tex_text
from .printing.tex import latex_tree

__all__ = ["fragment", "latex", "latex_tree", "package"]

DELIMITERS = {
    "block_start_string": "<%", "block_end_string": "%>",
    "variable_start_string": "<<", "variable_end_string": ">>",
    "comment_start_string": "<#", "comment_end_string": "#>",
}  # fmt: skip


def latex(
    d: Derivation | Sequence[Derivation],
    notation: Notation | None = None,
    *,
    language: Language = ENGLISH,
    findings: Sequence[PaperFinding] = (),
    pictures: Mapping[str, str] | None = None,
) -> str:
    """A document for pdflatex; every equation bears its label.

    Of several records what holds for any group comes once. ``findings``: where the print of the
    paper is corrected, to be told in footnotes; ``pictures``: name of a record → the file of a
    picture of its motion.
    """
    records = [d] if isinstance(d, Derivation) else [*d]
    one = len(records) == 1
    parts = book(records, language)
    writer = _Writer(parts, language, findings, pictures or {})
    chosen = notation or Notation()
    stated = (TRANSPOSES[chosen.transpose], conventions(records))
    meant = " ".join(prose(language.marked.word(x)) for x in stated)
    return _rendered(
        "walk.tex.jinja",
        language,
        chosen,
        title=tex_text(title(records[0], language) if one else language.word(MOTION)),
        subtitle=tex_text(capitalised(subtitle(records[0], language))) if one else "",
        contents="" if one else tex_text(language.word("Contents")),
        road=styled(prose(language.marked.word(road(records)))).removesuffix("."),
        conventions=styled(f"{meant} {tex_text(language.word(PAPER))}"),
        walk=styled("\n".join(writer.body())),
        drawn=any(writer.drawings.values()),
        pictures=bool(pictures),
        regular=styled(prose(language.marked.word(REGULAR))),
        references=tex_text(language.word("References")),
        bibliography=[[*map(tex_text, x)] for x in references(records)],
    )


def _rendered(name: str, language: Language, notation: Notation, **shown: object) -> str:
    """A template with the macros; ``shown``: what else it shows."""
    return (
        environment("latex", **DELIMITERS)
        .get_template(name)
        .render(
            shown,
            language=language.name,
            macros="\n".join(definitions(notation)),
            from_these=tex_text(language.word("from")),
        )
    )


def answer(x: Summary, notation: Notation | None = None, *, alone: bool = True) -> str:
    """The equations of motion with what their letters are: a document for pdflatex, or, not
    ``alone``, for one with the macros of :func:`package`."""
    body = styled("\n".join(_answer(x)))
    if not alone:
        return f"{WITHOUT_KEYS}\n{body}\n"
    left_out = ("contents", "road", "references", "bibliography", "drawn", "pictures")
    shown = dict.fromkeys(left_out, "") | {
        "title": tex_text(title(x.record, x.language)),
        "subtitle": tex_text(capitalised(subtitle(x.record, x.language))),
        "walk": body,
    }
    return _rendered("walk.tex.jinja", x.language, notation or Notation(), **shown)


def _answer(x: Summary) -> Iterator[str]:
    """The lines of an answer: equations, definitions, letters, and where it is from."""
    names = latex_names(x.record)
    for said, step in x.blocks:
        yield tex_text(said)
        yield from _equations(step, labels(step), names, x.language)
    yield r"\begin{walknames}{}"
    yield from _letters(x.letters, names, x.language)
    yield rf"\end{{walknames}}\par\medskip {breakable(x.source)}"


def package(notation: Notation | None = None, *, language: Language = ENGLISH) -> str:
    """``derive.sty``: the macros of a document, for one of a lecturer's own with fragments."""
    paper = tex_text(language.word("paper {numbers}", numbers="").strip())
    return _rendered("derive.sty.jinja", language, notation or Notation(), paper=paper)


def fragment(
    d: Derivation | Sequence[Derivation],
    *,
    language: Language = ENGLISH,
    findings: Sequence[PaperFinding] = (),
) -> str:
    """The steps alone, for a document with the macros of :func:`package`.

    Of several records what holds for any group comes once.
    """
    records = [d] if isinstance(d, Derivation) else [*d]
    writer = _Writer(book(records, language), language, findings)
    lines = (
        line
        for part in writer.parts
        for line in (
            rf"\walkheading{{{tex_text(part.heading)}}}",
            *(x for step in part.steps for x in writer.step(part, step)),
        )
    )
    return "\n".join((WITHOUT_KEYS, styled("\n".join(lines)))) + "\n"


WITHOUT_KEYS = r"\providecommand{\walkalso}[2]{}"
"""An empty definition of the one macro of a fragment that older preambles lack."""

TOGETHER = 8
"""Equations of so many lines, and one more, stay on one page."""

ROOM = "0.4\\textheight"
"""The space that must be left on a page for a section and its figure to begin there."""


@dataclass(frozen=True)
class _Writer:
    """A book as LaTeX."""

    parts: Sequence[BookPart]
    language: Language
    findings: Sequence[PaperFinding]
    pictures: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def drawings(self) -> dict[str, Scene | None]:
        """Name of a part → the figure of its problem's body; ``None`` for the general text."""
        return {p.name: scene(p.record) if p.record else None for p in self.parts}

    def body(self) -> Iterator[str]:
        """The lines of the document's body: sections with figures, steps and names."""
        for part in self.parts:
            yield rf"\walkroom{{{ROOM}}}\section{{{tex_text(part.heading)}}}"
            if part.about:
                yield rf"{{\large {prose(part.about)}\par}}"
            if drawn := self.drawings[part.name]:
                caption = prose(self.language.marked.of(drawn.caption))
                yield rf"\walkfigure{{{tikz(drawn)}}}{{{caption}}}"
            if part.record and (picture := self.pictures.get(part.name)):
                told = tex_text(self.language.word("In motion"))
                shown = rf"\includegraphics[width=0.7\textwidth]{{{picture}}}"
                yield rf"\walkfigure{{{shown}}}{{{told}}}"
            for step in part.steps:
                yield from ("", *self.step(part, step))
            listed = part.letters(self.language)
            if names := [*_letters(listed, latex_names(part.source), self.language)]:
                heading = tex_text(self.language.word("Names"))
                yield rf"\begin{{walknames}}{{{heading}}}"
                yield from (*names, r"\end{walknames}", "")

    @cached_property
    def corrections(self) -> dict[str, dict[int, list[Passage]]]:
        """Label of a step → number of the paper → the correction told at this step."""
        return corrections(self.parts, self.findings, self.language)

    @cached_property
    def labels(self) -> dict[str, list[str]]:
        """Label of a step → the LaTeX labels of its numbered entries."""
        return {step.label: labels(step) for _, step in steps(self.parts)}

    @cached_property
    def numbered(self) -> list[str]:
        """The LaTeX labels of all numbered entries, in order."""
        return [label for found in self.labels.values() for label in found]

    @cached_property
    def spans(self) -> dict[str, tuple[int, int]]:
        """Label of a step → the places of its first numbered entry and of what follows its last."""
        ends = [*accumulate(map(len, self.labels.values()), initial=0)]
        return dict(zip(self.labels, pairwise(ends), strict=True))

    def references(self, labels: Iterable[str]) -> Iterator[str]:
        """References to all the equations of some steps, neighbours in one span."""
        spans: list[tuple[int, int]] = []
        for first, end in sorted(self.spans[x] for x in labels):
            near = spans and spans[-1][1] == first and first not in self.begins
            spans[-1:] = [(spans[-1][0], end)] if near else [*spans[-1:], (first, end)]
        for first, end in spans:
            ends = [rf"\eqref{{{anchor(self.numbered[k])}}}" for k in (first, end - 1)]
            yield ends[0] if end == first + 1 else (", " if end == first + 2 else "--").join(ends)

    @cached_property
    def begins(self) -> set[int]:
        """The places of the first numbered entries of the parts."""
        return {self.spans[part.steps[0].label][0] for part in self.parts if part.steps}

    def step(self, part: BookPart, step: Step) -> Iterator[str]:
        """The lines of a step: heading, sentences, equations."""
        names, language = latex_names(part.source), self.language
        own = partial(dollars, names=names)
        assumptions = (prose(x, formula=own) for x in assumed(step, language.marked))
        beside = "".join(f", {x}" for x in assumptions) + self.footnotes(step)
        rule = tex_text(capitalised(language.word(step.rule)))
        paper = tex_text(printed(step))
        yield rf"\walkstep{{{paper}}}{{{rule}}}{{{beside}}}{{{breakable(step.label)}}}"
        used = ", ".join(self.references(step.uses))
        told = prose(language.marked.of(step.prose), formula=own)
        yield told + (rf" \walkfrom{{{used}}}" if used else "")
        yield from _equations(step, self.labels[step.label], names, language)

    def footnotes(self, step: Step) -> str:
        """The corrections of the print as footnotes, or the number of one made before."""
        here = self.corrections[step.label]
        shown = {n: "".join(x.shown(prose, _small) for x in t) for n, t in here.items()}
        notes = [rf"\footnote{{\label{{paper.{n}}}{x}}}" for n, x in shown.items()]
        again = [n for n in step.paper if n in self.corrected and n not in here]
        marks = [rf"\textsuperscript{{\ref{{paper.{n}}}}}" for n in again]
        return r"\textsuperscript{,}".join([*notes, *marks])

    @cached_property
    def corrected(self) -> set[int]:
        """The numbers of the paper that have a correction somewhere."""
        return {n for found in self.corrections.values() for n in found}


def _small(sides: Sequence[Tree]) -> str:
    """A formula of a footnote, its matrices small."""
    formula = " = ".join(map(latex_tree, sides))
    return f"${re.sub(r'pmatrix(?=[}])', 'psmallmatrix', formula)}$"


def _equations(
    step: Step, numbered: Iterable[str], names: Mapping[str, str], language: Language
) -> Iterator[str]:
    """The alignments of a step, whose numbered entries have the labels ``numbered``."""
    listed = iter(numbered)
    for block in blocks(step.equations, names, language):
        yield r"\begin{align}"
        rows: list[str] = []
        for entry in block:
            label = rf"\label{{{anchor(here := next(listed))}}}"
            if here == step.label:
                label += rf"\walkalso{{{anchor(step.keys[0])}}}{{{anchor(here)}}}"
            shown = [rf"{row} \notag" for row in entry[:-1]]
            # a page breaks inside a long equation alone, and leaves no line of it by itself
            ends = [
                r" \\" if 1 < k < len(shown) > TOGETHER else r" \\*" for k, _ in enumerate(shown, 1)
            ]
            rows += [*map("".join, zip(shown, ends, strict=True)), rf"{entry[-1]} {label} \\"]
        yield "\n".join(rows).removesuffix(r" \\")
        yield r"\end{align}"


def labels(step: Step) -> list[str]:
    """The LaTeX labels of a step's entries: their keys, but the step's own for the first."""
    return [step.label, *keys(step)[1:]]


def anchor(label: str) -> str:
    r"""A label as the argument of ``\label``: letters, digits and a few marks."""
    return re.sub(r"[^A-Za-z0-9_.:-]", "-", label)


def breakable(label: str) -> str:
    """A label to be read, which may break after its stops."""
    return re.sub(r"(\.|\\_)", r"\1\\allowbreak{}", tex_text(label))


def _letters(
    letters: Iterable[Letter], names: Mapping[str, str], language: Language
) -> Iterator[str]:
    """Letters with their meanings."""
    own = partial(dollars, names=names)
    for x in letters:
        told = tex_text(x.meaning) if x.own else prose(x.meaning, formula=own)
        about = x.after(language, lambda unit: f"[{_unit(unit)}]")
        shown = ", ".join(latex_tree(y, names) for y in x.names)
        yield rf"\walkname{{{shown}}}{{{told}{about}}}"


def _unit(unit: str) -> str:
    """The LaTeX of a unit, its exponents raised."""
    raised = re.sub(r"\\textasciicircum\{\}(-?[0-9]+)", r"$^{\1}$", tex_text(unit))
    return raised.replace(" ", r"\,")
