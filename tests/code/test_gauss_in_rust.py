"""The emitted Rust's gauss: beside the C, forward and back, its order, and what it says where a
motion ends."""

from functools import cache

import numpy as np
import pytest

import derive
from derive.code.emit import EmitError
from tests.support.emitted import import_python
from tests.support.motions import follow
from tests.support.needs import need

FORMS = [
    ("so3", {}),
    ("so3", {"attitude": "quaternion"}),
    ("se3", {"layout": "col"}),
    ("sl3", {"velocity": "tangent"}),
    ("so4", {}),
    ("kirchhoff", {"conserved": True}),
    ("zeitlin", {}),
    ("two_tops", {}),
    ("comet", {}),
]
PLACES = {"A_11": 1.0, "A_22": 1.0, "A_33": 1.0, "A_44": 1.0, "q_0": 1.0}
PLACES |= {f"A{k}_{i}{i}": 1.0 for k in (1, 2) for i in (1, 2, 3)}


@pytest.fixture(scope="module", autouse=True)
def compiler():
    need("rustc")


@cache
def walked(name):
    return derive.derive(name)


def emitted(tmp_path, name, *steps, **options):
    """The folder with Rust, C and Python, parameters and a state that moves."""
    walked(name).emit(tmp_path, ("rust", "c", "python"), step=steps or ("gauss",), **options)
    code = import_python(name, tmp_path)
    rng = np.random.default_rng(5)
    p = [code.DEFAULTS.get(x, 1.0 if "J" not in x else 0.1) for x in code.PARAMETERS]
    p = [1.5 + 0.2 * k if x in ("J_11", "J_22", "J_33") else v
         for k, (x, v) in enumerate(zip(code.PARAMETERS, p, strict=True))]  # fmt: skip
    x = [PLACES.get(x, 0.3 * rng.normal() if x[0] in "zwr" else 0.0) for x in code.STATE]
    if "mu" in code.PARAMETERS:
        x[9:12] = [2, 0, 0]  # away from the centre of attraction
    if name == "zeitlin":
        x = [0.1 * value for value in x]
    if options.get("velocity") == "tangent":
        x[9:] = [0.1, 0.2, 0, -0.1, 0.05, 0.1, 0.2, 0, -0.15]
    return tmp_path, p, 0.1 * rng.normal(size=len(code.INPUTS)), np.array(x)


@pytest.mark.parametrize(("name", "options"), FORMS)
def test_it_is_the_motion_of_c_and_goes_back(tmp_path, name, options):
    """In every form of the state; at a time within a step; with a tolerance; inputs held."""
    folder, p, u, x = emitted(tmp_path, name, **options)
    calls = [("gauss", 0.02, 20), ("dense", 0.393, 0), ("gauss", -0.02, 20)]
    calls += [("gauss_to", 0.5, 1e-13), ("dense", 0.49, 0), ("gauss_to", 0.1, 1e-10)]
    found = follow("rust", folder, name, calls, x, p, u)
    expected = follow("c", folder, name, calls, x, p, u)
    size = max(1.0, np.abs(x).max())
    for a, b, (word, *_) in zip(found, expected, calls, strict=True):
        assert a.status == b.status == 0
        assert abs(a.t - b.t) < 1e-15
        assert np.abs(a.x - b.x).max() < (1e-13 if word != "gauss_to" else 1e-10) * size
    assert np.abs(found[0].x - x).max() > 1e-3
    assert np.abs(found[2].x - x).max() < 1e-12 * size


