"""What is read off the motion: places, their velocities and accelerations, and what sensors read of
these, under the names of the problem."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ...algebra.calculus import derivation, gradient, substitute
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, word
from ...language.tree import Tree, add, mul, names, neg, nodes, operands, replaced
from ...problem.fields import angular_velocity
from ...problem.problem import Problem
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose, Sentence, listed
from ...schema.motion_kinds import (
    AccelerationOutput,
    DirectionOutput,
    DistanceOutput,
    ExpressionOutput,
    MomentumOutput,
    Output,
    PlaceOutput,
    PowerOutput,
    RateOutput,
    SpecificForceOutput,
    TensionOutput,
    VelocityOutput,
)
from ...schema.potential_kinds import Gravity, Spring, gravity
from ..chapter import Chapter, Draft, Steps, phrase, say
from ..matrices.isomorphism import ZETA, ZETA_DOT, HatMap
from ..spine.alphabet import Alphabet
from ..spine.lagrangian import sum_over
from .potential_terms import column, in_space, place

Images = Mapping[Letter, Expr]
RATES = (ZETA_DOT, Letter("ẇ", 3))
"""Where these are read, the equations of motion are solved before."""


def of_matrices(
    problem: Problem,
    group: Group,
    b: Alphabet,
    C: Expr,
    solved: tuple[Step, ...],
    power: Steps,
    c: Chapter,
) -> tuple[Step, ...]:
    """The step of the outputs, none where there are none, after the equations of motion are
    ``solved``: for Ż, where these have the coordinates alone, the equation that says it by them.
    ``C``: ĀA, as a step says it; ``power``: the step that says what acts by it."""
    by_coordinates = not any(e.lhs == b.Z.acceleration.name for s in solved for e in s.equations)
    rates = stated("Ż = Σ_a ζ̇_a E_a") if by_coordinates else []
    return _Observed(problem, group, b, C, {}, power, c).steps(solved, rates)


def of_vectors(
    problem: Problem,
    group: Group,
    b: Alphabet,
    C: Expr,
    hat_map: HatMap,
    motion: Step,
    power: Steps,
    c: Chapter,
) -> tuple[Step, ...]:
    """The same in R³, where Z = j(ζ)."""
    images = {b.Z.velocity: hat_map.hatted(ZETA), b.Z.acceleration: hat_map.hatted(ZETA_DOT)}
    return _Observed(problem, group, b, C, images, power, c).steps((motion,), [])


def equation_of(problem: Problem, x: Output, found: Sequence[Tree]) -> Equation:
    """The numbers of an output: of a vector together where it is one of words."""
    names = tuple(("par", name) for name in problem.numbers_of_output(x))
    if len(found) == 1:
        return Equation(names[0] if len(names) == 1 else column(names), found[0])
    return Equation(column(names), column(tuple(found)))


def in_words(problem: Problem, x: Output) -> Sentence:
    """An output in words."""
    frame = f"_{x.frame}" if hasattr(x, "frame") else ""
    if isinstance(x, SpecificForceOutput):
        others = [p for p in problem.potentials if not isinstance(p, (Gravity, Spring))]
        frame = "_in_fields" if others else ""
    places = {"name": f"‘{x.name}’"}
    if at := getattr(x, "on", None):
        places["point"] = f"r_{at}"
        frame = "_at" if isinstance(x, ExpressionOutput) else frame
    if isinstance(x, DistanceOutput) and x.other_end:
        frame, places["other"] = "_between", f"r_{x.other_end}"
    if isinstance(x, PowerOutput):
        frame = "" if x.of else "_whole"
        places |= {"of": f"‘{x.of}’"} if x.of else {}
    return phrase(f"output.{x.kind}{frame}", **places)


def prose_of(problem: Problem) -> Prose:
    """The sentence that says what is read off."""
    told = [in_words(problem, x) for x in problem.outputs]
    return say("output.read", outputs=listed("{first}; {second}", told))


def read_off(power: Sequence[Step], name: str | None) -> Tree:
    """The power of what acts by a name, or of all that acts, as the step ``power`` says it."""
    (step,) = power
    apart = [e.lhs for e in step.equations if isinstance(e.lhs, tuple)]
    if not apart:  # one thing acts
        first = next(e.rhs for e in step.equations if e.lhs == "ḣ")
        terms = operands(first) if isinstance(first, tuple) and first[0] == "add" else (first,)
        return add(*(x for x in terms if not {"∂ₜŨ", "∂ₜL̃"} & {*names(x)}))
    if name is None:
        return add(*apart)
    return next(x for x in apart if str(x[1])[1:].lstrip("_") == name.lstrip("_"))


class _Observed:
    """The outputs of one problem in letters of its group; ``images``: what stands for some of
    them."""

    def __init__(
        self,
        problem: Problem,
        group: Group,
        b: Alphabet,
        C: Expr,
        images: Images,
        power: Steps,
        c: Chapter,
    ):
        self.problem, self.group, self.b, self.C, self.images = problem, group, b, C, images
        self.power_step = power
        self.draft: Draft = c.draft("outputs", "output")
        turned = word(b.Z.velocity) * word(b.r_i)
        self.velocity = turned + word(b.w.velocity) if b.affine else turned
        rates = {b.Z.velocity: word(b.Z.acceleration), b.w.velocity: word(b.w.acceleration)}
        u = Letter("u", b.n)
        self.acceleration = word(b.Z.velocity) * word(u) + derivation(self.velocity, rates.get)
        self.notation = WordNotation(display={u: tree_of(substitute(self.velocity, images))})
        self.read: dict[type[Output], Callable[..., Sequence[Tree]]] = {
            PlaceOutput: lambda x: self.seen(x, in_space(x.on)),
            VelocityOutput: lambda x: self.moving(x, _velocity(x.on), self.velocity),
            AccelerationOutput: lambda x: self.moving(x, _acceleration(x.on), self.acceleration),
            SpecificForceOutput: self.specific_force,
            RateOutput: self.rate,
            DirectionOutput: self.direction,
            DistanceOutput: self.distance,
            MomentumOutput: self.momentum,
            TensionOutput: self.tension,
            PowerOutput: self.power,
            ExpressionOutput: lambda x: x.y,
        }

    def steps(self, solved: Sequence[Step], rates: Sequence[Equation]) -> tuple[Step, ...]:
        """The step: v_i and v̇_i of what is read, then each output; ``rates``: of what v̇_i
        needs."""
        outputs = self.problem.outputs
        if not outputs:
            return ()
        given = [equation_of(self.problem, x, self.read[type(x)](x)) for x in outputs]
        named = {x for e in given for x in nodes(e.rhs)}
        listed_places = range(1, self.problem.masses + len(self.problem.places) + 1)
        moved = [i for i in listed_places if _velocity(i) in named]
        pushed = [i for i in listed_places if _acceleration(i) in named]
        equations = [Equation(_velocity(i), self._in_space(self.velocity, i)) for i in moved]
        rated = {x.name for x in (*RATES, self.b.Z.acceleration)}
        if pushed or not rated.isdisjoint(named):
            self.draft.depends_on(*solved)
            equations += rates
        equations += [
            Equation(_acceleration(i), self._in_space(self.acceleration, i)) for i in pushed
        ]
        return (self.draft.step([*equations, *given], prose_of(self.problem)),)

    # -- velocities and accelerations of places: A u of u = Z r_i + w, and of Zu + du/dt -----------

    def _in_space(self, u: Expr, i: int) -> Tree:
        """A u at a place."""
        return mul("A", self._at(u, i))

    def _in_body(self, u: Expr, i: int = 0) -> Tree:
        """ĀA u, along the axes of the body."""
        return self._at(u if self.b.unit == self.C else self.C * u, i)

    def _at(self, u: Expr, i: int) -> Tree:
        self.draft.depends_on(self.C)
        found = self.draft.tree(substitute(u, self.images), self.notation)
        return replaced(found, self.b.r_i.name, ("at", "r", i))

    # -- what is read of them --------------------------------------------------------------------

    def seen(self, x: Output, vector: Tree) -> Sequence[Tree]:
        """A vector of space in the frame of an output: in words, in a product by its entries."""
        in_body = getattr(x, "frame", "body") == "body"
        if not self.group.factors:
            return (mul(("T", "A"), vector) if in_body else vector,)
        first, factor = self._block(x)
        span = range(1, factor.n + 1)
        entries = [_entry(vector, first + k) for k in span]
        if not in_body:
            return entries
        columns = [[("entry", "A", first + j, first + k) for j in span] for k in span]
        return [add(*map(mul, a, entries)) for a in columns]

    def moving(
        self, x: VelocityOutput | AccelerationOutput | SpecificForceOutput, vector: Tree, u: Expr
    ) -> Sequence[Tree]:
        """The vector A u of a place in the frame of an output, by u itself in the body."""
        in_body = getattr(x, "frame", "body") == "body"
        if in_body and not self.group.factors:
            return (self._in_body(u, x.on),)
        return self.seen(x, vector)

    def _block(self, x: Output) -> tuple[int, Group]:
        return self.group.places[self.problem.block_of(x.plain()) - 1]

    def _embedded(self, x: Output, entries: Sequence[Tree]) -> Tree:
        """A vector of the space of an output's block as a column of all spaces."""
        return column(self.group.in_block(self.problem.block_of(x.plain()), entries))

    def specific_force(self, x: SpecificForceOutput) -> Sequence[Tree]:
        """Ā(v̇_i − γ), γ the sum of what gravity is everywhere."""
        read = self.moving(x, _acceleration(x.on), self.acceleration)
        falling = gravity(self.problem.potentials)
        if falling is None:
            return read
        weight = self.seen(x, self._embedded(x, falling))
        return [add(a, neg(b)) for a, b in zip(read, weight, strict=True)]

    def rate(self, x: RateOutput) -> Sequence[Tree]:
        """ζ, or its components in entries of Z."""
        return ["ζ"] if self.group.turns_space else angular_velocity(self.group, x.block)

    def direction(self, x: DirectionOutput) -> Sequence[Tree]:
        """A d, or Ād."""
        there = self._embedded(x, x.direction)
        if x.frame == "body":
            return self.seen(x, there)
        if not self.group.factors:
            return (mul("A", there),)
        first, factor = self._block(x)
        span = range(1, factor.n + 1)
        rows = [[("entry", "A", first + j, first + k) for k in span] for j in span]
        return [add(*map(mul, row, x.direction)) for row in rows]

    def distance(self, x: DistanceOutput) -> Sequence[Tree]:
        """‖r_i(t) − r_j(t)‖, or that to a point of space."""
        return (self._length(x.on, x.other_end, x.anchor),)

    def momentum(self, x: MomentumOutput) -> Sequence[Tree]:
        """Σ m_i v_i over the points of a block; by the moments of the body where there is one."""
        b = self.b
        if self.group.factors:
            points = range(1, self.problem.masses + 1)
            inside = [i for i in points if self.problem.block(i) == x.block]
            return self.seen(x, add(*(mul(("at", "m", i), _velocity(i)) for i in inside)))
        moments = {(b.m_i, b.r_i): word(b.c), (b.m_i,): word(b.m)}
        along = word(direction := Letter("x", b.n))
        work = sum_over(word(b.m_i) * inner(self.velocity, along), {b.m_i, b.r_i}, moments)
        total = gradient(work, direction)
        return (self._in_body(total) if x.frame == "body" else self._in_space(total, 0),)

    def tension(self, x: TensionOutput) -> Sequence[Tree]:
        """k (‖d‖ − length), d the difference of the ends."""
        spring = self.problem.potentials[x.of - 1]
        assert isinstance(spring, Spring)
        length = self._length(*spring.ends, spring.anchor)
        return (mul(spring.stiffness, add(length, neg(spring.length))),)

    def power(self, x: PowerOutput) -> Sequence[Tree]:
        """P of what acts by a name, or the sum of all."""
        self.draft.depends_on(*self.power_step)
        return (read_off(self.power_step, x.of),)

    def _length(self, i: int, j: int | None, anchor: Sequence[Tree] | None) -> Tree:
        """The length of what is between a point and another, or a point of space."""
        other = place(self.problem, j) if j else column(tuple(anchor or ()))
        return ("fun", "sqrt", ("norm2", add(place(self.problem, i), neg(other))))


def _velocity(i: int) -> Tree:
    return ("at", "v", i)


def _acceleration(i: int) -> Tree:
    return ("at", "v̇", i)


def _entry(vector: Tree, k: int) -> Tree:
    """Entry k of a vector, a sum of multiples by numbers; of a column what stands there."""
    match vector:
        case ("add", *terms):
            return add(*(_entry(x, k) for x in terms))
        case ("mul", *factors, last):
            return mul(*factors, _entry(last, k))
        case ("matrix", *rows):
            entry: Tree = rows[k - 1][1]
            return entry
    return ("entry", vector, k)
