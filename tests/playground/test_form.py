"""Writing a problem in the playground: the form edits its own tables and keeps all else; numbers
with commas; faults at their fields; what is completed in the text."""

import json
import tomllib

import pytest

from derive.command.showing import ready_made
from tests.support.played import PENDULUM, text_of
from tests.support.playground_site import put, rewalked, text_in, typed, walked

TRACED = """# a first line
name = "mine"  # its name
group = "SO(3)"

# about the parameters
[parameters]
a = { default = 1, unit = "m", meaning = "an arm" }
k = 2.5

[[point]]
mass = 1 # heavy
at = ["a", 0, 0]

# the second
[[point]]
mass = 1
at = [0, 1, 0]

[[potential]]
kind = "spring"
at = [0, 0, 1]
anchor = [0, 0, 2]
stiffness = "k"

# what is watched
[[event]]
name = "edge"
when = "A_33"

[initial]
zeta_2 = 3
"""


@pytest.fixture
def form(page):
    """The page with a form of a text, in English."""

    def opened(text):
        page.click("#as-text")
        put(page, "")
        put(page, text)
        page.click("#as-form")
        page.wait_for_selector("#form:not([hidden]) fieldset")
        return page

    yield opened
    page.click("#as-text")
    assert not page.told


def fill(page, label, value, nth=0):
    field = page.get_by_label(label, exact=True).nth(nth)
    field.fill(value)
    field.press("Tab")


def tables(page):
    return tomllib.loads(text_in(page))


def test_an_edit_changes_nothing_else(form):
    page = form(TRACED)
    assert "[[event]]" in page.inner_text("#form")
    fill(page, "mass", "m_1")
    expected = TRACED.replace("mass = 1 # heavy", 'mass = "m_1" # heavy')
    assert text_in(page) == expected.replace("k = 2.5\n", "k = 2.5\nm_1 = {}\n")
    fill(page, "mass", "1")
    assert text_in(page) == TRACED
    fill(page, "zeta_2", "")
    fill(page, "zeta_3", "0,5")
    assert text_in(page) == TRACED.replace("zeta_2 = 3", "zeta_3 = 0.5")


@pytest.mark.parametrize("name", ready_made())
def test_a_ready_made_problem_is_shown_and_kept(form, name):
    page, text = form(text_of(name)), text_of(name)
    page.wait_for_function("(x) => document.querySelector('#form input')?.value === x", arg=name)
    page.fill("#form input >> nth=0", f"{name}x")
    page.press("#form input >> nth=0", "Tab")
    own = text_in(page)
    assert tomllib.loads(own) == tomllib.loads(text) | {"name": f"{name}x"}
    assert own.replace(f'"{name}x"', f'"{name}"') == text


def test_a_parameter_that_is_no_longer_used_goes_and_comes_back(form):
    page = form(PENDULUM)
    for k, place in enumerate(("1, 0, 0", "0, 1, 0", "0, 0, 1")):
        fill(page, "at", place, k)
    assert "l" not in tables(page)["parameters"]
    fill(page, "at", "0, 0, l", 2)
    assert tables(page)["parameters"]["l"] == {"default": 2}
    form(PENDULUM.replace("g = {", "q = 1\ng = {"))
    walked(page, "fault")
    with rewalked(page):
        page.click("[aria-label='Remove q']")
    assert text_in(page) == PENDULUM


def test_a_decimal_comma_is_a_number_and_no_number_is_told(form):
    """What is none stays and is told while the walk of the number before it ends and while the form
    is drawn anew, until it is one."""
    page, told = form(PENDULUM), "“1,5m” is no number"
    arm = page.get_by_label("l", exact=True)
    with rewalked(page):
        fill(page, "l", "1,5")
        fill(page, "l", "1,5m")
        assert told in page.inner_text("#form")
    fill(page, "at", "0; 0; 2,5", 2)
    assert tables(page)["parameters"]["l"] == {"default": 1.5}
    assert tables(page)["point"][2]["at"] == [0, 0, 2.5]
    assert arm.input_value() == "1,5m"
    assert arm.get_attribute("aria-invalid") == "true"
    assert told in page.inner_text("#form")
    fill(page, "l", "2")
    assert tables(page)["parameters"]["l"] == {"default": 2}
    assert told not in page.inner_text("#form")


def test_a_solid_has_its_springs_at_places_and_points_come_back(form):
    page = form(PENDULUM.replace("mass", "# one of three\nmass"))
    points = tables(page)["point"]
    page.get_by_label("made of").select_option("solid")
    with rewalked(page):
        page.get_by_label("Add a force").select_option("potential.spring")
    made = tables(page)
    assert "point" not in made
    assert made["potential"][1]["at"] == [0, 0, 0]
    assert "on" not in made["potential"][1]
    assert page.inner_text("#errors") == ""
    page.get_by_label("made of").select_option("points")
    assert tables(page)["point"] == points
    assert text_in(page).count("# one of three") == 3


