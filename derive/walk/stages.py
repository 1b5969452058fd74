"""A road as a table of stages that is run: each takes values of those before it, and gives one."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from typing import Any

from ..record.record import Step

Steps = tuple[Step, ...]
Values = dict[str, Any]
"""What is known on the way, by name: what the road starts from, then what each stage gives; under
``steps`` the steps that they took, in order."""


@dataclass(frozen=True)
class Stage:
    """A row of the table: ``run`` of the values that ``takes`` names gives ``name``, of the type
    ``gives``.

    ``takes``: names, and fields of them as ``pullback.moments``; with ``?`` one that may be
    missing. Where another is missing, the stage gives nothing. ``on``: the kind of road that has
    this stage; all have one without.
    """

    name: str
    takes: str
    gives: str
    run: Callable[..., Any]
    on: str = ""

    def value(self, values: Mapping[str, Any]) -> Any:
        """What the stage makes of these values; ``None`` where something that it takes is
        missing."""
        taken = [(_found(x.rstrip("?"), values), x.endswith("?")) for x in self.takes.split()]
        if any(x is None and not optional for x, optional in taken):
            return None
        return self.run(*(x for x, _ in taken))


def _found(path: str, values: Mapping[str, Any]) -> Any:
    """A value by its name, or a field of it; ``None`` where there is none."""
    name, *fields = path.split(".")
    return reduce(lambda x, field: x if x is None else getattr(x, field), fields, values.get(name))


def follow(road: Iterable[Stage], start: Mapping[str, Any], kinds: Collection[str]) -> Values:
    """The values of the stages of a road of these ``kinds``, after those that it starts from."""
    values, steps = {**start}, list[Step]()
    for stage in road:
        if not stage.on or stage.on in kinds:
            found = values[stage.name] = stage.value(values)
            steps += _steps_of(found)
    return values | {"steps": tuple(steps)}


def _steps_of(value: Any) -> Steps:
    """The steps in what a stage gave: a step, a tuple of them, or the field ``steps``."""
    if isinstance(value, Step):
        return (value,)
    return value if isinstance(value, tuple) else getattr(value, "steps", ())
