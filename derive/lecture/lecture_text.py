"""The text of the lecture as data, from the files of chapters beside this one.

A chapter begins with ``chapter NAME``, its title in an English and a French line, and the records
that its ties speak of.  A block is its head, ``KIND [LABEL] ["name"]``, and entries, each two
spaces further in: a sentence in English and, below it, in French, or a display, ``= FORMULA``, the
same in both, with two spaces and … behind it where its sentence goes on without a comma; then
what it rests on::

    < so3.kernel  (34)           the steps that prove it, and the numbers of the note
    < said                       it says what letters mean, or what is supposed
    < solved                     a letter as a function of t, and its rate, which that has
    < named                      a letter is a name of what stands beside it, in all formulas
    < open  English  |  French   proved here, and no step yet

Where a reader's body has the place of the racket, the lines after a sentence that begin with ``~``
stand for it, with that body's numbers in the places ``{m1}``.

What begins with ``$`` is there for a seed alone (``fresh_numbers.py``): in an exercise ``$ = NAME =
CHOICES,  …``, its letters, each with numbers or matrices apart by ``|``, in which ``1…4`` is any
whole number between; in its solution sentences, where a formula ends in ``= #``, its value, or in
``≈ #NAME``, the value of a motion.

Formulas stand in `backquotes`, as ``derive walk`` shows them; `?Ũ = 0` is
not tried: it is supposed, sought, or true under what the text alone supposes; emphasis in
_underscores_; ``@label`` is the number of a block, or of a display that begins ``= @label``, which
has a number only so.  ``#`` begins a comment.  A figure begins with
words that describe it to those who do not see it; its caption follows.  A calculation is a line for
each step, an equation and the identity by which it holds.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from unicodedata import normalize

from ..language.limits import Refused
from ..language.read import FormulaError, read
from ..language.tree import Tree
from ..record.record import Equation
from ..views.figure.drawing import Scene
from ..views.language import LANGUAGES
from ..views.printing.letters import named_so
from ..views.printing.signs import OVERDOT

FOLDER = Path(__file__).with_name("chapters")
PROVED = ("lemma", "proposition", "theorem")
STATED = ("definition", *PROVED, "remark")
"""What is numbered in one row."""
NUMBERED = (*STATED, "exercise")
KINDS = ("text", "section", *NUMBERED, "proof", "calculation", "solution", "figure")
"""What a block may be; those of ``NUMBERED`` have a number of their own."""
HEAD = re.compile(r'([a-z]+)(?: ([a-z_]+))?(?: "([^"]+)")?')
NUMBERS = re.compile(r"\s*\((\d+(?:, \d+)*)\)$")
RELATION = re.compile(r" [=≈≠<>≤≥∈↦→] ")
FRESH = "  $ "
LABELLED = re.compile(r"(?:@([a-z_]+) )?(.*?)(  …)?")
ASKED = re.compile(r" ([=≈]) #([a-z]*)$")
SAID, SOLVED, NAMED, OPEN = "said", "solved", "named", "open"


class LectureError(Refused, ValueError):
    """A text that is none of a lecture, or claims what no step proves: where, and why."""


@dataclass(frozen=True)
class Formula:
    """A formula among the words, as it is typed, or equations of a record; ``condition``: it is not
    tried; ``value``: what is printed behind it, a value asked for or found; ``shown``: equations
    of a record as they are printed, if not as they stand there."""

    text: str
    condition: bool = False
    recorded: tuple[Equation, ...] = ()
    value: str = ""
    shown: tuple[Equation, ...] = ()

    @cached_property
    def equations(self) -> tuple[Equation, ...]:
        """What it claims: of ``a = b = c`` that a = b and b = c; no other relation is tried."""
        if self.recorded:
            return () if self.condition else self.recorded
        found: list[Equation] = []
        for part in () if self.condition else re.split(r",\s\s+", self.text):
            if " = " in part and {*RELATION.findall(part)} == {" = "}:
                sides = [*map(tree, part.split(" = "))]
                found += (Equation(a, b) for a, b in pairwise(sides))
        return tuple(found)


def tree(text: str) -> Tree:
    """The tree of an expression, in which parameters stand in ‘quotes’."""
    return _unquoted(read(text))


def _unquoted(t: Tree) -> Tree:
    if not isinstance(t, tuple):
        return t
    if t[0] == "par":
        return ("par", named_so(str(t[1]).strip("‘’")))
    return (t[0], *map(_unquoted, t[1:]))


def rate_of(t: Tree) -> Tree:
    """The rate of a momentum or of an entry, as equations have it; 0 of anything else."""
    if not isinstance(t, tuple) or t[0] not in ("at", "entry") or not isinstance(t[1], str):
        return 0
    return (t[0], normalize("NFC", t[1] + OVERDOT), *t[2:])


class Given(str):
    """Words of the user's, in which nothing is marked."""


Words = tuple[str | Formula, ...]
"""A sentence: its words, with their emphasis, and its formulas."""


