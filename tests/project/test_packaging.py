"""What installing derive brings, under which name, what it can do, and what its developers have
installed."""

import re
import subprocess
import tomllib
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.version import Version

from tests.support.capabilities import LISTED, listed
from tests.support.needs import needs

ROOT = Path(__file__).parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
LOCK = (ROOT / "requirements-dev.lock").read_text(encoding="utf-8")
TEXTS = [ROOT / x for x in ("README.md", "SECURITY.md", "CHANGELOG.md", "pyproject.toml")]
TEXTS += [*ROOT.glob("docs/**/*.md"), *(x for x in ROOT.glob("examples/*") if x.is_file())]
TEXTS += [x for room in ("derive", "cmake", "templates") for x in ROOT.glob(f"{room}/**/*.*")]


def test_installing_it_brings_three_libraries():
    wanted = [Requirement(x) for x in metadata.requires(PROJECT["name"])]
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


@needs("git")
@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="this is no checkout of git")
def test_nothing_lies_about():
    """At the top are these files alone, and no other is a program or large."""
    known = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True)
    files = [ROOT / x for x in known.stdout.decode().split("\0") if x]
    assert {x.name for x in files if x.parent == ROOT} == {
        *(".gitignore", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "Makefile", "README.md"),
        *("SECURITY.md", "pyproject.toml", "requirements-dev.lock"),
    }
    for path in files:
        assert path.stat().st_size < 10**6, path
        with path.open("rb") as file:
            assert file.read(4) != b"\x7fELF", path


def test_what_one_is_told_to_install_is_this():
    """On the package index `derive` is a program of others, which would replace this one."""
    assert PROJECT["name"] == "derive-mechanics"
    told = []
    for path in TEXTS:
        if path.suffix != ".pyc":
            text = path.read_text(encoding="utf-8")
            found = re.findall(r"pip install (?:-\S+ )*['\"]?([\w.-]+)(?:\[(\w+)\])?", text)
            told += [(path.name, *words) for words in found]
    for place, name, extra in told:
        assert name.lower() != "derive", place
        if extra:
            assert name in (".", PROJECT["name"]), place
            assert extra in PROJECT["optional-dependencies"], place
    libraries = {name for place, name, extra in told if place.endswith(".py") and name != "."}
    extras = PROJECT["optional-dependencies"].values()
    assert {"trimesh", "matplotlib", "pyarrow"} <= libraries
    assert libraries <= {Requirement(x).name for extra in extras for x in extra}


# ---------------------------------------------------------------- requirements-dev.lock

LOCKED = re.findall(r"^([\w.-]+)==(\S+)(?: ; .*?)? \\\n((?:    --hash=.*\n)+)", LOCK, flags=re.M)


def test_the_lock_holds_exact_versions_and_hashes_and_nothing_else():
    assert LOCK.splitlines()[1] == "#    make lock; to have these versions: make test LOCKED=1"
    assert "".join(LOCK.splitlines(keepends=True)[2:]) == "".join(
        x[0] for x in re.finditer(r"^[\w.-]+==\S+(?: ; .*?)? \\\n(?:    --hash=.*\n)+", LOCK, re.M)
    )
    for name, version, hashes in LOCKED:
        assert str(Version(version)) == version, name
        for line in hashes.splitlines():
            assert re.fullmatch(r"    --hash=sha256:[0-9a-f]{64}(?: \\)?", line), name


def test_the_lock_has_all_that_tests_need():
    """For every version of Python that there may be, and what builds the package as well."""
    extras = PROJECT["optional-dependencies"]
    own, *others = extras["ci"]
    assert own == f"{PROJECT['name']}[test]"
    wanted = [*PROJECT["dependencies"], *extras["test"], *others]
    wanted += [*PYPROJECT["build-system"]["requires"], "editables"]
    for each in map(Requirement, wanted):
        name = each.name.lower().replace("_", "-")
        versions = [Version(version) for found, version, _ in LOCKED if found == name]
        assert versions, each
        assert all(version in each.specifier for version in versions), each
    assert PROJECT["name"] not in {name for name, *_ in LOCKED}


@needs("make")
def test_the_locked_environment_takes_nothing_without_a_hash():
    command = ["make", "-n", "VENV=build/none", "test", "LOCKED=1"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    first, second = [x for x in done.stdout.splitlines() if " pip install " in x]
    assert "--require-hashes --requirement requirements-dev.lock" in first
    assert "--no-deps --no-build-isolation --editable ." in second


def test_what_the_program_can_do_is_what_is_listed():
    before = LISTED.read_text(encoding="utf-8").splitlines()
    now = listed()
    assert not {*before} - {*now}, "lost; where that is meant: python -m tests.support.capabilities"
    assert not {*now} - {*before}, "new: python -m tests.support.capabilities"
