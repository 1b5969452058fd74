"""Visits to the playground, each in one page: what is read and copied, problems of one's own, the
addresses, what is taken, an engine that is stopped; without a network, and without WebAssembly."""

import json
from xml.etree import ElementTree
from zipfile import ZipFile

from derive.command.showing import ready_made
from derive.views.language import LANGUAGES
from playground.site import built
from tests.support import in_node
from tests.support.needs import need
from tests.support.played import PENDULUM, UNKNOWN_KEY, text_of
from tests.support.playground_site import (
    another,
    chosen,
    first_walk,
    put,
    rewalked,
    served,
    size,
    text_in,
    typed,
    violations,
    visit,
    walked,
)

BELOW = """(id) => play.equations.root.getElementById(id).getBoundingClientRect().top
    - document.querySelector(".read .bar").getBoundingClientRect().bottom"""


def in_sight(page, id, by=0):
    """Wait until a step stands under the bar, or so far below."""
    page.wait_for_function(f"([id, by]) => Math.abs(({BELOW})(id) - by) < 3", arg=[id, by])


def addressed(page, end):
    """Wait until the address ends so."""
    page.wait_for_function("(end) => location.href.endsWith(end)", arg=end)


def entries(page):
    """How many there are in the history."""
    return page.evaluate("history.length")


def article(page, step, inside=""):
    """What stands in a step."""
    return page.locator(f"#walk article[id='{step}'] {inside}")


READY = {"index.html", "main.js", "play.css", "arrows.css", "page.css", "data.json"}
"""What shows a ready-made problem, with a file of its own."""
PYTHON = {
    *("worker.js", "first.tar.gz", "pyodide/pyodide.mjs", "pyodide/pyodide.asm.mjs"),
    *("pyodide/pyodide.asm.wasm", "pyodide/python_stdlib.zip", "pyodide/pyodide-lock.json"),
}
"""What derives one that is changed."""
LIGHT, EACH = 0.3, 0.06
"""MB, of what moves the first body, and of each further ready-made problem."""
MOST = 7.5
"""MB."""
COPIES = """() => [...play.equations.root.querySelectorAll("article")].map(
    (x) => [...x.querySelectorAll(".number button")].map((y) => [y.ariaLabel, y.tabIndex]))"""


def test_what_is_derived_is_read(newcomer, site):
    visit(newcomer, f"{site}#so3")
    assert first_walk(newcomer.own, site) == READY | {"ready/so3.en.json.gz"}
    # steps are chosen, and lead to others; back and forward go to where the reader was
    begun = entries(newcomer)
    newcomer.select_option("#steps", "so3.kernel")
    addressed(newcomer, "#so3/so3.kernel")
    in_sight(newcomer, "so3.kernel")
    article(newcomer, "so3.kernel", "summary").first.click()
    left = "so3.kernel", -20
    newcomer.evaluate("document.getElementById('walk').scrollBy(0, 20)")
    in_sight(newcomer, *left)
    article(newcomer, "so3.kernel", "details a").first.click()
    newcomer.wait_for_function("() => !location.hash.endsWith('/so3.kernel')")
    second = newcomer.url.rpartition("/")[2]
    in_sight(newcomer, second)
    newcomer.wait_for_function("(id) => document.getElementById('steps').value === id", arg=second)
    assert entries(newcomer) == begun + 2
    newcomer.go_back()
    in_sight(newcomer, *left)
    addressed(newcomer, "#so3/so3.kernel")
    newcomer.go_back()
    newcomer.wait_for_function("() => document.getElementById('walk').scrollTop < 5")
    newcomer.go_forward()
    in_sight(newcomer, *left)
    # the equations alone; the page remembers that, and where the reader was
    assert newcomer.is_visible(".write")
    newcomer.click("#wide")
    assert not newcomer.is_visible(".write")
    in_sight(newcomer, *left)
    with rewalked(newcomer, "so3"):
        newcomer.reload()
    in_sight(newcomer, *left)
    assert not newcomer.is_visible(".write")
    newcomer.keyboard.press("F8")
    assert newcomer.is_visible(".write")
    in_a_room(newcomer)
    # a star leads to what is corrected
    star = article(newcomer, "linear.motions", ".printed a")
    assert star.text_content() == "*"
    star.click()
    assert newcomer.url.endswith("#so3/linear.symplectic")
    in_sight(newcomer, "linear.symplectic")
    assert article(newcomer, "linear.symplectic", ".correction").count() == 1
    assert article(newcomer, "linear.symplectic", ".printed a").count() == 0


