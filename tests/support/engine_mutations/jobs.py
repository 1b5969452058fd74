"""What a changed engine is tried on: problems and choices that reach all of its mathematics."""

import tomllib
from typing import Any, NamedTuple

from tests.code.test_forms import FREE, pushed_data
from tests.corpus import problems
from tests.oracles import solids
from tests.problems import PROBLEMS, READY
from tests.support import corpus

BOX = {"kind": "box", "density": 2, "sides": ["a", 0.3, "b"]}
CYLINDER = {"kind": "cylinder", "density": "rho", "radius": "b", "height": 0.7}
CYLINDER |= {"rotation": {"axis": [1, 0, 0], "angle": "pi/4"}}
HOLLOW = {"kind": "hollow_ball", "density": 1.5, "outer": 2, "inner": "a"}
BALL = {"kind": "ball", "density": 1.5, "radius": "b", "shift": [0, 2, 0]}
CORNERS = [[0, 0, 0], [1, 0, 0.5], [0, 1, 0], [0.2, 0.1, 1]]
TETRAHEDRON = {"kind": "tetrahedron", "density": 4, "vertices": CORNERS}
SPRING = {"kind": "spring", "at": ["a", 0, 0], "anchor": [3, 0, 1], "stiffness": 5, "length": "b"}
SOLIDS = tomllib.loads(corpus.SOLIDS.replace("GROUP", "SE(3)"))
SOLIDS["solid"] += [BOX, CYLINDER, HOLLOW, BALL, TETRAHEDRON]
SOLIDS["potential"] += [SPRING]
MIXED = """
name = "test"
group = "Sim(3)"
[parameters]
b = 0.7
[[point]]
mass = "b"
at = [1, "b", 2]
[[point]]
mass = 0.5
at = ["b", -1, 0.5]
[[solid]]
kind = "box"
density = 2
sides = [1, 0.3, "b"]
rotation = [[0.6, -0.8, 0], [0, 0, -1], [0.8, 0.6, 0]]
[[solid]]
kind = "ball"
density = "b"
radius = 0.5
shift = [0, 0.5, "b"]
[[solid]]
kind = "cylinder"
density = 1
radius = 0.3
height = "b"
rotation = { axis = [1, 1, 0], angle = "b" }
[[solid]]
kind = "cone"
density = 1
radius = 0.3
height = 1
rotation = { axis = [0, 3, 4], angle = "pi/2" }
[[potential]]
kind = "gravity"
g = [1, 2, "-9.81"]
"""

BOTH = {
    "group": "SE(3)",
    "parameters": {"b": 0.7},
    "point": [{"mass": "b", "at": [0, 0, 0.125]}],
    "solid": [{"kind": "ball", "density": 0.5, "radius": "b"}],
}
"""A solid and a point in principal axes."""
TENSOR = [["a", 0.1, 0], [0.1, 2, "a/9"], [0, "a/9", 2.2]]
GIVEN = {
    "group": "SE(3)",
    "parameters": {"a": 1.1, "M": 2.0},
    "body": {"given": {"m": "M", "c": [0.1, "a/4", -0.2], "I": TENSOR}},
    "potential": [{"kind": "gravity", "g": [0, 0, "-9.81"]}],
    "input": [{"name": "u", "kind": "covector"}],
}
J = [[1, 0.1, 0], [0.1, 2, 0.2], [0, 0.2, 2.2]]
NUMBERS = {
    "group": "Aff(3)",
    "parameters": {"b": 0.7},
    "body": {"given": {"m": 2, "c": [0.1, 0.2, -0.2], "J": J}},
    "potential": [{"kind": "gravity", "g": [1, 2, "-b"]}],
}
FUNCTIONS = """
name = "test"
group = "GL(2)"
[[point]]
mass = 1
at = [1, 0]
[[point]]
mass = 2
at = [0, 1]
[[potential]]
kind = "expression"
U = "log(3 + r1_x^2) + tan(r1_y) + tanh(r2_x) + cos(r2_y)*sin(r1_x) + sinh(r1_y)/cosh(r2_x)"
[[potential]]
kind = "expression"
U = "r2_x*atan(r2_y) + exp(r1_x*r2_y) + sqrt(5 + r1_y^2) + r1_x*log(4 + r1_y^2)"
"""
"""Every elementary function."""

