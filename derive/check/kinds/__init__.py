"""The checker's own account of each kind of potential: each module of this folder is one.

Each has ``KIND``, its name, and ``energy(at, p, t, r, masses)``, U from the places of the points.
Where the walk sums some of a kind up in words, ``summed(at, p)`` says which, and
``values(model, members)`` what the letters of these are; where it has distances,
``radial(at, p, r, masses)`` gives each of them with U as a function of its square.
``FRAMED``: it is of the axes of the body, whose ends are then points (``Exerted.frame``).
"""

from __future__ import annotations

import pkgutil
from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import Any


def framed(problem: Mapping[str, Any]) -> bool:
    """Is there a potential of the axes of the body, whose ends are points to it?"""
    given = (accounts().get(p["kind"]) for p in problem.get("potentials", []))
    return any(getattr(account, "FRAMED", False) for account in given)


@cache
def accounts() -> dict[str, Any]:
    """The module of each kind."""
    modules = [import_module(f"{__name__}.{x.name}") for x in pkgutil.iter_modules(__path__)]
    return {m.KIND: m for m in modules}