HEIGHTS = """[...document.querySelector(".screen > div").shadowRoot.querySelectorAll(
    ".now math")].map((x) => parseFloat(getComputedStyle(x).fontSize))"""


SIDES = ":is(.left, .right)"


def read(place):
    """The text of what is found, without spaces."""
    return "".join("".join(place.all_text_contents()).split())


def in_a_room(page):
    """The walk a step a screen, from where the reader is, by the keys of a clicker."""

    def shown(selector):
        return page.locator(f"#projector {selector}").inner_text()

    page.select_option("#steps", "so3.coadjoint")
    in_sight(page, "so3.coadjoint")
    page.locator("#walk").focus()
    page.keyboard.press("p")
    assert shown("header").split("\n")[-1] == "so3.coadjoint"
    page.keyboard.press("PageDown")
    addressed(page, "#so3/so3.kernel&projected")
    step = article(page, "so3.kernel")
    assert read(page.locator("#projector .why")) == read(step.locator("> p").first)
    now = page.locator(f"#projector .now {SIDES}")
    assert read(now) == read(step.locator(f"> .equations {SIDES}"))
    used = step.locator("> details").first.locator("a").all_text_contents()
    listed = page.evaluate("[...document.getElementById('steps').options].map((x) => x.value)")
    last = max(used, key=listed.index)
    before = page.locator("#projector .was").last.locator(SIDES)
    assert read(before) == read(article(page, last, f"> .equations {SIDES}"))
    assert min(page.evaluate(HEIGHTS)) >= 28
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(0, 0, 0)"
    page.wait_for_selector("iframe[data-moved]")  # the body beside its own steps
    assert page.locator("iframe[data-moved]").bounding_box()["width"] > 400
    page.keyboard.press("Home")
    assert not page.is_visible("iframe")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowLeft")
    first = shown("header").split("\n")[-1]
    assert first == listed[1]
    page.keyboard.press("End")
    assert page.locator(".screen p math").count() == page.locator("#answer p math").count()
    page.keyboard.press("PageUp")
    page.keyboard.press("Escape")
    assert not page.is_visible("#projector")
    addressed(page, f"/{listed[-1]}")
    assert page.is_visible("#walk")


def test_what_is_now_is_seen_before_what_was(fresh, site):
    """Of every step of a small body, on a small screen: what does not fit is the steps before it,
    which are there where they do."""
    fresh.set_viewport_size({"width": 1280, "height": 720})
    visit(fresh, f"{site}?lang=fr#pendulum/linear.lagrangian&tab=walk", "pendulum")
    fresh.keyboard.press("p")
    seen = """() => {
        const x = document.querySelector(".screen"), steps = x.firstElementChild.shadowRoot;
        const was = [...steps.querySelectorAll(".was")].map((y) => y.hidden);
        return [x.scrollHeight > x.clientHeight, was];
    }"""
    found = []
    while "pendulum.explicit" not in fresh.inner_text("#projector header"):
        found.append(fresh.evaluate(seen))
        fresh.keyboard.press("PageDown")
    assert len(found) > 40
    assert [x for over, x in found if over and not all(x)] == []
    assert any(any(x) for _, x in found)
    assert sum(x == [False, False] for _, x in found) > len(found) / 2


WALK = """play.equations.root.innerHTML.replace(/href="[^"]*"/g, "")"""
"""The walk but for the addresses of its steps."""


def test_it_opens_on_a_body_that_moves_and_its_equations(newcomer, site):
    """Without Python, which comes when the problem is changed; what that walks is the same."""
    newcomer.goto(site)
    walked(newcomer, "top")
    newcomer.wait_for_selector("iframe[data-moved]")
    assert newcomer.inner_text("#answer h2") == "Equations of motion"
    assert newcomer.locator("#answer p math").count() == 5
    newcomer.wait_for_selector("iframe[data-kept]", state="attached")
    own = {x.removeprefix(site).partition("#")[0] for x in newcomer.own if x.startswith(site)}
    assert not own & PYTHON
    assert size({x or "index.html" for x in own}) < LIGHT
    made = [*(built() / "ready").iterdir()]
    kinds = (*LANGUAGES, "code")
    assert {x.name for x in made} == {f"{x}.{y}.json.gz" for x in ready_made() for y in kinds}
    assert max(x.stat().st_size for x in made) / 1e6 < EACH
    stored = newcomer.evaluate(WALK)
    newcomer.own.clear()
    typed(newcomer, f"{text_of('top')}\n")
    assert newcomer.evaluate(WALK) == stored
    assert first_walk(newcomer.own, site) == PYTHON
    assert size(READY | PYTHON) < MOST


