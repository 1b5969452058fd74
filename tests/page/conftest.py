"""Pages, and the browser that they are opened in."""

import tomllib

import pytest

import derive
from derive.problem.toml import problem_of
from tests.support.motion_pages import HOSTILE
from tests.support.needs import need
from tests.support.playground_site import chromium


@pytest.fixture
def hostile():
    """The page of a problem of a stranger."""
    d = derive.derive(problem_of(tomllib.loads(HOSTILE)))
    return d.motion_page(1.0, start={"zeta_1": 1.0})


@pytest.fixture(scope="module")
def browser():
    need("the module playwright", "chromium")
    with chromium() as running:
        yield running


@pytest.fixture
def opened(browser, tmp_path):
    """A page in the browser; at the end nothing was said on its console, and nothing asked for."""
    said = []

    def open_page(text, width=1280, **how):
        file = tmp_path / "page.html"
        file.write_text(text, encoding="utf-8")
        how.setdefault("reduced_motion", "reduce")
        shown = browser.new_page(viewport={"width": width, "height": 844}, **how)
        shown.on("console", lambda message: said.append(message.text))
        shown.on("pageerror", lambda error: said.append(str(error)))
        shown.on("request", lambda x: x.url.startswith("file:") or said.append(x.url))
        shown.goto(file.as_uri())
        return shown

    yield open_page
    assert not said
