"""Algebras without a group in the state: the code beside Euler and Lagrange on a matrix group.

The oracle has no brackets and no rule for Γ: there Γ = ρ(g)⁻¹Γ₀, on the right ρ(g)Γ₀, is a function
of matrices, and ℓ one of (t, g, Z).
"""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.algebra.families import group
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.code.options import Options
from derive.code.program import LoweringError
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.json_reader import from_json
from derive.record.json_writer import to_json
from tests.oracles.euler_lagrange import acceleration
from tests.support.walks import own_verdicts, problem, record


def matrices(name):
    """A basis of a known algebra, as the oracle has it: on (r, 1) where it is affine."""
    found = group(name).stated
    return np.array([[[float(x) for x in row] for row in e] for e in found.basis])


def brackets(E):
    """The rows of a table for these matrices, by least squares."""
    flat = np.linalg.pinv(E.reshape(len(E), -1).T)
    rows = []
    for a in range(len(E)):
        for b in range(a + 1, len(E)):
            found = flat @ (E[a] @ E[b] - E[b] @ E[a]).reshape(-1)
            rows += [[a + 1, b + 1, k + 1, round(x)] for k, x in enumerate(found) if abs(x) > 0.5]
    return rows


def square(d):
    return " + ".join(f"{2 + k}*zeta_{k + 1}^2" for k in range(d)) + " + zeta_1*zeta_2"


CASES = {  # group, the oracle's terms beside the square, by text and by jax
    "heavy top": ("SO(3)", "left", "standard", "-3*x_3 + x_1*zeta_2"),
    "on the right": ("SO(3)", "right", "standard", "-3*x_3 + x_1*zeta_2"),
    "underwater": ("SE(3)", "left", "dual", "x_1^2 - x_2*x_4"),
    "Heisenberg": ("UT(3)", "left", "standard", "x_1*x_2 + x_2*zeta_3"),
    "Heisenberg on the right": ("UT(3)", "right", "dual", "sin(x_1)*zeta_1 + t*x_3"),
    "plane": ("SL(2)", "right", "standard", "exp(x_1/3) + x_2^3"),
    "displacements of the plane": ("SE(2)", "left", "standard", "x_1*x_2*zeta_3"),
}
BY_BRACKETS = {"heavy top": "adjoint", "Heisenberg": "coadjoint", "plane": "adjoint"}
"""Given without matrices: the representation is then one that every algebra has."""


def oracle_representation(name, kind):
    """ρ(g) as a function of g by matrices alone, or of g and g⁻¹."""
    E = matrices(name)
    flat = np.linalg.pinv(E.reshape(len(E), -1).T)
    if kind in ("standard", "dual"):
        return len(E[0]), lambda g: g if kind == "standard" else jnp.linalg.inv(g).T

    def adjoint(g):
        moved = jnp.einsum("ij,ajk,kl->ail", g, E, jnp.linalg.inv(g))
        return jnp.einsum("bm,am->ba", flat, moved.reshape(len(E), -1))

    return len(E), adjoint if kind == "adjoint" else lambda g: jnp.linalg.inv(adjoint(g)).T


def typed(case, kind, *, by_brackets):
    name, side, _, terms = CASES[case]
    E = matrices(name)
    algebra = {"brackets": brackets(E), "dimension": len(E)} if by_brackets else {"of": name}
    return {
        "name": "test",
        "algebra": algebra,
        "advected": [{"name": "x", "representation": kind}],
        "lagrangian": {"L": f"{square(len(E))} + {terms}", "trivialisation": side},
        "input": [{"name": "u", "kind": "covector"}],
    }


def module(p, d):
    space = {}
    exec(compile(emit(assemble(d, p.group), d, ("python",), "test")["test.py"], "t", "exec"), space)
    return space


LISTED = [(x, CASES[x][2], False) for x in CASES] + [(x, y, True) for x, y in BY_BRACKETS.items()]


