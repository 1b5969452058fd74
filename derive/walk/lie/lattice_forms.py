"""Elements Σ a(n) T(n) and quadratic forms Σ a(n) b(−n) on the lattice of the torus.

A coefficient is u |n|²ᵖ times a function of n.  The trace form pairs two elements,

    Tr (Σ a T)(Σ b T) = N Σ a(n) b(−n),

as T(n) T(−n) = T(0) = 1 has the trace N, and no other T(n) has any.  A form is the finite map of
its terms: δ, gradients and substitutions are those of polynomials.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.words import Expr, Letter
from ...language.tree import Tree, mul
from .lattice import BOUND, FREE, ONE, Index, N, Unit, minus, of, summed


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
        return {0: value, 1: mul(square, value), -1: ("div", value, square)}[self.power]

    def element(self) -> Tree:
        """Σ of it T(n)."""
        return self.unit.times(summed(self.at))


Term = tuple[str, str, int]
"""|n|²ᵖ a(n) b(−n) by a, b and p, a ≤ b: n and −n may change places."""


@dataclass(frozen=True)
class Form:
    """The sum over n of some terms, each with its unit."""

    terms: Mapping[Term, Unit]

    def __add__(self, other: Form) -> Form:
        total = dict(self.terms)
        for t, u in other.terms.items():
            total[t] = total[t] + u if t in total else u
        return Form({t: u for t, u in total.items() if u.q})

    def __sub__(self, other: Form) -> Form:
        return self + other.times(-1)

    def times(self, unit: Unit | Fraction | int) -> Form:
        """The same times a number."""
        return Form({t: u * unit for t, u in self.terms.items()})

    def put(self, name: str, image: Coefficient) -> Form:
        """The form with another coefficient for a function."""
        total = Form({})
        for (a, b, p), u in self.terms.items():
            first, second = (image if x == name else Coefficient(x) for x in (a, b))
            total += paired(first.times(u, p), second)
        return total

    def varied(self, name: str, variation: str) -> Form:
        """δ of the form by the product rule, δa being the variation of one function a."""
        total = Form({})
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

    def over(self, other: Form) -> Unit:
        """The number that it is of another form; ``ValueError`` where it is no multiple."""
        (term, u), (there, v) = self.only, other.only
        if term != there:
            raise ValueError("no multiple of that form")
        return u * v.inverse

    def tree(self) -> Tree:
        """The sum of the one term of a form."""
        (a, b, p), u = self.only
        return u.times(summed(Coefficient(a, ONE, p).at, of(b, minus(N))))


def paired(x: Coefficient, y: Coefficient) -> Form:
    """Σ of the one at n times the other at −n."""
    a, b = sorted((x.name, y.name))
    return Form({(a, b, x.power + y.power): x.unit * y.unit})


def traced(e: Expr, elements: Mapping[Letter, Coefficient], order: int) -> Form:
    """A sum of traces of products of two letters, which stand for elements of su(N)."""
    total = Form({})
    for (traces, rest), c in e.terms.items():
        (((x, bar), (y, other)),) = traces
        if rest or bar != other:
            raise ValueError("no trace of a product of two elements")
        total += paired(elements[x], elements[y]).times(c * order)
    return total
