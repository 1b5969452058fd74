"""The example notebooks run, keep what they show, and show formulas where a notebook can."""

import runpy

import pytest

from derive import derive
from tests.support.needs import needs
from tests.support.notebooks import JUPYTER, MARIMO, cells_of, converted, executed

pytestmark = needs("the module nbclient", "the module nbformat", "the module ipykernel")


def outputs(notebook):
    """What each code cell shows last: MIME type → text."""
    code = [c for c in notebook.cells if c.cell_type == "code"]
    return [c.outputs[-1].get("data") or {"text/plain": c.outputs[-1]["text"]} for c in code]


@pytest.fixture(scope="module")
def shown():
    return outputs(executed())


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
    *_, checked, coordinates, run, page, motion = shown
    assert checked["text/markdown"].startswith("✓ ")
    assert "zeta_1" in coordinates["text/plain"]
    assert run["text/html"].startswith('<img src="data:image/svg+xml;base64,')
    assert "<td>energy [J]</td>" in run["text/html"]
    assert page["text/html"].startswith("<iframe srcdoc=")
    lowest, highest, drift = map(float, motion["text/plain"].split())
    assert 0.2 < lowest < 0.3 < 0.9 < highest < 1  # it swings far down, and back
    assert abs(drift) < 1e-8


def test_what_the_notebook_keeps_is_what_it_shows(shown):
    """But for numbers of a motion and pictures, which may differ in a last digit elsewhere."""
    import nbformat

    stored = outputs(nbformat.read(JUPYTER, as_version=4))
    assert [sorted(x) for x in stored] == [sorted(x) for x in shown]
    for kept, now in zip(stored, shown, strict=True):
        for kind in ("text/markdown", "text/latex"):
            assert kept.get(kind) == now.get(kind)


def test_what_is_refused_is_one_line():
    import nbclient
    import nbformat

    cell = nbformat.v4.new_code_cell('from derive import derive\nderive("tpo")')
    notebook = nbformat.v4.new_notebook(cells=[cell])
    nbclient.NotebookClient(notebook, kernel_name="python3", allow_errors=True).execute()
    (out,) = notebook.cells[0].outputs
    assert out["traceback"] == [f"{out['ename']}: {out['evalue']}"]
    assert "tpo" in out["evalue"]


def test_what_a_terminal_shows_is_short():
    d = derive("pendulum")
    assert repr(d.check(1)).startswith("✓ ")
    assert len(repr(d.motion_page(1))) < 80


@needs("the module marimo")
def test_the_notebook_of_marimo_is_the_same_and_runs(tmp_path):
    text = MARIMO.read_text(encoding="utf-8")
    assert cells_of(converted(tmp_path)) == cells_of(text)
    _, defined = runpy.run_path(str(MARIMO))["app"].run()
    assert all(verdict.holds for verdict in defined["d"].check(1))
    assert abs(defined["drift"]) < 1e-8
