"""Torsion, fields of charges, far centres, energies of the volume and dampings with a name beside
Gauss's principle; what is known of some, and what is kept."""

from copy import deepcopy
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import derive
from derive import SO, Moments, Points, Problem, Solid
from derive.language.show import show
from derive.pipeline import discrete
from derive.problem.toml import problem_of
from tests.support.gauss import agrees, cloud, moments
from tests.support.library import arrange, library, module_of
from tests.support.needs import present
from tests.support.walks import own_verdicts

ANGLE = {"axis": [1, 2, 2], "angle": "b"}
TURNED = Rotation.from_rotvec(0.7 / 3 * np.array([1, 2, 2])).as_matrix()
BENT = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0.6, 0.8], [0, 0, -0.8, 0.6]]


def torsion(**more):
    return {"kind": "torsion", "stiffness": "k", **more}


WEIGHT = {"kind": "gravity", "g": [0, "-g", 1]}
FORCES = {
    "twisted": ({"k": 2.0, "b": 0.7, "g": 9.0}, [torsion(rest=ANGLE), torsion(), WEIGHT]),
    "bent": ({"k": 2.0}, [torsion(rest=BENT), torsion()]),
    "bent in the plane": ({"k": 2.0}, [torsion(rest=[[0, 1], [-1, 0]]), torsion()]),
    "charged": (
        {"q": 0.75, "w": 1.5},
        [
            {"kind": "field", "E": [1, "3*cos(w*t)", "q*t^2"], "charges": ["q", "-q", 0, 2, 1]},
            {"kind": "spring", "between": [1, 2], "stiffness": "q", "length": 0.5},
        ],
    ),
    "attracted": ({"mu": 3.0, "g": 1.0}, [{"kind": "far_centre", "strength": "mu"}, WEIGHT]),
    "attracted from aside": (
        {"mu": 3.0, "g": 1.0, "h": 0.5},
        [{"kind": "far_centre", "strength": "mu", "centre": ["h", -1, 2]}, WEIGHT],
    ),
    "driven": (
        {"k": 2.0, "w": 1.5},
        [
            {"kind": "gravity", "g": ["t", "-9*cos(w*t)", 1]},
            {"kind": "spring", "at": [1, 0, 2], "anchor": ["7 + sin(w*t)", "t", 1]}
            | {"stiffness": "k*(2 + cos(t))", "length": "1 + t^2/9"},
        ],
    ),
    "driven and twisted": (
        {"k": 2.0, "w": 1.5},
        [
            torsion(rest={"axis": [1, 2, 2], "angle": "w*t"}) | {"stiffness": "k + t^2"},
            {"kind": "far_centre", "strength": "2 + sin(t)", "centre": ["cos(w*t)", 1, "t"]},
        ],
    ),
    "driven in matrices": (
        {"k": 2.0, "w": 1.5},
        [{"kind": "harmonic", "W": [["k*t", "cos(t)", 0], ["cos(t)", 1, 0], [0, 0, "w*t"]]}],
    ),
    "swollen": (
        {"k": 2.0, "a": 0.3},
        [
            {"kind": "volume", "U": "k/2*(det_A - 1)^2"},
            {"kind": "volume", "U": "a*sin(t)*exp(det_A)/(2 + det_A^2)"},
        ],
    ),
}
"""Parameters and potentials: springs at rest at 1 or at a rotation, charges, centres, volumes."""
GROUPS = {
    "twisted": ("SO(3)", "SE(3)"),
    "bent": ("SO(4)",),
    "bent in the plane": ("SE(2)",),
    "charged": ("SO(3)", "SE(3)", "SL(3)", "SAff(3)", "Aff(3)", "SE(2)", "GL(2)"),
    "attracted": ("SE(3)", "SAff(3)", "Aff(3)", "Sim(3)"),
    "attracted from aside": ("SE(3)", "SAff(3)", "Aff(3)", "Sim(3)"),
    "driven": ("SO(3)", "SE(3)", "SL(3)", "Aff(3)", "Sim(3)"),
    "driven and twisted": ("SE(3)",),
    "driven in matrices": ("SL(3)", "SAff(3)"),
    "swollen": ("GL(2)", "GL(3)", "Aff(2)", "Sim(3)", "GL(4)"),
}
CASES = [(what, group) for what, groups in GROUPS.items() for group in groups]


