"""The functions of ``momenta=True`` of a compiled problem: the motion in momenta."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import numpy as np

Array = np.ndarray[Any, np.dtype[np.float64]]


class InMomenta:
    """What a compiled problem has of a state y, with momenta in the place of the velocity."""

    STATE: tuple[str, ...]
    REDUCED: int
    """The variables of the Poisson tensor."""

    @abstractmethod
    def _in_momenta(self, what: str, t: float, x: Any, u: Any, out: Array) -> int:
        """Call a C function of the time, a state, constants and inputs, which writes ``out``."""

    def momentum(self, t: float, x: Any) -> Array:
        """The state x with its momenta in the place of the velocity; needs ``momenta=True``."""
        return self._written("momentum", t, x)

    def velocity(self, t: float, y: Any) -> Array:
        """The state y, with momenta, with its velocity in their place; ``ArithmeticError`` where
        Newton's method does not find it."""
        return self._written("velocity", t, y)

    def momentum_rhs(self, t: float, y: Any, u: Any = None) -> Array:
        """dy/dt, y the state with momenta; ``ArithmeticError`` as that of :meth:`velocity`."""
        return self._written("momentum_rhs", t, y, u)

    def poisson(self, t: float, y: Any) -> Array:
        """The matrix of the Poisson brackets of the momenta, and of what is carried along."""
        out = np.zeros((self.REDUCED, self.REDUCED))
        self._in_momenta("poisson", t, y, None, out)
        return out

    def _written(self, what: str, t: float, x: Any, u: Any = None) -> Array:
        out = np.zeros(len(self.STATE))
        if self._in_momenta(what, t, x, u, out):
            raise ArithmeticError("no velocity is found that has these momenta")
        return out
