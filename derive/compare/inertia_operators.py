"""What may be otherwise in an operator of inertia: the added mass of a body in water, which is it
less that of a rigid body, left out or of the other sign; or the part of ω, that of v, or what
couples them, along other axes, exchanged, or with a factor; in the mass matrix, in the Coriolis
terms or in both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations, product

import numpy as np

from .balance import Balance
from .cross_products import coadjoint, through, turning
from .newton_euler import IN_MASS
from .told import FACTORS, SIMPLE, Hypothesis, changed
from .users_code import Array

OF_ADDED_MASS = (
    "C_A(ν)ν, of the added mass,",
    "v × p of the added mass",
    "the added mass in the mass matrix",
    "the added mass",
)
"""What is left out, by the places of ``parts``."""


def constant_operator(b: Balance) -> Array | None:
    """The operator of a body that no points make, (d, d), where it is the same in every state."""
    lagrangian = b.opened.problem.lagrangian
    if lagrangian is None or lagrangian.trivialisation != "left" or not b.is_frame:
        return None
    operators = b.mass(b.values())
    same = np.abs(operators - operators[0]).max() <= 1e-12 * np.abs(operators[0]).max()
    return np.asarray(operators[0]) if same else None


def of_added_mass(b: Balance) -> Iterator[Hypothesis]:
    """Of an operator that is the same in every state: what a factor s of the added mass adds is
    (s − 1) (P(M) − P(R)), P linear in the operator; the R of a rigid body is fitted."""
    M = constant_operator(b)
    if M is None:
        return
    rigid = rigid_bodies(len(b.rows["force"]))
    for words, part in zip(OF_ADDED_MASS, parts(b).values(), strict=True):
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
    """What an operator, or one for each state, makes in M a + b, by the place in words."""
    ζ, turns = np.hstack(b.velocities()), len(b.rows["moment"])

    def coriolis(K: Array) -> Array:
        return np.asarray(sum(coadjoint(ζ, through(K, ζ), turns).values()))

    return {
        " in the momenta π, p of the Coriolis terms alone": coriolis,
        " in v × p alone": lambda K: coadjoint(ζ, through(K, ζ), turns)["v × p"],
        IN_MASS: lambda K: through(K, b.a),
        "": lambda K: through(K, b.a) + coriolis(K),
    }


def of_blocks(b: Balance) -> Iterator[Hypothesis]:
    """The operator, or its part of ω, of v, or what couples these, is another in a place."""
    M = constant_operator(b)
    if M is None:
        return
    turns, w, v = len(b.rows["moment"]), np.zeros_like(M), np.zeros_like(M)
    scale = float(np.abs(M).max())
    w[:turns, :turns], v[turns:, turns:] = M[:turns, :turns], M[turns:, turns:]
    blocks = {"the ω-part of": w, "the v-part of": v, "what couples ω and v in": M - w - v, "": M}
    every = ((f"{words} the operator of inertia".strip(), x) for words, x in blocks.items())
    for (place, part), (words, own) in product(parts(b).items(), [x for x in every if x[1].any()]):
        of, seen = part(own), [own]
        square = float((of * of).sum())
        if own is not M and square:
            factor = 1 - float((of * b.unexplained).sum()) / square
            told, rank = changed(words + place, factor, {})
            seen.append(factor * own)
            # without a mass no acceleration follows: that explains every code where nothing acts
            mass = M + (factor - 1) * own
            regular = np.linalg.matrix_rank(mass, tol=1e-9 * scale) == len(M)
            if regular or place not in (IN_MASS, ""):
                yield Hypothesis(told, rank + 1, b.unexplained + (factor - 1) * of)
        for said, other in others(b, own):
            if not any(np.allclose(other, x, rtol=1e-12, atol=1e-12 * scale) for x in seen):
                seen.append(other)
                left = b.unexplained + part(other) - of
                yield Hypothesis(f"{words}{place} {said}", 1 + bool(place), left)


def others(b: Balance, K: Array) -> Iterator[tuple[str, Array]]:
    """An operator, or a part of it, along the axes of space, transposed, or with two axes
    exchanged, on both sides or on one, in words; where ω comes after v."""
    turns, n = len(b.rows["moment"]), len(b.rows["force"])
    one, A, v = np.tile(np.eye(turns + n), (len(b.x), 1, 1)), b.turns(), slice(turns, None)
    # in the plane a turn leaves ω as it is
    w = slice(0, turns if turns == n else 0)
    sides: dict[str, tuple[slice, ...]] = {"": (w, v)}
    coupling = K[:turns, turns:]
    if coupling.any():
        sides |= {", on the side of ω": (w,), ", on the side of v": (v,)}
    for side, turned in sides.items():
        for said, turn in ((IN_SPACE, A), (BY_A, A.transpose(0, 2, 1))):
            R = one.copy()
            for x in turned:
                R[:, x, x] = turn if x.start or x.stop else R[:, x, x]
            yield f"{said}{side}", R.transpose(0, 2, 1) @ K @ R
        for i, j in combinations(range(n), 2):
            order = np.arange(turns + n)
            for x in turned:
                at = order[x]
                at[[i, j][: len(at)]] = at[[j, i][: len(at)]]
            yield f"has the axes {i + 1} and {j + 1} exchanged{side}", K[np.ix_(order, order)]
    if turns == n:
        order = np.roll(np.arange(2 * n), n)
        parts = K[:n, :n].any(), K[n:, n:].any()
        if all(parts):
            yield "has v before ω", K[np.ix_(order, order)]
        if not any(parts):
            yield "is transposed", K[np.ix_(order, order)]


IN_SPACE = "has its numbers along the axes of space instead"
BY_A = "is turned by A, as to the axes of space, where its numbers are along the body's"
