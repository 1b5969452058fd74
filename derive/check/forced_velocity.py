"""That dϖ forces the velocity of X: variations of the velocity alone pair with ξ(X) − Z by the
metric, so that the kernel of this pairing is {ξ(X) = Z} where the metric is not degenerate."""

from __future__ import annotations

from fractions import Fraction

from ..language import rational as q
from ..record.record import Equation, Step
from .lagrangian.lagrangian_model import LagrangianModel
from .locus import part_of_velocity
from .model import Direction, Model


def states_velocity(equation: Equation) -> bool:
    """Does the equation say what part of the velocity of X is, as δA(X) = α?"""
    return bool(part_of_velocity(equation.lhs, equation.rhs))


def concludes_velocity(step: Step) -> bool:
    """Does a step conclude a part of the velocity of X, which is then put in?"""
    return any(states_velocity(e) and e in step.given for e in step.equations)


def unforced_velocity(model: Model | LagrangianModel) -> str:
    """Why dϖ(X, δ′) = 0 for every δ′ with δ′t = 0 and δ′g = 0 does not force ξ(X) = Z at a point,
    in words; "" where it does.

    dϖ(X, δ′) = −⟨ξ(X) − Z, δ′Z⟩ is tried for random ξ(X) and δ′Z in 𝔤, and the rank of the metric
    taken.
    """
    x, y = model.mixed.xi, model.second.velocity
    nothing = q.scaled(Fraction(0), y)
    moving = Direction(Fraction(1), q.plus(model.Z, x), model.first.velocity)
    paired = model.exterior(moving, Direction(Fraction(0), nothing, y))
    row, column = (q.column(model.group.nearest(z)) for z in (x, y))
    ((metric,),) = q.times(q.times(q.transposed(row), model.metric), column)
    if paired != -metric:
        return "variations of the velocity do not pair with that of X by the metric"
    singular = q.rank(model.metric) < model.group.dimension
    return "other velocities of X are in the kernel of dϖ, too" if singular else ""
