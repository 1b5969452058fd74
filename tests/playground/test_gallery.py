"""The gallery of the playground: every ready-made problem as a thing that moves, with a picture, by
mouse and by keys, on a phone and by night; and that each begins with a motion of its own."""

import gzip
import json
from xml.etree import ElementTree

import pytest

from derive.command.showing import ready_made
from derive.views.language import LANGUAGES
from playground.site import built
from playground.stage import picture, shelves
from tests.support.playground_site import (
    moving,
    opened,
    rewalked,
    size,
    violations,
    visit,
    walked,
)
from tests.support.walks import record

THINGS = [thing for shelf in shelves() for thing in shelf["things"]]
LIGHT = 0.03
"""MB, of all pictures."""
FOCUSED = "document.activeElement.querySelector('.name')?.textContent"


def test_every_ready_made_problem_is_one_thing():
    assert sorted(x["name"] for x in THINGS) == sorted(ready_made())
    for lang in LANGUAGES:
        assert len({x[lang] for x in THINGS}) == len(THINGS)


@pytest.mark.parametrize("name", ["pendulum", "euler_top", "two_tops"])
def test_a_picture_has_no_letters_and_is_whole(name):
    root = ElementTree.fromstring(picture(record(name)))
    assert {x.tag.split("}")[1] for x in root.iter()} <= {"svg", "g", "path", "circle"}
    assert root.get("aria-hidden") == "true"
    width, height = map(float, root.get("viewBox").split()[2:])
    for path in (x.get("d") for x in root.iter() if x.tag.endswith("path")):
        for point in path.strip("MZ").split("L"):
            x, y = map(float, point.split())
            assert 0 < x < width
            assert 0 < y < height


def test_groups_are_called_as_people_do():
    assert all("_" not in x.get("group", "") for x in THINGS)
    assert {x["name"]: x["group"] for x in THINGS if "group" in x}["imu"] == "SE₂(3)"


def test_what_has_no_body_has_no_picture():
    assert picture(record("ideal_fluid")) == ""


def test_things_are_chosen_by_mouse_and_by_keys(fresh, site):
    """The pictures come when they are looked at; what is chosen moves, what has no motion is read;
    Back leads to the one before."""
    visit(fresh, f"{site}#so3")
    assert not [x for x in fresh.asked if "gallery" in x]
    fresh.click("#things")
    fresh.wait_for_selector(".shelves a")
    assert f"{site}gallery.json" in fresh.asked
    assert size({"gallery.json"}) < LIGHT
    assert fresh.locator(".shelves a").count() == len(THINGS)
    pictures = json.loads((built() / "gallery.json").read_text(encoding="utf-8"))
    assert fresh.locator(".shelves svg").count() == len(pictures) > 30
    assert not violations(fresh)
    assert fresh.evaluate(FOCUSED) == "Solid held at a point"
    fresh.keyboard.press("ArrowLeft")
    assert fresh.evaluate(FOCUSED) == "Kovalevskaya’s top"
    fresh.keyboard.press("ArrowUp")
    above = fresh.evaluate(FOCUSED)
    fresh.keyboard.press("ArrowDown")
    assert above != fresh.evaluate(FOCUSED) == "Kovalevskaya’s top"
    for key, k in (("Home", 0), ("ArrowLeft", 0), ("End", -1), ("ArrowRight", -1)):
        fresh.keyboard.press(key)
        assert fresh.evaluate(FOCUSED) == THINGS[k]["en"]
    fresh.locator(".shelves a:has-text('Kovalevskaya')").focus()
    with rewalked(fresh, "kovalevskaya_top"):
        fresh.keyboard.press("Enter")
    fresh.wait_for_selector("iframe[data-moved]")
    assert not fresh.is_visible("#gallery")
    fresh.click("#things")
    fresh.keyboard.press("Escape")
    assert not fresh.is_visible("#gallery")
    fresh.click("#things")
    still = fresh.locator(".shelves a:has-text('Equations only')")
    assert still.count() == len(THINGS) - len(moving_ones())
    with rewalked(fresh, "ideal_fluid"):
        fresh.click(".shelves >> text=Water")
    assert fresh.get_attribute("#tab-walk", "aria-selected") == "true"
    fresh.click("#tab-see")
    assert "field" in fresh.inner_text("#see .note")
    assert not fresh.locator("#see .fault").count()
    fresh.click("#tab-walk")
    with rewalked(fresh, "kovalevskaya_top"):
        fresh.go_back()


def test_the_gallery_on_a_phone_by_night_in_french(browser, site):
    how = {"viewport": {"width": 390, "height": 844}, "locale": "fr-FR", "color_scheme": "dark"}
    with opened(browser, **how) as page:
        page.goto(f"{site}#pendulum")
        walked(page, "pendulum")
        page.click("#things")
        page.wait_for_selector(".shelves a")
        assert page.inner_text("#gallery h2") == "Qu’est-ce qui bouge ?"
        assert page.locator(".shelves .name").first.inner_text() == "Pendule"
        labels = "[...document.querySelectorAll('#ready optgroup')].map((x) => x.label)"
        assert page.evaluate(labels) == [x["fr"] for x in shelves()]
        assert page.inner_text("#ready :checked") == "Pendule (pendulum)"
        groups = {*page.locator(".shelves :is(small, .picture)").all_inner_texts()}
        assert {"SO(3)", "SE₂(3)", "Vissages", "tout groupe"} <= groups
        assert not {"SE_2_3", "G", "Screw", "any group"} & groups
        assert not violations(page, "#gallery")
        assert page.evaluate("document.querySelector('#gallery').scrollWidth") <= 390


def test_without_the_file_the_list_is_named(browser, site):
    with opened(browser, service_workers="block") as page:
        page.route("**/gallery.json", lambda route: route.fulfill(body="none"))
        visit(page, f"{site}#so3")
        page.click("#things")
        assert "the list beside it" in page.inner_text("#gallery [role=alert]")


def moving_ones():
    """The ready-made problems that move; none is at rest, or has to be pushed."""
    moved = set()
    for file in (built() / "ready").glob("*.en.json.gz"):
        told = json.loads(gzip.decompress(file.read_bytes()))
        for page in (news["page"] for kind, news in told["motion"] if kind == "motion"):
            assert not page["pushed"], file.name
            moved.add(file.name.partition(".")[0])
    return moved


def test_the_racket_flips(fresh, site):
    """Its middle axis, e_2, points the other way, and back, in the time of the page."""
    visit(fresh, f"{site}#euler_top", "euler_top")
    told = moving(fresh).evaluate(
        "() => { const { run } = document.getElementById('motion').motion; run.reach(20, Infinity);"
        " return [...Array(401).keys()].map((k) => run.at(k / 20)[4]); }"
    )
    first = next(k for k, x in enumerate(told) if x < -0.95)
    assert max(told[first:]) > 0.95


def test_every_motion_begins_by_itself(site):
    assert len(moving_ones()) == len(THINGS) - 6
