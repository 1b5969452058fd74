"""The body that moves in the playground: what is kept, its sliders, numbers into the text, what is
said of it; and that nothing is asked of others. Also by keys, on a phone and for screen readers."""

import tomllib

import numpy as np
import pytest

from tests.support.library import module_of
from tests.support.motion_pages import adjuster, set_to
from tests.support.played import text_of
from tests.support.playground_site import (
    asked,
    chosen,
    moving,
    opened,
    put,
    rewalked,
    text_in,
    typed,
    violations,
    visit,
    walked,
)

MOTION = "document.getElementById('motion').motion"
STATE = f"""(t) => {{
    {MOTION}.seek(t);
    {MOTION}.run.reach(t, Infinity);
    return [...{MOTION}.run.at(t)];
}}"""
LISTED = "[...document.querySelectorAll('tr[data-name]')].map((x) => x.dataset.name)"


def until(frame, expression, too=lambda: True):
    """Wait until an expression of the frame is true; its policy lets no script wait for a text."""
    for _ in range(100):
        if frame.evaluate(expression) and too():
            return
        frame.page.wait_for_timeout(100)
    pytest.fail(f"never: {expression}")


def apart(x, y):
    return max(abs(a - b) for a, b in zip(x, y, strict=True))


def change(frame, name):
    """By how much a number has changed."""
    return number(frame.inner_text(f"[data-name={name}] td + td"))


