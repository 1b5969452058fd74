"""The page in a browser: the body moves, and what is kept stays; what is drawn is where it should
be; its sliders, numbers and keys; on a phone and by night."""

import re
import tomllib

import numpy as np
import pytest

import derive
from derive.command.showing import ready_made
from derive.problem.toml import problem_of
from derive.programs import moving_program
from tests.page.test_motion_page import PAGELESS
from tests.support.motion_pages import BAD, STARTS, page, set_to
from tests.support.walks import derived

INK = """() => [...document.querySelectorAll("canvas")].map((c) => {
    const { data } = c.getContext("2d").getImageData(0, 0, c.width, c.height);
    return data.filter((v, i) => i % 4 === 3 && v > 0).length/data.length*4;
})"""
MOTION = 'document.getElementById("motion").motion'
STATE = f"[...{MOTION}.state]"
CHANGES = """() => [...document.querySelectorAll("tbody td:nth-child(3)")].map(
    (cell) => Number(cell.textContent.replace("·10", "e").replace(/[−⁻]/g, "-")
        .replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (x) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(x))))"""


def seek(shown, t):
    shown.evaluate(f"{MOTION}.seek({t})")
    shown.wait_for_function(f"Math.abs({MOTION}.time - {t}) < 1e-12")
    shown.wait_for_timeout(100)


# ---------------------------------------------------------------- what is drawn


DRAWN = """(n) => {
    const { prototype } = CanvasRenderingContext2D, stage = document.querySelectorAll("canvas")[n];
    const none = () => ({ dots: [], lines: [], strokes: [], letters: {} });
    const kept = globalThis.drawn = none();
    const heard = (name, does) => {
        const own = prototype[name];
        prototype[name] = function (...a) {
            if (this.canvas === stage) does.apply(this, a);
            own.call(this, ...a);
        };
    };
    heard("clearRect", () => Object.assign(kept, none()));
    heard("arc", (x, y) => kept.dots.push([x, y]));
    heard("fillText", (text, ...at) => { kept.letters[text] = at; });
    heard("beginPath", () => { kept.path = []; });
    heard("moveTo", (x, y) => (kept.begins ??= []).push([x, y]));
    heard("stroke", function () { kept.strokes.push([this.strokeStyle, kept.path]); });
    for (const name of ["moveTo", "lineTo"]) {
        heard(name, (x, y) => [kept.lines, kept.path].forEach((list) => list.push([x, y])));
    }
}"""
"""Keeps the places, in pixels, of what the last picture on the n-th canvas has: its dots, ends of
its lines, strokes, colour and line, and letters."""


@pytest.mark.parametrize(
    ("group", "gravity"),
    [("SO(2)", [0, -9.81]), ("SO(2)", [3, 2]), ("SE(2)", [0, -9.81]), ("SL(2)", [-1, 0])],
)
def test_a_plane_is_seen_as_it_is(group, gravity, opened):
    """The first axis to the right, the second up, and gravity along them."""
    points = [{"mass": 1, "at": [0.3, -0.7]}, {"mass": 2, "at": [0.4, 0.2]}]
    weight = {"kind": "gravity", "g": gravity}
    flat = {"name": "flat", "group": group, "point": points, "potential": [weight]}
    d = derive.derive(problem_of(flat))
    shown = opened(d.motion_page(2.0, start={"zeta_1": 1.3}))
    shown.wait_for_timeout(100)
    shown.evaluate(DRAWN, 0)
    seek(shown, 0.7)
    (one, other, *_), lines = map(np.array, shown.evaluate("[drawn.dots, drawn.lines]"))
    A = np.reshape(shown.evaluate(STATE)[:4], (2, 2))
    apart, own = (other - one) * [1, -1], A @ [0.1, 0.9]
    scale = np.linalg.norm(apart) / np.linalg.norm(own)
    assert scale > 50
    assert np.abs(apart - scale * own).max() < 1e-6
    fall = (lines[-4] - lines[-5]) * [1, -1]  # before the head of the arrow
    assert np.abs(fall - 30 * np.array(gravity) / np.linalg.norm(gravity)).max() < 1e-6


