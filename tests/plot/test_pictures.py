"""Pictures of real runs: every kind, the same bytes, texts on the sheet and in both languages, and
what is refused; those in notes; those in docs/pictures, which are of the runs in examples/runs, and
these are small and those of the commands that are said."""

import re

import numpy as np
import pytest

from derive.command.cli import main
from derive.motion.ensemble_files import read_either
from derive.motion.run import Run, written
from derive.views.language import language
from derive.views.plot.kind_descriptions import OVERVIEW
from derive.views.plot.pictures import KINDS, plot
from derive.views.plot.plot_sheet import FORMATS, PlotError, laid_out, look, with_mark
from tests.support.drawn_runs import figure_of, fitting, run_of, simulated, texts
from tests.support.motion_pictures import DRAWN, MADE, PICTURES, ROOT, RUNS, drawn, remade, unlike
from tests.support.needs import need, needs
from tests.support.walks import derived

pytestmark = needs("the module matplotlib")


@pytest.mark.parametrize("kind", [*KINDS, OVERVIEW])
def test_every_kind_has_the_same_bytes_twice(kind):
    """Without a date, and with fonts that are TrueType."""
    for name in (f"a{x}" for x in FORMATS):
        first = plot(fitting(kind), name, kind)
        assert first == plot(fitting(kind), name, kind)
        assert len(first) > 2000
        if name == "a.pdf":
            assert b"Date" not in first
            assert b"/Type3" not in first
            assert b"/TrueType" in first or b"/CIDFontType2" in first


# ---------------------------------------------------------------- texts


def cut_off(figure):
    """The texts of a figure that leave the sheet, and the labels longer than their axis; ticks
    outside of the view are not drawn."""
    figure.draw_without_rendering()
    sheet_, pen = figure.bbox, figure.canvas.get_renderer()
    ticks, found = set(), []
    for panel in figure.get_axes():
        box = panel.get_window_extent(pen)
        for axis, size in ((panel.xaxis, box.width), (panel.yaxis, box.height)):
            ticks |= {*axis.get_ticklabels(), *axis.get_ticklabels(minor=True)}
            ticks |= {x for t in axis.get_major_ticks() for x in (t.label1, t.label2)}
            own = axis.label.get_window_extent(pen)
            if max(own.width, own.height) > size and axis.label.get_text():
                found.append(axis.label.get_text())
    for x in texts(figure):
        box = x.get_window_extent(pen)
        inside = box.x0 >= 0 and box.y0 >= 0 and box.x1 <= sheet_.x1 and box.y1 <= sheet_.y1
        if x not in ticks and x.get_visible() and x.get_text().strip() and not inside:
            found.append(x.get_text())
    return found


@pytest.mark.parametrize("spoken", ["en", "fr"])
@pytest.mark.parametrize("kind", KINDS)
def test_no_text_leaves_its_sheet(kind, spoken):
    ellipsoid = simulated("riemann_ellipsoid")
    for run in (fitting(kind), *([] if KINDS[kind].lacks(ellipsoid) else [ellipsoid])):
        with look():
            figure = figure_of(run, kind, language(spoken).word, KINDS[kind].size(run))
            laid_out(figure)
            assert cut_off(figure) == []


@pytest.mark.parametrize("problem", ["euler_top", "so3", "hammer", "kovalevskaya_top"])
def test_labels_of_axes_are_off_the_outline_and_titles_on_the_sheet(problem):
    """By what is drawn: the boxes of the texts, the corners of the outline."""
    run = simulated(problem)
    figure = figure_of(run, "polhode", size=KINDS["polhode"].size(run))
    laid_out(figure)
    renderer = figure.canvas.get_renderer()
    for panel in figure.get_axes():
        assert panel.title.get_window_extent(renderer).y1 <= figure.bbox.height
        outline = panel.patches[0].get_path().vertices
        ends = np.linspace(outline[:-1], outline[1:], 9).reshape(-1, 2)
        boxes = [x.get_window_extent(renderer) for x in panel.texts]
        touched = [x.count_contains(panel.transData.transform(ends)) for x in boxes]
        # a needle's own end is as narrow as a label is wide
        assert touched == [0] * len(boxes) or problem == "hammer"
        assert sum(touched) < len(ends) // 4
        assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])


