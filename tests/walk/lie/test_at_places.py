"""Forces, torques and damping at places beside a Lagrangian: as on the points that have it, by
Gauss's principle and by the power; what is not damped there."""

import numpy as np
import pytest

import derive
from derive.check.checker import Checker
from derive.problem.toml import problem_of
from derive.record.sentence import english
from tests.oracles.sampling import cross_matrix, random_rotation
from tests.support.library import module_of
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
        {"name": "swept", "at": [0, 0, 1], "y": ["r_3*v_1 + t", "port*v_2"]},
        {"name": "whole", "kind": "power"},
        {"name": "towed", "kind": "power", "of": "tow"},
    ],
}  # fmt: skip


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
    both = np.block([[inertia, cross_matrix(CENTRE)], [-cross_matrix(CENTRE), MASS * np.eye(3)]])
    return {"inertia": {"operator": both.tolist()}}


DAMPED = {
    "parameters": {"k": 0.3, "b": 0.4},
    "damping": [
        {"coefficient": "k", "at": [1, 0, "b"]},
        {"kind": "quadratic", "coefficient": "b", "at": [0, 2, 0], "name": "drag"},
        {"kind": "rotational", "coefficient": 0.7},
    ],
}


@pytest.mark.parametrize("acting", [PUSHED, DAMPED], ids=["pushed", "damped"])
@pytest.mark.parametrize(
    ("group", "side"), [("SE(3)", "left"), ("SO(3)", "left"), ("SO(3)", "right")]
)
def test_what_acts_at_places_acts_as_on_points(group, side, acting):
    data = {"name": "test", "group": group, **acting}
    points = derive.compile(problem_of(data | of_points(group)))
    own = problem_of(data | kinetic(group, side))
    if side == "right":  # its coordinates are of space, zeta_2 of the body those of points
        names = [" + ".join(f"A_{j}{i}*zeta_{j}" for j in (1, 2, 3)) for i in (1, 2, 3)]
        changed = [
            x | {key: [_spelt(t, names) for t in x[key]] for key in ("force", "moment") if key in x}
            for x in acting.get("force", [])
        ]
        own = problem_of(data | kinetic(group, side) | ({"force": changed} if changed else {}))
    typed, rng = derive.compile(own), np.random.default_rng(5)
    for _ in range(3):
        R, place = random_rotation(rng), rng.normal(size=3 if group == "SE(3)" else 0)
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
        if "output" in acting:
            seen, read = points.outputs(0.4, x, u), typed.outputs(0.4, y, u)
            assert np.abs(read - seen).max() < 1e-11 * np.abs(seen).max()
    assert all(v.holds for v in own_verdicts(derive.derive(own).record))


def _spelt(text, names):
    """An expression with the coordinates in the body by those in space."""
    for i, name in enumerate(names, 1):
        text = str(text).replace(f"zeta_{i}", f"({name.replace('zeta', 'ZETA')})")
    return text.replace("ZETA", "zeta")


GAMMA = (0.5, 0, -9)


@pytest.mark.parametrize(
    ("group", "side"), [("SE(3)", "left"), ("SO(3)", "left"), ("SO(3)", "right")]
)
def test_a_specific_force_is_less_the_gravity_that_is_said(group, side):
    """As that of points with the weight, in L here, whose gravity the output is told."""
    imu = {"name": "imu", "kind": "specific_force", "at": [1, 2, 0.4]}
    data = {"name": "test", "group": group}
    falls = {"potential": [{"kind": "gravity", "g": [*GAMMA]}], "output": [imu]}
    points = derive.compile(problem_of(data | of_points(group) | falls))
    free = group == "SE(3)"
    if side == "right":
        L = kinetic(group, side)["lagrangian"]["L"]
    else:
        M = np.array(kinetic(group, side)["inertia"]["operator"])
        rows = range(1, len(M) + 1)
        L = " + ".join(f"{M[i - 1][j - 1]}*zeta_{i}*zeta_{j}/2" for i in rows for j in rows)
    c = CENTRE if free else [0, 0, 0]
    for j in (1, 2, 3):
        centre = [f"{c[k]}*A_{j}{k + 1}" for k in range(3)] + [f"{MASS}*T_{j}"] * free
        L += f" + {GAMMA[j - 1]}*({' + '.join(centre)})"
    told = {"lagrangian": {"L": L, "trivialisation": side}, "output": [imu | {"g": [*GAMMA]}]}
    own = problem_of(data | told)
    typed, rng = derive.compile(own), np.random.default_rng(5)
    R, zeta = random_rotation(rng), rng.normal(size=6 if free else 3)
    x = np.array([*R.ravel(), *[0.3, -1, 2][: 3 * free], *zeta])
    y = x.copy()
    y[-3:] = R @ zeta if side == "right" else x[-3:]
    seen = points.outputs(0.4, x)
    assert np.abs(typed.outputs(0.4, y) - seen).max() < 1e-12 * np.abs(seen).max()
    assert all(v.holds for v in own_verdicts(derive.derive(own).record))


