"""A visit to the playground: what is asked for while it derives, the history and the links of its
steps, what is taken, the equations alone, a phone, and what it says of a check."""

import json
import subprocess

import pytest

from derive.command.loading import READY
from tests.playground.test_playground import BAD, PENDULUM, typed
from tests.support.needs import need
from tests.support.playground_site import OWN, built, walked

BELOW = """(id) => play.equations.root.getElementById(id).getBoundingClientRect().top
    - document.querySelector(".read .bar").getBoundingClientRect().bottom"""
HOSTILE = [
    PENDULUM,
    "",
    "a",
    "'''",
    '"""',
    "x = '''a''' # \"\"\"b\"\"\"",
    "'edge'",
    '"edge"',
    "ends in \\",
    "\\n \\' \\\" \\\\ \\u0041 {x} %s $HOME",
    "x'''\n\"\"\"\\",
    "\"\"\"\"'''''",
    "'''\r\r\n\t\0\x7f\x85\ufeff\u202e\u2028\U000e0041é∑𝔤",
]


def in_sight(opened, id):
    """Wait until a step stands under the bar."""
    opened.wait_for_function(
        f"(id) => {{ const y = ({BELOW})(id); return y > -3 && y < 3; }}", arg=id
    )


def visit(opened, address, what="so3"):
    opened.goto(address)
    walked(opened, what)


def test_a_check_asked_for_while_it_derives_follows_the_walk(fresh, site):
    visit(fresh, f"{site}#so3")
    typed(fresh, PENDULUM)
    fresh.click("#check")  # the text is not even asked about
    assert "then the check" in fresh.inner_text("#state")
    fresh.wait_for_selector("body[data-checked=holds]", timeout=90_000)
    assert "the probability that a false step passes is below" in fresh.inner_text("#state")
    tick = fresh.locator("#walk h3 .tick").first
    assert "probability" in tick.get_attribute("title")
    assert "e-" not in tick.inner_text()
    assert "× 10⁻" in tick.inner_text()
    fresh.evaluate("delete document.body.dataset.checked")
    fresh.click("[data-lang=fr]")
    fresh.click("#check")  # while it derives
    fresh.wait_for_selector("body[data-checked=holds]", timeout=90_000)
    assert "la probabilité" in fresh.inner_text("#state")
    fresh.click("[data-lang=en]")
    typed(fresh, BAD[1][0])
    walked(fresh, "fault")
    fresh.click("#check")
    assert "first mend" in fresh.inner_text("#state")


def addressed(page, end):
    """Wait until the address ends so."""
    page.wait_for_function("(end) => location.href.endsWith(end)", arg=end)


def test_back_and_forward_go_to_where_the_reader_was(fresh, site):
    visit(fresh, f"{site}#so3")
    entries = fresh.evaluate("history.length")
    fresh.select_option("#steps", "so3.kernel")
    addressed(fresh, "#so3/so3.kernel")
    in_sight(fresh, "so3.kernel")
    fresh.locator("#walk article[id='so3.kernel'] summary").first.click()
    fresh.locator("#walk article[id='so3.kernel'] details a").first.click()
    fresh.wait_for_function("() => !location.hash.endsWith('/so3.kernel')")
    second = fresh.url.rpartition("/")[2]
    in_sight(fresh, second)
    fresh.wait_for_function("(id) => document.getElementById('steps').value === id", arg=second)
    assert fresh.evaluate("history.length") == entries + 2
    fresh.go_back()
    in_sight(fresh, "so3.kernel")
    addressed(fresh, "#so3/so3.kernel")
    fresh.go_back()
    fresh.wait_for_function("() => document.getElementById('walk').scrollTop < 5")
    fresh.go_forward()
    in_sight(fresh, "so3.kernel")
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.reload()
    walked(fresh)
    in_sight(fresh, "so3.kernel")
    assert not fresh.told


