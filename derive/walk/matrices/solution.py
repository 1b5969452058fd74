"""The kernel on a group of matrices, solved by multipliers or by a mass matrix."""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra.calculus import gradient, reduce, substitute, terms_with, without
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Factor, Letter, inner, number, one, word
from ...language import rational as q
from ...language.read import read
from ...language.tree import Tree, add, plain
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say, say_signed
from ..spine.alphabet import Alphabet, cancelling, inverse_letter, inverses
from ..spine.cartan import cauchy_green, rates
from .coordinates import coordinates_step
from .separation import Barycentric, CentralEquations, seen_from_centres
from .specialisation import KernelOnGroup

# The kernel through the normal space of 𝔤 in gl(n): one multiplier, or none.
#
# The equations hold for every ξ′ in 𝔤, so what they leave lies in the normal space, whose
# dimension is the number of constraints on A. For SL(n) it is spanned by 1, for GL(n) it is zero.

MULTIPLIER = Letter("θ")


def multiplier_steps(
    inertial: Expr,
    force: Expr,
    metric: Letter,
    group: Group,
    b: Alphabet,
    c: Chapter,
    centred: Barycentric | None = None,
) -> tuple[Step, ...]:
    """The steps ``multiplier``, ``motion`` and ``space``: Ż and θ from  Tr ξ′ (residue − force)‾ =
    0,  with J (or J_c) as ``metric``."""
    residue = gradient(inertial, b.Z.xi_prime)
    direction, letters, definition = direction_of(group, b)
    rule = "multiplier" if direction else "kernel"
    balancing, solving = c.draft("multiplier", rule), c.draft("motion", "solution")
    pressed = word(MULTIPLIER) * direction if direction else force * 0
    balance = Equation(
        balancing.tree(residue),
        add(balancing.tree(force, inverses(b.m)), balancing.tree(pressed)),
        exists=(MULTIPLIER.name,) if direction else (),
    )
    left, right = word(inverse_letter(b.C)), word(inverse_letter(metric))
    open_balance = balancing.mark(force + pressed - residue)
    free = reduce(left * open_balance * right, cancelling(b.C, metric))
    solved = free + word(b.Z.acceleration)
    notation = inverses(b.C, metric, b.m)
    equations = rates(solving, b)
    if direction:
        numerator, denominator = _multiplier(solved, direction)
        if group.relations:
            solving.depends_on(number(1).marked(c.label("relation")))  # Tr Ż = 0
        ratio: Tree = (
            "div",
            solving.tree(numerator, notation),
            solving.tree(denominator, notation),
        )
        equations.append(Equation("θ", ratio))
    if centred:
        solving.depends_on(*centred.steps)
    translation = (Equation("ẇ", centred.acceleration),) if centred else ()
    equations += [Equation("Ż", solving.tree(solved, notation)), *translation]
    solved = solving.mark(solved)
    return (
        balancing.step((*definition, balance), _prose(direction, letters)),
        solving.step(equations, _invertible(metric.name, b, multiplier=direction is not None)),
        _in_space(solved, solving.mark(centred.rate) if centred else None, b, notation, c),
    )


