"""What installing derive brings, and what its developers have installed."""

import re
import tomllib
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement
from packaging.version import Version

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
LOCK = (ROOT / "requirements-dev.lock").read_text(encoding="utf-8")


def test_installing_it_brings_three_libraries():
    wanted = [Requirement(x) for x in metadata.requires("derive")]
    plain = sorted(x.name for x in wanted if x.marker is None)
    assert plain == ["jinja2", "numpy", "sympy"]
    assert all("extra ==" in str(x.marker) for x in wanted if x.marker)
    assert sorted(Requirement(x).name for x in PROJECT["dependencies"]) == plain


def test_what_they_bring_is_small():
    """SymPy has mpmath, Jinja2 has MarkupSafe, and that is all."""
    found, stack = set(), ["jinja2", "numpy", "sympy"]
    while stack:
        name = stack.pop()
        if name not in found:
            found.add(name)
            needed = [Requirement(x) for x in metadata.requires(name) or []]
            stack += [x.name.lower() for x in needed if x.marker is None or x.marker.evaluate()]
    assert found == {"jinja2", "numpy", "sympy", "mpmath", "markupsafe"}


def test_the_command_is_in_the_package():
    (command,) = [x for x in metadata.entry_points(group="console_scripts") if x.name == "derive"]
    assert callable(command.load())


def test_the_lock_holds_exact_versions_and_nothing_else():
    lines = LOCK.splitlines()
    assert lines[0].startswith("# make lock")
    assert all(re.fullmatch(r"[A-Za-z0-9._-]+==[0-9][A-Za-z0-9.]*", x) for x in lines[1:])
    assert lines[1:] == sorted(lines[1:], key=str.upper)


def test_the_lock_has_all_that_tests_need():
    locked = dict(x.lower().replace("_", "-").split("==") for x in LOCK.splitlines()[1:])
    wanted = [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["test"]]
    for each in map(Requirement, wanted):
        assert Version(locked[each.name.lower()]) in each.specifier, each
    assert "derive" not in locked
