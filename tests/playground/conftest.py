"""The site and pages of it."""

import pytest

from tests.support.needs import need
from tests.support.playground_site import built, chromium, served, walked


@pytest.fixture(scope="module")
def browser():
    need("node", "npm", "the module playwright", "chromium")
    with chromium() as running:
        yield running


@pytest.fixture(scope="module")
def site(browser):
    with served(built().parent) as (address, _):
        yield f"{address}play/"


@pytest.fixture(scope="module")
def page(browser, site):
    """One page for all that only asks the worker."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, locale="en-GB")
    opened = context.new_page()
    opened.goto(f"{site}#so3")
    walked(opened)
    yield opened
    context.close()


@pytest.fixture
def fresh(browser, site):
    """A page of its own, with what it asked for and what it complained of."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, locale="en-GB")
    opened = context.new_page()
    opened.asked, opened.told = [], []
    context.on("request", lambda x: opened.asked.append(x.url))
    opened.on("console", lambda x: opened.told.append(x.text) if x.type == "error" else None)
    opened.on("pageerror", lambda x: opened.told.append(str(x)))
    yield opened
    context.close()
