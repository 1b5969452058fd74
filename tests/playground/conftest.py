"""The site and pages of it, in one browser."""

import pytest

from playground.site import built
from tests.support.needs import need
from tests.support.playground_site import DESK, another, chromium, opened, served, visit


@pytest.fixture(scope="package")
def browser():
    need("node", "npm", "the module playwright", "chromium")
    with chromium() as running:
        yield running


@pytest.fixture(scope="package")
def site(browser):
    with served(built().parent) as (address, _):
        yield f"{address}play/"


@pytest.fixture(scope="package")
def reader(browser):
    """Whose browser keeps the files of the site, and what it made of them: Python is compiled for
    the first page alone."""
    return browser.new_context(**DESK)


@pytest.fixture(scope="module")
def page(reader, site):
    """One page for all whose first act is a text of its own."""
    with another(reader) as page:
        visit(page, f"{site}#so3")
        yield page


@pytest.fixture
def fresh(reader):
    """A page of its own, which remembers nothing that was chosen in another."""
    with another(reader) as page:
        yield page
        if page.url != "about:blank":
            page.evaluate("localStorage.clear()")
    reader.clear_permissions()


@pytest.fixture
def newcomer(browser):
    """The page of a reader who was never here."""
    with opened(browser) as page:
        yield page
