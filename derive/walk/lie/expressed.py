"""A problem whose Lagrangian is an expression: the momentum form in a basis of 𝔤."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from ...algebra.groups import Group
from ...language.derivatives import derivative
from ...language.laurent import OverlongError, collected
from ...language.read import read
from ...language.tree import Tree, add, mul, names, neg, plain
from ...problem.entries_on_orbit import (
    EntriesOfElement,
    OrbitEntries,
    along,
    hessian,
    vanishes_on,
)
from ...problem.fields import coordinates
from ...problem.lagrangian_tables import quotient_of
from ...problem.problem import Problem, ProblemError
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose, enumerated, listed
from ...schema.kind import Lagrangian
from ..chapter import Chapter, phrase, say
from ..given.inputs import pushes
from ..matrices.coordinates import basis_equations
from .any_lagrangian import AnyLagrangian
from .from_outside import from_outside, named_forces, with_numbers

# The basis of 𝔤 in which a Lagrangian is expressed: coordinates, brackets, and how what it
# depends on moves with the group.


@dataclass(frozen=True)
class Basis:
    """``orbit_entries``: the entries on which L̃ depends; ``rates``: equations that say how they
    move with time, which the step ``last`` has found."""

    orbit_entries: OrbitEntries
    rates: tuple[Equation, ...]
    last: Step
    brackets: tuple[Step, ...]
    steps: tuple[Step, ...]


def of_element(problem: Problem, group: Group, general: AnyLagrangian, c: Chapter) -> Basis:
    """Z = Σ ζ_a E_a, and Ȧ by it; [E_a, E_b]."""
    draft = c.draft("coordinates", "coordinates", general["second_order"])
    rates = (Equation("Ȧ", general.velocity),)
    place = draft.step([*basis_equations(group), *rates], say("coordinates.basis") + _names(group))
    told = brackets(group, c)
    moved = EntriesOfElement(group, problem.own_lagrangian.trivialisation)
    return Basis(moved, rates, place, told, (place, *told))


def _names(group: Group) -> Prose:
    """Where in A what the names of the problem stand for is, where that is not A itself."""
    if len(group.places) < 2:
        (_, whole), *_ = group.places
        return say("coordinates.column") if whole.affine else ()
    blocks = [
        phrase("coordinates.block_and_column", name=f"A{k}", row=str(at + 1), column=f"T{k}")
        if factor.affine
        else phrase("coordinates.block", name=f"A{k}", row=str(at + 1))
        for k, (at, factor) in enumerate(group.places, 1)
    ]
    return say("coordinates.blocks", blocks=listed("{first}; {second}", blocks))


def brackets(group: Group, c: Chapter, *, shown: bool = True) -> tuple[Step, ...]:
    """[E_a, E_b] where it is not 0, after E_a as matrices where these are not many; ``shown``: are
    they those of the problem?"""
    table, span = group.structure_constants, range(group.dimension)
    listed = [
        Equation(("bracket", member("E", a), member("E", b)), _combined(table[a][b], "E"))
        for a in span
        for b in span
        if a < b and any(table[a][b])
    ]
    few = shown and group.dimension * group.size**2 <= MOST
    basis = [
        Equation(member("E", a), ("matrix", *(("row", *map(plain, row)) for row in e)))
        for a, e in enumerate(group.basis if few else ())
    ]
    if not basis and not listed:
        return ()
    about = say("algebra.brackets" if listed else "algebra.abelian")
    prose = (say("algebra.matrices") if basis else ()) + about
    return (c.draft("algebra", "relation").step([*basis, *listed], prose),)


MOST = 160
"""So many entries have the matrices of a basis at most that are shown: those of SO(5) have 250,
those of SE(3) 96, those of GL(3) 81."""


def member(family: str, a: int) -> Tree:
    """The member of a family for E_a; a from 0."""
    return ("at", family, a + 1)


def _combined(coefficients: Iterable[Fraction], family: str) -> Tree:
    """Σ x_k Y_k over a family."""
    return add(*(mul(plain(x), member(family, k)) for k, x in enumerate(coefficients) if x))


# What motions keep where a problem has its own Lagrangian: the energy, the other momentum.


def conserved(
    stage: Expressed,
    problem: Problem,
    group: Group,
    general: AnyLagrangian,
    balance: Sequence[Step],
    c: Chapter,
) -> tuple[Step, ...]:
    """The step of what the motion of a problem keeps, the energy and all of Π_o; none where it
    keeps neither."""
    laws: Prose = ()
    equations = []
    draft = c.draft("conserved", "conservation")
    expression, momenta, energy = stage.steps
    draft.depends_on(
        general["moment_map"], next(x for x in balance if x.label == c.label("motion"))
    )
    if "t" not in names(problem.own_lagrangian.L):
        draft.depends_on(expression, energy)
        equations.append(Equation("ḣ", 0))
        laws += say("conserved.energy")
    forced = not all(vanishes_on(group, x) for x in stage.forces)
    whole = not forced and group.has_inner_samples  # else no exact element is known
    if whole:
        draft.depends_on(momenta)
        equations.append(Equation("Π̇_o", 0))
        laws += say("conserved.other")
    if not equations:
        return ()
    without = "conserved.kept_without_forces" if problem.forces else "conserved.kept_by_any"
    prose = say(without, kept=enumerated(laws))
    if forced:
        prose += say("conserved.components")
    elif whole and problem.advected is not None:
        prose += say("conserved.no_element")
    return (draft.step(equations, prose + say("conserved.noether")),)


@dataclass(frozen=True)
class Expressed:
    """ℓ in coordinates.  ``momenta``: Π_a, and ``forces``: Φ_a, as trees; ``second``: ∂²ℓ/∂ζ²."""

    momenta: tuple[Tree, ...]
    forces: tuple[Tree, ...]
    second: tuple[tuple[Tree, ...], ...]
    steps: tuple[Step, ...]

    @property
    def momenta_step(self) -> Step:
        """The step of Π_a and Φ_a."""
        return self.steps[1]


def tidied(t: Tree) -> Tree:
    """A tree of numbers with its like terms added, where that is not too long; parameters first."""
    try:
        return _ordered(collected(t))
    except OverlongError:
        return t


def _ordered(t: Tree) -> Tree:
    """The factors of products in the order of physics: numbers, parameters, g, functions, ζ."""
    if not isinstance(t, tuple) or t[0] in ("par", "entry"):
        return t
    parts = [t[1], *map(_ordered, t[2:])] if t[0] == "fun" else [*map(_ordered, t[1:])]
    return (t[0], *(sorted(parts, key=_place) if t[0] == "mul" else parts))


def _place(t: Tree) -> int:
    """Where a factor stands in a product."""
    if not isinstance(t, tuple):
        return 0 if isinstance(t, (int, Fraction)) else 1
    if t[0] in ("pow", "div"):
        return _place(t[1])
    order = {"par": 1, "add": 3, "fun": 4}
    return (5 if t[1] in ("ζ", "Ȧ", "Γ̇") else 2) if t[0] == "entry" else order.get(t[0], 3)


def expressed(
    problem: Problem, group: Group, general: AnyLagrangian, basis: Basis, c: Chapter
) -> Expressed:
    """L̃, and its derivatives along Z and along the group."""
    given = problem.own_lagrangian
    zeta = coordinates(group)
    momenta = tuple(tidied(derivative(given.L, x)) for x in zeta)
    forces = tuple(tidied(basis.orbit_entries.along(given.L, a)) for a in range(group.dimension))
    second = tuple(tuple(map(tidied, row)) for row in hessian(given.L, zeta))
    carried = problem.advected
    kind = "expression" if carried is None else "carried" if carried else "alone"
    draft = c.draft("lagrangian", "definition")
    expression = draft.step([Equation("L̃", given.L)], say(f"lagrangian.{kind}"))
    told = _momenta(momenta, forces, (expression, general["momenta"]), c)
    energy = _energy(given, momenta, zeta, (expression, told, general["energy"]), c)
    return Expressed(momenta, forces, second, (expression, told, energy))


def _momenta(
    momenta: Sequence[Tree], forces: Sequence[Tree], made_from: tuple[Step, ...], c: Chapter
) -> Step:
    """Π_a and Φ_a."""
    draft = c.draft("momenta", "fibre derivative", *made_from)
    equations = [Equation(read("Π_a"), read("⟨Π, E_a⟩"))]
    equations += [Equation(member("Π", a), t) for a, t in enumerate(momenta)]
    equations += [Equation(read("Φ_a"), read("⟨Φ, E_a⟩"))]
    if any(forces):
        equations += [Equation(member("Φ", a), t) for a, t in enumerate(forces)]
    else:
        equations += [Equation(read("Φ_a"), 0)]
    return draft.step(equations, say("momenta.basis"))


def _energy(
    given: Lagrangian,
    momenta: Sequence[Tree],
    zeta: Sequence[Tree],
    made_from: tuple[Step, ...],
    c: Chapter,
) -> Step:
    draft = c.draft("energy", "Legendre transform", *made_from)
    paired = add(*(mul(p, z) for p, z in zip(momenta, zeta, strict=True)))
    return draft.step([Equation("h̃", tidied(add(paired, neg(given.L))))], say("energy.expression"))


def balance(
    stage: Expressed,
    problem: Problem,
    group: Group,
    general: AnyLagrangian,
    basis: Basis,
    c: Chapter,
) -> tuple[Step, ...]:
    """Π̇ in the basis, then M, β and the motion."""
    turning, weighing = c.draft("coadjoint", "kernel"), c.draft("mass", "components")
    turning.depends_on(general["coadjoint"], *basis.brackets)
    coadjoint = coadjoint_terms(group, general.epsilon)
    driven = from_outside(problem, group)
    forces = [member("Φ", a) if x else 0 for a, x in enumerate(stage.forces)]
    rates = [
        add(*((x,) if x else ()), *((y,) if y else ()), *driven[a])
        for a, (x, y) in enumerate(zip(forces, coadjoint, strict=True))
    ]
    prose = say("coadjoint.basis") + (say("coadjoint.at_places") if pushes(problem) else ())
    named = named_forces(problem, group)
    coadjoint_step = turning.step(
        [*named, *(Equation(member("Π̇", a), t) for a, t in enumerate(rates))], prose
    )
    held = {a - 1 for a in problem.own_lagrangian.held}
    left = [
        0 if a in held else add(t, neg(tidied(basis.orbit_entries.in_time(p))))
        for a, (t, p) in enumerate(zip(rates, stage.momenta, strict=True))
    ]
    second = [
        [int(a == b) if {a, b} & held else x for b, x in enumerate(row)]
        for a, row in enumerate(stage.second)
    ]
    null = _null(stage, problem, driven, coadjoint, coadjoint_step, c) if held else ()
    weighing.depends_on(*null)
    weighing.depends_on(coadjoint_step, basis.last)
    mass = weighing.step(
        [
            Equation("M", ("matrix", *(("row", *row) for row in second))),
            Equation("β", ("matrix", *(("row", t) for t in left))),
        ],
        say("mass.basis_of_lagrangian") + (say("mass.held") if held else ()),
    )
    solving = c.draft("motion", "solution", mass, basis.last)
    motion = solving.step([*basis.rates, *stated("ζ̇ = M⁻¹β")], say("motion.lagrangian"))
    return coadjoint_step, *null, mass, motion


def _null(
    stage: Expressed,
    problem: Problem,
    driven: Sequence[Sequence[Tree]],
    coadjoint: Sequence[Tree],
    balance: Step,
    c: Chapter,
) -> tuple[Step, ...]:
    """Along what has no kinetic energy: the momentum vanishes, and its equation says nothing; what
    acts from outside is of the quotient. ``ProblemError`` where it is not."""
    draft = c.draft("null", "restriction", balance)
    quotient, span = quotient_of(problem), range(len(stage.momenta))
    assert quotient is not None
    momenta = [member("Π", a) for a in span]
    pushes = [add(member("Φ", a), t) for a, t in enumerate(coadjoint)]
    directions = quotient.directions
    told = [Equation(along(values, x), 0) for x in directions for values in (momenta, pushes)]
    acting = [with_numbers(problem, add(*terms)) for terms in driven]
    if not quotient.bears(acting):
        what = next(x for x, alone in _apart(problem, quotient.group) if not quotient.bears(alone))
        raise ProblemError(
            f"{what}: L has symmetries without kinetic energy, and what pushes along them, or "
            "depends on where a motion stands along them, has no motion to answer; add their "
            f"kinetic energy, or leave the {what.split()[0]} out"
        )
    laws = [law for x in directions for law in quotient.laws(acting, x) if law[0] != law[1]]
    told += [Equation(*law) for law in laws]
    size = str(1 + 2 * len(directions))
    prose = say("null.symmetries", size=size) + (say("null.driven") if problem.driven else ())
    return (draft.step(told, prose),)


def _apart(problem: Problem, group: Group) -> Iterable[tuple[str, list[Tree]]]:
    """What each table that acts gives along the basis, by the name of the table."""
    given = [(f"input {k}", (x,), ()) for k, x in enumerate(problem.inputs, 1)]
    tables = zip(problem.force_tables, problem.forces, strict=True)
    for table, inputs, forces in [*given, *((t["table"], (), (x,)) for t, x in tables)]:
        alone = replace(problem, inputs=inputs, forces=forces)
        works = from_outside(alone, group)
        yield table, [with_numbers(alone, add(*terms)) for terms in works]


def coadjoint_terms(group: Group, epsilon: int) -> list[Tree]:
    """ε⟨Π, [Z, E_a]⟩ = ε Σ_b ζ_b c_ba^k Π_k."""
    table, span = group.structure_constants, range(group.dimension)
    return [
        add(
            *(
                mul(plain(epsilon * table[b][a][k]), ("entry", "ζ", b + 1), member("Π", k))
                for b in span
                for k in span
                if table[b][a][k]
            )
        )
        for a in span
    ]
