"""Lagrangians ℓ(t, g, Z) beside Euler and Lagrange, who have no brackets: ready-made and random
ones on groups, those of algebras without a group in the state, and the linearised equations.

Of an algebra alone the oracle has Γ = ρ(g)⁻¹Γ₀, on the right ρ(g)Γ₀, as a function of matrices.
"""

import os
import re
import tomllib

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from derive.algebra.families import group
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from tests.oracles.euler_lagrange import motion
from tests.problems import READY
from tests.support import advected
from tests.support.lagrangians import lagrangian_of
from tests.support.library import emission, module, module_of
from tests.support.walks import problem, record_that_holds

READY_MADE = ("gyrostat", "kirchhoff", "charged_body", "coupled")
READY_MADE += ("euler_top", "lagrange_top", "kovalevskaya_top", "manakov")


def of_file(name):
    """The data of a ready-made file, with ℓ as an expression and the defaults of its parameters."""
    data = tomllib.loads((READY / f"{name}.toml").read_text(encoding="utf-8"))
    values = {x: about["default"] for x, about in data["parameters"].items()}
    if "inertia" in data:
        rows = enumerate(data["inertia"]["operator"], 1)
        terms = [f"({x})*zeta_{i}*zeta_{j}/2" for i, row in rows for j, x in enumerate(row, 1)]
        data["lagrangian"] = {"L": " + ".join(terms)}
    return data | {"parameters": values}


def of_data(data, group):
    """ℓ of a file."""
    return lagrangian_of(data["lagrangian"]["L"], group, data["parameters"])


def states(group, basis, rng, several):
    """Random elements of a group, and coordinates of velocities."""
    for _ in range(several):
        g = np.array(group.sample(Integers(rng), 9), float)
        yield g, rng.normal(size=len(basis))


class Integers:
    def __init__(self, rng):
        self.rng = rng

    def randint(self, low, high):
        return int(self.rng.integers(low, high + 1))


def held(found, group, lagrangian, t, g, zeta, u=(), *, right=False):
    """What a module makes of one state, beside ℓ."""
    basis = np.array(found.BASIS, float)
    k = found.constants(found.DEFAULTS)
    place = [g[x] for x in places(group)]
    dx = found.rhs(t, np.array([*place, *zeta]), k, np.array(u) if len(u) else None)
    load = np.array(u) if len(u) else 0.0
    expected, energy = motion(lagrangian, basis, t, g, zeta, load, right=right)
    scale = max(1, np.abs(expected).max())
    assert np.abs(dx[len(place) :] - expected).max() < 1e-12 * scale
    Z = np.tensordot(zeta, basis, 1)
    moved = Z @ g if right else g @ Z
    assert np.abs(dx[: len(place)] - [moved[x] for x in places(group)]).max() < 1e-13 * scale
    # of several thousand where entries of g are large
    near = pytest.approx(energy, rel=1e-14, abs=1e-12)
    assert found.energy(t, np.array([*place, *zeta]), k) == near


def places(group):
    """The entries of g that the state has, factor after factor."""
    for offset, factor in group.places:
        span = range(offset, offset + factor.n)
        yield from ((i, j) for i in span for j in span)
        if factor.affine:
            yield from ((i, offset + factor.n) for i in span)


@pytest.mark.parametrize("name", READY_MADE)
def test_ready_made(name):
    group, found = problem(name).group, module_of(name)
    rng = np.random.default_rng(1)
    ell = of_data(of_file(name), group)
    for g, zeta in states(group, found.BASIS, rng, 2):
        held(found, group, ell, 0.0, g, zeta)


@pytest.mark.parametrize("name", ["SL(3)", "Sp(4)", "Sim(3)", "SAff(2)", "SU(2)"])
def test_on_other_groups(name):
    """A square that couples velocities, one of them with an entry of g, and a potential."""
    d = group(name).dimension
    squares = " + ".join(f"{a + 1}*zeta_{a}^2" for a in range(1, d + 1))
    L = f"({squares})/2 + zeta_1*zeta_{d}/3 + A_12*zeta_2 - A_11*A_21^2"
    data = {"name": "test", "group": name, "lagrangian": {"L": L}, "parameters": {}}
    p = problem_of(data)
    found = module_of(p)
    ell = of_data(data, p.group)
    for g, zeta in states(p.group, found.BASIS, np.random.default_rng(1), 2):
        held(found, p.group, ell, 0.3, g, zeta)


