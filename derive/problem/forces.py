"""The tables [[potential]], [[input]] and [[damping]] of a problem file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..schema.declared import Parameter
from ..schema.kind import Potential
from ..schema.kinds import kinds
from ..schema.outside import INPUTS, CovectorInput, Damping, ForceInput, Input
from .fields import tables
from .file_reader import FileReader
from .inertia import is_negative
from .problem import ProblemError

Forces = tuple[tuple[Potential, ...], tuple[Input, ...], tuple[Damping, ...]]


def forces(data: Mapping[str, object], reader: FileReader) -> Forces:
    """All of them; there is one of what may be there once."""
    potentials, inputs, damping = (
        {f"{key} {k}": x for k, x in enumerate(tables(data, key), 1)}
        for key in ("potential", "input", "damping")
    )
    acting = [w for w, x in inputs.items() if x.get("kind") == ForceInput.kind]
    for where in (*potentials, *acting, *damping) if reader.group is None else ():
        raise ProblemError(f"{where}: a text about any group has no points on which this could act")
    found = tuple(reader.one_of(kinds(), x, where) for where, x in potentials.items())
    given = tuple(reader.one_of(INPUTS, x, where) for where, x in inputs.items())
    for k, p in enumerate(found, 1):
        if p.alone and any(x.kind == p.kind for x in found[: k - 1]):
            raise ProblemError(f"potential {k}: a second {p.kind}; there may be one")
    if sum(isinstance(i, CovectorInput) for i in given) > 1:
        raise ProblemError("key 'input': one covector holds every component; give one such table")
    return found, given, tuple(reader.whole(Damping, x, w) for w, x in damping.items())


def negative_stiffness_of(
    potentials: Sequence[Potential],
    damping: Sequence[Damping],
    parameters: Mapping[str, Parameter],
) -> str | None:
    """Where a stiffness, a damping or a constant of gravitation is negative, for the defaults of
    the parameters."""
    listed = [
        (f"{told} {k}: key {key!r}", value)
        for told, tables in (("potential", potentials), ("damping", damping))
        for k, p in enumerate(tables, 1)
        for key, about, value in p.values()
        if about.positive
    ]
    return next((where for where, t in listed if is_negative(t, parameters)), None)
