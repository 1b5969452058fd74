"""What the pictures draw: series in time, polhodes, wells of a potential, bodies, fluids."""

import importlib
import re

import numpy as np
import pytest

from derive.motion.emitted import curve, turning_points
from derive.motion.run import Run
from derive.problem.toml import problem_of
from derive.python.derived import derive
from derive.views.language import language
from derive.views.plot import body_pictures
from derive.views.plot.body_pictures import _ellipsoid, drawn, hull, levels, unstable
from derive.views.plot.kind_descriptions import OVERVIEW
from derive.views.plot.pictures import KINDS, plot
from derive.views.plot.plot_sheet import label
from derive.views.plot.time_series import followed, maps, section
from tests.support.drawn_runs import (
    curves,
    figure_of,
    plain_run,
    run_of,
    simulated,
    texts,
    words_of,
)
from tests.support.needs import needs
from tests.support.walks import derived

pytestmark = needs("the module matplotlib")


def panel_of(run, kind):
    """The panel of a picture that has one, and all words of it."""
    (panel,) = figure_of(run, kind).get_axes()
    return panel, " ".join(x.get_text() for x in texts(panel))


# ---------------------------------------------------------------- series in time


def test_what_is_exact_or_constant_but_for_rounding_is_not_drawn():
    kinds = {"energy": "energy", "momentum_1": "conserved", "momentum_2": "conserved"}
    table = [[0, 1.0, 0, 3], [1, 1 + 5e-15, 0, 3], [2, 1, 0, 3.3]]
    panel, words = panel_of(plain_run(table, **kinds), "energy")
    assert [*curves(panel)] == ["linear momentum 2"]
    assert r"constant to $5.11 \cdot 10^{-15}$: energy" in words  # in doubles
    assert "exact: linear momentum 1" in words
    run = plain_run(np.array(table)[:, :3], energy="energy", momentum_1="conserved")
    panel, words = panel_of(run, "energy")
    assert not panel.axison
    assert "exact: linear momentum 1" in words
    assert KINDS["energy"].size(run)[1] < 1


