"""Families of relative equilibria in letters, and inequalities under which they are stable or not.

The algorithm of :mod:`.energy_casimir` and :mod:`.stability` over the field of functions of the
parameters and of the momentum of the family.  A form is definite where its leading minors, or those
of its opposite, are positive.  With q(λ²) the characteristic polynomial on the leaf, its factors f,
the roots of q are real and at most 0 only if the coefficients and the discriminant of each f are at
least 0; where f = s² + bs + e², this is b ± 2e ≥ 0.

An inequality is one of products of irreducible polynomials that are positive together.  Of a
product the sign alone counts: what is known to be positive is left out, and so is an even power,
whose base does not vanish then.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import chain, combinations
from math import prod
from typing import Any

from ...language.derivatives import power
from ...language.reserved import suffixed
from ...language.tree import Tree, mul
from ...language.univariate import root
from ..integrals.all_integrals import IntegralsFound
from ..integrals.lie_poisson import LiePoisson, PoissonPolynomials, plain
from .energy_casimir import (
    Leaf,
    along_the_orbit,
    domain_matrix,
    element,
    leaf,
    multipliers_tried,
    pencil,
    restricted,
    second_derivatives,
    solutions,
)
from .equilibrium_points import About, Elements, Expansion, Matrix, attained, tried
from .stability import has_compact_stabilisers, linear_on, polynomial

Element = Any
"""A function of the letters, of SymPy's field of fractions."""
Factors = frozenset[Any]
"""Irreducible polynomials in the letters, their leading coefficients positive."""


@dataclass(frozen=True)
class Case:
    """``products``: sign times product is positive; ``nonzero``: factors that do not vanish;
    ``implied``: letters that are positive where a metric is."""

    products: tuple[tuple[int, Factors], ...] = ()
    nonzero: Factors = frozenset()
    implied: Factors = frozenset()

    def with_positive(self, *functions: Element) -> Case | None:
        """The case with these positive, too; ``None`` where they cannot be."""
        found: Case | None = self
        for x in functions:
            found = found._with(x) if found else None
        return found

    def _with(self, x: Element) -> Case | None:
        if not x:
            return None
        sign, odd, every = _signed(x)
        nonzero = replace(self, nonzero=self.nonzero | every)
        sign, odd = self._reduced(sign, frozenset(f for f in odd if not nonzero.shows(f)))
        if not odd:
            return nonzero if sign > 0 else None
        found = replace(nonzero, products=(*self.products, (sign, odd)))
        return None if found.is_empty() else found

    def is_empty(self) -> bool:
        """Is the sum of some of what is to be positive, with the last, shown to be at most 0?"""
        single = [(s, f) for s, x in self.products if len(x) == 1 for f in x]
        sign, factors = self.products[-1]
        if len(factors) > 1:
            return sign < 0 and all(self.shows(f, strictly=False) for f in factors)
        *others, (_, last) = single
        some = (x for k in range(3) for x in combinations(others, k))
        sums = (sum((-s * f for s, f in x), -sign * last) for x in some)
        return any(self.shows(f, strictly=False) for f in sums)

    def _reduced(self, sign: int, odd: Factors) -> tuple[int, Factors]:
        """A product times such as are positive, with as few factors as these make it."""

        def size(x: Factors) -> tuple[int, list[str]]:
            return len(x), sorted(map(str, x))

        while True:
            shorter = [x for x in self.products if size(odd ^ x[1]) < size(odd)]
            if not shorter:
                return sign, odd
            sign, odd = sign * shorter[0][0], odd ^ shorter[0][1]

    def without_repetition(self, known: Case) -> Case:
        """The case without such of its products beyond the known as the others show."""
        found = self
        for x in self.products[len(known.products) :]:
            left = replace(found, products=tuple(y for y in found.products if y != x))
            if len(x[1]) == 1 and all(left.shows(x[0] * f) for f in x[1]):
                found = left
        return found

    def settled(self) -> Case:
        """The same with each product reduced by the others."""
        products = [*self.products]
        for k, x in enumerate(products):
            products[k] = Case((*products[:k], *products[k + 1 :]))._reduced(*x)
        return replace(self, products=(*(x for x in products if x[1]),))

    def shows(self, f: Any, *, strictly: bool = True) -> bool:
        """Is a polynomial positive, or else, not ``strictly``, at least 0?  It is where it is a sum
        of even powers and of positive letters, and where it is of second degree in a letter and
        its discriminant is so seen to be negative."""
        single = ((_letter(y), s) for s, x in self.products if len(x) == 1 for y in x)
        signs = {_letter(y): 1 for y in self.implied} | dict(single)
        there = {_letter(y) for y in self.nonzero | self.implied}

        def fair(term: tuple[tuple[int, ...], Any]) -> bool:
            return (
                prod((signs.get(n, 0) for n, k in enumerate(term[0]) if k % 2), start=term[1]) > 0
            )

        def at_least(f: Any, *, strictly: bool) -> bool:
            if all(map(fair, f.items())):
                return not strictly or any(there.issuperset(_places(e)) for e in f)
            return len(f) <= SHOWN and any(squared(f, n, strictly) for n in range(f.ring.ngens))

        def squared(f: Any, n: int, strictly: bool) -> bool:
            c, b, a = (_coefficient(f, n, k) for k in range(3))
            if f.degree(f.ring.gens[n]) != 2 or not (a and c):
                return False
            if signs.get(n, 0) > 0:
                b = f.ring.from_dict({e: x for e, x in b.items() if not fair((e, x))})
            ends = at_least(a, strictly=False) and at_least(c, strictly=False)
            return ends and at_least(4 * a * c - b**2, strictly=strictly)

        return at_least(f, strictly=strictly)

    def beyond(self, known: Case) -> tuple[tuple[int, Factors], ...]:
        """What is to be positive beyond what is known, squares of what is not to vanish last."""
        new = self.products[len(known.products) :]
        implied = known.nonzero.union(*(x for _, x in self.products))
        squares = (f for f in self.nonzero - implied if not (self.shows(f) or self.shows(-f)))
        return (*new, *((0, frozenset([f])) for f in sorted(squares, key=str)))


