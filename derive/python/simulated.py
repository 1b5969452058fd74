"""A run, and an ensemble, in Python, which can be drawn and written."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..motion.ensemble import Ensemble, Part
from ..motion.run import Run
from .keywords import in_keywords


def _drawn(
    run: Run | Ensemble, path: Path, kind: str, lang: str, columns: Sequence[str] = ()
) -> Path:
    from ..plot.pictures import plot
    from ..views.language import language

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
        from ..motion.run_files import read

        return cls.of(read(Path(path)))

    def plot(self, out: str | Path, kind: str = "", lang: str = "en") -> Path:
        """Draw it to a file, .svg, .pdf or .png, as ``derive plot --kind`` does; ``PlotError``."""
        return _drawn(self, Path(out), kind, lang)

    def save(self, out: str | Path) -> Path:
        """Write it to a file, .npz, .csv or .parquet."""
        from ..motion.run_files import written

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
        from ..motion.run_files import format_of

        path = Path(out)
        format_of(path.name)
        with path.open("wb") as file, writer(file, path.name, self) as made:
            made.add(Part(self.varied, self.status, self.states, self.end))
        return path
