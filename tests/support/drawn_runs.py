"""Runs to be drawn, and what is drawn of them."""

from functools import cache

import numpy as np

from derive.motion.emitted_code import Column
from derive.motion.run import Run
from derive.views.plot.pictures import KINDS
from derive.views.plot.plot_sheet import sheet
from tests.support.library import module_of
from tests.support.states import flow
from tests.support.walks import derived

BODY = {"inertia": [[1.0, 0, 0], [0, 1.6, 0], [0, 0, 2.2]]}
TORUS = 'name = "torus5"\n[algebra]\nof = "torus"\nN = 5\n[inertia]\noperator = "laplacian"\n'
STARTING = {"potential": ("top", 0.5), "spheroid": ("riemann_ellipsoid", 1.0), "body": ("sl3", 2.0)}


def plain_run(table, facts=None, **kinds):
    """A run of numbers: the time, and columns by name, each of a kind."""
    columns = (Column("t", "time"), *(Column(x, kind) for x, kind in kinds.items()))
    return Run(columns, np.asarray(table, float), facts or {})


@cache
def run_of(problem="euler_top", end=30.0, rows=400):
    """A run of the emitted Python by SciPy."""
    code, times = module_of(problem), np.linspace(0, end, rows)
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


@cache
def simulated(problem, end=1.0):
    """A run from where the problem starts."""
    return derived(problem).simulate(end, points=40)


def fitting(kind):
    """A run of which a kind of picture can be drawn."""
    if kind in STARTING:
        return simulated(*STARTING[kind])
    if kind == "outputs":
        read = {"w_1": "state", "gyro_1": "output", "gyro_2": "output", "height": "output"}
        t = np.linspace(0, 1, 50)
        return plain_run(np.column_stack([t, t, np.sin(t), t**2, 1 - t]), **read)
    return run_of(TORUS, 2.0, 5) if kind == "vorticity" else run_of()


def figure_of(run, kind, word=str, size=(7.5, 3.4)):
    """The picture of a kind."""
    figure = sheet(*size)
    KINDS[kind].draw(figure, run, word)
    return figure


def texts(drawn):
    """All texts of a picture, or of a panel."""
    return drawn.findobj(lambda x: hasattr(x, "get_text"))


def words_of(run, kind, word=str):
    """All words of a picture, in a line."""
    return " ".join(" ".join(x.get_text() for x in texts(figure_of(run, kind, word))).split())


def curves(panel):
    """Label → y, of the curves that are seen: two neighbours, or a point with a mark."""
    found = {}
    for line in panel.get_lines():
        there = np.isfinite(line.get_ydata())
        marked = line.get_marker() not in ("None", "") and there[[*(line.get_markevery() or [])]]
        if (there[1:] & there[:-1]).any() or np.any(marked):
            found[line.get_label()] = line.get_ydata()
    return found
