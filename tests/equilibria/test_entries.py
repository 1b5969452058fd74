"""Which entries of g are those of an element: beside samples of the groups and matrices by hand."""

from fractions import Fraction
from itertools import product
from random import Random

import numpy as np
import pytest

from derive import ProblemError
from derive.algebra.families import group
from derive.algebra.groups import constant_entries
from derive.check.claims.entries_checked import decided as checked
from derive.language.univariate import root
from derive.record.sentence import english
from derive.search.equilibria.entries_of_elements import conditions
from derive.search.equilibria.equilibrium_points import About, attained, off_the_group
from derive.search.integrals.reduced import without_energy
from derive.searches import equilibria
from tests.support.lagrangians import LINE, LINES, LORENTZ, lagrangian, squares


def decider(problem):
    """Has an element such entries, "yes", "no" or "open", as the search and as the checker say: a
    function of entries by their places from 1; others are as at 1.  What no element varies is no
    variable."""
    system, constant = without_energy(problem), constant_entries(problem.group)
    on = conditions(system, problem.group, left=problem.lagrangian.trivialisation == "left")

    def decided(entries):
        known = {x: constant.get((x[0] - 1, x[1] - 1), y) for x, y in entries.items()}
        if known != entries:
            return "no"
        at = [
            Fraction(0) if x[1] == "Π" else entries.get(x[2:], Fraction(int(x[2] == x[3])))
            for x in system.variables
        ]
        about = About(system, (*at,))
        found = "no" if off_the_group(about, (), on) else "yes" if attained(about, on) else "open"
        pairs = zip(system.variables, at, strict=True)
        places = {(x[2] - 1, x[3] - 1): y for x, y in pairs if x[1] == "A"}
        assert checked(problem.group, places) == found
        return found

    return decided


def with_entries(name, places, side="left"):
    """A problem on a group whose Lagrangian has entries of g."""
    d = len(name["basis"]) if isinstance(name, dict) else group(name).dimension
    letter = "A1" if " x " in str(name) else "A"
    L = squares(*range(1, d + 1)) + "".join(f" - {letter}_{i}{j}" for i, j in places)
    return lagrangian(L, name, side=side)


def entries_of(matrix, lines=None):
    """The entries of the rows (columns) with these numbers from 1, or of all, by their places."""
    n = len(matrix)
    return {
        (i, j): Fraction(matrix[i - 1][j - 1])
        for i, j in product(range(1, n + 1), repeat=2)
        if lines is None or i in lines or j in lines
    }


NAMED = (
    *("SO(2)", "SO(3)", "SO(4)", "SE(2)", "SE(3)", "SL(2)", "SL(3)", "SAff(2)", "GL(2)", "GL(3)"),
    *("Aff(2)", "Sp(2)", "Sp(4)", "Sim(2)", "Sim(3)", "UT(3)", "UT(4)", "U(1)", "U(2)", "SU(2)"),
    *("SO(3) x SE(2)", "SL(2) x SO(3)"),
)


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("name", NAMED)
def test_elements_are_elements(name, side):
    g, random = group(name), Random(name + side)
    for lines in ((1,), (1, 2)):
        places = [(k, 1) if side == "left" else (1, k) for k in lines]
        decided = decider(with_entries(name, places, side))
        for _ in range(4):
            assert decided(entries_of(g.sample(random, 3))) == "yes"


def orthogonal(a):
    return np.allclose(a @ a.T, np.eye(len(a))) and np.linalg.det(a) > 0


def unimodular(a):
    return abs(np.linalg.det(a) - 1) < 1e-9


J = np.array([[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, 0, 0], [0, -1, 0, 0]])
FULL = {
    "SO(2)": orthogonal,
    "SO(3)": orthogonal,
    "SL(2)": unimodular,
    "GL(2)": lambda a: abs(np.linalg.det(a)) > 1e-9,
    "Sp(4)": lambda a: np.allclose(a.T @ J @ a, J),
    "UT(3)": lambda a: np.allclose(np.tril(a), np.eye(3)),
    "U(2)": lambda a: orthogonal(a) and np.allclose(J @ a, a @ J),
}


@pytest.mark.parametrize("name", FULL)
def test_whole_matrices(name):
    """All entries of one matrix after another: elements, signed permutations, and others."""
    g, random = group(name), Random(name)
    n, counts = g.n, {"yes": 0, "no": 0}
    places = product(range(1, n + 1), repeat=2)
    decided = decider(with_entries(name, places))
    for _ in range(40):
        a = [[*row] for row in g.sample(random, 2)]
        if random.random() < 0.5:
            places = random.sample(range(n), n)
            a = [[random.choice([1, -1]) * int(j == k) for j in range(n)] for k in places]
        if random.random() < 0.4:
            a[random.randrange(n)][random.randrange(n)] += random.choice([1, -1, 2])
        if random.random() < 0.2:
            a[random.randrange(n)] = [0] * n
        found = decided(entries_of(a))
        assert found == ("yes" if FULL[name](np.array(a, float)) else "no"), a
        counts[found] += 1
    assert min(counts.values()) > 4


def row(*numbers):
    return {(1, j): Fraction(x) for j, x in enumerate(numbers, 1)}


