"""Problems whose integrals are not searched: one line that says why, and the exit code 2."""

import re

import pytest

from derive.command.cli import main
from derive.language.limits import LISTENER
from derive.problem.toml import load, problem_of
from derive.search.integrals import all_integrals
from derive.search.integrals.all_integrals import found
from derive.search.integrals.degree_search import TooLargeError
from derive.search.integrals.integral_steps import first_integrals
from derive.search.integrals.reduced import NotReducedError, reduced
from tests.support.lagrangians import lagrangian

SQUARE = "zeta_1^2 + zeta_2^2 + zeta_3^2"
LAGRANGIANS = {
    "the time": (SQUARE + " - t*A_33", "depends on the time"),
    "a metric that changes": ("(2 + A_33)*zeta_1^2 + zeta_2^2 + zeta_3^2", "depends on g"),
    "a fourth power": (SQUARE + " + zeta_1^4", "is not quadratic"),
    "a cube": (SQUARE + " + zeta_1^2*zeta_2", "is not quadratic"),
    "a function": (SQUARE + " - sin(A_33)", "a function, sin"),
    "a quotient": (SQUARE + " - 1/(2 + A_33)", "is no polynomial"),
    "a negative power": (SQUARE + " - (2 + A_33)^-2", "is no polynomial"),
}


@pytest.mark.parametrize("name", LAGRANGIANS)
def test_a_lagrangian(name):
    L, said = LAGRANGIANS[name]
    with pytest.raises(NotReducedError, match=said) as error:
        reduced(lagrangian(L))
    assert "\n" not in str(error.value)


def test_a_degree_that_is_too_large():
    with pytest.raises(TooLargeError, match="unknowns; at most"):
        found(reduced(lagrangian(SQUARE, parameters="")), 2000)


def test_a_group_with_too_many_variables():
    with pytest.raises(NotReducedError, match="variables in the reduced equations; at most"):
        reduced(problem_of({"name": "x", "group": "GL(7)", "lagrangian": {"L": squares(49)}}))


def squares(n):
    return " + ".join(f"zeta_{a}^2" for a in range(1, n + 1))


WIDE = (
    "zeta_1^2 + 2*zeta_2^2 + 3/2*zeta_3^2 + zeta_4^2 + zeta_5^2/2 + 3*zeta_6^2 + zeta_1*zeta_5/3"
    " + zeta_1*zeta_2/5 + zeta_2*zeta_3/7 + zeta_1*zeta_4/4 + zeta_3*zeta_6/2 + zeta_2*zeta_4/9"
    " - 2*T_3 - A_33*T_2 - A_31*A_22 - T_3^2 - A_31 - A_23*T_3"
)


def test_a_degree_that_code_does_not_wait_for(tmp_path, capsys):
    """Two rows of an element of SE(3), of 14 variables: degree 4 has thousands of monomials."""
    path = tmp_path / "wide.toml"
    path.write_text(f'name = "wide"\ngroup = "SE(3)"\n[lagrangian]\nL = "{WIDE}"\n')
    assert main(["emit", str(path), "--conserved", "--out", str(tmp_path)]) == 0
    first, *others = capsys.readouterr().err.splitlines()
    assert re.fullmatch(
        r"derive: note: wide: integrals of degree 4 are not sought, \d{4} unknowns in one linear "
        "system; derive integrals seeks them",
        first,
    )
    assert not others
    told = []
    before = LISTENER.set(told.append)
    assert [*first_integrals(load(path))] == ["energy", *(f"casimir_{k}" for k in range(1, 5))]
    LISTENER.reset(before)
    assert [x.partition(",")[0] for x in told] == ["wide: integrals of degree 4 are not sought"]


def test_a_word_while_it_works(monkeypatch, capsys):
    monkeypatch.setattr(all_integrals, "LONG", 10)
    assert main(["integrals", "lagrange_top"]) == 0
    told = capsys.readouterr().err.splitlines()
    assert re.fullmatch(
        r"derive: note: Casimirs of degree \d are sought: \d\d unknowns in one linear system",
        told[0],
    )
    assert any(x.startswith("derive: note: integrals of degree 4 are sought: ") for x in told)
