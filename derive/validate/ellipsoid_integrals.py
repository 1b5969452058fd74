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
from .terms import CodeError

NAME = "ellipsoid"
BUNDLES = {
    NAME: ((0, 1), (0, 3), (1, 3), (2, 3)),
    f"{NAME}_slopes": tuple((k, 5) for k in range(5)),
}
"""Function → the exponents k and 2s of its integrals ∫ u^k P^(−s) du."""
MOST = 5
"""So many has one at most."""


@dataclass(frozen=True)
class WithIntegrals:
    """Elementary functions, and those of ``BUNDLES`` of three numbers, of whose results
    ``ellipsoid_k`` is one; ``drawn``: random numbers by a name and k; ``measured``: do numbers
    carry degrees?"""

    elementary: Callable[[str, Any], Any]
    drawn: Callable[[str, int], Any]
    measured: bool = False

    def __call__(self, name: str, *x: Any) -> Any:
        """The value of a function."""
        if name in BUNDLES:
            return BUNDLES[name], x
        if not name.startswith(NAME):
            return self.elementary(name, *x)
        pairs = ((self._number(w), self._number(u)) for w, u in nodes(self.drawn))
        ((exponents, invariants),), place = x, int(name.removeprefix(f"{NAME}_"))
        if place >= len(exponents):
            raise CodeError(f"of the integrals there is none at place {place}")
        k, halves = exponents[place]
        return at_invariants(pairs, invariants, k, halves, lambda y: self.elementary("sqrt", y))

    def _number(self, x: Any) -> Any:
        return Measured(x, 1) if self.measured else x
