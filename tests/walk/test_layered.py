"""Ellipsoids in layers, and turned ones: moments by quadrature, Euler's equation at points.

The density is a Python function of s = <r, Q r>; its integrals here are Gauss's sums.
"""

import json
import math

import numpy as np
import pytest

import derive
from derive import Harmonic, Problem, Solid
from derive.check.checker import Checker
from derive.language.values import approximate
from derive.record.as_json import from_json, to_json
from derive.record.record import RecordError
from tests.oracles import ellipsoids
from tests.support.corpus import FULL, LAYERS, RHO, SLOPE, WELL
from tests.support.library import arrange, module_of
from tests.support.walks import SEED
from tests.walk.test_dirichlet import flight, start, unpacked, volume

NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)
NODES, WEIGHTS = (NODES + 1) / 2, WEIGHTS / 2
TURN = {"axis": [1, 2, 3], "angle": "phi"}


def density(s):
    return RHO * (1 - SLOPE * s) ** 2 / 2 + s**3


VALUES = {"rho": RHO, "q": SLOPE}


def rotation(axis, angle):
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    j = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * j + (1 - math.cos(angle)) * j @ j


def above(s):
    """The integral of the density from s to 1."""
    return (1 - s) * np.sum(WEIGHTS * density(s + (1 - s) * NODES))


def over(f, n, Q):
    """The integral of f(<x, Q x>) over the ellipsoid, by shells."""
    return volume(Q) * n * np.sum(WEIGHTS * NODES ** (n - 1) * [f(t * t) for t in NODES])


def body(n, Q):
    return Solid("ellipsoid", LAYERS, quadric=np.asarray(Q).tolist())


def numbers(problem):
    """m, c, J at the defaults."""
    given, names = problem.body.given, {x: p.default for x, p in problem.parameters.items()}
    c, *J = ([approximate(x, names) for x in row] for row in (given.c, *given.J))
    return approximate(given.m, names), np.array(c), np.array(J)


@pytest.mark.parametrize("n", [2, 3, 4])
def test_moments_by_shells(n):
    Q = np.eye(n) + 0.2 * np.ones((n, n))
    m, c, J = numbers(Problem("b", f"SL({n})", body(n, Q), parameters=VALUES))
    assert m == pytest.approx(over(density, n, Q), rel=1e-13)
    wanted = over(lambda s: s * density(s), n, Q) / n * np.linalg.inv(Q)
    assert np.max(np.abs(c)) == 0
    assert pytest.approx(wanted, rel=1e-12) == J


def test_moments_of_a_turned_and_shifted_one_in_a_mixture():
    """Beside sums over points in it, on shells and directions."""
    axes, shift = np.array([1.3, 1.0, 0.7]), np.array([0.2, -0.1, 0.4])
    solid = Solid("ellipsoid", LAYERS, semi_axes=axes.tolist(), rotation=TURN, shift=shift.tolist())
    whole = solid + Solid("ball", "2*(1 - s)", radius=0.5)
    values = VALUES | {"phi": 0.6}
    m, c, J = numbers(Problem("b", "SAff(3)", whole, parameters=values))
    z, w = np.polynomial.legendre.leggauss(6)
    around = np.arange(12) * np.pi / 6
    n = np.array([[math.sqrt(1 - x * x) * math.cos(p), math.sqrt(1 - x * x) * math.sin(p), x]
                  for x in z for p in around])  # fmt: skip
    total = np.zeros((4, 4))
    for turned, size, at, f in (
        (rotation([1, 2, 3], 0.6), axes, shift, density),
        (np.eye(3), np.full(3, 0.5), np.zeros(3), lambda s: 2 * (1 - s)),
    ):
        for t, wt in zip(NODES, WEIGHTS, strict=True):
            r = np.hstack([(t * n * size) @ turned.T + at, np.ones((len(n), 1))])
            share = np.repeat(w, 12) / 24 * 4 * np.pi * t * t * wt * size.prod() * f(t * t)
            total += (r * share[:, None]).T @ r
    assert m == pytest.approx(total[3, 3], rel=1e-13)
    assert c == pytest.approx(total[:3, 3], abs=1e-13)
    assert pytest.approx(total[:3, :3], abs=1e-13) == J


def quadric(n):
    return np.eye(n) + 0.2 * np.ones((n, n)) if n == 4 else FULL[:n, :n]


AXES, G = np.array([1.3, 1.0, 0.7]), 1.2


