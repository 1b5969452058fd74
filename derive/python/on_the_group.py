"""The functions of ``exponential=True`` of a compiled problem: those of its group."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import numpy as np

from ..code.group_functions import GroupFunctions

Array = np.ndarray[Any, np.dtype[np.float64]]


def binding(name: str, group: GroupFunctions) -> str:
    """C that is compiled beside the emitted one: the functions of its header, to be called."""
    lines = [f'#include "{name}_group.h"']
    for function, (takes, writes) in group.functions.items():
        given = ", ".join(f"const double *{x}" for x in takes)
        head = f"void derive_{function}({given}, double *{writes})"
        lines += [f"{head};", f"{head} {{ {name}_{function}({', '.join((*takes, writes))}); }}"]
    return "\n".join(lines) + "\n"


class OnTheGroup:
    """What a compiled problem has of its group G: d is its dimension, g an element as in the state
    x, which has N numbers, M of them those of g."""

    @abstractmethod
    def _on_the_group(self, what: str, *given: Any) -> Array:
        """What a C function writes of some arrays."""

    def exp(self, eta: Any) -> Array:
        """The element g, (M,), the exponential of Σ η_a E_a, η (d,)."""
        return self._on_the_group("exp", eta)

    def log(self, g: Any) -> Array:
        """The η, (d,), with exp η = g that turns by at most π; at π one of two. On groups that do
        more than turn and shift that of eigenvalues a + bi with −π < b < π; nan where one of g is
        negative or 0."""
        return self._on_the_group("log", g)

    def exp_jacobian(self, eta: Any) -> Array:
        """J, (d, d): exp(η + δ) = exp(η) exp(J δ) for small δ; exp(J δ) exp(η) where Z = ġ g⁻¹."""
        return self._on_the_group("exp_jacobian", eta)

    def log_jacobian(self, g: Any) -> Array:
        """The inverse of :meth:`exp_jacobian` at log g, (d, d)."""
        return self._on_the_group("log_jacobian", g)

    def retract(self, x: Any, eta: Any) -> Array:
        """The state, (N,), with g exp(η) in place of g and δζ added to the velocity, of (η, δζ),
        (2d,): the coordinates of :meth:`Compiled.jacobian`."""
        return self._on_the_group("retract", x, eta)

    def local(self, x: Any, y: Any) -> Array:
        """The (η, δζ), (2d,), that :meth:`retract` takes x to y by, η as :meth:`log` has it."""
        return self._on_the_group("local", x, y)

    def update_left(self, x: Any, o: Any, Y: Any, N: Any) -> Array:
        """The state, (N,), an estimate and the covariance of its error, after an observation of
        what varies of A o + V: Y, (m,), V a noise of the covariance N, (m, m)."""
        return self._on_the_group("update_left", x, o, Y, np.reshape(N, -1))

    def update_right(self, x: Any, o: Any, Y: Any, N: Any) -> Array:
        """The same for A⁻¹ o + V."""
        return self._on_the_group("update_right", x, o, Y, np.reshape(N, -1))

    def update(self, x: Any, z: Any, H: Any, N: Any) -> Array:
        """The same for any observation h: z, (m,), is what is observed less h(g), H, (m, d), its
        derivative, h(g exp ξ) = h(g) + H ξ, on the right h(exp(ξ) g).  With fewer than m numbers
        the others of z and H are 0, and 1 on the diagonal of N."""
        flat = (np.reshape(y, -1) for y in (H, N))
        return self._on_the_group("update", x, z, *flat)
