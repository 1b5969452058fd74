"""The principle on one jet of a curve: X is the tangent of a lift, δ varies it through lifts.

The curve and those it is varied through are one two-parameter family in the group; d/dt is its
second parameter.
"""

from __future__ import annotations

from typing import Any

from ..language import rational as q
from ..language.tree import Tree
from .arithmetic import EvaluationError
from .evaluate import Environment, point_index
from .model import Model
from .nilpotent import EPS, EPS_PRIME, Nilpotent, derivative_in, derivative_of, part

ON_TANGENT: Tree = ("call", "ϖ", "X")
ON_VARIATION: Tree = ("call", "ϖ", "δy")


def action_varied(model: Model) -> Any:
    """δ[L̃ dt(X)] = δ[ϖ(X)], by the Lagrangian alone: on each curve of the family the velocity is
    its own. ``EvaluationError`` where X is not the tangent of a lift."""
    if model.motion.xi != model.Z:
        raise EvaluationError("ϖ(X) is varied where X is the tangent of a lift")
    t, g, _ = model.family(model.first, model.motion)
    passing, velocity = derivative_in(t, EPS_PRIME), derivative_of(g, EPS_PRIME)
    t, g = _at_the_instant(t), tuple(tuple(map(_at_the_instant, row)) for row in g)
    return part(model.lagrangian(t, g, q.scaled(1 / passing, velocity)) * passing, EPS)


def rate(model: Model, what: Tree, env: Environment) -> Any:
    """d/dt along the motion of ϖ(δy), or of the place r_i(t) or the velocity v_i of a point;
    ``EvaluationError`` for any other."""
    t, g, Z = model.family(model.first, model.motion)
    nu = q.times(g, Z)
    match what:
        case ("call", ("at", "r", i), "t"):
            return part(q.column(model.moved(g)[point_index(i, env) - 1]), EPS_PRIME)
        case ("at", "v", i):
            return part(q.column(model.moved(nu)[point_index(i, env) - 1]), EPS_PRIME)
    if what != ON_VARIATION:
        raise EvaluationError("d/dt is of ϖ(δy), r_i(t) and v_i, where points give the Lagrangian")
    momentum = model.momentum(nu, derivative_of(g, EPS))
    return part(momentum - model.energy(t, g, nu) * derivative_in(t, EPS), EPS_PRIME)


def _at_the_instant(x: Any) -> Nilpotent:
    """A number at the instant itself: without its part in the parameter of d/dt."""
    return Nilpotent({k: v for k, v in Nilpotent.of(x).parts.items() if not k & EPS_PRIME})
