"""Files that are chosen, or dropped on the page."""

import pytest

from tests.support.played import PENDULUM
from tests.support.playground_site import opened, text_in, visit, walked

DROP = """([name, text]) => {
    const data = new DataTransfer();
    data.items.add(new File([text], name));
    const told = { dataTransfer: data, bubbles: true, cancelable: true };
    document.querySelector("#editor .cm-content").dispatchEvent(new DragEvent("drop", told));
}"""


@pytest.fixture(scope="module")
def page(browser, site):
    with opened(browser) as page:
        visit(page, f"{site}?lang=en#so3")
        yield page


def test_a_problem_file_is_opened(page):
    with page.expect_file_chooser() as asked:
        page.click("#open")
    file = {"name": "mine.toml", "mimeType": "text/plain", "buffer": PENDULUM.encode()}
    asked.value.set_files(file)
    page.wait_for_function("(x) => play.text.text === x", arg=PENDULUM)
    walked(page, "own")


def test_a_problem_file_is_dropped(page):
    text = PENDULUM.replace("default = 2", "default = 3")
    page.evaluate(DROP, ["mine.TOML", text])
    page.wait_for_function("(x) => play.text.text === x", arg=text)
    walked(page, "own")


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("cow.stl", "solid", 'solid = "mesh", file = "cow.stl"'),
        ("run.npz", "", "derive plot run.npz"),
        ("so3.json", '{"problem": {}, "steps": []}', "derive check so3.json"),
        ("other.json", "{}", "ends in .toml"),
        ("notes.txt", "", "ends in .toml"),
    ],
)
def test_of_another_a_line_says_what_to_do(page, name, text, told):
    before = text_in(page)
    page.evaluate(DROP, [name, text])
    page.wait_for_function(
        "(x) => document.querySelector('#state').textContent.includes(x)", arg=told
    )
    assert text_in(page) == before
