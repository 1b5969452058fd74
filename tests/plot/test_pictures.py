"""Pictures of real runs: every kind, the same bytes, and what is refused."""

import importlib
import json
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.motion.effective_well import curve, turning_points
from derive.motion.run import Column, Run
from derive.motion.run_files import written
from derive.plot import kinds_told
from derive.plot.body_pictures import _ellipsoid, drawn, hull
from derive.plot.kinds_told import OVERVIEW, PRECISION
from derive.plot.pictures import ENSEMBLE_KINDS, KINDS, plot, plot_energies
from derive.plot.plot_sheet import FORMATS, PlotError, label, look, settled, sheet, with_mark
from derive.plot.polhode_picture import in_math, levels, unstable
from derive.plot.precision import of_runs, table
from derive.plot.spheroid_pictures import followed, maps, section
from derive.plot.surfaces import VIEW, projected
from derive.plot.time_series import energies
from derive.plot.torus_pictures import vorticity
from derive.problem.toml import problem_of
from derive.views.language import language
from tests.support.flows import emitted, flow
from tests.support.needs import needs
from tests.support.pages import blocks, commands

pytestmark = needs("the module matplotlib")
BODY = {"inertia": [[1.0, 0, 0], [0, 1.6, 0], [0, 0, 2.2]]}


@cache
def run_of(problem, end=30.0, rows=400):
    """A run of the emitted Python by SciPy."""
    code, times = emitted(problem), np.linspace(0, end, rows)
    k = code.constants([code.DEFAULTS[x] for x in code.PARAMETERS])
    group = "SO(3)" if problem == "euler_top" else "SU(5)"
    if problem == "euler_top":  # about the middle axis, a little off: it flips
        x = [*np.eye(3).ravel(), 1e-3, 1.0, 1e-3]
    else:
        x = np.random.default_rng(1).normal(size=len(code.STATE))
    states = flow(code, k, x, times)
    energy = np.array([code.energy(0.0, x, k) for x in states])
    columns = (Column("t", "time", "s"), *(Column(x, "state") for x in code.STATE))
    table = np.column_stack([times, states, energy])
    facts = {"problem": problem, "group": group, "body": BODY}
    return Run((*columns, Column("energy", "energy", "J")), table, facts)


TORUS = 'name = "torus5"\n[algebra]\nof = "torus"\nN = 5\n[inertia]\noperator = "laplacian"\n'


STARTING = {"potential": ("top", 0.5), "spheroid": ("riemann_ellipsoid", 1.0), "body": ("sl3", 2.0)}


@cache
def simulated(problem, end):
    """A run from where the problem starts."""
    return derive.derive(problem).simulate(end, points=40)


def fitting(kind):
    if kind in STARTING:
        return simulated(*STARTING[kind])
    return run_of(TORUS, 2.0, 5) if kind == "vorticity" else run_of("euler_top")


def test_the_help_tells_every_kind():
    assert [*kinds_told.KINDS] == [*KINDS]
    assert [*kinds_told.ENSEMBLE_KINDS] == [*ENSEMBLE_KINDS]


@pytest.mark.parametrize("kind", [*KINDS, OVERVIEW])
def test_every_kind_has_the_same_bytes_twice(kind):
    for name in (f"a{x}" for x in FORMATS):
        first = plot(fitting(kind), name, kind)
        assert first == plot(fitting(kind), name, kind)
        assert len(first) > 2000
    assert b"Date" not in plot(fitting(kind), "a.pdf", kind)


def test_the_labels_speak_french():
    found = [plot(run_of("euler_top"), "a.svg", "energy", language(x).word) for x in ("en", "fr")]
    assert found[0] != found[1]


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
    for x in figure.findobj(lambda x: hasattr(x, "get_text") and x not in ticks):
        box = x.get_window_extent(pen)
        inside = box.x0 >= 0 and box.y0 >= 0 and box.x1 <= sheet_.x1 and box.y1 <= sheet_.y1
        if x.get_visible() and x.get_text().strip() and not inside:
            found.append(x.get_text())
    return found


@pytest.mark.parametrize("spoken", ["en", "fr"])
@pytest.mark.parametrize("kind", KINDS)
def test_no_text_leaves_its_sheet(kind, spoken):
    run_a, run_b = fitting(kind), simulated("riemann_ellipsoid", 1.0)
    for run in (run_a, run_b) if not KINDS[kind].lacks(run_b) else (run_a,):
        with look():
            figure = sheet(*KINDS[kind].size(run))
            KINDS[kind].draw(figure, run, language(spoken).word)
            settled(figure)
            assert cut_off(figure) == []


