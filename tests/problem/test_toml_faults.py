"""A text that is not TOML is told at its line, with what to write instead."""

import pytest

from derive.problem.problem import ProblemError
from derive.problem.toml import load

FAULTS = [
    ("name = drone\n", 1, 'stands in quotes: "drone"'),
    ('name = "a"\nat = [l, 0, 0]\n', 2, 'stands in quotes: "l"'),
    ("at = [0, -l, 0]\n", 1, 'stands in quotes: "-l"'),
    ("mass = 2*m\n", 1, 'stands in quotes: "2*m"'),
    ("at = [1, 2*k]\n", 1, 'stands in quotes: "2*k"'),
    ("name = “drone”\n", 1, "“ is a curly quote"),
    ('name = "drone”\n', 1, "” is a curly quote"),
    ("name = ‘drone’\n", 1, "‘ is a curly quote"),
    ('name = "a"\nm1 = 1,5\n', 2, "a decimal point, not a comma: 1.5"),
    ("[parameters]\nm = { default = 1,5 }\n", 2, "a decimal point, not a comma: 1.5"),
    ("m = -9,81 # down\n", 1, "a decimal point, not a comma: -9.81"),
    ('name =\u00a0"a"\n', 1, "a no-break space (U+00A0)"),
    ('\u00a0name = "a"\n', 1, "a no-break space (U+00A0)"),
    ("m = −1\n", 1, "− is not the minus sign"),
    ('name = "a"\n\n[ini', 3, "a table is written [name]"),
    ("[[point]\n", 1, "one of a list of tables [[name]]"),
    ("m = .5\n", 1, "both sides of the point: 0.5"),
    ("m = 5.\n", 1, "both sides of the point: 5.0"),
    ("m = \n", 1, "a value is missing"),
    ("at = [0, 1\n\n", 1, "a list ends with ]"),
    ('name = "a\n', 1, "ends with the quote"),
    ("// a drone\n", 1, "a comment begins with #"),
    ('name: "a"\n', 1, "not by :"),
    ("masse_é = 1\n", 1, "names have the letters A to Z"),
]


@pytest.mark.parametrize(("text", "line", "told"), FAULTS, ids=range(len(FAULTS)))
def test_the_line_and_the_remedy(tmp_path, text, line, told):
    path = tmp_path / "a.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ProblemError) as error:
        load(path)
    said = str(error.value)
    assert ": not TOML: " in said
    assert f"(at line {line}, column " in said
    assert told in said
    assert "\n" not in said


@pytest.mark.parametrize(
    "text", ['title = "« a “b” »"\nm = = 1\n', "at = [1,5\n", 'a = 3 "b"\n', "m = 1.5.2\n"]
)
def test_what_is_not_known_is_not_guessed(tmp_path, text):
    path = tmp_path / "a.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ProblemError) as error:
        load(path)
    assert "curly" not in str(error.value)
    assert "comma: " not in str(error.value)
    assert "stands in quotes" not in str(error.value)
