"""Mass matrices of any signs: what the emitted code divides by, beside a dense solve."""

import random

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.problem.toml import problem_of
from tests.support.library import module_of

DEFAULTS = {"p": 0.7, "q": -1.3, "r": 2.1}
ALGEBRAS = {"SL(2)": 3, "SO(4)": 6}
FIXED = {
    "pairs": [[0, 1, 0], [1, 0, 0], [0, 0, 2]],
    "a zero first": [[0, 1, 2], [1, 3, 1], [2, 1, 0]],
    "a corner": [["p", 1, 0], [1, 0, 0], [0, 0, 2]],
    "two parameters": [["p", "q", 0], ["q", 0, 0], [0, 0, 1]],
    "equal minors": [["p", "p", 1], ["p", "p", 2], [1, 2, 0]],
    "no diagonal": [[0, "p", "q"], ["p", 0, "r"], ["q", "r", 0]],
}


def drawn(seed, n=6):
    """A symmetric matrix of small numbers, many of them 0, and parameters."""
    some = random.Random(seed)
    entries = [0, 0, 0, 0, 1, -2, *DEFAULTS]
    m = [[some.choice(entries) for _ in range(n)] for _ in range(n)]
    return [[m[min(i, j)][max(i, j)] for j in range(n)] for i in range(n)]


def valued(m):
    return np.array([[DEFAULTS.get(x, x) for x in row] for row in m], float)


def typed(operator, name="test"):
    group = next(x for x, n in ALGEBRAS.items() if n == len(operator))
    used = {x: DEFAULTS[x] for row in operator for x in row if x in DEFAULTS}
    data = {"name": name, "group": group, "inertia": {"operator": operator}, "parameters": used}
    return problem_of(data | {"input": [{"name": "u", "kind": "covector"}]})


REGULAR = [m for m in map(drawn, range(40)) if abs(np.linalg.det(valued(m))) > 0.05][:4]


@pytest.mark.parametrize("m", [*FIXED.values(), *REGULAR])
def test_pushes_move_as_the_inverse_says(m):
    f, rng = derive.compile(typed(m), momenta=True), np.random.default_rng(1)
    u, zeta = rng.normal(size=(2, len(m)))
    x = np.zeros(len(f.STATE))
    x[-len(m) :] = zeta
    pushed = f.rhs(0.0, x, u) - f.rhs(0.0, x, np.zeros(len(m)))
    assert np.allclose(pushed[-len(m) :], np.linalg.solve(valued(m), u), rtol=1e-10, atol=1e-12)
    y = f.momentum(0.0, x)
    assert np.allclose(y[-len(m) :], valued(m) @ zeta)
    assert np.allclose(f.velocity(0.0, y), x)


def test_there_are_enough_of_them():
    assert len(REGULAR) == 4
    assert all(min(np.linalg.eigvalsh(valued(m))) < 0 for m in REGULAR)


@pytest.mark.parametrize(
    ("case", "regular", "singular"),
    [
        ("a corner", [0.0], None),
        ("two parameters", [0.0, 1.0], [1.0, 0.0]),
        ("equal minors", [1.0], [0.0]),
    ],
)
def test_what_constants_refuses(case, regular, singular):
    """Singular matrices alone, where a pivot is a number or of rows by themselves."""
    f = module_of(typed(FIXED[case]))
    assert np.isfinite(f.constants(regular)).all()
    if singular:
        with pytest.raises(ValueError, match=r"the mass matrix is singular"):
            f.constants(singular)


@pytest.mark.parametrize(
    ("m", "said"),
    [
        (FIXED["a corner"], "a mass matrix that is singular;"),
        ([["p", "q", 0], ["q", "r", 0], [0, 0, 1]], "that is singular, or a diagonal block of it;"),
    ],
)
def test_what_is_said_of_it(m, said):
    assert said in derive.derive(typed(m)).emit(languages=["c"])["test.h"]


def test_the_emission_is_held_by_the_validator(tmp_path, capsys):
    text = 'name = "plane"\n[algebra]\nbrackets = [[1,2,3,1],[4,1,2,1],[4,2,1,-1]]\n'
    text += '[lagrangian]\nL = "(zeta_1^2 + 2*zeta_2^2)/2 + zeta_3*zeta_4"\n'
    (tmp_path / "plane.toml").write_text(text, encoding="utf-8")
    arguments = [str(tmp_path / "plane.toml"), "--momenta", "--validate", "--out", str(tmp_path)]
    assert main(["emit", *arguments]) == 0
    assert "plane.py: constants, rhs" in capsys.readouterr().err
