"""SL(n), Exercise 2: the metric keeps C = ĀA, and the volume has one multiplier.

The equations hold for every ξ′ of trace zero; their residue is orthogonal to 𝔤, that is, in the
space of multipliers (for SL(n) the multiples of 1).  The trace of Ż then gives the multiplier.
"""

from __future__ import annotations

from ..algebra import forms
from ..algebra import rational as q
from ..algebra.calculus import gradient, reduce, substitute, without
from ..algebra.groups import Group
from ..algebra.notation import Notation, tree_of
from ..algebra.tree import Tree, add
from ..algebra.words import Expr, Letter, number, one, trace, word
from ..mechanics.problem import Problem
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import Cartan, form_equation, frame_rule, trivial_images
from .exterior import DOMEGA, Exterior, primes, structure, trivial_variations
from .gather import gathered, terms_with
from .inverse import cancelling, inverse_letter
from .kernel import Kernel
from .potential import Potentials, virtual_work

LAMBDA = Letter("λ")


def volume_steps(
    cartan: Cartan,
    exterior: Exterior,
    kernel: Kernel,
    v: Potentials,
    a: Alphabet,
    problem: Problem,
    prefix: str,
    general: str,
) -> tuple[Step, ...]:
    """From the general forms and equations to Ż and λ."""
    group = problem.group
    assert group is not None
    n, scope = group.n, group.name
    b = Alphabet(n, affine=False, traceless=True)
    residue = _residue(kernel, a, b)
    carried = frame_rule(b, word(b.C))
    force = gradient(virtual_work(v.energy, b, word(b.Z.xi_prime), None), b.Z.xi_prime)
    force = reduce(force, carried)
    normal = normal_direction(group)
    solved = _solved(residue, force, normal, b)
    multiplier = _multiplier(solved, b)
    potential = reduce(v.energy, carried)
    energy = substitute(b.respell(cartan.energy), {b.U: potential})
    form = Cartan(b.respell(cartan.momentum), energy, ())
    return (
        _relation(prefix, general, scope),
        *v.steps,
        *_forms(form, exterior, b, prefix, general, scope),
        Step(
            f"{prefix}.force",
            "variation",
            (f"{prefix}.potential", f"{general}.trivialisation"),
            (Equation(("mul", ("T", "A"), "N"), tree_of(force)),),
            "The forces of this problem in the body: the potential is varied along the group.",
            (),
            scope,
        ),
        Step(
            f"{prefix}.multiplier",
            "multiplier",
            (f"{general}.equations", f"{prefix}.relation", f"{prefix}.force"),
            (_balance(residue, force, normal),),
            "What the equations leave is orthogonal to every matrix of trace zero: a multiple λ "
            "of 1, the multiplier of the volume.",
            (),
            scope,
        ),
        _motion_step(solved, multiplier, b, prefix, scope),
        _coordinates(group, prefix, scope),
        Step(
            f"{prefix}.energy",
            "pull-back",
            (f"{general}.cartan_trivialised", f"{prefix}.potential"),
            (Equation("h̃", tree_of(energy)),),
            "The energy of this problem.",
            (),
            scope,
        ),
    )


def _forms(
    form: Cartan, general_exterior: Exterior, b: Alphabet, prefix: str, general: str, scope: str
) -> tuple[Step, Step]:
    """ϖ and dϖ with the potential of the problem, whose variation is that of A."""
    brackets, _ = structure(b, prefix)
    domega = reduce(
        forms.exterior(form.form(b), primes(b), *trivial_variations(b, brackets, ())),
        frame_rule(b, word(b.C)),
    )
    letters = b.letters()
    images = {
        letters[x.name]: without(b.respell(y), b.f) for x, y in general_exterior.images.items()
    }
    core = terms_with(without(domega, b.dt, b.dpt), b.Z.d_velocity, b.Z.dp_velocity)
    return (
        Step(
            f"{prefix}.cartan",
            "relation",
            (f"{general}.cartan_trivialised", f"{prefix}.potential"),
            (form_equation(form.momentum, form.energy, Notation()),),
            "The Cartan form of this problem.",
            (),
            scope,
        ),
        Step(
            f"{prefix}.exterior",
            "exterior derivative",
            (f"{prefix}.cartan", f"{general}.structure"),
            (Equation(DOMEGA, gathered(domega, core, images, Notation())),),
            "Its exterior derivative.",
            (),
            scope,
        ),
    )


