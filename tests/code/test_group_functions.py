"""--exponential: exp, log, their Jacobians, retract and local, against series of 50 digits."""

import re
import subprocess
from functools import cache

import mpmath
import numpy as np
import pytest

import derive
from derive.code.group_functions import FUNCTIONS
from derive.problem.toml import problem_of
from tests.support import walks
from tests.support.lagrangians import lagrangian, squares
from tests.support.library import STRICT, Asked, built, emission, module
from tests.support.needs import need
from tests.support.read_julia import Module, Numbers

DIGITS = 50
ANGLES = (0.0, 1e-12, 1e-8, 1e-4, 1.0, 1.99, 2.01, np.pi - 1e-4, np.pi - 1e-8)
"""The largest angle of a factor; at 2 the series end."""
SIZES = (0.0, 1e-8, 1.0, 3.0)
"""The size of the largest eigenvalue elsewhere."""


def unit(n, i, j):
    return [[int((r, c) == (i, j)) for c in range(n)] for r in range(n)]


def skew(n, i, j):
    return (np.array(unit(n, j, i)) - np.array(unit(n, i, j))).tolist()


TWO_FRAMES = [skew(5, 1, 2), skew(5, 2, 0), skew(5, 0, 1)]
TWO_FRAMES += [unit(5, i, j) for j in (3, 4) for i in range(3)]
"""SE_2(3): velocities and places that turn with one frame."""
SCREW = [[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, "1/10"], [0, 0, 0, 0]]]
LINE = [[[0, 1], [0, 0]]]


def of_points(group, n, **more):
    rng = np.random.default_rng(4)
    blocks = len(group.split(" x ")) if isinstance(group, str) else 1
    points = [
        {"mass": 1, "at": rng.integers(-3, 4, size=n).tolist(), "block": block}
        for block in range(1, blocks + 1)
        for _ in range(n + 2)
    ]
    return problem_of({"name": "test", "group": group, "point": points, **more})


def of_basis(basis, action="linear"):
    group = {"name": "G", "action": action, "basis": basis}
    L = " + ".join(f"zeta_{a}^2" for a in range(1, len(basis) + 1))
    data = {"name": "test", "group": group}
    return problem_of(data | {"lagrangian": {"L": L, "trivialisation": "left"}})


PROBLEMS = {
    "SO(2)": lambda: of_points("SO(2)", 2),
    "SO(3)": lambda: of_points("SO(3)", 3),
    "SE(2)": lambda: of_points("SE(2)", 2),
    "SE(3)": lambda: of_points("SE(3)", 3),
    "SO(3) x SE(3)": lambda: of_points("SO(3) x SE(3)", 3),
    "SE_2(3)": lambda: of_basis(TWO_FRAMES),
    "screw": lambda: of_basis(SCREW, "affine"),
    "line": lambda: of_basis(LINE),
    "right": lambda: lagrangian(squares(1, 2, 3, 1, 2, 3), "SE(3)", side="right"),
    "quaternion": lambda: of_points("SO(3)", 3),
    "quaternions": lambda: lagrangian(squares(*range(1, 11)), "SO(2) x SE(3) x SO(3)"),
}
GENERAL = {
    **{
        f"{x}({n})": lambda x=x, n=n: of_points(f"{x}({n})", n)
        for x, n in (("SL", 3), ("GL", 2), ("Aff", 2), ("SAff", 2), ("Sp", 4), ("Sim", 3))
    },
    **{f"{x}(4)": lambda x=x: of_points(f"{x}(4)", 4) for x in ("SO", "SE")},
    "SU(2)": lambda: of_points("SU(2)", 4),
    "UT(3)": lambda: of_basis([unit(3, 0, 1), unit(3, 1, 2), unit(3, 0, 2)]),
    "SO(3) x SL(2)": lambda: lagrangian(squares(1, 2, 3, 1, 2, 3), "SO(3) x SL(2)"),
    "right SL(2)": lambda: lagrangian(squares(1, 2, 3), "SL(2)", side="right"),
    "quaternion, SL(2)": lambda: lagrangian(squares(1, 2, 3, 1, 2, 3), "SO(3) x SL(2)"),
}
"""Groups that do more than turn and shift."""
OPTIONS = {"SE(3)": {"layout": "col"}, "SE(2)": {"state": "moving"}, "SL(3)": {"layout": "col"}}
OPTIONS |= {
    x: {"attitude": "quaternion"} for x in ("quaternion", "quaternions", "quaternion, SL(2)")
}


