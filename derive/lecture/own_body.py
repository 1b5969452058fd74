"""The body of a reader's problem in the place of the racket, where it turns freely as one: its
principal moments and axes, by its record; or why the racket stays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..language.tree import Tree, names
from ..language.values import approximate
from ..record.as_json import decode
from ..record.record import Derivation
from ..record.sentence import Sentence, phrase
from ..views.figure.drawn_body import ExpressionValues, moments_of
from ..views.figure.scene import along, at_velocity, quadratic, turns
from ..views.language import LANGUAGES, language
from ..views.outline import group, title
from .sheets import Vector

HELD, FREE = "SO(3)", "SE(3)"
APART = 0.01
"""The least difference of two principal moments, in the largest, that a picture shows."""
SMALL = 1e-9
"""What is less, beside the whole, is that of rounding."""
HERE = "In chapter 1 this body has the place of a racket; its flip is drawn there."
TAKEN = "In the first chapter another body has the place of the racket already."
ACTING = ("damping", "forces", "flows")
"""What a problem may have that no potential energy tells."""


class RacketStaysError(Exception):
    """The body of a problem is none that turns as a racket: ``reason`` says why."""

    def __init__(self, reason: str, **places: str) -> None:
        super().__init__(reason)
        self.reason: Sentence = phrase(reason, **places)


@dataclass(frozen=True)
class OwnBody:
    """A body that turns freely: the title of its problem in each language, its ``group``, its
    principal moments, rising, the axes (columns, right-handed) to which they belong, in the frame
    of the problem, how fast it turns at first, and the problem, as the record has it."""

    titles: tuple[str, ...]
    group: str
    moments: Vector
    axes: np.ndarray[Any, np.dtype[np.float64]]
    speed: float
    problem: Mapping[str, Any]


def body_of(d: Derivation, speed: float = 1.0) -> OwnBody:
    """The body of a record that turns freely about a fixed point or its centre of mass;
    ``RacketStaysError`` for any other."""
    problem = d.problem
    if problem["body"]["kind"] == "any":
        raise RacketStaysError("it has no body of its own")
    if problem["group"] not in (HELD, FREE):
        raise RacketStaysError("its group is {group}, not that of a solid", group=group(d))
    value = ExpressionValues(problem)
    inertia = _inertia(problem, value)
    if value.invented:
        raise RacketStaysError("some of its parameters have no number")
    moments, axes = np.linalg.eigh(inertia)
    first, second, third = (float(x) for x in moments)
    if not first > SMALL * third:
        raise RacketStaysError("its inertia is not positive")
    if min(second - first, third - second) < APART * third:
        raise RacketStaysError("two of its principal moments are equal, or nearly so")
    axes = axes * np.sign(axes[np.abs(axes).argmax(axis=0), range(3)])
    axes[:, 1] *= np.sign(np.linalg.det(axes))
    titles = tuple(title(d, language(x)) for x in LANGUAGES)
    return OwnBody(titles, str(problem["group"]), (first, second, third), axes, speed, problem)


def place_of(d: Derivation, speed: float, *, taken: bool) -> tuple[OwnBody | None, Sentence]:
    """The body of a record, if it turns freely, and what its chapter says of that; ``taken``: has
    another body the place of the racket?"""
    try:
        body = body_of(d, speed)
    except RacketStaysError as stays:
        return None, phrase("In the first chapter the racket stays: {reason}.", reason=stays.reason)
    return body, phrase(TAKEN if taken else HERE)


def _inertia(problem: Mapping[str, Any], value: ExpressionValues) -> Any:
    """The tensor of inertia about the point about which the body turns; ``RacketStaysError``."""
    kind = problem["body"]["kind"]
    if any(problem.get(x) for x in ACTING) or not {"gravity"} >= {
        x["kind"] for x in problem["potentials"]
    }:
        raise RacketStaysError("more than its weight acts on it")
    if kind == "none":
        return _stated(problem, value)
    m, c, J = _of_points(problem, value) if kind == "points" else _of_moments(problem, value)
    if problem["group"] == HELD:
        if problem["potentials"] and abs(c).max() > SMALL * np.trace(J) ** 0.5:
            raise RacketStaysError("it is heavy, and not held at its centre of mass")
    elif not m > 0:
        raise RacketStaysError("some of its parameters have no number")
    else:
        J = J - np.outer(c, c) / m
    return np.trace(J) * np.eye(3) - J


def _of_points(problem: Mapping[str, Any], value: ExpressionValues) -> tuple[float, Any, Any]:
    """Mass, first moment and matrix of moments of points."""
    points = problem["body"]["points"]
    masses = np.array([value.of(x["mass"]) for x in points])
    places = np.array([value.vector(x["at"]) for x in points])
    return masses.sum(), masses @ places, (places.T * masses) @ places


def _of_moments(problem: Mapping[str, Any], value: ExpressionValues) -> tuple[float, Any, Any]:
    """The same of a body that has its moments in the record; a mass without a number is 0."""
    mass, c, J = moments_of(problem)
    m = value.of(mass)
    if problem["body"]["kind"] == "moments" and problem["parameters"]["m"]["default"] is None:
        m = 0.0
    return m, np.array(value.vector(c)), np.array([value.vector(row) for row in J[:3]])


def _stated(problem: Mapping[str, Any], value: ExpressionValues) -> Any:
    """The inertia of a Lagrangian that is half a quadratic form of the angular velocity in the
    body, and no more; ``RacketStaysError``."""
    lagrangian = problem.get("lagrangian") or {}
    if "L" not in lagrangian or problem["group"] != HELD or problem["inputs"]:
        raise RacketStaysError("its Lagrangian is stated, and not that of a solid held at a point")
    energy = decode(lagrangian["L"], "lecture")
    turning = along([[[*map(float, r)] for r in E] for E in problem["basis"]], turns(0))
    wrong = RacketStaysError(
        "its Lagrangian is not half a quadratic form of the angular velocity alone"
    )
    if lagrangian.get("trivialisation") == "right" or -1 in turning or {*names(energy)} != {"ζ"}:
        raise wrong
    form = quadratic(energy, turning, value)
    if form is None or not _is_half(energy, turning, np.array(form), value):
        raise wrong
    return np.array(form)


def _is_half(energy: Tree, turning: list[int], form: Any, value: ExpressionValues) -> bool:
    """Is L half the form at a few velocities, not small nor large?"""
    for w in ((1, 2, 3), (-2, 3, 1), (3, -1, 2)):
        there = at_velocity(energy, dict(zip(turning, w, strict=True)))
        found, wanted = approximate(there, value.parameters), np.dot(w, form @ w) / 2
        if found is None or not abs(found - wanted) <= SMALL * abs(wanted):
            return False
    return True
