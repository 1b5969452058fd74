"""atan2 in the expressions of a file: to rounding up to ±π in every language, π at the jump."""

import math

import numpy as np
import pytest

from tests.support.library import ONE_BUILD, STEPPED, derived, library

TEXT = """
name = "turned"
group = "R(2)"
[[point]]
mass = 1
at = [0, 0]
[[output]]
kind = "expression"
name = "angle"
y = ["atan2(T_2, T_1)"]
[[potential]]
kind = "expression"
U = "atan2(r1_y, r1_x)"
"""
TINY = [1.0, 1e-4, 1.5e-8, 3e-9, 1e-12, 1e-16, 1e-40, 1e-120]


def places():
    rng = np.random.default_rng(4)
    for size in TINY:
        for x, y in rng.normal(size=(12, 2)) * [1, size]:
            yield x, y
            yield y, x


@pytest.mark.parametrize("build", [ONE_BUILD[x] for x in STEPPED])
def test_it_is_the_angle(build):
    found = library(build, TEXT)
    k = found.constants([])[1]

    def angle(x, y):
        return found.said("outputs", np.array([x, y, 0.0, 0.0]), 0.0, k=k)[0]

    for x, y in [*places()][:: 1 if build == "c" else 16]:
        assert abs(angle(x, y) - math.atan2(y, x)) <= 1e-15
    for x, y, known in [(-2, 0, math.pi), (2, 0, 0), (0, 3, math.pi / 2), (-1e20, 0, math.pi)]:
        assert angle(x, y) == known


def test_its_slope_near_the_jump():
    found = library("c", TEXT)
    k = found.constants([])[1]
    for x, y in places():
        if abs(y) > 1e-100 < abs(x):
            rate = np.ravel(found.rhs(0.0, np.array([x, y, 0.0, 0.0]), k, np.zeros(0)))[-2:]
            r = math.hypot(x, y)
            assert np.abs(rate - np.array([y, -x]) / r / r).max() <= 1e-14 / r


def test_the_record_holds():
    assert derived(TEXT).check()
