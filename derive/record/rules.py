"""The vocabulary of rules: what a step may say it did, one sentence each."""

from __future__ import annotations

RULES: dict[str, str] = {
    "definition": "A name is given to an expression.",
    "variation": "The derivation δ is applied: product rule on words.",
    "pull-back": "The motion by the group is substituted and summed over the points.",
    "fibre derivative": "The Lagrangian is differentiated along the velocity.",
    "Legendre transform": "The momentum is paired with the velocity, less the Lagrangian.",
    "Cartan form": "Momentum on the displacement, less energy on the time.",
    "exterior derivative": "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)].",
    "restriction": "Some variations are set to zero.",
    "trivialisation": "Tangent vectors are carried to the identity by g⁻¹.",
    "structure equation": "δ(δ′g) = δ′(δg), read in the trivialisation.",
    "contraction": "A vector is put into dϖ.",
    "kernel": "The coefficient of each free variation must vanish.",
    "relation": "A relation of the group is used.",
    "identification": "so(3) is written as R³ by the operator j.",
    "elimination": "One unknown is solved for and put into the other equations.",
    "multiplier": "An element orthogonal to the Lie algebra is a multiplier of its constraint.",
    "input": "A given force, outside dϖ, is added to the equations.",
    "coordinates": "A basis of the Lie algebra is chosen.",
    "conservation": "The Cartan form is constant on a displacement that leaves it alone.",
    "solution": "The equations are solved for the accelerations.",
}
