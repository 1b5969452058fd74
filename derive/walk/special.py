"""One problem on one group: its relations, ϖ and dϖ with its potential, its forces and energy.

What :mod:`derive.walk.kernel` says for any group is written in the letters of this one, which know
more: where Z is skew, C = 1; where its trace vanishes, so do those of ξ and Ż.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from ..algebra import forms
from ..algebra.calculus import Image, gradient, reduce, substitute, without
from ..algebra.groups import Group
from ..algebra.notation import Notation
from ..algebra.tree import Tree
from ..algebra.words import Expr, Letter, inner, number, word
from ..record.record import Equation, Step
from ..record.sentence import Prose, say
from .alphabet import Alphabet
from .cartan import Cartan, form_equation
from .chapter import Chapter, Draft
from .coadjoint import coadjoint_steps
from .contraction import Contraction
from .exterior import DOMEGA, Exterior, brackets_of, primes, trivial_variations
from .gather import gathered, terms_with
from .kernel import Ambient, balanced
from .lagrangian import Lagrangian
from .momentum import Momenta
from .orbit import Distances
from .potential import U_Q, Potentials, virtual_work
from .trivialisation import frame_rule, gram, rates


@dataclass(frozen=True)
class General:
    """What is known of every group of one action: letters, trivialised forms, kernel.

    ``points``: what is said of them, ``distances``: by C; ``momentum``: p̃(δg) in space;
    ``pushed``: −dŨ(δg) by the moments of forces; ``ambient``: the kernel in space.
    """

    letters: Alphabet
    points: Lagrangian
    momentum: Expr
    pushed: Expr
    cartan: Cartan
    exterior: Exterior
    momenta: Momenta
    distances: Distances
    ambient: Ambient
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Special:
    """``inertial``: dϖ(X, δ′) without the work of the ``forces`` on ξ′ (and η′).

    ``gram``: ĀA, the letter C or 1.  ``last``: steps that belong at the end of the record.
    """

    letters: Alphabet
    gram: Expr
    inertial: Expr
    forces: dict[Letter, Expr]
    steps: tuple[Step, ...]
    last: tuple[Step, ...]

    def pushed(self, moments: Expr, resultant: Expr) -> Special:
        """The same with further forces on ξ′ (and η′)."""
        b = self.letters
        more = {b.Z.xi_prime: moments, b.w.xi_prime: resultant}
        return replace(self, forces={x: e + more[x] for x, e in self.forces.items()})


def letters_of(group: Group, *, signed: bool) -> Alphabet:
    """The alphabet of a group: skew or traceless letters where its relations say so.

    ``signed``: masses may be negative.
    """
    skew = "orthogonal" in group.relations
    traceless = "unimodular" in group.relations and not skew
    known = {"skew": skew, "traceless": traceless, "signed": signed}
    return Alphabet(group.n, affine=group.affine, **known)


def specialise(road: General, group: Group, v: Potentials, c: Chapter) -> Special:
    """The forms, forces and energy of a problem."""
    b = letters_of(group, signed=road.letters.signed)
    plain = Alphabet(group.n, affine=group.affine, signed=b.signed)
    free, turned = b.freed(), "orthogonal" in group.relations
    whole = b.unit.marked(c.label("relation")) if turned else gram(b)
    carried = frame_rule(b, whole)

    def restricted(e: Expr, letters: Alphabet = plain) -> Expr:
        """An expression about any group on this one, where C may be 1."""
        found = letters.respell(e, whole)
        return found.of(whole) if turned else found

    eta = word(b.w.xi_prime) if b.affine else None
    virtual = virtual_work(v, b, word(free.Z.xi_prime), eta)
    primed = [f.xi_prime for f in free.frames]
    forces = {x: reduce(gradient(virtual, x), carried) for x in primed}
    potential = {plain.U: reduce(v.energy, frame_rule(plain, gram(plain)))}
    energy = substitute(plain.respell(road.cartan.energy), potential)
    momentum = plain.respell(road.cartan.momentum)
    pushing, weighing = c.draft("force", "variation"), c.draft("energy", "pull-back")
    pushes = _forces(forces, pushing)
    said = {x: pushing.said(e).of(road.pushed) for x, e in forces.items()}
    contraction, formed = _forms(momentum, energy, road.exterior, v, plain, restricted, c)
    inertial, motion = _kernel(contraction, [*said.values()], plain, c)
    steps = (
        *_relation(group, c),
        *v.steps,
        *formed,
        *(coadjoint_steps(road.momenta, b, whole, c) if turns_whole(group) else ()),
        pushes,
        motion,
    )
    last = weighing.step(
        (Equation("h̃", weighing.tree(restricted(energy))),), say("The energy of this problem.")
    )
    return Special(free, whole, free.respell(inertial), said, steps, (last,))


def turns_whole(group: Group) -> bool:
    """Are the linear parts all skew matrices, so that a skew coefficient of ξ′ vanishes?"""
    n = group.n
    return "orthogonal" in group.relations and len(group.linear_basis) == n * (n - 1) // 2 > 0


def _relation(group: Group, c: Chapter) -> tuple[Step, ...]:
    """What the group keeps, read off the basis of its Lie algebra."""
    if "orthogonal" in group.relations:
        claims: tuple[tuple[Tree, Tree], ...] = (
            ("C", ("one",)),
            (("T", "Z"), ("mul", -1, "Z")),
            (("T", "ξ"), ("mul", -1, "ξ")),
        )
    elif "unimodular" in group.relations:
        claims = ((("det", "A"), 1), (("tr", "Z"), 0), (("tr", "ξ"), 0))
    else:
        return ()
    equations = tuple(Equation(*claim) for claim in claims)
    return (c.draft("relation", "relation").step(equations, _kept(group) + _smaller(group)),)


def _smaller(group: Group) -> Prose:
    """That the relations are not all, where others have them, too."""
    n, skew = group.n, "orthogonal" in group.relations
    whole = n * (n - 1) // 2 if skew else n * n - 1
    if group.affine:
        whole += n
    if group.dimension == whole:
        return ()
    return say(
        "There are more relations: the Lie algebra has dimension {dimension}, and its elements are "
        "those in the step of the coordinates.",
        dimension=str(group.dimension),
    )


def _kept(group: Group) -> Prose:
    skew = "orthogonal" in group.relations
    if group.affine:
        if skew:
            return say("The linear parts of the Lie algebra are skew, so ĀA = 𝟏 and C drops out.")
        return say(
            "The linear parts of the Lie algebra have trace zero, so the volume is kept; C does "
            "not drop out."
        )
    if skew:
        return say("The matrices of the Lie algebra are skew, so ĀA = 𝟏 and C drops out.")
    prose = say(
        "The matrices of the Lie algebra have trace zero, so the volume is kept; C does not drop "
        "out."
    )
    if group.factors:
        return prose
    return (
        prose
        + say(
            "Only maps that fix the origin are allowed: a constraint, whose reaction at the "
            "origin is α̇c less the sum of the forces."
        )
        + say("It vanishes if c = 0 and the forces have no resultant.")
    )


def _forms(
    momentum: Expr,
    energy: Expr,
    exterior: Exterior,
    v: Potentials,
    a: Alphabet,
    restricted: Callable[[Expr], Expr],
    c: Chapter,
) -> tuple[Contraction, tuple[Step, Step]]:
    """ϖ and dϖ with the potential of the problem, whose variation is that of the group.

    They are varied with C, which is restricted to the group afterwards.
    """
    writing, varying = c.draft("cartan", "relation"), c.draft("exterior", "exterior derivative")
    form = writing.said(momentum - energy * word(a.dt))
    delta, delta_prime = trivial_variations(a, brackets_of(a), number(0))
    etas = (word(a.w.xi), word(a.w.xi_prime)) if a.affine else (None, None)
    pushed = [v.work(word(x), y) for x, y in zip((a.Z.xi, a.Z.xi_prime), etas, strict=True)]
    delta = _with(delta, word(a.dU_dt) * word(a.dt) - pushed[0])
    delta_prime = _with(delta_prime, word(a.dU_dt) * word(a.dpt) - pushed[1])
    varied = forms.exterior(form, primes(a), delta, delta_prime)
    domega = restricted(reduce(varied, frame_rule(a, gram(a))))
    letters = a.letters()
    images = {letters[x.name]: without(a.respell(y), a.f) for x, y in exterior.images.items()}
    moving = [x for f in a.frames for x in (f.d_velocity, f.dp_velocity)]
    core = terms_with(without(domega, a.dt, a.dpt), *moving)
    steps = (
        writing.step(
            (form_equation(writing, restricted(momentum), restricted(energy), Notation()),),
            say("The Cartan form of this problem."),
        ),
        varying.step(
            (Equation(DOMEGA, gathered(varying, domega, core, images, Notation())),),
            say("Its exterior derivative."),
        ),
    )
    found = Chapter(a.chapter).label("second_order_trivialised")
    return (
        Contraction(
            varying.said(domega),
            core,
            {x: varying.said(y) for x, y in images.items()},
            {f.xi: word(f.velocity).marked(found) for f in a.frames},
            {f.d_velocity: f.acceleration for f in a.frames},
            tuple(f.dp_velocity for f in a.frames),
            (a.dt, a.dpt),
            Notation(),
        ),
        steps,
    )


def _kernel(
    contraction: Contraction, forces: list[Expr], a: Alphabet, c: Chapter
) -> tuple[Expr, Step]:
    """dϖ(X, δ′) = 0 for X with the velocity of the motion; also without the work of the forces."""
    draft = c.draft("kernel", "kernel")
    tested = [f.xi_prime for f in a.frames]
    pairs = zip(forces, tested, strict=True)
    work = sum((inner(e, word(x)) for e, x in pairs), number(0))
    inertial, shown = balanced(draft, contraction, work, a)
    step = draft.step(
        (*rates(draft, a), Equation(shown, draft.tree(work), tuple(x.name for x in tested))),
        say(
            "X is in the kernel if and only if dϖ(X, δ′y) vanishes for every {variation} of the "
            "Lie algebra, with the work of the forces on the right.",
            variation="(ξ′, η′)" if a.affine else "ξ′",
        ),
    )
    return draft.said(inertial), step


def _with(delta: Image, varied: Expr) -> Image:
    """The same derivation with a value on U_Q."""
    return lambda x: varied if x == U_Q else delta(x)


def _forces(forces: dict[Letter, Expr], d: Draft) -> Step:
    sides: list[Tree] = [("mul", ("T", "A"), "N"), ("mul", ("T", "A"), "F")]
    return d.step(
        (Equation(x, d.tree(e)) for x, e in zip(sides, forces.values(), strict=False)),
        say(
            "The moments of this problem's forces in the body: the potential is varied over all "
            "matrices δA, of which those of the group are a part."
        ),
    )
