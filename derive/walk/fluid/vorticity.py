"""Zeitlin's model: any Lagrangian on the right, on su(N) in the basis of the torus."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import derivation, gradient, substitute
from ...algebra.structure import TorusLattice
from ...algebra.words import Expr, Letter, inner, trace, word
from ...language.tree import add, mul
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...schema.force_kinds import LaplacianDamping
from ..chapter import Chapter, say
from ..lie.any_lagrangian import AnyLagrangian, sign_of
from ..spine.alphabet import Alphabet
from .lattice import (
    LARGEST,
    Coefficient,
    LatticeForm,
    M,
    N,
    Phase,
    Unit,
    VorticityForcing,
    bracket_at,
    minus,
    modes,
    of,
    paired,
    summed,
    traced,
)

CASIMIRS = (2, 3, 4)
"""The powers of W of which the step tells the traces; the others go alike."""
W, P = Letter("W", "n", "n"), Letter("P", "n", "n")
BRACKET = word(W) * word(P) - word(P) * word(W)


def inertia(a: Coefficient) -> Coefficient:
    """𝔸, the opposite of the Laplacian: |n|² on T(n)."""
    return a.times(1, 1)


@dataclass(frozen=True)
class ZeitlinFluid:
    """What the inertia operator and the trace form make of the coefficients ζ, for one N.

    ``lagrangian``, ``energy``: L̃ by ζ and h̃ by ω̂; ``slope``: ω̂ by ζ; ``momentum``: Π of W̄;
    ``scale``: N/4πi; ``stream``: P; ``velocity``: Z of P.
    """

    lagrangian: LatticeForm
    slope: Coefficient
    momentum: Unit
    energy: LatticeForm
    stream: Coefficient
    velocity: Unit
    scale: Unit


def fluid_of(torus: TorusLattice, a: Alphabet) -> ZeitlinFluid:
    """From ½⟨𝔸Z, Z⟩: δL̃ = ⟨Π, δZ⟩, h̃ = ⟨Π, Z⟩ − L̃, 𝔸P = −W."""
    scale = Unit(Fraction(4, torus.N), 1, 1).inverse
    zeta, varied, vorticity = (Coefficient(x) for x in ("ζ", "δζ", "ω̂"))
    L = paired(inertia(zeta), zeta).times(Fraction(1, 2))
    slope = L.varied("ζ", "δζ").gradient("δζ")
    dZ, Z = a.Z.d_velocity, a.Z.velocity
    elements = {W: vorticity, dZ: varied.times(scale), Z: zeta.times(scale)}
    along, whole = (traced(inner(word(W).bar, word(x)), elements, torus.N) for x in (dZ, Z))
    momentum = paired(vorticity, varied).over(along)
    by_vorticity = slope.solved_for("ω̂")
    energy = (whole.times(momentum) - L).put("ω̂", slope).put("ζ", by_vorticity)
    stream = inertia(Coefficient("P")).times(-1).solved_for("ω̂")
    velocity = by_vorticity.times(scale).over(stream)
    return ZeitlinFluid(L, slope, momentum, energy, stream, velocity, scale)


def torus_steps(
    problem: Problem, general: AnyLagrangian, a: Alphabet, c: Chapter
) -> tuple[Step, ...]:
    """From the basis to the motion, and what it keeps."""
    torus = problem.torus
    assert torus is not None
    phase, fluid = Phase(torus.N), fluid_of(torus, a)
    first = _basis(phase, fluid, general, c)
    algebra, lagrangian = _algebra(phase, first, c), _lagrangian(fluid, general, first, c)
    momenta = _momenta(fluid, (first, lagrangian, general["momenta"]), c)
    flow, energy = _stream(fluid, momenta, c), _energy(fluid, (momenta, general["energy"]), c)
    rate, forcing = coadjoint_rate(fluid, general.epsilon, a), acting(problem)
    c = c.with_input() if forcing else c
    forced = (_forcing(forcing, momenta, c),) if forcing else ()
    turning = _coadjoint(rate, general, (momenta, flow, *forced), c)
    motion = _motion(phase, fluid, rate, forcing, (turning, flow, algebra, momenta, *forced), c)
    told = [modes(phase, fluid.stream, rate, forcing, motion, c)] if torus.N <= LARGEST else []
    kept = _conserved(fluid, torus, forcing, (turning, energy, momenta, *forced), c)
    found = first, algebra, lagrangian, momenta, flow, energy, *forced, turning, motion
    return *found, *told, kept


def acting(problem: Problem) -> VorticityForcing:
    """What acts from outside dϖ."""
    laplacian = (x for x in problem.damping if isinstance(x, LaplacianDamping))
    return VorticityForcing(
        bool(problem.covector), tuple((x.coefficient, x.power) for x in laplacian)
    )


def _basis(phase: Phase, fluid: ZeitlinFluid, general: AnyLagrangian, c: Chapter) -> Step:
    draft = c.draft("coordinates", "coordinates", general["second_order"])
    product = mul(of("T", M), of("T", N))
    return draft.step(
        [
            Equation(product, mul(phase.product(), of("T", (1, 1)))),
            Equation("Z", summed(lambda k: fluid.scale.times(of("ζ", k)))),
        ],
        say(
            "coordinates.torus", order=str(phase.N), half=str(phase.N // 2), most=str(phase.N // 2)
        ),
    )


def _algebra(phase: Phase, basis: Step, c: Chapter) -> Step:
    draft = c.draft("algebra", "relation", basis)
    unit, sine = phase.bracket(M, N)
    bracket = Equation(("bracket", of("T", M), of("T", N)), unit.times(sine, of("T", (1, 1))))
    return draft.step([bracket], say("algebra.torus"))


def _lagrangian(fluid: ZeitlinFluid, general: AnyLagrangian, basis: Step, c: Chapter) -> Step:
    draft = c.draft("lagrangian", "definition", general["momenta"], basis)
    return draft.step([Equation("L̃", fluid.lagrangian.tree())], say("lagrangian.torus"))


def _momenta(fluid: ZeitlinFluid, made_from: tuple[Step, ...], c: Chapter) -> Step:
    """ω̂(n), the derivative along ζ(−n), of which δZ is a multiple of T(−n); W, and Π by it."""
    draft = c.draft("momenta", "fibre derivative", *made_from)
    paired_with = ("inner", "Π", fluid.scale.times(of("T", minus(N))))
    return draft.step(
        [
            Equation(of("ω̂", N), paired_with),
            Equation(of("ω̂", N), fluid.slope.unit.times(fluid.slope.at(N))),
            Equation("W", Coefficient("ω̂").element()),
            Equation("Π", fluid.momentum.times(("T", "W"))),
        ],
        say("momenta.torus"),
    )


def _stream(fluid: ZeitlinFluid, momenta: Step, c: Chapter) -> Step:
    draft = c.draft("stream", "inversion", momenta)
    return draft.step(
        [Equation("P", fluid.stream.element()), Equation("Z", fluid.velocity.times("P"))],
        say("stream.torus"),
    )


def _energy(fluid: ZeitlinFluid, made_from: tuple[Step, ...], c: Chapter) -> Step:
    draft = c.draft("energy", "Legendre transform", *made_from)
    return draft.step([Equation("h̃", fluid.energy.tree())], say("energy.torus"))


def coadjoint_rate(fluid: ZeitlinFluid, epsilon: int, a: Alphabet) -> Unit:
    """What Ẇ is of [W, P]: ⟨Π̇, ξ′⟩ = ε⟨Π, [Z, ξ′]⟩, Π is a multiple of W̄, Z one of P; ξ′ is any."""
    Z, xi = word(a.Z.velocity), word(a.Z.xi_prime)
    turned = epsilon * inner(word(W).bar, Z * xi - xi * Z)
    rate = gradient(substitute(turned, {a.Z.velocity: word(P)}), a.Z.xi_prime).bar
    return fluid.velocity * sign_of(rate, BRACKET)


def _forcing(forcing: VorticityForcing, momenta: Step, c: Chapter) -> Step:
    """The covector that acts, as a matrix with the coefficients that W has of the momentum."""
    draft = c.draft("forcing", "input", momenta)
    given = say("forcing.torus") + (say("forcing.torus_input") if forcing.driven else ())
    given += say("forcing.torus_damping") if forcing.damping else ()
    return draft.step([Equation("F", summed(forcing.at))], given)


def _coadjoint(rate: Unit, general: AnyLagrangian, made_from: tuple[Step, ...], c: Chapter) -> Step:
    draft = c.draft("coadjoint", "kernel", general["coadjoint"], *made_from)
    turned = rate.times(("bracket", "W", "P"))
    if c.driven:
        return draft.step([Equation("Ẇ", add(turned, "F"))], say("coadjoint.torus_driven"))
    return draft.step([Equation("Ẇ", turned)], say("coadjoint.torus"))


def _motion(
    phase: Phase,
    fluid: ZeitlinFluid,
    rate: Unit,
    forcing: VorticityForcing,
    made_from: tuple[Step, ...],
    c: Chapter,
) -> Step:
    """The coefficient at T(n) of Ẇ."""
    draft = c.draft("motion", "solution", *made_from)
    unit, total = bracket_at(phase, Coefficient("ω̂").at, fluid.stream.at)
    unit = rate * fluid.stream.unit * unit
    found = add(unit.times(total), forcing.at(N))
    told = say("motion.torus_driven" if forcing else "motion.torus")
    return draft.step([Equation(("call", "d/dt", of("ω̂", N)), found)], told)


def _conserved(
    fluid: ZeitlinFluid,
    torus: TorusLattice,
    forcing: VorticityForcing,
    made_from: tuple[Step, ...],
    c: Chapter,
) -> Step:
    """The rates of the energy and of Tr Wᵏ, traces of a product with a bracket of one of its
    factors: those by what acts from outside, and 0 where nothing does."""
    label, rule = ("power", "power") if forcing else ("conserved", "conservation")
    draft = c.draft(label, rule, *made_from)
    dW, forced, vorticity = Letter("δW", "n", "n"), word(Letter("F", "n", "n")), Coefficient("ω̂")
    elements = {W: vorticity, P: fluid.stream, dW: Coefficient("δω̂")}
    along, varied = traced(trace(word(P, dW)), elements, torus.N), fluid.energy.varied("ω̂", "δω̂")
    varied.over(along)  # δh̃ is a multiple of Tr P δW
    _require_zero(trace(word(P) * BRACKET))
    slope = varied.gradient("δω̂")
    power = slope.unit.times(summed(forcing.at, slope.at(minus(N)))) if forcing else 0
    told = [Equation(("call", "d/dt", "h̃"), power)]
    for k in CASIMIRS:
        kept = trace(word(*[W] * k))
        _require_zero(derivation(kept, {W: BRACKET}.get))
        rate = draft.tree(derivation(kept, {W: forced}.get)) if forcing else 0
        told.append(Equation(("call", "d/dt", ("tr", mul(*["W"] * k))), rate))
    enstrophy = traced(trace(word(W, W)), elements, torus.N)
    told.append(Equation(("tr", mul("W", "W")), enstrophy.tree()))
    return draft.step(told, say("power.torus" if forcing else "conserved.torus"))


def _require_zero(e: Expr) -> None:
    if e.terms:
        raise ValueError("the motion does not keep this")
