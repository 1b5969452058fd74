"""The derivatives of emitted steps: against difference quotients of the steps themselves, the
linearised equations along a motion, one form of the state against another, and each language
against C."""

import tomllib

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import derive
from derive.problem.toml import problem_of
from tests.compare import codes
from tests.oracles.sampling import cross_matrix
from tests.problems.moving import FALLING
from tests.support.library import ONE_BUILD, STEPPED, library, module_of
from tests.support.states import element_names, hat, state

STEPS = ("gauss", "rk4", "vern9")
VARIED = {"step": STEPS, "jacobian": ("state", "inputs", "step")}
NAMES = ("so3", "se3", "sl3", "saff3", "two_tops", "jelly", "heisenberg", "so4", "kirchhoff")
H = {"gauss": 0.1, "rk4": 0.02, "vern9": 0.05}

PUSHED = """
name = "pushed"
group = "SE(3)"
[parameters]
c = 0.4
[body]
given = { m = 2, c = [0.1, 0, -0.2], J = [["7/4", 0.1, 0], [0.1, 1, 0], [0, 0, "5/4"]] }
[[potential]]
kind = "gravity"
g = [0, 1, -9.81]
[[damping]]
kind = "quadratic"
at = [1, 0, 1]
coefficient = "c"
[[input]]
name = "B"
kind = "force"
at = [1, 0.5, 0]
frame = "body"
[[input]]
name = "S"
kind = "force"
at = [0, 0, 1]
"""
"""A body in space with forces of both frames, and a drag that is no polynomial."""


LIGHTER = f"""{codes.SPRUNG}
[[output]]
name = "place"
kind = "place"
at = [0, 0, 2]
[[output]]
name = "shaken"
kind = "acceleration"
at = [0, 0, 2]
"""
RIGHT = """
name = "righthanded"
group = "SO(3)"
[lagrangian]
L = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - A_33"
trivialisation = "right"
"""


DAMPED_TOP = """
name = "damped_top"
[algebra]
brackets = [[1, 2, 3, 1], [2, 3, 1, 1], [3, 1, 2, 1]]
[parameters]
I = 1.5
k = 0.7
[[advected]]
name = "gamma"
representation = "coadjoint"
[lagrangian]
L = "(I*zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - gamma_3"
[[force]]
covector = ["-k*zeta_1", "-k*zeta_2*gamma_1^2", "u_2*zeta_1"]
[[input]]
name = "u"
kind = "covector"
[[output]]
name = "y"
y = ["zeta_1*gamma_2", "u_1 + gamma_3^2"]
"""


TILTED = """
name = "tilted"
group = "SO(3)"
[lagrangian]
L = "(zeta_1 - zeta_3)^2/2 + zeta_2^2 - 2*(A_31 + A_33)"
[[input]]
name = "F"
kind = "force"
at = [1, 0, 1]
"""
"""Its bob is at (1, 0, 1): what is held is no axis, and the velocity turns along it."""
FROM_SPACE = """
name = "from_space"
group = "SO(3)"
[lagrangian]
L = "zeta_1^2 + zeta_2^2 - 2*A_33 + A_32"
trivialisation = "right"
"""
"""ζ₃ turns space about its third axis, of which ℓ has what is seen from the body alone."""
QUOTIENTS = {
    "spherical_pendulum": ("spherical_pendulum", lambda g: g[:, 2]),
    "tilted": (TILTED, lambda g: g @ [1, 0, 1]),
    "rod": ("rod", lambda g: np.concatenate([g @ [0, 0, 1, 1], g @ [0, 0, -1, 1]])),
    "right": (FROM_SPACE, lambda g: g[2]),
}
"""Problem, and what of g is one of the quotient: linear, so that of its rate that is the speed."""


