"""The emitted C and Python against each other, the oracles, and known motions."""

import numpy as np
import pytest

from tests.oracles import gauss, multipliers, relative_error, sampling
from tests.support.emitted import BUILDS, arrange, compile_c, import_python, observed_order, rk4

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


def test_python_module_declares_state_basis_and_inputs(name, module):
    d = sampling.DIMENSION[name]
    assert len(module.STATE) == (12 if name == "se3" else 9) + d
    assert len(module.INPUTS) == INPUTS[name]
    for names in (module.STATE, module.PARAMETERS, module.INPUTS):
        assert isinstance(names, tuple)
        assert len(set(names)) == len(names)
        assert all(isinstance(each, str) for each in names)
    np.testing.assert_array_equal(np.asarray(module.BASIS, float), sampling.basis(name))


# ---------------------------------------------------------------- equations of motion


@pytest.mark.parametrize("build", BUILDS)
def test_c_equals_python(build, name, module, builds):
    library = builds(build, name)
    for _, p, x, u in cases(name, module, 1, STATES):
        status, kc = library.constants(p)
        k = module.constants(p)
        assert status == 0
        assert worst(name, library.rhs(0.3, x, kc, u), module.rhs(0.3, x, k, u)) < 1e-13
        assert relative_error(library.energy(0.3, x, kc), module.energy(0.3, x, k)) < 1e-13


def test_python_equals_gauss_and_multipliers(name, module):
    for body, p, x, u in cases(name, module, 2, STATES):
        dx = module.rhs(0.0, x, module.constants(p), u)
        u = u if INPUTS[name] else None
        assert worst(name, dx, gauss.rhs(name, x, body, u)) < 1e-12
        assert worst(name, dx, multipliers.rhs(name, x, body, u)) < 1e-12


@pytest.mark.parametrize("build", BUILDS)
def test_c_equals_gauss_and_multipliers(build, name, module, builds):
    library = builds(build, name)
    for body, p, x, u in cases(name, module, 3, STATES):
        dx = library.rhs(0.0, x, library.constants(p)[1], u)
        u = u if INPUTS[name] else None
        assert worst(name, dx, gauss.rhs(name, x, body, u)) < 1e-12
        assert worst(name, dx, multipliers.rhs(name, x, body, u)) < 1e-12


def test_group_element_moves_by_its_left_velocity(name, module):
    """dA/dt = A Z, and dT/dt = A w."""
    for _, p, x, u in cases(name, module, 4, 20):
        G, Z = sampling.split(name, x)
        expected = sampling.join(name, G @ Z, np.zeros(sampling.DIMENSION[name]))
        dx = module.rhs(0.0, x, module.constants(p), u)
        assert relative_error(blocks(name, dx)[0], blocks(name, expected)[0]) < 1e-14


def test_no_input_is_an_input_of_zeros(name, module):
    for _, p, x, u in cases(name, module, 5, 5):
        k = module.constants(p)
        np.testing.assert_array_equal(module.rhs(0.0, x, k), module.rhs(0.0, x, k, 0 * u))


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


@pytest.mark.parametrize("build", BUILDS)
def test_energy_is_that_of_the_points(build, name, module, builds):
    library = builds(build, name)
    for body, p, x, _ in cases(name, module, 7, STATES):
        q, v = sampling.motion(name, x, body)
        scale = np.sum(body.masses * np.sum(v * v, axis=1)) + abs(body.energy(q, v))
        for found in (
            module.energy(0.0, x, module.constants(p)),
            library.energy(0.0, x, library.constants(p)[1]),
        ):
            assert abs(found - body.energy(q, v)) < 1e-12 * scale


def test_energy_is_conserved_to_fourth_order(name, module):
    _, p, x, _ = next(cases(name, module, 8, 1))
    k = module.constants(p)

    def drift(steps):
        energy = module.energy(0.0, rk4(lambda t, y: module.rhs(t, y, k), x, 1.0, steps), k)
        return np.max(np.abs(energy - energy[0])) / abs(energy[0])

    order, coarse, fine = observed_order(drift, 100)
    assert coarse < 1e-3
    assert fine > 1e-12
    assert order >= 3.8


def test_group_element_stays_in_the_group_to_fourth_order(name, module):
    """det A = 1, and a transposed A times A = 1 for the rotations."""
    _, p, x, _ = next(cases(name, module, 9, 1))
    k = module.constants(p)

    def drift(steps):
        states = rk4(lambda t, y: module.rhs(t, y, k), x, 1.0, steps)
        A = states[:, :9].reshape(-1, 3, 3)
        off = np.abs(np.linalg.det(A) - 1)
        if name != "sl3":
            off = np.abs(np.swapaxes(A, 1, 2) @ A - np.eye(3))
        return np.max(off)

    order, coarse, fine = observed_order(drift, 100)
    assert coarse < 1e-3
    assert fine > 1e-12
    assert order >= 3.8


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
    assert worst(name, dx, gauss.rhs(name, x, body_at(name, points))) < 1e-12


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
    assert worst(name, module.rhs(0.0, x, k, u), gauss.rhs(name, x, body, u)) < 1e-12


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_c_and_python_refuse_a_parameter_that_is_not_finite(bad, name, module, builds):
    _, p, _, _ = next(cases(name, module, 10, 1))
    for i in range(len(p)):
        spoilt = np.where(np.arange(len(p)) == i, bad, p)
        assert builds("cc", name).constants(spoilt)[0] != 0, module.PARAMETERS[i]
        with pytest.raises(ValueError, match=name):
            module.constants(spoilt)


def follow(name, body, x, steps=400):
    """The state one second after ``x``, by the emitted Python."""
    module = import_python(name)
    k = module.constants(arrange(module, sampling.parameters(name, body)))
    return rk4(lambda t, y: module.rhs(t, y, k), x, 1.0, steps)[-1]


@pytest.mark.parametrize("name", ["so3", "se3"])
def test_free_axial_body(name):
    """The axis goes round the momentum; in se3 the centre of mass also falls on a parabola."""
    body = sampling.axial_body([0.0, 0.0, 0.0] if name == "so3" else [0.3, -1.0, -9.81])
    x = sampling.random_state(name, np.random.default_rng(3))
    start, end = (sampling.free_flight(name, x, body, t) for t in (0.0, 1.0))
    assert relative_error(start, x) < 1e-14
    assert worst(name, follow(name, body, x), end) < 1e-9


def test_steady_precession_of_the_lagrange_top():
    """I_3 omega_3 rate - I_1 rate^2 cos(tilt) = |g| c_3, omega_3 = spin + rate cos(tilt)."""
    body, rate, tilt = sampling.axial_body([0.0, 0.0, -9.81]), 1.7, 0.8
    first, _, third = np.diag(sampling.inertia(body))
    weight = 9.81 * sampling.moments(body)[1][2]
    spin = (weight / rate + first * rate * np.cos(tilt)) / third - rate * np.cos(tilt)
    found = follow("so3", body, sampling.precession(0.0, rate, tilt, spin), steps=2000)
    assert worst("so3", found, sampling.precession(1.0, rate, tilt, spin)) < 1e-9
