"""Other sizes and bodies: the emitted Python at exact points, against d'Alembert on the points."""

from random import Random

import numpy as np
import pytest

from derive import Gravity, Group, Moments, Problem, derive
from derive.check.trials.model import Model
from derive.check.values.draws import Locus
from derive.code.assemble import assemble
from derive.language import rational as q
from derive.walk.matrices import solution
from tests.support.corpus import LARGE, record
from tests.support.library import module_of


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("name", LARGE)
def test_code_against_points(name, seed):
    p, d = LARGE[name](), record(f"points many on {name}")
    g = p.group
    code = module_of(p)
    model = Model(d.problem, g, Random(seed), 2, Locus(driven=bool(p.inputs)))
    n = g.n
    A = [float(x) for row in model.g[:n] for x in row[:n]]
    zeta = [float(x) for x in g.vee(model.Z)]
    T = [float(row[n]) for row in model.g[:n]] if g.affine else []
    x = np.array([*A, *T, *zeta])
    k = code.constants([float(model.parameters[name]) for name in code.PARAMETERS])
    u = [float(x) for x in model.input] if p.inputs else None
    dx = code.rhs(0.0, x, k, u)
    rate = [float(x) for x in g.vee(model.acceleration)]
    scale = max(map(abs, rate))
    # a random element of SL(4) may be far from a rotation: C = ĀA is inverted with its condition
    condition = np.linalg.cond(np.reshape(A, (n, n))) ** 2
    assert np.abs(dx[-g.dimension :] - rate).max() <= max(1e-12, 1e-14 * condition) * scale
    motion = q.times(model.g, model.Z)
    assert np.allclose(dx[: n * n], [float(x) for row in motion[:n] for x in row[:n]])
    energy = float(model.energy(model.t, model.g, model.Z))
    assert code.energy(0.0, x, k) == pytest.approx(energy, rel=1e-9)


GROUPS = ("SL(2)", "SL(3)", "SL(4)", "GL(2)", "GL(3)", "SAff(2)", "SAff(3)", "Aff(2)", "Aff(3)")


@pytest.mark.parametrize("group", GROUPS)
def test_a_multiplier_costs_less_than_the_mass_matrix(group, monkeypatch):
    """Why the normal space of 𝔤 is used where it has at most one dimension."""
    n = int(group[-2])
    problem = Problem("p", Group(group), Moments(), [Gravity(*[0] * (n - 1), -1)])

    def operations():
        d = derive(problem)
        return assemble(d.record, d.problem.group).functions["rhs"].operations()

    ours = operations()
    monkeypatch.setattr(solution, "MULTIPLIERS", -1)
    other = operations()
    assert sum(ours.values()) < sum(other.values())
    assert "Aff" not in group or 3 * ours["mul"] < 2 * other["mul"]


def test_a_problem_in_numbers_has_no_parameters():
    """What is 0, 1 or alike for this body is folded: J diagonal, gravity along an axis."""
    J = [[1, 0, 0], [0, 2, 0], [0, 0, 3]]
    body = Moments(m=1, c=[0, 0, 0.2], J=J)
    d = derive(Problem("heavy", Group("SO(3)"), body, [Gravity(0, 0, -9.81)]))
    program = assemble(d.record, d.problem.group)
    assert program.parameters == program.constants == ()
    operations = program.functions["rhs"].operations()
    assert operations["mul"] <= 27
    assert operations["add"] <= 11
