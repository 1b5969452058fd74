"""Pictures of ensembles: what they say, the same bytes, and what is refused; several runs in one
picture: work and precision, and their energies."""

import json
from dataclasses import replace

import numpy as np
import pytest

from derive.command.cli import main
from derive.motion.ensemble import Ensemble, Part
from derive.motion.ensemble_files import writer
from derive.motion.native import AT_EVENT
from derive.motion.run import Run
from derive.python.simulated import Simulated, SimulatedEnsemble
from derive.views.language import language
from derive.views.plot.ensemble_pictures import differing, of_runs, quantiles, table
from derive.views.plot.kind_descriptions import PRECISION
from derive.views.plot.pictures import ENSEMBLE_KINDS, plot, plot_energies
from derive.views.plot.plot_sheet import PlotError, sheet
from derive.views.plot.time_series import energies
from tests.support.drawn_runs import plain_run, simulated
from tests.support.needs import needs
from tests.support.pages import blocks, commands
from tests.support.walks import derived

pytestmark = needs("the module matplotlib")
LAWS = [["x_1", "x_1 from 0 to 1"], ["k", "k from 1 to 2"]]


def ensemble(motions=50, instants=20):
    """x_1 = a + k t, x_2 = 7, with a and k drawn; each tenth motion ends after half of the time."""
    t = np.linspace(0.1, 2.0, instants)
    a, k = np.random.default_rng(3).uniform(size=(2, motions))
    states = np.stack([a[:, None] + k[:, None] * t, np.full((motions, instants), 7.0)], axis=-1)
    status = np.where(np.arange(motions) % 10 == 0, 3, 0).astype(np.intc)
    states[status != 0, instants // 2 :] = np.nan
    facts = {"problem": "line", "varied": LAWS, "motions": motions}
    varied, end = np.column_stack([a, k]), np.empty((motions, 0))
    return Ensemble(facts, ("x_1", "x_2"), t, varied, status, states, end)


def with_events(e):
    """The same, but that those which ended were at an event then, at x_1 = 3."""
    status = np.where(e.status == 3, AT_EVENT, e.status).astype(np.intc)
    end = np.full((len(status), 3), np.nan)
    for i in np.flatnonzero(status):
        a, k = e.varied[i]
        end[i] = (3 - a) / k, 3.0, 7.0
    return replace(e, status=status, end=end, facts={**e.facts, "ends": ["wall"]})


def drawn(kind, e, columns=(), word=str):
    """The figure of a kind."""
    figure = sheet(6.0, 4.0)
    ENSEMBLE_KINDS[kind].draw(figure, e, word, columns)
    return figure


def test_quantiles_are_those_of_the_motions_that_go_on():
    e = ensemble()
    found, are_few = quantiles(e, "x_1", [0.0, 0.5, 1.0])
    assert not are_few
    for i in range(len(e.t)):
        there = sorted(x for x in e.states[:, i, 0].tolist() if x == x)
        assert len(there) == (45 if i >= 10 else 50)
        middle = (there[(len(there) - 1) // 2] + there[len(there) // 2]) / 2
        assert found[:, i] == pytest.approx([there[0], middle, there[-1]])


def test_a_band_lies_between_its_quantiles():
    e = ensemble()
    (panel,) = drawn("spread", e).get_axes()
    assert panel.get_ylabel() == "$x_{1}$"  # the other is the same in all
    wide, narrow = (x.get_paths()[0].vertices for x in panel.collections)
    for band, levels in ((wide, (0.05, 0.95)), (narrow, (0.25, 0.75))):
        at_end = band[np.isclose(band[:, 0], e.t[-1]), 1]
        good = e.states[e.status == 0, -1, 0]
        assert [at_end.min(), at_end.max()] == pytest.approx(np.quantile(good, levels).tolist())
    (line,) = panel.get_lines()
    assert np.array_equal(line.get_ydata(), quantiles(e, "x_1", [0.5])[0][0])


def test_a_spread_ends_where_fewer_than_half_go_on():
    """So many as half are drawn, of fewer nothing; the title says so, where it is so."""
    e = ensemble()
    a, k = e.varied.T
    e.states[:, :, 0] = a[:, None] + k[:, None] * e.t
    counts = np.array([50] * 10 + [25] * 5 + [24] * 5)
    for i, count in enumerate(counts):
        e.states[count:, i] = np.nan
    found, are_few = quantiles(e, "x_1", [0.5])
    assert are_few
    assert np.array_equal(np.isfinite(found[0]), counts >= 25)
    told = drawn("spread", e, word=language("fr").word).get_suptitle()
    assert told.splitlines()[1] == "tracé tant que la moitié au moins des mouvements se poursuit"
    assert "\n" not in drawn("spread", ensemble()).get_suptitle()


def test_the_ends_are_those_of_the_motions():
    e = ensemble()
    figure = drawn("ends", e)
    panels = figure.get_axes()
    assert [x.get_xlabel() for x in panels] == ["$x_{1}$, varied", "$k$, varied"]
    for k, panel in enumerate(panels):
        good, lost = panel.get_lines()
        assert np.array_equal(good.get_xdata(), e.varied[e.status == 0, k])
        assert np.array_equal(good.get_ydata(), e.states[e.status == 0, -1, 0])
        assert np.array_equal(lost.get_xdata(), e.varied[e.status != 0, k])
    assert figure.get_suptitle() == "$t = 2$ – 45/50 motions to the end"
    french = drawn("ends", e, word=language("fr").word)
    assert french.get_suptitle() == "$t = 2$ – 45/50 mouvements jusqu’à la fin"


def test_the_ends_at_events_are_those_of_the_events():
    e = with_events(ensemble())
    figure = drawn("ends", e)
    time, _, column, _ = figure.get_axes()
    assert (time.get_ylabel(), column.get_ylabel()) == ("$t$", "$x_{1}$")
    at_last, at_event = time.get_lines()
    assert set(at_last.get_ydata()) == {2.0}
    a, k = e.varied[e.status == AT_EVENT].T
    assert np.array_equal(at_event.get_xdata(), a)
    assert np.allclose(a + k * at_event.get_ydata(), 3.0)
    assert set(column.get_lines()[1].get_ydata()) == {3.0}
    assert figure.get_suptitle() == "$t = 2$ – 45/50 motions to the end, 5 to an event"


def test_the_columns_that_are_drawn():
    e = ensemble()
    assert differing(e, (), 12) == ["x_1"]
    assert differing(e, ("x_2", "x_1"), 12) == ["x_2", "x_1"]
    assert len(drawn("spread", e, ("x_2", "x_1")).get_axes()) == 2
    still = replace(e, states=np.ones_like(e.states))
    assert differing(still, (), 12) == ["x_1", "x_2"]


def saved(folder, e, name="many.npz"):
    """The file of an ensemble."""
    with (folder / name).open("wb") as file, writer(file, name, e) as made:
        made.add(Part(e.varied, e.status, e.states, e.end))
    return folder / name


@pytest.mark.parametrize("name", ["many.npz", "many.csv"])
def test_the_command_and_python(tmp_path, name):
    path, out = saved(tmp_path, ensemble(), name), tmp_path / "a.svg"
    assert main(["plot", str(path), "--out", str(out)]) == 0
    assert out.read_bytes() == plot(ensemble(), "a.svg", "spread")
    words = ["plot", str(path), "--column", "x_2", "--column", "x_1", "--kind", "ends"]
    assert main([*words, "--out", str(out)]) == 0
    own = SimulatedEnsemble.read(path).plot(tmp_path / "b.svg", "ends", columns=("x_2", "x_1"))
    assert out.read_bytes() == own.read_bytes()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--kind", "polhode"], "polhode is of a run, and this is none; there are spread, ends"),
        (["--kind", "spred"], "unknown kind 'spred'; did you mean 'spread'? for this ensemble"),
        (["--column", "x_3"], "no column 'x_3'; did you mean"),
    ],
)
def test_what_is_refused(tmp_path, capsys, words, told):
    path, out = saved(tmp_path, ensemble()), tmp_path / "a.svg"
    assert main(["plot", str(path), *words, "--out", str(out)]) == 2
    err = capsys.readouterr().err
    assert told in err
    assert err.count("\n") == 1
    assert not out.exists()


def test_what_needs_more_is_told():
    e = ensemble()
    with pytest.raises(PlotError, match=r"spread needs several instants.*there are ends"):
        plot(ensemble(instants=1), "a.svg", "spread")
    lost = replace(e, status=np.full_like(e.status, 2))
    with pytest.raises(PlotError, match=r"reached the end.*nothing else can be drawn"):
        plot(lost, "a.svg")


# ---------------------------------------------------------------- several runs


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


def test_of_runs_what_is_rounding_is_told_and_what_is_not_is_drawn():
    E = 1.0 + np.array([0, 1, 0, 1, 0]) * 2.0**-52
    small = plain_run(np.stack([np.arange(5.0), E], -1), energy="energy")
    far = 1 + np.array([0, 1, 2, 3, 1]) * 1e-3
    large = plain_run(np.stack([np.arange(5.0), far], -1), energy="energy")
    figure = sheet(6.5, 3.4)
    energies(figure, [("a", small), ("b", large)], str)
    (panel,) = figure.get_axes()
    line, _ = panel.get_lines()
    assert np.nanmax(line.get_ydata()) == pytest.approx(3e-3)
    names = panel.get_legend_handles_labels()[1]
    assert names == ["?\nb", r"constant to $2.22 \cdot 10^{-16}$: ?" + "\na"]


def test_runs_of_two_motions_are_not_compared():
    runs = [simulated("euler_top", 1.0), simulated("euler_top", 2.0)]
    with pytest.raises(PlotError, match="runs of one motion"):
        of_runs(runs)
