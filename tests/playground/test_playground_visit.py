"""A visit to the playground: what is asked for while it derives, the history and the links of its
steps, what is taken, the equations alone, a phone, and what it says of a check."""

import json
import subprocess

import pytest

from derive.code.options import CHOICES, REPEATED
from derive.command.loading import READY
from tests.support.needs import need
from tests.support.played import PENDULUM, UNKNOWN_KEY
from tests.support.playground_site import OWN, built, typed, walked

BELOW = """(id) => play.equations.root.getElementById(id).getBoundingClientRect().top
    - document.querySelector(".read .bar").getBoundingClientRect().bottom"""
NUMBERS = """name = "mine"
group = "SO(3)"
[[point]]
mass = 1
at = [2, 0, 0]
[[point]]
mass = 1
at = [0, 2, 0]
[[point]]
mass = 1
at = [0, 0, 2]
"""
"""Without parameters."""
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
    typed(fresh, UNKNOWN_KEY)
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
    typed(fresh, NUMBERS)
    walked(fresh, "own")
    fresh.click("#tab-take")
    with fresh.expect_download() as waiting:
        fresh.click("#take button:has-text('mine.toml')")
    assert waiting.value.suggested_filename == "mine.toml"
    assert waiting.value.path().read_text(encoding="utf-8") == NUMBERS
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
    fresh.click("#take label:has-text('parameters')")
    assert fresh.locator(".code pre").count() == 0  # it was of other options
    fresh.click("#take button:has-text('Show the code')")
    fault = fresh.locator("#take .row:has(button:has-text('zip')) [role=alert]")
    fault.wait_for()
    assert "no parameters" in fault.inner_text()


REFUSED = "[...document.querySelectorAll('#take :is(option, input):disabled')].length"


def told(page, option):
    """Wait for the reason why an option cannot be chosen; where it is told."""
    place = page.locator(f"#why-{option} li")
    place.wait_for()
    return place


def test_an_option_that_would_be_refused_cannot_be_chosen(fresh, site):
    """As the command does for what is chosen; what is chosen can always be left out."""
    visit(fresh, f"{site}#so3")
    fresh.click("#tab-take")
    fresh.click("#take summary")
    assert "SO(3) has none or several" in told(fresh, "multiplier").inner_text()
    box = fresh.get_by_role("checkbox", name="multiplier")
    assert box.is_disabled()
    assert "SO(3) has none" in box.locator("xpath=..").get_attribute("title")
    assert "why-multiplier" in box.get_attribute("aria-describedby")
    assert told(fresh, "step").inner_text().startswith("gauss_jax – ")
    orders = fresh.locator("select[aria-describedby~=why-order] option")
    assert [x.is_disabled() for x in orders.all()] == [False, True, True, True]
    fresh.get_by_label("discrete").check()
    fresh.wait_for_function("() => !document.querySelector('#why-order li')")
    assert not orders.nth(2).is_disabled()
    assert "not for julia" in told(fresh, "lang").inner_text()
    assert fresh.get_by_label("julia").is_disabled()
    fresh.get_by_label("discrete").uncheck()
    told(fresh, "order")
    assert fresh.get_by_label("julia").is_enabled()
    fresh.select_option("select[aria-describedby~=why-attitude]", "quaternion")
    velocity = fresh.locator("select[aria-describedby~=why-velocity] option")
    told(fresh, "velocity")
    assert velocity.nth(1).is_disabled()
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.select_option("#ready", "sl3")  # on which a quaternion that is chosen is refused
    walked(fresh, "sl3")
    fault = fresh.locator("#take .choices .fault")
    fault.wait_for()
    assert "a quaternion needs SO(3) or SE(3)" in fault.inner_text()
    assert fresh.evaluate(REFUSED) == 0
    fresh.select_option("select[aria-describedby~=why-attitude]", "")
    assert "SL(3)" in told(fresh, "attitude").inner_text()
    assert fault.inner_text() == ""
    assert fresh.get_by_role("checkbox", name="multiplier").is_enabled()
    assert not fresh.told


def test_what_is_wrong_refuses_no_option(fresh, site):
    visit(fresh, f"{site}#so3")
    fresh.click("#tab-take")
    fresh.click("#take summary")
    told(fresh, "multiplier")
    typed(fresh, UNKNOWN_KEY)
    walked(fresh, "fault")
    assert fresh.evaluate(REFUSED) == 0


WORDS = """
import {{ WORDS }} from {module};
process.stdout.write(JSON.stringify([WORDS.en.values, WORDS.fr.values]));
"""


def test_values_are_told_in_words_in_both_languages():
    need("node")
    script = WORDS.format(module=json.dumps((OWN / "src" / "words.js").as_uri()))
    run = ["node", "--input-type=module", "-e", script]
    found = json.loads(subprocess.run(run, check=True, capture_output=True).stdout)
    values = CHOICES | REPEATED
    for words in found:
        assert {x: [*y] for x, y in words.items()} == {x: [*values[x][0]] for x in words}
        assert {"jacobian", "step", "frame", "velocity"} <= {*words}
    english, french = found
    assert all(english[x] != french[x] for x in ("jacobian", "step", "frame"))


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
        shown = fresh.locator(f"select[aria-describedby~=about-{name}]").locator("option").first
        words = {
            "form": ".h",
            "frame": {"en": "as in", "fr": "comme dans"}[lang],
            "velocity": "Z",
            "state": {"en": "all entries", "fr": "tous les coefficients"}[lang],
        }
        begin = f"{first} – {words[name]}" if name in words else f"{first} ("
        assert shown.inner_text().startswith(begin)


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
