"""The motion in momenta: beside an oracle without brackets, in every language, and what it keeps.

The momenta are ∂ℓ/∂ζ by JAX, their rates along the acceleration of Euler and Lagrange.
"""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.code.options import Options
from derive.command.cli import main
from derive.pipeline import walk
from derive.problem.toml import problem_of
from tests.oracles.euler_lagrange import acceleration
from tests.support.emitted import import_python

SQUARE = "zeta_1^2 + zeta_2^2 + zeta_3^2"
CASES = {  # group, side, ℓ; the last three are found by Newton's method
    "gyroscopic": ("SO(3)", "left", f"{SQUARE} + zeta_2^2 + zeta_1*zeta_3/3 + zeta_2 - A_33"),
    "right": ("SO(3)", "right", f"{SQUARE} - zeta_1^2/2 + A_12*zeta_2 - A_33"),
    "turning": ("SE(2)", "left", f"{SQUARE} + A_11*zeta_1^2/2 + t*zeta_3^2 + T_1*zeta_2"),
    "many": ("SO(4)", "right", f"{SQUARE} + zeta_4^2 + zeta_5^2 + zeta_6^2 + A_11*zeta_1*zeta_6"),
    "pairs": ("SO(4)", "left", "zeta_1*zeta_2 + zeta_3*zeta_4 + zeta_5*zeta_6 + A_11*zeta_1^2"),
    "light-like": ("SE(2)", "right", "zeta_1^2 + zeta_2*zeta_3 + T_1*zeta_1 - A_11"),
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


def lagrangian_of(text, n):
    """ℓ(t, g, ζ) of JAX by the text of a case."""

    def lagrangian(t, g, zeta):
        names = {f"zeta_{a}": x for a, x in enumerate(zeta, 1)}
        names |= {f"A_{i + 1}{j + 1}": g[i, j] for i in range(n) for j in range(n)}
        names |= {f"T_{i + 1}": g[i, -1] for i in range(n)}
        return eval(text.replace("^", "**"), {"cosh": jnp.cosh}, names | {"t": t})

    return lagrangian


def by_hand(lagrangian, E, t, g, zeta, u, *, right):
    """∂ℓ/∂ζ, and its rate along the motion."""
    expected = acceleration(lagrangian, E, t, g, zeta, u, right=right)
    with jax.enable_x64(True):
        Z, g = jnp.tensordot(zeta, E, 1), jnp.asarray(g)
        here = (jnp.asarray(t), g, jnp.asarray(zeta))
        there = (jnp.ones(()), Z @ g if right else g @ Z, jnp.asarray(expected))
        return map(np.asarray, jax.jvp(jax.grad(lagrangian, 2), here, there))


@pytest.mark.parametrize("case", CASES)
def test_c_and_python_beside_the_derivatives_of_the_lagrangian(case, tmp_path):
    p, right = typed(case), CASES[case][1] == "right"
    d = walk(p)
    for file, text in emit(
        assemble(d, p.group, Options(momenta=True)), d, ("python",), "test"
    ).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    m, f = import_python("test", tmp_path), derive.compile(p, momenta=True)
    E, k, rng = np.array(m.BASIS, float), m.constants([]), np.random.default_rng(3)
    lagrangian, count = lagrangian_of(CASES[case][2], p.group.n), len(m.BASIS)
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


@pytest.mark.parametrize("name", ["euler_poisson", "kirchhoff"])
def test_energy_and_casimirs_are_kept(name):
    f, rng = derive.compile(name, momenta=True), np.random.default_rng(6)
    x = rng.normal(size=len(f.STATE))
    if name == "kirchhoff":
        x[:9] = np.eye(3).reshape(-1)
    run = solve_ivp(f.momentum_rhs, (0, 10), f.momentum(0.0, x), "DOP853", rtol=1e-12, atol=1e-12)
    p, q = (run.y[-6:-3], run.y[-3:])
    energy = [f.energy(0.0, f.velocity(0.0, y)) for y in run.y.T]
    for kept in (energy, (p * q).sum(0), (q * q).sum(0)):
        assert np.ptp(kept) < 1e-9 * max(1, np.abs(kept).max())


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


# -- held against the record, and refused ---------------------------------------------------------

SPOILED = [
    ("turning", "out[4] = T_1;", "out[4] = T_2;"),
    ("turning", "(Pi_2 - T_1)", "(Pi_2 + T_1)"),
    ("turning", "    dy[4] = ", "    dy[4] = 1 + "),
    ("quartic", "zeta_2 + M_solve_x_2", "zeta_2 + 2.0*M_solve_x_2"),
    ("quartic", "    out[2] = Pi_2;", "    out[2] = Pi_1;"),
    ("quartic", "change <= ", "change < "),
]


def test_validated(tmp_path, capsys):
    for case in ("turning", "quartic"):
        group, side, text = CASES[case]
        path = tmp_path / f"{case}.toml"
        path.write_text(
            f'name = "{case}"\ngroup = "{group}"\n[lagrangian]\nL = "{text}"\n'
            f'trivialisation = "{side}"\n[[input]]\nname = "u"\nkind = "covector"\n'
        )
        words = ["emit", str(path), "--momenta", "--out", str(tmp_path)]
        assert main([*words, "--validate"]) == 0
        told = "".join(capsys.readouterr())
        newton = case == "quartic"
        step = "velocity_step, momentum_rates" if newton else "velocity, momentum_rhs"
        assert told.count(f"momentum, {step}, poisson equal the record") == 2
        assert ("for it is a loop: Newton's method" in told) == newton
        assert main(["emit", str(path), "--check", "--validate", "--out", str(tmp_path)]) == 0
        whole = (tmp_path / f"{case}.c").read_text(encoding="utf-8")
        for of, old, new in SPOILED:
            if of == case:
                assert old in whole, old
                (tmp_path / f"{case}.c").write_text(whole.replace(old, new), encoding="utf-8")
                capsys.readouterr()
                assert main(["emit", str(path), "--check", "--validate", "--out", str(tmp_path)])
                assert "DIFFERS" in "".join(capsys.readouterr()), old
        (tmp_path / f"{case}.c").write_text(whole, encoding="utf-8")


def test_nothing_without_the_option():
    with pytest.raises(ValueError, match="momenta=True"):
        derive.compile("gyrostat").momentum(0.0, np.zeros(12))