@pytest.mark.parametrize(("what", "group"), CASES, ids=[f"{x}: {y}" for x, y in CASES])
def test_it_moves_as_gauss_says(what, group):
    """The moments of the points are parameters, but where the points are charged."""
    n, (parameters, forces) = int(group[-2]), deepcopy(FORCES[what])
    masses, r = cloud(n, np.random.default_rng(5), 5)
    data = {"name": "own", "group": group, "parameters": parameters, "potential": forces}
    points = [{"mass": m, "at": at} for m, at in zip(masses.tolist(), r.tolist(), strict=True)]
    body = {"body": {"moments": "symbolic"}}
    if what == "charged":
        forces[0]["E"], body = forces[0]["E"][:n], {"point": points}
    problem, apart = problem_of(data | body), [4, 3, 5] if "attracted" in what else None
    c = library("c", problem) if present("cc") else None
    agrees(module_of(problem), c, data | {"point": points}, moments(masses, r), apart=apart)


@pytest.mark.parametrize("what", ["driven", "driven and twisted"])
def test_the_discrete_motion_knows_the_time(what):
    parameters, forces = deepcopy(FORCES[what])
    data = {"name": "own", "group": "SE(3)", "parameters": parameters, "potential": forces}
    record = discrete(problem_of(data | {"body": {"moments": "symbolic"}}))
    assert all(v.holds for v in own_verdicts(record))


def test_the_energy_of_an_angle():
    """k(1 − cos θ) about any axis from R."""
    forces, values = [derive.Torsion("k", ANGLE)], {"k": 2, "b": 0.7}
    m = module_of(Problem("ball", SO(3), Solid("ball", 1, radius=1), forces, values))
    theta = 1.1
    A = TURNED @ Rotation.from_rotvec(theta / 3 * np.array([2, -1, 2])).as_matrix()
    found = m.energy(0, np.append(A, np.zeros(3)), m.constants(arrange(m, values)))
    assert found == pytest.approx(2 * (1 - np.cos(theta)), rel=1e-12)


def test_what_a_far_centre_drops_is_of_the_fourth_order():
    """The formula less −GM Σ m_i/‖T + A r_i‖, at doubled distances."""
    masses, r = cloud(3, np.random.default_rng(7))
    rng = np.random.default_rng(8)
    A, direction = rng.normal(size=(3, 3)), rng.normal(size=3)
    m = module_of(Problem("own", "Aff(3)", Moments(), [derive.FarCentre(2)]))
    k = m.constants(arrange(m, moments(masses, r)))

    def off(distance):
        T = distance * direction
        whole = -2.0 * np.sum(masses / np.linalg.norm(T + r @ A.T, axis=1))
        return abs(m.energy(0, np.concatenate([A.ravel(), T, np.zeros(12)]), k) - whole)

    for far, farther in pairwise(off(100 * 2**k) for k in range(4)):
        assert 15 < far / farther < 17


# -- what is kept ---------------------------------------------------------------------------------


def test_the_angular_momentum_is_kept_about_a_centre_at_the_origin():
    def kept(*centre):
        problem = Problem("far", "SE(3)", Moments(), [derive.FarCentre(1, *centre)])
        return {e.lhs for e in derive.derive(problem).record["far.conserved"].equations}

    assert {"ḣ", "ℓ̇"} <= kept()
    assert "ℓ̇" not in kept([1, 0, 0])
    assert "ṗ" not in kept()


def in_field(*forces):
    """The labels of a solid in a field."""
    body = Points((1, [1, 0, 0]), (1, [0, 1, 0]), (1, [0, 0, 1]))
    record = derive.derive(Problem("b", "SO(3)", body, forces)).record
    assert all(v.holds for v in own_verdicts(record))
    return {s.label for s in record.steps}


