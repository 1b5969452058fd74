"""The walk as one web page that stands alone: MathML, no script needed to read it."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache, partial
from html import escape
from typing import Any

from ..language.templating import environment
from ..language.tree import Tree, nodes
from ..record.record import Derivation, Equation, Step
from ..record.vocabulary import RULES
from . import outline
from .answer import ANGLE, EXPANDED, Summary, by_angle
from .book import MOTION, REGULAR, BookPart, Passage, book, corrections, steps
from .figure.drawing import svg
from .figure.scene import scene
from .language import ENGLISH, Language, entries
from .latex import anchor
from .layout import ROOM, Quantifiers, clause, quantifier, quantifiers
from .paper.findings import PaperFinding
from .printing.letters import NAMES, standard
from .printing.sentences import inline, prose, spelt
from .printing.signs import Notation
from .printing.tex import Cut, cut_up, formula, joined
from .printing.typeset import Formula, groups, literal, measure, plain

PHONE = 16.0
"""The width, in em, above which what cannot be broken moves in a box of its own on a phone."""
LONG = 0.4 * ROOM
"""The width, in em, above which a left side has lines of its own."""

Fields = dict[str, Any]
"""What a template shows, by name."""
Equations = Callable[[str], list[Fields]]
ARTICLE = "</article>\n"
EQUALS = literal(" = ")
CONTINUATION: Fields = {"id": "", "number": "", "long": False, "cells": (), "clause": "", "tex": ""}
"""The fields of a line that belongs to the equation above it."""

SPACES = "\u00a0\u202f"
MATH = r"<math>(?:(?!</math>).)*</math>"
BESIDE = re.compile(rf"(?<!\S)[^\s<>]+{MATH}[^\s<>]*|(?<!>){MATH}[^\s<>]+")
"""A formula with what stands beside it without a space, from which no line is to part it."""


def html(
    records: Sequence[Derivation],
    notation: Notation | None = None,
    *,
    language: Language = ENGLISH,
    findings: Sequence[PaperFinding] = (),
    moving: Mapping[str, str] | None = None,
    pictures: Mapping[str, str] | None = None,
) -> str:
    """The walk of records as a web page: what holds for any group, then a part for each record.

    ``moving``: name of a record → the file of a page in which its body moves, which gets a link;
    ``pictures``: the file of a picture of its motion, which is shown.
    """
    beside = moving or {}, pictures or {}
    shown = _shown(records, notation or Notation(), language, findings, beside)
    return str(_template("page").render(shown, body="fragment.html.jinja", within="main"))


def fragment(
    records: Sequence[Derivation],
    notation: Notation | None = None,
    *,
    language: Language = ENGLISH,
    findings: Sequence[PaperFinding] = (),
) -> Iterator[str]:
    """What a page shows of the walk of records, to stand in another page with the style sheet
    ``page.css``: in pieces, each made when it is asked for, which end where an article does."""
    shown = _shown(records, notation or Notation(), language, findings)
    piece: list[str] = []
    for part in _template("fragment").generate(shown, within="div"):
        piece.append(part)
        if part.endswith(ARTICLE):
            yield "".join(piece)
            piece = []
    yield "".join(piece)


def articles(
    records: Sequence[Derivation],
    behind: Mapping[str, str],
    language: Language,
    findings: Sequence[PaperFinding],
) -> str:
    """Some steps of records, each once, to stand in another page with the style sheet ``page.css``:
    the labels of ``behind``, in its order, each with the markup that it has there at its end."""
    parts = book(records, language)
    numbers = dict.fromkeys(numbered(parts), "")  # another page counts its own equations
    found = corrections(parts, findings, language)
    home = {
        s.label: (_PartFields(p, Notation(), language, numbers, found, {}, {}), s)
        for p, s in steps(parts)
    }

    def equations(label: str) -> list[Fields]:
        part, step = home[label]
        return [*part.equations(step)]

    shown = [(home[x][0].step(home[x][1], equations, behind), behind[x]) for x in behind]
    given = {"steps": shown, "words": _words(language)}
    return str(_template("articles").render(given))


def answer(x: Summary, notation: Notation | None = None, *, alone: bool = True) -> str:
    """The equations of motion with what their letters are: a page, or, not ``alone``, what it has,
    to stand in another with the style sheet ``page.css``."""
    d, word, steps = x.record, x.language.word, tuple(step for _, step in x.blocks)
    numbers = {key: str(k) for k, key in enumerate((y for s in steps for y in outline.keys(s)), 1)}
    part = BookPart(d.name, "", "", steps, d, (), d)
    written = _PartFields(part, notation or Notation(), x.language, numbers, {}, {}, {})
    shown = {
        "language": x.language.name,
        "title": visible(outline.title(d, x.language)),
        "about": visible(outline.capitalised(outline.subtitle(d, x.language))),
        "words": {"names": word("Names"), "copy": word("copy the LaTeX")},
        "blocks": [(said, [*written.equations(step)]) for said, step in x.blocks],
        "names": [*map(written.letter, x.letters)],
        "source": x.source,
    }
    within = "main" if alone else "div"
    made = _template("page" if alone else "answer")
    return str(made.render(shown, body="answer.html.jinja", within=within))


def _template(name: str) -> Any:
    return environment("html", autoescape=True).get_template(f"{name}.html.jinja")


def _shown(
    records: Sequence[Derivation],
    chosen: Notation,
    language: Language,
    findings: Sequence[PaperFinding],
    beside: tuple[Mapping[str, str], Mapping[str, str]] = ({}, {}),
) -> Fields:
    """What the templates show of the walk of records; ``beside``: the pages and the pictures that
    are named beside it."""
    word = language.word
    parts = book(records, language)
    numbers, found = numbered(parts), corrections(parts, findings, language)
    written = [_PartFields(p, chosen, language, numbers, found, *beside) for p in parts]
    home = {s.label: (p, s) for p in written for s in p.part.steps}

    @cache
    def equations(label: str) -> list[Fields]:
        part, step = home[label]
        return [*part.equations(step)]

    return {
        "language": language.name,
        "title": visible(outline.title(records[0], language))
        if len(records) == 1
        else word(MOTION),
        "about": visible(outline.capitalised(outline.subtitle(records[0], language)))
        if len(records) == 1
        else "",
        "road": words(language.marked.word(outline.road(records)), chosen),
        "conventions": " ".join(
            words(language.marked.word(x), chosen)
            for x in (outline.TRANSPOSES[chosen.transpose], outline.conventions(records))
        ),
        "regular": words(word(REGULAR), chosen),
        "paper": word(outline.PAPER),
        "words": _words(language),
        "references": [x[1:] for x in outline.references(records)],
        "parts": [p.fields(equations) for p in written],
    }


def _words(language: Language) -> dict[str, str]:
    """The words of the templates."""
    word = language.word
    return {
        "from": outline.capitalised(word("from")),
        "coordinates": outline.capitalised(word("coordinates")),
        "names": word("Names"),
        "paper": word("paper {numbers}", numbers="").strip(),
        "copy": word("copy the LaTeX"),
        "moving": word("In motion"),
        "references": word("References"),
    }


def numbered(parts: Sequence[BookPart]) -> dict[str, str]:
    """The numbers of parts, by name, and of equations, by key: those of the LaTeX."""
    found = {}
    for i, part in enumerate(parts, 1):
        found[part.name] = str(i)
        listed = (key for step in part.steps for key in outline.keys(step))
        found |= {key: f"{i}.{k}" for k, key in enumerate(listed, 1)}
    return found


def words(text: str, notation: Notation, names: Mapping[str, str] = NAMES) -> str:
    """A sentence as markup, its formulas, between marks, as MathML; ``names``: the LaTeX of a
    record's own."""
    shown = prose(text, escaped, lambda x: movable(spelt(x).tex, inline(x, notation, names)))
    return BESIDE.sub(r'<span class="kept">\g<0></span>', shown)


