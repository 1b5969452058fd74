"""What the walk makes of each kind of potential, in words.

``WORDS``: the potentials of a kind together as a word, ``None`` without any.  A kind has that, or
is given point by point (``POINTWISE``), or both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from ...algebra.calculus import (
    adjugate,
    derivation,
    determinant,
    determinant_letter,
    power_of,
    reduce,
    substitute,
)
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, inner, number, one, trace, word
from ...language.derivatives import derivative, product
from ...language.tree import Tree, add, mul, neg, replaced
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.body_kinds import PointBody
from ...schema.potential_kinds import (
    FarCentre,
    Gravity,
    Harmonic,
    SelfGravity,
    Spring,
    Torsion,
    Volume,
    gravity,
    quadratic,
)
from ...schema.table import DETERMINANT
from ..chapter import Chapter, say
from ..spine.alphabet import Alphabet, cancelling, inverse_letter
from ..spine.lagrangian import POINT, sum_over
from .potential_terms import (
    FunctionLetter,
    PotentialLetter,
    Words,
    column,
    in_space,
    power_letter,
)

HALF = Fraction(1, 2)


def _moved(a: Alphabet) -> Expr:
    """The place of a point in space, A r_i + T."""
    position = a.acted_on(word(a.A.position), word(a.T.position))
    return position.marked(Chapter(a.chapter).label("action"))


def _over_masses(summand: Expr, a: Alphabet) -> Expr:
    """The sum over the points of what has their masses and places, by the moments m, c, J."""
    label = Chapter(a.chapter).label("moments")
    moments = {(a.m_i,): a.m, (a.m_i, a.r_i): a.c, (a.m_i, a.r_i, a.r_i): a.J}
    return sum_over(summand, {a.m_i, a.r_i}, {k: word(x).marked(label) for k, x in moments.items()})


# Gravity: −Σ m_i ⟨γ, r_i⟩, a sum over the points like L itself.


def gravity_words(problem: Problem, a: Alphabet, _vectors: bool) -> Words | None:
    """Gravity on words, −⟨γ, Ac⟩ − m⟨γ, T⟩; ``None`` without any."""
    g = gravity(problem.potentials)
    if g is None:
        return None
    summand = -word(a.m_i) * inner(word(Letter("γ", a.n)), _moved(a))
    spread = problem.body is not None and not isinstance(problem.body, PointBody)
    prose = say("potential.whole_body") if spread else ()
    return Words(
        _over_masses(summand, a),
        [Equation("γ", column(problem.own_group.in_every_block(g)))],
        [neg(("sum", "i", ("mul", ("at", "m", "i"), ("inner", "γ", POINT))))],
        prose,
    )


# Harmonic forces: ½ Σ m_i ⟨r_i, W_r r_i⟩, a sum over the points like L itself.


def harmonic_words(problem: Problem, a: Alphabet, _vectors: bool) -> Words | None:
    """Harmonic forces on words, ½ Tr W_r AJĀ with what T adds; ``None`` without any."""
    given = [p.W for p in problem.potentials if isinstance(p, Harmonic)]
    if not given:
        return None
    W, position = Letter("W_r", a.n, a.n, 1), _moved(a)
    summand = HALF * word(a.m_i) * inner(position, word(W) * position)
    span = range(len(given[0]))
    entries = ((add(*(x[i][j] for x in given)) for j in span) for i in span)
    shown: Tree = ("mul", HALF, ("at", "m", "i"), ("metric", W.name, POINT, POINT))
    return Words(
        _over_masses(summand, a),
        [Equation(W.name, ("matrix", *(("row", *row) for row in entries)))],
        [("sum", "i", shown)],
    )


# Springs: those of natural length 0 inside one block together, ½ Tr AKĀ; any other one by one.


def spring_words(problem: Problem, a: Alphabet, _vectors: bool) -> Words | None:
    """The springs of natural length 0 inside one block on words, Σ ½ k_e ‖A s_e‖²; ``None`` without
    any."""
    springs = quadratic(problem.potentials, problem.block)
    if not springs:
        return None
    K, k_e, s_e = Letter("K", a.n, a.n, 1), Letter("k_e"), Letter("s_e", a.n)
    turned = word(a.A.position).marked(Chapter(a.chapter).label("action"))
    stretched = turned * word(s_e)
    summand = HALF * word(k_e) * inner(stretched, stretched)
    return Words(
        sum_over(summand, {k_e, s_e}, {(k_e, s_e, s_e): word(K)}),
        _spring_definitions(springs),
        [
            ("mul", HALF, ("at", "k", e), ("norm2", ("add", i, neg(j))))
            for e, spring in enumerate(springs, 1)
            for i, j in [map(in_space, spring.points())]
        ],
        say("potential.springs"),
    )


def _spring_definitions(springs: tuple[Spring, ...]) -> list[Equation]:
    """The equations of s_e, k_e and K = Σ k_e s_e s̄_e."""
    equations = []
    for e, spring in enumerate(springs, 1):
        i, j = spring.ends
        ends = ("add", ("at", "r", i), neg(("at", "r", j)))
        equations += [Equation(("at", "s", e), ends), Equation(("at", "k", e), spring.stiffness)]
    s: Tree = ("at", "s", "e")
    equations.append(Equation("K", ("sum", "e", ("mul", ("at", "k", "e"), s, ("T", s)))))
    return equations


# Torsion springs: ½ k Tr(1 − R̄A), with N_A = ½ Ā Σ k R the sum of their moments.


def torsion_words(problem: Problem, a: Alphabet, vectors: bool) -> Words | None:
    """Torsion springs on words, ½ k_A Tr 1 − Tr N_A; ``None`` without any."""
    springs = [p for p in problem.potentials if isinstance(p, Torsion)]
    if not springs:
        return None
    N, turned = Letter("N_A", a.n, a.n), Letter("Σ k R", a.n, a.n)
    mu = Letter("μ_A", a.n) if vectors else None
    definitions = [
        Equation("k_A", add(*(p.stiffness for p in springs))),
        Equation("N_A", add(*(mul(HALF, p.stiffness, ("T", "A"), _rest(p)) for p in springs))),
    ]
    if mu:
        definitions.append(Equation(mu.name, _axial(N.name)))
    moments = HALF * word(a.A.position).bar * word(turned)
    return Words(
        HALF * word(Letter("k_A")) * trace(one(a.n)) - trace(word(N)),
        definitions,
        [mul(HALF, p.stiffness, ("tr", add(("one",), neg(_back(p))))) for p in springs],
        own=[PotentialLetter(N, moments, (a.A.position, turned), Fraction(2), mu)],
    )


def _back(p: Torsion) -> Tree:
    """The tree R̄A."""
    return mul(("T", _rest(p)), "A") if p.rest else "A"


def _rest(p: Torsion) -> Tree:
    """The tree R, or 1 where the spring rests there."""
    return ("matrix", *(("row", *row) for row in p.rest)) if p.rest else 1


def _axial(N: Tree) -> Tree:
    """The column of the vector of a matrix: (N₃₂ − N₂₃, …), for j(x)₃₂ = x₁."""
    pairs = ((3, 2), (1, 3), (2, 1))
    entries = (add(("entry", N, i, j), neg(("entry", N, j, i))) for i, j in pairs)
    return ("matrix", *(("row", x) for x in entries))


# An energy of the volume: U_V, a function of V_A = det A, and p_V = −V_A dU_V/dV_A.
#
# By Jacobi's formula, δ log det A = Tr A⁻¹δA, and −dŨ(Aξ′) = p_V Tr ξ′.

V_A, U_V, P_V = "V_A", Letter("U_V"), Letter("p_V")


def volume_words(problem: Problem, a: Alphabet, _vectors: bool) -> Words | None:
    """Energies of the volume on words, U_V; ``None`` without any."""
    given = [p.U for p in problem.potentials if isinstance(p, Volume)]
    if not given:
        return None
    energy: Tree = add(*(replaced(x, DETERMINANT, V_A) for x in given))
    A = a.A.position
    logarithm = trace(word(inverse_letter(A)) * word(A))  # δ log det A, where A⁻¹ stays
    return Words(
        word(U_V),
        [
            Equation(V_A, DETERMINANT),
            Equation(U_V.name, energy),
            Equation(P_V.name, product(-1, V_A, derivative(energy, V_A))),
        ],
        [replaced(x, DETERMINANT, V_A) for x in given],
        say("potential.volume"),
        own=[FunctionLetter(U_V, logarithm, slope=-word(P_V), rules=(cancelling(A),))],
    )


# The gravity of a far centre, with T_b = ĀT, W = 1/‖T‖, V = GM/‖T‖, T seen from the centre:
#
#     Ũ = −V(m − W²⟨T_b, c⟩ + ½ W²(3W²⟨T_b, J T_b⟩ − Tr AJĀ)),
#
# the sum over the points of −V m_i (1 + s)^(−½), s = W²(2⟨T, x⟩ + ‖x‖²), x = A r_i, to the second
# order in x.

V, W = Letter("V"), Letter("W")


def far_centre_words(problem: Problem, a: Alphabet, _vectors: bool) -> Words | None:
    """The expansion on words, summed over the points; ``None`` without a far centre."""
    p = next((p for p in problem.potentials if isinstance(p, FarCentre)), None)
    if p is None:
        return None
    x, T_b = Letter("x", a.n), Letter("T_b", a.n)
    T = Letter("T − a", a.n) if p.centre else a.T.position
    seen: Tree = add("T", neg(column(p.centre))) if p.centre else "T"
    arm: Tree = add(POINT, neg("T"))
    distance: Tree = ("fun", "sqrt", ("norm2", seen))
    shown = WordNotation(display={a.m_i: ("at", "m", "i"), T: seen, x: arm})
    square, over = inner(word(T), word(T)), word(W) * word(W)
    near = inner(word(T), word(x))
    body = PotentialLetter(T_b, word(a.A.position).bar * word(T), (a.A.position, T))
    own = (
        *((PotentialLetter(T, word(a.T.position)),) if p.centre else ()),
        body,
        power_letter(W, square, -HALF, over),
        power_letter(V, square, -HALF, over),
    )
    return Words(
        _summed(a, x, T, body),
        [
            Equation("T_b", mul(("T", "A"), seen)),
            Equation("W", ("div", 1, distance)),
            Equation("V", ("div", p.strength, distance)),
        ],
        [("sum", "i", tree_of(_summand(a, x, near, near * near), shown))],
        say("potential.far_orders"),
        own,
    )


def _summand(a: Alphabet, x: Letter, near: Expr, squared: Expr) -> Expr:
    """The summand −V m_i (1 + s)^(−½), by the binomial series, with ``near`` = ⟨T, x⟩ and its
    square."""
    first, second = -HALF, -HALF * (-HALF - 1) / 2
    over = word(W) * word(W)
    linear = over * (2 * near + inner(word(x), word(x)))
    quadratic = 4 * over * over * squared
    return -word(a.m_i) * word(V) * (number(1) + first * linear + second * quadratic)


def _summed(a: Alphabet, x: Letter, T: Letter, body: PotentialLetter) -> Expr:
    """The sum over the points, where ⟨T, x⟩² is ⟨x, T T̄ x⟩, with T_b."""
    TT = Letter("T T̄", a.n, a.n, 1)
    squared = inner(word(x), word(TT) * word(x))
    summand = _summand(a, x, inner(word(T), word(x)), squared)
    turned = (word(a.A.position) * word(a.r_i)).marked(Chapter(a.chapter).label("action"))
    total = _over_masses(substitute(summand, {x: turned}), a)
    return reduce(substitute(total, {TT: word(T) * word(T).bar}), body.written)


# The gravity of a homogeneous ellipsoid on itself.
#
# With X = K_G ĀA and P(u) = det(X + u), whose derivatives are δP = Tr adj(X + u) δX,
#
#     δ ∫ P^(−½) du = −½ ∫ P^(−3/2) Tr adj(X + u) K_G δ(ĀA) du.
#
# adj(X + u) is a polynomial in u by the theorem of Cayley and Hamilton, and P′(u) is its trace.

SHARE = Fraction(3, 10)
"""The energy of a homogeneous ball of radius a is −(3/5) Gm²/a, and there Ψ = 2/a."""

INVARIANTS = ("I_1", "I_2", "I_3")


@dataclass(frozen=True)
class GradientLetter(PotentialLetter):
    """A scalar letter x, a function of the symmetric ``value``, with δx = ½ Tr B δ(value).

    ``gradient``: B, which stands for ``slope``, in letters of the body and C.
    """

    gradient: Letter = field(kw_only=True)
    slope: Expr = field(kw_only=True)

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter, by its gradient."""
        return HALF * trace(word(self.gradient) * derivation(self.value, delta))

    @staticmethod
    def adjugate(left: Factor, right: Factor) -> Expr | None:
        """C C_a = C_a C = det C 1."""
        both = {left[0].name, right[0].name} == {"C", "C_a"}
        return word(Letter("det_C")) * one(left[0].rows) if both else None


