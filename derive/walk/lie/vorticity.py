"""Zeitlin's model: any Lagrangian on the right, on su(N) in the basis of the torus.

    L̃ = ½ Σ |n|² ζ(n) ζ(−n),  ω̂(n) = ⟨Π, (N/4πi) T(−n)⟩,  Ẇ = (N/4πi) [W, P],  W = Σ ω̂(n) T(n)

The steps are sums over the lattice: none is written out.
"""

from __future__ import annotations

from fractions import Fraction

from ...algebra.calculus import derivation, gradient, substitute
from ...algebra.torus import Torus
from ...algebra.words import Expr, Letter, inner, trace, word
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ..alphabet import Alphabet
from ..chapter import Chapter
from ..wording import say
from .any_lagrangian import AnyLagrangian
from .lattice import FREE, Index, M, N, Phase, Unit, bracket_at, minus, of, summed
from .orbit_form import sign_of

CASIMIRS = (2, 3, 4)
"""The powers of W of which the step tells the traces; the others go alike."""


def squared(k: Index) -> Tree:
    """|k|²."""
    return ("norm2", FREE if k in (N, minus(N)) else "𝐦")


def slope(k: Index) -> Tree:
    """∂L̃/∂ζ(−k) of L̃ = ½ Σ |n|² ζ(n) ζ(−n): each of two factors gives the half of |k|² ζ(k)."""
    return add(mul(squared(k), of("ζ", k)))


def stream(k: Index) -> Tree:
    """The coefficient of −P at k."""
    return ("div", of("ω̂", k), squared(k))


def torus_steps(
    problem: Problem, general: AnyLagrangian, a: Alphabet, c: Chapter
) -> tuple[Step, ...]:
    """From the basis to the motion, and what it keeps."""
    torus = problem.torus
    assert torus is not None
    phase, scale = Phase(torus.N), _scale(torus)
    first = _basis(phase, scale, general, c)
    algebra, lagrangian = _algebra(phase, first, c), _lagrangian(general, first, c)
    momenta = _momenta(torus, scale, (first, lagrangian, general["momenta"]), c)
    flow, energy = _stream(scale, momenta, c), _energy((momenta, general["energy"]), c)
    turning = _coadjoint(scale, general, (momenta, flow), a, c)
    motion = _motion(phase, scale, (turning, flow, algebra, momenta), c)
    kept = _kept((turning, energy, momenta), torus, a, c)
    return first, algebra, lagrangian, momenta, flow, energy, turning, motion, kept


def _scale(torus: Torus) -> Tree:
    """N/4πi."""
    return ("div", torus.N, mul(4, "π", "i"))


def _inverse_i(torus: Torus) -> Unit:
    """The same as a unit: 1/i = −i."""
    return Unit(Fraction(-torus.N, 4), 1, -1)


