"""The paper's print against the derivation: what holds as it stands, why the rest does not.

The numbered equations of the note, (1)–(39), are kept exactly as they are printed, each of them
once. Nothing there was corrected.  A *claim* has a truth value and is compared with the derivation;
a *definition* introduces a name.  What a print says is read from the print itself; where it is no
formula of our language it is said beside it what it means, as a whole or part by part.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache, cached_property, lru_cache, partial
from pathlib import Path
from random import Random
from typing import Any

from ...algebra.families import group
from ...check.trials.meaning import environment
from ...check.trials.model import Model
from ...check.trials.trial_points import SIZE
from ...check.values.draws import Locus, difference
from ...check.values.evaluate import Environment, evaluate
from ...language import rational as q
from ...language.read import read
from ...language.show import show
from ...language.tree import Tree, names, neg
from ...record.prose import read as read_texts
from ...record.prose import unmarked
from ...record.record import Derivation, Equation, stated

ALWAYS = {"Σ ": "Σᵢ ", "(t, g, ν)": "", " ∈ so(3)": "", "(δx)": "(δy)"}
"""Parts of prints, and what they mean everywhere: sums run over the points, dϖ and ϖ are of y."""
ABOUT_A_POINT = {*range(21, 36), 39}
"""The numbers that speak of the solid about a fixed point; the others are about the free solid."""


@dataclass(frozen=True)
class PrintedEquation:
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


claim, definition = partial(PrintedEquation, True), partial(PrintedEquation, False)


def permuted(text: str) -> str:
    """The text for each (i, j, k) = pc(1, 2, 3), the cyclic permutations, with commas between
    them."""
    cycles = (("₁", "₂", "₃"), ("₂", "₃", "₁"), ("₃", "₁", "₂"))
    each = (text.replace("_i", i).replace("_j", j).replace("_k", k) for i, j, k in cycles)
    return ",  ".join(each)


NONE = ""
ON_Y = {"(δx, δ′x)": "(δy, δ′y)"}

PAPER: tuple[PrintedEquation, ...] = (
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


# What became of a numbered equation of the paper, as data: nothing is computed here.

CONFIRMED, DEFINITION = "confirmed", "definition"
SIGN, OMISSION, MISPRINT = "sign convention", "omission", "misprint"
VERDICTS = (CONFIRMED, SIGN, OMISSION, MISPRINT, DEFINITION)

HOLDS = {SIGN: "with −dϖ for dϖ, −ω for ω", OMISSION: "where there are no forces"}
"""How what is false as it stands is true, by its verdict."""


@dataclass(frozen=True)
class PaperFinding:
    """What became of one numbered equation.

    ``verdict``: one of :data:`VERDICTS`; ``equations``: those that are false as printed.
    """

    number: int
    verdict: str
    printed: str
    derived: str | None
    counterexample: dict[str, str] | None
    remark: str
    equations: tuple[Equation, ...] = ()

    @property
    def holds(self) -> str | None:
        """In words, how a print that is false as it stands is true; ``None`` for any other."""
        return HOLDS.get(self.verdict)


ORIENTED = ("dϖ", "ω")
"""Forms that change their sign with the convention: dϖ(δ, δ′) is δ[ϖ(δ′)] − δ′[ϖ(δ)], or the
opposite."""

PROBLEMS = ("so3", "affine")
"""The records that hold the derived form of the numbered equations."""

READABLE = 2
"""Counterexamples are sought among integers within ± this, most of them zero."""


class Sparse(Random):
    """A source of random numbers that draws zero more often than not, where it may."""

    def randint(self, a: int, b: int) -> int:
        """A random integer from a to b."""
        zero = self.random() < 0.7
        return 0 if zero and a <= 0 <= b else super().randint(a, b)


def compare(records: Sequence[Derivation]) -> list[PaperFinding]:
    """A finding for each of the numbered equations, by the records of :data:`PROBLEMS`."""
    return list(findings(records))


def findings(records: Sequence[Derivation]) -> Iterator[PaperFinding]:
    """The findings of :func:`compare`, one after the other."""
    return (_finding(p, records) for p in PAPER)


def amendments(numbers: Container[int]) -> list[PaperFinding]:
    """The findings of the given numbers, known to be false as printed, without the records."""
    found = []
    for p in PAPER:
        if p.number in numbers:
            tried = ((e, _counterexample(p, e, 5)) for e in p.equations)
            false, example = next((e, x) for e, x in tried if x is not None)
            what = (_cause(p), p.reads, None, example, p.remark, (false,))
            found.append(PaperFinding(p.number, *what))
    return found


def holds(
    p: PrintedEquation, equation: Equation, size: int = SIZE, seed: int = 0, *, forces: bool = True
) -> bool:
    """Does a printed equation hold at a random exact point of its group?"""
    return not bool(difference(equation, _anywhere(p.group, p.principal, size, seed, forces)))


@lru_cache(maxsize=8)
def _anywhere(group: str, principal: bool, size: int, seed: int, forces: bool) -> Environment:
    """A random exact point for all printed equations of a group."""
    return situation(group, principal, Random(f"paper {group} {seed}"), size, forces=forces)


def _cause(p: PrintedEquation) -> str:
    """The verdict on a print that is false as it stands: sign convention, omission or misprint."""
    if all(holds(p, _other_sign(e)) for e in p.equations):
        return SIGN
    return OMISSION if all(holds(p, e, forces=False) for e in p.equations) else MISPRINT


def _other_sign(e: Equation) -> Equation:
    """An equation with the opposite of dϖ and ω."""

    def opposite(t: Tree) -> Tree:
        if not isinstance(t, tuple):
            return t
        inside = tuple(map(opposite, t))
        return neg(inside) if t[0] == "call" and t[1] in ORIENTED else inside

    return Equation(opposite(e.lhs), opposite(e.rhs))


def point(
    p: PrintedEquation, size: int, seed: int, draw: type[Random] = Random, *, forces: bool = True
) -> Environment:
    """A random exact point for one printed equation."""
    random = draw(f"paper {p.number} {seed}")
    return situation(p.group, p.principal, random, size, forces=forces)


def situation(
    group_name: str, principal: bool, random: Random, size: int, *, forces: bool
) -> Environment:
    """A random exact point of the paper's situation, with an arbitrary potential or none."""
    g = group(group_name)
    problem = {"name": "paper", "group": group_name, "action": g.action}
    model = Model(problem, g, random, size, Locus(principal), generic=forces, few=True)
    env = environment(model)
    numbered = len(model.points)  # a counterexample may name one
    names = ChainMap(_meaningless(model), env.names)  # type: ignore[arg-type]
    return replace(env, names=names, listed=numbered)


