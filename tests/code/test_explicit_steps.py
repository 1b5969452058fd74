"""Explicit steps, emitted: orders, languages, known motions, what is kept, what is told."""

import subprocess
import tomllib
from functools import cache
from math import log2, pi, sqrt

import numpy as np
import pytest

import derive
from derive.problem.toml import problem_of
from tests.oracles import free_top, general
from tests.support.emitted import import_python
from tests.support.motions import FLAGS, LANGUAGES, follow
from tests.support.needs import need

MOMENTS, ENERGY, MOMENTUM = (1.25, 2.0, 2.75), 1.0, 2.2
LINE = """
group = { name = "Line", action = "affine", basis = [[[0, 0, 1], [0, 0, 0], [0, 0, 0]]] }
[[point]]
mass = 1
at = [0, 0]
[[potential]]
kind = "expression"
U = """
TEXTS = {
    "top": """group = "SO(3)"
[body]
given = { m = 1, c = [0, 0, 0], J = [["7/4", 0, 0], [0, 1, 0], [0, 0, "1/4"]] }""",
    "collision": LINE + '"-1/sqrt(r1_x^2)"',
    "blow_up": LINE + '"-r1_x^4/4"',
}
"""Problems besides the ready-made: a free top of the MOMENTS; points on a line, of which one falls
to a centre and one off to infinity."""


@cache
def walked(name):
    text = TEXTS.get(name)
    return derive.derive(problem_of(tomllib.loads(f'name = "{name}"\n{text}')) if text else name)


@pytest.fixture(scope="module")
def emitted(tmp_path_factory):
    """A function (name, options) → the folder with all languages, made once."""
    made = {}

    def get(name, *steps, **options):
        key = (name, steps, *map(str, options.items()))
        if key not in made:
            folder, languages = tmp_path_factory.mktemp(name), options.pop("languages", LANGUAGES)
            walked(name).emit(folder, languages, name, step=steps or ("rk4", "vern9"), **options)
            made[key] = folder
        return made[key]

    return get


def top(t):
    """The free top at a time, in closed form."""
    A, W = free_top.motion(t, MOMENTS, ENERGY, MOMENTUM)
    return np.concatenate([A.ravel(), W])


def on_line(place, speed):
    """A state of the point on the line: A, T, speed."""
    return (1.0, 0.0, 0.0, 1.0, place, 0.0, speed)


# ---------------------------------------------------------------- orders


@pytest.mark.parametrize(
    ("step", "order", "counts"), [("rk4", 4, (60, 120)), ("vern9", 9, (8, 12))]
)
@pytest.mark.parametrize("T", [4.0, -4.0])
def test_the_error_falls_with_the_order(emitted, step, order, counts, T):
    """Of the free top in several phases of its motion, forward and back."""
    commands = [x for n in counts for x in (("begin", 0, 0), (step, T / n, n))]
    errors = np.zeros(2)
    for phase in (0.0, 1.1, 2.3, 3.1):
        places = follow("c", emitted("top"), "top", commands, top(phase))[1::2]
        assert all(place.status == 0 for place in places)
        errors += [np.abs(place.x - top(phase + T)).max() for place in places]
    assert order - 0.3 < log2(errors[0] / errors[1]) / log2(counts[1] / counts[0]) < order + 0.5
    assert errors[1] > 2e-13  # above rounding, so that this is the order


@pytest.mark.parametrize(
    ("step", "order", "sizes"), [("rk4", 3, (0.1, 0.05)), ("vern9", 8, (1.0, 0.7))]
)
def test_dense_output_has_its_order(emitted, step, order, sizes):
    """Of one step, at times within it: an error like h to the order and 1."""
    worst = []
    for h in sizes:
        times = [part * h for part in (0.1, 0.35, 0.6, 0.85, 1.0)]
        commands = [(step, h, 1), *(("dense", t, 0) for t in times)]
        places = follow("c", emitted("top"), "top", commands, top(0.0))[1:]
        errors = [np.abs(place.x - top(t)).max() for place, t in zip(places, times, strict=True)]
        worst.append(max(errors))
    found = log2(worst[0] / worst[1]) / log2(sizes[0] / sizes[1])
    assert order + 1 - 0.4 < found < order + 1 + 1.2, worst
    assert worst[1] > 1e-14


@pytest.mark.parametrize("language", LANGUAGES)
def test_dense_output_is_continuous(emitted, language):
    """At both ends of a step it is the state there; before the first, the first state."""
    commands = [("dense", 0, 0), ("vern9", 0.3, 2), ("dense", 0.3, 0), ("dense", 0.6, 0)]
    commands += [("begin", 0, 0), ("vern9", 0.3, 1), ("rk4", -0.1, 1), ("dense", 0.3, 0)]
    commands += [("dense", 0.2, 0)]
    begun, end, at_start, at_end, _, one, back, before, after = follow(
        language, emitted("top"), "top", commands, top(0.0)
    )
    assert np.array_equal(begun.x, top(0.0))
    for a, b in ((at_start, one), (before, one)):
        assert np.abs(a.x - b.x).max() < 2e-15
    for a, b in ((end, at_end), (after, back)):  # but for what takes the state to the group
        assert np.abs(a.x - b.x).max() < 1e-6 * np.abs(one.x - back.x).max()


