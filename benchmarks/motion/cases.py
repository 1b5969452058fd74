"""The four motions: their equations in the fastest forms of the state, and where they start."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..peers.cases import PROBLEMS, Array, command, draw, load, states

QUATERNION = ("--attitude", "quaternion")
PRINCIPAL = ("--frame", "principal")
TANGENT = ("--velocity", "tangent")
TURN = (1.0, 0.0, 0.0, 0.0, 0.8, -0.6, 0.0, 0.6, 0.8)
"""A rotation about the first axis."""


@dataclass(frozen=True, eq=False)
class Motion:
    """A problem, how long it moves, its fastest rate in rad/s, the forms of the state (options of
    ``derive emit`` by name), the errors at which methods are compared."""

    name: str
    until: float
    rate: float
    forms: dict[str, tuple[str, ...]]
    start: Callable[[], tuple[dict[str, float], Array]]
    goals: tuple[float, ...] = (1e-6, 1e-9, 1e-12)


def top(*velocity: float) -> Callable[[], tuple[dict[str, float], Array]]:
    """A top at an angle, at a velocity in the body."""
    return lambda: ({}, np.array([*TURN, *velocity]))


def drawn(name: str) -> Callable[[], tuple[dict[str, float], Array]]:
    """The parameters and a state of a problem of ``benchmarks.peers``."""

    def start() -> tuple[dict[str, float], Array]:
        case = draw(name)
        return case.values, states(case, 1)[0]

    return start


def springs() -> tuple[dict[str, float], Array]:
    """The parameters that P3 states, and four points that swing."""
    table = tomllib.loads((PROBLEMS / "p3.toml").read_text(encoding="utf-8"))
    values = {name: x["default"] for name, x in table["parameters"].items()}
    return values, np.array([1, 0, 0, 0, 1, 0, 0, 0, 1, *SWING])


SWING = (0.3, -0.2, 0.1, 0.4, 0.2, -0.3, 0.1, 0.2)
"""The velocity of the four points."""

PERIOD = 13.374823
"""Of the angular velocity of the free top, in s."""

MOTIONS = (
    Motion(
        "free_top",
        1000 * PERIOD,
        1.5,
        {"matrix": (), "quaternion": QUATERNION},
        top(0.4, 1.2, 0.3),
        (1e-6, 1e-8, 1e-9),
    ),
    Motion("heavy_top", 100.0, 15.0, {"matrix": (), "quaternion": QUATERNION}, top(0.3, 0.0, 15.0)),
    Motion(
        "p2", 20.0, 8.0, {"matrix": PRINCIPAL, "quaternion": PRINCIPAL + QUATERNION}, drawn("p2")
    ),
    Motion("p3", 100.0, 12.0, {"tangent": PRINCIPAL + TANGENT, "body": PRINCIPAL}, springs),
)


@dataclass(frozen=True)
class Form:
    """A motion in one form of the state; its emitted files are in ``folder``."""

    motion: Motion
    label: str
    folder: Path

    @property
    def name(self) -> str:
        """The prefix of the files."""
        return f"{self.motion.name}_{self.label}"

    def emit(self) -> None:
        """Write the C with its steps, and the Python."""
        words = (sys.executable, "-m", "derive", "emit", str(PROBLEMS / f"{self.motion.name}.toml"))
        words += ("--out", str(self.folder), "--prefix", self.name)
        words += self.motion.forms[self.label]
        command(*words, "--lang", "c", "--step", "gauss", "--step", "vern9")
        python = tuple(x for x in words if x not in ("--ensemble", "--conserved"))
        command(*python, "--lang", "python", "--step", "gauss_jax")

    @cached_property
    def module(self) -> Any:
        """The emitted Python."""
        return load(self.folder / f"{self.name}.py", self.name)

    @cached_property
    def _numbers(self) -> tuple[Array, Array]:
        values, x = self.motion.start()
        k = self.module.constants([values[name] for name in self.module.PARAMETERS])
        return np.asarray(k, dtype=float), self._from_matrix(x, np.asarray(k, dtype=float))

    @property
    def k(self) -> Array:
        """The constants."""
        return self._numbers[0]

    @property
    def x(self) -> Array:
        """The state at the start."""
        return self._numbers[1]

    def _from_matrix(self, x: Array, k: Array) -> Array:
        """The state of this form from (A, ζ) or (A, T, ζ, w) in the given frame."""
        state = self.module.STATE
        if state[0] == "q_0":
            x = np.concatenate([quaternion(x[:9].reshape(3, 3)), x[9:]])
        if len(state) > len(x):
            A, Z = x[:9].reshape(3, 3), np.einsum("a,aij->ij", x[9:], self.module.BASIS)
            x = np.concatenate([x[:9], (A @ Z).ravel()])
        return np.asarray(self.module.into_frame(x, k)) if hasattr(self.module, "into_frame") else x

    def parts(self, x: Array) -> list[Array]:
        """The parts of a state, a quaternion as its matrix."""
        found: dict[str, list[float]] = {}
        for name, value in zip(self.module.STATE, x, strict=True):
            part = name.partition("_")[0] + "_dot" * name.endswith("_dot")
            found.setdefault(part, []).append(value)
        return [rotation(*y) if name == "q" else np.array(y) for name, y in found.items()]

    def error(self, x: Array, wanted: Array) -> float:
        """The largest error of a part, relative to the largest number of it."""
        pairs = zip(self.parts(x), self.parts(wanted), strict=True)
        found = max(float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs)
        return found if np.isfinite(found) else np.inf


def quaternion(A: Array) -> Array:
    """The unit quaternion of a rotation, scalar first: the eigenvector of the form q ↦ q̄Aq."""
    a, b, c = A
    K = np.array(
        [
            [a[0] + b[1] + c[2], c[1] - b[2], a[2] - c[0], b[0] - a[1]],
            [c[1] - b[2], a[0] - b[1] - c[2], a[1] + b[0], a[2] + c[0]],
            [a[2] - c[0], a[1] + b[0], b[1] - a[0] - c[2], b[2] + c[1]],
            [b[0] - a[1], a[2] + c[0], b[2] + c[1], c[2] - a[0] - b[1]],
        ]
    )
    return np.asarray(np.linalg.eigh(K)[1][:, -1])


def rotation(w: float, x: float, y: float, z: float) -> Array:
    """The entries of the rotation of a quaternion."""
    return np.array(
        [
            *(w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            *(2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
            *(2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
        ]
    )
