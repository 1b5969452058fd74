"""The road at the foot of the page: its stations are equations of the steps that they lead to."""

import re
from html.parser import HTMLParser

import pytest

from derive.command.showing import ready_made
from tests.support.played import Played, text_of
from tests.support.playground_site import chosen, opened, visit, walked

WHOLE = ["lagrangian", "group", "cartan", "exterior", "kernel", "body", "kept"]
NOTE = {"lagrangian": 3, "group": 12, "cartan": 15, "exterior": 25, "kernel": 34}
"""A number that the note has at each station of a solid about a point."""


class Articles(HTMLParser):
    """The text of the articles of a walk, by their ids."""

    def __init__(self):
        super().__init__()
        self.now, self.texts = "", {}

    def handle_starttag(self, tag, attrs):
        if tag == "article":
            self.now = dict(attrs)["id"]

    def handle_data(self, data):
        self.texts[self.now] = self.texts.get(self.now, "") + "".join(data.split())


def plain(markup):
    """The text of a formula up to what is left out, in which only the shape of signs counts."""
    found = Articles()
    found.feed(markup)
    return found.texts[""].partition("…")[0].rstrip("+=")


@pytest.fixture
def played(tmp_path, monkeypatch):
    return Played(tmp_path, monkeypatch)


def road(played, name):
    """The stations of a problem, and the texts of its steps."""
    heard = played.asked("walk", text=text_of(name), lang="en")
    (told,) = (news for kind, news in heard if kind == "derived")
    articles = Articles()
    articles.feed("".join(news for kind, news in heard if kind == "piece"))
    return told["road"], articles.texts


@pytest.mark.parametrize("name", ready_made())
def test_a_station_is_an_equation_of_its_step(played, name):
    stations, texts = road(played, name)
    assert stations
    for x in stations:
        shown = plain(x["shown"])
        assert len(shown) > 1
        left, _, right = shown.partition("=")
        # by the angle of A a right side stands below that of its equation
        sides = (f"{left}=", f"={right}") if "θ" in right else (shown,)
        assert all(side in texts[x["id"]] for side in sides), (x["name"], shown)


def listed(text):
    """The numbers in a list with runs, (11)–(13), (17)."""
    runs = (re.findall(r"\d+", run) for run in text.split(","))
    return {n for run in runs for n in range(int(run[0]), int(run[-1]) + 1)}


def names(stations):
    return [x["name"] for x in stations]


def test_which_stations_a_road_has(played):
    for name in ("so3", "top", "se3", "sl3", "pendulum"):
        assert names(road(played, name)[0]) == WHOLE, name
    stated = ["group", "cartan", "exterior", "kernel", "body", "kept"]
    assert names(road(played, "euler_top")[0]) == stated  # no points, so no L
    assert names(road(played, "ideal_fluid")[0]) == WHOLE[:-2]
    assert names(road(played, "linear")[0]) == WHOLE[:-2]  # any group has no body
    assert names(road(played, "imu")[0]) == ["body"]  # a motion of first order
    told = {x["name"]: x["paper"] for x in road(played, "so3")[0]}
    for name, number in NOTE.items():
        assert number in listed(told[name]), name


COUNTED = """() => {
    const state = document.getElementById("state");
    window.counts = [];
    new MutationObserver(() => {
        if (state.textContent.includes(" of ")) window.counts.push(state.textContent);
    }).observe(state, { childList: true });
}"""
"""Keeps what is told of a check."""


def test_a_line_of_the_answer_leads_to_its_step(fresh, site):
    visit(fresh, f"{site}#top", "top")
    fresh.click("#tab-see")
    lines = fresh.locator("#answer p a")
    assert lines.count() == fresh.locator("#answer p").count() > 3
    assert lines.last.get_attribute("href").startswith("#top/top.")
    lines.last.focus()
    fresh.keyboard.press("Enter")
    assert fresh.is_visible("#walk")
    step = fresh.locator("#walk article:focus").get_attribute("id")
    assert lines.last.get_attribute("href") == f"#top/{step}"
    # a term that has an arrow is lit, as before
    fresh.locator("#answer p [data-arrow='1']").first.click()
    assert fresh.locator("#answer .legend [aria-pressed=true]").count() == 1
    # what is a parameter has one face wherever it stands
    faces = "[...document.querySelectorAll('#answer .parameter, #road .parameter')]"
    assert fresh.evaluate(
        f"{faces}.every((x) => getComputedStyle(x).fontFamily.endsWith('monospace'))"
    )


