"""The command line: exit codes, one clear line for bad input (tests/corpus/commands.toml), nothing
half-written; options that are refused are told before; what is searched for, in every format."""

import json
import os
import re
import subprocess

import numpy as np
import pytest

from derive import __version__, derive
from derive.code.options import ADDED, CHOICES, DEPENDENT, REPEATED, Options
from derive.command.cli import main
from derive.command.emitting import further, refused
from derive.command.showing import ready_made
from derive.command.simulating import summary
from derive.problem.problem import ProblemError
from derive.record.as_json import to_data, to_json
from derive.views.printing.typeset import display_width
from derive.views.rendering import FORMATS
from tests.corpus import commands, table
from tests.fuzz.mutate import toml
from tests.support.needs import CC, need, needs
from tests.support.walks import record


def one_line(capsys, *arguments):
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
    assert "line 2 has a byte that is not UTF-8; save" in one_line(capsys, "walk", str(broken))


def test_standard_output_by_its_name(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for words in (["walk", "so3"], ["emit", "so3", "--lang", "python"]):
        assert main([*words, "--out", "-"]) == 0
        assert "solid about a fixed point" in capsys.readouterr().out
    assert not [*tmp_path.iterdir()]


@needs("cc")
def test_prefix_and_float(tmp_path):
    options = ["--lang", "c", "--prefix", "top", "--real", "float", "--out", str(tmp_path)]
    assert main(["emit", "so3", *options]) == 0
    assert sorted(os.listdir(tmp_path)) == ["top.c", "top.h"]
    text = (tmp_path / "top.c").read_text(encoding="utf-8")
    assert "so3_" not in text
    assert "double" not in text
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wdouble-promotion"]
    compiled = subprocess.run(
        [CC, *flags, "-c", "top.c"], cwd=tmp_path, capture_output=True, text=True
    )
    assert compiled.returncode == 0, compiled.stderr


def test_version(capsys):
    with pytest.raises(SystemExit):
        main(["--version"])
    assert capsys.readouterr().out == f"derive {__version__}\n"


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


@pytest.mark.parametrize("label", ["kernel", "so3.kernel"])
def test_steps_behind_an_option(label, capsys):
    """By the whole name, or without the problem's."""
    assert main(["walk", "so3", "--lang", "fr", label]) == 0
    assert capsys.readouterr().out.startswith("so3.kernel")


@pytest.mark.parametrize(
    ("words", "files", "said"), [pytest.param(*x, id=" ".join(x[0])) for x in commands()]
)
def test_it_is_refused_in_one_line(words, files, said, tmp_path, monkeypatch, capsys):
    """Exit 2, beside warnings one line, and nothing is written."""
    if "--ensemble" in words:
        need("cc")
    monkeypatch.chdir(tmp_path)
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    try:
        status = main(words)
    except SystemExit as end:
        status = end.code
    out, err = capsys.readouterr()
    (line,) = (x for x in err.splitlines() if not x.startswith("derive: warning: "))
    assert (status, out) == (2, "")
    assert line.startswith(("derive: ", f"derive {words[0]}: error: "))
    assert [x for x in said if x not in line] == []
    # what means nothing that is known has no meaning guessed
    assert ("did you mean" in line) <= any("did you mean" in x for x in said)
    assert {*os.listdir()} == {*files}


FORMS = {
    "so3": ((), Options()),
    "sl3": (("julia",), Options(frame="given", momenta=True)),
    "spherical_pendulum": (("c", "rust"), Options(jacobian=("raw",))),
    "euler_top": (("python",), Options(step=("gauss", "gauss_jax"))),
    "zeitlin": (("c",), Options(real="float")),
    "top": (("c",), Options(attitude="quaternion", step=("rk4",))),
}


def words(languages, options):
    """As the command takes them."""
    found = [f"--lang={x}" for x in languages]
    found += [f"--{x}={getattr(options, x)}" for x in (*CHOICES, *DEPENDENT) if getattr(options, x)]
    found += [f"--{x}={y}" for x in REPEATED for y in getattr(options, x)]
    return found + [f"--{x}" for x in ADDED if getattr(options, x)]


@pytest.mark.parametrize("name", FORMS)
def test_the_reasons_are_those_of_the_command(name, capsys, tmp_path):
    languages, options = FORMS[name]
    d = derive(name)
    found = refused(d.problem, d.record, languages or ("c", "python"), options)
    assert found
    choices = dict(further(languages or ("c", "python"), options))
    assert {*found} <= {*choices}
    for choice, reason in found.items():
        command = ["emit", name, *words(*choices[choice]), "--out", str(tmp_path / "out")]
        assert main(command) == 2
        assert reason in capsys.readouterr().err, choice
    assert not (tmp_path / "out").exists()


ORDERS = [f"order {k}" for k in (2, 4, 6, 8)]
REFUSED_OF_SO3 = ("form header", *ORDERS, "multiplier", "ensemble")
REFUSED_OF_SO3 += ("attitude angle", "jacobian outputs", "jacobian step")
CHOICES_OF_SO3 = dict(further(("python",), Options()))


@pytest.mark.parametrize("choice", CHOICES_OF_SO3)
def test_what_is_not_refused_is_made(choice, tmp_path, capsys):
    d = derive("so3")
    why = refused(d.problem, d.record, ("python",), Options()).get(choice)
    assert bool(why) == (choice in REFUSED_OF_SO3)
    status = main(["emit", "so3", *words(*CHOICES_OF_SO3[choice]), "--out", str(tmp_path / "out")])
    assert status == (2 if why else 0)
    assert (why or "") in capsys.readouterr().err


def test_what_is_refused_itself_is_told_alone():
    d = derive("sl3")
    (told,) = refused(d.problem, d.record, ("c",), Options(attitude="quaternion")).items()
    assert told == ("", "sl3: a quaternion needs a factor SO(3) or SE(3), not SL(3)")


SEARCHES = {
    "symmetries": ("top", "symmetries", "conserved_3", "By a symmetry", "Par une symétrie"),
    "reduction": (
        *("spherical_pendulum", "momentum_1", "quadrature"),
        *("The locked inertia", "L’inertie bloquée"),
    ),
    "integrals --degree 2": (
        *("lagrange_top", "poisson", "first_integrals"),
        *("For generic values of the parameters", "Pour des valeurs génériques des paramètres"),
    ),
    "integrals --degree 2 --conditions": (
        *("lagrange_top", "poisson", "first_integrals"),
        *("where one of these conditions holds", "là où l’une de ces conditions"),
    ),
    "equilibria": (
        *("euler_top", "equilibrium_1", "energy_casimir_3"),
        *("A relative equilibrium", "Un équilibre relatif"),
    ),
    "trim --at A_11=-1 --at A_22=-1": (
        *("pendulum", "trim", "trim"),
        *("The velocity stays 0 with", "La vitesse reste 0 avec"),
    ),
    "equilibria --near Pi_2=1": (
        *("euler_top", "enclosure_1", "enclosure_1"),
        *("(Krawczyk)", "(Krawczyk)"),
    ),
}
"""Words of a command → a problem, the first and the last step that is shown, and what they say."""


@pytest.mark.parametrize("words", SEARCHES)
@pytest.mark.parametrize("form", FORMATS)
def test_it_is_shown_in_every_format(words, form, tmp_path, capsys):
    name, first, last, *said = SEARCHES[words]
    command, *options = words.split()
    file, own = tmp_path / f"out.{form}", [command, name, *options]

    def shown(*more):
        assert main([*own, "--format", form, "--out", str(file), *more]) == 0
        return " ".join(file.read_text(encoding="utf-8").replace("\\_", "_").split())

    english = shown()
    assert f"{name}.{first}" in english
    assert f"{name}.{last}" in english
    if form == "json":
        assert main(["check", str(file)]) == 0
        return
    assert f"{name}.mass" not in english
    if form == "text":
        french = shown("--lang", "fr")
        assert [x in y for x, y in zip(said, (english, french), strict=True)] == [True, True]
        assert said[0] == said[1] or said[0] not in french
    if form == "text" and command in ("symmetries", "reduction"):
        alone = shown(last)
        assert alone.startswith(f"{name}.{last} ·")
        assert f"{name}.{first} ·" not in alone


@pytest.fixture
def fluid(tmp_path):
    path = tmp_path / "fluid.toml"
    path.write_text(toml(table("commands")["file"]["fluid.toml"]), encoding="utf-8")
    return path


def test_text_is_told_from_a_name():
    with pytest.raises(ProblemError, match="not its text"):
        derive('name = "fluid"\n')


def test_the_end_of_a_large_state_is_its_largest_numbers(fluid):
    start = {"re_1_0": 1.0, "im_0_1": -2.0, "re_3_2": 3.0}
    run = derive(fluid).simulate(1e-3, points=1, start=start)
    *told, rest = summary(run)[-1].removeprefix("  at the end: ").split(", ")
    assert rest == "… (the largest of 80)"
    assert len(told) == 8
    found = {name: float(x) for name, x in (one.split(" = ") for one in told)}
    assert {*start} <= {*found}
    at_end = np.sort(np.abs(run.states[-1]))[-8:]
    assert np.allclose(np.sort(np.abs([*found.values()])), at_end, rtol=1e-5)


def test_a_sum_over_the_lattice_is_bad_input(fluid):
    with pytest.raises(ProblemError, match="place of the lattice"):
        derive(fluid)["energy"].sympy()