def test_the_momentum_stays_in_space_and_the_velocity_does_not(opened):
    """The two vectors of a racket, as they are drawn; the legend says which is which."""
    shown = opened(page("euler_top"))
    ends = f"Object.fromEntries({MOTION}.scene.drawn.map(([n, , to]) => [n, to.slice(0, 2)]))"
    seek(shown, 8)  # what is longest has been there
    seen = []
    for t in (1, 4, 7.5):
        seek(shown, t)
        seen.append(shown.evaluate(ends))
    ζ, momentum = (np.array([x[n] for x in seen]) for n in "12")
    assert np.abs(momentum - momentum[0]).max() < 1
    assert np.abs(ζ - ζ[0]).max() > 5
    told = ["ζ angular velocity in the body", "Π angular momentum in the body"]
    assert shown.locator(".legend span").all_inner_texts() == told


def test_the_ellipsoid_rolls_and_the_momentum_is_dragged(opened):
    """In space ℓ stays, and the end of the velocity is always as far along it; dragged on the
    ellipsoid it begins a motion of the same energy."""
    moments, start = np.array([1, 1.6, 2.2]), np.array([0.6, 3.0, 1.0])
    given = {f"zeta_{k + 1}": float(v) for k, v in enumerate(start)}
    shown = opened(derived("euler_top").motion_page(5.0, start=given))
    shown.wait_for_timeout(100)
    shown.evaluate(DRAWN, 1)
    seek(shown, 1.0)
    assert "ℓ" not in shown.evaluate("drawn.letters")
    shown.check("figure .within input")
    seen = []
    for t in (1.0, 2.0, 3.5):
        seek(shown, t)
        seen.append(shown.evaluate("[drawn.letters['ℓ'], drawn.letters['ζ₃'], drawn.dots[0]]"))
    seen = np.array(seen)
    assert np.abs(seen[:, 0] - seen[0, 0]).max() < 0.1
    assert np.abs(seen[:, 1:] - seen[0, 1:]).max(0).min() > 2
    box, (x, y) = shown.locator(".side").bounding_box(), seen[-1, 2]
    shown.mouse.move(box["x"] + x, box["y"] + y)
    shown.mouse.down()
    shown.mouse.move(box["x"] + x + 12, box["y"] + y - 9)
    shown.mouse.up()
    now = np.array(shown.evaluate(STATE)[-3:])
    assert shown.evaluate(f"{MOTION}.time") == 0
    assert np.abs(now - start).max() > 0.05
    assert np.sum(moments * now**2) == pytest.approx(np.sum(moments * start**2), rel=1e-12)


def test_seen_from_the_body_its_points_stay(opened):
    """And in space they do not; what deforms has no such view."""
    masses = [{"mass": 1, "at": [0.3, -0.7, 0.2]}, {"mass": 2, "at": [0.4, 0.2, -0.5]}]
    masses.append({"mass": 1, "at": [-0.5, 0.1, 0.6]})
    free = {"name": "free", "group": "SE(3)", "point": masses}
    d = derive.derive(problem_of(free))
    shown = opened(d.motion_page(3.0, start={"zeta_1": 1.3, "zeta_3": 0.4, "w_2": 0.5}))
    shown.wait_for_timeout(100)
    shown.evaluate(DRAWN, 0)

    def points(t):
        seek(shown, t)
        return np.array(shown.evaluate("drawn.dots"))

    assert points(0.5).shape == (4, 2)  # the masses, and the head of the trail
    assert np.abs(points(0.5) - points(2.5)).max() > 5
    shown.check(".controls .within input")
    assert np.abs(points(0.5) - points(2.5)).max() < 1e-6
    assert opened(derived("sl3").motion_page(1.0)).locator(".within").count() == 0


