"""The numbered equations of the free solid and the continuum, (1)–(20), (36)–(38), as printed."""

from __future__ import annotations

from ..language.tree import Tree, add, mul, neg
from ..record.record import Equation
from .printing import DMOVED, M_I, MOVED, R_I, V_I, VARPI, Printed, bar, minus, tr


def _moved(i: int) -> Tree:
    return ("call", ("at", "r", i), "t")


def _difference(i: int, j: int) -> Tree:
    return add(_moved(i), neg(_moved(j)))


def _varied(i: int, j: int) -> Tree:
    return add(("call", "δ", _moved(i)), neg(("call", "δ", _moved(j))))


KINETIC: Tree = ("sum", "i", mul(("div", M_I, 2), ("norm2", V_I)))
ENERGY_17: Tree = add(
    ("div", tr("α", "J", bar("α")), 2),
    ("inner", mul("α", "c"), "τ"),
    mul(("div", "m", 2), ("norm2", "τ")),
    neg("Ũ"),
)
SOLID: tuple[Printed, ...] = (
    Printed(1, False, "SE(3)", "‖r_i − r_j‖ = cst"),
    Printed(2, False, "SE(3)", "dr_i/dt = v_i,  m_i dv_i/dt = F_i,  F_i = −∂U/∂r_i"),
    Printed(
        3, False, "SE(3)", "L(t, r, v) = Σ m_i v_i²/2 − U", (Equation("L", add(KINETIC, neg("U"))),)
    ),
    Printed(4, False, "SE(3)", "r = (r_1, …, r_N),  v = (v_1, …, v_N) ∈ R^{3N}"),
    Printed(
        5,
        False,
        "SE(3)",
        "δa = 0,  a = ∫_a^b L(t, r(t), v(t)) dt",
        remark="The letter a is both the action and the lower bound.",
    ),
    Printed(
        6,
        True,
        "SE(3)",
        "δ‖r_i − r_j‖ = 0",
        (Equation(mul(2, ("inner", _varied(1, 2), _difference(1, 2))), 0),),
        "Checked as δ‖r_i − r_j‖² = 0.",
    ),
    Printed(7, False, "SE(3)", "r_i(t) = g_t(r_i)", (Equation(MOVED, add(mul("A", R_I), "T")),)),
    Printed(
        8, False, "SE(3)", "g = (A, T),  g(r) = Ar + T", (Equation(MOVED, add(mul("A", R_I), "T")),)
    ),
    Printed(
        9, True, "SE(3)", "δr_i(t) = δg(t)(r_i)", (Equation(DMOVED, add(mul("δA", R_I), "δT")),)
    ),
    Printed(10, True, "SE(3)", "v(t) = (dg(t)/dt)(r)", (Equation(V_I, add(mul("Ȧ", R_I), "Ṫ")),)),
    Printed(11, False, "SE(3)", "a = ∫_a^b L̃(t, g(t), ν(t)) dt"),
    Printed(12, False, "SE(3)", "r̂ : (t, g, ν) ↦ (t, g(r), ν(r))"),
    Printed(13, False, "SE(3)", "L̃(t, g, ν) = L(t, g(r), ν(r))", (Equation("L̃", "L"),)),
    Printed(
        14,
        True,
        "SE(3)",
        "ν = (α, τ),  ν(r_i) = αr_i + τ",
        (Equation(V_I, add(mul("α", R_I), "τ")),),
    ),
    Printed(
        15,
        False,
        "SE(3)",
        "ϖ(δy) = p̃(δg) − h̃δt,  ỹ = (t, g, ν)",
        (Equation(VARPI, add(("call", "p̃", "δA", "δT"), neg(mul("h̃", "δt")))),),
        "The point is written y on the left and ỹ on the right.",
    ),
    Printed(
        16,
        True,
        "SE(3)",
        "p̃ = dL̃_g ∈ T*_g E,  h̃(t, g, ν) = h(t, g(r), ν(r))",
        (Equation("h̃", add(("call", "p̃", "α", "τ"), neg("L̃"))), Equation("h̃", add(KINETIC, "U"))),
        "dL̃_g is the derivative of L̃ along the fibre T_g E, t and g being fixed.",
    ),
    Printed(
        17,
        True,
        "SE(3)",
        "L̃(t, g, ν) = ½ Tr αJᾱ + ⟨αc, τ⟩ + (m/2)‖τ‖² − Ũ",
        (Equation("L̃", ENERGY_17),),
    ),
    Printed(
        18,
        False,
        "SE(3)",
        "J = Σ m_i r_i r̄_i",
        (Equation("J", ("sum", "i", mul(M_I, R_I, bar(R_I)))),),
    ),
    Printed(
        19,
        False,
        "SE(3)",
        "c = Σ m_i r_i,  m = Σ m_i",
        (Equation("c", ("sum", "i", mul(M_I, R_I))), Equation("m", ("sum", "i", M_I))),
        "c is the first moment; the text calls it the centre of gravity, which is c/m.",
    ),
    Printed(
        20,
        True,
        "SE(3)",
        "p_SO(3)(δA) = Tr[(Jᾱ + τc̄)δA],  p_R³(δτ) = ⟨mτ + αc, δτ⟩",
        (
            Equation(("call", "p̃", "δA", 0), tr(add(mul("J", bar("α")), mul("τ", bar("c"))), "δA")),
            Equation(("call", "p̃", 0, "δτ"), ("inner", add(mul("m", "τ"), mul("α", "c")), "δτ")),
        ),
        "As ⟨δA c, τ⟩ = Tr cτ̄ δA, the factors are exchanged; and the displacement that "
        "the second part measures is δT, not δτ.",
        answers=(("call", "p̃", 0, "δT"),),
        seed=1329,
    ),
    Printed(
        36,
        False,
        "SE(3)",
        "L(t, r, v) = ∫_S [½m‖v‖² − U] dn",
        (Equation("L", add(KINETIC, neg("U"))),),
        "Checked for a measure concentrated at points.",
    ),
    Printed(
        37,
        True,
        "SE(3)",
        "ϖ(δy) = ∫_S m⟨v, δr⟩ dn − hδt,  h = ∫_S [½m‖v‖² + U] dn",
        (
            Equation(VARPI, minus(("sum", "i", mul(M_I, ("inner", V_I, DMOVED))), "h̃", "δt")),
            Equation("h̃", add(KINETIC, "U")),
        ),
        "Checked for a measure concentrated at points.",
    ),
    Printed(38, False, "SE(3)", "g(r) = g ∘ r"),
)