def flowing(kind, n, forced):
    """The problem, Q in the body, the density as a number or a function of s, its parameters."""
    values, Q, solid, rho = {"rho": RHO}, quadric(n), None, RHO
    forces = [Harmonic((np.eye(n) if n == 4 else WELL[:n, :n]).tolist())] * forced
    if kind == "plain":
        solid = Solid("ellipsoid", "rho", quadric=Q.tolist())
    elif kind == "star":
        Q, forces = np.diag(AXES**-2), [derive.SelfGravity(G=G)]
        solid = Solid("ellipsoid", "rho", semi_axes=AXES.tolist())
    else:
        values, solid, rho = dict(VALUES), body(n, Q), density
    if kind == "turned":
        R = rotation(TURN["axis"], 0.6)
        Q, values["phi"] = R @ np.diag(AXES**-2) @ R.T, 0.6
        solid = Solid("ellipsoid", LAYERS, semi_axes=AXES.tolist(), rotation=TURN)
    return Problem("fluid", f"SL({n})", solid, forces, parameters=values), Q, rho, values


def pull(kind, n, forced, A):
    """The matrix of the force on a unit of mass: minus this at a place."""
    if kind == "star":
        squares, R = np.linalg.eigh(A @ np.diag(AXES**2) @ A.T)
        attracted = np.diag(ellipsoids.attractions(np.sqrt(squares)))
        return 2 * np.pi * G * RHO * R @ attracted @ R.T
    return forced * (np.eye(n) if n == 4 else WELL[:n, :n])


FLOWS = [("plain", n, forced) for n in (2, 3, 4) for forced in (False, True)]
FLOWS += [("layers", 2, True), ("layers", 3, False), ("layers", 4, True), ("turned", 3, True)]
FLOWS += [("star", 3, False)]


@pytest.mark.parametrize(("kind", "n", "forced"), FLOWS)
def test_eulers_equation_at_points(kind, n, forced):
    """rho(s)(acceleration - force) = -grad p at places of any layer, along a trajectory, for p =
    theta/(2 kappa) times the integral of rho from s to 1, and theta the integral of p."""
    problem, Q, rho, values = flowing(kind, n, forced)
    inside = above if callable(rho) else lambda s: rho * (1 - s)
    m, rng = module_of(problem, multiplier=True), np.random.default_rng(n)
    k, kappa = m.constants(arrange(m, values)), over(inside, n, Q) / 2
    A, Z = start(n, rng)
    A[0] *= np.sign(np.linalg.det(A))
    for x in flight(m, k, A, Z, [0, 0.2, 0.4]):
        A, Z, force = unpacked(m, n, x, m.rhs(0.0, x, k))
        theta, back = m.multiplier(0.0, x, k), np.linalg.inv(A)
        central = theta / (2 * kappa)
        assert central * over(inside, n, Q) == pytest.approx(theta, rel=1e-12)
        for _ in range(4):
            r = rng.normal(size=n)
            r *= rng.uniform(0.2, 0.9) / math.sqrt(r @ Q @ r)
            here = rho(r @ Q @ r) if callable(rho) else rho
            slope = -central * here * 2 * back.T @ Q @ r
            moved = here * (force @ r + pull(kind, n, forced, A) @ A @ r)
            assert np.max(np.abs(moved + slope)) < 1e-11 * (1 + np.max(np.abs(moved)))


def layered(density=LAYERS, parameters=VALUES, kind="ball", **sizes):
    return Problem("b", "SL(3)", Solid(kind, density, **(sizes or {"radius": 1})),
                   parameters=parameters)  # fmt: skip


def test_a_level_that_cancels():
    """rho(1 + s) - rho s has the moments of rho."""
    uniform = numbers(layered("rho", {"rho": RHO}))
    for found, wanted in zip(numbers(layered("rho*(1 + s) - rho*s", {"rho": RHO})), uniform):  # noqa: B905
        assert np.max(np.abs(found - wanted)) < 1e-14


def test_another_density_in_the_record_is_refused():
    """The moments and the density are held together."""
    record = derive.derive(layered("2 - s", {})).record
    changed = json.loads(to_json(record))
    density = changed["problem"]["body"]["solids"][0]["density"]
    assert "s_r" in json.dumps(density)
    changed["problem"]["body"]["solids"][0]["density"] = 2
    verdict = Checker(from_json(json.dumps(changed)).problem, SEED).check(record.steps[-1])
    assert "not those of its solids" in str(verdict)


@pytest.mark.parametrize(
    ("kind", "wrong"),
    [("box", "s_r"), ("ball", ["fun", "sin", "s_r"]), ("ball", ["div", 1, "s_r"])],
)
def test_strangers_densities(kind, wrong):
    sizes = {"box": {"sides": [1, 2, 3]}, "ball": {"radius": 1}}[kind]
    data = json.loads(to_json(derive.derive(layered(2, {}, kind, **sizes)).record))
    data["problem"]["body"]["solids"][0]["density"] = wrong
    with pytest.raises(RecordError, match="density: expected a polynomial in the level"):
        from_json(json.dumps(data))


def test_levels_are_of_ellipsoids():
    assert numbers(layered("s", {"s": 2.0}, "box", sides=[1, 2, 3]))[0] == 12