def test_a_reading_that_is_no_number_is_a_gap_and_told(opened):
    """Not a line across, nor an empty graph: √(cos θ − ¾) of a pendulum that swings beyond."""
    text = {"name": "root", "y": ["sqrt(A_11 - 0.75)"]}
    bob, down = {"mass": 1, "at": [0, -1]}, {"kind": "gravity", "g": [0, -9.81]}
    swing = {"name": "swing", "group": "SO(2)", "point": [bob], "potential": [down]}
    d = derive.derive(problem_of(swing | {"output": [text]}))
    shown = opened(d.motion_page(3.0, start={"zeta_1": 3.0}))
    shown.wait_for_timeout(100)
    shown.evaluate(DRAWN, shown.locator("canvas").count() - 1)
    seek(shown, 2.9)
    curve = max((x for _, x in shown.evaluate("drawn.strokes")), key=len)
    there = np.isfinite(np.array(curve)[:, 1])
    assert (there[1:] != there[:-1]).sum() >= 4
    begins = [round(y, 6) for _, y in shown.evaluate("drawn.begins")]
    assert {round(curve[k + 1][1], 6) for k in np.flatnonzero(~there[:-1] & there[1:])} <= {*begins}
    assert any(
        re.fullmatch(r"\d+ NaN, t = 0\.\d+ …", x)
        for x in shown.evaluate("Object.keys(drawn.letters)")
    )


def test_a_curve_ends_where_its_time_does(opened):
    """What leads to its name is of another colour, that of no curve."""
    shown = opened(derived("hung_bar").motion_page(2.0))
    shown.wait_for_timeout(100)
    shown.evaluate(DRAWN, 1)
    seek(shown, 1.5)
    strokes = [(x, np.array(line)) for x, line in shown.evaluate("drawn.strokes")]
    axes = strokes[0][1]
    curves = [(x, line) for x, line in strokes if len(line) > 20]
    assert len(curves) == 3
    colours = {x for x, _ in curves}
    for colour, line in strokes:
        assert colour not in colours or line[:, 0].max() <= axes[:, 0].max() + 1e-9
    state = shown.evaluate(STATE)[6:]
    ends = [line[-1, 1] for _, line in curves]  # in the order of their names, the highest first
    assert np.all(np.diff(ends) > 0)
    span = (ends[0] - ends[-1]) / (max(state) - min(state))
    assert ends == pytest.approx([ends[0] + span * (v - max(state)) for v in sorted(state)[::-1]])


COLOURS = """(places) => {
    const c = document.querySelector("canvas"), f = c.width/c.clientWidth;
    const { data } = c.getContext("2d").getImageData(0, 0, c.width, c.height);
    const long = Math.min(c.clientWidth - 130, c.clientHeight - 40);
    const [X, Y] = [(c.clientWidth - long)/2, (c.clientHeight - long)/2 - 8];
    const at = ([x, y]) => Math.floor(f*(Y + long*(1 - y)))*c.width + Math.floor(f*(X + long*x));
    return places.map((x) => [...data.slice(4*at(x), 4*at(x) + 3)]);
}"""


def test_vorticity_is_seen_where_it_is(opened):
    """On the square of one period, the second coordinate up: where it is positive more red."""
    shown = opened(page("zeitlin"))
    seek(shown, 0.1)
    d = derived("zeitlin")
    names = moving_program(d.problem, d.record, sought=False)[0].state
    state = dict(zip(names, shown.evaluate(STATE), strict=True))
    places = np.random.default_rng(1).uniform(0.02, 0.98, (400, 2))
    field = np.zeros(len(places))
    for name, re_n in state.items():
        letter, *n = name.replace("m", "-").split("_")
        phase = 2 * np.pi * places @ [*map(int, n)]
        field += 2 * (re_n * np.cos(phase) if letter == "re" else -re_n * np.sin(phase))
    red, _, blue = np.transpose(shown.evaluate(COLOURS, places.tolist()))
    strong = np.abs(field) > 0.3 * np.abs(field).max()
    assert 150 < strong.sum() < 400
    assert np.all((red > blue)[strong] == (field > 0)[strong])


