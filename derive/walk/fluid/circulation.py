"""What the motion of a fluid keeps: its density, its energy, circulation along curves (Kelvin)."""

from __future__ import annotations

from fractions import Fraction

from ...algebra.calculus import (
    PairRule,
    coefficient_of,
    derivation,
    reduce,
    strip,
    substitute,
    terms_with,
    without,
)
from ...algebra.word_trees import WordNotation, along, with_derivatives
from ...algebra.words import Expr, Factor, Letter, col_dim, inner, row_dim, word, zero
from ...language.read import read
from ...language.tree import Tree
from ...record.record import Equation, Step, stated
from ..chapter import Chapter, say
from ..matrices.coordinates import factored_tree
from ..spine.cartan import Cartan, brackets_of, trivial_images, varied_cauchy_green
from .fluid_forms import GRADIENT_OF_V, FluidAlphabet, Points, trees
from .fluid_kernel import GRADIENT, SHOWN, FluidKernel, by_gradient, pair_rule

# The density is carried along: ρ = ρ₀ ∘ g⁻¹, with ρ₀ that of the points.
#
# Gρ = ρ₀G,  ρ̇ = ρ∇_u − ∇_uρ,  ρ̇ + ⟨u, grad ρ⟩ = 0
#
# By the chain rule, Ġ = G∇_u; the rate of ḠG = ρ, where ∇_u is skew, is the same.

RATE, INITIAL_DENSITY = Letter("ρ̇", "n", "n", 1), Letter("ρ_0", "n", "n", 1)
SLOPE = Letter("⟨u, grad ρ⟩", "n", "n", 1)
"""The derivative of ρ along u, and the product with it at each place."""
DENSITY_NOTATION = WordNotation(display={SLOPE: ("inner", "u", ("call", "grad", "ρ"))})


