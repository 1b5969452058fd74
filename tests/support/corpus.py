"""The corpus of records, of every road: what the laws of ``tests/record`` are tried on.

A record is named by its road and its problem, as "discrete so3"; each is made once for these
sources, and kept on the disk.
"""

import tomllib
from functools import cache, partial

import numpy as np

from derive import Gravity, Harmonic, Problem, SelfGravity, Solid, first_integrals
from derive.algebra.families import group as named_group
from derive.check.checker import checker_of
from derive.command.showing import load_problem
from derive.pipeline import discrete, walk
from derive.problem.toml import problem_of
from derive.searches import symmetries
from tests.problems import PROBLEMS
from tests.support import advected, reduced, symmetric
from tests.support.cached import on_disk
from tests.support.lagrangians import heavy, lagrangian, squares
from tests.support.record_mutations import TWINS, twin
from tests.support.walks import ESTIMATES, FLUIDS, NAMES, OTHERS, SEED, problem
from tests.support.walks import record as ready_made_record

READY = tuple(dict.fromkeys((*NAMES, *OTHERS, *FLUIDS, *ESTIMATES)))


def read(text, **allowed):
    """The problem of a file."""
    return problem_of(tomllib.loads(text), **allowed)


# -- points and solids ----------------------------------------------------------------------------


def simplex(n, mass="q"):
    """Two points along every axis, one mass a parameter: by default the body is regular."""
    axes = [[int(i == j) for j in range(n)] for i in range(n)]
    others = [(2 + k, e) for k, e in enumerate(axes)]
    return points((mass, [1] * n), *others, *((1, [-2 * x for x in e]) for e in axes))


def points(*masses_and_places):
    return {"point": [{"mass": m, "at": [*r]} for m, r in masses_and_places]}


SYMBOLIC = {"body": {"moments": "symbolic"}}
SIGNED = {
    **{name: (name, simplex(2)) for name in ("SL(2)", "GL(2)", "SAff(2)", "Aff(2)", "SE(2)")},
    **{name: (name, simplex(3)) for name in ("SO(3)", "SE(3)", "UT(3)", "Sim(3)")},
    "Sp(4)": ("Sp(4)", simplex(4)),
    "SO(4)": ("SO(4)", simplex(4)),
    "moments": ("SO(3)", SYMBOLIC),
    "moments of SE(3)": ("SE(3)", SYMBOLIC),
}


def of_masses(group, body, default=0.01, **signed):
    """A problem named hole, of a body with the mass q."""
    given = {} if "body" in body else {"parameters": {"q": default}}
    return problem_of({"name": "hole", "group": group, **given, **body}, **signed)


def large(group, n, count, *, wrench=False):
    """Points with a parameter in every mass and in some coordinates, in a field and on a spring."""
    names = [f"{x}{i}" for x in "mx" for i in range(count)]
    data = {
        "name": "test",
        "group": group,
        "parameters": {x: {} for x in (*names, "k", "g")},
        "point": [
            {
                "mass": f"m{i}^2" if i else "m0",
                "at": [f"x{i}", *((i - 1) ** j for j in range(1, n))],
            }
            for i in range(count)
        ],
        "potential": [
            {"kind": "gravity", "g": [0] * (n - 1) + ["-g"]},
            {"kind": "spring", "between": [1, 2], "stiffness": "k/2"},
        ],
    }
    return problem_of(data | ({"input": [{"name": "push", "kind": "covector"}]} if wrench else {}))


LARGE = {
    "SL(2)": partial(large, "SL(2)", 2, 4),
    "SL(3)": partial(large, "SL(3)", 3, 5),
    "SL(4)": partial(large, "SL(4)", 4, 6),
    "SO(3)": partial(large, "SO(3)", 3, 4, wrench=True),
    "SE(3)": partial(large, "SE(3)", 3, 4, wrench=True),
}

SOLIDS = """
name = "test"
group = "GROUP"
[parameters]
a = 1.1
b = 0.7
rho = 2.0
[[solid]]
kind = "ellipsoid"
density = "rho"
semi_axes = ["a", "b", 0.5]
rotation = { axis = [1, 2, 2], angle = "pi/3" }
shift = [0.1, 0, "b"]
[[solid]]
kind = "cone"
density = 3
radius = 0.4
height = "a"
[[potential]]
kind = "gravity"
g = [1, 0, "-9.81"]
"""
SOLIDS_ON = ("SE(3)", "SO(3)", "SL(3)", "SAff(3)", "Sim(3)")
DAMPED = 'name = "large"\ngroup = "SO(3)"\n[parameters]\na = 1.0\n' + "".join(
    f"[[point]]\nmass = 1\nat = {at}\n" for at in ([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1])
)
DAMPED += '[[damping]]\ncoefficient = "a"\non = [2, 3]\n'
"""Damping on some of the points."""

# -- ellipsoids of fluid --------------------------------------------------------------------------

