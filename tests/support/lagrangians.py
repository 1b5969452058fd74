"""Problems whose Lagrangian is an expression; that as a function for JAX."""

from derive.algebra.families import group as named
from derive.problem.toml import problem_of
from derive.python.derived import derive
from derive.python.found import first_integrals
from tests.support.cached import on_disk


def lagrangian(L, group="SO(3)", parameters="", side="left", **more):
    """A problem named x; the names of its parameters stand in one text."""
    data = {"name": "x", "group": group, "parameters": {p: {} for p in parameters.split()}}
    return problem_of(data | {"lagrangian": {"L": L, "trivialisation": side}} | more)


def lagrangian_of(text, group, parameters=()):
    """ℓ(t, g, ζ) of an expression, for JAX, read by Python alone; ``group``: its blocks."""
    import jax.numpy as jnp

    words = " ".join(text.replace("^", "**").split())
    functions = {x: getattr(jnp, x) for x in ("sin", "sqrt", "exp", "cosh")}

    def ell(t, g, zeta):
        names = {f"zeta_{a}": x for a, x in enumerate(zeta, 1)}
        for k, (offset, factor) in enumerate(group.places, 1):
            mark, span = str(k) if len(group.places) > 1 else "", range(factor.n)
            names |= {
                f"A{mark}_{i + 1}{j + 1}": g[offset + i, offset + j] for i in span for j in span
            }
            if factor.affine:
                names |= {f"T{mark}_{i + 1}": g[offset + i, offset + factor.n] for i in span}
        return eval(words, functions, names | {"t": t} | dict(parameters))

    return ell


def heavy(moments, potential, parameters):
    """A heavy solid with principal moments of inertia, three expressions."""
    kinetic = " + ".join(f"({x})*zeta_{a}^2" for a, x in enumerate(moments, 1))
    return lagrangian(f"({kinetic})/2 - ({potential})", parameters=parameters)


def planes(n):
    """The planes i < j of the basis of so(n), in its order."""
    for e in named(f"SO({n})").basis:
        (found,) = [(i, j) for i in range(n) for j in range(i + 1, n) if e[i][j]]
        yield found


def manakov(a, b):
    """The metric (b_i − b_j)/(a_i − a_j) on SO(n), for numbers a and b."""
    terms = [
        f"({b[i]} - {b[j]})/({a[i]} - {a[j]})*zeta_{k}^2/2"
        for k, (i, j) in enumerate(planes(len(a)), 1)
    ]
    return lagrangian(" + ".join(terms), f"SO({len(a)})")


APART = {"name": "Apart", "basis": [[[1, 0], [0, 0]], [[0, 0], [0, 1]]]}
"""The diagonal matrices of the plane: an algebra that commutes."""
LINE = {"name": "Line", "basis": [[[1, 0], [0, 0]], [[0, 1], [0, 0]]]}
"""The affine maps of a line, as matrices of the plane: no Casimirs."""


LADDER = {
    "name": "Ladder",
    "basis": [
        [[1, 0, 0], [0, 2, 0], [0, 0, 0]],
        [[0, 0, 1], [0, 0, 0], [0, 0, 0]],
        [[0, 0, 0], [0, 0, 1], [0, 0, 0]],
    ],
}
"""Translations of a plane and a scaling by s and s², as linear maps."""


def unit(i, j):
    return [[int((i, j) == (k, m)) for m in range(4)] for k in range(4)]


TURN = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
BOOSTS = ([[0, 0, 1], [0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 0, 1], [0, 1, 0]])
LORENTZ = {"name": "Lorentz", "basis": [TURN, *BOOSTS]}
"""Those of a plane and a time that runs forwards, which is not what a form tells."""

SPIRAL = {
    "name": "Spiral",
    "basis": [
        [[1, -2, 0], [2, 1, 0], [0, 0, 0]],
        [[0, 0, 1], [0, 0, 0], [0, 0, 0]],
        [[0, 0, 0], [0, 0, 1], [0, 0, 0]],
    ],
}
"""Translations of a plane, and a turn that stretches."""

LINES = {"name": "Lines", "basis": [unit(0, 0), unit(0, 1), unit(2, 2), unit(2, 3)]}


def heisenberg():
    """A particle in a magnetic field Π₂, along the centre of the group, by springs."""
    return lagrangian("(zeta_1^2 + zeta_2^2 + zeta_3^2)/2 - A_12^2/2 - A_23^2", "UT(3)")


def squares(*factors):
    """A metric that is diagonal in the basis."""
    return " + ".join(f"{x}*zeta_{a}^2" for a, x in enumerate(factors, 1))


