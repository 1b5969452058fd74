"""The playground in Chromium, from this machine: how long until equations are read, the answer to a
key meanwhile, what is loaded, the memory of the page. Each round has a browser of its own.

python -m benchmarks.playground [rounds]
"""

from __future__ import annotations

import re
import statistics
import sys
from pathlib import Path
from typing import Any

from tests.support.needs import missing
from tests.support.playground_site import built, chromium, first_walk, served, size, walked

AIMS = {
    "first equation, s": 4.0,
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


def figures(address: str, browser: Any) -> dict[str, float]:
    """Those of one visit."""
    page, asked = browser.new_page(), set[str]()
    page.on("request", lambda x: asked.add(x.url))
    page.add_init_script(WATCH)
    page.goto(f"{address}#so3")
    walked(page)
    first = first_walk(asked, address)
    found = {"first equation, s": page.evaluate("begun") / 1000}
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
    print(f"{'':28}{'median':>8}{'most':>8}{'aim':>8}")
    for name, aim in AIMS.items():
        values = [x[name] for x in found]
        print(f"{name:28}{statistics.median(values):8.2f}{max(values):8.2f}{aim:8.1f}")


if __name__ == "__main__":
    main()
