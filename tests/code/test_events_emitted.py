"""Events, emitted: at known times in every language, in order, once, and what is refused."""

import subprocess
from copy import copy
from math import pi, sqrt

import numpy as np
import pytest
from scipy.special import ellipk

import derive
from derive.command.cli import main
from tests.problems.moving import BODY, WEIGHT
from tests.support.emitted import import_python
from tests.support.motions import LANGUAGES, follow

STONE = f"""
name = "stone"
group = "SE(3)"
[parameters]
H = 3.0
{BODY}{WEIGHT}[[event]]
name = "ground"
when = "T_3"
terminal = true
[[event]]
name = "half"
when = "T_3 - H/2"
direction = "falling"
[[event]]
name = "also"
when = "H/2 - T_3"
direction = "rising"
[[event]]
name = "up"
when = "T_3 - H/2"
direction = "rising"
[[event]]
name = "quarter"
when = "A_11"
[[event]]
name = "never"
when = "(T_3 - H/4)^2"
"""
PENDULUM = """
name = "pendulum"
group = "SO(2)"
[parameters]
l = 0.5
[[point]]
mass = 2
at = [0, "-l"]
[[potential]]
kind = "gravity"
g = [0, "-9.81"]
[[event]]
name = "down"
when = "A_12"
direction = "falling"
[[event]]
name = "below"
when = "A_12"
"""
SPUN = f"""
name = "spun"
group = "SO(3)"
{BODY}
[[event]]
name = "quarter"
when = "A_11"
"""
FALLEN, HALF = sqrt(6 / 9.81), sqrt(3 / 9.81)
AT_ONE = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]
STANDING = [*AT_ONE, 0, 0, 3.0, 0, 2, 0, 1, 0, 0]
STEPS, FIXED = ("gauss", "vern9"), ("gauss", "vern9", "rk4")


@pytest.fixture(scope="module")
def emitted(tmp_path_factory):
    """A function (text, language, options) → the folder with the code, made once."""
    made = {}

    def get(text, language, step=FIXED, **options):
        key = (text, language, step, *map(str, options.items()))
        if key not in made:
            folder = made[key] = tmp_path_factory.mktemp("events")
            (folder / "p.toml").write_text(text)
            languages = {language, "python"}
            derive.derive(folder / "p.toml").emit(folder, sorted(languages), step=step, **options)
        return made[key]

    return get


def names(folder, name):
    return import_python(name, folder).EVENTS


def told(places, listed):
    """(name, time) of the events that some calls returned."""
    return [(listed[place.event], place.t) for place in places if place.status == 4]


CALLS = [(language, step) for language in LANGUAGES for step in STEPS]


@pytest.mark.parametrize(("language", "step"), CALLS)
def test_a_falling_stone(emitted, language, step):
    """Its height is of degree 2 in t; it turns. Two events at one time, and others in one step;
    then back."""
    folder = emitted(STONE, language)
    calls = [(f"{step}_to", 1.0, 1e-13)] * 6 + [(f"{step}_to", 0.0, 1e-13)] * 5
    places = follow(language, folder, "stone", calls, STANDING, [3.0])
    listed = names(folder, "stone")
    expected = [("half", HALF), ("also", HALF), ("ground", FALLEN), ("quarter", pi / 4)]
    back = [("quarter", pi / 4), ("ground", FALLEN), ("up", HALF)]
    found = told(places, listed)
    assert [name for name, _ in found] == [name for name, _ in [*expected, *back]]
    for (_, t), (_, exact) in zip(found, [*expected, *back], strict=True):
        assert abs(t - exact) < 1e-12
    assert [place.status for place in places] == [4] * 4 + [0] * 2 + [4] * 3 + [0] * 2
    assert (places[4].t, places[-1].t) == (1.0, 0.0)
    rising = [place.rising for place in places if place.status == 4]
    assert rising == [False, True, False, False, True, True, True]
    at = {listed[place.event]: place.x for place in places[:4]}
    assert abs(at["ground"][11]) < 1e-13
    assert abs(at["half"][11] - 1.5) < 1e-13
    assert abs(at["quarter"][0]) < 1e-13
    assert np.abs(places[-1].x - STANDING).max() < 1e-11


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("tol", [1e-9, 1e-13])
def test_a_pendulum_by_an_elliptic_integral(emitted, language, tol):
    """It passes its lowest place a quarter of a period after it was let go, then every half."""
    folder, start = emitted(PENDULUM, language), 2.5
    x = [np.cos(start), -np.sin(start), np.sin(start), np.cos(start), 0.0]
    calls = [("gauss_to", 9.0, tol)] * 14
    found = told(follow(language, folder, "pendulum", calls, x, [0.5]), names(folder, "pendulum"))
    quarter = sqrt(0.5 / 9.81) * ellipk(np.sin(start / 2) ** 2)
    exact = quarter * np.arange(1, 9 / quarter, 2)
    below = [t for name, t in found if name == "below"]
    assert below == pytest.approx(exact[: len(below)], rel=0, abs=max(2e-12, 1e3 * tol))
    assert len(below) >= 8
    down = [t for name, t in found if name == "down"]
    assert down == pytest.approx(below[1::2][: len(down)], rel=0, abs=1e-12)
    assert len(down) >= 4


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_every_language_stops_alike(emitted, language):
    calls = [("gauss_to", 1.0, 1e-12)] * 5
    found = follow(language, emitted(STONE, language), "stone", calls, STANDING, [3.0])
    in_c = follow("c", emitted(STONE, "c"), "stone", calls, STANDING, [3.0])
    for a, b in zip(found, in_c, strict=True):
        assert a.status == b.status
        assert a.status != 4 or a.event == b.event
        assert abs(a.t - b.t) < 1e-13
        assert np.abs(a.x - b.x).max() < 1e-12


