"""Places that cannot be written to, and prefixes that are names elsewhere: one line, exit 2."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from derive import compile as compiled
from derive.command.cli import main
from derive.language import templating
from tests.support.library import module_of
from tests.support.needs import CC, needs
from tests.support.processes import environment


@pytest.fixture
def refused(capsys):
    """The only line of stderr, the exit code 2 and nothing on stdout."""

    def run(*arguments):
        assert main([str(x) for x in ("emit", *arguments)]) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("derive: ")
        assert err.count("\n") == 1
        return err

    return run


@pytest.mark.parametrize(
    ("prefix", "free"),
    [("box", "c"), ("begin", "c"), ("imp", "c"), ("lambda", "c"), ("virtual", "javascript")],
)
def test_words_of_one_language_are_prefixes_in_others(prefix, free, tmp_path):
    assert main(["emit", "so3", f"--prefix={prefix}", "--lang", free, "--out", str(tmp_path)]) == 0


@needs("cc")
@pytest.mark.parametrize("name", ["box", "match", "core", "stdio", "imp"])
def test_a_problem_of_any_name_runs(name, tmp_path, capsys):
    """Also compiled, and in a page: no file of its code is left to be named."""
    path = tmp_path / "problem.toml"
    points = "".join(f"[[point]]\nmass = 1\nat = {x}\n" for x in ([1, 0, 0], [0, 2, 0], [0, 0, 3]))
    path.write_text(f'name = "{name}"\ngroup = "SO(3)"\n{points}')
    start = ["--t", "1", "--set", "zeta_1=1"]
    page = ["--html", str(tmp_path / "page.html"), "--out", str(tmp_path / "run.csv")]
    assert main(["simulate", str(path), *start, *page]) == 0
    assert capsys.readouterr().out.split("\n")[1].startswith(f"{name}: ")
    assert main(["simulate", str(path), *start, "--dt", "0.001"]) == 0
    assert "in C" in capsys.readouterr().out
    assert len(compiled(str(path)).STATE) == 12


USE = """\
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include "{0}.h"
int main(void)
{{
    double x[{0}_N_STATE] = {{1}}, k[{0}_N_CONSTANTS] = {{0}};
    errno = 0;
    printf("%g", {0}_energy(0, x, k));
    return errno;
}}
"""


@needs("cc")
@pytest.mark.parametrize("prefix", ["printf", "main", "free", "size_t"])
def test_prefixes_of_libc_are_harmless(prefix, tmp_path):
    """Every name gets an ending, so these collide with nothing but a file of the same name."""
    assert main(["emit", "so3", "--lang", "c", "--prefix", prefix, "--out", str(tmp_path)]) == 0
    (tmp_path / "user.c").write_text(USE.format(prefix))
    options = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-I.", "-lm"]
    command = [CC, *options[:-1], "user.c", f"{prefix}.c", options[-1], "-o", "user"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert subprocess.run([tmp_path / "user"], capture_output=True, text=True).stdout == "0"


def test_out_is_a_file(refused, tmp_path, capsys):
    file = tmp_path / "file"
    file.write_text("mine")
    for out in (file, file / "deeper"):
        assert str(out) in refused("so3", "--out", out)
    assert main(["walk", "so3", "--out", str(file / "walk.txt")]) == 2
    assert str(file) in capsys.readouterr().err
    assert file.read_text() == "mine"
    assert os.listdir(tmp_path) == ["file"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_out_is_a_device(refused):
    assert "/dev/full" in refused("so3", "--out", "/dev/full")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_link_to_a_full_device(capsys, tmp_path):
    (tmp_path / "walk.txt").symlink_to("/dev/full")
    assert main(["walk", "so3", "--out", str(tmp_path / "walk.txt")]) == 2
    assert "No space left" in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["walk.txt"]


@pytest.mark.parametrize("target", ["../mine", "/dev/null", "missing/../../mine", "so3.h"])
def test_a_link_out_of_the_folder(target, refused, tmp_path):
    """The problem gives the names in the folder; whoever packed both could aim at any file."""
    mine, out = tmp_path / "mine", tmp_path / "out"
    mine.write_text("mine")
    out.mkdir()
    (out / "so3.h").symlink_to(target)
    assert "so3.h: a link that leads out of the folder" in refused("so3", "--out", out)
    assert mine.read_text() == "mine"
    assert os.listdir(out) == ["so3.h"]


def test_a_link_within_the_folder(tmp_path):
    (tmp_path / "so3.h").symlink_to("real.h")
    assert main(["emit", "so3", "--lang", "c", "--out", str(tmp_path)]) == 0
    assert (tmp_path / "so3.h").is_symlink()
    assert "so3_rhs" in (tmp_path / "real.h").read_text()


@pytest.mark.skipif(not Path("/proc/sys").is_dir(), reason="there is no /proc")
def test_a_folder_that_root_may_not_write_to(refused):
    for out in ("/proc", "/proc/new", "/proc/self/derive", "/proc/sys/kernel"):
        assert out in refused("so3", "--out", out)


@pytest.mark.skipif(getattr(os, "geteuid", int)() == 0, reason="root may write anywhere")
def test_a_folder_without_permission(refused, tmp_path):
    tmp_path.chmod(0o500)
    assert "Permission denied" in refused("so3", "--out", tmp_path)
    tmp_path.chmod(0o700)
    assert not list(tmp_path.iterdir())


LIMITED = """\
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
from derive.command.cli import main
from derive.language import templating
from derive.pipeline import walk
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]),) * 2)
sys.exit(main(sys.argv[2:]))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="files have no limit on their size")
@pytest.mark.parametrize("size", [0, 1000])
def test_a_write_that_stops_half_way(size, tmp_path):
    """As on a full disk; what was there stays, and nothing is left over."""
    old = {name: f"old {name}" for name in ("so3.h", "so3.c", "so3.py")}
    for name, text in old.items():
        (tmp_path / name).write_text(text)
    command = [sys.executable, "-B", "-c", LIMITED, str(size), "emit", "so3", "--out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, env=environment())
    assert done.returncode == 2
    assert done.stderr.startswith(f"derive: {tmp_path / 'so3.h'}: File too large")
    assert done.stderr.count("\n") == 1
    assert {p.name: p.read_text() for p in tmp_path.iterdir()} == old


@pytest.fixture
def small_disk(tmp_path):
    """16 KiB, where this may be mounted."""
    disk = tmp_path / "disk"
    disk.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", "size=16k", "derive-test", str(disk)]
    if shutil.which("mount") is None or subprocess.run(command, capture_output=True).returncode:
        pytest.skip("no tmpfs may be mounted here")
    yield disk
    subprocess.run(["umount", "-l", str(disk)], check=True)


def test_a_full_disk(small_disk, refused):
    (small_disk / "ballast").write_bytes(b"x" * 4 * 4096)
    assert f"{small_disk / 'so3.h'}: No space left" in refused("so3", "--out", small_disk)
    assert os.listdir(small_disk) == ["ballast"]


def test_a_disk_that_fills_up_between_files(small_disk, refused):
    """No file is there, and no temporary one is left."""
    assert "No space left" in refused("so3", "--out", small_disk)
    assert not list(small_disk.iterdir())


def test_an_output_that_is_a_folder(refused, tmp_path):
    (tmp_path / "so3.h").mkdir()
    assert "so3.h: Is a directory" in refused("so3", "--out", tmp_path)
    assert os.listdir(tmp_path) == ["so3.h"]


def test_check_writes_nothing(tmp_path, capsys):
    new = tmp_path / "new"
    assert main(["emit", "so3", "--out", str(new), "--check"]) == 1
    assert capsys.readouterr().out.count("missing; run the same") == 3
    assert not new.exists()


def test_why_constants_are_refused():
    """A rod, a number that is none, and one that is too large are told apart."""
    so3 = module_of("so3")
    given = dict.fromkeys(so3.PARAMETERS, 0.0)
    with pytest.raises(ValueError, match="the mass matrix is singular"):
        so3.constants(given | {"J_33": 1.0})
    with pytest.raises(ValueError, match="a parameter is not finite"):
        so3.constants(given | {"J_33": float("nan")})
    with pytest.raises(ValueError, match="too large"):
        so3.constants({"J_11": 1e308, "J_22": 1.1e308, "J_33": 1e308, "c_3": 1e308})


def test_a_build_on_a_disk_that_fills_up(tmp_path):
    """What is written is whole, the rest is not there, and one line says why."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=256k", "derive-test", str(disk)]
    if shutil.which("mount") is None or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("no tmpfs may be mounted here")
    try:
        command = [sys.executable, "-B", "-m", "derive", "build", "--out", disk]
        done = subprocess.run(command, capture_output=True, text=True)
        lines = done.stderr.splitlines()
        assert done.returncode == 2
        assert "No space left" in lines[-1]
        assert [x.startswith("derive: ") for x in lines] == [False] * 6 + [True]
        written = [x for x in disk.rglob("*") if x.is_file()]
        assert sorted(map(str, written)) == sorted(lines[:-1])
    finally:
        subprocess.run(["umount", "-l", str(disk)], check=True)


@pytest.mark.parametrize("missing", ["c", "c/sizes.jinja"])
def test_a_template_that_is_missing_is_named(refused, tmp_path, monkeypatch, missing):
    shutil.copytree(templating.folder("c"), tmp_path / "templates" / "c")
    place = tmp_path / "templates" / missing
    shutil.rmtree(place) if place.is_dir() else place.unlink()
    monkeypatch.setattr(templating, "__file__", str(tmp_path / "language" / "templating.py"))
    templating.environment.cache_clear()
    told = f"templates/{missing} is missing beside the package; install derive again"
    assert refused("so3", "--lang", "c", "--out", tmp_path / "code") == f"derive: {told}\n"
    templating.environment.cache_clear()