def _in_space(
    solved: Expr, drift: Expr | None, b: Alphabet, inverse: WordNotation, c: Chapter
) -> Step:
    """The step ``space``: α̇ = A(Ż + Z²) and τ̇ = A(ẇ + Zw), with C⁻¹ = A⁻¹Ā⁻¹: the point r has α̇r
    + τ̇."""
    draft = c.draft("space", "solution")
    left, right = Letter("A⁻¹", b.n, b.n), Letter("Ā⁻¹", b.n, b.n)
    g, Z, within = b.A.position, word(b.Z.velocity), Letter("Y", b.n, b.n)
    twice = cauchy_green(b)

    def rule(x: Factor, y: Factor) -> Expr | None:
        """Ā⁻¹Ā = 1, and AY = α̇ for Y = Ż + Z²."""
        if (x, y) == ((g, False), (within, False)):
            return word(b.A.acceleration)
        return b.unit if (x, y) == ((right, False), (g, True)) else None

    def carried(e: Expr) -> Expr:
        inside = substitute(e, {inverse_letter(b.C): (word(left) * word(right)).of(twice)})
        return reduce(word(g) * inside, cancelling(g), rule)

    shown = {**inverse.display, left: read("A⁻¹"), right: read("Ā⁻¹")}
    notation = WordNotation(display=shown)
    total = carried(solved + Z * Z)
    equations = [Equation(b.A.acceleration.name, draft.tree(total, notation))]
    if drift is not None:
        turning = {b.Z.acceleration: word(within) - Z * Z}
        pulled = carried(substitute(drift, turning) + Z * word(b.w.velocity))
        equations.append(Equation(b.T.acceleration.name, draft.tree(pulled, notation)))
    return draft.step(equations, say("space.affine" if drift is not None else "space.linear"))


def direction_of(group: Group, b: Alphabet) -> tuple[Expr | None, list[Letter], list[Equation]]:
    """The normal direction as a word, with its letters and their equations: 1, or a letter Λ with
    its value; ``None`` for GL(n)."""
    if not group.normal_space_of_linear_parts:
        return None, [], []
    normal = group.normal_direction
    n = group.n
    if normal == q.identity(n):
        return one(b.n), [], []
    letter = Letter("Λ", n, n)
    rows = tuple(("row", *(plain(x) for x in row)) for row in normal)
    return word(letter), [letter], [Equation("Λ", ("matrix", *rows))]


def _multiplier(solved: Expr, direction: Expr) -> tuple[Expr, Expr]:
    """The numerator and the denominator of θ, from ⟨Λ, Ż⟩ = 0."""
    total = inner(solved, direction)
    denominator = substitute(terms_with(total, MULTIPLIER), {MULTIPLIER: number(1)})
    return -without(total, MULTIPLIER), denominator


def _prose(direction: Expr | None, letters: list[Letter]) -> Prose:
    if direction is None:
        return say("multiplier.none")
    if letters:
        return say("multiplier.normal")
    return say("multiplier.volume")


def _invertible(metric: str, b: Alphabet, *, multiplier: bool) -> Prose:
    maps = "affine_maps" if b.affine else "maps"
    maps += "_of_a_volume" if multiplier else ""
    return say_signed(f"motion.{maps}", b.signed, metric=metric)


# The kernel in coordinates of 𝔤: the mass matrix M of a basis, for any group.
#
# With ξ′ = E_a and Ż = Σ ζ̇_b E_b the equations of motion are  Σ_b M_ab ζ̇_b = β_a.

RATE = Letter("ζ̇_b")