def test_the_energy_is_kept_where_the_field_does_not_change():
    assert "b.conserved" in in_field(derive.Field([0, 0, 1], [1, 2, 3]))
    assert "b.conserved" not in in_field(derive.Field([0, 0, "cos(t)"], [1, 2, 3]))


# -- dampings with a name, moments alone --------------------------------------------------------


MASS, INERTIA, FACTOR = 3.0, np.array([0.3, 0.4, 0.6]), 0.17
AT = np.array([0.2, -0.1, 0.3])
LAWS = {
    "air": ({"at": AT.tolist()}, lambda v, w: (-FACTOR * v, 0)),
    "drag": (
        {"kind": "quadratic", "at": AT.tolist()},
        lambda v, w: (-FACTOR * np.linalg.norm(v) * v, 0),
    ),
    "bearing": ({"kind": "rotational"}, lambda v, w: (0 * v, -FACTOR * w)),
}


def with_damping(name, table):
    return problem_of(
        {
            "name": "damped",
            "group": "SE(3)",
            "body": {
                "given": {"m": MASS, "centre": [0, 0, 0], "I_centre": np.diag(INERTIA).tolist()}
            },
            "damping": [{"name": name, "coefficient": FACTOR, **table}],
        }
    )


@pytest.mark.parametrize("name", LAWS)
def test_it_pulls_by_newton_and_euler(name):
    table, law = LAWS[name]
    problem = with_damping(name, table)
    module = module_of(problem)
    w, v = np.array([0.3, -0.7, 1.1]), np.array([0.9, 0.4, -0.6])
    x = np.concatenate([np.eye(3).ravel(), np.zeros(3), w, v])
    force, moment = law(v + np.cross(w, AT), w)
    turn = (moment + np.cross(AT, force) - np.cross(w, INERTIA * w)) / INERTIA
    expected = np.concatenate([turn, force / MASS - np.cross(w, v)])
    found = module.rhs(0.0, x, module.constants([]))[-6:]
    assert np.allclose(found, expected, rtol=1e-12, atol=1e-13)
    record = derive.derive(problem).record
    assert any(("par", f"{name}_1") == e.lhs for step in record.steps for e in step.equations)
    assert all(x.holds for x in own_verdicts(record))


@pytest.mark.parametrize("acting", ["damping", "input"])
def test_a_moment_alone_turns_a_body_in_the_plane(acting):
    table = {"name": "brake", "kind": {"damping": "rotational", "input": "torque"}[acting]}
    table |= {"coefficient": FACTOR} if acting == "damping" else {}
    body = {"given": {"m": MASS, "centre": [0, 0], "I_centre": 2}}
    data = {"name": "plate", "group": "SE(2)", "body": body, acting: [table]}
    module = module_of(problem_of(data))
    w, *v = 0.7, 0.4, -0.3
    x = np.array([1, 0, 0, 1, 0, 0, w, *v])
    told = [0.9] if acting == "input" else None
    found = module.rhs(0.0, x, module.constants([]), told)[-3:]
    moment = 0.9 if acting == "input" else -FACTOR * w
    assert np.allclose(found, [moment / 2, w * v[1], -w * v[0]], rtol=1e-12, atol=1e-13)


def test_the_signs_of_a_law_and_of_a_coordinate_are_one():
    """ζ₁ is −Z₁₂ in the plane, so that −500 ζ₁ is 500 Z₁₂."""
    body = {"given": {"m": MASS, "centre": [0, 0], "I_centre": 2}}
    law = {"name": "water", "at": [0, 0], "frame": "body", "moment": ["-500*zeta_1"]}
    record = derive.derive(
        problem_of({"name": "boat", "group": "SE(2)", "body": body, "force": [law]})
    ).record
    (found,) = (e.rhs for s in record.steps for e in s.equations if e.lhs == ("par", "water"))
    assert show(found) == "500 Z₁₂"