@pytest.mark.parametrize(("language", "step"), CALLS)
def test_where_it_starts_nothing_happens_and_an_end_is_seen_once(emitted, language, step):
    """A start at an event, an end at one, and a time that is an instant of calls."""
    folder = emitted(STONE, language)
    start = [*AT_ONE, 0, 0, 1.5, 0, 0, 0, 0, 0, 0]  # at half, from where it falls
    lands = sqrt(3 / 9.81)
    calls = [(f"{step}_to", t, 1e-13) for t in (lands / 2, lands + 1e-3, lands + 1e-3, 1.0)]
    places = follow(language, folder, "stone", calls, start, [3.0])
    assert [place.status for place in places] == [0, 4, 0, 0]
    assert abs(places[1].t - lands) < 1e-12


FORMS = [
    {},
    {"layout": "col"},
    {"attitude": "quaternion"},
    {"velocity": "tangent"},
    {"form": "header"},
]


@pytest.mark.parametrize("options", FORMS)
def test_every_form_of_the_state_has_the_same_events(tmp_path, options):
    """By the names of matrices and velocities in the body, whatever the state is."""
    text = STONE + '[[event]]\nname = "spin"\nwhen = "zeta_2*A_11 - w_1 - 1/2"\n'
    (tmp_path / "p.toml").write_text(text)
    d = derive.derive(tmp_path / "p.toml")
    d.emit(tmp_path, ("c", "python"), step="gauss", **options)
    code = import_python("stone", tmp_path)
    start = {"T_3": 3.0, "zeta_2": 2.0, "w_1": 1.0, "q_0": 1.0}
    start |= {"A_11": 1.0, "A_22": 1.0, "A_33": 1.0}
    start |= {"A_13_dot": 2.0, "A_31_dot": -2.0, "T_1_dot": 1.0}
    x = np.array([start.get(name, 0.0) for name in code.STATE])
    m, k, found = code.begin(0.0, x), code.constants([3.0]), []
    while code.gauss_to(m, k, None, 1.0, 1e-13) == code.EVENT:
        found.append((code.EVENTS[m.event], m.t))
    plain = d.simulate(1.0, tol=1e-13, start={"T_3": 3.0, "zeta_2": 2.0, "w_1": 1.0, "H": 3.0})
    until = [(e.name, e.t) for e in plain.events]  # up to the terminal one
    assert [name for name, _ in found[: len(until)]] == [name for name, _ in until]
    assert [t for _, t in found[: len(until)]] == pytest.approx(
        [t for _, t in until], rel=0, abs=1e-12
    )
    assert "spin" in {name for name, _ in found}
    strict = ["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    (tmp_path / "all.c").write_text('#include "stone_steps.h"\n#include "stone_steps.h"\n')
    subprocess.run([*strict, str(tmp_path / "all.c")], check=True)


def test_inputs_time_and_parameters_are_read(tmp_path):
    text = f"""
name = "torqued"
group = "SO(3)"
[parameters]
a = 0.25
{BODY}
[[input]]
name = "u"
kind = "covector"
[[event]]
name = "later"
when = "t - a - u_2"
[[event]]
name = "cubic"
when = "(t - 1/2)^3"
"""
    (tmp_path / "p.toml").write_text(text)
    derive.derive(tmp_path / "p.toml").emit(tmp_path, ("python",), step="vern9")
    code = import_python("torqued", tmp_path)
    k, x = code.constants({}), np.array([*AT_ONE, 0.3, 0.2, 0.1])
    for u in (np.array([0.0, 0.5, 0]), lambda t, x: np.array([0.1, t / 2 + 0.125, 0])):
        m, found = code.begin(0.0, x), []
        while code.vern9_to(m, k, u, 1.0, 1e-9) == code.EVENT:
            found.append((code.EVENTS[m.event], m.t))
        assert found == [("cubic", pytest.approx(0.5, abs=1e-12)), ("later", pytest.approx(0.75))]


METHODS = [(language, x) for language in LANGUAGES for x in FIXED]
METHODS += [(language, "discrete") for language in ("c", "python", "cpp")]


def zero(name, x):
    """What becomes 0 at an event of the stone."""
    return {"ground": x[11], "half": x[11] - 1.5, "also": 1.5 - x[11], "quarter": x[0]}[name]


@pytest.mark.parametrize(("language", "step"), METHODS)
def test_steps_of_one_size_are_watched(emitted, language, step):
    """At the zeros of the motion that they make, which is the same as without a watch: each event,
    in order and once, to a time between the ends of steps and then to the end of one."""
    folder = emitted(STONE, language, ("discrete",) if step == "discrete" else FIXED)
    names_of, h = names(folder, "stone"), 0.07
    calls = [(f"{step}_watch", t, h) for t in (8 * h, 15 * h) for _ in range(5)]
    plain = [(step, h, 8), (step, h, 7)]
    places = follow(language, folder, "stone", calls, STANDING, [3.0])
    ends = follow(language, folder, "stone", plain, STANDING, [3.0])
    found = [place for place in places if place.status == 4]
    assert [names_of[x.event] for x in found] == ["half", "also", "ground", "quarter"]
    assert [x.rising for x in found] == [False, True, False, False]
    off = {"gauss": 1e-12, "vern9": 1e-12, "rk4": 1e-5, "discrete": 4e-3}[step]
    for x, exact in zip(found, (HALF, HALF, FALLEN, pi / 4), strict=True):
        assert abs(x.t - exact) < off
        assert abs(zero(names_of[x.event], x.x)) < 1e-13
    for place, end in zip((places[4], places[9]), ends, strict=True):
        assert (place.status, place.t) == (0, end.t)
        same = 0 if step in ("rk4", "vern9") else 1e-13
        assert np.abs(place.x - end.x).max() <= same


@pytest.mark.parametrize(("language", "step"), METHODS)
def test_they_are_watched_backwards_to_a_shorter_last_step(emitted, language, step):
    folder = emitted(STONE, language, ("discrete",) if step == "discrete" else FIXED)
    calls = [(step, 0.07, 12), *[(f"{step}_watch", 0.3, 0.08)] * 5]
    places = follow(language, folder, "stone", calls, STANDING, [3.0])[1:]
    assert [x.status for x in places] == [4, 4, 4, 0, 0]
    found = [names(folder, "stone")[x.event] for x in places[:3]]
    assert found == ["quarter", "ground", "up"]
    assert [x.rising for x in places[:3]] == [True] * 3
    assert places[4].t == pytest.approx(0.3, rel=0, abs=1e-15)
    assert places[4].h == pytest.approx(-0.06, rel=1e-9)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_step_that_is_made_in_halves_is_watched_whole(emitted, language):
    """So coarse that the iteration of gauss does not converge."""
    folder, h = emitted(SPUN, language, ("gauss",)), 1.0
    x, calls = (
        [*AT_ONE, 0, 0, 9.0],
        [("gauss_watch", 2.0, h)] * 13 + [("begin", 0, 0), ("gauss", h, 2)],
    )
    *places, _, end = follow(language, folder, "spun", calls, x)
    found = [place.t for place in places if place.status == 4]
    exact = (np.arange(6) + 0.5) * pi / 9
    assert found == pytest.approx(exact, rel=0, abs=1e-10)  # the error of such halves
    assert abs(end.h) < h
    assert (places[6].status, places[6].t) == (0, 2.0)
    assert np.abs(places[6].x - end.x).max() < 1e-6  # not of the same parts


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("real", ["double", "float"])
def test_rk4_alone(emitted, language, real):
    """Without what steps of their own size need; in floats, too."""
    folder = emitted(SPUN, language, ("rk4",), real=real)
    calls = [("rk4_watch", 1.0, 1 / 64)] * 5
    places = follow(language, folder, "spun", calls, [*AT_ONE, 0, 0, 9.0], real=real)
    assert [place.status for place in places] == [4, 4, 4, 0, 0]
    exact = (np.arange(3) + 0.5) * pi / 9
    assert [x.t for x in places[:3]] == pytest.approx(exact, rel=0, abs=1e-5)
    zeros = [abs(x.x[0]) for x in places[:3]]
    assert max(zeros) < (1e-14 if real == "double" else 1e-6)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("t", "h"), [(1.0, 0.0), (np.inf, 0.1), (1.0, np.inf)])