@pytest.mark.parametrize("kind", ["state", "polhode", "body", "potential"])
def test_the_numbers_speak_french(kind):
    """At the ticks, in titles and at marks; a file keeps its name."""
    figure = figure_of(fitting(kind), kind, size=(8, 4))
    figure.get_axes()[0].plot([], [], label="run_1.5.npz")
    named = figure.text(0, 0, "a/1.5.npz 0.25 $x = 1.5e-3$")
    with_mark(figure, ",")
    laid_out(figure)
    shown = [x.get_text() for x in figure.findobj(type(named))]
    assert named.get_text() == "a/1.5.npz 0,25 $x = 1{,}5e-3$"
    assert [x for x in shown if re.search(r"[0-9]\.[0-9]", x) and ".npz" not in x] == []
    assert any(re.search(r"[0-9](?:,|\{,\})[0-9]", x) for x in shown if x is not named)


# ---------------------------------------------------------------- what is refused


def without_inertia(run):
    return Run(run.columns, run.table, {**run.facts, "body": {}})


@pytest.mark.parametrize(
    ("run", "kind", "says"),
    [
        (run_of, "polhod", "unknown kind 'polhod'; did you mean 'polhode'"),
        (run_of, "precision", "precision is of several runs, derive plot A B …, or of a table; th"),
        (run_of, "spread", "spread is of an ensemble, and this is none; there are"),
        (run_of, "vorticity", "vorticity needs columns re_1_0.*there are state, energy, axes, pol"),
        (
            lambda: without_inertia(run_of()),
            "polhode",
            r"a tensor of inertia, that of .* \[body\] given, or of an ℓ",
        ),
        ("heisenberg", "axes", r"axes needs a group of rotations of R³, SO\(3\) or SE\(3\), which"),
        ("heisenberg", "polhode", "polhode needs a group of rotations of R³"),
        ("charged_body", "polhode", "polhode needs a tensor of inertia, that of points"),
        ("gas_cloud", "spheroid", "spheroid needs a body that is one solid ellipsoid, which"),
        ("zeitlin", "body", "body needs columns A_11 … A_33, or A_11 … A_22 of the plane, which"),
        ("zeitlin", "potential", "potential needs symmetries that leave"),
        ("euler_top", "potential", r"potential needs .* one degree of freedom"),
    ],
)
def test_a_kind_that_does_not_fit_is_told_with_what_is_missing(run, kind, says):
    run = run() if callable(run) else simulated(run, 0.01)
    with pytest.raises(PlotError, match=says):
        plot(run, "a.svg", kind)
    assert kind not in KINDS or KINDS[kind].lacks(run)


def test_columns_and_a_missing_library_are_told(monkeypatch):
    with pytest.raises(PlotError, match="columns are chosen of an ensemble"):
        plot(run_of(), "a.svg", columns=["A_11"])
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(PlotError, match=r"pip install matplotlib$"):
        plot(run_of(), "a.svg")


def test_the_command_and_python(tmp_path, capsys):
    path, out = tmp_path / "run.npz", tmp_path / "a.svg"
    path.write_bytes(written(run_of(), path.name))
    assert main(["plot", str(path), "--out", str(out)]) == 0
    assert out.read_bytes() == plot(run_of(), "a.svg")
    run = simulated("euler_top")
    assert run.plot(tmp_path / "b.svg", "axes").read_bytes() == plot(run, "b.svg", "axes")
    assert np.array_equal(run.read(run.save(tmp_path / "run.csv")).table, run.table)
    assert main(["plot", str(path), "--out", str(tmp_path / "a.gif")]) == 2
    assert "must end in .svg, .pdf, .png" in capsys.readouterr().err
    (tmp_path / "b.npz").write_bytes(b"PK")
    assert main(["plot", str(tmp_path / "b.npz"), "--out", str(out)]) == 2
    assert "not a run" in capsys.readouterr().err


# ---------------------------------------------------------------- in notes


@pytest.mark.parametrize(
    ("name", "shown", "problems"),
    [
        ("notes.html", r'<img src="([^"]*\.svg)"', ("rod", "euler_top")),
        ("notes.tex", r"{(\w+\.pdf)}", ("rod",)),
    ],
)
def test_the_picture_of_each_problem_is_beside_and_shown(name, shown, problems, tmp_path, capsys):
    out = tmp_path / name
    assert main(["notes", *problems, "--picture", "3", "--out", str(out)]) == 0
    pictures = re.findall(shown, out.read_text(encoding="utf-8"))
    assert [x.rpartition(".")[0] for x in pictures] == [f"notes_{x}_motion" for x in problems]
    assert capsys.readouterr().out.split() == [str(out), *(str(tmp_path / x) for x in pictures)]
    for problem, picture in zip(problems, pictures, strict=True):
        run = derived(problem).simulate(3.0)
        assert (tmp_path / picture).read_bytes() == plot(run, picture)


# ---------------------------------------------------------------- those that are committed


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
