"""The sides of an equation about a fluid at a point, and how much the points must tell apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any, NamedTuple

from ...language.tree import Tree
from ...record.record import Equation
from ..values.arithmetic import EvaluationError
from ..values.residue import common_degree, indeterminate
from .exact_functions import (
    ORDERS,
    Edges,
    Exponents,
    Function,
    MatrixField,
    OnBoundary,
    Operator,
    Told,
    Value,
    times,
)
from .field_values import FluidValues
from .fluid_spaces import DEGREE, FREQUENCIES

# The sides of an equation about a fluid at a point: the numbers that must agree.


def pairs(equation: Equation, values: FluidValues) -> Iterator[tuple[Any, Any]]:
    """The numbers that must agree, two by two; ``EvaluationError`` for sides of two kinds."""
    for both in zip(*map(functions, sides(equation, values)), strict=True):
        yield from (pair for _, pair in coefficients(*both))


def sides(equation: Equation, values: FluidValues) -> tuple[Value, Value]:
    """The values of both sides: of operators, of what they do to a random field; of what is told by
    its products, of that with one. ``EvaluationError`` for two kinds."""
    left, right = values.of(equation.lhs), values.of(equation.rhs)
    model = values.model
    written = 0 in (equation.lhs, equation.rhs)  # a 0 of any kind
    for x, y in ((left, right), (right, left)):
        if written and isinstance(x, Function) and x == 0 and not isinstance(y, Function):
            left, right = y, times(Fraction(0), y)
    if isinstance(left, Operator) and isinstance(right, Operator):
        b = model.space.any_field(model.draw)
        on_curve = {x.on_curve for x in (left, right)}
        if on_curve == {True}:
            b = tuple(map(model.curve.of_space, b))
        left, right = (times(x, b) for x in (left, right))
    if isinstance(left, Told) or isinstance(right, Told):
        like = next((x for x in (left, right) if not isinstance(x, Told)), ())
        if isinstance(like, Function):
            raise EvaluationError("the sides differ: a field and a number")
        if like and like[0].space is model.curve:
            test = tuple(map(model.curve.of_space, model.space.any_field(model.draw)))
        else:
            test = model.space.tangent(model.draw, like)
        left, right = (values.pair(x, test) for x in (left, right))
    if type(left) is not type(right):
        raise EvaluationError("the sides are of two kinds")
    for x, y in zip(functions(left), functions(right), strict=True):
        if x.space is not y.space and not (x.is_constant or y.is_constant):
            raise EvaluationError("one side is over the points, the other in space")
    return left, right


def coefficients(x: Function, y: Function) -> Iterator[tuple[Exponents, tuple[Any, Any]]]:
    """Those of two functions, by their exponents; on a polygon of each edge."""
    for m in {**x.terms, **y.terms}:
        for pair in entries(x.terms.get(m, Fraction(0)), y.terms.get(m, Fraction(0))):
            yield m, pair


def entries(x: Any, y: Any) -> Iterator[tuple[Any, Any]]:
    """Two numbers, or those of each edge."""
    if not isinstance(x, Edges) and not isinstance(y, Edges):
        yield x, y
        return
    size = len(x.each if isinstance(x, Edges) else y.each)
    each = (z.each if isinstance(z, Edges) else (z,) * size for z in (x, y))
    yield from zip(*each, strict=True)


def functions(x: Value) -> tuple[Function, ...]:
    """The functions that a value is made of."""
    if isinstance(x, MatrixField):
        return tuple(f for row in x.rows for f in row)
    if isinstance(x, OnBoundary):
        return (x.f,)
    return x if isinstance(x, tuple) else (x,)


def kind_of(x: Value) -> str:
    """The type of a value, as a record has it."""
    if isinstance(x, Function):
        return "scalar" if x.is_constant else "scalar field"
    if isinstance(x, OnBoundary):
        return "scalar field"
    if isinstance(x, MatrixField):
        return "tensor field"
    return "operator" if isinstance(x, Operator) else "vector field"


# How much the points at which a claim about a fluid is tried must tell apart.
#
# On tori a field has as many frequencies as there are fields in a term, in a ball its polynomials
# are of the degree of the derivatives: else a claim may hold where it is tried, and not
# otherwise.

MOST_FIELDS, MOST_DERIVATIVES = 6, 4
"""That are tried; a claim with more is refused."""
SLOTS = indeterminate().degree.num.slots
"""Of a coefficient of a field, by which fields are counted; frequencies and lengths have none."""
BOUNDARY = frozenset({"n", "∂ₙ"})
DENSITIES = dict.fromkeys(("ρ", "ρ_0", "ρ̇", "κ", "κ̇"), 1)
_WHOLE = "inner metric norm2 ∫ p̃ dŨ ϖ dϖ h̃ L L̃ U Ũ"
INTEGRALS = dict.fromkeys(_WHOLE.split(), 1)
_LOCAL = "nabla grad div ∇ D ∂ₙ δ δ′ d/dt ∂_s"
DERIVATIVES = {**dict.fromkeys(_LOCAL.split(), 1), "Δ": 2}
LIMITS = (
    ("densities", DENSITIES, 1),
    ("integrals", INTEGRALS, 1),
    ("derivatives", DERIVATIVES, MOST_DERIVATIVES),
)
"""What is counted in a term, by the heads and names that are counted, and the most that is tried:
products of two integrals would need modes in which each of them alone has the sum 0."""
MORE = "a product with more {} than those that are tried can tell"


class Reach(NamedTuple):
    """Of points that tell claims apart with so many ``fields`` in a term, or with so many
    ``derivatives`` of one."""

    fields: int = FREQUENCIES
    derivatives: int = DEGREE


LEAST = Reach()


def too_much(equation: Equation) -> str:
    """Of what an equation has more than can be tried, in words; "" if of nothing."""
    over = (what for what, counted, limit in LIMITS if most(counted, equation) > limit)
    return next(map(MORE.format, over), "")


def most(counted: Mapping[str, int], of: Equation | Tree) -> int:
    """The most of what is counted in a term of a tree, of either side of an equation."""
    if isinstance(of, Equation):
        return max(most(counted, of.lhs), most(counted, of.rhs))
    if not isinstance(of, tuple):
        return counted.get(of, 0) if isinstance(of, str) else 0
    own, found = counted.get(of[0], 0), [most(counted, x) for x in of[1:]]
    one_of = of[0] == "add" or of[:2] == ("call", "∫")  # under which ⟨a, b⟩ is at each place
    return own + (max(found) if one_of else sum(found))


def needed(equation: Equation, graded: FluidValues | None) -> Reach:
    """The reach that an equation needs, by its values in ``graded`` numbers on a torus; ``None`` at
    the boundary, of which tori tell nothing and balls must tell one derivative more."""
    derivatives = most(DERIVATIVES, equation) - (graded is not None)
    counted = FREQUENCIES if graded is None else fields(equation, graded)
    return Reach(max(counted, FREQUENCIES), max(derivatives, DEGREE))


def fields(equation: Equation, graded: FluidValues) -> int:
    """The most fields in a term of the sides, less one under an integral; of densities to the order
    s alone, as :data:`~derive.check.fluid.exact_functions.ORDERS` says."""
    listed = [*zip(*map(functions, sides(equation, graded)), strict=True)]
    whole = all(x.is_constant for both in listed for x in both)
    each = (pair for x, y in listed for m, pair in coefficients(x, y) if m[-1] < ORDERS - 1)
    slots = max((common_degree(pair).numerator.slots for pair in each), default=0)
    return slots // SLOTS - whole
