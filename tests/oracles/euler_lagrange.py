"""The acceleration of a Lagrangian ℓ(t, g, Z) by Euler and Lagrange, in coordinates g = g₀ exp q.

No bracket and no structure constant is used: ℓ is a function of (t, q, q̇) by matrices alone, its
derivatives are those of JAX.  At q = 0 the acceleration q̈ is the rate of the coordinates of Z.
"""

from collections.abc import Callable
from typing import Any

import numpy as np


def acceleration(
    lagrangian: Callable[[Any, Any, Any], Any],
    basis: Any,
    t: float,
    g: Any,
    zeta: Any,
    covector: Any = 0.0,
    *,
    right: bool = False,
) -> np.ndarray[Any, Any]:
    """ζ̇, d numbers; ``lagrangian(t, g, zeta)`` in functions of ``jax.numpy``; basis d × s × s."""
    import jax
    import jax.numpy as jnp

    with jax.enable_x64(True):
        E, g0 = jnp.asarray(basis), jnp.asarray(g)
        flat = jnp.linalg.pinv(E.reshape(len(E), -1).T)

        def small(q: Any) -> Any:
            """exp q to the third order: nothing more is seen at q = 0."""
            x = jnp.tensordot(q, E, 1)
            one = jnp.eye(len(x))
            return one + x @ (one + x @ (one + x / 3) / 2)

        def of_path(t: Any, q: Any, q_dot: Any) -> Any:
            h, rate = jax.jvp(small, (q,), (q_dot,))
            back = small(-q)
            Z = rate @ back if right else back @ rate
            return lagrangian(t, h @ g0 if right else g0 @ h, flat @ Z.reshape(-1))

        q, velocity = jnp.zeros(len(E)), jnp.asarray(zeta)
        pushed = jax.grad(of_path, 2)
        mass = jax.jacfwd(pushed, 2)(t, q, velocity)
        load = jax.grad(of_path, 1)(t, q, velocity) + jnp.asarray(covector)
        load = load - jax.jacfwd(pushed, 1)(t, q, velocity) @ velocity
        load = load - jax.jacfwd(pushed, 0)(t, q, velocity)
        return np.asarray(jnp.linalg.solve(mass, load))