def words_of(run, kind, word=str):
    """All words of a picture."""
    figure = sheet(7.5, 3.4)
    KINDS[kind].draw(figure, run, word)
    return "\n".join(x.get_text() for x in figure.findobj(lambda x: hasattr(x, "get_text")))


@pytest.mark.parametrize("kind", ["state", "polhode", "body", "potential"])
def test_the_numbers_speak_french(kind):
    """At the ticks, in titles and at marks; a file keeps its name."""
    figure = sheet(8, 4)
    KINDS[kind].draw(figure, fitting(kind), str)
    figure.get_axes()[0].plot([], [], label="run_1.5.npz")
    named = figure.text(0, 0, "a/1.5.npz 0.25 $x = 1.5e-3$")
    with_mark(figure, ",")
    settled(figure)
    shown = [x.get_text() for x in figure.findobj(type(named))]
    assert named.get_text() == "a/1.5.npz 0,25 $x = 1{,}5e-3$"
    assert [x for x in shown if re.search(r"[0-9]\.[0-9]", x) and ".npz" not in x] == []
    assert any(re.search(r"[0-9](?:,|\{,\})[0-9]", x) for x in shown if x is not named)


def test_the_quantities_speak_french():
    found = simulated("riemann_ellipsoid", 1.0)
    assert "circulation in the body 1" in words_of(found, "energy")
    told = words_of(found, "energy", language("fr").word)
    assert all(x in told for x in ("circulation dans le corps 1", "moment cinétique 3"))


def test_a_fluid_has_units_where_its_problem_has():
    told = words_of(derive.derive("dirichlet").simulate(0.5, points=20), "spheroid")
    for words in ("semi-axes [m]", "integral of the pressure [J]", "section y = 0 (space)", "[m]"):
        assert words in told


def test_what_is_exact_is_not_drawn():
    still = Run(
        (Column("t", "time"), Column("energy", "energy"), Column("momentum_1", "conserved")),
        np.array([[0, 1.0, 0], [1, 1 + 1e-15, 0], [2, 1, 0]]),
    )
    figure = sheet(6.5, 3.4)
    KINDS["energy"].draw(figure, still, str)
    (panel,) = figure.get_axes()
    drawn = [x for x in panel.get_lines() if len(x.get_xdata())]
    assert len(drawn) == 1
    assert np.isnan(drawn[0].get_ydata()).tolist() == [True, False, True]
    assert "exact: linear momentum 1" in panel.get_legend_handles_labels()[1]


def panels_of(run, kind):
    """The panels of a picture, and all words of each."""
    figure = sheet(7.5, 3.4)
    KINDS[kind].draw(figure, run, str)
    texts = [x.findobj(lambda t: hasattr(t, "get_text")) for x in figure.get_axes()]
    return [
        *zip(figure.get_axes(), (" ".join(t.get_text() for t in x) for x in texts), strict=True)
    ]


def curves(panel):
    """Label → y, of the curves that are seen: two neighbours, or a point with a mark."""
    found = {}
    for line in panel.get_lines():
        there = np.isfinite(line.get_ydata())
        marked = line.get_marker() not in ("None", "") and there[[*(line.get_markevery() or [])]]
        if (there[1:] & there[:-1]).any() or np.any(marked):
            found[line.get_label()] = line.get_ydata()
    return found


def test_where_all_is_exact_that_is_said_and_takes_little_room():
    t = np.linspace(0, 2, 40)
    columns = (Column("t", "time"), Column("x_1", "state"), Column("energy", "energy"))
    exact = Run(columns, np.stack([t, np.sin(t), 0 * t + 3], 1))
    assert KINDS["energy"].size(exact)[1] < 1.5 < KINDS["energy"].size(run_of("euler_top"))[1]
    ((panel, words),) = panels_of(exact, "energy")
    assert "exact: energy" in words
    assert not curves(panel)
    assert panel.get_xlim() == (0, 2)