TURNED = ([0.8, -0.6, 0.6, 0.8, 1.5], [1.5], [0.3, -0.2])
"""A state, parameters and inputs of a body in the plane."""
FULL = (
    [0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1, 0.1, -0.4, 0.3, 0.5, -0.3, 0.7, 0.2, 1.1, -0.6, 4.5],
    [1.5],
    [0.8],
)
"""The same of a body in space, with a mass in its state."""
AT_ALGEBRA = [0.4, -0.7, 1.1, 0.3, 0.5, -0.8], [1.5, 0.7], [0.2, -0.3, 0.5]
ON_QUOTIENT = [0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1, 0.5, -0.3], [], [0.8, -0.2, 0.4]
OWN = {"pushed": PUSHED, "a mass": LIGHTER, "no element": DAMPED_TOP, "on the right": RIGHT}
DERIVED = ("state", "inputs", "parameters", "outputs")
AT = {"a mass": FULL, "no element": AT_ALGEBRA}


def module(name, **options):
    """The Python of a problem with its steps and their derivatives."""
    inputs = module_of(name).INPUTS
    jacobian = tuple(x for x in VARIED["jacobian"] if x != "inputs" or inputs)
    return module_of(name, step=STEPS, jacobian=jacobian, **options)


def prepared(name, **options):
    """The Python of a problem, parameters, a state, inputs, and on which side it is."""
    text = (OWN | {x: problem for x, (problem, _) in QUOTIENTS.items()}).get(name, name)
    m = module(text, **options)
    if name in AT:
        x, p, u = map(np.array, AT[name])
    else:
        p, x, u, *_ = on_quotient(m) if name in QUOTIENTS else state(m)
    return m, p, x, u, "right" if text in (RIGHT, FROM_SPACE) else "left"


def on_quotient(m):
    """Parameters, a state of which some velocities are held, inputs."""
    rng = np.random.default_rng(3)
    g = expm(hat(m, rng.normal(size=len(m.BASIS))))
    start = {name: g[place] for name, place in element_names(m).items()}
    drawn = zip(m.STATE, rng.normal(size=len(m.STATE)), strict=True)
    x = np.array([start.get(name, y) for name, y in drawn])
    p = [m.DEFAULTS[x] for x in m.PARAMETERS]
    return p, x, rng.normal(size=len(m.INPUTS))


def free(m):
    """The coordinates that are not held, by their numbers in 𝔤, from 0."""
    moves = [x for x in m.STATE if x.startswith(("zeta_", "w_"))]
    return [int(x[-1]) - 1 + 3 * x.startswith("w") for x in moves]


def matrix(m, x):
    """The element of the group of a state."""
    g = np.eye(len(m.BASIS[0]))
    for name, place in element_names(m).items():
        g[place] = x[m.STATE.index(name)]
    return g


def apart(m):
    """What a state has of g, with its places in the matrix, where all else is, and which of 𝔤 are
    not held."""
    own = element_names(m) if any(x[0] == "A" for x in m.STATE) else {}
    rest = [k for k, name in enumerate(m.STATE) if name not in own]
    count = len(m.BASIS) if own else 0
    return own, rest, free(m) if len(rest) < count else [*range(count)]


def variations(m):
    """How many numbers a variation has: those of 𝔤 in the place of those of g."""
    _, rest, turning = apart(m)
    return len(turning) + len(rest)


def retracted(m, x, change, side="left"):
    """The state at g exp(eta), or exp(eta) g, with all else displaced."""
    (own, rest, turning), y = apart(m), np.array(x)
    if own:
        eta, g = np.zeros(len(m.BASIS)), matrix(m, x)
        eta[turning] = change[: len(turning)]
        turn = expm(hat(m, eta))
        g = turn @ g if side == "right" else g @ turn
        y[[m.STATE.index(name) for name in own]] = [g[place] for place in own.values()]
    y[rest] += change[len(turning) :]
    return y