@dataclass(frozen=True)
class Tie:
    """What an entry rests on: labels of steps, or ``said``, ``solved`` or ``named``, or what is
    open, in each language; and the numbers of the note."""

    labels: tuple[str, ...] = ()
    said: bool = False
    solved: bool = False
    named: bool = False
    open: tuple[str, ...] = ()
    numbers: tuple[int, ...] = ()


@dataclass(frozen=True)
class Entry:
    """A sentence in each language, or a display that is the same in all, with its ties; ``own``:
    what is said instead of a reader's body, its places not filled; ``fresh``: is it there for a
    seed alone? ``label``: of a display that is cited; ``runs_on``: does no sign end the display?"""

    texts: tuple[Words, ...]
    ties: tuple[Tie, ...]
    display: bool
    line: int
    own: tuple[Words, ...] = ()
    fresh: bool = False
    label: str = ""
    runs_on: bool = False

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """The formulas of the entry, in the first language."""
        return tuple(x for x in self.texts[0] if isinstance(x, Formula))

    @property
    def equations(self) -> tuple[Equation, ...]:
        """All that its formulas claim."""
        return tuple(e for x in self.formulas for e in x.equations)

    @property
    def solved(self) -> bool:
        """Does it have a function of the time, with the rate that it satisfies?"""
        return any(tie.solved for tie in self.ties)

    @property
    def labels(self) -> tuple[str, ...]:
        """The steps that it rests on."""
        return tuple(label for tie in self.ties for label in tie.labels)


@dataclass(frozen=True)
class Block:
    """A paragraph, a statement, a proof, an exercise, …; ``title``: of a section, in each
    language, or a name as Euler's."""

    kind: str
    label: str
    title: str
    entries: tuple[Entry, ...]
    line: int


@dataclass(frozen=True)
class Chapter:
    """A chapter: its name, its title in each language, the problems of its ties, its blocks;
    ``figures``: those that are its own, by their labels, each by the equations displayed."""

    name: str
    title: tuple[str, ...]
    problems: tuple[str, ...]
    blocks: tuple[Block, ...]
    file: str = field(default="", compare=False)
    figures: Mapping[str, Callable[..., Scene]] = field(default_factory=dict, compare=False)

    @property
    def of_course(self) -> bool:
        """Is it one of the course, not of a reader's problem, whose name may be the same?"""
        return self.file in {x.name for x in FOLDER.glob("*.txt")}

    @property
    def entries(self) -> Iterator[Entry]:
        """The entries of all blocks."""
        for block in self.blocks:
            yield from block.entries

    def changed(self, of: Callable[[Entry], Entry | None]) -> Chapter:
        """The chapter with what its entries become, without those that become nothing."""
        changed = [[y for x in b.entries if (y := of(x))] for b in self.blocks]
        blocks = zip(self.blocks, changed, strict=True)
        return replace(self, blocks=tuple(replace(b, entries=tuple(x)) for b, x in blocks))


def words_of(text: str) -> Words:
    """A sentence from its line: words and, between backquotes, formulas."""
    parts = text.split("`")
    return tuple(_formula(x) if k % 2 else x for k, x in enumerate(parts) if x)


def _formula(text: str) -> Formula:
    asked = ASKED.search(text)
    whole = text[: asked.start()] if asked else text
    value = asked[0] if asked else ""
    return Formula(whole.removeprefix("?"), whole.startswith("?"), value=value)


class _Lines:
    """The lines of a chapter's file that say something, with where they stand."""

    def __init__(self, text: str, file: str):
        self.file = file
        lines = enumerate(text.split("\n"), 1)
        self.left = [(k, x) for k, x in lines if x.strip() and not x.startswith("#")]

    def wrong(self, line: int, why: str) -> LectureError:
        """The error at a line."""
        return LectureError(f"{self.file}, line {line}: {why}")

    def next(self) -> tuple[int, str]:
        """The next line, and its number."""
        if not self.left:
            raise LectureError(f"{self.file}: it ends where a line is needed")
        return self.left.pop(0)

    def inside(self) -> bool:
        """Does the next line belong to the block?"""
        return bool(self.left) and self.left[0][1].startswith("  ")


def parsed(text: str, file: str = "a chapter") -> Chapter:
    """The chapter of a file's text; ``LectureError`` names the line that is wrong."""
    lines = _Lines(text, file)
    line, head = lines.next()
    kind, _, name = head.partition(" ")
    if kind != "chapter":
        raise lines.wrong(line, f"a chapter begins with 'chapter NAME', not {head[:40]!r}")
    title = tuple(lines.next()[1].strip() for _ in LANGUAGES)
    line, records = lines.next()
    kind, *problems = records.split()
    if kind != "records":
        raise lines.wrong(line, "after its title a chapter has 'records PROBLEM …'")
    blocks = []
    while lines.left:
        blocks.append(_block(lines))
    return Chapter(name, title, tuple(problems), tuple(blocks), file)


