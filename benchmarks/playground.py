"""The playground in Chromium, from this machine: how long until equations are read, the answer to a
key meanwhile, what is loaded, the memory of the page. Each round has a browser of its own.

python -m benchmarks.playground [rounds]
"""

from __future__ import annotations

import base64
import re
import statistics
import sys
import time
import zlib
from pathlib import Path
from typing import Any

from tests.support.needs import missing
from tests.support.played import text_of
from tests.support.playground_site import built, chromium, first_walk, served, size, walked

AIMS = {
    "a body moves, s": 1.5,
    "loaded until it moves, MB gzip": 0.3,
    "first equation of a problem of one's own, s": 4.0,
    "walk so3 again, s": 0.6,
    "check so3, s": 6.0,
    "a key while it checks, ms": 100.0,
    "loaded, MB gzip": 7.5,
    "memory of the page, MB": 300.0,
}
WATCH = """addEventListener("DOMContentLoaded", () => {
    const look = () => {
        const root = document.getElementById("walk").shadowRoot;
        if (root?.querySelector(".equation")) window.begun = performance.now();
        else requestAnimationFrame(look);
    };
    look();
})"""
AGAIN = """async () => {
    const begin = performance.now();
    await play.engine.ask({ ask: "walk", text: `${play.text.text}\\n`, lang: "en" }, () => {});
    return performance.now() - begin;
}"""
CHECK = """async () => {
    const begin = performance.now();
    await play.engine.ask({ ask: "check", text: play.text.text }, () => {});
    return performance.now() - begin;
}"""
KEYS = """() => {
    window.slowest = 0;
    new PerformanceObserver((list) => {
        for (const x of list.getEntries()) window.slowest = Math.max(window.slowest, x.duration);
    }).observe({ type: "event", durationThreshold: 16 });
    play.text.focus();
    play.engine.ask({ ask: "check", text: play.text.text }, () => {});
}"""


def memory() -> float:
    """The memory, in MB, of the page of a running browser: its share of what it shares counted."""
    found = [0]
    for status in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if b"--type=renderer" in status.read_bytes():
                told = status.with_name("smaps_rollup").read_text(encoding="ascii")
                found.append(int(re.search(r"^Pss:\s+(\d+) kB", told, re.M)[1]))  # type: ignore[index]
        except OSError:  # it has ended
            continue
    return max(found) / 1000


def packed(text: str) -> str:
    """A text as an address has it: compressed, without a header, in base 64."""
    deflate = zlib.compressobj(9, wbits=-15)
    made = deflate.compress(text.encode()) + deflate.flush()
    return base64.urlsafe_b64encode(made).decode().rstrip("=")


def figures(address: str, browser: Any) -> dict[str, float]:
    """Those of one visit."""
    page, asked = browser.new_page(), set[str]()
    page.on("request", lambda x: asked.add(x.url))
    page.add_init_script(WATCH)
    begin = time.perf_counter()
    page.goto(address)
    page.wait_for_selector("iframe[data-moved]")
    found = {"a body moves, s": time.perf_counter() - begin}
    own = {x.removeprefix(address).partition("#")[0] or "index.html" for x in asked}
    found["loaded until it moves, MB gzip"] = size({x for x in own if ":" not in x} - {"keep.js"})
    page.close()
    page = browser.new_page()
    page.add_init_script(WATCH)
    asked.clear()
    page.on("request", lambda x: asked.add(x.url))
    page.goto(f"{address}#p={packed(text_of('so3') + chr(10))}&tab=walk")
    walked(page, "own")
    first = first_walk(asked, address)
    found["first equation of a problem of one's own, s"] = page.evaluate("begun") / 1000
    found["check so3, s"] = page.evaluate(CHECK) / 1000
    found["memory of the page, MB"] = memory()
    found["walk so3 again, s"] = min(page.evaluate(AGAIN) for _ in range(3)) / 1000
    page.evaluate(KEYS)
    for _ in range(25):
        page.keyboard.press("a")
        page.wait_for_timeout(60)
    found["a key while it checks, ms"] = page.evaluate("slowest")
    return found | {"loaded, MB gzip": size(first)}


def main() -> None:
    """Print the table."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    if absent := missing(["node", "npm", "the module playwright", "chromium"]):
        print(f"the playground is left out, which needs {', '.join(absent)}")
        return
    with served(built().parent) as (address, _):
        found = []
        for _ in range(rounds):
            with chromium() as browser:
                found.append(figures(f"{address}play/", browser))
    print(f"{'':44}{'median':>8}{'most':>8}{'aim':>8}")
    for name, aim in AIMS.items():
        values = [x[name] for x in found]
        print(f"{name:44}{statistics.median(values):8.2f}{max(values):8.2f}{aim:8.1f}")


if __name__ == "__main__":
    main()