@cache
def case(name):
    """What is compiled of a problem, the basis, and where the numbers of an element are."""
    need("cc")
    chosen = OPTIONS.get(name, {})
    problem = {**PROBLEMS, **GENERAL}[name]()
    f = derive.compile(problem, exponential=True, jacobian="state", **chosen)
    group = problem.group
    d, basis = group.dimension, group.in_user_basis.basis
    sizes = [x.size for x in group.factors or (group,)]
    places = []
    for entry in f.STATE[:-d]:
        letter, block, i, j = re.fullmatch(r"([ATq])(\d?)_(\d)(\d?)", entry).groups()
        start = sum(sizes[: int(block or 1) - 1])
        end = start + sizes[int(block or 1) - 1]
        if letter == "q":
            places.append((f"q{i}", start))
            continue
        places.append((start + int(i) - 1, start + int(j) - 1 if j else end - 1))
        assert letter == "T" or j
    matrices = [
        mpmath.matrix([[mpmath.mpf(x.numerator) / x.denominator for x in r] for r in e])
        for e in basis
    ]
    return f, matrices, places


def hat(E, eta):
    return sum((mpmath.mpf(x) * e for x, e in zip(eta, E, strict=True)), 0 * E[0])


def exp(M):
    """The exponential of a matrix, by its series and squares."""
    power = total = mpmath.eye(M.rows)
    for n in range(1, 40):
        power = power * M / (n * 2**8)
        total += power
    for _ in range(8):
        total = total * total
    return total


def quaternion(G, at):
    """The unit quaternion, scalar first and not negative, of a turn by less than π."""
    R = G[at : at + 3, at : at + 3]
    p = mpmath.sqrt(1 + R[0, 0] + R[1, 1] + R[2, 2]) / 2
    return [p, *((R[j, i] - R[i, j]) / (4 * p) for i, j in ((1, 2), (2, 0), (0, 1)))]


def rotation(q):
    """The matrix of what a quaternion does to a vector."""
    p, *v = (mpmath.mpf(float(x)) / mpmath.norm(mpmath.matrix([*map(float, q)])) for x in q)
    j = mpmath.matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return mpmath.eye(3) + 2 * p * j + 2 * j * j


def entries(G, places):
    return np.array(
        [float(quaternion(G, j)[int(i[1])] if isinstance(i, str) else G[i, j]) for i, j in places]
    )


def alike(g, places):
    """The numbers of an element, of q and −q that with a scalar that is not negative."""
    g = np.array(g)
    for n, (i, _) in enumerate(places):
        if i == "q0" and g[n] < 0:
            g[n : n + 4] *= -1
    return g


def element(g, places, size):
    """The matrix of an element of doubles."""
    G = mpmath.eye(size)
    for n, (x, (i, j)) in enumerate(zip(g, places, strict=True)):
        if i == "q0":
            G[j : j + 3, j : j + 3] = rotation(g[n : n + 4])
        elif not isinstance(i, str):
            G[i, j] = mpmath.mpf(float(x))
    return G


def coordinates(E, M):
    """Those of a matrix of the algebra."""
    flat = mpmath.matrix([[*e] for e in E]).T
    found = mpmath.lu_solve(flat, mpmath.matrix([*M]))
    assert mpmath.norm(flat * found - mpmath.matrix([*M])) < mpmath.mpf(10) ** -15
    return [*found]


def turned(E, angle, rng):
    """Coordinates of the largest angle that is asked for; those of shifts alone are of size 1."""
    turns = [any(abs(sum((d * e)[i, i] for i in range(e.rows))) > 0 for d in E) for e in E]
    eta = rng.normal(size=len(E))
    if not any(turns):
        return eta
    M = hat(E, eta * turns)
    largest = max(abs(z) for z in np.linalg.eigvals(np.array(M.tolist(), dtype=float)))
    return np.where(turns, eta * angle / largest, eta)


def drawn(name, angle):
    f, E, places = case(name)
    return f, E, places, turned(E, angle, np.random.default_rng([7, int(angle * 1e3)]))


PAIRS = [(x, a) for x in PROBLEMS for a in ANGLES] + [(x, a) for x in GENERAL for a in SIZES]
CASES = pytest.mark.parametrize(("name", "angle"), PAIRS, ids=[f"{x} {a:.3g}" for x, a in PAIRS])
NAMES = pytest.mark.parametrize("name", PROBLEMS)