def self_gravity_words(problem: Problem, a: Alphabet, _vectors: bool) -> Words | None:
    """Self-gravity as the letter U_G; ``None`` without it."""
    p = next((p for p in problem.potentials if isinstance(p, SelfGravity)), None)
    if p is None:
        return None
    ellipsoid = _Ellipsoid(a, unimodular="unimodular" in problem.own_group.relations)
    A, energy, B = word(a.A.position), Letter("U_G"), Letter("B_G", a.n, a.n, 1)
    scale = mul(SHARE, p.G, ("pow", "m", 2))
    return Words(
        word(energy),
        [
            *ellipsoid.definitions(),
            Equation("U_G", mul(-1, scale, _integral("Ψ"))),
            Equation("B_G", mul(scale, ellipsoid.summed())),
        ],
        ["U_G"],
        say("potential.self_gravity"),
        [GradientLetter(energy, A.bar * A, gradient=B, slope=ellipsoid.slope())],
    )


class _Ellipsoid:
    """K_G with the coefficients of 1, u, u² in adj(X + u)K_G; ``unimodular``: is det A = 1?"""

    def __init__(self, a: Alphabet, *, unimodular: bool) -> None:
        self.a, self.unimodular = a, unimodular
        self.K, self.K_a, self.C_a, self.A_a = (
            Letter(x, a.n, a.n, symmetry)
            for x, symmetry in (("K_G", 1), ("K_a", 1), ("C_a", 1), ("A_a", 0))
        )
        u, self.X = Letter("u"), Letter("X_G", a.n, a.n)
        X = word(self.X)
        shifted = adjugate(X + word(u) * one(a.n))
        last, self.among, highest = (power_of(shifted, u, k) for k in range(3))
        if last != adjugate(X):
            raise ValueError("adj(X + u) at u = 0 is not adj X")
        self.last = word(self.C_a) * word(self.K_a)  # adj X, the adjugate of a product
        among = self._by_C(self.among)
        self.first = HALF * trace(among)  # I_1, for P′ = 3u² + 2I_1u + I_2
        products = (self.last, among, highest)
        self.coefficients = tuple(reduce(x * word(self.K), self._adjugates) for x in products)

    def _by_C(self, e: Expr) -> Expr:
        """An expression with X_G = K_G C."""
        return substitute(e, {self.X: word(self.K) * word(self.a.C)})

    def _adjugates(self, left: Factor, right: Factor) -> Expr | None:
        """K_a K_G = det K_G 1."""
        pair = {left[0], right[0]} == {self.K_a, self.K}
        return word(determinant_letter(self.K)) * one(self.a.n) if pair else None

    def definitions(self) -> list[Equation]:
        """The equations of K_G, of the adjugates, and of the coefficients of det(AK_GĀ + u)."""
        volume, inverse = ("det", "K_G"), ("inv", "A")
        return [
            Equation("K_G", mul(("div", 5, "m"), "J")),
            Equation("K_a", mul(volume, ("inv", "K_G"))),
            Equation("X_G", self._tree(self._by_C(word(self.X)))),
            Equation("A_a", inverse if self.unimodular else mul(("det", "A"), inverse)),
            Equation("C_a", tree_of(word(self.A_a) * word(self.A_a).bar)),  # adj ĀA = adj A adj Ā
            Equation("I_1", self._tree(self.first)),
            Equation("I_2", self._tree(trace(self.last))),
            Equation(
                "I_3", mul(*map(self._tree, map(determinant, (word(self.K), word(self.a.C)))))
            ),
        ]

    def _without_metric(self, e: Expr) -> Expr:
        """An expression with C = ĀA, and det C the square of det A."""
        A = word(self.a.A.position)
        square = number(1) if self.unimodular else determinant(A.bar * A)
        return substitute(e, {self.a.C: A.bar * A, determinant_letter(self.a.C): square})

    def _tree(self, e: Expr) -> Tree:
        letters = {determinant_letter(x): ("det", x.name) for x in (self.K, self.a.A.position)}
        return tree_of(self._without_metric(e), WordNotation(display=letters))

    def summed(self) -> Tree:
        """The sum of the coefficients of u^k, each times ∫ u^k P^(−3/2) du = Ψ_k."""
        last, _, highest = map(self._tree, self.coefficients)
        among = mul(self._tree(self.among), "K_G")  # as it stands: in the code its terms cancel
        return add(*(mul(_integral(f"Ψ_{k}"), x) for k, x in enumerate((last, among, highest))))

    def slope(self) -> Expr:
        """The same as a word: K_G is J but for a factor, and each Ψ_k and invariant is a number."""
        K = 5 * word(inverse_letter(self.a.m)) * word(self.a.J)
        terms = (word(Letter(f"Ψ_{k}")) * x for k, x in enumerate(self.coefficients))
        return substitute(sum(terms, start=K * 0), {self.K: K})


def _integral(name: str) -> Tree:
    return ("call", name, *INVARIANTS)


WORDS: dict[type, Callable[[Problem, Alphabet, bool], Words | None]] = {
    Gravity: gravity_words,
    Spring: spring_words,
    Harmonic: harmonic_words,
    FarCentre: far_centre_words,
    SelfGravity: self_gravity_words,
    Torsion: torsion_words,
    Volume: volume_words,
}
