"""Step 5.  The kernel of dϖ: the equations of motion (34), for any group (Exercise 1)."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import gradient, substitute, without
from ..algebra.notation import Notation, metrics, tree_of
from ..algebra.tree import Tree, add
from ..algebra.words import Expr, Letter, number, word
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import carry
from .exterior import Exterior, primed, work
from .gather import gathered, terms_with

CONTRACTION: Tree = ("call", "dϖ", "X", "δ′y")


@dataclass(frozen=True)
class Kernel:
    """``form`` = dϖ(X, δ′) on words, linear in the primed letters, for X with δt = 1."""

    form: Expr
    steps: tuple[Step, ...]


def kernel(stage: Exterior, a: Alphabet, prefix: str) -> Kernel:
    """The kernel in the variables (t, g, ν): the motion in the ambient matrices."""
    along: dict[Letter, Expr] = {a.dt: number(1)}
    for p in a.parts:
        along[p.d_position] = along_motion(stage, p.d_position, a)
        along[p.d_velocity] = word(p.acceleration)
    form = substitute(stage.form, along)
    notation = metrics() if a.affine else metrics("J")
    shown = gathered(form, *_contracted(stage, form, a), notation)
    velocity = tuple(Equation(p.rate, tree_of(along[p.d_position])) for p in a.parts)
    virtual = without(form, a.dpt)
    if a.affine:
        pairs = [
            ("inner", tree_of(gradient(virtual, p.dp_position)), p.dp_position.name)
            for p in a.parts
        ]
        balance = add(*pairs)
    else:
        core, images = _contracted(stage, form, a)
        kept = {a.A.acceleration: images[a.A.acceleration]}
        balance = gathered(virtual, core, kept, notation)
    variations = tuple(p.dp_position.name for p in a.parts)
    equations = (Equation(balance, 0, variations),)
    steps = (
        Step(
            f"{prefix}.contraction",
            "contraction",
            (f"{prefix}.exterior",),
            (Equation(CONTRACTION, shown),),
            "A vector X with δt = 1 and the velocity of the motion is put into dϖ.",
            given=("any acceleration",),
        ),
        Step(
            f"{prefix}.kernel",
            "kernel",
            (f"{prefix}.contraction",),
            (*velocity, *equations),
            "X spans the kernel when this vanishes for all displacements δ′ that the group allows: "
            "the equations of motion. They have one solution when the metric is not degenerate, "
            "that is, when no direction of the group leaves every mass in its place.",
        ),
    )
    return Kernel(form, steps)


def _core(form: Expr, a: Alphabet) -> Expr:
    return terms_with(form, *(p.acceleration for p in a.parts))


def _contracted(stage: Exterior, form: Expr, a: Alphabet) -> tuple[Expr, dict[Letter, Expr]]:
    """The terms with accelerations, and  ẍ ↦ ẍ − F̃,  δ′x ↦ δ′x − ẋ δ′t  to gather the rest."""
    images: dict[Letter, Expr] = {}
    for p in a.parts:
        images[p.dp_position] = stage.images.get(p.dp_position, word(p.dp_position))
        shift = stage.images.get(p.d_velocity, word(p.d_velocity))
        images[p.acceleration] = substitute(
            shift, {p.d_velocity: word(p.acceleration), a.dt: number(1)}
        )
    return without(_core(form, a), a.dpt), images


def along_motion(stage: Exterior, x: Letter, a: Alphabet) -> Expr:
    """δx(X) for δt = 1: what makes the horizontal variation δx − X δt vanish."""
    return substitute(word(x) - stage.images.get(x, word(x)), {a.dt: number(1)})


def kernel_trivialised(stage: Exterior, a: Alphabet, prefix: str) -> Kernel:
    """The kernel in the variables (t, g, Z): Exercise 1 for every group that moves points."""
    along: dict[Letter, Expr] = {a.dt: number(1)}
    for f in a.frames:
        along[f.xi] = along_motion(stage, f.xi, a)
        along[f.d_velocity] = word(f.acceleration)
    form = substitute(stage.form, along)
    images: dict[Letter, Expr] = {f.xi_prime: stage.images[f.xi_prime] for f in a.frames}
    for f in a.frames:
        images[f.acceleration] = substitute(stage.images[f.d_velocity], along)
    core = without(terms_with(form, *(f.acceleration for f in a.frames)), a.dpt)
    first = tuple(Equation(("call", f.xi.name, "X"), tree_of(along[f.xi])) for f in a.frames)
    steps = (
        Step(
            f"{prefix}.contraction_trivialised",
            "contraction",
            (f"{prefix}.exterior_trivialised",),
            (*first, Equation(CONTRACTION, gathered(form, core, images, Notation()))),
            "The same in the trivialisation.",
            given=("any acceleration",),
        ),
        _equations(form, core, images, a, prefix),
    )
    return Kernel(form, steps)


def _equations(
    form: Expr, core: Expr, images: dict[Letter, Expr], a: Alphabet, prefix: str
) -> Step:
    """dϖ(X, δ′) = 0 with the work of the forces carried to the right: −dŨ(gξ′)."""
    force = without(primed(carry(work(a), a), a), a.dpt)
    inertial = without(form, a.dpt) + force
    quadratic = {f.acceleration: without(images[f.acceleration], a.f) for f in a.frames}
    shown = gathered(inertial, core, quadratic, Notation())
    g = word(a.A.position)
    variations = [tree_of(g * word(f.xi_prime)) for f in a.frames]
    rhs: Tree = ("mul", -1, ("call", "dŨ", *variations))
    return Step(
        f"{prefix}.equations",
        "kernel",
        (f"{prefix}.contraction_trivialised", f"{prefix}.force"),
        (Equation(shown, rhs, tuple(f.xi_prime.name for f in a.frames)),),
        "The equations of motion of any group that moves points (Exercise 1), for every element "
        "of its Lie algebra.",
    )