def _meaningless(model: Model) -> dict[str, Any]:
    """Values for f′ and φ′: the print gives them no meaning, so they are any element of 𝔤."""
    if model.group.name != "SO(3)":
        return {}
    Z = model.algebra()
    return {"f′": Z, "φ′": ((Z[2][1],), (Z[0][2],), (Z[1][0],))}


def _finding(p: PrintedEquation, records: Sequence[Derivation]) -> PaperFinding:
    false = [e for e in p.equations if not holds(p, e)]
    verdict = _cause(p) if false else CONFIRMED if p.claim else DEFINITION
    counterexample = _counterexample(p, false[0]) if false else None
    assert bool(false) == (counterexample is not None), f"({p.number}) at small values"
    derived = _derived(p, records)
    return PaperFinding(p.number, verdict, p.reads, derived, counterexample, p.remark, tuple(false))


def _derived(p: PrintedEquation, records: Iterable[Derivation]) -> str | None:
    """What the records derive, as text: the printed left sides in the steps that carry the number.

    Failing that, all that such a step says; failing that, the left sides wherever they stand.
    """
    steps = [s for record in records if _suits(record, p) for s in record.steps]
    numbered = [s for s in steps if p.number in s.paper]
    wanted = [*(e.lhs for e in p.equations), *p.answers]
    choices = (
        [e for s in numbered for e in s.equations if e.lhs in wanted],
        [e for s in numbered[:1] for e in s.equations],
        [e for s in steps for e in s.equations if e.lhs in wanted],
    )
    found = next((c for c in choices if c), [])
    return ";  ".join(dict.fromkeys(f"{show(e.lhs)} = {show(e.rhs)}" for e in found)) or None


def _suits(record: Derivation, p: PrintedEquation) -> bool:
    """Is an equation to be read in this record: of SE(3) in the affine one, others in that of
    SO(3)?"""
    return bool((record.problem["action"] == "affine") == (p.group == "SE(3)"))


def _counterexample(
    p: PrintedEquation, equation: Equation, tries: int = 1000
) -> dict[str, str] | None:
    """Small exact values of the names in the equation, of a body with a positive definite J, at
    which its sides differ, if any."""
    for seed in range(p.seed, p.seed + tries):
        try:
            env = point(p, READABLE, seed, Sparse)
        except (ZeroDivisionError, AssertionError):
            continue
        if q.definite(env.names["J"]) and difference(equation, env):
            used = dict.fromkeys(x for side in (equation.lhs, equation.rhs) for x in names(side))
            foot = ["A", "α"] if {"δα", "δ′α"} & {*used} else ["A"] * ("α" in used)
            used = dict.fromkeys([*foot, *used, *p.missing])  # a vector is tangent somewhere
            values = {x: text(env.names[x]) for x in used if x in env.names}
            sides = {
                f"true value of {show(equation.lhs)}": text(evaluate(equation.lhs, env)),
                "value of the printed right side": text(evaluate(equation.rhs, env)),
            }
            return values | sides
    return None


def text(x: Any) -> str:
    """The text of an exact value: a fraction, or the rows of a matrix."""
    if isinstance(x, tuple):
        return "[" + "; ".join(", ".join(text(y) for y in row) for row in x) + "]"
    q = Fraction(x)
    return str(q.numerator) if q.denominator == 1 else f"{q.numerator}/{q.denominator}"
