"""Programs that the page writes for the emitted code: each runs, and all say the same rates."""

import math
import re
import subprocess
import sys

import pytest
from tree_sitter import Parser

from derive import derive as derived
from derive.command.cli import main
from tests.support import in_node
from tests.support.library import module_of
from tests.support.needs import CC, needs, present
from tests.support.played import Played, text_of
from tests.support.read_julia import LANGUAGE, Module

IMPORTS = """
import { about, snippets } from "./src/snippets.js";
const told = ({ files, start }) => ({ programs: snippets(Object.entries(files), start),
    about: Object.fromEntries(Object.entries(files).map(([name, text]) => [name, about(text)])) });
"""
RUNS = {
    "main.c": [[CC, "-std=c99", "-pedantic", "-Wall", "-Werror", "main.c", "NAME.c", "-lm"]],
    "main.cpp": [
        [CC, "-std=c99", "-c", "NAME.c"],
        ["g++", "-std=c++17", "main.cpp", "NAME.o", "-lm"],
    ],
    "main.rs": [["rustc", "--edition=2021", "-A", "warnings", "main.rs", "-o", "a.out"]],
    "main.py": [],
    "main.mjs": [],
}
INTERPRETER = {"main.py": [sys.executable, "-B"], "main.mjs": ["node"]}


@pytest.fixture
def played(tmp_path, monkeypatch):
    return Played(tmp_path, monkeypatch)


def written(folder, problem, *options, start=None):
    """What is emitted, and the programs of the page beside it, whose names are returned, and what
    the files say of themselves; ``start``: what is told of the problem's."""
    assert main(["emit", problem, *options, "--out", str(folder)]) == 0
    files = {x.name: x.read_text(encoding="utf-8") for x in folder.iterdir()}
    found = in_node.told(IMPORTS, "told(given)", {"files": files, "start": start or {}})
    for name, text in found["programs"]:
        (folder / name).write_text(text, encoding="utf-8")
    return [name for name, _ in found["programs"]], found["about"]


def rates(folder, program, problem):
    """What a program prints."""
    for command in RUNS[program]:
        line = [x.replace("NAME", problem) for x in command]
        subprocess.run(line, cwd=folder, check=True, capture_output=True)
    command = [*INTERPRETER[program], program] if program in INTERPRETER else ["./a.out"]
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    return {name: float(x) for name, x in map(str.split, done.stdout.splitlines())}


def by_julia(folder, problem):
    """What main.jl prints, by the tests' own reader of Julia: its statements as a function of the
    module, and the loop that prints as it stands."""
    program, emitted = ((folder / x).read_text() for x in ("main.jl", f"{problem}.jl"))
    assert not Parser(LANGUAGE).parse(program.encode()).root_node.has_error
    head, statements, printed = re.split(r"(?<=\.jl\"\)\n)|^(?=for )", program, flags=re.MULTILINE)
    assert head == f'# julia main.jl\ninclude("{problem}.jl")\n'
    each = f"for (name, rate) in zip({problem}.STATE, dx)"
    assert printed == f'{each}\n    println(name, " ", rate + 0)\nend\n'
    main = f"function main()\n{statements.replace(f'{problem}.', '')}return dx\nend\n"
    module = Module(emitted.replace("end # module", f"{main}end # module"))
    return dict(zip(module.names["STATE"], map(float, module.call("main").whole()), strict=True))


@needs("cc", "node")
@pytest.mark.parametrize(
    "problem", ["so3", "se3", "top", "comet", "two_tops", "heisenberg", "kirchhoff"]
)
def test_a_program_of_each_language_runs_and_says_the_same(problem, tmp_path, capsys):
    languages, tried = ["c", "python", "javascript"], ["main.c", "main.py", "main.mjs"]
    if present("g++"):
        languages.append("cpp")
        tried.append("main.cpp")
    if present("rustc") and problem in ("so3", "top"):
        languages.append("rust")
        tried.append("main.rs")
    languages.append("julia")
    names, about = written(tmp_path, problem, *(y for x in languages for y in ("--lang", x)))
    assert {*names} == {*tried, "main.jl"}
    assert "rhs" in about[f"{problem}.h"]["operations"]
    found = [*(rates(tmp_path, x, problem) for x in tried), by_julia(tmp_path, problem)]
    first = found[0]
    assert [*first] == about[f"{problem}.py"]["state"] == about[f"{problem}.jl"]["state"]
    assert any(first.values())
    assert all(map(math.isfinite, first.values()))
    for other in found[1:]:
        assert other == pytest.approx(first, rel=1e-6, abs=1e-12)
    capsys.readouterr()


@needs("cc", "node")
@pytest.mark.parametrize(
    "options", [["--attitude", "quaternion", "--real", "float"], ["--form", "header"]]
)
def test_a_program_follows_the_options(options, tmp_path, capsys):
    names, about = written(tmp_path, "se3", "--lang", "c", *options)
    assert names == ["main.c"]
    command = [
        CC,
        "-std=c99",
        "-Wall",
        "-Werror",
        "main.c",
        *([] if "--form" in options else ["se3.c"]),
    ]
    subprocess.run([*command, "-lm"], cwd=tmp_path, check=True)
    done = subprocess.run(["./a.out"], cwd=tmp_path, check=True, capture_output=True, text=True)
    found = [x.split() for x in done.stdout.splitlines()]
    assert [name for name, _ in found] == about["se3.h"]["state"]
    assert all(math.isfinite(float(x)) for _, x in found)
    capsys.readouterr()


@needs("node")
@pytest.mark.parametrize(
    ("problem", "options"),
    [("top", ""), ("pendulum", ""), ("se3", "--attitude quaternion"), ("so3", "--frame principal")],
)
def test_a_program_starts_where_the_file_says(problem, options, played, tmp_path):
    """Beside the rates of the emitted Python at the start of `derive simulate`; in another frame
    the file says nothing of the state."""
    words = f"emit FILE {options} --lang python --out out".replace("  ", " ")
    told = dict(played.asked("files", text=text_of(problem), words=words))
    folder = tmp_path / "code"
    folder.mkdir()
    written(folder, problem, *options.split(), "--lang", "python", start=told["start"])
    found = rates(folder, "main.py", problem)
    assert bool(told["start"]) == (problem != "so3")
    if told["start"]:
        assert [*told["start"]] == [*found]
    if not options:
        run = derived(problem).simulate(1e-3)
        made = module_of(problem)
        k = made.constants([made.DEFAULTS[x] for x in made.PARAMETERS])
        at = run.table[0][[x.kind == "state" for x in run.columns]]
        expected = made.rhs(0.0, at, k, [0.0] * len(made.INPUTS))
        assert [*found.values()] == pytest.approx([*expected], rel=1e-6, abs=1e-12)
