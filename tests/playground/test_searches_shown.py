"""What is searched of the equations, in a tab of the playground: as the commands say it; in another
the lecture."""

import re

import pytest

from derive.command.cli import main
from tests.support.playground_site import another, violations, visit

PLACE = "document.querySelector('#find > div:last-child').shadowRoot"
STEPS = f"[...{PLACE}.querySelectorAll('article')].map((x) => x.id)"


def steps_found(page, what):
    """The steps of a search, when they stand there."""
    page.click(f"[data-search={what}]")
    page.wait_for_selector("#find article, #find .fault", state="attached", timeout=60_000)
    return page.evaluate(STEPS)


def by_the_command(capsys, *words):
    assert main([*words, "--format", "html", "--fragment"]) == 0
    return re.findall(r'<article id="([^"]+)"', capsys.readouterr().out)


@pytest.fixture(scope="module")
def found(reader, site):
    with another(reader) as page:
        visit(page, f"{site}?lang=en#euler_top&tab=find", "euler_top")
        yield page


@pytest.mark.parametrize("what", ["symmetries", "integrals", "equilibria", "letters", "reduction"])
def test_a_search_is_that_of_its_command(found, what, capsys):
    """Equilibria in numbers, too, without NumPy."""
    command, *options = ["equilibria", "--letters"] if what == "letters" else [what]
    wanted = by_the_command(capsys, command, "euler_top", *options)
    assert steps_found(found, what) == wanted != []
    assert found.inner_text("#find code").split() == ["derive", command, "euler_top", *options]


def test_a_link_goes_to_a_step_there(found):
    first, *_, last = steps_found(found, "equilibria")
    found.click(f"#find article[id='{last}'] h3 a")
    assert found.evaluate(f"{PLACE}.querySelector('.aimed').id") == last != first


def test_nothing_is_wrong_for_screen_readers(found):
    steps_found(found, "symmetries")
    assert violations(found) == []


def test_what_is_refused_is_one_line_and_in_the_other_language(fresh, site):
    visit(fresh, f"{site}?lang=fr#jelly&tab=find", "jelly")
    assert fresh.inner_text("[data-search=equilibria]") == "Équilibres"
    assert steps_found(fresh, "integrals") == []
    assert fresh.evaluate(f"{PLACE}.querySelector('.fault').textContent").startswith("derive: ")


def test_the_lecture_is_fetched_in_the_language_when_it_is_seen(fresh, site):
    visit(fresh, f"{site}?lang=fr#top&tab=walk", "top")
    assert not [x for x in fresh.asked if "lecture" in x]
    fresh.click("#tab-lecture")
    heading = fresh.frame_locator("#lecture iframe").locator("h1")
    assert heading.inner_text().startswith("D’où viennent")
    assert "derive lecture top --out top.html --lang fr" in fresh.inner_text("#lecture p")
    assert violations(fresh, "#lecture") == []
    fresh.click("[data-lang=en]")
    fresh.wait_for_selector("iframe[src='lecture.en.html']")
    assert "tab=lecture" in fresh.url
