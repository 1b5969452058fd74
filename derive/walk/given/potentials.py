"""The potentials of a problem: on words, or point by point, and their forces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from ...algebra.calculus import PairRule, derivation, gradient, reduce, substitute, without
from ...algebra.word_trees import WordNotation, hat, metrics, tree_of
from ...algebra.words import Expr, Factor, Letter, inner, number, word, zero
from ...language.derivatives import derivative, product
from ...language.tree import Tree, add, mul, nodes, replaced
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say
from ..kinds import walked
from ..spine.alphabet import Alphabet
from ..spine.cartan import body_rule
from ..vectors.isomorphism import OMEGA_P, anticommute

# Potentials as words in A, T, m, c, J and letters of their own.
#
# A letter of its own stands for a word that g moves, or for a power of one: what a displacement
# makes of it is derived from that word, and products in it are written by the letters again.


@dataclass(frozen=True)
class PotentialLetter:
    """A letter of a potential's own, which stands for ``value``; for a product āb, if that is one:
    ``factors`` (a, b) and the ``share`` of the letter that āb is.

    ``axial``: in R³, the vector of the letter N, ⟨axial, x⟩ = Tr N j(x)‾.
    """

    letter: Letter
    value: Expr
    factors: tuple[Letter, Letter] | None = None
    share: Fraction = Fraction(1)
    axial: Letter | None = None

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter along a displacement, whose value on other letters is
        ``delta``."""
        return derivation(self.value, delta)

    def written(self, left: Factor, right: Factor) -> Expr | None:
        """The product āb, or b̄a, by the letter; ``None`` for another pair of factors."""
        if self.factors:
            a, b = self.factors
            if (left, right) == ((a, True), (b, False)):
                return self.share * word(self.letter)
            if (left, right) == ((b, True), (a, False)):
                return self.share * word(self.letter).bar
        return None


@dataclass(frozen=True)
class FunctionLetter(PotentialLetter):
    """A letter x for a function of a scalar q, its ``value``: δx = slope · δq.

    ``rules``: what reduces δq.
    """

    slope: Expr = field(kw_only=True)
    rules: tuple[PairRule, ...] = ()

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter, by the chain rule."""
        return self.slope * reduce(derivation(self.value, delta), *self.rules)


def power_letter(x: Letter, value: Expr, exponent: Fraction, over: Expr) -> FunctionLetter:
    """A letter for a power of a scalar; ``over``: the scalar's inverse by letters."""
    return FunctionLetter(x, value, slope=exponent * word(x) * over)


def displaced_letters(
    own: Iterable[PotentialLetter], images: Mapping[Letter, Expr]
) -> dict[Letter, Expr]:
    """The images of A, T and so on under a displacement, completed by those of own letters."""
    found, listed = dict(images), [*own]
    rules: list[PairRule] = [x.written for x in listed]
    for x in listed:
        found[x.letter] = reduce(x.varied(found.get), *rules)
    return found


@dataclass(frozen=True)
class Words:
    """The potentials of one kind on words: ``energy``: what they add to Ũ; the same
    ``over_points``, as trees.

    ``definitions``: of the letters that are its own; ``prose``: what is said of them; ``own``: how
    those move, each after those that it stands for.
    """

    energy: Expr
    definitions: Sequence[Equation]
    over_points: Sequence[Tree]
    prose: Prose = ()
    own: Sequence[PotentialLetter] = ()


# Potentials given point by point: springs with a length or an anchor, attraction, any U.
#
# Each pushes its points by minus the derivative of U.  A potential of a distance ‖d‖ is
# differentiated as a function of ‖d‖²: the force is  σ d  with  σ = −2 ∂U/∂‖d‖².


def in_space(i: int) -> Tree:
    """The tree r_i(t), the place of point i in space."""
    return ("call", ("at", "r", i), "t")


def column(entries: tuple[Tree, ...]) -> Tree:
    """A vector as a matrix tree with one column."""
    return ("matrix", *(("row", x) for x in entries))


def embedded(problem: Problem, i: int, entries: tuple[Tree, ...], corner: int) -> Tree:
    """A vector of the space of point i as a column; in a product, in its block, with a corner."""
    assert problem.group is not None
    return column(problem.group.in_block(problem.block(i), entries, corner))