@pytest.mark.parametrize(("case", "kind", "by_brackets"), LISTED)
def test_holds_and_agrees(case, kind, by_brackets):
    data = typed(case, kind, by_brackets=by_brackets)
    p = problem_of(data)
    d = walk(p)
    assert from_json(to_json(d)) == d
    assert [f"{v.label}: {v.reason}" for v in own_verdicts(d) if not v.holds] == []
    found, (name, side, _, _) = module(p, d), CASES[case]
    E, (m, rho) = matrices(name), oracle_representation(name, kind)
    text, right = data["lagrangian"]["L"].replace("^", "**"), side == "right"
    rng = np.random.default_rng(5)
    functions = {x: getattr(jnp, x) for x in ("sin", "exp")}
    for _ in range(2):
        zeta, start, u = rng.normal(size=len(E)), rng.normal(size=m), rng.normal(size=len(E))
        g = np.eye(len(E[0]))

        def carried(g, start=start):
            moved = rho(g)
            return moved @ start if right else jnp.linalg.inv(moved) @ start

        def lagrangian(t, g, zeta, carried=carried):
            names = {f"zeta_{a}": x for a, x in enumerate(zeta, 1)}
            names |= {f"x_{i}": x for i, x in enumerate(carried(g), 1)}
            return eval(text, functions, names | {"t": t})

        x = np.array([*zeta, *start])
        dx = found["rhs"](0.4, x, found["constants"]([]), u)
        expected = acceleration(lagrangian, E, 0.4, g, zeta, u, right=right)
        scale = max(1, np.abs(expected).max())
        assert np.abs(dx[: len(E)] - expected).max() < 1e-12 * scale
        with jax.enable_x64(True):
            _, rate = jax.jvp(carried, (jnp.asarray(g),), (jnp.tensordot(zeta, E, 1),))
            rate = np.asarray(rate)
        assert np.abs(dx[len(E) :] - rate).max() < 1e-12 * scale


def test_as_with_an_element_of_the_group():
    """The heavy top by its attitude: γ is the last row of A, and both are one motion."""
    reduced, d = problem("euler_poisson"), record("euler_poisson")
    names = {f"gamma_{i}": f"A_3{i}" for i in (1, 2, 3)}
    text = "(I1*zeta_1^2 + I2*zeta_2^2 + I3*zeta_3^2)/2 - c1*gamma_1 - c3*gamma_3"
    for old, new in names.items():
        text = text.replace(old, new)
    values = {x: y.default for x, y in reduced.parameters.items()}
    data = {"name": "whole", "group": "SO(3)", "lagrangian": {"L": text}, "parameters": values}
    p = problem_of(data)
    one, two = module(reduced, d), module(p, walk(p))
    A, zeta = np.array(group("SO(3)").sample(Small(), 3), float), np.array([0.3, -0.8, 1.1])
    start = np.array([*zeta, *A[2]])
    runs = [
        solve_ivp(f["rhs"], (0, 5), x, "DOP853", rtol=1e-12, atol=1e-12, args=(f["constants"](k),))
        for f, x, k in (
            (one, start, one["DEFAULTS"]),
            (two, np.array([*A.reshape(-1), *zeta]), two["DEFAULTS"]),
        )
    ]
    end, whole = (run.y[:, -1] for run in runs)
    assert np.abs(end[:3] - whole[9:]).max() < 1e-9
    assert np.abs(end[3:] - whole[6:9]).max() < 1e-9
    k = one["constants"](one["DEFAULTS"])
    energies = [one["energy"](0.0, x, k) for x in runs[0].y.T]
    assert max(energies) - min(energies) < 1e-9


class Small:
    """A source of small integers, always the same."""

    def __init__(self):
        self.left = [1, -2, 3, 1, 2, -1, 1, 1, 2]

    def randint(self, low, high):
        return max(low, min(high, self.left.pop()))


@pytest.mark.parametrize(
    "options",
    [
        {"velocity": "tangent"},
        {"attitude": "quaternion"},
        {"layout": "col"},
        {"jacobian": ("state",)},
    ],
)
def test_what_needs_an_element_is_refused(options):
    p = problem("euler_poisson")
    with pytest.raises(LoweringError, match="a state with an element of the group"):
        assemble(record("euler_poisson"), p.group, Options(**options))