# ---------------------------------------------------------------- what moves


@pytest.mark.dist
@pytest.mark.parametrize("name", [x for x in ready_made() if x not in PAGELESS])
def test_it_moves_and_keeps_what_is_kept(name, opened):
    shown = opened(page(name))
    shown.wait_for_timeout(200)
    assert shown.evaluate(f"{MOTION}.time") == 0
    seek(shown, 0.5)
    ink = shown.evaluate(INK)
    assert min(ink) > 0.002
    if name not in STARTS:
        return
    thin = 0.015 if name == "hammer" else 0.03  # of a hammer most is its handle
    assert ink[0] > thin or name == "euler_poisson"  # the body, not the ground alone
    assert max(shown.evaluate(CHANGES)) < 1e-9
    shown.get_by_role("button", name="play").click()
    shown.wait_for_function(f"{MOTION}.time > 0.501")
    shown.keyboard.press("Escape")
    shown.get_by_role("button", name="pause").click()
    after = shown.evaluate(f"{MOTION}.time")
    shown.wait_for_timeout(200)
    assert shown.evaluate(f"{MOTION}.time") == after
    seek(shown, 10.0)
    assert max(shown.evaluate(CHANGES)) < 1e-9
    if name == "sl3":
        run = derived(name).simulate(10.0, points=1, tol=1e-12, **STARTS[name])
        assert np.abs(np.array(shown.evaluate(STATE)) - run.states[-1]).max() < 1e-7


@pytest.mark.dist
def test_the_trail_follows_the_speed_that_is_set(opened):
    """The tip of an axis that turns fast about another goes a small angle between two points."""
    shown = opened(derived("top").motion_page(10.0, start={"zeta_1": 0.5}))
    set_to(shown, "zeta_1", "50")
    seek(shown, 1.0)
    shown.get_by_role("button", name="play").click()
    shown.wait_for_function(f"{MOTION}.time > 1.2")
    shown.get_by_role("button", name="pause").click()
    trail = shown.evaluate(f"{MOTION}.trail.map(([t]) => t)")
    assert 480 - 8 < len(trail) <= 480 + 1  # whole cells of at most 8 instants, and now
    assert np.diff(trail).min() > 0
    assert np.diff(trail).max() < 0.2 / 50


@pytest.mark.dist
def test_it_plays_by_itself_where_motion_is_welcome(opened):
    shown = opened(page("two_tops"), reduced_motion="no-preference")
    shown.wait_for_function(f"{MOTION}.time > 0.2")


@pytest.mark.dist
def test_a_collision_is_told(opened):
    at_rest = dict.fromkeys(("T_1", "w_2", "zeta_3"), 0.0)  # about the centre, to which they fall
    shown = opened(derived("comet").motion_page(1.0, start=at_rest))
    shown.evaluate(f"{MOTION}.seek(1)")
    message = 'document.querySelector(".message").textContent'
    shown.wait_for_function(f'{message}.includes("collision")')


# ---------------------------------------------------------------- numbers, sliders, keys


@pytest.mark.dist
@pytest.mark.parametrize("width", [390, 1280])
def test_a_wrong_number_is_told_where_it_is_and_keys_move(width, opened):
    """tests/playground/test_moving.py has the sliders."""
    shown = opened(page("top"), width)
    row = set_to(shown, "R", "0")
    told = shown.get_by_role("status")
    assert told.inner_text() == "No body has these numbers: R = 0."
    assert row.get_by_role("status").count() == 1
    box = told.bounding_box()
    assert 0 <= box["y"] <= 844 - box["height"]
    energy = shown.locator('tr[data-name="energy"] td').first
    assert energy.inner_text() == ""
    set_to(shown, "R", "0.03")
    assert told.inner_text() == ""
    assert energy.inner_text() != ""
    shown.evaluate("document.activeElement.blur()")
    shown.keyboard.press("ArrowRight")
    shown.wait_for_function(f"{MOTION}.time > 0")
    shown.keyboard.press("Home")
    shown.wait_for_function(f"{MOTION}.time === 0")
    before = shown.locator("canvas").first.screenshot()
    shown.locator("canvas").first.focus()
    shown.keyboard.press("ArrowLeft")
    shown.wait_for_timeout(100)
    assert shown.locator("canvas").first.screenshot() != before
    assert shown.evaluate(f"{MOTION}.time") == 0
    shown.keyboard.press("Space")
    shown.wait_for_function(f"{MOTION}.time > 0")


