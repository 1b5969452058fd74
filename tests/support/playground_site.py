"""The playground served on this machine, and pages of it in Chromium."""

import gzip
import shutil
import threading
from contextlib import contextmanager

from playground.site import OWN, built, server
from tests.support.needs import BROWSERS

BEHIND = (
    *("keep.js", "rest.tar.gz", "mpmath.tar.gz"),
    *("moving.html", "moving.js", "motion.css", "motion.js"),
    *("icon.svg", "play.webmanifest"),
)
"""Files that are fetched behind the first walk: the rest of the package, and what a motion and the
worker of the service ask for."""


@contextmanager
def served(folder):
    """The address of a folder while it is served, and the server."""
    serving = server(folder)
    thread = threading.Thread(target=serving.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{serving.server_port}/", serving
    finally:
        serving.shutdown()
        serving.server_close()


@contextmanager
def chromium():
    """The browser of the machine."""
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, BROWSERS)))
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield running
        running.close()


ASK = """([ask, more]) => new Promise(async (resolve) => {
    const heard = [];
    const plain = (bytes) => btoa(Array.from(bytes, (x) => String.fromCharCode(x)).join(""));
    const how = await play.engine.ask({ ask, ...more }, (kind, news) => {
        heard.push([kind, kind === "zip" ? plain(new Uint8Array(news)) : news]);
    });
    resolve([how, heard]);
})"""


def asked(page, ask, **more):
    """How a question to the worker ended, and all that it answered."""
    how, heard = page.evaluate(ASK, [ask, more])
    return how, [(kind, news) for kind, news in heard]


DESK = {"viewport": {"width": 1280, "height": 800}, "locale": "en-GB"}


@contextmanager
def opened(browser, **how):
    """The page of a reader who comes for the first time, in English on a desk; see ``another``."""
    context = browser.new_context(**DESK | how)
    with another(context) as page:
        yield page
    context.close()


@contextmanager
def another(reader):
    """A page, of a reader whose browser has kept the files and the code that it compiled, with what
    was asked for, by itself and in all, and what it complained of, which is nothing at the end.
    """
    page = reader.new_page()
    page.asked, page.own, page.told = [], [], []

    def hear(request):
        page.asked.append(request.url)

    reader.on("request", hear)
    page.on("request", lambda x: page.own.append(x.url))  # not those of the worker of the service
    page.on("console", lambda x: page.told.append(x.text) if x.type == "error" else None)
    page.on("pageerror", lambda x: page.told.append(str(x)))
    yield page
    assert not page.told
    reader.remove_listener("request", hear)
    page.close()


def walked(page, what="so3"):
    """Wait until a problem is walked, or any where none is named."""
    value = f'="{what}"' if what else ""
    page.wait_for_selector(f"body[data-walked{value}]", timeout=90_000)


@contextmanager
def rewalked(page, what="own"):
    """Do something, and wait until what it asks for is walked."""
    page.evaluate("delete document.body.dataset.walked")
    yield
    walked(page, what)


def visit(page, address, what="so3"):
    """Go to an address, of a problem alone to its walk, and wait until that is there; a page that
    is there stays, where nothing but the problem is another."""
    place = address.partition("#")[2]
    address += "&tab=walk" * bool(place and not {*place} & {"/", "&"})
    if page.url.partition("#")[0] != address.partition("#")[0]:
        page.goto(address)
        walked(page, what)
    elif page.url != address:
        with rewalked(page, what):
            page.goto(address)


def chosen(page, name):
    """Choose a ready-made problem."""
    with rewalked(page, name):
        page.select_option("#ready", name)


def put(page, text):
    """Another text in the place of what stands there."""
    page.evaluate("(text) => { play.text.text = text; }", text)


def typed(page, text, what="own"):
    """Another text, and wait until it is walked."""
    with rewalked(page, what):
        put(page, text)


def text_in(page):
    """What stands in the editor."""
    return page.evaluate("play.text.text")


def moving(page):
    """The frame in which the problem that is walked moves, and stands."""
    page.click("#tab-see")
    page.wait_for_selector("iframe[data-moved]:not(.stale)", timeout=90_000)
    frame = page.query_selector("iframe").content_frame()
    frame.evaluate("document.getElementById('motion').motion.pause()")
    return frame


def violations(place, part=""):
    """What axe finds wrong in a page or a frame, or in a part of it, which takes half as long: what
    is of the page alone, as its landmarks, is not asked then."""
    axe = (OWN / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")
    place.evaluate(f"{axe}; 0")
    found = place.evaluate(
        "(part) => axe.run(part || document, { resultTypes: ['violations'], iframes: false })"
        ".then((x) => x.violations)",
        part,
    )
    return [
        (x["id"], [y["html"][:120] + y["failureSummary"] for y in x["nodes"][:3]]) for x in found
    ]


def first_walk(asked, address):
    """The files of the playground among the addresses that a page asked for, but for those that
    are fetched behind its first walk."""
    own = {x.removeprefix(address).partition("#")[0] or "index.html" for x in asked}
    return {x for x in own if ":" not in x} - {*BEHIND}


def size(names):
    """Of files of the playground, in MB, each as gzip −9."""
    contents = {x: (built() / x).read_bytes() for x in names}
    packed = (y if x.endswith(".gz") else gzip.compress(y, 9) for x, y in contents.items())
    return sum(map(len, packed)) / 1e6
