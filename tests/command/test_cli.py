"""The command line: exit codes, one clear line for bad input, nothing half-written."""

import json
import os
import re
import subprocess
import sys

import pytest

from derive.command.cli import main
from derive.command.showing import ready_made
from derive.record.as_json import to_data, to_json
from derive.views.printing.line_breaking import display_width
from derive.views.rendering import FORMATS
from tests.support.needs import CC, needs
from tests.support.walks import record


def run(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "derive", *arguments], capture_output=True, text=True, **options
    )


def refused(capsys, *arguments):
    """Exit 2, nothing on stdout, one line on stderr."""
    assert main(list(arguments)) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("derive: ")
    assert err.count("\n") == 1
    return err


def test_list(capsys):
    assert main(["list"]) == 0
    out = capsys.readouterr().out
    assert all(name in out for name in (*ready_made(), "SO(n)", "SE(n)", "SL(n)"))


@pytest.mark.parametrize("form", FORMATS)
def test_walk_formats(form, capsys, tmp_path):
    assert main(["walk", "so3", "--format", form]) == 0
    out = capsys.readouterr().out
    assert "so3.kernel" in out
    target = tmp_path / "walk"
    assert main(["walk", "so3", "--format", form, "--out", str(target)]) == 0
    assert target.read_text(encoding="utf-8") == out
    assert os.listdir(tmp_path) == ["walk"]


def widest(text):
    return max(map(display_width, text.split("\n")))


TEXTS = (
    ("walk", "so3"),
    ("walk", "so3", "linear.kernel"),
    ("integrals", "euler_top"),
    ("equilibria", "euler_top"),
    ("trim", "so3"),
    ("symmetries", "euler_top"),
    ("paper",),
)


@pytest.mark.parametrize("words", TEXTS)
def test_a_text_is_as_wide_as_what_shows_it(words, capsys, tmp_path, monkeypatch):
    """COLUMNS, of standard output alone; 100 where nothing is known of the reader."""
    said = {}
    for columns in ("", "72", "160"):
        monkeypatch.setenv("COLUMNS", columns)
        assert main([*words]) == 0
        said[columns] = capsys.readouterr().out
    file = tmp_path / "said.txt"
    assert main([*words, "--out", str(file)]) == 0
    assert file.read_text(encoding="utf-8") == said[""]
    assert 72 < widest(said[""]) <= 100 < widest(said["160"]) <= 160
    assert 60 < widest(said["72"]) <= 72
    assert len({x.replace("\n", " ").replace(" ", "") for x in said.values()}) == 1


def test_check_a_problem_and_a_file(capsys, tmp_path):
    path = tmp_path / "linear.json"  # whose steps are of any group, each tried once
    path.write_text(to_json(record("linear")), encoding="utf-8")
    assert main(["check", "linear", str(path)]) == 0
    *each, _, total = capsys.readouterr().out.splitlines()
    counts = [re.search("([0-9]+) of ([0-9]+) steps hold exactly", x) for x in each]
    steps = sum(int(x[2]) for x in counts if x)
    assert total == f"records: 2; steps: {steps}; failed: 0"
    assert main(["check", str(path), str(tmp_path / "none.json")]) == 2
    assert capsys.readouterr().out.endswith("failed: 0; not checked: 1\n")
    assert main(["check", str(path)]) == 0
    assert "records" not in capsys.readouterr().out


def test_a_file_in_another_encoding(capsys, tmp_path):
    broken = tmp_path / "broken.toml"
    broken.write_bytes('name = "x"\ntitle = "é"'.encode("latin-1"))
    assert "line 2 has a byte that is not UTF-8; save" in refused(capsys, "walk", str(broken))


def test_standard_output_by_its_name(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for words in (["walk", "so3"], ["emit", "so3", "--lang", "python"]):
        assert main([*words, "--out", "-"]) == 0
        assert "solid about a fixed point" in capsys.readouterr().out
    assert not [*tmp_path.iterdir()]


@needs("cc")
def test_prefix_and_float(tmp_path):
    out = run(
        "emit", "so3", "--lang", "c", "--prefix", "top", "--real", "float", "--out", str(tmp_path)
    )
    assert out.returncode == 0
    assert sorted(os.listdir(tmp_path)) == ["top.c", "top.h"]
    text = (tmp_path / "top.c").read_text(encoding="utf-8")
    assert "so3_" not in text
    assert "double" not in text
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wdouble-promotion"]
    compiled = subprocess.run(
        [CC, *flags, "-c", "top.c"], cwd=tmp_path, capture_output=True, text=True
    )
    assert compiled.returncode == 0, compiled.stderr


def test_a_closed_pipe_is_quiet():
    shell = f"{sys.executable} -m derive walk se3 | head -1"
    out = subprocess.run(["sh", "-c", shell], capture_output=True, text=True)
    assert out.stderr == ""


def test_version():
    assert run("--version").stdout.startswith("derive ")


def test_a_failing_step_says_what_and_where(capsys, tmp_path):
    """The equation, the entry, and small numbers on both sides; of the others, on which groups."""
    data = to_data(record("so3"))
    step = next(s for s in data["steps"] if s["label"] == "so3.kernel")
    step["equations"][0]["rhs"][1] = ["mul", -1, step["equations"][0]["rhs"][1]]
    path = tmp_path / "wrong.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    assert main(["check", str(path)]) == 1
    lines = capsys.readouterr().out.splitlines()
    (failed,) = (line for line in lines if line.startswith("FAILS"))
    assert failed.startswith(
        "FAILS  so3.kernel: so3.kernel.1 on SO(3), Iζ̇ = −Iφ + Iζ ∧ ζ: the sides"
    )
    assert re.search(r"differ in entry \(\d, 1\): -?[\d/]{1,9} and -?[\d/]{1,9}$", failed)
    assert "holds  linear.energy: 2 equations on B(2), SO(3), SL(3), GL(6)" in lines


@pytest.mark.parametrize("form", [x for x in FORMATS if x != "json"])
def test_steps_alone(form, capsys):
    """Those that are named, from any chapter, and no other."""
    assert main(["walk", "so3", "euler", "linear.kernel", "--format", form]) == 0
    out = capsys.readouterr().out
    shown = {x for x in ("so3.euler", "linear.kernel", "so3.motion", "linear.action") if x in out}
    # what a step uses is named beside it, but where that would be a link to nothing
    assert {"so3.euler", "linear.kernel"} <= shown <= {"so3.euler", "linear.kernel"}


def test_steps_behind_an_option(capsys):
    assert main(["walk", "so3", "--lang", "fr", "kernel"]) == 0
    assert capsys.readouterr().out.startswith("so3.kernel")
