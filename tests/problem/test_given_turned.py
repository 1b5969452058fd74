"""Moments in axes of their own: the tensor is R I R̄, whatever angles R has."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import derive
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of

TENSOR = [[0.5, 0.02, 0], [0.02, 0.6, 0], [0, 0, 0.8]]
TURNS = {
    "rpy": ({"rpy": [0.3, -0.2, 0.7]}, Rotation.from_euler("xyz", [0.3, -0.2, 0.7])),
    "yaw alone": ({"rpy": [0, 0, 0.5]}, Rotation.from_euler("z", 0.5)),
    "a quaternion": ({"quaternion": [1, 2, 3, 4]}, Rotation.from_quat([2, 3, 4, 1])),
    "an axis": (
        {"rotation": {"axis": [0, 0, 1], "angle": 0.5}},
        Rotation.from_rotvec([0, 0, 0.5]),
    ),
}


@pytest.mark.parametrize("name", TURNS)
def test_a_tensor_in_axes_that_are_turned(name):
    said, R = TURNS[name]
    given = {"m": 2, "centre": [0, 0, 0], "I_centre": TENSOR, **said}
    problem = problem_of({"name": "b", "group": "SE(3)", "body": {"given": given}})
    f = derive.compile(derive.derive(problem))
    zeta = np.array([1.0, 2.0, 3.0])
    x = np.concatenate([np.eye(3).ravel(), np.zeros(3), zeta, np.zeros(3)])
    inertia = R.as_matrix() @ TENSOR @ R.as_matrix().T
    wanted = np.linalg.solve(inertia, np.cross(inertia @ zeta, zeta))
    assert np.allclose(f.rhs(0.0, x)[12:15], wanted, rtol=0, atol=1e-14)


@pytest.mark.parametrize("said", [{"rpy": [0, 0, 1]}, {"rotation": {"axis": [0, 0, 1]}}])
def test_in_the_plane_a_rotation_is_rows(said):
    given = {"m": 1, "centre": [0, 0], "J": [[1, 0], [0, 2]], **said}
    told = r"'(rpy|axis)' is of R\^3; give rotation = \[\[c, -s\], \[s, c\]\] with numbers"
    with pytest.raises(ProblemError, match=told):
        problem_of({"name": "b", "group": "SE(2)", "body": {"given": given}})
