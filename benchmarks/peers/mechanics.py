"""Peers that derive the equations of a solid themselves: Pinocchio, SymPy's Kane, CasADi from L."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np

from .cases import HERE, Array, Case, library
from .equations import add, cross, dot, flip, less, nine, on, symmetric, three, times, upper
from .generators import casadi_native, headers, sympy_native
from .native import Native, copy, pointer
from .oracle import basis

# as Pinocchio's own CMake files define them
BOOST = [
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
]


def solid(case: Case) -> Array:
    """m, the centre of mass, the central inertia, gravity, then k, b, a of the free solid."""
    m, s = case.values["m"], case.vector("c") / case.values["m"]
    J = case.moments - m * np.outer(s, s)
    parts = [np.array([m]), s, upper(np.trace(J) * np.eye(3) - J), case.vector("g")]
    if case.name == "p2":
        parts += [np.array([case.values["k"]]), case.vector("b"), case.vector("a")]
    return np.concatenate(parts)


def quaternions(A: Array) -> Array:
    """x, y, z, w of rotations: the eigenvector of 1 of a matrix linear in A."""
    K, trace = np.empty((len(A), 4, 4)), np.trace(A, axis1=1, axis2=2)
    K[:, :3, :3] = A + A.transpose(0, 2, 1) - trace[:, None, None] * np.eye(3)
    K[:, :3, 3] = K[:, 3, :3] = np.stack(
        [A[:, 2, 1] - A[:, 1, 2], A[:, 0, 2] - A[:, 2, 0], A[:, 1, 0] - A[:, 0, 1]], axis=1
    )
    K[:, 3, 3] = trace
    return np.asarray(np.linalg.eigh(K)[1][:, :, -1])


def pinocchio(case: Case, states: Array, folder: Path) -> Native:
    """Pinocchio's ABA; its state holds a quaternion, and Ȧ and Ṫ are not asked of it."""
    if case.name == "p3":
        raise RuntimeError("not a rigid body")
    k, turn = solid(case), quaternions(states[:, :9].reshape(-1, 3, 3))
    free = case.name == "p2"
    moved = [states[:, 9:12], turn, states[:, 15:], states[:, 12:15]]
    native = Native(
        name="Pinocchio ABA",
        sources=[copy(HERE / "pinocchio.cpp", folder.parent)],
        function=f"pinocchio_{case.name}",
        constants=k,
        states=np.concatenate(moved if free else [turn, states[:, 9:]], axis=1),
        outputs=6 if free else 3,
        options=[*BOOST, *headers("pinocchio/multibody.hpp", "Eigen/Core")],
        rows=list(range(12, 18) if free else range(9, 12)),
        note="accelerations alone, attitude a quaternion",
    )
    native.prepare = lambda library: library.pinocchio_setup(pointer(k), ctypes.c_int(free))
    return native


def kane(case: Case, states: Array, folder: Path) -> Native:
    """SymPy's KanesMethod with direction cosines; the inverse of its mass matrix is staged."""
    if case.name == "p3":
        raise RuntimeError("not a rigid body")
    sp = library("sympy")
    free, numbers = case.name == "p2", solid(case)
    x_, k_, method = kane_method(free, len(numbers))
    plain = {symbol: sp.Symbol(f"y{i}") for i, symbol in enumerate(x_)}
    k = list(sp.symbols(f"k:{len(numbers)}"))
    mass = np.array(method.mass_matrix.subs(dict(zip(k, numbers, strict=True))), dtype=float)
    staged = np.linalg.inv(mass)
    size = len(mass)
    symbols = {(i, j): sp.Symbol(f"n{i}{j}") for i in range(size) for j in range(i, size)}
    inverse = sp.Matrix(size, size, lambda i, j: symbols[min(i, j), max(i, j)])
    rates = method.kindiffdict()
    right = [rates[symbol.diff()] for symbol in x_[:-size]]
    right = [e.subs(plain) for e in [*right, *(inverse * method.forcing)]]
    values = np.concatenate([numbers, [staged[key] for key in symbols]])
    graph = (list(plain.values()), [*k_, *symbols.values()], right)
    return sympy_native("SymPy Kane", case, states, values, graph, folder)