def number(shown):
    """A number as a page shows it."""
    return float(shown.replace("·10", "e").translate(str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")))


def shown_at(frame, t):
    """Seek an instant, and wait until it is drawn."""
    frame.evaluate(STATE, t)
    frame.wait_for_function(f"() => {MOTION}.time === {t}")
    frame.page.wait_for_timeout(200)


def slid(frame, **values):
    """Each number changes the motion, by keys and by dragging, and all goes back."""
    first = frame.evaluate(STATE, 1.0)
    for name, value in values.items():
        slider = adjuster(frame, name).locator("[role=slider]")
        was = float(slider.get_attribute("aria-valuenow"))
        slider.press("PageUp" if value > was else "PageDown")
        assert (float(slider.get_attribute("aria-valuenow")) > was) == (value > was)
        slider.scroll_into_view_if_needed()
        box, mouse = slider.bounding_box(), frame.page.mouse
        mouse.move(box["x"] + 4, box["y"] + 8)
        mouse.down()
        mouse.move(box["x"] + (204 if value > was else -196), box["y"] + 8, steps=4)
        mouse.up()
        assert apart(first, frame.evaluate(STATE, 1.0)) > 0.01, name
        frame.locator(".reset").click()
        assert frame.evaluate(STATE, 1.0) == first, name


def into_the_text(page, frame, **numbers):
    """Set numbers, and have them put into the text: the tables of before and of now; it moves as
    with the numbers that were set."""
    for name, value in numbers.items():
        set_to(frame, name, value)
    expected = frame.evaluate(STATE, 1.0)
    before = tomllib.loads(text_in(page))
    page.evaluate("delete document.body.dataset.walked")
    frame.locator(".into").click()
    walked(page, "own")
    assert apart(moving(page).evaluate(STATE, 1.0), expected) < 1e-9
    return before, tomllib.loads(text_in(page))


READ = f"""(t) => {{
    const {{ module }} = {MOTION}.scene.page, x = [...{MOTION}.run.at(t)];
    return [x, [...module.outputs(t, x, {MOTION}.run.k, [])]];
}}"""


def the_vectors_of_a_cone(frame):
    """ζ, Iζ, the torque of gravity about the apex and Iζ ∧ ζ, by the moments of a cone."""
    p = module_of("top").PARAMETERS
    rho, R, h, g = (frame.evaluate(f"{MOTION}.given.p")[p.index(x)] for x in ("rho", "R", "h", "g"))
    x, read = frame.evaluate(READ, 0.3)
    m = np.pi * rho * R**2 * h / 3
    inertia = m * np.diag([0.6 * h**2 + 0.15 * R**2] * 2 + [0.3 * R**2])
    A, zeta = np.reshape(x[:9], (3, 3)), np.array(x[9:])
    weight = np.cross([0, 0, 0.75 * m * h], A.T @ [0, 0, -g])
    turned = inertia @ zeta
    expected = [zeta, turned, weight, np.cross(turned, zeta)]
    assert np.allclose(np.reshape(read, (4, 3)), expected, rtol=1e-9, atol=1e-15)


def the_arrows_and_the_letters(page, frame):
    """What is pointed at in the equations is lit on the body, and the other way."""
    lit = f"{MOTION}.scene.lit"
    on = page.locator("#answer p .on")
    page.locator("#answer p [data-arrow='3']").hover()
    until(frame, f"{lit} === 3")
    assert on.count() == 1
    page.locator(".legend button").first.focus()
    until(frame, f"{lit} === 1")
    assert on.count() == 7  # ζ in j(ζ), twice in Iζ ∧ ζ, and four of its numbers
    shown_at(frame, 0)
    _, _, tip = frame.evaluate(f"{MOTION}.scene.drawn.at(-1)")
    box = frame.locator("canvas").first.bounding_box()

    def pointed():
        page.mouse.move(box["x"] + tip[0], box["y"] + tip[1], steps=2)
        return page.locator("#answer .legend .on").count() == 1

    until(frame, "true", pointed)
    until(frame, f"{lit} > 0")
    number = frame.evaluate(lit)
    assert on.first.get_attribute("data-arrow") == str(number)
    hue = page.evaluate("getComputedStyle(document.querySelector('#answer p .on')).color")
    drawn = frame.evaluate(f"{MOTION}.scene.colours.read('arrow-{number}')")
    assert hue == "rgb({}, {}, {})".format(*bytes.fromhex(drawn[1:]))


def test_a_top(fresh, site):
    visit(fresh, f"{site}#top", "top")
    frame = moving(fresh)
    the_vectors_of_a_cone(frame)
    the_arrows_and_the_letters(fresh, frame)
    # the wheel scrolls, and zooms with Ctrl alone
    frame.locator(".side").scroll_into_view_if_needed()
    scrolled = frame.evaluate("document.querySelector('.beside').scrollTop")
    side = frame.locator(".side").bounding_box()
    fresh.mouse.move(side["x"] + side["width"] / 2, side["y"] + side["height"] / 2)
    before = frame.locator(".side").screenshot()
    fresh.keyboard.down("Control")
    fresh.mouse.wheel(0, -300)
    fresh.keyboard.up("Control")
    until(frame, "true", lambda: frame.locator(".side").screenshot() != before)
    assert frame.evaluate("document.querySelector('.beside').scrollTop") == scrolled

    def at_the_end():
        fresh.mouse.wheel(0, 4000)
        last = frame.locator(".keys").bounding_box()
        return last["y"] + last["height"] <= 800

    until(frame, "true", at_the_end)
    # every parameter and number of the start can be set, those that are not 0 at sight
    names = frame.evaluate(
        "[...document.querySelectorAll('.values .adjuster')].map((x) => x.dataset.name)"
    )
    start = ["zeta_1", "zeta_2", *(f"theta_{k}" for k in (1, 2, 3))]
    assert names == ["zeta_3", *module_of("top").PARAMETERS, *start]
    slid(frame, g=5.0, zeta_1=40.0, theta_1=0.4)
    # what is kept is found behind the motion, and stays
    fresh.wait_for_selector("iframe[data-kept]", timeout=90_000)
    shown_at(frame, 3)
    kept = ["energy", "angular_momentum_3", "body_angular_momentum_3"]
    assert frame.evaluate(LISTED) == [*kept, "defect"]
    assert max(change(frame, x) for x in kept) < 1e-8
    set_to(frame, "zeta_1", "3", "Enter")
    fresh.wait_for_timeout(200)
    assert frame.inner_text("[data-name=body_angular_momentum_3] td + td") == "0"
    frame.locator(".reset").click()
    before, after = into_the_text(fresh, frame, g="3,5", zeta_3="40")
    assert after["parameters"]["g"] == before["parameters"]["g"] | {"default": 3.5}
    assert after["initial"] == before["initial"] | {"zeta_3": 40}


def test_numbers_in_french_have_a_comma(fresh, site):
    """In the fields, typed with a comma or a point; in the text they have a point."""
    visit(fresh, f"{site}?lang=fr#top", "top")
    frame = moving(fresh)
    row = adjuster(frame, "g")
    assert row.locator("[role=slider]").inner_text() == "9,81"
    for typed_, now in (("3,5", 3.5), ("−2.25", -2.25), (",5", 0.5), ("1e1", 10)):
        set_to(frame, "g", typed_, "Enter")
        assert float(row.locator("[role=slider]").get_attribute("aria-valuenow")) == now
    row.locator("[role=slider]").press("4")  # a digit begins, a comma goes on
    row.locator("input").press_sequentially(",25")
    row.locator("input").press("Enter")
    assert row.locator("[role=slider]").inner_text() == "4,25"
    set_to(frame, "g", "4,,25", "Enter")
    assert row.locator("input").get_attribute("aria-invalid") == "true"
    assert "n’est pas un nombre" in row.inner_text()
    set_to(frame, "g", "4,25", "Enter")
    frame.locator(".two input[type=checkbox]").check()
    set_to(frame, "epsilon", "0,002", "Enter")
    assert frame.evaluate(f"{MOTION}.second.told")[1] == 0.002
    _, after = into_the_text(fresh, frame, g="4,25")
    assert after["parameters"]["g"]["default"] == 4.25
    fresh.click("#as-form")
    field = fresh.locator("[data-mark='1.g']")
    field.fill("0,125")
    with rewalked(fresh):
        field.press("Tab")
    assert tomllib.loads(text_in(fresh))["parameters"]["g"]["default"] == 0.125


DRAWN = f"{MOTION}.scene.drawn.map(([number]) => number)"


def test_arrows_in_a_plane_of_two_bodies_and_of_points(fresh, site):
    """An arc out of the plane, one arrow a body, and one at each point."""
    for name, expected in {
        "pendulum": [1] * 16 + [2] * 16,
        "two_tops": [1, 2, 3, 3],  # the velocity of each, their torques
        "sl3": [1] * 4 + [2] * 4 + [3] * 4 + [4] * 4,
    }.items():
        visit(fresh, f"{site}#{name}", name)
        frame = moving(fresh)
        frame.evaluate(STATE, 0.4)
        until(frame, f"{DRAWN}.length > 0 && {MOTION}.time === 0.4")
        assert frame.evaluate(DRAWN) == expected
        buttons = fresh.locator("#answer .legend button")
        assert buttons.count() == len({*expected})
        fresh.mouse.move(0, 0)  # it may be over the equations, which light theirs
        buttons.last.focus()
        until(frame, f"{MOTION}.scene.lit === {expected[-1]}")


CURVE = """() => {
    window.lines = [];
    for (const canvas of document.querySelectorAll(".graph canvas")) {
        const pen = canvas.getContext("2d");
        const own = [pen.beginPath, pen.lineTo, pen.stroke];
        const [begin, line, stroke] = own.map((x) => x.bind(pen));
        let path = [];
        pen.beginPath = () => { path = []; begin(); };
        pen.lineTo = (x, y) => { path.push(y); line(x, y); };
        pen.stroke = () => { window.lines.push(path); stroke(); };
    }
}"""
"""Keeps the heights of the lines of the graph."""


def test_a_graph_of_what_is_chosen(fresh, site):
    """The tilt goes with A₃₃, and what is kept is level; what starts at 0 is offered later."""
    visit(fresh, f"{site}#top", "top")
    frame = moving(fresh)
    fresh.wait_for_selector("iframe[data-kept]", state="attached")
    offered = frame.locator(".graph option").all_text_contents()
    assert offered[0] == "cosine of the tilt of the third axis"
    assert [x.split()[0] for x in offered[1:5]] == ["ζ₃", "ζ₁", "ζ₂", "energy"]
    frame.evaluate(CURVE)

    def heights(k):
        frame.select_option(".graph select", index=k)
        shown_at(frame, 0.3)
        return frame.evaluate("window.lines.findLast((x) => x.length > 20)")

    tilt, energy = np.array(heights(0)), np.array(heights(4))
    trail = np.array(frame.evaluate(f"{MOTION}.trail.slice(1).map(([, x]) => x[8])"))
    assert np.abs(np.corrcoef(trail, -tilt)[0, 1] - 1) < 1e-9
    assert np.ptp(tilt) > 20
    assert np.ptp(energy) < 1e-3


SLOWEST = """async ([does, until]) => {
    let slowest = 0, frames = 0;
    const each = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (f) => each((now) => {
        const begin = performance.now();
        f(now);
        slowest = Math.max(slowest, performance.now() - begin);
        frames += 1;
    });
    does === "seek" ? MOTION.seek(until) : MOTION.play();
    await new Promise((done) => {
        const look = () => (MOTION.time >= until ? done() : setTimeout(look, 50));
        look();
    });
    MOTION.pause();
    window.requestAnimationFrame = each;
    return [frames, slowest];
}""".replace("MOTION", MOTION)
"""How many frames a motion took, and the milliseconds of the script in the slowest."""


def test_two_motions_side_by_side_for_longer(fresh, site):
    """The second is that of a reader who sets the number; the graph has both and their distance."""
    visit(fresh, f"{site}#top", "top")
    frame = moving(fresh)
    frame.locator(".two input[type=checkbox]").check()
    frame.locator(".two select").select_option("zeta_3")
    first = frame.evaluate(STATE, 2.0)
    run = f"{MOTION}.scene.other"
    second = frame.evaluate(f"({run}.reach(2, Infinity), [...{run}.at(2)])")
    assert 1e-4 < apart(first, second) < 10
    frame.evaluate(CURVE)
    shown_at(frame, 2)
    lines = [x for x in frame.evaluate("window.lines") if len(x) > 20]
    two, one, distance = lines[-3:]
    assert np.ptp(one) > 10
    assert 0 < apart(one, two) < np.ptp(one)
    tilts = frame.evaluate(f"{MOTION}.trail.slice(1).map(([, x, y]) => x[8] - y[8])")
    expected = np.log10(np.abs(tilts))
    assert np.abs(np.corrcoef(expected, -np.array(distance))[0, 1] - 1) < 1e-9
    assert frame.locator(".graph figure canvas").is_visible()
    # it goes on, in frames that stay short, and what was there stays
    assert frame.evaluate(f"{MOTION}.until") == 20
    frame.locator(".controls select").first.select_option("160 s")
    frames, slowest = frame.evaluate(SLOWEST, ["seek", 150])
    assert frames > 5
    assert slowest < 1000
    assert apart(frame.evaluate(STATE, 2.0), first) < 1e-6
    shown_at(frame, 150)
    assert change(frame, "energy") < 1e-8
    # alone again, from the number that the second began with
    frame.locator(".two input[type=checkbox]").uncheck()
    assert frame.evaluate(f"{run} === null")
    assert not frame.locator(".graph figure canvas").is_visible()
    set_to(frame, "zeta_3", "100.1")
    assert frame.evaluate(STATE, 2.0) == second


def test_other_bodies(fresh, site):
    visit(fresh, f"{site}#sl3", "sl3")
    slid(moving(fresh), zeta_1=3.0)
    # a body that becomes flat is told, and a smaller push does not make it so
    message = "document.querySelector('.message').textContent"
    chosen(fresh, "gl3")
    frame = moving(fresh)
    frame.evaluate(STATE, 20.0)
    until(frame, f"{message}.includes('det A = 0')")
    chosen(fresh, "jelly")
    frame = moving(fresh)
    frame.evaluate(STATE, 20.0)
    assert frame.evaluate(f"{MOTION}.run.last") == 20.0
    assert frame.evaluate(message) == ""
    # a push is told only where there is one
    note = fresh.locator("#see .note")
    chosen(fresh, "comet")  # it has a velocity in [initial]
    moving(fresh)
    assert "pushed" not in note.inner_text()
    typed(fresh, text_of("sim3").partition("[initial]")[0])
    frame = moving(fresh)
    assert "pushed" in note.inner_text()
    _, after = into_the_text(fresh, frame, theta_2="-0.25")  # with the velocity of the push
    assert after["initial"]["exp"] == [0, -0.25, 0, 0, 0, 0, 0]
    chosen(fresh, "so3")
    _, after = into_the_text(fresh, moving(fresh), u_2="0,5")
    assert after["initial"]["u_2"] == 0.5
    assert not {"u_1", "u_3"} & {*after["initial"]}
    # what moves when the text is wrong is dim
    fresh.evaluate("delete document.body.dataset.walked")
    put(fresh, 'name = "so3"\ngroup = 3\n')
    fresh.wait_for_selector("iframe.stale", timeout=10_000)
    assert note.inner_text().startswith("The text has changed")
    walked(fresh, "fault")
    assert fresh.locator("iframe.stale").count() == 1


SHORT = """() => {
    const sought = (x) => document.getElementById("state").textContent === x;
    const seconds = () => (sought("What is kept is sought …") ? 0.2 : 60);
    Object.defineProperty(play.engine, "seconds", { get: seconds });
}"""
"""The clock is short for the search alone."""
STOPPED = "What is kept was not found in 0.2 s: the motion goes on."


def test_a_search_that_the_clock_ends_leaves_the_motion_running(fresh, site):
    visit(fresh, f"{site}#top", "top")
    typed(fresh, f"{text_of('top')}\n")  # what is kept is sought here
    fresh.evaluate(SHORT)
    fresh.click("#tab-see")
    says = "(x) => document.getElementById('state').textContent.startsWith(x)"
    fresh.wait_for_function(says, arg=STOPPED, timeout=90_000)
    assert "\n" not in fresh.inner_text("#state")
    assert fresh.locator("iframe[data-moved]:not([data-kept]):not(.stale)").count() == 1
    frame = fresh.frames[-1]
    now = frame.evaluate(f"{MOTION}.time")
    until(frame, f"{MOTION}.time > {now + 0.05}")
    assert frame.evaluate(LISTED) == ["energy", "defect"]
    fresh.click("#tab-walk")
    fresh.click("#tab-see")  # it is not sought again
    fresh.wait_for_timeout(300)
    assert fresh.inner_text("#state") == STOPPED


SCRIPT = """() => {
    const made = document.createElement("script");
    made.textContent = "window.ran = 1";
    document.body.append(made);
    return window.ran ?? "blocked";
}"""


LABEL = "(document.activeElement.ariaLabel || '') + document.activeElement.id"
NUMBER = "document.activeElement.closest('[data-name]')?.dataset.name ?? ''"
VALUE = "document.activeElement.ariaValueNow ?? document.activeElement.value"


def tabbed(page, told, name, where=None):
    """Tab until the focus is there."""
    for _ in range(60):
        page.keyboard.press("Tab")
        if (where or page).evaluate(told) == name:
            return
    raise AssertionError(f"{name} is not reached by Tab")


def test_a_parameter_is_set_by_keys_alone(fresh, site):
    """In the sentence, and beside what moves; nothing is clicked or focused by a script."""
    visit(fresh, f"{site}#top", "top")
    fresh.evaluate("document.activeElement.blur()")
    tabbed(fresh, LABEL, "as-sentence")
    fresh.keyboard.press("Enter")
    tabbed(fresh, LABEL, "radius of the base")
    fresh.keyboard.press("ArrowDown")
    assert fresh.evaluate(VALUE) == "0.029"
    fresh.keyboard.press("Control+a")
    fresh.keyboard.type("0.05")
    fresh.keyboard.press("Enter")
    tabbed(fresh, LABEL, "tab-walk")
    fresh.keyboard.press("ArrowRight")
    fresh.wait_for_selector("iframe[data-moved]", timeout=90_000)
    frame = moving(fresh)
    tabbed(fresh, NUMBER, "R", frame)
    assert frame.evaluate(VALUE) == "0.05"
    before = frame.evaluate(STATE, 1.0)
    fresh.keyboard.press("ArrowUp")
    assert float(frame.evaluate(VALUE)) > 0.05
    fresh.keyboard.press("Enter")
    fresh.keyboard.press("Control+a")
    fresh.keyboard.type("0.08")
    fresh.keyboard.press("Enter")
    assert frame.evaluate(VALUE) == "0.08"
    assert apart(before, frame.evaluate(STATE, 1.0)) > 0.01


def test_by_keys_and_nothing_is_asked_of_others(newcomer, site):
    visit(newcomer, f"{site}#so3")
    newcomer.evaluate("document.activeElement.blur()")
    reached = []
    for _ in range(32):  # each word of the sentence is one
        newcomer.keyboard.press("Tab")
        focus = "document.activeElement.id || document.activeElement.className"
        reached.append(newcomer.evaluate(focus))
    for id in ("ready", "as-text", "as-form", "link", "cm-content", "tab-walk", "check", "walk"):
        assert any(id in x for x in reached), (id, reached)
    newcomer.focus("#tab-walk")
    for key, tab in (
        ("End", "take"),
        ("ArrowRight", "walk"),
        ("ArrowLeft", "take"),
        ("Home", "walk"),
    ):
        newcomer.keyboard.press(key)
        assert newcomer.evaluate("document.activeElement.id") == f"tab-{tab}"
    newcomer.keyboard.press("ArrowRight")
    newcomer.wait_for_selector("iframe[data-moved]", timeout=90_000)
    assert newcomer.evaluate("document.activeElement.id") == "tab-see"
    # it moves, and keeps its energy
    frame = moving(newcomer)
    first, last = (frame.evaluate(STATE, t) for t in (0, 10))
    assert apart(first, last) > 0.1
    shown_at(frame, 10)
    assert change(frame, "energy") < 1e-9
    # nothing was asked of others, and nothing may be
    assert newcomer.asked
    assert all(x.startswith((site, "blob:")) for x in newcomer.asked)
    assert not newcomer.told
    elsewhere = "fetch('http://127.0.0.2:9/x').then(() => 'came', () => 'refused')"
    assert newcomer.evaluate(elsewhere) == "refused"
    assert any("Content Security Policy" in x for x in newcomer.told)
    asked(newcomer, "walk", text="", lang="en")  # there is Python
    (worker,) = newcomer.workers
    assert worker.evaluate(elsewhere) == "refused"
    assert frame.evaluate("fetch('motion.css').then(() => 'came', () => 'refused')") == "refused"
    assert not [x for x in newcomer.asked if "127.0.0.2" in x]
    assert newcomer.evaluate(SCRIPT) == "blocked"
    newcomer.told.clear()


def test_on_a_phone_all_is_in_one_page_and_sides_together(browser, site):
    phone = {"width": 390, "height": 844}
    with opened(browser, viewport=phone, has_touch=True) as page:
        visit(page, f"{site}#so3/linear.pullback")
        step = "article[id='linear.pullback']"
        buttons = page.locator(f"#walk {step} .number button")
        assert buttons.count() == 8
        assert buttons.first.is_visible()
        sides = f"""(side) => [...play.equations.root.querySelectorAll(
            `{step} .${{side}}`)].map((x) => x.getBoundingClientRect())"""
        for left, right in zip(*(page.evaluate(sides, x) for x in ("left", "right")), strict=True):
            assert right["top"] < left["bottom"]
            assert right["left"] >= left["right"]
        page.click("#tab-find")  # what is found, later, is seen from its beginning
        page.wait_for_selector("#find article", state="attached", timeout=90_000)
        first, bar = (page.locator(x).first.bounding_box() for x in ("#find article", ".read .bar"))
        assert bar["y"] < first["y"] < 844
        chosen(page, "top")
        frame = moving(page)
        canvases = "[...document.querySelectorAll('canvas')]"
        touch = f"{canvases}.map((x) => getComputedStyle(x).touchAction)"
        assert {*frame.evaluate(touch)} == {"pan-y"}
        until(frame, "document.documentElement.scrollHeight - innerHeight < 4 && innerHeight > 900")
        assert frame.locator("canvas").first.bounding_box()["height"] < 0.5 * 844
        frame.locator(".keys").scroll_into_view_if_needed()
        assert page.evaluate("scrollY") > 200
        assert frame.locator(".keys").is_visible()


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [390, 1280])
def test_screen_readers_and_contrast(browser, site, width, dark):
    """Of each part of the page, and of the frame with all its groups open; by night, which changes
    colours alone, of the part that is another."""
    scheme = "dark" if dark else "light"
    size = {"width": width, "height": 800}
    with opened(browser, viewport=size, color_scheme=scheme, locale="fr-FR") as page:
        visit(page, f"{site}#jelly", "jelly")
        for tab in ("walk", "take", "see"):
            page.click(f"#tab-{tab}")
            if tab == "see":
                page.wait_for_selector("iframe[data-moved]", timeout=90_000)
            assert page.evaluate("document.documentElement.scrollWidth") <= width, tab
            assert not violations(page, f"#{tab}" * dark), tab
        page.click("#project")
        for key in ("Home", "End"):
            page.keyboard.press(key)
            assert page.evaluate("document.documentElement.scrollWidth") <= width, key
            assert not violations(page, "#projector" * dark), key
        page.keyboard.press("Escape")
        page.click("#as-form")
        page.wait_for_selector("#form > *")
        assert not violations(page, "#form" * dark), "form"
        chosen(page, "top")
        frame = moving(page)
        frame.evaluate("for (const x of document.querySelectorAll('details')) x.open = true")
        assert not violations(frame), "the body"
