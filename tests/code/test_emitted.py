"""The emitted C and Python against each other and the oracles; bodies that are refused."""

import numpy as np
import pytest

from tests.oracles import general, multipliers, relative_error, sampling
from tests.support.emitted import BUILDS, arrange, compile_c, import_python
from tests.support.needs import present

NAMES = ("so3", "se3", "sl3")
STATES = 200
INPUTS = {"so3": 3, "se3": 6, "sl3": 0}


@pytest.fixture(scope="module")
def builds(tmp_path_factory):
    """A function (build, name) -> CLibrary that compiles once, and skips without the compiler."""
    kept = {}

    def get(build, name):
        if (build, name) not in kept:
            kept[build, name] = compile_c(build, name, tmp_path_factory.mktemp(name))
        return kept[build, name]

    return get


@pytest.fixture(scope="module", params=NAMES)
def name(request):
    return request.param


@pytest.fixture(scope="module")
def module(name):
    return import_python(name)


def cases(name, module, seed, count):
    """Yield random bodies, their arranged parameters, states and inputs (empty for sl3)."""
    rng = np.random.default_rng([seed, NAMES.index(name)])
    for _ in range(count):
        body, x = sampling.random_body(name, rng), sampling.random_state(name, rng)
        p = arrange(module, sampling.parameters(name, body))
        yield body, p, x, rng.normal(size=INPUTS[name])


def listed(name, body):
    """The body as a problem file has it, its points listed."""
    data = {"group": f"{name[:2].upper()}(3)", "input": [{"name": "u", "kind": "covector"}]}
    points = zip(body.masses, body.points, strict=True)
    data["point"] = [{"mass": m, "at": [*r]} for m, r in points]
    data["potential"] = [{"kind": "gravity", "g": [*body.gravity]}]
    for i, j in np.argwhere(np.triu(body.springs)):
        spring = {"between": [i + 1, j + 1], "stiffness": body.springs[i, j]}
        data["potential"].append({"kind": "spring", **spring})
    return data


def by_gauss(name, x, body, u=None):
    """dx/dt by Gauss's principle."""
    return general.rhs(listed(name, body), sampling.basis(name), {}, 0.0, x, u)


def blocks(name, dx):
    """The velocity of the group element and that of the coordinates, compared separately."""
    d = sampling.DIMENSION[name]
    return dx[:-d], dx[-d:]


def worst(name, found, expected):
    """The larger relative error of the two blocks."""
    pairs = zip(blocks(name, found), blocks(name, expected), strict=True)
    return max(relative_error(*pair) for pair in pairs)


@pytest.mark.parametrize("build", BUILDS)
def test_compiles_without_a_warning_and_declares_the_sizes_of_the_module(
    build, name, module, builds
):
    sizes = builds(build, name).sizes
    p = next(cases(name, module, 0, 1))[1]
    assert sizes == {
        "STATE": len(module.STATE),
        "ALGEBRA": len(module.BASIS),
        "PARAMETERS": len(module.PARAMETERS),
        "INPUTS": len(module.INPUTS),
        "CONSTANTS": len(module.constants(p)),
    }


# ---------------------------------------------------------------- equations of motion


def test_rates_and_energy_are_those_of_the_points(name, module, builds):
    """By Gauss's principle and by multipliers; of Python, and of the C of every compiler."""
    known = [builds(build, name) for build in BUILDS if present(build)]
    for body, p, x, u in cases(name, module, 2, STATES):
        k, own = module.constants(p), u if INPUTS[name] else None
        dx, energy = module.rhs(0.0, x, k, u), module.energy(0.0, x, k)
        assert worst(name, dx, by_gauss(name, x, body, own)) < 1e-12
        assert worst(name, dx, multipliers.rhs(name, x, body, own)) < 1e-12
        q, v = sampling.motion(name, x, body)
        scale = np.sum(body.masses * np.sum(v * v, axis=1)) + abs(body.energy(q, v))
        assert abs(energy - body.energy(q, v)) < 1e-12 * scale
        for library in known:
            status, kc = library.constants(p)
            assert status == 0
            assert worst(name, library.rhs(0.0, x, kc, u), dx) < 1e-13
            assert relative_error(library.energy(0.0, x, kc), energy) < 1e-13


def test_batches_are_the_states_one_by_one(name, module):
    """rhs and energy on states (5, 4, N), with one input for all and with one input for each."""
    rng = np.random.default_rng([6, NAMES.index(name)])
    _, p, _, u = next(cases(name, module, 6, 1))
    k = module.constants(p)
    x = np.array([[sampling.random_state(name, rng) for _ in range(4)] for _ in range(5)])
    many = rng.normal(size=(5, 4, INPUTS[name]))
    free, same, each = module.rhs(0.0, x, k), module.rhs(0.0, x, k, u), module.rhs(0.0, x, k, many)
    energy = module.energy(0.0, x, k)
    assert free.shape == same.shape == each.shape == x.shape
    assert energy.shape == (5, 4)
    for at in np.ndindex(5, 4):
        assert worst(name, free[at], module.rhs(0.0, x[at], k)) < 1e-14
        assert worst(name, same[at], module.rhs(0.0, x[at], k, u)) < 1e-14
        assert worst(name, each[at], module.rhs(0.0, x[at], k, many[at])) < 1e-14
        assert relative_error(energy[at], module.energy(0.0, x[at], k)) < 1e-14


