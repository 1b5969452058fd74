"""A group of one parameter that scales keeps its coordinate s: exp(sE) with SciPy, the same motion
as by matrices, and the files read back."""

import tomllib

import numpy as np
import pytest
from scipy.linalg import expm

from derive.algebra.factor_charts import factor_charts
from derive.algebra.user_groups import group_of_basis
from derive.code.emit import emit
from derive.code.options import Options
from derive.language import rational as q
from derive.motion.first_numbers import first_numbers
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.support.library import module

BASES = {
    "dilation": "[[[1, 0], [0, 1]]]",
    "contraction": '[[["-2/3", 0], [0, "-2/3"]]]',
    "boost": '[[[0, "1/2"], ["1/2", 0]]]',
    "weights": "[[[2, 0], [0, -1]]]",
    "one axis": "[[[3, 3], [0, 0]]]",
}
BODY = """
name = "test"
[group]
name = "G"
action = "linear"
basis = {basis}
[[point]]
mass = 1
at = [1, 0.5]
[[point]]
mass = 2
at = [-0.5, 1]
[[potential]]
kind = "spring"
on = 1
anchor = [1, 1]
stiffness = 2
[initial]
exp = [0.7]
zeta_1 = 0.4
"""
LANGUAGES = ("c", "python", "rust", "julia", "javascript")


def made(basis, attitude):
    problem = problem_of(tomllib.loads(BODY.format(basis=basis)))
    record = walk(problem)
    options = Options(attitude=attitude, jacobian=("state",))
    compiled = program(problem, record, options)
    several = LANGUAGES if basis == BASES["boost"] else ("python",)
    files = emit(compiled, record, several, "test", options)
    return problem, record, compiled, files, module("test", files["test.py"])


@pytest.mark.parametrize("name", BASES)
def test_the_coordinate_is_that_of_the_exponential(name):
    problem, record, compiled, files, angle = made(BASES[name], "angle")
    assert compiled.state == ("s_1", "zeta_1")
    E = np.array(compiled.basis[0], float)
    *_, matrices = made(BASES[name], "matrix")
    k, other = angle.constants([]), matrices.constants([])
    for s in (-1.3, 0, 0.8):
        x, A = np.array([s, 0.4]), expm(s * E)
        y = np.array([*A.ravel(), 0.4])
        assert np.allclose(angle.to_matrix(x), y, rtol=1e-13, atol=1e-14)
        wanted = matrices.rhs(0.0, y, other)[-1]
        assert np.allclose(angle.rhs(0.0, x, k), [0.4, wanted], rtol=1e-12)
        assert np.isclose(angle.energy(0.0, x, k), matrices.energy(0.0, y, other), rtol=1e-13)
    assert np.allclose(first_numbers(compiled, problem, {}).x, [0.7, 0.4], rtol=1e-14)
    read = EmittedFiles(files, "test", Chart(attitude="angle"), compiled.numbers())
    assert all(x.holds for x in read.reports(record)), [x.text for x in read.reports(record)]


@pytest.mark.parametrize(
    "rows", [[[0, 2], [1, 0]], [[2, 0], [0, 3]], [[1, 1], [0, 1]], [[1, -1], [1, 1]]]
)
def test_what_has_none(rows):
    """Irrational eigenvalues, none of which all are multiples, a shear beside, a spiral."""
    assert not factor_charts(group_of_basis("G", "linear", [q.matrix(rows)]), "angle")
