"""The value of a tree at a point of a fluid: numbers, functions, fields, operators, by the meaning
of every name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from operator import add
from typing import Any

from ...language.tree import Tree
from ..arithmetic import EvaluationError
from ..nilpotent import EPS, EPS_PRIME, nilpotent, part
from .fluid_model import Direction, FluidModel, gradient, mean
from .functions import Field, Function, dot, shifted
from .operators import Operator, Told, applied

Value = Any
ALONG_CURVE = ("mul", "Γ", "u")


@dataclass(frozen=True)
class Matrix:
    """A matrix at each place."""

    rows: tuple[tuple[Function, ...], ...]


@dataclass(frozen=True)
class Normal:
    """The unit normal of the boundary."""


@dataclass(frozen=True)
class OnBoundary:
    """A function on the boundary."""

    f: Function


class FluidValues:
    """The values at a model, each found once. ``pointwise``: are products those at each place, as
    under an integral?"""

    def __init__(self, model: FluidModel):
        self.model, self.known = model, dict[str, Value]()
        self.found: dict[tuple[Tree, bool], Value] = {}

    def of(self, t: Tree, pointwise: bool = False) -> Value:
        """The value of a tree; ``EvaluationError`` where it has none."""
        key = t, pointwise
        if key not in self.found:
            self.found[key] = self._of(t, pointwise)
        return self.found[key]

    def _of(self, t: Tree, pointwise: bool) -> Value:
        if isinstance(t, str):
            return self.named(t)
        if isinstance(t, (int, Fraction)):
            return self.model.one * Fraction(t)
        op, *parts = t
        if op in ("inner", "metric", "norm2"):
            return self._product(op, parts, pointwise)
        if op == "call":
            return self._call(parts[0], parts[1:])
        if op not in OPERATIONS:
            raise EvaluationError(f"{op} has no meaning for fields")
        if op == "pow":
            return _power(self.of(parts[0]), parts[1])
        found = [self.of(x, pointwise) for x in parts]
        return OPERATIONS[op](self, *found)

    def named(self, name: str) -> Value:
        """The value of a name."""
        if name not in self.known:
            if name not in NAMES:
                raise EvaluationError(f"no value for {name!r}")
            self.known[name] = NAMES[name](self)
        return self.known[name]

    # -- products ------------------------------------------------------------------------------

    def pair(self, a: Value, b: Value) -> Value:
        """⟨a, b⟩ of fields, over the points by their mass, or in space; or of what is told by
        it."""
        if isinstance(b, Told) and not isinstance(a, Told):
            a, b = b, a
        if isinstance(a, Told):
            return a.paired(b, self.pair)
        if isinstance(a, Function) and isinstance(b, Function):
            return (a * b).mean()
        if Normal in (type(a), type(b)):
            (field,) = (x for x in (a, b) if not isinstance(x, Normal))
            return OnBoundary(self._normal_part(_field(field)))
        return mean(self._weighted(_field(a), _field(b)))

    def _weighted(self, a: Field, b: Field) -> Any:
        """The product at each place, over the points with the mass."""
        found = dot(a, b)
        return found * self.model.mass if found.space is self.model.points else found

    def _normal_part(self, field: Field) -> Function:
        """Of a field at the boundary."""
        from .disc import axis, on_boundary

        space = self.model.space
        if not space.bounded:
            raise EvaluationError("there is no boundary")
        found = [x * axis(space, j) for j, x in enumerate(field)]
        return on_boundary(sum(found[1:], found[0]))

    def _product(self, op: str, parts: list[Tree], pointwise: bool) -> Value:
        found = [self.of(x) for x in parts]
        if op == "norm2":
            found = [*found, found[-1]]
        *metric, a, b = found
        if metric:
            b = self.times(metric[0], b)
        if pointwise:
            return dot(_field(a), _field(b))
        return self.pair(a, b)

    def times(self, a: Value, b: Value) -> Value:
        """The product of two values, an operator applied to what follows it."""
        if isinstance(a, Operator):
            if isinstance(b, Operator):
                return a.then(b)
            if isinstance(b, Told):
                raise EvaluationError("an operator before a transposed one")
            if not isinstance(b, (tuple, Function)):
                raise EvaluationError("an operator is of fields")
            return applied(a, b, self.plus, self.times)
        if isinstance(a, int):
            a = Fraction(a)
        if isinstance(a, (Fraction, Function)):
            if isinstance(a, Function) and not a.is_constant:
                raise EvaluationError("a function is no factor")
            if isinstance(b, tuple):
                return tuple(x * a for x in b)
            if isinstance(b, (Operator, Told)):
                return b.scaled(a)
            if isinstance(b, Function):
                return b * a
            if isinstance(b, OnBoundary):
                return OnBoundary(b.f * a)
            if isinstance(b, Matrix):
                return Matrix(tuple(tuple(x * a for x in row) for row in b.rows))
        if isinstance(a, Matrix) and isinstance(b, Matrix):
            return _product(a, b)
        if isinstance(b, Function) and b.is_constant and not isinstance(a, Function):
            return self.times(b, a)
        raise EvaluationError("these are not multiplied")

    def plus(self, a: Value, b: Value) -> Value:
        """a + b, of one kind; 0 is of each."""
        for x, y in ((a, b), (b, a)):
            if isinstance(x, Function) and x == 0 and not isinstance(y, Function):
                return y
        if type(a) is not type(b):
            raise EvaluationError("a sum of things of two kinds")
        if isinstance(a, tuple):
            return tuple(x + y for x, y in zip(a, b, strict=True))
        if isinstance(a, OnBoundary):
            return OnBoundary(a.f + b.f)
        if isinstance(a, Matrix):
            rows = zip(a.rows, b.rows, strict=True)
            return Matrix(tuple(tuple(map(add, x, y)) for x, y in rows))
        return a + b

    # -- functions -----------------------------------------------------------------------------

    def _call(self, head: Tree, arguments: list[Tree]) -> Value:
        """A function at its arguments."""
        if not isinstance(head, str) or head not in CALLS:
            raise EvaluationError(f"no function {head!r}")
        count, function = CALLS[head]
        if len(arguments) != count:
            raise EvaluationError(f"{head} has {count} arguments, not {len(arguments)}")
        return function(self, *arguments)

    def direction(self, t: Tree) -> tuple[bool, Direction]:
        """A variation by its name: is it δ′ of the family, and its vector."""
        model = self.model
        at = model.at
        if t == "X" and not (at.contracted or at.along or at.lift):
            raise EvaluationError("nothing is given of X")
        second = t == ("X" if at.lift else "δ′y")  # on lifts δ′ is the derivative along X
        if t not in ("δy", "X") and not second:
            raise EvaluationError("a form is of a variation δy, δ′y or X")
        return second, model.second if second else model.first

    def exterior(self, a: Tree, b: Tree) -> Value:
        """dϖ of two variations."""
        (first, _), (second, _) = self.direction(a), self.direction(b)
        if first == second:
            return self.model.one * 0
        found = self.model.exterior
        return -found if first else found

    def functional(self, t: Tree) -> Function:
        """A function in space."""
        found = self.of(t)
        if not isinstance(found, Function) or found.space is not self.model.space:
            raise EvaluationError("a function in space is expected")
        return found

    def field(self, t: Tree) -> Field:
        """A field in space."""
        found = _field(self.of(t))
        if found[0].space is not self.model.space:
            raise EvaluationError("a field in space is expected")
        return found

    def integral(self, t: Tree) -> Value:
        """The integral over the points by their mass."""
        found = self.of(t, pointwise=True)
        if not isinstance(found, Function) or found.space is not self.model.points:
            raise EvaluationError("the integral is of a function over the points")
        return mean(found * self.model.mass)

    def gradient(self, t: Tree) -> Field:
        """grad of a function."""
        f = self.functional(t)
        return gradient(f)

    def divergence(self, t: Tree) -> Any:
        """div of a field."""
        return divergence(self.field(t))

    def laplacian(self, t: Tree) -> Function:
        """Δ of a function: its second derivatives."""
        f = self.functional(t)
        second = [f.d(j).d(j) for j in range(self.model.space.dimension)]
        return sum(second[1:], second[0])

    def jacobian(self, t: Tree) -> Matrix:
        """∇ of a field, the matrix of its derivatives."""
        field, span = self.field(t), range(self.model.space.dimension)
        return Matrix(tuple(tuple(f.d(j) for j in span) for f in field))

    def along_normal(self, t: Tree) -> OnBoundary:
        """∂ₙ of a function."""
        return OnBoundary(self._normal_part(self.gradient(t)))

    def varied(self, what: Tree, mask: int) -> Value:
        """δ or δ′ of η′, η, G or ρ on the family; δ of ϖ(X) on lifts."""
        if what == ("call", "ϖ", "X") and mask == EPS and self.model.at.lift:
            return self.model.action_varied
        model, other = self.model, EPS_PRIME if mask == EPS else EPS
        if what == ("η′" if mask == EPS else "η"):
            return tuple(part(x, mask) for x in model.eulerian(other))
        moved = (model.first if mask == EPS else model.second).displacement
        if what == "G":
            return Operator.of(lambda c: tuple(self._composed(x, mask) for x in _field(c)))
        if what == "ρ":
            return self.product_with(model.rate_of_density(moved))
        raise EvaluationError("δ is of η′, G and ρ, δ′ of η")

    def _composed(self, f: Function, mask: int) -> Any:
        """The part of a mask of f ∘ g on the family."""
        model = self.model
        return model.at_points(part(shifted(f, model.displacement), mask))

    def product_with(self, f: Function) -> Operator:
        """The product with a function, as an operator."""
        return componentwise(lambda x: x * f)

    def rate(self, t: Tree) -> Value:
        """d/dt of ⟨a, b⟩ or ⟨a, b⟩_ρ of fields, by the rates of both and of the density; of what is
        along the curve; on lifts, of ϖ(δy)."""
        if t == ("call", "ϖ", "δy") and self.model.at.lift:
            return self.model.cartan_varied(EPS_PRIME)
        if t in (ALONG_CURVE, "γ_s"):
            return self._rate(t)
        if not isinstance(t, tuple) or t[0] not in ("inner", "metric"):
            raise EvaluationError("d/dt is of a scalar product")
        *metric, a, b = t[1:]
        density = self.of(metric[0]) if metric else None
        if metric and metric[0] != "ρ":
            raise EvaluationError("the metric is the density")
        total: Value = self.model.one * 0
        for x, y in ((self._rate(a), self.of(b)), (self.of(a), self._rate(b))):
            total = total + self.pair(x, y if density is None else self.times(density, y))
        if density is not None:
            total = total + self.pair(self.of(a), self.times(self.named("ρ̇"), self.of(b)))
        return total

    def _rate(self, t: Tree) -> Value:
        """The rate of u, ϑ, Γu or γ_s."""
        model = self.model
        if t == ALONG_CURVE:
            rest = zip(model.acceleration, model.u, strict=True)
            return tuple(model.curve.of_space(x) + model.rate_on_curve(y) for x, y in rest)
        if t == "γ_s":
            return tuple(x.d(0) for x in model.velocity_of_curve)
        if t not in ("u", "ϑ"):
            raise EvaluationError("the rates of u and ϑ, of Γu and γ_s are known")
        return self.named({"u": "u̇", "ϑ": "ϑ̇"}[str(t)])

    def of_level(self, f: Function) -> Function:
        """What is said of κ; ``EvaluationError`` where the curve is not of one level."""
        if not self.model.at.one_level:
            raise EvaluationError("κ is the density where Γρ = κΓ, which must be given")
        return f

    def along_curve(self, f: Function) -> Function:
        """∂_s of a function along the curve."""
        if f.space is not self.model.curve:
            raise EvaluationError("∂_s is of what is along the curve")
        return f.d(0)


def componentwise(change: Callable[[Any], Any], *, on_curve: bool = False) -> Operator:
    """What changes functions, as an operator on functions and fields."""
    return Operator.of(
        lambda c: change(c) if isinstance(c, Function) else tuple(map(change, _field(c))),
        on_curve=on_curve,
    )


def divergence(field: Field) -> Any:
    """Σ ∂_j a_j."""
    found = [f.d(j) for j, f in enumerate(field)]
    return sum(found[1:], found[0])


def _field(x: Value) -> Field:
    if not isinstance(x, tuple):
        raise EvaluationError("a field is expected")
    return x


def _nabla(values: FluidValues, field: Value) -> Operator:
    """∇_c: the rate of a field from each place to the place where c leads."""
    if _field(field)[0].space is values.model.curve:  # from the curve to that beside it
        rate = values.model.curve.rate
        return Operator.of(lambda a: tuple(rate(x, field) for x in _field(a)))
    along = [nilpotent(EPS) * x for x in _field(field)]
    if along and field[0].space is not values.model.space:
        raise EvaluationError("∇ is along a field in space")
    return Operator.of(lambda a: tuple(part(shifted(x, along, 1), EPS) for x in _field(a)))


def _transposed(_: FluidValues, x: Value) -> Operator:
    if not isinstance(x, Operator):
        raise EvaluationError("the transpose is of an operator")
    return x.transposed


def _inverse(values: FluidValues, x: Value) -> Operator:
    if x is not values.named("ρ"):
        raise EvaluationError("the density alone has an inverse")
    return values.product_with(values.model.inverse_density)


def _power(x: Value, n: Any) -> Value:
    if not isinstance(x, Matrix) or n != 2:
        raise EvaluationError("a power is the square of a matrix")
    return _product(x, x)


def _product(a: Matrix, b: Matrix) -> Matrix:
    columns = [*zip(*b.rows, strict=True)]
    return Matrix(tuple(tuple(dot(row, c) for c in columns) for row in a.rows))


def _trace(_: FluidValues, x: Value) -> Function:
    if not isinstance(x, Matrix):
        raise EvaluationError("the trace is of a matrix")
    found = [row[j] for j, row in enumerate(x.rows)]
    return sum(found[1:], found[0])


def _add(values: FluidValues, first: Value, *rest: Value) -> Value:
    for x in rest:
        first = values.plus(first, x)
    return first


def _mul(values: FluidValues, *factors: Value) -> Value:
    *rest, found = factors
    for x in reversed(rest):
        found = values.times(x, found)
    return found


OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": _add,
    "mul": _mul,
    "T": _transposed,
    "tr": _trace,
    "inv": _inverse,
    "nabla": _nabla,
    "one": lambda values: Operator.of(lambda c: c),
    "pow": _power,
}

CALLS: dict[str, tuple[int, Callable[..., Value]]] = {
    "∫": (1, FluidValues.integral),
    "p̃": (1, lambda v, x: _paired(v, v.of(x))),
    "dŨ": (1, lambda v, x: v.model.work(_over_points(v, v.of(x)))),
    "ϖ": (1, lambda v, x: v.model.cartan(v.direction(x)[1])),
    "dϖ": (2, FluidValues.exterior),
    "δ": (1, lambda v, x: v.varied(x, EPS)),
    "δ′": (1, lambda v, x: v.varied(x, EPS_PRIME)),
    "η": (1, lambda v, x: v.direction(x)[1].displacement),
    "d/dt": (1, FluidValues.rate),
    "grad": (1, FluidValues.gradient),
    "div": (1, FluidValues.divergence),
    "Δ": (1, FluidValues.laplacian),
    "∇": (1, FluidValues.jacobian),
    "∂ₙ": (1, FluidValues.along_normal),
}


def _paired(values: FluidValues, moved: Value) -> Value:
    """p̃ of a tangent vector, over the points: the derivative of L."""
    field = _over_points(values, moved)
    nu = [part(x, 0) for x in values.model.nu]
    return part(values.model.momentum(nu, field), 0)


def _over_points(values: FluidValues, moved: Value) -> Field:
    """A tangent vector at g."""
    field = _field(moved)
    if field[0].space is not values.model.points:
        raise EvaluationError("a tangent vector at g is expected")
    return field


def _points(values: FluidValues, mask: int) -> Field:
    return tuple(part(x, mask) for x in values.model.nu)


def _moved(values: FluidValues, mask: int) -> Field:
    model = values.model
    return tuple(model.at_points(part(x, mask)) for x in model.displacement)


def _lagrangian(values: FluidValues) -> Value:
    return part(values.model.lagrangian(_points(values, 0)), 0)


def _potential(values: FluidValues) -> Value:
    return part(values.model.potential, 0)


NAMES: dict[str, Callable[[FluidValues], Value]] = {
    "u": lambda v: v.model.u,
    "η": lambda v: v.model.first.displacement,
    "η′": lambda v: v.model.second.displacement,
    "δu": lambda v: v.model.first.velocity,
    "δ′u": lambda v: v.model.second.velocity,
    "u̇": lambda v: v.model.acceleration,
    "δt": lambda v: v.model.first.time,
    "δ′t": lambda v: v.model.second.time,
    "v": lambda v: _points(v, 0),
    "ν": lambda v: _points(v, 0),
    "ν̇": lambda v: tuple(map(v.model.at_points, v.model.acceleration_of_points)),
    "ġ": lambda v: tuple(v.model.at_points(x) for x in v.model.u),
    "δν": lambda v: _points(v, EPS),
    "δ′ν": lambda v: _points(v, EPS_PRIME),
    "δg": lambda v: _moved(v, EPS),
    "δ′g": lambda v: _moved(v, EPS_PRIME),
    "U": _potential,
    "Ũ": _potential,
    "V": lambda v: v.model.V,
    "f": lambda v: tuple(-x for x in gradient(v.model.V)),
    "L": _lagrangian,
    "L̃": _lagrangian,
    "h̃": lambda v: part(v.model.energy(_points(v, 0)), 0),
    "G": lambda v: componentwise(lambda x: v._composed(x, 0)),
    "D": lambda v: Operator.of(lambda c: divergence(_field(c))),
    "p": lambda v: v.model.any_pressure if v.model.at.free else v.model.pressure,
    "ρ": lambda v: v.product_with(v.model.density),
    "ρ̇": lambda v: v.product_with(v.model.rate_of_density(v.model.u)),
    "ϑ": lambda v: v.model.moved_field,
    "ϑ̇": lambda v: v.model.rate_of_moved(),
    "n": lambda _: Normal(),
    "Γ": lambda v: componentwise(v.model.curve.of_space),
    "Γ_0": lambda v: componentwise(v.model.curve.of_points),
    "Γ̇": lambda v: componentwise(v.model.rate_on_curve),
    "∂_s": lambda v: componentwise(v.along_curve, on_curve=True),
    "γ_s": lambda v: v.model.curve.tangent,
    "γ̇": lambda v: v.model.velocity_of_curve,
    "κ": lambda v: v.of_level(v.model.curve.of_space(v.model.density)),
    "κ̇": lambda v: v.of_level(v.model.rate_of_level),
}
