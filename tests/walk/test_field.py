"""A uniform field on charged points, −Σ q_i ⟨E(t), r_i⟩, beside Gauss's principle."""

import numpy as np
import pytest

import derive
from derive import Points, Problem, Spring
from derive.problem.problem import ProblemError
from tests.support.kinds import agrees, cloud
from tests.support.walks import own_verdicts

VALUES = {"q": 0.75, "w": 1.5}
CHARGES = ["q", "-q", 0, 2, 1]
FIELD = [1, "3*cos(w*t)", "q*t^2"]


def field(t, n):
    return np.array([1, 3 * np.cos(1.5 * t), 0.75 * t**2])[:n]


@pytest.mark.parametrize(
    "group", ["SO(3)", "SE(3)", "SL(3)", "SAff(3)", "Aff(3)", "SE(2)", "GL(2)"]
)
def test_on_groups(group, tmp_path):
    """A spring beside it; the field depends on the time."""
    n = int(group[-2])
    masses, r = cloud(n, np.random.default_rng(2), 5)
    body = Points(*((float(m), at.tolist()) for m, at in zip(masses, r, strict=True)))
    forces = [derive.Field(FIELD[:n], CHARGES), Spring(1, 2, "q", 0.5)]
    problem = Problem("charged", group, body, forces, parameters=VALUES)
    q = np.array([0.75, -0.75, 0, 2, 1])

    def U(t, A, T):
        moved = r @ A.T + T
        apart = moved[0] - moved[1]
        spring = 0.75 * (np.sqrt(apart @ apart) - 0.5) ** 2 / 2
        return spring - q @ (moved @ field(t, n))

    agrees(problem, VALUES, masses, r, U, tmp_path)


def labels(*forces):
    body = Points((1, [1, 0, 0]), (1, [0, 1, 0]), (1, [0, 0, 1]))
    record = derive.derive(Problem("b", "SO(3)", body, forces)).record
    assert all(v.holds for v in own_verdicts(record))
    return {s.label for s in record.steps}


def test_the_energy_is_kept_where_the_field_does_not_change():
    assert "b.conserved" in labels(derive.Field([0, 0, 1], [1, 2, 3]))
    assert "b.conserved" not in labels(derive.Field([0, 0, "cos(t)"], [1, 2, 3]))


@pytest.mark.parametrize(
    ("E", "charges", "told"),
    [
        ([1, 0, 0], [1, 2], "charges: expected a list of 3 expressions"),
        ([1, 0], [1, 2, 3], "E: expected a list of 3 expressions"),
        (["r1_x", 0, 0], [1, 2, 3], "'r1_x' is known in the 'U' of an expression alone"),
        ([1, 0, 0], ["t", 2, 3], "'t'"),
    ],
)
def test_what_is_refused(E, charges, told):
    with pytest.raises(ProblemError, match=rf"potential 1.*{told}"):
        labels(derive.Field(E, charges))


def test_no_points():
    with pytest.raises(ProblemError, match="'charges' is for \\[\\[point\\]\\] tables"):
        Problem("b", "SE(3)", derive.Moments(), [derive.Field([1, 0, 0], [])])
