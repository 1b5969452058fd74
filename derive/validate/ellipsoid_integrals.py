"""Integrals over an ellipsoid in emitted code: functions, whose values are those of the checker.

The emitted function that computes them, by an iteration, is not read: of its numbers nothing is
known here but the arguments.  An integral is a sum over the same random places as in the record.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..check.kinds.self_gravity_checked import at_invariants, nodes
from .degree_bounds import Measured

NAME = "ellipsoid"


@dataclass(frozen=True)
class WithIntegrals:
    """Elementary functions, and ``ellipsoid`` of three numbers, of whose results ``ellipsoid_k`` is
    one; ``drawn``: random numbers by a name and k; ``measured``: do numbers carry degrees?"""

    elementary: Callable[[str, Any], Any]
    drawn: Callable[[str, int], Any]
    measured: bool = False

    def __call__(self, name: str, *x: Any) -> Any:
        """The value of a function."""
        if name == NAME:
            return x
        if not name.startswith(NAME):
            return self.elementary(name, *x)
        pairs = ((self._number(w), self._number(u)) for w, u in nodes(self.drawn))
        (invariants,), which = x, int(name.removeprefix(f"{NAME}_"))
        return at_invariants(pairs, invariants, which, lambda y: self.elementary("sqrt", y))

    def _number(self, x: Any) -> Any:
        return Measured(x, 1) if self.measured else x
