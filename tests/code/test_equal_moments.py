"""Where moments are equal the principal frame is a choice: every build and language makes one."""

import numpy as np
import pytest

from derive import SE, SL, Covector, Gravity, Moments, Problem, SAff
from tests.support.library import library, module_of
from tests.support.needs import need

BUILDS = {
    "strict": ["-O2"],
    "plain": ["-O2", "-ffp-contract=off"],
    "fused": ["-O3", "-march=native", "-ffp-contract=fast"],
    "fast": ["-O3", "-march=native", "-fno-math-errno", "-fassociative-math", "-fno-signed-zeros",
             "-fno-trapping-math"],
}  # fmt: skip


def turned(J, seed):
    """The matrix in other axes."""
    R = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return R @ J @ R.T


BODIES = {
    "ball": np.eye(3),
    "disc": np.diag([2.0, 2, 1]),
    "needle": np.diag([1.0, 1, 3]),
    "disc along y": np.diag([2.0, 1, 2]),
    "disc across (1, 1, 1)": 2 * np.eye(3) - np.full((3, 3), 1 / 3),
    "needle across (1, 1, 0)": np.eye(3) + np.array([[1.0, 1, 0], [1, 1, 0], [0, 0, 0]]),
    **{f"disc turned {i}": turned(np.diag([2.0, 2, 1]), i) for i in range(6)},
    **{f"needle turned {i}": turned(np.diag([1.0, 1, 30]), i) for i in range(6)},
    **{f"ball turned {i}": turned(np.eye(3), i) for i in range(3)},
    "all different": turned(np.diag([1.0, 2, 3]), 9),
}


@pytest.fixture(scope="module", params=["SE(3)", "SL(3)", "SAff(3)"])
def emitted(request):
    """A free body: the module, and the library of each build."""
    need("cc")
    group = {"SE(3)": SE(3), "SL(3)": SL(3), "SAff(3)": SAff(3)}[request.param]
    problem = Problem("body", group, Moments(), [Gravity("g", 0, 1), Covector("u")], {"g": 1})
    libraries = {x: library("c", problem, flags, frame="principal") for x, flags in BUILDS.items()}
    return module_of(problem, frame="principal"), libraries


@pytest.mark.parametrize("body", BODIES)
def test_one_choice(body, emitted):
    module, libraries = emitted
    m, c = 1.7, np.array([0.3, -0.4, 0.9])
    moved = any(x.startswith("w") for x in module.STATE)
    J = BODIES[body] + (m * np.outer(c, c) if moved else 0)
    values = {"m": m, "g": 0.7} | {f"c_{i + 1}": m * x for i, x in enumerate(c)}
    values |= {f"J_{i + 1}{j + 1}": J[i, j] for i in range(3) for j in range(i, 3)}
    p = np.array([values[name] for name in module.PARAMETERS])
    x = np.random.default_rng(2).normal(size=len(module.STATE))
    k = module.constants(p)
    expected = module.into_frame(x, k)
    assert np.allclose(module.constants(np.stack([p, p]))[1], k, rtol=1e-12, atol=1e-12)
    assert np.allclose(module.out_of_frame(expected, k), x, rtol=1e-11, atol=1e-11)
    for name, build in libraries.items():
        status, constants = build.constants(p)
        assert status == 0
        found = build.said("into_frame", x, k=constants)
        assert np.abs(found - expected).max() < 1e-11 * np.abs(expected).max(), name
