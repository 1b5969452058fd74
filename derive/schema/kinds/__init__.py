"""The kinds of potentials: each module of this folder is one."""

from __future__ import annotations

import pkgutil
from functools import cache
from importlib import import_module

from ..kind import Potential


@cache
def kinds() -> dict[str, type[Potential]]:
    """Every kind by its name, in the order in which they are told."""
    for module in sorted(x.name for x in pkgutil.iter_modules(__path__)):
        import_module(f"{__name__}.{module}")
    found = sorted(Potential.__subclasses__(), key=lambda x: (x.rank, x.kind))
    return {x.kind: x for x in found}
