"""The motion in momenta: beside oracles without brackets, in every language, and what it keeps.

The momenta of a Lagrangian are ∂ℓ/∂ζ by JAX, their rates along the acceleration of Euler and
Lagrange; those of points Π_a = Σ m ⟨v, gE_a r⟩, the rates by the accelerations of Gauss's
principle, the Poisson tensor by the flows.
"""

import tomllib

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import derive
from derive.problem.toml import problem_of
from tests.oracles import general
from tests.oracles.euler_lagrange import motion
from tests.oracles.general import evaluate
from tests.problems import READY as READY_MADE
from tests.support.emitted_files import Emission
from tests.support.lagrangians import lagrangian_of
from tests.support.library import module_of
from tests.support.walks import own_verdicts

SQUARE = "zeta_1^2 + zeta_2^2 + zeta_3^2"
CASES = {  # group, side, ℓ; the last three are found by Newton's method
    "gyroscopic": ("SO(3)", "left", f"{SQUARE} + zeta_2^2 + zeta_1*zeta_3/3 + zeta_2 - A_33"),
    "right": ("SO(3)", "right", f"{SQUARE} - zeta_1^2/2 + A_12*zeta_2 - A_33"),
    "turning": ("SE(2)", "left", f"{SQUARE} + A_11*zeta_1^2/2 + t*zeta_3^2 + T_1*zeta_2"),
    "many": ("SO(4)", "right", f"{SQUARE} + zeta_4^2 + zeta_5^2 + zeta_6^2 + A_11*zeta_1*zeta_6"),
    "pairs": ("SO(4)", "left", "zeta_1*zeta_2 + zeta_3*zeta_4 + zeta_5*zeta_6 + A_11*zeta_1^2"),
    "light-like": ("SE(2)", "right", "zeta_1^2 + zeta_2*zeta_3 + T_1*zeta_1 - A_11"),
    "in a fluid": ("SE(3)", "left", f"{SQUARE} + 2*zeta_4^2 + zeta_5^2 + zeta_6^2 + zeta_1*zeta_4"),
    "quartic": ("SO(3)", "left", f"{SQUARE} + zeta_2^2 + ({SQUARE})^2/5 + zeta_1*A_13 - A_33"),
    "quartic on the right": ("SE(2)", "right", f"{SQUARE} + zeta_1^4 + zeta_2*T_1 + zeta_3^4"),
    "hyperbolic": ("SO(2)", "left", "cosh(zeta_1) + A_11"),
}  # fmt: skip


def typed(case, **more):
    group, side, text = CASES[case]
    data = {"name": "test", "group": group, "lagrangian": {"L": text, "trivialisation": side}}
    return problem_of(data | {"input": [{"name": "u", "kind": "covector"}]} | more)


def element(group, rng):
    """A random element of SO(n) or SE(n) as a matrix, and its entries in the state."""
    ((_, factor),) = group.places
    n = factor.n
    g, _ = np.linalg.qr(rng.normal(size=(n, n)))
    g[:, 0] *= np.linalg.det(g)
    if not factor.affine:
        return g, g.reshape(-1)
    place = rng.normal(size=n)
    return np.block([[g, place[:, None]], [np.zeros(n), 1]]), np.array([*g.reshape(-1), *place])


def by_hand(lagrangian, E, t, g, zeta, u, *, right):
    """∂ℓ/∂ζ, and its rate along the motion."""
    expected, _ = motion(lagrangian, E, t, g, zeta, u, right=right)
    with jax.enable_x64(True):
        Z, g = jnp.tensordot(zeta, E, 1), jnp.asarray(g)
        here = (jnp.asarray(t), g, jnp.asarray(zeta))
        there = (jnp.ones(()), Z @ g if right else g @ Z, jnp.asarray(expected))
        return map(np.asarray, jax.jvp(jax.grad(lagrangian, 2), here, there))


