"""Step 5.  The kernel of dϖ: the equations of motion (34), for any group (Exercise 1)."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import gradient, substitute, without
from ..algebra.notation import Notation, metrics, tree_of
from ..algebra.tree import Tree, add
from ..algebra.words import Expr, Letter, number, word
from ..record.record import Equation, Step
from ..record.sentence import listed, phrase, say
from .alphabet import Alphabet
from .cartan import carry, rates
from .contraction import AND, CONTRACTION, LINE, Contraction, rate, steps_of, velocities
from .exterior import Exterior, primed, work
from .gather import at_constant_time, gathered, terms_with


@dataclass(frozen=True)
class Kernel:
    """``form`` = dϖ(X, δ′) on words, linear in the primed letters, for X with δt = 1."""

    form: Expr
    steps: tuple[Step, ...]


def kernel(stage: Exterior, a: Alphabet, prefix: str) -> Kernel:
    """The kernel in the variables (t, g, ν): the motion in the ambient matrices."""
    notation = metrics() if a.affine else metrics("J")
    c = Contraction(
        stage.form,
        at_constant_time(stage.form, a.dt, a.dpt),
        stage.images,
        {p.d_position: along_motion(stage, p.d_position, a) for p in a.parts},
        {p.d_velocity: p.acceleration for p in a.parts},
        tuple(p.dp_velocity for p in a.parts),
        (a.dt, a.dpt),
        notation,
    )
    virtual = without(c.second_order, a.dpt)
    if a.affine:
        pairs = [
            ("inner", tree_of(gradient(virtual, p.dp_position)), p.dp_position.name)
            for p in a.parts
        ]
        balance = add(*pairs)
    else:
        kept = {a.A.acceleration: c.shifts[a.A.acceleration]}
        balance = gathered(virtual, c.remaining_core, kept, notation)
    first_order = tuple(Equation(p.rate, tree_of(c.velocity[p.d_position])) for p in a.parts)
    variations = tuple(p.dp_position.name for p in a.parts)
    velocity = ", ".join(f"{p.dp_position.name} = {p.velocity.name}" for p in a.parts)
    last = Step(
        f"{prefix}.kernel",
        "kernel",
        (f"{prefix}.second_order",),
        (*first_order, Equation(balance, 0, variations)),
        say(
            "X is in the kernel if and only if this expression vanishes for every "
            "displacement tangent to the group: the equations of motion."
        )
        + say(
            "They fix the part of the acceleration that is tangent to the group; the velocity "
            "gives the rest."
        )
        + say(
            "The coefficient of δ′t then vanishes as well, for {velocity} is such a displacement.",
            velocity=velocity,
        )
        + LINE,
    )
    unknown = tuple(x.name for p in a.parts for x in (p.d_position, p.d_velocity))
    first = velocities(c.velocity, c.velocity)
    *others, last_one = unknown
    names = phrase(AND, first=", ".join(others), second=last_one)
    dots = [rate(p.acceleration.name, p.d_velocity.name) for p in a.parts]
    steps = steps_of(c, first, names, listed(AND, dots), prefix, f"{prefix}.exterior")
    return Kernel(c.second_order, (*steps, last))


def along_motion(stage: Exterior, x: Letter, a: Alphabet) -> Expr:
    """δx(X) for δt = 1: what makes the horizontal variation δx − X δt vanish."""
    return substitute(word(x) - stage.images.get(x, word(x)), {a.dt: number(1)})


def kernel_trivialised(stage: Exterior, a: Alphabet, prefix: str) -> Kernel:
    """The kernel in the variables (t, g, Z): Exercise 1 for every group that moves points."""
    variations = [x for f in a.frames for x in (f.d_velocity, f.dp_velocity)]
    c = Contraction(
        stage.form,
        terms_with(without(stage.form, a.dt, a.dpt), *variations),
        stage.images,
        {f.xi: along_motion(stage, f.xi, a) for f in a.frames},
        {f.d_velocity: f.acceleration for f in a.frames},
        tuple(f.dp_velocity for f in a.frames),
        (a.dt, a.dpt),
        Notation(),
    )
    steps = (
        Step(
            f"{prefix}.second_order_trivialised",
            "trivialisation",
            (
                f"{prefix}.exterior_trivialised",
                f"{prefix}.second_order",
                f"{prefix}.trivialisation",
            ),
            (*velocities(c.velocity, c.velocity), Equation(CONTRACTION, c.remaining())),
            say("The velocity of X is carried to the Lie algebra, and put into this form of dϖ."),
            given=("any acceleration",),
        ),
        _equations(c, a, prefix),
    )
    return Kernel(c.second_order, steps)


def _equations(c: Contraction, a: Alphabet, prefix: str) -> Step:
    """dϖ(X, δ′) = 0 with the work of the forces carried to the right: −dŨ(gξ′)."""
    force = without(primed(carry(work(a), a), a), a.dpt)
    inertial = without(c.second_order, a.dpt) + force
    quadratic = {f.acceleration: without(c.shifts[f.acceleration], a.f) for f in a.frames}
    shown = gathered(inertial, without(c.remaining_core, a.dpt), quadratic, Notation())
    g = word(a.A.position)
    variations = [tree_of(g * word(f.xi_prime)) for f in a.frames]
    rhs: Tree = ("mul", -1, ("call", "dŨ", *variations))
    names = tuple(f.xi_prime.name for f in a.frames)
    force_steps = (f"{prefix}.force",) if a.affine else (f"{prefix}.force", f"{prefix}.gradient")
    return Step(
        f"{prefix}.equations",
        "kernel",
        (f"{prefix}.second_order_trivialised", f"{prefix}.trivialisation", *force_steps),
        (*rates(a), Equation(shown, rhs, names)),
        say(
            "The equations of motion of any group of matrices that moves points (Exercise 1), one "
            "for each direction of its Lie algebra, to which {acceleration} belongs.",
            acceleration="(Ż, ẇ)" if a.affine else "Ż",
        ),
    )
