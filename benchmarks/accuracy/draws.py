"""Random bodies and states: ordinary ones, and such as are hard on rounding.

A third of the bodies is round, a third slender or flat, by up to 10⁴ in length, a third has
extremely different masses and sizes; of the states a third is ordinary, in a third positions and
velocities are 10⁻³ to 10³ times as large, and in a third each coordinate by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

import numpy as np

from derive.algebra.groups import Group

from .terms import Array

Random = np.random.Generator
SLENDER = 4.0
DECADES = 3.0


def spread(random: Random, decades: float, *shape: int) -> Array:
    """Positive numbers of so many decades about 1."""
    return 10 ** random.uniform(-decades, decades, shape)


def rotations(random: Random, *shape: int, n: int = 3) -> Array:
    """Rotations (…, n, n), as near to orthogonal as doubles are."""
    q, r = np.linalg.qr(random.normal(size=(*shape, n, n)))
    q = q * np.sign(np.einsum("...ii->...i", r))[..., None, :]
    q[..., 0] *= np.linalg.det(q)[..., None]
    return q


# ---------------------------------------------------------------- bodies


def lengths(random: Random, count: int) -> Array:
    """The three lengths (count, 3) of round, slender or flat, and extreme bodies."""
    kind = np.arange(count) % 3
    thin = 10 ** random.uniform(-SLENDER, 0, (count, 3)) * (random.uniform(size=(count, 3)) < 0.6)
    thin = np.where(thin == 0, 1, thin)
    size = np.where(kind == 2, spread(random, DECADES, count), 1.0)[:, None]
    return random.uniform(0.5, 1, (count, 3)) * np.where(kind[:, None] == 0, 1, thin) * size


def clouds(random: Random, count: int, points: int) -> tuple[Array, Array]:
    """Masses (count, points) and places (count, points, 3) of bodies, turned at random.

    Their centre is off the origin by 10⁻³ to 10 of their length.
    """
    mass = random.uniform(0.5, 1.5, (count, points)) * spread(random, DECADES, count, 1)
    r = random.normal(size=(count, points, 3)) * lengths(random, count)[:, None, :]
    r += spread(random, 2, count, 1, 1) / 10 * np.abs(r).max(axis=(1, 2))[:, None, None]
    return mass, np.einsum("bij,bpj->bpi", rotations(random, count), r)


def moments(random: Random, names: Sequence[str], count: int) -> dict[str, Array]:
    """m, c_i, J_ij of six points; what else there is, g_i, of size 10."""
    mass, r = clouds(random, count, 6)
    found = {"m": mass.sum(axis=1)}
    found |= {f"c_{i + 1}": (mass * r[..., i]).sum(axis=1) for i in range(3)}
    found |= {
        f"J_{i + 1}{j + 1}": (mass * r[..., i] * r[..., j]).sum(axis=1)
        for i in range(3)
        for j in range(i, 3)
    }
    return {x: found[x] if x in found else 10 * random.normal(size=count) for x in names}


def four_points(random: Random, names: Sequence[str], count: int) -> dict[str, Array]:
    """m1, x1, y1, z1 … of four points and their springs."""
    mass, r = clouds(random, count, 4)
    found = {f"m{p + 1}": mass[:, p] for p in range(4)}
    found |= {f"{a}{p + 1}": r[:, p, i] for p in range(4) for i, a in enumerate("xyz")}
    return {x: found[x] if x in found else spread(random, 1, count) for x in names}


def bodies(random: Random, defaults: dict[str, float], count: int) -> dict[str, Array]:
    """Parameters (count,) by name; others than moments and four points about their defaults."""
    if "J_33" in defaults:
        return moments(random, [*defaults], count)
    if "z4" in defaults:
        return four_points(random, [*defaults], count)
    return {x: value * spread(random, 1.5, count) for x, value in defaults.items()}


# ---------------------------------------------------------------- states


def scaled(random: Random, *shape: int) -> Array:
    """Vectors (B, S, n) of the three kinds of states."""
    x, kind = random.normal(size=shape), np.arange(shape[1]) % 3
    x *= np.where(kind[:, None] == 1, spread(random, DECADES, *shape[:2], 1), 1)
    x *= np.where(kind[:, None] == 2, spread(random, DECADES, *shape), 1)
    return x


def elements(random: Random, group: Group, shape: tuple[int, int]) -> Array:
    """Linear parts (B, S, n, n); of determinant exactly 1 in SL(n), in numbers of few bits."""
    n, d = group.n, len(group.linear_basis)
    if group.relations == {"unimodular"} and d == n * n - 1:
        return _shears(random, n, shape)
    if "orthogonal" in group.relations and d == n * (n - 1) // 2:
        return rotations(random, *shape, n=n)
    basis = np.array([group.linear_part(e) for e in group.basis], dtype=float)
    found = np.broadcast_to(np.eye(n), (*shape, n, n))
    for _ in range(2):
        z = np.einsum("bsa,aij->bsij", random.normal(size=(*shape, len(basis))), basis)
        found = found @ _exponential(z / np.maximum(1, np.abs(z).max(axis=(2, 3), keepdims=True)))
    return found


def _shears(random: Random, n: int, shape: tuple[int, int]) -> Array:
    """Products of shears and of powers of 2 on the diagonal: no rounding, det = 1."""
    found = np.broadcast_to(np.eye(n), (*shape, n, n)).copy()
    for i, j in [*permutations(range(n), 2)]:
        found[..., j] += found[..., i] * (random.integers(-6, 7, shape) / 8)[..., None]
    wide = (np.arange(shape[1]) % 3 > 0)[:, None]
    powers = random.integers(-3, 4, (*shape, n)) * wide
    powers[..., -1] = -powers[..., :-1].sum(axis=-1)
    return found * 2.0 ** powers[..., None, :]


def _exponential(z: Array) -> Array:
    found = one = np.eye(z.shape[-1])
    for k in range(24, 0, -1):
        found = one + z @ found / k
    return np.asarray(found)
