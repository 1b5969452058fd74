"""What the quick run leaves out: each entry is a test that there is; other commands run a
share of it, and what is run is chosen by a seed, of each kind one."""

import json
import re
import subprocess
import sys
from functools import partial
from pathlib import Path
from unicodedata import normalize

import pytest

from tests.support import thorough
from tests.support.thorough import KEPT, counted, kinds, share, split
from tests.support.unmeasured import environment

TESTS = Path(__file__).parents[1]


def test_an_entry_is_a_test():
    for name in KEPT:
        file, test = name.split("::")
        text = normalize("NFKC", (TESTS / file).read_text(encoding="utf-8"))  # as Python names are
        assert re.search(rf"^def {test}\(", text, re.M), name


def test_what_takes_long_is_left_out_by_its_costs(monkeypatch):
    """One of ten cases for a second; none where one takes two, but for one by hand."""
    monkeypatch.setattr(thorough, "KEPT", {"x.py::known": 3})
    monkeypatch.setattr(thorough, "BY_HAND", {"x.py::by_hand"})
    costs = {f"tests/x.py::many[{k}]": 0.5 for k in range(10)} | {"tests/x.py::cheap": 0.9}
    costs |= {"tests/x.py::long": 2.0, "tests/x.py::by_hand": 2.0}
    assert counted(costs) == {"x.py::known": 3, "x.py::many": 2, "x.py::long": 0}


def items_of(name, cases):
    return [type("item", (), {"nodeid": f"tests/{name}[{x}]"}) for x in cases]


def ids(items):
    return [x.nodeid for x in items]


def test_a_seed_chooses_and_nothing_else_is_left():
    name, kept = max(KEPT.items(), key=lambda x: x[1])
    items = items_of(name, range(2 * kept)) + items_of("else.py::test_else", "ab")
    (run, left), again, other = split(items), split(items[::-1]), split(items, "other")
    assert len(run) == kept + 2
    assert sorted(ids(run + left)) == sorted(ids(items))
    assert ids(again[0]) == ids(run)[::-1]
    assert {*ids(other[0])} != {*ids(run)}
    assert {*ids(items[-2:])} < {*ids(run)} & {*ids(other[0])}


@pytest.mark.parametrize("seed", "12345")
def test_a_case_of_each_kind_is_run(seed):
    """However few are; and none where none is to be."""
    name = next(name for name, kept in KEPT.items() if kept == 1)
    cases = [f"so{k}-{x}-{y}" for k in range(9) for x in ("g++17", "rust2021", "julia", "c")
             for y in ("vern9", "{'step': 'gauss'}")]  # fmt: skip
    run, _ = split(items_of(name, cases), seed)
    assert {kind for x in run for kind in kinds(x)} == {
        "cpp",
        "rust",
        "julia",
        "c",
        "vern",
        "gauss",
    }
    assert len(run) < 7
    none = next(name for name, kept in KEPT.items() if kept == 0)
    assert split(items_of(none, cases), seed)[0] == []


def test_a_share_of_the_cases_is_of_every_test():
    names = ["a[0]", "b", "a[1]", "c[x]", "a[2]", "c[y]"]
    items = [type("item", (), {"nodeid": x}) for x in names]
    run, rest = map(ids, share(items, 2))
    assert run == ["a[0]", "b", "c[x]", "a[2]"]
    assert rest == ["a[1]", "c[y]"]
    assert [ids(share(items, n)[0]) for n in (0, 1, 4)] == [[], names, ["a[0]", "b", "c[x]"]]


def test_the_build_server_has_some_cases_of_every_test():
    makefile = (TESTS.parent / "Makefile").read_text(encoding="utf-8")
    rest = makefile[makefile.index("rest:") :]
    assert "--share=8" in rest[: rest.index("coverage:")]
    assert "make rest" in (TESTS.parent / ".ci/run").read_text(encoding="utf-8")


def test_what_passed_is_left_out(tmp_path):
    """By the file that another run wrote."""
    passed, name = tmp_path / "passed.json", "tests/project/test_thorough.py"
    own = f"{name}::{test_a_share_of_the_cases_is_of_every_test.__name__}"
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider"]
    run = partial(subprocess.run, cwd=TESTS.parent, env=environment(), capture_output=True)
    run([*command, "--passed", passed, own], check=True)
    assert json.loads(passed.read_text(encoding="utf-8")) == [own]
    assert (
        run([*command, "--without", passed, own]).returncode == pytest.ExitCode.NO_TESTS_COLLECTED
    )
