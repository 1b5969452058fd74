"""The pictures in docs/pictures are those of the runs in examples/runs, and these are small and
those of the commands that are said."""

import re

import numpy as np
import pytest

from derive.motion.ensemble_files import read_either
from derive.motion.run import Run
from tests.support.motion_pictures import DRAWN, MADE, PICTURES, ROOT, RUNS, drawn, remade, unlike
from tests.support.needs import need, needs

pytestmark = needs("the module matplotlib")


@pytest.mark.parametrize("name", DRAWN)
def test_a_picture_is_drawn_from_its_run(name, tmp_path):
    found = drawn(name, tmp_path)
    if unlike():
        pytest.skip(f"not as in requirements-dev.lock: {', '.join(unlike())}")
    assert found == (PICTURES / name).read_bytes()


def numbers(path):
    """The numbers of a run or of an ensemble, columns last."""
    found = read_either(path)
    return found.table if isinstance(found, Run) else found.states


@pytest.mark.parametrize("name", MADE)
def test_a_run_is_that_of_its_command(name, tmp_path):
    if "--ensemble" in MADE[name].words:
        need("cc")
    path = tmp_path / name
    path.write_bytes(remade(name, tmp_path))
    again, committed = numbers(path), numbers(RUNS / name)
    largest = np.abs(committed).max(axis=tuple(range(committed.ndim - 1)))
    last_digit = 10.0 ** (1 - MADE[name].digits)
    assert again.shape == committed.shape
    assert np.all(np.abs(again - committed) <= last_digit * largest)


def test_the_runs_are_small_and_all_are_shown():
    assert {x.name for x in RUNS.iterdir()} == {*MADE} == {run for run, _ in DRAWN.values()}
    assert all(x.stat().st_size < 30_000 for x in RUNS.iterdir())
    shown = {
        name
        for page in (ROOT / "docs").glob("*.md")
        for name in re.findall(r"\]\(pictures/([\w.]+)\)", page.read_text(encoding="utf-8"))
    }
    assert {*DRAWN} <= shown
