"""An address is what is seen: the problem, its step, the tab, the time, the camera, the numbers."""

import json
from base64 import b64decode
from io import BytesIO

import numpy as np
import pytest
from matplotlib.image import imread

from benchmarks.playground import packed
from tests.playground.test_moving import MOTION, STATE, until
from tests.support import in_node
from tests.support.motion_pages import set_to
from tests.support.played import text_of
from tests.support.playground_site import another, chosen, moving, opened, visit, walked

LINK = 'import { asked, placed } from "./src/link.js";'
SEEN = [
    {},
    {"tab": "take"},
    {"tab": "see"},
    {"projected": ""},
    {"projected": "answer"},
    {"tab": "see", "t": 30, "until": 80, "second": ["zeta_1", 1e-3], "within": True},
    {
        "tab": "see",
        "t": 1.5,
        "eye": [-0.25, 1.5, 2],
        "within": True,
        "set": {"zeta_1": "-3", "m": "1e-7"},
    },
]


def test_what_is_seen_goes_through_an_address():
    script = f"""{LINK}
        const seen = {json.dumps(SEEN)}, told = [];
        for (const x of seen) {{
            const address = placed("fr", "so3", "so3.kernel", x);
            told.push(await asked(address.slice(address.indexOf("#")), ["so3"]));
        }}
        console.log(JSON.stringify(told));"""
    found = json.loads(in_node.printed(script))
    numbers = [x | {"set": {k: float(v) for k, v in x["set"].items()}} for x in SEEN[-1:]]
    assert [x["step"] for x in found] == ["so3.kernel"] * len(SEEN)
    assert [x["name"] for x in found] == ["so3"] * len(SEEN)
    told = [x["seen"] for x in found]
    told[-1]["set"] = {k: float(v) for k, v in told[-1]["set"].items()}
    assert told == SEEN[:-1] + numbers


@pytest.mark.parametrize(
    "wrong",
    [
        *("tab=x", "t=NaN", "t=", "eye=1,2", "eye=a,b,c", "set=m:x", "set=m", "set=<b>:1", "p"),
        *("until=x", "second=zeta_1", "second=zeta_1:x", "second="),
    ],
)
def test_what_an_address_says_wrongly_is_not_seen(wrong):
    script = f'{LINK} console.log(JSON.stringify(await asked("#so3&{wrong}", ["so3"])));'
    assert json.loads(in_node.printed(script)) == {"name": "so3", "step": "", "seen": {}}


EYE = f"(({{ azimuth, elevation, zoom }}) => [azimuth, elevation, zoom])({MOTION}.scene.eye)"


def test_a_copied_link_shows_another_reader_the_same(fresh, site):
    fresh.context.grant_permissions(["clipboard-read", "clipboard-write"])
    visit(fresh, f"{site}?lang=fr#top", "top")
    frame = moving(fresh)
    set_to(frame, "zeta_3", "123,5", "Enter")
    frame.locator("canvas").first.press("ArrowUp")
    frame.locator("canvas").first.press("+")
    state = frame.evaluate(STATE, 0.625)
    until(frame, f"{MOTION}.time === 0.625")
    eye = frame.evaluate(EYE)
    fresh.click("#link")
    fresh.wait_for_selector("#link:has-text('Lien copié')")
    link = fresh.evaluate("navigator.clipboard.readText()")
    assert link == fresh.url
    assert link.startswith(f"{site}?lang=fr#top&t=0.625&eye=")
    assert link.endswith("&set=zeta_3:123.5")
    with opened(fresh.context.browser) as other:
        visit(other, link, "top")
        assert other.url == link
        assert other.evaluate("document.documentElement.lang") == "fr"
        other.wait_for_selector("iframe[data-moved]")
        shown = other.query_selector("iframe").content_frame()
        until(shown, f"{MOTION}.time === 0.625")
        assert shown.evaluate(f"[...{MOTION}.state]") == state
        assert shown.evaluate(EYE) == pytest.approx(eye, rel=1e-6)
        # another problem leaves it behind
        chosen(other, "so3")
        assert other.url == f"{site}?lang=fr#so3"


