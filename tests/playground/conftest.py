"""The site and pages of it."""

import pytest

from playground.site import built
from tests.support.needs import need
from tests.support.playground_site import chromium, opened, served, visit


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
    """One page for all whose first act is a text of its own."""
    with opened(browser) as page:
        visit(page, f"{site}#so3")
        yield page


@pytest.fixture
def fresh(browser):
    """A page of its own."""
    with opened(browser) as page:
        yield page
