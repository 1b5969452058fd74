"""The state against time, what was kept, potentials, spheroids, the fluid on the torus."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from textwrap import wrap
from typing import Any

import numpy as np

from ...language.reserved import by_letter, letter_and_suffix, waves
from ...motion.emitted_code import VECTORS, Column, in_words, parts
from ...motion.run import Array, Run, shown, symmetry_axis
from .body_pictures import BODY_AXIS, attitude, in_math, paths
from .plot_sheet import COLOURS, at_time, label, method_in_words, time_label, with_unit

# The state against time, and how well what motions keep was kept.

MOST = 12
"""So many curves a panel: of more, the first are drawn."""

LONG = 14
"""Longer names, which are words and no letters, stand one a line; those of letters eight."""

LINE = 30
"""So many letters a line of what stands beside an axis: as much as a panel is high."""

OFTEN, EVEN = 0.25, 1e-6
"""A column that turns back at more than this part of the instants has fewer than eight of them a
period, too few for a curve; unless it is even but for so much of its panel."""


def letters(run: Run, kind: str = "state") -> list[tuple[str, list[Column]]]:
    """The columns of the state, of many the first, or of another kind, by letter and unit."""
    named = (replace(x, name=shown(run.facts, x.name)) for x in run.columns if x.kind == kind)
    known = {x.name: x for x in named}
    grouped = by_letter(known) if kind == "state" else {}
    for name in known if kind != "state" else ():
        grouped.setdefault(parts(name)[0], []).append(name)
    found: dict[tuple[str, str], list[Column]] = {}
    for key, names in grouped.items():
        for x in names:
            found.setdefault((key, known[x].unit), []).append(known[x])
    return [(key, x) for (key, _), x in found.items()][: 8 if kind == "state" else None]


@dataclass(frozen=True)
class CurvesOfUnit:
    """Curves of one unit, by their names."""

    name: str
    unit: str
    curves: dict[str, Array]


def turned(run: Run, key: str, members: list[Column], word: Any) -> CurvesOfUnit | None:
    """Of a rotation of space the tip of the axis of a symmetric body, of another that of the axis
    that goes least far, of one of the plane its angle: all entries say no more, and hide it.
    ``None`` of other columns."""
    n = math.isqrt(len(members))
    if [letter_and_suffix(x.name)[1] for x in members] not in INDICES:
        return None
    A = np.stack([run[x.name] for x in members], -1).reshape(-1, n, n)
    there = np.isfinite(A).all(axis=(1, 2))
    if not np.allclose(A[there] @ A[there].transpose(0, 2, 1), np.eye(n), atol=1e-6):
        return None
    if n == 2:
        angle: Array = np.full(len(A), np.nan)
        angle[there] = np.unwrap(np.arctan2(A[there, 1, 0], A[there, 0, 0]))
        return CurvesOfUnit(word("angle"), "rad", {word("angle"): angle})
    body = run.facts.get("body", {}) if key == "A" else {}
    axis = symmetry_axis(np.array(body["inertia"])) if "inertia" in body else body.get("axis", 0)
    k = axis - 1 if axis else int(np.argmin(paths(A)))
    tip = {label(members[n * i + k].name): A[:, i, k] for i in range(n)}
    return CurvesOfUnit(f"{word(BODY_AXIS).format(k=k + 1)}\n{label(key)}$\\,e_{k + 1}$", "", tip)


INDICES = [[f"{i}{j}" for i in range(1, n + 1) for j in range(1, n + 1)] for n in (2, 3)]
"""Of the entries of a matrix of the plane, and of one of space."""


def size_of_state(run: Run, kind: str = "state") -> tuple[float, float]:
    """Width and height of :func:`state`."""
    listed, told = panels(run, str, kind)
    return 6.5, 0.6 + 1.7 * len(listed) + 0.15 * len(told.splitlines())


def state(figure: Any, run: Run, word: Any, kind: str = "state") -> None:
    """The columns of the state against time, a panel each letter (A, T, ζ, …); or those of what is
    read off the motion, a panel each name."""
    listed, told = panels(run, word, kind)
    axes = figure.subplots(len(listed) or 1, 1, sharex=True, squeeze=False)[:, 0]
    for axis, panel in zip(axes, listed, strict=False):
        for k, (name, y) in enumerate(panel.curves.items()):
            axis.plot(run.t, y, **_style(k), label=name)
        name = next(iter(panel.curves)) if len(panel.curves) == 1 else panel.name
        axis.set_ylabel(with_unit(name, panel.unit))
        _legend(axis, run, "")
    if not listed:
        axes[0].set_axis_off()
        axes[0].text(0.5, 0.5, told, transform=axes[0].transAxes, ha="center", va="center", size=8)
        return
    axes[-1].set_xlabel(time_label(run) + missing(run, word, kind) + f"\n{told}".rstrip())


def panels(run: Run, word: Any, kind: str) -> tuple[list[CurvesOfUnit], str]:
    """Those of :func:`state` with what has instants enough for a curve; and lines that say what has
    too few, and how many would do, empty where nothing has."""
    found, fast, most = [], [], 0.0
    for key, members in letters(run, kind):
        drawn = turned(run, key, members, word) if kind == "state" else None
        if drawn is None:
            curves = {label(x.name): run[x.name] for x in members}
            drawn = CurvesOfUnit(label(key), members[0].unit, curves)
        size, slow = max(float(np.abs(known(y)).max()) for y in drawn.curves.values()), {}
        for name, y in [*drawn.curves.items()][:MOST]:
            if (often := _turning_back(y, size)) > OFTEN:
                fast.append(name)
                most = max(most, often)
            else:
                slow[name] = y
        if slow:
            found.append(replace(drawn, curves=slow))
    if not fast:
        return found, ""
    count = 2 * len(run.t) * most / OFTEN  # what turns back so often may do so more often still
    power = 10 ** int(math.log10(count) - 1)
    advice = word("simulate with --points {count}").format(count=math.ceil(count / power) * power)
    return found, _named(f"{word('too few instants:')} ", fast) + f"\n{advice}"


def known(y: Array) -> Array:
    """The values of a column that are numbers, 0 where none is."""
    found: Array = y[np.isfinite(y)]
    return found if len(found) else np.zeros(1)


def missing(run: Run, word: Any, *kinds: str) -> str:
    """A line below: how many values of the columns of some kinds are no numbers, which are gaps in
    their curves, and where the first one is; empty where there is none."""
    columns = (x.name for x in run.columns if x.kind in kinds)
    lost = [(k, x) for x in columns for k in np.flatnonzero(~np.isfinite(run[x])).tolist()]
    if not lost:
        return ""
    first, name = min(lost, key=lambda x: x[0])
    told = word("missing values: {count}, the first of {name} at {time}")
    where = {"name": label(shown(run.facts, name)), "time": at_time(run, first)}
    return f"\n{told.format(count=len(lost), **where)}"


def _turning_back(y: Array, size: float) -> float:
    """At what part of the instants of its run a column turns back; 0 of one that is even."""
    y = known(y)
    if len(y) < 1 / OFTEN or np.ptp(y) <= EVEN * size:
        return 0.0
    steps = np.diff(y)
    return float((steps[1:] * steps[:-1] < 0).mean())


def _is_long(name: str) -> bool:
    return len(name) > LONG and name[0] != "$"


def _named(why: str, names: Sequence[str]) -> str:
    """Why some curves are not drawn, and which; empty where all are."""
    each = 1 if any(map(_is_long, names)) else 8
    lines = [", ".join(names[k : k + each]) for k in range(0, len(names), each)]
    return why + ",\n".join(lines) if names else ""


def _legend(panel: Any, run: Run, others: str) -> None:
    """The legend, and words of what is not drawn, which stand in the panel where nothing is."""
    drawn = len(panel.get_lines())
    if not drawn:
        panel.text(0.5, 0.5, others, transform=panel.transAxes, ha="center", va="center", size=8)
        panel.set(xlim=run.t[[0, -1]], yticks=[])
        panel.spines["left"].set_visible(False)
        return
    if others:
        panel.plot([], [], " ", label=others)
    elif drawn == 1:  # its name is that of the axis
        return
    several = drawn > 6 and not any(_is_long(str(x.get_label())) for x in panel.get_lines())
    panel.legend(loc="center left", bbox_to_anchor=(1, 0.5), ncols=1 + several)


def _style(k: int) -> dict[str, str]:
    """The line of curve k, from 0."""
    return {"ls": ("-", "--", ":")[k // len(COLOURS) % 3], "c": COLOURS[k % len(COLOURS)]}


AT_ROUNDING = 1e-13
"""A relative error that is nowhere larger is rounding: no curve, but a number."""


def _curve(panel: Any, t: Array, away: Array, k: int, **more: Any) -> None:
    """Curve k of what is away from its first value, where it is, in powers of ten; a point that
    stands alone is a dot."""
    away = np.where(away == 0, np.nan, away)
    there = np.isfinite([np.nan, *away, np.nan])
    alone = np.flatnonzero(there[1:-1] & ~there[:-2] & ~there[2:]).tolist()
    dots = {"marker": ".", "markevery": alone} if alone else {}
    panel.semilogy(t, away, **_style(k), **dots, **more)


def constant(away: Array, relative: bool, word: Any) -> str:
    """How constant what is constant is, in words; empty where it has a curve."""
    most = float(known(away).max())
    if not most:
        return f"{word('exact:')} "
    if not relative or most >= AT_ROUNDING:
        return ""
    return f"{word('constant to {bound}:').format(bound=f'${in_math(most)}$')} "


def changes(run: Run) -> dict[str, tuple[Array, float]]:
    """|E − E₀| / |E₀| of the energy and of every conserved quantity, and |E₀|: of a component of a
    vector that of the vector; where it is 0, or nothing but rounding beside others of its name, the
    difference itself."""
    sizes, kept = norms(run), {**run.of_kind("energy"), **run.of_kind("conserved")}
    scales = {name: sizes.get(vector_of(name), abs(known(y)[0])) for name, y in kept.items()}
    for name, scale in scales.items():
        alike = [y for x, y in scales.items() if base_of(x) == base_of(name)]
        scales[name] = scale if scale > ROUNDED * max(alike) else 0.0
    return {x: (np.abs(y - known(y)[0]) / (scales[x] or 1.0), scales[x]) for x, y in kept.items()}


def size_of_energy(run: Run) -> tuple[float, float]:
    """Width and height of :func:`energy`, small where all is constant."""
    found = changes(run).values()
    return 6.5, 0.4 + 0.2 * len(found) if all(constant(x, y > 0, str) for x, y in found) else 3.4


def energy(figure: Any, run: Run, word: Any) -> None:
    """The :func:`changes`.  What is exact, or constant but for rounding, is told.  They are no
    errors where damping, an input or the time changes what is kept."""
    panel, found = figure.subplots(), changes(run)
    curves = [(run.t, in_words(name, word), *x) for name, x in found.items()]
    kept = _drawn_errors(panel, curves, word)
    vectors = any(abs(known(run[x])[0]) < scale for x, (_, scale) in found.items())
    told = word("components relative to the length of their vector") if vectors else ""
    error = word("relative change" if run.facts.get("drives") else "relative error")
    _errors(panel, run, (error, *wrap(told, LINE)), kept, missing(run, word, "energy", "conserved"))


def energies(figure: Any, runs: Sequence[tuple[str, Run]], word: Any) -> None:
    """|E − E₀| / |E₀| of several runs, each with what it is called and its method; of a run that
    begins with no energy, the difference itself."""
    panel, curves = figure.subplots(), []
    for name, run in runs:
        first = known(y := run["energy"])[0]
        away = np.abs(y - first) / (abs(first) or 1.0)
        drawn = method_in_words(run, word) + f"\n{name}".replace("$", r"\$")
        curves.append((run.t, drawn, away, abs(first)))
    kept = _drawn_errors(panel, curves, word, lw=0.8)
    driven = any(run.facts.get("drives") for _, run in runs)
    change, error = "relative change of the energy", "relative error of the energy"
    lost = "".join(missing(x, word, "energy") for _, x in runs)
    _errors(panel, runs[0][1], (word(change if driven else error),), kept, lost)


def _drawn_errors(panel: Any, curves: Sequence[Any], word: Any, **more: Any) -> list[str]:
    """Draw errors, each of the times, what it is called, what is away and relative to which size;
    what is constant is told instead."""
    kept = []
    for k, (t, drawn, away, scale) in enumerate(curves):
        if told := constant(away, scale > 0, word):
            kept.append(told + drawn)
            continue
        drawn += "" if scale else f" ({word('absolute')})"
        _curve(panel, t, away, k, label=drawn, **more)
    return kept


def _errors(panel: Any, run: Run, about: Sequence[str], kept: Sequence[str], lost: str) -> None:
    """Finish a panel of errors: what is ``kept`` or ``lost`` is said; all is kept: no axes."""
    if not panel.get_lines():
        panel.set_axis_off()
        about, kept = (), [*kept, *about[1:], *lost.split("\n")[1:]]
    elif not kept and len(panel.get_lines()) == 1:
        about = (panel.get_lines()[0].get_label(), *about)
    panel.set(xlabel=(time_label(run) + lost) * bool(about), ylabel="\n".join(about))
    _legend(panel, run, "\n".join(kept))


def norms(run: Run) -> dict[str, float]:
    """Vector → its norm at first, of the conserved quantities that are vectors."""
    first: dict[str, list[float]] = {}
    for name, y in run.of_kind("conserved").items():
        first.setdefault(vector_of(name), []).append(float(known(y)[0]))
    return {name: math.hypot(*parts) for name, parts in first.items() if name}


def vector_of(name: str) -> str:
    """Of which vector a conserved quantity is a component; empty where of none."""
    return base_of(name) if base_of(name) in VECTORS else ""


def base_of(name: str) -> str:
    """A name without its number: ``trace`` of ``trace_3``."""
    return re.sub(r"_\d+$", "", name)


ROUNDED = 1e-12
"""What is smaller, relative to others of its name, was 0."""


# The effective potential of what the symmetries leave, with the run in it.


def potential(figure: Any, run: Run, word: Any) -> None:
    """V against the entry of the group that is left, above its least value there, the energy, and
    where between its turning points the run was."""
    told = run.facts["potential"]
    u, V = (np.array(told[x], float) for x in ("u", "V"))
    least, at = float(V.min()), run[told["entry"]]
    V, energy = V - least, float(known(run["energy"])[0]) - least
    panel = figure.subplots()
    panel.plot(u, V, c=COLOURS[0], label=word("effective potential"))
    panel.axhline(energy, c="#777777", lw=0.8, label=word("energy"))
    below = np.minimum(V, energy)
    panel.fill_between(u, below, energy, color=COLOURS[5], alpha=0.2, lw=0)
    ends = np.array([known(at).min(), known(at).max()])
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


# A fluid that stays an ellipsoid: its semi-axes, its pressure, and its section, in time.

SECTIONS = 6
PRESSURE = "#7a4b00"
"""The colour of its axis, its curve, and of when it is negative."""


def is_ellipsoid(run: Run) -> bool:
    """Is the body one ellipsoid about the origin?"""
    body = run.facts.get("body", {})
    ellipsoids, others = body.get("ellipsoids", ()), body.get("points") or body.get("solids")
    return len(ellipsoids) == 1 and not others


def maps(run: Run) -> Array:
    """The maps of the unit ball to the ellipsoid, (instants, 3, 3)."""
    (map_, _), *_ = run.facts["body"]["ellipsoids"]
    found: Array = attitude(run) @ np.array(map_, float)
    return found


def spheroid(figure: Any, run: Run, word: Any) -> None:
    """Semi-axes and integral of the pressure, one below the other, and sections by the plane y = 0
    of space."""
    M = maps(run)
    places = figure.subplot_mosaic(
        [["axes", "section"], ["pressure", "section"]], width_ratios=(3, 2)
    )
    sizes, below, right = (places[x] for x in ("axes", "pressure", "section"))
    below.sharex(sizes)
    axes = followed(np.asarray(np.linalg.svd(M, compute_uv=False), dtype=float))
    for k in range(3):
        sizes.plot(run.t, axes[:, k], ("-", "--", ":")[k], c=COLOURS[k], label=f"$a_{k + 1}$")
    (column,) = (x for x in run.columns if x.kind == "multiplier")
    length = "m" if column.unit else ""  # a run is in SI or has no units
    sizes.set(ylabel=with_unit(word("semi-axes"), length))
    sizes.tick_params(labelbottom=False)
    sizes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    theta = run[column.name]
    below.plot(run.t, theta, c=PRESSURE)
    below.axhline(0, c="#777777", lw=0.5)
    where = below.get_xaxis_transform()
    below.fill_between(
        run.t, 0, 1, where=theta < 0, transform=where, color=PRESSURE, alpha=0.12, lw=0
    )
    told = wrap(with_unit(word("integral of the pressure"), column.unit), LINE // 2)
    below.set(xlabel=time_label(run), ylabel="\n".join(told))
    rows = np.linspace(0, len(M) - 1, SECTIONS).round().astype(int)
    for shade, k in zip(np.linspace(0.25, 1, SECTIONS), rows, strict=True):
        right.plot(*section(M[k]), c=COLOURS[0], alpha=shade, label=at_time(run, k))
    right.set(aspect="equal", title=word("section y = 0 (space)"))
    right.set(xlabel=with_unit(label("x"), length), ylabel=with_unit(label("z"), length))
    right.legend(loc="center left", bbox_to_anchor=(1, 0.5))


def followed(sizes: Array) -> Array:
    """Sizes by instants, (instants, 3), in such an order at each that the curves go on straight."""
    found = sizes.copy()
    for k in range(2, len(found)):
        ahead = 2 * found[k - 1] - found[k - 2]
        found[k] = min(permutations(sizes[k]), key=lambda x: float(np.abs(x - ahead).sum()))
    return found


def section(M: Array) -> Array:
    """The section of {M u : |u| ≤ 1} with the plane of the first and third axes of space, (2,
    places): ⟨r, (M M̄)⁻¹ r⟩ = 1."""
    Q = np.linalg.inv(M @ M.T)[np.ix_([0, 2], [0, 2])]
    turn = np.linspace(0, 2 * np.pi, 181)
    found: Array = np.linalg.inv(np.linalg.cholesky(Q)).T @ np.stack([np.cos(turn), np.sin(turn)])
    return found


# The fluid on the torus: its vorticity at the last instant, the spectrum of enstrophy.

ROUNDING = 1e-32
"""What the enstrophy of a mode is, relative, where its coefficient is nothing but rounding."""


def amplitudes(run: Run) -> tuple[Array, Array]:
    """The waves n, (count, 2), and ω_n at the last instant, of the columns re_n, im_n."""
    names = [*run.of_kind("state")]
    found: Array = np.array(waves(names))
    x = np.array([run[name][-1] for name in names])
    return found[:, :2], x[found[:, 2]] + 1j * x[found[:, 3]]


def vorticity(figure: Any, run: Run, word: Any) -> None:
    """ω(x, y) = Σ ω_n e^{in·x}, with ω_−n the conjugate; the enstrophy Σ |ω_n|², its sum over the n
    whose |n| is nearest to each whole number, but for what is rounding alone."""
    modes, amplitude = amplitudes(run)
    grid = np.linspace(0, 2 * np.pi, 129)
    along = [np.exp(1j * np.outer(modes[:, k], grid)) for k in (0, 1)]
    field = 2 * np.einsum("n,nx,ny->yx", amplitude, *along).real
    left, right = figure.subplots(1, 2)
    most = float(np.abs(field).max()) or 1.0
    image = left.pcolormesh(grid, grid, field, cmap="RdBu_r", vmin=-most, vmax=most,
                            rasterized=True)  # fmt: skip
    left.set(aspect="equal", xlabel="$x$", ylabel="$y$", title=at_time(run, -1))
    figure.colorbar(image, ax=left, label=word("vorticity"))
    shell = np.rint(np.hypot(*modes.T)).astype(int)
    spectrum = 2 * np.bincount(shell, np.abs(amplitude) ** 2)
    seen = np.flatnonzero(spectrum > ROUNDING * spectrum.max())
    right.loglog(seen, spectrum[seen], "o-", c=COLOURS[0], ms=3)
    right.set(xlabel="$|n|$", ylabel=word("enstrophy"))