def test_help_is_five_lines(fresh, site):
    visit(fresh, f"{site}#top", "top")
    fresh.click(".help summary")
    assert fresh.locator(".help li:visible").count() == 5
    assert not violations(fresh, ".help")


def test_equations_are_copied(fresh, site):
    """One stop of Tab a step, arrows within; every bar of the TeX is an accent of the MathML, which
    is well-formed by itself, without the style of the page."""
    fresh.context.grant_permissions(["clipboard-read", "clipboard-write"])

    def copied(button):
        button.click()
        return fresh.evaluate("navigator.clipboard.readText()")

    visit(fresh, f"{site}#so3")
    found = fresh.evaluate(COPIES)
    assert found[0] == [["TeX (1.1): copy the LaTeX", 0], ["MathML (1.1): copy the MathML", -1]]
    assert all(sum(stop == 0 for _, stop in x) == 1 for x in found if x)
    assert sum(map(len, found)) > 100
    buttons = fresh.locator("#walk .number button")
    assert copied(buttons.nth(0)).startswith("L")
    assert copied(buttons.nth(1)).startswith('<math xmlns="http://www.w3.org/1998/Math/MathML"')
    buttons.first.focus()
    for key, expected in (
        ("ArrowRight", "MathML (1.1): copy the MathML"),
        ("ArrowDown", "MathML (1.2): copy the MathML"),
        ("ArrowLeft", "TeX (1.2): copy the LaTeX"),
        ("ArrowUp", "TeX (1.1): copy the LaTeX"),
    ):
        fresh.keyboard.press(key)
        label = "play.equations.root.activeElement.getAttribute('aria-label')"
        assert fresh.evaluate(label) == expected
    chosen(fresh, "gl3")
    equations = fresh.locator("#walk .equation:has(.overline):has(button)")
    bars = 0
    for k in range(equations.count()):
        tex, button = (equations.nth(k).locator("button").nth(x) for x in (0, 1))
        whole = ElementTree.fromstring(copied(button))
        marks = [x.text for x in whole.iter("{http://www.w3.org/1998/Math/MathML}mo")]
        told = tex.get_attribute("data-tex")
        assert marks.count("‾") == told.count("\\bar{") + told.count("\\overline{"), told
        assert not [x for x in whole.iter() if x.get("class") == "overline"]
        bars += marks.count("‾")
    assert bars > 20


def checked(page):
    """What is said of a check that holds; it is asked for while the page derives."""
    page.evaluate("delete document.body.dataset.checked")
    page.click("#check")
    page.wait_for_selector("body[data-checked=holds]", timeout=90_000)
    return page.inner_text("#state")


def test_a_problem_of_ones_own(fresh, site):
    visit(fresh, f"{site}#so3")
    put(fresh, PENDULUM)
    fresh.click("#check")  # the text is not even asked about
    assert "then the check" in fresh.inner_text("#state")
    # a check that was asked for follows the walk; each step gets a tick
    fresh.wait_for_selector("body[data-checked=holds]", timeout=90_000)
    assert "the probability that a false step passes is below" in fresh.inner_text("#state")
    ticks, steps = fresh.evaluate("""() => ["h3 .tick", "article"].map(
        (x) => play.equations.root.querySelectorAll(x).length)""")
    assert ticks == steps > 40
    tick = fresh.locator("#walk h3 .tick").first
    assert "probability" in tick.get_attribute("title")
    assert "e-" not in tick.inner_text()
    assert "× 10⁻" in tick.inner_text()
    fresh.click("[data-lang=fr]")
    assert "la probabilité" in checked(fresh)
    fresh.click("[data-lang=en]")
    # a fault is shown at its line, and gone when it is mended
    typed(fresh, UNKNOWN_KEY, "fault")
    assert "unknown key 'h'" in fresh.inner_text("#errors")
    assert fresh.locator(".cm-lint-marker-error").count() == 1
    fresh.click("#errors button")
    assert fresh.evaluate("document.activeElement.classList.contains('cm-content')")
    fresh.click("#check")
    assert "first mend" in fresh.inner_text("#state")
    typed(fresh, PENDULUM)
    assert fresh.inner_text("#errors") == ""


