"""Equilibria and what is said of their stability, beside linearisations by hand."""

from fractions import Fraction

import numpy as np
import pytest

from derive import ProblemError, derive
from derive.command.cli import main
from derive.problem.toml import problem_of
from derive.record.as_json import from_json
from derive.record.sentence import english
from derive.search.equilibria.energy_casimir import between_roots, diagonalised
from derive.search.equilibria.stability import polynomial, roots_of_squares
from tests.support.lagrangians import LINE, heavy, heisenberg, lagrangian, nilpotent
from tests.support.walks import repeated


def test_a_free_solid_turns_about_its_axes():
    """Stable about the least and the largest moment, unstable about the middle one (Euler)."""
    found = derive("euler_top").equilibria()
    assert [x.verdict for x in found] == ["stable", "unstable", "stable"]
    assert [x.signature for x in found] == [(0, 2), (1, 1), (2, 0)]
    moments = [float(derive("euler_top").problem.parameters[f"I{a}"].default) for a in (1, 2, 3)]
    a, b, c = moments
    assert found[1].growth == pytest.approx(np.sqrt((b - a) * (c - b) / (a * c)) / b)


def test_a_leaf_that_is_a_point_says_nothing():
    found = nilpotent().equilibria({"Pi_1": 1})
    ((x,), step) = found, found.record.steps[-1]
    assert (x.verdict, x.signature) == ("open", (0, 0))
    said = english(step.prose)
    assert "is this point alone" in said
    assert not any(x in said for x in ("characteristic", "not definite"))


def test_momenta_leave_a_leaf_that_is_a_point():
    """On the affine maps of a line Π̇₁ = −Π₂², Π̇₂ = Π₁Π₂: by hand 1 and 0 at Π₁ = 1."""
    found = derive(lagrangian("(zeta_1^2 + zeta_2^2)/2", LINE)).equilibria({"Pi_1": 1})
    (x,) = found
    assert (x.verdict, x.growth) == ("unstable", pytest.approx(1))
    assert "is unstable (Lyapunov)" in english(found.record.steps[-1].prose)
    assert all(v.holds for v in found.check(1))
    resting = derive(lagrangian("(zeta_1^2 + zeta_2^2)/2", LINE)).equilibria({"Pi_1": -1})
    assert resting[0].verdict == "open"
    assert all(v.holds for v in resting.check(1))


def test_rest_at_one_where_other_entries_never_vary():
    found = derive(heisenberg()).equilibria()
    assert [x.verdict for x in found] == ["stable", "stable"]
    assert not any(found[0].at)
    assert all(v.holds for v in found.check(1))


def sleeping(spin):
    """The Lagrange top upright: its verdict at a momentum about the vertical."""
    (x,) = derive("lagrange_top").equilibria({"Pi_3": spin, "A_33": 1})
    return x


def test_a_sleeping_top_wakes_where_it_spins_slowly():
    """Stable above Π₃² = 4 I₁ mgl, unstable below."""
    p = derive("lagrange_top").problem.parameters
    least = np.sqrt(4 * p["I1"].default * p["mgl"].default)
    above, below = (Fraction(str(round(least + x, 6))) for x in (0.01, -0.01))
    assert sleeping(above).verdict == "stable"
    assert sleeping(below).verdict == "unstable"


def rates(x, moments, weight):
    """Euler–Poisson by hand: weight along the first axis of the body, of the kovalevskaya_top."""
    pi, gamma = x[:3], x[3:]
    omega = pi / moments
    push = np.cross(gamma, [0, 0, 0]) + np.cross([weight, 0, 0], gamma)
    return np.concatenate([np.cross(pi, omega) - push, np.cross(gamma, omega)])


@pytest.mark.parametrize("at", [1, -1])
def test_a_top_hangs_or_stands(at):
    p = derive("kovalevskaya_top").problem.parameters
    moments = np.array([2, 2, 1]) * p["I"].default
    (found,) = derive("kovalevskaya_top").equilibria({"A_31": at})
    x = np.array([0, 0, 0, at, 0, 0], float)
    assert not rates(x, moments, p["mgl"].default).any()
    step, weight = 1e-6, p["mgl"].default
    pairs = [[rates(x + s * step * e, moments, weight) for s in (1, -1)] for e in np.eye(6)]
    slopes = [(up - down) / (2 * step) for up, down in pairs]
    growth = np.linalg.eigvals(np.array(slopes).T).real.max()
    assert found.growth == pytest.approx(growth, abs=1e-6)
    assert found.verdict == ("unstable" if growth > 1e-6 else "stable")


RECORDS = ("euler_top", "lagrange_top", "kovalevskaya_top", "euler_poisson", "kirchhoff", "manakov")


