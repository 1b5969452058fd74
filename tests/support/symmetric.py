"""Problems with symmetries of every kind, and their symmetries."""

from functools import cache

from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.searches import symmetries

LINE = [0, 0, 0, 0]


def shift(i):
    return [[0, 0, 0, int(k == i)] for k in range(3)] + [LINE]


T3 = {"name": "T3", "action": "affine", "basis": [shift(k) for k in range(3)]}
SQUARES = " + ".join(f"zeta_{k}^2" for k in range(1, 7))
SOLID = {"density": "rho"}
SIZES = {"rho": 1.0, "R": 1.5, "h": 2.0, "s": 0.5}

FILES = {
    "free": {"group": "SE(3)", "body": {"moments": "symbolic"}},
    "cone": {"group": "SE(3)", "body": SOLID | {"solid": "cone", "radius": "R", "height": "h"}},
    "ball": {
        "group": "SE(3)",
        "body": SOLID | {"solid": "ball", "radius": "R", "shift": ["s", 0, 0]},
    },
    "planet": {
        "group": T3,
        "point": [{"mass": "m", "at": [0, 0, 0]}],
        "potential": [{"kind": "attraction", "strength": "k"}],
    },
    "long_numbers": {
        "group": "SE(3)",
        "point": [
            {"mass": 0.0073412345, "at": [1.23456789, 0, 0]},
            {"mass": 1.37, "at": [0, 1.1, 0]},
            {"mass": 2.123456, "at": [0, 0, 0.777]},
        ],
    },
    "spatial": {"group": "SE(3)", "lagrangian": {"L": SQUARES, "trivialisation": "right"}},
    "driven": {
        "group": "SE(2)",
        "lagrangian": {
            "L": "zeta_1^2 + zeta_2^2 + zeta_3^2 - k*(T_1*cos(w*t) + T_2*sin(w*t))^2",
        },
    },
    "none": {
        "group": "SO(3)",
        "lagrangian": {"L": "zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 - t*A_11 - t^2*A_22*A_31"},
    },
    "drop": {  # √det Q = √93/4
        "group": "SL(3)",
        "body": {
            "solid": "ellipsoid",
            "density": "rho",
            "quadric": [[1, "1/4", 0], ["1/4", 2, 0], [0, 0, 3]],
        },
        "potential": [{"kind": "harmonic", "W": [["w^2", 0, 0], [0, "w^2", 0], [0, 0, 1]]}],
    },
    "roots": {
        "group": "SL(3)",
        "body": SOLID | {"solid": "ellipsoid", "semi_axes": ["sqrt(2)", 1, "2*sqrt(2)"]},
    },
    "turned": {
        "group": "SL(3)",
        "body": {
            "solid": "ellipsoid",
            "density": "rho*(1 - s/2)",
            "semi_axes": ["R", 1, 1],
            "rotation": {"axis": [0, 0, 1], "angle": "pi/4"},
        },
    },
    # a turn about an axis and a stretch along it, whose boost is no polynomial in the entries of g
    "spiral": {
        "group": {"name": "Spiral", "basis": [[[0, -1, 0], [1, 0, 0], [0, 0, 2]]]},
        "lagrangian": {"L": "zeta_1^2/2"},
    },
    "landau": {
        "group": T3,
        "lagrangian": {"L": "m*(zeta_1^2 + zeta_2^2 + zeta_3^2)/2 + k*T_1*zeta_2"},
    },
}
PARAMETERS = {
    "cone": SIZES,
    "ball": SIZES,
    "planet": {"m": 1.0, "k": 2.0},
    "drop": {"rho": 1.0, "w": 2.0},
    "roots": {"rho": 1.0},
    "turned": {"rho": 1.0, "R": 2.0},
    "driven": {"k": 1.0, "w": 0.3},
    "landau": {"m": 1.0, "k": 2.0},
}


def file(name):
    """The data of a problem file."""
    used = {x: y for x, y in PARAMETERS.get(name, {}).items() if x != "h" or name == "cone"}
    used = {x: y for x, y in used.items() if x != "s" or name == "ball"}
    return {"name": name, **FILES[name], **({"parameters": used} if used else {})}


@cache
def found(name):
    """The symmetries of one of these problems."""
    problem = problem_of(file(name))
    return symmetries(problem, walk(problem))