# ---------------------------------------------------------------- languages


@pytest.mark.parametrize("language", LANGUAGES[1:])
@pytest.mark.parametrize("name", ["se3", "sl3"])
def test_every_language_has_the_same_motion(emitted, language, name):
    """As that of C, with inputs."""
    folder = emitted(name)
    p, u, x = start_of(folder, name, np.random.default_rng(7))
    commands = [("rk4", 0.02, 20), ("dense", 0.393, 0), ("vern9", -0.1, 3), ("dense", 0.2, 0)]
    commands += [("vern9_to", 1.0, 1e-8), ("dense", 0.99, 0)]
    places = follow(language, folder, name, commands, x, p, u)
    for a, b in zip(places, follow("c", folder, name, commands, x, p, u), strict=True):
        assert (a.status, a.t) == (b.status, b.t)
        # h goes with the ninth root of an estimated error: processors round the sums of the Python
        # apart, by 1e-15 of some 1e-11
        assert abs(a.h - b.h) <= 1e-5 * abs(b.h)
        assert np.abs(a.x - b.x).max() < 1e-13 * np.abs(b.x).max()  # which is up to 13


def start_of(folder, name, rng):
    """Parameters near their defaults, inputs, and a state on the group."""
    code = import_python(name, folder)
    p = [code.DEFAULTS.get(x, 1.0) + rng.uniform(-0.1, 0.1) for x in code.PARAMETERS]
    group = walked(name).problem.group.name
    return (
        p,
        rng.normal(size=len(code.INPUTS)),
        general.random_state({"group": group}, code.BASIS, rng),
    )


@pytest.mark.parametrize("flags", FLAGS)
def test_the_compiler_changes_nothing(emitted, flags):
    """Vector registers as wide as there are: an SLP pass once made errors of a pair wrong."""
    commands = [("vern9_to", 30.0, 1e-10), ("begin", 0, 0), ("rk4", 0.01, 1000)]
    commands += [("begin", 0, 0), ("vern9_to", 1.0, 1e-6)]
    plain = follow("c", emitted("top"), "top", commands, top(0.0), flags=("-O0",))
    found = follow("c", emitted("top"), "top", commands, top(0.0), flags=flags)
    for a, b in zip(found, plain, strict=True):
        assert (a.status, a.t) == (b.status, b.t) == (0, b.t)
        if "-ffp-contract=fast" in flags:  # other roundings
            assert abs(a.h - b.h) <= 1e-2 * b.h
            assert np.abs(a.x - b.x).max() < 1e-11
        else:
            assert a.h == b.h
            assert np.array_equal(a.x, b.x)


# ---------------------------------------------------------------- known motions


@pytest.mark.parametrize("tol", [1e-6, 1e-9, 1e-12])
def test_a_tolerance_is_kept(emitted, tol):
    """The free top over some periods: the error is of the size that was asked for, and ends at the
    time itself."""
    T = 10 * free_top.period(MOMENTS, ENERGY, MOMENTUM)
    (end,) = follow("c", emitted("top"), "top", [("vern9_to", T, tol)], top(0.0))
    assert (end.status, end.t) == (0, T)
    error = np.abs(end.x - top(T)).max()
    assert error < 20 * tol
    assert error > tol / 1e5 or tol < 1e-11


@pytest.mark.parametrize("step", [("rk4", 0.02), ("vern9", 0.1)])
def test_the_tangent_state_stays_on_the_group(emitted, step):
    """Four points on springs, on SL(3): det A = 1 and Tr(A^-1 dA/dt) = 0 over 10^6 steps, which
    without projection end in numbers that are none."""
    folder = emitted("sl3", velocity="tangent")
    p, _, x = start_of(emitted("sl3"), "sl3", np.random.default_rng(3))
    code = import_python("sl3", folder)
    A = x[:9].reshape(3, 3)
    V = A @ np.tensordot(0.3 * x[9:], code.BASIS, 1)
    start, k = np.concatenate([A.ravel(), V.ravel()]), code.constants(np.array(p))
    (end,) = follow("c", folder, "sl3", [(step[0], step[1], 1_000_000)], start, p, flags=("-O3",))
    A, V = end.x.reshape(2, 3, 3)
    assert end.status == 0
    assert abs(np.linalg.det(A) - 1) < 1e-14 * np.abs(A).max() ** 3
    assert abs(np.trace(np.linalg.solve(A, V))) < 1e-13 * np.abs(V).max() * np.abs(A).max() ** 2
    assert abs(code.energy(0.0, end.x, k) / code.energy(0.0, start, k) - 1) < 1e-2


