"""The added mass of a body in water, the operator of inertia less that of a rigid body: is it left
out, or taken otherwise, in the mass matrix, in the Coriolis terms or in both?"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from .balance import Balance, turning
from .told import FACTORS, SIMPLE, Hypothesis
from .users_code import Array


def of_added_mass(b: Balance) -> Iterator[Hypothesis]:
    """Of an operator that is the same in every state: what a factor s of the added mass adds is
    (s − 1) (P(M) − P(R)), P linear in the operator; the R of a rigid body is fitted."""
    problem = b.opened.problem
    if problem.lagrangian is None or not b.is_frame:
        return
    operators = b.code.mass_matrix(b.t, b.x, b.k(b.values()))
    M = operators[0]
    if np.abs(operators - M).max() > 1e-12 * np.abs(M).max():
        return
    rigid = rigid_bodies(len(b.rows["force"]))
    for words, part in parts(b).items():
        columns = np.stack([part(R).ravel() for R in rigid], axis=1)
        scale = np.abs(columns).max(axis=0)
        known, used = part(M), scale > 0
        for s in FACTORS:
            wanted = known - b.unexplained / (1 - s)
            numbers = np.zeros(len(rigid))
            fit = np.linalg.lstsq(columns[:, used] / scale[used], wanted.ravel(), rcond=1e-9)
            numbers[used] = fit[0] / scale[used]
            left = b.unexplained - (1 - s) * (known - part(np.tensordot(numbers, rigid, 1)))
            dry = f" of mass {numbers[0]:.6g}" if used[0] else ""
            if not used[0] or numbers[0] > 1e-9 * np.abs(M).max():
                rest = f"the rest is that of a rigid body{dry}"
                yield Hypothesis(f"{words} {SIMPLE[s]}: {rest}", 2, left)


def rigid_bodies(n: int) -> Array:
    """The operators of a mass, of each first moment, and of each entry of the tensor."""
    turns = 3 if n == 3 else 1
    found = [np.diag([0.0] * turns + [1.0] * n)]
    for c in np.eye(n):
        # ω × c is D ω, and v · D ω is in the energy
        D = np.stack([turning(w, c) for w in np.eye(turns)], axis=1)
        found.append(np.block([[np.zeros((turns, turns)), D.T], [D, np.zeros((n, n))]]))
    for i in range(turns):
        for j in range(i, turns):
            R = np.zeros((turns + n, turns + n))
            R[i, j] = R[j, i] = 1
            found.append(R)
    return np.array(found)


def parts(b: Balance) -> dict[str, Callable[[Array], Array]]:
    """What an operator makes in M a + b, in words."""
    ζ = np.hstack(b.velocities())

    def coriolis(K: Array) -> Array:
        return np.asarray(sum(b.coadjoint(ζ @ K).values()))

    return {
        "C_A(ν)ν, of the added mass,": coriolis,
        "v × p of the added mass": lambda K: b.coadjoint(ζ @ K)["v × p"],
        "the added mass in the mass matrix": lambda K: b.a @ K,
        "the added mass": lambda K: b.a @ K + coriolis(K),
    }
