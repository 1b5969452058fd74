"""The playground in Chromium: its problem, its body, its files; what works without a network, and
nothing leaves the machine."""

import json
import tomllib
from xml.etree import ElementTree

from derive import derive as derived
from derive.command.loading import READY
from tests.support.needs import need
from tests.support.played import PENDULUM, UNKNOWN_KEY
from tests.support.playground_site import built, served, typed, walked


def test_what_is_kept_comes_behind_the_motion(fresh, site):
    """The body moves first; then the momenta are in its table, and they stay what they are."""
    fresh.goto(f"{site}#top")
    walked(fresh, "top")
    fresh.click("#tab-see")
    fresh.wait_for_selector("iframe[data-moved]", timeout=90_000)
    fresh.wait_for_selector("iframe[data-kept]", timeout=90_000)
    frame = fresh.frames[-1]
    frame.evaluate("document.getElementById('motion').motion.seek(3)")
    frame.wait_for_function("() => document.getElementById('motion').motion.time === 3")
    frame.wait_for_timeout(200)
    names = frame.evaluate(
        "[...document.querySelectorAll('tr[data-name]')].map((x) => x.dataset.name)"
    )
    assert names == ["energy", "angular_momentum_3", "body_angular_momentum_3", "defect"]
    for name in names[:-1]:
        change = frame.inner_text(f"[data-name={name}] td + td").replace("−", "-")
        assert float(change) < 1e-8
    frame.fill("[data-name=zeta_1] input[inputmode]", "3")
    frame.press("[data-name=zeta_1] input[inputmode]", "Enter")
    frame.wait_for_timeout(200)
    assert frame.inner_text("[data-name=body_angular_momentum_3] td + td") == "0"
    assert not fresh.told


