"""The kinds of potentials: the problems of their pages, and emitted code beside an oracle."""

import re
import tomllib
from functools import cache
from pathlib import Path

import numpy as np

from derive import derive
from derive.problem.toml import problem_of
from tests.oracles import least_constraint
from tests.support.emitted import arrange, compile_c, import_python
from tests.support.needs import CC

PAGES = Path(__file__).parents[2] / "docs" / "potentials"
BLOCK = re.compile(r"^```toml\n(.*?)^```$", re.M | re.S)


def pages():
    """The problem files in the pages, by kind and number."""
    return {
        f"{page.stem} {k}": text
        for page in sorted(PAGES.glob("*.md"))
        for k, text in enumerate(BLOCK.findall(page.read_text(encoding="utf-8")), 1)
    }


@cache
def examples():
    """Their problems."""
    return {name: problem_of(tomllib.loads(text)) for name, text in pages().items()}


def cloud(n, rng, count=6):
    """Masses (count,) and places (count, n)."""
    return rng.uniform(0.5, 1.5, count), rng.normal(size=(count, n))


def moments(masses, r):
    """m, c_i and J_ij, as a body with symbolic moments names them."""
    n = r.shape[1]
    values = {"m": masses.sum()} | {f"c_{i + 1}": masses @ r[:, i] for i in range(n)}
    J = r.T @ (masses[:, None] * r)
    return values | {f"J_{i + 1}{j + 1}": J[i, j] for i in range(n) for j in range(i, n)}


def agrees(problem, values, masses, r, U, folder, apart=lambda T: T, tolerance=1e-12):
    """C and Python of a problem against the oracle, at random states.

    ``values``: of the parameters; ``U(t, A, T)``; ``apart``: where T is to be.
    """
    d = derive(problem)
    d.emit(folder, ("c", "python"))
    name, n = problem.name, problem.group.n
    m, c = import_python(name, folder), compile_c(CC, name, folder, folder)
    p, rng = arrange(m, values), np.random.default_rng(3)
    basis = np.array([[[float(x) for x in row] for row in e] for e in m.BASIS])
    status, k = c.constants(p)
    assert status == 0
    for _ in range(5):
        x, t = least_constraint.state(n, basis, rng), rng.normal()
        if basis.shape[1] > n:
            x[n * n : n * n + n] = apart(x[n * n : n * n + n])
        wanted = least_constraint.rhs(t, x, n, basis, masses, r, U)
        size = np.max(np.abs(wanted))
        for found in (m.rhs(t, x, m.constants(p)), c.rhs(t, x, k, np.zeros(0))):
            assert np.max(np.abs(found - wanted)) < tolerance * size
        total = least_constraint.energy(t, x, n, basis, masses, r, U)
        for found in (m.energy(t, x, m.constants(p)), c.energy(t, x, k)):
            assert abs(found - total) < tolerance * (abs(total) + size)
