"""Laws of the emitted steps, in every language: of a body that is thrown, whose motion is known in
closed form, and of points that come to an end."""

import re
import subprocess
from functools import cache
from itertools import pairwise
from math import log, pi, sqrt

import numpy as np
import pytest

from tests.problems import thrown
from tests.problems.thrown import PARAMETERS, PUSH, TEXT, state
from tests.support.emitted import import_python
from tests.support.motions import FLAGS, LANGUAGES, emitted, follow, in_c, in_rust
from tests.support.needs import need

STEPS = ("gauss", "vern9", "rk4", "discrete")
ADAPTIVE = ("gauss", "vern9")
EACH = [(language, step) for language in LANGUAGES for step in STEPS]
NAN, INFINITE = float("nan"), float("inf")
NOT_FINITE, NOT_CONVERGED, NO_SOLUTION = 2, 3, 5


def moved(language, commands, x=None, p=PARAMETERS, u=PUSH, **more):
    """The places of the thrown body after some commands."""
    folder, name = emitted(TEXT, step=STEPS, order=4)
    return follow(language, folder, name, commands, state(0) if x is None else x, p, u, **more)


TURNING = [*range(9), *range(12, 15)]


def off(place, t, phase=0.0, which=slice(None)):
    """How far the body is from where it should be at a time, in some numbers of its state."""
    return np.abs(place.x - state(t, phase))[which].max()


# ---------------------------------------------------------------- orders

ORDERS = {"gauss": (16, 12.0, (4, 6)), "vern9": (9, 4.0, (8, 12))}
ORDERS |= {"rk4": (4, 4.0, (60, 120)), "discrete": (4, 4.0, (40, 80))}
"""Step → its order, a time, and how many steps lead there with errors that tell the order."""


@pytest.mark.parametrize(("language", "step"), EACH)
@pytest.mark.parametrize("sign", [1, -1], ids=["forward", "back"])
def test_the_error_falls_with_the_order(language, step, sign):
    """In several phases of the motion; of order 16 as it turns, the rest is soon exact."""
    order, T, counts = ORDERS[step]
    which = TURNING if step == "gauss" else slice(None)
    commands = [x for n in counts for x in (("begin", 0, 0), (step, sign * T / n, n))]
    errors = np.zeros(2)
    for phase in (0.0, 1.1, 2.3, 3.1)[: 4 if language == "c" else 2]:
        places = moved(language, commands, state(0, phase))[1::2]
        for place, n in zip(places, counts, strict=True):
            assert (place.status, place.h) == (0, sign * T / n)
        errors += [off(place, sign * T, phase, which) for place in places]
    found = log(errors[0] / errors[1]) / log(counts[1] / counts[0])
    assert order - (2 if step == "gauss" else 0.3) < found < order + (3 if step == "gauss" else 0.5)
    assert errors[1] > 5e-13  # above rounding, so that this is the order


DENSE = {"gauss": (8, (0.8, 0.6)), "vern9": (9, (0.7, 0.5))}
DENSE |= {"rk4": (3, (0.1, 0.05)), "discrete": (4, (0.1, 0.05))}
"""Step → the order of a state within it, and two sizes."""


@pytest.mark.parametrize(("language", "step"), EACH)
def test_within_a_step(language, step):
    """The error is like h to the order and 1; at both ends it is the state there; before the first
    step there is but the first state."""
    order, sizes = DENSE[step]
    worst = []
    for h in sizes:
        times = [part * h for part in (0.1, 0.35, 0.6, 0.85, 1.0)]
        commands = [("dense", 0, 0), (step, h, 1), *(("dense", t, 0) for t in (0.0, *times))]
        first, end, start, *places = moved(language, commands)
        assert np.array_equal(first.x, state(0))
        assert np.abs(start.x - state(0)).max() < 1e-13
        # but for what takes a state to the group
        assert np.abs(places[-1].x - end.x).max() < max(1e-13, 0.05 * off(end, h))
        worst.append(max(off(place, t) for place, t in zip(places, times, strict=True)))
    found = log(worst[0] / worst[1]) / log(sizes[0] / sizes[1])
    assert order + 1 - 0.9 < found < order + 1 + 1.2, worst