FULL = np.array([[2.0, 0.5, 0.3], [0.5, 3.0, -0.2], [0.3, -0.2, 1.0]])
WELL = np.array([[2.0, 0.3, 0.1], [0.3, 1.0, 0.0], [0.1, 0.0, 0.5]])
RHO, SLOPE = 1.7, 0.4
LAYERS = "rho*(1 - q*s)^2/2 + s^3"
"""A density by the level s."""


def ellipsoid(n, Q=FULL, W=None, forces=(), density="rho"):
    """A problem on SL(n), its density a parameter; ``Q`` and ``W`` as far as n goes."""
    own = {"rho": RHO, "q": SLOPE} if "q" in density else {"rho": RHO}
    body = Solid("ellipsoid", density, quadric=Q[:n, :n].tolist())
    acting = [Harmonic(W[:n, :n].tolist())] if W is not None else []
    return Problem("fluid", f"SL({n})", body, [*acting, *forces], parameters=own)


def of_axes(name="fluid", axes=("a", 1, 2), density="rho", **more):
    """An ellipsoid by its semi-axes, on SL(3)."""
    known = {"rho": 1, "a": 2, "phi": 0.3}
    body = Solid("ellipsoid", density, semi_axes=[*axes], **more)
    used = {x: y for x, y in known.items() if x in repr((axes, density, more))}
    return Problem(name, "SL(3)", body, parameters=used)


ELLIPSOIDS = {
    "in space": lambda: ellipsoid(3),
    "in a plane": lambda: ellipsoid(2, W=WELL),
    "in layers": lambda: ellipsoid(3, np.eye(3, dtype=int), density=LAYERS),
    "in layers of a plane": lambda: ellipsoid(2, W=WELL, density=LAYERS),
    "turned": lambda: of_axes(rotation={"axis": [0, 0, 1], "angle": "phi"}),
    "a star": lambda: ellipsoid(3, forces=[SelfGravity(1)]),
    "heavy": lambda: ellipsoid(3, forces=[Gravity(0, 0, -5)]),
    "hung": lambda: of_axes(axes=(1, 2, 3), shift=[0, 0, 1]),
}

# -- expressions of a Lagrangian ------------------------------------------------------------------

SLANTED = "3*(zeta_1 - zeta_3)^2/4 + 3*zeta_2^2/2 - A_31 - A_33"
"""A pendulum about (1, 0, 1): no element of the basis has no energy."""
LAGRANGIANS = {
    "left": lambda: lagrangian(squares(1, 2, 3), "SL(2)"),
    "right": lambda: lagrangian(squares(1, 2, 3), "SL(2)", side="right"),
    "free left": lambda: lagrangian(squares(1, 1, 1)),
    "free right": lambda: lagrangian(squares(1, 1, 1), side="right"),
    "slanted left": lambda: lagrangian(SLANTED),
    "slanted right": lambda: lagrangian(SLANTED.replace("A_31", "A_13"), side="right"),
    "still": lambda: lagrangian("(zeta_1^2 + zeta_3^2)/2 - A_23", "UT(3)"),
    "a force that changes nothing": lambda: lagrangian(
        f"({squares(1, 1, 1)})/2 - A_33 - 2*A_21^2", "UT(3)"
    ),
    **{" ".join(map(str, x)): partial(advected.problem, *x) for x in advected.CASES},
}


# -- steps in time --------------------------------------------------------------------------------

DRIVEN = """
name = "pushed"
group = "GROUP"
parameters = { k = {}, m_3 = {} }
point = [
  { mass = 1, at = [1, 2, 1] }, { mass = 2, at = [1, -2, 3] },
  { mass = "m_3", at = [3, 1, 2] }, { mass = 1, at = [-1, 1, 5] },
]
potential = [{ kind = "spring", on = 1, anchor = [1, 0, 2], stiffness = "k", length = 1 }]
damping = [{ coefficient = "k", on = [1, 3] }]
input = [
  { name = "f", kind = "force", on = 2, frame = "body" }, { name = "u", kind = "covector" },
  { name = "p", kind = "force", on = 4, direction = [1, "k", 0]MOMENT },
]
"""
"""A problem of points on which inputs and damping act, without its group."""


def driven(group, length=1):
    """The same on a group; a moment goes with a force where it turns; ``length`` of the spring."""
    moment = ", moment = [0, 1, 2]" if group.startswith("S") and group != "SL(3)" else ""
    text = DRIVEN.replace("GROUP", group).replace("MOMENT", moment)
    return text.replace("length = 1 ", f"length = {length} ")


DRIVEN_ON = ("SO(3)", "SL(3)", "GL(3)", "SE(3)")
STEPPED = ("linear", "affine", "so3", "se3", "sl3", "gl3", "saff3", "so4", "sp4", "heisenberg")
STEPPED += ("sim3", "top", "hammer")


def in_steps(name):
    """The discrete road of a ready-made problem, in general position, or of a driven one."""
    if name in DRIVEN_ON:
        return discrete(read(driven(name)))
    return twin(name, discrete) if name in TWINS else discrete(load_problem(name))


# -- what is found --------------------------------------------------------------------------------

