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

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import reduce
from itertools import combinations_with_replacement
from operator import add, mul
from typing import Any
from zlib import crc32

import numpy as np

from ...algebra.exact_kernel import echelon, kernel
from ...algebra.residue_arrays import PRIMES, Array, Residues, ResidueSource
from ...language import rational as q
from ...language.tree import nodes
from ..ellipsoid import BUNDLES
from ..program import EmittedFunction, Expression, KeptByGauss
from ..state import StateSpace

LARGEST, MORE = 26, 20
"""The largest state of which this is found; the random states beyond the unknown numbers."""

P = PRIMES[0]


def kept_by_gauss(
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
    some = _columns(_on_the_group(space, _Points(functions, sizes, n)))
    spanned = _Points(functions, sizes, n + len(pairs) + MORE)
    weights = [spanned.draw() for _ in range(n - 1)]
    weights.append(1 - reduce(add, weights))
    x = [Residues(sum_of(_columns(weights), row), P) for row in some.T]
    f = [*spanned.values("rhs", x), spanned.source.constant(1)]
    x.append(spanned.t)
    rates = [x[i] * f[j] + f[i] * x[j] for i, j in pairs]
    quadratics, _ = kernel(_columns([*f, *rates]), P)

    here = _Points(functions, sizes, len(quadratics) + MORE)
    place = _on_the_group(space, here)
    on = [*place, here.t]
    of_state = _columns([*on, *(on[i] * on[j] for i, j in pairs)])
    values = [Residues(sum_of(of_state, row), P) for row in quadratics]
    one = here.source.constant(1)
    constant, _ = kernel(_columns([*values, one]), P)
    relations = product(constant[:, :-1], quadratics)
    group = _rank(_slopes(relations, on, pairs)) == n - 1 - _dimension(space)
    names, numbers = conserved or ("energy",), "conserved" if conserved else "energy"
    found = here.values(numbers, place)
    exact = [
        name
        for name, number in zip(names, found, strict=True)
        if group and len(kernel(_columns([*values, one, number]), P)[0]) > len(constant)
    ]
    others = [name for name in conserved if name not in exact]
    return KeptByGauss(tuple(exact), tuple(others), group)


class _Points:
    """The functions of a program at random points, of one body without inputs."""

    def __init__(
        self, functions: Mapping[str, EmittedFunction], sizes: Mapping[str, int], points: int
    ):
        self.source, self.functions = ResidueSource(P, points, 1), functions
        zero = self.source.constant(0)
        self.t = self.draw()
        body = np.random.default_rng(2)  # the same for all points
        p = [self.source.constant(int(v)) for v in body.integers(1, P, sizes["p"])]
        self.arrays = {"p": p, "u": [zero] * sizes["u"], "t": [self.t]}
        self.arrays["k"] = self._evaluated(functions["constants"])

    def draw(self) -> Residues:
        """A random number at each point."""
        return self.source.randint(0, 1)

    def values(self, name: str, x: Sequence[Residues]) -> list[Residues]:
        """What a function gives at some states."""
        self.arrays["x"] = [*x]
        return self._evaluated(self.functions[name])

    def _evaluated(self, f: EmittedFunction) -> list[Residues]:
        known: dict[str, Any] = {x.name: self.arrays[x.array][x.index] for x in f.loads}
        for section in f.sections:
            for v in section.values:
                known[v.name] = self._value(v.expression, known)
        return [self._value(e, known) + self.source.constant(0) for e in f.outputs]

    def _value(self, e: Expression, known: Mapping[str, Any]) -> Any:
        if isinstance(e, str):
            return known[e]
        if not isinstance(e, tuple):
            return Fraction(e)
        if e[0] in ("fun", "abs"):
            return self._any_function(str(e[-2]), self._value(e[-1], known))
        parts = [self._value(x, known) for x in e[1:]]
        if e[0] == "none":
            zero = (parts[0] + self.source.constant(0)).values == 0
            return Residues(zero.astype(np.int64), P)
        if e[0] == "div":
            return parts[0] / parts[1]
        return reduce({"add": add, "mul": mul}[e[0]], parts)

    def _any_function(self, name: str, x: Any) -> Residues:
        """A function of no property but that it is one; of the name alone."""
        shifted: Residues = x + self.source.constant(crc32(name.encode()))
        return shifted ** (P // 3 + len(name))


def _on_the_group(space: StateSpace, at: _Points) -> list[Residues]:
    """Random states on the group, in the form of a state."""
    if not space.slots:
        return [at.draw() for _ in space.names]
    zero = at.source.constant(0)
    turned: list[Residues] = []
    if space.quaternion:
        v = [at.draw() for _ in range(3)]
        square = reduce(add, (x * x for x in v))
        turned = [(1 - square) / (1 + square), *(2 * x / (1 + square) for x in v)]
        T = [at.draw() for x in space.slots if x.letter == "T"]
        place = [*turned, *T]
    else:
        g = space.group.sample_inside(at.source)
        place = [x + zero for x in space.entries(g)]
    if not space.tangent:
        return [*place, *(at.draw() for _ in range(len(space.names) - len(place)))]
    Z = q.combine([at.draw() for _ in space.group.basis], space.group.basis)
    return [x + zero for x in (*place, *space.entries(q.times(g, Z)))]


def _dimension(space: StateSpace) -> int:
    """That of the states on the group."""
    if not space.slots:
        return len(space.names)
    return 2 * space.group.dimension - len([*space.held])


def _columns(found: Sequence[Residues]) -> Array:
    return np.stack([x.values for x in found], axis=1)


def sum_of(columns: Array, weights: Array) -> Array:
    """Σ_j w_j a_j modulo P."""
    total = np.zeros(len(columns), np.int64)
    for j in np.flatnonzero(weights):
        total = (total + columns[:, j] * weights[j]) % P
    return total


def product(a: Array, b: Array) -> Array:
    """a b modulo P."""
    return np.array([sum_of(b.T, row) for row in a], np.int64).reshape(len(a), b.shape[1])


def _slopes(relations: Array, on: Sequence[Residues], pairs: Sequence[tuple[int, int]]) -> Array:
    """The derivatives by the state of some quadratics, by rows, at the first point."""
    n = len(on)
    x = np.array([value.values[0] for value in on], np.int64)
    slopes = relations[:, :n] % P
    for (i, j), weight in zip(pairs, relations[:, n:].T, strict=True):
        slopes[:, i] = (slopes[:, i] + weight * x[j]) % P
        slopes[:, j] = (slopes[:, j] + weight * x[i]) % P
    return slopes


def _rank(rows: Array) -> int:
    return len(echelon(rows, P)[1])
