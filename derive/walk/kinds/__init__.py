"""What the walk makes of each kind of potential: each module of this folder is one.

``words(problem, a, vectors)``: the potentials of the kind together as a word, ``None`` without any;
``pointwise(found, p, problem)``: one of them, given point by point.  A kind has one or both.
"""

from __future__ import annotations

import pkgutil
from functools import cache
from importlib import import_module
from typing import Any

from ...schema.potential_kinds import kinds


@cache
def walked() -> dict[str, Any]:
    """The module of each kind of potential, by its name, in the order in which kinds are told."""
    names = (x.name for x in pkgutil.iter_modules(__path__))
    modules = [import_module(f"{__name__}.{name}") for name in names]
    found = {m.KIND.kind: m for m in modules}
    return {kind: found[kind] for kind in kinds()}
