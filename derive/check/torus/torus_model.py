"""A random exact point of the fluid on the torus, and its motion; no bracket of the basis is used.

T(n) are products of the clock and of the shift; ω̂ is the polar form of L̃; the motion is that under
which the momentum seen through g, g⁻¹Wg, is constant (Noether's theorem for g ↦ gh).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from random import Random
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import Source
from ...algebra.torus import Place, Torus
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..arithmetic import EvaluationError, is_matrix
from ..evaluate import Environment, evaluate
from ..grades import DegreeSource
from .roots_of_unity import RootsOfUnity, Turns

ALL_PAIRS = 5
"""Up to this N an equation with free indices is tried at all places of the lattice; for larger N at
``SAMPLES`` that are drawn."""
SAMPLES = 12
LEAST = 3
"""The N of a model of which the degrees alone are asked for: they are those of any N."""
STEPS = ((-2, Fraction(1, 12)), (-1, Fraction(-2, 3)), (1, Fraction(2, 3)), (2, Fraction(-1, 12)))
"""The derivative at 0 of a polynomial of degree 4 at most, by its values: s and the weight of its
value at s."""


def torus_of(problem: Mapping[str, Any]) -> Torus:
    """The torus of a record's problem."""
    return Torus(problem["torus"]["N"])


def group_of_torus(torus: Torus) -> Group:
    """SU(N) by its name and size, without a table of a basis, or elements."""

    def none(random: Source, size: int) -> Matrix:
        raise EvaluationError(f"no elements of {torus.name} are drawn")

    return Group(torus.name, torus.N, "linear", (), none)


class TorusModel:
    """One point: ζ(n) at random, and with it W, P, Z and Π."""

    def __init__(self, torus: Torus, source: Source, size: int):
        graded = isinstance(source, DegreeSource)
        self.torus = torus = Torus(LEAST) if graded else torus
        assert graded or isinstance(source, Random)
        self.roots = RootsOfUnity(torus.N, None if graded else source)  # type: ignore[arg-type]
        self.source, self.size, self.graded = source, size, graded
        self.pi = self.draw()
        self.elementary = Turns(self.roots, self.pi, torus.N**2)
        self.zeta = {n: self.draw() for n in torus.places}
        self.vorticity = {n: self.derivative(n) for n in torus.places}
        self.made: dict[Place, Matrix] = {}
        self.hypothesis_failures: dict[Any, str] = {}
        self.scale = torus.N / (4 * self.pi * self.roots.i)
        self.Z = q.scaled(self.scale, self.matrix(self.zeta))
        self.W = self.matrix(self.vorticity)
        self.P = q.scaled(-1 / self.scale, self.Z)
        self.rate = q.minus(q.times(self.Z, self.W), q.times(self.W, self.Z))

    def draw(self) -> Any:
        """A random number of the field, not 0."""
        x = self.source.randint(1, self.size)
        return x if self.graded else self.roots.i * 0 + int(x)

    def derivative(self, n: Place) -> Any:
        """∂L̃/∂ζ(−n), of L̃ = ½ Σ |k|² ζ(k) ζ(−k): the terms with k = −n and with k = n."""
        a, b = n
        other = (-a, -b)
        return sum((self.zeta[n] * Fraction(x * x + y * y, 2) for x, y in (n, other)), Fraction(0))

    def matrix(self, coefficients: Mapping[Place, Any]) -> Matrix:
        """Σ a(n) T(n), entry by entry: in row a and column b those with n₂ = b − a."""
        span, half = range(self.torus.N), self.torus.half
        first = range(-half, half + 1)

        @cache
        def symbol(second: int, s: int) -> Any:
            terms = (coefficients[k, second] * self.roots[k * s] for k in first if k or second)
            return sum(terms, Fraction(0))

        def difference(a: int, b: int) -> int:
            return self.torus.representative((0, b - a))[1]

        return tuple(
            tuple(symbol(difference(a, b), (a + b) % self.torus.N) for b in span) for a in span
        )

    def basis(self, n: Place) -> Matrix:
        """T(n) = ω^(n₁n₂) g^n₁ h^n₂, by the clock and the shift; each made once."""
        if n not in self.made:
            self.made[n] = self._basis(n)
        return self.made[n]

    def _basis(self, n: Place) -> Matrix:
        N, (a, b) = self.torus.N, n
        zero = Fraction(0)
        return tuple(
            tuple(
                self.roots[a * b] * self.roots[2 * a * row] if column == (row + b) % N else zero
                for column in range(N)
            )
            for row in range(N)
        )

    def coefficient(self, m: Matrix, n: Place) -> Any:
        """That of T(n) in a matrix, Tr m T(−n)/N: in T(−n), row b has its number in column a."""
        N, (first, second) = self.torus.N, n
        terms = (m[a][(a + second) % N] * self.roots[-first * (2 * a + second)] for a in range(N))
        return sum(terms, Fraction(0)) * Fraction(1, N)

    def moved(self, s: int) -> Matrix:
        """W + s Ẇ."""
        return q.plus(self.W, q.scaled(Fraction(s), self.rate))


