"""An emitted file as data, whatever its language, and a machine that runs its functions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from .terms import Array, CodeError, CodeFunction, Elementary, Literal, run

Names = tuple[str, ...] | None


@dataclass(frozen=True)
class Module:
    """An emitted file: the names of state, parameters and inputs, ``None`` where it has no such
    list, and its functions.

    ``sizes``: STATE, ALGEBRA, PARAMETERS, CONSTANTS, INPUTS. ``defaults`` and ``basis`` where the
    file has them.
    """

    state: Names
    parameters: Names
    inputs: Names
    functions: Mapping[str, CodeFunction]
    sizes: Mapping[str, int]
    defaults: Mapping[str, Any] | None = None
    basis: Any = field(default=None)


@dataclass(frozen=True)
class Machine:
    """An interpreter of the functions of a module; ``elementary`` and ``literal`` give the values
    of elementary functions and decimals."""

    module: Module
    elementary: Elementary
    literal: Literal

    def call(self, name: str, arguments: Mapping[str, Any], **sizes: int) -> dict[str, list[Any]]:
        """The arrays that a function computes, by their names in C; ``sizes``: how long each is.

        C writes into the arrays, Python returns all numbers in one list. ``CodeError`` where one is
        missing.
        """
        f = self.module.functions.get(name)
        if f is None:
            raise CodeError("there is no such function")
        empty = {x: Array.empty(size, x) for x, size in sizes.items() if x in f.arguments}
        value = run(f, {**arguments, **empty}, self.elementary, self.literal)
        if not empty:
            return _returned(value, sizes)
        return {x: array.whole() for x, array in empty.items()}


def _returned(value: Any, sizes: Mapping[str, int]) -> dict[str, list[Any]]:
    """The returned numbers, cut into arrays of these sizes."""
    if not isinstance(value, list):
        value = [value]
    if len(value) != sum(sizes.values()) or any(x is None or isinstance(x, list) for x in value):
        raise CodeError(f"it does not return {sum(sizes.values())} numbers")
    found, start = {}, 0
    for x, size in sizes.items():
        found[x] = value[start : start + size]
        start += size
    return found