def test_lists_are_as_long_as_the_space(form):
    page = form(PENDULUM)
    page.select_option("[data-mark='0.group']", "SO(2)")
    made = tables(page)
    assert [x["at"] for x in made["point"]] == [["l", 0], [0, "l"], [0, 0]]
    assert made["potential"][0]["g"] == [0, "-g"]
    page.click("text=Add a point")
    assert tables(page)["point"][-1]["at"] == [0, 0]
    page.select_option("[data-mark='0.group']", "Sp(4)")
    assert {len(x["at"]) for x in tables(page)["point"]} == {4}
    assert "Sp(3)" not in page.inner_text("#form select >> nth=0")


def test_a_fault_is_told_at_its_field(form):
    page = form(PENDULUM)
    with rewalked(page, "fault"):
        fill(page, "at", "0, l", 1)
    wrong = page.locator("#form [aria-invalid]")
    assert wrong.count() == 1
    assert wrong.input_value() == "0, l"
    told = wrong.get_attribute("aria-describedby")
    assert page.locator(f"[id='{told}']").inner_text().startswith("point 2, at")
    page.click("#errors button")
    assert page.evaluate("document.activeElement.value") == "0, l"
    with rewalked(page):
        fill(page, "at", "0, l, 0", 1)
    assert page.locator("#form [aria-invalid]").count() == 0


def test_starting_afresh_asks(form):
    page, broken = form(PENDULUM), PENDULUM + "[[point"
    put(page, broken)
    page.click("#as-form")
    page.once("dialog", lambda x: x.dismiss())
    page.click("text=Start afresh")
    assert text_in(page) == broken
    page.once("dialog", lambda x: x.accept())
    with rewalked(page):
        page.click("text=Start afresh")
    assert page.locator("#form fieldset").count()
    assert page.inner_text("#errors") == ""


SHOWN = """() => {
    const is = (id) => !document.getElementById(id).hidden;
    const on = (id) => document.getElementById(id).getAttribute("aria-pressed") === "true";
    return [is("form"), on("as-form"), is("editor"), on("as-text")];
}"""


def test_the_last_button_counts_while_python_works(page):
    """Is the form shown, and its button pressed; the text, and its button?"""
    for clicks in ("form text", "form text form", "text form", "form form text"):
        put(page, f"{PENDULUM}# {clicks}\n")
        page.wait_for_function("() => play.engine.busy")
        for each in clicks.split():
            page.click(f"#as-{each}")
        form = clicks.endswith("form")
        assert page.evaluate(SHOWN) == [form, form, not form, not form], clicks
        page.click("#as-text")


LABELS = "[...document.querySelectorAll('.cm-completionLabel')].map((x) => x.textContent)"


@pytest.mark.parametrize(
    ("begin", "keys", "made"),
    [
        ('[[potential]]\nkind = "spring"\n', "sti", '[[potential]]\nkind = "spring"\nstiffness = '),
        ("[[", "poin", "[[point]]"),
        ("[", "bod", "[body]"),
        ("group = ", None, 'group = "SO(2)"'),
        ('name = "a"\n[', "poi", None),
    ],
)
def test_what_is_taken_is_whole(page, begin, keys, made):
    """tests/playground/test_scripts.py has what is offered where; no such table alone is none."""
    put(page, begin)
    page.focus(".cm-content")
    page.keyboard.press("Control+End")
    page.keyboard.press("Control+Space") if keys is None else page.keyboard.type(keys)
    if made is None:
        page.wait_for_timeout(400)
        assert "point" not in page.evaluate(LABELS)
        return
    page.wait_for_selector(".cm-tooltip-autocomplete li")
    page.wait_for_timeout(150)
    page.keyboard.press("Enter")
    assert text_in(page) == made


SPITEFUL = [
    '<img src=x onerror="window.ran=1">',
    "</title><script>window.ran=1</script>",
    "{{ 7*7 }}",
    "]]><svg/onload=window.ran=1>",
    "\u202egnihton",
    "$\\immediate\\write18{ls}$",
]
STRANGE = "script, img, [onerror], [onload]"


@pytest.mark.parametrize("spite", SPITEFUL, ids=range(len(SPITEFUL)))
def test_texts_are_never_markup(page, spite):
    quoted = json.dumps(spite, ensure_ascii=False)
    typed(
        page,
        f'name = "spite"\ntitle = {quoted}\ngroup = "SO(3)"\n[body]\nmoments = "symbolic"\n'
        f"[parameters]\nm = {{ default = 1, unit = {quoted}, meaning = {quoted} }}\n"
        f'[[potential]]\nkind = "gravity"\ng = [0, 0, 1]\n',
        None,
    )
    page.click("#tab-see")
    page.wait_for_selector("iframe[data-moved]:not(.stale), #see .fault", timeout=90_000)
    count = f"document.querySelectorAll('#errors :is({STRANGE}), #see :is({STRANGE})').length"
    assert page.evaluate(count) == 0
    assert page.evaluate(f"play.equations.root.querySelectorAll({STRANGE!r}).length") == 0
    assert not any(x.evaluate("globalThis.ran") for x in page.frames)
    page.click("#tab-walk")