@pytest.mark.parametrize("case", CASES)
def test_c_and_python_beside_the_derivatives_of_the_lagrangian(case):
    p, right = typed(case), CASES[case][1] == "right"
    m, f = module_of(p, momenta=True), derive.compile(p, momenta=True)
    E, k, rng = np.array(m.BASIS, float), m.constants([]), np.random.default_rng(3)
    lagrangian, count = lagrangian_of(CASES[case][2], p.group), len(m.BASIS)
    states = []
    for _ in range(3):
        (g, place), zeta, u = element(p.group, rng), rng.normal(size=count), rng.normal(size=count)
        x = np.array([*place, *zeta])
        momenta, rates = by_hand(lagrangian, E, 0.4, g, zeta, u, right=right)
        y, scale = np.array([*place, *momenta]), max(1, np.abs(rates).max())
        states.append((x, y))
        turned = f.rhs(0.4, x, u)[: len(place)]
        for found, driven in ((f, (u,)), (m, (k, u))):
            constant = driven[:-1]
            assert np.abs(found.momentum(0.4, x, *constant) - y).max() < 1e-12 * scale
            assert np.abs(found.velocity(0.4, y, *constant) - x).max() < 1e-12
            dy = found.momentum_rhs(0.4, y, *driven)
            assert np.abs(dy - [*turned, *rates]).max() < 1e-12 * scale
            skew = found.poisson(0.4, y, *constant)
            assert np.array_equal(skew, -skew.T)
    x, y = map(np.stack, zip(*states, strict=True))
    assert np.abs(m.velocity(0.4, y, k) - x).max() < 1e-12


@pytest.mark.parametrize("case", ["gyroscopic", "right", "turning", "light-like"])
def test_a_covector_of_the_state_acts_as_the_input_with_its_values(case):
    """Beside an input that acts too; in ζ̇, and in the rates of the momenta."""
    values = ["-zeta_1", "A_12*zeta_2 + t", "u_1*zeta_3^2"]
    own = typed(case, force=[{"covector": values}])
    given, acted = (derive.compile(p, momenta=True) for p in (typed(case), own))
    rng = np.random.default_rng(6)
    (_, place), zeta, u = element(own.group, rng), rng.normal(size=3), rng.normal(size=3)
    x = np.array([*place, *zeta])
    named = dict(zip(acted.STATE, x, strict=True)) | {"t": 0.4, "u_1": u[0]}
    pushed = u + [evaluate(text, named) for text in values]
    assert np.abs(acted.rhs(0.4, x, u) - given.rhs(0.4, x, pushed)).max() < 1e-13
    y = acted.momentum(0.4, x)
    assert np.array_equal(y, given.momentum(0.4, x))
    rates = [f.momentum_rhs(0.4, y, w) for f, w in ((acted, u), (given, pushed))]
    assert np.abs(rates[0] - rates[1]).max() < 1e-12
    assert all(v.holds for v in own_verdicts(derive.derive(own).record))


@pytest.mark.parametrize("name", ["euler_poisson", "kirchhoff", "manakov", "coupled"])
def test_jacobi(name):
    """Σ Λ_ia ∂_a Λ_jk over the cycles of i, j, k vanishes; Λ is linear in the variables."""
    f, rng = derive.compile(name, momenta=True), np.random.default_rng(4)
    size, reduced = len(f.STATE), name == "euler_poisson"
    own = range(f.REDUCED) if reduced else range(size - f.REDUCED, size)
    y = rng.normal(size=size)
    here = f.poisson(0.0, y)
    slopes = np.array([f.poisson(0.0, y + np.eye(size)[i]) - here for i in own])
    first = np.einsum("ia,ajk->ijk", here, slopes)
    cycles = first + np.einsum("ijk->jki", first) + np.einsum("ijk->kij", first)
    assert np.abs(first).max() > 0.1
    assert np.abs(cycles).max() < 1e-13


