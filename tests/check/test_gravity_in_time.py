"""What a sensor reads where gravity depends on the time; determinants of the largest products."""

from dataclasses import replace
from fractions import Fraction
from itertools import permutations
from math import prod

import numpy as np
import pytest

import derive
from derive.check.checker import checker_of
from derive.check.values.arithmetic import EvaluationError, Nilpotent, determinant
from derive.problem.toml import problem_of
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.support.library import derived

SHAKEN = {
    "name": "shaken",
    "group": "SO(2)",
    "point": [{"mass": 2, "at": [0, -1]}],
    "potential": [{"kind": "gravity", "g": [0, "-9.81 - cos(t)"]}],
    "output": [{"kind": "specific_force", "name": "a", "at": [0, -1]}],
}


def test_a_sensor_where_gravity_is_shaken():
    d = derived(problem_of(SHAKEN))
    assert d.check()
    (report,) = EmittedFiles(d.emit(languages=("python",)), "shaken", Chart()).reports(d.record)
    assert report.holds
    assert "outputs" in report.text
    f = derive.compile(d)
    t, turned, rate = 0.7, 0.4, 1.3
    c, s = np.cos(turned), np.sin(turned)
    A = np.array([[c, -s], [s, c]])
    # the rod pulls along itself alone: ω²l and what bears the weight
    g = 9.81 + np.cos(t)
    assert np.allclose(f.outputs(t, [*A.flat, rate]), [0, rate**2 + g * c], atol=1e-14)


def by_definition(a):
    """The determinant, over all permutations."""
    n = range(len(a))
    signs = {p: (-1) ** sum(p[i] < p[j] for i in n for j in range(i)) for p in permutations(n)}
    return sum(sign * prod((a[i][p[i]] for i in n), start=Fraction(1)) for p, sign in signs.items())


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_a_determinant_in_a_ring(n):
    draw = np.random.default_rng(n).integers(-9, 9, size=(2, n, n)).tolist()
    a = tuple(tuple(Nilpotent({0: Fraction(x), 1: Fraction(y)}) for x, y in zip(*rows, strict=True))
              for rows in zip(*draw, strict=True))  # fmt: skip
    assert determinant(a).parts == by_definition(a).parts
    plain = tuple(tuple(map(Fraction, row)) for row in draw[0])
    assert determinant(plain) == by_definition(plain)


@pytest.mark.parametrize("n", [12, 13])
def test_a_determinant_of_the_largest_product(n):
    draw = np.random.default_rng(n).integers(-3, 3, size=(n, n))
    a = tuple(tuple(map(Fraction, row)) for row in draw.tolist())
    if n == 12:
        assert abs(determinant(a) / Fraction(np.linalg.det(draw)) - 1) < 1e-12
    else:
        with pytest.raises(EvaluationError, match="of size up to 12 only"):
            determinant(a)


PLACES = [(1, [1, 0]), (2, [0, 0, 1]), (3, [0, 1]), (4, [1, 2, 0]), (4, [0, 0, 1])]
POINTS = [{"mass": k, "block": block, "at": at} for k, (block, at) in enumerate(PLACES, 1)]
THREE = {"name": "three", "group": "SO(2) x R(3) x SO(2) x SO(3)", "point": POINTS}


def test_a_product_of_more_than_eight_rows():
    d = derived(problem_of(THREE))
    checker = checker_of(d.record.problem, 3)
    (step,) = [x for x in d.record.steps if x.rule == "relation" and ("det", "A") in lefts(x)]
    assert checker.check(step).holds
    false = replace(step, equations=[replace(e, rhs=2) for e in step.equations])
    assert not checker.check(false).holds


def lefts(step):
    return [e.lhs for e in step.equations]
