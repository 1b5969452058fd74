"""The playground in Chromium: what it derives, checks, moves and gives is what the command line
does; what is typed wrong is told at its line; nothing leaves the machine."""

import base64
import io
import json
import tomllib
import zipfile
from xml.etree import ElementTree

import pytest

from derive import derive as derived
from derive.code.emit import emit
from derive.code.options import Options
from derive.command.cli import main
from derive.command.loading import READY, ready_made
from derive.motion.simulate import beginning
from derive.page.motion_page import data
from derive.pipeline import motion_of
from derive.views.language import language
from tests.support.needs import need
from tests.support.playground_site import asked, built, served, walked

PENDULUM = """name = "mine"
group = "SO(3)"
[parameters]
m = { default = 1 }
l = { default = 2 }
g = { default = 9.81 }
[[point]]
mass = "m"
at = ["l", 0, 0]
[[point]]
mass = "m"
at = [0, "l", 0]
[[point]]
mass = "m"
at = [0, 0, "l"]
[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
"""
SLOW = ("inhomogeneous_fluid", "stratified_fluid", "riemann_ellipsoid")
CHECKED = [pytest.param(x, marks=pytest.mark.dist) if x in SLOW else x for x in ready_made()]
MESH = '\n[body]\nsolid = "mesh"\nfile = "cube.off"\ndensity = 1\n'
BAD = [
    (PENDULUM.replace('at = [0, "l", 0]', "at = [0, 1]"), 12, "point 2, at"),
    (PENDULUM.replace('g = [0, 0, "-g"]', 'h = [0, 0, "-g"]'), 18, "unknown key 'h'"),
    (PENDULUM.replace("SO(3)", "SOO(3)"), 2, "unknown group 'SOO(3)'"),
    (PENDULUM.replace('group = "SO(3)"', 'group = "SO(3)'), 2, "not TOML"),
    (PENDULUM.replace("l = { default = 2 }", 'l = { default = "x" }'), 5, "parameter 'l'"),
    (PENDULUM.replace("g = { default = 9.81 }\n", ""), 17, "potential 1, key 'g'"),
    ('name = "cube"\ngroup = "SO(3)"\n' + MESH, 1, "NumPy"),
    ("", 1, "key 'group' is missing"),
]


def typed(opened, text):
    opened.evaluate("delete document.body.dataset.walked")
    opened.evaluate("(text) => { play.text.text = text; }", text)


def said(capsys, *words):
    assert main([*words]) == 0
    return capsys.readouterr().out


def fragment(page, text, lang="en"):
    how, heard = asked(page, "walk", text=text, lang=lang)
    assert how == "end", (how, heard)
    assert not [news for kind, news in heard if kind == "error"]
    return "".join(news for kind, news in heard if kind == "piece")


@pytest.mark.parametrize("name", ready_made())
def test_a_ready_made_problem_is_walked_as_by_the_command(page, capsys, name):
    text = (READY / f"{name}.toml").read_text(encoding="utf-8")
    lang = "fr" if len(name) % 2 else "en"
    command = ("walk", name, "--format", "html", "--fragment", "--lang", lang)
    assert fragment(page, text, lang) == said(capsys, *command)


@pytest.mark.parametrize("name", CHECKED)
def test_a_ready_made_problem_is_checked(page, name):
    text = (READY / f"{name}.toml").read_text(encoding="utf-8")
    how, heard = asked(page, "check", text=text)
    verdicts = [news for kind, news in heard if kind == "verdict"]
    assert how == "end"
    assert ("checked", {}) in heard
    assert len(verdicts) > 10
    assert all(x["holds"] and float(x["bound"]) < 1e-30 for x in verdicts)


