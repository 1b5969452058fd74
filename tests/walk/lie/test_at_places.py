"""Forces and torques at places beside a Lagrangian: as on the points that have it."""

import numpy as np
import pytest

import derive
from derive.check.checker import Checker
from derive.problem.toml import problem_of
from tests.support.walks import SEED, own_verdicts

MASS, CENTRE, INERTIA = 2, [0.5, 0, -1], [[5, 1, 0], [1, 7, 0.5], [0, 0.5, 6]]
PUSHED = {
    "parameters": {"k": 0.3, "b": 0.4},
    "input": [
        {"name": "port", "kind": "force", "at": [-1, "b", 0], "frame": "body",
         "direction": [1, 0, "k"], "moment": ["k", 0, 0]},
        {"name": "tow", "kind": "force", "at": [1, 0, "b"]},
        {"name": "wheel", "kind": "torque", "direction": [0, 0, 1]},
        {"name": "fin", "kind": "torque", "frame": "body"},
        {"name": "gas", "kind": "scalar"},
    ],
    "force": [
        {"at": [1, 0, "b"], "relative_to": ["k*r_3", 0, "t"],
         "force": ["-k*hypot(v_1, v_2)*v_1", "-k*v_2*A_33", "-port*v_3"]},
        {"name": "keel", "at": [0, 2, 0], "frame": "body", "force": ["-k*v_1", "zeta_2", 0],
         "moment": [0, 0, "-k*zeta_3"]},
        {"at": [0, 2, 0], "frame": "body", "relative_to": [1, "k", 0],
         "force": ["-v_1*v_2", 0, "gas*v_3"]},
    ],
    "output": [
        {"name": "spot", "kind": "place", "at": [1, 0, "b"]},
        {"name": "pace", "kind": "velocity", "at": [1, 0, "b"], "frame": "body"},
        {"name": "drift", "kind": "velocity", "at": [1, "k", 0]},
        {"name": "felt", "kind": "acceleration", "at": [1, 2, "b"], "frame": "body"},
        {"name": "rush", "kind": "acceleration", "at": [1, 2, 0]},
        {"name": "gyro", "kind": "rate"},
        {"name": "north", "kind": "direction", "direction": [1, 0, "b"], "frame": "body"},
        {"name": "mast", "kind": "direction", "direction": [1, 0, 2]},
        {"name": "range", "kind": "distance", "at": [1, 0, "b"], "to": [0, "b", 2]},
        {"name": "power", "at": [0, 0, 1], "y": ["r_3*v_1 + t", "port*v_2"]},
    ],
}  # fmt: skip


def hat(c):
    return np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])


def of_points(group):
    """The body by its moments: J of points is (Tr I/2) 1 - I, of places about the origin."""
    inertia = np.array(INERTIA, float)
    J = np.trace(inertia) / 2 * np.eye(3) - inertia
    c = CENTRE if group == "SE(3)" else [0, 0, 0]
    return {"body": {"given": {"m": MASS, "c": c, "J": J.tolist()}}}


def kinetic(group, side):
    """The same energy as an operator; on the right the expression with the entries of A."""
    inertia = np.array(INERTIA, float)
    if side == "right":
        terms = [
            f"{inertia[k][m]}*A_{i + 1}{k + 1}*A_{j + 1}{m + 1}*zeta_{i + 1}*zeta_{j + 1}"
            for i in range(3) for j in range(3) for k in range(3) for m in range(3)
        ]  # fmt: skip
        return {"lagrangian": {"L": f"({'+'.join(terms)})/2", "trivialisation": side}}
    if group == "SO(3)":
        return {"inertia": {"operator": inertia.tolist()}}
    both = np.block([[inertia, hat(CENTRE)], [-hat(CENTRE), MASS * np.eye(3)]])
    return {"inertia": {"operator": both.tolist()}}


def turned(rng):
    """A random rotation."""
    R, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    R[:, 0] *= np.linalg.det(R)
    return R


@pytest.mark.parametrize(
    ("group", "side"), [("SE(3)", "left"), ("SO(3)", "left"), ("SO(3)", "right")]
)
def test_what_acts_at_places_acts_as_on_points(group, side):
    data = {"name": "test", "group": group, **PUSHED}
    points = derive.compile(problem_of(data | of_points(group)))
    own = problem_of(data | kinetic(group, side))
    if side == "right":  # its coordinates are of space, zeta_2 of the body those of points
        names = [" + ".join(f"A_{j}{i}*zeta_{j}" for j in (1, 2, 3)) for i in (1, 2, 3)]
        changed = [
            x | {key: [_spelt(t, names) for t in x[key]] for key in ("force", "moment") if key in x}
            for x in PUSHED["force"]
        ]
        own = problem_of(data | kinetic(group, side) | {"force": changed})
    typed, rng = derive.compile(own), np.random.default_rng(5)
    for _ in range(3):
        R, place = turned(rng), rng.normal(size=3 if group == "SE(3)" else 0)
        zeta, u = rng.normal(size=len(place) + 3), rng.normal(size=len(points.INPUTS))
        x = np.array([*R.ravel(), *place, *zeta])
        expected = points.rhs(0.4, x, u)
        y, count = x.copy(), len(zeta)
        if side == "right":
            y[-3:] = R @ zeta
            expected[-3:] = R @ expected[-3:]
        found = typed.rhs(0.4, y, u)
        assert np.abs(found - expected)[-count:].max() < 1e-11 * np.abs(expected).max()
        assert np.abs(found - expected)[:-count].max() < 1e-13 * np.abs(expected).max()
        seen, read = points.outputs(0.4, x, u), typed.outputs(0.4, y, u)
        assert np.abs(read - seen).max() < 1e-11 * np.abs(seen).max()
    assert all(v.holds for v in own_verdicts(derive.derive(own).record))


def _spelt(text, names):
    """An expression with the coordinates in the body by those in space."""
    for i, name in enumerate(names, 1):
        text = str(text).replace(f"zeta_{i}", f"({name.replace('zeta', 'ZETA')})")
    return text.replace("ZETA", "zeta")


def test_a_false_arm_is_seen():
    record = derive.derive(
        problem_of({"name": "test", "group": "SE(3)", **PUSHED, **kinetic("SE(3)", "left")})
    ).record
    problem = dict(record.problem)
    problem["places"] = [*problem["places"]]
    problem["places"][0] = problem["places"][0] | {"at": [-1, ["par", "b"], 1]}
    step = record["test.coadjoint"]
    assert not Checker(problem, SEED).check(step).holds
