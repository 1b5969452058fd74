"""Ellipsoids of fluid, plain and in layers: Euler's equation at points, the pressure, published
motions, circulation; moments by quadrature.

u(x) = L x with L = Ȧ A⁻¹ has the acceleration (L̇ + L²)x; nothing of the walk is used. A density in
layers is a Python function of s = <r, Q r>; its integrals here are Gauss's sums.
"""

import json
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive import Harmonic, Problem, Solid, Spring
from derive.check.checker import Checker
from derive.language.values import approximate
from derive.record.as_json import from_json, to_json
from tests.oracles import ellipsoids
from tests.support.corpus import FULL, LAYERS, RHO, SLOPE, WELL, ellipsoid
from tests.support.library import arrange, derived, module_of
from tests.support.walks import SEED

CENTRED = Solid("ellipsoid", "rho", quadric=FULL.tolist())


def emitted(problem):
    """The emitted module with its multiplier, and its constants."""
    m = module_of(problem, multiplier=True)
    return m, m.constants(arrange(m, {"rho": RHO}))


def coordinates(m, Z):
    """Those of a matrix of trace 0 in the basis of the module."""
    basis = np.array([[[float(x) for x in row] for row in e] for e in m.BASIS])
    return np.linalg.lstsq(basis.reshape(len(basis), -1).T, np.ravel(Z), rcond=None)[0], basis


def state(m, A, Z):
    return np.concatenate([np.ravel(A), coordinates(m, Z)[0]])


def flight(m, k, A, Z, times):
    found = solve_ivp(
        m.rhs, (0, times[-1]), state(m, A, Z), "DOP853", times, args=(k,), rtol=1e-13, atol=1e-14
    )
    return found.y.T


def unpacked(m, n, x, dx):
    """A, Z and the acceleration A(Z' + Z^2)."""
    basis = coordinates(m, np.zeros((n, n)))[1]
    A, Z = x[: n * n].reshape(n, n), np.tensordot(x[n * n :], basis, 1)
    return A, Z, A @ (np.tensordot(dx[n * n :], basis, 1) + Z @ Z)


def volume(Q):
    """That of <r, Q r> <= 1."""
    n = len(Q)
    return math.pi ** (n / 2) / math.gamma(n / 2 + 1) / math.sqrt(np.linalg.det(Q))


def about_z(angle):
    s, q = math.sin(angle), math.cos(angle)
    return np.array([[q, -s, 0], [s, q, 0], [0, 0, 1]])


def start(n, rng):
    A, Z = np.eye(n) + 0.3 * rng.normal(size=(n, n)), rng.normal(size=(n, n))
    return A / abs(np.linalg.det(A)) ** (1 / n), Z - np.trace(Z) / n * np.eye(n)


def test_dirichlets_spheroid():
    """A = diag(a, a, 1/a²) of a ball: (1 + 2/a⁶) a'² is constant, a quadrature."""
    m, k = emitted(ellipsoid(3, np.eye(3)))
    times, rate = np.linspace(0, 2, 9), 0.7
    x = flight(m, k, np.eye(3), np.diag([rate, rate, -2 * rate]), times)
    a = solve_ivp(
        lambda t, a: rate * np.sqrt(3 / (1 + 2 / a**6)), (0, 2), [1.0], "DOP853", times,
        rtol=1e-13, atol=1e-14,
    ).y[0]  # fmt: skip
    assert x[:, [0, 4, 8]] == pytest.approx(np.array([a, a, a**-2]).T, abs=1e-9)
    assert np.max(np.abs(x[:, [1, 2, 3, 5, 6, 7]])) < 1e-12
    moved = rate**2 * 3 / (1 + 2 / a**6)  # a'²; θ = j Tr Z²/Tr C⁻¹, Tr Z² = 6 (a'/a)²
    wanted = RHO * volume(np.eye(3)) / 5 * 6 * moved / a**2 / (2 / a**2 + a**4)
    theta = np.array([m.multiplier(0.0, y, k) for y in x])
    assert theta == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("c", [0.8, 1.0, 1.3])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_steady_ellipsoids(c, share):
    """Riemann's ellipsoids of type S in a harmonic well: A = R(Ωt) diag(a, b, c) R(φt) with
    Ω² + φ² = w², −2Ωφ = w₃² c³ and the pressure −2Ωφ ab j; Dedekind's of another share."""
    a = 1.2 + 0.1 * share
    b, w3 = 1 / (a * c), 0.9
    turning = 0.6 + share
    inner = -(w3**2) * c**3 / (2 * turning)
    w2 = turning**2 + inner**2
    W = np.diag([w2, w2, w3**2])
    m, k = emitted(ellipsoid(3, np.eye(3), W))

    spin = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])
    D = np.diag([a, b, c])
    Z = np.linalg.inv(D) @ (turning * spin @ D + inner * D @ spin)
    times = np.linspace(0, 3, 7)
    j = RHO * volume(np.eye(3)) / 5
    for t, x in zip(times, flight(m, k, D, Z, times), strict=True):
        wanted = about_z(turning * t) @ D @ about_z(inner * t)
        assert x[:9].reshape(3, 3) == pytest.approx(wanted, abs=1e-9)
        assert m.multiplier(t, x, k) == pytest.approx(-2 * turning * inner * a * b * j, rel=1e-9)