@pytest.mark.parametrize("name", repeated(RECORDS, 2))
def test_every_step_is_checked(name):
    found = derive(name).equilibria()
    new = [v for v in found.check() if ".equilibrium" in v.label or ".energy_casimir" in v.label]
    assert len(new) >= len(found) > 0
    assert [v.reason for v in new if not v.holds] == []


def test_points_and_solids_too():
    (found,) = derive("su2").equilibria({"Pi_1": 1})
    assert found.at == {"Pi_1": 1}


def test_numbers_are_needed():
    with pytest.raises(ProblemError, match="has no default"):
        derive(heavy("123", "m*A_31", "m")).equilibria()


@pytest.mark.parametrize(
    ("potential", "said"),
    [
        ("pi*A_33", "and π is none"),
        ("b*pi*A_33", "and b has no default"),
        ("cos(pi/3)*A_33", "has cos of π or parameters"),
    ],
)
def test_pi_is_no_number_here(potential, said):
    """“b, π has no default”; “cos of its parameters” where there is none."""
    with pytest.raises(ValueError, match=said):
        derive(heavy("123", potential, "b" if "b" in potential else "")).equilibria()


def test_pi_stays_a_letter_in_a_command(tmp_path, capsys):
    """The cone of ``top``: what is told of it holds, and is stable where it spins fast enough."""
    assert main(["equilibria", "top", "--format", "json"]) == 0
    told, said = capsys.readouterr()
    assert "have π, which is no fraction and stays a letter" in said
    record = from_json(told)
    upright = next(s for s in record.steps if s.label == "top.energy_casimir_2")
    assert "are stable" in english(upright.prose)
    assert "‘g’" not in english(upright.prose)
    (tmp_path / "found.json").write_text(told, encoding="utf-8")
    assert main(["check", str(tmp_path / "found.json")]) == 0


def test_squares_by_lagrange():
    rng = np.random.default_rng(3)
    for n in (1, 3, 5):
        a = rng.integers(-4, 5, size=(n, n))
        q = [[Fraction(int(x)) for x in row] for row in a + a.T - 2 * np.diag(np.diag(a))]
        squares = diagonalised(q)
        whole = sum(
            (float(d) * np.outer([*map(float, r)], [*map(float, r)]) for d, r in squares),
            np.zeros((n, n)),
        )
        assert whole == pytest.approx(np.array(q, float))
        positive = sum(np.linalg.eigvalsh(np.array(q, float)) > 1e-9)
        assert positive == sum(d > 0 for d, _ in squares)


def test_roots_and_what_is_between():
    one, two = ([[Fraction(x), 0], [0, Fraction(y)]] for x, y in ((-1, -4), (1, 1)))
    low, middle, high = sorted(between_roots(one, two))
    assert low < 1 < middle < 4 < high


@pytest.mark.parametrize(
    ("matrix", "expected"),
    [([[0, 1], [-1, 0]], False), ([[0, 1], [1, 0]], True), ([[0, 1], [0, 0]], False)],
)
def test_growth(matrix, expected):
    found = roots_of_squares(polynomial([[Fraction(x) for x in row] for row in matrix]))
    assert (found.negative < found.distinct) is expected


def test_a_leaf_of_lower_rank_is_said():
    """A free top at rest in space but for nothing: on so(3)* the origin is a leaf by itself."""
    found = derive(lagrangian("zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2")).equilibria({"Pi_1": 2})
    assert found[0].verdict == "stable"


def test_the_degree_of_what_is_kept_is_an_option(capsys):
    """The Casimir of a top is of degree 2: of degree 1 nothing is known but the energy."""
    for degree, known in (("1", False), ("2", True)):
        assert main(["equilibria", "euler_top", "--at", "Pi_3=1", "--degree", degree]) == 0
        assert ("No multiples" not in capsys.readouterr().out) == known
    weighted = derive("lagrange_top").equilibria({"A_33": 1}, degree=1).record
    assert "degrees are weighted" in str(weighted["poisson"].prose)


def test_entries_of_a_product_have_the_names_of_the_file():
    """A2_33 was no coordinate: the text has the one matrix A, whose entry that is A_66."""
    L = f"({' + '.join(f'{1 + a % 3}*zeta_{a}^2' for a in range(1, 7))})/2 - A1_33 - A2_33"
    own = {"name": "own", "group": "SO(3) x SO(3)", "lagrangian": {"L": L}}
    d = derive(problem_of(own))
    (x,), (y,) = (d.equilibria(at) for at in ({"A1_33": 1, "A2_33": 1}, {"A_33": 1, "A_66": 1}))
    assert x.at == y.at == {"A_33": 1, "A_66": 1}
