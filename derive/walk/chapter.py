"""A part of a record, a step in the making, and the road as a table of stages that is run."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from functools import cache, reduce
from pathlib import Path
from typing import Any

from ..algebra.word_trees import PLAIN, WordNotation, tree_of
from ..algebra.words import Expr
from ..language.tree import Tree
from ..problem.problem import ProblemError
from ..record import sentence
from ..record.prose import message
from ..record.record import ANY_GROUP, Equation, Hypothesis, Step
from ..record.sentence import Claim, Prose, Sentence, conditions, rendered
from ..record.uses import position_of
from ..record.vocabulary import DERIVATIVE_OF, VOCABULARY


@dataclass(frozen=True)
class Chapter:
    """A part of a record: ``name`` prefixes the labels of its steps, whose equations hold on
    ``scope``; ``driven``: does an input or damping act in them?"""

    name: str
    scope: str = ANY_GROUP
    driven: bool = False

    def with_input(self) -> Chapter:
        """The same chapter for steps in which an input or damping acts."""
        return replace(self, driven=True)

    def label(self, short: str) -> str:
        """The label of a step of this chapter: ``so3.kernel`` for ``kernel``."""
        return f"{self.name}.{short}"

    def draft(self, label: str, rule: str, *made_from: Expr | Step) -> Draft:
        """A step of this chapter in the making, by its label without the chapter and its rule, and
        what it is made from: expressions, or other steps."""
        found = Draft(self, self.label(label), rule)
        found.depends_on(*made_from)
        return found


class Draft:
    """A step in the making: it notes what each expression that it writes was made from."""

    def __init__(self, chapter: Chapter, label: str, rule: str):
        self.chapter, self.label, self.rule = chapter, label, rule
        self.uses: dict[str, None] = {}
        self.claims: list[Claim] = []
        begin(label, rule)

    def depends_on(self, *made: Expr | Step) -> None:
        """Note among the uses of this step what an expression was made from, or another step."""
        for x in made:
            marks = (x.label,) if isinstance(x, Step) else sorted(x.lineage)
            self.uses |= dict.fromkeys(marks)

    def tree(self, e: Expr, notation: WordNotation = PLAIN) -> Tree:
        """The tree of an expression, whose origin is noted among the uses of this step."""
        self.depends_on(e)
        return tree_of(e, notation)

    def claim(self, key: str, **places: Tree | Sentence) -> Prose:
        """A sentence of this step that says more than its equations, by its key, and the values or
        phrases in its places; it is noted among the claims of the step."""
        phrases = {name: x for name, x in places.items() if isinstance(x, Sentence)}
        values = ((name, x) for name, x in places.items() if not isinstance(x, Sentence))
        self.claims.append(Claim(key, tuple(values)))
        return (rendered(self.claims[-1], **phrases),)

    def step(
        self,
        equations: Iterable[Equation],
        prose: Prose,
        paper: Sequence[int] = (),
        where: Iterable[Equation] = (),
        hypotheses: Iterable[Hypothesis] = (),
    ) -> Step:
        """The step, finished: its equations hold where those of ``where`` and its ``hypotheses``
        do."""
        written = tuple(equations)  # before the uses are read off, for it may be a generator
        c = self.chapter
        end(self.label, self.rule)
        return Step(
            self.label,
            self.rule,
            tuple(self.uses),
            written,
            prose,
            tuple(paper),
            c.scope,
            tuple(where),
            c.driven,
            tuple(hypotheses),
            (*self.claims, *conditions(prose)),
        )

    def mark(self, e: Expr) -> Expr:
        """The same expression, marked as made by this step: who uses it uses this step."""
        return e.marked(self.label)


# What a step uses: the steps that its equations were made from, and those from which it has its
# names.

FREE = ("letter", "value on X", "function")
"""Roles of the names that the walk starts from, which no equation gives."""
OPERATORS = ("δ", "δ′", "d/dt", "∫", "grad")
"""The functions that the walk starts from."""


def traced(steps: Iterable[Step]) -> tuple[Step, ...]:
    """The steps in the order of the record, with ``uses`` completed: every name comes from one of
    these.

    A name that is in none of the steps used comes from the first step that speaks of it.
    """
    order: dict[str, int] = {}
    spoken: dict[str, set[str]] = {}
    first: dict[str, str] = {}
    found = []
    for step in steps:
        here = {x for e in step.equations for side in (e.lhs, e.rhs) for x in subjects(side)}
        heard = set().union(*(spoken[x] for x in step.uses))
        naming = {first[x] for x in here - heard if x in first}
        uses = sorted({*step.uses, *naming}, key=order.__getitem__)
        order[step.label], spoken[step.label] = len(order), here
        first |= dict.fromkeys(here - {*first}, step.label)
        found.append(replace(step, uses=tuple(uses)))
    return tuple(found)


def subjects(t: Tree) -> Iterator[str]:
    """The names that a tree speaks of, without those that the walk starts from; ``m_`` of a member
    m_i."""
    if isinstance(t, str):
        x = DERIVATIVE_OF.get(t, t)
        if _is_defined(x, "value") or _is_defined(x, "function"):
            yield x
    elif isinstance(t, tuple) and t[0] == "at":
        if _is_defined(str(t[1]), "member"):
            yield f"{t[1]}_"
    elif isinstance(t, tuple) and t[0] != "par":
        for part in t[1:]:
            yield from subjects(part)


@cache
def _is_defined(name: str, way: str) -> bool:
    """Is a name, in this position, given by an equation, not one that the walk starts from?"""
    uses = VOCABULARY[name].uses if name in VOCABULARY else ()
    roles = [use.role for use in uses if position_of(use.type) == way]
    free = FREE if name in OPERATORS or way != "function" else FREE[:2]
    return not {*roles} <= {*free}


# A road as a table of stages that is run: each takes values of those before it, and gives one.

Steps = tuple[Step, ...]
Values = dict[str, Any]
"""What is known on the way, by name: what the road starts from, then what each stage gives; under
``steps`` the steps that they took, in order."""


@dataclass(frozen=True)
class Stage:
    """A row of the table: ``run`` of the values that ``takes`` names gives ``name``, of the type
    ``gives``.

    ``takes``: names, and fields of them as ``pullback.moments``; with ``?`` one that may be
    missing. Where another is missing, the stage gives nothing. ``on``: the kind of road that has
    this stage; all have one without.
    """

    name: str
    takes: str
    gives: str
    run: Callable[..., Any]
    on: str = ""

    def value(self, values: Mapping[str, Any]) -> Any:
        """What the stage makes of these values; ``None`` where something that it takes is
        missing."""
        taken = [(_found(x.rstrip("?"), values), x.endswith("?")) for x in self.takes.split()]
        if any(x is None and not optional for x, optional in taken):
            return None
        return self.run(*(x for x, _ in taken))


def _found(path: str, values: Mapping[str, Any]) -> Any:
    """A value by its name, or a field of it; ``None`` where there is none."""
    name, *fields = path.split(".")
    return reduce(lambda x, field: x if x is None else getattr(x, field), fields, values.get(name))


def follow(road: Iterable[Stage], start: Mapping[str, Any], kinds: Collection[str]) -> Values:
    """The values of the stages of a road of these ``kinds``, after those that it starts from."""
    values, steps = {**start}, list[Step]()
    for stage in road:
        if not stage.on or stage.on in kinds:
            found = values[stage.name] = stage.value(values)
            steps += _steps_of(found)
    return values | {"steps": tuple(steps)}


def _steps_of(value: Any) -> Steps:
    """The steps in what a stage gave: a step, a tuple of them, or the field ``steps``."""
    if isinstance(value, Step):
        return (value,)
    return value if isinstance(value, tuple) else getattr(value, "steps", ())


# An error of the engine names the step on whose way it came about.

BROKEN = (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError)
"""The errors in which a rule may end that makes something else of an equation."""
SHOWN = 200
"""As many letters of a message are quoted."""


class WalkError(Exception):
    """An error of the engine: one of its rules is wrong, and no problem is at fault."""


@dataclass
class Way:
    """The steps that are begun, with their rules, and the one that was ended last."""

    begun: dict[str, str] = field(default_factory=dict)
    last: str = ""

    def describe(self, error: Exception) -> str:
        """Where on the way an error came about, and what it is, as one text."""
        steps = " or ".join(f"{label} ({rule})" for label, rule in self.begun.items())
        before = f"after the step {self.last}" if self.last else "before the first step of its own"
        place = f"in the step {steps}" if steps else before
        what = f"{type(error).__name__}: {error}"
        return f"{place}, in {_functions(error)}: {what[:SHOWN]}"


def _functions(error: Exception) -> str:
    """The functions of the walk in which an error came about, the innermost last."""
    frames = [(Path(x.filename), x.name) for x in traceback.extract_tb(error.__traceback__)]
    inside = [f"{p.stem}.{x}" for p, x in frames if Path(__file__).parent in p.parents[:-1]]
    inside = [x for x in inside if not x.startswith("chapter.")]
    return ", ".join(inside) or "the pipeline"


WAY: ContextVar[Way] = ContextVar("WAY")


def begin(label: str, rule: str) -> None:
    """Note that a step is being drafted."""
    if way := WAY.get(None):
        way.begun[label] = rule


def end(label: str, rule: str) -> None:
    """Note that a step is written."""
    if way := WAY.get(None):
        way.begun.pop(label, None)
        way.last = f"{label} ({rule})"


@contextmanager
def naming_steps() -> Iterator[None]:
    """Turn an error that the engine does not expect into ``WalkError``, which names the step."""
    way = Way()
    token = WAY.set(way)
    try:
        yield
    except ProblemError:
        raise
    except BROKEN as error:
        raise WalkError(way.describe(error)) from error
    finally:
        WAY.reset(token)


# Sentences of the walk, by the labels of their steps in prose.


def phrase(key: str, **places: Sentence | str) -> Sentence:
    """The sentence, or a part of one, of a key as ``kernel.line``, its places filled."""
    return sentence.phrase(message(key), **places)


def say(key: str, **places: Sentence | str) -> Prose:
    """One sentence as prose, by its key, its places filled."""
    return (phrase(key, **places),)


def say_signed(key: str, signed: bool, **places: Sentence | str) -> Prose:
    """The sentence for positive masses or, where they may be negative (``signed``), the other
    one."""
    return say(f"{key}_signed" if signed else key, **places)