def every_case():
    """First integrals of problems that together reach whatever may be said of them."""
    return [
        first_integrals(lagrangian(squares(1, 2), LINE), 2),
        first_integrals(lagrangian(squares(1, 2, 3, 5), LINES), 2),
        first_integrals(lagrangian(squares(1, 2), APART), 2),
        first_integrals(lagrangian(squares(1, 1, 1)), 2),
        first_integrals(heavy("123", "A_33 + A_11^2", ""), 2),
        first_integrals(heavy("441", "m*A_31", "m"), 3),
        first_integrals(heavy("441", "m*A_31", "m"), 4),
        *(first_integrals(x) for x in ("gyrostat", "euler_top", "lagrange_top")),
        first_integrals("so3", 1, at_defaults=True),
        *(
            first_integrals(heavy("123", U, parameters), degree, conditions=True)
            for U, parameters, degree in (
                ("m*A_31", "m", 4),
                ("A_31 + k*A_32", "k", 1),
                ("(k^2 - 2*q^2)*A_31", "k q", 2),
            )
        ),
        first_integrals("lagrange_top", 1, conditions=True),
    ]


def two_algebras(weight, **parameters):
    """A heavy top beside affine maps of a line, its vertical advected: at rest the stabiliser does
    not commute, and the leaf is smaller than others."""
    by_axes = [[[0, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 0, 0], [-1, 0, 0]], TURN]
    matrices = [*by_axes, *[[[0] * 3] * 3] * 2]
    brackets = [[1, 2, 3, 1], [2, 3, 1, 1], [3, 1, 2, 1], [4, 5, 5, 1]]
    data = {"name": "x", "algebra": {"brackets": brackets}, "parameters": parameters}
    data["advected"] = [{"name": "u", "representation": matrices}]
    return problem_of(data | {"lagrangian": {"L": f"{squares(1, 2, 3, 1, 1)} - {weight}*u_3"}})


def nilpotent():
    """Heisenberg's algebra alone: some of its coadjoint orbits are points."""
    data = {"name": "x", "algebra": {"brackets": [[1, 2, 3, 1]]}}
    return derive(problem_of(data | {"lagrangian": {"L": squares(1, 1, 1)}}))


def bent():
    """A top with weight off its axes, and no equilibrium with simple coordinates."""
    return derive(heavy("132", "A_31/2 + A_33/3", ""))


def disc():
    """A disc in a fluid: edge-on it is unstable, and has an eigenvalue 0 as well."""
    moments = (1, 1, 2, 1, 1, 3)
    operator = [[int(i == j) * k for j in range(6)] for i, k in enumerate(moments)]
    return problem_of({"name": "x", "group": "SE(3)", "inertia": {"operator": operator}})


TWO = squares(1, 1, 2, 3) + " - A1_21 - A2_33"
"""A pendulum and a top that do not act on each other."""


def every_equilibrium():
    """Equilibria that together reach whatever may be said of them."""
    solid = squares(3, 5, 11, 13, 13, 13)
    tilted = {"A_31": "0.866", "A_33": "0.5", "Pi_1": "0.866", "Pi_3": 1}
    exact = {"A_31": "sqrt(3)/2", "A_33": "1/2", "Pi_1": "sqrt(3)/2", "Pi_3": 1}
    return [
        bent().equilibrium_near({"A_31": "0.7", "A_33": "0.5"}),
        bent().equilibrium_near({"A_31": "-0.7", "A_33": "-0.5"}),
        derive(heavy("132", "A_33/2", "")).equilibrium_near(tilted),
        derive("euler_top").equilibria(),
        derive("euler_top").equilibria({"Pi_1": 0}),
        derive(disc()).equilibria({"Pi_4": 1}),
        nilpotent().equilibria({"Pi_1": 1}),
        derive(lagrangian(squares(1, 1), LINE)).equilibria({"Pi_1": 1}),
        *(derive(lagrangian(squares(1, 1, 1), SPIRAL)).equilibria({"Pi_1": x}) for x in (1, -1)),
        derive(heavy("132", "A_33/2", "")).equilibria(exact),
        derive("lagrange_top").equilibria({"A_33": -1}),
        derive("pendulum").equilibria(),
        derive(lagrangian(TWO, "SO(2) x SO(3)")).equilibria({"A1_21": 1, "A2_33": 1}),
        derive(lagrangian(TWO, "SO(2) x SO(3)")).equilibria({"A1_21": -1, "A2_33": -1}),
        derive("kirchhoff").equilibria({"Pi_1": 1}),
        derive(lagrangian(solid, "SE(3)", side="right")).equilibria({"Pi_1": 1}),
        derive(lagrangian(solid, "SE(3)")).equilibria({"Pi_1": 1}),
        derive(lagrangian(squares(*range(2, 12)), "SO(5)")).equilibria({"Pi_1": 1}),
        derive(lagrangian(squares(*range(2, 8)), "SO(4)")).equilibria({"Pi_1": 1, "Pi_6": 1}),
        derive(lagrangian(squares(1, 1, 3) + " - A_33", LORENTZ)).equilibria({"A_33": -1}),
    ]


@on_disk
def every_record():
    """Those of all cases and equilibria."""
    return [x.record for x in (*every_case(), *every_equilibrium())]
