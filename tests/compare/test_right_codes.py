"""Right code, in any language, conventions and hand, is no false alarm (the list is
``right_codes.toml``), and a wrong convention is told."""

import os
from functools import cache
from pathlib import Path

import pytest

from derive.command.comparing import made
from derive.command.showing import load_problem
from derive.compare.comparison import comparison, reports
from derive.compare.user_states import WORDS
from tests.compare import codes, conventions
from tests.compare.codes import LISTED
from tests.support.library import module_of
from tests.support.needs import need

HERE = Path(__file__).parent
OURS = [
    (name, language, seed)
    for name, languages in LISTED["ours"].items()
    for language, seeds in languages.items()
    for seed in seeds
]
QUATERNIONS = [(name, x) for name, own in LISTED["quaternions"].items() for x in own]
NEEDS = {f"{x}_bodies.py": [f"the module {x}"] for x in ("pinocchio", "mujoco")}
OF_NAMES = ("hung_bar", "PLANE", "pendulum", "two_tops", "coupled", "sl3", "heisenberg")
"""Problems whose state has no blocks."""


@cache
def walked(path):
    """The program of a problem, walked once."""
    return made(load_problem(path), False)


def agreed(place, name, file, told):
    """What is said of a file beside a problem, in the conventions of a table."""
    problem, table = name, place / "as.toml"
    if name.isupper():
        problem = str(place.parent / f"{name}.toml")
        Path(problem).write_text(getattr(codes, name), encoding="utf-8")
    table.write_text(told, encoding="utf-8")
    once = lambda _, dynamics: walked(problem)  # noqa: E731
    return reports(comparison(load_problem(problem), once, file, "", table, 3, 6), once)


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
    choices = conventions.drawn(seed, code.STATE, code.INPUTS, blocks)
    file = conventions.written(tmp_path, text, language, choices)
    agrees, lines = agreed(tmp_path, name, file, conventions.table(choices, code.INPUTS))
    assert agrees, (choices, lines)


@pytest.mark.parametrize(("name", "language"), QUATERNIONS)
def test_ours_with_quaternions(name, language, tmp_path):
    code = module_of(name, attitude="quaternion")
    choices = conventions.drawn(0, code.STATE, code.INPUTS, False)
    choices["options"], choices["units"] = {"attitude": "quaternion"}, {}
    named = dict.fromkeys(x.split("_")[0] for x in code.STATE)
    own = {"q": ("quaternion", 4), "T": ("position", 3), "zeta": ("omega", 3)}
    state = [own.get(x, ("velocity", 3)) for x in named]
    choices |= {"state": state, "names": [x for x, _ in state]}
    file = conventions.written(tmp_path, name, language, choices)
    agrees, lines = agreed(tmp_path, name, file, conventions.table(choices, code.INPUTS))
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
    choices = conventions.drawn(seed, code.STATE, code.INPUTS)
    file = conventions.written(tmp_path, codes.DRONE, "python", choices)
    word = choices["said"][name][key]
    choices["said"][name][key] = next(x for x in WORDS[name][key] if x != word)
    agrees, lines = agreed(tmp_path, "DRONE", file, conventions.table(choices, code.INPUTS))
    assert not agrees
    assert f"  it agrees if {name} has {key} {word!r}" in lines


def test_there_are_many():
    """In every language, and by two simulators."""
    assert len({x[1] for x in OURS}) == 6
    assert len(OURS) + len(QUATERNIONS) + len(LISTED["others"]) >= 80