ROWS = {
    ("SL(2)", (0, 0)): "no",
    ("SL(3)", (0, 0, 0)): "no",
    ("SL(3)", (0, -2, 0)): "yes",
    ("GL(2)", (0, 0)): "no",
    ("GL(2)", (-3, 0)): "yes",
    ("Sp(4)", (0, 0, 0, 0)): "no",
    ("Sp(4)", (0, 7, 0, 0)): "yes",
    ("SO(3)", (1, 1, 0)): "no",
    ("SO(3)", (-1, 0, 0)): "yes",
    ("Sim(3)", (-2, 1, 0)): "yes",
    ("Sim(3)", (0, 0, 0)): "no",
    ("SU(2)", (0, 0, 1, 0)): "yes",
    ("SU(2)", (0, 0, 2, 0)): "no",
    ("SAff(3)", (0, 0, 0)): "no",
}


@pytest.mark.parametrize(("name", "numbers"), ROWS)
def test_a_row(name, numbers):
    assert decider(with_entries(name, [(1, 1)]))(row(*numbers)) == ROWS[name, numbers]


def test_a_row_with_a_root():
    decided = decider(with_entries("SO(3)", [(1, 1)]))
    half = root(Fraction(1, 2))
    assert decided({(1, 1): half, (1, 2): -half, (1, 3): Fraction(0)}) == "yes"
    assert decided({(1, 1): half, (1, 2): half * half, (1, 3): Fraction(0)}) == "no"


STATED = {
    "stretches of R": {"name": "Stretch", "basis": [[[1, 0], [0, 1]]]},
    "a spiral": {"name": "Spiral", "basis": [[[1, -1], [1, 1]]]},
    "a line": LINE,
    "two lines": LINES,
    "triangular": {
        "name": "B2",
        "basis": [[[1, 0], [0, 0]], [[0, 1], [0, 0]], [[0, 0], [0, 1]]],
    },
    "Lorentz": LORENTZ,
    "moment curve": {
        "name": "Curve",
        "basis": [[[0, 1, 0], [0, 0, 1], [0, 0, 0]]],
    },
}
AT = [
    ("stretches of R", {(1, 1): 0}, "no"),
    ("stretches of R", {(1, 1): 2}, "yes"),
    ("stretches of R", {(1, 1): -1}, "no"),
    ("stretches of R", {(1, 1): root(2)}, "yes"),
    ("stretches of R", {(1, 1): 1 - root(2)}, "no"),
    ("a spiral", {(1, 1): 0, (1, 2): 0}, "no"),
    ("a spiral", {(1, 1): 1, (1, 2): 0}, "yes"),
    ("a spiral", {(1, 1): 1, (1, 2): 5}, "open"),
    ("a line", {(1, 1): 0}, "no"),
    ("a line", {(1, 1): 3}, "yes"),
    ("a line", {(1, 1): -3}, "no"),
    ("two lines", {(1, 1): 3}, "yes"),
    ("two lines", {(1, 1): 0}, "no"),
    ("triangular", {(1, 1): 5}, "yes"),
    ("triangular", {(1, 1): -5}, "no"),
    ("Lorentz", {(3, 3): 1}, "yes"),
    ("Lorentz", {(3, 3): 2}, "no"),
    ("Lorentz", {(3, 3): -1}, "open"),
    ("moment curve", {(1, 1): 1, (1, 2): 3, (1, 3): Fraction(9, 2)}, "yes"),
    ("moment curve", {(1, 1): 1, (1, 2): 3, (1, 3): 1}, "no"),
    ("moment curve", {(1, 1): 2}, "no"),
]


@pytest.mark.parametrize(("name", "entries", "expected"), AT)
def test_a_group_by_a_basis(name, entries, expected):
    decided = decider(with_entries(STATED[name], [max(entries)]))
    found = decided({x: y + Fraction(0) for x, y in entries.items()})
    assert found == expected


SL2 = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - (A_11^2 + A_12^2)"


def test_no_motion_is_told_at_what_no_element_has():
    """At A₁₁ = A₁₂ = 0 nothing moves in the reduced equations, and there is no such g."""
    problem = lagrangian(SL2, "SL(2)")
    for values in ({"A_11": Fraction(0)}, {"Pi_1": Fraction(1)}):
        with pytest.raises(ProblemError, match="row 1 of g would be 0"):
            equilibria(problem, values)
    found, _ = equilibria(problem, {})
    assert found == ()


def test_what_is_not_decided_is_said():
    """A boost in space–time, whose time may not run backwards: of the sheet nothing is proved."""
    L = "zeta_1^2 + zeta_2^2 + 3*zeta_3^2 - A_33"
    problem = lagrangian(L, LORENTZ)
    forwards, backwards = (equilibria(problem, {"A_33": Fraction(x)}) for x in (1, -1))
    assert [x.verdict for x in (*forwards[0], *backwards[0])] == ["stable", "open"]
    said = [english(record.steps[-1].prose) for _, record in (forwards, backwards)]
    assert ["is not decided" in x for x in said] == [False, True]
    assert not any(x in said[1] for x in ("stable", "unstable", "imaginary"))
