"""The projects of tests/consumers, built and run as a user would, each in a copy of its own.

derive is a copy as well, so that it can be changed: the builds must notice, and only then work.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import derive
from tests.support.needs import CC, needs

ROOT = Path(__file__).parents[2]
CONSUMERS = ROOT / "tests" / "consumers"
METADATA = "derive_mechanics-{}.dist-info"


class Project:
    """A consumer in a folder of its own, and the derive that it uses."""

    def __init__(self, name, folder):
        self.folder, self.generator = folder / "a project", folder / "generator"
        shutil.copytree(CONSUMERS / name, self.folder)
        package = Path(derive.__file__).parent
        shutil.copytree(package, self.generator / "derive")
        if not (package / "templates").is_dir():
            shutil.copytree(package.parent / "templates", self.generator / "templates")
        (self.generator / METADATA.format(1)).mkdir()
        (self.generator / METADATA.format(1) / "METADATA").touch()
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        self.environment = os.environ | {"PATH": path, "PYTHONPATH": str(self.generator)}
        self.environment["CC"] = CC
        # Meson runs scripts where temporary files lie: a module there would stand for Python's own.
        self.environment["TMPDIR"] = str(folder / "temporary")
        Path(self.environment["TMPDIR"]).mkdir()
        for name in ("DESTDIR", "MAKEFLAGS", "MAKELEVEL", "CFLAGS", "PREFIX"):
            self.environment.pop(name, None)

    def run(self, *command, expected=0, **more):
        """The output of a command in the folder of the project."""
        environment = self.environment | {key: str(value) for key, value in more.items()}
        done = subprocess.run(
            [str(word) for word in command],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        assert done.returncode == expected, done.stdout
        return done.stdout

    def check(self, *command, expected):
        """derive emit ... --check"""
        return self.run(sys.executable, "-m", "derive", *command, "--check", expected=expected)


def changed_text(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


@needs("cmake", "cc")
@pytest.mark.parametrize("builder", [pytest.param("Ninja", marks=needs("ninja")), "Unix Makefiles"])
def test_cmake(builder, tmp_path):
    project = Project("cmake", tmp_path)
    command = f"-DDERIVE_COMMAND={sys.executable};-m;derive"
    found = f"-Dderive_DIR={ROOT / 'cmake'}"
    log = project.run("cmake", "-S", ".", "-B", "b", "-G", builder, found, command)
    assert "Found derive: " in log
    assert "Warning" not in log

    def emits():
        return "Emitting swing" in project.run("cmake", "--build", "b")

    assert emits()
    assert "energy drift" in project.run("b/main")
    assert not emits()
    if builder == "Ninja":
        assert "no work to do" in project.run("cmake", "--build", "b")

    os.utime(project.folder / "swing.toml")
    assert emits()
    os.utime(project.generator / "derive" / "code" / "emit.py")
    assert emits()
    old, new = (project.generator / METADATA.format(version) for version in (1, 2))
    old.rename(new)  # another version, with files as old as the first
    assert emits()
    assert not emits()


OTHERS = """
cmake_minimum_required(VERSION 3.20)
project(others C)
list(APPEND CMAKE_MODULE_PATH "${MODULES}")
include(DeriveEmit)
derive_emit(PROBLEM so2.toml TARGET so2 OPTIONS ${OPTIONS} OUTPUT_DIR gen)
derive_emit(PROBLEM so3 TARGET body PREFIX solid OPTIONS --form header)
add_executable(main main.c)
target_link_libraries(main PRIVATE so2 body)
"""
SO2 = 'name = "so2"\ngroup = "SO(2)"\n[[point]]\nmass = 1\nat = [1, 2]\n'
BOTH = """
#include "so2.h"
#include "solid.h"
int main(void)
{
    double x[solid_N_STATE] = {1}, k[solid_N_CONSTANTS] = {1};
    return !(solid_energy(0, x, k) == 0 && so2_N_STATE > 0);
}
"""


@needs("cmake", "cc")
def test_cmake_options_and_ready_made_problems(tmp_path):
    project = Project("cmake", tmp_path)
    (project.folder / "CMakeLists.txt").write_text(OTHERS)
    (project.folder / "main.c").write_text(BOTH)
    (project.folder / "so2.toml").write_text(SO2)
    common = ("-S", ".", "-B", "b", "-G", "Unix Makefiles", f"-DMODULES={ROOT / 'cmake'}")
    command = f"-DDERIVE_COMMAND={sys.executable};-m;derive"
    project.run("cmake", *common, command, "-DOPTIONS=--real;double")
    project.run("cmake", "--build", "b", "-j2")
    project.run("b/main")
    header = project.folder / "b" / "gen" / "so2.h"
    assert "float" not in header.read_text()
    project.run("cmake", *common, "-DOPTIONS=--real;float")
    log = project.run("cmake", "--build", "b")
    assert "Emitting so2" in log
    assert "Emitting solid" not in log
    assert "float" in header.read_text()


MANY = """
cmake_minimum_required(VERSION 3.20)
project(many C CXX)
list(APPEND CMAKE_MODULE_PATH "${MODULES}")
include(DeriveEmit)
set(all c cpp cvode fmu python rust julia javascript)
set(place "made $dollar")
derive_emit(PROBLEM so2.toml TARGET so2 LANG ${all} OUTPUT_DIR "${place}"
  OPTIONS --jacobian state --layout col --validate)
