"""What the quick run leaves out: each entry is a test that there is; coverage runs half of it."""

import re
from pathlib import Path

import pytest

from tests.support.thorough import KEPT, half, split

TESTS = Path(__file__).parents[1]


@pytest.mark.parametrize("name", KEPT)
def test_an_entry_is_a_test(name):
    file, test = name.split("::")
    assert re.search(rf"^def {test}\(", (TESTS / file).read_text(encoding="utf-8"), re.M)


def test_the_first_cases_are_kept():
    name, kept = max(KEPT.items(), key=lambda x: x[1])
    items = [type("item", (), {"nodeid": f"tests/{name}[{k}]"}) for k in range(kept + 3)]
    items.append(type("item", (), {"nodeid": "tests/else.py::test_else"}))
    run, left = split(items)
    assert [x.nodeid for x in left] == [f"tests/{name}[{k}]" for k in range(kept, kept + 3)]
    assert len(run) == kept + 1


def test_half_of_the_cases_are_of_every_test():
    names = ["a[0]", "b", "a[1]", "c[x]", "a[2]", "c[y]"]
    run, rest = half([type("item", (), {"nodeid": x}) for x in names])
    assert [x.nodeid for x in run] == ["a[0]", "b", "c[x]", "a[2]"]
    assert [x.nodeid for x in rest] == ["a[1]", "c[y]"]


def test_the_build_server_has_some_cases_of_every_test():
    makefile = (TESTS.parent / "Makefile").read_text(encoding="utf-8")
    coverage = makefile[makefile.index("coverage:") :]
    assert "--half" in coverage[: coverage.index("thorough:")]
    assert "make coverage" in (TESTS.parent / ".ci/run").read_text(encoding="utf-8")
