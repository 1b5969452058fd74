"""The motion in the playground: its sliders, its page for screen readers, and the notebook that is
taken, run whole."""

import json
import shutil
import subprocess
import tomllib

import pytest

from tests.support.flows import emitted
from tests.support.needs import need
from tests.support.playground_site import OWN, walked

STATE = """(t) => {
    const { motion } = document.getElementById("motion");
    motion.seek(t);
    motion.run.reach(t, Infinity);
    return [...motion.run.at(t)];
}"""


def moving(opened, site, name):
    """The frame in which a ready-made problem moves."""
    opened.goto(f"{site}#{name}")
    walked(opened, name)
    opened.click("#tab-see")
    opened.wait_for_selector("iframe[data-moved]", timeout=90_000)
    frame = opened.frames[-1]
    frame.evaluate("document.getElementById('motion').motion.pause()")
    return frame


def until(frame, expression, too=lambda: True):
    """Wait until an expression of the frame is true; its policy lets no script wait for a text."""
    for _ in range(100):
        if frame.evaluate(expression) and too():
            return
        frame.page.wait_for_timeout(100)
    pytest.fail(f"never: {expression}")


@pytest.mark.parametrize(
    ("name", "adjusted"),
    [("top", {"g": 5.0, "zeta_1": 40.0, "theta_1": 0.4}), ("sl3", {"zeta_1": 3.0})],
)
def test_sliders_change_the_motion_and_all_goes_back(fresh, site, name, adjusted):
    frame = moving(fresh, site, name)
    first = frame.evaluate(STATE, 1.0)
    for slider, value in adjusted.items():
        row = frame.locator(f'[data-name="{slider}"]')
        row.locator("xpath=ancestor::details").evaluate("(e) => { e.open = true; }")
        row.locator("input[type=range]").fill(str(value))
        then = frame.evaluate(STATE, 1.0)
        assert max(abs(a - b) for a, b in zip(first, then, strict=True)) > 0.01
        frame.locator(".reset").click()
        assert frame.evaluate(STATE, 1.0) == first