def test_the_tensor_of_the_reduced_equations_makes_their_motion():
    """dy/dt = Λ ∇H, H the energy of the velocity that y has."""
    f = derive.compile("euler_poisson", momenta=True)
    y, h = np.random.default_rng(5).normal(size=6), 1e-5

    def energy(y):
        return f.energy(0.0, f.velocity(0.0, y))

    slope = [(energy(y + h * e) - energy(y - h * e)) / (2 * h) for e in np.eye(6)]
    assert np.abs(f.poisson(0.0, y) @ slope - f.momentum_rhs(0.0, y)).max() < 1e-9
    for casimir in ([0, 0, 0, *(2 * y[3:])], [*y[3:], *y[:3]]):
        assert np.abs(f.poisson(0.0, y) @ casimir).max() < 1e-14


def test_momenta_that_no_velocity_has():
    """Momenta of atan(ζ) are below 1 in size."""
    data = {"name": "test", "group": "SO(2)"}
    bounded = {"L": "sqrt(1 + zeta_1^2) + A_11/5"}
    f = derive.compile(problem_of(data | {"lagrangian": bounded}), momenta=True)
    y = np.array([1.0, 0, 0, 1, 0.3])
    assert f.velocity(0.0, y)[-1] == pytest.approx(0.3 / np.sqrt(1 - 0.09))
    for wrong in (1.5, np.nan, np.inf):
        y[-1] = wrong
        for function in (f.velocity, f.momentum_rhs):
            with pytest.raises(ArithmeticError, match="no velocity"):
                function(0.0, y)


# -- points ---------------------------------------------------------------------------------------

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
OF_POINTS = {name: name for name in READY} | {"two bodies": TWO, "flat": FLAT}


def data_of(case):
    if isinstance(OF_POINTS[case], dict):
        return OF_POINTS[case]
    return tomllib.loads((READY_MADE / f"{case}.toml").read_text(encoding="utf-8"))


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


@pytest.mark.parametrize("case", OF_POINTS)
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


# -- held against the record, and refused ---------------------------------------------------------

SPOILED = {
    "turning": ("out[4] = T_1;", "out[4] = T_2;"),
    "turning, a power": ("(Pi_2 - T_1)", "(Pi_2 + T_1)"),
    "turning, a rate": ("    dy[4] = ", "    dy[4] = 1 + "),
    "quartic": ("zeta_2 + M_solve_x_2", "zeta_2 + 2.0*M_solve_x_2"),
    "quartic, the tensor": ("    out[2] = Pi_2;", "    out[2] = Pi_1;"),
    "quartic, when it ends": ("change <= ", "change < "),
    "so3": ("Pi_2*velocity_3", "Pi_1*velocity_3"),
    "so3, an inverse": ("inv_I_12*Pi_2", "inv_I_13*Pi_2"),
    "so3, the tensor": ("    out[1] = -Pi_3;", "    out[1] = Pi_3;"),
    "se3": (
        "    out[3] = 0.0;\n    out[4] = -p_3;",
        "    out[3] = 0.0;\n    out[4] = p_3;",
    ),
    "sl3": ("momentum_22*Z_21", "Pi_5*Z_21"),
}
"""A problem, one of CASES or a ready-made one, and what is changed in its C."""


@pytest.mark.parametrize("name", dict.fromkeys(x.partition(",")[0] for x in SPOILED))
def test_validated(name):
    made = Emission(typed(name) if name in CASES else name, momenta=True)
    newton = name == "quartic"
    step = "velocity_step, momentum_rates" if newton else "velocity, momentum_rhs"
    for report in made.reports(fresh=made.files):
        assert f"momentum, {step}, poisson equal the record" in report.text
        assert ("for it is a loop: Newton's method" in report.text) == newton
    file = f"{made.name}.c"
    for old, new in (x for case, x in SPOILED.items() if case.partition(",")[0] == name):
        assert old in made.files[file], old
        changed = {file: made.files[file].replace(old, new, 1)}
        assert "DIFFERS" in " ".join(x.text for x in made.reports(changed, made.files)), old
