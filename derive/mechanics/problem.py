"""A problem: group, body, potentials, inputs, parameters.  Data only; ``toml.py`` reads files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..algebra.groups import Group
from ..algebra.tree import Tree, add


class ProblemError(ValueError):
    """Bad input: the message names the key and the remedy."""


@dataclass(frozen=True)
class Parameter:
    """A free name, with what a reader of the emitted code wants to know."""

    default: float | None = None
    unit: str = ""
    meaning: str = ""


@dataclass(frozen=True)
class PointBody:
    """Point masses: ``masses[i]`` and ``positions[i]`` (n coordinates), trees in the parameters."""

    masses: tuple[Tree, ...]
    positions: tuple[tuple[Tree, ...], ...]


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
        meanings |= {f"c_{i}": f"first moment, sum of m r_{i}" for i in span}
        meanings |= {
            f"J_{i}{j}": f"matrix of moments, sum of m r_{i} r_{j}"
            for i in span
            for j in span[i - 1 :]
        }
        return {name: Parameter(meaning=meaning) for name, meaning in meanings.items()}


@dataclass(frozen=True)
class Gravity:
    """U = −Σ m_i ⟨γ, r_i⟩."""

    acceleration: tuple[Tree, ...]


@dataclass(frozen=True)
class Spring:
    """U = ½ k ‖r_i − r_j‖² between two points of the body, counted from 1."""

    between: tuple[int, int]
    stiffness: Tree


@dataclass(frozen=True)
class CovectorInput:
    """A covector of the Lie algebra given at every call: power ⟨u, ζ⟩."""

    name: str


Body = PointBody | MomentBody
Potential = Gravity | Spring


@dataclass(frozen=True)
class Problem:
    """``group`` is ``None`` for the general text: any group with the given ``action``."""

    name: str
    group: Group | None
    action: str = "linear"
    title: str = ""
    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    body: Body | None = None
    potentials: tuple[Potential, ...] = ()
    inputs: tuple[CovectorInput, ...] = ()

    @property
    def affine(self) -> bool:
        """Does the group translate?"""
        return self.action == "affine"

    @property
    def springs(self) -> tuple[Spring, ...]:
        """The springs, in the order of the file."""
        return tuple(p for p in self.potentials if isinstance(p, Spring))

    @property
    def gravity(self) -> tuple[Tree, ...] | None:
        """The acceleration of gravity, the sum of all that are given."""
        given = [p.acceleration for p in self.potentials if isinstance(p, Gravity)]
        return tuple(add(*entries) for entries in zip(*given, strict=True)) if given else None

    def data(self) -> dict[str, Any]:
        """What the record says of the problem; trees as they are."""
        return {
            "name": self.name,
            "title": self.title,
            "group": self.group.name if self.group else "any group",
            "action": self.action,
            "parameters": {
                k: {"default": p.default, "unit": p.unit, "meaning": p.meaning}
                for k, p in self.parameters.items()
            },
            "body": _body_data(self.body),
            "potentials": [_potential_data(p) for p in self.potentials],
            "inputs": [{"kind": "covector", "name": i.name} for i in self.inputs],
        }


def _body_data(body: Body | None) -> dict[str, Any]:
    if isinstance(body, PointBody):
        points = zip(body.masses, body.positions, strict=True)
        return {"kind": "points", "points": [{"mass": m, "at": list(r)} for m, r in points]}
    return {"kind": "moments" if body else "any"}


def _potential_data(p: Potential) -> dict[str, Any]:
    if isinstance(p, Gravity):
        return {"kind": "gravity", "g": list(p.acceleration)}
    return {"kind": "spring", "between": list(p.between), "stiffness": p.stiffness}