def test_its_order_and_that_of_dense(tmp_path):
    folder, p, u, x = emitted(tmp_path, "so3")
    x[9:] = [0.9, 0.4, 1.1]
    calls = [("gauss_to", 6.0, 1e-15)]
    for n in (4, 6):
        calls += [("begin", 0, 0), ("gauss", 6 / n, n)]
    exact, _, coarse, _, fine = follow("rust", folder, "so3", calls, x, p, u)
    errors = [np.abs(place.x - exact.x).max() for place in (coarse, fine)]
    assert errors[1] > 1e-13
    assert 13 < np.log(errors[0] / errors[1]) / np.log(3 / 2) < 19
    worst = []
    for h in (1.2, 0.8):
        calls = [("gauss", h, 1), ("dense", 0.37 * h, 0), ("begin", 0, 0)]
        calls += [("gauss_to", 0.37 * h, 1e-15)]
        _, inside, _, exact = follow("rust", folder, "so3", calls, x, p, u)
        worst.append(np.abs(inside.x - exact.x).max())
    assert np.log(worst[0] / worst[1]) / np.log(1.5) > 8


def test_a_long_run_keeps_the_group_and_the_energy(tmp_path):
    folder, p, u, x = emitted(tmp_path, "kirchhoff")
    code = import_python("kirchhoff", folder)
    (end,) = follow("rust", folder, "kirchhoff", [("gauss", 0.1, 20_000)], x, p, u)
    k = code.constants(np.array(p))
    assert end.status == 0
    assert code.defect(end.x) < 1e-14
    energy = code.energy(0.0, x, k)
    assert abs(code.energy(0.0, end.x, k) - energy) < 1e-12 * abs(energy)


def test_a_coarse_step_is_made_in_halves_and_no_number_is_told(tmp_path):
    folder, p, u, x = emitted(tmp_path, "so3")
    x[9:] = [0.9, 0.4, 6.1]
    calls = [("gauss", 2.0, 2), ("begin", 0, 0), ("gauss_to", 4.0, 1e-13)]
    halved, _, exact = follow("rust", folder, "so3", calls, x, p, u)
    assert (halved.status, halved.t) == (0, 4.0)
    assert abs(halved.h) < 2
    assert np.abs(halved.x - exact.x).max() < 1e-3
    nan = float("nan")
    for call in (("gauss", nan, 1), ("gauss_to", nan, 1e-9), ("gauss_to", 1e400, 1e-9)):
        (place,) = follow("rust", folder, "so3", [call], x, p, u)
        assert place.status in ((2, 3) if call[0] == "gauss" else (2,))
        assert np.array_equal(place.x, x)
    x[9] = nan
    for call in (("gauss", 0.1, 1), ("gauss_to", 1.0, 1e-9)):
        (place,) = follow("rust", folder, "so3", [call], x, p, u)
        assert (place.status, place.t) == (2, 0.0)


def test_a_collision_is_told_and_methods_take_turns(tmp_path):
    folder, p, u, _ = emitted(tmp_path, "comet", "gauss", "vern9", "rk4")
    start = [1.0, 0, 0, 0, 1, 0, 0, 0, 1, *[0.0] * 9]  # the masses fall to the centre
    (told,) = follow("rust", folder, "comet", [("gauss_to", 1.0, 1e-9)], start, p, u)
    assert told.status in (2, 3)
    assert told.t == pytest.approx(0.06471, abs=1e-4)
    assert np.isfinite(told.x).all()


def test_steps_in_turn(tmp_path):
    folder, p, u, x = emitted(tmp_path, "so3", "gauss", "vern9", "rk4")
    calls = [("gauss", 0.05, 4), ("vern9", 0.05, 4), ("dense", 0.39, 0), ("rk4", 0.001, 100)]
    calls += [("gauss", 0.05, 2), ("dense", 0.58, 0), ("gauss_to", 1.0, 1e-12)]
    places = follow("rust", folder, "so3", calls, x, p, u)
    whole = [("gauss_to", t, 1e-14) for t in (0.39, 0.4, 0.58, 0.6, 1.0)]
    exact = [place.x for place in follow("c", folder, "so3", whole, x, p, u)]
    for place, right in zip((2, 1, 5, 4, 6), exact, strict=True):
        assert np.abs(places[place].x - right).max() < 1e-9


def test_it_is_of_doubles(tmp_path):
    with pytest.raises(EmitError, match="leave out real float"):
        walked("so3").emit(None, ("rust",), step="gauss", real="float")