def test_in_a_plane():
    """Ellipses in a well, Kirchhoff's among them: Ω² + φ² = w², θ = −2Ωφ j for any axes; and with
    φ = 0 each point swings by itself, without pressure."""
    m, k = emitted(ellipsoid(2, np.eye(2), 1.25 * np.eye(2)))
    spin, D = np.array([[0.0, -1], [1, 0]]), np.diag([1.6, 1 / 1.6])
    j = RHO * volume(np.eye(2)) / 4
    for turning, inner in ((1.0, -0.5), (0.5, 1.0), (math.sqrt(1.25), 0.0)):
        Z = np.linalg.inv(D) @ (turning * spin @ D + inner * D @ spin)
        for t, x in zip((0, 1, 2), flight(m, k, D, Z, [0, 1, 2]), strict=True):
            left, right = (about_z(y)[:2, :2] for y in (turning * t, inner * t))
            assert x[:4].reshape(2, 2) == pytest.approx(left @ D @ right, abs=1e-9)
            assert m.multiplier(t, x, k) == pytest.approx(-2 * turning * inner * j, abs=1e-9)


SHIFTED = Solid("ellipsoid", "rho", semi_axes=[1, 2, 3], shift=[0, 0, 1])
WEIGHT, STAR = derive.Gravity(0, 0, -5), derive.SelfGravity(1)
CIRCULATIONS = {  # a body, what acts on it, and is the circulation kept?
    "alone": (CENTRED, [], True),
    "in a well, which acts on every point": (CENTRED, [Harmonic(WELL.tolist())], True),
    "a star": (CENTRED, [STAR], True),
    "a centred body under weight, as c = 0": (CENTRED, [WEIGHT], True),
    "a star under weight": (CENTRED, [STAR, WEIGHT], True),
    "hung: a body off its centre": (SHIFTED, [WEIGHT], False),
    "a spring at one place": (CENTRED, [Spring([0.3, 0, 0], [1, 0, 0], 5)], False),
}


@pytest.mark.parametrize("case", CIRCULATIONS)
def test_circulation_is_kept_where_the_record_says_so(case):
    """Āα − ᾱA along a flight."""
    body, forces, kept = CIRCULATIONS[case]
    problem = Problem("fluid", "SL(3)", body, forces, parameters={"rho": RHO})
    record = derived(problem).record
    step = record["fluid.circulation"]
    assert (step.rule == "conservation") == (step.equations[-1].rhs == 0) == kept
    assert Checker(record.problem, SEED).check(step).holds
    m, k = emitted(problem)
    A, Z = start(3, np.random.default_rng(8))
    A[0] *= np.sign(np.linalg.det(A))
    found = []
    for x in flight(m, k, A, Z, [0, 0.1, 0.2]):
        A, Z, _ = unpacked(m, 3, x, m.rhs(0.0, x, k))
        found.append(A.T @ A @ Z - Z.T @ A.T @ A)
    moved = np.max(np.abs(np.array(found) - found[0]))
    assert moved < 1e-9 if kept else moved > 0.02


def labels(problem):
    record = derived(problem).record
    return [
        step.label.split(".")[1] for step in record.steps if step.label.startswith(problem.name)
    ]


def test_what_is_claimed():
    """Pressure at every point of centred ellipsoids with linear forces; else the total alone."""
    told = {"quadric", "pressure", "total", "virial", "circulation", "no_rotation"}
    free, plane = labels(ellipsoid(3, FULL)), labels(ellipsoid(2, FULL[:2, :2]))
    assert told & {*free} == told - {"virial"}
    assert told & {*plane} == told - {"virial", "no_rotation"}
    assert told & {*labels(ellipsoid(3, FULL, WELL))} == told - {"virial", "no_rotation"}
    for body in (
        Solid("box", 1, sides=[1, 2, 3]),
        Solid("ellipsoid", 1, semi_axes=[1, 2, 3], shift=[1, 0, 0]),
        Solid("ball", 1, radius=1) + Solid("ball", 1, radius=2),
    ):
        assert told & {*labels(Problem("b", "SL(3)", body))} == {
            "virial",
            "circulation",
            "no_rotation",
        }
    held = Problem("b", "SL(3)", Solid("ball", 1, radius=1), [derive.Gravity(0, 0, -1)])
    assert told & {*labels(held)} == {"virial", "circulation"}
    assert not told & {*labels(Problem("b", "GL(3)", Solid("ball", 1, radius=1)))}
    assert not told & {*labels(derive.derive("sl3").problem)}


def test_a_star_at_rest():
    """In a ball, where p(r) = (2π/3) ρ² (1 − r²), of which ∫ is m²/(5 · 1)."""
    star = Problem("star", "SL(3)", CENTRED, [STAR], parameters={"rho": RHO})
    assert {"pressure", "total"} <= {*labels(star)}
    body = Solid("ball", "rho", radius=1)
    m, k = emitted(Problem("ball", "SL(3)", body, [STAR], parameters={"rho": RHO}))
    theta = m.multiplier(0.0, state(m, np.eye(3), np.zeros((3, 3))), k)
    mass = RHO * volume(np.eye(3))
    assert theta == pytest.approx(mass**2 / 5, rel=1e-12)


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


def test_levels_are_of_ellipsoids():
    assert numbers(layered("s", {"s": 2.0}, "box", sides=[1, 2, 3]))[0] == 12