def advection(a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The step ``advection`` of a density that is carried along."""
    if not a.advected:
        return ()
    draft = c.draft("advection", "variation")
    G, rho, nabla, any_field = word(a.A.position), word(a.C), along(a.w.velocity), Letter("a", a.n)
    draft.depends_on(rho.marked(c.label("chain"), c.label("transport")))
    rate = rate_of_density(a)
    # at each place, where the product rule holds along u
    by_places = coefficient_of(
        derivation(
            rho * word(any_field), {a.C: word(SLOPE), any_field: word(nabla, any_field)}.get
        ),
        any_field,
    )
    local = reduce(rate, pair_rule((nabla, False), (a.C, False), by_places))
    return (
        draft.step(
            (
                Equation(draft.tree(G * rho), draft.tree(word(INITIAL_DENSITY) * G)),
                Equation(RATE.name, draft.tree(rate)),
                Equation(draft.tree(word(nabla) * rho), draft.tree(by_places, DENSITY_NOTATION)),
                Equation(draft.tree(word(RATE) - local, DENSITY_NOTATION), 0),
            ),
            say("advection.carried") + say("advection.place"),
        ),
    )


def rate_of_density(a: FluidAlphabet) -> Expr:
    """ρ̇ = ρ∇_u − ∇_uρ by Gρ = ρ₀G and the chain rule; ``ValueError`` where ḠG has another."""
    G, rho, turning = word(a.A.position), word(a.C), word(along(a.w.velocity))
    carried = pair_rule((INITIAL_DENSITY, False), (a.A.position, False), G * rho)
    left = derivation(
        G * rho - word(INITIAL_DENSITY) * G, {a.A.position: G * turning, a.C: word(RATE)}.get
    )
    rate = word(RATE) - strip(reduce(left, carried), a.A.position)
    if rate != varied_cauchy_green(a, along(a.w.velocity)):
        raise ValueError("the density is not carried along with the volume")
    return rate


# The energy h̃ along the motion: its rate is what the kernel says of η′ = u, and vanishes.
#
# d/dt h̃ = ⟨u̇ + ∇_u u − f, u⟩_ρ = ⟨D̄p, u⟩ = ⟨p, Du⟩ = 0
#
# ∇_u is skew and Du = 0: u is divergence-free, and tangent to the boundary.


def energy(stage: FluidKernel, form: Cartan, a: FluidAlphabet, c: Chapter) -> Step:
    """The rate of h̃, told by u in ``form``: for any acceleration it is what the kernel pairs with
    u, and along the motion 0."""
    draft = c.draft("energy_kept", "conservation")
    u, rate = word(a.w.velocity), a.w.acceleration
    turned = word(along(a.w.velocity)).marked(c.label("skew")) * u
    images = {a.w.velocity: word(rate), a.U: -substitute(form.work, {a.w.xi: u})}
    told = [Equation("h̃", draft.tree(form.energy, trees(a)))]
    if a.advected:
        images[a.C] = rate_of_density(a).marked(c.label("advection"), c.label("skew"))
        half, found = (inner(u, x * u) * Fraction(1, 2) for x in (word(RATE), images[a.C]))
        like = inner(u, a.volume * word(rate))
        shown = factored_tree(draft, found, like, {rate: turned}, trees(a))
        told.append(Equation(draft.tree(half), shown))
    else:
        told.append(Equation(read("⟨u, ∇_u u⟩"), draft.tree(inner(u, turned))))
    changed = derivation(form.energy, images.get)
    power = inner(u, a.volume * word(a.force)) if a.given else zero()
    if changed - power != inner(u, stage.force):
        raise ValueError("the rate of the energy is not what the kernel pairs with u")
    # along the motion ``stage.force`` is D̄p, and f is D̄V where the density is the same everywhere
    still = pair_rule((a.D, False), (a.w.velocity, False), zero("k", 1))
    push = word(a.D).bar * word(a.p).marked(c.label("divergence"), c.label("pressure"))
    idle = reduce(inner(u, push), still)
    if a.forced:
        pulled = word(a.D).bar * word(a.V).marked(c.label("absorbed"))
        gone = {} if a.advected else {a.force: pulled}
        fallen, changed = (reduce(substitute(x, gone), still) for x in (images[a.U], changed))
        told.append(Equation(read("dŨ(ν)"), draft.tree(fallen, trees(a))))
    moved = word(rate) + turned - (word(a.force) if a.forced else zero(a.n, 1))
    moving = {rate: moved} if a.advected else {}
    shown = factored_tree(draft, changed, terms_with(changed, rate), moving, trees(a))
    draft.depends_on(stage.balance, push)
    rated: Tree = ("call", "d/dt", "h̃")
    return draft.step(
        (
            *told,
            Equation(rated, shown, (rate.name,)),
            Equation(draft.tree(inner(word(GRADIENT), u), SHOWN), draft.tree(-idle)),
            Equation(rated, draft.tree(idle + power, trees(a))),
        ),
        say("energy_kept.power" if a.given else "energy_kept.kernel")
        + say(f"energy_kept.{'advected' if a.advected else 'homogeneous'}")
        + (say(f"energy_kept.{'forced' if a.advected else 'absorbed'}") if a.forced else ())
        + say("energy_kept.pressure"),
    )


# What the motion keeps by the symmetries of the right side; along curves, see below.
#
# Displacements of the fluid before g, which keep the volume, leave u alone: g goes to g ∘ h, δu =
# 0 and δg = Gϑ, where ϑ is carried along by the motion. So p̃(Gϑ) = ⟨u, ϑ⟩ is constant.


def circulation(
    stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter
) -> tuple[Step, ...]:
    """The steps ``relabelling`` and ``circulation``."""
    moving, keeping = c.draft("relabelling", "variation"), c.draft("circulation", "conservation")
    w, u = a.w, word(a.w.velocity)
    carried = word(a.moved_field)
    # δη′ − δ′η for δ the relabelling and δ′ the motion: δu = 0, and δ′η is the rate of ϑ
    crossed = brackets_of(a)[w.xi_prime]
    found = -substitute(crossed, with_derivatives({w.xi: carried, w.xi_prime: u}))
    images = {a.moved_field: moving.mark(found), w.velocity: word(w.acceleration)}
    given: list[Equation] = []
    if a.advected:
        images[a.C] = rate_of_density(a).marked(c.label("advection"))
        turned, density = word(along(a.moved_field)), word(a.C)
        given = [Equation(keeping.tree(turned * density), keeping.tree(density * turned))]
    told = (Equation(a.moved_rate.name, moving.tree(found)),)
    first = moving.step(told, say("relabelling.field"))
    momentum = inner(u, a.volume * carried)
    changed = derivation(momentum, images.get)
    driven = substitute(stage.balance, {w.xi_prime: carried})
    inert = without(driven, a.force)
    keeping.depends_on(driven, points.potential, changed, word(a.C).marked(c.label("skew")))
    work = inert - driven if a.given else zero()
    left = skew_part(changed - inert, a) + work_on(driven - inert + work, a)
    if left:
        raise ValueError("the circulation is not kept")
    moved = word(w.acceleration) + word(along(w.velocity)) * u
    pushed = factored_tree(
        keeping, inert, terms_with(inert, w.acceleration), {w.acceleration: moved}, trees(a)
    )
    rated: Tree = ("call", "d/dt", keeping.tree(momentum, trees(a)))
    second = keeping.step(
        (
            Equation(rated, pushed, (w.acceleration.name,)),
            Equation(rated, keeping.tree(work, trees(a))),
        ),
        say(f"circulation.{_kind(a)}") + (say("circulation.potential") if a.forced else ()),
        where=given,
    )
    return first, second


def work_on(e: Expr, a: FluidAlphabet) -> Expr:
    """A scalar with D̄V for f, where ϑ, and the product with a density that it leaves alone, is
    without divergence."""
    product = Letter("ρϑ", a.n)

    def rule(x: Factor, y: Factor) -> Expr | None:
        if (x[0], y[0]) == (a.C, a.moved_field):
            return word(product)
        return zero("k", 1) if x == (a.D, False) and y[0] in (product, a.moved_field) else None

    return reduce(substitute(e, {a.force: word(a.D).bar * word(a.V)}), rule)


def skew_part(e: Expr, a: FluidAlphabet) -> Expr:
    """A scalar in which ρ∇_ϑ = ∇_ϑρ is one letter, skew as ∇_ϑ is."""
    both = {along(a.moved_field), a.C}
    product = word(Letter("ρ∇_ϑ", a.n, a.n, symmetry=-1))
    return reduce(e, lambda x, y: product if {x[0], y[0]} == both else None)


# Kelvin's theorem: the circulation along a closed curve χ = g ∘ χ₀ that the fluid carries along.
#
# Γ = Γ₀G,  d/dt⟨Γu, χ_s⟩ = ⟨Γ(u̇ + ∇_u u), χ_s⟩ + ⟨Γu, ∂_sΓu⟩ = 0
#
# Γ is the composition with χ and ∂_s the derivative along it, skew as χ is closed: so the last
# term vanishes, and so does the first, where Γ(u̇ + ∇_u u) is that of gradients. With a density
# it is where Γρ = κΓ.

INITIAL_CURVE, CURVE = Letter("Γ_0", "curve", "n"), Letter("Γ", "curve", "n")
"""The composition with χ₀, of fields over the points, and with χ, of fields in space."""
ALONG = Letter("∂_s", "curve", "curve", symmetry=-1)
TANGENT, LEVEL, CHANGE = Letter("χ_s", "curve"), Letter("κ"), Letter("κ̇")


def kelvin(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The steps ``curve``, ``closed_curve``, of a density ``level_curve``, and ``kelvin``."""
    level = (_level(a, c),) if a.advected else ()
    return (_advected(a, c), _closed(a, c), *level, _conserved(stage, points, a, c))


def _advected(a: FluidAlphabet, c: Chapter) -> Step:
    """Γ = Γ₀G, and the rates of χ and Γ by those of g and G."""
    draft = c.draft("curve", "variation")
    G = a.A.position
    whole = pair_rule((INITIAL_CURVE, False), (G, False), word(CURVE))
    turned = word(G) * word(along(a.w.velocity))
    draft.depends_on(turned.marked(c.label("chain")))
    moving = word(INITIAL_CURVE) * trivial_images(a)[a.T.velocity]
    turning = derivation(word(INITIAL_CURVE) * word(G), {G: turned}.get)
    return draft.step(
        (
            *stated("Γ = Γ₀G,  χ̇ = Γ₀ν"),
            Equation("χ̇", draft.tree(reduce(moving, whole))),
            Equation("Γ̇", draft.tree(reduce(turning, whole))),
        ),
        say("curve.carried"),
    )


def _closed(a: FluidAlphabet, c: Chapter) -> Step:
    """∂_s is skew: of gradients nothing is left along the curve, nor of u along itself."""
    draft = c.draft("closed_curve", "relation")
    moved = word(CURVE).marked(c.label("curve")) * word(a.w.velocity)
    pushed = inner(word(CURVE) * word(GRADIENT), word(TANGENT))
    return draft.step(
        (
            Equation(("T", ALONG.name), draft.tree(word(ALONG).bar)),
            *stated("∂_sΓ = ∇_χ_s"),
            Equation(draft.tree(pushed, SHOWN), draft.tree(reduce(pushed, along_curve(GRADIENT)))),
            Equation(read("⟨Γu, ∂_sΓu⟩"), draft.tree(inner(moved, word(ALONG) * moved))),
        ),
        say("closed_curve.skew"),
    )


def along_curve(slope: Letter) -> PairRule:
    """⟨Γ grad p, χ_s⟩ = ⟨1, ∇_χ_s p⟩ = ⟨1, ∂_sΓp⟩ over the curve, and ∂_s1 = 0: as rules."""
    values, unit, pushed = Letter("Γp", "values"), Letter("1", "values"), Letter("Γ grad", "curve")
    down = Letter("∂_s", "values", "values", symmetry=-1)

    def rule(x: Factor, y: Factor) -> Expr | None:
        if (x, y) == ((CURVE, False), (slope, False)):
            return word(pushed)
        if (x, y) == ((slope, True), (CURVE, True)):
            return word(pushed).bar
        if {x[0], y[0]} == {pushed, TANGENT}:
            return inner(word(unit), word(down) * word(values))
        return zero(row_dim(x), col_dim(y)) if {x[0], y[0]} == {down, unit} else None

    return rule


def _level(a: FluidAlphabet, c: Chapter) -> Step:
    """The rate of both sides of Γρ = κΓ."""
    draft = c.draft("level_curve", "variation")
    images = {
        CURVE: (word(CURVE) * word(along(a.w.velocity))).marked(c.label("curve")),
        a.C: rate_of_density(a).marked(c.label("advection")),
        LEVEL: word(CHANGE),
    }
    both = word(CURVE) * word(a.C) - word(LEVEL) * word(CURVE)
    changed = reduce(derivation(both, images.get), on_level(a))
    draft.depends_on(changed)
    if changed != -word(CHANGE) * word(CURVE):
        raise ValueError("the density on the curve is not kept")
    return draft.step((Equation(CHANGE.name, 0),), say("level_curve.kept"), where=(one_level(a),))


def one_level(a: FluidAlphabet) -> Equation:
    """Γρ = κΓ: on the curve ρ has one value, κ."""
    return Equation(("mul", CURVE.name, a.C.name), ("mul", LEVEL.name, CURVE.name))


def on_level(a: FluidAlphabet) -> PairRule:
    """The same as a rule."""
    return pair_rule((CURVE, False), (a.C, False), word(LEVEL) * word(CURVE))


def _conserved(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> Step:
    """The rate of ⟨Γu, χ_s⟩, which is 0 by the equation of motion."""
    draft = c.draft("kelvin", "conservation")
    u, rate, curve = a.w.velocity, a.w.acceleration, word(CURVE)
    images = {
        u: word(rate),
        CURVE: (curve * word(along(u))).marked(c.label("curve")),
        TANGENT: (word(ALONG) * curve * word(u)).marked(c.label("curve")),
    }
    moved = {rate: word(rate) + word(along(u)) * word(u)}
    carried, circulating = curve * word(u), inner(curve * word(u), word(TANGENT))
    changed = derivation(circulating, images.get)
    inert = without(stage.force, a.force)
    driving = substitute(inert - stage.force, {a.force: points.potential})
    push = by_gradient(word(a.D).bar * word(a.p), a).marked(c.label("pressure"))
    pushed, left = (reduce(curve * x, on_level(a)) for x in (push + driving, inert))
    scaled = word(LEVEL) * changed if a.advected else changed
    gradients = (along_curve(x) for x in (GRADIENT, GRADIENT_OF_V))
    work = inner(curve * word(a.force), word(TANGENT)) if a.given else zero()
    rest = reduce(inner(pushed, word(TANGENT)), *gradients)
    if scaled != inner(left, word(TANGENT)) or rest != (word(LEVEL) * work if a.advected else work):
        raise ValueError("the circulation along a curve is not kept")
    draft.depends_on(changed.marked(c.label("closed_curve")))
    if a.advected:
        draft.depends_on(word(LEVEL).marked(c.label("level_curve")))

    def written(e: Expr) -> Tree:
        return factored_tree(draft, e, terms_with(e, rate), moved, SHOWN)

    rated: Tree = ("call", "d/dt", draft.tree(circulating))
    return draft.step(
        (
            Equation(
                ("call", "d/dt", draft.tree(carried)),
                written(derivation(carried, images.get)),
                (rate.name,),
            ),
            Equation(("call", "d/dt", TANGENT.name), draft.tree(images[TANGENT])),
            Equation(written(left), draft.tree(pushed, SHOWN)),
            Equation(rated, written(changed), (rate.name,)),
            Equation(rated, draft.tree(work)),
        ),
        say(f"kelvin.{_kind(a)}"),
        where=(one_level(a),) if a.advected else (),
    )


def _kind(a: FluidAlphabet) -> str:
    """The density, as a part of a key; or that a force is given, where all is said of it."""
    return "force" if a.given else "advected" if a.advected else "homogeneous"