def movable(tex: str, shown: Formula, *, follows: bool = False) -> str:
    """The markup of a formula that is not broken; a wide one moves in a box of its own."""
    markup = shown.mathml(follows=follows) if tex else ""
    wide = "<mtable" in markup or measure(tex) > PHONE
    return f'<span class="wide">{markup}</span>' if wide else markup


def escaped(text: str) -> str:
    """Text as markup: escaped, and without hidden characters."""
    return escape(visible(text), quote=False)


def visible(text: str) -> str:
    """Text without characters that turn its direction or hide."""
    return "".join(c for c in text if c.isprintable() or c in SPACES)


@dataclass(frozen=True)
class _PartFields:
    """A part of the book as the fields of its template."""

    part: BookPart
    notation: Notation
    language: Language
    numbers: Mapping[str, str]
    corrections: Mapping[str, Mapping[int, list[Passage]]]
    moving: Mapping[str, str]
    pictures: Mapping[str, str]

    @cached_property
    def names(self) -> Mapping[str, str]:
        """Name → LaTeX, of the part's record."""
        return ANGLE | outline.latex_names(self.part.source)

    def fields(self, shown: Equations) -> Fields:
        """What the template shows of the part, its steps one by one; ``shown``: label → the
        equations of that step."""
        return {
            "id": anchor(self.part.name),
            "number": self.numbers[self.part.name],
            "heading": visible(self.part.heading),
            "about": words(self.part.about, self.notation),
            "steps": (self.step(step, shown) for step in self.part.steps),
            "names": [*map(self.letter, self.part.letters(self.language))],
            "moving": self.moving.get(self.part.name, "") if self.part.record else "",
            "picture": self.pictures.get(self.part.name, "") if self.part.record else "",
            **self.figure(),
        }

    def figure(self) -> dict[str, str]:
        """The drawing of the body and its caption; empty where there is none."""
        drawn = scene(self.part.record) if self.part.record else None
        if drawn is None:
            return {"figure": "", "caption": ""}
        caption = words(self.language.marked.of(drawn.caption), self.notation)
        titled = replace(drawn, title=outline.title(self.part.source, self.language))
        return {"figure": svg(titled), "caption": caption}

    def step(self, step: Step, shown: Equations, there: Collection[str] | None = None) -> Fields:
        """The fields of a step, with the equations it rests on, or that write it in coordinates;
        of steps that are ``there`` on a page, where not all are, no more than the link."""

        def unfolded(label: str) -> Fields:
            linked = there is None or label in there
            equations = () if there and linked else shown(label)
            return {"label": label, "id": linked and anchor(label), "equations": equations}

        return {
            "label": step.label,
            "id": anchor(step.label),
            "rule": outline.capitalised(self.language.word(step.rule)),
            "told": words(self.language.marked.word(RULES[step.rule].sentence), self.notation),
            "printed": outline.printed(step),
            "notes": [
                words(x, self.notation, self.names)
                for x in outline.assumed(step, self.language.marked)
            ],
            "corrections": [*map(self.correction, self.corrections[step.label].values())],
            "prose": words(self.language.marked.of(step.prose), self.notation, self.names),
            "equations": shown(step.label),
            "uses": [unfolded(x) for x in step.uses],
            "coordinates": [
                unfolded(x.label)
                for x in self.part.steps
                if x.rule in ("coordinates", "components") and step.label in x.uses
            ],
        }

    def correction(self, passages: Iterable[Passage]) -> str:
        """The markup of a correction of the print."""

        def shown(sides: Sequence[Tree]) -> str:
            whole = joined([formula(x, None, self.notation) for x in sides], EQUALS)
            return movable(whole.tex, whole)

        return "".join(x.shown(lambda text: words(text, self.notation), shown) for x in passages)

    def equations(self, step: Step) -> Iterable[Fields]:
        """The fields of each numbered entry of a step, with its anchor and its LaTeX."""
        every = quantifiers(self.language, step.equations)
        for x in entries(step.equations):
            key = step.keys[x.first]
            first, cells = x.equations[0], x.equations if x.only is None else ()
            yield {
                "id": anchor(key),
                "number": self.numbers[key],
                "long": measure(self.formula(first.lhs).plain().tex) > LONG,
                "left": self.cut(first.lhs),
                "right": self.cut(first.rhs, equals=True),
                "cells": [self.cell(e) for e in cells],
                "clause": self.clause(first, every),
                "tex": r",\qquad ".join(self.source(e, every) for e in (*x.equations, *x.where)),
            }
            for e in x.where:
                yield CONTINUATION | {
                    "left": self.cut(e.lhs),
                    "right": self.cut(e.rhs, equals=True),
                }
            yield from self.turned(step, first)

    def turned(self, step: Step, e: Equation) -> Iterable[Fields]:
        """The right side of an equation of the answer, and of rates near an equilibrium, once more
        by the angle of A, where that turns a plane."""
        own, kind = self.part.record, step.label.rpartition(".")[2].partition("_")[0]
        if own is None or kind not in (EXPANDED[-1], "equilibrium"):
            return
        written = by_angle(own)
        inside = [x for x in dict.fromkeys(nodes(e.rhs)) if isinstance(x, tuple)]
        entries_of_A = [x for x in inside if x[0] == "entry" and written(x) != x]
        by_it = [self.cell(Equation(x, written(x))) for x in entries_of_A]
        if by_it:
            right = self.cut(written(e.rhs), equals=True)
            yield CONTINUATION | {"left": "", "right": right, "clause": ", ".join(by_it)}

    def cell(self, e: Equation) -> str:
        """The markup of a short equation that stands beside others."""
        whole = (self.formula(e.lhs) + EQUALS + self.formula(e.rhs)).plain()
        return movable(whole.tex, whole)

    @cached_property
    def formula(self) -> Callable[[Tree], Formula]:
        """A tree in the letters and the notation of this part, remembered: it is asked for more
        than once."""
        return lru_cache(64)(partial(formula, names=self.names, notation=self.notation))

    def cut(self, t: Tree, *, equals: bool = False) -> str:
        """The markup of a formula in terms between which a line may break, and these in turn."""
        whole = [x for x in cut_up(self.formula(t)) if x.text.strip()]
        if equals:
            first = whole[0]
            whole[0] = Cut("= " + first.text, 0.0, literal("=") + first.formula)
        return "".join(self.nested(group, equals or k > 0) for k, group in enumerate(groups(whole)))

    def nested(self, parts: Sequence[Cut], follows: bool) -> str:
        """The markup of a term: one element, or terms of its own kept on a line if they fit."""
        if len(parts) == 1:
            return movable(parts[0].text, parts[0].formula, follows=follows)
        inside = (self.nested(x, follows or k > 0) for k, x in enumerate(groups(parts)))
        return f'<span class="term">{"".join(inside)}</span>'

    def clause(self, e: Equation, every: Quantifiers) -> str:
        """The markup of "for every …": for which names the equation holds."""
        over = quantifier(e, self.names, every, self.notation)
        return over.mathml() if over.tex else ""

    def source(self, e: Equation, every: Quantifiers) -> str:
        """The LaTeX of an equation, in standard commands."""
        shown = standard((self.formula(e.lhs) + EQUALS + self.formula(e.rhs)).plain().tex)
        over = clause(e, self.names, every)
        return f"{shown} \\quad {plain(over)}" if over else shown

    def letter(self, x: outline.Letter) -> dict[str, str]:
        """A letter and its meaning."""
        told = escaped(x.meaning) if x.own else words(x.meaning, self.notation, self.names)
        about = told + x.after(self.language, lambda unit: escaped(f"[{unit}]"))
        return {"name": ", ".join(self.formula(y).mathml() for y in x.names), "meaning": about}
