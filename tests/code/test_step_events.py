"""Events of the emitted steps, in every language: at known times, in order, once; refusals."""

from copy import copy
from math import asin, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import derive
from derive.command.cli import main
from tests.problems import thrown
from tests.problems.moving import BODY
from tests.problems.thrown import PARAMETERS, PUSH, state
from tests.support.emitted import import_python
from tests.support.motions import LANGUAGES, emitted, follow
from tests.support.needs import need

TEXT = thrown.TEXT + thrown.EVENTS
STEPS, ADAPTIVE = ("gauss", "vern9", "rk4", "discrete"), ("gauss", "vern9")
EACH = [(language, step) for language in LANGUAGES for step in STEPS]
AT_EVENT = 4
FALL = 2 / (thrown.GRAVITY - PUSH[2] / thrown.MASS)
HALF, FALLEN = sqrt(1.5 * FALL), sqrt(3 * FALL)
TURNED = brentq(lambda t: state(t)[1] - 0.2, 0.1, 0.4, xtol=1e-15)
PULLED = asin(PUSH[0]) / 3
FORTH = [("pulled", PULLED, True), ("turned", TURNED, True), ("half", HALF, False)]
FORTH += [("also", HALF, True), ("ground", FALLEN, False), ("pulled", pi / 3 - PULLED, False)]
BACK = [("pulled", pi / 3 - PULLED, True), ("ground", FALLEN, True), ("up", HALF, True)]
BACK += [("turned", TURNED, False), ("pulled", PULLED, False)]
"""Event, when, and is it reached from below? up to t = 1 and back."""
OFF = {"gauss": 1e-12, "vern9": 1e-12, "rk4": 1e-5, "discrete": 4e-3}


def watched(language, commands, x=None, u=PUSH):
    """The places of the thrown body after some commands; and the names of its events."""
    folder, name = emitted(TEXT, step=STEPS, order=2)
    begin = state(0) if x is None else x
    listed = import_python(name, folder).EVENTS
    return follow(language, folder, name, commands, begin, PARAMETERS, u), listed


def zero(name, place):
    """What becomes 0 at an event."""
    T, force = place.x[11], PUSH[0]
    height = {"ground": T, "half": T - 1.5, "also": 1.5 - T, "up": T - 1.5}
    return height | {"pulled": np.sin(3 * place.t) - force, "turned": place.x[1] - 0.2}


def hold(places, listed, expected, within):
    """The events that calls returned are those that were expected."""
    found = [x for x in places if x.status == AT_EVENT]
    assert [listed[x.event] for x in found] == [name for name, *_ in expected]
    for place, (name, t, rising) in zip(found, expected, strict=True):
        assert abs(place.t - t) < within, name
        assert place.rising == rising, name
        assert abs(zero(name, place)[name]) < 1e-13, name


@pytest.mark.parametrize(("language", "step"), [x for x in EACH if x[1] in ADAPTIVE])
def test_in_steps_of_their_own_size(language, step):
    """Two at one time, some in one step, some of the time and an input alone; then back."""
    calls = [(f"{step}_to", 1.0, 1e-13)] * 8 + [(f"{step}_to", 0.0, 1e-13)] * 7
    places, listed = watched(language, calls)
    assert [x.status for x in places] == [4] * 6 + [0] * 2 + [4] * 5 + [0] * 2
    hold(places[:8], listed, FORTH, 1e-12)
    hold(places[8:], listed, BACK, 1e-12)
    assert (places[7].t, places[-1].t) == (1.0, 0.0)
    assert np.abs(places[-1].x - state(0)).max() < 1e-11


@pytest.mark.parametrize(("language", "step"), EACH)
def test_in_steps_of_one_size(language, step):
    """At the zeros of the motion that they make, which is the same as without a watch, to a time
    between the ends of steps and then to the end of one."""
    h = 0.07
    calls = [(f"{step}_watch", t, h) for t in (8 * h, 15 * h) for _ in range(8)]
    places, listed = watched(language, calls)
    ends, _ = watched(language, [(step, h, 8), (step, h, 7)])
    hold(places, listed, FORTH, OFF[step])
    for place, end in zip((places[7], places[15]), ends, strict=True):
        assert (place.status, place.t) == (0, end.t)
        same = 0 if step in ("rk4", "vern9") else 1e-13
        assert np.abs(place.x - end.x).max() <= same * np.abs(end.x).max()


