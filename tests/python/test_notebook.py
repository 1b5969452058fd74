"""The example notebook runs, and shows formulas where a notebook can."""

from pathlib import Path

import pytest

from tests.support.needs import needs

pytestmark = needs("the module nbclient", "the module nbformat", "the module ipykernel")
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture(scope="module")
def shown():
    """What each code cell shows last: MIME type → text."""
    import nbclient
    import nbformat

    notebook = nbformat.read(EXAMPLES / "top.ipynb", as_version=4)
    assert not any(c.get("outputs") for c in notebook.cells)  # committed without results
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    code = [c for c in notebook.cells if c.cell_type == "code"]
    return [c.outputs[-1].get("data") or c.outputs[-1]["text"] for c in code]


def test_walk_step_and_equation_are_formulas(shown):
    walk, figure, step, equation, *_ = shown
    assert figure["image/svg+xml"].startswith("<svg")
    answer, _, folded = walk["text/markdown"].partition("<details>")
    assert answer.startswith("# A cone on its apex")
    assert "\n\n$$\n\\begin{aligned}\n\\dot A &= " in answer
    assert "\n\n# A cone on its apex" in folded
    assert "\\varpi" not in answer
    assert "\\varpi" in folded
    assert "$$" in step["text/markdown"]
    assert walk["text/plain"].startswith("<derivation cone")
    assert equation["text/latex"].startswith("$$\\begin{aligned}")
    assert equation["text/plain"].startswith("<equation ζ̇ = ")


def test_the_checks_hold_and_the_top_keeps_its_energy(shown):
    *_, checked, coordinates, motion = shown
    assert checked["text/plain"] == "True"
    assert "zeta_1" in coordinates["text/plain"]
    lowest, highest, drift = map(float, motion.split())
    assert 0.9 < lowest < highest < 1
    assert abs(drift) < 1e-8