@pytest.mark.parametrize("rows", [2, 3, 5])
def test_a_change_at_one_instant_alone_is_seen(rows):
    columns, change = (Column("t", "time"), Column("energy", "energy")), np.zeros(rows)
    change[rows // 2] = 1e-9
    run = Run(columns, np.stack([np.arange(rows), 1 + change], 1))
    ((panel, _),) = panels_of(run, "energy")
    assert [*curves(panel)] == ["energy"]


@pytest.mark.parametrize("turned", [0.1, 0.5, 1.0, 2.5, 6.0])
def test_a_state_that_is_too_fast_for_its_instants_is_named_instead(turned):
    """By how much it turns from one instant to the next, in radians: 8 instants a period are 0.79;
    at 6.0 it looks like one that turns back by 0.28."""
    t = np.arange(200.0)
    random = np.random.default_rng(3)
    columns = [np.cos(turned * t), np.cos(0.01 * t), 1 + 1e-15 * random.normal(size=200), 0.3 * t]
    names = [Column("t", "time"), *(Column(f"A_1{k}", "state") for k in range(1, 5))]
    ((panel, words),) = panels_of(Run(tuple(names), np.stack([t, *columns], 1)), "state")
    slow = turned < 0.7 or turned == 6.0  # which no picture of these instants can know
    assert [label(f"A_1{k}") for k in range(1 if slow else 2, 5)] == [*curves(panel)]
    assert ("too few instants:" in words) is not slow
    alone = Run((names[0], names[1]), np.stack([t, columns[0]], 1))
    ((panel, words),) = panels_of(alone, "state")
    assert bool(curves(panel)) is slow
    assert ("too few instants:" in words) is not slow


def test_a_component_is_held_against_its_vector():
    names = ("angular_momentum_1", "angular_momentum_2", "integral_1", "integral_2")
    kept = Run(
        (Column("t", "time"), *(Column(x, "conserved") for x in names)),
        np.array([[0, 3e12, 4e12, 5, 100], [1, 3e12, 4e12 + 1, 5.5, 100.5]]),
    )
    figure = sheet(6.5, 3.4)
    KINDS["energy"].draw(figure, kept, str)
    ends = [x.get_ydata()[-1] for x in figure.get_axes()[0].get_lines() if len(x.get_xdata())]
    assert ends == pytest.approx([2e-13, 0.1, 0.005], rel=1e-3)


def test_the_picture_says_what_components_are_held_against():
    said = "components relative to the length of their vector"
    assert said in words_of(simulated("euler_top", 1.0), "energy").replace("\n", " ")
    assert said not in words_of(simulated("top", 0.5), "energy")  # one component alone


def test_the_energies_of_several_runs(tmp_path, capsys):
    paths = [tmp_path / "a.npz", tmp_path / "b.npz"]
    for path, step in zip(paths, ("discrete", "gauss"), strict=True):
        derive.derive("top").simulate(0.04, dt=0.002, step=step, points=20).save(path)
    runs = [(x.name, derive_read(x)) for x in paths]
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
    still = Run((Column("t", "time"), Column("x_1", "state")), np.zeros((2, 2)))
    with pytest.raises(PlotError, match="c: no run with a column of the energy"):
        plot_energies([*runs, ("c", still)], "a.svg")
    bare = tuple(replace(x, unit="") for x in runs[0][1].columns)
    with pytest.raises(PlotError, match="some have no units"):
        plot_energies([runs[0], ("c", Run(bare, runs[0][1].table))], "a.svg")
    assert main([*words, "--column", "A_11"]) == 2
    assert "leave out --column" in capsys.readouterr().err


def test_fonts_of_a_pdf_are_truetype():
    assert b"/Type3" not in (found := plot(run_of("euler_top"), "a.pdf", "energy"))
    assert b"/TrueType" in found or b"/CIDFontType2" in found


def test_the_view_is_a_projection():
    square = projected(np.eye(3))
    assert square.T @ square == pytest.approx(np.eye(2))
    assert projected(VIEW) == pytest.approx(np.zeros(2))
    assert (label("zeta_1"), label("energy")) == (r"$\zeta_{1}$", "energy")


@pytest.mark.parametrize(
    ("kind", "says"),
    [
        ("polhod", "unknown kind 'polhod'; did you mean 'polhode'"),
        ("precision", "precision is of several runs, derive plot A B …, or of a table; there are"),
        (
            "vorticity",
            "vorticity needs columns re_1_0.*there are state, energy, axes, polhode",
        ),
    ],
)
def test_a_kind_that_does_not_fit_is_told(kind, says):
    with pytest.raises(PlotError, match=says):
        plot(run_of("euler_top"), "a.svg", kind)


@pytest.mark.parametrize(
    ("problem", "kind", "says"),
    [
        ("heisenberg", "axes", r"axes needs a group of rotations of R³, SO\(3\) or SE\(3\), which"),
        ("heisenberg", "polhode", "polhode needs a group of rotations of R³"),
        ("charged_body", "polhode", "polhode needs a tensor of inertia, that of points"),
        ("gas_cloud", "spheroid", "spheroid needs a body that is one solid ellipsoid, which"),
        ("zeitlin", "body", "body needs columns A_11 … A_33, which"),
        ("zeitlin", "potential", "potential needs symmetries that leave"),
    ],
)
def test_a_refusal_names_what_is_missing_and_no_more(problem, kind, says):
    run = simulated(problem, 0.01)
    with pytest.raises(PlotError, match=says):
        plot(run, "a.svg", kind)
    assert KINDS[kind].lacks(run)


def test_what_is_of_ensembles_is_refused_for_a_run():
    with pytest.raises(PlotError, match="spread is of an ensemble, and this is none; there are"):
        plot(run_of("euler_top"), "a.svg", "spread")
    with pytest.raises(PlotError, match="columns are chosen of an ensemble"):
        plot(run_of("euler_top"), "a.svg", columns=["A_11"])


def test_a_polhode_needs_the_inertia():
    run = run_of("euler_top")
    bare = Run(run.columns, run.table, {**run.facts, "body": {}})
    with pytest.raises(
        PlotError, match=r"a tensor of inertia, that of .* \[body\] given, or of an ℓ"
    ):
        plot(bare, "a.svg", "polhode")


def test_neighbouring_polhodes_keep_both_integrals_and_the_separatrix_meets_the_middle_axis():
    d = np.array([1.0, 1.6, 2.2])
    found = [*levels(d)]
    assert len(found) == 14
    for u, parts in found:
        assert np.linalg.norm(u, axis=1) == pytest.approx(np.ones(len(u)))
        assert np.ptp(u**2 @ d) < 1e-12
        assert parts == (abs(u**2 @ d - 1.6).max() < 1e-12)
        assert not parts or abs(u[:, 1]).max() == pytest.approx(1)
    assert [parts for _, parts in levels(np.array([1.0, 1.0, 2.0]))] == [False] * 6
    assert [*levels(np.ones(3))] == []
    assert unstable(np.array([1, 1.6, 2.2])) == 1
    assert unstable(np.array([1, 1, 2.2])) is None


def test_a_polhode_marks_the_axes_and_its_titles_are_level():
    run = simulated("euler_top", 1.0)
    told = words_of(run, "polhode", language("fr").word)
    assert all(x in told for x in ("axe stable", "axe instable", "séparatrice", "$I = 1.6$"))
    figure = sheet(7.0, 3.9)
    KINDS["polhode"].draw(figure, run, str)
    figure.draw_without_rendering()
    left, right = (x.title.get_window_extent().y0 for x in figure.get_axes())
    assert abs(left - right) < 3


def test_a_polhode_on_which_a_torque_acts_has_no_others_and_is_seen_whole():
    run = derive.derive("top").simulate(2.0, start={"zeta_3": 3.0}, points=40)
    told = words_of(run, "polhode", str)
    assert "at first: a torque acts" in told
    assert "principal axis" in told
    assert not any(x in told for x in ("separatrix", "stable axis"))
    figure = sheet(7.0, 3.9)
    KINDS["polhode"].draw(figure, run, str)
    for panel in figure.get_axes():
        ends = np.abs([x.get_xydata() for x in panel.lines if len(x.get_xydata()) == len(run.t)])
        assert np.nanmax(ends) <= panel.get_xlim()[1]


def test_what_changes_by_damping_is_no_error():
    run = simulated("euler_top", 1.0)
    for drives, told in ((["damping"], "relative change"), ([], "relative error")):
        driven = Run(run.columns, run.table, {**run.facts, "drives": drives})
        assert told in words_of(driven, "energy", str)


@pytest.mark.parametrize("problem", ["euler_top", "so3", "hammer", "kovalevskaya_top"])
def test_labels_of_axes_are_off_the_outline_and_titles_on_the_sheet(problem):
    """By what is drawn: the boxes of the texts, the corners of the outline."""
    figure = sheet(*KINDS["polhode"].size(run := simulated(problem, 1.0)))
    KINDS["polhode"].draw(figure, run, str)
    settled(figure)
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


def test_the_command(tmp_path, capsys):
    path, out = tmp_path / "run.npz", tmp_path / "a.svg"
    path.write_bytes(written(run_of("euler_top"), path.name))
    assert main(["plot", str(path), "--out", str(out)]) == 0
    assert out.read_bytes() == plot(run_of("euler_top"), "a.svg")
    assert main(["plot", str(path), "--out", str(tmp_path / "a.gif")]) == 2
    assert "must end in .svg, .pdf, .png" in capsys.readouterr().err
    (tmp_path / "b.npz").write_bytes(b"PK")
    assert main(["plot", str(tmp_path / "b.npz"), "--out", str(out)]) == 2
    assert "not a run" in capsys.readouterr().err


def test_without_matplotlib_the_remedy_is_told(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(PlotError, match="pip install"):
        plot(run_of("euler_top"), "a.svg")


# ---------------------------------------------------------------- what is drawn


@pytest.mark.parametrize(
    ("problem", "end", "spin"),
    [("top", 0.5, 100.0), ("top", 0.5, 600.0), ("spherical_pendulum", 3.0, None)],
)
def test_the_effective_potential_is_the_energy_where_the_body_turns_back(problem, end, spin):
    """E = V(u) + u̇²/(2 slope): V is below E on the whole run, and meets it where u̇ = 0."""
    run = derive.derive(problem).simulate(end, start={"zeta_3": spin} if spin else {})
    u, V = (np.array(run.facts["potential"][x]) for x in ("u", "V"))
    height, energy = run[run.facts["potential"]["entry"]], run["energy"][0]
    there = np.interp(height, u, V)
    scale = np.ptp(there)
    assert there[0] == pytest.approx(energy, abs=1e-3 * scale) or problem != "top"  # let go at rest
    inside = (u >= height.min()) & (u <= height.max())
    assert inside.sum() > 15  # the window is scaled to the well
    assert not inside[0]
    assert not inside[-1]
    assert np.all(there <= energy + 1e-3 * scale)
    assert np.any(there < energy - 0.3 * scale)


def test_the_potential_of_a_symmetric_top_is_the_known_one():
    run = simulated("lagrange_top", 1.0)
    p, told = run.facts["parameters"], run.facts["potential"]
    u, V = np.array(told["u"]), np.array(told["V"])
    about_space, about_axis = run["angular_momentum_3"][0], run["body_angular_momentum_3"][0]
    known = p["mgl"] * u + (about_space - about_axis * u) ** 2 / (2 * p["I1"] * (1 - u**2))
    assert pytest.approx(known + about_axis**2 / (2 * p["I3"]), rel=1e-12) == V


def test_the_run_lies_in_the_well_of_its_energy():
    run = derive.derive("top").simulate(1.0, start={"zeta_3": 600.0}, exp=(0.5, 0, 0))
    figure = sheet(5.0, 3.4)
    KINDS["potential"].draw(figure, run, str)
    (panel,) = figure.get_axes()
    curve, energy, own, *_ = (np.array(x.get_ydata()) for x in panel.get_lines())
    assert own.max() <= energy[0] * (1 + 1e-3)
    assert own.min() == pytest.approx(0, abs=1e-3 * energy[0])
    assert curve[0] > 1.5 * energy[0] < curve[-1]
    assert panel.get_ylabel() == r"$V - V_{\min}$ [J]"


def test_the_potential_is_drawn_to_a_pixel_where_it_bends():
    """A wall of a hundredth of the width beside a flat bottom, and few places on a parabola."""

    def wall(u):
        return 0.1 * u**2 + 1e-4 / (1.001 - u)

    u, V = curve(wall, 0.05, -1, 1)
    dense = np.linspace(-1, 1, 100001)
    drawn, true = (np.minimum(x, 0.1) / 0.1 for x in (np.interp(dense, u, V), wall(dense)))
    slope = np.gradient(true, dense / 2)
    assert np.max(np.abs(drawn - true) / np.hypot(1, slope)) < 1.5e-3
    assert len(u) < 250
    assert len(curve(lambda u: u * u, 1.0, -1, 1)[0]) < 100


@pytest.mark.parametrize("start", [(-0.2, -0.1), (0.2, 0.2), (-0.5, 0.3)])
def test_the_turning_points_are_those_of_the_well_of_the_motion(start):
    wells = [lambda u: u * u - 0.25, lambda u: (u * u - 0.25) * (u * u - 0.81)]
    for V in wells:
        assert turning_points(V, 0.0, *start) == pytest.approx((-0.5, 0.5)) or V is wells[1]
    assert turning_points(wells[1], 0.0, 0.6, 0.7) == pytest.approx((0.5, 0.9))
    low, high = turning_points(lambda u: 0 * u, 1.0, *start)
    assert -1 < low < -1 + 1e-6
    assert 1 - 1e-6 < high < 1


def test_a_motion_that_stays_has_a_window_too():
    asleep = derive.derive("lagrange_top").simulate(1.0, points=5, exp=(0, 0, 0))
    assert np.ptp(asleep.facts["potential"]["u"]) > 0.01
    assert len(plot(asleep, "a.svg", "potential")) > 2000


def test_two_degrees_of_freedom_have_no_potential():
    run = simulated("euler_top", 1.0)
    assert not run.facts["potential"]
    with pytest.raises(PlotError, match=r"potential needs .* one degree of freedom"):
        plot(run, "a.svg", "potential")


def test_a_spectrum_ends_where_rounding_begins():
    columns = [f"{part}_{n}_0" for n in (1, 2, 3) for part in ("re", "im")]
    numbers = np.array([[0.0, 3.0, 4.0, 1e-15, 0.0, 0.0, 1e-18]])
    run = Run((Column("t", "time"), *(Column(x, "state") for x in columns)), numbers, {})
    figure = importlib.import_module("matplotlib.figure").Figure()
    vorticity(figure, run, str)
    (line,) = figure.axes[1].lines
    assert line.get_xdata().tolist() == [1, 2]
    assert np.allclose(line.get_ydata(), [2 * 25, 2e-30], rtol=1e-12)


def test_a_wave_along_x_is_the_same_along_y():
    run = Run(
        (Column("t", "time"), Column("re_1_0", "state"), Column("im_1_0", "state")),
        np.array([[0.0, 0.5, 0.0]]),
    )
    figure = sheet(7, 3.4)
    vorticity(figure, run, str)
    field = figure.get_axes()[0].collections[0].get_array().reshape(129, 129)
    assert np.allclose(field, np.cos(np.linspace(0, 2 * np.pi, 129))[None, :])


def test_a_body_of_an_inertia_alone_is_the_ellipsoid_that_has_it():
    a, b, c = 1.0, 2.0, 3.0
    inertia = np.diag([b**2 + c**2, c**2 + a**2, a**2 + b**2]) / 5
    run = Run((Column("t", "time"),), np.zeros((1, 1)), {"body": {"inertia": inertia.tolist()}})
    ((root, centre),) = drawn(run)["ellipsoids"]
    assert np.allclose(root, np.diag([a, b, c]) / c)
    assert centre == [0, 0, 0]


def test_the_body_of_a_run_is_that_of_its_parameters():
    found = derive.derive("sl3").simulate(0.1, start={"x1": 3.0}, points=1).facts["body"]
    assert found["points"] == [[3, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]
    hammer = simulated("hammer", 0.1).facts["body"]
    handle, head = hammer["solids"]
    assert (len(handle), len(head)) == (2, 12)
    p = simulated("hammer", 0.1).facts["parameters"]
    assert {round(z, 9) for line in handle for *_, z in line} == {p["l"] / 2, -p["l"] / 2}


@pytest.mark.parametrize("sizes", [(1, 2, 3), (2, 1, 0), (0, 1, 1)])
def test_an_ellipsoid_also_flat_is_within_its_outline(sizes):
    panel = importlib.import_module("matplotlib.figure").Figure().add_subplot()
    turned = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    _ellipsoid(panel, turned @ np.diag(sizes), np.zeros(3))
    (outline,) = panel.patches
    for line in panel.lines:
        points = np.column_stack(line.get_data())
        inside = points[np.isfinite(points).all(axis=1)]
        assert outline.get_path().contains_points(inside, radius=0.01).all()


def test_a_flat_body_has_its_pictures(tmp_path):
    given = {"m": 1, "centre": [0, 0, -1], "I_centre": [[1, 0, 0], [0, 2, 0], [0, 0, 1]]}
    problem = problem_of({"name": "plate", "group": "SO(3)", "body": {"given": given}})
    run = derive.derive(problem).simulate(1.0, start={"zeta_1": 1.0}, points=4)
    assert not KINDS["body"].lacks(run)
    assert plot(run, "a.svg", OVERVIEW)


def test_small_moments_are_powers_of_ten():
    assert [in_math(x) for x in (1.02e-5, 0.25, 1.5e7)] == [
        r"1.02 \cdot 10^{-5}",
        "0.25",
        r"1.5 \cdot 10^{7}",
    ]


def test_the_section_and_the_axes_of_a_spheroid():
    run = simulated("riemann_ellipsoid", 1.0)
    M = maps(run)
    assert np.linalg.det(M) == pytest.approx(np.ones(len(M)))
    x, z = section(M[0])
    assert (x.max(), z.max()) == pytest.approx((1.3, 1 / 1.69), rel=1e-3)
    t = np.linspace(0, 1, 50)
    crossing = np.sort(np.stack([1 + t, 2 - t, 0 * t], axis=1), axis=1)[:, ::-1]
    curves = followed(crossing)
    assert np.abs(np.diff(curves, 2, axis=0)).max() < 1e-12


def test_a_hull():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0], [0, 0]])
    assert sorted(map(tuple, hull(square))) == [(0, 0), (0, 1), (1, 0), (1, 1)]