EXAMPLES = int(os.environ.get("EXAMPLES", "5"))
GROUPS = {  # with d, and the entries of g that a term may have
    "SO(3)": (3, ["A_11", "A_23", "A_32"]),
    "SL(2)": (3, ["A_11", "A_12", "A_22"]),
    "SE(2)": (3, ["A_12", "T_1", "T_2"]),
    "UT(3)": (3, ["A_12", "A_23"]),
    "GL(2)": (4, ["A_12", "A_21"]),
    "SO(2) x SE(2)": (4, ["A1_12", "A2_11", "T2_2"]),
}
OWN = {
    "name": "Turned",
    "basis": [
        [[0, 1, 0], [-1, 0, 0], [0, 0, 0]],
        [[0, 0, 1], [0, 0, 1], [-1, -1, 0]],
        [[0, 0, -1], [0, 0, 1], [1, -1, 0]],
    ],
}
"""so(3) in a basis of one's own."""


@st.composite
def lagrangians(draw):
    """The data of a file: a definite square, and terms of all kinds."""
    name = draw(st.sampled_from([*GROUPS, "Turned"]))
    d, entries = GROUPS.get(name, (3, ["A_13", "A_21"]))
    zeta = [f"zeta_{a}" for a in range(1, d + 1)]
    atom = st.sampled_from([*entries, "t", "a", "b"])
    terms = [f"{k}*({x})^2/2" for k, x in zip("3579", zeta, strict=False)]
    for _ in range(draw(st.integers(1, 4))):
        factors = [draw(atom)]
        factors += draw(st.lists(st.sampled_from(zeta), max_size=2))
        factors += draw(st.lists(atom, max_size=1))
        kind = draw(
            st.sampled_from(["{}", "sin({})", "({})^2", "sqrt(9 + ({})^2)", "exp(-({})^2)"])
        )
        terms.append(f"{draw(st.integers(1, 5))}*{kind.format('*'.join(factors))}/10")
    table = {"L": " + ".join(terms), "trivialisation": draw(st.sampled_from(["left", "right"]))}
    data = {"name": "test", "group": OWN if name == "Turned" else name, "lagrangian": table}
    used = {x: 0.5 + 0.3 * k for k, x in enumerate("ab") if re.search(rf"\b{x}\b", table["L"])}
    if draw(st.booleans()):
        data["input"] = [{"name": "u", "kind": "covector"}]
    return data | {"parameters": used}


@pytest.mark.no_cover
@settings(
    max_examples=EXAMPLES,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[*HealthCheck],
)
@given(data=lagrangians())
def test_holds_and_agrees(data):
    try:
        problem = problem_of(data)
    except ProblemError as error:
        assume("is singular" not in str(error))
        raise
    record = record_that_holds(problem)
    files = emit(assemble(record, problem.group), record, ("python",), "test")
    found = module("test", files["test.py"])
    rng, right = np.random.default_rng(3), data["lagrangian"]["trivialisation"] == "right"
    ell = of_data(data, problem.group)
    for g, zeta in states(problem.group, found.BASIS, rng, 2):
        u = rng.normal(size=len(found.INPUTS))
        if np.abs(g).max() <= 20:
            held(found, problem.group, ell, 0.3, g, zeta, u, right=right)


def oracle_representation(name, kind):
    """ρ(g) as a function of g by matrices alone, or of g and g⁻¹."""
    E = advected.matrices(name)
    flat = np.linalg.pinv(E.reshape(len(E), -1).T)
    if kind in ("standard", "dual"):
        return len(E[0]), lambda g: g if kind == "standard" else jnp.linalg.inv(g).T

    def adjoint(g):
        moved = jnp.einsum("ij,ajk,kl->ail", g, E, jnp.linalg.inv(g))
        return jnp.einsum("bm,am->ba", flat, moved.reshape(len(E), -1))

    return len(E), adjoint if kind == "adjoint" else lambda g: jnp.linalg.inv(adjoint(g)).T


