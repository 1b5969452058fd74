"""Step 5.  The kernel of dϖ: the equations of motion of any group (Exercise 1); here for one of
linear maps.

Ȧ = α,  ⟨δ′A, α̇ − F̃⟩_J = 0

For every δ′A tangent to the group: so dϖ(X, ·) vanishes, where δt(X) = 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ..algebra.calculus import gradient, substitute, terms_with, without
from ..algebra.forms import strip_left
from ..algebra.word_trees import WordNotation, metrics
from ..algebra.words import Expr, Letter, number, word
from ..language.tree import Tree, add
from ..record import sentence
from ..record.record import Equation, Step
from ..record.sentence import listed
from .alphabet import Alphabet
from .cartan import Cartan
from .chapter import Chapter, Draft
from .contraction import AND, CONTRACTION, Contraction, rate, steps_of, velocities
from .exterior import Exterior, primed
from .factorisation import at_constant_time, factored_tree
from .trivialisation import rates, trivial_images
from .variation import Principle
from .wording import say, say_signed


@dataclass(frozen=True)
class Kernel:
    """The kernel in the variables (t, g, ν): ``velocity``: δg(X), part by part;
    ``velocity_equations``: these as equations; ``balance``: what vanishes for every displacement
    δ′g tangent to the group."""

    velocity: Mapping[Letter, Expr]
    velocity_equations: tuple[Equation, ...]
    balance: Expr
    steps: tuple[Step, ...]


def on_kernel(stage: Exterior, a: Alphabet) -> tuple[dict[Letter, Expr], Expr]:
    """X with δt(X) = 1 and dϖ(X, ·) = 0: δg(X), where every δg − ν δt vanishes; and
    dϖ(X, δ′y) for δ′t = 0 and δν(X) = ν̇, which does so for every δ′g.

    That it has no δ′ν left is tested where the steps are made (``Contraction.on_vertical``)."""
    now = {a.dt: number(1)}
    moving = {x: word(x) - stage.images.get(x, word(x)) for x in (p.d_position for p in a.parts)}
    velocity = {x: substitute(e, now) for x, e in moving.items()}
    rates = {p.d_velocity: word(p.acceleration) for p in a.parts}
    return velocity, without(substitute(stage.form, now | velocity | rates), a.dpt)


def kernel(stage: Exterior, principle: Principle, a: Alphabet, chapter: Chapter) -> Kernel:
    """The kernel in the variables (t, g, ν), with its steps: by the ``principle`` it is the
    tangents of the motions."""
    notation = metrics() if a.affine else metrics("J")
    draft = chapter.draft("kernel", "kernel")
    *others, last_one = (x.name for p in a.parts for x in (p.d_position, p.d_velocity))
    velocity, virtual = on_kernel(stage, a)
    contracted, steps = steps_of(
        [
            Contraction(
                stage.form.of(principle.across),
                at_constant_time(stage.form, a.dt, a.dpt),
                stage.images,
                velocity,
                {p.d_velocity: p.acceleration for p in a.parts},
                tuple(p.dp_velocity for p in a.parts),
                (a.dt, a.dpt),
                notation,
                resting={p.dp_velocity: p.dp_position for p in a.parts},
                space="T_g G",
            )
        ],
        [p.d_position for p in a.parts],
        sentence.phrase(AND, first=", ".join(others), second=last_one),
        listed(AND, [rate(p.acceleration.name, p.d_velocity.name) for p in a.parts]),
        a,
        chapter,
    )
    mark = chapter.label("second_order")
    virtual = virtual.marked(mark)
    if a.affine:
        pairs = [
            ("inner", draft.tree(gradient(virtual, p.dp_position)), p.dp_position.name)
            for p in a.parts
        ]
        balance = add(*pairs)
    else:
        kept = {a.A.acceleration: contracted.shifts[a.A.acceleration].marked(mark)}
        balance = factored_tree(draft, virtual, contracted.remaining_core, kept, notation)
    along = {x: e.marked(mark) for x, e in velocity.items()}
    first_order = tuple(Equation(p.rate, draft.tree(along[p.d_position])) for p in a.parts)
    variations = tuple(p.dp_position.name for p in a.parts)
    last = draft.step(
        (*first_order, Equation(balance, 0, variations)),
        say("kernel.displacements")
        + say("kernel.tangent")
        + say(
            "kernel.energy",
            velocity=", ".join(f"{p.dp_position.name} = {p.velocity.name}" for p in a.parts),
        )
        + say_signed("kernel.line", a.signed),
    )
    return Kernel(along, steps[-1].given, draft.mark(virtual), (*steps, last))


def kernel_trivialised(
    stage: Exterior, natural: Kernel, cartan: Cartan, a: Alphabet, chapter: Chapter
) -> tuple[Step, ...]:
    """The steps of the kernel in the variables (t, g, Z): Exercise 1 for every group that moves
    points."""
    variations = [x for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity)]
    draft = chapter.draft("second_order_trivialised", "trivialisation")
    contracted = Contraction(
        stage.form,
        terms_with(without(stage.form, a.dt, a.dpt), *variations),
        stage.images,
        carried_velocity(natural, a),
        {f.d_velocity: f.acceleration for f in a.algebra_parts},
        tuple(f.dp_velocity for f in a.algebra_parts),
        (a.dt, a.dpt),
        WordNotation(),
    )
    first = draft.step(
        (
            *velocities(draft, contracted.velocity, contracted.velocity),
            Equation(CONTRACTION, contracted.remaining(draft), contracted.rates()),
        ),
        say("second_order_trivialised.carried"),
        where=natural.velocity_equations,
    )
    images, velocity = (
        {x: draft.mark(e) for x, e in found.items()}
        for found in (contracted.images, contracted.velocity)
    )
    found = replace(contracted, form=draft.mark(contracted.form), images=images, velocity=velocity)
    return first, _equations(found, cartan.work, a, chapter)


def carried_velocity(stage: Kernel, a: Alphabet) -> dict[Letter, Expr]:
    """The values ξ(X) = Z (and η(X) = w), by their letters, from gξ(X) = δg(X)."""
    carried, g = trivial_images(a), a.A.position
    return {
        f.xi: strip_left(substitute(stage.velocity[p.d_position], carried), g)
        for p, f in zip(a.parts, a.algebra_parts, strict=True)
    }


def balanced(d: Draft, c: Contraction, work: Expr, a: Alphabet) -> tuple[Expr, Tree]:
    """dϖ(X, δ′) for X with the velocity of the motion and δ′t = 0, without the ``work`` of the
    forces: on words, and as a tree by Ż + Z²."""
    inertial = without(c.second_order, a.dpt) + work
    shifts = {f.acceleration: without(c.shifts[f.acceleration], a.f) for f in a.algebra_parts}
    core = without(c.remaining_core, a.dpt)
    return inertial, factored_tree(d, inertial, core, shifts, WordNotation())


def _equations(c: Contraction, work: Expr, a: Alphabet, chapter: Chapter) -> Step:
    """The step dϖ(X, δ′) = 0, with the work of the forces carried to the right: −dŨ(gξ′)."""
    draft = chapter.draft("equations", "kernel")
    _, shown = balanced(draft, c, without(primed(work, a), a.dpt), a)
    images = trivial_images(a)
    rhs: Tree = ("mul", -1, ("call", "dŨ", *(draft.tree(images[p.dp_position]) for p in a.parts)))
    return draft.step(
        (*rates(draft, a), Equation(shown, rhs, tuple(f.xi_prime.name for f in a.algebra_parts))),
        say(
            "equations.exercise",
            acceleration="(Ż, ẇ)" if a.affine else "Ż",
        ),
    )