@pytest.mark.parametrize(("language", "step"), [x for x in EACH if x[1] in ("gauss", "discrete")])
def test_a_symmetric_step_goes_back(language, step):
    there, back = moved(language, [(step, 0.05, 40), (step, -0.05, 40)])
    assert np.abs(there.x - state(0)).max() > 1
    assert np.abs(back.x - state(0)).max() < 1e-12
    assert back.t == 0


# ---------------------------------------------------------------- languages

ALIKE = [(step, 0.02, 20) for step in STEPS] + [("dense", 1.593, 0), ("vern9", -0.1, 3)]
ALIKE += [("dense", 1.42, 0), ("rk4", 0.01, 5), ("dense", 1.347, 0)]
ALIKE += [("begin", 0, 0), ("vern9_to", 2.0, 1e-8), ("dense", 1.99, 0), ("gauss_to", 2.5, 1e-13)]
"""The last one in C ends its iterations where they are exact enough, elsewhere at rounding."""


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_the_steps_are_those_of_c(language):
    """One method after the other; also the sizes of steps that a tolerance chooses."""
    found = zip(moved(language, ALIKE), moved("c", ALIKE), ALIKE, strict=True)
    for a, b, (word, *_) in found:
        assert (a.status, a.t) == (b.status, pytest.approx(b.t, abs=1e-15))
        own = 1e-13 if b.t < 2 else 1e-11  # then steps have sizes of their own
        assert np.abs(a.x - b.x).max() < own * np.abs(b.x).max()
        # h goes with a root of an estimated error: processors round the sums of the Python apart,
        # by 1e-15 of some 1e-11
        assert word == "gauss_to" or abs(a.h - b.h) <= 1e-5 * abs(b.h)


def test_methods_may_take_turns():
    """All are the motion itself, up to their errors."""
    for place, (word, t, _) in zip(moved("c", ALIKE), ALIKE, strict=True):
        assert off(place, t if word == "dense" else place.t) < 1e-5


BUILDS = {"plain": ("-O0",), "loops": ("-O3", "-march=native", "-Dthrown_LANES=1")}
BUILDS |= {"four": ("-O3", "-march=native", "-Dthrown_LANES=4")}
BUILDS |= {f"flags {k}": x for k, x in enumerate(FLAGS)}


@pytest.mark.parametrize("build", BUILDS)
def test_the_compiler_changes_nothing(build):
    """In lanes of each width and in loops; vector registers as wide as there are: an SLP pass once
    made errors of a pair wrong."""
    found, plain = (moved("c", ALIKE, flags=x) for x in (BUILDS[build], ("-O1",)))
    for a, b, (word, *_) in zip(found, plain, ALIKE, strict=True):
        assert (a.status, a.t) == (b.status, pytest.approx(b.t, abs=1e-15))
        assert word == "gauss_to" or abs(a.h - b.h) <= 1e-2 * abs(b.h)
        assert np.abs(a.x - b.x).max() < 1e-9


def test_sanitizers_find_nothing():
    """Addresses and undefined behaviour, in a run with all that there is."""
    need("sanitizers of gcc")
    flags = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    commands = [("dense", 0, 0), *ALIKE, ("discrete", 1e4, 1), ("gauss", 9.0, 1), ("dense", 3, 0)]
    told = [place.status for place in moved("c", commands, flags=flags)]
    assert [k for k, x in enumerate(told) if x] == [1 + len(ALIKE)]


# ---------------------------------------------------------------- steps of their own size


