"""The three problems: parameters and states drawn at random, and our emitted code for them."""

from __future__ import annotations

import importlib
import importlib.util
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

HERE = Path(__file__).parent
PROBLEMS = HERE.parent / "problems"
GROUPS = {"p1": "SO(3)", "p2": "SE(3)", "p3": "SL(3)"}
XYZ = range(1, 4)


@dataclass(frozen=True)
class Case:
    """One problem with its numbers: ``masses`` at ``places`` of the body, ``values`` by name."""

    name: str
    masses: Array
    places: Array
    values: dict[str, float] = field(repr=False)

    @property
    def size(self) -> int:
        """Numbers in a state."""
        return {"p1": 12, "p2": 18, "p3": 17}[self.name]

    def vector(self, letter: str) -> Array:
        """The values ``letter_1`` … ``letter_3``."""
        return np.array([self.values[f"{letter}_{i}"] for i in XYZ])

    @property
    def moments(self) -> Array:
        """J, the sum of m r rᵀ."""
        return np.asarray((self.masses * self.places.T) @ self.places)


def draw(name: str, seed: int = 1) -> Case:
    """A problem with random parameters; a solid is a cloud of masses, so that it can exist."""
    random = np.random.default_rng(seed)
    count = 4 if name == "p3" else 7
    masses, places = random.uniform(0.5, 1.5, count), random.normal(size=(count, 3))
    if name == "p3":
        pairs = [(i, j) for i in range(1, 5) for j in range(i + 1, 5)]
        values: dict[str, float] = {f"k{i}{j}": random.uniform(0.5, 1.5) for i, j in pairs}
        for i, (mass, place) in enumerate(zip(masses, places, strict=True), 1):
            values[f"m{i}"] = mass
            values.update({f"{a}{i}": float(place[j]) for j, a in enumerate("xyz")})
        return Case(name, masses, places, values)
    case = Case(name, masses, places, {"m": masses.sum(), "k": 3.0})
    case.values.update({f"c_{i}": float(masses @ places[:, i - 1]) for i in XYZ})
    case.values.update({f"J_{i}{j}": case.moments[i - 1, j - 1] for i in XYZ for j in range(i, 4)})
    case.values.update({f"{a}_{i}": random.normal() for a in "gba" for i in XYZ})
    return case


def states(case: Case, count: int, seed: int = 2) -> Array:
    """Random states, one a row: a matrix of the group, then velocities and translations."""
    random = np.random.default_rng(seed)
    if case.name == "p3":
        A = np.eye(3) + 0.3 * random.normal(size=(count, 3, 3))
        A /= np.cbrt(np.linalg.det(A))[:, None, None]
    else:
        A = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
        A *= np.linalg.det(A)[:, None, None]
    rest = random.normal(size=(count, case.size - 9))
    return np.concatenate([A.reshape(count, 9), rest], axis=1)


def command(*words: str) -> str:
    """What a program prints; its last words are the error when it fails."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if "error" in line.lower()]
        raise RuntimeError((lines or done.stderr.splitlines() or ["failed"])[0][:160])
    return done.stdout


@dataclass(frozen=True)
class Emitted:
    """Our code: its folder, its header, its Python module and the parameters in its order."""

    folder: Path
    header: str
    module: Any
    parameters: Array

    def operations(self) -> str:
        """What the header says of rhs."""
        found = re.search(r"rhs ((?:\d+ \w+,? ?)+)", self.header)
        return found[1].strip(" ,") if found else ""


def library(name: str) -> Any:
    """A module that may not be installed, taken without its types."""
    return importlib.import_module(name)


def load(path: Path, name: str) -> Any:
    """The module of a file, apart from those imported already."""
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(name)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def emit(case: Case, folder: Path, prefix: str = "", *options: str) -> Emitted:
    """Run ``derive emit`` in a process of its own."""
    problem, name = str(PROBLEMS / f"{case.name}.toml"), prefix or case.name
    words = ("--out", str(folder), "--prefix", name, *options)
    command(sys.executable, "-m", "derive", "emit", problem, *words)
    module = load(folder / f"{name}.py", name)
    header = (folder / f"{name}.h").read_text(encoding="utf-8")
    parameters = np.array([case.values[name] for name in module.PARAMETERS], dtype=float)
    return Emitted(folder, header, module, parameters)
