"""An incompressible fluid: its letters, the Lagrangian of its points, ϖ and dϖ trivialised."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ...algebra import calculus
from ...algebra.calculus import derivation, gradient, reduce, substitute, terms_with, without
from ...algebra.word_trees import PLAIN, WordNotation, along, metrics, tree_of
from ...algebra.words import Expr, Letter, inner, number, one, word, zero
from ...language.read import read
from ...language.tree import add, neg
from ...record.record import Equation, Step, stated
from ..chapter import Chapter, say
from ..given.body_and_potentials import integral
from ..matrices.coordinates import at_constant_time, factored_tree, solve_for
from ..spine import cartan
from ..spine.alphabet import AlgebraPart, Alphabet, SpacePart, members
from ..spine.cartan import (
    DOMEGA,
    Cartan,
    Exterior,
    body_rule,
    cartan_form,
    contact_images,
    derivative,
    form_equation,
    primed,
    primes,
    shown_brackets,
    trivial_images,
    trivial_variations,
    trivialised_images,
    varied_cauchy_green,
)
from ..spine.lagrangian import kinetic_energy

# The letters of a fluid: those of an affine group, with G and ∇ in the place of matrices.
#
# ν = Gu,  δg = Gη,  δG = G∇_η          τ = Aw,  δT = Aη,  δA = Aξ
#
# G is the composition with g, (Gc)(r) = c(g(r)), and ∇_c the derivative of fields along c: so the
# structure equation, the trivialisation and dϖ are those of the walk of the affine groups.


class FluidAlphabet(Alphabet):
    """The letters of a problem of this name; ``advected``: the density varies from place to place,
    and ḠG is the product with it, else 1; ``forced``: per unit mass, f = −grad V acts; ``given``: f
    is any field, from outside dϖ."""

    def __init__(self, name: str, *, advected: bool, forced: bool, given: bool):
        super().__init__("n", affine=True)
        self.name, self.advected, self.forced, self.given = name, advected, forced, given
        operator = [Letter(x, self.n, self.n) for x in self._part("G", "Ġ")]
        field = [Letter(x, self.n) for x in self._part("g", "ν")]
        self.A, self.T = SpacePart("Ġ", *operator), SpacePart("ġ", *field)
        names = ("u", "η", "η′", "δu", "δ′u", "u̇", "δδ′η", "δδ′u")
        self.w = AlgebraPart(*(Letter(x, self.n) for x in names))
        self.Z = AlgebraPart(*map(along, self.w_letters))
        self.C = Letter("ρ", self.n, self.n, 1)
        self.D, self.p, self.V = Letter("D", "k", self.n), Letter("p", "k"), Letter("V", "k")
        self.force = Letter("f", self.n)
        self.moved_field, self.moved_rate = Letter("ϑ", self.n), Letter("ϑ̇", self.n)

    @property
    def chapter(self) -> str:
        """All of the record is about this group: its labels begin with the problem's name."""
        return self.name

    def label(self, short: str) -> str:
        """The label of a step, by its label without the problem's name."""
        return f"{self.name}.{short}"

    @property
    def parts(self) -> tuple[SpacePart, ...]:
        """The letters of g."""
        return (self.T,)

    @property
    def algebra_parts(self) -> tuple[AlgebraPart, ...]:
        """The letters of u."""
        return (self.w,)

    @property
    def w_letters(self) -> list[Letter]:
        """The letters of u, η, η′ and so on, in the order of their part."""
        return [x for x in members(self.w) if isinstance(x, Letter)]

    @property
    def volume(self) -> Expr:
        """ḠG: the density ρ, or 1."""
        return word(self.C) if self.advected else one(self.n)

    @property
    def metric(self) -> str:
        """The name of the letter that is written as a metric; "" for 1."""
        return self.C.name if self.advected else ""


# The points of the fluid: L, and the forms of any motion of a continuum, (36)–(38).
#
# L = ½ ∫ ‖v‖² dm − U,  ϖ = ⟨ν, δg⟩ − h̃ δt,  dϖ = ⟨δν, δ′g − ν δ′t⟩ − ⟨δ′ν, δg − ν δt⟩

GRADIENT_OF_V = Letter("grad V", "n")
"""grad V as one vector."""


@dataclass(frozen=True)
class Points:
    """``lagrangian``: L̃ = ½⟨ν, ν⟩ − Ũ on words, by the velocity of all the points together;
    ``work``: −dŨ(δg); ``potential``: f = −grad V, told by its step, or f as it is."""

    lagrangian: Expr
    work: Expr
    potential: Expr
    steps: tuple[Step, ...]


