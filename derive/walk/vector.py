"""so(3) ≅ R³: the vector form (31)–(34) of the equations of SO(3) and SE(3)."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import PairRule, gradient, reduce, substitute, without
from ..algebra.notation import Notation, metrics, tree_of
from ..algebra.space import antisymmetry, double, fold_inertia, hat, normal_form
from ..algebra.tree import Tree
from ..algebra.words import Expr, Factor, Letter, inner, number, trace, word, zero
from ..record.record import Equation, Step
from ..record.sentence import listed, phrase, say
from .contraction import AND, LINE, Contraction, NoKernelError, rate, steps_of, velocities
from .exterior import DOMEGA
from .gather import gathered
from .isometry import Isometry
from .wedge import vector_sum


def _vector(name: str) -> Letter:
    return Letter(name, 3)


ZETA, OMEGA, OMEGA_P = _vector("ζ"), _vector("Ω"), _vector("Ω′")
D_ZETA, DP_ZETA, ZETA_DOT = _vector("δζ"), _vector("δ′ζ"), _vector("ζ̇")
PHI, MU, BRACKET = _vector("φ"), _vector("μ"), _vector("Ω′ ∧ Ω")
INERTIA = Letter("I", 3, 3, 1)
AXES = {"Z": ZETA, "ξ": OMEGA, "ξ′": OMEGA_P, "δZ": D_ZETA, "δ′Z": DP_ZETA, "f": PHI}


@dataclass(frozen=True)
class VectorForm:
    """The kernel in vectors: ``balance[v]`` = 0 for each free v of δ′; ``inertia`` = I by J."""

    balance: dict[Letter, Expr]
    inertia: Expr
    steps: tuple[Step, ...]


def vector_form(stage: Isometry, prefix: str, general: str, scope: str) -> VectorForm:
    """Write ϖ's derivative by vectors and read the kernel off it."""
    b = stage.letters
    domega = to_vectors(stage.exterior.form, stage)
    images = {
        _axis(x): _flat(to_vectors_matrix(y, stage)) for x, y in stage.exterior.images.items()
    }
    display = {BRACKET: tree_of(axis_of_bracket(stage))}
    if b.affine:
        display[b.bracket_w] = tree_of(_bracket_w(stage))
    notation = metrics("I", display=display)
    flat = gathered(domega, without(domega, b.dt, b.dpt), images, notation)
    steps = [
        _identification(stage, prefix, scope),
        _inertia(stage, prefix, scope),
        Step(
            f"{prefix}.exterior_vector",
            "identification",
            (f"{prefix}.exterior", f"{prefix}.hat", f"{prefix}.inertia"),
            (Equation(DOMEGA, flat),),
            say("The exterior derivative in vectors."),
            () if b.affine else (31,),
            scope,
        ),
    ]
    c = _contraction(domega, images, notation, stage)
    bracket = {BRACKET: substitute(axis_of_bracket(stage), c.velocity)}
    opened = substitute(without(c.second_order, b.dpt), bracket)
    balance = {
        v: normal_form(gradient(reduce(opened, isolate(v)), v))
        for v in ((OMEGA_P, b.w.xi_prime) if b.affine else (OMEGA_P,))
    }
    known = [x for x in c.velocity if x.axis is None]
    steps += steps_of(
        c,
        velocities(c.velocity, known),
        phrase(AND, first="Ω, η, δζ", second="δw")
        if b.affine
        else phrase(AND, first="Ω", second="δζ"),
        listed(AND, [rate("ζ̇", "δζ"), *([rate("ẇ", "δw")] if b.affine else [])]),
        prefix,
        f"{prefix}.exterior_vector",
        () if b.affine else (34,),
        scope,
        phrase("the metric is not degenerate (the masses are not all on one line)")
        if b.affine
        else phrase(
            "the tensor I is invertible (the masses are not all on one line through the "
            "fixed point)"
        ),
    )
    steps.append(_kernel(balance, stage, prefix, scope))
    return VectorForm(balance, inertia_of(b.J), tuple(steps))