def test_a_false_arm_is_seen():
    record = derive.derive(
        problem_of({"name": "test", "group": "SE(3)", **PUSHED, **kinetic("SE(3)", "left")})
    ).record
    problem = dict(record.problem)
    problem["places"] = [*problem["places"]]
    problem["places"][0] = problem["places"][0] | {"at": [-1, ["par", "b"], 1]}
    step = record["test.coadjoint"]
    assert not Checker(problem, SEED).check(step).holds


KAPPA = {"parameters": DAMPED["parameters"]}
OF_TWO = [
    {"coefficient": "k", "at": [1, 0, "b"], "block": 2},
    {"kind": "quadratic", "coefficient": "b", "at": [0, 2], "block": 1},
    {"kind": "rotational", "coefficient": 0.7, "block": 1},
    {"kind": "rotational", "coefficient": 0.2, "block": 2},
]
MASSES = np.arange(1, 10)


def two(side, damping):
    """SE(2) x SE(3) with the energy of a diagonal inertia and of a place."""
    zeta = "+".join(f"{m}*zeta_{a}^2" for a, m in enumerate(MASSES, 1))
    L = {"L": f"({zeta})/2 - T2_3 - A1_12", "trivialisation": side}
    return {"name": "two", "group": "SE(2) x SE(3)", "lagrangian": L, "damping": damping} | (
        KAPPA if damping else {}
    )