def points(a: FluidAlphabet, c: Chapter) -> Points:
    """L of the points by their velocity, and L̃ of the group that moves them: the steps
    ``lagrangian``, ``action``."""
    first, acting = c.draft("lagrangian", "definition"), c.draft("action", "pull-back")
    summand = kinetic_energy(v_i := Letter("v_i", a.n), a)
    kinetic = substitute(summand, {a.m_i: number(1), v_i: word(v := Letter("v", a.n))})
    moving = substitute(first.mark(kinetic), {v: word(a.T.velocity)})
    density = "advected" if a.advected else "homogeneous"
    potential = [neg("U")] if a.forced else []
    moving = moving - word(a.U) if a.forced else moving
    forces = "forced" if a.forced else "free"
    steps = (
        first.step(
            (
                Equation("L", add(integral(first, summand, a, v_i), *potential)),
                Equation("L", add(first.tree(kinetic), *potential)),
            ),
            say("lagrangian.fluid") + say(f"lagrangian.{forces}") + say(f"lagrangian.{density}"),
            (36,),
        ),
        acting.step(
            (
                *stated("v = ν,  Ũ = U" if a.forced else "v = ν"),
                Equation("L̃", "L"),
                Equation("L̃", acting.tree(moving)),
            ),
            say("action.fluid"),
            (13, 38),
        ),
    )
    if not a.forced:
        return Points(acting.mark(moving), zero(), word(a.force), steps)
    work, force, pulling = _force(a, c)
    return Points(acting.mark(moving), work, force, (*steps, pulling))


def _force(a: FluidAlphabet, c: Chapter) -> tuple[Expr, Expr, Step]:
    """−dŨ(δg) = ⟨Gf, δg⟩, and −grad V as one vector: the step ``force``."""
    draft = c.draft("force", "pull-back")
    V, moved, f = Letter("V"), Letter("δr", a.n), word(a.force)
    # at each place, where dV is −f by the definition of f; and there f is that of the place g(r)
    varied = derivation(word(V), {V: -inner(f, word(moved))}.get)
    here = {a.force: word(a.A.position) * f, moved: word(a.T.d_position)}
    work = -substitute(varied, here)
    step = draft.step(
        (
            Equation("Ũ", ("call", "∫", ("mul", "G", "V"))),
            *stated("f = −grad V"),
            Equation(read("dŨ(δg)"), draft.tree(-work)),
        ),
        say("force.potential"),
        (2,),
    )
    return draft.mark(work), draft.mark(-word(GRADIENT_OF_V)), step


def in_space(stage: Points, a: FluidAlphabet, c: Chapter) -> Cartan:
    """ϖ in the variables (t, g, ν): the steps ``momentum``, ``energy`` and ``cartan``."""
    paper = ((16,), (16, 37), (37,))
    found = cartan.in_space(stage.lagrangian, stage.work, a, c, PLAIN, paper)
    return replace(found, momentum=found.momentum.marked(c.label("cartan")))


def exterior_in_space(stage: Cartan, a: FluidAlphabet, c: Chapter) -> Exterior:
    """dϖ in the variables (t, g, ν): the step ``exterior``."""
    draft = c.draft("exterior", "exterior derivative")
    form = derivative(stage.form, stage.work, a)
    images = contact_images(form, a) | _by_force(form, a)
    shown = factored_tree(draft, form, at_constant_time(form, a.dt, a.dpt), images, PLAIN)
    step = draft.step((Equation(DOMEGA, shown),), say("exterior.derivative"))
    return Exterior(draft.mark(form), {x: draft.mark(y) for x, y in images.items()}, (step,))


def _by_force(form: Expr, a: FluidAlphabet) -> dict[Letter, Expr]:
    """δν ↦ δν − Gf δt, and for δ′: the acceleration by the force, read off dϖ."""
    x, moved = a.T.d_velocity, a.T.dp_position
    found = solve_for(gradient(form, moved), x) if a.forced else None
    if found is None:
        return {}
    image = word(x) - found
    return {x: image, a.T.dp_velocity: primed(image, a)}


# Velocities and displacements told at the place where a point is: ϖ and dϖ by u and η.
#
# ϖ = ⟨u, η⟩ − ½‖u‖² δt,  δη′ − δ′η = ∇_η′ η − ∇_η η′
#
# G is the composition with g; what the walk of the affine groups says of A, T and w is said of G,
# g and u, with ḠG = 1, or ρ, for C = ĀA.