derive_emit(PROBLEM so3 TARGET solid LANG cpp OUTPUT_DIR "${place}"
  OPTIONS --form=header --attitude quaternion --real float)
derive_emit(PROBLEM so3 TARGET top OUTPUT_DIR "${place}"
  OPTIONS --frame principal --allow-negative-mass --seconds 60)
derive_emit(PROBLEM "in $1 a;b #/so2.toml" TARGET text LANG rust python OUTPUT_DIR "${place}")
get_target_property(files text DERIVE_FILES)
message(STATUS "text: ${files}")
add_executable(main main.cpp)
target_link_libraries(main PRIVATE so2 solid top)
add_executable(other main.cpp)
target_link_libraries(other PRIVATE so2 solid top)
"""
USED = """
#include "so2.hpp"
#include "solid.hpp"
#include "top.h"
int main()
{
    const derive::so2::State x{1, 0, 0, 1, 0.5};
    const auto k = derive::so2::constants({}).value();
    static_assert(sizeof(derive::solid::Real) == 4 && top_N_STATE == 12);
    return !(derive::so2::jacobian(0, x, k).D.size() == 4);
}
"""


@needs("cmake", "cc", "g++")
@pytest.mark.parametrize(
    ("builder", "build"),
    [
        pytest.param("Ninja", "b d", marks=(needs("ninja"), pytest.mark.dist)),
        pytest.param("Ninja", "b $d", marks=needs("ninja")),
        ("Unix Makefiles", "b $d"),
    ],
)
def test_cmake_all_languages_and_strange_paths(builder, build, tmp_path):
    """Libraries and plain files of several targets in one folder, linked to several programs."""
    project = Project("cmake", tmp_path)
    project.folder = project.folder.rename(tmp_path / "a $pro ject")
    odd = project.folder / "in $1 a;b #"
    odd.mkdir()
    for path in (project.folder, odd):
        (path / "so2.toml").write_text(SO2)
    (project.folder / "CMakeLists.txt").write_text(MANY)
    (project.folder / "main.cpp").write_text(USED)
    common = ("-S", ".", "-B", build, "-G", builder, f"-DMODULES={ROOT / 'cmake'}")
    log = project.run("cmake", *common, f"-DDERIVE_COMMAND={sys.executable};-m;derive")
    made = project.folder / build / "made $dollar"
    assert f"text: {made}/text.rs;{made}/text.py" in log

    def emitted():
        return set(re.findall(r"Emitting (\w+) from", project.run("cmake", "--build", build)))

    assert emitted() == {"so2", "solid", "top", "text"}
    project.run(f"{build}/main")
    project.run(f"{build}/other")
    names = {f"so2{x}" for x in (".h", ".c", ".hpp", "_cvode.h", ".py", ".rs", ".jl", ".mjs")}
    names |= {f"so2{x}" for x in ("_fmu.c", "_fmu.xml", "_fmi2.xml", ".fmu", "_fmi2.fmu")}
    names |= {"solid.h", "solid.hpp", "top.h", "top.c", "text.rs", "text.py"}
    assert {x.name for x in made.iterdir()} == names
    assert emitted() == set()
    changed_text(odd / "so2.toml", "mass = 1", "mass = 2")
    assert emitted() == {"text"}
    changed_text(project.folder / "so2.toml", "mass = 1", "mass = 3")
    assert emitted() == {"so2"}
    (made / "text.py").unlink()
    assert emitted() == {"text"}
    assert emitted() == set()


@needs("cmake")
def test_cmake_without_a_language_of_its_own(tmp_path):
    """Python and Rust are files: no compiler is asked for."""
    lines = ["cmake_minimum_required(VERSION 3.20)", "project(x NONE)", "include(DeriveEmit)"]
    lines += ["derive_emit(PROBLEM so3 TARGET body LANG python rust)"]
    (tmp_path / "CMakeLists.txt").write_text("\n".join(lines))
    command = ["cmake", "-S", ".", "-B", "b", f"-DCMAKE_MODULE_PATH={ROOT / 'cmake'}"]
    command += [f"-DDERIVE_COMMAND={sys.executable};-m;derive"]
    for words in (command, ["cmake", "--build", "b"]):
        subprocess.run(words, cwd=tmp_path, check=True, capture_output=True)
    assert sorted(x.name for x in (tmp_path / "b/derive/body").iterdir()) == ["body.py", "body.rs"]


@needs("cmake")
@pytest.mark.parametrize(
    ("call", "told"),
    [
        ("TARGET x", "PROBLEM is missing"),
        ("PROBLEM so3", "TARGET is missing"),
        ("PROBLEM none.toml TARGET x", "none.toml: no such file"),
        ("PROBLEM so3 TARGET x-y", "add PREFIX name"),
        ("PROBLEM so3 TARGET x LANGUAGE c", "unknown argument"),
        ("PROBLEM so3 TARGET x LANG fortran", "invalid choice: 'fortran'"),
        ("PROBLEM so3 TARGET x OPTIONS --frobnicate", "unknown option '--frobnicate'"),
        ("PROBLEM so3 TARGET x LANG rust OPTIONS --form header", "--form header is one of c"),
        ("PROBLEM so3 TARGET x PREFIX stdio", "the prefix 'stdio' cannot be used"),
        ("PROBLEM so3 TARGET x OPTIONS --lang=c", "--lang=c cannot be among OPTIONS"),
        ("PROBLEM so3 TARGET x OUTPUT_DIR [[a;b]]", "CMake can build no file whose path has a ;"),
        (
            "PROBLEM so3 TARGET x LANG python)\nderive_emit(PROBLEM so3 TARGET y PREFIX x "
            "OUTPUT_DIR derive/x LANG python",
            "y would write",
        ),
        ("PROBLEM so3 TARGET x OPTIONS --check", "--check cannot be among OPTIONS"),
        ("PROBLEM so3 TARGET x", "add enable_language(C)"),
    ],
)
def test_cmake_calls_that_are_wrong(call, told, tmp_path):
    lines = ["cmake_minimum_required(VERSION 3.20)", "project(x NONE)"]  # no compiler: faster
    lines += ["include(DeriveEmit)", f"derive_emit({call})"]
    (tmp_path / "CMakeLists.txt").write_text("\n".join(lines))
    command = ["cmake", "-S", ".", "-B", "b", f"-DCMAKE_MODULE_PATH={ROOT / 'cmake'}"]
    command += [f"-DDERIVE_COMMAND={sys.executable};-m;derive"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode
    assert told in " ".join(done.stderr.split())


@needs("cmake", "cc")
def test_cmake_without_derive(tmp_path):
    project = Project("cmake", tmp_path)
    found = f"-Dderive_DIR={ROOT / 'cmake'}"
    for program in (tmp_path / "nothing", "/bin/true"):
        set_to = f"-DDERIVE_COMMAND={program}"
        log = project.run("cmake", "-S", ".", "-B", "b", found, set_to, expected=1)
        assert f"`{program} --version` is not derive" in " ".join(log.split())


@needs("make", "cc", "ar")
def test_make(tmp_path):
    project = Project("make", tmp_path)
    make = ("make", f"PYTHON={sys.executable}")
    assert "derive emit hoop.toml" in project.run(*make)
    assert "energy drift" in project.run(*make, "check")
    project.run(*make, "-q")
    os.utime(project.folder / "hoop.toml")
    project.run(*make, "-q", expected=1)
    assert "derive emit hoop.toml" in project.run(*make)
    project.run(*make, "-q")
    project.run(*make, "current")
    os.utime(project.generator / "derive" / "code" / "emit.py")
    project.run(*make, "-q", expected=1)
    changed_text(project.folder / "hoop.toml", "anchor = [2, 0]", "anchor = [3, 0]")
    project.check("emit", "hoop.toml", "--lang", "c", "--out", "build", expected=1)


@needs("make", "cc", "ar", "pkg-config")
def test_pkg_config(tmp_path):
    project, prefix = Project("make", tmp_path), tmp_path / "prefix"
    project.run("make", f"PYTHON={sys.executable}", f"PREFIX={prefix}", "install")
    path = {"PKG_CONFIG_PATH": prefix / "lib" / "pkgconfig"}
    flags = project.run("pkg-config", "--cflags", "--libs", "hoop", **path).split()
    assert "-lhoop" in flags
    project.run(CC, "-std=c99", "main.c", *flags, "-o", "installed")
    assert "energy drift" in project.run("./installed")


@needs("meson", "ninja", "cc")
def test_meson(tmp_path):
    project = Project("meson", tmp_path)
    project.run("meson", "setup", "b")

    def emits():
        return "Generating top_code" in project.run("ninja", "-C", "b")

    assert emits()
    assert "energy drift" in project.run("b/main")
    assert not emits()
    os.utime(project.folder / "top.toml")
    assert emits()
    assert not emits()
    os.utime(project.generator / "derive" / "code" / "emit.py")
    assert emits()
    project.check("emit", "top.toml", "--lang", "c", "--out", "b", expected=0)
    changed_text(project.folder / "top.toml", "mass = 1\n", "mass = 2\n")
    project.check("emit", "top.toml", "--lang", "c", "--out", "b", expected=1)


@needs("cc")
def test_python(tmp_path):
    project = Project("python", tmp_path)
    run = (sys.executable, "compare.py")
    assert "compiled" in project.run(*run)
    again = project.run(*run)
    assert "energy drift" in again
    assert "compiled" not in again
    changed_text(project.folder / "sheet.toml", "mass = 2", "mass = 3")
    assert "compiled" in project.run(*run)