def test_the_address_is_the_problem(fresh, site):
    """Its language, its step; and an edit leaves the ready-made problem behind."""
    visit(fresh, f"{site}?lang=fr#SO3/so3.kernel")
    in_sight(fresh, "so3.kernel")
    assert fresh.inner_text("#errors") == ""
    assert fresh.url == f"{site}?lang=fr#so3/so3.kernel"
    assert fresh.evaluate("document.documentElement.lang") == "fr"
    assert fresh.locator("#walk h1").inner_text() == "Le solide autour d’un point fixe"
    with rewalked(fresh, "so3"):
        fresh.click("[data-lang=en]")
    assert fresh.url == f"{site}?lang=en#so3/so3.kernel"
    in_sight(fresh, "so3.kernel")
    chosen(fresh, "jelly")
    assert fresh.url.endswith("#jelly&tab=walk")
    with rewalked(fresh, "so3"):
        fresh.go_back()
    with rewalked(fresh, "jelly"):
        fresh.go_forward()
    # an edit, and the next one, have one entry together
    begun = entries(fresh)
    typed(fresh, PENDULUM.replace("mine", "other"))
    typed(fresh, PENDULUM)
    assert entries(fresh) == begun + 1
    article(fresh, "mine.motion", "a.label").click()
    link = fresh.url
    assert "#p=" in link
    assert link.endswith("/mine.motion")
    assert len(link) < 420
    shown = article(fresh, "mine.kernel", "a.label").get_attribute("href")
    assert shown == f"#{link.partition('#')[2].rpartition('/')[0]}/mine.kernel"
    fresh.go_back()
    addressed(fresh, f"{link.partition('#')[2].rpartition('/')[0]}&tab=walk")
    with rewalked(fresh, "jelly"):
        fresh.go_back()
    assert text_in(fresh) == text_of("jelly")
    with rewalked(fresh):
        fresh.select_option("#ready", "")  # one's own, to begin with
    assert fresh.inner_text("#errors") == ""
    assert "#p=" in fresh.url
    with rewalked(fresh, "jelly"):
        fresh.go_back()
    # who gets the link sees the same; what is wrong in it is told
    with another(fresh.context) as other:
        visit(other, link, "own")
        in_sight(other, "mine.motion")
        assert text_in(other) == PENDULUM
        problem = link.rpartition("/")[0]
        other.goto("about:blank")
        visit(other, f"{problem[:-9]}AAAAAAAAA")
        assert "damaged" in other.inner_text("#errors")
        other.goto(f"{other.url.partition('#')[0]}#so3/so3.nosuch")  # so3 is walked
        says = "document.getElementById('state').textContent"
        other.wait_for_function(f"() => {says}.includes(\"no step 'so3.nosuch'\")")
        visit(other, f"{other.url.partition('#')[0]}#nosuch")
        assert "no ready-made problem 'nosuch'" in other.inner_text("#errors")


# ---- what is taken


REFUSED = "[...document.querySelectorAll('#take :is(option, input):disabled')].length"
ABOUT = {
    "en": {"frame": "as in", "state": "all entries"},
    "fr": {"frame": "comme dans", "state": "tous les coefficients"},
}
ALIKE = {"attitude": "matrices", "form": ".h", "velocity": "Z"}
"""How the words begin for the first choice of some options."""


def told(page, option):
    """Wait for the reason why an option cannot be chosen; where it is told."""
    place = page.locator(f"#why-{option} li").first
    place.wait_for()
    return place


def offered(page):
    """Show what can be taken, with all options."""
    page.click("#tab-take")
    page.click("#take summary")