def mass_steps(
    inertial: Expr,
    force: Expr,
    place: Step,
    b: Alphabet,
    c: Chapter,
    centred: Barycentric | None = None,
    *,
    balanced: bool = True,
    central: CentralEquations | None = None,
) -> tuple[Step, ...]:
    """The steps ``mass`` and ``motion``: M, β and the solved equations, from  inertial = Tr ξ′
    force‾  for every ξ′ in 𝔤.

    ``place``: the step of the coordinates, Ż = Σ ζ̇_b E_b. ``balanced``: is there a B, the balance
    as a matrix? Not where C dropped out for what pairs with 𝔤 alone. ``central``: the equations
    seen from the centres of mass; the coordinates ψ are then those of Ż(1 + S).
    """
    weighing, solving = c.draft("mass", "components"), c.draft("motion", "solution")
    E_a, E_b = basis_member("a", b), basis_member("b", b)
    notation = WordNotation(display={E_a: read("E_a"), E_b: read("E_b")})
    rate = word(RATE) * word(E_b)
    rate = rate if central else rate.marked(place.label)
    along = {b.Z.xi_prime: word(E_a), b.Z.acceleration: rate}
    mass = gradient(substitute(inertial, along), RATE)
    rest = force - gradient(without(inertial, b.Z.acceleration), b.Z.xi_prime)
    if centred:
        solving.depends_on(*centred.steps)
    translation = (Equation("ẇ", centred.acceleration),) if centred else ()
    balance = [Equation("B", weighing.tree(rest, inverses(b.m)))] if balanced else []
    load = inner(word(E_a), word(Letter("B", b.n, b.n)) if balanced else rest)
    found = "ψ" if central else "ζ̇"
    mass_step = weighing.step(
        (
            Equation(read("M_ab"), weighing.tree(mass, notation)),
            *balance,
            Equation(read("β_a"), weighing.tree(load, notation)),
            *stated(f"Σ_b M_ab {found}_b = β_a"),
        ),
        say("mass.centres" if central else "mass.basis"),
    )
    solving.depends_on(mass_step)
    solved = stated(f"{found} = M⁻¹β")
    motion = solving.step(
        (*rates(solving, b), *solved, *_equation_of_rates(solving, b, central), *translation),
        say("motion.problem") + say_signed("motion.mass_matrix", b.signed),
    )
    return mass_step, motion


def _equation_of_rates(d: Draft, b: Alphabet, central: CentralEquations | None) -> list[Equation]:
    """The equation of Ż by its coordinates, where ẇ or ζ̇ needs it."""
    if central is None:
        return stated("Ż = Σ_a ζ̇_a E_a") if b.affine else []
    rate = b.Z.acceleration
    whole = word(rate) - word(rate) * central.shift
    return [Equation("Ż", d.tree(whole, WordNotation(display={rate: read("Σ_a ψ_a E_a")})))]


def basis_member(index: str, b: Alphabet) -> Letter:
    """The letter E_a of a basis matrix, skew or traceless where Z is."""
    z = b.Z.velocity
    return Letter(f"E_{index}", b.n, b.n, z.symmetry, z.traceless)


# The kernel solved for the acceleration: through the normal space of 𝔤, or by the mass matrix.

MULTIPLIERS = 1
"""The kernel is solved through the normal space of 𝔤 where it has at most so many dimensions: the
counted operations of the emitted code are then fewer than through the mass matrix
(tests/walk/test_any_problem.py)."""


@dataclass(frozen=True)
class Solution:
    """The steps that solve the kernel; ``motion``: that of the equations of motion."""

    motion: Step
    steps: tuple[Step, ...]


def solution(
    stage: KernelOnGroup, centred: Barycentric | None, group: Group, here: Chapter, c: Chapter
) -> Solution:
    """The acceleration from ``stage.inertial`` = the work of ``stage.forces``, or from what is left
    of it once the translation is eliminated, for every ξ′ in 𝔤; ``c``: here, where inputs act."""
    b = stage.letters
    inertial, force, metric = stage.inertial, stage.forces[b.Z.xi_prime], b.J
    if centred is not None:
        inertial, force, metric = centred.inertial, centred.force, centred.metric
    multiplied = len(group.normal_space_of_linear_parts) <= MULTIPLIERS
    place = coordinates_step(
        group, b, here, with_rates=multiplied or bool(group.barycentric_blocks)
    )
    if multiplied:
        _, motion, _ = solved = multiplier_steps(inertial, force, metric, group, b, c, centred)
        return Solution(motion, (*solved, place))
    central = seen_from_centres(inertial, force, group, b, c)
    if central is not None:
        _, motion = solved = mass_steps(
            central.inertial, central.force, place, b, c, balanced=False, central=central
        )
        return Solution(motion, (*central.steps, *solved, place))
    _, motion = solved = mass_steps(
        inertial, force, place, b, c, centred, balanced=stage.bodies is None
    )
    return Solution(motion, (place, *solved))
