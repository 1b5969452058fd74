"""The numbered equations of the note, (1)–(39), exactly as they are printed: each of them once.

Nothing here was corrected.  A *claim* has a truth value and is compared with the derivation; a
*definition* introduces a name.  What a print says is read from the print itself; where it is no
formula of our language it is said beside it what it means, as a whole or part by part.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property, partial
from pathlib import Path

from ...language.read import read
from ...language.tree import Tree
from ...record.prose import read as read_texts
from ...record.prose import unmarked
from ...record.record import Equation, stated

ALWAYS = {"Σ ": "Σᵢ ", "(t, g, ν)": "", " ∈ so(3)": "", "(δx)": "(δy)"}
"""Parts of prints, and what they mean everywhere: sums run over the points, dϖ and ϖ are of y."""
ABOUT_A_POINT = {*range(21, 36), 39}
"""The numbers that speak of the solid about a fixed point; the others are about the free solid."""


@dataclass(frozen=True)
class Printed:
    """One numbered equation of the paper.

    ``reads``: its print; ``means``: what that says, in full, or the parts that are to be read in
    another way; empty where nothing of it can be put in.
    ``principal``: it holds in principal axes; ``answers``: left sides of the record that answer it
    where its own are false; ``missing``: names that the print has lost, and a counterexample needs;
    ``seed``: from where one is sought, for nearby is one with few numbers.
    """

    claim: bool
    number: int
    reads: str
    means: str | Mapping[str, str] = field(default_factory=dict)
    principal: bool = False
    answered: str = ""
    missing: tuple[str, ...] = ()
    seed: int = 0

    @property
    def remark(self) -> str:
        """What the print needs, in English; empty for most."""
        return unmarked(remarks().get(self.number, ("", ""))[0])

    @property
    def group(self) -> str:
        """The group of the solid of which the equation speaks."""
        return "SO(3)" if self.number in ABOUT_A_POINT else "SE(3)"

    @cached_property
    def equations(self) -> tuple[Equation, ...]:
        """What is printed, as trees."""
        if isinstance(self.means, str):
            return tuple(stated(self.means)) if self.means else ()
        text = self.reads
        for printed, meant in {**self.means, **ALWAYS}.items():
            text = text.replace(printed, meant)
        return tuple(stated(text))

    @property
    def answers(self) -> tuple[Tree, ...]:
        """Left sides of the record that answer the print where its own are false."""
        return (read(self.answered),) if self.answered else ()


@cache
def remarks() -> dict[int, tuple[str, ...]]:
    """Number → what is said of the print, in English and in French."""
    listed = read_texts([Path(__file__).with_name("remarks.txt")]).items()
    return {int(n): texts for numbers, texts in listed for n in numbers.split()}


claim, definition = partial(Printed, True), partial(Printed, False)


def permuted(text: str) -> str:
    """The text for each (i, j, k) = pc(1, 2, 3), the cyclic permutations, with commas between
    them."""
    cycles = (("₁", "₂", "₃"), ("₂", "₃", "₁"), ("₃", "₁", "₂"))
    each = (text.replace("_i", i).replace("_j", j).replace("_k", k) for i, j, k in cycles)
    return ",  ".join(each)


NONE = ""
ON_Y = {"(δx, δ′x)": "(δy, δ′y)"}

PAPER: tuple[Printed, ...] = (
    definition(1, "‖r_i − r_j‖ = cst", NONE),
    definition(2, "dr_i/dt = v_i,  m_i dv_i/dt = F_i,  F_i = −∂U/∂r_i", NONE),
    definition(3, "L(t, r, v) = Σ m_i v_i²/2 − U", {"(t, r, v)": "", "m_i v_i²/2": "m_i/2 ‖v_i‖²"}),
    definition(4, "r = (r_1, …, r_N),  v = (v_1, …, v_N) ∈ R^{3N}", NONE),
    definition(5, "δa = 0,  a = ∫_a^b L(t, r(t), v(t)) dt", NONE),
    claim(6, "δ‖r_i − r_j‖ = 0", "2⟨δ(r₁(t)) − δ(r₂(t)), r₁(t) − r₂(t)⟩ = 0"),
    definition(7, "r_i(t) = g_t(r_i)", {"g_t(r_i)": "Ar_i + T"}),
    definition(8, "g = (A, T),  g(r) = Ar + T", "r_i(t) = Ar_i + T"),
    claim(9, "δr_i(t) = δg(t)(r_i)", "δ(r_i(t)) = δA r_i + δT"),
    claim(10, "v(t) = (dg(t)/dt)(r)", "v_i = Ȧr_i + Ṫ"),
    definition(11, "a = ∫_a^b L̃(t, g(t), ν(t)) dt", NONE),
    definition(12, "r̂ : (t, g, ν) ↦ (t, g(r), ν(r))", NONE),
    definition(13, "L̃(t, g, ν) = L(t, g(r), ν(r))", {"(t, g(r), ν(r))": ""}),
    claim(14, "ν = (α, τ),  ν(r_i) = αr_i + τ", {"ν = (α, τ),  ν(r_i)": "v_i"}),
    definition(15, "ϖ(δy) = p̃(δg) − h̃δt,  ỹ = (t, g, ν)", {"δg": "δA, δT", ",  ỹ = ": ""}),
    claim(
        16,
        "p̃ = dL̃_g ∈ T*_g E,  h̃(t, g, ν) = h(t, g(r), ν(r))",
        "h̃ = p̃(α, τ) − L̃,  h̃ = Σᵢ m_i/2 ‖v_i‖² + U",
    ),
    claim(17, "L̃(t, g, ν) = ½ Tr αJᾱ + ⟨αc, τ⟩ + (m/2)‖τ‖² − Ũ"),
    definition(18, "J = Σ m_i r_i r̄_i"),
    definition(19, "c = Σ m_i r_i,  m = Σ m_i"),
    claim(
        20,
        "p_SO(3)(δA) = Tr[(Jᾱ + τc̄)δA],  p_R³(δτ) = ⟨mτ + αc, δτ⟩",
        {"p_SO(3)(δA)": "p̃(δA, 0)", "[": " ", "]": "", "p_R³(": "p̃(0, "},
        answered="p̃(0, δT)",
        seed=1329,
    ),
    claim(21, "L̃(t, g, ν) = ½ Tr αJᾱ − Ũ"),
    claim(22, "⟨α, α′⟩_J = Tr αJᾱ′,  L̃ = ½‖α‖²_J − Ũ", {"α′": "δA", "ᾱ′": "δĀ"}),
    claim(23, "ϖ(δy) = ⟨α, δA⟩_J − h̃δt,  h̃ = ½‖α‖²_J + Ũ"),
    definition(24, "F̃ = −grad_J Ũ ∈ T_A SO(3)", "⟨F̃, δA⟩_J = −dŨ(δA)"),
    claim(25, "dϖ(δy, δ′y) = ⟨δA − αδt, δ′α − F̃δ′t⟩_J − ⟨δ′A − αδ′t, δα − F̃δt⟩_J", seed=2436),
    claim(26, "ω(δx, δ′x) = ⟨δA, δ′α⟩_J − ⟨δ′A, δα⟩_J", seed=2958),
    definition(27, "θ : T_A SO(3) → so(3),  θ(A, α) = (A, Z = A⁻¹α)", "Z = A⁻¹α"),
    claim(28, "ϖ(δx) = Tr A⁻¹δA J Z̄ − (½ Tr ZJZ̄ + Ũ)δt"),
    claim(
        29,
        "dϖ(δx, δ′x) = Tr(ξ′ − Zδ′t)J(δZ̄ − f̄δt) − Tr(ξ − Zδt)J(δ′Z − f̄′δ′t) + Tr[ξ′, ξ]JZ̄",
        ON_Y,
        seed=6311,
    ),
    definition(30, "ξ = A⁻¹δA,  ξ′ = A⁻¹δ′A ∈ so(3),  f = A⁻¹F̃"),
    claim(
        31,
        "dϖ(δx, δ′x) = ⟨Ω′ − ζδ′t, δζ − φδt⟩_I − ⟨Ω − ζδt, δ′ζ − φ′δ′t⟩_I + ⟨ζ, Ω′ ∧ Ω⟩_I",
        ON_Y,
        seed=4855,
    ),
    claim(32, "I = J − Tr J", {"Tr J": "(Tr J) 1"}, seed=39),
    definition(33, "ξ = j(Ω),  ξ′ = j(Ω′),  Z = j(ζ),  f = j(φ)"),
    claim(34, "Ω = ζ,  dζ/dt = φ + I⁻¹(Iζ ∧ ζ)", {"Ω": "Ω(X)", "dζ/dt": "ζ̇"}),
    claim(
        35,
        "dζ_i/dt = ((λ_j − λ_k)/λ_i) ζ_j ζ_k,  (i, j, k) = pc(1, 2, 3)",
        permuted("ζ̇_i = ((λ_j − λ_k)/λ_i) ζ_j ζ_k"),
        principal=True,
        missing=("φ",),
        seed=4100,
    ),
    definition(36, "L(t, r, v) = ∫_S [½m‖v‖² − U] dn", "L = Σᵢ m_i/2 ‖v_i‖² − U"),
    claim(
        37,
        "ϖ(δy) = ∫_S m⟨v, δr⟩ dn − hδt,  h = ∫_S [½m‖v‖² + U] dn",
        "ϖ(δy) = Σᵢ m_i ⟨v_i, δ(r_i(t))⟩ − h̃δt,  h̃ = Σᵢ m_i/2 ‖v_i‖² + U",
    ),
    definition(38, "g(r) = g ∘ r", NONE),
    claim(39, "J = ∫_S m r r̄ dn", "J = Σᵢ m_i r_i r̄_i,  L̃ = ½ Tr αJᾱ − Ũ"),
)
