"""Laws of the emitted steps, in every language by one table: of a body that is thrown, whose motion
and events are known in closed form, of a point on a line that is stiff or comes to an end, of every
form of the state; and of what is kept."""

import subprocess
from copy import copy
from itertools import pairwise
from math import asin, log, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import derive
from derive.code.options import Options
from derive.programs import program
from tests.problems import thrown
from tests.problems.moving import FALLING
from tests.problems.thrown import PARAMETERS, PUSH, state
from tests.support import faces
from tests.support.corpus import driven
from tests.support.library import (
    ONE_BUILD,
    SHARED,
    STEPPED,
    STRICT,
    Native,
    built,
    derived,
    emission,
    library,
    module_of,
)
from tests.support.needs import need

STEPS, ADAPTIVE = ("gauss", "vern9", "rk4", "discrete"), ("gauss", "vern9")
BUILDS, READ = tuple(ONE_BUILD[x] for x in STEPPED), "julia"
EACH = [(build, step) for build in BUILDS for step in STEPS]
NAN, INFINITE = float("nan"), float("inf")
NOT_FINITE, NOT_CONVERGED, AT_EVENT, NO_SOLUTION = 2, 3, 4, 5
each_step = pytest.mark.parametrize(("build", "step"), EACH)
each_adaptive = pytest.mark.parametrize(("build", "step"), [x for x in EACH if x[1] in ADAPTIVE])
each_build = pytest.mark.parametrize("build", BUILDS)
ALL = {"step": STEPS, "order": 4}
TEXT = thrown.TEXT + thrown.EVENTS


def moved(build, commands, x=None, p=PARAMETERS, u=PUSH, flags=()):
    """The places of the thrown body after some commands."""
    return library(build, TEXT, flags, **ALL).follow(commands, state(0) if x is None else x, p, u)


def to(step, t, tol, events=24):
    """Up to a time, by as many calls as may stop at events."""
    return [(f"{step}_to", t, tol)] * (1 + events)


TURNING = [*range(9), *range(12, 15)]


def off(place, t, phase=0.0, which=slice(None)):
    """How far the body is from where it should be at a time, in some numbers of its state."""
    return np.abs(place.x - state(t, phase))[which].max()


# ---------------------------------------------------------------- orders

ORDERS = {"gauss": (16, 12.0, (4, 6)), "vern9": (9, 4.0, (8, 12))}
ORDERS |= {"rk4": (4, 4.0, (60, 120)), "discrete": (4, 4.0, (40, 80))}
"""Step → its order, a time, and how many steps lead there with errors that tell the order."""


@each_step
@pytest.mark.parametrize("sign", [1, -1], ids=["forward", "back"])
def test_the_error_falls_with_the_order(build, step, sign):
    """In several phases of the motion; of order 16 as it turns, the rest is soon exact."""
    order, T, counts = ORDERS[step]
    which = TURNING if step == "gauss" else slice(None)
    commands = [x for n in counts for x in (("begin", 0, 0), (step, sign * T / n, n))]
    errors = np.zeros(2)
    for phase in (0.0, 1.1, 2.3, 3.1)[: 4 if build == "c" else 2]:
        places = moved(build, commands, state(0, phase))[1::2]
        for place, n in zip(places, counts, strict=True):
            assert (place.status, place.h) == (0, sign * T / n)
        errors += [off(place, sign * T, phase, which) for place in places]
    found = log(errors[0] / errors[1]) / log(counts[1] / counts[0])
    assert order - (2 if step == "gauss" else 0.3) < found < order + (3 if step == "gauss" else 0.5)
    assert errors[1] > 5e-13  # above rounding, so that this is the order


DENSE = {"gauss": (8, (0.8, 0.6)), "vern9": (9, (0.7, 0.5))}
DENSE |= {"rk4": (3, (0.1, 0.05)), "discrete": (4, (0.1, 0.05))}
"""Step → the order of a state within it, and two sizes."""


@each_step
def test_within_a_step(build, step):
    """The error is like h to the order and 1; at both ends it is the state there; before the first
    step there is but the first state."""
    order, sizes = DENSE[step]
    worst = []
    for h in sizes:
        times = [part * h for part in (0.1, 0.35, 0.6, 0.85, 1.0)]
        commands = [("dense", 0, 0), (step, h, 1), *(("dense", t, 0) for t in (0.0, *times))]
        first, end, start, *places = moved(build, commands)
        assert np.array_equal(first.x, state(0))
        assert np.abs(start.x - state(0)).max() < 1e-13
        # but for what takes a state to the group
        assert np.abs(places[-1].x - end.x).max() < max(1e-13, 0.05 * off(end, h))
        worst.append(max(off(place, t) for place, t in zip(places, times, strict=True)))
    found = log(worst[0] / worst[1]) / log(sizes[0] / sizes[1])
    assert order + 1 - 0.9 < found < order + 1 + 1.2, worst


@pytest.mark.parametrize(("build", "step"), [x for x in EACH if x[1] in ("gauss", "discrete")])
def test_a_symmetric_step_goes_back(build, step):
    there, back = moved(build, [(step, 0.05, 40), (step, -0.05, 40)])
    assert np.abs(there.x - state(0)).max() > 1
    assert np.abs(back.x - state(0)).max() < 1e-12
    assert back.t == 0


COUNTED = {"vern9": (16, 16), "rk4": (4, 4), "discrete": (0, 0), "gauss": (16, 64)}
"""Step → between which numbers the evaluations of the rates for each are."""


@each_step
def test_how_often_a_step_asks_for_the_rates(build, step):
    """Gauss's for as many sweeps of 8 stages as it takes, fewer of short steps."""
    (first, rest) = moved(build, [(step, 0.05, 10), (step, 0.05, 20)])
    least, most = COUNTED[step]
    assert 10 * least <= first.evaluations <= 10 * most
    assert 20 * least <= rest.evaluations - first.evaluations <= 20 * most


