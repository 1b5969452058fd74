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


def module(name, **options):
    """The Python of a problem with its steps and their derivatives."""
    inputs = module_of(name).INPUTS
    jacobian = tuple(x for x in VARIED["jacobian"] if x != "inputs" or inputs)
    return module_of(name, step=STEPS, jacobian=jacobian, **options)


def matrix(m, x):
    """The element of the group of a state."""
    g = np.eye(len(m.BASIS[0]))
    for name, place in element_names(m).items():
        g[place] = x[m.STATE.index(name)]
    return g


def retracted(m, x, change):
    """The state at g exp(eta) and zeta + delta zeta."""
    d, y = len(m.BASIS), np.array(x)
    g = matrix(m, x) @ expm(hat(m, change[:d]))
    for name, place in element_names(m).items():
        y[m.STATE.index(name)] = g[place]
    y[-d:] += change[d:]
    return y


def relative(m, x, y):
    """(eta, delta zeta) from x to a y that is near it, to first order."""
    d = len(m.BASIS)
    moved = np.linalg.solve(matrix(m, x), matrix(m, y))
    eta = np.linalg.lstsq(m.BASIS.reshape(d, -1).T, moved.ravel(), rcond=None)[0]
    return np.concatenate([eta, y[-d:] - x[-d:]])


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
@pytest.mark.parametrize("name", [*NAMES, PUSHED], ids=[*NAMES, "pushed"])
def test_the_derivative_is_that_of_the_step(name, step):
    """To 1e-9, against differences of two steps, which go where steps without derivatives go."""
    m = module(name)
    p, x, u, *_ = state(m)
    k, h, d = m.constants(p), H[step], len(m.BASIS)
    motion = m.begin(0.3, x)
    status, phi, gamma = getattr(m, f"{step}_jacobian")(motion, k, u, h, 2)
    end = moved(m, step, x, k, u, h, 2)
    assert status == m.OK
    assert np.array_equal(motion.x, end)
    by_state = derivative(
        lambda e: relative(m, end, moved(m, step, retracted(m, x, e), k, u, h, 2)), 2 * d
    )
    by_inputs = derivative(
        lambda e: relative(m, end, moved(m, step, x, k, u + e, h, 2)), len(m.INPUTS)
    )
    assert close(phi, by_state)
    assert close(gamma, by_inputs)
    assert gamma.shape == (2 * d, len(m.INPUTS))


def linearised(m, x, k, u, t):
    """Φ and Γ by the linearised equations along the motion, as others integrate them."""
    d, n, inputs = 2 * len(m.BASIS), len(x), len(m.INPUTS)

    def rates(t, y):
        dx, A = m.jacobian(0.3 + t, y[:n], k, u)
        B = m.jacobian_inputs(0.3 + t, y[:n], k, u) if inputs else np.zeros((d, 0))
        S = y[n:].reshape(d, d + inputs)
        return np.concatenate([dx, (A @ S + np.hstack([np.zeros((d, d)), B])).ravel()])

    start = np.concatenate([x, np.eye(d, d + inputs).ravel()])
    end = solve_ivp(rates, (0, t), start, "DOP853", rtol=1e-12, atol=1e-12).y[n:, -1]
    return np.hsplit(end.reshape(d, d + inputs), [d])


def test_a_step_that_is_exact_has_the_derivative_of_the_motion():
    """Of the linearised equations, in the same coordinates; of rk4 it is off as its error is."""
    m = module(PUSHED)
    p, x, u, *_ = state(m)
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


RIGHT = """
name = "righthanded"
group = "SO(3)"
[lagrangian]
L = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - A_33"
trivialisation = "right"
"""


def test_on_the_right_variations_are_those_of_space():
    """δg = η g; of the linearised equations."""
    m = module_of(RIGHT, step=("gauss",), jacobian=("state", "step"))
    p, x, *_ = state(m)
    k = m.constants(p)
    known, _ = linearised(m, x, k, None, 0.2)
    status, phi, gamma = m.gauss_jacobian(m.begin(0.0, x), k, None, 0.1, 2)
    assert (status, gamma.shape) == (0, (6, 0))
    assert close(phi, known)


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