# ---------------------------------------------------------------- work and precision


def runs_of(tmp_path, **chosen):
    (name, values), *_ = chosen.items()
    paths = []
    for value in values:
        run = derive.derive("euler_top").simulate(20.0, points=1, **{name: value})
        paths.append(run.save(tmp_path / f"{value}.npz"))
    return paths


def test_a_diagram_of_runs(tmp_path):
    paths = runs_of(tmp_path, dt=[2.0, 0.25, 1.0])
    series = of_runs([derive_read(x) for x in paths])
    assert list(series) == ["gauss, dt"]
    (_, coarse), (_, fine) = series["gauss, dt"]
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
    series = of_runs([derive_read(tmp_path / x) for x in names])
    assert len(series) > 1
    for points in series.values():
        work, error = np.array(sorted(points)).T
        assert len(work) > 1
        assert (work[1:] > 1.2 * work[:-1]).all()
        assert (error[1:] < 0.1 * error[:-1]).all()


def derive_read(path):
    from derive.python.simulated import Simulated

    return Simulated.read(path)


@pytest.mark.parametrize("name", ["a.csv", "a.json"])
def test_a_diagram_of_a_table(tmp_path, name):
    rows = [("gauss", 100, 1e-6), ("gauss", 200, 1e-12), ("rk4", 1000, 1e-5)]
    path = tmp_path / name
    if name.endswith("json"):
        keys = ("method", "work", "error")
        path.write_text(json.dumps([dict(zip(keys, x, strict=True)) for x in rows]))
    else:
        path.write_text("method,work,error\n" + "\n".join(",".join(map(str, x)) for x in rows))
    assert table(path) == {"gauss": [(100, 1e-6), (200, 1e-12)], "rk4": [(1000, 1e-5)]}
    if name.endswith("json"):
        return
    out = tmp_path / "a.pdf"
    assert main(["plot", str(path), "--kind", PRECISION, "--out", str(out)]) == 0
    assert len(out.read_bytes()) > 2000


