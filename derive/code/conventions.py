"""What a reader of the emitted files must know: frames, and what each part of the state means."""

from __future__ import annotations

from collections.abc import Sequence

from ..algebra.groups import Group


def conventions(group: Group, inputs: Sequence[str]) -> tuple[str, ...]:
    """One sentence each, in plain ASCII."""
    n = group.n
    lines = [
        f"A is {n} x {n}, row by row: a point r of the body stands at A r"
        + (" + T in space." if group.affine else " in space."),
    ]
    if "orthogonal" in group.relations and n == 3:
        lines.append(
            "zeta is the angular velocity in the body frame: dA/dt = A j(zeta), j(x) y = x cross y."
        )
        if group.affine:
            lines.append(
                "w is the velocity of the body's origin (r = 0) in the body frame: dT/dt = A w."
            )
    else:
        lines.append("zeta are the coordinates of Z = A^-1 dA/dt in the basis below.")
    return (*lines, *_inputs(group, inputs))


def _inputs(group: Group, inputs: Sequence[str]) -> list[str]:
    if not inputs:
        return []
    rotation = "orthogonal" in group.relations and group.n == 3
    if rotation and group.affine:
        first, last = ", ".join(inputs[:3]), ", ".join(inputs[3:])
        return [
            f"Input: ({first}) is a moment about the body's origin and ({last}) a force on it,",
            "both in the body frame; their power is <moment, zeta> + <force, w>.",
        ]
    if rotation:
        names = ", ".join(inputs)
        return [f"Input: ({names}) is a torque about the fixed point, in the body frame."]
    return ["Input: a covector of the Lie algebra; its power is the sum of u_a zeta_a."]