@dataclass(frozen=True)
class Radial:
    """A potential of ‖d‖², where d = Σ ± r_i(t) − anchor: σ_e = ``tension``, a tree in d_e."""

    d: Tree
    signs: dict[int, int]
    anchor: tuple[Tree, ...]
    tension: Tree

    @property
    def shifts(self) -> bool:
        """Does ‖d‖ stay when space is shifted?"""
        return not sum(self.signs.values())

    @property
    def sigma(self) -> Tree:
        """The tree σ_e."""
        return ("at", "σ", self.d[2])  # type: ignore[index]


@dataclass
class PointPotentials:
    """The potentials given point by point, whose sum is U_Q: ``differences``: the equations of d_e;
    ``energies``: U_e; ``radials``: those of a distance; ``forces``: −∂U/∂r_i(t) of the others."""

    problem: Problem
    differences: list[Equation] = field(default_factory=list)
    energies: list[Tree] = field(default_factory=list)
    radials: list[Radial] = field(default_factory=list)
    forces: dict[int, list[Tree]] = field(default_factory=dict)

    @property
    def shifts(self) -> bool:
        """Is U_Q a function of distances that stay when space is shifted?"""
        return not self.forces and all(x.shifts for x in self.radials)

    def add_force(self, i: int, force: Tree) -> None:
        """Add a term to the force on point i."""
        self.forces.setdefault(i, []).append(force)

    def add_energy(self, U: Tree) -> None:
        """Add a potential U of entries of places r_i(t), with its forces −∂U/∂r_i(t)."""
        self.energies.append(U)
        assert self.problem.group is not None
        span = range(1, self.problem.group.n + 1)
        for i in sorted({*_points(U)}):
            slopes = (derivative(U, ("entry", in_space(i), k)) for k in span)
            self.add_force(i, column(tuple(product(-1, x) for x in slopes)))

    def add_difference(self, ends: Tree) -> Tree:
        """Name a difference d_e, and give its tree."""
        d: Tree = ("at", "d", len(self.differences) + 1)
        self.differences.append(Equation(d, ends))
        return d

    def add_radial(
        self, energy: Tree, d: Tree, signs: dict[int, int], anchor: tuple[Tree, ...] = ()
    ) -> None:
        """Add a potential of ‖d‖²; ``signs``: those of r_i(t) in d, by the point."""
        self.energies.append(energy)
        tension = product(-2, derivative(energy, ("norm2", d)))
        self.radials.append(Radial(d, signs, anchor, tension))


def place(problem: Problem, i: int) -> Tree:
    """The place of point i in its space: r_i(t), or the entries of its block."""
    group = problem.group
    assert group is not None
    if not group.factors:
        return in_space(i)
    rows = range(1, group.n + 1)[group.of_block(problem.block(i))]
    return column(tuple(("entry", in_space(i), k) for k in rows))


def _points(t: Tree) -> Iterator[int]:
    """The numbers i of the points whose places are in a tree."""
    for x in nodes(t):
        if isinstance(x, tuple) and x[:2] == ("at", "r"):
            yield x[2]


# The potentials of a problem on words: Ũ pulled back, and its force.
#
# A kind that has words (``walk/kinds``) is pulled back like L itself: gravity, springs of natural
# length 0, torsion, a far centre. The others enter as U_Q, with the forces Q_i on the points.

U_Q = Letter("U_Q")


@dataclass(frozen=True)
class Potentials:
    """The potentials of a problem: ``energy`` = Ũ on words in A, T, c, m, γ, K, U_Q; ``work(ξ, η)``
    of what U_Q exerts.

    ``pointwise``: what is in U_Q; ``own``: letters of the potentials beside these.
    """

    energy: Expr
    steps: tuple[Step, ...]
    work: Callable[[Expr, Expr | None], Expr]
    pointwise: PointPotentials
    own: tuple[PotentialLetter, ...] = ()

    def displaced(
        self, a: Alphabet, xi: Expr, eta: Expr | None = None, axis: Expr | None = None
    ) -> dict[Letter, Expr]:
        """The images of the letters of Ũ under δA = Aξ, δT = Aη; ``axis``: x for ξ = j(x)."""
        g = word(a.A.position)
        images = {a.A.position: g * xi, U_Q: -self.work(xi if axis is None else axis, eta)}
        return displaced_letters(
            self.own, images if eta is None else images | {a.T.position: g * eta}
        )


