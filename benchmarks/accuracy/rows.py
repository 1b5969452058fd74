"""The programs that are measured, and the measurement of one of them over many samples."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from derive import derive
from derive.validate.chart import Chart

from .constants import of_constants
from .measure import Numbers, Worst, by_c, by_python, compared, compiled, module
from .reference import Case, Reference, Sample

STATES = 8
"""Of each body."""
FORMS: dict[str, Mapping[str, str]] = {
    "C": {},
    "quaternion": {"attitude": "quaternion"},
    "tangent": {"velocity": "tangent"},
    "principal": {"frame": "principal"},
    "principal, tangent": {"frame": "principal", "velocity": "tangent"},
}
PROBLEMS: dict[str, tuple[str, ...]] = {
    "so3": ("C", "Python", "quaternion", "tangent", "principal"),
    "se3": ("C", "Python", "quaternion", "tangent", "principal"),
    "sl3": ("C", "Python", "tangent", "principal", "principal, tangent"),
    "top": ("C",),
    "hammer": ("C",),
    "comet": ("C",),
    "ellipsoid": ("C",),
    "saff3": ("C",),
    "gl3": ("C",),
    "two_tops": ("C",),
    "so4": ("C",),
    "su2": ("C",),
    "heisenberg": ("C",),
    "sim3": ("C",),
    "sp4": ("C",),
    "jelly": ("C",),
}


@dataclass(frozen=True)
class Row:
    """One program: a problem and a form of its code."""

    problem: str
    form: str

    @cached_property
    def choices(self) -> Mapping[str, str]:
        """The options of the emission."""
        return FORMS.get(self.form, {})

    @cached_property
    def case(self) -> Case:
        """The problem, with the chart of the states."""
        chart = {x: y for x, y in self.choices.items() if x != "frame"}
        return Case(derive(self.problem), Chart(**chart))

    @cached_property
    def program(self) -> Any:
        """What is measured."""
        if self.form == "Python":
            return module(self.case.derived)
        return compiled(self.case.derived, **self.choices)

    def sample(self, bodies: int, seed: int) -> Sample:
        """The bodies and states of a seed."""
        name = zlib.crc32(self.problem.encode())
        return self.case.sample(np.random.default_rng([seed, name]), bodies, STATES)

    def numbers(self, sample: Sample) -> Numbers:
        """What the program makes of a sample."""
        if self.form == "Python":
            return by_python(self.program, sample)
        return by_c(self.program, sample, framed="frame" in self.choices)

    def measure(self, bodies: int, seed: int = 0) -> dict[str, Worst]:
        """The worst error of each output over so many bodies."""
        sample = self.sample(bodies, seed)
        numbers = self.numbers(sample)
        reference = Reference(self.case, sample, numbers.carried)
        found = compared(reference, numbers)
        if self.form == "C":
            constants = of_constants(self.program, reference, sample)
            found |= {"constants": constants} if constants else {}
        return found


def joined(found: list[dict[str, Worst]]) -> dict[str, Worst]:
    """The worst of several measurements."""
    return {
        name: max((x[name] for x in found), key=lambda worst: worst.scaled) for name in found[0]
    }