def far(found, wanted):
    """The largest error, of numbers beyond 1 relative to the largest of them."""
    wanted = np.array(wanted, dtype=float)
    return np.max(np.abs(found - wanted)) / max(1, np.max(np.abs(wanted)))


def back(name):
    """What an error of what leads back to the algebra is below: by roots it has the condition of
    matrices, here of up to 500."""
    return 1e-15 if name in PROBLEMS else 3e-14


@CASES
def test_exp_and_log_have_all_digits(name, angle):
    """Of numbers of size 1; the largest error of these is 6e-16, by roots 8e-15."""
    with mpmath.workdps(DIGITS):
        f, E, places, eta = drawn(name, angle)
        g = entries(exp(hat(E, eta)), places)
        assert far(f.exp(eta), g) < 1e-15
        assert far(f.log(g), eta) < back(name)


@pytest.mark.parametrize("angle", [3.5, 50.0])
@NAMES
def test_exp_beyond_half_a_turn(name, angle):
    """There the error grows as the angle does: to 2e-15 at 50."""
    with mpmath.workdps(DIGITS):
        f, E, places, eta = drawn(name, angle)
        g = entries(exp(hat(E, eta)), places)
        assert far(alike(f.exp(eta), places), g) < 1e-16 * max(10, angle)


@CASES
def test_jacobians_are_those_of_differences(name, angle):
    """The largest error of these is 7e-16, by roots 2e-14; differences of 50 digits are right to
    1e-30."""
    with mpmath.workdps(DIGITS):
        f, E, places, eta = drawn(name, angle)
        h, X = mpmath.mpf(10) ** -18, hat(E, eta)
        columns = []
        for e in E:
            change = (exp(X + h * e) - exp(X - h * e)) / (2 * h)
            change = change * exp(-X) if "right" in name else exp(-X) * change
            columns.append(coordinates(E, change))
        J = mpmath.matrix(columns).T
        inverse = np.array((J**-1).tolist(), dtype=float)
        assert far(f.exp_jacobian(eta), J.tolist()) < 1e-15
        assert far(f.log_jacobian(entries(exp(X), places)), inverse) < back(name)


@pytest.mark.parametrize("name", ["SO(3)", "quaternion"])
@pytest.mark.parametrize("angle", [1e-12, 1e-8])
def test_small_turns_have_all_their_digits(angle, name):
    """Of what is small itself: the skew part of a rotation."""
    f = case(name)[0]
    eta = angle * np.array([1.0, -2.0, 0.5])
    np.testing.assert_allclose(f.log(f.exp(eta)), eta, rtol=4e-16, atol=0)


def test_a_quaternion_and_its_opposite_are_one_turn():
    """In log, its Jacobian and local; half a turn, of scalar 0, is by either sign."""
    f, rng = case("quaternion")[0], np.random.default_rng(9)
    for q in rng.normal(size=(20, 4)):
        g, h, w = q / np.linalg.norm(q), f.exp(rng.normal(size=3)), np.zeros(3)
        np.testing.assert_allclose(f.log(-g), f.log(g), rtol=1e-15)
        np.testing.assert_array_equal(f.log_jacobian(-g), f.log_jacobian(g))
        eta = f.local([*g, *w], [*h, *w])
        assert np.linalg.norm(eta) < np.pi + 1e-15
        np.testing.assert_allclose(f.local([*-g, *w], [*h, *w]), eta, atol=2e-15)
    for axis in np.eye(3):
        np.testing.assert_allclose(np.abs(f.log([0, *axis])), np.pi * axis, rtol=1e-15)


@pytest.mark.parametrize(
    ("name", "g"),
    [
        ("right SL(2)", [-1, 0, 0, -1]),
        ("right SL(2)", [-2, 0, 0, -0.5]),
        ("GL(2)", [1, 1, 1, 1]),
        ("SO(4)", np.diag([-1, -1, 1, 1])),
    ],
)
def test_what_has_no_logarithm_is_no_number(name, g):
    """An eigenvalue that is negative, or 0."""
    f, g = case(name)[0], np.ravel(g)
    d = len(f.log(g))
    x = np.concatenate([case(name)[0].exp(np.zeros(d)), np.zeros(d)])
    assert np.isnan(f.log(g)).all()
    assert np.isnan(f.log_jacobian(g)).all()
    assert np.isnan(f.local(x, [*g, *np.zeros(d)])[:d]).all()