OPERATOR = [[1, 0, "s"], [0, "2 + A_11", 0], ["s", 0, 3]]
POTENTIAL = {"momentum": [0, "s", "T_1"], "U": "T_2^2*t", "trivialisation": "right"}
L_4 = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 + a*zeta_1^4/4 + sin(t)*zeta_2 - A_33*A_12"
CARRIED = "(2*zeta_1^2 + zeta_2^2 + 3*zeta_3^2)/2 + zeta_1*gamma_2 - gamma_1*gamma_3"
OWN = {
    "solids": SOLIDS,
    "both": BOTH,
    "given": GIVEN,
    "numbers": NUMBERS,
    "on the right": {
        "group": "SE(2)",
        "parameters": {"s": 0.1},
        "inertia": {"operator": OPERATOR} | POTENTIAL,
    },
    "quartic": {"group": "SO(3)", "parameters": {"a": 0.3}, "lagrangian": {"L": L_4}},
    "goryachev": {
        "group": "SO(3)",
        "parameters": {"I": 1.5, "m": 2.0},
        "lagrangian": {"L": "I*(4*zeta_1^2 + 4*zeta_2^2 + zeta_3^2)/2 - m*A_31"},
    },
    "carried on the right": {
        "algebra": {"of": "SE(2)"},
        "advected": [{"name": "gamma", "representation": "dual"}],
        "lagrangian": {"L": CARRIED, "trivialisation": "right"},
    },
    "torus": {"algebra": {"of": "torus", "N": 3}, "inertia": {"operator": "laplacian"}},
    "poured": {"fluid": {"forces": "potential"}},
}


class Job(NamedTuple):
    """A problem as the plain data of its file, and the options of its emission."""

    name: str
    data: dict[str, Any]
    options: dict[str, Any]
    refused: str = ""
    """What must be said of it, where it is none that can be derived."""
    sought: str = ""
    """What is found of it beside its walk, and is the record then: a function of the pipeline."""

    @property
    def framed(self) -> bool:
        """Is its code in the principal frame?"""
        return self.options.get("frame") == "principal"

    @property
    def any_group(self) -> bool:
        """Is it a text about any group, from which no code is made?"""
        return self.data.get("group") == "any"

    @property
    def plain(self) -> bool:
        """Is the state of its code that of the oracle, which knows bodies of points?"""
        of_points = not {"lagrangian", "inertia"} & {*self.data}
        return of_points and not {"attitude", "velocity", "layout"} & {*self.options}

    @property
    def coded(self) -> bool:
        """Is code made of it?"""
        algebra = self.data.get("algebra")
        on_torus = isinstance(algebra, dict) and algebra.get("of") == "torus"
        unread = "fluid" in self.data or on_torus
        return not (self.any_group or self.sought or unread)

    def seen_by_the_oracle(self) -> dict[str, Any]:
        """The oracle knows points and moments: of other bodies it has the moments."""
        known = "solid" not in self.data and not {"given", "solid"} & {*self.data.get("body", {})}
        return self.data if known else solids.by_moments(self.data)


