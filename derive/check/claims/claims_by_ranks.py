"""Claims that hold by ranks: that there are no more polynomials up to a degree, proved modulo a
prime;

the conditions under which sentences say that a tensor or matrix has an inverse, and what they
suppose of masses and of the Lie algebra, tried at places that just satisfy them or just do not.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from itertools import islice
from math import lcm
from typing import Any

from ...algebra.exact_kernel import PRIMES, ResidueVector, ResidueVectorSource, pivots
from ...language import rational as q
from ...language.laurent import is_layered
from ...language.rational import Matrix
from ...language.tree import Tree, add, nodes, operands, terms
from ...record.as_json import decode
from ...record.mass_signs import any_sign
from ...record.record import Step
from ...record.sentence import CONDITIONS, MONOMIALS, SIGNED, Claim
from .reduced_system import ClaimedRecord, Judge, ReducedSystem
from .spectra_and_residues import Value, about, drawn, expansion, second_derivatives, value

Exponents = tuple[int, ...]


class TooManyMonomialsError(ValueError):
    """More monomials than are tried."""


Images = Sequence[Mapping[int, frozenset[Exponents]]]
"""For each derivation, the monomials of its value on each variable, by the variable's number."""
ATTEMPTS = 3
SPARE = 8
"""So many more points than unknowns."""


def degree(t: Tree, weights: Mapping[Tree, Fraction]) -> Fraction:
    """The degree of a polynomial as it is written, where nothing cancels."""
    if t in weights:
        return weights[t]
    found = [degree(x, weights) for x in operands(t)]
    if not isinstance(t, tuple) or not found:
        return Fraction(0)
    if t[0] == "pow":
        return sum(found * t[2], Fraction(0))
    return max(found) if t[0] == "add" else sum(found, Fraction(0))