# ---------------------------------------------------------------- languages

ALIKE = [(step, 0.02, 20) for step in STEPS] + [("dense", 1.593, 0), ("vern9", -0.1, 3)]
ALIKE += [("dense", 1.42, 0), ("rk4", 0.01, 5), ("dense", 1.347, 0), ("begin", 0, 0)]
ALIKE += [*to("vern9", 2.0, 1e-8, 16), ("dense", 1.99, 0), *to("gauss", 2.5, 1e-13, 8)]
"""The last one in C ends its iterations where they are exact enough, elsewhere at rounding."""
FEWER = [(word, t, min(n, 3)) if word in STEPS else (word, t, n) for word, t, n in ALIKE[:4]]
FEWER += [("dense", 0.225, 0), ("gauss_to", 0.3, 1e-9), ("begin", 0, 0), *to("vern9", 0.3, 1e-8, 2)]


@pytest.mark.parametrize("build", [*BUILDS[1:], READ])
def test_the_steps_are_those_of_c(build):
    """One method after the other, all the motion itself up to their errors; also the sizes of steps
    that a tolerance chooses, and the events where they stop."""
    commands = FEWER if build == READ else ALIKE
    for a, b, (word, t, _) in zip(
        moved(build, commands), moved("c", commands), commands, strict=True
    ):
        assert (a.status, a.t) == (b.status, pytest.approx(b.t, abs=1e-12 if b.status else 1e-15))
        assert b.status in (0, AT_EVENT)
        assert build != READ or a.evaluations == b.evaluations
        assert not b.status or (a.event, a.rising) == (b.event, b.rising)
        own = 1e-11 if word.endswith("_to") or b.t >= 2 else 1e-13  # steps have sizes of their own
        assert np.abs(a.x - b.x).max() < own * np.abs(b.x).max()
        # h goes with a root of an estimated error, of which rounding is a part
        assert word == "gauss_to" or b.status or abs(a.h - b.h) <= 1e-3 * abs(b.h)
        assert off(b, t if word == "dense" else b.t) < 1e-5


FLAGS = {"plain": ("-O0",), "loops": ("-O3", "-march=native", "-Dthrown_LANES=1")}
FLAGS |= {"four": ("-O3", "-march=native", "-Dthrown_LANES=4"), "two": ("-O2",)}
FLAGS |= {"native": ("-O3", "-march=native")}
FLAGS |= {"widest": (*FLAGS["native"], "-mprefer-vector-width=512", "-ffp-contract=fast")}


@pytest.mark.parametrize("flags", FLAGS)
def test_the_compiler_changes_nothing(flags):
    """In lanes of each width and in loops; vector registers as wide as there are: an SLP pass once
    made errors of a pair wrong."""
    found, same = (moved("c", ALIKE, flags=x) for x in (FLAGS[flags], ()))
    for a, b, (word, *_) in zip(found, same, ALIKE, strict=True):
        assert (a.status, a.t) == (b.status, pytest.approx(b.t, abs=1e-9))
        assert word == "gauss_to" or abs(a.h - b.h) <= 1e-2 * abs(b.h)
        assert np.abs(a.x - b.x).max() < 1e-8


ALONE = """\
#include "face.c"
#include <stdio.h>
int main(void)
{{
    const double p[] = {{{p}}}, u[] = {{{u}}}, x[] = {{{x}}};
    double k[{name}_SIZE_K], out[9 + {name}_N_STATE];
    const struct {{ const char *word; double a, b; }} each[] = {{{commands}}};
    if (face("constants", 0, 0, p, k, u, x, 0, k)) return 1;
    for (size_t i = 0; i < sizeof each / sizeof *each; ++i) {{
        printf("%d ", face(each[i].word, each[i].a, each[i].b, p, k, u, x, 0, out));
    }}
    return 0;
}}
"""


