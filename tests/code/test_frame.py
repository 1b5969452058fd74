"""The principal frame: the same motion as in the frame that is given, with fewer operations; where
moments are equal every build and language makes one choice; the emitted Python finds the axes."""

import numpy as np
import pytest

from derive import Covector, Gravity, Moments, Problem, derive
from derive.code.emit import EmitError
from derive.code.languages import LANGUAGES
from derive.pipeline import walk
from derive.problem.principal import principal
from derive.problem.toml import problem_of
from tests.code.test_forms import given, started
from tests.support.library import library, module_of
from tests.support.needs import need, present
from tests.support.states import state
from tests.support.walks import own_verdicts


def both(problem):
    """The modules in the given frame and in the principal one."""
    return module_of(problem), module_of(problem, frame="principal")


def refused(problem, p, why):
    """What C tells of parameters that Python refuses with some words."""
    with pytest.raises(ValueError, match=why):
        module_of(problem, frame="principal").constants(p)
    if present("cc"):
        return library("c", problem, frame="principal").constants(p)[0]
    return {"singular": 1, "not finite": 2}[why]


@pytest.mark.parametrize("name", ["SO(3)", "SE(3)", "SL(3)", "SAff(3)", "GL(3)"])
def test_the_frame_is_principal(name):
    """In the new parameters J is diagonal, c = 0 where there are translations: few numbers."""
    framed = principal(given(name))
    body = framed.body
    assert all(x == 0 for i, row in enumerate(body.given.J) for j, x in enumerate(row) if i != j)
    if framed.affine:
        assert body.given.c == (0, 0, 0)


@pytest.mark.parametrize("name", ["SO(3)", "SL(3)", "SAff(3)", "SE(2)", "comet"])
def test_the_problem_in_the_frame_is_checked_like_any_other(name):
    record = walk(principal(given(name)))
    assert all(v.holds for v in own_verdicts(record))


def test_bodies_without_a_frame_are_refused_by_the_code():
    """All mass on a line: no moment about it."""
    code, p = module_of("so3"), started("so3", {}, 1)[0]
    r = np.array([0.3, -2.0, 0.7])
    at = {name: i for i, name in enumerate(code.PARAMETERS)}
    for i in range(3):
        for j in range(i, 3):
            p[at[f"J_{i + 1}{j + 1}"]] = r[i] * r[j]
    assert refused("so3", p, "singular") == 1


BODIES = {
    "top": ("SO(3)", {"given": {"m": 1, "c": [0, 0, 1], "J": np.diag([2, 1, 4]).tolist()}}),
    "ball": ("SE(3)", {"solid": "ball", "density": 2, "radius": 1}),
}


@pytest.mark.parametrize("gravity", [0.0, 1e-9, 1.0, 1e200])
@pytest.mark.parametrize("body", BODIES)
def test_gravity_of_any_size(body, gravity):
    """Of a ball every axis is principal, and rounding may choose any."""
    group, given = BODIES[body]
    data = {"name": "heavy", "group": group, "parameters": {"g": 1.0}, "body": given}
    data["potential"] = [{"kind": "gravity", "g": ["g", "2*g", "-g"]}]
    plain, framed = both(problem_of(data))
    _, x, *_ = state(plain)
    k0, k = plain.constants({"g": gravity}), framed.constants({"g": gravity})
    expected = framed.into_frame(plain.rhs(0.0, x, k0), k)
    found = framed.rhs(0.0, framed.into_frame(x, k), k)
    assert np.allclose(found, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("name", [name for name, x in LANGUAGES.items() if not x.framed])
def test_some_languages_have_no_frame(name):
    with pytest.raises(EmitError, match=f"not in {name}"):
        derive("so3").emit(None, (name,), frame="principal")


# ---------------------------------------------------------------- equal moments

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


ALIKE = {
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
    problem = Problem(
        "body", request.param, Moments(), [Gravity("g", 0, 1), Covector("u")], {"g": 1}
    )
    libraries = {x: library("c", problem, flags, frame="principal") for x, flags in BUILDS.items()}
    return module_of(problem, frame="principal"), libraries


@pytest.mark.parametrize("body", ALIKE)
def test_one_choice(body, emitted):
    module, libraries = emitted
    m, c = 1.7, np.array([0.3, -0.4, 0.9])
    moved = any(x.startswith("w") for x in module.STATE)
    J = ALIKE[body] + (m * np.outer(c, c) if moved else 0)
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


# ---------------------------------------------------------------- the axes of the emitted Python

SOLIDS = {
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
    values |= dict(zip(names, SOLIDS[body], strict=True)) | {"m": 2.0}
    values |= {"c_1": 0.1, "c_2": -0.2, "c_3": 0.3} | {"m1": 1.0, "m2": 2.0, "m3": 3.0}
    return np.array([values[x] for x in module.PARAMETERS])


@pytest.mark.parametrize("body", SOLIDS)
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


def test_a_ball_has_its_moments():
    module = module_of("ellipsoid")
    p = dict.fromkeys(module.PARAMETERS, 1.0) | {"rho": 3.0, "a": 2.0, "b": 2.0, "c": 2.0}
    moments, _ = module.principal_axes([p[x] for x in module.PARAMETERS])
    assert np.allclose(moments, 0.4 * (3 * 4 / 3 * np.pi * 8) * 4, rtol=1e-14)