# ---------------------------------------------------------------- with a mass in the state

TIP = np.array([0, 0, 2.0])
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
USED_UP = {"step": STEPS, "jacobian": ("state", "inputs", "outputs", "step")}


def by_hand():
    """The rates of a lander, as somebody wrote them, for complex numbers too."""
    text = codes.SPRUNG_CODE.replace("np.linalg.norm(d)", "np.sqrt(d @ d)")
    exec(text, own := {})  # of this test alone
    return own["f"]


def variation(A, e):
    """What the numbers of a state change by along (eta, delta zeta, delta m)."""
    w, v, rest = e[:3], e[3:6], e[6:]
    return np.concatenate([(A @ cross_matrix(w)).ravel(), A @ v, rest])


def told(A, dx):
    """(eta, delta zeta, delta m) of a change of the numbers of a state."""
    turn = A.T @ dx[:9].reshape(3, 3)
    w = [(turn[k, j] - turn[j, k]) / 2 for j, k in ((1, 2), (2, 0), (0, 1))]
    return np.concatenate([w, A.T @ dx[9:12], dx[12:]])


def rk4_by_hand(f, x, u, h):
    """One step, and what it is off a rotation taken away to first order."""
    a = f(x, u)
    b = f(x + h / 2 * a, u)
    c = f(x + h / 2 * b, u)
    y = x + h / 6 * (a + 2 * b + 2 * c + f(x + h * c, u))
    A = y[:9].reshape(3, 3)
    return np.concatenate([(A @ (3 * np.eye(3) - A.T @ A) / 2).ravel(), y[9:]])


def along(f, x, u):
    """∂f/∂(eta, delta zeta, delta m) and ∂f/∂u by complex steps."""
    A, tiny = x[:9].reshape(3, 3), 1e-30
    turned = [f(x + 1j * tiny * variation(A, e), u + 0j).imag / tiny for e in np.eye(13)]
    return np.array(turned).T, (f(x + 0j, u + 1j * tiny).imag / tiny)[:, None]


def shaken(f, x, u):
    """The place and the acceleration of the tip."""
    A, w, v = x[:9].reshape(3, 3), x[12:15], x[15:18]
    dw, dv = np.split(f(x, u)[12:18], 2)
    a = dv + np.cross(w, v) + np.cross(dw, TIP) + np.cross(w, np.cross(w, TIP))
    return np.concatenate([x[9:12] + A @ TIP, A @ a])


def test_a_mass_of_the_state_is_varied():
    """Against complex steps through equations that were written by hand."""
    m, f = module_of(LIGHTER, **USED_UP), by_hand()
    A = expm(cross_matrix([0.3, -0.5, 0.9]))
    x = np.concatenate([A.ravel(), [0.1, -0.4, 0.3, 0.5, -0.3, 0.7, 0.2, 1.1, -0.6, 4.5]])
    k, u = m.constants([1.5]), np.array([0.8])
    assert close(m.rhs(0.3, x, k, u), f(x, u), 1e-13)
    by_state, by_inputs = along(f, x, u)
    assert close(m.jacobian_inputs(0.3, x, k, u), told(A, by_inputs[:, 0])[:, None], 1e-12)
    C, D = along(lambda y, v: shaken(f, y, v), x, u)
    assert close(m.outputs(0.3, x, k, u), shaken(f, x, u), 1e-13)
    assert close(m.jacobian_outputs(0.3, x, k, u), C, 1e-12)
    assert close(m.jacobian_outputs_inputs(0.3, x, k, u), D, 1e-12)
    # of (eta, delta zeta) ↦ d/dt of it: eta turns with the body
    turning = np.zeros((13, 13))
    turning[:3, :3] = turning[3:6, 3:6] = cross_matrix(x[12:15])
    turning[3:6, :3] = cross_matrix(x[15:18])
    rates = np.vstack([np.eye(6, 13, 6) - turning[:6], by_state[12:]])
    assert close(m.jacobian(0.3, x, k, u)[1], rates, 1e-12)
    for step, h, n, inside, error in (
        ("rk4", 0.02, 2, 1, 1e-9),
        ("vern9", 0.05, 2, 100, 1e-9),
        ("gauss", 0.05, 2, 100, 1e-9),
    ):

        def whole(y, v, h=h / inside, n=n * inside):
            for _ in range(n):
                y = rk4_by_hand(f, y, v, h)
            return y

        end = whole(x, u)
        motion = m.begin(0.3, x)
        status, phi, gamma = getattr(m, f"{step}_jacobian")(motion, k, u, h, n)
        known = [
            np.array([told(end[:9].reshape(3, 3), y) for y in S.T]).T for S in along(whole, x, u)
        ]
        assert status == m.OK
        assert close(motion.x, end, error)
        assert close(phi, known[0], error), step
        assert close(gamma, known[1], error), step


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