def test_runs_of_two_motions_are_not_compared(tmp_path):
    runs = [simulated("euler_top", 1.0), simulated("euler_top", 2.0)]
    with pytest.raises(PlotError, match="runs of one motion"):
        of_runs(runs)


def test_a_run_draws_and_writes_itself(tmp_path):
    run = simulated("euler_top", 1.0)
    assert run.plot(tmp_path / "a.svg", "axes").read_bytes() == plot(run, "a.svg", "axes")
    assert np.array_equal(derive_read(run.save(tmp_path / "run.csv")).table, run.table)


def test_the_help_has_every_kind(capsys):
    with pytest.raises(SystemExit):
        main(["plot", "--help"])
    text = " ".join(capsys.readouterr().out.split())
    for kind in (*KINDS, OVERVIEW, PRECISION):
        assert f"{kind}: " in text


def test_the_well_of_a_motion_that_does_not_turn():
    """It may be anywhere: about where the motion was, and no cosine."""
    run = derive.derive("heisenberg").simulate(6.0, start={"zeta_1": 1.0, "zeta_3": 0.4})
    told = run.facts["potential"]
    entry, u = run[told["entry"]], np.array(told["u"])
    assert entry.max() > 2
    assert u[0] <= entry.min()
    assert u[-1] >= entry.max()
    assert np.ptp(u) <= 3 * np.ptp(entry)
