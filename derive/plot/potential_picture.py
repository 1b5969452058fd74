"""The effective potential of what the symmetries leave, with the run in it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..motion.run import Run
from .plot_sheet import COLOURS, label


def potential(figure: Any, run: Run, word: Any) -> None:
    """V against the entry of the group that is left, the energy, and where between its turning
    points the run was."""
    told = run.facts["potential"]
    u, V = (np.array(told[x], float) for x in ("u", "V"))
    at, energy = run[told["entry"]], float(run["energy"][0])
    panel = figure.subplots()
    least = float(np.nanmin(V))
    panel.plot(u, V, c=COLOURS[0], label=word("effective potential"))
    panel.axhline(energy, c="#777777", lw=0.8, label=word("energy"))
    panel.fill_between(u, V, energy, where=energy >= V, color=COLOURS[5], alpha=0.2, lw=0)
    panel.plot(at, np.interp(at, u, V), c=COLOURS[1], lw=3, alpha=0.7, label=word("the run"))
    ends = np.array([at.min(), at.max()])
    panel.plot(ends, [energy, energy], "o", c=COLOURS[1], ms=4)
    panel.vlines(ends, least, energy, colors=COLOURS[1], lw=0.6, linestyles=":")
    room = max(energy - least, 1e-9 * max(abs(energy), 1e-300))
    panel.set_ylim(least - 0.2 * room, energy + 1.5 * room)
    beside = max(float(np.ptp(ends)), 0.1)
    panel.set_xlim(max(u[0], ends[0] - beside), min(u[-1], ends[1] + beside))
    panel.set(xlabel=label(told["entry"]), ylabel="$V$")
    panel.legend(loc="upper center")
