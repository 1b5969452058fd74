"""Step 5.  The kernel of dϖ: the equations of motion (34), for any group (Exercise 1)."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import gradient, substitute, without
from ..algebra.notation import Notation, metrics, tree_of
from ..algebra.tree import Tree
from ..algebra.words import Expr, Letter, number, word
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .exterior import Exterior
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
        along |= {p.d_position: word(p.velocity), p.d_velocity: word(p.acceleration)}
    form = substitute(stage.form, along)
    shown = gathered(form, *_contracted(stage, form, a), metrics() if a.affine else metrics("J"))
    equations = []
    for part in a.parts:
        variation = part.dp_position.name
        virtual = gradient(without(form, a.dpt), part.dp_position)
        pairing: Tree = ("inner", tree_of(virtual), variation)
        if not a.affine:
            pairing = tree_of(without(_core(form, a), a.dpt), _ambient_notation(stage, a))
        equations.append(Equation(pairing, 0, (variation,)))
    velocity = tuple(Equation(p.rate, p.velocity.name) for p in a.parts)
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
            "X lies in the kernel when this vanishes for all displacements δ′ that the group "
            "allows: the equations of motion in the ambient space of matrices.",
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


def _ambient_notation(stage: Exterior, a: Alphabet) -> Notation:
    images = _contracted(stage, number(0), a)[1]
    return metrics("J", display={a.A.acceleration: tree_of(images[a.A.acceleration])})


def kernel_trivialised(stage: Exterior, a: Alphabet, prefix: str) -> Kernel:
    """The kernel in the variables (t, g, Z): Exercise 1 for every group that moves points."""
    along: dict[Letter, Expr] = {a.dt: number(1)}
    for f in a.frames:
        along |= {f.xi: word(f.velocity), f.d_velocity: word(f.acceleration)}
    form = substitute(stage.form, along)
    images: dict[Letter, Expr] = {f.xi_prime: stage.images[f.xi_prime] for f in a.frames}
    for f in a.frames:
        images[f.acceleration] = substitute(stage.images[f.d_velocity], along)
    core = without(terms_with(form, *(f.acceleration for f in a.frames)), a.dpt)
    first = tuple(
        Equation(("call", f.xi.name, "X"), tree_of(substitute(word(f.xi) - shift, along_time)))
        for f in a.frames
        for shift, along_time in ((stage.images[f.xi], {a.dt: number(1)}),)
    )
    steps = (
        Step(
            f"{prefix}.contraction_trivialised",
            "contraction",
            (f"{prefix}.exterior_trivialised",),
            (*first, Equation(CONTRACTION, gathered(form, core, images, Notation()))),
            "The same in the trivialisation.",
            given=("any acceleration",),
        ),
        _equations(core, images, a, prefix),
    )
    return Kernel(form, steps)


def _equations(core: Expr, images: dict[Letter, Expr], a: Alphabet, prefix: str) -> Step:
    """∂²L̃ (Ż + Z², ξ′) = −dŨ(gξ′) for every ξ′ in 𝔤, one equation for each part of ξ′."""
    equations = []
    quadratic = {f.acceleration: _without_force(images[f.acceleration], a) for f in a.frames}
    for k, f in enumerate(a.frames):
        others = {g.xi_prime: word(g.xi_prime) * 0 for j, g in enumerate(a.frames) if j != k}
        virtual = substitute(core, others) if others else core
        lhs = tree_of(virtual, Notation(display={x: tree_of(y) for x, y in quadratic.items()}))
        variations = [
            ("mul", "A", g.xi_prime.name) if j == k else 0 for j, g in enumerate(a.frames)
        ]
        rhs: Tree = ("mul", -1, ("call", "dŨ", *variations))
        equations.append(Equation(lhs, rhs, (f.xi_prime.name,)))
    return Step(
        f"{prefix}.equations",
        "kernel",
        (f"{prefix}.contraction_trivialised", f"{prefix}.force"),
        tuple(equations),
        "The equations of motion of any group that moves points (Exercise 1).",
    )


def _without_force(e: Expr, a: Alphabet) -> Expr:
    return without(e, a.f)
