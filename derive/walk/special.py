"""One problem on one group: its relations, ϖ and dϖ with its potential, its forces and energy.

What :mod:`derive.walk.kernel` says for any group is written in the letters of this one, which know
more: where Z is skew, C = 1; where its trace vanishes, so do those of ξ and Ż.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..algebra import forms
from ..algebra.calculus import Image, gradient, reduce, substitute, without
from ..algebra.groups import Group
from ..algebra.notation import Notation, tree_of
from ..algebra.tree import Tree
from ..algebra.words import Expr, Letter, word
from ..record.record import Equation, Step
from ..record.sentence import Prose, say
from .alphabet import Alphabet
from .cartan import Cartan, form_equation, frame_rule
from .chapter import Chapter
from .exterior import DOMEGA, Exterior, primes, structure, trivial_variations
from .gather import gathered, terms_with
from .kernel import Kernel
from .potential import U_Q, Potentials, virtual_work


@dataclass(frozen=True)
class General:
    """What is known of every group of one action: letters, trivialised forms, kernel.

    ``momentum``: p̃(δg) in space.
    """

    name: str
    letters: Alphabet
    momentum: Expr
    cartan: Cartan
    exterior: Exterior
    kernel: Kernel
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


def letters_of(group: Group) -> Alphabet:
    """The alphabet of a group: skew or traceless letters where its relations say so."""
    skew = "orthogonal" in group.relations
    traceless = "unimodular" in group.relations and not skew
    return Alphabet(group.n, affine=group.affine, skew=skew, traceless=traceless)


def specialise(road: General, group: Group, v: Potentials, c: Chapter) -> Special:
    """The forms, forces and energy of a problem."""
    a, b = road.letters, letters_of(group)
    free = b.freed()
    gram = b.unit if "orthogonal" in group.relations else word(b.C)
    carried = frame_rule(b, gram)
    eta = word(b.w.xi_prime) if b.affine else None
    virtual = virtual_work(v, b, word(free.Z.xi_prime), eta)
    primed = [f.xi_prime for f in free.frames]
    forces = {x: reduce(gradient(virtual, x), carried) for x in primed}
    energy = substitute(b.respell(road.cartan.energy, gram), {b.U: reduce(v.energy, carried)})
    form = Cartan(b.respell(road.cartan.momentum, gram), energy, ())
    kernel = without(road.kernel.form, a.dpt, a.f, a.N_body, a.F_body)
    inertial = free.respell(kernel, gram)
    steps = (
        *_relation(group, c),
        *v.steps,
        *_forms(form, road.exterior, v, b, gram, c),
        _forces(forces, c),
    )
    last = c.step(
        "energy",
        "pull-back",
        ".cartan_trivialised potential",
        (Equation("h̃", tree_of(energy)),),
        say("The energy of this problem."),
    )
    return Special(free, gram, inertial, forces, steps, (last,))


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
    prose = _kept(group) + _smaller(group)
    return (c.step("relation", "relation", ".trivialisation", equations, prose),)


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
    form: Cartan, exterior: Exterior, v: Potentials, b: Alphabet, gram: Expr, c: Chapter
) -> tuple[Step, Step]:
    """ϖ and dϖ with the potential of the problem, whose variation is that of the group."""
    brackets, _ = structure(b, c.name)
    delta, delta_prime = trivial_variations(b, brackets, (frame_rule(b, gram),))
    etas = (word(b.w.xi), word(b.w.xi_prime)) if b.affine else (None, None)
    pushed = [v.work(word(x), y) for x, y in zip((b.Z.xi, b.Z.xi_prime), etas, strict=True)]
    delta = _with(delta, word(b.dU_dt) * word(b.dt) - pushed[0])
    delta_prime = _with(delta_prime, word(b.dU_dt) * word(b.dpt) - pushed[1])
    domega = forms.exterior(form.form(b), primes(b), delta, delta_prime)
    domega = reduce(domega, frame_rule(b, gram))
    letters = b.letters()
    images = {letters[x.name]: without(b.respell(y), b.f) for x, y in exterior.images.items()}
    moving = [x for f in b.frames for x in (f.d_velocity, f.dp_velocity)]
    core = terms_with(without(domega, b.dt, b.dpt), *moving)
    if gram == b.unit:  # where C drops out the terms ξZ of the images are gone
        images = {x: _without_products(y) for x, y in images.items()}
    return (
        c.step(
            "cartan",
            "relation",
            ".cartan_trivialised potential",
            (form_equation(form.momentum, form.energy, Notation()),),
            say("The Cartan form of this problem."),
        ),
        c.step(
            "exterior",
            "exterior derivative",
            "cartan .structure .trivialisation",
            (Equation(DOMEGA, gathered(domega, core, images, Notation())),),
            say("Its exterior derivative."),
        ),
    )


def _with(delta: Image, varied: Expr) -> Image:
    """The same derivation with a value on U_Q."""
    return lambda x: varied if x == U_Q else delta(x)


def _without_products(e: Expr) -> Expr:
    """The terms of an image that are single letters, times δt."""
    return Expr(e.rows, e.cols, {k: c for k, c in e.terms.items() if len(k[1]) == 1})


def _forces(forces: dict[Letter, Expr], c: Chapter) -> Step:
    sides: list[Tree] = [("mul", ("T", "A"), "N"), ("mul", ("T", "A"), "F")]
    return c.step(
        "force",
        "variation",
        "potential .trivialisation .force",
        (Equation(x, tree_of(e)) for x, e in zip(sides, forces.values(), strict=False)),
        say(
            "The moments of this problem's forces in the body: the potential is varied over all "
            "matrices δA, of which those of the group are a part."
        ),
    )
