"""The emitted Python turns a solid to its principal axes: the same motion, in the other frame."""

import numpy as np
import pytest

from tests.support.library import module_of

BODIES = {
    "any": [1.3, 0.1, 0.05, 0.9, -0.07, 0.4],
    "two alike": [1.0, 0.0, 0.0, 1.0, 0.0, 0.3],
    "a ball": [0.5, 0.0, 0.0, 0.5, 0.0, 0.5],
    "turned, two alike": [0.65, 0.35, 0.0, 0.65, 0.0, 0.3],
}


NAMES = [f"{x}{i}" for i in (1, 2, 3) for x in "mxyz"]
POINTS = """
name = "rattle"
group = "SE(3)"
[parameters]
k = {}
[[potential]]
kind = "spring"
on = 1
anchor = [1, 2, 3]
stiffness = "k"
length = 1
"""
POINTS = POINTS.replace("k = {}", "\n".join(f"{x} = {{}}" for x in ("k", *NAMES)))
POINTS += "".join(f'[[point]]\nmass = "m{i}"\nat = ["x{i}", "y{i}", "z{i}"]\n' for i in (1, 2, 3))


def rates(module, p, A, T, vectors, forces):
    x = np.concatenate([A.ravel(), T, vectors.ravel()])
    dx = module.rhs(0.0, x, module.constants(p), forces.ravel())
    return dx[-vectors.size :].reshape(vectors.shape)


def parameters(name, body, module, rng):
    values = dict(zip(module.PARAMETERS, rng.normal(size=len(module.PARAMETERS)), strict=True))
    names = [f"J_{i}{j}" for i in (1, 2, 3) for j in range(i, 4)]
    values |= dict(zip(names, BODIES[body], strict=True)) | {"m": 2.0}
    values |= {"c_1": 0.1, "c_2": -0.2, "c_3": 0.3} | {"m1": 1.0, "m2": 2.0, "m3": 3.0}
    return np.array([values[x] for x in module.PARAMETERS])


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("name", ["so3", "se3", POINTS], ids=["so3", "se3", "points"])
def test_the_motion_is_the_same(name, body):
    module = module_of(name)
    rng = np.random.default_rng(4)
    p = parameters(name, body, module, rng)
    moments, R = module.principal_axes(p)
    assert np.allclose(module.inertia(p), R @ np.diag(moments) @ R.T, atol=1e-13 * moments[-1])
    assert np.allclose(R.T @ R, np.eye(3), atol=1e-14)
    assert np.linalg.det(R) > 0
    assert np.all(np.diff(moments) >= 0)
    turned = module.turned(p, R)
    there = module.inertia(turned)
    assert np.allclose(there, np.diag(moments), atol=1e-13 * moments[-1])
    A = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    affine = len(module.STATE) == 18
    vectors = rng.normal(size=(2, 3) if affine else (1, 3))
    T = rng.normal(size=3 if affine else 0)
    forces = rng.normal(size=vectors.shape)
    here = rates(module, p, A, T, vectors, forces)
    there = rates(module, turned, A @ R, T, vectors @ R, forces @ R)
    assert np.allclose(there, here @ R, rtol=1e-11, atol=1e-11)


def test_a_batch_of_bodies():
    module, rng = module_of("so3"), np.random.default_rng(5)
    batch = np.stack([parameters("so3", body, module, rng) for body in BODIES])
    moments, R = module.principal_axes(batch)
    turned = module.turned(batch, R)
    for i, p in enumerate(batch):
        assert np.allclose(moments[i], module.principal_axes(p)[0])
        assert np.allclose(turned[i], module.turned(p, R[i]))


def test_a_ball_has_its_moments():
    module = module_of("ellipsoid")
    p = dict.fromkeys(module.PARAMETERS, 1.0) | {"rho": 3.0, "a": 2.0, "b": 2.0, "c": 2.0}
    moments, _ = module.principal_axes([p[x] for x in module.PARAMETERS])
    assert np.allclose(moments, 0.4 * (3 * 4 / 3 * np.pi * 8) * 4, rtol=1e-14)


def test_parameters_by_name():
    """Wherever parameters are taken, a dictionary will do."""
    so3 = module_of("so3")
    named = {"J_12": 0.2, "c_3": 0.1}
    p = np.array([named.get(x, so3.DEFAULTS.get(x)) for x in so3.PARAMETERS])
    for function in (so3.constants, so3.inertia, lambda p: so3.principal_axes(p)[1]):
        np.testing.assert_array_equal(function(named), function(p))
    np.testing.assert_array_equal(so3.turned(named, np.eye(3)), p)