SETTLED = """async (link) => {
    const places = [], walk = document.getElementById("walk").shadowRoot;
    link.click();
    for (let k = 0; k < 12; ++k) {
        const bar = document.querySelector(".read .bar").getBoundingClientRect().bottom;
        places.push(Math.round(walk.activeElement.getBoundingClientRect().top - bar));
        await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    }
    return places;
}"""
"""How far below the bar a step begins that a link goes to, at once and after each frame."""


def test_a_step_stands_still_from_the_first_on(browser, site):
    """Heights of steps that nobody has seen do not move it when they come."""
    phone = {"width": 390, "height": 844}
    for name in ("pendulum", "top"):
        with opened(browser, viewport=phone, has_touch=True, locale="fr-FR") as page:
            page.goto(f"{site}?lang=fr#{name}")
            walked(page, name)
            line = page.locator("#answer p a").first
            assert {*line.evaluate(SETTLED)} == {0}
            assert page.evaluate("play.equations.at().id") == f"{name}.motion"


def test_the_last_line_leads_to_the_last_step(fresh, site):
    """Below which little stands: it is the one that is read, and so the list and the road say."""
    visit(fresh, f"{site}#pendulum&tab=see", "pendulum")
    fresh.locator("#answer p a").last.focus()
    fresh.keyboard.press("Enter")
    top = "document.querySelector('#walk').shadowRoot.activeElement.getBoundingClientRect().top"
    bar = "document.querySelector('.read .bar').getBoundingClientRect().bottom"
    fresh.wait_for_function(f"() => Math.abs({top} - {bar}) < 30")
    fresh.wait_for_timeout(300)
    assert fresh.input_value("#steps") == "pendulum.explicit"
    road = "#road [aria-current=step]"
    assert fresh.get_attribute(road, "data-to") == "pendulum.explicit"


def test_a_station_leads_to_its_step_and_is_ticked(fresh, site):
    visit(fresh, f"{site}#so3")
    stations = fresh.locator("#road button:visible")
    assert stations.count() == 7
    assert fresh.locator("#road .tick:not(.wrong)").count() == 7  # made with the page
    stations.nth(4).focus()
    fresh.keyboard.press("Enter")
    fresh.wait_for_function("() => location.hash === '#so3/so3.kernel'")
    assert fresh.locator("#walk article:focus").get_attribute("id") == "so3.kernel"
    fresh.wait_for_selector("#road [data-to='so3.kernel'][aria-current=step]")
    current = fresh.locator("#road [aria-current=step]")
    # the last step of the walk, above which the walk cannot be moved, is the one that was gone to
    stations.nth(5).click()
    assert current.all_inner_texts()[0].startswith("6 ")
    last = stations.nth(5).get_attribute("data-to")
    assert fresh.input_value("#steps") == last
    fresh.wait_for_timeout(400)
    assert current.all_inner_texts()[0].startswith("6 ")
    fresh.evaluate("document.getElementById('walk').scrollBy(0, -900)")
    fresh.wait_for_function("(id) => document.getElementById('steps').value !== id", arg=last)
    stations.nth(6).click()
    assert fresh.is_visible("#take")
    assert current.all_inner_texts()[0].startswith("7 ")
    fresh.evaluate(COUNTED)
    fresh.click("#check")
    fresh.wait_for_selector("body[data-checked=holds]", timeout=90_000)
    assert fresh.locator("#road .tick:not(.wrong)").count() == 7
    # how far it was, of how many; a tick tells what it means
    counts = fresh.evaluate("window.counts")
    articles = fresh.locator("#walk article").count()
    assert counts[0].endswith(f"1 of {articles}")
    assert counts[-1].endswith(f"{articles} of {articles}")
    fresh.locator("#walk .tick").first.click()
    assert "the probability that a false step passes" in fresh.inner_text("#state")
    chosen(fresh, "euler_top")
    assert fresh.locator("#road .tick").count() == stations.count() == 6
