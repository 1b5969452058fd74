"""What moves is saved as a picture and as a film."""

import base64
import re
from xml.etree import ElementTree

from tests.playground.test_moving import MOTION, shown_at
from tests.support.playground_site import moving, opened, visit

DRAWN = """async (bytes) => {
    const picture = await createImageBitmap(new Blob([Uint8Array.from(bytes)]));
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const pen = canvas.getContext("2d");
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
    let ink = 0, clear = 0;
    for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 255) ++clear;
        if (data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2]) ++ink;
    }
    return [picture.width, picture.height, ink / data.length * 4, clear];
}"""
"""The size of a picture, the part of it that is not of the colour of its corner, and how many of
its points are clear."""
LONG = """async (bytes) => {
    const film = document.createElement("video");
    film.muted = true;
    film.src = URL.createObjectURL(new Blob([Uint8Array.from(bytes)], { type: "video/webm" }));
    await film.play();
    await new Promise((done) => film.addEventListener("ended", done));
    return [film.videoWidth, film.videoHeight, film.currentTime];
}"""
"""The size of a film, and how long it was when it had been played."""


def saved(page, frame, words, again=""):
    """The name and bytes of what a button saves, which is pressed ``again`` after a second."""
    with page.expect_download() as waiting:
        frame.click(f"button:has-text('{words}')")
        if again:
            page.wait_for_timeout(1000)
            frame.click(f"button:has-text('{again}')")
    return waiting.value.suggested_filename, [*waiting.value.path().read_bytes()]


def test_a_picture_and_a_film_are_saved(fresh, site):
    visit(fresh, f"{site}#top", "top")
    frame = moving(fresh)
    shown_at(frame, 0.5)
    size = frame.evaluate(
        "(({ width, height }) => [width, height])(document.querySelector('canvas'))"
    )
    name, picture = saved(fresh, frame, "Save PNG")
    assert name == "top.png"
    *found, ink, clear = fresh.evaluate(DRAWN, picture)
    told = frame.evaluate(f"{MOTION}.scene.page.meanings")
    assert len(told) == fresh.locator("#answer .legend li").count() > 0
    assert found[0] == 2 * size[0]  # finer than the screen, and below it what the arrows mean
    assert found[1] > 2 * (size[1] + 15 * len(told))
    assert 0.03 < ink < 0.9
    assert clear == 0
    name, film = saved(fresh, frame, "Film", "Stop and save")
    assert name == "top.webm"
    assert frame.evaluate(f"{MOTION}.time") > 0.5
    frame.wait_for_selector("button:has-text('Film')")
    shown_at(frame, 19.95)  # it ends with the motion
    assert saved(fresh, frame, "Film")[0] == "top.webm"
    assert frame.evaluate(f"[{MOTION}.time, {MOTION}.playing]") == [20, False]
    shown_at(frame, 19.95)  # which begins again where none is made
    frame.evaluate(f"{MOTION}.play()")
    frame.wait_for_function(f"() => {MOTION}.time < 10 && {MOTION}.playing")
    now = "(({ width, height }) => [width, height])(document.querySelector('canvas'))"
    assert frame.evaluate(now) == size
    with opened(fresh.context.browser) as other:  # whose policy lets a film be shown
        *found, long = other.evaluate(LONG, film)
    assert found == size
    assert 0.5 < long < 5


def test_the_same_picture_as_svg(fresh, site):
    """As many strokes and faces as the canvas is drawn with, its letters, and what they mean."""
    visit(fresh, f"{site}#top", "top")
    frame = moving(fresh)
    shown_at(frame, 0.5)
    name, picture = saved(fresh, frame, "SVG")
    assert name == "top.svg"
    root = ElementTree.fromstring(bytes(picture))
    parts = [x for x in root.iter() if x.tag.endswith("path")]
    texts = {x.text for x in root.iter() if x.tag.endswith("text")}
    assert len(parts) > 100
    assert {"ζ", "Iζ", "e₁", "e₃", "g"} <= texts
    told = frame.evaluate(f"{MOTION}.scene.page.meanings")
    assert len([x for x in texts if any(x.endswith(y) for y in told)]) == len(told)
    width, height = map(float, root.get("viewBox").split()[2:])
    for part in parts:
        numbers = [float(x) for x in re.findall(r"[ML](-?[\d.]+)", part.get("d"))]
        assert all(-width < x < 2 * width for x in numbers)
    with opened(fresh.context.browser) as other:
        shown = f'<img src="data:image/svg+xml;base64,{base64.b64encode(bytes(picture)).decode()}">'
        other.set_content(shown)
        size = "(({ naturalWidth, naturalHeight }) => naturalHeight / naturalWidth)"
        ratio = other.evaluate(f"{size}(document.querySelector('img'))")
    assert abs(ratio - height / width) < 0.02
    assert frame.evaluate(
        "!Object.hasOwn(document.querySelector('canvas').getContext('2d'), 'fill')"
    )


def test_without_a_recorder_a_line_says_so(fresh, site):
    fresh.add_init_script("delete globalThis.MediaRecorder")
    visit(fresh, f"{site}?lang=fr#top", "top")
    frame = moving(fresh)
    assert frame.locator("button:has-text('Filmer')").count() == 0
    assert "ce navigateur n’en enregistre pas" in frame.inner_text(".saves")
