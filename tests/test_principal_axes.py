"""The emitted Python turns a solid to its principal axes: the same motion, in the other frame."""

import numpy as np
import pytest

from tests.emitted import import_python

BODIES = {
    "any": [1.3, 0.1, 0.05, 0.9, -0.07, 0.4],
    "two alike": [1.0, 0.0, 0.0, 1.0, 0.0, 0.3],
    "a ball": [0.5, 0.0, 0.0, 0.5, 0.0, 0.5],
    "turned, two alike": [0.65, 0.35, 0.0, 0.65, 0.0, 0.3],
}


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("name", ["so3", "se3"])
def test_the_motion_is_the_same(name, body):
    module, rng = import_python(name), np.random.default_rng(4)
    values = dict(zip(module.PARAMETERS, rng.normal(size=len(module.PARAMETERS)), strict=True))
    names = [f"J_{i}{j}" for i in (1, 2, 3) for j in range(i, 4)]
    values |= dict(zip(names, BODIES[body], strict=True)) | {"m": 2.0}
    values |= {"c_1": 0.1, "c_2": -0.2, "c_3": 0.3}
    p = np.array([values[x] for x in module.PARAMETERS])
    R, turned = module.principal_axes(p)
    assert np.allclose(R.T @ R, np.eye(3), atol=1e-14)
    assert np.linalg.det(R) > 0
    J = {x: v for x, v in zip(module.PARAMETERS, turned, strict=True) if x in names}
    assert [J[x] for x in ("J_12", "J_13", "J_23")] == [0, 0, 0]
    assert J["J_11"] <= J["J_22"] <= J["J_33"]
    A = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    vectors = rng.normal(size=(2, 3) if name == "se3" else (1, 3))
    T = rng.normal(size=3 if name == "se3" else 0)
    forces = rng.normal(size=vectors.shape)

    def rates(p, A, vectors, forces):
        x = np.concatenate([A.ravel(), T, vectors.ravel()])
        return module.rhs(0.0, x, module.constants(p), forces.ravel())[-vectors.size :]

    here = rates(p, A, vectors, forces).reshape(vectors.shape)
    there = rates(turned, A @ R, vectors @ R, forces @ R).reshape(vectors.shape)
    assert np.allclose(there, here @ R, rtol=1e-11, atol=1e-11)