def environment(model: TorusModel) -> Environment:
    """The names at a model."""
    return _environment(model, model.W)


def _environment(model: TorusModel, W: Matrix) -> Environment:
    torus, N, zero = model.torus, model.torus.N, Fraction(0)

    def place(t: Tree, env: Environment) -> Place:
        value = evaluate(t, env)
        if not is_matrix(value) or len(value) != 2:
            raise EvaluationError("a point of the lattice is expected")
        return torus.representative((int(value[0][0]), int(value[1][0])))

    def of_place(values: Callable[[Place], Any]) -> Callable[..., Any]:
        return lambda _, a, env: values(place(a[0], env))

    @cache
    def vorticity(n: Place) -> Any:
        return model.coefficient(W, n) if n != (0, 0) else zero

    def energy() -> Any:
        terms = (
            vorticity(n) * vorticity((-n[0], -n[1])) * Fraction(1, 2 * (n[0] ** 2 + n[1] ** 2))
            for n in torus.places
        )
        return sum(terms, zero)

    def lagrangian() -> Any:
        terms = (
            model.zeta[n] * model.zeta[-n[0], -n[1]] * Fraction(n[0] ** 2 + n[1] ** 2, 2)
            for n in torus.places
        )
        return sum(terms, zero)

    def rate(_: Tree, a: tuple[Tree, ...], env: Environment) -> Any:
        total: Any = zero
        for s, weight in STEPS:
            there = _environment(model, model.moved(s))
            total = total + evaluate(a[0], replace(there, indices=env.indices)) * weight
        return total

    names: dict[str, Any] = {
        "i": model.roots.i,
        "π": model.pi,
        "Z": model.Z,
        "W": W,
        "P": model.P,
        "Ẇ": model.rate,
        "Π": q.scaled(1 / (model.scale * N), q.transposed(W)),
    }
    return Environment(
        N,
        _Lazily(names, {"h̃": energy, "L̃": lagrangian}),
        functions={
            "T": of_place(model.basis),
            "ω̂": of_place(vorticity),
            "ζ": of_place(lambda n: model.zeta.get(n, zero)),
            "d/dt": rate,
        },
        elementary=model.elementary,
        lattice=torus.places,
        chosen=_chosen(model),
    )


def _chosen(model: TorusModel) -> Sequence[tuple[int, int]]:
    """Pairs of places, by their numbers; none where all are tried."""
    if model.graded or model.torus.N <= ALL_PAIRS:
        return ()
    random = Random(f"{model.roots.p}")
    count = len(model.torus.places)
    return tuple((random.randint(1, count), random.randint(1, count)) for _ in range(SAMPLES))


class _Lazily(dict[str, Any]):
    """Names whose values are found when they are asked for."""

    def __init__(self, known: Mapping[str, Any], later: Mapping[str, Callable[[], Any]]):
        super().__init__(known)
        self.later = later

    def __missing__(self, name: str) -> Any:
        self[name] = self.later[name]()
        return self[name]