@pytest.mark.parametrize("decades", [-200, -18, -8, -3, 3, 5, 8, 18, 200])
def test_scales_of_many_decades_keep_their_logarithm_or_have_none(decades):
    """Of a multiple of 1, one of a single axis, a shear of it: right, or no number, never wrong."""
    f, E, _ = case("GL(2)")
    size, c = decades * np.log(10), 10.0**decades
    for g, X in (
        (np.diag([c, c]), np.diag([size, size])),
        (np.diag([c, 1]), np.diag([size, 0])),
        ([[c, c / 2], [0, c]], [[size, 0.5], [0, size]]),
    ):
        eta = f.log(np.ravel(g))
        if abs(decades) > 100:
            assert np.isnan(eta).all()
        else:
            found = np.array(hat(E, eta).tolist(), dtype=float)
            assert np.abs(found - X).max() < 1e-15 * max(1, abs(size))


def test_half_a_turn_has_one_of_two_signs():
    f = case("SO(3)")[0]
    for n in np.eye(3), np.array([[0.6, 0.8, 0], [0, -0.6, 0.8]]):
        for axis in n:
            g = (2 * np.outer(axis, axis) - np.eye(3)).ravel()
            found = f.log(g)
            np.testing.assert_allclose(np.abs(found @ axis), np.pi, rtol=1e-15)
            np.testing.assert_allclose(np.abs(found), np.pi * np.abs(axis), atol=1e-15)


@CASES
def test_local_is_the_inverse_of_retract(name, angle):
    """The largest error of these is 5e-16, by roots 6e-14."""
    with mpmath.workdps(DIGITS):
        f, E, places, eta = drawn(name, angle)
        d, size, rng = len(E), E[0].rows, np.random.default_rng(5)
        x = np.concatenate([f.exp(turned(E, 2.0, rng)), rng.normal(size=d)])
        moved = np.concatenate([eta, rng.normal(size=d)])
        y, X = f.retract(x, moved), element(x[:-d], places, size)
        by = exp(hat(E, eta))
        wanted = by * X if "right" in name else X * by
        assert far(alike(y[:-d], places), entries(wanted, places)) < 2e-15
        np.testing.assert_array_equal(y[-d:], x[-d:] + moved[d:])
        assert far(f.local(x, y), moved) < 2 * back(name)


@pytest.mark.parametrize("name", [*PROBLEMS, "SL(3)", "right SL(2)"])
def test_its_coordinates_are_those_of_the_linearised_equations(name):
    """D of --jacobian by differences of the rates along retract, seen by local: to 3e-8."""
    f, E, _ = case(name)
    d, rng, h = len(E), np.random.default_rng(6), 1e-4
    x = np.concatenate([f.exp(turned(E, 1.0, rng)), rng.normal(size=d)])
    _, D = f.jacobian(0.0, x)

    def between(y):
        """The rate of local(x, y) as both move."""
        ends = [f.local(x + s * f(0.0, x), y + s * f(0.0, y)) for s in (h, -h)]
        return (ends[0] - ends[1]) / (2 * h)

    steps = h * np.eye(2 * d)
    found = [(between(f.retract(x, s)) - between(f.retract(x, -s))) / (2 * h) for s in steps]
    assert far(np.transpose(found), D) < 2e-7


# -- languages -----------------------------------------------------------------------------------


def in_python(prefix, texts, calls):
    made = module(prefix, texts[f"{prefix}_group.py"])
    return [getattr(made, name)(*given).ravel() for name, given, _ in calls]


def in_julia(prefix, texts, calls):
    text, found = texts[f"{prefix}_group.jl"], []
    real, made = np.float32 if "--real float" in text else np.float64, Module(text)
    for name, given, count in calls:
        arrays = [Numbers(len(x), values=map(real, x)) for x in given]
        out = Numbers(count, kind=real)
        made.call(f"{name}!", *arrays, out)
        found.append(np.array(out.array, dtype=float))
    return found


def in_javascript(prefix, texts, calls):
    real = "float" if "--real float" in texts[f"{prefix}_group.mjs"] else "double"
    made = Asked("javascript", f"{prefix}_group", texts, real)
    return [np.array(made.ask(name, *map(np.asarray, given))[1], float) for name, given, _ in calls]


def listed(x):
    return f"[{', '.join(map(repr, map(float, x)))}]"


