"""The motion in the playground: its sliders, its page for screen readers, and the notebook that is
taken, run whole."""

import json

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
