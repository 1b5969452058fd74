"""The README is true: its commands run, its programs compile, its output is what is printed."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from derive.command.cli import main
from tests.support.needs import CC, needs

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.S)


COMMANDS = [line.split("#")[0].split() for line in blocks("sh")[0].splitlines()]


CASES = [
    pytest.param(x, marks=needs("pdflatex") if x[-1].endswith(".pdf") else ()) for x in COMMANDS
]


@pytest.mark.no_cover
@pytest.mark.parametrize("command", CASES, ids=" ".join)
def test_commands(command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert command[0] == "derive"
    assert main(command[1:]) == 0


def test_the_shown_output_is_printed(capsys):
    shown = re.search(r"<!-- output: derive walk so3 -->\n```\n(.*?)```", README, flags=re.S)[1]
    assert main(["walk", "so3"]) == 0
    assert shown.strip("\n") in capsys.readouterr().out
    assert 15 < len(shown.splitlines()) < 60


@needs("cc")
def test_the_c_program(tmp_path):
    (tmp_path / "main.c").write_text(blocks("c")[0], encoding="utf-8")
    compile_line = re.search(r"`(cc -std=c99 .*?)`", README)[1].split()
    flags = [x.replace("generated/", f"{ROOT}/generated/") for x in compile_line[1:]]
    subprocess.run([CC, *flags, "-o", "main"], cwd=tmp_path, check=True)
    out = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True).stdout
    assert abs(float(out.split()[-1])) < 1e-4


def test_the_python_program():
    out = subprocess.run(
        [sys.executable, "-c", blocks("python")[0]], cwd=ROOT, capture_output=True, text=True
    )
    assert out.returncode == 0, out.stderr
    assert "zeta_3" in out.stdout


def test_the_problem_file(tmp_path, monkeypatch, capsys):
    text = blocks("toml")[0]
    assert tomllib.loads(text)["name"] == "swing"
    monkeypatch.chdir(tmp_path)
    Path("swing.toml").write_text(text, encoding="utf-8")
    for command in re.findall(r"`derive (\w+ swing\.toml)`", README):
        assert main(command.split()) == 0
    assert Path("swing.c").exists()


def test_the_named_files_exist():
    tree = README[README.index("## Where things are") :]
    for name in re.findall(r"^    ([a-z/_.]+?),?  ", tree, flags=re.M):
        assert (ROOT / name).exists(), name


@needs("make")
def test_every_make_target_is_described():
    help_text = subprocess.run(
        ["make", "help"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    targets = re.findall(r"^([a-z]+):.*##", (ROOT / "Makefile").read_text(), flags=re.M)
    assert all(f"make {t}" in help_text for t in targets)
    assert {"derive", "test", "bench", "help"} <= set(targets)
