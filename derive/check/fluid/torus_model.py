"""A random exact point of the fluid on the torus, and its motion; no bracket of the basis is used.

T(n) are products of the clock and of the shift; ω̂ is the polar form of L̃; the motion is that under
which the momentum seen through g, g⁻¹Wg, is constant (Noether's theorem for g ↦ gh).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from random import Random
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import RandomSource
from ...algebra.structure import Place, TorusLattice
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ...record.as_json import decode
from ..values.arithmetic import EvaluationError
from ..values.evaluate import Environment, evaluate
from ..values.residue import DegreeSource, _residue
from .lattice_values import (
    Drawn,
    Elements,
    LatticeResidues,
    LatticeTerm,
    Multiples,
    Places,
    RootsOfUnity,
    Turns,
    Wave,
)

KEPT = 64
"""The most T(n) that are kept."""
LEAST = 3
"""The N of a model of which the degrees alone are asked for: they are those of any N."""
STEPS = ((-2, Fraction(1, 12)), (-1, Fraction(-2, 3)), (1, Fraction(2, 3)), (2, Fraction(-1, 12)))
"""The derivative at 0 of a polynomial of degree 4 at most, by its values: s and the weight of its
value at s."""


class TorusModel:
    """One point: ζ(n) at random, and with it W, P, Z and Π; ``free``: is Ẇ any, not that of the
    motion?  ``problem``: what acts from outside, in steps that are ``driven``."""

    def __init__(
        self,
        torus: TorusLattice,
        source: RandomSource,
        size: int,
        *,
        free: bool = False,
        problem: Mapping[str, Any] | None = None,
        driven: bool = False,
    ):
        graded = isinstance(source, DegreeSource)
        self.torus = torus = TorusLattice(LEAST) if graded else torus
        assert graded or isinstance(source, Random)
        self.roots = RootsOfUnity(torus.N, None if graded else source)  # type: ignore[arg-type]
        self.source, self.size, self.graded = source, size, graded
        self.pi = self.draw()
        self.elementary = Turns(self.roots, self.pi, torus.N**2)
        self.zeta = {n: self.draw() for n in torus.places}
        self.vorticity = {n: self.derivative(n) for n in torus.places}
        self.basis = lru_cache(KEPT)(self._basis)
        self.hypothesis_failures: dict[Any, str] = {}
        self.scale = torus.N / (4 * self.pi * self.roots.i)
        self.Z = q.scaled(self.scale, self.matrix(self.grid(self.zeta)))
        self.W = self.matrix(self.grid(self.vorticity))
        self.P = q.scaled(-1 / self.scale, self.Z)
        told = problem or {}
        self.parameters = {name: self.draw() for name in told.get("parameters", ())}
        self.input = {n: self.draw() for n in torus.places} if told.get("inputs") else None
        self.damping = told.get("damping", ())
        self.rate = q.minus(q.times(self.Z, self.W), q.times(self.W, self.Z))
        self.forcing: Matrix | None = None
        if driven:
            self.forcing = self.matrix(self.grid({n: self.acting(n) for n in torus.places}))
            self.rate = q.plus(self.rate, self.forcing)
        if free:
            self.rate = self.matrix(self.grid({n: self.draw() for n in torus.places}))

    @property
    def all_places(self) -> Matrix:
        """The points of the lattice, all at once, as one vector."""
        return tuple((Multiples(x, self.roots.p),) for x in zip(*self.torus.places, strict=True))

    @cached_property
    def drawn(self) -> Drawn:
        """By what matrices at all points are compared."""
        return Drawn(self)

    def draw(self) -> Any:
        """A random number of the field, not 0."""
        x = self.source.randint(1, self.size)
        return x if self.graded else self.roots.i * 0 + int(x)

    def derivative(self, n: Place) -> Any:
        """∂L̃/∂ζ(−n), of L̃ = ½ Σ |k|² ζ(k) ζ(−k): the terms with k = −n and with k = n."""
        a, b = n
        other = (-a, -b)
        return sum((self.zeta[n] * Fraction(x * x + y * y, 2) for x, y in (n, other)), Fraction(0))

    def acting(self, n: Place) -> Any:
        """What is added to the rate of ω̂(n) from outside."""
        total = self.input[n] if self.input else Fraction(0)
        env = Environment(self.torus.N, {}, parameters=self.parameters)
        for x in self.damping:
            size = Fraction(n[0] ** 2 + n[1] ** 2) ** x["power"]
            kappa = evaluate(decode(x["coefficient"], "damping"), env)
            total = total - kappa * self.vorticity[n] * size
        return total

    def input_grid(self) -> Matrix:
        """f̂(n) as a matrix over n modulo N."""
        return self.grid(self.input or {})

    def fourier(self, sign: int) -> Matrix:
        """e^(± 2πi jk/N) in row j and column k: the discrete Fourier transform."""
        span = range(self.torus.N)
        return tuple(tuple(self.roots[sign * j * k] for k in span) for j in span)

    def grid(self, coefficients: Mapping[Place, Any]) -> Matrix:
        """a(n) as a matrix over n modulo N, 0 at 0."""
        N, span = self.torus.N, range(self.torus.N)
        found = {(a % N, b % N): x for (a, b), x in coefficients.items()}
        return tuple(tuple(found.get((a, b), Fraction(0)) for b in span) for a in span)

    def matrix(self, grid: Matrix) -> Matrix:
        """Σ a(n) T(n), entry by entry: in row r and column c those with n₂ = c − r, times
        e^(2πi n₁(r + c)/N)."""
        N, sums = self.torus.N, q.times(self.fourier(1), grid)
        return tuple(tuple(sums[(r + c) % N][(c - r) % N] for c in range(N)) for r in range(N))

    def coefficients(self, m: Matrix) -> Matrix:
        """a(n) of a matrix Σ a(n) T(n), that is Tr m T(−n)/N, as a matrix over n modulo N."""
        N = self.torus.N
        half = (N + 1) // 2  # 1/2 modulo N
        sums = tuple(
            tuple(m[half * (s - k) % N][half * (s + k) % N] for k in range(N)) for s in range(N)
        )
        return q.scaled(Fraction(1, N), q.times(self.fourier(-1), sums))

    def _basis(self, n: Place) -> Matrix:
        """T(n) = ω^(n₁n₂) g^n₁ h^n₂, by the clock and the shift."""
        a, b = n
        rows = range(self.torus.N)
        return Wave.of([self.roots[a * b] * self.roots[2 * a * r] for r in rows], b)

    def along_rate(self, s: int) -> Matrix:
        """W + s Ẇ."""
        return q.plus(self.W, q.scaled(Fraction(s), self.rate))


def environment(model: TorusModel) -> Environment:
    """The names at a model."""
    return _environment(model, model.W)


def _place(torus: TorusLattice, given: tuple[Tree, ...], env: Environment) -> Place | Places:
    """A point of the lattice, given as one or by its two coordinates; or all at once."""
    found = [evaluate(x, env) for x in given]
    if len(found) == 1:
        if not isinstance(found[0], tuple) or len(found[0]) != 2:
            raise EvaluationError("a point of the lattice is expected")
        found = [row[0] for row in found[0]]
    if any(isinstance(x, (Multiples, LatticeResidues)) for x in found):
        x, y = (_coordinates(torus, x) for x in found)
        N = torus.N
        return [a % N * N + b % N for a, b in zip(x, y, strict=True)]
    x, y = found
    return torus.representative((int(x), int(y)))


def _coordinates(torus: TorusLattice, x: Any) -> Sequence[int]:
    """A coordinate of all points at once, of which some may be the same."""
    if isinstance(x, Multiples) and x.unit == 1:
        return x.k
    if isinstance(x, (Multiples, LatticeResidues)):
        raise EvaluationError("whole numbers are expected on the lattice")
    return [int(x)] * len(torus.places)


def _of_grid(model: TorusModel, grid: Callable[[], Matrix]) -> Callable[[Any], Any]:
    """a(n) at a point, or at all at once, of a matrix that is made when it is asked for."""

    @cache
    def residues() -> list[int]:
        return [_residue(x, model.roots.p) for row in grid() for x in row]

    def value(n: Place | Places) -> Any:
        if isinstance(n, tuple):
            return grid()[n[0]][n[1]]
        return LatticeResidues([*map(residues().__getitem__, n)], model.roots.p)

    return value


def _half_square(torus: TorusLattice, a: Callable[[Place], Any], power: int) -> Any:
    """½ Σ |n|²ᵖ a(n) a(−n)."""
    terms = (
        a(n) * a((-n[0], -n[1])) * (Fraction(n[0] ** 2 + n[1] ** 2) ** power / 2)
        for n in torus.places
    )
    return sum(terms, Fraction(0))


def _environment(model: TorusModel, W: Matrix) -> Environment:
    torus, N, zero = model.torus, model.torus.N, Fraction(0)

    def of_place(values: Callable[[Any], Any]) -> Callable[..., Any]:
        return lambda _, a, env: values(_place(torus, a, env))

    @cache
    def coefficients() -> Matrix:
        (_, *first), *rest = model.coefficients(W)
        return ((zero, *first), *rest)

    def basis(n: Place | Places) -> Any:
        return model.basis(n) if isinstance(n, tuple) else Elements(model, [LatticeTerm(n)])

    vorticity = _of_grid(model, coefficients)
    zeta = _of_grid(model, cache(lambda: model.grid(model.zeta)))

    @cache
    def along_rate(s: int) -> Environment:
        return _environment(model, model.along_rate(s))

    def rate(_: Tree, a: tuple[Tree, ...], env: Environment) -> Any:
        total: Any = zero
        for s, weight in STEPS:
            there = along_rate(s)
            total = total + evaluate(a[0], replace(there, indices=env.indices)) * weight
        return total

    functions = {
        "T": of_place(basis),
        "ω̂": of_place(vorticity),
        "ζ": of_place(zeta),
        "d/dt": rate,
    }
    if model.input is not None:
        functions["f̂"] = of_place(_of_grid(model, model.input_grid))
    names: dict[str, Any] = {
        "i": model.roots.i,
        "π": model.pi,
        "Z": model.Z,
        "W": W,
        "P": model.P,
        "Ẇ": model.rate,
        "Π": q.scaled(1 / (model.scale * N), q.transposed(W)),
    } | ({} if model.forcing is None else {"F": model.forcing})
    return Environment(
        N,
        _Lazily(
            names,
            {
                "h̃": lambda: _half_square(torus, vorticity, -1),
                "L̃": lambda: _half_square(torus, zeta, 1),
            },
        ),
        parameters=model.parameters,
        functions=functions,
        elementary=model.elementary,
        lattice=torus.places,
        at_once=None if model.graded else model.all_places,
    )


class _Lazily(dict[str, Any]):
    """Names whose values are found when they are asked for."""

    def __init__(self, known: Mapping[str, Any], later: Mapping[str, Callable[[], Any]]):
        super().__init__(known)
        self.later = later

    def __missing__(self, name: str) -> Any:
        self[name] = self.later[name]()
        return self[name]


# The torus of a record's problem, and its group.


def torus_of(problem: Mapping[str, Any]) -> TorusLattice:
    """The torus of a record's problem."""
    return TorusLattice(problem["torus"]["N"])


def group_of_torus(torus: TorusLattice) -> Group:
    """SU(N) by its name and size, without a table of a basis, or elements."""

    def none(random: RandomSource, size: int) -> Matrix:
        raise EvaluationError(f"no elements of {torus.name} are drawn")

    return Group(torus.name, torus.N, "linear", (), none)