def test_every_parameter_and_number_of_the_start_has_a_slider(fresh, site):
    frame = moving(fresh, site, "top")
    shown = frame.evaluate("[...document.querySelectorAll('.adjuster')].map((x) => x.dataset.name)")
    code = emitted("top")
    start = [f"{x}_{k}" for x in ("zeta", "theta") for k in (1, 2, 3)]
    assert shown == [*start, *code.PARAMETERS]


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [390, 1280])
def test_the_moving_page_for_screen_readers(browser, site, width, dark):
    scheme = "dark" if dark else "light"
    context = browser.new_context(viewport={"width": width, "height": 800}, color_scheme=scheme)
    opened = context.new_page()
    frame = moving(opened, site, "top")
    frame.evaluate("for (const x of document.querySelectorAll('details')) x.open = true")
    axe = (OWN / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")
    frame.evaluate(f"{axe}; 0")
    found = frame.evaluate("axe.run({ resultTypes: ['violations'] }).then((x) => x.violations)")
    told = [
        (x["id"], [y["html"][:120] + y["failureSummary"] for y in x["nodes"][:3]]) for x in found
    ]
    assert not told, json.dumps(told, indent=1)
    context.close()


def test_the_notebook_runs(fresh, site, tmp_path):
    need("the module nbclient", "the module nbformat", "the module ipykernel")
    import nbclient
    import nbformat

    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.click("#tab-take")
    with fresh.expect_download() as waiting:
        fresh.click("#take button:has-text('.ipynb')")
    book = nbformat.read(waiting.value.path(), as_version=4)
    nbformat.validate(book)
    runs = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3", resources=runs).execute()
    shown = {x.id: str(x.get("outputs", "")) for x in book.cells}
    assert "ζ" in shown["walk"] or "zeta" in shown["walk"]
    assert "every step holds" in shown["check"]
    assert "run of so3" in shown["motion"]
    assert "so3.c" in shown["code"]


# ---------------------------------------------------------------- where the frame is small


def test_the_wheel_scrolls_and_zooms_with_ctrl_alone(fresh, site):
    frame = moving(fresh, site, "top")
    side = frame.locator(".side").bounding_box()
    fresh.mouse.move(side["x"] + side["width"] / 2, side["y"] + side["height"] / 2)
    before = frame.locator(".side").screenshot()
    beside = "document.querySelector('.beside').scrollTop"
    fresh.keyboard.down("Control")
    fresh.mouse.wheel(0, -300)
    fresh.keyboard.up("Control")
    until(frame, "true", lambda: frame.locator(".side").screenshot() != before)
    assert frame.evaluate(beside) == 0

    def at_the_end():
        """What the motion keeps comes into the column later, and makes it longer."""
        fresh.mouse.wheel(0, 4000)
        reset = frame.locator(".reset").bounding_box()
        return reset["y"] + reset["height"] <= 800

    until(frame, "true", at_the_end)


def test_on_a_phone_all_is_in_one_page(browser, site):
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    opened = context.new_page()
    frame = moving(opened, site, "top")
    touch = "[...document.querySelectorAll('canvas')].map((x) => getComputedStyle(x).touchAction)"
    assert {*frame.evaluate(touch)} == {"pan-y"}
    whole = "document.documentElement.scrollHeight - innerHeight"
    until(frame, f"{whole} < 4 && innerHeight > 900")
    assert frame.locator("canvas").first.bounding_box()["height"] < 0.5 * 844
    frame.locator(".reset").scroll_into_view_if_needed()
    assert opened.evaluate("scrollY") > 200
    assert frame.locator(".keys").is_visible()
    context.close()


# ---------------------------------------------------------------- what is said


def test_a_push_is_told_only_where_there_is_one(fresh, site):
    said = {}
    for name in ("sim3", "comet"):
        moving(fresh, site, name)
        said[name] = fresh.locator("#see .note").inner_text()
    assert "pushed" in said["sim3"]
    assert "pushed" not in said["comet"]  # it has a velocity in [initial]


def test_what_moves_when_the_text_is_wrong_is_dim(fresh, site):
    moving(fresh, site, "so3")
    fresh.evaluate("play.text.text = 'name = \"so3\"\\ngroup = 3\\n'")
    fresh.wait_for_selector("iframe.stale", timeout=10_000)
    assert fresh.locator("#see .note").inner_text().startswith("The text has changed")
    walked(fresh, "fault")
    assert fresh.locator("iframe.stale").count() == 1


def test_a_body_that_becomes_flat_is_told_and_a_smaller_push_does_not(fresh, site):
    frame = moving(fresh, site, "gl3")
    frame.evaluate(STATE, 20.0)
    frame.evaluate("document.getElementById('motion').motion.seek(20)")
    message = "document.querySelector('.message').textContent"
    until(frame, f"{message}.includes('det A = 0')")
    frame = moving(fresh, site, "jelly")
    frame.evaluate(STATE, 20.0)
    assert frame.evaluate("document.getElementById('motion').motion.run.last") == 20.0
    assert frame.evaluate(message) == ""


SHORT = """() => {
    const sought = (x) => document.getElementById("state").textContent === x;
    const seconds = () => (sought("What is kept is sought …") ? 0.2 : 60);
    Object.defineProperty(play.engine, "seconds", { get: seconds });
}"""
"""The clock is short for the search alone."""


def test_a_search_that_the_clock_ends_leaves_the_motion_running(fresh, site):
    fresh.goto(f"{site}#top")
    walked(fresh, "top")
    fresh.evaluate(SHORT)
    fresh.click("#tab-see")
    stopped = "What is kept was not found in 0.2 s: the motion goes on."
    fresh.wait_for_function(
        "(x) => document.getElementById('state').textContent.startsWith(x)",
        arg=stopped,
        timeout=90_000,
    )
    assert "\n" not in fresh.inner_text("#state")
    assert fresh.locator("iframe[data-moved]:not([data-kept]):not(.stale)").count() == 1
    frame = fresh.frames[-1]
    time = "document.getElementById('motion').motion.time"
    now = frame.evaluate(time)
    until(frame, f"{time} > {now + 0.05}")
    listed = "[...document.querySelectorAll('tr[data-name]')].map((x) => x.dataset.name)"
    assert frame.evaluate(listed) == ["energy", "defect"]
    fresh.click("#tab-walk")
    fresh.click("#tab-see")  # it is not sought again
    fresh.wait_for_timeout(300)
    assert fresh.inner_text("#state") == stopped
    assert not fresh.told


@pytest.mark.parametrize(
    ("name", "numbers"),
    [
        ("top", {"g": "3,5", "zeta_3": "40"}),
        ("sim3", {"zeta_1": "1.5", "theta_2": "-0.25"}),
        ("so3", {"u_2": "0,5"}),
    ],
)
def test_numbers_that_are_set_go_into_the_text(fresh, site, name, numbers):
    frame = moving(fresh, site, name)
    for x, value in numbers.items():
        row = frame.locator(f'[data-name="{x}"]')
        row.locator("xpath=ancestor::details").evaluate("(e) => { e.open = true; }")
        row.locator("input[inputmode]").fill(value)
        row.locator("input[inputmode]").press("Tab")
    expected = frame.evaluate(STATE, 1.0)
    before = tomllib.loads(fresh.evaluate("play.text.text"))
    frame.locator(".into").click()
    walked(fresh, "own")
    fresh.wait_for_selector("iframe[data-moved]:not(.stale)", timeout=90_000)
    after = tomllib.loads(fresh.evaluate("play.text.text"))
    if name == "top":
        assert after["parameters"]["g"] == before["parameters"]["g"] | {"default": 3.5}
        assert after["initial"] == before["initial"] | {"zeta_3": 40}
    elif name == "sim3":
        assert after["initial"]["exp"] == [0, -0.25, 0, 0, 0, 0, 0]
    else:
        assert after["initial"]["u_2"] == 0.5
        assert not {"u_1", "u_3"} & {*after["initial"]}
    found = fresh.frames[-1].evaluate(STATE, 1.0)
    assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < 1e-9


NUMBERS = """
import { written } from "./numbers.js";
const text = `name = "x"
[parameters]
m = 1.5 # mass
k = { meaning = "default", default = 1e-3 }
[initial]
exp = [0.3, 0, 0]
`;
const initial = { zeta_1: 2, zeta_2: 0 }, parameters = { m: -2, k: 4, q: 1 };
const set = { initial, parameters, exp: [1, 0, 0] };
console.log(JSON.stringify(written(text, set)));
"""


def test_numbers_in_a_text_and_what_has_no_place_in_it(tmp_path):
    need("node")
    for name in ("numbers", "declared", "source", "values"):
        shutil.copy(OWN / "src" / f"{name}.js", tmp_path)
    (tmp_path / "package.json").write_text('{ "type": "module" }')
    (tmp_path / "main.js").write_text(NUMBERS, encoding="utf-8")
    command = ["node", tmp_path / "main.js"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    told = json.loads(done.stdout)
    found = tomllib.loads(told["text"])
    assert found["parameters"] == {"m": -2, "k": {"meaning": "default", "default": 4}}
    assert found["initial"] == {"zeta_1": 2, "exp": [0.3, 0, 0]}
    assert told["left"] == ["q", "θ"]
