"""The numbered equations of the solid about a fixed point, (21)–(35) and (39), as printed."""

from __future__ import annotations

from ..language.tree import Tree, add, mul, neg
from ..record.record import Equation
from .printing import DOMEGA, M_I, R_I, VARPI, Printed, bar, metric, minus, tr

PC = ((1, 2, 3), (2, 3, 1), (3, 1, 2))


def _euler(i: int, j: int, k: int) -> Equation:
    """(35) as printed, for one circular permutation."""

    def at(name: str, index: int) -> Tree:
        return ("entry", name, index)

    ratio: Tree = ("div", add(at("λ", j), neg(at("λ", k))), at("λ", i))
    return Equation(at("ζ̇", i), mul(ratio, at("ζ", j), at("ζ", k)))


SAME_FORCE = "The force is a function of the point, not of the variation: the prime has no meaning."
ORIENTATION = (
    "With dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)], the convention of (29) and (31), the "
    "sign is the opposite; (25) and (26) both follow the other convention. The kernel is the same."
)

TOP: tuple[Printed, ...] = (
    Printed(
        21,
        True,
        "SO(3)",
        "L̃(t, g, ν) = ½ Tr αJᾱ − Ũ",
        (Equation("L̃", add(("div", tr("α", "J", bar("α")), 2), neg("Ũ"))),),
    ),
    Printed(
        22,
        True,
        "SO(3)",
        "⟨α, α′⟩_J = Tr αJᾱ′,  L̃ = ½‖α‖²_J − Ũ",
        (
            Equation(metric("J", "α", "δA"), tr("α", "J", bar("δA"))),
            Equation("L̃", add(("div", ("norm2", "J", "α"), 2), neg("Ũ"))),
        ),
        remark="Before it, J is called positive definite: it is where the masses are not all in "
        "one plane through the fixed point. A metric on SO(3) needs less: not all on one line "
        "through it.",
    ),
    Printed(
        23,
        True,
        "SO(3)",
        "ϖ(δy) = ⟨α, δA⟩_J − h̃δt,  h̃ = ½‖α‖²_J + Ũ",
        (
            Equation(VARPI, minus(metric("J", "α", "δA"), "h̃", "δt")),
            Equation("h̃", add(("div", ("norm2", "J", "α"), 2), "Ũ")),
        ),
    ),
    Printed(
        24,
        False,
        "SO(3)",
        "F̃ = −grad_J Ũ ∈ T_A SO(3)",
        (Equation(metric("J", "F̃", "δA"), neg(("call", "dŨ", "δA"))),),
    ),
    Printed(
        25,
        True,
        "SO(3)",
        "dϖ(δy, δ′y) = ⟨δA − αδt, δ′α − F̃δ′t⟩_J − ⟨δ′A − αδ′t, δα − F̃δt⟩_J",
        (
            Equation(
                DOMEGA,
                add(
                    metric("J", minus("δA", "α", "δt"), minus("δ′α", "F̃", "δ′t")),
                    neg(metric("J", minus("δ′A", "α", "δ′t"), minus("δα", "F̃", "δt"))),
                ),
            ),
        ),
        ORIENTATION,
        seed=2436,
    ),
    Printed(
        26,
        True,
        "SO(3)",
        "ω(δx, δ′x) = ⟨δA, δ′α⟩_J − ⟨δ′A, δα⟩_J",
        (
            Equation(
                ("call", "ω", "δx", "δ′x"),
                add(metric("J", "δA", "δ′α"), neg(metric("J", "δ′A", "δα"))),
            ),
        ),
        ORIENTATION,
        seed=2958,
    ),
    Printed(
        27,
        False,
        "SO(3)",
        "θ : T_A SO(3) → so(3),  θ(A, α) = (A, Z = A⁻¹α)",
        (Equation("Z", mul(("inv", "A"), "α")),),
        "The value printed is a pair in SO(3) × so(3); the Maurer–Cartan form is its second part.",
    ),
    Printed(
        28,
        True,
        "SO(3)",
        "ϖ(δx) = Tr A⁻¹δA J Z̄ − (½ Tr ZJZ̄ + Ũ)δt",
        (
            Equation(
                VARPI,
                minus(
                    tr(("inv", "A"), "δA", "J", bar("Z")),
                    add(("div", tr("Z", "J", bar("Z")), 2), "Ũ"),
                    "δt",
                ),
            ),
        ),
        "The variation is of (t, A, Z); the text leaves the time out of x = (a, Z).",
    ),
    Printed(
        29,
        True,
        "SO(3)",
        "dϖ(δx, δ′x) = Tr(ξ′ − Zδ′t)J(δZ̄ − f̄δt) − Tr(ξ − Zδt)J(δ′Z − f̄′δ′t) + Tr[ξ′, ξ]JZ̄",
        (
            Equation(
                DOMEGA,
                add(
                    tr(minus("ξ′", "Z", "δ′t"), "J", minus(bar("δZ"), bar("f"), "δt")),
                    neg(tr(minus("ξ", "Z", "δt"), "J", minus("δ′Z", bar("f′"), "δ′t"))),
                    tr(("bracket", "ξ′", "ξ"), "J", bar("Z")),
                ),
            ),
        ),
        "The transpose is missing on δ′Z in the second term. " + SAME_FORCE,
        seed=6311,
    ),
    Printed(
        30,
        False,
        "SO(3)",
        "ξ = A⁻¹δA,  ξ′ = A⁻¹δ′A ∈ so(3),  f = A⁻¹F̃",
        (
            Equation("ξ", mul(("inv", "A"), "δA")),
            Equation("ξ′", mul(("inv", "A"), "δ′A")),
            Equation("f", mul(("inv", "A"), "F̃")),
        ),
    ),
    Printed(
        31,
        True,
        "SO(3)",
        "dϖ(δx, δ′x) = ⟨Ω′ − ζδ′t, δζ − φδt⟩_I − ⟨Ω − ζδt, δ′ζ − φ′δ′t⟩_I + ⟨ζ, Ω′ ∧ Ω⟩_I",
        (
            Equation(
                DOMEGA,
                add(
                    metric("I", minus("Ω′", "ζ", "δ′t"), minus("δζ", "φ", "δt")),
                    neg(metric("I", minus("Ω", "ζ", "δt"), minus("δ′ζ", "φ′", "δ′t"))),
                    metric("I", "ζ", ("wedge", "Ω′", "Ω")),
                ),
            ),
        ),
        SAME_FORCE + " With φ for φ′ the equation holds.",
        seed=4855,
    ),
    Printed(
        32,
        True,
        "SO(3)",
        "I = J − Tr J",
        (Equation("I", add("J", neg(mul(("tr", "J"), ("one",))))),),
        "The sign: ⟨ζ, Iζ⟩ would be negative, against (31); (34) and (35) do not see it.",
        seed=39,
    ),
    Printed(
        33,
        False,
        "SO(3)",
        "ξ = j(Ω),  ξ′ = j(Ω′),  Z = j(ζ),  f = j(φ)",
        (
            Equation("ξ", ("hat", "Ω")),
            Equation("ξ′", ("hat", "Ω′")),
            Equation("Z", ("hat", "ζ")),
            Equation("f", ("hat", "φ")),
        ),
    ),
    Printed(
        34,
        True,
        "SO(3)",
        "Ω = ζ,  dζ/dt = φ + I⁻¹(Iζ ∧ ζ)",
        (
            Equation(("call", "Ω", "X"), "ζ"),
            Equation("ζ̇", add("φ", mul(("inv", "I"), ("wedge", mul("I", "ζ"), "ζ")))),
        ),
        "Ω is that of the vector of the kernel with δt = 1.",
    ),
    Printed(
        35,
        True,
        "SO(3)",
        "dζ_i/dt = ((λ_j − λ_k)/λ_i) ζ_j ζ_k,  (i, j, k) = pc(1, 2, 3)",
        tuple(_euler(*p) for p in PC),
        "Said to be equivalent to (34), it has lost the term φ of the potential.",
        True,
        missing=("φ",),
        seed=4100,
    ),
    Printed(
        39,
        True,
        "SO(3)",
        "J = ∫_S m r r̄ dn",
        (
            Equation("J", ("sum", "i", mul(M_I, R_I, bar(R_I)))),
            Equation("L̃", add(("div", tr("α", "J", bar("α")), 2), neg("Ũ"))),
        ),
        "Checked for a measure concentrated at points: the same equations with this J.",
    ),
)
