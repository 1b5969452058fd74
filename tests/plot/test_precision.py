"""Several runs in one picture: work and precision, and their energies."""

import json
from dataclasses import replace

import numpy as np
import pytest

from derive.command.cli import main
from derive.motion.run import Run
from derive.python.simulated import Simulated
from derive.views.language import language
from derive.views.plot.ensemble_pictures import of_runs, table
from derive.views.plot.kind_descriptions import PRECISION
from derive.views.plot.pictures import plot_energies
from derive.views.plot.plot_sheet import PlotError, sheet
from derive.views.plot.time_series import energies, method_in_words
from tests.support.drawn_runs import plain_run, simulated
from tests.support.needs import needs
from tests.support.pages import blocks, commands
from tests.support.walks import derived

pytestmark = needs("the module matplotlib")


def test_the_energies_of_several_runs(tmp_path, capsys):
    paths = [tmp_path / "a.npz", tmp_path / "b.npz"]
    for path, step in zip(paths, ("discrete", "gauss"), strict=True):
        derived("top").simulate(0.04, dt=0.002, step=step, points=20).save(path)
    runs = [(x.name, Simulated.read(x)) for x in paths]
    figure = sheet(6.5, 3.4)
    energies(figure, runs, str)
    (panel,) = figure.get_axes()
    named = {x.get_label(): x.get_ydata() for x in panel.get_lines()}
    assert {x.split("\n")[0].removeprefix("exact: ") for x in named} == {
        "discrete of order 2, dt 0.002",
        "gauss, dt 0.002",
    }
    E = runs[0][1]["energy"]
    drawn = np.nan_to_num(named["discrete of order 2, dt 0.002\na.npz"])
    assert drawn == pytest.approx(abs(E / E[0] - 1), abs=1e-15)
    out = tmp_path / "a.pdf"
    words = ["plot", *map(str, paths), "--kind", "energy", "--out", str(out)]
    assert main(words) == 0
    assert len(out.read_bytes()) > 2000
    still = plain_run(np.zeros((2, 2)), x_1="state")
    with pytest.raises(PlotError, match="c: no run with a column of the energy"):
        plot_energies([*runs, ("c", still)], "a.svg")
    bare = tuple(replace(x, unit="") for x in runs[0][1].columns)
    with pytest.raises(PlotError, match="some have no units"):
        plot_energies([runs[0], ("c", Run(bare, runs[0][1].table))], "a.svg")
    assert main([*words, "--column", "A_11"]) == 2
    assert "leave out --column" in capsys.readouterr().err


def test_a_diagram_of_runs(tmp_path):
    paths = [tmp_path / f"{dt}.npz" for dt in (0.5, 0.0625, 0.25)]
    for path in paths:
        derived("euler_top").simulate(5.0, points=1, dt=float(path.stem)).save(path)
    series = of_runs([Simulated.read(x) for x in paths])
    (called,) = series
    assert called == "gauss, with steps of one size"
    (_, coarse), (_, fine) = series[called]
    assert fine < coarse < 1e-4
    out = [tmp_path / "a.svg", tmp_path / "b.svg"]
    for x in out:
        assert main(["plot", *map(str, paths), "--kind", PRECISION, "--out", str(x)]) == 0
    assert out[0].read_bytes() == out[1].read_bytes()


def test_the_recipe_of_the_page_has_points_apart(tmp_path, monkeypatch):
    """That of docs/plot.md: each method's by their work and by their error."""
    monkeypatch.chdir(tmp_path)
    (recipe,) = [x.text for x in blocks("docs/plot.md") if f"--kind {PRECISION}" in x.text]
    for line in commands(recipe):
        assert main(line.split()[1:]) == 0
    names = [x for x in commands(recipe)[-1].split() if x.endswith(".npz")]
    series = of_runs([Simulated.read(tmp_path / x) for x in names])
    assert len(series) > 1
    for points in series.values():
        work, error = np.array(sorted(points)).T
        assert len(work) > 1
        assert (work[1:] > 1.2 * work[:-1]).all()
        assert (error[1:] < 0.1 * error[:-1]).all()


def test_a_diagram_of_a_table(tmp_path):
    rows = [("gauss", 100, 1e-6), ("gauss", 200, 1e-12), ("rk4", 1000, 1e-5)]
    keys = ("method", "work", "error")
    lines = [",".join(map(str, x)) for x in (keys, *rows)]
    (tmp_path / "a.csv").write_text("\n".join(lines))
    (tmp_path / "a.json").write_text(json.dumps([dict(zip(keys, x, strict=True)) for x in rows]))
    for name in ("a.csv", "a.json"):
        assert table(tmp_path / name) == {
            "gauss": [(100, 1e-6), (200, 1e-12)],
            "rk4": [(1000, 1e-5)],
        }
    out = tmp_path / "a.pdf"
    assert main(["plot", str(tmp_path / "a.csv"), "--kind", PRECISION, "--out", str(out)]) == 0
    assert len(out.read_bytes()) > 2000


def test_steps_that_evaluate_no_rate_are_refused_and_drawn_is_nothing(tmp_path, capsys):
    paths = [tmp_path / f"{dt}.npz" for dt in (0.002, 0.001)]
    for path in paths:
        derived("top").simulate(0.01, dt=float(path.stem), step="discrete", points=1).save(path)
    out = tmp_path / "a.svg"
    assert main(["plot", *map(str, paths), "--kind", PRECISION, "--out", str(out)]) == 2
    assert "discrete steps evaluate no rate" in capsys.readouterr().err
    assert not out.exists()


def test_what_is_rounding_has_a_floor_and_the_axis_three_decades():
    """Of errors of 1.2e-16, and 0 among them: a line without gaps; larger ones have none."""
    E = 1.0 + np.array([0, 1, 0, 1, 0]) * 2.0**-52
    small = plain_run(np.stack([np.arange(5.0), E], -1), energy="energy")
    far = 1 + np.array([0, 1, 2, 3, 1]) * 1e-3
    large = plain_run(np.stack([np.arange(5.0), far], -1), energy="energy")
    for run, shown, word in (
        (small, ["rounding"], str),
        (large, [], str),
        (small, ["x"], lambda x: "x"),
    ):
        figure = sheet(6.5, 3.4)
        energies(figure, [("a", run)], word)
        (panel,) = figure.get_axes()
        bottom, top = panel.get_ylim()
        assert top > 999 * bottom
        assert [x.get_text() for x in panel.texts] == shown
        line = panel.get_lines()[0].get_ydata()
        assert np.isfinite(line).all() == bool(shown)


def test_the_method_of_a_run_in_words():
    run = plain_run(np.zeros((2, 2)), x_1="state")
    french = language("fr").word
    for told, english, en_francais in (
        ("gauss, tol 1e-09", "gauss, tol $10^{-9}$", "gauss, tol $10^{-9}$"),
        ("rk4, tol 2.5e-12", r"rk4, tol $2.5 \cdot 10^{-12}$", r"rk4, tol $2.5 \cdot 10^{-12}$"),
        (
            "discrete of order 2, dt 0.004",
            "discrete of order 2, dt 0.004",
            "discret d’ordre 2, dt 0.004",
        ),
    ):
        run.facts["method"] = told
        assert method_in_words(run, str) == english
        assert method_in_words(run, french) == en_francais


def test_runs_of_two_motions_are_not_compared():
    runs = [simulated("euler_top", 1.0), simulated("euler_top", 2.0)]
    with pytest.raises(PlotError, match="runs of one motion"):
        of_runs(runs)
