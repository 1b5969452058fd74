"""The emitted numbers against the record's own trees, evaluated in floats at the same points.

The trees are evaluated as they stand (an inverse by elimination, a product left to right), not as
they were lowered; the kernel before it was solved is compared as well.
"""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from derive.check.evaluate import Environment, evaluate
from tests.support.walks import SPECIAL, problem, record

ROOT = Path(__file__).parents[2]


def module(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "generated" / name / f"{name}.py")
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


class Names(dict):
    """Given values, and for other names what the record defines."""

    def __init__(self, d, given):
        super().__init__(given)
        self.record, self.env = d, None

    def __contains__(self, name):
        return super().__contains__(name) or self.record.definition(name) is not None

    def __missing__(self, name):
        _, equation = self.record.definition(name)
        self[name] = evaluate(equation.rhs, self.env)
        return self[name]


def rows(a):
    return tuple(tuple(float(x) for x in row) for row in np.atleast_2d(a))


def column(v):
    return tuple((float(x),) for x in v)


def environment(name, p, x, u):
    d, g = record(name), problem(name).group
    n, size = g.n, g.dimension - (g.n if g.affine else 0)
    given = {"A": rows(x[: n * n].reshape(n, n)), "t": 0.0}
    if g.affine:
        given["T"] = column(x[n * n : n * n + n])
        given["w"] = column(x[-n:])
        given["f_u"] = column(u[size:])
    start = n * n + (n if g.affine else 0)
    given["ζ"] = column(x[start : start + size])
    given["u"] = column(u[:size])
    names = Names(d, given)
    listed = [*d.problem["body"].get("points", []), *d.problem.get("places", [])]
    numbers = p | dict(zip(module(name).INPUTS, u, strict=False))
    env = Environment(n, names, parameters=numbers, listed=len(listed))
    names.env = env
    for step in d.steps:
        for e in step.equations:
            if isinstance(e.lhs, tuple) and e.lhs[0] == "at" and isinstance(e.lhs[2], int):
                env.families.setdefault(e.lhs[1], {})[(e.lhs[2],)] = evaluate(e.rhs, env)
    return env


def sample(name, seed):
    """Parameters of a random body, a random state near the group, a random input."""
    rng = np.random.default_rng(seed)
    code, g = module(name), problem(name).group
    points, masses = rng.normal(size=(5, 3)), rng.uniform(0.5, 2, size=5)
    J, c = (points.T * masses) @ points, masses @ points
    p = {"m": masses.sum()}
    p |= {f"c_{i + 1}": c[i] for i in range(3)}
    p |= {f"J_{i + 1}{j + 1}": J[i, j] for i in range(3) for j in range(i, 3)}
    p = {x: p.get(x, rng.uniform(0.5, 2)) for x in code.PARAMETERS} | {"m": p["m"]}
    A = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    A *= np.linalg.det(A)
    if name == "sl3":
        A = np.eye(3) + rng.normal(size=(3, 3)) / 5
        A /= np.cbrt(np.linalg.det(A))
    rest = rng.normal(size=len(code.STATE) - g.n**2)
    return code, p, np.concatenate([A.ravel(), rest]), rng.normal(size=max(len(code.INPUTS), 6))


def close(a, b):
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    assert np.abs(a - b).max() <= 1e-12 * max(1.0, np.abs(b).max())


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("name", SPECIAL)
def test_code_computes_the_recorded_motion(name, seed):
    code, p, x, u = sample(name, seed)
    inputs = u[: len(code.INPUTS)]
    k = code.constants(np.array([p[n] for n in code.PARAMETERS]))
    dx = code.rhs(0.0, x, k, inputs)
    env = environment(name, p, x, u)
    d = record(name)
    close(dx[:9].reshape(3, 3), env.names["Ȧ"])
    if name == "sl3":
        zeta_dot = [evaluate(d.definition(("entry", "ζ̇", a))[1].rhs, env) for a in range(1, 9)]
        close(dx[9:], zeta_dot)
    elif name == "so3":
        close(dx[9:], np.ravel(env.names["ζ̇"]))
    else:
        close(dx[9:12], np.ravel(env.names["Ṫ"]))
        close(dx[12:15], np.ravel(env.names["ζ̇"]))
        close(dx[15:], np.ravel(env.names["ẇ"]))
    close(code.energy(0.0, x, k), env.names["h̃"])


KERNELS = {"so3": "so3.kernel", "se3": "se3.kernel", "sl3": "sl3.multiplier"}


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("name", SPECIAL)
def test_code_satisfies_the_recorded_kernel(name, seed):
    """The equations before they were solved hold for the emitted rates (without input)."""
    code, p, x, u = sample(name, seed)
    k = code.constants(np.array([p[n] for n in code.PARAMETERS]))
    dx = code.rhs(0.0, x, k)
    env = environment(name, p, x, 0 * u)
    if name == "sl3":
        Z_dot = np.append(dx[9:], 0.0)
        Z_dot[8] = -Z_dot[0] - Z_dot[4]
        env.names["Ż"] = rows(Z_dot.reshape(3, 3))
    else:
        env.names["ζ̇"] = column(dx[12:15] if name == "se3" else dx[9:12])
        if name == "se3":
            env.names["ẇ"] = column(dx[15:])
        else:
            torque = record(name)["so3.torque"].equations[0]
            assert torque.lhs == ("mul", "I", "φ")
            force = np.linalg.solve(env.names["I"], evaluate(torque.rhs, env))
            env.names["φ"] = column(force.ravel())
    for equation in record(name)[KERNELS[name]].equations:
        close(evaluate(equation.lhs, env), evaluate(equation.rhs, env))
