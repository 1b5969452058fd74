"""The motion of a Lagrangian ℓ(t, g, Z) by Euler and Lagrange, in coordinates g = g₀ exp q.

No bracket and no structure constant is used: ℓ is a function of (t, q, q̇) by matrices alone, its
derivatives are those of JAX.  At q = 0 the acceleration q̈ is the rate of the coordinates of Z.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np


def motion(
    lagrangian: Callable[[Any, Any, Any], Any],
    basis: Any,
    t: float,
    g: Any,
    zeta: Any,
    covector: Any = 0.0,
    *,
    right: bool = False,
) -> tuple[np.ndarray[Any, Any], float]:
    """ζ̇, d numbers, and the energy; ``lagrangian(t, g, zeta)`` in functions of ``jax.numpy``;
    basis d × s × s."""
    import jax

    with jax.enable_x64(True):
        load = np.zeros(len(basis)) + covector
        rate, energy = compiled(lagrangian, right)(np.array(basis), t, g, zeta, load)
        return np.asarray(rate), float(energy)


@cache
def compiled(lagrangian: Callable[[Any, Any, Any], Any], right: bool) -> Callable[..., Any]:
    """The same as one program: operation by operation each would be compiled by itself."""
    import jax
    import jax.numpy as jnp

    def solved(E: Any, t: Any, g0: Any, velocity: Any, covector: Any) -> Any:
        d = len(E)
        flat = jnp.linalg.pinv(E.reshape(d, -1).T)

        def small(q: Any) -> Any:
            """exp q to the third order: nothing more is seen at q = 0."""
            x = jnp.tensordot(q, E, 1)
            one = jnp.eye(len(x))
            return one + x @ (one + x @ (one + x / 3) / 2)

        def of_path(x: Any) -> Any:
            t, q, q_dot = x[0], x[1 : d + 1], x[d + 1 :]
            h, rate = jax.jvp(small, (q,), (q_dot,))
            back = small(-q)
            Z = rate @ back if right else back @ rate
            return lagrangian(t, h @ g0 if right else g0 @ h, flat @ Z.reshape(-1))

        place = jnp.concatenate([jnp.array([t]), jnp.zeros(d), velocity])
        along = jnp.concatenate([jnp.ones(1), velocity, jnp.zeros(d)])
        value, slope = jax.value_and_grad(of_path)(place)
        second = jax.hessian(of_path)(place)
        load = slope[1 : d + 1] + covector - (second @ along)[d + 1 :]
        rate = jnp.linalg.solve(second[d + 1 :, d + 1 :], load)
        return rate, slope[d + 1 :] @ velocity - value

    return jax.jit(solved)
