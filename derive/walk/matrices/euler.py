"""SO(3) and SE(3) in vectors: dϖ by the momenta in the body, its kernel, Euler's equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...algebra.calculus import coefficient_of, gradient, reduce, substitute, terms_with, without
from ...algebra.word_trees import WordNotation, antisymmetry, hat, metrics, normal_form, tree_of
from ...algebra.words import Expr, Letter, inner, word
from ...language.tree import Tree, add, mul, terms
from ...record import sentence
from ...record.record import Equation, Step
from ...record.sentence import Sentence, listed
from ..chapter import Chapter, say, say_signed
from ..spine.alphabet import (
    AlgebraPart,
    Alphabet,
    Dual,
    cancel_scalar,
    inverse_letter,
    inverse_tree,
    inverses,
)
from ..spine.cartan import DOMEGA, primed
from ..spine.kernel import MomentumForm, along_motion, contact
from ..spine.principle import AND, Contraction, rate, steps_of
from .coordinates import at_constant_time
from .isomorphism import (
    BRACKET,
    D_SPIN,
    D_ZETA,
    INERTIA,
    OMEGA,
    OMEGA_P,
    SPIN,
    SPIN_RATE,
    SPINNING,
    TURNING,
    ZETA,
    ZETA_DOT,
    HatMap,
    anticommute,
    axis,
    inertia_of,
    vector_sum,
)
from .separation import central_moments
from .specialisation import Isometry, halved, momenta_prose, motion_prose

# SE(3): the translation is eliminated; the inertia about the centre of mass appears.
#
# The equations of vector hold for any origin in the body. The coefficient of ẇ is the scalar m,
# so ẇ is solved for and put into the other equation; what then multiplies ζ̇ is the tensor of
# inertia about the centre of mass. Nothing is assumed about c. Then everything is said from the
# centre of mass r_c, by c = m r_c and its velocity w_c, and the terms in c fall together.

CENTRAL = Letter("I_c", 3, 3, 1)
CENTRE, CENTRE_VELOCITY = Letter("r_c", 3), Letter("w_c", 3)


@dataclass(frozen=True)
class Eliminated:
    """The equations of SE(3), solved: ``torque`` = I_c ζ̇ and ``acceleration`` = ẇ on words, in ζ,
    w_c, r_c, m⁻¹, μ, F_b."""

    torque: Expr
    acceleration: Expr
    steps: tuple[Step, ...]

    @property
    def inertia(self) -> Step:
        """The step that says I_c."""
        return self.steps[0]


def eliminate(stage: VectorForm, a: Alphabet, c: Chapter) -> Eliminated:
    """The balance of forces solved for ẇ, and put into the balance of moments."""
    draft, w_dot = c.draft("elimination", "elimination"), a.w.acceleration
    forces, moments = stage.balance[a.w.xi_prime], stage.balance[OMEGA_P]
    acceleration = -simplified(word(inverse_letter(a.m)) * without(forces, w_dot), a)
    reduced = simplified(substitute(moments, {w_dot: acceleration}), a)
    tensor = coefficient_of(reduce(reduced, anticommute(ZETA_DOT)), ZETA_DOT)
    J_c, moments_c = central_moments(a)
    by_moments = substitute(tensor, {INERTIA: stage.inertia})
    central = substitute(by_moments, {a.J: word(J_c) + word(a.J) - moments_c})
    rest = -simplified(reduced - tensor * word(ZETA_DOT), a)
    shift = {INERTIA: word(CENTRAL) + word(INERTIA) - tensor}
    torque = from_centre(substitute(rest, shift), a)
    velocity = word(a.w.velocity) + word(hat(ZETA)) * word(CENTRE)
    carried = word(a.w.velocity) + word(CENTRE_VELOCITY) - velocity
    ending = reduce(acceleration, anticommute(a.w.velocity))
    acceleration = from_centre(substitute(ending, {a.w.velocity: carried}), a)
    draft.depends_on(acceleration, central, torque)
    step = draft.step(
        (
            Equation(CENTRE.name, tree_of(word(inverse_letter(a.m)) * word(a.c), inverses(a.m))),
            Equation(CENTRE_VELOCITY.name, vector_tree(velocity, a)),
            Equation(w_dot.name, vector_tree(acceleration, a)),
            Equation(J_c.name, tree_of(moments_c, inverses(a.m))),
            Equation(CENTRAL.name, tree_of(tensor, inverses(a.m))),
            Equation(CENTRAL.name, tree_of(central, inverses(a.m))),
            Equation(("mul", CENTRAL.name, "ζ̇"), vector_tree(torque, a)),
        ),
        say_signed("elimination.mass", a.signed) + say("elimination.velocity"),
    )
    return Eliminated(draft.mark(torque), draft.mark(acceleration), (step,))


def simplified(e: Expr, a: Alphabet) -> Expr:
    """The normal form of an expression, with m m⁻¹ = 1."""
    return cancel_scalar(normal_form(e), a.m)


def from_centre(e: Expr, a: Alphabet) -> Expr:
    """An expression with m r_c for c, simplified."""
    mass = word(a.m)
    images = {a.c: mass * word(CENTRE), hat(a.c): mass * word(hat(CENTRE))}
    return simplified(substitute(e, images), a)


def vector_tree(e: Expr, a: Alphabet) -> Tree:
    """The tree of a sum of vectors, the terms with m⁻¹ together behind one m⁻¹."""
    light, heavy = without(e, inverse_letter(a.m)), coefficient_of(e, inverse_letter(a.m))
    parts = [vector_sum(light, inverses(a.m))] if light else []
    if heavy:
        parts.append(mul(inverse_tree(a.m), vector_sum(heavy, inverses(a.m))))
    return add(*parts)


# SO(3) and SE(3) in vectors: dϖ by the momenta in the body, its kernel, and Euler's equations.
#
# dϖ = ⟨δℓ_b − μ δt, Ω′ − ζ δ′t⟩ + ⟨δp_b − F_b δt, η′ − w δ′t⟩ + ⟨ℓ_b, Ω′ ∧ Ω⟩ + … ,
#
# the general form read by j, with Π = ½ j(ℓ_b); then with the values of ℓ_b and p_b, (31) and
# (34). Makes the steps ``momenta`` to ``kernel`` of SO(3) and SE(3), Kirchhoff's equations among
# them.

HATS = tuple({hat(ZETA): word(hat(x))} for x in (TURNING.d_velocity, TURNING.dp_velocity, ZETA_DOT))
"""How j(ζ) varies with ζ: under δ, δ′ and along the motion."""


@dataclass(frozen=True)
class VectorForm:
    """The kernel in vectors: ``balance[v]`` = 0 for each free v of δ′; ``inertia``: I by J.

    ``momenta``: ℓ_b and p_b by their letters; ``coadjoint``: the same balance in these.
    """

    balance: dict[Letter, Expr]
    inertia: Expr
    momenta: dict[Letter, Expr]
    coadjoint: dict[Letter, Expr]
    steps: tuple[Step, ...]


def pairs_of(b: Alphabet) -> list[tuple[Dual, AlgebraPart]]:
    """The letters of ℓ_b with those of ζ and, for an affine action, of p_b with those of w."""
    return [(SPINNING, TURNING), *([(b.p_b, b.w)] if b.affine else [])]


def vector_form(general: MomentumForm, stage: Isometry, hat_map: HatMap, c: Chapter) -> VectorForm:
    """dϖ by vectors, and the kernel read off it, with the steps ``momenta`` to ``kernel``."""
    b, pairs = stage.letters, pairs_of(stage.letters)
    momenta = body_momenta(stage, hat_map)
    stating, varying = c.draft("momenta", "identification"), c.draft("exterior_vector", "relation")
    stating.depends_on(*momenta.values())
    naming = stating.step(
        [Equation(x.name, vector_sum(e)) for x, e in momenta.items()], momenta_prose(b)
    )
    values = {x: stating.mark(e) for x, e in momenta.items()}
    forces = pairing(stage, hat_map)
    acting = {d.force: forces[f.xi_prime] for d, f in pairs}
    by_value = along_motion(values | acting, [d for d, _ in pairs], [f for _, f in pairs], HATS)
    domega = hat_map.scalar(substitute(b.respell(general.form), halved(stage.values, b)))
    forms = _by_momenta(domega, pairs, acting, hat_map), _by_value(stage, hat_map)
    written = varying.step(
        [Equation(DOMEGA, x.tree(varying)) for x in forms],
        say("exterior_vector.momenta"),
        () if b.affine else (31,),
    )
    found, steps = steps_of(
        [x.marked_by(varying) for x in forms],
        [f.xi for _, f in pairs if f.xi.axis is None],
        _unknown(pairs),
        listed("{first}, {second}", _rates(pairs)),
        b,
        c,
        () if b.affine else (34,),
        *say_signed(f"second_order.{'displacement' if b.affine else 'rotation'}", b.signed),
    )
    balance, moving = _coadjoint(found, pairs, hat_map, b, c)
    rules = [anticommute(d.momentum) for d, _ in pairs]
    solved = {v: normal_form(substitute(reduce(e, *rules), by_value)) for v, e in balance.items()}
    motion = _kernel(solved, b, c)
    return VectorForm(
        {v: e.marked(motion.label) for v, e in solved.items()},
        inertia_of(b.J).marked(hat_map.inertia),
        values,
        balance,
        (naming, written, *steps, moving, motion),
    )


def body_momenta(stage: Isometry, hat_map: HatMap) -> dict[Letter, Expr]:
    """The values of ℓ_b and p_b, by their letters: ⟨Π, j(Ω)⟩ = ⟨ℓ_b, Ω⟩, and p_b in vectors.

    Π and p_b are those of the isometries, which :mod:`derive.walk.matrices.specialisation` reads
    off p̃.
    """
    b, found = stage.letters, dict[Letter, Expr]()
    for dual, part, (d, f) in zip(b.duals, b.algebra_parts, pairs_of(b), strict=True):
        paired = hat_map.scalar(inner(stage.values[dual.momentum], word(part.xi)))
        found[d.momentum] = gradient(reduce(paired, anticommute(f.xi)), f.xi)
    return found


def pairing(stage: Isometry, hat_map: HatMap) -> dict[Letter, Expr]:
    """The force of the walk in vectors, by Ω′ and η′, read off −dŨ(AΩ′, Aη′): Iφ, or μ and F_b."""
    virtual = hat_map.scalar(primed(stage.cartan.work, stage.letters))
    return {f.xi_prime: gradient(virtual, f.xi_prime) for _, f in pairs_of(stage.letters)}


def _by_momenta(
    domega: Expr,
    pairs: Sequence[tuple[Dual, AlgebraPart]],
    forces: Mapping[Letter, Expr],
    hat_map: HatMap,
) -> Contraction:
    """dϖ in ℓ_b, p_b and their variations, ready to be contracted."""
    b = hat_map.letters
    return Contraction(
        domega,
        at_constant_time(domega, b.dt, b.dpt),
        contact(pairs, b, forces),
        _velocity(pairs),
        {d.d_momentum: d.rate for d, _ in pairs} | {hat(D_SPIN): hat(SPIN_RATE)},
        tuple(x for d, _ in pairs for x in (d.dp_momentum, hat(d.dp_momentum))),
        _notation(hat_map),
        **_brackets(pairs, hat_map),
    )


def _by_value(stage: Isometry, hat_map: HatMap) -> Contraction:
    """dϖ in ζ and w, as (31), ready to be contracted."""
    b, pairs, form = stage.letters, pairs_of(stage.letters), hat_map.scalar(stage.form)
    return Contraction(
        form,
        without(form, b.dt, b.dpt),
        {axis(x): hat_map.vector(y) for x, y in stage.images.items()},
        _velocity(pairs),
        {f.d_velocity: f.acceleration for _, f in pairs} | {hat(D_ZETA): hat(ZETA_DOT)},
        tuple(x for _, f in pairs for x in (f.dp_velocity, hat(f.dp_velocity))),
        _notation(hat_map),
        resting={f.dp_velocity: f.xi_prime for _, f in pairs},
        **_brackets(pairs, hat_map),
    )


def _velocity(pairs: Sequence[tuple[Dual, AlgebraPart]]) -> dict[Letter, Expr]:
    """The values Ω(X) = ζ and η(X) = w, by their letters."""
    return {f.xi: word(f.velocity) for _, f in pairs} | {hat(OMEGA): word(hat(ZETA))}


def _notation(hat_map: HatMap) -> WordNotation:
    return metrics("I", display={x: tree_of(e) for x, e in hat_map.brackets.items()})


def _brackets(pairs: Sequence[tuple[Dual, AlgebraPart]], hat_map: HatMap) -> dict[str, Any]:
    """The fields ``display`` and ``opening`` of a contraction: how the brackets read, and what they
    are, once X has the velocity of the motion."""
    velocity = _velocity(pairs)
    opened = {x: substitute(e, velocity).marked() for x, e in hat_map.brackets.items()}
    turning = opened.pop(BRACKET)
    return {
        "display": {BRACKET: tree_of(turning)},
        "opening": lambda e: reduce(substitute(e, opened), antisymmetry),
    }


def _unknown(pairs: Sequence[tuple[Dual, AlgebraPart]]) -> Sentence:
    """The components of X that are unknown, in words."""
    *others, last = [f.xi.name for _, f in pairs] + [f.d_velocity.name for _, f in pairs]
    return sentence.phrase(AND, first=", ".join(others), second=last)


def _rates(pairs: Sequence[tuple[Dual, AlgebraPart]]) -> list[Sentence]:
    """The phrases that say what ζ̇, ẇ, ℓ̇_b, ṗ_b are."""
    rates = [(f.acceleration, f.d_velocity) for _, f in pairs]
    rates += [(d.rate, d.d_momentum) for d, _ in pairs]
    return [rate(x.name, y.name) for x, y in rates]


def _coadjoint(
    c: Contraction,
    pairs: Sequence[tuple[Dual, AlgebraPart]],
    hat_map: HatMap,
    b: Alphabet,
    chapter: Chapter,
) -> tuple[dict[Letter, Expr], Step]:
    """The balance of moments and forces, coefficients of Ω′ and η′, in ℓ_b and p_b; and the step of
    ℓ̇_b and ṗ_b (Euler, Kirchhoff)."""
    draft = chapter.draft("coadjoint", "kernel")
    bracket = substitute(hat_map.brackets[BRACKET], c.velocity).marked()
    opened = substitute(without(c.second_order, b.dpt), {BRACKET: bracket})
    opened = opened.marked(chapter.label("second_order"))
    balance = {
        f.xi_prime: normal_form(gradient(reduce(opened, anticommute(f.xi_prime)), f.xi_prime))
        for _, f in pairs
    }
    rates = {d.rate: word(d.rate) - balance[f.xi_prime] for d, f in pairs}
    draft.depends_on(*rates.values())
    step = draft.step(
        [Equation(x.name, spun(vector_sum(e))) for x, e in rates.items()],
        (say("coadjoint.turning_and_moving") if b.affine else say("coadjoint.turning"))
        + say("coadjoint.energy", motion="Ω′ = ζ, η′ = w" if b.affine else "Ω′ = ζ")
        + say_signed("kernel.line", b.signed)
        + motion_prose(b),
    )
    return {v: draft.mark(e) for v, e in balance.items()}, step


def spun(t: Tree) -> Tree:
    """The tree of a sum in which ℓ_b ∧ ζ, first, is written for −(ζ ∧ ℓ_b)."""
    against: Tree = ("mul", -1, ("wedge", ZETA.name, SPIN.name))
    if against not in terms(t):
        return t
    return add(("wedge", SPIN.name, ZETA.name), *(x for x in terms(t) if x != against))


def _kernel(balance: dict[Letter, Expr], b: Alphabet, c: Chapter) -> Step:
    draft = c.draft("kernel", "kernel")
    inertial = {OMEGA_P: word(INERTIA) * word(ZETA_DOT)}
    equations = []
    for v, e in balance.items():
        moving = terms_with(e, ZETA_DOT, hat(ZETA_DOT), b.w.acceleration)
        left = moving if b.affine else inertial[v]
        draft.depends_on(e)
        equations.append(Equation(tree_of(left), vector_sum(left - e)))
    return draft.step(
        equations,
        say("kernel.values") if b.affine else say("kernel.value"),
        () if b.affine else (34,),
    )
