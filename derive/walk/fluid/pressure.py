"""The pressure: the multiplier of div u = 0, by the letter D and its adjoint.

    u̇ + ∇_u u = D̄p = −grad p,  −Δp = Tr (∇u)²,  ∂ₙp = −⟨∇_u u, n⟩

What is orthogonal to every field η′ with Dη′ = 0 is in the image of D̄ (Helmholtz).  Then D is put
before this equation; D∇_u u is found at each place, where ∇_u u is (∇u)u, a matrix times a vector.
"""

from __future__ import annotations

from ...algebra.calculus import PairRule, coefficient_of, derivation, reduce
from ...algebra.forms import strip_left
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Factor, Letter, inner, one, trace, word, zero
from ...language.read import read
from ...language.tree import neg
from ...record.formulas import stated
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..wording import say
from .fluid_kernel import FluidKernel
from .fluid_letters import FluidAlphabet

GRADIENT = Letter("grad p", "n")
"""−D̄p as one vector."""
SHOWN = WordNotation(display={GRADIENT: ("call", "grad", "p")})


def pressure(stage: FluidKernel, a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The steps ``divergence``, ``pressure``, ``divergence_along``, ``pressure_equation`` and
    ``boundary``."""
    u, rate = (word(x) for x in (a.w.velocity, a.w.acceleration))
    D, pushed = word(a.D), word(a.D).bar * word(a.p)
    dividing, pressing = c.draft("divergence", "definition"), c.draft("pressure", "multiplier")
    first = dividing.step(
        (
            *stated("D∇_u u = div(∇_u u)"),
            *(Equation(dividing.tree(D * x), 0) for x in (u, rate)),
        ),
        say("divergence.fields"),
    )
    pressing.depends_on(first)
    force = pressing.tree(stage.force)
    second = pressing.step(
        (
            Equation(force, pressing.tree(pushed), exists=("p",)),
            Equation(pressing.tree(pushed), pressing.tree(by_gradient(pushed, a), SHOWN)),
            Equation(force, pressing.tree(by_gradient(pushed, a), SHOWN)),
        ),
        say("pressure.helmholtz") + (() if a.advected else say("pressure.curved")),
    )
    twice = divergence_along(a, c)
    return (first, second, twice, _poisson(stage, a, c, first, twice), _boundary(stage, a, c))


def by_gradient(e: Expr, a: FluidAlphabet) -> Expr:
    """An expression with −grad p for D̄p."""
    return reduce(e, _pair((a.D, True), (a.p, False), -word(GRADIENT)))


def _pair(left: Factor, right: Factor, value: Expr) -> PairRule:
    """The relation that a pair of factors has this value."""
    return lambda x, y: value if (x, y) == (left, right) else None


def divergence_along(a: FluidAlphabet, c: Chapter) -> Step:
    """D∇_u u at one place, by the matrix B of ∇u there: the trace of the derivative of Bu."""
    draft = c.draft("divergence_along", "variation")
    n, u = a.n, a.w.velocity
    B, e = Letter("∇u", n, n, traceless=True), Letter("e", n)
    along_e, along_u = Letter("∂_e B", n, n), Letter("∂_u B", n, n, traceless=True)
    varied = derivation(word(B) * word(u), {B: word(along_e), u: word(B) * word(e)}.get)
    # second derivatives commute: (∂_e B)u = (∂_u B)e, whose trace is that of B along u, 0
    crossed = reduce(varied, _pair((along_e, False), (u, False), word(along_u) * word(e)))
    found = trace(coefficient_of(crossed, e))
    notation = WordNotation(display={B: ("call", "∇", "u")})
    return draft.step(
        (Equation(read("div(∇_u u)"), draft.tree(found, notation)),), say("divergence_along.twice")
    )


def _poisson(stage: FluidKernel, a: FluidAlphabet, c: Chapter, adjoint: Step, twice: Step) -> Step:
    """D before the equation of motion, solved for the acceleration; D u̇ = 0."""
    draft = c.draft("pressure_equation", "elimination")
    draft.depends_on(adjoint, twice)
    inverse = Letter("ρ⁻¹", a.n, a.n, 1)
    over = word(inverse) if a.advected else one(a.n)
    cancelled = _pair((inverse, False), (a.C, False), one(a.n))
    still = _pair((a.D, False), (a.w.acceleration, False), zero("k", 1))
    ((_, value),) = ((e.lhs, e.rhs) for e in twice.equations)
    along = reduce(word(a.D) * reduce(over * stage.force, cancelled), still)
    if along != word(a.D) * word(a.Z.velocity) * word(a.w.velocity):
        raise ValueError("the divergence of the acceleration is not that of ∇_u u")
    pushed = strip_left(word(a.D) * by_gradient(over * word(a.D).bar * word(a.p), a), a.D)
    notation = WordNotation(display={**SHOWN.display, inverse: ("inv", "ρ")})
    laplacian = ("call", "div", draft.tree(-pushed.of(stage.force), notation))
    left = neg(laplacian if a.advected else read("Δp"))
    known = () if a.advected else (Equation(read("Δp"), laplacian),)
    return draft.step((*known, Equation(left, value)), say(f"pressure_equation.{_kind(a)}"))


def _boundary(stage: FluidKernel, a: FluidAlphabet, c: Chapter) -> Step:
    """The equation of motion paired with n, to which u̇ and with it ρu̇ is orthogonal."""
    draft = c.draft("boundary", "restriction")
    n = word(Letter("n", a.n))
    still = a.volume * word(a.w.acceleration)
    push = by_gradient(word(a.D).bar * word(a.p), a)
    paired = inner(n, push) - inner(n, stage.force - still)  # 0 = ⟨n, D̄p − ρ(u̇ + ∇_u u)⟩
    normal = inner(n, word(GRADIENT))
    return draft.step(
        (
            Equation(read("∂ₙp"), draft.tree(normal, SHOWN)),
            Equation(read("∂ₙp"), draft.tree(paired + normal, SHOWN)),
        ),
        say("boundary.tangent"),
    )


def _kind(a: FluidAlphabet) -> str:
    """The density, as a part of a key."""
    return "advected" if a.advected else "homogeneous"