def potentials(problem: Problem, a: Alphabet, c: Chapter, C: Expr | None = None) -> Potentials:
    """The potentials of the problem, with the step of Ũ, and of the forces that are given point by
    point.

    ``C``: ĀA = 1, where the forces are to be said in vectors.
    """
    draft = c.draft("potential", "pull-back")
    vectors = C is not None
    modules = walked()
    having = [m for m in modules.values() if hasattr(m, "words")]
    parts: list[Words] = [w for m in having if (w := m.words(problem, a, vectors=vectors))]
    found, forces = PointPotentials(problem), applied(a, "Q", vectors=vectors)
    for p in problem.potentials:
        if hasattr(modules[p.kind], "pointwise"):
            modules[p.kind].pointwise(found, p, problem)
    energy = sum((w.energy for w in parts), number(0))
    definitions = [x for w in parts for x in w.definitions]
    over_points = [x for w in parts for x in w.over_points] + found.energies
    if found.energies:
        energy = energy + word(U_Q)
        definitions += [*found.differences, Equation("U_Q", add(*found.energies))]
    shown = [*over_points[: len(over_points) - len(found.energies)]]
    energies = [
        Equation("U", add(*shown, *([U_Q.name] if found.energies else []))),
        Equation("Ũ", draft.tree(energy)),
    ]
    prose = sum((w.prose for w in parts), _opening(over_points))
    steps = [draft.step((*definitions, *energies), prose)]
    if found.energies:
        steps.append(point_forces_step(found, forces, a, c, C))
    own = tuple(x for w in parts for x in w.own)
    return Potentials(draft.mark(energy), tuple(steps), forces.work, found, own)


def _opening(over_points: list[Tree]) -> Prose:
    if not over_points:
        return say("potential.none")
    return say("potential.pulled_back")


def virtual_work(
    v: Potentials, a: Alphabet, xi: Expr, eta: Expr | None, axis: Expr | None = None
) -> Expr:
    """−dŨ(Aξ, Aη) on words; the moments of Q are paired with the axis of ξ = j(axis), if that is
    said."""
    return -derivation(v.energy, v.displaced(a, xi, eta, axis).get)


# The forces of the potentials that are given point by point, and their sums over the points.


@dataclass(frozen=True)
class Applied:
    """The letters of the sums over the points of some forces: N and F, or the vectors μ and F."""

    moments: Letter
    resultant: Letter

    def work(self, xi: Expr, eta: Expr | None) -> Expr:
        """The virtual work of the forces, ⟨N, ξ⟩ + ⟨F, η⟩."""
        pairing = inner(word(self.moments), xi)
        return pairing if eta is None else pairing + inner(word(self.resultant), eta)


def applied(a: Alphabet, mark: str, *, vectors: bool) -> Applied:
    """N and F, or μ and F in vectors, with a mark behind: N_Q, μ_Q, F_Q."""
    moments = Letter(f"μ_{mark}", 3) if vectors else Letter(f"N_{mark}", a.n, a.n)
    return Applied(moments, Letter(f"F_{mark}", a.n))


def point_forces_step(
    found: PointPotentials, forces: Applied, a: Alphabet, c: Chapter, C: Expr | None
) -> Step:
    """The step of the tensions, the forces and their sums: in the body where ĀA = 1 is at hand
    (``C``), else in space."""
    draft = c.draft("pushes", "variation")
    equations = _in_space(found) if C is None else _in_body(draft, found, a, C)
    prose = _prose(vectors=C is not None, radials=bool(found.radials))
    sums = _sums_over_points(draft, a, forces, C)
    return draft.step((*equations, *sums), prose)


def _prose(*, vectors: bool, radials: bool) -> Prose:
    prose = say("pushes.body" if vectors else "pushes.space")
    if radials and vectors:
        prose += say("pushes.element_and_length")
    elif radials:
        prose += say("pushes.element")
    return prose


