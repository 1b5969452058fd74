"""The principle: an extremal of the action is a curve that dϖ(X, ·) = 0 has for its tangent."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from ...algebra import calculus
from ...algebra.calculus import derivation, substitute, terms_with, without
from ...algebra.word_trees import PLAIN, WordNotation, hat, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.read import read
from ...language.tree import Tree, add
from ...record.record import Equation, Hypothesis, Step
from ...record.sentence import Sentence
from ..chapter import Chapter, Draft, phrase, say, say_signed
from ..matrices.coordinates import factored_tree
from .alphabet import Alphabet
from .cartan import Cartan, natural_variations, primes
from .lagrangian import PointLagrangian, Pullback, indexed_tree, sum_over, vertical_metric

# dϖ(X, ·) for an unknown vector X with δt = 1, and what its vertical part says of X.
#
# On a vertical δ′ (δ′t = 0, δ′g = 0) dϖ(X, δ′) is the metric between the velocity of X and that
# of the motion, so on the kernel the two agree: X is a *second-order* field. What then remains
# gives the accelerations. One code for the three forms of dϖ: in space, trivialised, in vectors.

CONTRACTION = read("dϖ(X, δ′y)")
REGULAR = phrase("second_order.displacement_signed")
"""The words for a metric that is not degenerate, of any group."""
CONTRACTED = Equation("δt", 1)
"""δt(X) = 1: the components of X are written as those of δ."""
AND = "{first} and {second}"
DT, DPT = Letter("δt"), Letter("δ′t")


class NoKernelError(ValueError):
    """A dϖ whose kernel is not the motion: a rule of the engine is wrong."""


@dataclass(frozen=True)
class Contraction:
    """dϖ(X, ·) for an unknown X, where ``form`` = dϖ(δ, δ′); ``core``: its terms without δt, δ′t,
    to be written with ``images``.

    ``velocity``: δx ↦ its value on the kernel, for δt = 1; ``acceleration``: δv ↦ v̇; ``vertical``:
    the letters δ′v; ``display``: how letters read once X has its velocity;
    ``opening``: what is worked out then. ``resting``: δ′v ↦ δ′x, tangent vectors of ``space``.
    """

    form: Expr
    core: Expr
    images: Mapping[Letter, Expr]
    velocity: Mapping[Letter, Expr]
    acceleration: Mapping[Letter, Letter]
    vertical: tuple[Letter, ...]
    notation: WordNotation = PLAIN
    display: Mapping[Letter, Tree] = field(default_factory=dict)
    opening: Callable[[Expr], Expr] = lambda e: e
    resting: Mapping[Letter, Letter] = field(default_factory=dict)
    space: str = "𝔤"

    @property
    def _now(self) -> dict[Letter, Expr]:
        return {DT: number(1)}

    @cached_property
    def _shifts(self) -> dict[Letter, Expr]:
        return {x: substitute(y, self._now) for x, y in self.images.items()}

    def tree(self, d: Draft) -> Tree:
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
        vertical = terms_with(without(self.form, DPT), *self.vertical)
        vertical = substitute(vertical, self._now)
        if substitute(vertical, self.velocity):
            raise NoKernelError("the kernel of dϖ has not the velocity of the motion")
        shifts = {x: y for x, y in self._shifts.items() if x in self.velocity}
        core = terms_with(self.core, *self.vertical)
        return factored_tree(d, vertical, core, shifts, self.notation)

    def at_rest(self) -> tuple[Equation, ...]:
        """The equations δ′t = 0 and δ′x = 0 of a variation of the velocity alone."""
        return tuple(Equation(x.name, 0) for x in (DPT, *self.resting.values()))

    def rates(self) -> tuple[str, ...]:
        """The names of the accelerations."""
        return tuple(dict.fromkeys(x.name for x in self.acceleration.values() if x.axis is None))

    def metric(self) -> Hypothesis:
        """The hypothesis that the metric of the kinetic energy, read off the vertical part of dϖ,
        is not degenerate."""
        vertical = terms_with(without(self.form, DT, DPT), *self.vertical)
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
    finding = chapter.draft("second_order", "kernel")
    forms, first, second = put_in(forms, unknown, chapter)
    last = forms[-1]
    found = last.velocity
    along = velocities(finding, found, known)
    third = finding.step(
        (*along, *(Equation(CONTRACTION, x.remaining(finding), x.rates()) for x in forms)),
        say_signed("second_order.velocity", a.signed, regular=regular, rates=rates),
        paper,
        along,
        (last.metric(),),
    )
    return forms[0], (first, second, third)


def put_in(
    forms: Sequence[Contraction],
    unknown: Sentence | str,
    chapter: Chapter,
    beside: Iterable[Equation] = (),
) -> tuple[list[Contraction], Step, Step]:
    """X put into dϖ, and its vertical part: the forms as these two steps say them, and the steps;
    ``beside``: what else is so of the second."""
    putting = chapter.draft("contraction", "contraction")
    testing = chapter.draft("vertical", "restriction")
    first = putting.step(
        [Equation(CONTRACTION, x.any_vector(putting)) for x in forms],
        say("contraction.extremals") + say("contraction.unknown", unknown=unknown),
        where=(CONTRACTED,),
    )
    forms = [x.marked_by(putting) for x in forms]
    last = forms[-1]
    second = testing.step(
        [*(Equation(CONTRACTION, x.on_vertical(testing)) for x in forms), *beside],
        say("vertical.velocity"),
        where=(CONTRACTED, *last.at_rest()),
    )
    found = {x: testing.mark(y) for x, y in last.velocity.items()}
    return [replace(x, velocity=found) for x in forms], first, second


# The principle: a lift is an extremal of the action (5), δt and δg being 0 at both ends, if and
# only if its tangent is in the kernel of dϖ.
#
# A curve t ↦ (t, g, ν) is a lift where ν = ġ. With X its tangent, δ′ is the derivative d/dt along
# it, which commutes with δ:
#
# δ[ϖ(X)] = dϖ(δy, X) + d/dt ϖ(δy).
#
# The left side is varied from L̃ alone, through lifts. No regularity is used.

ACROSS = read("dϖ(δy, X)")
LATER = Letter("d/dt δt")
"""The derivative of δt along a lift."""


@dataclass(frozen=True)
class Principle:
    """The variation of the action: ``across``: dϖ(δy, X) on lifts, which vanishes on extremals
    alone."""

    across: Expr
    steps: tuple[Step, Step]


def principle(
    points: PointLagrangian, pulled: Pullback, form: Cartan, a: Alphabet, c: Chapter
) -> Principle:
    """The variation of the action by dϖ, and what dϖ is there, d’Alembert's principle: the steps
    ``extremal`` and ``dalembert``."""
    varying, working = c.draft("extremal", "variation"), c.draft("dalembert", "contraction")
    lagrangian = pulled.kinetic - word(a.U)
    first, across = extremal(varying, lagrangian, form.form, pulled.moment_work, a)
    summand, shown = _work(points, a)
    balance = sum_over(summand, {a.m_i, a.r_i, a.F_i}, pulled.moments)
    moving = {p.position: word(p.velocity) for p in a.parts}
    if derivation(points.position, moving.get) != points.velocity:
        raise ValueError("the velocity of a point is not the derivative of its place")
    any_rate = tuple(p.acceleration.name for p in a.parts)
    across_points = add(("mul", -1, ("sum", "i", shown)), working.tree(across + balance))
    second = working.step(
        (
            Equation(read("d/dt(rᵢ(t))"), read("vᵢ")),
            Equation(
                read("d/dt(vᵢ)"), indexed_tree(_acceleration(points, a), points.v_i, a), any_rate
            ),
            Equation(ACROSS, across_points, any_rate),
        ),
        say("dalembert.extremal") + say("dalembert.points"),
        (2, 5),
        first.given,
    )
    return Principle(working.mark(across), (first, second))


def extremal(
    varying: Draft, lagrangian: Expr, form: Expr, work: Expr, a: Alphabet
) -> tuple[Step, Expr]:
    """The step ``extremal`` by L̃ and ϖ, with −dŨ(δg) = ``work``; and dϖ(δy, X) on lifts, as what
    remains of the variation of L̃."""
    twins, tangent = primes(a), tangent_of_lift(a)
    onto = {x: tangent[y] for x, y in twins.items() if y in tangent}
    excess = substitute(form, onto) - lagrangian
    delta, delta_prime = natural_variations(work, a)
    exterior = substitute(calculus.exterior(form, twins, delta, delta_prime), tangent)
    varied, rate = _varied(lagrangian, work, a), _rate(form, work, a)
    step = varying.step(
        (
            Equation(read("ϖ(X)"), add("L̃", varying.tree(excess))),
            Equation(
                read("δ(ϖ(X))"),
                add(ACROSS, read("d/dt(ϖ(δy))"), varying.tree(varied - exterior - rate)),
            ),
        ),
        say("extremal.action") + say("extremal.lifts"),
        (5, 11),
        [Equation(("call", p.d_position.name, "X"), p.velocity.name) for p in a.parts],
    )
    return step, varying.mark(varied) - rate


def tangent_of_lift(a: Alphabet) -> dict[Letter, Expr]:
    """The values of δ′ as d/dt along a lift: δ′t = 1, δ′g = ν, δ′ν = ν̇."""
    tangent = {a.dpt: number(1)}
    for p in a.parts:
        tangent |= {p.dp_position: word(p.velocity), p.dp_velocity: word(p.acceleration)}
    return tangent


def _varied(lagrangian: Expr, work: Expr, a: Alphabet) -> Expr:
    """δ(L̃ dt) / dt through lifts: ν = dg/dt, whose variation is d(δg)/dt − ν d(δt)/dt."""
    later = word(LATER)
    delta = {a.U: word(a.dU_dt) * word(a.dt) - work}
    for p in a.parts:
        delta[p.position] = word(p.d_position)
        delta[p.velocity] = word(p.second) - word(p.velocity) * later
    return derivation(lagrangian, delta.get) + lagrangian * later


def _rate(form: Expr, work: Expr, a: Alphabet) -> Expr:
    """d/dt of ϖ(δy) along a lift."""
    along = substitute(work, {p.d_position: word(p.velocity) for p in a.parts})
    rate = {a.U: word(a.dU_dt) - along, a.dt: word(LATER)}
    for p in a.parts:
        rate |= {p.position: word(p.velocity), p.velocity: word(p.acceleration)}
        rate[p.d_position] = word(p.second)
    return derivation(form, rate.get)


def _acceleration(points: PointLagrangian, a: Alphabet) -> Expr:
    """α̇ r_i + τ̇."""
    return substitute(points.velocity, {p.velocity: word(p.acceleration) for p in a.parts})


def _work(points: PointLagrangian, a: Alphabet) -> tuple[Expr, Tree]:
    """⟨m_i r̈_i − F_i, δr_i − v_i δt⟩ on words, with the acceleration at hand; and as written."""
    acceleration = _acceleration(points, a)
    varied = Letter("δr_i", a.n)
    balance = word(a.m_i) * acceleration - word(a.F_i)
    moved = word(varied) - word(points.v_i) * word(a.dt)
    members = {a.m_i: "m", a.r_i: "r", a.F_i: "F", points.v_i: "v"}
    display: dict[Letter, Tree] = {x: ("at", name, "i") for x, name in members.items()}
    notation = WordNotation(display=display | {varied: read("δ(rᵢ(t))")})
    shown: Tree = ("inner", tree_of(balance, notation), tree_of(moved, notation))
    images = {varied: points.variation, points.v_i: points.velocity}
    return inner(balance, substitute(moved, images)), shown