def relative(m, x, y, side="left"):
    """The variation from x to a y that is near it, to first order."""
    (own, rest, _), eta = apart(m), []
    if own:
        g, h = matrix(m, x), matrix(m, y)
        moved = h @ np.linalg.inv(g) if side == "right" else np.linalg.solve(g, h)
        basis = m.BASIS.reshape(len(m.BASIS), -1).T
        eta = np.linalg.lstsq(basis, (moved - np.eye(len(g))).ravel(), rcond=None)[0]
    return np.concatenate([eta, (y - x)[rest]])


def derivative(f, count):
    """The derivative of f at 0 by differences, twice extrapolated: as exact as rounding lets it."""

    def quotient(e, h):
        return (f(h * e) - f(-h * e)) / (2 * h)

    steps = (4e-3, 2e-3, 1e-3)
    columns = []
    for e in np.eye(count):
        a, b, c = (quotient(e, h) for h in steps)
        columns.append((64 * c - 20 * b + a) / 45)
    return np.transpose(columns) if columns else np.zeros((len(f(np.zeros(count))), 0))


def moved(m, step, x, k, u, h, n):
    """The state after some steps."""
    motion = m.begin(0.3, x)
    assert getattr(m, step)(motion, k, u, h, n) == m.OK
    return motion.x


def close(found, expected, tolerance=1e-9):
    scale = max(1, np.abs(expected).max(initial=0))
    return np.abs(found - expected).max(initial=0) < tolerance * scale


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("name", [*NAMES, *OWN])
def test_the_derivative_is_that_of_the_step(name, step):
    """To 1e-9, against differences of two steps, which go where steps without derivatives go."""
    m, p, x, u, side = prepared(name)
    k, h, count = m.constants(p), H[step], variations(m)
    motion = m.begin(0.3, x)
    status, phi, gamma = getattr(m, f"{step}_jacobian")(motion, k, u, h, 2)
    end = moved(m, step, x, k, u, h, 2)
    assert status == m.OK
    assert np.array_equal(motion.x, end)

    def change(e, more):
        y = moved(m, step, retracted(m, x, e, side), k, u + more, h, 2)
        return relative(m, end, y, side)

    assert phi.shape == (count, count)
    assert gamma.shape == (count, len(m.INPUTS))
    assert close(phi, derivative(lambda e: change(e, 0), count))
    assert close(gamma, derivative(lambda e: change(np.zeros(count), e), len(m.INPUTS)))


@pytest.mark.parametrize("name", AT)
def test_the_derivatives_of_outputs_and_by_parameters(name):
    m, (x, p, u) = module_of(OWN[name], jacobian=DERIVED), map(np.array, AT[name])
    k, t = m.constants(p), 0.3
    by_state = derivative(lambda e: m.outputs(t, retracted(m, x, e), k, u), variations(m))
    assert close(m.jacobian_outputs(t, x, k, u), by_state)
    by_inputs = derivative(lambda e: m.outputs(t, x, k, u + e), len(u))
    assert close(m.jacobian_outputs_inputs(t, x, k, u), by_inputs)
    rest = apart(m)[1]
    by_parameters = derivative(lambda e: m.rhs(t, x, m.constants(p + e), u)[rest], len(p))
    assert close(m.jacobian_parameters(t, x, p, u)[-len(rest) :], by_parameters)


def linearised(m, x, k, u, t):
    """Φ and Γ by the linearised equations along the motion, as others integrate them."""
    n, inputs = len(x), len(m.INPUTS)
    d = len(m.jacobian(0.3, x, k, u)[1])

    def rates(t, y):
        dx, A = m.jacobian(0.3 + t, y[:n], k, u)
        B = m.jacobian_inputs(0.3 + t, y[:n], k, u) if inputs else np.zeros((d, 0))
        S = y[n:].reshape(d, d + inputs)
        return np.concatenate([dx, (A @ S + np.hstack([np.zeros((d, d)), B])).ravel()])

    start = np.concatenate([x, np.eye(d, d + inputs).ravel()])
    end = solve_ivp(rates, (0, t), start, "DOP853", rtol=1e-12, atol=1e-12).y[n:, -1]
    return np.hsplit(end.reshape(d, d + inputs), [d])