def monomials(weights: Sequence[Fraction], most: Fraction) -> list[Exponents]:
    """The exponents of monomials, or of products, of a degree above 0, up to one;
    ``TooManyMonomialsError`` for too many."""
    unit = lcm(*(w.denominator for w in weights))
    found: list[tuple[Exponents, int]] = [((), int(most * unit))]
    for w in map(int, (w * unit for w in weights)):
        longer = (((*e, k), left - k * w) for e, left in found for k in range(left // w + 1))
        found = [*islice(longer, MONOMIALS + 1)]
        if len(found) > MONOMIALS:
            raise TooManyMonomialsError(f"more than {MONOMIALS} monomials")
    return [e for e, _ in found if any(e)]


def support(t: Tree, place: Mapping[Tree, int]) -> frozenset[Exponents]:
    """The exponents of the monomials of which a polynomial is made; ``TooManyMonomialsError`` for
    too many."""
    if t in place:
        return frozenset([tuple(int(k == place[t]) for k in place.values())])
    parts = [support(x, place) for x in operands(t)]
    if not isinstance(t, tuple) or not parts:
        return frozenset([(0,) * len(place)])
    if t[0] == "add":
        return frozenset().union(*parts)
    return reduce(_product, parts * t[2] if t[0] == "pow" else parts)


def _product(a: frozenset[Exponents], b: frozenset[Exponents]) -> frozenset[Exponents]:
    if len(a) * len(b) > MONOMIALS:
        raise TooManyMonomialsError(f"more than {MONOMIALS} monomials")
    return frozenset(tuple(map(operator.add, x, y)) for x in a for y in b)


def blocks(unknowns: Sequence[Exponents], images: Images) -> Iterator[list[Exponents]]:
    """The monomials apart, those together of which some images have a monomial in common: what the
    derivations take to 0 is a sum over these."""
    root = [*range(len(unknowns))]
    owner: dict[tuple[int, Exponents], int] = {}

    def top(k: int) -> int:
        while root[k] != k:
            root[k] = k = root[root[k]]
        return k

    for k, e in enumerate(unknowns):
        for d, image in enumerate(images):
            for i in (i for i in image if e[i]):
                rest = (*e[:i], e[i] - 1, *e[i + 1 :])
                for m in image[i]:
                    target = tuple(map(operator.add, rest, m))
                    root[top(k)] = top(owner.setdefault((d, target), k))
    found: dict[int, list[Exponents]] = {}
    for k, e in enumerate(unknowns):
        found.setdefault(top(k), []).append(e)
    return iter(found.values())


class Completeness:
    """The polynomials of at most a ``degree``, variables counting as of ``weights``, and products
    of ``generators``, of a system with these ``values`` of some parameters."""

    def __init__(
        self,
        system: ReducedSystem,
        weights: Sequence[Fraction],
        most: Fraction,
        generators: Sequence[Tree],
        values: Sequence[tuple[Tree, Tree]] = (),
    ):
        self.system, self.generators, self.values = system, generators, values
        self.weights, self.most = weights, most
        own = dict(zip(system.variables, weights, strict=True))
        self.products = monomials([degree(f, own) for f in generators], most)

    def fault(self, images: Images, rates: Rates) -> str:
        """What derivations, with these ``images`` of the variables and these ``rates`` at points,
        take to 0 beside the products, in words; "" where that is nothing."""
        apart = [*blocks(monomials(self.weights, self.most), images)]
        for p in PRIMES[:ATTEMPTS]:
            several = self.kernel(apart, rates, p)
            known = self.rank(several + SPARE, p)
            if known == several:
                return ""
        return f"a space of dimension {several}, in which the products have the rank {known}"

    def point(self, several: int, p: int) -> dict[Tree, Value]:
        """So many random points of the variables, at one of the parameters, modulo p."""
        random = self.system.random
        at: dict[Tree, Value] = {**drawn(self.system.parameters, random, p)}
        for letter, t in self.values:
            at[letter] = value(t, at, p)
        source = ResidueVectorSource(p, several, random.getrandbits(64))
        return at | {x: source.randint(1, p) for x in self.system.variables}

    def kernel(self, apart: Sequence[Sequence[Exponents]], rates: Rates, p: int) -> int:
        """The dimension of what derivations take to 0 at random points, 1 among it."""
        at = self.point(max(map(len, apart), default=0) + SPARE, p)
        moved = rates(at, p)
        x = [at[y] for y in self.system.variables]
        slopes = [moved[i] / y if i in moved else None for i, y in enumerate(x)]
        return 1 + sum(len(block) - _rank(block, x, slopes, p) for block in apart)

    def rank(self, several: int, p: int) -> int:
        """The rank of 1 and the products at so many random points."""
        return len(pivots(self.rows(self.point(several, p), p), several, p))

    def rows(self, at: Mapping[Tree, Value], p: int) -> list[list[int]]:
        """The values of 1 and the products at points."""
        f = [value(t, at, p) for t in self.generators]
        powers = _powers(f, self.products)
        one = [1] * len(at[self.system.variables[0]].values)
        return [one, *(_monomial(powers, e).values for e in self.products)]

    def contains(self, f: Tree) -> bool:
        """Is a polynomial of the degree a combination of 1 and the products?"""
        p, several = PRIMES[0], len(self.products) + SPARE
        at = self.point(several, p)
        rows = self.rows(at, p)
        both = ([*rows, value(f, at, p).values], rows)
        more, known = (len(pivots(x, several, p)) for x in both)
        return more == known


Rates = Callable[[Mapping[Tree, Value], int], Mapping[int, ResidueVector]]
"""The values that a derivation has on the variables at points, by their numbers."""


def _rank(
    block: Sequence[Exponents],
    x: Sequence[ResidueVector],
    slopes: Sequence[ResidueVector | None],
    p: int,
) -> int:
    """The rank of the values D(x^e) = x^e Σ e_i ẋ_i/x_i at points for the monomials of a block."""
    few = range(len(block) + SPARE)
    powers = _powers([y.at(few) for y in x], block)
    own = [None if y is None else y.at(few) for y in slopes]
    nothing, rows = ResidueVector([0] * len(few), p), []
    for e in block:
        rate = sum((y * k for k, y in zip(e, own, strict=True) if k and y), nothing)
        rows.append((_monomial(powers, e) * rate).values)
    return len(pivots(rows, len(few), p))


def _powers(
    x: Sequence[ResidueVector], exponents: Sequence[Exponents]
) -> list[list[ResidueVector]]:
    """The powers of numbers, from the first on, that monomials need."""
    found = []
    for k, y in enumerate(x):
        own, most = [y], max((e[k] for e in exponents), default=0)
        while len(own) < most:
            own.append(own[-1] * y)
        found.append(own)
    return found


def _monomial(powers: Sequence[Sequence[ResidueVector]], e: Exponents) -> ResidueVector:
    return reduce(operator.mul, (own[k - 1] for own, k in zip(powers, e, strict=True) if k))


# -- the two derivations ------------------------------------------------------------------------


def along_the_motion(system: ReducedSystem) -> tuple[Images, Rates]:
    """d/dt."""
    place = {x: k for k, x in enumerate(system.variables)}
    images = {k: support(t, place) for k, t in enumerate(system.rates) if t != 0}

    def rates(at: Mapping[Tree, Value], p: int) -> Mapping[int, ResidueVector]:
        nothing = ResidueVector([0] * len(at[system.variables[0]].values), p)
        return {k: nothing + value(t, at, p) for k, t in enumerate(system.rates) if t != 0}

    return [images], rates


def along_every_field(system: ReducedSystem) -> tuple[Images, Rates]:
    """The brackets with all variables; at a point that with a random combination of them."""
    size = len(system.variables)
    unit = {k: tuple(int(i == k) for i in range(size)) for k in range(size)}
    one = (0,) * size
    images: list[dict[int, frozenset[Exponents]]] = [{} for _ in range(size)]
    for (i, j), form in system.tensor.forms.items():
        images[j][i] = frozenset(one if k is None else unit[k] for k in form)

    def rates(at: Mapping[Tree, Value], p: int) -> Mapping[int, ResidueVector]:
        x = [at[y] for y in system.variables]
        source = ResidueVectorSource(p, len(x[0].values), system.random.getrandbits(64))
        w = [source.randint(1, p) for _ in x]
        found: dict[int, ResidueVector] = {}
        for (i, j), c in system.tensor.at(x).items():
            found[i] = found[i] + w[j] * c if i in found else w[j] * c
        return found

    return images, rates


DIVISORS = {
    "body.symbolic": "",
    "pullback.metric": "",
    "kernel.line": "",
    "unique.span": "J",
    "unique.affine_span": "J_c",
    "elimination.mass": "m",
    "elimination.linear_parts": "m",
    "euler.solved": "I",
    "motion.rotation": "I",
    "motion.displacement": "I_c",
    "motion.maps": "J",
    "motion.maps_of_a_volume": "J",
    "motion.affine_maps": "J_c",
    "motion.affine_maps_of_a_volume": "J_c",
    "motion.mass_matrix": "M",
    "motion.lagrangian": "M",
}
"""What is said, of positive masses or of any → what the equations of the step divide by."""
ALSO = {"C", "m"}
"""What they may divide by besides: C = ĀA has an inverse, and so has a mass that is not 0."""
ANY_SIZE = 3
"""The dimension of the space where the group is any."""
NEEDED = {"J": 0, "J_c": 0, "I": 2, "I_c": 2}
"""What each of these needs: so many independent places, seen from the origin or the centre of mass;
0 stands for as many as the space has dimensions."""


def _divisor(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """Masses have the signs of the problem, and the equations divide by what is said to have an
    inverse alone: it has one at places that satisfy the condition, at others not."""
    kind = claim.kind.removesuffix(SIGNED)
    if any_sign(c.record.problem) is (kind == claim.kind):
        return "masses of this problem may be negative, or none is"
    divisor = DIVISORS[kind]
    if dict(claim.values).get("metric", divisor) != divisor:
        return f"the condition is that of {divisor}"
    sides = (t for e in step.equations for side in (e.lhs, e.rhs) for t in nodes(side))
    found = {str(t[1]) for t in sides if isinstance(t, tuple) and t[0] == "inv"}
    if divisor and found - ALSO - {divisor}:
        return f"the equations do not divide by {divisor} alone"
    if kind == "elimination.linear_parts" and not _translates(c):
        return "the group has not every translation"
    return _tried(c, divisor) if divisor in NEEDED else ""


def _translates(c: ClaimedRecord) -> bool:
    """Has the Lie algebra all elements without a linear part?"""
    whole, linear = (
        q.rank(q.matrix([q.flatten(e) for e in basis]))
        for basis in (c.group.basis, c.group.linear_basis)
    )
    return whole - linear == c.group.n


def _tried(c: ClaimedRecord, divisor: str) -> str:
    """Is a tensor of places invertible where so many of these are independent, and of one less is
    it not?"""
    told = c.record.problem.get("n")
    n = told if isinstance(told, int) else ANY_SIZE
    rank = NEEDED[divisor] or n
    for size in (rank, rank - 1):
        basis = q.matrix([_drawn(c, n) for _ in range(size)])
        weights = q.matrix([_drawn(c, size) for _ in range(n + 2)])
        shift = _drawn(c, n) if divisor.endswith("_c") else [0] * n
        moved = ([*map(sum, zip(r, shift, strict=True))] for r in q.times(weights, basis))
        if (q.determinant(_tensor(divisor, q.matrix([*moved]))) != 0) is (size < rank):
            return f"{divisor} has an inverse under another condition"
    return ""


def _drawn(c: ClaimedRecord, count: int) -> list[int]:
    # of small numbers, some have a rank that is too small
    return [c.random.randint(1, 2**64) for _ in range(count)]


def _tensor(name: str, places: Matrix) -> Matrix:
    """J, or the tensor of inertia I, of unit masses at places; about their centre with an index."""
    if name.endswith("_c"):
        centre = [sum(x, Fraction(0)) / len(places) for x in zip(*places, strict=True)]
        places = tuple(tuple(x - y for x, y in zip(r, centre, strict=True)) for r in places)
    J = q.times(q.transposed(places), places)
    if name[0] == "J":
        return J
    return q.minus(q.scaled(q.trace(J), q.identity(len(J))), J)


# What is said of the Lie algebra.


def _more(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The dimension, which is less than that of all matrices with the relations."""
    group, n = c.group, c.group.n
    whole = n * (n - 1) // 2 if "orthogonal" in group.relations else n * n - 1
    if group.dimension >= whole + n * group.affine:
        return "there are no more relations"
    return _equal(claim["dimension"], group.dimension)


def _equal(told: Tree, own: int) -> str:
    return "" if told == own else f"the dimension is {own}"


def _null(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The kernel has one dimension, and two for each direction along which the second derivative
    of L̃ by the velocity vanishes."""
    d = c.group.dimension
    velocity: list[Tree] = [("entry", "ζ", a) for a in range(1, d + 1)]
    L = decode(c.record.problem["lagrangian"]["L"], "problem")
    moving = add(*(x for x in terms(L) if not {*velocity}.isdisjoint(nodes(x))))
    at: dict[Tree, Any] = {x: Fraction(*_drawn(c, 2)) for x in nodes(moving) if _letter(x)}
    at |= about(velocity, [*map(Fraction, _drawn(c, d))])
    return _equal(claim["size"], 1 + 2 * (d - q.rank(second_derivatives(expansion(moving, at), d))))


def _letter(t: Tree) -> bool:
    return isinstance(t, str) or (isinstance(t, tuple) and t[0] in ("entry", "par"))


def _so3(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The linear parts of the Lie algebra are all skew matrices with three rows, of dimension 3."""
    found = c.group.linear_basis
    skew = all(q.transposed(e) == q.scaled(-1, e) for e in found)
    rank = q.rank(q.matrix([q.flatten(e) for e in found]))
    return "" if (c.group.n, rank) == (3, 3) and skew else "the linear parts are not those of so(3)"


def _ellipsoid(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The body is one ellipsoid about the origin, of a density that depends on the level, or not,
    and its volume is kept."""
    solids = c.record.problem["body"].get("solids") or ()
    centred = [x for x in solids if x["kind"] in ROUND and not x["shift"]]
    if len(solids) != 1 or centred != [*solids]:
        return "the body is no ellipsoid about the origin"
    layered = is_layered(decode(centred[0]["density"], "problem"))
    if claim.kind != "total.sign" and layered is (claim.kind == "quadric.stokes"):
        return "the density depends on the level, or does not"
    return "" if "unimodular" in c.group.relations else "the volume is not kept"


ROUND = ("ball", "ellipsoid")
OF_ROTATIONS = (
    *("isomorphism.onto", "hat.rotations", "hat.displacements"),
    *("unaligned.turned", "unaligned.displaced"),
)
JUDGES: dict[str, Judge] = {
    **{kind: _divisor for kind in CONDITIONS if kind.removesuffix(SIGNED) in DIVISORS},
    "relation.more": _more,
    "null.symmetries": _null,
    **dict.fromkeys(OF_ROTATIONS, _so3),
    **dict.fromkeys(("quadric.stokes", "quadric.layers", "total.sign"), _ellipsoid),
}
