"""The lists of an emitted file, names, sizes, defaults and the basis, against the record."""

from __future__ import annotations

from .emitted_file import Module
from .exact_points import Claims
from .terms import CodeError


class DiffersError(CodeError):
    """The code is readable and says something else than the record: the message says where."""


def compare_names(m: Module, claims: Claims) -> None:
    """``DiffersError`` where one of the lists is not what record and chart make it."""
    for what, names in (("state", claims.state.names), ("inputs", claims.inputs)):
        if (getattr(m, what) or names) != names:
            raise DiffersError(f"the names of {what} are not {', '.join(names) or 'none'}")
    declared, listed = claims.record.problem["parameters"], m.parameters or ()
    if listed != tuple(x for x in declared if x in listed):
        raise DiffersError("the parameters are not those of the record, in its order")
    sizes = {
        "STATE": len(claims.state.names),
        "INPUTS": len(claims.inputs),
        "PARAMETERS": len(listed),
        "ALGEBRA": claims.group.dimension,
    }
    if "q_0" in claims.state.names:
        sizes["MATRIX"] = len(claims.state.names) + 5  # nine entries for four
    for what, size in sizes.items():
        if m.sizes.get(what, size) != size:
            raise DiffersError(f"the size {what} is {m.sizes[what]}, not {size}")
    recorded = {x: declared[x]["default"] for x in listed}
    defaults = {x: value for x, value in recorded.items() if value is not None}
    if m.defaults is not None and {x: float(y) for x, y in m.defaults.items()} != defaults:
        raise DiffersError("the defaults of the parameters are not those of the record")
    if m.basis is not None and m.basis != claims.state.group.basis:
        raise DiffersError("the basis is not that of the record")
