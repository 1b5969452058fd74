"""An emitted file as data, whatever its language."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from .terms import Array, CodeError, Elementary, Function, Literal, run

Names = tuple[str, ...] | None


@dataclass(frozen=True)
class Module:
    """Names of state, parameters and inputs, ``None`` where the file has no such list; functions.

    ``sizes``: STATE, ALGEBRA, PARAMETERS, CONSTANTS, INPUTS.  ``defaults`` and ``basis`` where the
    file has them.
    """

    state: Names
    parameters: Names
    inputs: Names
    functions: Mapping[str, Function]
    sizes: Mapping[str, int]
    defaults: Mapping[str, Any] | None = None
    basis: Any = field(default=None)


@dataclass(frozen=True)
class Machine:
    """Runs the functions of a module with given values of elementary functions and decimals."""

    module: Module
    elementary: Elementary
    literal: Literal

    def call(self, name: str, given: Mapping[str, Any], **sizes: int) -> dict[str, list[Any]]:
        """What a function gives, by the names of the arrays that C writes; ``sizes``: of these.

        Python returns them in a list instead.  ``CodeError`` where one is not complete.
        """
        f = self.module.functions.get(name)
        if f is None:
            raise CodeError("there is no such function")
        empty = {x: Array.empty(size, x) for x, size in sizes.items() if x in f.arguments}
        value = run(f, {**given, **empty}, self.elementary, self.literal)
        if not empty:
            return _returned(value, sizes)
        return {x: array.whole() for x, array in empty.items()}


def _returned(value: Any, sizes: Mapping[str, int]) -> dict[str, list[Any]]:
    """What was returned, cut into the arrays of these sizes."""
    if not isinstance(value, list):
        value = [value]
    if len(value) != sum(sizes.values()) or any(x is None or isinstance(x, list) for x in value):
        raise CodeError(f"it does not return {sum(sizes.values())} numbers")
    found, start = {}, 0
    for x, size in sizes.items():
        found[x] = value[start : start + size]
        start += size
    return found
