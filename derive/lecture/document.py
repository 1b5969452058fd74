"""The lecture as LaTeX and as a page: its entries with their formulas set, for the templates."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial, reduce
from itertools import zip_longest
from typing import Any, NamedTuple

from ..check.form.hypotheses_checked import Verdict
from ..language.read import FormulaError
from ..language.templating import environment
from ..record.record import Derivation, Equation
from ..views.figure.drawing import Scene, svg, tikz
from ..views.html import escaped
from ..views.language import LANGUAGES, Language
from ..views.language import typeset as typeset_french
from ..views.latex import DELIMITERS, anchor
from ..views.printing import typeset
from ..views.printing.letters import definitions
from ..views.printing.sentences import prose, spelt
from ..views.printing.signs import NO_BREAK, SYMBOLS, Notation, tex_text
from ..views.printing.tex import formula as of_tree
from ..views.printing.typeset import literal, measure, plain
from .back_matter import NUMBERS, UNTITLED, WORKS, Front, LetterUse, homes, letters
from .displays import LETTERS, blocks, displayed, sides
from .figures import FIGURES, Figure
from .lecture_text import RELATION, STATED, Block, Chapter, Entry, Formula, Given, Words
from .lecture_text import tree as tree_of
from .sheets import AXES, Claims
from .ticked_steps import ticked

TITLE = "Where do the equations of motion of solids come from?"
WORDS = (
    *("Definition", "Lemma", "Proposition", "Theorem", "Remark", "Proof", "Calculation"),
    *("Exercise", "Solution", "Solutions", "Fig.", "Symbols", "Bibliography", "Steps"),
    "The steps behind the ticks",
    *("Projector", "The step before", "The next step", "Leave (Esc)", "now", "{n} of {all}"),
    "A name at the right begins with one of these; the command beside it prints the steps.",
)
"""The words of the templates."""
MOVE = "Move it: {title}"
MARKED = re.compile(r"_([^_]+)_|@([a-z_]+)")
"""What is marked among words: emphasis, and the number of a block."""
COMMAND = "derive "
"""How what is typed begins."""
LISTED = re.compile(r"(?<=\d\u202f;) (?=\d)")
"""The space between two numbers of a list in French."""
MEASURED = re.compile(r"(\d[.,]\d+) (?=[^\W\d])")
"""A decimal before a word, as its unit."""
TIED = re.compile(r"(?<=\w|\.) $")
"""The space between a word and a number, where no line breaks."""
CAPITAL = re.compile("<mi>([Α-Ω])</mi>")
CLOSED = re.compile(r"(<math>(?:(?!<math).)*</math>)([.,;:)]+)", re.S)
"""A formula of a page and the signs after it, between which no line breaks."""


@dataclass(frozen=True)
class Medium:
    """How words, commands and formulas are written in a kind of document."""

    text: Callable[[str], str]
    emphasis: str
    command: str
    reference: str
    inline: Callable[[typeset.Formula], str]
    display: Callable[[typeset.Formula], str]
    picture: Callable[[Scene], str]
    aligned: Callable[[Sequence[Equation], str], str]
    apart: str


AMONG = 60
"""The most letters of a formula of a record that stands among words."""
SIGNS = re.compile(r"\s*[.,;:]")

SHORT, SIGN = 7.0, re.compile(r" \S+ ")
"""The width, in em, below which a formula among words is not broken, and where it might be."""


def _inline(x: typeset.Formula) -> str:
    """A formula among words as LaTeX."""
    tex = plain(x.tex)
    return f"${{{tex}}}$" if measure(tex) < SHORT and SIGN.search(tex) else f"${tex}$"


LATEX = Medium(
    partial(tex_text, latin=True),
    r"\emph{{{}}}",
    r"\texttt{{{}}}",
    r"\ref{{{label}}}",
    _inline,
    displayed,
    lambda x: tikz(x, colours=frozenset(AXES)),
    blocks,
    "\\[{}\\]",
)


PAGE: Medium = Medium(
    escaped,
    "<em>{}</em>",
    "<code>{}</code>",
    '<a href="#{label}">{number}</a>',
    lambda x: x.mathml(),
    lambda x: x.mathml().replace("<math>", '<math display="block">'),
    svg,
    lambda equations, sign: "\n".join(  # one below the other
        PAGE.display(sides(e) + literal(sign * (e is equations[-1]))) for e in equations
    ),
    '<span class="display">{}</span>',
)


Set = dict[str, Any]
"""What a template takes of a chapter, a block, an entry or a letter."""


class Frame(NamedTuple):
    """A page of its own behind a figure, in which what this shows moves: its title, its HTML."""

    title: str
    page: str


@dataclass(frozen=True)
class Lecture:
    """Chapters in a language; ``records``: those of the chapters, by the names that these give
    them; ``solutions``: where those of the exercises stand, at the end of each ``chapter``, in
    one of their own at the ``end``, or nowhere (``none``); ``judgements``: the verdicts on the
    steps that its ticks name, where they were tried; ``frames``: of a page, by the labels of the
    figures."""

    chapters: Sequence[Chapter]
    language: Language
    records: Mapping[str, Derivation]
    front: Front = UNTITLED
    solutions: str = "chapter"
    judgements: Mapping[str, Verdict] = field(default_factory=dict)
    frames: Mapping[str, Frame] = field(default_factory=dict)


def latex(lecture: Lecture) -> str:
    """The lecture as a document for pdflatex."""
    template = environment("latex", **DELIMITERS).get_template("lecture.tex.jinja")
    return template.render(macros="\n".join(definitions(Notation())), **_whole(lecture, LATEX))


def page(lecture: Lecture) -> str:
    """The lecture as a page of HTML by itself, its formulas in MathML."""
    whole, numbers = _whole(lecture, PAGE), numbers_of(lecture.chapters)
    calculation = lecture.language.word("Calculation")
    between: dict[str, list[str]] = {}
    for k, c in enumerate(lecture.chapters, 1):
        for block in (b for b in c.blocks if b.kind == "calculation"):
            link = f'<a href="#calculation-{numbers[id(block)]}">{calculation}, § {k}</a>'
            for label in dict.fromkeys(x for e in block.entries for x in e.labels):
                between.setdefault(label, []).append(link)
    told = lecture.chapters, lecture.records, lecture.language, lecture.judgements
    whole |= {"steps": ticked(*told, between), "anchored": anchor}
    whole["frames"] = {
        label: (x, lecture.language.word(MOVE, title=x.title))
        for label, x in lecture.frames.items()
    }
    text = environment("html").get_template("lecture.html.jinja").render(whole)
    text = CAPITAL.sub(r'<mi mathvariant="normal">\1</mi>', text)  # as LaTeX has them
    return CLOSED.sub(r'<span class="close">\1\2</span>', text)


def _whole(x: Lecture, medium: Medium) -> Set:
    """What both templates take."""
    chapters, language, front = x.chapters, x.language, x.front
    numbers = numbers_of(chapters)
    named: list[Block | Entry] = [b for c in chapters for b in c.blocks]
    named += [e for c in chapters for e in c.entries if e.label]
    labels = {x.label: numbers[id(x)] for x in named if id(x) in numbers}
    figures = {**FIGURES, **{label: y for c in chapters for label, y in c.figures.items()}}
    setter = _Setter(language, medium, labels | NUMBERS, claims_of(chapters), figures)
    if x.solutions == "none":
        asked = [tuple(b for b in c.blocks if b.kind != "solution") for c in chapters]
        chapters = [replace(c, blocks=x) for c, x in zip(chapters, asked, strict=True)]
    listed = letters(chapters, x.records, language)
    table = [setter.letter(letter, k) for k, letter in enumerate(listed)]
    printed = homes(chapters, x.records)
    works = [(*by, ", ".join(map(language.word, where.split(", ")))) for *by, where in WORKS]
    return {
        "language": language.name,
        "word": lambda word: medium.text(language.word(word)),
        "title": medium.text(front.title or language.word(TITLE)),
        "author": medium.text(front.author),
        "front": [*map(medium.text, front.lines)],
        "solutions": x.solutions,
        "chapters": [setter.chapter(c, numbers) for c in chapters],
        "letters": table,
        "homes": {medium.text(y): [*map(medium.text, told)] for y, told in printed.items()},
        "works": [(key.lower(), *map(medium.text, told)) for key, *told in works],
    }


COUNTED = {**dict.fromkeys(STATED, "statement"), "solution": "exercise"}
"""Kind of a block → what its number is counted with, if not its own kind."""


def numbers_of(chapters: Sequence[Chapter]) -> dict[int, int]:
    """The number of each block and display that has one, by its id: statements are counted
    together, and a solution has that of the exercise before it."""
    displays = (x for c in chapters for x in c.entries if x.label)
    found = {id(x): k for k, x in enumerate(displays, 1)}
    counts = {"statement": 0, "exercise": 0, "figure": 0, "calculation": 0}
    for block in (x for c in chapters for x in c.blocks):
        counter = COUNTED.get(block.kind, block.kind)
        if counter in counts:
            counts[counter] += block.kind != "solution"
            found[id(block)] = counts[counter]
    return found


def claims_of(chapters: Sequence[Chapter]) -> Claims:
    """The equations that are displayed, by the steps that they rest on."""
    displays = [e for c in chapters for e in c.entries if e.display]
    return {label: e.equations for e in displays[::-1] for label in e.labels}


class _Setter:
    """Entries in one language and one medium; ``numbers``: of the labels of blocks; ``claims``: the
    equations displayed, by their steps; ``figures``: by the labels of their blocks."""

    def __init__(
        self,
        language: Language,
        medium: Medium,
        numbers: dict[str, int],
        claims: Claims,
        figures: Mapping[str, Figure],
    ):
        self.language, self.medium, self.numbers = language, medium, numbers
        self.claims, self.figures = claims, figures
        self.anchors: dict[int, list[str]] = {}
        self.at = LANGUAGES.index(language.name)

    def chapter(self, c: Chapter, numbers: Mapping[int, int]) -> Set:
        """A chapter, with the solutions of its exercises once more; ``numbers``: of its blocks."""
        blocks = [self.block(b, numbers.get(id(b), 0)) for b in c.blocks]
        solutions = [x for x in blocks if x["kind"] == "solution"]
        # a theorem, or a chapter of the course, may be called as a problem is
        name = f"{'chapter' if c.of_course else 'problem'}_{c.name}"
        title = self.words((c.title[self.at],))
        return {"name": name, "title": title, "blocks": blocks, "solutions": solutions}

    def letter(self, x: LetterUse, k: int) -> Set:
        """A row of the table of symbols, with its chapter and the anchor at its first entry."""
        anchor = f"letter-{k}"
        self.anchors.setdefault(id(x.entry), []).append(anchor)
        meaning = prose(x.meaning, self.plain, lambda y: self.medium.inline(spelt(y)))
        letter = self.words((Formula(x.name),))
        return {"letter": letter, "meaning": meaning, "anchor": anchor, "chapter": x.chapter}

    def block(self, b: Block, number: int) -> Set:
        """A block with its entries and the number of a statement, an exercise or a figure; the
        first entry of a figure describes its picture, for those who do not see it."""
        entries = [self.entry(x, y) for x, y in zip_longest(b.entries, b.entries[1:])]
        found: Set = {"kind": b.kind, "label": b.label, "title": self.medium.text(b.title)}
        found |= {"number": number, "entries": entries}
        if b.kind == "figure":
            picture = self.medium.picture(self.scene(b))
            found |= {"entries": entries[1:], "description": entries[0]["text"], "picture": picture}
        return found

    def scene(self, b: Block) -> Scene:
        """The picture of a figure, with its description and the decimal mark of the language."""
        scene = self.figures[b.label](self.claims)
        labels = (replace(x, base=self.language.numbers(x.base)) for x in scene.labels)
        (description,) = b.entries[0].texts[self.at]
        return replace(scene, labels=tuple(labels), title=str(description))

    def entry(self, x: Entry, behind: Entry | None) -> Set:
        """A sentence or a display with what stands in its margins; the label and the number of a
        display that is cited. What is ``behind`` a display says which sign ends it."""
        return {
            "text": self.display(x, behind) if x.display else self.words(x.texts[self.at]),
            "display": x.display,
            "labels": x.labels,
            "open": tuple(self.medium.text(y.open[self.at]) for y in x.ties if y.open),
            "numbers": tuple(n for tie in x.ties for n in tie.numbers),
            "anchors": self.anchors.get(id(x), ()),
            "label": x.label,
            "number": self.numbers[x.label] if x.label else 0,
        }

    def display(self, x: Entry, behind: Entry | None) -> str:
        """A display: formulas side by side, with a comma where their sentence goes on."""
        ((whole,), *_) = x.texts
        assert isinstance(whole, Formula)
        first = str(behind.texts[0][0]) if behind else ""
        goes_on = first[:1].islower() or (behind and behind.display)
        sign = "" if x.runs_on else "," if goes_on else "."
        if whole.recorded:
            return self.medium.aligned(whole.shown or whole.recorded, sign)
        parts = [formula(y) for y in re.split(r",\s\s+", whole.text)]
        parts[-1] += literal(sign)
        return self.medium.display(reduce(lambda x, y: x + literal(r",\qquad ") + y, parts))

    def words(self, text: Words) -> str:
        """A sentence, its formulas set; a long one of a record stands apart, with the sign behind
        it."""
        found, left = "", [*text]
        while left:
            x = left.pop(0)
            if not isinstance(x, Formula) or not x.condition or len(x.text) <= AMONG:
                found += self.part(x)
                continue
            shown = formula(x.text + x.value)
            if left and isinstance(left[0], str) and (sign := SIGNS.match(left[0])):
                shown += literal(sign[0].strip())
                left[0] = left[0][sign.end() :]
            found += self.medium.apart.format(self.medium.display(shown))
        return found

    def part(self, x: str | Formula) -> str:
        """A formula, or words, of a sentence."""
        if isinstance(x, Formula):
            return self.medium.inline(formula(x.text + x.value))
        return self.medium.text(x) if isinstance(x, Given) else self.plain(x)

    def plain(self, words: str) -> str:
        """Words with their emphasis and their numbers of blocks; spaces at their ends stay."""
        found, at = [], 0
        for mark in MARKED.finditer(words):
            before = words[at : mark.start()]
            found.append(self.spaced(TIED.sub(NO_BREAK[0], before) if mark[2] else before))
            if mark[1]:
                typed = mark[1].startswith(COMMAND)
                form = self.medium.command if typed else self.medium.emphasis
                found.append(form.format(self.medium.text(mark[1])))
            else:
                where = {"label": mark[2], "number": self.numbers[mark[2]]}
                found.append(self.medium.reference.format(**where))
            at = mark.end()
        return "".join((*found, self.spaced(words[at:])))

    def spaced(self, words: str) -> str:
        """Words in the medium, with the spaces before and after."""
        words = MEASURED.sub(rf"\1{NO_BREAK[0]}", words)
        if self.language.name == "fr":
            words = LISTED.sub(NO_BREAK[0], typeset_french(words))
        inside = words.strip(" ")
        before, _, after = words.partition(inside) if inside else (words[:1], "", "")
        return f"{before}{self.medium.text(inside)}{after}"


def formula(text: str) -> typeset.Formula:
    """A formula as it is typed: sides that are expressions by their trees, others as spelt."""
    signs = RELATION.findall(text)
    sides = RELATION.split(text)
    found = _side(sides[0])
    for sign, side in zip((x.strip() for x in signs), sides[1:], strict=True):
        among = sign in "∈↦"
        found += literal(f" {SYMBOLS.get(sign, sign)} ") + (spelt(side) if among else _side(side))
    return found


def _side(text: str) -> typeset.Formula:
    try:
        return of_tree(tree_of(text), LETTERS)
    except FormulaError:
        return spelt(text)
