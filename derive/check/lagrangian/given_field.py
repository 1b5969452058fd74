"""A variation that is a field on R × G, and what it and an algebra carry along."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from ...algebra.groups import Group
from ...algebra.user_groups import block
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, nodes
from ...record.record import RecordError
from ..trials.phase_point import PhasePoint, TangentVector
from ..values.arithmetic import EPS, EvaluationError, is_matrix, nilpotent, part
from ..values.evaluate import evaluate

# A variation that is a field on R × G, and what it carries along: ϖ of it, along the motion too.
#
# The velocity goes with it by a two-parameter family, the motion moved by the field: no structure
# equation is used.


ARGUMENTS = ("t", "A", "π")
"""The names that the trees of a field may have."""


@dataclass(frozen=True)
class GivenField:
    """δt and δA as trees in t, A and the parameters."""

    time: Tree
    displacement: Tree

    def __post_init__(self) -> None:
        if any(x not in ARGUMENTS for x in nodes(self.displacement) if isinstance(x, str)):
            raise RecordError("a field δA is a function of t and A")

    def at(self, model: PhasePoint, t: Any, g: Matrix) -> tuple[Any, Matrix]:
        """δt and δA at a point, which may be nilpotent."""
        env = replace(model.expressions, names={"π": model.pi, "t": t, "A": g})
        moved = evaluate(self.displacement, env)
        if not is_matrix(moved):
            if self.displacement != 0:
                raise EvaluationError("δA is no matrix")
            moved = q.scaled(Fraction(0), model.g)
        return evaluate(self.time, env), moved

    def trivialised(self, model: PhasePoint, t: Any, g: Matrix, back: Matrix) -> tuple[Any, Matrix]:
        """δt, and δA carried to 𝔤."""
        time, moved = self.at(model, t, g)
        return time, model.ordered(back, moved)

    def direction(self, model: PhasePoint) -> TangentVector:
        """The variation at the point of the model; ``EvaluationError`` where it is not tangent to
        the group, or δt not constant."""
        back = q.inverted(model.g)
        time, xi = self.trivialised(model, model.t, model.g, back)
        ahead, _ = model.displaced((nilpotent(EPS), model.Z))
        later, ahead = model.t + nilpotent(EPS), model.ordered(model.g, ahead)
        _, moved = self.at(model, later, ahead)  # ∂ₛ of g(s) + εδA(s) is the velocity there
        rate = model.ordered(back, part(moved, EPS))
        velocity = q.minus(rate, model.ordered(xi, model.Z))
        if any(isinstance(x, str) for x in nodes(self.time)):
            raise RecordError("δt of a field is constant")
        if not model.graded and None in map(model.group.vee, (xi, velocity)):
            raise EvaluationError("the field is not tangent to the group")
        return TangentVector(time, xi, velocity)

    def rate(self, model: PhasePoint, subtracted: tuple[Tree, ...]) -> Any:
        """d/dt of ϖ of the field, and of functions of t and A added to it, along the motion."""
        t, g, Z, *_ = model.onward
        time, xi = self.trivialised(model, t, g, model.undone(model.onward))
        total = model.momentum(t, g, Z, xi) - model.energy(t, g, Z) * time
        env = replace(model.expressions, names={"π": model.pi, "t": t, "A": g})
        for x in subtracted:
            total = total + evaluate(x, env)
        return part(total, EPS)


# What an algebra carries along, at an exact point: Γ with ρ(g)^ε Γ = Γ₀, no rule of δΓ used.


class CarriedAlong:
    """Γ as a function of g near 1; ``start``: Γ₀, a column of any numbers."""

    def __init__(self, problem: Mapping[str, Any], group: Group, side: str):
        size = sum(x["size"] for x in problem["advected"])
        self.rows, self.side = range(group.n - size, group.n), side
        self.start: Matrix = ()

    def at(self, g: Matrix) -> Matrix:
        """ρ(g)⁻¹Γ₀ on the left, ρ(g)Γ₀ on the right; ρ(g) is a block of g."""
        if not self.rows:
            return ()
        whole = block(g, self.rows)
        return q.times(near_one(whole) if self.side == "left" else whole, self.start)


def near_one(m: Matrix) -> Matrix:
    """The inverse of 1 + x, x nilpotent in three parameters: 1 − x + x² − x³."""
    one = q.identity(len(m))
    x = q.minus(one, m)
    found = one
    for _ in range(3):
        found = q.plus(one, q.times(x, found))
    return found
