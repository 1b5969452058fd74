"""derive as it is shipped: the same wheel, the same output everywhere, from old and new libraries.

These take minutes and a package index: `make dist`.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tests.support.needs import need, needs
from tests.support.pages import PAGES, Reader, blocks

pytestmark = pytest.mark.dist
ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
BOUNDS = dict(x.split(">=") for x in PROJECT["dependencies"])
OLDEST = [f"{name}=={version}" for name, version in BOUNDS.items()]
NEWEST_PYTHON = 20
JULIA = ("tree-sitter", "tree-sitter-julia")
"""What reads Julia, where it is not installed: the library of emitted files has it."""
BESIDE = ("python-flint", "scipy", "matplotlib", "jax", "distributed", "casadi", "fmpy")
QUIET = ("-m", "pip", "--quiet", "--disable-pip-version-check")


def run(*command, cwd, expected=0, **environment):
    """The output of a command, in which nothing of this project is to be found but installed."""
    here = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL_ENV"))}
    here |= {key: str(value) for key, value in environment.items()}
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
def wheels(tmp_path_factory):
    """Two wheels, of two copies of the tree: other folders, time zones and masks."""
    made = []
    for i, (zone, mask) in enumerate([("UTC", 0o022), ("Pacific/Kiritimati", 0o027)]):
        place = tmp_path_factory.mktemp(f"tree{i}") / ("x" * (5 * i + 1))
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
def installed(wheels, tmp_path_factory):
    """A function (python, packages) → the Python of an environment with them and the wheel."""
    kept = {}

    def get(python, *packages):
        if (python, packages) not in kept:
            folder = tmp_path_factory.mktemp("environment")
            run(python, "-m", "venv", folder, cwd=folder)
            python_there = folder / "bin" / "python"
            run(python_there, *QUIET, "install", wheels[0], *packages, cwd=folder)
            kept[python, packages] = python_there
        return kept[python, packages]

    return get


def test_two_wheels_are_the_same_bytes(wheels):
    first, second = wheels
    assert first.name == second.name == f"derive_mechanics-{version()}-py3-none-any.whl"
    assert first.read_bytes() == second.read_bytes()


def version():
    return re.search(
        r'"(.*)"', (ROOT / "derive" / "__init__.py").read_text().split("__version__")[1]
    )[1]


# ---------------------------------------------------------------- the same output everywhere


def everything(python, folder, cwd=ROOT, shifted=(), pdf="pdf", **environment):
    """What tests/support/everything.py writes: where derive was, and the digests."""
    script = shutil.copy(ROOT / "tests" / "support" / "everything.py", folder)
    told = run(*shifted, python, script, folder / "out", pdf, cwd=cwd, **environment)
    return told.splitlines()[-1], digest(folder / "out")


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    need("pdflatex")
    options = {"PYTHONPATH": ROOT, "PYTHONHASHSEED": 0, "LC_ALL": "C.UTF-8", "TZ": "UTC"}
    where, found = everything(sys.executable, tmp_path_factory.mktemp("base"), **options)
    assert where == str(ROOT / "derive")
    assert len(found) > 100
    return found


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
    assert everything(sys.executable, tmp_path, tmp_path, **options)[1] == base


@needs("faketime", "the locale fr_FR")
def test_french_and_years_later(base, tmp_path):
    clock = ["faketime", "2037-12-31 23:59:50"]
    options = {"PYTHONPATH": ROOT, "PYTHONHASHSEED": 2, "PYTHONUTF8": 0}
    options |= {"LC_ALL": "fr_FR.UTF-8", "LANG": "fr_FR.UTF-8", "TZ": "America/St_Johns"}
    # latexmk believes no clock that is so far from that of its files
    found = everything(sys.executable, tmp_path, ROOT, clock, "no pdf", **options)[1]
    assert found == {name: x for name, x in base.items() if "notes.pdf" not in name}


def test_from_a_wheel_with_flint(base, installed, tmp_path):
    python = installed(sys.executable, *BESIDE)
    where, found = everything(python, tmp_path, tmp_path, PYTHONHASHSEED=3)
    assert str(ROOT) not in where
    assert found == base


def test_from_a_wheel_on_the_newest_python(base, installed, tmp_path):
    where, found = everything(installed(newest_python()), tmp_path, tmp_path, PYTHONHASHSEED=4)
    assert str(ROOT) not in where
    assert found == base


def test_on_the_oldest_libraries(base, installed, tmp_path):
    python = installed(sys.executable, *OLDEST, "scipy", "pytest", "array-api-strict", *JULIA)
    frozen = run(python, *QUIET, "freeze", cwd=tmp_path).lower()
    for name, oldest in BOUNDS.items():
        assert re.search(rf"^{name}=={re.escape(oldest)}(\.0)*$", frozen, flags=re.M)
    assert everything(python, tmp_path, tmp_path, PYTHONHASHSEED=5)[1] == base
    tests = ("emitted", "as_sympy", "arrays", "compiled", "api", "frame")
    files = [next(ROOT.glob(f"tests/*/test_{x}.py")) for x in tests]
    run(python, "-m", "pytest", "--quick", "-p", "no:cacheprovider", *files, cwd=ROOT)


# ---------------------------------------------------------------- as the pages say


@pytest.mark.parametrize("page", [x for x in PAGES if blocks(x)])
def test_a_page_where_only_the_wheel_is(page, installed, tmp_path):
    """Its commands and programs, in an empty folder."""
    python = installed(sys.executable, *BESIDE)
    reader = Reader(tmp_path, str(python))
    reader.read(page)
    if page == "docs/build.md" and "cmake" not in reader.absent:
        cache = (tmp_path / "cmake-build" / "CMakeCache.txt").read_text(encoding="utf-8")
        assert f"derive_DIR:PATH={python.parents[1]}" in cache
    need(*sorted(reader.absent))