@pytest.mark.parametrize(("language", "step"), EACH)
def test_backwards_to_a_shorter_last_step(language, step):
    calls = [(step, 0.07, 14), *[(f"{step}_watch", 0.3, 0.08)] * 5]
    (_, *places), listed = watched(language, calls)
    assert [x.status for x in places] == [4, 4, 4, 0, 0]
    hold(places, listed, BACK[:3], OFF[step])
    assert places[4].t == pytest.approx(0.3, rel=0, abs=1e-15)
    assert places[4].h == pytest.approx(-0.04, rel=1e-9)


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_every_language_stops_where_c_does(language):
    calls = [("vern9_to", 1.0, 1e-12)] * 8
    for a, b in zip(watched(language, calls)[0], watched("c", calls)[0], strict=True):
        assert (a.status, a.status and a.event) == (b.status, b.status and b.event)
        assert abs(a.t - b.t) < 1e-13
        assert np.abs(a.x - b.x).max() < 1e-12


@pytest.mark.parametrize(("language", "step"), [x for x in EACH if x[1] in ADAPTIVE])
def test_where_it_starts_nothing_happens_and_an_end_is_seen_once(language, step):
    """A start at an event, an end at one, and a time that is an instant of calls."""
    start, u = [*np.eye(3).ravel(), 0, 0, 1.5, *[0] * 6], (2, 0, 0)
    lands = sqrt(3 / thrown.GRAVITY)  # from half, where it is at rest
    calls = [(f"{step}_to", t, 1e-13) for t in (lands / 2, lands + 1e-3, lands + 1e-3, 0.6)]
    places, listed = watched(language, calls, start, u)
    assert [place.status for place in places] == [0, AT_EVENT, 0, 0]
    assert listed[places[1].event] == "ground"
    assert abs(places[1].t - lands) < 1e-12


NO_STEPS = [(1.0, 0.0), (float("inf"), 0.1), (1.0, float("inf"))]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_step_that_is_made_in_halves_is_watched_whole(language):
    """So coarse that the iteration of gauss does not converge, of a body that spins high above."""
    calls = [("gauss_watch", 2.0, 1.0)] * 12 + [("begin", 0, 0), ("gauss", 1.0, 2)]
    calls += [("begin", 0, 0), *[("rk4_watch", *x) for x in NO_STEPS]]
    x, u = [*np.eye(3).ravel(), 0, 0, 1e3, 0, 0, 9.0, 0, 0, 0], (2, 0, 0)
    (*places, _, end, _, first, second, third), _ = watched(language, calls, x, u)
    found = [place.t for place in places if place.status == AT_EVENT]
    exact = [(2 * pi * k + x) / 9 for k in range(3) for x in (pi + asin(0.2), -asin(0.2) + 2 * pi)]
    assert found == pytest.approx(exact[:5], rel=0, abs=1e-10)  # the error of such halves
    assert abs(end.h) < 1
    assert (places[5].status, places[5].t) == (0, 2.0)
    assert np.abs(places[5].x - end.x).max() < 1e-6  # not of the same parts
    assert [(x.status, x.t) for x in (first, second, third)] == [(2, 0)] * 3


@pytest.mark.parametrize("language", LANGUAGES)
def test_rk4_alone_in_floats(language):
    """Without what steps of their own size need; as exact as numbers of 32 bits are, in C without a
    double."""
    folder, name = emitted(TEXT, step="rk4", real="float")
    flags = ("-O2", "-Wdouble-promotion", "-Wconversion", "-fsingle-precision-constant")
    calls = [("rk4", 0.02, 50), ("dense", 0.99, 0), ("begin", 0, 0)]
    calls += [("rk4_watch", 1.0, 1 / 64)] * 8
    x, real = np.float32(state(0)), {"real": "float", "flags": flags}
    end, within, _, *places = follow(language, folder, name, calls, x, PARAMETERS, PUSH, **real)
    for place, t in ((end, 1.0), (within, 0.99)):
        assert np.abs(place.x - state(t)).max() < 2e-5
    assert [place.status for place in places] == [4] * 6 + [0] * 2
    listed = import_python(name, folder).EVENTS
    for place, (event, t, rising) in zip(places, FORTH, strict=False):
        assert (listed[place.event], place.rising) == (event, rising)
        assert abs(place.t - t) < 1e-5
        assert abs(zero(event, place)[event]) < 2e-6


FORMS = [{}, {"layout": "col"}, {"attitude": "quaternion"}, {"velocity": "tangent"}]