def _signed(x: Element) -> tuple[int, Factors, Factors]:
    """The sign of the number in a function, its factors of odd powers, and all."""
    (c, above), (d, below) = x.numer.factor_list(), x.denom.factor_list()
    sign, odd, every = 1 if c * d > 0 else -1, set[Any](), set[Any]()
    for f, k in chain(above, below):
        alike = f if f.LC > 0 else -f
        sign *= 1 if f.LC > 0 or k % 2 == 0 else -1
        every.add(alike)
        odd ^= {alike} if k % 2 else set()
    return sign, frozenset(odd), frozenset(every)


def _coefficient(f: Any, n: int, k: int) -> Any:
    """The coefficient of the power k of the letter at a place."""
    here = ((e, c) for e, c in f.items() if e[n] == k)
    return f.ring.from_dict({(*e[:n], 0, *e[n + 1 :]): c for e, c in here})


def _places(e: Iterable[int]) -> Iterable[int]:
    return (n for n, k in enumerate(e) if k)


def _letter(f: Any) -> int:
    """The place of the letter that a polynomial is; −1 for none."""
    ((e, _), *more) = f.items()
    return e.index(1) if not more and sum(e) == 1 else -1


def square_root(x: Element) -> Element | None:
    """A function whose square a function is; ``None`` for none."""
    found = x.field.one
    for p, side in ((x.numer, 1), (x.denom, -1)):
        number, factors = p.factor_list()
        y = root(Fraction(plain(number))) if number > 0 else None
        if not isinstance(y, Fraction) or any(k % 2 for _, k in factors):
            return None
        found *= x.field(x.field.domain(y.numerator, y.denominator)) ** side
        for f, k in factors:
            found *= x.field(f) ** (side * k // 2)
    return found


def inequality(algebra: PoissonPolynomials, sign: int, factors: Factors) -> tuple[Tree, Tree]:
    """Two sides, the greater first: of one factor what is added and what is taken away, of several
    a product and 0; with a sign 0, that they do not vanish, by squares."""
    if len(factors) > 1 or not sign:
        trees = [algebra.letters_tree(f) for f in sorted(factors, key=str)]
        product = mul(*(trees if sign else (power(x, 2) for x in trees)))
        return (product, 0) if sign >= 0 else (0, product)
    (f,) = factors
    more, less = ({e: abs(c) for e, c in f.items() if (c > 0) is up} for up in (True, False))
    above, below = map(algebra.letters_tree, (more, less)[::sign])
    return above, below


Vector = list[Element]
SHOWN = 20
"""Of polynomials of more terms no discriminant is taken to show that they are positive."""
TERMS = 10
"""Of coefficients of more terms no discriminant is computed: it has hundreds."""


@dataclass(frozen=True)
class Family:
    """Equilibria ``about`` a point in letters, with momenta of these ``names``; ``multipliers``: of
    the form, none where there are none; ``characteristic``: polynomial on the leaf; ``apart``: that
    letters do not vanish, ``known``: that the kinetic energy is positive, too; ``stable``: cases in
    which the form is definite; ``unstable``: cases that prove it, all where they are ``counted``;
    ``beyond``: are they stable off the leaf, too?  ``whole``: is the form definite on all
    displacements wherever it is on those along the leaf?"""

    about: About
    names: tuple[str, ...]
    multipliers: tuple[Element, ...] | None
    characteristic: tuple[Element, ...]
    apart: Case
    known: Case
    stable: tuple[Case, ...]
    unstable: tuple[Case, ...]
    counted: bool
    beyond: bool
    whole: bool


def letters(system: LiePoisson, taken: Mapping[str, Any]) -> tuple[str, ...]:
    """The names of the momenta of families, ell_3 of Π₃; more l where a parameter has one."""
    name, places = "ell", range(1, system.momenta + 1)
    while any(suffixed(name, k) in taken for k in places):
        name += "l"
    return tuple(suffixed(name, k) for k in places)


def with_letters(whole: IntegralsFound, names: Sequence[str]) -> IntegralsFound:
    """What was found, over a field with more letters, which come last."""
    system = replace(whole.system, parameters=(*whole.system.parameters, *names))
    ring, zeros = system.algebra.ring, (0,) * len(names)

    def over(f: Any) -> Any:
        return ring.from_dict({(*e, *zeros): c for e, c in f.items()})

    kept = ((*map(over, x),) for x in (whole.casimirs, whole.integrals))
    casimirs, integrals = kept
    return replace(whole, system=system, casimirs=casimirs, integrals=integrals)


def families(whole: IntegralsFound, names: Sequence[str], on: Elements) -> Iterator[Family]:
    """The families through the points that are tried, on leaves of more than a point; ``names``:
    of their momenta."""
    system = whole.system
    algebra, momenta = system.algebra, system.momenta
    own = [algebra.letters[x] for x in names]
    kept = [*map(algebra.over_the_field, whole.casimirs)]
    numbers = [algebra.letters["π"]] if "π" in algebra.letters else []
    apart = Case((), frozenset(x.numer for x in own)).with_positive(*numbers)
    known = positive(system, apart) if apart else None
    if apart is None or known is None:
        return
    for about in tried(system, kept, on):
        one, rest = about.at[:momenta], about.at[momenta:]
        chosen = tuple(x for x, y in zip(names, one, strict=True) if y)
        at = (*(x * y if y else y for x, y in zip(own, one, strict=True)), *rest)
        there = About(system, at)
        moving = any(there.moving())
        if attained(about, on) and not moving and leaf(there).free:
            yield judged(whole, there, chosen, apart, known)


def positive(system: LiePoisson, apart: Case) -> Case | None:
    """The case with a positive kinetic energy; ``None`` where it cannot be."""
    algebra, m = system.algebra, system.momenta
    start = About(system, (Fraction(0),) * len(system.variables))
    second = [row[:m] for row in start.expansion(algebra.hamiltonian).second[:m]]
    case = apart.with_positive(*minors(second))
    if case is None:
        return None
    known = case.settled()
    diagonal = (known.with_positive(row[k]) for k, row in enumerate(second))
    beyond = (x for y in diagonal if y for x in y.products[len(known.products) :])
    single = (x for s, x in beyond if s > 0 and len(x) == 1)
    return replace(known, implied=frozenset(f for x in single for f in x if _letter(f) >= 0))


def judged(
    whole: IntegralsFound, about: About, names: tuple[str, ...], apart: Case, known: Case
) -> Family:
    """A family with the inequalities that prove its stability or instability."""
    on = leaf(about)
    over = about.algebra.over_the_field
    energy = about.expansion(about.algebra.hamiltonian)
    kept = [about.expansion(over(f)) for f in (*whole.casimirs, *whole.integrals)]
    multipliers, stable = _definite(about, on, energy, kept, known)
    every = second_derivatives(multipliers, energy, kept) if multipliers is not None else []
    characteristic = polynomial(linear_on(about, on))
    factors = factors_of(characteristic[::2])
    signs = (x for f in factors for x in must_not_be_negative(f))
    unstable = {x.beyond(known): x for y in signs if (x := known.with_positive(-y))}
    if () in unstable:
        unstable = {(): unstable[()]}
    regular = whole.proved.proved and len(on.free) == whole.proved.rank
    return Family(
        *(about, names, multipliers, characteristic),
        *(apart, known, stable, (*unstable.values(),)),
        counted=all(map(decided, factors)),
        beyond=regular or has_compact_stabilisers(whole.system),
        whole=all(any(not y.beyond(x) for y in definite(every, x)) for x in stable),
    )


def _definite(
    about: About, on: Leaf, energy: Expansion, kept: Sequence[Expansion], known: Case
) -> tuple[tuple[Element, ...] | None, tuple[Case, ...]]:
    """Multipliers such that the form is definite on the leaf where it can be, and the cases in
    which it is."""
    choices = solutions([e.slope for e in kept], [-x for x in energy.slope])
    if choices is None:
        return None, definite(along_the_orbit(about, on), known)
    start, freedom = choices
    domain = about.algebra.field
    start = [element(x, domain) for x in start]
    middle = partial(between, domain=domain)
    plain, *others = multipliers_tried(start, freedom, energy, kept, on, middle)
    several: list[Vector] = [*others, plain]  # in the middle it is definite wherever it is with any
    for multipliers in several:
        cases = definite(restricted(second_derivatives(multipliers, energy, kept), on), known)
        poles = [x.field(x.denom) ** 2 for x in multipliers]
        cases = tuple(y for x in cases if (y := x.with_positive(*poles)))
        if cases:
            return (*multipliers,), tuple(x.without_repetition(known) for x in cases)
    return (*several[0],), ()


def between(a: Matrix, b: Matrix, domain: Any) -> Iterator[Element]:
    """Functions μ, each in the middle of two real roots of det(a + μb), where these are real."""
    determinant = pencil(a, b, domain)
    factors = [f for f, _ in determinant.factor_list()[1]] if determinant else []
    of = [[f.get((k,), domain.zero) for k in range(f.degree() + 1)] for f in factors]
    yield from (-c[1] / (2 * c[2]) for c in of if len(c) == 3)
    linear = [-c[0] / c[1] for c in of if len(c) == 2]
    yield from ((x + y) / 2 for x, y in combinations(linear, 2))
    yield from (x + s for x in linear for s in (1, -1))


def minors(q: Matrix) -> list[Element]:
    """The leading minors of a matrix."""
    return [domain_matrix([row[:k] for row in q[:k]], k).det() for k in range(1, len(q) + 1)]


def definite(q: Matrix, known: Case) -> tuple[Case, ...]:
    """The cases in which a symmetric matrix is positive or negative definite."""
    found = minors(q)
    signed = ([x * s**k for k, x in enumerate(found, 1)] for s in (1, -1))
    return tuple(y for x in signed if (y := known.with_positive(*x))) if found else ()


def factors_of(q: Sequence[Element]) -> list[Vector]:
    """The factors of a polynomial, its coefficients from the highest power, each with a leading
    coefficient 1."""
    from sympy import Symbol

    if len(q) < 2:
        return []
    ring = q[-1].field.to_domain()[Symbol("s")].ring
    n = len(q) - 1
    whole = ring.from_dict({(n - k,): x for k, x in enumerate(q) if x})
    factors = ((f, f.degree()) for f, _ in whole.factor_list()[1])
    return [[f.get((d - k,), ring.domain.zero) / f.LC for k in range(d + 1)] for f, d in factors]


def must_not_be_negative(f: Vector) -> Vector:
    """Functions that are at least 0 where all roots of such a factor are real and at most 0, and,
    where its degree is at most 2, only there."""
    if len(f) == 3:
        _, b, c = f
        e = square_root(c)
        if e is None:
            return [b, c, *([b**2 - 4 * c] if decided(f) else [])]
        return [b - 2 * e, b + 2 * e]
    return f[1:]


def decided(f: Vector) -> bool:
    """Do the signs of these functions say where its roots are, no discriminant being left out?"""
    short = all(len(x.numer) <= TERMS for x in f[1:])
    return len(f) < 3 or (len(f) == 3 and (short or square_root(f[2]) is not None))