def _contraction(
    domega: Expr, images: dict[Letter, Expr], notation: Notation, stage: Isometry
) -> Contraction:
    """dϖ(X, δ′) in vectors, with Ω(X) (and η(X)) read off the horizontal variations."""
    b = stage.letters
    unknown = (OMEGA, b.w.xi) if b.affine else (OMEGA,)
    if any(x not in images for x in unknown):
        raise NoKernelError("the velocity of the kernel cannot be read off dϖ")
    velocity = {x: substitute(word(x) - images[x], {b.dt: number(1)}) for x in unknown}
    (turning,) = velocity[OMEGA].letters()
    velocity[hat(OMEGA)] = word(hat(turning))
    rates = {D_ZETA: ZETA_DOT, hat(D_ZETA): hat(ZETA_DOT)}
    vertical: tuple[Letter, ...] = (DP_ZETA, hat(DP_ZETA))
    brackets = {}
    if b.affine:
        rates[b.w.d_velocity] = b.w.acceleration
        vertical = (*vertical, b.w.dp_velocity)
        brackets[b.bracket_w] = substitute(_bracket_w(stage), velocity)
    display = {BRACKET: tree_of(substitute(axis_of_bracket(stage), velocity))}
    core, times = without(domega, b.dt, b.dpt), (b.dt, b.dpt)
    return Contraction(
        domega,
        core,
        images,
        velocity,
        rates,
        vertical,
        times,
        notation,
        display,
        lambda e: reduce(substitute(e, brackets), antisymmetry),
    )


def isolate(v: Letter) -> PairRule:
    """``v ∧ y = −y ∧ v``: carry the vector v out of every j(v)."""

    def rule(left: Factor, right: Factor) -> Expr | None:
        (a, a_bar), (b, b_bar) = left, right
        if a.axis == v and b.cols == 1 and not b_bar:
            return -(word(hat(b)) * word(v))
        if b.axis == v and a.cols == 1 and a_bar:
            return -(word(v).bar * word(hat(a)))
        return None

    return rule


def to_vectors(e: Expr, stage: Isometry) -> Expr:
    """A scalar on so(3) by vectors: Z → j(ζ), traces with J by the inertia, N_b by the moment μ."""
    b = stage.letters
    images = {x: word(hat(_axis(x))) for x in e.letters() if x.name in AXES}
    images[b.bracket] = word(hat(BRACKET))
    work = fold_inertia(substitute(e, images), b.J, INERTIA)
    return normal_form(_fold_moment(work, b.N_body))


def to_vectors_matrix(e: Expr, stage: Isometry) -> Expr:
    """A combination of skew letters as the combination of their hats (vectors stay)."""
    images = {x: word(hat(_axis(x))) for x in e.letters() if x.name in AXES}
    return substitute(e, images) if images else e


def _axis(x: Letter) -> Letter:
    return AXES.get(x.name, x)


def _flat(e: Expr) -> Expr:
    """j(a) + j(b) ↦ a + b for a sum of single hats; sums of vectors stay."""
    terms = {}
    for (traces, w), c in e.terms.items():
        axis = w[0][0].axis
        terms[traces, w if axis is None else ((axis, False),)] = c
    return Expr(e.rows, 1, terms)


def _fold_moment(e: Expr, moment: Letter) -> Expr:
    """``Tr N_b j(x)‾ = ⟨μ, x⟩``: what defines the moment of the forces."""
    total = number(0)
    for (traces, _), c in e.terms.items():
        term = number(c)
        for cycle in traces:
            axes = [x.axis for x, _ in cycle if x.axis is not None]
            if len(cycle) == 2 and axes and any(x == moment for x, _ in cycle):
                barred = any(bar for x, bar in cycle if x == moment)
                folded = inner(word(MU), word(axes[0])) * (1 if barred else -1)
            else:
                folded = Expr(1, 1, {((cycle,), ()): number(1).terms[(), ()]})
            term = term * folded
        total = total + term
    return total


def axis_of_bracket(stage: Isometry) -> Expr:
    """The vector of the bracket [ξ′, ξ], from the structure equation with ξ = j(Ω), ξ′ = j(Ω′)."""
    bracket = to_vectors_matrix(stage.brackets[stage.letters.bracket], stage)
    return reduce(axial(normal_form(bracket)), isolate(OMEGA))


def axial(e: Expr) -> Expr:
    """X with j(X) the given skew sum of words y x̄: from  j(x ∧ y) = y x̄ − x ȳ."""
    total = zero(3, 1)
    for (traces, w), c in e.terms.items():
        (y, _), (x, _) = w
        term = Expr(1, 1, {(traces, ()): c / 2})
        total = total + term * (word(hat(x)) * word(y))
    return normal_form(total)


