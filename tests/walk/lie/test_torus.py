"""Zeitlin's model: its steps hold modulo primes, every change of them is refused, and the files."""

from dataclasses import replace
from functools import cache

import pytest

from derive.check.checker import Checker, check
from derive.command.cli import main
from derive.language.read import read
from derive.language.show import show
from derive.language.tree import mul
from derive.pipeline import walk
from derive.problem.toml import ProblemError, problem_of
from derive.record.contract import ANY_GROUP
from derive.record.json_reader import from_json
from derive.record.json_writer import to_json
from derive.record.record import Equation
from tests.support.record_mutations import tried
from tests.support.walks import SEED


@cache
def record(N):
    algebra, inertia = {"of": "torus", "N": N}, {"operator": "laplacian"}
    return walk(problem_of({"name": "fluid", "algebra": algebra, "inertia": inertia}))


@cache
def own(N):
    return tuple(s for s in record(N).steps if s.scope != ANY_GROUP)


@cache
def checker(N):
    return Checker(record(N).problem, SEED)


@pytest.mark.parametrize("N", [3, 9, 13])
def test_every_step_holds(N):
    assert checker(N).symbols(record(N)).holds
    for step in own(N):
        verdict = checker(N).check(step)
        assert verdict.holds, verdict
        assert verdict.bound < 1e-30


def test_the_whole_record_holds_and_is_read_back():
    again = from_json(to_json(record(5)))
    assert again.steps == record(5).steps
    assert all(v.holds for v in check(again, SEED))


def test_the_equations_are_those_of_any_size():
    for three, seven in zip(own(3), own(7), strict=True):
        assert len(three.equations) == len(seven.equations)
        assert len(show(three.equations[0].rhs)) <= len(show(seven.equations[0].rhs))


def test_formulas_are_read_back():
    for step in own(7):
        for e in step.equations:
            assert [read(show(x)) for x in (e.lhs, e.rhs)] == [e.lhs, e.rhs]


@pytest.mark.parametrize("k", range(len(own(3))))
def test_every_change_is_refused(k):
    found = list(tried(own(3)[k], checker(3)))
    assert found
    for kind, wrong, verdict in found:
        assert not verdict.holds, (kind, wrong)
        assert verdict.reason


def changed(label, number, new):
    step = record(7)[label]
    equations = list(step.equations)
    equations[number] = new(equations[number])
    return checker(7).check(replace(step, equations=tuple(equations)))


FALSE = {
    "the other orientation": ("fluid.motion", 0, ("𝐦", "𝐧"), ("𝐧", "𝐦")),
    "another N": ("fluid.motion", 0, 7, 9),
    "cos for sin": ("fluid.algebra", 0, "sin", "cos"),
    "another place": ("fluid.algebra", 0, ("add", "𝐦", "𝐧"), ("add", "𝐧", ("mul", -1, "𝐦"))),
    "the conjugate": ("fluid.lagrangian", 0, ("mul", -1, "𝐧"), "𝐧"),
    "P for W": ("fluid.coadjoint", 0, "P", "W"),
}


@pytest.mark.parametrize("name", FALSE)
def test_false_equations_are_refused(name):
    label, number, old, new = FALSE[name]

    def put(t):
        if isinstance(old, tuple) and old == ("𝐦", "𝐧"):
            if isinstance(t, tuple) and t[0] == "wedge":
                return ("wedge", *t[:0:-1])
        elif t == old:
            return new
        return (t[0], *map(put, t[1:])) if isinstance(t, tuple) else t

    verdict = changed(label, number, lambda e: Equation(e.lhs, put(e.rhs)))
    assert not verdict.holds


def test_what_is_true_in_another_form_holds():
    """The checker compares values, not trees: n ∧ m with the other sign."""

    def turned(e):
        unit, total = e.rhs[1:-1], e.rhs[-1]
        swapped = put_wedge(total)
        return Equation(e.lhs, mul(-1, *unit, swapped))

    def put_wedge(t):
        if isinstance(t, tuple) and t[0] == "wedge":
            return ("wedge", *t[:0:-1])
        return (t[0], *map(put_wedge, t[1:])) if isinstance(t, tuple) else t

    assert changed("fluid.motion", 0, turned).holds


def test_a_record_of_another_group_is_refused():
    d = record(5)
    for key, value in (("group", "SU(7)"), ("n", 7), ("torus", {"N": 7})):
        wrong = replace(d, problem={**d.problem, key: value})
        assert not all(v.holds for v in check(wrong, SEED))


BAD = {
    "N = 4": "even",
    "N = 1": "3",
    "N = 103": "101",
    'N = "x"': "N",
    "": "missing",
    "N = 5\ndimension = 3": "unknown key",
}


@pytest.mark.parametrize("given", BAD)
def test_bad_sizes_are_one_line(given, tmp_path, capsys):
    path = tmp_path / "bad.toml"
    text = f'name = "bad"\n[algebra]\nof = "torus"\n{given}\n[inertia]\noperator = "laplacian"\n'
    path.write_text(text, encoding="utf-8")
    assert main(["walk", str(path)]) == 2
    err = capsys.readouterr().err
    assert BAD[given] in err
    assert "bad.toml" in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize(
    "other",
    [
        {"group": "SO(3)"},
        {"point": []},
        {"parameters": {"a": 1}},
        {"inertia": {"operator": [[1]]}},
        {"inertia": {"operator": "laplace"}},
        {"inertia": {"operator": "laplacian", "trivialisation": "left"}},
        {"name": "right"},
    ],
    ids=str,
)
def test_what_else_a_file_says_is_refused(other):
    given = {
        "name": "bad",
        "algebra": {"of": "torus", "N": 5},
        "inertia": {"operator": "laplacian"},
    }
    with pytest.raises(ProblemError):
        problem_of(given | other)


def test_without_inertia():
    with pytest.raises(ProblemError, match="laplacian"):
        problem_of({"name": "bad", "algebra": {"of": "torus", "N": 5}})