# ---------------------------------------------------------------- without g, and on a quotient

EVERY = {"step": STEPS, "jacobian": ("state", "inputs", "parameters", "outputs", "step")}
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


def top_by_hand(x, p, u):
    """The equations of Euler and Poisson, γ the vertical seen from the body, with a drag."""
    (w, gamma), (I1, k) = np.split(x, 2), p
    momentum = np.array([I1, 2, 3]) * w
    drag = np.array([-k * w[0], -k * w[1] * gamma[0] ** 2, u[1] * w[0]])
    torque = np.cross(momentum, w) + np.cross([0, 0, 1], gamma) * -1 + drag + u
    return np.concatenate([torque / np.array([I1, 2, 3]), np.cross(gamma, w)])


def by_complex_steps(f, x):
    """The derivative of f at x."""
    tiny = 1e-30
    return np.array([f(x + 1j * tiny * e).imag / tiny for e in np.eye(len(x))]).T


def test_without_an_element_a_variation_is_of_the_numbers_of_the_state():
    """Against complex steps through equations that were written by hand."""
    m = module_of(DAMPED_TOP, **EVERY)
    x, p, u = np.array([0.4, -0.7, 1.1, 0.3, 0.5, -0.8]), np.array([1.5, 0.7]), [0.2, -0.3, 0.5]
    k, u = m.constants(p), np.array(u)
    assert m.STATE == ("zeta_1", "zeta_2", "zeta_3", "gamma_1", "gamma_2", "gamma_3")
    dx, A = m.jacobian(0.0, x, k, u)
    assert close(dx, top_by_hand(x, p, u), 1e-14)
    assert close(A, by_complex_steps(lambda x: top_by_hand(x, p, u), x), 1e-13)
    by_inputs = by_complex_steps(lambda u: top_by_hand(x, p, u), u)
    assert close(m.jacobian_inputs(0.0, x, k, u), by_inputs, 1e-13)
    by_parameters = by_complex_steps(lambda p: top_by_hand(x, p, u), p)
    assert close(m.jacobian_parameters(0.0, x, p, u), by_parameters, 1e-13)
    C = by_complex_steps(lambda x: np.array([x[0] * x[4], u[0] + x[5] ** 2]), x)
    assert close(m.jacobian_outputs(0.0, x, k, u), C, 1e-14)
    assert close(m.jacobian_outputs_inputs(0.0, x, k, u), [[0, 0, 0], [1, 0, 0]], 1e-14)
    for step, h, inside in (("rk4", 0.1, 1), ("vern9", 0.05, 100), ("gauss", 0.05, 100)):

        def whole(x, u, h=h / inside, n=2 * inside):
            for _ in range(n):
                a = top_by_hand(x, p, u)
                b = top_by_hand(x + h / 2 * a, p, u)
                c = top_by_hand(x + h / 2 * b, p, u)
                x = x + h / 6 * (a + 2 * b + 2 * c + top_by_hand(x + h * c, p, u))
            return x

        motion = m.begin(0.0, x)
        status, phi, gamma = getattr(m, f"{step}_jacobian")(motion, k, u, h, 2)
        assert status == m.OK
        assert close(motion.x, whole(x, u), 1e-9)
        assert close(phi, by_complex_steps(lambda x, f=whole: f(x, u), x)), step
        assert close(gamma, by_complex_steps(lambda u, f=whole: f(x, u), u)), step


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


