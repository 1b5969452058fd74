"""Templates are short: what is long is text for the run time, which says so in its first line."""

from pathlib import Path

import pytest

from derive.code.languages import LANGUAGES

ROOT = Path(__file__).parents[2] / "templates"
LONGEST = 90
FILES = [x for language in LANGUAGES for x in sorted((ROOT / language).iterdir())]


@pytest.mark.parametrize("path", FILES, ids=lambda x: "/".join(x.parts[-2:]))
def test_a_template_is_short(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    tags = sum("{%" in line for line in lines)
    assert len(lines) <= LONGEST or ("run-time text" in lines[0] and tags < len(lines) / 8)


@pytest.mark.parametrize("path", FILES, ids=lambda x: "/".join(x.parts[-2:]))
def test_the_functions_of_a_program_are_data(path):
    """No template spells out a function that another language has as well, but constants."""
    text = path.read_text(encoding="utf-8")
    spelt = ("energy(", "defect(", "project(", "_frame(t", "jacobian(", "jacobian_inputs(")
    assert not [x for x in spelt if x in text and path.parent.name != "cvode"]