def in_rust(prefix, texts, calls):
    need("rustc")
    lines = [f"mod {prefix}_group;", "fn main() {"]
    for name, given, count in calls:
        arrays = ", ".join(f"&{listed(x)}" for x in given)
        lines += [f"let mut out = [0.0; {count}];", f"{prefix}_group::{name}({arrays}, &mut out);"]
        lines += ['for x in out { print!("{x:e} "); }', "println!();"]
    main = {"main.rs": "\n".join([*lines, "}"])}
    own = {x: text for x, text in texts.items() if x.endswith("_group.rs")}
    words = ("rustc", "--edition=2021", "-Dwarnings", "-oout", "main.rs")
    done = subprocess.check_output([built([words], own | main)], text=True)
    return [np.array(line.split(), dtype=float) for line in done.splitlines()]


RUN = {"python": in_python, "julia": in_julia, "javascript": in_javascript, "rust": in_rust}


ALIKE = ("SO(3) x SE(3)", "SE(2)", "right", "SAff(2)", "quaternions")
COMPARED = [(name, x, "double") for name in ALIKE for x in RUN]
COMPARED += [("SE(2)", x, "float") for x in RUN if x != "python"]  # where it is of doubles
COMPARED += [(y, x, "float") for x in RUN for y in ("right SL(2)", "quaternion") if x != "python"]


@pytest.mark.parametrize(("name", "language", "real"), COMPARED)
def test_every_language_says_what_c_says(name, language, real):
    f, E, _ = case(name)
    d, rng = len(E), np.random.default_rng(8)
    chosen = {"exponential": True, "real": real, **OPTIONS.get(name, {})}
    prefix, texts = emission({**PROBLEMS, **GENERAL}[name](), ("c", language), **chosen)
    calls = []
    for angle in ANGLES if name in PROBLEMS else SIZES:
        eta = turned(E, angle, rng)
        g = f.exp(eta)
        x, moved = (np.concatenate([a, rng.normal(size=d)]) for a in (g, eta))
        values = {"g": g, "x": x, "y": f.retract(x, moved)}
        for function, (takes, _) in FUNCTIONS.items():
            own = {**values, "eta": moved if function == "retract" else eta}
            given = [own[x] for x in takes]
            calls.append((function, given, getattr(f, function)(*given).size))
    found = RUN[language](prefix, texts, calls)
    for (function, given, _), there in zip(calls, found, strict=True):
        error = far(there, getattr(f, function)(*given).ravel())
        assert error < 2 * back(name) * (1 if real == "double" else 1e9), function


COMPILERS = ("gcc -std=c99", "clang -std=c99", "g++ -xc++ -std=c++11", "clang++ -xc++")


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("name", ["SO(3) x SE(3)", "SO(3) x SL(2)", "quaternion"])
def test_every_compiler_takes_the_header(name, compiler, real):
    words = compiler.split()
    need(words[0])
    prefix, texts = emission(
        {**PROBLEMS, **GENERAL}[name](),
        ("c",),
        exponential=True,
        real=real,
        **OPTIONS.get(name, {}),
    )
    header = f"{prefix}_group.h"
    main = f'#include "{header}"\nint main(void) {{ return 0; }}\n'
    more = ["-Wdouble-promotion"] if real == "float" else []
    command = (*words, *STRICT, *more, "main.c", "-oout", "-lm")
    built([command], {header: texts[header], "main.c": main})


@pytest.mark.parametrize("language", RUN)
def test_every_language_updates_as_c_does(language):
    """An estimate and its covariance, by an observation of A o and of A⁻¹ o."""
    problem, rng = walks.problem("imu"), np.random.default_rng(3)
    f = derive.compile(problem, exponential=True)
    root = rng.normal(size=(9, 9))
    x = [*f.exp(rng.normal(size=9)), *(root @ root.T)[np.triu_indices(9)]]
    given = [np.array(x), rng.normal(size=5), rng.normal(size=3), np.diag([1.0, 2, 3]).ravel()]
    calls = [(f"update_{side}", given, len(x)) for side in ("left", "right")]
    own = [given[0], rng.normal(size=3), rng.normal(size=27), given[3]]
    calls.append(("update", own, len(x)))
    prefix, texts = emission(problem, ("c", language), exponential=True)
    found = RUN[language](prefix, texts, calls)
    for (function, given, _), there in zip(calls, found, strict=True):
        assert far(there, getattr(f, function)(*given)) < 1e-13, function
