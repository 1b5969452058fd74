"""The value of a tree at a point of a fluid, by the meaning of its names and operations."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from ...language.tree import Tree
from ..values.arithmetic import EPS, EPS_PRIME, EvaluationError, nilpotent, part
from .exact_functions import (
    Field,
    Function,
    MatrixField,
    Normal,
    OnBoundary,
    Operator,
    Slope,
    Told,
    Value,
    componentwise,
    divergence,
    dot,
    field_of,
    laplacian,
    plus,
    power,
    shifted,
    times,
    trace,
)
from .fluid_model import FluidModel, FluidVariation, gradient, mean
from .fluid_spaces import on_boundary

ALONG_CURVE = ("mul", "Γ", "u")


class FluidValues:
    """The values at a model, each found once. ``pointwise``: are products those at each place, as
    under an integral?"""

    def __init__(self, model: FluidModel):
        self.model: FluidModel = model
        self.known: dict[str, Value] = {}
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
        if op == "pow":
            return power(self.of(parts[0]), parts[1])
        if op not in OPERATIONS:
            raise EvaluationError(f"{op} has no meaning for fields")
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
        for x, y in ((a, b), (b, a)):
            if isinstance(x, Normal):
                return OnBoundary(self._normal_part(field_of(y)))
            if isinstance(x, Slope):
                return self.product_with(dot(field_of(y), x.field))
        return mean(self._weighted(field_of(a), field_of(b)))

    def _weighted(self, a: Field, b: Field) -> Any:
        """The product at each place, over the points with the mass."""
        found = dot(a, b)
        return found * self.model.mass if found.space is self.model.points else found

    def _normal_part(self, field: Field) -> Function:
        """Of a field at the boundary."""
        space = self.model.space
        if not space.bounded:
            raise EvaluationError("there is no boundary")
        return on_boundary(space.outwards(field))

    def _product(self, op: str, parts: list[Tree], pointwise: bool) -> Value:
        found = [self.of(x) for x in parts]
        if op == "norm2":
            found = [*found, found[-1]]
        *metric, a, b = found
        if metric:
            b = times(metric[0], b)
        if pointwise:
            return dot(field_of(a), field_of(b))
        return self.pair(a, b)

    # -- functions -----------------------------------------------------------------------------

    def _call(self, head: Tree, arguments: list[Tree]) -> Value:
        """A function at its arguments."""
        if not isinstance(head, str) or head not in CALLS:
            raise EvaluationError(f"no function {head!r}")
        count, function = CALLS[head]
        if len(arguments) != count:
            raise EvaluationError(f"{head} has {count} arguments, not {len(arguments)}")
        return function(self, *arguments)

    def direction(self, t: Tree) -> tuple[bool, FluidVariation]:
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
        found = field_of(self.of(t))
        if found[0].space is not self.model.space:
            raise EvaluationError("a field in space is expected")
        return found

    def integral(self, t: Tree) -> Value:
        """The integral over the points by their mass."""
        found = self.of(t, pointwise=True)
        if not isinstance(found, Function) or found.space is not self.model.points:
            raise EvaluationError("the integral is of a function over the points")
        return mean(found * self.model.mass)

    def gradient(self, t: Tree) -> Value:
        """grad of a function, or of the density."""
        return Slope(gradient(self.model.density)) if t == "ρ" else gradient(self.functional(t))

    def divergence(self, t: Tree) -> Any:
        """div of a field."""
        return divergence(self.field(t))

    def laplacian(self, t: Tree) -> Function:
        """Δ of a function: its second derivatives."""
        found: Function = laplacian(self.functional(t))
        return found

    def jacobian(self, t: Tree) -> MatrixField:
        """∇ of a field, the matrix of its derivatives."""
        field, span = self.field(t), range(self.model.space.dimension)
        return MatrixField(tuple(tuple(f.d(j) for j in span) for f in field))

    def along_normal(self, t: Tree) -> OnBoundary:
        """∂ₙ of a function."""
        return OnBoundary(self._normal_part(gradient(self.functional(t))))

    def varied(self, what: Tree, mask: int) -> Value:
        """δ or δ′ of η′, η, G or ρ on the family; δ of ϖ(X) on lifts."""
        if what == ("call", "ϖ", "X") and mask == EPS and self.model.at.lift:
            return self.model.action_varied
        model, other = self.model, EPS_PRIME if mask == EPS else EPS
        if what == ("η′" if mask == EPS else "η"):
            return tuple(part(x, mask) for x in model.eulerian(other))
        moved = (model.first if mask == EPS else model.second).displacement
        if what == "G":
            return Operator.of(lambda c: tuple(self.composed(x, mask) for x in field_of(c)))
        if what == "ρ":
            return self.product_with(model.rate_of_density(moved))
        raise EvaluationError("δ is of η′, G and ρ, δ′ of η")

    def composed(self, f: Function, mask: int) -> Any:
        """The part of a mask of f ∘ g on the family."""
        model = self.model
        return model.at_points(part(shifted(f, model.displacement), mask))

    def product_with(self, f: Function) -> Operator:
        """The product with a function, as an operator."""
        return componentwise(lambda x: x * f)

    def rate(self, t: Tree) -> Value:
        """d/dt of ⟨a, b⟩ or ⟨a, b⟩_ρ of fields, by the rates of both and of the density; of the
        energy, over the points; of what is along the curve; on lifts, of ϖ(δy)."""
        if t == "h̃":
            return self.model.rate_of_energy
        if t == ("call", "ϖ", "δy") and self.model.at.lift:
            return self.model.cartan_varied(EPS_PRIME)
        if t in (ALONG_CURVE, "χ_s"):
            return self._rate(t)
        if not isinstance(t, tuple) or t[0] not in ("inner", "metric"):
            raise EvaluationError("d/dt is of a scalar product")
        *metric, a, b = t[1:]
        density = self.of(metric[0]) if metric else None
        if metric and metric[0] != "ρ":
            raise EvaluationError("the metric is the density")
        total: Value = self.model.one * 0
        for x, y in ((self._rate(a), self.of(b)), (self.of(a), self._rate(b))):
            total = total + self.pair(x, y if density is None else times(density, y))
        if density is not None:
            total = total + self.pair(self.of(a), times(self.named("ρ̇"), self.of(b)))
        return total

    def _rate(self, t: Tree) -> Value:
        """The rate of u, ϑ, Γu or χ_s."""
        model = self.model
        if t == ALONG_CURVE:
            rest = zip(model.acceleration, model.u, strict=True)
            return tuple(model.curve.of_space(x) + model.rate_on_curve(y) for x, y in rest)
        if t == "χ_s":
            return tuple(x.d(0) for x in model.velocity_of_curve)
        if t not in ("u", "ϑ"):
            raise EvaluationError("the rates of u and ϑ, of Γu and χ_s are known")
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


def _nabla(values: FluidValues, field: Value) -> Operator:
    """∇_c: the rate of a field from each place to the place where c leads."""
    if field_of(field)[0].space is values.model.curve:  # from the curve to that beside it
        rate = values.model.curve.rate
        return Operator.of(lambda a: tuple(rate(x, field) for x in field_of(a)))
    along = [nilpotent(EPS) * x for x in field_of(field)]
    if along and field[0].space is not values.model.space:
        raise EvaluationError("∇ is along a field in space")
    return Operator.of(lambda a: tuple(part(shifted(x, along, 1), EPS) for x in field_of(a)))


def _transposed(_: FluidValues, x: Value) -> Operator:
    if not isinstance(x, Operator):
        raise EvaluationError("the transpose is of an operator")
    return x.transposed


def _inverse(values: FluidValues, x: Value) -> Operator:
    if x is not values.named("ρ"):
        raise EvaluationError("the density alone has an inverse")
    return values.product_with(values.model.inverse_density)


def _add(values: FluidValues, first: Value, *rest: Value) -> Value:
    for x in rest:
        first = plus(first, x)
    return first


def _mul(values: FluidValues, *factors: Value) -> Value:
    *rest, found = factors
    for x in reversed(rest):
        found = times(x, found)
    return found


OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": _add,
    "mul": _mul,
    "T": _transposed,
    "tr": lambda _, x: trace(x),
    "inv": _inverse,
    "nabla": _nabla,
    "one": lambda values: Operator.of(lambda c: c),
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
    field = field_of(moved)
    if field[0].space is not values.model.points:
        raise EvaluationError("a tangent vector at g is expected")
    return field


# The values of the names of a fluid.


def _points(model: FluidModel, mask: int) -> Field:
    return tuple(part(x, mask) for x in model.nu)


def _moved(model: FluidModel, mask: int) -> Field:
    return tuple(model.at_points(part(x, mask)) for x in model.displacement)


def _lagrangian(model: FluidModel) -> Value:
    return part(model.lagrangian(_points(model, 0)), 0)


def _potential(model: FluidModel) -> Value:
    return part(model.potential, 0)


NAMES: dict[str, Callable[[Any], Value]] = {
    "u": lambda v: v.model.u,
    "η": lambda v: v.model.first.displacement,
    "η′": lambda v: v.model.second.displacement,
    "δu": lambda v: v.model.first.velocity,
    "δ′u": lambda v: v.model.second.velocity,
    "u̇": lambda v: v.model.acceleration,
    "δt": lambda v: v.model.first.time,
    "δ′t": lambda v: v.model.second.time,
    "v": lambda v: _points(v.model, 0),
    "ν": lambda v: _points(v.model, 0),
    "ν̇": lambda v: tuple(map(v.model.at_points, v.model.acceleration_of_points)),
    "ġ": lambda v: tuple(v.model.at_points(x) for x in v.model.u),
    "δν": lambda v: _points(v.model, EPS),
    "δ′ν": lambda v: _points(v.model, EPS_PRIME),
    "δg": lambda v: _moved(v.model, EPS),
    "δ′g": lambda v: _moved(v.model, EPS_PRIME),
    "U": lambda v: _potential(v.model),
    "Ũ": lambda v: _potential(v.model),
    "V": lambda v: v.model.V,
    "f": lambda v: tuple(v.model.force),
    "L": lambda v: _lagrangian(v.model),
    "L̃": lambda v: _lagrangian(v.model),
    "h̃": lambda v: part(v.model.energy(_points(v.model, 0)), 0),
    "G": lambda v: componentwise(lambda x: v.composed(x, 0)),
    "D": lambda v: Operator.of(lambda c: divergence(field_of(c))),
    "p": lambda v: v.model.any_pressure if v.model.at.free else v.model.pressure,
    "ρ": lambda v: v.product_with(v.model.density),
    "ρ̇": lambda v: v.product_with(v.model.rate_of_density(v.model.u)),
    "ρ_0": lambda v: v.product_with(v.model.mass),
    "ϑ": lambda v: v.model.moved_field,
    "ϑ̇": lambda v: v.model.rate_of_displaced(),
    "n": lambda _: Normal(),
    "Γ": lambda v: componentwise(v.model.curve.of_space),
    "Γ_0": lambda v: componentwise(v.model.curve.of_points),
    "Γ̇": lambda v: componentwise(v.model.rate_on_curve),
    "∂_s": lambda v: componentwise(v.along_curve, on_curve=True),
    "χ_s": lambda v: v.model.curve.tangent,
    "χ̇": lambda v: v.model.velocity_of_curve,
    "κ": lambda v: v.of_level(v.model.curve.of_space(v.model.density)),
    "κ̇": lambda v: v.of_level(v.model.rate_of_level),
}
"""Name → what it is, by the ``FluidValues`` of a model."""
