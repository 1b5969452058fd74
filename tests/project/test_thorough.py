"""What the quick run leaves out: each entry is a test that there is; coverage runs all."""

import re
from pathlib import Path

import pytest

from tests.support.thorough import KEPT, split

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


def test_the_build_server_leaves_nothing_out():
    makefile = (TESTS.parent / "Makefile").read_text(encoding="utf-8")
    coverage = makefile[makefile.index("coverage:") :]
    assert "--thorough" in coverage[: coverage.index("mutants:")]
    assert "make coverage" in (TESTS.parent / ".ci/run").read_text(encoding="utf-8")
