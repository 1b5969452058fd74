"""What Gauss's collocation keeps to rounding, found from the equations: as it is known, in runs, in
the files."""

import numpy as np
import pytest

import derive
from derive.code.options import Options
from derive.pipeline import program

TOP = {"J_11": 1.3, "J_12": 0.1, "J_13": 0.05, "J_22": 0.9, "J_23": -0.07, "J_33": 0.4}
TOP |= {"c_1": 0.2, "c_2": 0.0, "c_3": 0.3, "g_1": 0.0, "g_2": 0.0, "g_3": -1.0}
QUATERNION, TANGENT = {"attitude": "quaternion"}, {"velocity": "tangent"}


def kept(name, **options):
    d = derive.derive(name)
    return program(d.problem, d.record, Options(step="gauss", conserved=True, **options)).keeps


@pytest.mark.parametrize(
    ("name", "options", "exact", "group"),
    [
        ("so3", {}, {"energy", "angular_momentum"}, True),
        ("so3", {"layout": "col"}, {"energy", "angular_momentum"}, True),
        ("so3", QUATERNION, set(), True),
        ("so3", TANGENT, set(), False),
        ("kirchhoff", {}, {"energy", "momentum_1", "momentum_2", "momentum_3"}, True),
        ("se3", QUATERNION, set(), True),
        ("se3", {}, {"energy"}, True),
        ("sl3", {}, set(), False),
        ("sl3", TANGENT, set(), False),
        ("so4", {}, {"energy"}, True),
        ("euler_poisson", {}, {"energy", "casimir_1", "casimir_2"}, True),
        ("comet", {}, set(), True),
    ],
)
def test_what_is_found(name, options, exact, group):
    """A body under gravity in a matrix keeps energy and momentum; free in space its energy and its
    linear momentum, as the angular one is cubic; a quaternion, quartic; det A = 1 is cubic."""
    found = kept(name, **options)
    assert ({*found.exact}, found.group) == (exact, group)
    assert not {*found.exact} & {*found.others}


def worst(f, x, h, n):
    """How much each integral changes at most, relative to the largest, over n steps."""
    m, first, found = f.begin(x), f.conserved(0.0, x), 0.0
    for _ in range(20):
        m.move(h, n // 20)
        found = np.maximum(found, np.abs(f.conserved(m.t, m.x) - first))
    assert m.h == h  # none was made in halves
    return dict(zip(f.CONSERVED, found / np.abs(first).max(), strict=True))


@pytest.mark.parametrize(
    ("name", "options", "h"), [("so3", {}, 0.4), ("so3", QUATERNION, 0.9), ("kirchhoff", {}, 0.4)]
)
def test_so_it_is_over_coarse_steps(name, options, h):
    f = derive.compile(name, step="gauss", conserved=True, **options)
    f.use({x: TOP.get(x, v) for x, v in f._names.defaults.items()})
    start = dict.fromkeys(("A_11", "A_22", "A_33", "q_0"), 1.0)
    start |= {"zeta_1": 2.7, "zeta_2": 1.2, "zeta_3": 3.3, "w_1": 1.5, "w_2": 0.9, "w_3": -1.2}
    x = np.array([start.get(name, 0.0) for name in f.STATE])
    found, known = worst(f, x, h, 2000), kept(name, **options)
    assert all(found[name] < 1e-13 for name in known.exact), found
    assert all(found[name] > 1e-12 for name in known.others), found
    assert known.exact or known.others


def test_the_files_say_it():
    d = derive.derive("kirchhoff")
    files = d.emit(None, ("c", "python", "javascript"), step="gauss", conserved=True)
    for name in ("kirchhoff_steps.h", "kirchhoff.py", "kirchhoff.mjs"):
        words = " ".join(files[name].replace("*", " ").split())
        assert "keeps the group, energy, momentum_1, momentum_2, momentum_3 to rounding" in words
        assert "to the error of its steps alone angular_momentum_1, angular_momentum_2" in words
    alone = d.emit(None, ("c",), step="gauss")["kirchhoff_steps.h"]
    assert "keeps the group, energy to rounding; --conserved" in alone
