"""Names of [initial] and [[event]] that the state has not are told with the walk."""

import pytest

from derive.command.cli import main
from derive.command.showing import ready_made
from derive.pipeline import walk
from derive.problem.motion_tables import faults, numbers_followed
from derive.problem.toml import load
from derive.programs import program
from tests.problems import READY, moving

FILE = f"""{moving.SPIN}[[input]]
name = "u"
kind = "covector"
[initial]
zeta_3 = "w"
"""
ENTRIES = "it has A_11 … A_33, zeta_1 … zeta_3, u_1 … u_3"


@pytest.fixture
def told(tmp_path, capsys):
    """The exit code and stderr of a command on a text."""

    def done(text, command, *options):
        path = tmp_path / "p.toml"
        path.write_text(text)
        code = main([command, str(path), *options])
        return code, capsys.readouterr().err.replace(str(path), "p.toml")

    return done


@pytest.mark.parametrize(
    "name", [x for x in ready_made() if x != "imu" and load(READY / f"{x}.toml").group is not None]
)
def test_they_are_those_of_the_emitted_code(name):
    problem = load(READY / f"{name}.toml")
    assert problem.group is not None
    emitted = program(problem, walk(problem))
    assert {*numbers_followed(problem, problem.group)} == {*emitted.state, *emitted.inputs}
    assert [*faults(problem)] == []


@pytest.mark.parametrize(
    ("form", "when"),
    [(["--attitude", "quaternion"], "q_2 - w"), (["--velocity", "tangent"], "A_12_dot - w")],
)
def test_names_of_another_form_of_the_state_are_not_told(told, tmp_path, form, when):
    text = f'{FILE}[[event]]\nname = "e"\nwhen = "{when}"\n'
    emit = ("emit", "--lang", "c", "--step", "gauss", "--out", str(tmp_path))
    assert told(text, *emit, *form) == (0, "")
    assert told(text, *emit)[0] == 2


@pytest.mark.parametrize("command", [["walk"], ["emit", "--out"]])
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[[event]]\nname = "e"\nwhen = "A_44 - w"\n', "event 1, when: the state has no A_44"),
        ('[[event]]\nname = "e"\nwhen = "u_4*t"\n', "event 1, when: the state has no u_4"),
        (
            "omega_3 = 1\n",
            "initial, omega_3: the state has no such number; did you mean 'zeta_3'?",
        ),
    ],
)
def test_a_command_that_derives_tells_them(told, tmp_path, command, text, words):
    folder = [str(tmp_path)] * (command[-1] == "--out")
    code, err = told(FILE + text, *command, *folder)
    assert (code, err) == (0, f"derive: warning: p.toml: {words}; {ENTRIES}\n")


def test_a_motion_refuses_them_in_one_line(told):
    code, err = told(f'{FILE}[[event]]\nname = "e"\nwhen = "A_44"\n', "simulate", "--t", "1")
    assert (code, err.count("\n")) == (2, 1)
    assert "event e: no 'A_44' in the state" in err


@pytest.mark.parametrize("when", ["A_33 - w", "zeta_1*u_2", "t - 1", "sin(pi*A_11)"])
def test_what_the_state_has_is_not_told(told, when):
    assert told(f'{FILE}[[event]]\nname = "e"\nwhen = "{when}"\n', "walk") == (0, "")