def kane_method(free: bool, count: int) -> tuple[list[Any], list[Any], Any]:
    """The state, the constants and Kane's equations formed."""
    sp, me = library("sympy"), library("sympy.physics.mechanics")
    A = sp.Matrix(3, 3, me.dynamicsymbols("A:9"))
    T, w, v = (me.dynamicsymbols(f"{a}:3") for a in "Twv")
    k = sp.symbols(f"k:{count}")
    N, B = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    B.orient_explicit(N, A)

    def vector(frame: Any, entries: Any) -> Any:
        return sum((e * d for e, d in zip(entries, frame, strict=True)), me.Vector(0))

    B.set_ang_vel(N, vector(B, w))
    origin = me.Point("O")
    origin.set_vel(N, vector(B, v) if free else 0)
    G = origin.locatenew("G", vector(B, k[1:4]))
    G.v2pt_theory(origin, N, B)
    rigid = me.RigidBody("body", G, B, k[0], (me.inertia(B, k[4], k[7], k[9], k[5], k[8], k[6]), G))
    loads = [(G, k[0] * vector(N, k[10:13]))]
    hat = sp.Matrix([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    rates = list(A.diff(me.dynamicsymbols._t) - A * hat)
    if free:
        P = origin.locatenew("P", vector(B, k[14:17]))
        P.v2pt_theory(origin, N, B)
        stretch = vector(N, [t - a for t, a in zip(T, k[17:20], strict=True)])
        loads.append((P, -k[13] * (stretch + vector(B, k[14:17]))))
        rates += list(sp.Matrix(T).diff(me.dynamicsymbols._t) - A * sp.Matrix(v))
    q, u = [*A, *(T if free else [])], [*w, *(v if free else [])]
    method = me.KanesMethod(N, q_ind=q, u_ind=u, kd_eqs=rates)
    method.kanes_equations([rigid], loads)
    return [*q, *u], list(k), method


def lagrangian(case: Case, A: Any, T: Any, y: Any, k: Any) -> Any:
    """L by hand; k = m, c, J, g, k, b, a, or for four points J and K."""
    if case.name == "p3":
        Z = (three(y, 0), three(y, 3), (y[6], y[7], -(y[0] + y[4])))
        C = times(flip(A), A)
        kinetic = times(times(Z, symmetric(k, 0)), times(flip(Z), C))
        elastic = times(C, symmetric(k, 6))
        return sum(kinetic[i][i] - elastic[i][i] for i in range(3)) / 2
    w, v, c, g = three(y, 0), three(y, 3) if case.name == "p2" else None, three(k, 1), three(k, 10)
    total = dot(w, on(symmetric(k, 4), w)) / 2 + dot(g, on(A, c))
    if v is not None:
        e = less(add(T, on(A, three(k, 14))), three(k, 17))
        total += dot(w, cross(c, v)) + k[0] * (dot(v, v) / 2 + dot(g, T)) - k[13] * dot(e, e) / 2
    return total


def lagrangian_constants(case: Case) -> Array:
    """The numbers of ``lagrangian``."""
    J = case.moments
    if case.name == "p3":
        K = np.zeros((3, 3))
        for key, value in case.values.items():
            if key[0] == "k":
                d = case.places[int(key[1]) - 1] - case.places[int(key[2]) - 1]
                K += value * np.outer(d, d)
        return np.concatenate([upper(J), upper(K)])
    inertia = upper(np.trace(J) * np.eye(3) - J)
    return np.concatenate([solid(case)[:1], case.vector("c"), inertia, solid(case)[10:]])


def casadi_from_l(case: Case, states: Array, folder: Path) -> Native:
    """Euler, Poincaré: d/dt ∂L/∂ζ = ad*; CasADi differentiates, and solves at every call."""
    ca = library("casadi")
    k, E, free = lagrangian_constants(case), basis(case), case.name == "p2"
    x_, k_ = ca.SX.sym("x", case.size), ca.SX.sym("k", len(k))
    x = ca.vertsplit(x_)
    A, T = nine(x, 0), three(x, 9)
    first = case.size - len(E)
    q, y = x_[:first], x_[first:]
    L = lagrangian(case, A, T, ca.vertsplit(y), ca.vertsplit(k_))
    g = ca.SX(4, 4)
    for i in range(3):
        g[i, :] = ca.horzcat(*A[i], T[i] if free else 0)
    g[3, 3] = 1

    def tangent(m: Any) -> Any:
        moved = ca.mtimes(g, m)
        rows = [moved[i, j] for i in range(3) for j in range(3)]
        return ca.vertcat(*rows, *([moved[i, 3] for i in range(3)] if free else []))

    Z = sum(y[a] * e for a, e in enumerate(ca.DM(e) for e in E))
    momentum = ca.gradient(L, y)
    turned = coadjoint(E)
    force = [
        ca.dot(ca.gradient(L, q), tangent(ca.DM(e)))
        + sum(
            float(turned[a, b, c]) * y[b] * momentum[c]
            for b in range(len(E))
            for c in range(len(E))
            if turned[a, b, c]
        )
        for a, e in enumerate(E)
    ]
    right = ca.vertcat(*force) - ca.mtimes(ca.jacobian(momentum, q), tangent(Z))
    factors = ca.ldl(ca.hessian(L, y)[0])
    dy = ca.ldl_solve(right, *factors)
    graph = (x_, k_, ca.vertcat(tangent(Z), dy))
    return casadi_native("CasADi, from L", case, states, k, graph, folder)


def coadjoint(E: Array) -> Array:
    """[E_b, E_a] = Σ n_abc E_c."""
    size = len(E)
    brackets = np.einsum("bij,ajk->abik", E, E) - np.einsum("aij,bjk->abik", E, E)
    flat = E.reshape(size, -1)
    found = np.linalg.lstsq(flat.T, brackets.reshape(size * size, -1).T, rcond=None)[0]
    return np.asarray(np.round(found.T.reshape(size, size, size), 9))
