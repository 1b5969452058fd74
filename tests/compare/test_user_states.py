"""Right code in other conventions is no false alarm, and a wrong convention is told."""

import json
import random
from pathlib import Path

import pytest

from derive.command.cli import main
from derive.command.comparing import made
from derive.command.showing import load_problem
from derive.compare.comparison import comparison, reports
from derive.compare.user_states import SIZES, WORDS
from tests.compare import codes

WRITTEN = Path(__file__).with_name("written_otherwise.py").read_text(encoding="utf-8")


KNOWN = {}


def once(problem, dynamics):
    """The one problem of this file is walked once."""
    assert not dynamics
    if not KNOWN:
        KNOWN[problem.name] = made(problem, dynamics)
    return KNOWN[problem.name]


def drawn(seed):
    """What someone may have chosen."""
    chosen = random.Random(seed)
    turned = ["quaternion", "euler", "matrix"][seed % 3]
    names = [turned, "position", "omega", "velocity"]
    chosen.shuffle(names)
    said = {x: {k: chosen.choice(y) for k, y in WORDS[x].items()} for x in names}
    units = {x: chosen.choice([1.0, 57.3, 0.001]) for x in names if x not in SIZES and x != "euler"}
    return {"state": [(x, SIZES.get(x, 3)) for x in names], "said": said, "units": units}


def table(choices):
    """The same as a table for ``--as``."""
    lines = ['call = "f(x, u) -> dx"', f"state = {json.dumps([x for x, _ in choices['state']])}"]
    lines += ["[units]", *(f"{x} = {y}" for x, y in choices["units"].items())]
    for name, words in choices["said"].items():
        lines += [f"[{name}]", *(f"{k} = {json.dumps(x)}" for k, x in words.items())]
    return "\n".join(lines)


def written(folder, choices):
    """The module, and ours beside it."""
    (folder / "problem.toml").write_text(codes.DRONE, encoding="utf-8")
    assert (
        main(["emit", str(folder / "problem.toml"), "--lang", "python", "--out", str(folder)]) == 0
    )
    (folder / "drone.py").rename(folder / "ours.py")
    text = WRITTEN.replace("CHOICES = None", f"CHOICES = {choices!r}")
    (folder / "users.py").write_text(text, encoding="utf-8")
    return load_problem(str(folder / "problem.toml"))


def held(problem, folder, told):
    (folder / "as.toml").write_text(told, encoding="utf-8")
    c = comparison(problem, once, folder / "users.py", "", folder / "as.toml", 3, 6)
    return reports(c, once)


@pytest.mark.parametrize("seed", range(24))
def test_right_code_in_other_conventions_agrees(seed, tmp_path, capsys):
    choices = drawn(seed)
    agrees, lines = held(written(tmp_path, choices), tmp_path, table(choices))
    assert agrees, (choices, lines)


@pytest.mark.parametrize(
    ("seed", "name", "key"),
    [
        (0, "quaternion", "order"),
        (0, "quaternion", "sense"),
        (1, "omega", "frame"),
        (2, "matrix", "order"),
    ],
)
def test_another_convention_is_told(seed, name, key, tmp_path, capsys):
    choices = drawn(seed)
    problem, word = written(tmp_path, choices), choices["said"][name][key]
    choices["said"][name][key] = next(x for x in WORDS[name][key] if x != word)
    agrees, lines = held(problem, tmp_path, table(choices))
    assert not agrees
    assert f"  it agrees if {name} has {key} {word!r}" in lines