def test_sanitizers_find_nothing():
    """Addresses and undefined behaviour, in a program with all that there is."""
    need("sanitizers of gcc")
    commands = [("begin", 0, 0), ("torque", 0.5, 2), ("dense", 0, 0), *ALIKE]
    commands += [("discrete", 1e4, 1), ("gauss", 9.0, 1), ("dense", 3, 0), ("rk4_watch", 9, 0.1)]
    name, texts = emission(TEXT, ("c",), **ALL)
    arrays = {"p": PARAMETERS, "u": PUSH, "x": state(0)}
    given = {a: ", ".join(map(repr, map(float, values))) for a, values in arrays.items()}
    listed = ", ".join(f'{{"{word}", {a}, {b}}}' for word, a, b in commands)
    known = Native("c", name, texts)
    main = ALONE.format(name=name, commands=listed, **given)
    flags = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    words = ("gcc", "-std=c99", "-O1", "-g1", *flags, "main.c", f"{name}.c", "-o", "out", "-lm")
    made = texts | {"face.c": known.source("_steps.h", faces.in_c, f"{name}_")[0], "main.c": main}
    done = subprocess.run([built([words], made)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    told = [*map(int, done.stdout.split())]
    first = 3 + len(ALIKE)
    assert (told[first], {*told[:first]} | {*told[first + 1 :]}) == (NO_SOLUTION, {0, AT_EVENT})


# ---------------------------------------------------------------- steps of their own size


@pytest.mark.parametrize("tol", [1e-6, 1e-9, 1e-12])
@each_adaptive
def test_a_tolerance_is_kept(build, step, tol):
    """The error is of the size that was asked for, at the time itself; and back."""
    commands = [*to(step, 5.0, tol), *to(step, 0.0, tol)]
    places = moved(build, commands)
    end, back = places[len(places) // 2 - 1], places[-1]
    assert (end.status, end.t, back.status, back.t) == (0, 5, 0, 0)
    assert off(end, 5.0) < 20 * tol * np.abs(state(5)).max()
    assert off(end, 5.0) > tol / 1e6 or tol < 1e-11
    assert off(back, 0.0) < 40 * tol * np.abs(state(5)).max()


START = [*np.eye(3).ravel(), 0.6, 0.4, 1.1]
SIZES = {"gauss": (16, 0.6), "vern9": (9, 0.25)}
"""The order of an error, and a step that is not too coarse and not exact."""
BEFORE = 5.0
"""When a step is as long as is wanted, or longer, after many of a larger tolerance."""


def spun(build, commands):
    """The places of a free symmetric top, whose steps of one size all have one error."""
    moments = {"m": 1.0, "J_11": 1.0, "J_22": 1.0}
    p = [moments.get(x, 0.0) for x in module_of("so3", step=ADAPTIVE).PARAMETERS]
    return library(build, "so3", step=ADAPTIVE).follow(commands, START, p, [0] * 3)


def boundary(below, low, high):
    """Where, between two numbers, what is so below is so no more, to a thousandth; ``below`` says
    it of several numbers at once."""
    while high > 1.001 * low:
        asked = low * (high / low) ** (np.arange(11) / 10)
        k = 1 + sum(below(asked[1:-1]))
        low, high = asked[k - 1], asked[k]
    return (low * high) ** 0.5


@each_adaptive
def test_the_next_step_is_as_long_as_the_tolerance_says(build, step):
    """It is to the last as the tolerance to the error, to the power of one over the order."""
    order, h = SIZES[step]

    def last(runs):
        """The last step of each run: to h at a tolerance, then on."""
        calls = []
        for tol, *more in runs:
            times = [(BEFORE, 1e-3), *((BEFORE + t, tol) for t in (h, *more))]
            calls += [("begin", 0, 0), *((f"{step}_to", *x) for x in times)]
        places = spun(build, calls)
        each = len(calls) // len(runs)
        return np.array([place.h for place in places[each - 1 :: each]])

    def following(tol):
        """The longest step that is made at once after h."""

        def at_once(more):
            return abs(last([(tol, h + x) for x in more]) - more) < 1e-9

        return boundary(at_once, 0.7 * h, 1.3 * h)

    error = boundary(lambda tols: abs(last([(x,) for x in tols]) - h) > 1e-9, 1e-14, 1e-2)
    sizes = {part: following(part * error) for part in (1.1, 2.2)}
    for part, size in sizes.items():
        assert size / h == pytest.approx(0.9 * part ** (1 / order), rel=4e-3)
    assert log(sizes[2.2] / sizes[1.1]) / log(2) == pytest.approx(1 / order, rel=0.1)


@each_adaptive
def test_steps_that_are_too_long_are_shortened_alike(build, step):
    """The first is a tenth of the size over the speed, later ones are far too long for the
    tolerance of the second call: what is left for the last step tells how much each was made
    shorter, and the evaluations how often one was tried."""
    calls = [(f"{step}_to", 5, 1e-4), (f"{step}_to", 6.3, 1e-12)]
    places, others = spun(build, calls), spun("c", calls)
    for a, b in zip(places, others, strict=True):
        assert (a.status, a.t, a.h) == (b.status, b.t, pytest.approx(b.h, rel=1e-3))
        assert a.evaluations == b.evaluations
    first, second = others
    assert second.evaluations - first.evaluations <= {"gauss": 480, "vern9": 200}[step]


# ---------------------------------------------------------------- coarse steps, and ends

LINE = """
name = "line"
group = { name = "Line", action = "affine", basis = [[[0, 0, 1], [0, 0, 0], [0, 0, 0]]] }
[parameters]
a = 1.0
b = 0.0
c = 0.0
[[point]]
mass = 1
at = [0, 0]
[[potential]]
kind = "expression"
U = "-a/sqrt(r1_x^2) - b*r1_x^4/4 + c*(r1_x - 1 - sin(t)/2)^2/2"
"""


def on_a_line(build, commands, p, at, speed, **options):
    """The places of a point on a line that falls to a centre, goes off, or hangs on a spring."""
    made = library(build, LINE, step=STEPS[:3], **options)
    return made.follow(commands, (1.0, 0.0, 0.0, 1.0, at, 0.0, speed), p)


def test_stages_by_newtons_method_are_those_of_c():
    """In Julia, whose arrays have their indices the other way round."""
    commands = [("gauss", 0.05, 2), ("dense", 0.07, 0), ("gauss_to", 0.16, 1e-9)]
    found, known = (
        on_a_line(x, commands, (0, 0, 1e6), 1.0, 0.5, jacobian="raw") for x in (READ, "c")
    )
    for a, b in zip(found, known, strict=True):
        assert (a.status, a.evaluations) == (b.status, b.evaluations) != (0, 0)
        assert np.abs(a.x - b.x).max() < 1e-13


@each_build
def test_a_stiff_spring_by_newtons_method(build):
    """In steps of 0.05 s, some 50 rad of the spring, none of them made in halves: the point goes
    with the end that is moved, c/(c - 1) as far."""
    c = 1e6
    far = c / (c - 1) / 2
    commands = [("gauss", 0.05, 40), ("dense", 1.97, 0), ("begin", 0, 0), ("gauss_to", 2.0, 1e-9)]
    places = on_a_line(build, commands, (0, 0, c), 1.0, far, jacobian="raw")
    assert (places[0].status, places[0].h, places[-1].status) == (0, 0.05, 0)
    for place, t in zip(places[:2] + places[3:], (2.0, 1.97, 2.0), strict=True):
        assert abs(place.x[4] - 1 - far * np.sin(t)) < 1e-10
    assert abs(places[0].x[6] - far * np.cos(2)) < 1e-7


ENDS = {"collision": ((1, 0, 0), 0.0, pi / sqrt(8))}
ENDS |= {"infinity": ((0, 1, 0), sqrt(0.5), sqrt(2))}
"""Of a point that falls to a centre from 1, or goes off, as 1/(1 - t/√2): parameters, its speed at
first, and the time of its end."""
TO_AN_END = {"gauss_to": 1e-9, "vern9_to": 1e-9, "vern9": 1000, "rk4": 1000}
ENDED = [(end, x) for end in ENDS for x in TO_AN_END if end == "infinity" or x.endswith("_to")]
"""Steps of one size leap over a centre."""


@pytest.mark.parametrize(("end", "word"), ENDED)
@each_build
def test_the_end_of_a_motion_is_told(build, word, end):
    """Steps become too short or rates infinite: the last good state is kept, by another try too."""
    (p, speed, time), adaptive = ENDS[end], word.endswith("_to")
    command = (word, 9.0 if adaptive else 0.01, TO_AN_END[word])
    for place in on_a_line(build, [command, command], p, 1.0, speed, jacobian="raw"):
        assert place.status in ((NOT_FINITE, NOT_CONVERGED) if adaptive else (NOT_FINITE,))
        assert np.isfinite(place.x).all()
        assert abs(place.t - time) < (1e-4 if adaptive else 0.2)


@each_build
def test_a_coarse_step_is_made_in_halves(build):
    """One whose iteration does not converge: the motion is the same but for the error."""
    (halved,) = moved(build, [("gauss", 6.0, 1)])
    assert halved.status == 0
    assert abs(halved.h) < 6
    assert off(halved, 6.0) < 1e-2


# ---------------------------------------------------------------- what is told


@each_build
def test_what_is_no_number_is_told_and_a_motion_goes_on(build):
    """In a size, a time, a state: nothing moves; a tolerance that is no number is the least one."""
    bad = [(step, NAN, 1) for step in STEPS]
    bad += [(f"{step}_to", t, 1e-9) for step in ADAPTIVE for t in (NAN, INFINITE, -INFINITE)]
    good = [*to("gauss", 0.5, NAN, 3), *to("vern9", 1.0, 0.0, 5)]
    places = moved(build, bad + good)
    for place, (word, *_) in zip(places[: len(bad)], bad, strict=True):
        assert place.status in {"gauss": (2, 3), "discrete": (5,)}.get(word, (2,)), word
        assert (place.t, place.x.tolist()) == (0, state(0).tolist())
    first, second = places[len(bad) + 3], places[-1]
    assert (first.t, second.t) == (0.5, 1.0)
    assert off(first, 0.5) + off(second, 1.0) < 1e-12
    commands = [(step, 0.1, 1) for step in STEPS[:3]] + [(f"{x}_to", 1.0, 1e-9) for x in ADAPTIVE]
    for place in moved(build, commands, [*state(0)[:-1], NAN]):
        assert (place.status, place.t) == (NOT_FINITE, 0)


@each_build
def test_a_step_without_solution_is_told(build):
    """A ball turns by at most 1 rad h |ζ|: a longer step leaves the motion as it was."""
    ball = (0.25, 0.25, 0.25, 0, 0)
    x = [*np.eye(3).ravel(), 0, 0, 0, 0.6, 0, 0.8, 0, 0, 0]
    commands = [("discrete", 0.99, 1), ("discrete", 1e3, 3), ("discrete", NAN, 1)]
    commands += [("discrete", -0.5, 2)]
    good, *bad, back = moved(build, commands, x, ball, (0, 0, 0))
    assert (good.status, back.status, back.h) == (0, 0, -0.5)
    for place in bad:
        assert place.status == NO_SOLUTION
        assert (place.t, place.h, place.x.tolist()) == (good.t, good.h, good.x.tolist())


# ---------------------------------------------------------------- what is kept

FREE, STILL = (*PARAMETERS[:3], 0.0, 0.0), (0, 0, 0)
"""Without any force: energy and momenta are kept."""
KEPT = {"gauss": (0.1, 1e-13, 1e-12), "discrete": (0.02, 1e-13, 1e-3)}
KEPT |= {"vern9": (0.1, 1e-13, 1e-9), "rk4": (0.02, 1e-13, 1e-4)}
"""Step → a size, what is left of the group, and what of energy and momentum, after many steps."""


@each_step
def test_what_is_kept_over_many_steps(build, step):
    """The group to rounding by all; energy and the momentum about the centre by the order of a
    step, or to rounding."""
    code = module_of(TEXT, **ALL)
    x, k = state(0), code.constants(np.array(FREE))
    h, group, most = KEPT[step]
    n = 400 if build == "python" else 4000
    places = moved(build, [(step, h, n)] * 5, x, FREE, STILL)
    for place in places:
        assert place.status == 0
        assert code.defect(place.x) < group
        assert abs(code.energy(0.0, place.x, k) / code.energy(0.0, x, k) - 1) < most
        spins = [y[:9].reshape(3, 3) @ (thrown.MOMENTS * y[12:15]) for y in (x, place.x)]
        assert np.abs(spins[0] - spins[1]).max() < (most if step != "discrete" else 1e-11)
    assert min(np.abs(a.x - b.x)[12:15].max() for a, b in pairwise(places)) > 1e-3


TOP = {"m": 1.0, "J_11": 1.3, "J_12": 0.1, "J_13": 0.05, "J_22": 0.9, "J_23": -0.07, "J_33": 0.4}
TOP |= {"c_1": 0.2, "c_2": 0.0, "c_3": 0.3, "g_1": 0.0, "g_2": 0.0, "g_3": -1.0}
SPUN = {"A_11": 1.0, "A_22": 1.0, "A_33": 1.0, "q_0": 1.0, "zeta_1": 2.7, "zeta_2": 1.2}
SPUN |= {"zeta_3": 3.3, "w_1": 1.5, "w_2": 0.9, "w_3": -1.2}
QUATERNION, TANGENT = {"attitude": "quaternion"}, {"velocity": "tangent"}
BY_GAUSS = [
    ("so3", {}, {"energy", "angular_momentum"}, True),
    ("so3", {"layout": "col"}, {"energy", "angular_momentum"}, True),
    ("so3", QUATERNION, set(), True),
    ("so3", TANGENT, set(), False),
    ("kirchhoff", {}, {"energy", "momentum_1", "momentum_2", "momentum_3"}, True),
    ("se3", QUATERNION, set(), True),
    ("se3", {}, {"energy"}, True),
    ("sl3", {}, set(), False),
    ("sl3", TANGENT, set(), False),
    ("so4", {}, {"energy"}, True),
    ("euler_poisson", {}, {"energy", "casimir_1", "casimir_2"}, True),
    ("comet", {}, set(), True),
]


def kept(name, **options):
    d = derived(name)
    return program(d.problem, d.record, Options(step="gauss", conserved=True, **options)).keeps


@pytest.mark.parametrize(("name", "options", "exact", "group"), BY_GAUSS)
def test_what_gauss_keeps_is_found(name, options, exact, group):
    """A body under gravity in a matrix keeps energy and momentum; free in space its energy and its
    linear momentum, as the angular one is cubic; a quaternion, quartic; det A = 1 is cubic."""
    found = kept(name, **options)
    assert ({*found.exact}, found.group) == (exact, group)
    assert not {*found.exact} & {*found.others}


@pytest.mark.parametrize(
    "steps", [2000, pytest.param(200_000, marks=pytest.mark.dist)], ids=["some", "many"]
)
@pytest.mark.parametrize(
    ("name", "options", "h"),
    [("so3", {}, 0.2), ("so3", QUATERNION, 0.5), ("kirchhoff", {}, 0.2), ("sl3", {}, 0.1)],
)
def test_so_it_is_over_coarse_steps(name, options, h, steps):
    """To rounding, which adds up as by chance, and no other integral."""
    chosen = {"step": "gauss", "conserved": True, **options}
    code, made = module_of(name, **chosen), library("javascript", name, **chosen)
    p = np.array([TOP.get(x, code.DEFAULTS.get(x)) for x in code.PARAMETERS])
    x, k = np.array([SPUN.get(y, 0.0) for y in code.STATE]), code.constants(p)
    if name == "sl3":
        x[9:] = [0.3, -0.2, 0.1, 0.4, 0.2, -0.3, 0.1, 0.2]
    places = made.follow([("gauss", h, steps // 20)] * 20, x, p, [0] * len(code.INPUTS))
    assert {place.h for place in places} == {h}  # none was made in halves
    first = code.conserved(0.0, x, k)
    found = np.max([np.abs(code.conserved(y.t, y.x, k) - first) for y in places], axis=0)
    each = dict(zip(code.CONSERVED, found / np.abs(first).max(), strict=True))
    known, rounding = kept(name, **options), 1e-13 * max(1, steps / 1e4)
    print(f"{name}, {steps} steps: {each}")
    assert all(each[x] < rounding for x in known.exact), each
    assert name == "sl3" or all(each[x] > 1e-14 for x in known.others), each
    assert max(each.values()) < (1e-2 if known.others else rounding)
    assert max(code.defect(y.x) for y in places) < 1e-14


def test_the_files_say_what_is_kept():
    files = emission("kirchhoff", ("c", "python", "javascript"), step="gauss", conserved=True)[1]
    for name in ("kirchhoff_steps.h", "kirchhoff.py", "kirchhoff.mjs"):
        words = " ".join(files[name].replace("*", " ").split())
        assert "keeps the group, energy, momentum_1, momentum_2, momentum_3 to rounding" in words


# ---------------------------------------------------------------- inputs


@pytest.mark.parametrize("build", [x for x in BUILDS if x != "rust2021"])
def test_inputs_as_a_function_of_time(build):
    """A torque that changes within a step: against SciPy."""
    x, code = np.array([*np.eye(3).ravel(), 0.1, 0, 9]), module_of("so3", step=ADAPTIVE)
    p = [TOP[y] for y in code.PARAMETERS]
    k = code.constants(np.array(p))
    calls = [("torque", 2, 3), ("gauss_to", 1, 1e-12), ("vern9_to", 2, 1e-12)]
    *_, end = library(build, "so3", step=ADAPTIVE).follow(calls, x, p, [0] * 3)
    field = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}

    def rates(t, x):
        return code.rhs(t, x, k, [2 * np.cos(3 * t), 0, 0])

    assert end.status == 0
    assert np.abs(end.x - solve_ivp(rates, (0, 2), x, **field).y[:, -1]).max() < 1e-9


@pytest.mark.parametrize("build", [x for x in BUILDS if x != "rust2021"])
def test_events_of_inputs_as_a_function_of_time(build):
    """sin 3t − F_1 vanishes where F_1 = cos 2t is that."""
    when = brentq(lambda t: np.sin(3 * t) - np.cos(2 * t), 0.1, 0.5, xtol=1e-15)
    places = moved(build, [("torque", 1, 2), *to("vern9", 0.6, 1e-9, 4)])
    assert min(abs(place.t - when) for place in places if place.status == AT_EVENT) < 1e-12


# ---------------------------------------------------------------- events

FALL = 2 / (thrown.GRAVITY - PUSH[2] / thrown.MASS)
HALF, FALLEN = sqrt(1.5 * FALL), sqrt(3 * FALL)
TURNED = brentq(lambda t: state(t)[1] - 0.2, 0.1, 0.4, xtol=1e-15)
PULLED = asin(PUSH[0]) / 3
FORTH = [("pulled", PULLED, True), ("turned", TURNED, True), ("half", HALF, False)]
FORTH += [("also", HALF, True), ("ground", FALLEN, False), ("pulled", pi / 3 - PULLED, False)]
BACK = [("pulled", pi / 3 - PULLED, True), ("ground", FALLEN, True), ("up", HALF, True)]
BACK += [("turned", TURNED, False), ("pulled", PULLED, False)]
"""Event, when, and is it reached from below? up to t = 1 and back."""
LISTED = ("ground", "half", "also", "up", "pulled", "turned", "never")
OFF = {"gauss": 1e-12, "vern9": 1e-12, "rk4": 1e-5, "discrete": 1e-4}


def zero(name, place):
    """What becomes 0 at an event."""
    T, force = place.x[11], PUSH[0]
    height = {"ground": T, "half": T - 1.5, "also": 1.5 - T, "up": T - 1.5}
    return height | {"pulled": np.sin(3 * place.t) - force, "turned": place.x[1] - 0.2}


def hold(places, expected, within, rounding=1e-13):
    """The events that calls returned are those that were expected."""
    found = [x for x in places if x.status == AT_EVENT]
    assert [LISTED[x.event] for x in found] == [name for name, *_ in expected]
    for place, (name, t, rising) in zip(found, expected, strict=True):
        assert abs(place.t - t) < within, name
        assert place.rising == rising, name
        assert abs(zero(name, place)[name]) < rounding, name


@each_adaptive
def test_events_in_steps_of_their_own_size(build, step):
    """Two at one time, some in one step, some of the time and an input alone; then back."""
    places = moved(build, to(step, 1.0, 1e-13, 7) + to(step, 0.0, 1e-13, 6))
    assert [x.status for x in places] == [4] * 6 + [0] * 2 + [4] * 5 + [0] * 2
    hold(places[:8], FORTH, 1e-12)
    hold(places[8:], BACK, 1e-12)
    assert (places[7].t, places[-1].t) == (1.0, 0.0)
    assert np.abs(places[-1].x - state(0)).max() < 1e-11


@each_step
def test_events_in_steps_of_one_size(build, step):
    """At the zeros of the motion that they make, which is the same as without a watch, to a time
    between the ends of steps and then to the end of one."""
    h = 0.07
    calls = [(f"{step}_watch", t, h) for t in (8 * h, 15 * h) for _ in range(8)]
    places = moved(build, calls)
    hold(places, FORTH, OFF[step])
    for place, end in zip(places[7::8], moved(build, [(step, h, 8), (step, h, 7)]), strict=True):
        assert (place.status, place.t) == (0, end.t)
        same = 0 if step in ("rk4", "vern9") else 1e-13
        assert np.abs(place.x - end.x).max() <= same * np.abs(end.x).max()


@each_step
def test_backwards_to_a_shorter_last_step(build, step):
    calls = [(step, 0.07, 14), *[(f"{step}_watch", 0.3, 0.08)] * 5]
    _, *places = moved(build, calls)
    assert [x.status for x in places] == [4, 4, 4, 0, 0]
    hold(places, BACK[:3], OFF[step])
    assert places[4].t == pytest.approx(0.3, rel=0, abs=1e-15)
    assert places[4].h == pytest.approx(-0.04, rel=1e-9)


@each_adaptive
def test_where_it_starts_nothing_happens_and_an_end_is_seen_once(build, step):
    """A start at an event, an end at one, and a time that is an instant of calls."""
    start, u = [*np.eye(3).ravel(), 0, 0, 1.5, *[0] * 6], (2, 0, 0)
    lands = sqrt(3 / thrown.GRAVITY)  # from half, where it is at rest
    calls = [(f"{step}_to", t, 1e-13) for t in (lands / 2, lands + 1e-3, lands + 1e-3, 0.6)]
    places = moved(build, calls, start, u=u)
    assert [place.status for place in places] == [0, AT_EVENT, 0, 0]
    assert LISTED[places[1].event] == "ground"
    assert abs(places[1].t - lands) < 1e-12


NO_STEPS = [(1.0, 0.0), (INFINITE, 0.1), (1.0, INFINITE)]


@each_build
def test_a_step_that_is_made_in_halves_is_watched_whole(build):
    """So coarse that the iteration of gauss does not converge, of a body that spins high above."""
    calls = [("gauss_watch", 2.0, 1.0)] * 12 + [("begin", 0, 0), ("gauss", 1.0, 2)]
    calls += [("begin", 0, 0), *[("rk4_watch", *x) for x in NO_STEPS]]
    x, u = [*np.eye(3).ravel(), 0, 0, 1e3, 0, 0, 9.0, 0, 0, 0], (2, 0, 0)
    *places, _, end, _, first, second, third = moved(build, calls, x, u=u)
    found = [place.t for place in places if place.status == AT_EVENT]
    exact = [(2 * pi * k + x) / 9 for k in range(3) for x in (pi + asin(0.2), -asin(0.2) + 2 * pi)]
    assert found == pytest.approx(exact[:5], rel=0, abs=1e-10)  # the error of such halves
    assert abs(end.h) < 1
    assert (places[5].status, places[5].t) == (0, 2.0)
    assert np.abs(places[5].x - end.x).max() < 1e-6  # not of the same parts
    assert [(x.status, x.t) for x in (first, second, third)] == [(2, 0)] * 3


@each_build
def test_from_an_event_other_steps_go_on(build):
    """The end of the step in which it was is forgotten; n steps do not stop and are no event."""
    calls = [("rk4_watch", 1.0, 0.5), ("rk4", 1e-3, 1), ("rk4_watch", 0.16, 0.01)]
    calls += [("gauss", 0.1, 5), ("gauss_to", 1.0, 1e-9)]
    first, on, then, beyond, last = moved(build, calls)
    assert [x.status for x in (first, on, then, beyond, last)] == [4, 0, 0, 0, 4]
    assert on.t == pytest.approx(first.t + 1e-3, rel=0, abs=1e-15)
    assert then.t == pytest.approx(0.16, rel=0, abs=1e-15)
    assert LISTED[last.event] == "ground"


@each_build
def test_rk4_alone_in_floats(build):
    """Without what steps of their own size need; as exact as numbers of 32 bits are, in C without a
    double."""
    flags = ("-O2", "-Wdouble-promotion", "-Wconversion", "-fsingle-precision-constant")
    made = library(build, TEXT, flags if build == "c" else (), step="rk4", real="float")
    calls = [("rk4", 0.02, 50), ("dense", 0.99, 0), ("begin", 0, 0)]
    calls += [("rk4_watch", 1.0, 1 / 64)] * 8
    end, within, _, *places = made.follow(calls, np.float32(state(0)), PARAMETERS, PUSH)
    for place, t in ((end, 1.0), (within, 0.99)):
        assert np.abs(place.x - state(t)).max() < 2e-5
    assert [place.status for place in places] == [4] * 6 + [0] * 2
    hold(places, FORTH, 1e-5, 2e-6)


FORMS_OF_EVENTS = [{}, {"layout": "col"}, QUATERNION, TANGENT]


@pytest.mark.parametrize("options", FORMS_OF_EVENTS)
def test_every_form_of_the_state_has_the_same_events(options):
    """By the names of matrices and velocities in the body, whatever the state is; against SciPy."""
    text = TEXT + '[[event]]\nname = "spin"\nwhen = "zeta_2*A_11 - w_1 - 1/2"\n'
    code = module_of(text, step="gauss", **options)
    start = {"T_3": 3.0, "q_0": 1.0, "zeta_2": 2.0, "w_1": 1.0, "A_13_dot": 2.0, "A_31_dot": -2.0}
    start |= {"A_11": 1.0, "A_22": 1.0, "A_33": 1.0, "T_1_dot": 1.0}
    x = np.array([start.get(name, 0.0) for name in code.STATE])
    m, k, found = code.begin(0.0, x), code.constants(PARAMETERS), []
    while code.gauss_to(m, k, PUSH, 1.0, 1e-13) == code.EVENT:
        found.append((code.EVENTS[m.event], m.t))
    values = [lambda t, x, e=e: code.events(t, x, k, PUSH)[e] for e in range(len(code.EVENTS))]
    field = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-13, "events": values}
    run = solve_ivp(lambda t, x: code.rhs(t, x, k, PUSH), (0, 1), x, **field)
    exact = dict(zip(code.EVENTS, map(list, run.t_events), strict=True))
    for name in ("spin", "ground", "pulled", "turned"):
        times = [t for other, t in found if other == name]
        assert times == pytest.approx(exact[name], rel=0, abs=1e-11), name
    assert "spin" in dict(found)


# ---------------------------------------------------------------- forms of the state

FORMS = {
    "so3": {},
    "so3 quaternion": QUATERNION,
    "so3 principal": {"frame": "principal"},
    "se3": {},
    "se3 columns": {"layout": "col"},
    "sl3 tangent": TANGENT,
    "kirchhoff conserved": {"conserved": True},
    **{name: {} for name in ("so4", "sp4", "heisenberg", "two_tops", "comet", "gyrostat")},
    **{name: {} for name in ("top", "riemann_ellipsoid", "zeitlin", "euler_poisson")},
}
DISCRETE = ("so3", "se3", "sl3", "saff3", "gl3", "so4", "heisenberg", "screw", "sim3", "sp4")
DISCRETE += ("pushed SO(3)", "pushed SL(3)", "pushed GL(3)", "pushed SE(3)")
CASES = [(name, step) for name in FORMS for step in ADAPTIVE]
CASES += [(name, "discrete") for name in DISCRETE]
WRITTEN = [(*x, y) for x in CASES for y in BUILDS[: 2 if "principal" in x[0] else 4]]


def near_one(code):
    """Parameters of a body, small inputs, and a state near 1 that moves, on the group."""
    rng = np.random.default_rng(5)
    moments = {"m": 2, "J_11": 1.5, "J_12": 0.1, "J_22": 1.3, "J_23": 0.05, "J_33": 1.1}
    known = moments | {"c_1": 0.1, "c_2": 0.2, "c_3": 0.3, "J_13": 0.0}
    defaults = {x: v for x, v in code.DEFAULTS.items() if v is not None}
    p = [known.get(x, defaults.get(x, 0.7)) for x in code.PARAMETERS]
    still = [x[0] in "ATq" for x in code.STATE]
    x = np.where(still, 0.0, 0.2 * rng.normal(size=len(still)))
    ones = [k for k, s in enumerate(code.STATE) if s == "q_0" or (s[0] == "A" and s[-1] == s[-2])]
    x[ones] = 1
    if "mu" in code.PARAMETERS:
        x[code.STATE.index("T_1")] = 2  # away from the centre of attraction
    if any(s.endswith("_dot") for s in code.STATE):
        x[len(x) // 2 :] = [0.1, 0.2, 0, -0.1, 0.05, 0.1, 0.2, 0, -0.15]
    return np.array(p), 0.1 * rng.normal(size=len(code.INPUTS)), x


@pytest.mark.parametrize(("name", "step", "build"), WRITTEN, ids=str)
def test_every_form_moves_alike_and_goes_back(name, step, build):
    """C as SciPy says, other languages as C."""
    problem = driven(name[7:], 0) if name.startswith("pushed") else name.split()[0]
    options = {"step": step} | ({"order": 4} if step == "discrete" else FORMS[name])
    code = module_of(problem, **options)
    p, u, x = near_one(code)
    commands = [(step, 0.02, 20), ("dense", 0.393, 0), (step, -0.02, 20)]
    commands += [(f"{step}_to", 0.3, 1e-12), (f"{step}_to", 0.0, 1e-12)] * (step != "discrete")
    places = library(build, problem, **options).follow(commands, x, p, u)
    size = max(1.0, np.abs(x).max())
    assert [place.status for place in places] == [0] * len(commands)
    assert np.abs(places[0].x - x).max() > 1e-3
    for place in places[2::2]:
        assert np.abs(place.x - x).max() < (1e-6 if step == "vern9" else 1e-12) * size
    if build == "c":
        k = code.constants(p)
        exact = solve_ivp(
            lambda t, x: code.rhs(t, x, k, *([u] if len(u) else [])), (0, 0.4), x,
            method="DOP853", rtol=1e-12, atol=1e-13, t_eval=[0.393, 0.4],
        ).y.T  # fmt: skip
        close = 1e-6 if step == "discrete" else 1e-9
        for place, wanted in zip(places[1::-1], exact, strict=True):
            assert np.abs(place.x - wanted).max() < close * max(1, np.abs(wanted).max())
        return
    for place, same in zip(
        places, library("c", problem, **options).follow(commands, x, p, u), strict=True
    ):
        assert abs(place.t - same.t) < 1e-15
        assert np.abs(place.x - same.x).max() < 1e-12 * np.abs(same.x).max()


@pytest.mark.parametrize("compiler", ["gcc -std=c99", "g++ -std=c++17", "clang -std=c99"])
@pytest.mark.parametrize("function", ["sqrt", "fabs"])
def test_it_compiles_strictly_for_this_machine(compiler, function):
    """With the square roots of lanes, of springs: headers of GCC 12 warn of their own."""
    need(compiler.split()[0])
    problem = FALLING.replace("r1_x^2", "1 + r1_x^2") if function == "sqrt" else FALLING
    _, texts = emission(problem, ("c",), step="gauss")
    assert f"line_{function}_lanes(" in texts["line_steps.h"]
    source = "all.cpp" if compiler.startswith("g++") else "all.c"
    texts[source] = (
        '#include "line_steps.h"\n#include "line_steps.h"\n'
        "int go(line_motion *m, const double *k, const double *u);\n"
        "int go(line_motion *m, const double *k, const double *u)\n"
        "{ return line_gauss_to(m, k, u, 1.0, 1e-9); }\n"
    )
    words = (*compiler.split(), "-O3", "-march=native", *STRICT, "-c", source, "-o", "out")
    built([words], texts)


# ---------------------------------------------------------------- the compiled C


@pytest.fixture(scope="module")
def top():
    need("cc")
    return derive.compile("so3", step=ADAPTIVE, flags=("-O1", *SHARED))


HEAVY = np.array([*np.eye(3).ravel(), 0.1, 0, 9])


def test_wrong_words(top):
    m = top.begin(HEAVY)
    with pytest.raises(ValueError, match="no step 'euler' was compiled; there is gauss, vern9"):
        m.move(0.1, step="euler")
    for h, n in ((np.nan, 1), (np.inf, 1), (0.1, -1)):
        with pytest.raises(ValueError, match=f"n = {n}, h = {h}"):
            m.move(h, n)
    for tol in (0, -1.0, np.nan):
        with pytest.raises(ValueError, match="tol must be positive"):
            m.move_to(1.0, tol)
    with pytest.raises(ValueError, match="a state of 12 numbers"):
        top.begin([1.0])
    with pytest.raises(ValueError, match='step="gauss"'):
        derive.compile("so3").begin(HEAVY)


def test_a_start_is_on_the_group(top):
    """Up to what rounding, or some digits in a file, leave of it."""
    x = HEAVY.copy()
    x[0] += 1e-10
    top.begin(x)
    x[4] = 1.1
    with pytest.raises(ValueError, match=r"its defect is 0\.21: project\(x\)"):
        top.begin(x)
    for _ in range(5):
        x = top.project(x)
    assert top.begin(x).move(0.1).t == 0.1
    x[0] = np.nan
    with pytest.raises(ValueError, match="its defect is nan"):
        top.begin(x)


def test_a_motion_that_cannot_go_on_says_so(top):
    m = top.begin([*np.eye(3).ravel(), np.nan, 0, 0])
    for move in (lambda: m.move(0.1), lambda: m.move_to(1.0)):
        with pytest.raises(derive.StepError, match="no finite value at t = 0"):
            move()
    f = derive.compile(derived(FALLING), step="gauss")
    m = f.begin([float(name in ("A_11", "A_22", "T_1")) for name in f.STATE])
    with pytest.raises(derive.StepError, match=r"too short|no finite value"):
        m.move_to(10.0, 1e-9)
    assert np.isfinite(m.x).all()
    assert abs(m.t - np.pi / np.sqrt(8)) < 1e-6


def test_the_compiled_c_tells_events(top):
    f = derive.compile(derived(TEXT), step=ADAPTIVE, flags=("-O1", *SHARED))
    f.u = np.array(PUSH)
    names = [name for name, *_ in FORTH]
    for step in ADAPTIVE:
        m, found = f.begin(state(0)), []
        while m.move_to(1.0, 1e-12, step).event:
            found.append(m.event)
        assert (found, m.t) == (names, 1.0)
        m, again = f.begin(state(0)), []
        while m.watch(1.0, 0.1, step).event:
            again.append((m.event, m.rising))
            if not again[3:]:
                other = copy(m)
        assert again == [(name, rising) for name, _, rising in FORTH]
        assert np.abs(m.x - f.begin(state(0)).move(0.1, 10, step).x).max() < 1e-12
        assert (other.event, other.watch(1.0, 0.1, step).event) == ("half", "also")
    with pytest.raises(ValueError, match="has no"):
        top.begin(HEAVY).watch(1.0, 0.1)
    for t, h in (*NO_STEPS[:2], (1.0, np.nan)):
        with pytest.raises(ValueError, match="the size of a step"):
            m.watch(t, h)