# ---------------------------------------------------------------- what is told


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_collision_is_told(emitted, language):
    """A point falls to a centre: its steps become too short, or its rates infinite."""
    commands = [("vern9_to", 2.0, 1e-9), ("vern9_to", 2.0, 1e-9)]
    places = follow(language, emitted("collision"), "collision", commands, on_line(1.0, 0.0))
    for place in places:
        assert place.status in (2, 3)
        assert np.isfinite(place.x).all()
        assert abs(place.t - pi / sqrt(8)) < 1e-4


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    "command", [("rk4", 0.01, 1000), ("vern9", 0.01, 1000), ("vern9_to", 9, 1e-9)]
)
def test_a_motion_to_infinity_is_told(emitted, language, command):
    """x'' = x^3 of energy 0 is 1/(1 - t/sqrt 2): the last good state is kept."""
    folder, start = emitted("blow_up"), on_line(1.0, sqrt(0.5))
    told, again = follow(language, folder, "blow_up", [command, command], start)
    assert told.status == (3 if command[0] == "vern9_to" else 2)
    assert again.status in (2, 3)
    assert np.isfinite(told.x).all()
    assert abs(told.t - sqrt(2)) < (1e-6 if command[0] == "vern9_to" else 0.2)


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_no_number_is_told(emitted, language):
    """In a state, a size, a time: nothing moves."""
    nan = float("nan")
    for command in (
        ("rk4", nan, 1),
        ("vern9", nan, 1),
        ("vern9_to", nan, 1e-9),
        ("vern9_to", 1e400, 1e-9),
    ):
        (place,) = follow(language, emitted("top"), "top", [command], top(0.0))
        assert place.status == 2
        assert np.array_equal(place.x, top(0.0))
    for command in (("rk4", 0.1, 1), ("vern9", 0.1, 1), ("vern9_to", 1.0, 1e-9)):
        (place,) = follow(language, emitted("top"), "top", [command], [*top(0.0)[:-1], nan])
        assert (place.status, place.t) == (2, 0.0)


# ---------------------------------------------------------------- other builds


def test_sanitizers_find_nothing(emitted):
    """Addresses and undefined behaviour, in a run with all that there is."""
    need("sanitizers of gcc")
    flags = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    commands = [("dense", 0, 0), ("rk4", 0.1, 3), ("dense", 0.25, 0), ("vern9_to", 3.0, 1e-9)]
    commands += [("dense", 2.9, 0), ("vern9", -0.1, 3), ("dense", 2.75, 0)]
    folder = emitted("se3")
    p, u, x = start_of(folder, "se3", np.random.default_rng(1))
    assert all(
        place.status == 0 for place in follow("c", folder, "se3", commands, x, p, u, flags=flags)
    )


@pytest.mark.parametrize("language", LANGUAGES)
def test_floats_have_rk4(emitted, language):
    """In numbers of 32 bits, as exact as these are: in C without a double."""
    folder = emitted("top", "rk4", real="float")
    commands = [("rk4", 0.02, 200), ("dense", 3.99, 0)]
    flags = ("-O2", "-Wdouble-promotion", "-Wconversion", "-fsingle-precision-constant")
    start = np.float32(top(0.0))
    end, within = follow(language, folder, "top", commands, start, real="float", flags=flags)
    assert np.abs(end.x - top(4.0)).max() < 2e-6
    assert np.abs(within.x - top(3.99)).max() < 3e-6


FORMS = {
    "quaternion": {"attitude": "quaternion"},
    "columns, in one header": {"layout": "col", "form": "header"},
    "principal": {"frame": "principal"},
    "momenta": {"momenta": True},
    "tangent": {"velocity": "tangent"},
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("compiler", ["gcc", "clang", "g++"])
def test_every_form_of_the_state_has_them_all(emitted, form, compiler):
    """Together with gauss, as C99 and as C++11."""
    need(compiler)
    folder = emitted("se3", "gauss", "rk4", "vern9", languages=("c",), **FORMS[form])
    (folder / "all.c").write_text('#include "se3_steps.h"\n#include "se3_steps.h"\n')
    language = ["-x", "c++", "-std=c++11"] if compiler == "g++" else ["-std=c99", "-pedantic"]
    strict = ["-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    subprocess.run([compiler, *language, *strict, str(folder / "all.c")], check=True)


def test_methods_may_take_turns():
    """A motion that gauss, vern9 and rk4 move one after the other, and back."""
    f = derive.compile(walked("top").problem, step=("gauss", "vern9", "rk4"))
    x = top(0.0)
    m = f.begin(x).move(0.1, 3, "gauss").move(0.1, 3, "vern9").move(0.001, 400, "rk4")
    assert np.abs(m.move(0.1, 1, "gauss").x - top(1.1)).max() < 1e-11
    for step in ("vern9", "gauss"):
        m.move_to(m.t + 0.3, 1e-13, step)
        within = m.t - 0.3 * m.h
        assert np.abs(m.dense(within) - top(within)).max() < 1e-11