def _in_space(found: PointPotentials) -> list[Equation]:
    """The equations σ_e = … and Q_i = Σ ± σ_e d_e − ∂U/∂r_i(t)."""
    equations = [Equation(x.sigma, x.tension) for x in found.radials]
    terms: dict[int, list[Tree]] = {}
    for x in found.radials:
        for i, sign in x.signs.items():
            terms.setdefault(i, []).append(_placed(found.problem, i, x.sigma, x.d, sign))
    for i, forces_on_point in found.forces.items():
        terms.setdefault(i, []).extend(forces_on_point)
    return equations + [Equation(("at", "Q", i), add(*x)) for i, x in sorted(terms.items())]


def _placed(problem: Problem, i: int, sigma: Tree, d: Tree, sign: int) -> Tree:
    """The tree ± σ d of a force on point i, in its block of a product."""
    group = problem.group
    assert group is not None
    if not group.factors:
        return mul(sign, sigma, d)
    _, factor = group.places[problem.block(i) - 1]
    entries = tuple(mul(sign, sigma, ("entry", d, k)) for k in range(1, factor.n + 1))
    return embedded(problem, i, entries, 0)


def _in_body(d: Draft, found: PointPotentials, a: Alphabet, C: Expr) -> list[Equation]:
    """The equations χ_e = Ād_e, σ_e = … and P_i = Σ ± σ_e χ_e − Ā ∂U/∂r_i(t)."""
    equations = []
    terms: dict[int, list[Tree]] = {}
    for x in found.radials:
        chi: Tree = ("at", "χ", x.d[2])  # type: ignore[index]
        equations.append(Equation(chi, _distance_in_body(d, x, a, C)))
        equations.append(Equation(x.sigma, replaced(x.tension, x.d, chi)))
        for i, sign in x.signs.items():
            terms.setdefault(i, []).append(mul(sign, x.sigma, chi))
    for i, forces_on_point in found.forces.items():
        terms.setdefault(i, []).extend(mul(("T", "A"), f) for f in forces_on_point)
    return equations + [Equation(("at", "P", i), add(*x)) for i, x in sorted(terms.items())]


def _distance_in_body(d: Draft, x: Radial, a: Alphabet, C: Expr) -> Tree:
    """The tree of Ād_e: the places in the body, by ĀA = 1, and Ā on what is in space."""
    g, total = word(a.A.position), zero(a.n, 1)
    display: dict[Letter, Tree] = {}
    for i, sign in x.signs.items():
        r = Letter(f"r_{i}", a.n)
        display[r] = ("at", "r", i)
        place = substitute(a.acted_on(g, word(a.T.position)), {a.r_i: word(r)})
        total = total + sign * place
    inside = without(total, a.T.position)
    outside = total - inside
    if x.anchor:
        anchor = Letter("a", a.n)
        display[anchor] = column(x.anchor)
        outside = outside - word(anchor)
    notation = WordNotation(display=display)
    body = d.tree(reduce(g.bar * inside, body_rule(a, C)), notation)
    return add(body, mul(("T", "A"), tree_of(outside, notation)) if outside else 0)


def _sums_over_points(d: Draft, a: Alphabet, forces: Applied, C: Expr | None) -> list[Equation]:
    """The equations N_Q = Σ ĀQ_i r̄_i and F_Q = Σ ĀQ_i, or μ_Q = Σ r_i ∧ P_i and F_Q = Σ P_i with
    AP_i = Q_i."""
    vectors = C is not None
    family, xi = "P" if vectors else "Q", Letter("ξ′", a.n, a.n)
    point_force = Letter(f"{family}_i", a.n)
    eta = Letter("η′", a.n)
    g = word(a.A.position)
    force = g.bar * word(point_force)
    if C is not None:
        force = reduce(g.bar * g * word(point_force), body_rule(a, C))
    turned = word(hat(OMEGA_P)) if vectors else word(xi)
    work = inner(force, turned * word(a.r_i))
    if vectors:
        work = reduce(work, anticommute(OMEGA_P))
    moment = gradient(work, OMEGA_P if vectors else xi)
    display = metrics(display={point_force: ("at", family, "i"), a.r_i: ("at", "r", "i")})
    equations = [Equation(forces.moments.name, ("sum", "i", d.tree(moment, display)))]
    if a.affine:
        pull = gradient(inner(force, word(eta)), eta)
        equations.append(Equation(forces.resultant.name, ("sum", "i", d.tree(pull, display))))
    return equations