def element(rng):
    """A random one as a matrix on both, with its numbers in the order of the state."""
    plane, space = np.eye(3), np.eye(4)
    angle = rng.normal()
    plane[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    plane[:2, 2], space[:3, :3], space[:3, 3] = (
        rng.normal(size=2),
        random_rotation(rng),
        rng.normal(size=3),
    )
    g = np.block([[plane, np.zeros((3, 4))], [np.zeros((4, 3)), space]])
    parts = (plane[:2, :2].ravel(), plane[:2, 2], space[:3, :3].ravel(), space[:3, 3])
    return g, np.concatenate(parts)


def of_velocity(g, basis, side):
    """What ζ makes of the velocities that are damped: 3 of a place of space, 2 of one of the plane,
    and both angular velocities, rows of a matrix each."""
    moved = [g @ e if side == "left" else e @ g for e in basis]  # dg by each coordinate
    space = [x @ [0, 0, 0, 1, 0, 0.4, 1] for x in moved]
    plane = [x @ [0, 2, 1, 0, 0, 0, 0] for x in moved]
    turns = [x @ np.linalg.inv(g) for x in moved]
    return (
        np.array([x[3:6] for x in space]).T,
        np.array([x[:2] for x in plane]).T,
        np.array([[x[1, 0]] for x in turns]).T,
        np.array([[x[5, 4], x[3, 5], x[4, 3]] for x in turns]).T,
    )


@pytest.mark.parametrize("side", ["left", "right"])
def test_by_gauss_and_the_power(side):
    """M Δζ̇ = Σ Jᵀf, least squares over 𝔤; the energy falls by Σ⟨f, v⟩."""
    damped, free = (module_of(problem_of(two(side, x))) for x in (OF_TWO, []))
    rng = np.random.default_rng(3)
    k = damped.constants([{"k": 0.3, "b": 0.4}[x] for x in damped.PARAMETERS])
    for _ in range(4):
        (g, numbers), zeta = element(rng), rng.normal(size=9)
        x = np.concatenate([numbers, zeta])
        maps = of_velocity(g, np.array(damped.BASIS), side)
        v = [J @ zeta for J in maps]
        f = [-0.3 * v[0], -0.4 * np.linalg.norm(v[1]) * v[1], -0.7 * v[2], -0.2 * v[3]]
        found = damped.rhs(0.0, x, k) - free.rhs(0.0, x, free.constants([]))
        pushed = sum(J.T @ y for J, y in zip(maps, f, strict=True)) / MASSES
        assert np.abs(found[-9:] - pushed).max() < 1e-13 * np.abs(pushed).max()
        rate, h = damped.rhs(0.0, x, k), 1e-6
        above, below = (damped.energy(0.0, x + s * h * rate, k) for s in (1, -1))
        power = sum(y @ z for y, z in zip(f, v, strict=True))
        assert power < 0
        assert abs((above - below) / (2 * h) - power) < 1e-7 * abs(power)


@pytest.mark.parametrize("side", ["left", "right"])
def test_every_step_is_checked(side):
    own = [{x: y for x, y in d.items() if x != "block"} | {"at": [0, 2]} for d in OF_TWO[:3]]
    del own[2]["at"]
    L = {"L": "(2*zeta_1^2 + zeta_2^2 + zeta_3^2)/2 - T_2", "trivialisation": side}
    data = {"name": "one", "group": "SE(2)", "lagrangian": L, "damping": own, **KAPPA}
    record = derive.derive(problem_of(data)).record
    assert all(v.holds for v in own_verdicts(record))
    assert any(s.label == "one.power" for s in record.steps)


@pytest.mark.parametrize("frame", ["body", "space"])
@pytest.mark.parametrize(
    ("group", "body", "block"),
    [
        ("SE(3)", of_points("SE(3)"), 1),
        ("SO(3)", kinetic("SO(3)", "left"), 1),
        ("SO(3)", kinetic("SO(3)", "right"), 1),
        ("SE(2) x SE(2)", {"point": [{"mass": m, "at": [m, 0], "block": b}
                                     for b in (1, 2) for m in (1, 2)]}, 2),
    ],
)  # fmt: skip
def test_a_moment_alone_needs_no_place(group, body, block, frame):
    """It acts as a torque that is given has the same numbers, and is called one."""
    count = 1 if "2" in group else 3
    data = {"name": "test", "group": group, **body}
    where = {"frame": frame} | ({"block": block} if block > 1 else {})
    moment = [f"{k + 1}*t*zeta_1" for k in range(count)]
    own = derive.derive(
        problem_of(data | {"force": [{"name": "brake", "moment": moment, **where}]})
    )
    given = [{"name": "u", "kind": "torque", **where}]
    torque = derive.compile(problem_of(data | {"input": given}))
    stated = derive.compile(own.problem)
    x = np.random.default_rng(7).normal(size=len(stated.STATE))
    u = [0.4 * (k + 1) * x[stated.STATE.index("zeta_1")] for k in range(count)]
    assert np.allclose(stated.rhs(0.4, x), torque.rhs(0.4, x, u), rtol=1e-12, atol=1e-12)
    assert np.abs(torque.rhs(0.4, x, u) - torque.rhs(0.4, x, [0] * count)).max() > 1e-3
    assert all(v.holds for v in own_verdicts(own.record))
    said = " ".join(english(step.prose) for step in own.record.steps)
    assert group == "SO(3)" or f"‘brake’, a torque, in the {frame} frame" in said


def test_a_moment_of_a_place_says_which():
    data = {"name": "test", "group": "SE(3)", **of_points("SE(3)")}
    for more in ({"moment": ["-v_1", 0, 0]}, {"moment": ["t", 0, 0], "relative_to": [1, 0, 0]}):
        with pytest.raises(derive.ProblemError, match="key 'at', a place of the body, is missing"):
            problem_of(data | {"force": [more]})
    made = derive.AppliedForce(moment=["-zeta_1", 0, 0], frame="body").fields
    assert problem_of(data | {"force": [made]}).forces[0].frame == "body"