def _block(lines: _Lines) -> Block:
    line, head = lines.next()
    found = HEAD.fullmatch(head)
    if not found or found[1] not in KINDS:
        raise lines.wrong(line, f"no block: {head[:60]!r}; blocks are {', '.join(KINDS)}")
    entries = []
    while lines.inside():
        entries.append(_entry(lines))
    if found[1] == "figure" and (len(entries) < 2 or entries[0].formulas):
        raise lines.wrong(line, "a figure begins with a description in words, then its caption")
    return Block(found[1], found[2] or "", found[3] or "", tuple(entries), line)


def _entry(lines: _Lines) -> Entry:
    line, first = lines.next()
    fresh = first.startswith(FRESH)
    first = first.replace(FRESH, "  ", 1) if fresh else first
    display, label, runs_on = first.startswith("  = "), "", False
    if display:
        labelled = LABELLED.fullmatch(first[4:].strip())
        assert labelled is not None
        label, runs_on, mark = labelled[1] or "", bool(labelled[3]), "?" if fresh else ""
        texts: Sequence[Words] = [words_of(f"`{mark}{labelled[2]}`")] * len(LANGUAGES)
    else:
        other = lines.next()[1]
        texts = [words_of(first.strip()), words_of(other.removeprefix(FRESH).strip())]
    own, ties = [], []
    while lines.left and lines.left[0][1].startswith("  ~ "):
        own.append(words_of(lines.next()[1][4:].strip()))
    while lines.left and lines.left[0][1].startswith("  < "):
        number, text = lines.next()
        ties.append(_tie(text[4:].strip(), number, lines))
    found = Entry(tuple(texts), tuple(ties), display, line, tuple(own), fresh, label, runs_on)
    if len(own) not in (0, len(texts)):
        raise lines.wrong(line, "after ~ a sentence in each language")
    for one in (found, replace(found, texts=found.own)) if own else (found,):
        _agreeing(one, lines)
    return found


def _agreeing(entry: Entry, lines: _Lines) -> None:
    """The same formulas in all languages, each of them one."""
    said = [sorted(x.text for x in text if isinstance(x, Formula)) for text in entry.texts]
    if said[0] != said[1]:
        differing = sorted({*said[0]} ^ {*said[1]})
        raise lines.wrong(entry.line, f"formulas of one language alone: {', '.join(differing)}")
    try:
        claimed = entry.equations
    except FormulaError as error:
        raise lines.wrong(entry.line, str(error)) from error
    if claimed and not entry.ties:
        raise lines.wrong(entry.line, "an equation that rests on nothing: give '< STEP'")


def _tie(text: str, line: int, lines: _Lines) -> Tie:
    """What a line after ``<`` says."""
    numbers = NUMBERS.search(text)
    text = NUMBERS.sub("", text).strip()
    of_note = tuple(int(x) for x in numbers[1].split(", ")) if numbers else ()
    word, _, rest = text.partition(" ")
    if word == SAID:
        return Tie(said=True, numbers=of_note)
    if word == SOLVED:
        return Tie(solved=True)
    if word == NAMED:
        return Tie(named=True)
    if word == OPEN:
        reasons = tuple(x.strip() for x in rest.split("|"))
        if len(reasons) != len(LANGUAGES):
            raise lines.wrong(line, "what is open is said in English | and in French")
        return Tie(open=reasons, numbers=of_note)
    return Tie(tuple(text.split()), numbers=of_note)


PLACE = re.compile(r"\{(\w+)\}")


def with_places(words: Words, filled: Mapping[str, str]) -> Words:
    """A sentence, its places filled."""
    found: list[str | Formula] = []
    for x in words:
        if isinstance(x, Formula):
            found.append(replace(x, text=PLACE.sub(lambda y: filled[y[1]], x.text)))
        else:
            parts = PLACE.split(x)
            found += (filled[y] if k % 2 else y for k, y in enumerate(parts) if y)
    return tuple(found)


def of_body(
    chapter: Chapter,
    filled: Sequence[Mapping[str, str]],
    figures: Mapping[str, Callable[..., Scene]],
) -> Chapter:
    """The chapter with a reader's body in the place of the racket, by the words and numbers of that
    in each language, and its figures."""

    def own(x: Entry) -> Entry:
        return replace(x, texts=tuple(map(with_places, x.own, filled))) if x.own else x

    labels = {b.label for b in chapter.blocks}
    drawn = {x: figure for x, figure in figures.items() if x in labels}
    return replace(chapter.changed(own), figures=drawn)


def chapters(*, fresh: bool = False) -> list[Chapter]:
    """The chapters of the lecture, in the order of their files; ``fresh``: with what is there for a
    seed alone."""
    files = sorted(FOLDER.glob("*.txt"))
    found = [parsed(x.read_text(encoding="utf-8"), x.name) for x in files]
    return found if fresh else [c.changed(lambda x: None if x.fresh else x) for c in found]
