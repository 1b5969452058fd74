"""derive as it is shipped: the same wheel, the same output everywhere, from old and new libraries.

These take minutes and a package index: `make dist`.
"""

import fcntl
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tests.support.cached import read, write
from tests.support.needs import CC, need, needs
from tests.support.pages import PAGES, Reader, blocks

pytestmark = pytest.mark.dist
ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
BOUNDS = dict(x.split(">=") for x in PROJECT["dependencies"])
OLDEST = [f"{name}=={version}" for name, version in BOUNDS.items()]
NEWEST_PYTHON = 20
JULIA = ("tree-sitter", "tree-sitter-julia")
"""What reads Julia, where it is not installed: the library of emitted files has it."""
FLINT = "python-flint"
QUIET = ("-m", "pip", "--quiet", "--disable-pip-version-check")


def outside():
    """The environment of a process that finds nothing of this project but what is installed."""
    return {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL_ENV"))}


def run(*command, cwd, expected=0, **environment):
    """The output of a command, in which nothing of this project is to be found but installed."""
    here = outside() | {key: str(value) for key, value in environment.items()}
    done = subprocess.run(
        [*map(str, command)], cwd=cwd, env=here, stdout=-1, stderr=-2, encoding="utf-8"
    )
    assert done.returncode == expected, done.stdout[-3000:]
    return done.stdout


def digest(folder):
    return {
        str(x.relative_to(folder)): hashlib.sha256(x.read_bytes()).hexdigest()
        for x in sorted(folder.rglob("*"))
        if x.is_file()
    }


@pytest.fixture(scope="module")
def once(tmp_path_factory):
    """A function (name, make) → what make returns of a new folder, for all processes of xdist: the
    first that asks makes it, others wait."""
    place = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        place = place.parent

    def get(name, make):
        with (place / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            kept, folder = place / f"{name}.made", place / name
            if not kept.exists():
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                write(kept, make(folder))
            return read(kept)

    return get


def two_wheels(folder):
    """Of two copies of the tree: other folders, time zones and masks."""
    made = []
    for i, (zone, mask) in enumerate([("UTC", 0o022), ("Pacific/Kiritimati", 0o027)]):
        place = folder / f"tree{i}" / ("x" * (5 * i + 1))
        left_out = shutil.ignore_patterns(".*", "__pycache__", "build", "dist", "notes.*")
        shutil.copytree(ROOT, place, ignore=left_out, copy_function=shutil.copy)
        kept, out = os.umask(mask), place.parent / "wheel"
        try:
            options = {"SOURCE_DATE_EPOCH": 1700000000, "TZ": zone}
            run(sys.executable, *QUIET, "wheel", "--no-deps", "-w", out, ".", cwd=place, **options)
        finally:
            os.umask(kept)
        made += out.iterdir()
    return made


@pytest.fixture(scope="module")
def wheels(once):
    """Two wheels."""
    return once("wheels", two_wheels)


@pytest.fixture(scope="module")
def installed(wheels, once):
    """A function (python, packages) → the Python of an environment with them and the wheel; what is
    imported of them is compiled then, not all of it now."""

    def get(python, *packages):
        def make(folder):
            run(python, "-m", "venv", folder, cwd=folder)
            python_there = folder / "bin" / "python"
            run(python_there, *QUIET, "install", "--no-compile", wheels[0], *packages, cwd=folder)
            return python_there

        name = re.sub(r"[^\w.]+", "-", "-".join(("environment", python, *packages)))
        return once(name[-200:], make)

    return get


@pytest.fixture(scope="module")
def with_flint(installed):
    """The Python of an environment with python-flint, and behind all that it has, for the pages,
    the packages of the tests: but derive, of which there is the wheel alone."""
    python = installed(sys.executable, FLINT)
    (packages,) = python.parents[1].glob("lib/*/site-packages")
    others = [x for x in sys.path if Path(x).name == "site-packages"]
    (packages / "beside.pth").write_text("\n".join(others), encoding="utf-8")
    return python


def test_two_wheels_are_the_same_bytes(wheels):
    first, second = wheels
    assert first.name == second.name == f"derive_mechanics-{version()}-py3-none-any.whl"
    assert first.read_bytes() == second.read_bytes()


def version():
    return re.search(
        r'"(.*)"', (ROOT / "derive" / "__init__.py").read_text().split("__version__")[1]
    )[1]


# ---------------------------------------------------------------- the same output everywhere


def everything(python, folder, *further, cwd=ROOT, shifted=(), **environment):
    """What tests/support/everything.py writes: where derive was, and the digests."""
    script = shutil.copy(ROOT / "tests" / "support" / "everything.py", folder)
    told = run(*shifted, python, script, folder / "out", *further, cwd=cwd, **environment)
    return told.splitlines()[-1], digest(folder / "out")


@pytest.fixture(scope="module")
def base(once):
    """The digests of everything, by this Python and from this tree."""
    need("pdflatex")
    options = {"PYTHONPATH": ROOT, "PYTHONHASHSEED": 0, "LC_ALL": "C.UTF-8", "TZ": "UTC"}
    where, found = once(
        "base", lambda folder: everything(sys.executable, folder, "pdf", "checked", **options)
    )
    assert where == str(ROOT / "derive")
    assert len(found) > 100
    return found


def without(found, *names):
    """Those of the files whose names have none of these in them."""
    return {file: x for file, x in found.items() if not any(name in file for name in names)}


def newest_python():
    """The newest Python to be had here, apart from this one."""
    places = [*os.environ["PATH"].split(os.pathsep), "/usr/local/bin", "/usr/bin"]
    places += Path.home().glob(".pyenv/versions/3.*/bin")
    places += Path.home().glob(".local/share/uv/python/cpython-3.*/bin")
    for minor in range(NEWEST_PYTHON, sys.version_info.minor, -1):
        for place in places:
            python = Path(place) / f"python3.{minor}"
            command = [python, "-c", "import venv, ensurepip"]
            if python.is_file() and not subprocess.run(command, stderr=-3).returncode:
                return str(python)
    pytest.skip(f"there is no Python newer than 3.{sys.version_info.minor}")
    return ""


def test_another_folder_locale_zone_and_seed(base, tmp_path):
    """A locale of ASCII, so that every file must say that it is UTF-8."""
    options = {"PYTHONPATH": ROOT, "PYTHONHASHSEED": 1, "LC_ALL": "C", "LANG": "C"}
    options |= {"PYTHONUTF8": 0, "TZ": "Pacific/Kiritimati", "SOURCE_DATE_EPOCH": 0}
    found = everything(sys.executable, tmp_path, "pdf", "checked", cwd=tmp_path, **options)
    assert found[1] == base


@needs("faketime", "the locale fr_FR")
def test_french_and_years_later(base, tmp_path):
    """But for notes as a PDF: latexmk believes no clock that is so far from that of its files."""
    clock = ["faketime", "2037-12-31 23:59:50"]
    options = {"PYTHONPATH": ROOT, "PYTHONHASHSEED": 2, "PYTHONUTF8": 0}
    options |= {"LC_ALL": "fr_FR.UTF-8", "LANG": "fr_FR.UTF-8", "TZ": "America/St_Johns"}
    found = everything(sys.executable, tmp_path, shifted=clock, **options)
    assert found[1] == without(base, "notes.pdf", "checked")


# the same TeX is set alike, which is seen above: elsewhere no PDF is made


def test_from_a_wheel_with_flint(base, with_flint, tmp_path):
    where, found = everything(with_flint, tmp_path, "checked", cwd=tmp_path, PYTHONHASHSEED=3)
    assert str(ROOT) not in where
    assert found == without(base, "notes.pdf")


def test_from_a_wheel_on_the_newest_python(base, installed, tmp_path):
    python = installed(newest_python())
    where, found = everything(python, tmp_path, "checked", cwd=tmp_path, PYTHONHASHSEED=4)
    assert str(ROOT) not in where
    assert found == without(base, "notes.pdf")


def test_on_the_oldest_libraries(base, installed, tmp_path):
    """The same, and what a quick run has of what NumPy and SymPy are for, checks among it."""
    python = installed(sys.executable, *OLDEST, "scipy", "pytest", "array-api-strict", *JULIA)
    frozen = run(python, *QUIET, "freeze", cwd=tmp_path).lower()
    for name, oldest in BOUNDS.items():
        assert re.search(rf"^{name}=={re.escape(oldest)}(\.0)*$", frozen, flags=re.M)
    found = everything(python, tmp_path, cwd=tmp_path, PYTHONHASHSEED=5)[1]
    assert found == without(base, "notes.pdf", "checked")
    tests = ("emitted", "as_sympy", "arrays", "compiled", "api", "frame")
    files = [next(ROOT.glob(f"tests/*/test_{x}.py")) for x in tests]
    run(python, "-m", "pytest", "--quick", "-p", "no:cacheprovider", *files, cwd=ROOT)


# ---------------------------------------------------------------- as the pages say


COMMANDS = """
import contextlib, io, json, os, sys
from derive.command.cli import main
asked, answers = os.fdopen(os.dup(0)), os.fdopen(os.dup(1), "w")
os.dup2(os.open(os.devnull, os.O_RDONLY), 0)  # what a compiler reads and prints is no answer
os.dup2(2, 1)
for line in asked:
    folder, words = json.loads(line)
    os.chdir(folder)
    told = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(told[0]), contextlib.redirect_stderr(told[1]):
        code = main(words)
    print(json.dumps([code, *(x.getvalue() for x in told)]), file=answers, flush=True)
"""


@pytest.fixture(scope="module")
def commands(with_flint, tmp_path_factory):
    """A function (folder, words) → the exit code of a command of the wheel, and what it prints: all
    of them in one process, which is not started, and has not imported SymPy, hundreds of times."""
    told = (tmp_path_factory.mktemp("commands") / "stderr").open("w+")
    path = f"{with_flint.parent}{os.pathsep}{os.environ['PATH']}"
    process = subprocess.Popen(
        [with_flint, "-c", COMMANDS],
        cwd=with_flint.parent,
        env=outside() | {"PATH": path, "CC": CC},
        **{"stdin": -1, "stdout": -1, "stderr": told, "encoding": "utf-8"},
    )

    def get(folder, words):
        process.stdin.write(json.dumps([str(folder), words]) + "\n")
        process.stdin.flush()
        answer = process.stdout.readline()
        assert answer, told.seek(0) or told.read()[-3000:]
        return json.loads(answer)

    with process:
        yield get
        process.stdin.close()


BY_PROCESSES = ("README.md", "docs/build.md")
"""Pages whose commands are typed, so that the program of that name is seen."""


@pytest.mark.parametrize("page", [x for x in PAGES if blocks(x)])
def test_a_page_where_only_the_wheel_is(page, with_flint, commands, tmp_path):
    """Its commands and programs, in an empty folder."""

    def typed(words, expected):
        code, *told = commands(tmp_path, words)
        assert code == expected, (words, *told)
        return told

    reader = Reader(tmp_path, str(with_flint), derive=None if page in BY_PROCESSES else typed)
    reader.read(page)
    if page == "docs/build.md" and "cmake" not in reader.absent:
        cache = (tmp_path / "cmake-build" / "CMakeCache.txt").read_text(encoding="utf-8")
        assert f"derive_DIR:PATH={with_flint.parents[1]}" in cache
    need(*sorted(reader.absent))
