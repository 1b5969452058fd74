"""The checker's own account of each kind of potential: each module of this folder is one.

Each has ``KIND``, its name, and ``energy(at, p, r, masses)``, U from the places of the points, at
the time of ``at``.
Where the walk sums a kind up in words, ``values(model, members)`` says what its letters are, and
``summed(at, p)`` which ones these are of, if not of all; where it has distances,
``radial(at, p, r, masses)`` gives each of them with U as a function of its square.
``OF_BODY_AXES``: it is of the axes of the body, whose ends are then points
(``AppliedForces.body_axes``).
"""

from __future__ import annotations

import pkgutil
from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import Any


def uses_body_axes(problem: Mapping[str, Any]) -> bool:
    """Is there a potential of the axes of the body, whose ends are points to it?"""
    own = (accounts().get(p["kind"]) for p in problem.get("potentials", []))
    return any(getattr(account, "OF_BODY_AXES", False) for account in own)


@cache
def accounts() -> dict[str, Any]:
    """The module of each kind."""
    modules = [import_module(f"{__name__}.{x.name}") for x in pkgutil.iter_modules(__path__)]
    return {m.KIND: m for m in modules}