@pytest.mark.parametrize("options", FORMS)
def test_every_form_of_the_state_has_the_same_events(options):
    """By the names of matrices and velocities in the body, whatever the state is; against SciPy."""
    text = TEXT + '[[event]]\nname = "spin"\nwhen = "zeta_2*A_11 - w_1 - 1/2"\n'
    folder, name = emitted(text, ("python",), step="gauss", **options)
    code = import_python(name, folder)
    start = {"T_3": 3.0, "q_0": 1.0, "zeta_2": 2.0, "w_1": 1.0, "A_13_dot": 2.0, "A_31_dot": -2.0}
    start |= {"A_11": 1.0, "A_22": 1.0, "A_33": 1.0, "T_1_dot": 1.0}
    x = np.array([start.get(name, 0.0) for name in code.STATE])
    m, k, found = code.begin(0.0, x), code.constants(PARAMETERS), []
    while code.gauss_to(m, k, PUSH, 1.0, 1e-13) == code.EVENT:
        found.append((code.EVENTS[m.event], m.t))
    values = [lambda t, x, e=e: code.events(t, x, k, PUSH)[e] for e in range(len(code.EVENTS))]
    field = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-13, "events": values}
    run = solve_ivp(lambda t, x: code.rhs(t, x, k, PUSH), (0, 1), x, **field)
    pairs = zip(code.EVENTS, run.t_events, strict=True)
    exact = {name: list(times) for name, times in pairs}
    for name in ("spin", "ground", "pulled", "turned"):
        times = [t for other, t in found if other == name]
        assert times == pytest.approx(exact[name], rel=0, abs=1e-11), name
    assert "spin" in dict(found)


def test_inputs_as_a_function():
    folder, name = emitted(TEXT, step=STEPS, order=2)
    code = import_python(name, folder)
    k, m = code.constants(PARAMETERS), code.begin(0.0, state(0))
    assert code.vern9_to(m, k, lambda t, x: [2 * t, 0, 0], 0.5, 1e-9) == code.EVENT
    when = brentq(lambda t: np.sin(3 * t) - 2 * t, 0.3, 0.6, xtol=1e-15)
    found = [m.t]
    while code.vern9_to(m, k, lambda t, x: [2 * t, 0, 0], 0.6, 1e-9) == code.EVENT:
        found.append(m.t)
    assert min(abs(np.array(found) - when)) < 1e-12


def test_from_an_event_other_steps_go_on():
    """The end of the step in which it was is forgotten; n steps do not stop and are no event."""
    folder, name = emitted(TEXT, step=STEPS, order=2)
    code = import_python(name, folder)
    k, m = code.constants(PARAMETERS), code.begin(0.0, state(0))
    assert code.watch(code.rk4, m, k, PUSH, 1.0, 0.5) == code.EVENT
    assert code.rk4(m, k, PUSH, 1e-3) == code.OK
    t = m.t
    assert code.watch(code.rk4, m, k, PUSH, t + 0.02, 0.01) == code.OK
    assert m.t == pytest.approx(t + 0.02, rel=0, abs=1e-15)
    assert code.gauss(m, k, PUSH, 0.1, 5) == code.OK  # beyond half
    assert code.gauss_to(m, k, PUSH, 1.0) == code.EVENT
    assert (code.EVENTS[m.event], code.TERMINAL[m.event]) == ("ground", True)


def test_the_compiled_c_tells_them(tmp_path):
    need("cc")
    (tmp_path / "p.toml").write_text(TEXT)
    f = derive.compile(tmp_path / "p.toml", step=("gauss", "vern9"))
    f.u = np.array(PUSH)
    names = [name for name, *_ in FORTH]
    for step in ("gauss", "vern9"):
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
    plain = derive.compile("so3", step="rk4").begin([*np.eye(3).ravel(), 0, 0, 1])
    with pytest.raises(ValueError, match="has no"):
        plain.watch(1.0, 0.1)
    for t, h in (*NO_STEPS[:2], (1.0, np.nan)):
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


def test_every_emitted_text_says_what_an_event_is():
    """“never” of these problems, a square, is none by any step; files said “what becomes 0”."""
    folder, name = emitted(TEXT, step=STEPS, order=2)
    files = [folder / f"{name}.{x}" for x in ("h", "py", "mjs", "rs", "hpp")]
    said = "changes its sign at each "
    assert [x.name for x in files if said not in x.read_text()] == []
    assert [x.name for x in files if "only touches 0 is one by rounding" not in x.read_text()] == []