def test_a_step_of_any_problem_has_a_link(fresh, site, browser):
    visit(fresh, f"{site}#so3")
    typed(fresh, PENDULUM)
    walked(fresh, "own")
    fresh.locator("#walk article[id='mine.motion'] a.label").click()
    link = fresh.url
    assert link.endswith("/mine.motion")
    shown = fresh.locator("#walk article[id='mine.kernel'] a.label").get_attribute("href")
    assert shown == f"#{link.partition('#')[2].rpartition('/')[0]}/mine.kernel"
    other = browser.new_page()
    visit(other, link, "own")
    in_sight(other, "mine.motion")
    assert other.evaluate("play.text.text") == PENDULUM
    other.goto("about:blank")
    visit(other, f"{site}#so3/so3.nosuch")
    assert "no step 'so3.nosuch'" in other.inner_text("#state")
    other.close()


def test_an_edit_leaves_the_ready_made_problem_behind(fresh, site):
    visit(fresh, f"{site}#so3")
    entries = fresh.evaluate("history.length")
    typed(fresh, PENDULUM)
    walked(fresh, "own")
    typed(fresh, PENDULUM.replace("mine", "other"))
    walked(fresh, "own")
    assert fresh.evaluate("history.length") == entries + 1
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.go_back()
    walked(fresh)
    assert fresh.evaluate("play.text.text") == (READY / "so3.toml").read_text(encoding="utf-8")
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.select_option("#ready", "")  # one's own, to begin with
    walked(fresh, "own")
    assert fresh.inner_text("#errors") == ""
    assert "#p=" in fresh.url
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.go_back()
    walked(fresh)


def test_an_address_says_the_problem_and_the_language(fresh, site):
    visit(fresh, f"{site}#nosuch")
    assert "no ready-made problem 'nosuch'" in fresh.inner_text("#errors")
    fresh.goto("about:blank")
    visit(fresh, f"{site}?lang=fr#SO3/so3.kernel")
    in_sight(fresh, "so3.kernel")
    assert fresh.inner_text("#errors") == ""
    assert fresh.url == f"{site}?lang=fr#so3/so3.kernel"
    assert fresh.evaluate("document.documentElement.lang") == "fr"
    assert fresh.locator("#walk h1").inner_text() == "Le solide autour d’un point fixe"
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.click("[data-lang=en]")
    walked(fresh)
    assert fresh.url == f"{site}?lang=en#so3/so3.kernel"
    in_sight(fresh, "so3.kernel")


def test_what_is_taken_is_shown_and_what_is_refused_is_told_beside(fresh, site):
    visit(fresh, f"{site}#so3")
    typed(fresh, PENDULUM)
    walked(fresh, "own")
    fresh.click("#tab-take")
    with fresh.expect_download() as waiting:
        fresh.click("#take button:has-text('mine.toml')")
    assert waiting.value.suggested_filename == "mine.toml"
    assert waiting.value.path().read_text(encoding="utf-8") == PENDULUM
    fresh.click("#take button:has-text('Show the code')")
    fresh.wait_for_selector(".code pre")
    listed = fresh.locator(".code option").all_inner_texts()
    assert listed == ["mine.c", "mine.h", "mine.py"]
    assert '#include "mine.h"' in fresh.inner_text(".code pre")
    fresh.select_option(".code select", "mine.py")
    code = fresh.evaluate("document.querySelector('.code pre').textContent")
    compile(code, "mine.py", "exec")
    with fresh.expect_download() as waiting:
        fresh.click(".code button:has-text('Save')")
    assert waiting.value.path().read_text(encoding="utf-8") == code
    fresh.click("#take summary")
    fresh.click("#take label:has-text('multiplier')")
    assert fresh.locator(".code pre").count() == 0  # it was of other options
    fresh.click("#take button:has-text('Show the code')")
    fault = fresh.locator("#take .row:has(button:has-text('zip')) [role=alert]")
    fault.wait_for()
    assert "multiplier" in fault.inner_text()