@pytest.mark.parametrize("tol", [1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(("language", "step"), [x for x in EACH if x[1] in ADAPTIVE])
def test_a_tolerance_is_kept(language, step, tol):
    """The error is of the size that was asked for, at the time itself; and back."""
    end, back = moved(language, [(f"{step}_to", 5.0, tol), (f"{step}_to", 0.0, tol)])
    assert (end.status, end.t, back.status, back.t) == (0, 5, 0, 0)
    assert off(end, 5.0) < 20 * tol * np.abs(state(5)).max()
    assert off(end, 5.0) > tol / 1e6 or tol < 1e-11
    assert off(back, 0.0) < 40 * tol * np.abs(state(5)).max()


SYMMETRIC = (0.5, 0.5, 0.0, 0.0, 0.0)
START = [*np.eye(3).ravel(), 1, 1, 1, 0.6, 0.4, 1.1, 1e-3, 0, 0]
"""A free symmetric top, whose steps of one size all have one error."""
SIZES = {"gauss": (16, 0.6), "vern9": (9, 0.25)}
"""The order of an error, and a step that is not too coarse and not exact."""
BEFORE = 5.0
"""When a step is as long as is wanted, or longer, after many of a larger tolerance."""


def boundary(below, low, high):
    """Where, between two numbers, what is so below is so no more, to a thousandth; ``below`` says
    it of several numbers at once."""
    while high > 1.001 * low:
        asked = low * (high / low) ** (np.arange(11) / 10)
        k = 1 + sum(below(asked[1:-1]))
        low, high = asked[k - 1], asked[k]
    return (low * high) ** 0.5


@pytest.mark.parametrize(("language", "step"), [x for x in EACH if x[1] in ADAPTIVE])
def test_the_next_step_is_as_long_as_the_tolerance_says(language, step):
    """It is to the last as the tolerance to the error, to the power of one over the order."""
    order, h = SIZES[step]

    def last(runs):
        """The last step of each run: to h at a tolerance, then on."""
        calls = []
        for tol, *more in runs:
            times = [(BEFORE, 1e-3), *((BEFORE + t, tol) for t in (h, *more))]
            calls += [("begin", 0, 0), *((f"{step}_to", *x) for x in times)]
        places = moved(language, calls, START, SYMMETRIC, (0, 0, 0))
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


SAYS = {
    "c": ("_steps.h", r"_gauss_step\([^;{]*\)\n\{\n", 'fprintf(stderr, "%.17g\\n", h);'),
    "rust": (".rs", r"fn gauss_step\(.*\{\n", 'eprintln!("{h:e}");'),
}
"""Where a language tries a step, and how it says of which size."""


def tried(language):
    """The steps that are tried, of which one is too long for the tolerance by far, up to that after
    it."""
    folder, name = emitted(TEXT, (language,), step="gauss")
    end, place, says = SAYS[language]
    path = folder / f"{name}{end}"
    text, found = re.subn(place, lambda x: f"{x[0]}{says}\n", path.read_text())
    assert found == 1
    path.write_text(f"#include <stdio.h>\n{text}" if language == "c" else text)
    program = {"c": in_c, "rust": in_rust}[language](folder, name, ("-O1",), "double")
    rows = [" ".join(map(str, x)) for x in (SYMMETRIC, (0, 0, 0), START)]
    given = "\n".join([*rows, "gauss_to 5 1e-3", "gauss_to 7 1e-15", ""])
    done = subprocess.run(program, input=given, capture_output=True, text=True, check=True)
    sizes = [*map(float, done.stderr.split())]
    return sizes[: sizes.index(2.0) + 2]


def test_rust_tries_the_steps_of_c():
    """The first is a tenth of the size over the speed, others grow to four times that; then one is
    too long."""
    in_each = [tried(x) for x in SAYS]
    assert in_each[1] == pytest.approx(in_each[0], rel=1e-6)
    assert in_each[0][-1] < 0.3 * in_each[0][-2]


# ---------------------------------------------------------------- coarse steps

STIFF = """
name = "stiff"
group = "SE(3)"
[parameters]
k = 1e6
[[point]]
mass = 1
at = [1, 0, 0]
[[point]]
mass = 1
at = [-1, 0, 0]
[[point]]
mass = 2
at = [0, 1, 0.5]
[[potential]]
kind = "spring"
at = [0, 1, 0]
anchor = [0, 1, 0]
stiffness = "k"
length = 0
[[potential]]
kind = "gravity"
g = [0, 0, -9.81]
"""
SPIN = np.array([0.1, 0.2, 0.5])
HANGING = [*np.eye(3).ravel(), 0, 0, -4 * 9.81 / 1e6, *SPIN, *-np.cross(SPIN, [0, 1, 0])]
"""A body that hangs by a point on a spring of more than 500 rad/s."""
COARSE = [("gauss", 0.05, 40), ("dense", 1.97, 0), ("begin", 0, 0), ("gauss_to", 2.0, 1e-9)]
COARSE += [("begin", 0, 0), ("gauss", 1e-4, 3)]


@cache
def stiff(language):
    """With Newton's method for the stages."""
    folder, name = emitted(STIFF, step="gauss", jacobian="raw")
    return follow(language, folder, name, COARSE, HANGING, [1e6])


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_stiff_spring_by_newtons_method(language):
    """In steps of 0.05 s, some 28 rad of the spring, none of them made in halves; then of steps
    that the iteration makes."""
    steps, inside, _, adaptive, _, fine = stiff(language)
    assert (steps.status, steps.h, adaptive.status, fine.status) == (0, 0.05, 0, 0)
    # the spring's own oscillation, of 1e-5, is not resolved: its phase is any
    assert np.abs(steps.x - adaptive.x)[:9].max() < 3e-5
    in_c = stiff("c")
    for place, same in zip((steps, inside, fine), (in_c[0], in_c[1], in_c[5]), strict=True):
        assert np.abs(place.x - same.x).max() < 1e-10  # rounding, times the stiffness
    assert np.abs(adaptive.x - in_c[3].x).max() < 1e-6


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_coarse_step_is_made_in_halves(language):
    """One whose iteration does not converge: the motion is the same but for the error."""
    (halved,) = moved(language, [("gauss", 6.0, 1)])
    assert halved.status == 0
    assert abs(halved.h) < 6
    assert off(halved, 6.0) < 1e-2


# ---------------------------------------------------------------- what is told


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_no_number_is_told_and_a_motion_goes_on(language):
    """In a size, a time, a state: nothing moves; a tolerance that is no number is the least one."""
    bad = [(step, NAN, 1) for step in STEPS]
    bad += [(f"{step}_to", t, 1e-9) for step in ADAPTIVE for t in (NAN, INFINITE, -INFINITE)]
    good = [(f"{step}_to", t, NAN) for step, t in zip(ADAPTIVE, (0.5, 1.0), strict=True)]
    *none, first, second = moved(language, bad + good)
    for place, (word, *_) in zip(none, bad, strict=True):
        assert place.status in {"gauss": (2, 3), "discrete": (5,)}.get(word, (2,)), word
        assert (place.t, place.x.tolist()) == (0, state(0).tolist())
    assert off(first, 0.5) + off(second, 1.0) < 1e-12
    commands = [(step, 0.1, 1) for step in STEPS[:3]] + [(f"{x}_to", 1.0, 1e-9) for x in ADAPTIVE]
    for place in moved(language, commands, [*state(0)[:-1], NAN]):
        assert (place.status, place.t) == (NOT_FINITE, 0)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_step_without_solution_is_told(language):
    """A ball turns by at most 1 rad h |ζ|: a longer step leaves the motion as it was."""
    ball = (0.25, 0.25, 0.25, 0, 0)
    x = [*np.eye(3).ravel(), 0, 0, 0, 0.6, 0, 0.8, 0, 0, 0]
    commands = [("discrete", 0.99, 1), ("discrete", 1e3, 3), ("discrete", NAN, 1)]
    commands += [("discrete", -0.5, 2)]
    good, *bad, back = moved(language, commands, x, ball, (0, 0, 0))
    assert (good.status, back.status, back.h) == (0, 0, -0.5)
    for place in bad:
        assert place.status == NO_SOLUTION
        assert (place.t, place.h, place.x.tolist()) == (good.t, good.h, good.x.tolist())


LINE = """
name = "line"
group = { name = "Line", action = "affine", basis = [[[0, 0, 1], [0, 0, 0], [0, 0, 0]]] }
[parameters]
a = 1.0
b = 0.0
[[point]]
mass = 1
at = [0, 0]
[[potential]]
kind = "expression"
U = "-a/sqrt(r1_x^2) - b*r1_x^4/4"
"""
ENDS = {"collision": ((1, 0), 0.0, pi / sqrt(8)), "infinity": ((0, 1), sqrt(0.5), sqrt(2))}
"""Of a point on a line that falls to a centre from 1, or goes off, as 1/(1 - t/√2): parameters, its
speed at first, and the time of its end."""
TO_AN_END = {"gauss_to": 1e-9, "vern9_to": 1e-9, "vern9": 1000, "rk4": 1000}
ENDED = [(end, x) for end in ENDS for x in TO_AN_END if end == "infinity" or x.endswith("_to")]
"""Steps of one size leap over a centre."""


@pytest.mark.parametrize(("end", "word"), ENDED)
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_end_of_a_motion_is_told(language, word, end):
    """Steps become too short or rates infinite: the last good state is kept, by another try too."""
    (p, speed, time), adaptive = ENDS[end], word.endswith("_to")
    folder, name = emitted(LINE, step=STEPS[:3])
    command = (word, 9.0 if adaptive else 0.01, TO_AN_END[word])
    x = (1.0, 0.0, 0.0, 1.0, 1.0, 0.0, speed)
    for place in follow(language, folder, name, [command, command], x, p):
        assert place.status in ((NOT_FINITE, NOT_CONVERGED) if adaptive else (NOT_FINITE,))
        assert np.isfinite(place.x).all()
        assert abs(place.t - time) < (1e-4 if adaptive else 0.2)


# ---------------------------------------------------------------- what is kept

FREE, STILL = (*PARAMETERS[:3], 0.0, 0.0), (0, 0, 0)
"""Without any force: energy and momenta are kept."""
KEPT = {"gauss": (0.1, 1e-13, 1e-12), "discrete": (0.02, 1e-13, 1e-3)}
KEPT |= {"vern9": (0.1, 1e-13, 1e-9), "rk4": (0.02, 1e-13, 1e-4)}
"""Step → a size, what is left of the group, and what of energy and momentum, after many steps."""


@pytest.mark.parametrize(("language", "step"), EACH)
def test_what_is_kept_over_many_steps(language, step):
    """The group to rounding by all; energy and the momentum about the centre by the order of a
    step, or to rounding."""
    folder, name = emitted(TEXT, step=STEPS, order=4)
    code = import_python(name, folder)
    x, k = state(0), code.constants(np.array(FREE))
    h, group, most = KEPT[step]
    n = 400 if language == "python" else 4000
    places = moved(language, [(step, h, n)] * 5, x, FREE, STILL)
    for place in places:
        assert place.status == 0
        assert code.defect(place.x) < group
        assert abs(code.energy(0.0, place.x, k) / code.energy(0.0, x, k) - 1) < most
        spins = [y[:9].reshape(3, 3) @ (thrown.MOMENTS * y[12:15]) for y in (x, place.x)]
        assert np.abs(spins[0] - spins[1]).max() < (most if step != "discrete" else 1e-11)
    assert min(np.abs(a.x - b.x)[12:15].max() for a, b in pairwise(places)) > 1e-3
