"""The right answers by d'Alembert's principle on the points themselves; shares no code with derive.

A point r of the body stands at A r + T.  In homogeneous coordinates its velocity is g Z r, its
acceleration g (Z² + Ż) r; for every direction E of the Lie algebra Σ ⟨m a − F, g E r⟩ = 0.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from .cases import Array, Case


def unit(i: int, j: int) -> Array:
    """A single 1, in row i and column j of a 4 x 4 matrix, counted from 0."""
    e = np.zeros((4, 4))
    e[i, j] = 1
    return e


def basis(case: Case) -> Array:
    """The directions of the velocities, in the order of the state."""
    if case.name == "p3":
        places = [(i, j) for i in range(3) for j in range(3)][:-1]
        return np.array([unit(i, j) - (i == j) * unit(2, 2) for i, j in places])
    turns = [unit(2, 1) - unit(1, 2), unit(0, 2) - unit(2, 0), unit(1, 0) - unit(0, 1)]
    shifts = [unit(i, 3) for i in range(3)] if case.name == "p2" else []
    return np.array(turns + shifts)


def forces(case: Case, g: Array) -> list[tuple[Array, Array]]:
    """Forces in space on places of the body (homogeneous), for the matrices g of many states."""
    places = np.c_[case.places, np.ones(len(case.places))]
    found: list[tuple[Array, Array]] = []
    if case.name == "p3":
        for i, j in combinations(range(4), 2):
            pull = -case.values[f"k{i + 1}{j + 1}"] * (g @ (places[i] - places[j]))
            found += [(places[i], pull), (places[j], -pull)]
        return found
    gravity = np.append(case.vector("g"), 0)
    for mass, place in zip(case.masses, places, strict=True):
        found.append((place, np.broadcast_to(mass * gravity, (len(g), 4))))
    if case.name == "p2":
        b, a = np.append(case.vector("b"), 1), np.append(case.vector("a"), 1)
        found.append((b, -case.values["k"] * (g @ b - a)))
    return found


def derivative(case: Case, x: Array) -> Array:
    """dx/dt of many states, one a row."""
    E, places = basis(case), np.c_[case.places, np.ones(len(case.places))]
    g = np.zeros((len(x), 4, 4))
    g[:, :3, :3], g[:, 3, 3] = x[:, :9].reshape(-1, 3, 3), 1
    if case.name == "p2":
        g[:, :3, 3] = x[:, 9:12]
    velocity = x[:, x.shape[1] - len(E) :]
    Z = np.einsum("na,aij->nij", velocity, E)
    moves = np.einsum("nij,ajk,pk->npai", g, E, places)
    mass = np.einsum("p,npai,npbi->nab", case.masses, moves, moves)
    bias = np.einsum("nij,njk,nkl,pl->npi", g, Z, Z, places)
    force = -np.einsum("p,npai,npi->na", case.masses, moves, bias)
    for place, push in forces(case, g):
        force += np.einsum("nij,ajk,k,ni->na", g, E, place, push)
    acceleration = np.linalg.solve(mass, force[..., None])[..., 0]
    moved = g @ Z
    shift = [moved[:, :3, 3]] if case.name == "p2" else []
    return np.concatenate([moved[:, :3, :3].reshape(-1, 9), *shift, acceleration], axis=1)