def test_the_page_shows_a_fault_and_recovers(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    typed(fresh, UNKNOWN_KEY)
    walked(fresh, "fault")
    assert "unknown key 'h'" in fresh.inner_text("#errors")
    assert fresh.locator(".cm-lint-marker-error").count() == 1
    fresh.click("#errors button")
    assert fresh.evaluate("document.activeElement.classList.contains('cm-content')")
    typed(fresh, PENDULUM)
    walked(fresh, "own")
    assert fresh.inner_text("#errors") == ""
    assert not fresh.told


def test_steps_get_ticks(fresh, site):
    fresh.goto(f"{site}#jelly")
    walked(fresh, "jelly")
    fresh.click("#check")
    fresh.wait_for_selector("body[data-checked=holds]", timeout=90_000)
    ticks, steps = fresh.evaluate("""() => ["h3 .tick", "article"].map(
        (x) => play.equations.root.querySelectorAll(x).length)""")
    assert ticks == steps > 40


def test_the_address_is_the_problem(fresh, site, browser):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.select_option("#ready", "jelly")
    walked(fresh, "jelly")
    assert fresh.url.endswith("#jelly")
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.go_back()
    walked(fresh)
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.go_forward()
    walked(fresh, "jelly")
    typed(fresh, PENDULUM)
    walked(fresh, "own")
    link = fresh.url
    assert "#p=" in link
    assert len(link) < 400
    other = browser.new_page()
    other.goto(link)
    walked(other, "own")
    assert other.evaluate("play.text.text") == PENDULUM
    other.goto("about:blank")
    other.goto(link[:-9] + "AAAAAAAAA")
    walked(other)
    assert "damaged" in other.inner_text("#errors")
    other.close()


def test_it_works_without_a_network_after_the_first_visit(browser):
    need("node", "npm")
    with served(built().parent) as (address, serving):
        context = browser.new_context()
        opened = context.new_page()
        opened.goto(f"{address}play/")
        walked(opened)
        opened.wait_for_function(
            "async () => (await (await caches.open((await caches.keys())[0])).keys()).length > 15"
        )
        opened.evaluate("navigator.serviceWorker.ready.then(() => true)")
        serving.shutdown()
        serving.server_close()
        context.set_offline(True)
        again = context.new_page()
        again.goto(f"{address}play/#jelly")
        walked(again, "jelly")
        again.click("#tab-see")
        again.wait_for_selector("iframe[data-moved]", timeout=90_000)
        context.close()


def test_nothing_is_asked_of_others_and_nothing_may_be(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.click("#tab-see")
    fresh.wait_for_selector("iframe[data-moved]", timeout=90_000)
    assert fresh.asked
    assert all(x.startswith((site, "blob:")) for x in fresh.asked)
    assert not fresh.told
    elsewhere = "fetch('http://127.0.0.2:9/x').then(() => 'came', () => 'refused')"
    assert fresh.evaluate(elsewhere) == "refused"
    assert any("Content Security Policy" in x for x in fresh.told)
    fresh.told.clear()
    (worker,) = fresh.workers
    assert worker.evaluate(elsewhere) == "refused"
    frame = fresh.frames[-1]
    assert frame.evaluate("fetch('motion.css').then(() => 'came', () => 'refused')") == "refused"
    assert not [x for x in fresh.asked if "127.0.0.2" in x]
    scripts = """() => {
        const made = document.createElement("script");
        made.textContent = "window.ran = 1";
        document.body.append(made);
        return window.ran ?? "blocked";
    }"""
    assert fresh.evaluate(scripts) == "blocked"


def test_the_body_moves_and_what_is_kept_stays(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.click("#tab-see")
    fresh.wait_for_selector("iframe[data-moved]", timeout=90_000)
    frame = fresh.frames[-1]
    moved = """() => {
        const { motion } = document.getElementById("motion");
        motion.pause();
        motion.run.reach(10, Infinity);
        return [0, 10].map((t) => [...motion.run.at(t)]);
    }"""
    first, last = frame.evaluate(moved)
    assert max(abs(a - b) for a, b in zip(first, last, strict=True)) > 0.1
    frame.evaluate('document.getElementById("motion").motion.seek(10)')
    frame.wait_for_function("() => document.getElementById('motion').motion.time === 10")
    frame.wait_for_timeout(200)
    change = frame.inner_text("[data-name=energy] td + td").replace("−", "-")
    assert float(change) < 1e-9


def test_a_walk_can_be_stopped_and_the_clock_ends_it(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    stopped = fresh.evaluate("""async () => {
        const asked = play.engine.ask({ ask: "check", text: play.text.text }, () => {});
        await new Promise((resolve) => { setTimeout(resolve, 300); });
        play.engine.stop();
        return asked;
    }""")
    assert stopped == "stopped"
    late = """async () => {
        play.engine.seconds = 0.2;
        const how = await play.engine.ask({ ask: "check", text: play.text.text }, () => {});
        play.engine.seconds = 60;
        return how;
    }"""
    assert fresh.evaluate(late) == "late"
    typed(fresh, PENDULUM)
    walked(fresh, "own")


def test_the_page_answers_keys_while_it_derives(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    slowest = fresh.evaluate("""async () => {
        const asked = play.engine.ask({ ask: "check", text: play.text.text }, () => {});
        let worst = 0, before = performance.now(), end = before + 1500;
        while (performance.now() < end) {
            await new Promise((resolve) => { setTimeout(resolve, 0); });
            worst = Math.max(worst, performance.now() - before);
            before = performance.now();
        }
        play.engine.stop();
        await asked;
        return worst;
    }""")
    assert slowest < 100


def test_a_form_writes_the_same_file(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    typed(fresh, PENDULUM)
    walked(fresh, "own")
    fresh.click("#as-form")
    fresh.fill("#form input >> nth=0", "another")
    fresh.evaluate("delete document.body.dataset.walked")
    fresh.keyboard.press("Tab")
    walked(fresh, "own")
    expected = tomllib.loads(PENDULUM) | {"name": "another"}
    assert tomllib.loads(fresh.evaluate("play.text.text")) == expected


def test_a_notebook_is_one(fresh, site, tmp_path, monkeypatch):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.click("#tab-take")
    with fresh.expect_download() as waiting:
        fresh.click("#take button:has-text('.ipynb')")
    book = json.loads(waiting.value.path().read_text(encoding="utf-8"))
    title, problem, *_ = ("".join(x["source"]) for x in book["cells"])
    assert title.startswith("# The solid about a fixed point\n")
    assert "pip install derive-mechanics" in title
    monkeypatch.chdir(tmp_path)
    ran = {}
    exec(problem, ran)
    text = (READY / "so3.toml").read_text(encoding="utf-8")
    assert ran["problem"] == text
    assert f"problem = r'''{text}'''\n" in problem
    assert ran["d"].labels == derived("so3").labels
    assert not [*tmp_path.iterdir()]  # no file is written over


def test_an_equation_is_copied(fresh, site):
    fresh.context.grant_permissions(["clipboard-read", "clipboard-write"])
    fresh.goto(f"{site}#so3")
    walked(fresh)
    buttons = fresh.locator("#walk .number button")
    buttons.nth(0).click()
    tex = fresh.evaluate("navigator.clipboard.readText()")
    buttons.nth(1).click()
    mathml = fresh.evaluate("navigator.clipboard.readText()")
    assert tex.startswith("L")
    assert mathml.startswith('<math xmlns="http://www.w3.org/1998/Math/MathML"')


def test_copied_mathml_is_whole_without_the_style_of_the_page(fresh, site):
    """Every bar of the TeX is an accent of the MathML, which is well-formed by itself."""
    fresh.context.grant_permissions(["clipboard-read", "clipboard-write"])
    fresh.goto(f"{site}#gl3")
    walked(fresh, "gl3")
    equations = fresh.locator("#walk .equation:has(.overline):has(button)")
    bars = 0
    for k in range(equations.count()):
        tex, button = (equations.nth(k).locator("button").nth(x) for x in (0, 1))
        button.click()
        copied = ElementTree.fromstring(fresh.evaluate("navigator.clipboard.readText()"))
        marks = [x.text for x in copied.iter("{http://www.w3.org/1998/Math/MathML}mo")]
        told = tex.get_attribute("data-tex")
        assert marks.count("‾") == told.count("\\bar{") + told.count("\\overline{"), told
        assert not [x for x in copied.iter() if x.get("class") == "overline"]
        bars += marks.count("‾")
    assert bars > 20


def test_a_browser_without_web_assembly_says_what_to_do(browser, site):
    opened = browser.new_page()
    opened.add_init_script("delete globalThis.WebAssembly")
    opened.goto(site)
    opened.wait_for_selector("#walk pre")
    assert "derive walk so3" in opened.inner_text("#walk pre")
    opened.close()
