"""Kinematics of first order: the errors of an estimate, and the condition under which they move by
themselves, with a counterexample where it does not hold."""

from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from derive.check.checker import Checker, check
from derive.language.expression import parse
from derive.language.tree import add, mul, neg, nodes
from derive.pipeline import walk
from derive.problem.entries_on_orbit import matrix, rational
from derive.problem.toml import problem_of
from derive.record.record import Equation
from derive.walk.lie.invariant_errors import Velocity
from tests.support.walks import SEED, record


def skew(n, i, j):
    """The matrix that turns axis i to axis j."""
    m = [[0] * n for _ in range(n)]
    m[j][i], m[i][j] = 1, -1
    return m


def unit(n, i, j):
    return [[int((r, c) == (i, j)) for c in range(n)] for r in range(n)]


TURNS = ((1, 2), (2, 0), (0, 1))


def with_bias(group, n, column, turned):
    """The problem of rates turned(row, w) of the first rows, w the measured rates less a bias that
    is kept in a column of the last rows, from 0, where the group has a 1."""
    first = n - 3 - (column == n - 1)
    bias = [unit(n, first + k, column) for k in range(3)]
    w = [f"(w_{k + 1} - A_{first + k + 1}{column + 1})" for k in range(3)]
    rate = [*(turned(i, w) for i in (1, 2, 3)), *([0] * n for _ in range(n - 3))]
    return problem_of(
        {
            "name": "biased",
            "group": {"name": "G", "basis": [*group, *bias]},
            "parameters": {},
            "kinematics": {"inputs": inputs_of(rate), "rate": rate},
        }
    )


def inputs_of(rate):
    """The inputs that stand in some rates."""
    text = " ".join(str(x) for row in rate for x in row)
    return [x for x in ("w_1", "w_2", "w_3", "a_1", "a_2", "a_3") if x in text]


def columns(i, w):
    """Row i of R j(w)."""
    A = [f"A_{i}{k}" for k in (1, 2, 3)]
    pairs = ((1, 2), (2, 0), (0, 1))
    return [f"{A[a]}*{w[b]} - {A[b]}*{w[a]}" for a, b in pairs]


@cache
def gyroscope():
    """SO(3) × R³: attitude, and the bias of a gyroscope."""
    return with_bias([skew(7, *x) for x in TURNS], 7, 6, lambda i, w: [*columns(i, w), *[0] * 4])


@cache
def imu_with_bias():
    """SE_2(3) × R³: the ready-made problem with a bias of its gyroscope."""

    def row(i, w):
        pull = " + ".join(f"A_{i}{k}*a_{k}" for k in (1, 2, 3))
        return [*columns(i, w), pull, f"A_{i}4", 0, 0, 0]

    shifts = [unit(8, i, j) for j in (3, 4) for i in range(3)]
    return with_bias([*(skew(8, *x) for x in TURNS), *shifts], 8, 4, row)


def short(label):
    return label.partition(".")[2]


def test_the_generators_of_an_imu_are_those_of_the_article():
    """On the left −j(w) and −j(a), and v into p; on the right j(γ) alone, without inputs."""
    told = {e.lhs: e.rhs for e in record("imu")["log_linear"].equations}
    left, right = ([list(row[1:]) for row in told[x][1:]] for x in ("𝒜_L", "𝒜_R"))
    names = {t for row in right for x in row for t in nodes(x) if isinstance(t, tuple)}
    assert {t[1] for t in names if t[0] == "par"} == {"g"}
    minus_w = [[0, "w_3", "-w_2"], ["-w_3", 0, "w_1"], ["w_2", "-w_1", 0]]
    minus_a = [[str(x).replace("w", "a") for x in row] for row in minus_w]
    for k in (0, 3, 6):
        assert [row[k : k + 3] for row in left[k : k + 3]] == trees(minus_w)
    assert [row[:3] for row in left[3:6]] == trees(minus_a)
    for found in (left, right):
        assert [row[3:6] for row in found[6:]] == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


@cache
def walked(made):
    return walk(made())


def trees(rows):
    return [[parse(str(x)) for x in row] for row in rows]


@pytest.mark.parametrize("made", [gyroscope, imu_with_bias])
def test_a_bias_in_the_state_has_a_counterexample(made):
    d = walked(made)
    last = d.steps[-1]
    assert short(last.label) == "counterexample"
    assert [e.lhs for e in last.given] == ["A", "Â"]
    numbers = [x for e in last.given for row in e.rhs[1:] for x in row[1:]]
    assert all(isinstance(x, (int, Fraction)) and abs(x) <= 1 for x in numbers)
    assert any(x != 0 for row in last.equations[0].rhs[1:] for x in row[1:])
    assert all(v.holds for v in check(d))