def relations(a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The steps ``trivialisation``, ``chain``, ``isometry``, ``skew`` and, of a density that is
    carried along, ``transport``."""
    images = trivial_images(a)
    g, xi, shown = a.A.position, word(a.Z.xi), trees(a)
    turned = derivation(word(g), {g: word(g) * xi}.get)
    moving, varying = c.draft("trivialisation", "trivialisation"), c.draft("chain", "variation")
    keeping, integrating = c.draft("isometry", "relation"), c.draft("skew", "relation")
    steps = [
        moving.step(stated("ν = Gu,  δg = Gη,  δ′g = Gη′"), say("trivialisation.fluid")),
        varying.step(
            (
                Equation(("call", "δ", "G"), varying.tree(turned)),
                *(
                    Equation(x.name, varying.tree(images[x]))
                    for x in (a.T.d_velocity, a.T.dp_velocity)
                ),
            ),
            say("chain.rule"),
        ),
        keeping.step(
            (Equation(tree_of(word(g).bar * word(g)), keeping.tree(a.volume, shown)),),
            say(f"isometry.{'advected' if a.advected else 'homogeneous'}"),
        ),
        integrating.step(
            (Equation(("T", tree_of(xi)), integrating.tree(xi.bar)),), say("skew.stokes")
        ),
    ]
    if a.advected:
        steps.append(_transport(a, c))
    return tuple(steps)


def _transport(a: FluidAlphabet, c: Chapter) -> Step:
    """δρ by ρ = ḠG: the step ``transport``."""
    draft = c.draft("transport", "variation")
    draft.depends_on(word(a.C).marked(c.label("isometry"), c.label("chain"), c.label("skew")))
    varied = varied_cauchy_green(a, a.Z.xi)
    return draft.step((Equation(("call", "δ", "ρ"), draft.tree(varied)),), say("transport.density"))


def trees(a: FluidAlphabet) -> WordNotation:
    """The notation with the density as a metric."""
    return metrics(a.metric)


def at_identity(e: Expr, a: FluidAlphabet) -> Expr:
    """A scalar by u, η and ḠG."""
    volume = a.volume.marked(a.label("isometry"))
    return reduce(substitute(e, trivial_images(a)), body_rule(a, volume))


def trivialised(natural: Cartan, stage: Points, a: FluidAlphabet, c: Chapter) -> Cartan:
    """L̃ and ϖ by u and η: the steps ``pullback`` and ``cartan_trivialised``."""
    pulling = c.draft("pullback", "pull-back")
    draft = c.draft("cartan_trivialised", "trivialisation")
    images = trivial_images(a)
    momentum, energy = (at_identity(e, a) for e in (natural.momentum, natural.energy))
    lagrangian = at_identity(stage.lagrangian, a)
    steps = (
        pulling.step(
            (
                Equation("L̃", pulling.tree(substitute(stage.lagrangian, images))),
                Equation("L̃", pulling.tree(lagrangian, trees(a))),
            ),
            say("pullback.fluid"),
        ),
        draft.step(
            (form_equation(draft, momentum, energy, trees(a)),), say("cartan_trivialised.form")
        ),
    )
    momentum, energy = draft.mark(momentum), draft.mark(energy)
    work = at_identity(natural.work, a)
    return Cartan(momentum, energy, cartan_form(momentum, energy, a), work, steps)


def exterior_by_fields(natural: Exterior, stage: Cartan, a: FluidAlphabet, c: Chapter) -> Exterior:
    """dϖ by u and η, with what crosses the variations: the steps ``structure`` and
    ``exterior_trivialised``."""
    crossing, draft = (
        c.draft("structure", "structure equation", word(a.A.position).marked(c.label("chain"))),
        c.draft("exterior_trivialised", "exterior derivative"),
    )
    (crossed,) = shown_brackets(a)
    first = crossing.step((Equation(read("δ(η′) − δ′(η)"), crossed),), say("structure.fields"))
    varied = calculus.exterior(stage.form, primes(a), *trivial_variations(a, stage.work))
    form = reduce(varied, body_rule(a, a.volume))
    draft.depends_on(word(a.A.position).marked(c.label("skew")))
    images = trivialised_images(natural, a)
    for x in (a.w.d_velocity, a.w.dp_velocity):
        images[x] = word(x) + (images[x] - word(x))  # first the variation itself
    core = terms_with(without(form, a.dt, a.dpt), a.w.d_velocity, a.w.dp_velocity)
    contact = {x: y for x, y in images.items() if x in (a.w.xi, a.w.xi_prime)}
    for x in (a.w.d_velocity, a.w.dp_velocity) if a.forced else ():
        contact[x] = word(x) + terms_with(images[x], a.dt, a.dpt)
    shown = [factored_tree(draft, form, core, images, trees(a))]
    if not a.advected:  # with a density that moves, the second has terms in its derivative
        shown.append(factored_tree(draft, form, core, contact, trees(a)))
    step = draft.step([Equation(DOMEGA, t) for t in shown], say("exterior_trivialised.fluid"))
    return Exterior(draft.mark(form), {x: draft.mark(y) for x, y in images.items()}, (first, step))