def free(m):
    """The coordinates that are not held, by their numbers in 𝔤, from 0."""
    moves = [x for x in m.STATE if x.startswith(("zeta_", "w_"))]
    return [int(x[-1]) - 1 + 3 * x.startswith("w") for x in moves]


def retracted_on_quotient(m, x, V, side="left"):
    """The state at g exp(η), or exp(η) g, with ζ + δζ, where nothing of η is held."""
    eta, y = np.zeros(len(m.BASIS)), np.array(x)
    count = len(own := free(m))
    eta[own] = V[:count]
    turn = expm(hat(m, eta))
    g = turn @ matrix(m, x) if side == "right" else matrix(m, x) @ turn
    for name, place in element_names(m).items():
        y[m.STATE.index(name)] = g[place]
    y[-count:] += V[count:]
    return y


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


def prepared(problem, **options):
    """The Python of a problem, a state, and inputs; on which side it is."""
    m, rng = module_of(problem, **options), np.random.default_rng(3)
    g = expm(hat(m, rng.normal(size=len(m.BASIS))))
    start = {name: g[place] for name, place in element_names(m).items()}
    drawn = zip(m.STATE, rng.normal(size=len(m.STATE)), strict=True)
    x = np.array([start.get(name, y) for name, y in drawn])
    side = "right" if problem == FROM_SPACE else "left"
    return m, x, rng.normal(size=len(m.INPUTS)), side


def constants(m):
    return m.constants(m.DEFAULTS if m.PARAMETERS else [])


@pytest.mark.parametrize(
    ("name", "attitude"),
    [*((x, "matrix") for x in QUOTIENTS), ("tilted", "quaternion"), ("rod", "quaternion")],
)
def test_on_a_quotient_it_is_of_what_is_seen(name, attitude):
    """Where the body is, and how it moves, after two steps, by differences; on both sides as what V
    does to it."""
    problem, told = QUOTIENTS[name]
    plain, x, u, side = prepared(problem)
    m, count = (
        module_of(problem, step=STEPS, jacobian="step", attitude=attitude),
        2 * len(free(plain)),
    )
    if attitude == "quaternion":
        x, inside, outside = plain.project(x), m.from_matrix, m.to_matrix
    else:
        inside = outside = np.array
    k = constants(m)

    def seen(x):
        return np.concatenate([told(y) for y in held_apart(plain, x, side)])

    for step in STEPS:
        motion = m.begin(0.0, inside(x))
        status, phi, gamma = getattr(m, f"{step}_jacobian")(motion, k, u, H[step], 2)
        assert (status, phi.shape, gamma.shape) == (0, (count, count), (count, len(u)))
        end = outside(motion.x)

        def after(V, u=u, step=step):
            y = inside(retracted_on_quotient(plain, x, V, side))
            return seen(outside(moved(m, step, y, k, u, H[step], 2)))

        there = derivative(lambda V, y=end: seen(retracted_on_quotient(plain, y, V, side)), count)
        assert close(there @ phi, derivative(after, count)), step
        by_inputs = derivative(lambda e, f=after: f(np.zeros(count), u + e), len(u))
        assert close(there @ gamma, by_inputs), step


@pytest.mark.parametrize("problem", [x for x, _ in QUOTIENTS.values()], ids=[*QUOTIENTS])
def test_on_a_quotient_the_linearised_equations_are_those_of_the_motion(problem):
    """Φ by them, and by an exact step."""
    m, x, u, _ = prepared(problem, step="gauss", jacobian=("state", "step"))
    k, n = constants(m), 2 * len(free(m))

    def rates(t, y):
        dx, A = m.jacobian(t, y[: len(x)], k, u)
        return np.concatenate([dx, (A @ y[len(x) :].reshape(n, n)).ravel()])

    begun = np.concatenate([x, np.eye(n).ravel()])
    end = solve_ivp(rates, (0, 0.2), begun, "DOP853", rtol=1e-12, atol=1e-12).y[len(x) :, -1]
    status, phi, _ = m.gauss_jacobian(m.begin(0.0, x), k, u, 0.1, 2)
    assert status == m.OK
    assert close(phi, end.reshape(n, n))


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
