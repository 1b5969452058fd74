"""Right code, in any language, conventions and hand, is no false alarm (the list is
``right_codes.toml``), and a wrong convention is told.

Conventions that someone may have chosen are drawn at random, and our code is written in them.
"""

import json
import os
import random
import shutil
from functools import cache
from pathlib import Path

import pytest

from derive.command.showing import load_problem
from derive.command.simulating import made
from derive.compare.comparison import comparison, reports
from derive.compare.user_states import SIZES, WORDS, kind_of
from tests.compare import codes
from tests.compare.codes import LISTED
from tests.support.library import ONE_BUILD, library, module_of
from tests.support.needs import need

WRITTEN = Path(__file__).with_name("written_otherwise.py")
UNITS = (1.0, 57.3, 0.001)


def drawn(seed, state, inputs=(), in_blocks=True):
    """What someone may have chosen of a state by our names; ``in_blocks``: of a rotation, and
    maybe of a place."""
    chosen = random.Random(seed)
    names = [*state]
    if in_blocks:
        names = []
        for i, mark in enumerate(("1", "2") if "A2_11" in state else ("",)):
            moving = ["position", "velocity"] * (f"T{mark}_1" in state)
            own = [["quaternion", "euler", "matrix"][(seed + i) % 3], "omega", *moving]
            names += [x + mark for x in own]
    chosen.shuffle(names)
    said = {x: WORDS[kind_of(x)] for x in names if kind_of(x)}
    said = {x: {k: chosen.choice(y) for k, y in words.items()} for x, words in said.items()}
    plain = [x for x in names if kind_of(x) not in (*SIZES, "euler")]
    units = {x: chosen.choice(UNITS) for x in plain if in_blocks or not x.startswith("A")}
    order = [*range(len(inputs))]
    chosen.shuffle(order)
    sizes = [(x, SIZES.get(kind_of(x), 3) if kind_of(x) else 1) for x in names]
    found = {"state": sizes, "said": said, "units": units, "inputs": order, "options": {}}
    return found | {"names": [*state]}


def table(choices, inputs=()):
    """The same as a table for ``--as``."""
    state, order = [x for x, _ in choices["state"]], [inputs[i] for i in choices["inputs"]]
    lines = ['call = "f(t, x, u) -> dx"', f"state = {json.dumps(state)}"]
    lines += [f"inputs = {json.dumps(order)}"] * bool(order)
    lines += ["[units]", *(f"{x} = {y}" for x, y in choices["units"].items())]
    for name, words in choices["said"].items():
        lines += [f"[{name}]", *(f"{k} = {json.dumps(x)}" for k, x in words.items())]
    return "\n".join(lines)


def written(folder, problem, language, choices):
    """Our code of a problem, a name or a text, in these conventions: a file."""
    build = ONE_BUILD[language]
    library(build, problem, **choices["options"])  # kept on the disk for the process of the code
    defaults = module_of(problem).DEFAULTS
    said = {"BUILD": build, "PROBLEM": problem, "CHOICES": choices}
    said["DEFAULTS"] = [*defaults.values()]
    lines = [f"{name} = {x!r}" for name, x in said.items()]
    (folder / "choices.py").write_text("\n".join(lines), encoding="utf-8")
    return shutil.copy(WRITTEN, folder / "users.py")


# ---------------------------------------------------------------- comparisons

HERE = Path(__file__).parent
OURS = [
    (name, language, seed)
    for name, languages in LISTED["ours"].items()
    for language, seeds in languages.items()
    for seed in seeds
]
QUATERNIONS = [(name, x) for name, own in LISTED["quaternions"].items() for x in own]
NEEDS = {f"{x}_bodies.py": [f"the module {x}"] for x in ("pinocchio", "mujoco")}
OF_NAMES = ("hung_bar", "PLANE", "pendulum", "coupled", "sl3", "heisenberg")
"""Problems whose state has no blocks."""


@cache
def walked(path):
    """The program of a problem, walked once."""
    return made(load_problem(path), False)


def agreed(place, name, file, told):
    """What is said of a file beside a problem, in the conventions of a table."""
    problem, path = name, place / "as.toml"
    if name.isupper():
        problem = str(place.parent / f"{name}.toml")
        Path(problem).write_text(getattr(codes, name), encoding="utf-8")
    path.write_text(told, encoding="utf-8")
    once = lambda _, dynamics: walked(problem)  # noqa: E731
    return reports(comparison(load_problem(problem), once, file, "", path, 3, 6), once)


@pytest.fixture(autouse=True)
def found_from_here(monkeypatch):
    """The process of a code finds what this one does."""
    paths = [str(HERE.parents[1]), os.environ.get("PYTHONPATH", "")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))


@pytest.mark.parametrize(("name", "language", "seed"), OURS)
def test_ours_in_any_conventions(name, language, seed, tmp_path):
    text = getattr(codes, name, name)
    code = module_of(text)
    blocks = name not in OF_NAMES
    choices = drawn(seed, code.STATE, code.INPUTS, blocks)
    file = written(tmp_path, text, language, choices)
    agrees, lines = agreed(tmp_path, name, file, table(choices, code.INPUTS))
    assert agrees, (choices, lines)


@pytest.mark.parametrize(("name", "language"), QUATERNIONS)
def test_ours_with_quaternions(name, language, tmp_path):
    code = module_of(name, attitude="quaternion")
    choices = drawn(0, code.STATE, code.INPUTS, False)
    choices["options"], choices["units"] = {"attitude": "quaternion"}, {}
    named = dict.fromkeys(x.split("_")[0] for x in code.STATE)
    own = {"q": ("quaternion", 4), "T": ("position", 3), "zeta": ("omega", 3)}
    state = [own.get(x, ("velocity", 3)) for x in named]
    choices |= {"state": state, "names": [x for x, _ in state]}
    file = written(tmp_path, name, language, choices)
    agrees, lines = agreed(tmp_path, name, file, table(choices, code.INPUTS))
    assert agrees, lines


@pytest.mark.parametrize("name", LISTED["others"])
def test_codes_of_others(name, tmp_path):
    told = LISTED["others"][name]
    file = HERE / "right" / told["file"] if "file" in told else None
    if file:
        need(*NEEDS.get(file.name, ()))
    else:
        text = getattr(codes, f"{told['problem']}_CODE").replace("STEINER", "1")
        file = tmp_path / ("users.c" if "#include" in text else "users.py")
        file.write_text(text, encoding="utf-8")
    agrees, lines = agreed(tmp_path, told["problem"], file, told["as"])
    assert agrees, lines


@pytest.mark.parametrize(
    ("seed", "name", "key"),
    [
        (0, "quaternion", "order"),
        (0, "quaternion", "sense"),
        (1, "omega", "frame"),
        (2, "matrix", "order"),
    ],
)
def test_another_convention_is_told(seed, name, key, tmp_path):
    code = module_of(codes.DRONE)
    choices = drawn(seed, code.STATE, code.INPUTS)
    file = written(tmp_path, codes.DRONE, "python", choices)
    word = choices["said"][name][key]
    choices["said"][name][key] = next(x for x in WORDS[name][key] if x != word)
    agrees, lines = agreed(tmp_path, "DRONE", file, table(choices, code.INPUTS))
    assert not agrees
    assert f"  it agrees if {name} has {key} {word!r}" in lines


def test_there_are_many():
    """In every language, and by two simulators."""
    assert len({x[1] for x in OURS}) == 6
    assert len(OURS) + len(QUATERNIONS) + len(LISTED["others"]) >= 80