TEXTS = PROBLEMS | {p.stem: p.read_text(encoding="utf-8") for p in READY.glob("*.toml")}
TEXTS |= {"mixed": MIXED, "functions": FUNCTIONS}
WHOLE = ("state", "inputs", "parameters")
CHOSEN = [
    ("linear", {}),
    ("affine", {}),
    ("SL(3) forces", {}),
    ("SO(3) forces", {}),
    ("SE(3) forces", {}),
    ("so3", {"attitude": "quaternion", "jacobian": WHOLE}),
    ("Sim(3) forces", {}),
    ("sl3", {"velocity": "tangent", "jacobian": ("state",)}),
    ("se3", {}),
    ("se3", {"frame": "principal"}),
    ("SE(3) x SO(3)", {}),
    ("solids", {}),
    ("sl3", {"frame": "principal"}),
    ("screw", {"velocity": "tangent", "layout": "col", "jacobian": ("state",)}),
    ("functions", {"jacobian": ("state",)}),
    ("Sp(2)", {}),
    ("SE(2)", {}),
    ("SAff(3) forces", {"layout": "col"}),
    ("SAff(2)", {"velocity": "tangent", "jacobian": ("state",)}),
    ("SL(4)", {"velocity": "tangent"}),
    ("so3", {"frame": "principal"}),
    ("pushed SE(3)", {"frame": "principal", "attitude": "quaternion"}),
    ("pushed SAff(3)", {"frame": "principal", "velocity": "tangent"}),
    ("SU(2)", {}),
    ("UT(3)", {}),
    ("mixed", {}),
    ("both", {}),
    ("given", {}),
    ("numbers", {}),
    ("GL(2)", {}),
    ("comet", {"frame": "principal"}),
    ("SO(4)", {}),
    ("U(1)", {}),
    ("weighted", {}),
    ("a cylinder", {}),
    ("translations", {}),
    ("jelly", {}),
    ("top", {"frame": "principal", "attitude": "quaternion"}),
    ("GL(2)", {"frame": "principal"}),
    ("Aff(2)", {"frame": "principal"}),
    ("SO(2)", {"frame": "principal"}),
]
"""From the telling to the special: a change is tried on the first that reach it."""

LAGRANGIANS = [
    ("gyrostat", {"momenta": True, "conserved": True}),
    ("charged_body", {}),
    ("kirchhoff", {"momenta": True}),
    ("coupled", {}),
    ("euler_poisson", {"momenta": True, "conserved": True}),
    ("on the right", {"momenta": True}),
    ("quartic", {"momenta": True}),
    ("carried on the right", {}),
    ("spherical_pendulum", {}),
    ("rod", {}),
    ("dirichlet", {"multiplier": True}),
    ("riemann_ellipsoid", {"multiplier": True}),
    ("gas_cloud", {}),
    ("so3", {"momenta": True}),
    ("SL(2)", {"momenta": True}),
    ("ideal_fluid", {}),
    ("inhomogeneous_fluid", {}),
    ("stratified_fluid", {}),
    ("poured", {}),
    ("torus", {}),
]
SOUGHT = [
    ("reduction", "lagrange_top"),
    ("reduction", "charged_body"),
    ("integrals", "kovalevskaya_top"),
    ("integrals", "gyrostat"),
    ("integrals", "goryachev"),
    ("integrals", "manakov"),
    ("symmetries", "se3"),
    ("symmetries", "top"),
    ("symmetries", "charged_body"),
    ("symmetries", "screw"),
    ("equilibria", "euler_top"),
    ("equilibria", "lagrange_top"),
]

DATA = {name: tomllib.loads(text) for name, text in TEXTS.items()}
DATA |= {name: {"name": "test"} | data for name, data in OWN.items()}
DATA |= {f"pushed {group}": pushed_data(group, FREE) for group in ("SE(3)", "SAff(3)")}
JOBS = [Job(name, DATA[name], options) for name, options in (*CHOSEN, *LAGRANGIANS)]
JOBS += [Job(f"{what} of {name}", DATA[name], {}, sought=what) for what, name in SOUGHT]
MISTAKES = [x for x in problems("refused") if x[1] is not None]
"""Files that are refused: those in which a direction has no inertia, and every eighth."""
OPEN = ("moves no mass", "Z = [[")
JOBS += [
    Job(words[0], data, {}, words[0])
    for i, (_, data, words) in enumerate(MISTAKES)
    if i % 8 == 0 or any(x in words[0] for x in OPEN)
]