@pytest.mark.parametrize("name", [*OWN, *QUOTIENTS])
def test_a_step_that_is_exact_has_the_derivative_of_the_motion(name):
    """Of the linearised equations, in the same coordinates; of rk4 it is off as its error is."""
    m, p, x, u, _ = prepared(name)
    k = m.constants(p)
    known = linearised(m, x, k, u, 0.2)
    for step, n, error in (("gauss", 2, 1e-9), ("vern9", 8, 1e-9), ("rk4", 4, 1e-2)):
        _, *found = getattr(m, f"{step}_jacobian")(m.begin(0.3, x), k, u, 0.2 / n, n)
        for a, b in zip(found, known, strict=True):
            assert close(a, b, error), step
    assert not close(found[0], known[0], 1e-9)


def in_form(plain, other, options, x):
    """A state of matrices and velocities in a body as another form has it."""
    if "attitude" in options:
        return other.from_matrix(x)
    g, d = matrix(plain, x), len(plain.BASIS)
    speed, places = g @ hat(plain, x[-d:]), element_names(plain)
    values = dict(zip(plain.STATE, x, strict=True))
    values |= {f"{name}_dot": speed[place] for name, place in places.items()}
    return np.array([values[name] for name in other.STATE])


FORMS = {
    "columns": {"layout": "col"},
    "tangent": {"velocity": "tangent"},
    "quaternion": {"attitude": "quaternion"},
    "moving": {"state": "moving"},
}
CASES = [(form, "se3") for form in FORMS] + [("tangent", "sl3"), ("moving", "heisenberg")]


@pytest.mark.parametrize(("form", "name"), CASES)
def test_forms_of_the_state_have_one_derivative(form, name):
    """By steps of gauss, which differ by rounding."""
    plain, other = module(name), module(name, **FORMS[form])
    p, x, u, *_ = state(plain)
    if form == "quaternion":  # a rotation to the last bit, as that is what is turned into one
        x = plain.project(x)
    known = plain.gauss_jacobian(plain.begin(0.3, x), plain.constants(p), u, 0.05, 2)
    motion = other.begin(0.3, in_form(plain, other, FORMS[form], x))
    found = other.gauss_jacobian(motion, other.constants(p), u, 0.05, 2)
    assert found[0] == known[0] == 0
    for a, b in zip(found[1:], known[1:], strict=True):
        assert close(a, b, 1e-10)


def test_inputs_that_are_a_function_of_time():
    """Γ is by what is added to them."""
    m = module(PUSHED)
    p, x, u, *_ = state(m)
    k = m.constants(p)

    def pushing(e):
        return lambda t, x: u * np.cos(3 * t) + e

    for step in STEPS:
        motion = m.begin(0.3, x)
        _, _, gamma = getattr(m, f"{step}_jacobian")(motion, k, pushing(0), 0.05, 2)
        known = derivative(
            lambda e, step=step, end=motion.x: relative(
                m, end, moved(m, step, x, k, pushing(e), 0.05, 2)
            ),
            len(m.INPUTS),
        )
        assert close(gamma, known), step


@pytest.mark.parametrize("attitude", ["matrix", "quaternion"])
def test_a_mass_of_the_state_is_moved_and_told(attitude):
    """By ``retract`` and ``local``, and by the step that is compiled."""
    options = {"exponential": True, "step": "rk4", "jacobian": "step", "attitude": attitude}
    f = derive.compile(problem_of(tomllib.loads(codes.LANDER)), **options)
    x, p, u = map(np.array, FULL)
    start, e = f.from_matrix(x) if attitude == "quaternion" else x, np.linspace(-0.3, 0.4, 13)
    y = f.retract(start, e)
    moved = f.to_matrix(y) if attitude == "quaternion" else y
    A = x[:9].reshape(3, 3)
    assert close(moved[:9].reshape(3, 3), A @ expm(cross_matrix(e[:3])), 1e-14)
    assert close(moved[12:], x[12:] + e[6:], 1e-14)
    assert close(f.local(start, y), e, 1e-14)
    f.use(p)
    end, phi, gamma = f.step_jacobian(0.0, start, 1e-3, u, n=3)
    assert (phi.shape, gamma.shape) == ((13, 13), (13, 1))
    ahead = [
        f.local(end, f.step_jacobian(0.0, f.retract(start, s * e), 1e-3, u, n=3)[0])
        for s in (1e-6, -1e-6)
    ]
    assert close(phi @ e, (ahead[0] - ahead[1]) / 2e-6, 1e-8)