# ---------------------------------------------------------------- bodies without an inverse


LINES = {
    "axis": (1, 0, 0),
    "integers": (1, -2, 2),
    "irrational": (0.3, np.sqrt(2), -np.pi),
    "tilted": (1, 1e-4, 0),
}
LINE = np.outer([1.0, -2.0, 0.5, 3.0], [1, -2, 2])
FLAT = np.array([[1, 0, 0], [-1, 2, 0], [0, -1, 0], [2, 1, 0]])
AWAY = np.array([0.5, 1.5, -1.0])


def body_at(name, points):
    """A body with masses 1, 1.1, 1.2, ... at these points, with gravity or springs."""
    count = len(points)
    springs = 1.0 - np.eye(count) if name == "sl3" else np.zeros((count, count))
    gravity = np.zeros(3) if name == "sl3" else np.array([0.0, 0.0, -9.81])
    return sampling.Body(1 + 0.1 * np.arange(count), np.asarray(points, float), gravity, springs)


def degenerate(name, direction):
    """Points that leave a motion of the algebra without inertia.

    so3: on a line through 0; se3: on any line; sl3: in a plane through 0.
    """
    direction = np.array(direction, float)
    if name == "sl3":
        flat = np.random.default_rng(1).integers(-4, 5, size=(4, 3))
        points = flat - np.outer(flat @ direction, direction) / (direction @ direction)
        return body_at(name, points)
    points = np.outer([1.0, -2.0, 0.5, 3.0], direction)
    return body_at(name, points + AWAY if name == "se3" else points)


@pytest.mark.parametrize("direction", LINES.values(), ids=LINES.keys())
def test_a_degenerate_body_is_refused(direction, name, module, builds):
    p = arrange(module, sampling.parameters(name, degenerate(name, direction)))
    assert builds("cc", name).constants(p)[0] != 0
    with pytest.raises(ValueError, match=name):
        module.constants(p)


def test_a_body_that_only_looks_degenerate_is_accepted(name, module, builds):
    """so3: a line off the origin; se3: a plane; sl3: a plane off the origin."""
    points = {"so3": LINE + AWAY, "se3": FLAT, "sl3": FLAT + np.array([0, 0, 1])}[name]
    p = arrange(module, sampling.parameters(name, body_at(name, points)))
    status, kc = builds("cc", name).constants(p)
    x = sampling.random_state(name, np.random.default_rng(2))
    dx = module.rhs(0.0, x, module.constants(p))
    assert status == 0
    assert worst(name, builds("cc", name).rhs(0.0, x, kc), dx) < 1e-13
    assert worst(name, dx, by_gauss(name, x, body_at(name, points))) < 1e-12


@pytest.mark.parametrize("far", [30, 1000])
def test_far_from_its_origin_a_line_is_refused_and_a_plane_accepted(far, builds):
    module = import_python("se3")
    bodies = [body_at("se3", points + far * AWAY) for points in (LINE, FLAT)]
    ps = [arrange(module, sampling.parameters("se3", body)) for body in bodies]
    assert [builds("cc", "se3").constants(p)[0] != 0 for p in ps] == [True, False]
    module.constants(ps[1])
    with pytest.raises(ValueError, match="se3"):
        module.constants(ps[0])


@pytest.mark.parametrize("name", ["so3", "se3"])
def test_a_thin_rod_along_an_axis_keeps_its_digits(name):
    """The smallest moment of inertia is 1e-6 of the largest: it is a sum, not a difference."""
    module, h = import_python(name), 1e-3
    body = body_at(name, [[h, 0, 1], [-h, 0, -1], [0, h, 0.5], [0, -h, -0.7]])
    k = module.constants(arrange(module, sampling.parameters(name, body)))
    x, u = sampling.random_state(name, np.random.default_rng(4)), np.ones(INPUTS[name])
    assert worst(name, module.rhs(0.0, x, k, u), by_gauss(name, x, body, u)) < 1e-12


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_c_and_python_refuse_a_parameter_that_is_not_finite(bad, name, module, builds):
    _, p, _, _ = next(cases(name, module, 10, 1))
    for i in range(len(p)):
        spoilt = np.where(np.arange(len(p)) == i, bad, p)
        assert builds("cc", name).constants(spoilt)[0] != 0, module.PARAMETERS[i]
        with pytest.raises(ValueError, match=name):
            module.constants(spoilt)
