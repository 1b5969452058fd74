"""The note, line by line: its labels are steps, and every numbered line of it has its row."""

import re
from pathlib import Path

import pytest

from derive.command.showing import ready_made
from tests.support.walks import record

TEXT = (Path(__file__).parents[2] / "docs" / "paper.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in TEXT.splitlines()
    if line.startswith("|") and not line.startswith(("|-", "| the note"))
]
NUMBERED = {int(first.strip("()")): where for first, _, where in ROWS if first.startswith("(")}
LABEL = re.compile(r"`(\w+)\.(\w+)`")


def steps(where):
    """Those that a row names; of the two actions, the first word names the text about any group."""
    return [record(name)[f"{name}.{step}"] for name, step in LABEL.findall(where)]


def test_every_numbered_line_has_a_row():
    assert [*NUMBERED] == [*range(1, 40)]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0] + row[1])
def test_a_row_names_steps_that_there_are(row):
    names = {name for name, _ in LABEL.findall(row[2])}
    assert names <= {*ready_made()}
    told = [*steps(row[2])]  # KeyError for one that is not there
    assert told or "not walked" in row[2] or "`derive list`" in row[2]


@pytest.mark.parametrize("number", NUMBERED)
def test_a_numbered_row_names_the_steps_that_carry_the_number(number):
    """In the texts that it speaks of, those steps and no others, but for what is said besides."""
    carrying = {
        s.label
        for name, _ in LABEL.findall(NUMBERED[number])
        for s in record(name).steps
        if number in s.paper and s.label.startswith(f"{name}.")
    }
    named = {s.label for s in steps(NUMBERED[number])}
    assert carrying <= named
    assert carrying or number == 4  # the letters of (3), all at once