def held_apart(m, x, side):
    """g and dg/dt of a state."""
    g, Z = matrix(m, x), hat(m, full(m, x))
    return g, Z @ g if side == "right" else g @ Z


def full(m, x):
    """The coordinates of Z, those that are held 0."""
    found = np.zeros(len(m.BASIS))
    for name, value in zip(m.STATE, x, strict=True):
        if name.startswith(("zeta_", "w_")):
            found[int(name[-1]) - 1 + 3 * name.startswith("w")] = value
    return found


@pytest.mark.parametrize(
    ("name", "attitude"),
    [*((x, "matrix") for x in QUOTIENTS), ("tilted", "quaternion"), ("rod", "quaternion")],
)
def test_on_a_quotient_it_is_of_what_is_seen(name, attitude):
    """Where the body is, and how it moves, after two steps, by differences; on both sides as what V
    does to it."""
    problem, told = QUOTIENTS[name]
    plain, p, x, u, side = prepared(name)
    m, count = module(problem, attitude=attitude), variations(plain)
    if attitude == "quaternion":
        x, inside, outside = plain.project(x), m.from_matrix, m.to_matrix
    else:
        inside = outside = np.array
    k = m.constants(p)

    def seen(x):
        return np.concatenate([told(y) for y in held_apart(plain, x, side)])

    for step in STEPS:
        motion = m.begin(0.0, inside(x))
        status, phi, gamma = getattr(m, f"{step}_jacobian")(motion, k, u, H[step], 2)
        assert (status, phi.shape, gamma.shape) == (0, (count, count), (count, len(u)))
        end = outside(motion.x)

        def after(V, u=u, step=step):
            y = inside(retracted(plain, x, V, side))
            return seen(outside(moved(m, step, y, k, u, H[step], 2)))

        there = derivative(lambda V, y=end: seen(retracted(plain, y, V, side)), count)
        assert close(there @ phi, derivative(after, count)), step
        by_inputs = derivative(lambda e, f=after: f(np.zeros(count), u + e), len(u))
        assert close(there @ gamma, by_inputs), step


# ---------------------------------------------------------------- in each language

OTHERS = [ONE_BUILD[x] for x in STEPPED if x != "c"] + ["julia"]
COMMANDS = [("gauss_jacobian", 0.1, 2), ("rk4_jacobian", 0.05, 2), ("vern9_jacobian", 0.05, 1)]


SWING = """
name = "swing"
group = "SO(2)"
[parameters]
m = 1.5
[[point]]
mass = "m"
at = [1, 0.5]
[[potential]]
kind = "gravity"
g = [0, -9.81]
[[input]]
name = "F"
kind = "force"
at = [0, 1]
"""
IN_LANGUAGES = {
    "": (SWING, TURNED, 2 * (2 + 2)),
    "with a mass": (codes.LANDER, FULL, 13 * (13 + 1)),
    "without an element": (DAMPED_TOP, AT_ALGEBRA, 6 * (6 + 3)),
    "on a quotient": (TILTED, ON_QUOTIENT, 4 * (4 + 3)),
}
"""Problem, where it is asked, how many numbers Φ and Γ are."""


