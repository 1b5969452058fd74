"""The equations on the group as one writes them by hand, for any type of scalar.

Every generator of code is given these, with all that depends on the parameters alone staged in k:
symbols of CasADi, SymForce, wrenfold or SymPy, arrays of JAX, and numbers under Numba.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .cases import Array, Case

Vector = tuple[Any, Any, Any]
Matrix = tuple[Vector, Vector, Vector]


def dot(a: Vector, b: Vector) -> Any:
    """⟨a, b⟩."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """a ∧ b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def add(a: Vector, b: Vector) -> Vector:
    """a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def less(a: Vector, b: Vector) -> Vector:
    """a − b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(s: Any, a: Vector) -> Vector:
    """s a."""
    return (s * a[0], s * a[1], s * a[2])


def flip(m: Matrix) -> Matrix:
    """The transpose."""
    return (
        (m[0][0], m[1][0], m[2][0]),
        (m[0][1], m[1][1], m[2][1]),
        (m[0][2], m[1][2], m[2][2]),
    )


def on(m: Matrix, a: Vector) -> Vector:
    """m a."""
    return (dot(m[0], a), dot(m[1], a), dot(m[2], a))


def times(m: Matrix, n: Matrix) -> Matrix:
    """m n."""
    f = flip(n)
    return (on(f, m[0]), on(f, m[1]), on(f, m[2]))


def symmetric(k: Any, i: int) -> Matrix:
    """The matrix with the entries 11 12 13 22 23 33 from k[i]."""
    return (
        (k[i], k[i + 1], k[i + 2]),
        (k[i + 1], k[i + 3], k[i + 4]),
        (k[i + 2], k[i + 4], k[i + 5]),
    )


def three(k: Any, i: int) -> Vector:
    """Three numbers from k[i]."""
    return (k[i], k[i + 1], k[i + 2])


def nine(k: Any, i: int) -> Matrix:
    """The matrix with its rows from k[i]."""
    return (three(k, i), three(k, i + 3), three(k, i + 6))


def p1(x: Any, k: Any) -> Any:
    """Iζ̇ = Iζ ∧ ζ + c ∧ Aᵀg; k = I, I⁻¹, c, g."""
    A, w = nine(x, 0), three(x, 9)
    moment = add(cross(on(symmetric(k, 0), w), w), cross(three(k, 12), on(flip(A), three(k, 15))))
    turn = on(symmetric(k, 6), moment)
    return cross(A[0], w) + cross(A[1], w) + cross(A[2], w) + turn


def p2(x: Any, k: Any) -> Any:
    """About the centre of mass s; k = I, I⁻¹, s, b, a, g, k(s − b), k/m."""
    A, T, w, v = nine(x, 0), three(x, 9), three(x, 12), three(x, 15)
    s, down = three(k, 12), flip(A)
    e = add(three(k, 15), on(down, less(T, three(k, 18))))
    moment = add(cross(on(symmetric(k, 0), w), w), cross(three(k, 24), e))
    turn = on(symmetric(k, 6), moment)
    force = less(on(down, three(k, 21)), scale(k[27], e))
    push = add(add(cross(add(v, cross(w, s)), w), force), cross(s, turn))
    return cross(A[0], w) + cross(A[1], w) + cross(A[2], w) + on(A, v) + turn + push


def p3(x: Any, k: Any) -> Any:
    """Ż = θ C⁻¹J⁻¹ − Z² − KJ⁻¹ without trace; k = J⁻¹, KJ⁻¹ by rows, its trace."""
    A = nine(x, 0)
    Z = (three(x, 9), three(x, 12), (x[15], x[16], -(x[9] + x[13])))
    C = times(flip(A), A)
    D = (cross(C[1], C[2]), cross(C[2], C[0]), cross(C[0], C[1]))
    G, S, move = times(D, symmetric(k, 0)), times(Z, Z), times(A, Z)
    by = (k[15] + S[0][0] + S[1][1] + S[2][2]) / (G[0][0] + G[1][1] + G[2][2])
    first = less(less(scale(by, G[0]), S[0]), three(k, 6))
    second = less(less(scale(by, G[1]), S[1]), three(k, 9))
    third = less(less(scale(by, G[2]), S[2]), three(k, 12))
    return move[0] + move[1] + move[2] + first + second + (third[0], third[1])


EQUATIONS: dict[str, Callable[[Any, Any], Sequence[Any]]] = {"p1": p1, "p2": p2, "p3": p3}


def upper(m: Array) -> Array:
    """The entries 11 12 13 22 23 33."""
    return np.asarray(m[np.triu_indices(3)])


def constants(case: Case) -> Array:
    """The numbers k that the equations ask for."""
    J = case.moments
    if case.name == "p1":
        inertia = np.trace(J) * np.eye(3) - J
        parts = [upper(inertia), upper(np.linalg.inv(inertia)), case.vector("c"), case.vector("g")]
        return np.concatenate(parts)
    if case.name == "p2":
        m, k, s = case.values["m"], case.values["k"], case.vector("c") / case.values["m"]
        J = J - m * np.outer(s, s)
        inertia, b = np.trace(J) * np.eye(3) - J, case.vector("b")
        parts = [upper(inertia), upper(np.linalg.inv(inertia)), s, b, case.vector("a")]
        return np.concatenate([*parts, case.vector("g"), k * (s - b), [k / m]])
    K = np.zeros((3, 3))
    for i in range(4):
        for j in range(i + 1, 4):
            d = case.places[i] - case.places[j]
            K += case.values[f"k{i + 1}{j + 1}"] * np.outer(d, d)
    inverse = np.asarray(np.linalg.inv(J), dtype=np.float64)
    return np.concatenate([upper(inverse), (K @ inverse).ravel(), [np.trace(K @ inverse)]])