def _residue(kernel: Kernel, a: Alphabet, b: Alphabet) -> Expr:
    """C(Ż + Z²)J: the coefficient of ξ′ in dϖ(X, δ′), less the force."""
    inertial = without(terms_with(kernel.form, a.Z.xi_prime), a.f)
    return gradient(b.respell(inertial), b.Z.xi_prime)


def normal_direction(group: Group) -> Expr:
    """The multiplier's direction, computed from the basis of 𝔤: for SL(n) the identity."""
    (direction,) = group.normal_space
    scale = direction[0][0]
    if direction != q.scaled(scale, q.identity(group.n)):
        raise ValueError(f"{group.name}: the normal space is not spanned by the identity")
    return one(group.n)


def _balance(residue: Expr, force: Expr, normal: Expr) -> Equation:
    return Equation(tree_of(residue), add(tree_of(force), tree_of(word(LAMBDA) * normal)))


def _solved(residue: Expr, force: Expr, normal: Expr, b: Alphabet) -> Expr:
    """Ż from  residue = force + λ 1,  multiplied by C⁻¹ and J⁻¹."""
    left, right = word(inverse_letter(b.C)), word(inverse_letter(b.J))
    balance = force + word(LAMBDA) * normal - residue
    free = reduce(left * balance * right, cancelling(b.C, b.J))
    return free + word(b.Z.acceleration)


def _multiplier(solved: Expr, b: Alphabet) -> tuple[Expr, Expr]:
    """λ = numerator / denominator from Tr Ż = 0."""
    total = trace(solved)
    with_multiplier = terms_with(total, LAMBDA)
    denominator = substitute(with_multiplier, {LAMBDA: number(1)})
    return -without(total, LAMBDA), denominator


def _relation(prefix: str, general: str, scope: str) -> Step:
    return Step(
        f"{prefix}.relation",
        "relation",
        (f"{general}.trivialisation",),
        (
            Equation(("det", "A"), 1),
            Equation(("tr", "Z"), 0),
            Equation(("tr", "ξ"), 0),
        ),
        "The group preserves the volume: its Lie algebra is that of the matrices of trace zero; "
        "C does not drop out. The origin is fixed, and its reaction holds the points, unless c = 0 "
        "and the forces have no resultant.",
        (),
        scope,
    )


def _motion_step(
    solved: Expr, multiplier: tuple[Expr, Expr], b: Alphabet, prefix: str, scope: str
) -> Step:
    inverses = {inverse_letter(x): ("inv", x.name) for x in (b.C, b.J)}
    notation = Notation(display=inverses)
    numerator, denominator = (tree_of(e, notation) for e in multiplier)
    return Step(
        f"{prefix}.motion",
        "solution",
        (f"{prefix}.multiplier", f"{prefix}.relation"),
        (
            Equation("Ȧ", tree_of(trivial_images(b)[b.A.velocity])),
            Equation("λ", ("div", numerator, denominator)),
            Equation("Ż", tree_of(solved, notation)),
        ),
        "The equations of motion of this problem: the trace of Ż vanishes, which gives the "
        "multiplier.",
        (),
        scope,
    )


def _coordinates(group: Group, prefix: str, scope: str) -> Step:
    """Z = Σ ζᵃ E_a entry by entry, and ζ̇ read off Ż."""
    rows: list[Tree] = []
    for i in range(group.n):
        row: list[Tree] = []
        for j in range(group.n):
            terms: list[Tree] = []
            for a, e in enumerate(group.basis, 1):
                if e[i][j]:
                    sign = int(e[i][j]) if e[i][j].denominator == 1 else e[i][j]
                    terms.append(
                        ("entry", "ζ", a) if sign == 1 else ("mul", sign, ("entry", "ζ", a))
                    )
            row.append(add(*terms))
        rows.append(("row", *row))
    equations = [Equation("Z", ("matrix", *rows))]
    for a in range(group.dimension):
        reading = group.reading(a)
        terms = [
            ("entry", "Ż", i + 1, j + 1) if c == 1 else ("mul", c, ("entry", "Ż", i + 1, j + 1))
            for c, i, j in reading
        ]
        equations.append(Equation(("entry", "ζ̇", a + 1), add(*terms)))
    return Step(
        f"{prefix}.coordinates",
        "coordinates",
        (f"{prefix}.relation",),
        tuple(equations),
        "Coordinates of the Lie algebra in the basis of the group.",
        (),
        scope,
    )