@pytest.mark.parametrize(
    ("build", "text", "at", "size"),
    [(x, *case) for case in IN_LANGUAGES.values() for x in OTHERS],
    ids=[f"{x} {kind}".strip() for kind in IN_LANGUAGES for x in OTHERS],
)
def test_each_language_has_the_derivatives_of_c(build, text, at, size):
    options = {"step": STEPS, "jacobian": ("step",)}
    found, known = (library(b, text, **options).follow(COMMANDS, *at) for b in (build, "c"))
    for a, b in zip(found, known, strict=True):
        assert (a.status, b.status, len(b.slopes)) == (0, 0, size)
        assert close(a.x, b.x, 1e-14)
        assert close(a.slopes, b.slopes, 1e-13)


@pytest.mark.parametrize("build", ["c", "javascript", "rust2021"])
def test_rk4_in_floats(build):
    x, *more = TURNED
    options = {"step": "rk4", "jacobian": "step"}
    (a,) = library(build, SWING, real="float", **options).follow(COMMANDS[1:2], x, *more)
    (b,) = library("c", SWING, **options).follow(COMMANDS[1:2], x, *more)
    assert close(a.slopes[: len(b.slopes)], b.slopes, 2e-6)


def test_a_coarse_step_by_newtons_method():
    """Of a spring of 1000 rad/s, 50 rad in a step, whose far end goes to and fro: the derivative is
    that of the step."""
    text = FALLING.replace('"-1/sqrt(r1_x^2)"', '"500000*(r1_x - sin(t)/2)^2 + r1_x^4"')
    m = module_of(text, step=("gauss",), jacobian=("raw", "step"))
    k, x = m.constants([]), np.array([1, 0, 0, 1, 0.1, 0, 0.5])
    status, phi, _ = m.gauss_jacobian(motion := m.begin(0.3, x), k, None, 0.05, 1)
    assert (status, motion.h) == (0, 0.05)
    scale = np.array([1e3, 1])  # of the place, which the spring holds
    known = derivative(
        lambda e: relative(
            m, motion.x, moved(m, "gauss", retracted(m, x, e / scale), k, None, 0.05, 1)
        ),
        2,
    )
    assert close(phi, known * scale)


def test_what_has_no_step_is_told():
    """Where the next state is not finite, too coarse for the iteration, or 0 steps are wanted."""
    m = module_of("so3", step=STEPS, jacobian="step")
    k = m.constants([0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81])
    x = np.array([1, 0, 0, 0, 0.8, -0.6, 0, 0.6, 0.8, 1, -0.5, 30])
    for step in STEPS:
        status, phi, gamma = getattr(m, f"{step}_jacobian")(m.begin(0.0, x), k, None, 0.1, 0)
        assert status == m.OK
        assert close(phi, np.eye(6), 1e-15)
        assert not gamma.any()
    coarse = m.gauss_jacobian(motion := m.begin(0.0, x), k, None, 5.0)
    assert coarse[0] == m.NOT_CONVERGED
    assert np.array_equal(motion.x, x)
    assert m.rk4_jacobian(m.begin(0.0, x), k, None, np.inf)[0] == m.NOT_FINITE


def test_in_python_by_the_compiled_c():
    f = derive.compile("so3", step=["rk4", "gauss"], jacobian="step")
    m = module_of("so3", step=STEPS, jacobian="step")
    x, u = np.array([1, 0, 0, 0, 0.8, -0.6, 0, 0.6, 0.8, 1, -0.5, 3]), np.array([0.3, -0.2, 0.5])
    f.use(p := [0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81])
    for step in f.STEPS:
        y, *found = f.step_jacobian(0, x, 0.05, u, n=2, step=step)
        motion = m.begin(0.0, x)
        _, *known = getattr(m, f"{step}_jacobian")(motion, m.constants(p), u, 0.05, 2)
        for a, b in zip([y, *found], [motion.x, *known], strict=True):
            assert close(a, b, 1e-12)
    for wrong in ({"step": "vern9"}, {"n": 0}):
        with pytest.raises(ValueError, match=r"not compiled|number of steps"):
            f.step_jacobian(0, x, 0.05, **wrong)