@pytest.mark.parametrize("lang", ["en", "fr"])
def test_options_say_what_they_do(fresh, site, lang):
    visit(fresh, f"{site}?lang={lang}#so3")
    fresh.click("#tab-take")
    fresh.click("#take summary")
    data = json.loads((built() / "data.json").read_text(encoding="utf-8"))
    for name in data["about"]:
        about = fresh.locator(f"#about-{name}")
        assert about.is_visible()
        assert (about.inner_text() == data["about"][name]) == (lang == "en")
    for name, (first, *_) in data["choices"].items():
        shown = fresh.locator(f"select[aria-describedby=about-{name}]")
        assert shown.locator("option").first.inner_text().startswith(f"{first} (")


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_a_text_of_any_kind_is_a_literal_of_python(text):
    """Read by Python, and whole in the source that a notebook would run."""
    need("node")
    script = (
        f"import {{ literal }} from {json.dumps((OWN / 'src' / 'notebook.js').as_uri())};"
        f"process.stdout.write(literal({json.dumps(text)}))"
    )
    run = ["node", "--input-type=module", "-e", script]
    shown = subprocess.run(run, check=True, capture_output=True).stdout.decode("utf-8")
    found = {}
    exec(f"x = {shown}", found)
    assert found["x"] == text
    assert shown.count("\n") == text.count("\n")
    if text == PENDULUM:
        assert shown == f"r'''{text}'''"


def test_the_equations_alone(fresh, site):
    visit(fresh, f"{site}#so3/so3.kernel")
    in_sight(fresh, "so3.kernel")
    assert fresh.is_visible(".write")
    fresh.click("#wide")
    assert not fresh.is_visible(".write")
    in_sight(fresh, "so3.kernel")
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.reload()
    walked(fresh)
    assert not fresh.is_visible(".write")
    fresh.keyboard.press("F8")
    assert fresh.is_visible(".write")


def test_a_phone_copies_and_keeps_sides_together(browser, site):
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    opened = context.new_page()
    visit(opened, f"{site}#so3/linear.pullback")
    in_sight(opened, "linear.pullback")
    buttons = opened.locator("#walk article[id='linear.pullback'] .number button")
    assert buttons.count() == 8
    assert buttons.first.is_visible()
    sides = """(side) => [...play.equations.root.querySelectorAll(
        `article[id='linear.pullback'] .${side}`)].map((x) => x.getBoundingClientRect())"""
    for left, right in zip(*(opened.evaluate(sides, x) for x in ("left", "right")), strict=True):
        assert right["top"] < left["bottom"]
        assert right["left"] >= left["right"]
    context.close()


def test_copies_are_told_apart_and_one_stop_of_tab_a_step(fresh, site):
    visit(fresh, f"{site}#so3")
    found = fresh.evaluate("""() => [...play.equations.root.querySelectorAll("article")].map(
        (x) => [...x.querySelectorAll(".number button")].map((y) => [y.ariaLabel, y.tabIndex]))""")
    assert found[0] == [["TeX (1.1): copy the LaTeX", 0], ["MathML (1.1): copy the MathML", -1]]
    assert all(sum(stop == 0 for _, stop in x) == 1 for x in found if x)
    assert sum(map(len, found)) > 100
    fresh.locator("#walk .number button").first.focus()
    label = "play.equations.root.activeElement.getAttribute('aria-label')"
    for key, expected in (
        ("ArrowRight", "MathML (1.1): copy the MathML"),
        ("ArrowDown", "MathML (1.2): copy the MathML"),
        ("ArrowLeft", "TeX (1.2): copy the LaTeX"),
        ("ArrowUp", "TeX (1.1): copy the LaTeX"),
    ):
        fresh.keyboard.press(key)
        assert fresh.evaluate(label) == expected


def test_a_star_leads_to_the_correction(fresh, site):
    visit(fresh, f"{site}#so3")
    star = fresh.locator("#walk article[id='linear.motions'] .printed a")
    assert star.text_content() == "*"
    star.click()
    assert fresh.url.endswith("#so3/linear.symplectic")
    in_sight(fresh, "linear.symplectic")
    assert fresh.locator("#walk article[id='linear.symplectic'] .correction").count() == 1
    assert fresh.locator("#walk article[id='linear.symplectic'] .printed a").count() == 0