def _bracket_w(stage: Isometry) -> Expr:
    """The translation part of the bracket in vectors."""
    return normal_form(to_vectors_matrix(stage.brackets[stage.letters.bracket_w], stage))


def _identification(stage: Isometry, prefix: str, scope: str) -> Step:
    affine = stage.letters.affine
    pairs = [("Z", "ζ"), ("ξ", "Ω"), ("ξ′", "Ω′")] + ([] if affine else [("f", "φ")])
    equations = [Equation(x, ("hat", y)) for x, y in pairs]
    cross = tree_of(axis_of_bracket(stage))
    equations.append(Equation(("bracket", "ξ′", "ξ"), ("hat", cross)))
    if affine:
        pairing: Tree = ("tr", ("mul", "N_b", ("T", ("hat", "Ω′"))))
        equations.append(Equation(pairing, ("inner", "μ", "Ω′"), ("Ω′",)))
    return Step(
        f"{prefix}.hat",
        "identification",
        (f"{prefix}.relation",),
        tuple(equations),
        say(
            "The linear part 𝔰𝔬(3) of the Lie algebra is identified with R³ by j(X)Y = X ∧ "
            "Y; the bracket is the vector product."
        )
        if affine
        else say(
            "The Lie algebra 𝔰𝔬(3) is identified with R³ by j(X)Y = X ∧ Y; the bracket is "
            "the vector product."
        ),
        () if affine else (33,),
        scope,
    )


def _inertia(stage: Isometry, prefix: str, scope: str) -> Step:
    tensor = inertia_of(stage.letters.J)
    traced: Tree = ("tr", ("mul", ("hat", "ζ"), "J", ("T", ("hat", "Ω"))))
    return Step(
        f"{prefix}.inertia",
        "identification",
        (f"{prefix}.hat", f"{prefix}.cartan"),
        (Equation(traced, ("metric", "I", "ζ", "Ω")), Equation("I", tree_of(tensor))),
        say("The metric of J on 𝔰𝔬(3) is that of the tensor of inertia on R³."),
        () if stage.letters.affine else (32,),
        scope,
    )


def inertia_of(J: Letter) -> Expr:
    """I with  Tr j(ζ) J j(Ω)‾ = ⟨ζ, IΩ⟩,  by the double vector product under the trace."""
    pairing = reduce(trace(word(hat(ZETA)) * word(J) * word(hat(OMEGA)).bar), double)
    return strip_right(gradient(pairing, ZETA), OMEGA)


def strip_right(e: Expr, vector: Letter) -> Expr:
    """The matrix M with e = M x, for a last letter x common to every term."""
    terms = {}
    for (traces, w), c in e.terms.items():
        if not w or w[-1] != (vector, False):
            raise ValueError(f"{vector.name} is not a common right factor")
        terms[traces, w[:-1]] = c
    return Expr(e.rows, vector.rows, terms)


def _kernel(balance: dict[Letter, Expr], stage: Isometry, prefix: str, scope: str) -> Step:
    b = stage.letters
    inertial = {OMEGA_P: word(INERTIA) * word(ZETA_DOT)}
    equations = []
    for v, e in balance.items():
        left = inertial[v] if not b.affine else _accelerations(e, b.w.acceleration)
        equations.append(Equation(tree_of(left), vector_sum(left - e)))
    motion = say("The coefficient of Ω′ must vanish: the equations of motion.")
    if b.affine:
        motion = say("The coefficients of Ω′ and of η′ must vanish: the equations of motion.")
    return Step(
        f"{prefix}.kernel",
        "kernel",
        (f"{prefix}.second_order",),
        tuple(equations),
        motion
        + say(
            "That of δ′t then vanishes as well: it is the opposite of what the rest gives for "
            "{motion}.",
            motion="Ω′ = ζ, η′ = w" if b.affine else "Ω′ = ζ",
        )
        + LINE,
        () if b.affine else (34,),
        scope,
    )


def _accelerations(e: Expr, w_dot: Letter) -> Expr:
    terms = {
        key: c
        for key, c in e.terms.items()
        if any(x in (ZETA_DOT, hat(ZETA_DOT), w_dot) for part in (*key[0], key[1]) for x, _ in part)
    }
    return Expr(e.rows, e.cols, terms)
