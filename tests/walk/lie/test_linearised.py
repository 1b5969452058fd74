"""The linearised equations on both sides, by the derivative of families of curves of matrices."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of

TEXT = (
    "(2*zeta_1^2 + 3*zeta_2^2 + 4*zeta_3^2)/2 - T_1*A_12*zeta_2/5 + T_2^2/3 + zeta_1*zeta_3*A_11/3"
)


@pytest.mark.parametrize("side", ["left", "right"])
def test_by_families_of_curves(side):
    data = {"name": "test", "group": "SE(2)", "lagrangian": {"L": TEXT, "trivialisation": side}}
    p = problem_of(data)
    d, space = walk(p), {}
    files = emit(assemble(d, p.group, Options(jacobian=("state",))), d, ("python",), "test")
    exec(compile(files["test.py"], "test", "exec"), space)
    assert f"delta g = {'g eta' if side == 'left' else 'eta g'}" in files["test.py"]
    k, rng, E = space["constants"]([]), np.random.default_rng(6), np.array(space["BASIS"], float)
    turn = np.array([[0.6, -0.8, 0.7], [0.8, 0.6, -1.3], [0, 0, 1]])
    zeta, eta, change = rng.normal(size=(3, 3))

    def state(g, zeta):
        return np.array([*g[:2, :2].reshape(-1), *g[:2, 2], *zeta])

    _, D = space["jacobian"](0.0, state(turn, zeta), k)
    rates = D @ np.array([*eta, *change])
    h = 1e-5
    moved = [turn + s * h * displaced(side, turn, np.tensordot(eta, E, 1)) for s in (1, -1)]
    # beyond the group by h², which central differences do not see
    ends = [
        space["rhs"](0.0, state(g, zeta + s * h * change), k)
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
