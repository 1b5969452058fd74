"""What is wrong in a Lagrangian of one's own: one line that names the key and the remedy."""

import pytest

from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of

SQUARE = "zeta_1^2 + zeta_2^2 + zeta_3^2"
POINT = {"mass": 1, "at": [1, 0, 0]}
ONE = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
TABLES = {
    "no text": ({"L": 3}, "no coordinate of the velocity, as zeta_1"),
    "without Z": ({"L": "A_11"}, "no coordinate of the velocity, as zeta_1"),
    "no L": ({}, "lagrangian: key 'L' is missing"),
    "another key": ({"L": SQUARE, "l": 1}, "unknown key 'l' (known: L, trivialisation)"),
    "side": ({"L": SQUARE, "trivialisation": "lft"}, "did you mean 'left'?"),
    "a function": ({"L": SQUARE + " + sinn(t)"}, "unknown function 'sinn'"),
    "still": (
        {"L": "zeta_1^2 + 2*zeta_2^2"},
        "singular along E_3, and that is no symmetry of L: the equations leave this velocity open",
    ),
    "still but for the potential": (
        {"L": "zeta_1^2 + zeta_2^2 - A_31"},
        "singular along E_3, and that is no symmetry of L",
    ),
    "still together": (
        {"L": "(zeta_1 + zeta_2)^2 + zeta_3^2"},
        "singular along −E_1 + E_2, and that is no symmetry of L",
    ),
    "still here and there": (
        {"L": "(A_11*zeta_1 + A_12*zeta_2)^2 + zeta_3^2"},
        "singular, in directions that are not constant",
    ),
    "linear": ({"L": "zeta_1*A_11"}, "L is of first order in the velocities, which the kernel"),
    "first order": ({"L": "zeta_1*A_11 - A_12^2"}, "L is of first order in the velocities"),
    "linear beside": ({"L": "zeta_1^2 + zeta_2^2 + zeta_3"}, "along E_3, and L is linear there"),
    "another entry": ({"L": SQUARE + " + A_14"}, "SO(3) has no A_14; its entries"),
    "a translation": (
        {"L": SQUARE + " + T_1"},
        "lagrangian, key 'L': SO(3) has no T_1; its entries are A_11 … A_33, zeta_1 … zeta_3",
    ),
    "a letter of others": (
        {"L": "zeta_1^2 + zeta_2^2 + xi_3^2"},
        "'xi_3' is not declared; add it to [parameters]; the state has A_11 … A_33, zeta_1 …",
    ),
    "no entry at all": ({"L": SQUARE + " + A_1"}, "'A_1' is not declared"),
    "another coordinate": (
        {"L": SQUARE + " + zeta_4"},
        "SO(3) has no zeta_4; its entries are A_11 … A_33, zeta_1 … zeta_3",
    ),
    "a place": ({"L": SQUARE + " + r1_x"}, "r1_x"),
    "code": ({"L": "__import__('os')"}, "not part of an expression"),
}


@pytest.mark.parametrize("name", TABLES)
def test_lagrangian(name):
    table, said = TABLES[name]
    with pytest.raises(ProblemError) as error:
        problem_of({"name": "test", "group": "SO(3)", "lagrangian": table})
    assert said in str(error.value)
    assert "\n" not in str(error.value)


OPERATORS = {
    "no operator": ({}, "inertia: key 'operator' is missing"),
    "two rows": ({"operator": ONE[:2]}, "operator: expected a list of 3 rows"),
    "short": ({"operator": [[1, 0], [0, 1], [0, 0]]}, "row 1: expected a list of 3 expressions"),
    "skew": ({"operator": [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}, "must be symmetric"),
    "momentum": ({"operator": ONE, "momentum": [1]}, "momentum: expected a list of 3"),
    "degenerate": (
        {"operator": [[1, 0, 0], [0, 2, 0], [0, 0, 0]]},
        "singular along E_3, and that is no symmetry of L",
    ),
}


@pytest.mark.parametrize("name", OPERATORS)
def test_inertia(name):
    table, said = OPERATORS[name]
    with pytest.raises(ProblemError) as error:
        problem_of({"name": "test", "group": "SO(3)", "inertia": table})
    assert said in str(error.value)


OTHERS = {
    "points": ({"point": [POINT]}, "key 'point': [lagrangian] says all of L"),
    "potential": ({"potential": [{"kind": "gravity", "g": [0, 0, 1]}]}, "key 'potential'"),
    "both": ({"inertia": {"operator": ONE}}, "either [lagrangian] or [inertia]"),
    "any group": ({"group": "any", "action": "linear"}, "a text about any group has no Lagrangian"),
    "a force": ({"input": [{"name": "F", "kind": "force", "on": 1}]}, "an input is a covector"),
    "a taken name": ({"parameters": {"A_11": 1}}, "parameter 'A_11': an entry of the state"),
    "a name of another group's": (
        {"parameters": {"T_1": 1}, "lagrangian": {"L": SQUARE + "*T_1"}},
        "parameter 'T_1': SO(3) has no T_1; its entries are A_11 … A_33, zeta_1 … zeta_3; choose",
    ),
    "in a product": (
        {"group": "SO(2) x SE(2)", "parameters": {"zeta1_1": 1}},
        "no zeta1_1; its entries are A1_11 … A1_22, A2_11 … A2_22, T2_1 … T2_2, zeta_1 … zeta_4",
    ),
    "no table": ({"lagrangian": "zeta_1^2"}, "must be a table [lagrangian]"),
    "an input that nothing answers": (
        {
            "lagrangian": {"L": "zeta_1^2 + zeta_2^2"},
            "input": [{"name": "u", "kind": "covector"}],
        },
        "input 1: L has symmetries without kinetic energy",
    ),
    "a name of the text": ({"name": "left"}, "names what is said of any group"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_beside(name):
    more, said = OTHERS[name]
    data = {"name": "test", "group": "SO(3)", "lagrangian": {"L": SQUARE}} | more
    with pytest.raises(ProblemError) as error:
        problem_of(data)
    assert said in str(error.value)
