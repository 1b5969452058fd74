"""Entries of g that are one number in all of a group are numbers: in what is refused, in what is
shown, and in what is kept; against elements made by exponentials."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.linalg import expm

import derive
from derive.language.tree import nodes
from derive.problem.entries_on_orbit import element, null_directions
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of

ENGEL = [
    [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
    [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]],
    [[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0]],
    [[0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
]
TURN = [[[0, -1, 0], [1, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 0], [0, 0, 2]]]
SCREW = [[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 2], [0, 0, 0, 0]]]
GROUPS = {
    "Engel": ({"name": "Engel", "basis": ENGEL}, 4),
    "Turn": ({"name": "Turn", "basis": TURN}, 2),
    "Screw": ({"name": "Screw", "basis": SCREW, "action": "affine"}, 1),
    "UT(3)": ("UT(3)", 3),
    "SE(2)": ("SE(2)", 3),
    "SL(2) x UT(3)": ("SL(2) x UT(3)", 6),
}
LAGRANGIANS = {
    "Engel": "A_44^2*{} - A_13*A_23 - A_14*A_24*A_44 - A_43*A_14",
    "Turn": "{} - A_33*A_11*A_32 - A_12*A_33^2",
    "UT(3)": "A_11*{} - A_13*A_22/A_33",
}


def derived(name, L="{}"):
    """The record of a Lagrangian with the square of the velocity in the place of {}."""
    group, d = GROUPS[name]
    square = "(" + " + ".join(f"zeta_{a}^2" for a in range(1, d + 1)) + ")/2"
    table = {"name": "test", "group": group, "lagrangian": {"L": L.format(square)}}
    return derive.derive(problem_of(table))


def drawn(group, count=8):
    """Elements of a group, (count, size, size)."""
    rng, basis = np.random.default_rng(1), np.array(group.basis, float)
    coordinates = rng.normal(size=(count, 2, len(basis)))
    factors = expm(np.tensordot(coordinates, basis, 1))
    return factors[:, 0] @ factors[:, 1]


@pytest.mark.parametrize("name", GROUPS)
def test_entries_are_numbers_where_they_never_vary(name):
    group = derived(name).problem.group
    g = drawn(group)
    still = np.ptp(g, axis=0) < 1e-9
    for i, row in enumerate(element(group)):
        for j, x in enumerate(row):
            assert isinstance(x, tuple) != still[i, j]
            assert isinstance(x, tuple) or abs(float(x) - g[0, i, j]) < 1e-9


@pytest.mark.parametrize("name", LAGRANGIANS)
def test_such_entries_are_not_shown(name):
    d = derived(name, LAGRANGIANS[name])
    still = np.ptp(drawn(d.problem.group), axis=0) < 1e-9
    own = [s for s in d.record.steps if s.label.startswith("test.")]
    named = {x for s in own for e in s.equations for t in (e.lhs, e.rhs) for x in nodes(t)}
    entries = {x[2:] for x in named if isinstance(x, tuple) and x[:2] == ("entry", "A")}
    assert entries
    assert not any(still[i - 1, j - 1] for i, j in entries)
    assert all(v.holds for v in d.check(seed=1))


def test_what_does_not_change_is_no_force():
    """Π_o is kept where L̃ has no entry of g that varies, and E_2 is a symmetry of A_23 on UT(3)."""
    d = derived("UT(3)", "{} - A_33 - 2*A_21^2")
    kept = next(s for s in d.record.steps if s.label == "test.conserved")
    assert "Π̇_o" in [e.lhs for e in kept.equations]
    still = {"name": "test", "group": "UT(3)"}
    still |= {"lagrangian": {"L": "(zeta_1^2 + zeta_3^2)/2 - A_23"}}
    assert problem_of(still).lagrangian.held == (2,)
    assert all(v.holds for v in derive.derive(problem_of(still)).check(seed=1))


TWICE = {"name": "Twice", "basis": [np.diag([1, 0, 1]).tolist(), np.diag([0, 1, 0]).tolist()]}
RELATED = {
    "the same factor twice": (TWICE, "zeta_2^2/2 + sin(A_33) - sin(A_11) - A_22", (1,)),
    "a turn": ("SE(2)", "(zeta_2^2 + zeta_3^2)/2 - (A_11 - A_22)", (1,)),
    "a column": ("SO(3)", "(zeta_2^2 + zeta_3^2)/2 - A_11^2 - A_21^2 - A_31^2", (1,)),
}


@pytest.mark.parametrize("name", RELATED)
def test_what_the_group_relates_is_no_force(name):
    """A symmetry where entries tell each other: A_33 = A_11, A_22 = A_11, or a column is a unit."""
    group, L, held = RELATED[name]
    d = derive.derive(problem_of({"name": "test", "group": group, "lagrangian": {"L": L}}))
    assert d.problem.lagrangian.held == held
    assert all(v.holds for v in d.check(seed=1))


def test_the_other_momentum_is_kept_by_what_the_group_relates():
    for group, L, kept in (
        ("SE(2)", "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2)/2 - (A_11 - A_22)", True),
        ("SE(2)", "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2)/2 - (A_11 + A_22)", False),
        ("SO(3)", "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2)/2 - A_11^2 - A_21^2 - A_31^2", True),
    ):
        d = derive.derive(problem_of({"name": "test", "group": group, "lagrangian": {"L": L}}))
        step = next(s for s in d.record.steps if s.label == "test.conserved")
        assert ("Π̇_o" in [e.lhs for e in step.equations]) is kept
        assert all(v.holds for v in d.check(seed=1))


def test_division_by_an_entry_that_is_0_is_told():
    with pytest.raises(ProblemError, match="divides by an entry of g that is 0 on UT"):
        derived("UT(3)", "{} - 1/A_21")


def test_null_directions_are_those_that_are_null_everywhere():
    """Fractions of small numbers; of what varies, or is longer, none is told."""
    a, half = ("par", "a"), Fraction(-3, 2)
    assert null_directions([[4, 6], [6, 9]]) == ((half, 1),)
    assert null_directions([[("mul", 4, a), ("mul", 6, a)], [6, 9]]) == ((half, 1),)
    assert null_directions([[1, 0], [0, a]]) == ()
    assert null_directions([[1, a], [a, ("pow", a, 2)]]) is None
    assert null_directions([[1, 10**6], [10**6, 10**12]]) == ((-(10**6), 1),)
    assert null_directions([[1, 10**6 + 1], [1, 10**6 + 1]]) is None
