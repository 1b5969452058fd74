"""Products of vectors at many states, in space and in the plane."""

from __future__ import annotations

from typing import Any

import numpy as np

from .users_code import Array


def cross(a: Array, b: Array) -> Array:
    """a × b of vectors of space; in the plane the number of it, (…, 1)."""
    if b.shape[-1] == 3:
        return np.asarray(np.cross(a, b))
    return np.asarray(a[..., :1] * b[..., 1:] - a[..., 1:] * b[..., :1])


def turning(w: Array, r: Array) -> Array:
    """ω × r, in the plane of the number ω, (…, 1)."""
    if r.shape[-1] == 3:
        return np.asarray(np.cross(w, r))
    return np.asarray(w * np.stack([-r[..., 1], r[..., 0]], axis=-1))


def through(to: Any, vectors: Array) -> Array:
    """Vectors, (N, d) or (d,), as a matrix takes them, one for all or one for each state."""
    return np.asarray(np.einsum("...ij,...j->...i", to, vectors))


def hats(r: Array) -> Array:
    """The matrices of r × of vectors in space, (N, 3, 3)."""
    return np.asarray(np.cross(r[:, None, :], np.eye(3)).transpose(0, 2, 1))


def coadjoint(velocity: Array, momenta: Array, turns: int) -> dict[str, Array]:
    """What momenta π, p (N, d) of a body make in its equations by Kirchhoff's, about the origin; of
    its velocity the first ``turns`` are ω, the others v."""
    (w, v), (spin, p) = (np.split(x, [turns], axis=1) for x in (velocity, momenta))
    none = np.zeros_like(velocity)
    spun = np.cross(w, spin) if turns == 3 else none[:, :turns]
    found = {"ω × π": np.hstack([spun, none[:, turns:]])}
    if v.shape[1]:
        found["v × p"] = np.hstack([cross(v, p), none[:, turns:]])
        found["ω × p"] = np.hstack([none[:, :turns], turning(w, p)])
    return found