def test_a_typed_problem_gives_the_bytes_of_the_command(page, capsys, tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(PENDULUM)
    command = ("walk", str(file), "--format", "html", "--fragment")
    assert fragment(page, PENDULUM) == said(capsys, *command)
    words = "emit FILE --lang c --lang javascript --lang rust --real float --out out"
    _, heard = asked(page, "files", text=PENDULUM, words=words)
    (zipped,) = [news for kind, news in heard if kind == "files"]
    with zipfile.ZipFile(io.BytesIO(base64.b64decode(zipped))) as archive:
        files = {x: archive.read(x) for x in archive.namelist()}
    said(capsys, *words.replace("FILE", str(file)).split()[:-1], str(tmp_path / "out"))
    assert files == {x.name: x.read_bytes() for x in (tmp_path / "out").iterdir()}
    for words, end in (
        ("notes FILE --out out/mine.tex", "tex"),
        ("walk FILE --format json --out out/mine.json", "json"),
    ):
        _, heard = asked(page, "files", text=PENDULUM, words=words)
        (zipped,) = [news for kind, news in heard if kind == "files"]
        with zipfile.ZipFile(io.BytesIO(base64.b64decode(zipped))) as archive:
            shown = archive.read(f"mine.{end}")
        made = tmp_path / f"mine.{end}"
        said(
            capsys,
            *words.replace("FILE", str(file)).replace("out/mine", str(tmp_path / "mine")).split(),
        )
        assert shown == made.read_bytes()


@pytest.mark.parametrize(
    ("text", "chosen"),
    [
        (PENDULUM, "--step gauss"),
        (PENDULUM, "--step gauss --conserved"),
        ("kovalevskaya_top", "--conserved"),
        ("se3", "--step gauss --conserved"),
        ("gas_cloud", "--step gauss --conserved"),
    ],
    ids=range(5),
)
def test_what_is_kept_is_in_the_code_of_the_page(page, capsys, tmp_path, text, chosen):
    file = tmp_path / "mine.toml"
    file.write_text(text if "\n" in text else (READY / f"{text}.toml").read_text())
    words = f"emit FILE --lang c --lang javascript --lang python {chosen} --out out"
    _, heard = asked(page, "files", text=file.read_text(), words=words)
    assert [kind for kind, _ in heard] == ["files"]
    with zipfile.ZipFile(io.BytesIO(base64.b64decode(heard[0][1]))) as archive:
        files = {x: archive.read(x) for x in archive.namelist()}
    said(capsys, *words.replace("FILE", str(file)).split()[:-1], str(tmp_path / "out"))
    assert files == {x.name: x.read_bytes() for x in (tmp_path / "out").iterdir()}


@pytest.mark.parametrize("name", ["so3", "kovalevskaya_top", "sl3", "riemann_ellipsoid"])
def test_a_motion_has_what_the_page_of_the_command_has(page, name):
    text = (READY / f"{name}.toml").read_text(encoding="utf-8")
    (how, first), (_, heard) = (
        asked(page, ask, text=text, lang="fr") for ask in ("motion", "kept")
    )
    assert how == "end"
    ((_, shown),) = [x for x in first if x[0] == "motion"]
    ((_, told),) = [x for x in heard if x[0] == "kept"]
    own = derived(name)
    code = motion_of(own.problem, own.record)
    begin = beginning(code, own.problem, given={})
    there = json.loads(json.dumps(data(code, own.problem, own.record, begin, language("fr"))))
    assert told["kept"] == there["kept"] != {}
    assert shown["page"]["kept"] == {}
    different = {x for x in shown["page"] if shown["page"][x] != there.get(x)}
    assert different <= {"kept", "x", "t", "tol", "names", "pushed"}
    chosen = Options(step=("gauss",))
    (source,) = emit(code.program, own.record, ("javascript",), name, chosen).values()
    assert told["source"] == source


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


@pytest.mark.parametrize(("text", "line", "message"), BAD, ids=range(len(BAD)))
def test_what_is_wrong_is_told_at_its_line(page, text, line, message):
    how, heard = asked(page, "walk", text=text, lang="en")
    errors = [news for kind, news in heard if kind == "error"]
    assert how == "end"
    assert len(errors) == 1
    assert message in errors[0]["message"]
    assert errors[0]["message"].startswith("derive: ")
    assert errors[0]["line"] == line


def test_the_page_shows_a_fault_and_recovers(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    typed(fresh, BAD[1][0])
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
