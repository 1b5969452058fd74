"""What the motion keeps by Noether's theorem, and the axis about which space may be turned."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...algebra.calculus import derivation, gradient, reduce, substitute, without
from ...algebra.groups import Group
from ...algebra.word_trees import hat, normal_form, tree_of
from ...algebra.words import Expr, Letter, inner, one, word, zero
from ...language import rational as q
from ...language.derivatives import product
from ...language.tree import Tree, add, names, neg, nodes, replaced
from ...problem.entries_on_orbit import vanishes, wedge
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose, enumerated
from ...schema.potential_kinds import Attraction, FarCentre, Harmonic, Spring, gravity
from ..chapter import Chapter, phrase, say
from ..given.body_and_potentials import U_Q, Potentials
from ..given.potential_terms import column, displaced_letters
from ..spine.alphabet import Alphabet
from .isomorphism import anticommute, vector_sum

# The line through the origin about which space may be turned without moving what a potential is
# given by: the acceleration of gravity, anchors, centres, the axes of harmonic forces; where
# these depend on the time, one along which they stay.
#
# Whether two vectors are parallel is decided by residues modulo large primes (vanishes); what is
# then claimed is checked.

Vector = tuple[Tree, ...]
UNITS = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True)
class PotentialsInSpace:
    """What the potentials are given by in space: ``vectors`` that are not 0; ``weighs``: is gravity
    one of them? ``W``: the matrix of harmonic forces."""

    n: int
    vectors: tuple[Vector, ...]
    weighs: bool
    W: tuple[Vector, ...]

    @classmethod
    def of(cls, problem: Problem) -> PotentialsInSpace:
        """Of the potentials of a problem on one space."""
        n = problem.own_group.n
        weight = _not_zero([gravity(problem.potentials)])
        places = []
        for p in problem.potentials:
            if isinstance(p, Spring):
                places.append(p.anchor)
            elif isinstance(p, (Attraction, FarCentre)):
                places.append(p.centre)
        W = [p.W for p in problem.potentials if isinstance(p, Harmonic)]
        summed = (tuple(add(*(x[i][j] for x in W)) for j in range(n)) for i in range(n))
        vectors = (*weight, *_not_zero(places))
        return cls(n, vectors, bool(weight), tuple(summed) if W else ())

    @property
    def timed(self) -> bool:
        """Does a vector, or W, depend on the time?"""
        return any("t" in nodes(x) for v in (*self.vectors, *self.W) for x in v)

    @property
    def by_gravity(self) -> bool:
        """Is γ the vector of the line?"""
        return self.weighs and not self.timed

    def along(self, line: Vector) -> Tree:
        """The tree of a vector of the line."""
        return GAMMA.name if self.by_gravity else column(line)

    def lines(self) -> tuple[Vector, ...]:
        """A vector of R³ along each line to try: the one of all vectors, where there are some, else
        the axes that W_r may have; one that stays, an axis or where these are at some time."""
        found: Iterable[Vector] = self.vectors[:1] or (_axes(self.W) if self.W else ())
        if self.timed:
            moving = [*found]
            found = (tuple(replaced(x, "t", k) for x in v) for v in moving for k in (0, 1))
            found = (*UNITS, *found)
        pairs = ((x, [wedge(x, y) for y in self.vectors]) for x in _not_zero(found))
        return tuple(x for x, products in pairs if not _not_zero(products))

    def known(self, line: Vector | None, axis: Letter | None = None) -> dict[Letter, Expr]:
        """γ as 0 where it is, or along the letter ``axis`` x of the ``line``; W_r as w, or as
        w + v x x̄, where it is that."""
        found: dict[Letter, Expr] = {} if self.weighs else {Letter("γ", self.n): zero(self.n)}
        if self.weighs and axis == AXIS:
            found[GAMMA] = word(Letter("v_γ")) * word(axis)
        W, w, v = Letter("W_r", self.n, self.n, 1), Letter("w"), Letter("v")
        if self.W and _is_scalar(self.W):
            found[W] = word(w) * one(self.n)
        elif self.W and line and axis and _turns_into_itself(self.W, line):
            found[W] = word(w) * one(self.n) + word(v) * word(axis) * word(axis).bar
        return found


def _not_zero(vectors: Iterable[Vector | None]) -> tuple[Vector, ...]:
    return tuple(x for x in vectors if x and not all(map(_is_zero, x)))


def _is_zero(t: Tree) -> bool:
    try:
        return vanishes(t)
    except ZeroDivisionError:
        return False


def _turns_into_itself(W: Sequence[Vector], x: Vector) -> bool:
    """Is j(x)W = Wj(x), for a symmetric W: is j(x)W, whose columns are x ∧ W e_i, symmetric?"""
    turned = [wedge(x, row) for row in W]
    return all(_is_zero(add(turned[i][j], turned[j][i])) for i in range(3) for j in range(i + 1))


def _is_scalar(W: Sequence[Vector]) -> bool:
    span = range(len(W))
    other = (add(W[i][j], neg(W[0][0]) if i == j else 0) for i in span for j in span)
    return all(map(_is_zero, other))


def _axes(W: Sequence[Vector]) -> Iterator[Vector]:
    """The x for which W may be w + v x x̄: by W_ij = v x_i x_j, or with an x_i = 0, where w is
    W_ii."""
    yield from UNITS
    yield product(W[0][1], W[0][2]), product(W[0][1], W[1][2]), product(W[0][2], W[1][2])
    for i in range(3):
        for j in {0, 1, 2} - {i}:
            yield tuple(add(W[j][k], neg(W[i][i]) if j == k else 0) for k in range(3))


# What the motion keeps, by Noether's theorem: for a displacement of space that moves the group
# into itself and leaves L̃ alone, the momentum of that displacement, p̃(Yg); and the energy.
#
# The displacements are the rotations and translations of space, δg = Yg with Y = (Y, b), Y skew:
# they keep the kinetic energy whatever the group, where they belong to it. All rotations about
# the origin are tried, else those about one line (above); all translations, else those across
# gravity. All symmetries of a problem are found in ``derive.symmetries``.

GAMMA = Letter("γ", 3)
AXIS = Letter("y", 3)


@dataclass(frozen=True)
class SpaceMomenta:
    """The momenta of the displacements of space: ``turning``: ℓ, a skew matrix or, of ``vectors``,
    a vector; ``shifting``: p."""

    turning: Expr
    shifting: Expr | None
    vectors: bool


def conserved_steps(
    problem: Problem,
    v: Potentials,
    momenta: SpaceMomenta,
    motion: Step,
    b: Alphabet,
    c: Chapter,
) -> tuple[Step, ...]:
    """The step that says which of the energy, ℓ and p the motions keep; none where they keep
    none."""
    group = problem.own_group
    draft = c.draft("conserved", "conservation", motion)
    vectors = momenta.vectors
    write = vector_sum if vectors else tree_of
    kept = [Equation("ḣ", 0)] if not problem.timed else []
    laws = say("conserved.energy") if kept else ()
    definitions = []
    for x in kept_momenta(group, v, b, vectors=vectors):
        momentum = momenta.turning if x.turning else momenta.shifting
        assert momentum is not None
        draft.depends_on(momentum, v.energy)
        definitions.append(Equation("ℓ" if x.turning else "p", write(momentum)))
        kept.append(Equation(x.rate, 0))
        laws += x.law
    if not kept:
        return ()
    without = "conserved.kept_without" if problem.forces else "conserved.kept"
    prose = say(without, kept=enumerated(laws))
    prose += _tried(group, v) + say("conserved.noether")
    return (draft.step([*definitions, *kept], prose),)


@dataclass(frozen=True)
class ConservedMomentum:
    """A momentum that motions keep, ℓ (``turning``) or p: what vanishes of its rate, and in
    words."""

    turning: bool
    rate: Tree
    law: Prose


def kept_momenta(
    group: Group, v: Potentials, b: Alphabet, *, vectors: bool
) -> list[ConservedMomentum]:
    """The momenta of rotations and translations of space that are kept; ``vectors``: ℓ is one."""
    found = []
    if _turned(group) and (rate := _turning(v, b, vectors=vectors)) is not None:
        found.append(ConservedMomentum(True, rate, say(f"conserved.{_turning_law(rate)}")))
    if (rate := _shifting(group, v, b)) is not None:
        law = "momentum" if rate == "ṗ" else "across_gravity"
        found.append(ConservedMomentum(False, rate, say(f"conserved.{law}")))
    return found


def matrix_momenta(momentum: Expr, a: Alphabet) -> SpaceMomenta:
    """ℓ = G − Ḡ, with G the gradient of p̃(YA, YT + b) by Y, and p, its gradient by b."""
    Y, shift = Letter("Y", a.n, a.n), Letter("b", a.n)
    images = {a.A.d_position: word(Y) * word(a.A.position)}
    if a.affine:
        images[a.T.d_position] = word(Y) * word(a.T.position) + word(shift)
    paired = substitute(momentum, images)
    whole = gradient(paired, Y)
    displaced_letters = gradient(paired, shift) if a.affine else None
    return SpaceMomenta(whole - whole.bar, displaced_letters, vectors=False)


def vector_momenta(momenta: Mapping[Letter, Expr], b: Alphabet) -> SpaceMomenta:
    """ℓ and p in R³: the gradients by y and b of ⟨ℓ_b, Ω⟩ + ⟨p_b, η⟩, with Ω = Āy and η = Ā(y ∧ T +
    b)."""
    turned, *shifted = momenta.values()
    g, shift = word(b.A.position), Letter("b", 3)
    paired = inner(turned, g.bar * word(AXIS))
    if b.affine:
        displaced_letters = word(hat(AXIS)) * word(b.T.position) + word(shift)
        paired = paired + inner(shifted[0], g.bar * displaced_letters)
    whole = gradient(reduce(paired, anticommute(AXIS)), AXIS)
    return SpaceMomenta(whole, gradient(paired, shift) if b.affine else None, vectors=True)


def _tried(group: Group, v: Potentials) -> Prose:
    """The sentence that says which displacements of space were tried."""
    if v.pointwise.forces:
        return say("conserved.by_coordinates")
    has = {"rotations": _turned(group), "translations": group.free_translations}
    which = "" if group.n == 3 else "_together"
    listed = [phrase(f"conserved.{x}{which}") for x, there in has.items() if there]
    return (
        say("conserved.tried", displacements=enumerated(listed))
        if listed
        else say("conserved.alone")
    )


def _turned(group: Group) -> bool:
    """Does the group contain the rotations of space, which act from the left?"""
    n, size = group.n, group.size
    if group.factors:
        return False
    turns = [q.minus(q.unit(size, i, j), q.unit(size, j, i)) for i in range(n) for j in range(i)]
    return n > 1 and all(group.vee(e) is not None for e in turns)


def _turning(v: Potentials, b: Alphabet, *, vectors: bool) -> Tree | None:
    """What vanishes of ℓ̇: all of it, or its component along a line, where the potential is kept by
    all rotations of space, or by those about the line; ``None`` where by neither."""
    if v.pointwise.forces:
        return None
    given = PotentialsInSpace.of(v.pointwise.problem)
    Y = Letter("Y", b.n, b.n, -1)
    if not given.vectors and not _varied(v, word(Y), None, b, given.known(None)):
        return "ℓ̇"
    for line in given.lines() if b.n == 3 else ():
        axis, along = GAMMA if given.by_gravity else AXIS, given.along(line)
        if not normal_form(_varied(v, word(hat(axis)), None, b, given.known(line, axis))):
            return ("inner", along if vectors else ("hat", along), "ℓ̇")
    return None


def _turning_law(rate: Tree) -> str:
    """The name of the words for what vanishes of ℓ̇."""
    if rate == "ℓ̇":
        return "angular_momentum"
    return "along_gravity" if GAMMA.name in names(rate) else "along_axis"


def _shifting(group: Group, v: Potentials, b: Alphabet) -> Tree | None:
    """What vanishes of ṗ: all of it, or γ ∧ ṗ, where the potential is kept by all translations of
    space, or by those across gravity; ``None`` where by neither."""
    if not group.free_translations or not v.pointwise.shifts:
        return None
    given = PotentialsInSpace.of(v.pointwise.problem)
    known = given.known(None)
    if not _varied(v, None, word(Letter("b", b.n)), b, known):
        return "ṗ"
    axis, other = (GAMMA, AXIS) if given.by_gravity else (AXIS, Letter("b", 3))
    across = word(hat(axis)) * word(other)
    for line in given.lines() if b.n == 3 else ():
        if not normal_form(_varied(v, None, across, b, given.known(line, axis))):
            return ("wedge", given.along(line), "ṗ")
    return None


def _varied(
    v: Potentials, turn: Expr | None, shift: Expr | None, b: Alphabet, known: Mapping[Letter, Expr]
) -> Expr:
    """The derivative of Ũ along δA = YA, δT = YT with Y = ``turn``, or along δT = ``shift``;
    without U_Q, which is judged by its terms.

    ``known``: letters of the problem, by what is known of them.
    """
    images, T = {}, b.T.position
    if turn is not None:
        # T less a constant that Y sends to 0 turns as T does
        seen = next((x.letter for x in v.own if x.value == word(T)), T)
        images[b.A.position] = turn * word(b.A.position)
        images[T] = turn * word(seen)
    if shift is not None:
        images[T] = shift
    varied = derivation(without(v.energy, U_Q), displaced_letters(v.own, images).get)
    return substitute(varied, known)