def _basis(phase: Phase, scale: Tree, general: AnyLagrangian, c: Chapter) -> Step:
    draft = c.draft("coordinates", "coordinates")
    draft.depends_on(general["second_order"])
    product = mul(of("T", M), of("T", N))
    return draft.step(
        [
            Equation(product, mul(phase.product(), of("T", (1, 1)))),
            Equation("Z", summed(lambda k: mul(scale, of("ζ", k)))),
        ],
        say(
            "coordinates.torus", order=str(phase.N), half=str(phase.N // 2), most=str(phase.N // 2)
        ),
    )


def _algebra(phase: Phase, basis: Step, c: Chapter) -> Step:
    draft = c.draft("algebra", "relation")
    draft.depends_on(basis)
    unit, sine = phase.bracket(M, N)
    bracket = Equation(("bracket", of("T", M), of("T", N)), unit.times(sine, of("T", (1, 1))))
    return draft.step([bracket], say("algebra.torus"))


def _lagrangian(general: AnyLagrangian, basis: Step, c: Chapter) -> Step:
    draft = c.draft("lagrangian", "definition")
    draft.depends_on(basis)
    half = mul(Fraction(1, 2), summed(lambda k: mul(squared(k), of("ζ", k)), of("ζ", minus(N))))
    return draft.step([Equation("L̃", half)], say("lagrangian.torus"))


def _momenta(torus: Torus, scale: Tree, made_from: tuple[Step, ...], c: Chapter) -> Step:
    """ω̂ by Π and by ζ; W, and Π by it: Tr T(m) T(n) is N where m + n = 0, else 0."""
    draft = c.draft("momenta", "fibre derivative")
    draft.depends_on(*made_from)
    paired = ("inner", "Π", mul(scale, of("T", minus(N))))
    unit = Unit(Fraction(4, torus.N**2), 1, 1)  # 1 over N · N/4πi
    return draft.step(
        [
            Equation(of("ω̂", N), paired),
            Equation(of("ω̂", N), slope(N)),
            Equation("W", summed(lambda k: of("ω̂", k))),
            Equation("Π", unit.times(("T", "W"))),
        ],
        say("momenta.torus"),
    )


def _stream(scale: Tree, momenta: Step, c: Chapter) -> Step:
    draft = c.draft("stream", "inversion")
    draft.depends_on(momenta)
    return draft.step(
        [Equation("P", neg(summed(stream))), Equation("Z", neg(mul(scale, "P")))],
        say("stream.torus"),
    )


def _energy(made_from: tuple[Step, ...], c: Chapter) -> Step:
    """½ Σ |n|⁻² ω̂(n) ω̂(−n): L̃ is quadratic in ζ, and ζ(n) = |n|⁻² ω̂(n)."""
    draft = c.draft("energy", "Legendre transform")
    draft.depends_on(*made_from)
    half = mul(Fraction(1, 2), summed(stream, of("ω̂", minus(N))))
    return draft.step([Equation("h̃", half)], say("energy.torus"))


W, P = Letter("W", "n", "n"), Letter("P", "n", "n")
BRACKET = word(W) * word(P) - word(P) * word(W)


def _coadjoint(
    scale: Tree, general: AnyLagrangian, made_from: tuple[Step, ...], a: Alphabet, c: Chapter
) -> Step:
    """⟨Π̇, ξ′⟩ = ε⟨Π, [Z, ξ′]⟩ where Π is a multiple of W̄, and Z = −P times N/4πi; ξ′ is any."""
    draft = c.draft("coadjoint", "kernel")
    draft.depends_on(general["coadjoint"], *made_from)
    Z, xi = word(a.Z.velocity), word(a.Z.xi_prime)
    turned = general.epsilon * inner(word(W).bar, Z * xi - xi * Z)
    rate = gradient(substitute(turned, {a.Z.velocity: -word(P)}), a.Z.xi_prime).bar
    sign = sign_of(rate, BRACKET)
    moved = mul(sign, scale, ("bracket", "W", "P"))
    return draft.step([Equation("Ẇ", moved)], say("coadjoint.torus"))


def _motion(phase: Phase, scale: Tree, made_from: tuple[Step, ...], c: Chapter) -> Step:
    """The coefficient at T(n) of Ẇ = (N/4πi) [W, P]."""
    draft = c.draft("motion", "solution")
    draft.depends_on(*made_from)
    unit, total = bracket_at(phase, lambda k: of("ω̂", k), stream)
    unit = unit * _inverse_i(Torus(phase.N)) * -1  # P has −|n|⁻² ω̂(n)
    return draft.step(
        [Equation(("call", "d/dt", of("ω̂", N)), unit.times(total))], say("motion.torus")
    )


def _kept(made_from: tuple[Step, ...], torus: Torus, a: Alphabet, c: Chapter) -> Step:
    """The energy, and Tr Wᵏ: traces of a product with a bracket of one of its factors."""
    draft = c.draft("conserved", "conservation")
    draft.depends_on(*made_from)
    _require_zero(trace(BRACKET * word(P)))  # that of h̃ is a multiple, as P is linear in W
    told = [Equation(("call", "d/dt", "h̃"), 0)]
    for k in CASIMIRS:
        _require_zero(derivation(trace(word(*[W] * k)), {W: BRACKET}.get))
        told.append(Equation(("call", "d/dt", ("tr", mul(*["W"] * k))), 0))
    enstrophy = mul(torus.N, summed(lambda n: of("ω̂", n), of("ω̂", minus(N))))
    told.append(Equation(("tr", mul("W", "W")), enstrophy))
    return draft.step(told, say("conserved.torus"))


def _require_zero(e: Expr) -> None:
    if e.terms:
        raise ValueError("the motion does not keep this")
