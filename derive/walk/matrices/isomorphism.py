"""so(3) ≅ R³ by j(X)Y = X ∧ Y (33): skew letters read as vectors, the metric of J as I's (32)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from ...algebra import calculus
from ...algebra.word_trees import (
    PLAIN,
    WordNotation,
    double,
    fold_double,
    fold_inertia,
    hat,
    normal_form,
    tree_of,
)
from ...algebra.words import Expr, Factor, Letter, Traces, Word, inner, scalar_of, trace, word, zero
from ...language.read import read
from ...language.tree import Tree, add, terms
from ...record.record import Equation, Step, stated
from ..chapter import Chapter, say
from ..spine.alphabet import AlgebraPart, Alphabet, Dual
from ..spine.cartan import brackets_of

# so(3) ≅ R³: the operator j, an isomorphism as the footnote says, and the tensor of inertia.


@dataclass(frozen=True)
class Axial:
    """The identification of so(3) with R³, ``hat_map``; ``inertia``: the step that says I."""

    hat_map: HatMap
    inertia: Step
    steps: tuple[Step, ...]


def axial_identification(b: Alphabet, C: Expr, c: Chapter) -> Axial:
    """The identification by j, with the steps of j, that it is an isomorphism, and of the metric of
    J as that of I; ``C``: ĀA = 1."""
    hat_map = HatMap(b, c.label("hat"), c.label("inertia"))
    identification = _identification(b, C, hat_map.brackets[BRACKET], c)
    inertia = _inertia(b, c)
    return Axial(hat_map, inertia, (identification, isomorphism(hat_map, c), inertia))


def isomorphism(hat_map: HatMap, c: Chapter) -> Step:
    """The step Tr j(x) j(y)‾ = 2⟨x, y⟩, by which j is one to one."""
    draft = c.draft("isomorphism", "identification")
    product = hat_map.hatted(ZETA) * hat_map.hatted(OMEGA).bar
    return draft.step(
        (Equation(tree_of(trace(product)), draft.tree(normal_form(trace(product)))),),
        say("isomorphism.onto"),
    )


# How a sum of vectors of R³ is written: double vector products whole, Iζ ∧ ζ without a sign.


def vector_sum(e: Expr, notation: WordNotation = PLAIN) -> Tree:
    """The tree of a sum of vectors in normal form, as the paper writes it."""
    return add(*map(flip_wedge, terms(tree_of(fold_double(e), notation))))


def flip_wedge(t: Tree) -> Tree:
    """The tree b ∧ a for −(a ∧ b) where the second factor is a product, as the paper writes
    Iζ ∧ ζ."""
    if isinstance(t, tuple) and t[0] == "mul" and len(t) == 3 and t[1] == -1:
        inside = t[2]
        if isinstance(inside, tuple) and inside[0] == "wedge" and isinstance(inside[2], tuple):
            return ("wedge", inside[2], inside[1])
    return t


# so(3) ≅ R³ by j(X)Y = X ∧ Y (33): skew letters read as vectors, the metric of J as I's (32).


def _vector(name: str) -> Letter:
    return Letter(name, 3)


ZETA, OMEGA, OMEGA_P = _vector("ζ"), _vector("Ω"), _vector("Ω′")
D_ZETA, DP_ZETA, ZETA_DOT = _vector("δζ"), _vector("δ′ζ"), _vector("ζ̇")
PHI, MU, BRACKET = _vector("φ"), _vector("μ"), _vector("Ω′ ∧ Ω")
SPIN, D_SPIN, DP_SPIN, SPIN_RATE = map(_vector, ("ℓ_b", "δℓ_b", "δ′ℓ_b", "ℓ̇_b"))
INERTIA = Letter("I", 3, 3, 1)
AXES = {"Z": ZETA, "ξ": OMEGA, "ξ′": OMEGA_P, "δZ": D_ZETA, "δ′Z": DP_ZETA, "f": PHI}
AXES |= {x.name: x for x in (SPIN, D_SPIN, DP_SPIN, SPIN_RATE)}
TURNING = AlgebraPart(
    ZETA, OMEGA, OMEGA_P, D_ZETA, DP_ZETA, ZETA_DOT, _vector("δδ′Ω"), _vector("δδ′ζ")
)
SPINNING = Dual(SPIN, D_SPIN, DP_SPIN, SPIN_RATE, MU)


def anticommute(v: Letter) -> calculus.PairRule:
    """The rule ``v ∧ y = −y ∧ v``, which carries the vector v out of every j(v)."""

    def rule(left: Factor, right: Factor) -> Expr | None:
        (a, a_bar), (b, b_bar) = left, right
        if a.axis == v and b.cols == 1 and not b_bar:
            return -(word(hat(b)) * word(v))
        if b.axis == v and a.cols == 1 and a_bar:
            return -(word(v).bar * word(hat(a)))
        return None

    return rule


@dataclass(frozen=True)
class HatMap:
    """so(3) ≅ R³ on the expressions of an alphabet; ``hat``, ``inertia``: the labels of the steps
    that say Z = j(ζ) and I."""

    letters: Alphabet
    hat: str
    inertia: str

    def scalar(self, e: Expr) -> Expr:
        """A scalar in vectors: j(ζ) for Z, the inertia for traces with J, the moment μ for N_b."""
        b = self.letters
        images = self._hats(e) | {b.bracket: self.hatted(BRACKET)}
        work = fold_inertia(calculus.substitute(e, images), b.J, word(INERTIA).marked(self.inertia))
        return normal_form(fold_moment(work, b.N_body, MU))

    def vector(self, e: Expr) -> Expr:
        """A sum of skew letters as the sum of their axes (sums of vectors stay)."""
        images = self._hats(e)
        return _flat(calculus.substitute(e, images) if images else e)

    def hatted(self, x: Letter) -> Expr:
        """The matrix j(x), as said by the step ``hat``."""
        return word(hat(x)).marked(self.hat)

    @cached_property
    def brackets(self) -> Mapping[Letter, Expr]:
        """The letters of [ξ′, ξ] and ξ′η − ξη′ with their values in vectors, from the structure
        equation with ξ = j(Ω), ξ′ = j(Ω′)."""
        derived = brackets_of(self.letters).values()
        turning, *others = (normal_form(calculus.substitute(e, self._axes(e))) for e in derived)
        found = {BRACKET: calculus.reduce(axial(turning), anticommute(OMEGA))}
        return found | dict(zip((self.letters.bracket_w,), others, strict=False))

    def _hats(self, e: Expr) -> dict[Letter, Expr]:
        return {x: y.marked(self.hat) for x, y in self._axes(e).items()}

    @staticmethod
    def _axes(e: Expr) -> dict[Letter, Expr]:
        return {x: word(hat(axis(x))) for x in e.letters() if x.name in AXES}


def axis(x: Letter) -> Letter:
    """The vector X of a skew letter j(X); any other letter itself."""
    return AXES.get(x.name, x)


def _flat(e: Expr) -> Expr:
    """The vector a + b for a sum j(a) + j(b) of single hats; sums of vectors stay."""
    terms = {}
    for (traces, w), c in e.terms.items():
        axis = w[0][0].axis
        terms[traces, w if axis is None else ((axis, False),)] = c
    return Expr(e.rows, 1, terms, e.lineage)


def fold_moment(e: Expr, moment: Letter, vector: Letter) -> Expr:
    """A scalar with ⟨μ, x⟩ for ``Tr N j(x)‾``, which defines the vector of a moment; N and μ are
    the letters ``moment`` and ``vector``."""

    def folded(cycle: Word) -> Expr:
        axes = [x.axis for x, _ in cycle if x.axis is not None]
        if len(cycle) == 2 and axes and any(x == moment for x, _ in cycle):
            barred = any(bar for x, bar in cycle if x == moment)
            return inner(word(vector), word(axes[0])) * (1 if barred else -1)
        return scalar_of((cycle,))

    return calculus.map_traces(e, folded)


def axial(e: Expr) -> Expr:
    """The vector X for which j(X) is a skew sum of words y x̄, by  j(x ∧ y) = y x̄ − x ȳ."""

    def turned(traces: Traces, w: Word, c: Fraction) -> Expr:
        (y, _), (x, _) = w
        return scalar_of(traces, c / 2) * (word(hat(x)) * word(y))

    return normal_form(calculus.map_terms(e, turned, zero(3, 1)))


def _identification(b: Alphabet, C: Expr, cross: Expr, c: Chapter) -> Step:
    affine = b.affine
    draft = c.draft("hat", "identification")
    equations = stated("Z = j(ζ),  ξ = j(Ω),  ξ′ = j(Ω′)")
    if not affine:
        equations += stated("f = j(φ)")
    draft.depends_on(C)  # only a skew matrix is a j(X)
    equations.append(Equation(read("[ξ′, ξ]"), ("hat", draft.tree(cross))))
    if affine:
        equations += stated("Tr N_b j(Ω′)‾ = ⟨μ, Ω′⟩", for_all=("Ω′",))
    return draft.step(
        equations,
        say("hat.displacements") if affine else say("hat.rotations"),
        () if affine else (33,),
    )


def _inertia(b: Alphabet, c: Chapter) -> Step:
    draft = c.draft("inertia", "identification")
    tensor = inertia_of(b.J)
    return draft.step(
        (*stated("Tr j(ζ) J j(Ω)‾ = ⟨ζ, Ω⟩_I"), Equation("I", draft.tree(tensor))),
        say("inertia.metric"),
        () if b.affine else (32,),
    )


def inertia_of(J: Letter) -> Expr:
    """The tensor I with  Tr j(ζ) J j(Ω)‾ = ⟨ζ, IΩ⟩,  by the double vector product under the
    trace."""
    pairing = calculus.reduce(trace(word(hat(ZETA)) * word(J) * word(hat(OMEGA)).bar), double)
    return calculus.coefficient_of(calculus.gradient(pairing, ZETA), OMEGA)