def test_what_is_no_step_is_told(emitted, language, t, h):
    folder = emitted(SPUN, language, ("rk4",))
    (place,) = follow(language, folder, "spun", [("rk4_watch", t, h)], [*AT_ONE, 0, 0, 9.0])
    assert (place.status, place.t) == (2, 0.0)


def test_from_an_event_other_steps_go_on(emitted):
    """And the end of the step in which it was is forgotten."""
    folder = emitted(STONE, "python")
    code = import_python("stone", folder)
    k, m = code.constants([3.0]), code.begin(0.0, np.array(STANDING))
    assert code.watch(code.rk4, m, k, None, 1.0, 0.5) == code.EVENT
    assert code.rk4(m, k, None, 1e-3) == code.OK
    t = m.t
    assert code.watch(code.rk4, m, k, None, t + 0.02, 0.01) == code.OK
    assert m.t == pytest.approx(t + 0.02, rel=0, abs=1e-15)


def test_steps_of_a_size_do_not_stop_and_are_no_event(emitted):
    folder = emitted(STONE, "python")
    code = import_python("stone", folder)
    k, m = code.constants([3.0]), code.begin(0.0, np.array(STANDING))
    assert code.gauss_to(m, k, None, 0.1) == code.OK
    assert code.gauss(m, k, None, 0.1, 5) == code.OK  # beyond half
    assert code.gauss_to(m, k, None, 1.0) == code.EVENT
    assert (code.EVENTS[m.event], code.TERMINAL[m.event]) == ("ground", True)