@pytest.mark.dist
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_on_a_phone_by_night_in_french(scheme, opened):
    shown = opened(page("top", "fr"), 390, color_scheme=scheme, has_touch=True)
    shown.wait_for_timeout(100)
    assert shown.evaluate("document.documentElement.scrollWidth") == 390
    assert shown.locator("canvas").first.bounding_box()["height"] > 300
    assert min(shown.evaluate(INK)) > 0.002
    sizes = '[...document.querySelectorAll(".controls button")].map((b) => b.offsetHeight)'
    assert min(shown.evaluate(sizes)) >= 44
    colour = shown.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, re.findall(r"\d+", colour))) > 380) == (scheme == "light")
    assert "t = 0,00" in shown.locator(".clock").inner_text()
    # a number has a comma or a point, and nothing else
    g = f"{MOTION}.given.p[3]"
    for text, value in (("1,5", 1.5), ("2.25", 2.25), ("−3e-1", -0.3)):
        set_to(shown, "g", text)
        assert shown.evaluate(g) == value
    for text in ("1,234.5", "five", "", "1e999"):
        box = set_to(shown, "g", text).locator("input[inputmode]")
        assert box.get_attribute("aria-invalid") == "true"
        assert shown.get_by_role("status").inner_text() == "Ce n’est pas un nombre."
        assert shown.evaluate(g) == -0.3
    set_to(shown, "g", "9,81")
    assert box.get_attribute("aria-invalid") == "false"


@pytest.mark.dist
def test_a_component_along_no_direction_is_not_shown(opened):
    """Along gravity, in its unit; without gravity those along the axes, which are kept then.  And a
    slider spins the body both ways."""
    shown = opened(page("so3"))
    spin = shown.locator('[data-name="zeta_3"] [role=slider]')
    ends = (float(spin.get_attribute(f"aria-value{x}")) for x in ("min", "max"))
    assert next(ends) < 0 < next(ends)
    row = "[...document.querySelectorAll('[data-name=angular_momentum]')].map((x) => x.innerText)"
    along = row.replace("name=", "name^=")
    (only,) = shown.evaluate(row)
    assert "kg m²/s" in only
    set_to(shown, "g_3", "0")
    assert shown.evaluate(row) == []
    assert [x.split()[:3] for x in shown.evaluate(along)] == [
        ["angular", "momentum", str(k)] for k in (1, 2, 3)
    ]
    set_to(shown, "g_1", "1")
    assert len(shown.evaluate(row)) == len(shown.evaluate(along)) == 1


@pytest.mark.dist
def test_what_is_not_kept_stands_apart(opened):
    shown = opened(derived("jelly").motion_page(2.0, start={"zeta_1": 0.1}))
    groups = "[...document.querySelectorAll('tbody')].map((x) => x.innerText)"
    kept, others = shown.evaluate(groups)
    assert "energy" not in kept
    assert others.startswith("What is not kept")
    assert "energy" in others


@pytest.mark.dist
def test_texts_of_a_stranger_are_shown_as_text(hostile, opened):
    shown = opened(hostile)
    assert BAD in shown.locator('[data-name="a"]').inner_text()
    assert shown.locator("h1").inner_text() == BAD
    assert shown.locator("img").count() == 0


