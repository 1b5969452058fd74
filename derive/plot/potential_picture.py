"""The effective potential of what the symmetries leave, with the run in it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..motion.run import Run
from .plot_sheet import COLOURS, label
from .time_series import with_unit


def potential(figure: Any, run: Run, word: Any) -> None:
    """V against the entry of the group that is left, above its least value there, the energy, and
    where between its turning points the run was."""
    told = run.facts["potential"]
    u, V = (np.array(told[x], float) for x in ("u", "V"))
    least, at = float(V.min()), run[told["entry"]]
    V, energy = V - least, float(run["energy"][0]) - least
    panel = figure.subplots()
    panel.plot(u, V, c=COLOURS[0], label=word("effective potential"))
    panel.axhline(energy, c="#777777", lw=0.8, label=word("energy"))
    below = np.minimum(V, energy)
    panel.fill_between(u, below, energy, color=COLOURS[5], alpha=0.2, lw=0)
    ends = np.array([at.min(), at.max()])
    there = np.unique(np.concatenate([ends, u[(u > ends[0]) & (u < ends[1])]]))
    panel.plot(there, np.interp(there, u, V), c=COLOURS[1], lw=3, alpha=0.7, label=word("the run"))
    panel.plot(ends, [energy, energy], "o", c=COLOURS[1], ms=4)
    panel.vlines(ends, 0, energy, colors=COLOURS[1], lw=0.6, linestyles=":")
    room = energy if energy > 1e-12 * abs(energy + least) else float(V.max()) or 1.0
    panel.set_ylim(-0.1 * room, energy + 0.8 * room)
    panel.set_xlim(u[0], u[-1])
    unit = next((x.unit for x in run.columns if x.kind == "energy"), "")
    panel.set(xlabel=label(told["entry"]), ylabel=with_unit(r"$V - V_{\min}$", unit))
    panel.ticklabel_format(axis="x", useOffset=False)
    panel.locator_params(axis="x", nbins=6)
    figure.legend(*panel.get_legend_handles_labels(), loc="outside lower center", ncols=3)
