"""The page of the playground for every reader: screen readers, the keyboard, a phone, dark mode;
how much it loads; and files of strangers, which neither hang it nor become markup."""

import json

import pytest

from tests.support.playground_site import OWN, first_walk, size, walked

SPITEFUL = [
    '<img src=x onerror="window.ran=1">',
    "</title><script>window.ran=1</script>",
    "{{ 7*7 }}",
    "]]><svg/onload=window.ran=1>",
    "\u202egnihton",
    "$\\immediate\\write18{ls}$",
]
FIRST = [
    *("index.html", "main.js", "play.css", "page.css", "data.json", "icon.svg", "worker.js"),
    *("pyodide/pyodide.mjs", "pyodide/pyodide.asm.mjs", "pyodide/pyodide.asm.wasm"),
    *("pyodide/python_stdlib.zip", "pyodide/pyodide-lock.json", "first.tar.gz", "play.webmanifest"),
]
MOST = 7.5
"""MB."""


def test_what_a_first_walk_loads_is_small(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    loaded = first_walk(fresh.asked, site)
    assert {*FIRST} - {"icon.svg", "play.webmanifest"} <= loaded <= {*FIRST}
    assert size(loaded) < MOST


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [390, 1280])
def test_screen_readers_and_contrast(browser, site, width, dark):
    scheme = "dark" if dark else "light"
    context = browser.new_context(
        viewport={"width": width, "height": 800}, color_scheme=scheme, locale="fr-FR"
    )
    opened = context.new_page()
    opened.goto(f"{site}#jelly")
    walked(opened, "jelly")
    axe = (OWN / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")
    for tab in ("walk", "take", "see"):
        opened.click(f"#tab-{tab}")
        if tab == "see":
            opened.wait_for_selector("iframe[data-moved]", timeout=90_000)
        assert opened.evaluate("document.documentElement.scrollWidth") <= width
        opened.evaluate(f"{axe}; 0")
        chosen = "{ resultTypes: ['violations'], iframes: false }"
        found = opened.evaluate(f"axe.run({chosen}).then((x) => x.violations)")
        told = [(x["id"], [y["html"][:120] for y in x["nodes"][:3]]) for x in found]
        assert not told, json.dumps(told, indent=1)
    opened.click("#as-form")
    opened.wait_for_selector("#form > *")
    found = opened.evaluate(
        "axe.run({ iframes: false }).then((x) => x.violations.map((y) => y.id))"
    )
    assert found == []
    context.close()


def test_the_keyboard_reaches_everything(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.evaluate("document.activeElement.blur()")
    reached = []
    for _ in range(14):
        fresh.keyboard.press("Tab")
        reached.append(
            fresh.evaluate("document.activeElement.id || document.activeElement.className")
        )
    for id in ("ready", "as-text", "as-form", "link", "cm-content", "tab-walk", "check", "walk"):
        assert any(id in x for x in reached), (id, reached)
    fresh.focus("#tab-walk")
    fresh.keyboard.press("ArrowRight")
    fresh.wait_for_selector("iframe[data-moved]", timeout=90_000)
    assert fresh.evaluate("document.activeElement.id") == "tab-see"


def test_keys_are_completed(fresh, site):
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.evaluate("play.text.text = '[[potential]]\\nkind = \"spring\"\\n'; play.text.focus()")
    fresh.keyboard.press("Control+End")
    fresh.keyboard.type("sti")
    fresh.wait_for_selector(".cm-tooltip-autocomplete li")
    assert "stiffness" in fresh.inner_text(".cm-tooltip-autocomplete")


@pytest.mark.parametrize("spite", SPITEFUL, ids=range(len(SPITEFUL)))
def test_texts_are_never_markup(fresh, site, spite):
    quoted = json.dumps(spite, ensure_ascii=False)
    text = (
        f'name = "spite"\ntitle = {quoted}\ngroup = "SO(3)"\n[body]\nmoments = "symbolic"\n'
        f"[parameters]\nm = {{ default = 1, unit = {quoted}, meaning = {quoted} }}\n"
        f'[[potential]]\nkind = "gravity"\ng = [0, 0, 1]\n'
    )
    fresh.goto(f"{site}#so3")
    walked(fresh)
    fresh.evaluate(
        "(text) => { delete document.body.dataset.walked; play.text.text = text; }", text
    )
    fresh.wait_for_selector("body[data-walked]", timeout=90_000)
    fresh.click("#tab-see")
    fresh.wait_for_selector("iframe[data-moved], #see .fault", timeout=90_000)
    strange = "script, img, [onerror], [onload]"
    count = f"document.querySelectorAll('#errors :is({strange}), #see :is({strange})').length"
    assert fresh.evaluate(count) == 0
    assert fresh.evaluate(f"play.equations.root.querySelectorAll({strange!r}).length") == 0
    assert not any(x.evaluate("globalThis.ran") for x in fresh.frames)