@pytest.mark.dist
@pytest.mark.parametrize("width", [1280, 390])
def test_what_is_beside_keeps_its_place(width, opened):
    """A value about 0.001, where small numbers begin to be powers of ten."""
    d, tilt = derived("top"), (0.3, 0, 0)
    spin = d.simulate(0.01, start={"zeta_3": 1.0}, exp=tilt, points=1)["body_angular_momentum_3"][0]
    shown = opened(d.motion_page(10.0, start={"zeta_3": 0.001 / spin}, exp=tilt), width)
    told, places = set(), set()
    for k in range(20):
        seek(shown, 0.0125 * 1.37**k)
        cell = shown.locator('[data-name="body_angular_momentum_3"] td').first
        told.add(cell.inner_text())
        places.add(shown.locator(".adjuster").first.bounding_box()["y"])
        assert shown.locator(".clock").bounding_box()["height"] < 30
    assert "0.0010000" in told
    assert {len(x) for x in told} == {9}
    assert len(places) == 1


PUSHED = """
name = "pushed"
group = "R(3)"
parameters = { a = 2.0, b = 4.0 }
point = [{ mass = 1, at = [0, 0, 0] }]
input = [{ name = "F", kind = "force", on = 1, frame = "space" }]
output = [{ name = "push", y = ["F_1"] }]
signal = [
  { input = "F_1", u = "b*cos(a*t)" },
  { input = "F_2", times = [0, 1, "b - 1"], values = [0, "a", 0], hold = false },
  { input = "F_3", times = [0, 2], values = [1, "-a"] },
]
"""


def test_inputs_follow_their_signals_until_they_are_set(opened):
    """By the integrals of the forces on a unit mass, and after one is typed, which is held."""
    d = derive.derive(problem_of(tomllib.loads(PUSHED)))
    shown = opened(d.motion_page(4.0))
    ways = {
        0.75: [2 * np.sin(1.5), 0.75**2, 0.75],
        2.5: [2 * np.sin(5.0), 1 + 3 - 2.25 / 2, 2 - 2 * 0.5],
        3.5: [2 * np.sin(7.0), 3, 2 - 2 * 1.5],
    }
    for t, w in ways.items():
        seek(shown, t)
        assert np.abs(np.array(shown.evaluate(STATE)[3:]) - w).max() < 1e-7
        scene = f"{MOTION}.scene"
        read = f"{scene}.page.module.outputs({t}, {STATE}, {MOTION}.run.k, {scene}.u)[0]"
        assert abs(shown.evaluate(read) - 4 * np.cos(2 * t)) < 1e-12
    set_to(shown, "F_1", "5")
    seek(shown, 2.5)
    assert np.abs(np.array(shown.evaluate(STATE)[3:]) - [12.5, *ways[2.5][1:]]).max() < 1e-7
    held = opened(d.motion_page(4.0, start={"F_1": 5.0}))
    seek(held, 2.5)
    assert abs(held.evaluate(STATE)[3] - 12.5) < 1e-7


READ = """
name = "read"
group = "SO(2)"
point = [{ mass = 1, at = [0, -1] }]
output = [
  { name = "hwheel_momentum", unit = "kg m^2/s", y = ["zeta_1"] },
  { name = "height", y = ["-A_11"] },
]
"""


def test_readings_are_called_whole_and_with_their_units_and_the_picture_is_saved(opened):
    shown = opened(derive.derive(problem_of(tomllib.loads(READ))).motion_page(4.0))
    shown.evaluate("""() => {
        const { prototype } = CanvasRenderingContext2D, own = prototype.fillText;
        globalThis.written = {};
        prototype.fillText = function (what, x, y) {
            globalThis.written[what] = x + this.measureText(what).width - this.canvas.clientWidth;
            own.call(this, what, x, y);
        };
    }""")
    seek(shown, 2)
    written = shown.evaluate("globalThis.written")
    assert written["hwheel momentum, kg m²/s"] <= 0
    assert written["height"] <= 0
    with shown.expect_download() as saved:
        shown.get_by_label("the picture, as PNG").click()
    assert saved.value.suggested_filename == "read.png"
    assert saved.value.path().read_bytes().startswith(b"\x89PNG")
