"""The motion of points in momenta, beside Gauss's principle and sums over the points.

Π_a = Σ m ⟨v, gE_a r⟩, its rate by the accelerations of the oracle, the Poisson tensor by the flows.
"""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import derive
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from tests.oracles import general
from tests.support.library import module_of

ROOT = Path(__file__).parents[2]
READY = ("so3", "se3", "sl3", "saff3", "so4", "sim3", "heisenberg", "screw", "jelly")
READY += ("two_tops", "su2", "gl3", "comet", "sp4")
POINTS = [
    {"mass": 1.5, "at": [1.0, 0.2, 0.5], "block": 1},
    {"mass": 0.7, "at": [0.1, 1.0, -0.3], "block": 1},
    {"mass": 1.2, "at": [-0.4, 0.3, 1.0], "block": 1},
]
TWO = {
    "name": "test",
    "group": "SE(3) x SE(3)",
    "point": POINTS + [{**x, "block": 2} for x in POINTS],
    "potential": [{"kind": "spring", "between": [1, 4], "stiffness": 2, "length": 0.5}],
    "input": [{"name": "F", "kind": "force", "on": 1, "frame": "space"}],
}
FLAT = {
    "name": "test",
    "group": "SE(2)",
    "point": [{"mass": x["mass"], "at": x["at"][:2]} for x in POINTS],
    "damping": [{"coefficient": 0.3}],
    "input": [{"name": "u", "kind": "covector"}],
}
CASES = {name: name for name in READY} | {"two bodies": TWO, "flat": FLAT}


def data_of(case):
    if isinstance(CASES[case], dict):
        return CASES[case]
    return tomllib.loads((ROOT / f"derive/problems/{case}.toml").read_text(encoding="utf-8"))


def by_sums(data, E, p, t, x, u):
    """Π_a, its rate along the motion, and the brackets {Π_a, Π_b}: of gE_a moved by gE_b."""
    found, (G, zeta) = general.places(data, p), general.split(data, x, len(E))
    rates = general.rhs(data, E, p, t, x, u)[-len(E) :]
    Z, change = np.tensordot(zeta, E, 1), np.tensordot(rates, E, 1)
    v, a = found.moved(G @ Z), found.moved(G @ (change + Z @ Z))

    def along(X):
        return found.masses @ (v * found.moved(G @ X))

    momenta = [along(e) for e in E]
    pushed = [found.masses @ (a * found.moved(G @ e)) + along(Z @ e) for e in E]
    return momenta, pushed, [[along(f @ e - e @ f) for f in E] for e in E]


@pytest.mark.parametrize("case", CASES)
def test_beside_sums_over_the_points(case):
    data = data_of(case)
    m, rng = module_of(problem_of(data), momenta=True), np.random.default_rng(4)
    E, p = np.array(m.BASIS, float), general.parameters(data)
    k = m.constants([p[x] for x in m.PARAMETERS])
    for _ in range(2):
        x, u = general.random_state(data, E, rng), rng.normal(size=len(m.INPUTS))
        momenta, pushed, brackets = by_sums(data, E, p, 0.4, x, u if len(u) else None)
        y = np.array([*x[: -len(E)], *momenta])
        scale = max(1, *map(abs, momenta), *map(abs, pushed))
        assert np.abs(m.momentum(0.4, x, k) - y).max() < 1e-12 * scale
        assert np.abs(m.velocity(0.4, y, k) - x).max() < 1e-11 * scale
        dy = m.momentum_rhs(0.4, y, k, u if len(u) else None)
        assert np.abs(dy[-len(E) :] - pushed).max() < 1e-11 * scale
        turned = m.rhs(0.4, x, k, u if len(u) else None)[: -len(E)]
        assert np.abs(dy[: -len(E)] - turned).max() < 1e-11 * scale
        assert np.abs(m.poisson(0.4, y, k) - brackets).max() < 1e-12 * scale


def test_euler_in_momenta_is_as_short_as_by_hand():
    """I⁻¹ℓ, ℓ ∧ ζ, Āγ, c ∧ Āγ and Aj(ζ): 9 + 6 + 9 + 6 + 18 products."""
    p = problem_of(data_of("so3"))
    functions = program(p, walk(p), Options(momenta=True)).functions
    assert functions["momentum_rhs"].operations()["mul"] == 48
    assert functions["velocity"].operations()["mul"] == 9


@pytest.mark.parametrize("name", ["so3", "se3"])
def test_a_quaternion_turns_by_the_velocity_of_the_momenta(name):
    """q̇ = ½q(0, ζ), the rest as with a matrix."""
    rng, turned = np.random.default_rng(5), Rotation.from_rotvec([0.3, -1.1, 0.7])
    shift, velocity = rng.normal(size=3 * (name == "se3")), rng.normal(size=3 + 3 * (name == "se3"))
    q = turned.as_quat()[[3, 0, 1, 2]]
    by_matrix = derive.compile(name, momenta=True)
    f = derive.compile(name, momenta=True, attitude="quaternion")
    y = f.momentum(0.0, np.concatenate([q, shift, velocity]))
    whole = np.concatenate([turned.as_matrix().ravel(), shift, velocity])
    other = by_matrix.momentum_rhs(0.0, by_matrix.momentum(0.0, whole))
    found = f.momentum_rhs(0.0, y)
    w, z = q[0], velocity[:3]
    rate = np.array([-q[1:] @ z, *(w * z + np.cross(q[1:], z))]) / 2
    assert found[:4] == pytest.approx(rate, abs=1e-14)
    assert found[4:] == pytest.approx(other[9:], abs=1e-12)
