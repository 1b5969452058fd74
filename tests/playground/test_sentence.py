"""The problem as a sentence, which is made of its tables, and edits their text."""

import tomllib

from tests.support.played import text_of
from tests.support.playground_site import chosen, opened, text_in, violations, visit

SAID = """() => {
    const seen = (x) => x.nodeType === 3 ? x.textContent
        : x.matches("input") ? x.value
        : x.matches("select") ? x.selectedOptions[0].textContent
        : [...x.childNodes].map(seen).join("");
    return seen(document.querySelector("#sentence p"));
}"""
TOP = (
    "A cone of density 800.0 kg/m³, of radius 0.03 m, of height 0.05 m, "
    "that stands on its apex, turns about a fixed point, under its weight (g = (0, 0, -g)), "
    "starting with zeta_3 = 100 and exp = (0.3, 0, 0), where g = 9.81 m/s²."
)


def sentence(page):
    page.click("#as-sentence")
    page.wait_for_selector("#sentence > *", timeout=90_000)
    return page.evaluate(SAID)


def told(page):
    return tomllib.loads(text_in(page))


def test_a_problem_is_one_sentence_that_is_dragged_typed_and_chosen(fresh, site):
    visit(fresh, f"{site}#top", "top")
    assert sentence(fresh) == TOP
    assert not violations(fresh)
    before = told(fresh)
    # dragged, and moved by keys: all else of the text stays
    radius = fresh.locator("#sentence [aria-label='radius of the base']")
    box = radius.bounding_box()
    fresh.mouse.move(box["x"] + 8, box["y"] + 8)
    fresh.mouse.down()
    fresh.mouse.move(box["x"] + 48, box["y"] + 8, steps=4)
    fresh.mouse.up()
    now = told(fresh)
    assert now["parameters"]["R"]["default"] == 0.04
    radius.press("ArrowDown")
    assert told(fresh)["parameters"]["R"]["default"] == 0.039
    radius.fill("0,03")
    radius.press("Enter")
    assert told(fresh) == before
    # a number in a list, and one of the start
    fresh.locator("#sentence [data-mark='3.g']").fill("1")
    fresh.locator("#sentence [data-mark$='.zeta_3']").fill("50")
    fresh.locator("#sentence [data-mark$='.zeta_3']").press("Tab")
    assert told(fresh)["potential"] == [{"kind": "gravity", "g": [1, 0, "-g"]}]
    assert told(fresh)["initial"] == before["initial"] | {"zeta_3": 50}
    # words
    fresh.select_option("#sentence select >> nth=0", label="A ball")
    fresh.select_option("#sentence select >> nth=1", label="moves in space")
    now = told(fresh)
    assert (now["group"], now["body"]["solid"], "height" in now["body"]) == ("SE(3)", "ball", False)
    assert fresh.evaluate(SAID).startswith("A ball of density 800.0 kg/m³, of radius 0.03 m")
    # the form and the text are of the same problem
    fresh.click("#as-form")
    fresh.wait_for_selector("#form > *")
    assert fresh.input_value("[data-mark='0.group']") == "SE(3)"
    assert fresh.locator("#sentence").is_hidden()


def test_points_and_a_lagrangian_in_french(browser, site):
    with opened(browser, locale="fr-FR", color_scheme="dark") as page:
        visit(page, f"{site}#hung_bar", "hung_bar")
        said = sentence(page)
        assert said.startswith("Un corps avec un point de masse 1.0 kg en (-a, 0) et un point de ")
        assert (
            "se meut dans le plan, sous l’action de son poids (g = (0, -g)), d’un ressort (" in said
        )
        assert not violations(page, "#sentence")
        chosen(page, "spherical_pendulum")
        lagrangian = "() => document.querySelector('#sentence p').innerText.includes('lagrangien')"
        page.wait_for_function(lagrangian)
        assert page.evaluate(SAID).startswith("Un système de lagrangien ")
        assert text_in(page) == text_of("spherical_pendulum")