@pytest.mark.parametrize("rows", [2, 3, 5])
def test_a_change_at_one_instant_alone_is_seen(rows):
    change = np.zeros(rows)
    change[rows // 2] = 1e-9
    run = plain_run(np.stack([np.arange(rows), 1 + change], 1), energy="energy")
    panel, _ = panel_of(run, "energy")
    assert [*curves(panel)] == ["energy"]
    assert panel.get_legend() is None  # of one curve the axis has the name
    assert panel.get_ylabel().startswith("energy\nrelative error")


def test_what_is_missing_is_a_gap_and_told():
    """In the state, of a turn, and in the errors, also where the first value is missing."""
    t = np.linspace(0, 9, 10)
    turn = np.stack([np.cos(t / 3), -np.sin(t / 3), np.sin(t / 3), np.cos(t / 3)], -1)
    zeta, energy = np.sin(t / 5), 2 + 1e-3 * t
    zeta[[4, 5]], turn[7, 2], energy[0] = np.nan, np.nan, np.inf
    names = {f"A_{i}{j}": "state" for i in (1, 2) for j in (1, 2)}
    kinds = names | {"zeta_1": "state", "energy": "energy"}
    run = plain_run(np.column_stack([t, turn, zeta, energy]), **kinds)
    figure = figure_of(run, "state")
    angle, velocity = (next(iter(curves(x).values())) for x in figure.get_axes())
    assert np.flatnonzero(np.isnan(angle)).tolist() == [7]
    assert angle[[0, 6, 8, 9]] == pytest.approx(t[[0, 6, 8, 9]] / 3)
    assert np.flatnonzero(np.isnan(velocity)).tolist() == [4, 5]
    told = figure.get_axes()[-1].get_xlabel()
    assert "missing values: 3, the first of $\\zeta_{1}$ at $t = 4$" in told
    panel, _ = panel_of(run, "energy")
    (error,) = curves(panel).values()
    assert error[2:] == pytest.approx(1e-3 * (t[2:] - 1) / 2.001)
    assert "missing values: 1, the first of energy at $t = 0$" in panel.get_xlabel()


@pytest.mark.parametrize("turned", [0.1, 0.5, 1.0, 2.5, 6.0])
def test_a_state_that_is_too_fast_for_its_instants_is_named_instead(turned):
    """By how much it turns from one instant to the next, in radians: 8 instants a period are 0.79;
    at 6.0 it looks like one that turns back by 0.28."""
    t = np.arange(200.0)
    random = np.random.default_rng(3)
    columns = [np.cos(turned * t), np.cos(0.01 * t), 1 + 1e-15 * random.normal(size=200), 0.3 * t]
    names = [f"A_1{k}" for k in range(1, 5)]
    run = plain_run(np.stack([t, *columns], 1), **dict.fromkeys(names, "state"))
    panel, words = panel_of(run, "state")
    slow = turned < 0.7 or turned == 6.0  # which no picture of these instants can know
    assert [*map(label, names if slow else names[1:])] == [*curves(panel)]
    assert ("too few instants:" in words) is not slow
    panel, words = panel_of(plain_run(np.stack([t, columns[0]], 1), A_11="state"), "state")
    assert bool(curves(panel)) is slow
    assert ("too few instants:" in words) is not slow


def test_what_has_too_few_instants_has_no_panel_and_is_told_how_many_would_do():
    """And with as many it has a curve; the names of a product are those of its blocks."""

    def drawn(points):
        t = np.linspace(0, 199, points)
        columns = {"A1_11": np.cos(t), "T2_1": 0.1 * t, "zeta2_1": np.sin(0.02 * t)}
        table = np.stack([t, *columns.values()], 1)
        panels = figure_of(plain_run(table, **dict.fromkeys(columns, "state")), "state").get_axes()
        return [name for x in panels for name in curves(x)], panels[-1].get_xlabel()

    names, told = drawn(200)
    assert names == ["$(T_{2})_{1}$", r"$(\zeta_{2})_{1}$"]
    assert "too few instants: $(A_{1})_{11}$" in told
    (count,) = re.findall("simulate with --points ([0-9]+)", told)
    names, told = drawn(int(count))
    assert names[0] == "$(A_{1})_{11}$"
    assert "instants" not in told


@pytest.mark.parametrize("axis", [1, 2, 3])
def test_of_a_symmetric_body_its_axis_is_drawn_however_far_it_goes(axis):
    t = np.linspace(0, 3, 50)
    k = axis % 3  # about which it turns, and which is not drawn
    i, j = (k + 1) % 3, (k + 2) % 3
    A = np.zeros((50, 3, 3))
    A[:, k, k] = 1
    A[:, i, i] = A[:, j, j] = np.cos(t)
    A[:, i, j], A[:, j, i] = -np.sin(t), np.sin(t)
    names = dict.fromkeys([f"A_{a}{b}" for a in (1, 2, 3) for b in (1, 2, 3)], "state")
    run = plain_run(np.column_stack([t, A.reshape(50, 9)]), **names)
    moments = [2.0, 2.0, 2.0]
    moments[axis - 1] = 0.5
    for body, told in (
        ({}, k + 1),
        ({"inertia": np.diag(moments).tolist()}, axis),
        ({"axis": axis}, axis),
    ):
        run.facts["body"] = body
        panel, *_ = figure_of(run, "state").get_axes()
        assert panel.get_ylabel().startswith(f"axis {told} of the body")


def test_a_rotation_is_drawn_by_its_calmest_axis_and_a_turn_of_the_plane_by_its_angle():
    """The racket turns about its second axis before it flips; dθ/dt = ζ."""
    run = run_of()
    panel, *_ = figure_of(run, "state").get_axes()
    assert panel.get_ylabel() == "axis 2 of the body\n" + r"$A$$\,e_2$"
    tip = {label(x): run[x] for x in ("A_12", "A_22", "A_32")}
    assert all(np.array_equal(tip[x], y) for x, y in curves(panel).items())
    assert [*curves(panel)] == [*tip]
    run = simulated("pendulum", 3.0)
    panel, *_ = figure_of(run, "state").get_axes()
    (angle,) = curves(panel).values()
    assert panel.get_ylabel() == "angle [rad]"
    assert np.abs(np.gradient(angle, run.t) - run["zeta_1"])[1:-1].max() < 0.1
    assert angle[0] == pytest.approx(np.arctan2(run["A_21"][0], run["A_11"][0]))
    panel, *_ = figure_of(simulated("sl3", 1.0), "state").get_axes()
    assert len(curves(panel)) == 9  # no rotation: all of it is wanted


def test_a_component_is_held_against_its_vector():
    names = ("angular_momentum_1", "angular_momentum_2", "integral_1", "integral_2")
    table = [[0, 3e12, 4e12, 5, 100], [1, 3e12, 4e12 + 1, 5.5, 100.5]]
    panel, _ = panel_of(plain_run(table, **dict.fromkeys(names, "conserved")), "energy")
    ends = [x.get_ydata()[-1] for x in panel.get_lines() if len(x.get_xdata())]
    assert ends == pytest.approx([2e-13, 0.1, 0.005], rel=1e-3)
    said = "components relative to the length of their vector"
    assert said in words_of(simulated("euler_top"), "energy")
    assert said not in words_of(simulated("top", 0.5), "energy")  # one component alone


def test_what_is_rounding_at_first_is_held_against_nothing():
    """A trace that vanishes but for rounding, beside others: its own first value is no measure."""
    table = [[0, 2.0, 1e-17, 3.0], [1, 2.0 + 2e-13, 1e-14, 3.0 + 6e-13]]
    run = plain_run(table, trace_2="conserved", trace_3="conserved", trace_4="conserved")
    panel, _ = panel_of(run, "energy")
    names = panel.get_legend_handles_labels()[1]
    assert [x for x in names if "absolute" in x] == ["moment of the vorticity 3 (absolute)"]
    (line,) = [
        x for x in panel.get_lines() if x.get_label().startswith("moment of the vorticity 3")
    ]
    assert line.get_ydata()[-1] == pytest.approx(1e-14, rel=1e-2)


def test_what_changes_by_damping_is_no_error():
    run = plain_run([[0, 1.0], [1, 1.1]], energy="energy")
    for drives, told in ((["damping"], "relative change"), ([], "relative error")):
        driven = Run(run.columns, run.table, {**run.facts, "drives": drives})
        assert told in words_of(driven, "energy")


# ---------------------------------------------------------------- polhodes


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
    figure = figure_of(simulated("euler_top"), "polhode", language("fr").word, (7.0, 3.9))
    told = " ".join(x.get_text() for x in texts(figure))
    assert all(x in told for x in ("axe stable", "axe instable", "séparatrice", "$I = 1.6$"))
    figure.draw_without_rendering()
    left, right = (x.title.get_window_extent().y0 for x in figure.get_axes())
    assert abs(left - right) < 3


def test_a_polhode_on_which_a_torque_acts_has_no_others_and_is_seen_whole():
    run = derived("top").simulate(2.0, start={"zeta_3": 3.0}, points=40)
    told = words_of(run, "polhode")
    assert "at first: a torque acts" in told
    assert "principal axis" in told
    assert not any(x in told for x in ("separatrix", "stable axis"))
    for panel in figure_of(run, "polhode", size=(7.0, 3.9)).get_axes():
        ends = np.abs([x.get_xydata() for x in panel.lines if len(x.get_xydata()) == len(run.t)])
        assert np.nanmax(ends) <= panel.get_xlim()[1]


# ---------------------------------------------------------------- wells


@pytest.mark.parametrize(
    ("problem", "end", "spin"),
    [("top", 0.5, 100.0), ("top", 0.5, 600.0), ("spherical_pendulum", 3.0, None)],
)
def test_the_effective_potential_is_the_energy_where_the_body_turns_back(problem, end, spin):
    """E = V(u) + u̇²/(2 slope): V is below E on the whole run, and meets it where u̇ = 0."""
    run = derived(problem).simulate(end, start={"zeta_3": spin} if spin else {})
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
    run = simulated("lagrange_top")
    p, told = run.facts["parameters"], run.facts["potential"]
    u, V = np.array(told["u"]), np.array(told["V"])
    about_space, about_axis = run["angular_momentum_3"][0], run["body_angular_momentum_3"][0]
    known = p["mgl"] * u + (about_space - about_axis * u) ** 2 / (2 * p["I1"] * (1 - u**2))
    assert pytest.approx(known + about_axis**2 / (2 * p["I3"]), rel=1e-12) == V


def test_the_run_lies_in_the_well_of_its_energy():
    run = derived("top").simulate(1.0, start={"zeta_3": 600.0}, exp=(0.5, 0, 0))
    panel, _ = panel_of(run, "potential")
    well, energy, own, *_ = (np.array(x.get_ydata()) for x in panel.get_lines())
    assert own.max() <= energy[0] * (1 + 1e-3)
    assert own.min() == pytest.approx(0, abs=1e-3 * energy[0])
    assert well[0] > 1.5 * energy[0] < well[-1]
    assert panel.get_ylabel() == r"$V - V_{\min}$ [J]"


def test_the_potential_is_drawn_to_a_pixel_where_it_bends():
    """A wall of a hundredth of the width beside a flat bottom, and few places on a parabola."""

    def wall(u):
        return 0.1 * u**2 + 1e-4 / (1.001 - u)

    u, V = curve(wall, 0.05, -1, 1)
    dense = np.linspace(-1, 1, 100001)
    shown, true = (np.minimum(x, 0.1) / 0.1 for x in (np.interp(dense, u, V), wall(dense)))
    slope = np.gradient(true, dense / 2)
    assert np.max(np.abs(shown - true) / np.hypot(1, slope)) < 1.5e-3
    assert len(u) < 250
    assert len(curve(lambda u: u * u, 1.0, -1, 1)[0]) < 100


@pytest.mark.parametrize("start", [(-0.2, -0.1), (0.2, 0.2), (-0.5, 0.3)])
def test_the_turning_points_are_those_of_the_well_of_the_motion(start):
    def inner(u):
        return u * u - 0.25

    def several(u):
        return inner(u) * (u * u - 0.81)

    assert turning_points(inner, 0.0, *start) == pytest.approx((-0.5, 0.5))
    assert turning_points(several, 0.0, 0.6, 0.7) == pytest.approx((0.5, 0.9))
    low, high = turning_points(lambda u: 0 * u, 1.0, *start)
    assert -1 < low < -1 + 1e-6
    assert 1 - 1e-6 < high < 1


def test_a_motion_that_stays_or_does_not_turn_has_a_window_too():
    """That which does not turn may be anywhere: about where the motion was, and no cosine."""
    asleep = derived("lagrange_top").simulate(1.0, points=5, exp=(0, 0, 0))
    assert np.ptp(asleep.facts["potential"]["u"]) > 0.01
    assert len(plot(asleep, "a.svg", "potential")) > 2000
    run = derived("heisenberg").simulate(6.0, start={"zeta_1": 1.0, "zeta_3": 0.4})
    told = run.facts["potential"]
    entry, u = run[told["entry"]], np.array(told["u"])
    assert entry.max() > 2
    assert u[0] <= entry.min()
    assert u[-1] >= entry.max()
    assert np.ptp(u) <= 3 * np.ptp(entry)


# ---------------------------------------------------------------- fluids


def test_a_wave_along_x_is_the_same_along_y():
    run = plain_run([[0.0, 0.5, 0.0]], re_1_0="state", im_1_0="state")
    field = figure_of(run, "vorticity").get_axes()[0].collections[0].get_array().reshape(129, 129)
    assert np.allclose(field, np.cos(np.linspace(0, 2 * np.pi, 129))[None, :])


def test_the_section_and_the_axes_of_a_spheroid():
    M = maps(simulated("riemann_ellipsoid"))
    assert np.linalg.det(M) == pytest.approx(np.ones(len(M)))
    x, z = section(M[0])
    assert (x.max(), z.max()) == pytest.approx((1.3, 1 / 1.69), rel=1e-3)
    t = np.linspace(0, 1, 50)
    crossing = np.sort(np.stack([1 + t, 2 - t, 0 * t], axis=1), axis=1)[:, ::-1]
    assert np.abs(np.diff(followed(crossing), 2, axis=0)).max() < 1e-12


# ---------------------------------------------------------------- bodies


def test_a_body_of_an_inertia_alone_is_the_ellipsoid_that_has_it():
    a, b, c = 1.0, 2.0, 3.0
    inertia = np.diag([b**2 + c**2, c**2 + a**2, a**2 + b**2]) / 5
    ((root, centre),) = drawn(plain_run([[0]], {"body": {"inertia": inertia.tolist()}}))[
        "ellipsoids"
    ]
    assert np.allclose(root, np.diag([a, b, c]) / c)
    assert centre == [0, 0, 0]


def test_the_body_of_a_run_is_that_of_its_parameters():
    found = derived("sl3").simulate(0.1, start={"x1": 3.0}, points=1).facts["body"]
    assert found["points"] == [[3, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]
    hammer = simulated("hammer").facts
    handle, head = hammer["body"]["solids"]
    assert (len(handle), len(head)) == (2, 12)
    half = hammer["parameters"]["l"] / 2
    assert {round(z, 9) for line in handle for *_, z in line} == {half, -half}


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


def test_a_flat_body_has_its_pictures():
    given = {"m": 1, "centre": [0, 0, -1], "I_centre": [[1, 0, 0], [0, 2, 0], [0, 0, 1]]}
    problem = problem_of({"name": "plate", "group": "SO(3)", "body": {"given": given}})
    run = derive(problem).simulate(1.0, start={"zeta_1": 1.0}, points=4)
    assert not KINDS["body"].lacks(run)
    assert plot(run, "a.svg", OVERVIEW)


def test_a_body_of_the_plane_is_seen_from_above():
    run = simulated("hung_bar", 2.0)
    *_, last = figure_of(run, "body").get_axes()
    dots = np.array([x.get_xydata()[0] for x in last.lines if x.get_marker() == "o"])
    A = np.array([[run[f"A_{i}{j}"][-1] for j in (1, 2)] for i in (1, 2)])
    assert dots == pytest.approx(np.array([A @ [-0.5, 0], A @ [0.5, 0]]))


def test_what_falls_in_the_plane_has_a_potential_along_the_height():
    """One degree of freedom is left, a translation: V = m g T_2 + constant."""
    body = {"solid": "ellipsoid", "density": 1, "quadric": [[1, 0], [0, 4]]}
    falling = {"name": "paddle", "group": "SE(2)", "parameters": {"g": 9.81}, "body": body}
    gravity = [{"kind": "gravity", "g": [0, "-g"]}]
    run = derive(problem_of({**falling, "potential": gravity})).simulate(1.0, points=9)
    told = run.facts["potential"]
    slope = np.gradient(told["V"], told["u"])
    assert told["entry"] == "T_2"
    assert slope == pytest.approx(np.full(len(slope), np.pi / 2 * 9.81), rel=1e-6)


def test_tips_that_go_round_and_round_are_left_out():
    """A top that spins: its axis alone; a slow turn has all three."""

    def named(run):
        return figure_of(run, "axes").get_axes()[0].get_legend_handles_labels()[1]

    assert named(simulated("top", 0.3)) == ["axis 3 of the body, $A e_3$"]
    t = np.linspace(0, 1, 40)
    slow = np.stack(
        [np.cos(t), -np.sin(t), 0 * t, np.sin(t), np.cos(t), 0 * t, 0 * t, 0 * t, 1 + 0 * t]
    )
    run = plain_run(np.vstack([t, slow]).T, **dict.fromkeys(body_pictures.ATTITUDE, "state"))
    assert named(run) == [f"axis {k} of the body, $A e_{k}$" for k in (1, 2, 3)]
    # about (1, 1, 2), so long that all three are a thicket: the calmest alone
    t, j = np.linspace(0, 30, 400), np.array([[0, -2, 1], [2, 0, -1], [-1, 1, 0]]) / np.sqrt(6)
    round_ = [np.eye(3) + np.sin(x) * j + (1 - np.cos(x)) * j @ j for x in t]
    rows = np.column_stack([t, np.reshape(round_, (-1, 9))])
    run = plain_run(rows, **dict.fromkeys(body_pictures.ATTITUDE, "state"))
    assert named(run) == ["axis 3 of the body, $A e_3$"]


def test_a_hull():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0], [0, 0]])
    assert sorted(map(tuple, hull(square))) == [(0, 0), (0, 1), (1, 0), (1, 1)]
