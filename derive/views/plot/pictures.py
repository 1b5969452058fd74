"""The kinds of pictures, of runs and of ensembles: name → what draws it, and what it needs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from ...language.reserved import did_you_mean, near_name
from ...motion.ensemble import Ensemble
from ...motion.run import Run
from . import body_pictures, ensemble_pictures, time_series
from .kind_descriptions import OVERVIEW, PRECISION
from .plot_sheet import PlotError, ending, look, sheet, written

Needs = tuple[tuple[str, Callable[[Any], bool]], ...]
"""What a picture needs, one after the other: in words, and whether a run has it."""


@dataclass(frozen=True)
class PictureKind:
    """A kind of picture: ``draw(figure, run, word)`` on a sheet of a ``size``, in inches; what it
    ``needs``.  Those of an ensemble are drawn, and measured, with the columns that are chosen after
    all else."""

    draw: Callable[..., None]
    needs: Needs
    size: Callable[..., tuple[float, float]]

    def lacks(self, run: Any) -> str:
        """The first thing that it needs and a run has not; empty where it can be drawn."""
        return next((told for told, has in self.needs if not has(run)), "")


def _columns(*names: str) -> Callable[[Run], bool]:
    return lambda run: {*names} <= {*run.of_kind("state")}


def _sized(width: float, height: float) -> Callable[[Run], tuple[float, float]]:
    return lambda run: (width, height)


def _rotates(run: Run) -> bool:
    return str(run.facts.get("group", "")) in ("SO(3)", "SE(3)")


ROTATION = ("a group of rotations of R³, SO(3) or SE(3)", _rotates)
ATTITUDE = ("columns A_11 … A_33", _columns(*body_pictures.ATTITUDE))
ANY_ATTITUDE = (
    "columns A_11 … A_33, or A_11 … A_22 of the plane",
    lambda run: body_pictures.is_flat(run) or ATTITUDE[1](run),
)

KINDS = {
    "state": PictureKind(
        time_series.state,
        (("columns of the state", lambda run: run.states.shape[1] > 0),),
        time_series.size_of_state,
    ),
    "outputs": PictureKind(
        partial(time_series.state, kind="output"),
        (("columns of outputs", lambda run: bool(run.of_kind("output"))),),
        partial(time_series.size_of_state, kind="output"),
    ),
    "energy": PictureKind(
        time_series.energy,
        (
            (
                "a column of the energy or of what is conserved",
                lambda run: bool(run.of_kind("energy") or run.of_kind("conserved")),
            ),
        ),
        time_series.size_of_energy,
    ),
    "axes": PictureKind(body_pictures.axes, (ROTATION, ATTITUDE), _sized(4.2, 4.0)),
    "polhode": PictureKind(
        body_pictures.polhode,
        (
            ROTATION,
            ("columns zeta_1 … zeta_3", _columns(*body_pictures.VELOCITY)),
            (
                "a tensor of inertia, that of points or solids, of [body] given, or of an ℓ that "
                "is quadratic in zeta_1 … zeta_3",
                lambda run: "inertia" in run.facts.get("body", {}),
            ),
        ),
        _sized(7.0, 3.9),
    ),
    "body": PictureKind(
        body_pictures.body,
        (
            ANY_ATTITUDE,
            (
                "a body of points, of solids or with a tensor of inertia",
                lambda run: any(body_pictures.drawn(run).values()),
            ),
        ),
        _sized(8.0, 2.2),
    ),
    "potential": PictureKind(
        time_series.potential,
        (
            (
                "symmetries that leave one degree of freedom",
                lambda run: bool(run.facts.get("potential")),
            ),
        ),
        _sized(5.0, 3.4),
    ),
    "spheroid": PictureKind(
        time_series.spheroid,
        (
            ATTITUDE,
            ("a body that is one solid ellipsoid", time_series.is_ellipsoid),
            ("a column of the multiplier", lambda run: bool(run.of_kind("multiplier"))),
        ),
        _sized(7.5, 3.0),
    ),
    "vorticity": PictureKind(
        time_series.vorticity,
        (("columns re_1_0, im_1_0, … of the torus", _columns("re_1_0", "im_1_0")),),
        _sized(7.0, 3.3),
    ),
}
ENSEMBLE_KINDS = {
    "spread": PictureKind(
        ensemble_pictures.spread,
        (
            (
                "several instants, --points, and a motion that reached the end, or an event",
                ensemble_pictures.fits_spread,
            ),
        ),
        ensemble_pictures.size_of_spread,
    ),
    "ends": PictureKind(
        ensemble_pictures.ends,
        (("a motion that reached the end, or an event", ensemble_pictures.fits_ends),),
        ensemble_pictures.size_of_ends,
    ),
}


def plot(
    run: Run | Ensemble,
    name: str,
    kind: str = "",
    word: Any = str,
    columns: Sequence[str] = (),
    mark: str = ".",
) -> bytes:
    """The bytes of a picture of a run or of an ensemble, in the format of the ending of ``name``;
    ``kind`` of KINDS or ENSEMBLE_KINDS, or OVERVIEW, else what suits it; ``word``: English → the
    language of the labels; ``columns``: of the state of an ensemble, those that are drawn;
    ``mark``: of decimals.  ``PlotError``."""
    ending(name)
    kinds, what = KINDS, "run"
    more: tuple[Sequence[str], ...] = ()
    if isinstance(run, Ensemble):
        kinds, more, what = ENSEMBLE_KINDS, (columns,), "ensemble"
    elif columns:
        raise PlotError("columns are chosen of an ensemble: leave out --column")
    elif not len(run.table):
        raise PlotError("the run has no instant: nothing to draw")
    chosen = _chosen(kinds, run, kind, what)
    with look():
        figure = _sheet_of(kinds, chosen, run, word, more)
        if kinds is KINDS and (title := str(run.facts.get("title", ""))):
            figure.suptitle(word(title).replace("$", r"\$"), fontsize=10)
        return written(figure, name, mark)


def plot_energies(
    listed: Sequence[tuple[str, Run | Ensemble]], name: str, word: Any = str, mark: str = "."
) -> bytes:
    """The bytes of a picture of the errors of the energy of several runs, each with what it is
    called, as :func:`plot`."""
    ending(name)
    runs: list[tuple[str, Run]] = []
    for called, run in listed:
        if isinstance(run, Ensemble) or not (len(run.table) and run.of_kind("energy")):
            raise PlotError(f"{called}: no run with a column of the energy: leave it out")
        runs.append((called, run))
    if len({x.columns[0].unit for _, x in runs}) > 1:
        raise PlotError("energy: some runs have a time in s, some have no units: draw them apart")
    with look():
        figure = sheet(6.5, 3.4)
        time_series.energies(figure, runs, word)
        return written(figure, name, mark)


def _chosen(kinds: Mapping[str, PictureKind], run: Any, kind: str, what: str) -> list[str]:
    """The kinds that are drawn of a run, or of an ensemble."""
    fitting = [x for x, own in kinds.items() if not own.lacks(run)]
    there = f"there are {', '.join(fitting)}" if fitting else "nothing else can be drawn of it"
    if not kind:
        first = ("vorticity", "state", "axes", "energy") if kinds is KINDS else tuple(kinds)
        kind = next((x for x in first if x in fitting), first[-1])
    if kind == PRECISION:
        raise PlotError(f"{kind} is of several runs, derive plot A B …, or of a table; {there}")
    if kind != OVERVIEW and kind not in {**KINDS, **ENSEMBLE_KINDS}:
        near = did_you_mean(near_name(kind, [*kinds, OVERVIEW]), after=" ")
        raise PlotError(f"unknown kind {kind[:40]!r}; {near}for this {what} {there}")
    chosen = fitting if kind == OVERVIEW else [kind]
    if not chosen or not {*chosen} <= {*fitting}:
        needs = "a column of the state or of the energy"
        if kind in kinds:
            needs = kinds[kind].lacks(run)
        elif kind != OVERVIEW:
            other = "a run" if what == "ensemble" else "an ensemble"
            raise PlotError(f"{kind} is of {other}, and this is none; {there}")
        raise PlotError(f"{kind} needs {needs}, which this {what} has not; {there}")
    return chosen


def _sheet_of(
    kinds: Mapping[str, PictureKind],
    chosen: list[str],
    run: Any,
    word: Any,
    columns: tuple[Any, ...],
) -> Any:
    """A figure with some kinds, those of several in two columns of about one height."""
    sizes = [kinds[kind].size(run, *columns) for kind in chosen]
    if len(chosen) == 1:
        figure = sheet(*sizes[0])
        kinds[chosen[0]].draw(figure, run, word, *columns)
        return figure
    first, *others = sorted(range(len(chosen)), key=lambda k: (k > 0, -sizes[k][1]))
    halves: tuple[list[int], list[int]] = ([first], [])

    def height(half: list[int]) -> float:
        return sum(sizes[k][1] for k in half)

    for k in others:
        min(halves, key=height).append(k)
    widths = [max(sizes[k][0] for k in half) for half in halves]
    figure = sheet(sum(widths), max(map(height, halves)))
    for column, half in zip(
        figure.subfigures(1, 2, width_ratios=widths, squeeze=False)[0], halves, strict=True
    ):
        heights = [sizes[k][1] for k in sorted(half)]
        rows = column.subfigures(len(half), 1, height_ratios=heights, squeeze=False)
        for row, k in zip(rows[:, 0], sorted(half), strict=True):
            kinds[chosen[k]].draw(row, run, word, *columns)
    return figure
