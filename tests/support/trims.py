"""Equilibria under inputs of which the answer is known by hand."""

from derive import derive
from derive.problem.toml import problem_of
from tests.support.walks import SEED

PENDULUM = {
    "name": "arm",
    "group": "SO(2)",
    "point": [{"mass": 2, "at": [0, -1]}],
    "potential": [{"kind": "gravity", "g": [0, -10]}],
    "damping": [{"coefficient": 6}],
    "input": [{"name": "u", "kind": "torque"}],
}
"""2 θ̈ = −20 sin θ − 6 θ̇ + u."""

TURNED = {"A_11": "4/5", "A_12": "-3/5", "A_21": "3/5", "A_22": "4/5"}
"""sin θ = 3/5."""

DRONE = {
    "name": "drone",
    "group": "SE(2)",
    "body": {"given": {"m": 2, "centre": [0, 0], "I": 3}},
    "potential": [{"kind": "gravity", "g": [0, -10]}],
    "input": [
        {"name": x, "kind": "force", "at": [at, 0], "frame": "body", "direction": [0, 1]}
        for x, at in (("u", 1), ("v", -1))
    ],
}
"""Two rotors, a length 1 from the centre, carry 20 together."""


def leaning(**more):
    """A damped pendulum that a torque keeps aside."""
    return derive(problem_of(PENDULUM | more)).trim(TURNED)


def upside_down():
    """A pendulum that stands: λ² = g/l."""
    return derive("pendulum").trim({"A_11": -1, "A_22": -1})


def drone(**more):
    """A body in the plane with two rotors."""
    return derive(problem_of(DRONE | more))


def drifting():
    """It moves aside."""
    return drone().trim({"w_1": 1})


DRAG = {"kind": "quadratic", "coefficient": "c", "at": [0, 0]}
ASIDE = {"A_11": "4/5", "A_12": "3/5", "A_21": "-3/5", "A_22": "4/5"}
"""It leans ahead, by sin θ = −3/5."""


def flying(*damping, c=0.6, **more):
    """The drone with a drag −c‖v‖v; m = 2, g = 10."""
    used = {"parameters": {"c": c}} if "'c'" in str(damping or DRAG) else {}
    return derive(problem_of(DRONE | used | {"damping": [*(damping or [DRAG])]} | more))


def balanced():
    """The speed at which a tilt and a thrust are balanced."""
    return flying().trim(ASIDE | {"u": "25/2", "v": "25/2"}, ["w_1", "w_2"])


def resting_in_air():
    """It rests, where ‖v‖ has no derivative."""
    return flying().trim()


def in_a_wind():
    """It leans into a wind of 5 along the first axis, with a drag −2v."""
    wind = {"name": "drag", "frame": "space", "at": [0, 0], "relative_to": ["5", "0"]}
    found = drone(force=[wind | {"force": ["-2*v_1", "-2*v_2"]}])
    return found.trim({}, ["eta_1", "u", "v"])


# Trims of which no number is one of a square root.


def cubed():
    """A torque u + u³ keeps a pendulum aside."""
    return derive(problem_of(PENDULUM | {"force": [{"covector": ["u^3"]}]})).trim(TURNED)


def nearly_upside_down():
    """A pendulum that stands, beside a torque that is cubic in A."""
    bent = PENDULUM | {"force": [{"covector": ["-A_21^3"]}]}
    return derive(problem_of(bent)).trim({"A_11": -1, "A_22": -1, "u": 1}, ["eta_1"])


def turned_in_space():
    """The same on the right, of a Lagrangian."""
    L = "zeta_1^2/2 + 3*A_11 + 4*A_21 + A_21^3"
    data = {"name": "turned", "group": "SO(2)", "lagrangian": {"L": L, "trivialisation": "right"}}
    quarter = {"A_11": "3/5", "A_12": "-4/5", "A_21": "4/5", "A_22": "3/5"}
    return derive(problem_of(data)).trim(quarter, ["eta_1"])


def spun():
    """A torque u against friction of the first and the third degree."""
    problem = {
        "name": "spun",
        "group": "SO(2)",
        "point": [{"mass": 1, "at": [1, 0]}],
        "force": [{"covector": ["-zeta_1 - zeta_1^3"]}],
        "input": [{"name": "u", "kind": "torque"}],
    }
    return derive(problem_of(problem)).trim({"u": 1}, ["zeta_1"])


def holds(found):
    """Is a trim held, with all steps of its record?"""
    return all(v.holds for v in found.check(SEED))
