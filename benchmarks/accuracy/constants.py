"""The numbers that ``constants`` makes of the parameters and the record has a name for.

Others, products with parameters in them, are seen in the rates alone.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from derive.code.naming import name_of
from derive.language.reserved import suffixed
from derive.programs import program
from derive.python.compiled import Compiled

from .measure import Worst, errors, taken
from .reference import Reference, Sample
from .terms import EXACT, Terms

NAMES = ("m", "c", "r_c", "J", "J_c", "I", "I_c", "K")
NAMED = (*NAMES, *(("inv", x) for x in ("m", "J", "J_c", "I", "I_c")))


def named(reference: Reference, names: Collection[str]) -> Iterator[tuple[str, Terms]]:
    """What the record says of each of the names in code that it knows."""
    equations = reference.equations
    for t in NAMED:
        name = name_of(t)
        there = any(x == name or x.startswith(f"{name}_") for x in names)
        if there and equations.knows(t[1] if isinstance(t, tuple) else t):
            value = equations.value(t)
            if isinstance(value, Terms):
                yield name, value
                continue
            column = len(value[0]) == 1
            for i, row in enumerate(value, 1):
                for j, x in enumerate(row, 1):
                    yield suffixed(name, i) if column else suffixed(name, i, j), x


def of_constants(f: Compiled, reference: Reference, sample: Sample) -> Worst | None:
    """The worst constant of all bodies; ``None`` if the record names none of them."""
    derived = reference.case.derived
    names = program(derived.problem, derived.record).constants
    own = [x for x in names if x not in sample.parameters]
    wanted = {name: x for name, x in named(reference, own) if name in own}
    bodies = len(sample.states)
    k = np.full((bodies, len(names)), np.nan)
    for b in range(bodies):
        if taken(f, sample.body(b)):
            k[b] = f.k
    zero = np.zeros((bodies, 1))
    found = [errors(Terms(EXACT(k[:, [names.index(name)]])), x) for name, x in wanted.items()]
    return Worst.of([(a + zero, b + zero) for a, b in found]) if found else None