SIDES = ("left", "right")
GROUPS = ("SE(2)", "SL(2)", "GL(2)", "SAff(2)", "Sim(2)", "UT(3)", "UT(4)", "SU(2)", "SE(3)")
"""On which integrals are sought."""
FACTORS = (3, 5, 11, 13, 19, 29)
INTEGRALS = ("euler_top", "lagrange_top", "kovalevskaya_top", "manakov", "gyrostat", "kirchhoff")
INTEGRALS += ("euler_poisson",)
LEVEL = heavy(("4", "4", "1"), "m*A_31", "m")
"""Goryachev's and Chaplygin's top."""
NO_SYMMETRIES = ("zeitlin", "euler_poisson", "jelly", "saff3", "sim3", "sp4", "gl3")
SYMMETRIC = ("so3", "se3", *(x for x in OTHERS if x not in NO_SYMMETRIES))


def kept_on(group, side):
    """First integrals of a Lagrangian without symmetries."""
    d = named_group(group).dimension
    L = f"{squares(*FACTORS[:d])} + zeta_1*zeta_{d}/7 + zeta_2/3 - 3*A_21 + 2*A_11^2"
    return first_integrals(lagrangian(L, group, side=side), 3)


def symmetries_of(name):
    """Those of a problem of their own, or of a ready-made one."""
    if name in symmetric.FILES:
        return symmetric.found(name)
    return symmetries(problem(name), ready_made_record(name))


# -- all ------------------------------------------------------------------------------------------

TORI = ("3", "5", "7", "9", "13")


STIRRED = {
    "parameters": {"kappa": 0.3, "nu": 0.02},
    "input": [{"kind": "covector", "name": "f"}],
    "damping": [
        {"kind": "laplacian", "coefficient": "kappa"},
        {"kind": "laplacian", "coefficient": "nu", "power": 2},
    ],
}
"""An input, drag and hyperviscosity of a fluid on the torus."""


def on_the_torus(N):
    """Zeitlin's model of this size."""
    return walk(problem_of(fluid(N)))


def stirred_torus(N):
    """The same, forced and damped."""
    return problem_of(fluid(N) | STIRRED)


def fluid(N):
    """A file of this model."""
    algebra, inertia = {"of": "torus", "N": int(N)}, {"operator": "laplacian"}
    return {"name": "fluid", "algebra": algebra, "inertia": inertia}


IN_FIELDS = {
    "well": {"forces": "potential"},
    "blown": {"forces": "given"},
    "wind": {"density": "advected", "forces": "given"},
}
"""Fluids in a field of force, and on which any force acts."""


def in_a_field(name):
    """One of these."""
    return walk(problem_of({"name": name, "fluid": IN_FIELDS[name]}))


def walked(made):
    """Name → what makes a problem, as what makes its record."""
    return {x: lambda make=make: walk(make()) for x, make in made.items()}


STARS = ("riemann_ellipsoid",)
"""Under their own gravity."""
READ = {x: text for x, text in PROBLEMS.items() if x not in READY} | {"some damped": DAMPED}
READ |= {f"solids on {x}": SOLIDS.replace("GROUP", x) for x in SOLIDS_ON}
ROADS = {
    "ready": {x: partial(ready_made_record, x) for x in READY if x not in (*FLUIDS, *STARS)},
    "star": {x: partial(ready_made_record, x) for x in STARS},
    "fluid": {x: partial(ready_made_record, x) for x in FLUIDS}
    | {x: partial(in_a_field, x) for x in IN_FIELDS},
    "moved": {x: partial(twin, x) for x in TWINS},
    "forces": walked({x: partial(read, y) for x, y in READ.items() if x.endswith("forces")}),
    "points": walked({x: partial(read, y) for x, y in READ.items() if not x.endswith("forces")})
    | walked({f"many on {x}": make for x, make in LARGE.items()}),
    "signed": walked({x: partial(of_masses, *y, negative_mass=True) for x, y in SIGNED.items()}),
    "ellipsoid": walked(ELLIPSOIDS),
    "lagrangian": walked(LAGRANGIANS),
    "torus": {x: partial(on_the_torus, x) for x in TORI}
    | {"stirred": lambda: walk(stirred_torus(5))},
    "discrete": {x: partial(in_steps, x) for x in (*STEPPED, *DRIVEN_ON)},
    "symmetries": {x: lambda x=x: symmetries_of(x).record for x in (*symmetric.FILES, *SYMMETRIC)},
    "reduced": {x: lambda x=x: reduced.reduced(x).record for x in (*reduced.FILES, *reduced.LONG)},
    "integrals": {x: lambda x=x: first_integrals(x, 3).record for x in INTEGRALS}
    | {"a level": lambda: first_integrals(LEVEL, 3).record}
    | {f"{x} {y}": lambda x=x, y=y: kept_on(x, y).record for x in GROUPS for y in SIDES},
}
"""Road → problem → what makes the record."""
NAMED = {f"{road} {x}": make for road, rest in ROADS.items() for x, make in rest.items()}


@on_disk
def record(name):
    """The record of a road and a problem."""
    return NAMED[name]()


@cache
def checker(name):
    """The checker of a record, the same for all tests of a process."""
    return checker_of(record(name).problem, SEED)
