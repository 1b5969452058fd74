"""Pages in which a body moves, made once for these sources; and their scripts."""

import json
import re

from derive.language.templating import folder
from derive.programs import program
from derive.views.page.moving_body import moving_body
from tests.support.cached import on_disk
from tests.support.walks import derived

FAST = {"start": {"zeta_3": 300.0}, "exp": (0.3, 0, 0)}
STARTS = {
    "top": FAST,
    "so3": {"start": {"zeta_1": 0.01, "zeta_2": 1.0}},
    "sl3": {"start": {"zeta_1": 1.0, "zeta_5": 0.5}},
    "hammer": {"start": {"zeta_1": 6.0, "zeta_3": 1.0, "w_3": 5.0}},
    "two_tops": {"start": {"zeta_1": 1.0, "zeta_5": 2.0}},
    "euler_poisson": {"start": {"zeta_1": 1.0, "gamma_1": 1.0, "gamma_2": 0.5}},
}
BAD = "</script><script>alert(1)</script><img src=x onerror=alert(1)>`${alert(1)}`"
HOSTILE = f"""
name = "hostile"
title = '{BAD}'
group = "SO(3)"
[parameters]
a = {{ default = 1.0, unit = '{BAD}', meaning = '{BAD}' }}
[[point]]
mass = "a"
at = [1, 0, 0]
[[point]]
mass = 2
at = [0, 1, 0]
"""
"""A problem of a stranger."""


@on_disk
def page(name, language="en"):
    """The page of a motion of 10 s, of a ready-made problem."""
    return derived(name).motion_page(10.0, language=language, **STARTS.get(name, {}))


def told(page):
    """The data of a page."""
    return json.loads(re.search(r'<script id="page" [^>]*>(.*?)</script>', page, re.DOTALL)[1])


def scripts(*names):
    """Of the drawing."""
    files = (folder("html") / "motion" / f"{x}.js" for x in names)
    return "".join(x.read_text(encoding="utf-8") for x in files)


def body_of(d, state=None):
    """What is drawn of a derivation, by the names of its state, those that its code has."""
    group = d.problem.group if d.problem.advected is None else None
    names = program(d.problem, d.record).state if state is None else state
    return moving_body(d.record.problem, group, names)


def adjuster(frame, name):
    """The row of a number, in an open group."""
    row = frame.locator(f'[data-name="{name}"].adjuster')
    row.evaluate(
        "(e) => { for (let x = e; x; x = x.parentElement) if ('open' in x) x.open = true; }"
    )
    return row


def set_to(frame, name, value, key="Tab"):
    """Type a number, and leave its box."""
    row = adjuster(frame, name)
    if row.locator("[role=slider]").is_visible():
        row.locator("[role=slider]").press("Enter")
    box = row.locator("input[inputmode]")
    box.fill(value)
    box.press(key)
    row.page.wait_for_timeout(100)
    return row