def of_group(group, rate, **more):
    text = str(rate)
    inputs = [x for x in ("u", "w", "s") if f"{x}" in text.replace("sin", "")]
    return problem_of(
        {"name": "moved", "group": group, "kinematics": {"inputs": inputs, "rate": rate} | more}
    )


UNICYCLE = [["-A_21*w", "-A_11*w", "A_11*u"], ["A_11*w", "-A_21*w", "A_21*u"], [0, 0, 0]]
CASES = {
    "a wheel": ("SE(2)", UNICYCLE, "left"),
    "in space": ("SE(2)", [["-A_21*w", "-A_11*w", "u"], ["A_11*w", "-A_21*w", "s"], [0, 0, 0]], ""),
    "turned in space": ("SO(2)", [["-A_21*w", "-A_22*w"], ["A_11*w", "A_12*w"]], "left"),
    "a flow": ("GL(2)", [["u*A_11", "u*A_12"], ["w*A_21", "w*A_22"]], "right"),
    "by functions": ("SO(2)", [["-A_21*sin(w)", "-A_22*sin(w)"], ["A_11*sin(w)", "A_12*sin(w)"]],
        "left"),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_other_groups_have_their_errors(case):
    group, rate, side = CASES[case]
    d = walk(of_group(group, rate))
    assert all(v.holds for v in check(d))
    told = [e.lhs for e in d["noise"].equations]
    assert told == (["W_R", "W_L"] if side == "right" else ["W_L", "W_R"])
    first = d["noise"].equations[0].rhs
    assert ("inv" in str(first)) == (not side)


# -- the checker ----------------------------------------------------------------------------------


def refused(d, label, *equations, **more):
    """Is a step refused with other equations, or something else of it changed?"""
    step = replace(d[label], **({"equations": equations} if equations else {}), **more)
    return not Checker(d.problem, SEED).check(step).holds


def test_the_condition_is_refused_where_it_does_not_hold():
    d, right = walked(gyroscope), record("imu")["affine"]
    step = replace(d.steps[-1], given=(), equations=right.equations)
    assert "the sides differ" in Checker(d.problem, SEED).check(step).reason


def test_other_rates_of_the_errors_are_refused():
    d = record("imu")
    left, right = d["error_rates"].equations
    plain = ("call", "ℱ", "η_L")
    assert refused(d, "error_rates", Equation(left.lhs, plain), right)
    turned = add(("call", "ℱ", "η_R"), neg(mul(("call", "ℱ", 1), "η_R")))
    assert refused(d, "error_rates", left, Equation(right.lhs, turned))
    L, R, moved, other = d["log_linear"].equations
    assert refused(d, "log_linear", Equation("𝒜_L", R.rhs), R, moved, other)
    assert refused(d, "log_linear", L, R, Equation(moved.lhs, mul("𝒜_R", "ξ_L")), other)


def test_a_linear_rate_of_the_logarithm_is_refused_where_it_is_not_exact():
    """Near the identity every error moves linearly: the series of the checker goes further."""
    d, right = walked(gyroscope), record("imu")["log_linear"]
    for moved in right.equations[2:]:
        step = replace(right, scope="G", equations=(moved,))
        assert Checker(record("imu").problem, SEED).check(replace(step, scope="SE_2_3")).holds
        assert "the sides differ" in Checker(d.problem, SEED).check(step).reason


def test_a_counterexample_off_the_group_is_refused():
    """Also where the difference is that of the two matrices."""
    problem, d = gyroscope(), walked(gyroscope)
    assert refused(d, "counterexample", given=())
    velocity = Velocity(problem.group, problem.kinematics.rate)
    A, estimate = velocity.counterexample()
    twice = tuple(tuple(2 * x for x in row) for row in A)
    step = d["counterexample"]
    for first, holds in ((A, True), (twice, False)):
        found = Equation(step.equations[0].lhs, matrix(velocity.defect(first, estimate)))
        pair = zip(("A", "Â"), (first, estimate), strict=True)
        where = tuple(Equation(x, matrix(rational(m))) for x, m in pair)
        told = Checker(d.problem, SEED).check(replace(step, equations=(found,), given=where))
        assert told.holds == holds


# -- bad input ------------------------------------------------------------------------------------