def test_the_compiled_c_tells_them(tmp_path):
    (tmp_path / "p.toml").write_text(STONE)
    f = derive.compile(tmp_path / "p.toml", step=("gauss", "vern9"))
    for step in ("gauss", "vern9"):
        m, found = f.begin(STANDING), []
        while m.move_to(1.0, 1e-12, step).event:
            found.append(m.event)
        assert found == ["half", "also", "ground", "quarter"]
        assert m.t == 1.0
        m, again = f.begin(STANDING), []
        while m.watch(1.0, 0.1, step).event:
            again.append((m.event, m.rising))
            if not again[1:]:
                other = copy(m)
        assert again == [(name, name == "also") for name in found]
        assert np.abs(m.x - f.begin(STANDING).move(0.1, 10, step).x).max() < 1e-13
        assert (other.event, other.watch(1.0, 0.1, step).event) == ("half", "also")
    plain = derive.compile("so3", step="rk4").begin([*AT_ONE, 0, 0, 1])
    with pytest.raises(ValueError, match="has no"):
        plain.watch(1.0, 0.1)
    for t, h in ((1.0, 0.0), (np.inf, 0.1), (1.0, np.nan)):
        with pytest.raises(ValueError, match="the size of a step"):
            m.watch(t, h)


@pytest.mark.parametrize(
    ("when", "more", "words"),
    [
        ("A_44 - 1", (), "event e: no 'A_44' in the state, the parameters or the inputs"),
        ("zeta_9", (), "did you mean 'zeta_"),
        ("A_11", ("--frame", "principal"), "leave out --frame"),
    ],
)
def test_what_is_refused(tmp_path, capsys, when, more, words):
    path = tmp_path / "p.toml"
    path.write_text(
        f'name = "spin"\ngroup = "SO(3)"\n{BODY}[[event]]\nname = "e"\nwhen = "{when}"\n'
    )
    out = tmp_path / "out"
    assert main(["emit", str(path), "--step", "gauss", *more, "--out", str(out)]) == 2
    err = capsys.readouterr().err
    assert words in err
    assert err.count("\n") == 1
    assert not out.exists() or not [*out.iterdir()]
    assert main(["emit", str(path), "--out", str(out)]) == 0