def test_an_option_that_would_be_refused_cannot_be_chosen(fresh, site):
    """As the command does for what is chosen; what is chosen can always be left out."""
    visit(fresh, f"{site}?lang=fr#so3")
    data = json.loads((built() / "data.json").read_text(encoding="utf-8"))
    for lang in ("fr", "en"):
        if lang == "en":
            with rewalked(fresh, "so3"):
                fresh.click("[data-lang=en]")
        offered(fresh)
        for name, english in data["about"]["en"].items():
            about = fresh.locator(f"#about-{name}")
            assert about.is_visible(), name
            assert (about.inner_text() == english) == (lang == "en"), name
        for name, (first, *_) in data["choices"].items():
            shown = fresh.locator(f"select[aria-describedby~=about-{name}]").locator("option").first
            words = (ALIKE | ABOUT[lang]).get(name)
            begin = f"{first} – {words}" if words else f"{first} ("
            assert shown.inner_text().startswith(begin), name

    def options(name):
        return fresh.locator(f"select[aria-describedby~=why-{name}] option")

    assert "SO(3) has none or several" in told(fresh, "multiplier").inner_text()
    box = fresh.get_by_role("checkbox", name="multiplier")
    assert box.is_disabled()
    assert "SO(3) has none" in box.locator("xpath=..").get_attribute("title")
    assert "why-multiplier" in box.get_attribute("aria-describedby")
    assert told(fresh, "step").inner_text().startswith("gauss_jax – ")
    assert [x.is_disabled() for x in options("order").all()] == [False, True, True, True]
    fresh.get_by_label("discrete").check()
    fresh.wait_for_function("() => !document.querySelector('#why-order li')")
    assert not options("order").nth(2).is_disabled()
    fresh.get_by_label("discrete").uncheck()
    told(fresh, "order")
    assert fresh.get_by_label("julia").is_enabled()
    frames = "select[aria-describedby~=why-frame]"
    fresh.select_option(frames, "principal")
    fresh.locator("#why-lang li", has_text="not in julia").wait_for()
    assert fresh.get_by_label("julia").is_disabled()
    fresh.select_option(frames, index=0)
    fresh.wait_for_function("() => !document.querySelector('#why-lang li')")
    assert fresh.get_by_label("julia").is_enabled()
    fresh.select_option("select[aria-describedby~=why-attitude]", "quaternion")
    told(fresh, "velocity")
    assert options("velocity").nth(1).is_disabled()
    chosen(fresh, "sl3")  # on which a quaternion that is chosen is refused
    fault = fresh.locator("#take .choices .fault")
    fault.wait_for()
    assert "a quaternion needs a factor SO(3) or SE(3)" in fault.inner_text()
    assert fresh.evaluate(REFUSED) == 0
    fresh.select_option("select[aria-describedby~=why-attitude]", "")
    assert "a quaternion needs a factor SO(3)" in told(fresh, "attitude").inner_text()
    assert fault.inner_text() == ""
    assert fresh.get_by_role("checkbox", name="multiplier").is_enabled()
    # of a text that is wrong none is refused
    typed(fresh, UNKNOWN_KEY, "fault")
    assert fresh.evaluate(REFUSED) == 0


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


def test_what_is_taken_is_shown_and_what_is_refused_is_told_beside(fresh, site):
    def saved(button):
        with fresh.expect_download() as waiting:
            fresh.click(button)
        text = waiting.value.path().read_text(encoding="utf-8")
        return waiting.value.suggested_filename, text

    visit(fresh, f"{site}#so3")
    fresh.click("#tab-take")
    fresh.wait_for_selector(".code pre")  # at once: it was made with the page
    assert fresh.input_value(".code select") == "main.c"
    assert fresh.inner_text(".code pre").startswith("/* cc -std=c99 main.c so3.c -lm")
    assert f"{site}ready/so3.code.json.gz" in fresh.own
    imports = 'import { notebook } from "./src/notebook.js";'
    call = 'notebook("so3", given, "The solid about a fixed point")'
    book = saved("#take button:has-text('.ipynb')")
    assert book == ("so3.ipynb", in_node.told(imports, call, text_of("so3")))
    typed(fresh, NUMBERS)
    assert saved("#take button:has-text('mine.toml')") == ("mine.toml", NUMBERS)
    fresh.wait_for_selector(".code option[value='mine.py']", state="attached")
    listed = fresh.locator(".code option").all_inner_texts()
    assert listed == ["main.c", "main.py", "mine.c", "mine.h", "mine.py"]
    assert '#include "mine.h"' in fresh.inner_text(".code pre")
    fresh.select_option(".code select", "mine.py")
    code = fresh.evaluate("document.querySelector('.code pre').textContent")
    compile(code, "mine.py", "exec")
    assert saved(".code button:has-text('Save')") == ("mine.py", code)
    about = fresh.inner_text(".code .told")
    assert f"{len(code.encode()) / 1e3:.1f} kB; " in about
    assert "rhs" in about
    fresh.select_option(".code select", "main.c")
    name, program = saved(".code button:has-text('Save')")
    assert name == "main.c"
    assert "mine_rhs(0, x, k, u, dx);" in program
    with fresh.expect_download() as waiting:
        fresh.click("#take button:has-text('.zip')")
    with ZipFile(waiting.value.path()) as packed:
        assert sorted(packed.namelist()) == sorted(listed)
        assert packed.read("main.c").decode() == program
    fresh.click("#take summary")
    fresh.click("#take label:has-text('parameters')")
    assert fresh.locator(".code pre").count() == 0  # it was of other options
    fresh.click("#take button:has-text('Show the code')")
    fault = fresh.locator("#take .row:has(button:has-text('zip')) [role=alert]")
    fault.wait_for()
    assert "no parameters" in fault.inner_text()


