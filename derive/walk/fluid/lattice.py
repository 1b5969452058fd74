"""Sums over the lattice of the torus, quadratic forms of them, and their motion mode by mode."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.structure import Place, TorusLattice
from ...algebra.words import Expr, Letter
from ...language.tree import Tree, add, mul, neg
from ...record.record import Equation, Step
from ..chapter import Chapter, say

# Sums over the lattice of the torus: an element Σ a(n) T(n) by its coefficient a, a function of
# n.
#
# T(m) T(n) = (cos x − i sin x) T(m + n),  x = 2π m∧n/N
#
# The bracket keeps twice the odd part of the phase:  [T(m), T(n)] = −2i sin x T(m + n).

FREE, BOUND = "𝐧", "𝐦"
"""A free index, and one that a sum binds."""
Index = tuple[int, int]
"""An index p𝐦 + q𝐧 by its numbers (p, q)."""
M, N = (1, 0), (0, 1)


def shown(k: Index) -> Tree:
    """The tree of an index."""
    parts = [(x, name) for x, name in zip(k, (BOUND, FREE), strict=True) if x]
    return add(*(mul(x, name) for x, name in sorted(parts, key=lambda part: part[0] < 0)))


def minus(k: Index, other: Index = (0, 0)) -> Index:
    """other − k."""
    return other[0] - k[0], other[1] - k[1]


def of(name: str, k: Index) -> Tree:
    """The value of a function of the lattice."""
    return ("call", name, shown(k))


def crossed(k: Index, other: Index) -> int:
    """k ∧ other, as a multiple of m ∧ n."""
    return k[0] * other[1] - k[1] * other[0]


@dataclass(frozen=True)
class Unit:
    """q iᵃ πᵇ, a = 0 or 1: the numbers of the torus."""

    q: Fraction
    i: int = 0
    pi: int = 0

    def __mul__(self, other: Unit | int | Fraction) -> Unit:
        if not isinstance(other, Unit):
            return Unit(self.q * other, self.i, self.pi)
        turns, i = divmod(self.i + other.i, 2)
        return Unit((-1) ** turns * self.q * other.q, i, self.pi + other.pi)

    def __add__(self, other: Unit) -> Unit:
        if (self.i, self.pi) != (other.i, other.pi):
            raise ValueError("a sum of numbers with other powers of i and π")
        return Unit(self.q + other.q, self.i, self.pi)

    def __sub__(self, other: Unit) -> Unit:
        return self + other * -1

    @property
    def inverse(self) -> Unit:
        """1/x; that of i is −i."""
        return Unit((-1) ** self.i / self.q, self.i, -self.pi)

    def times(self, *factors: Tree) -> Tree:
        """The tree of a product, i on that side of the line where π is."""
        if not self.i and not self.pi:
            return mul(self.q, *factors)
        q, i = (-self.q if self.pi < 0 and self.i else self.q), ("i",) * self.i
        above = ("π",) * (self.pi > 0) + i * (self.pi >= 0)
        below = ("π",) * (self.pi < 0) + i * (self.pi < 0)
        top, bottom = mul(abs(q.numerator), *above), mul(q.denominator, *below)
        return mul(1 if q > 0 else -1, top if bottom == 1 else ("div", top, bottom), *factors)


ONE = Unit(Fraction(1))
SINE = Unit(Fraction(-1), 1)
"""What the sine has in the phase of T(m) T(n), the cosine having 1."""


@dataclass(frozen=True)
class Phase:
    """The two parts of the phase of T(m) T(n) for an N: the even one cos, the odd one −i sin."""

    N: int

    def angle(self) -> Tree:
        """2π m∧n/N."""
        return ("div", mul(2, "π", ("wedge", BOUND, FREE)), self.N)

    def sine(self, k: int) -> Tree:
        """sin 2πk/N."""
        return ("fun", "sin", ("div", mul(2 * k, "π"), self.N))

    def product(self) -> Tree:
        """The phase itself."""
        cos, sin = (("fun", name, self.angle()) for name in ("cos", "sin"))
        return add(cos, SINE.times(sin))

    def bracket(self, k: Index, other: Index) -> tuple[Unit, Tree]:
        """That of [T(k), T(other)], where k ∧ other is ± m ∧ n: of the product less the one in the
        other order the odd part is left, twice."""
        odd = SINE * crossed(k, other) - SINE * crossed(other, k)
        return odd, ("fun", "sin", self.angle())


CoefficientAt = Callable[[Index], Tree]


def summed(coefficient: CoefficientAt, factor: Tree | None = None) -> Tree:
    """Σ a(n) T(n), or Σ a(n) times another factor."""
    last = of("T", N) if factor is None else factor
    return ("sum", FREE, mul(coefficient(N), last))


def bracket_at(phase: Phase, a: CoefficientAt, b: CoefficientAt) -> tuple[Unit, Tree]:
    """The coefficient at n of the bracket of Σ a T and Σ b T: the sum over m of a(n − m) b(m)."""
    unit, sine = phase.bracket(minus(M, N), M)
    return unit, ("sum", BOUND, mul(sine, b(M), a(minus(M, N))))


# Elements Σ a(n) T(n) and quadratic forms Σ a(n) b(−n) on the lattice of the torus.
#
# A coefficient is u |n|²ᵖ times a function of n. The trace form pairs two elements,
#
# Tr (Σ a T)(Σ b T) = N Σ a(n) b(−n),
#
# as T(n) T(−n) = T(0) = 1 has the trace N, and no other T(n) has any. A form is the finite map of
# its terms: δ, gradients and substitutions are those of polynomials.


@dataclass(frozen=True)
class Coefficient:
    """u |n|²ᵖ a(n), a being a function of the lattice by its name."""

    name: str
    unit: Unit = ONE
    power: int = 0

    def times(self, unit: Unit | Fraction | int, power: int = 0) -> Coefficient:
        """The same times a number and a power of |n|²."""
        return Coefficient(self.name, self.unit * unit, self.power + power)

    def solved_for(self, name: str) -> Coefficient:
        """Of b(n) = u |n|²ᵖ a(n), what a(n) is by b, whose name is given."""
        return Coefficient(name, self.unit.inverse, -self.power)

    def over(self, other: Coefficient) -> Unit:
        """The number that it is of another; ``ValueError`` where it is no multiple."""
        if (self.name, self.power) != (other.name, other.power):
            raise ValueError(f"no multiple of that of {other.name}")
        return self.unit * other.unit.inverse

    def at(self, k: Index) -> Tree:
        """|k|²ᵖ a(k), without the unit."""
        value, square = of(self.name, k), ("norm2", FREE if k in (N, minus(N)) else BOUND)
        raised = square if abs(self.power) == 1 else ("pow", square, abs(self.power))
        if self.power < 0:
            return ("div", value, raised)
        return mul(raised, value) if self.power else value

    def element(self) -> Tree:
        """Σ of it T(n)."""
        return self.unit.times(summed(self.at))


Term = tuple[str, str, int]
"""|n|²ᵖ a(n) b(−n) by a, b and p, a ≤ b: n and −n may change places."""


@dataclass(frozen=True)
class LatticeForm:
    """The sum over n of some terms, each with its unit."""

    terms: Mapping[Term, Unit]

    def __add__(self, other: LatticeForm) -> LatticeForm:
        total = dict(self.terms)
        for t, u in other.terms.items():
            total[t] = total[t] + u if t in total else u
        return LatticeForm({t: u for t, u in total.items() if u.q})

    def __sub__(self, other: LatticeForm) -> LatticeForm:
        return self + other.times(-1)

    def times(self, unit: Unit | Fraction | int) -> LatticeForm:
        """The same times a number."""
        return LatticeForm({t: u * unit for t, u in self.terms.items()})

    def put(self, name: str, image: Coefficient) -> LatticeForm:
        """The form with another coefficient for a function."""
        total = LatticeForm({})
        for (a, b, p), u in self.terms.items():
            first, second = (image if x == name else Coefficient(x) for x in (a, b))
            total += paired(first.times(u, p), second)
        return total

    def varied(self, name: str, variation: str) -> LatticeForm:
        """δ of the form by the product rule, δa being the variation of one function a."""
        total = LatticeForm({})
        for (a, b, p), u in self.terms.items():
            for x, other in ((a, b), (b, a)):
                if x == name:
                    total += paired(Coefficient(other, u, p), Coefficient(variation))
        return total

    def gradient(self, variation: str) -> Coefficient:
        """What multiplies the variation at −n in a form that is linear in it."""
        (a, b, p), u = self.only
        if (a == variation) == (b == variation):
            raise ValueError(f"not linear in {variation}")
        return Coefficient(b if a == variation else a, u, p)

    @property
    def only(self) -> tuple[Term, Unit]:
        """The one term of a form; ``ValueError`` where it has another number of them."""
        (found,) = self.terms.items()
        return found

    def over(self, other: LatticeForm) -> Unit:
        """The number that it is of another form; ``ValueError`` where it is no multiple."""
        (term, u), (there, v) = self.only, other.only
        if term != there:
            raise ValueError("no multiple of that form")
        return u * v.inverse

    def tree(self) -> Tree:
        """The sum of the one term of a form."""
        (a, b, p), u = self.only
        return u.times(summed(Coefficient(a, ONE, p).at, of(b, minus(N))))


def paired(x: Coefficient, y: Coefficient) -> LatticeForm:
    """Σ of the one at n times the other at −n."""
    a, b = sorted((x.name, y.name))
    return LatticeForm({(a, b, x.power + y.power): x.unit * y.unit})


def traced(e: Expr, elements: Mapping[Letter, Coefficient], order: int) -> LatticeForm:
    """A sum of traces of products of two letters, which stand for elements of su(N)."""
    total = LatticeForm({})
    for (traces, rest), c in e.terms.items():
        (((x, bar), (y, other)),) = traces
        if rest or bar != other:
            raise ValueError("no trace of a product of two elements")
        total += paired(elements[x], elements[y]).times(c * order)
    return total


# What acts on the fluid from outside dϖ: a covector, by its values f̂(n) as those of Π are ω̂(n), and
# damping, −κ |n|²ᵖ ω̂(n).


@dataclass(frozen=True)
class VorticityForcing:
    """Is there an input f̂?  ``damping``: the coefficients κ, each with p."""

    driven: bool
    damping: tuple[tuple[Tree, int], ...] = ()

    def __bool__(self) -> bool:
        return self.driven or bool(self.damping)

    def at(self, k: Index) -> Tree:
        """The coefficient of the whole at an index."""
        damped = (neg(mul(kappa, Coefficient("ω̂", ONE, p).at(k))) for kappa, p in self.damping)
        return add(*([of("f̂", k)] * self.driven), *damped)

    def at_place(self, n: Place) -> Tree:
        """The same at a place."""
        size = _square(n)
        damped = (neg(mul(kappa, size**p, at(n))) for kappa, p in self.damping)
        return add(*([at(n, "f̂")] * self.driven), *damped)


# The motion on the torus mode by mode, for small N: the sums over the lattice, written out.
#
# [W, P] is the sum of a(m) b(k) [T(m), T(k)], which is on T(m + k); the sines of m∧k and of k∧m
# are opposite, so that each pair {m, k} is one term, and terms with the same sine stand together.

LARGEST = 5
"""The largest N of which the modes are written out, as 12 equations of 11 terms."""
Pair = tuple[Place, Place]
Terms = Mapping[int, Mapping[Pair, Fraction]]
"""Of one mode: by k of sin 2πk/N, 0 < k < N/2, the number before each pair of coefficients."""


def modes(
    phase: Phase,
    stream: Coefficient,
    rate: Unit,
    forcing: VorticityForcing,
    motion: Step,
    c: Chapter,
) -> Step:
    """dω̂(n)/dt for one of n and −n, of Ẇ = rate · [W, P] and what acts by ``forcing``;
    ``stream``: P by ω̂."""
    draft = c.draft("modes", "evaluation", motion)
    torus, found = TorusLattice(phase.N), commutator(TorusLattice(phase.N), stream.power)
    unit = rate * stream.unit * phase.bracket(M, N)[0]
    told = [
        Equation(("call", "d/dt", at(n)), add(total(phase, unit, found[n]), forcing.at_place(n)))
        for n in torus.half_plane
    ]
    return draft.step(told, say("modes.torus"))


def commutator(torus: TorusLattice, power: int) -> Mapping[Place, Terms]:
    """What stands before ω̂(m) ω̂(k) in Σ sin(2π m∧k/N) ω̂(m) |k|²ᵖ ω̂(k) T(m + k), by m + k."""
    found: dict[Place, dict[int, dict[Pair, Fraction]]] = {}
    for m in torus.places:
        for k in torus.places:
            turns = torus.representative((m[0] * k[1] - m[1] * k[0], 0))[0]
            there = torus.representative((m[0] + k[0], m[1] + k[1]))
            terms = found.setdefault(there, defaultdict(lambda: defaultdict(Fraction)))
            sign = (turns > 0) - (turns < 0)
            terms[abs(turns)][min(m, k), max(m, k)] += sign * Fraction(_square(k)) ** power
    return found


def _square(n: Place) -> int:
    return n[0] ** 2 + n[1] ** 2


def total(phase: Phase, unit: Unit, terms: Terms) -> Tree:
    """The sum of the terms of a mode, times a number."""
    groups = []
    for k, pairs in sorted(terms.items()):
        products = [mul(x, at(m), at(n)) for (m, n), x in sorted(pairs.items()) if x]
        if k and products:
            groups.append(unit.times(phase.sine(k), add(*products)))
    return add(*groups)


def at(n: Place, name: str = "ω̂") -> Tree:
    """A function of the lattice, ω̂, at a place."""
    return ("call", name, *n)
