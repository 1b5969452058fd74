"""Two random exact elements of a group that move by ġ = f_u(g), and the errors between them.

No formula of the errors is used: their rates are derivatives along the two motions.  That of the
logarithm of an error is a power series, where one element is the other times exp(sX).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import RandomSource, simple_elements
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ...record.as_json import decode
from ..values.arithmetic import EPS, EPS_PRIME, ETA, EvaluationError, nilpotent, part
from ..values.draws import Draws, Locus
from ..values.evaluate import Environment, evaluate

ORDER = 3
"""The order in s of the series: s is a sum of as many numbers whose squares are 0."""

HIGHER = (EPS | EPS_PRIME, EPS | EPS_PRIME | ETA)
"""The products of these numbers that s², s³ have as their part."""


class KinematicsModel(Draws):
    """A and Â, the inputs and their noise, at random; or the elements that the locus has."""

    def __init__(
        self, problem: Mapping[str, Any], group: Group, source: RandomSource, size: int, at: Locus
    ):
        super().__init__(problem, group, source, size)
        self.at, given = at, problem["kinematics"]
        self.hypothesis_failures: dict[Any, str] = {}
        self.rate = [[decode(x, "problem, rate") for x in row] for row in given["rate"]]
        self.inputs = [str(x) for x in given["inputs"]]
        self.parameters |= {x: self.draw() for x in self.inputs}
        self.noise = [self.draw() for _ in self.inputs]
        self.A, self.estimate = (group.sample_inside(source, size) for _ in range(2))
        for name, tree in at.elements:
            self._take(name, tree)
        self.observed = q.column(self.place())
        self.X = self.algebra()
        self.xi = q.column(group.nearest(self.X))
        self.weights = [self.draw() for _ in HIGHER]

    def _take(self, name: str, tree: Tree) -> None:
        """A given element in the place of a random one; ``EvaluationError`` where it is none."""
        g = evaluate(tree, self.expressions)
        simple = simple_elements(self.group.basis)
        if g not in simple and not any(g == q.times(a, b) for a in simple for b in simple):
            raise EvaluationError(
                f"what is given for {name} is no product of simple elements of {self.group.name}"
            )
        if name == "A":
            self.A = g
        else:
            self.estimate = g

    def velocity(self, g: Matrix, parameters: Mapping[str, Any] | None = None) -> Matrix:
        """f at a matrix, for the inputs of the model or others."""
        env = Environment(
            self.n,
            {**self.expressions.names, "A": g},
            parameters=parameters or self.parameters,
            elementary=self.elementary,
        )
        return tuple(tuple(evaluate(x, env) for x in row) for row in self.rate)

    @cached_property
    def by_noise(self) -> Matrix:
        """The derivative of f(Â) by the inputs along the noise."""
        moved = zip(self.inputs, self.noise, strict=True)
        ahead = {x: self.parameters[x] + nilpotent(EPS) * e for x, e in moved}
        return part(  # type: ignore[no-any-return]
            self.velocity(self.estimate, {**self.parameters, **ahead}), EPS
        )

    def names(self, A: Matrix, estimate: Matrix) -> dict[str, Any]:
        """What depends on the two elements."""
        back = q.inverted(estimate)
        return {
            **{"A": A, "Â": estimate},
            **{"η_L": q.times(back, A), "η_R": q.times(A, back)},
        }

    def rate_of(self, t: Tree, env: Environment) -> Any:
        """The derivative of a tree along the two motions."""
        e = nilpotent(EPS)
        A, estimate = (q.plus(g, q.scaled(e, self.velocity(g))) for g in (self.A, self.estimate))
        return part(evaluate(t, replace(env, names=self.names(A, estimate))), EPS)

    def generator(self, *, left: bool) -> Matrix:
        """The matrix of the rates of the logarithm of an error near 1, on the basis."""
        one, e = q.identity(self.n), nilpotent(EPS)
        near = (q.plus(one, q.scaled(e, x)) for x in self.group.basis)
        rates = (part(self.rate_of_error(x, left=left), EPS) for x in near)
        return q.transposed(tuple(map(self.group.nearest, rates)))

    def rate_of_logarithm(self, *, left: bool) -> Matrix:
        """The derivative of the coordinates of the logarithm of an error exp(sX), of first order in
        s; random multiples of what is of higher order are added."""
        found = self.series(self.X, left=left)
        total = part(found, EPS)
        for weight, mask in zip(self.weights, HIGHER, strict=True):
            total = q.plus(total, q.scaled(weight, part(found, mask)))
        inside = self.group.hat(self.group.nearest(total))
        if not self.graded and any(map(any, q.minus(inside, total))):
            raise EvaluationError("the logarithm of the error leaves the Lie algebra")
        return q.column(self.group.nearest(total))

    def series(self, X: Matrix, *, left: bool) -> Matrix:
        """The derivative of the logarithm of an error, where that is exp(sX), as a series in s."""
        s = nilpotent(EPS) + nilpotent(EPS_PRIME) + nilpotent(ETA)
        small = q.scaled(s, X)
        error = power = q.identity(self.n)
        for k in range(1, ORDER + 1):
            power = q.scaled(Fraction(1, k), q.times(power, small))
            error = q.plus(error, power)
        rate = self.rate_of_error(error, left=left)
        return self._derivative_of_logarithm(q.minus(error, q.identity(self.n)), rate)

    def rate_of_error(self, error: Matrix, *, left: bool) -> Matrix:
        """The derivative of Â⁻¹A where A = Â error, or of AÂ⁻¹ where A = error Â."""
        B, back = self.estimate, q.inverted(self.estimate)
        moved = self.velocity(B)
        if left:
            ahead = q.times(back, self.velocity(q.times(B, error)))
            return q.minus(ahead, q.times(q.times(back, moved), error))
        ahead = q.times(self.velocity(q.times(error, B)), back)
        return q.minus(ahead, q.times(error, q.times(moved, back)))

    @staticmethod
    def _derivative_of_logarithm(small: Matrix, rate: Matrix) -> Matrix:
        """That of log(1 + N) = N − N²/2 + N³/3 − …, where N has this rate and is of first order."""
        powers = [q.identity(len(small))]
        for _ in range(ORDER):
            powers.append(q.times(powers[-1], small))
        total = q.scaled(Fraction(0), small)
        for k in range(1, ORDER + 2):
            for j in range(k):
                term = q.times(q.times(powers[j], rate), powers[k - 1 - j])
                total = q.plus(total, q.scaled(Fraction((-1) ** (k + 1), k), term))
        return total


def environment(model: KinematicsModel) -> Environment:
    """The names at a model."""
    A, B = model.A, model.estimate
    back = q.inverted(B)
    Z = q.times(q.inverted(A), model.velocity(A))

    def rate(_: Tree, a: tuple[Tree, ...], env: Environment) -> Any:
        (t,) = a
        if t in ("ξ_L", "ξ_R"):
            return model.rate_of_logarithm(left=t == "ξ_L")
        return model.rate_of(t, env)

    def at(_: Tree, a: tuple[Tree, ...], env: Environment) -> Any:
        g = evaluate(a[0], env)
        return model.velocity(g if isinstance(g, tuple) else q.scaled(g, q.identity(model.n)))

    functions: dict[str, Callable[..., Any]] = {"d/dt": rate, "ℱ": at}
    o = model.observed
    names = {
        **model.names(A, B),
        "π": model.pi,
        "Ȧ": model.velocity(A),
        "Z": Z,
        "ζ": q.column(model.group.nearest(Z)),
        **{"𝒜_L": model.generator(left=True), "𝒜_R": model.generator(left=False)},
        **{"ξ_L": model.xi, "ξ_R": model.xi},
        "ς": q.column(model.noise),
        "W_L": q.times(back, model.by_noise),
        "W_R": q.times(model.by_noise, back),
        "o": o,
        "z_L": q.minus(q.times(q.times(back, A), o), o),
        "z_R": q.minus(q.times(q.times(B, q.inverted(A)), o), o),
    }
    return Environment(
        model.n,
        names,
        {"E": {(a,): e for a, e in enumerate(model.group.basis, 1)}},
        functions,
        model.parameters,
        elementary=model.elementary,
        unit=model.unit,
    )
