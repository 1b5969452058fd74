"""What Gauss's collocation keeps to rounding of a problem, in the numbers of its state.

The method keeps each function Q of degree 2, of the state x and the time, its last number, that is
constant along dx/dt = f(x): its stages are off the group, though in the affine space that it
spans, so that ∇Q · f = 0 must hold there, too. These Q are the kernel of linear conditions, one for
each of many random states of that space, modulo a prime; elementary functions are any functions. A
number that the motion keeps is kept to rounding where it is the value of such a Q on the group, and
the group is, where it is the zeros of some. Where it is not, each step is taken back to it by as
much as its error is, and nothing else is kept better.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import combinations_with_replacement
from operator import add
from typing import Any
from zlib import crc32

from ...algebra.exact_kernel import PRIMES, ResidueVector, ResidueVectorSource, Rows, kernel, pivots
from ...algebra.factor_charts import FactorChart
from ...language import rational as q
from ...language.tree import nodes
from ..ellipsoid import BUNDLES
from ..program import EmittedFunction, KeptByGauss
from ..slots import drawn
from ..state import StateSpace

LARGEST, MORE = 26, 20
"""The largest state of which this is found; the random states beyond the unknown numbers."""

P = PRIMES[0]


def invariants_of_gauss(
    functions: Mapping[str, EmittedFunction],
    space: StateSpace,
    sizes: Mapping[str, int],
    conserved: Sequence[str],
) -> KeptByGauss | None:
    """That of a program, by its functions and the sizes of its arrays; ``None`` where it is not
    found.  ``conserved``: the names of what its function of that name gives, else its energy
    alone is looked at."""
    n = len(space.names) + 1
    parts = [x for f in functions.values() for e in f.expressions for x in nodes(e)]
    integrals = any(isinstance(x, tuple) and x[0] == "fun" and x[1] in BUNDLES for x in parts)
    framed = any(x.array == "frame" for x in functions["constants"].loads)
    if n > LARGEST + 1 or integrals or framed or not space.group.has_inner_samples:
        return None
    pairs = [*combinations_with_replacement(range(n), 2)]
    some = _on_the_group(space, _Points(functions, sizes, n))
    spanned = _Points(functions, sizes, n + len(pairs) + MORE)
    weights = [spanned.draw() for _ in range(n - 1)]
    weights.append(1 - reduce(add, weights))
    x = [ResidueVector.dot(weights, coordinate.values) for coordinate in some]
    f = [*spanned.values("rhs", x), spanned.source.constant(1)]
    x.append(spanned.t)
    rates = [x[i] * f[j] + f[i] * x[j] for i, j in pairs]
    quadratics, _ = kernel(_rows([*f, *rates]), n + len(pairs), P)

    names, numbers = conserved or ("energy",), "conserved" if conserved else "energy"
    here = _Points(functions, sizes, len(quadratics) + len(names) + MORE)
    place = _on_the_group(space, here)
    on = [*place, here.t]
    of_state = [*on, *(on[i] * on[j] for i, j in pairs)]
    values = [ResidueVector.dot(row, of_state) for row in quadratics]
    columns = [*values, here.source.constant(1), *here.values(numbers, place)]
    vectors, free = kernel(_rows(columns), len(columns), P)
    first = len(values) + 1
    listed = [ResidueVector(row, P) for row in quadratics]
    relations = [
        ResidueVector.dot(x[: first - 1], listed).values
        for x, c in zip(vectors, free, strict=True)
        if c < first
    ]
    group = _rank(_slopes(relations, on, pairs)) == n - 1 - _dimension(space)
    told = {c for x, c in zip(vectors, free, strict=True) if not any(x[first:c])}
    exact = [x for c, x in enumerate(names, first) if group and c in told]
    others = [name for name in conserved if name not in exact]
    return KeptByGauss(tuple(exact), tuple(others), group)


class _Points:
    """The functions of a program at random points, of one body without inputs."""

    def __init__(
        self, functions: Mapping[str, EmittedFunction], sizes: Mapping[str, int], points: int
    ):
        self.source, self.functions = ResidueVectorSource(P, points, 1), functions
        zero = self.source.constant(0)
        self.t = self.draw()
        body = ResidueVectorSource(P, sizes["p"], 2).randint(0, 1)  # the same for all points
        p = [self.source.constant(v) for v in body.values]
        self.arrays = {"p": p, "u": [zero] * sizes["u"], "t": [self.t]}
        self.arrays["k"] = self._evaluated(functions["constants"])

    def draw(self) -> ResidueVector:
        """A random number at each point."""
        return self.source.randint(0, 1)

    def values(self, name: str, x: Sequence[ResidueVector]) -> list[ResidueVector]:
        """What a function gives at some states."""
        self.arrays["x"] = [*x]
        return self._evaluated(self.functions[name])

    def _evaluated(self, f: EmittedFunction) -> list[ResidueVector]:
        zero = self.source.constant(0)
        return [x + zero for x in f.values(self.arrays, self._any_function)]

    def _any_function(self, name: str, x: Any) -> ResidueVector:
        """A function of no property but that it is one; of the name alone."""
        if name == "none":
            return ResidueVector([int(v == 0) for v in (x + self.source.constant(0)).values], P)
        if name in ("cos", "sin"):  # on the circle, by the tangent of the half
            y = self._any_function("half", x)
            found: ResidueVector = (1 - y * y if name == "cos" else 2 * y) / (1 + y * y)
            return found
        shifted: ResidueVector = x + self.source.constant(crc32(name.encode()))
        return shifted ** (P // 3 + len(name))


def _on_the_group(space: StateSpace, at: _Points) -> list[ResidueVector]:
    """Random states on the group, in the form of a state."""
    if not space.has_element:
        return [at.draw() for _ in space.names]
    zero = at.source.constant(0)
    g = space.group.sample_inside(at.source)
    place: list[ResidueVector] = []
    for x in space.held_of_g:
        if isinstance(x, FactorChart):
            place += drawn(x, at.draw)
        else:
            place += [y + zero for y in space.entries(g, [x])]
    if not space.tangent:
        return [*place, *(at.draw() for _ in range(len(space.names) - len(place)))]
    Z = q.combine([at.draw() for _ in space.group.basis], space.group.basis)
    return [x + zero for x in (*place, *space.entries(q.times(g, Z)))]


def _dimension(space: StateSpace) -> int:
    """That of the states on the group."""
    if not space.has_element:
        return len(space.names)
    return 2 * space.group.dimension - len([*space.held])


def _rows(columns: Sequence[ResidueVector]) -> Iterator[tuple[int, ...]]:
    """A matrix by its columns."""
    return zip(*(x.values for x in columns), strict=True)


def _slopes(relations: Rows, on: Sequence[ResidueVector], pairs: Sequence[tuple[int, int]]) -> Rows:
    """The derivatives by the state of some quadratics, by rows, at the first point."""
    n, x = len(on), [value.values[0] for value in on]
    slopes = []
    for relation in relations:
        row = relation[:n]
        for (i, j), weight in zip(pairs, relation[n:], strict=True):
            row[i] += weight * x[j]
            row[j] += weight * x[i]
        slopes.append([y % P for y in row])
    return slopes


def _rank(rows: Rows) -> int:
    return len(pivots(rows, len(rows[0]), P)) if rows else 0