@pytest.mark.parametrize(("case", "kind", "by_brackets"), advected.CASES)
def test_the_code_agrees(case, kind, by_brackets):
    found = module_of(advected.problem(case, kind, by_brackets))
    name, side, *_ = advected.GIVEN[case]
    E, (m, rho) = advected.matrices(name), oracle_representation(name, kind)
    text, right = advected.lagrangian(case).replace("^", "**"), side == "right"
    rng = np.random.default_rng(5)
    functions = {x: getattr(jnp, x) for x in ("sin", "exp")}
    start, g = rng.normal(size=m), np.eye(len(E[0]))

    def carried(g):
        moved = rho(g)
        return moved @ start if right else jnp.linalg.inv(moved) @ start

    def lagrangian(t, g, zeta):
        names = {f"zeta_{a}": x for a, x in enumerate(zeta, 1)}
        names |= {f"x_{i}": x for i, x in enumerate(carried(g), 1)}
        return eval(text, functions, names | {"t": t})

    for _ in range(2):
        zeta, u = rng.normal(size=(2, len(E)))
        x = np.array([*zeta, *start])
        dx = found.rhs(0.4, x, found.constants([]), u)
        expected, _ = motion(lagrangian, E, 0.4, g, zeta, u, right=right)
        scale = max(1, np.abs(expected).max())
        assert np.abs(dx[: len(E)] - expected).max() < 1e-12 * scale
        with jax.enable_x64(True):
            _, rate = jax.jvp(carried, (jnp.asarray(g),), (jnp.tensordot(zeta, E, 1),))
            rate = np.asarray(rate)
        assert np.abs(dx[len(E) :] - rate).max() < 1e-12 * scale


TEXT = (
    "(2*zeta_1^2 + 3*zeta_2^2 + 4*zeta_3^2)/2 - T_1*A_12*zeta_2/5 + T_2^2/3 + zeta_1*zeta_3*A_11/3"
)


@pytest.mark.parametrize("side", ["left", "right"])
def test_by_families_of_curves(side):
    data = {"name": "test", "group": "SE(2)", "lagrangian": {"L": TEXT, "trivialisation": side}}
    p = problem_of(data)
    name, texts = emission(p, ("python",), jacobian=("state",))
    assert f"delta g = {'g eta' if side == 'left' else 'eta g'}" in texts[f"{name}.py"]
    code = module_of(p, jacobian=("state",))
    k, rng, E = code.constants([]), np.random.default_rng(6), np.array(code.BASIS, float)
    turn = np.array([[0.6, -0.8, 0.7], [0.8, 0.6, -1.3], [0, 0, 1]])
    zeta, eta, change = rng.normal(size=(3, 3))

    def state(g, zeta):
        return np.array([*g[:2, :2].reshape(-1), *g[:2, 2], *zeta])

    _, D = code.jacobian(0.0, state(turn, zeta), k)
    rates = D @ np.array([*eta, *change])
    h = 1e-5
    moved = [turn + s * h * displaced(side, turn, np.tensordot(eta, E, 1)) for s in (1, -1)]
    # beyond the group by h², which central differences do not see
    ends = [
        code.rhs(0.0, state(g, zeta + s * h * change), k)
        for g, s in zip(moved, (1, -1), strict=True)
    ]
    assert np.abs(rates[3:] - (ends[0] - ends[1])[6:] / (2 * h)).max() < 1e-8

    with jax.enable_x64(True):
        flat = np.linalg.pinv(E.reshape(3, -1).T)
        X, Z, dZ = (jnp.tensordot(jnp.asarray(x), E, 1) for x in (eta, zeta, change))

        def variation(t):
            """η at the time t, of the curves g_s(t)."""

            def curve(s):
                g = jnp.asarray(turn) + s * displaced(side, jnp.asarray(turn), X)
                return g + t * displaced(side, g, Z + s * dZ)

            g, rate = jax.jvp(curve, (0.0,), (1.0,))
            back = jnp.linalg.inv(g)
            return back @ rate if side == "left" else rate @ back

        _, found = jax.jvp(variation, (0.0,), (1.0,))
        assert np.abs(rates[:3] - flat @ np.asarray(found).reshape(-1)).max() < 1e-12


def displaced(side, g, x):
    """The tangent vector at g of an element x of the algebra."""
    return g @ x if side == "left" else x @ g
