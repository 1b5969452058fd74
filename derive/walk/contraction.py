"""dϖ(X, ·) for an unknown vector X with δt = 1, and what its vertical part says of X.

On a vertical δ′ (δ′t = 0, δ′g = 0) dϖ(X, δ′) is the metric between the velocity of X and that of
the motion, so on the kernel the two agree: X is a *second-order* field.  What then remains gives
the accelerations.  One code for the three forms of dϖ: in space, trivialised, in vectors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from ..algebra.calculus import substitute, terms_with, without
from ..algebra.space import hat
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, number, word
from ..language.read import read
from ..language.tree import Tree
from ..record.record import Equation, Hypothesis, Step
from ..record.sentence import Sentence
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .factorisation import factored_tree
from .regularity import vertical_metric
from .wording import phrase, say, say_signed

CONTRACTION = read("dϖ(X, δ′y)")
REGULAR = phrase("second_order.displacement_signed")
"""The words for a metric that is not degenerate, of any group."""
CONTRACTED = Equation("δt", 1)
"""δt(X) = 1: the components of X are written as those of δ."""
AND = "{first} and {second}"


class NoKernelError(ValueError):
    """A dϖ whose kernel is not the motion: a rule of the engine is wrong."""


@dataclass(frozen=True)
class Contraction:
    """dϖ(X, ·) for an unknown X, where ``form`` = dϖ(δ, δ′); ``core``: its terms without δt, δ′t,
    to be written with ``images``.

    ``velocity``: δx ↦ its value on the kernel, for δt = 1; ``acceleration``: δv ↦ v̇; ``vertical``:
    the letters δ′v; ``times``: δt and δ′t; ``display``: how letters read once X has its velocity;
    ``opening``: what is worked out then. ``resting``: δ′v ↦ δ′x, tangent vectors of ``space``.
    """

    form: Expr
    core: Expr
    images: Mapping[Letter, Expr]
    velocity: Mapping[Letter, Expr]
    acceleration: Mapping[Letter, Letter]
    vertical: tuple[Letter, ...]
    times: tuple[Letter, Letter]
    notation: WordNotation
    display: Mapping[Letter, Tree] = field(default_factory=dict)
    opening: Callable[[Expr], Expr] = lambda e: e
    resting: Mapping[Letter, Letter] = field(default_factory=dict)
    space: str = "𝔤"

    @property
    def _now(self) -> dict[Letter, Expr]:
        return {self.times[0]: number(1)}

    @cached_property
    def _shifts(self) -> dict[Letter, Expr]:
        return {x: substitute(y, self._now) for x, y in self.images.items()}

    def whole(self, d: Draft) -> Tree:
        """The tree of dϖ(δ, δ′)."""
        return factored_tree(d, self.form, self.core, self.images, self.notation)

    def marked_by(self, d: Draft) -> Contraction:
        """The same contraction, its expressions marked as made by a step."""
        images = {x: d.mark(y) for x, y in self.images.items()}
        return replace(self, form=d.mark(self.form), images=images)

    def any_vector(self, d: Draft) -> Tree:
        """The tree of dϖ(X, δ′), in which δt(X) = 1 and the other components of X are those
        of δ."""
        form = substitute(self.form, self._now)
        return factored_tree(d, form, self.core, self._shifts, self.notation)

    def on_vertical(self, d: Draft) -> Tree:
        """The tree of dϖ(X, ·) on variations of the velocity alone, δ′t = 0 and δ′g = 0.

        ``NoKernelError`` if it does not vanish for the velocity of the motion.
        """
        vertical = terms_with(without(self.form, self.times[1]), *self.vertical)
        vertical = substitute(vertical, self._now)
        if substitute(vertical, self.velocity):
            raise NoKernelError("the kernel of dϖ has not the velocity of the motion")
        shifts = {x: y for x, y in self._shifts.items() if x in self.velocity}
        core = terms_with(self.core, *self.vertical)
        return factored_tree(d, vertical, core, shifts, self.notation)

    def at_rest(self) -> tuple[Equation, ...]:
        """The equations δ′t = 0 and δ′x = 0 of a variation of the velocity alone."""
        return tuple(Equation(x.name, 0) for x in (self.times[1], *self.resting.values()))

    def rates(self) -> tuple[str, ...]:
        """The names of the accelerations."""
        return tuple(dict.fromkeys(x.name for x in self.acceleration.values() if x.axis is None))

    def metric(self) -> Hypothesis:
        """The hypothesis that the metric of the kinetic energy, read off the vertical part of dϖ,
        is not degenerate."""
        vertical = terms_with(without(self.form, *self.times), *self.vertical)
        hats = {hat(x): word(hat(y)) for x, y in self.resting.items() if y.cols == 1}
        images = {x: word(y) for x, y in self.resting.items()} | hats
        return vertical_metric(vertical, images, self.notation, self.space)

    @cached_property
    def _along(self) -> dict[Letter, Expr]:
        rates = {x: word(y) for x, y in self.acceleration.items()}
        return {**self._now, **self.velocity, **rates}

    @cached_property
    def second_order(self) -> Expr:
        """dϖ(X, δ′) for X with the velocity of the motion."""
        return self.opening(substitute(self.form, self._along))

    @cached_property
    def shifts(self) -> dict[Letter, Expr]:
        """The letters δ′x ↦ δ′x − ẋ δ′t and v̇ ↦ v̇ − F̃, for X with the velocity of the motion, as
        far as dϖ is written with them."""
        rates = {
            dot: substitute(self.images[x], self._along)
            for x, dot in self.acceleration.items()
            if x in self.images
        }
        hidden = {*self.velocity, *self.acceleration, *self.vertical}
        return {x: y for x, y in self.images.items() if x not in hidden} | rates

    @cached_property
    def remaining_core(self) -> Expr:
        """The terms of the core with accelerations, for X with the velocity of the motion."""
        core = self.opening(substitute(without(self.core, *self.vertical), self._along))
        return terms_with(core, *self.acceleration.values())

    def remaining(self, d: Draft) -> Tree:
        """The tree of dϖ(X, δ′) for X with the velocity of the motion."""
        display = {**self.notation.display, **self.display}
        notation = replace(self.notation, display=display)
        return factored_tree(d, self.second_order, self.remaining_core, self.shifts, notation)


def velocities(d: Draft, along: Mapping[Letter, Expr], letters: Iterable[Letter]) -> list[Equation]:
    """The equations δx(X) = ẋ for these letters δx."""
    return [Equation(read(f"{x.name}(X)"), d.tree(along[x])) for x in letters]


def rate(dotted: str, varied: str) -> Sentence:
    """The sentence “v̇ is δv(X)”."""
    return phrase("second_order.rate", rate=dotted, value=f"{varied}(X)")


def steps_of(
    forms: Sequence[Contraction],
    known: Iterable[Letter],
    unknown: Sentence,
    rates: Sentence,
    a: Alphabet,
    chapter: Chapter,
    paper: tuple[int, ...] = (),
    regular: Sentence = REGULAR,
) -> tuple[Contraction, tuple[Step, ...]]:
    """The steps ``contraction``, ``vertical`` and ``second_order``: X put into dϖ, its vertical
    part, and what remains once the velocity is known.

    ``forms``: how dϖ is written, the last of them by velocities; ``known``: the letters whose
    values on X are told; ``a``: the alphabet. Also: the first form as these steps say it.
    """
    putting = chapter.draft("contraction", "contraction")
    testing = chapter.draft("vertical", "restriction")
    finding = chapter.draft("second_order", "kernel")
    first = putting.step(
        [Equation(CONTRACTION, x.any_vector(putting)) for x in forms],
        say("contraction.extremals")
        + say(
            "contraction.unknown",
            unknown=unknown,
        ),
        where=(CONTRACTED,),
    )
    forms = [x.marked_by(putting) for x in forms]
    last = forms[-1]
    second = testing.step(
        [Equation(CONTRACTION, x.on_vertical(testing)) for x in forms],
        say("vertical.velocity"),
        where=(CONTRACTED, *last.at_rest()),
    )
    found = {x: testing.mark(y) for x, y in last.velocity.items()}
    forms = [replace(x, velocity=found) for x in forms]
    along = velocities(finding, found, known)
    third = finding.step(
        (*along, *(Equation(CONTRACTION, x.remaining(finding), x.rates()) for x in forms)),
        say_signed("second_order.velocity", a.signed, regular=regular, rates=rates),
        paper,
        along,
        (last.metric(),),
    )
    return forms[0], (first, second, third)
