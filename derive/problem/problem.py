"""A problem: group, body, potentials, inputs, parameters.  Data only; ``toml.py`` reads files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..algebra.groups import Group
from ..language.refused import Refused
from ..language.tree import Tree
from ..schema.kind import Potential
from ..schema.outside import CovectorInput, Damping, ForceInput, Input
from .solids import Solid


class ProblemError(Refused, ValueError):
    """Bad input: the message names the key and the remedy."""


@dataclass(frozen=True)
class Parameter:
    """A free name, with what a reader of the emitted code wants to know."""

    default: float | None = None
    unit: str = ""
    meaning: str = ""


@dataclass(frozen=True)
class PointBody:
    """Point masses: ``masses[i]`` and ``positions[i]`` (n coordinates), trees in the parameters.

    ``blocks[i]``: the factor of a product that moves it, counted from 1.
    """

    masses: tuple[Tree, ...]
    positions: tuple[tuple[Tree, ...], ...]
    blocks: tuple[int, ...] = ()


@dataclass(frozen=True)
class MomentBody:
    """A body known by its moments, which are parameters m, c_1 …, J_11, J_12, …"""

    n: int

    def mass(self) -> Tree:
        """m."""
        return ("par", "m")

    def first(self) -> tuple[Tree, ...]:
        """c, n entries."""
        return tuple(("par", f"c_{i}") for i in range(1, self.n + 1))

    def second(self) -> tuple[tuple[Tree, ...], ...]:
        """J, n × n, the upper triangle named row by row."""
        span = range(1, self.n + 1)
        return tuple(tuple(("par", f"J_{min(i, j)}{max(i, j)}") for j in span) for i in span)

    def parameters(self) -> dict[str, Parameter]:
        """All the moments, in the order of the emitted parameters."""
        span = range(1, self.n + 1)
        meanings = {"m": "total mass"}
        meanings |= {f"c_{i}": "first moment, the sum of m r" for i in span}
        meanings |= {
            f"J_{i}{j}": "entry of the matrix of moments J (not of the tensor of inertia)"
            for i in span
            for j in span[i - 1 :]
        }
        return {name: Parameter(meaning=meaning) for name, meaning in meanings.items()}


@dataclass(frozen=True)
class GivenBody:
    """A body whose moments are given, or are those of solids and points together."""

    mass: Tree
    first: tuple[Tree, ...]
    second: tuple[tuple[Tree, ...], ...]
    points: PointBody | None = None
    solids: tuple[Solid, ...] = ()


@dataclass(frozen=True)
class Place:
    """A place in the body without mass, where a spring or a force is attached."""

    at: tuple[Tree, ...]
    block: int = 1


Body = PointBody | MomentBody | GivenBody


@dataclass(frozen=True)
class Problem:
    """``group`` is ``None`` for the general text: any group with the given ``action``.

    ``frame``: what its parameters stand for, if it is in a principal frame (``frame.py``).
    ``signed``: masses may be negative, so that nothing is said of the sign of the metric.
    """

    name: str
    group: Group | None
    action: str = "linear"
    title: str = ""
    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    body: Body | None = None
    potentials: tuple[Potential, ...] = ()
    inputs: tuple[Input, ...] = ()
    places: tuple[Place, ...] = ()
    damping: tuple[Damping, ...] = ()
    frame: Mapping[str, Any] | None = None
    signed: bool = False

    @property
    def affine(self) -> bool:
        """Does the group translate?"""
        return self.action == "affine"

    @property
    def masses(self) -> int:
        """How many points have a mass of their own."""
        return len(self.points.masses) if self.points else 0

    @property
    def points(self) -> PointBody | None:
        """The point masses, alone or among solids."""
        return self.body.points if isinstance(self.body, GivenBody) else _as_points(self.body)

    @property
    def homogeneous(self) -> bool:
        """Is it an affine group that is kept as a linear one on (r, 1)?"""
        return bool(self.group and len(self.group.factors) == 1)

    def block(self, i: int) -> int:
        """The factor of a product that moves point i, counted from 1."""
        if i > self.masses:
            return self.places[i - self.masses - 1].block
        assert self.points is not None
        return self.points.blocks[i - 1] if self.points.blocks else 1

    @property
    def covector(self) -> CovectorInput | None:
        """The covector input, if there is one."""
        return next((i for i in self.inputs if isinstance(i, CovectorInput)), None)

    @property
    def force_inputs(self) -> tuple[ForceInput, ...]:
        """The force inputs."""
        return tuple(i for i in self.inputs if isinstance(i, ForceInput))


def _as_points(body: Body | None) -> PointBody | None:
    return body if isinstance(body, PointBody) else None