def test_an_address_of_a_step_on_the_whole_screen(fresh, site):
    fresh.goto(f"{site}?lang=en#so3/so3.kernel&projected")
    walked(fresh)
    assert fresh.inner_text("#projector header .from") == "so3.kernel"
    assert fresh.url == f"{site}?lang=en#so3/so3.kernel&projected"
    fresh.keyboard.press("End")
    assert fresh.url == f"{site}?lang=en#so3&projected=answer"
    fresh.reload()
    walked(fresh)
    assert fresh.locator(".screen p math").count() == fresh.locator("#answer p math").count() > 0
    fresh.keyboard.press("Escape")
    assert fresh.url == f"{site}?lang=en#so3"


def test_the_address_is_the_tab_that_is_seen(fresh, site):
    """Of the first visit, too; a page that is loaded again, and Back, show it."""
    fresh.goto(f"{site}?lang=en")
    walked(fresh, "top")
    assert fresh.url == f"{site}?lang=en#top"
    fresh.reload()
    walked(fresh, "top")
    assert fresh.is_visible("#see")
    for tab, end in (("find", "&tab=find"), ("walk", "&tab=walk"), ("see", "")):
        fresh.click(f"#tab-{tab}")
        assert fresh.url == f"{site}?lang=en#top{end}"
    fresh.select_option("#steps", index=2, force=True)
    assert "&tab" not in fresh.url
    fresh.go_back()
    fresh.wait_for_function("() => !document.getElementById('see').hidden")
    assert fresh.url.endswith("#top")


def test_a_problem_alone_moves_and_what_cannot_is_read(fresh, site):
    """A ready-made one, by its address and by the list, and one's own, in which a fault is read."""
    for where in ("pendulum", "ideal_fluid", "jelly"):
        fresh.goto(f"{site}#{where}")
        walked(fresh, where)
        assert fresh.is_visible("#walk" if where == "ideal_fluid" else "#see")
    chosen(fresh, "ideal_fluid")
    assert fresh.is_visible("#walk")
    chosen(fresh, "jelly")
    fresh.wait_for_selector("iframe[data-moved]")
    own = packed(f"{text_of('pendulum')}\n")
    with another(fresh.context) as other:
        other.goto(f"{site}#p={own}")
        other.wait_for_selector("iframe[data-moved]", timeout=90_000)
    with another(fresh.context) as other:
        other.goto(f"{site}#p={packed('group = 1')}")
        walked(other, "fault")
        assert other.is_visible("#walk .fault")


VIEW = f"""() => {{
    const canvas = document.querySelector(".stage canvas");
    return [{MOTION}.time, {MOTION}.trail.map(([t]) => t), {MOTION}.scene.page.body.parts.length,
        canvas.width, canvas.toDataURL()];
}}"""


@pytest.mark.parametrize("name", ["hung_bar", "jelly", "top"])
def test_what_is_played_looks_as_what_is_sought(fresh, site, name):
    """The trail, the scale and so the picture of an instant are the same, whatever came before."""
    visit(fresh, f"{site}#{name}", name)
    frame = moving(fresh)
    frame.evaluate(f"{MOTION}.seek(0)")
    until(frame, f"{MOTION}.time === 0")
    frame.evaluate(f"{MOTION}.play()")
    until(frame, f"{MOTION}.time > 0.3")
    frame.evaluate(f"{MOTION}.pause()")
    fresh.wait_for_timeout(200)
    played = frame.evaluate(VIEW)
    fresh.reload()
    walked(fresh, name)
    frame = moving(fresh)
    for t in (15, played[0]):
        frame.evaluate(STATE, t)
        until(frame, f"{MOTION}.time === {t}")
    fresh.wait_for_timeout(200)
    sought = frame.evaluate(VIEW)
    assert len(played[1]) > 3
    assert sought[:-1] == played[:-1]
    one, other = (imread(BytesIO(b64decode(x[-1].partition(",")[2]))) for x in (played, sought))
    assert one.shape == other.shape
    assert (np.abs(one - other).max(axis=-1) > 0.2).mean() < 0.002
