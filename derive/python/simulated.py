"""A run, and an ensemble, in Python."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from contextlib import suppress
from html import escape
from pathlib import Path

import numpy as np

from ..motion.ensemble import Ensemble, Part
from ..motion.run import Run, shown
from .api import in_keywords


def _drawn(
    run: Run | Ensemble, path: Path, kind: str, lang: str, columns: Sequence[str] = ()
) -> Path:
    from ..views.language import language
    from ..views.plot.pictures import plot

    words = language(lang)
    with in_keywords():
        path.write_bytes(plot(run, path.name, kind, words.word, columns, words.mark))
    return path


class Simulated(Run):
    """A run with pictures and files."""

    @classmethod
    def of(cls, run: Run) -> Simulated:
        """The same run."""
        return cls(run.columns, run.table, run.facts)

    @classmethod
    def read(cls, path: str | Path) -> Simulated:
        """The run in a file; ``RunFileError`` where there is none."""
        from ..motion.run import read

        return cls.of(read(Path(path)))

    def plot(self, out: str | Path, kind: str = "", lang: str = "en") -> Path:
        """Draw it to a file, .svg, .pdf or .png, as ``derive plot --kind`` does; ``PlotError``."""
        return _drawn(self, Path(out), kind, lang)

    def _repr_html_(self) -> str:
        """Its picture, where there is matplotlib, and a table of what it begins and ends with."""
        from ..views.plot.pictures import plot
        from ..views.plot.plot_sheet import PlotError

        if not len(self.t):
            return f"<p>{escape(repr(self))}</p>"
        with suppress(PlotError), in_keywords():
            drawing = base64.b64encode(plot(self, "run.svg")).decode()
            return f'<img src="data:image/svg+xml;base64,{drawing}">{self._ends()}'
        return self._ends()

    def _ends(self) -> str:
        """The table of the first and last numbers of each column, and of the most that it was away
        from the first."""
        from ..views.plot.plot_sheet import with_unit

        unit = self.columns[0].unit
        first, last = (f"t = {t:g} {unit}".rstrip() for t in self.t[[0, -1]])
        rows: list[tuple[str, ...]] = [("", first, last, "largest change")]
        for x in self.columns[1:]:
            y = self[x.name]
            name = with_unit(shown(self.facts, x.name), x.unit)
            rows.append((name, *(f"{v:.6g}" for v in (y[0], y[-1], np.abs(y - y[0]).max()))))
        cells = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows)
        return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"

    def save(self, out: str | Path) -> Path:
        """Write it to a file, .npz, .csv or .parquet."""
        from ..motion.run import written

        path = Path(out)
        path.write_bytes(written(self, path.name))
        return path


class SimulatedEnsemble(Ensemble):
    """An ensemble with files."""

    @classmethod
    def of(cls, e: Ensemble) -> SimulatedEnsemble:
        """The same ensemble."""
        return cls(**vars(e))

    @classmethod
    def read(cls, path: str | Path) -> SimulatedEnsemble:
        """The ensemble in a file; of an .npz the states stay on the disk. ``RunFileError`` where
        there is none."""
        from ..motion.ensemble_files import read

        return cls.of(read(Path(path)))

    def plot(
        self, out: str | Path, kind: str = "", lang: str = "en", columns: Sequence[str] = ()
    ) -> Path:
        """Draw it to a file, .svg, .pdf or .png, as ``derive plot --kind --column`` does;
        ``PlotError``."""
        return _drawn(self, Path(out), kind, lang, columns)

    def save(self, out: str | Path) -> Path:
        """Write it to a file, .npz, .csv or .parquet."""
        from ..motion.ensemble_files import writer
        from ..motion.run import format_of

        path = Path(out)
        format_of(path.name)
        with path.open("wb") as file, writer(file, path.name, self) as made:
            made.add(Part(self.varied, self.status, self.states, self.end))
        return path