def test_each_text_is_saved(fresh, site):
    """None of them needs NumPy, which the page does not have."""
    visit(fresh, f"{site}#so3")
    fresh.click("#tab-take")
    for end in (".tex", ".html", ".json"):
        with fresh.expect_download() as waiting:
            fresh.click(f"#take button:has-text('{end}')")
        assert waiting.value.suggested_filename == f"so3{end}"
        assert "so3.motion" in waiting.value.path().read_text(encoding="utf-8")


# ---- what may happen to it

BUSY = """async () => {
    const asked = play.engine.ask({ ask: "check", text: play.text.text }, () => {});
    let worst = 0, before = performance.now(), end = before + 1500;
    while (performance.now() < end) {
        await new Promise((resolve) => { setTimeout(resolve, 0); });
        worst = Math.max(worst, performance.now() - before);
        before = performance.now();
    }
    play.engine.stop();
    return [worst, await asked];
}"""
GO_ON = "this machine is slow, or the problem is large. Go on?"
LATE = """async () => {
    play.engine.seconds = 0.2;
    const how = await play.engine.ask({ ask: "check", text: play.text.text }, () => {});
    play.engine.seconds = 60;
    return how;
}"""


def test_a_check_can_be_stopped_and_the_clock_ends_it(fresh, site):
    """Meanwhile the page answers keys; then it derives as before."""
    visit(fresh, f"{site}#so3")
    slowest, how = fresh.evaluate(BUSY)
    # ms; were the page to check by itself, all 1500: other tests take a core for 150
    assert slowest < 400
    assert how == "stopped"
    told = []

    def once(dialog):
        told.append(dialog.message)
        (dialog.dismiss if len(told) > 1 else dialog.accept)()

    fresh.on("dialog", once)  # it goes on where the reader says so
    assert fresh.evaluate(LATE) == "late"
    assert [x.split(": ")[-1] for x in told] == [GO_ON] * 2
    typed(fresh, PENDULUM)


def test_it_works_without_a_network_after_the_first_visit(browser):
    need("node", "npm")
    with served(built().parent) as (address, serving):
        context = browser.new_context()
        page = context.new_page()
        page.goto(f"{address}play/")
        walked(page, "top")
        page.wait_for_function(
            "async () => (await (await caches.open((await caches.keys())[0])).keys()).length > 15"
        )
        page.evaluate("navigator.serviceWorker.ready.then(() => true)")
        serving.shutdown()
        serving.server_close()
        context.set_offline(True)
        again = context.new_page()
        again.goto(f"{address}play/#jelly")
        walked(again, "jelly")
        again.click("#tab-see")
        again.wait_for_selector("iframe[data-moved]", timeout=90_000)
        context.close()


def test_a_browser_without_web_assembly_says_what_to_do(fresh, site):
    fresh.add_init_script("delete globalThis.WebAssembly")
    fresh.goto(site)
    walked(fresh, "top")  # by what was made with the page
    put(fresh, PENDULUM)
    fresh.wait_for_selector("#walk pre")
    assert "derive walk mine.toml" in fresh.inner_text("#walk pre")
