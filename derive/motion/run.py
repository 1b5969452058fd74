"""A run: a motion as a table, a row an instant, its columns, its files."""

from __future__ import annotations

import io
import json
import math
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..language.limits import Refused
from .emitted_code import KINDS, Column

__all__ = ("KINDS", "Array", "Column", "Happening", "Run")

Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Happening:
    """An event that happened: its name, when, "rising" or "falling", did it end the run, and the
    state then."""

    name: str
    t: float
    direction: str
    terminal: bool
    state: Array

    def plain(self) -> dict[str, Any]:
        """As JSON has it."""
        return {**vars(self), "state": self.state.tolist()}


@dataclass(frozen=True)
class Run:
    """A motion of one problem.

    ``table``: (instants, columns), the first column the time; ``facts``: what it was made of, as
    JSON has it: the name of the problem, its title, group and hash, ``unsought`` (why nothing but
    the energy stands as what is kept, if so), ``filled`` (does the body fill a solid),
    ``parameters`` (name → number), ``method`` (the step, its tolerance or size), ``language`` (in
    which it was run, C or Python), ``evaluations`` (of the rate), ``vanishing`` (what it keeps that
    is 0 in any state with these parameters), ``ended`` (empty, or why it stopped too soon),
    ``events`` (those that happened), ``body`` and ``potential`` (what pictures need).
    """

    columns: tuple[Column, ...]
    table: Array
    facts: Mapping[str, Any] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns."""
        return tuple(x.name for x in self.columns)

    def __getitem__(self, name: str) -> Array:
        """A column by its name, or by that of a block; ``KeyError`` says which there are."""
        name = called(self.facts, name)
        if name not in self.names:
            raise KeyError(f"no column {name!r:.60}; there are {', '.join(self.names)}")
        return self.table[:, self.names.index(name)]

    def of_kind(self, kind: str) -> dict[str, Array]:
        """Name → column, of all columns of a kind."""
        return {x.name: self[x.name] for x in self.columns if x.kind == kind}

    @property
    def t(self) -> Array:
        """The instants."""
        return self.table[:, 0]

    @property
    def states(self) -> Array:
        """The states, (instants, size of the state)."""
        return self.table[:, [k for k, x in enumerate(self.columns) if x.kind == "state"]]

    @property
    def ended(self) -> str:
        """Why the motion stopped before its time; empty where it did not."""
        return str(self.facts.get("ended", ""))

    @property
    def events(self) -> tuple[Happening, ...]:
        """The events that happened, in order of time."""
        listed = self.facts.get("events", ())
        return tuple(Happening(**{**x, "state": np.array(x["state"], dtype=float)}) for x in listed)

    def __repr__(self) -> str:
        name, rows = self.facts.get("problem", "?"), len(self.table)
        span = f", t = {self.t[0]:g} … {self.t[-1]:g}" if rows else ""
        return f"<run of {name}: {rows} instant{'s' * (rows != 1)}{span}>"


def called(facts: Mapping[str, Any], name: str) -> str:
    """The name of the column that a block of a product calls so; of others their own."""
    return str(facts.get("by_block", {}).get(name, name))


def shown(facts: Mapping[str, Any], name: str) -> str:
    """What a column is called where it is shown: in a product by its block, as ``w2_1``."""
    own = {x: y for y, x in facts.get("by_block", {}).items()}
    return str(own.get(name, name))


def symmetry_axis(I: Array) -> int:  # noqa: E741
    """The axis of the body, 1 to 3, about which a tensor of inertia (3, 3) is that of a symmetric
    body; 0 where there is none, and of a sphere."""
    off = np.abs(I - np.diag(np.diag(I))).max()
    a, b, c = np.diag(I).tolist()
    alike = [math.isclose(x, y, rel_tol=1e-9) for x, y in ((b, c), (c, a), (a, b))]
    return alike.index(True) + 1 if alike.count(True) == 1 and off <= 1e-9 * max(a, b, c) else 0


# Runs as files: ``.npz`` of NumPy, ``.csv`` with its facts in a comment below the names of the
# columns, ``.parquet``.
#
# All three hold the same numbers to the last bit, the columns with their kinds and units, and the
# facts as JSON. The same run gives the same bytes.

MARK = "derive run"
"""What the facts of a file begin with, by which it is known."""

COMMENT = "# "
"""What the line of a .csv begins with that other programs skip."""


class RunFileError(Refused, ValueError):
    """A file that is no run, or cannot be made: the message says which, and what to do."""


def written(run: Run, name: str) -> bytes:
    """The bytes of a file of this name; ``RunFileError`` for an ending that means no format."""
    return format_of(name)[0](run)


def read(path: Path) -> Run:
    """The run in a file; ``RunFileError`` where there is none."""
    reader = format_of(path.name)[1]
    try:
        found = reader(path.read_bytes())
        if len(back := np.flatnonzero(~(np.diff(found.t) >= 0))):
            t, after = found.t[back[0] : back[0] + 2]
            raise RunFileError(f"row {back[0] + 2}: t = {after:g} does not come after {t:g}")
        return found
    except RunFileError as error:
        raise RunFileError(f"{path}: {error}") from None
    except OSError as error:
        raise RunFileError(f"{path}: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError, EOFError, zipfile.BadZipFile):
        raise RunFileError(f"{path}: not a run that derive simulate wrote, or damaged") from None


def known(name: str) -> bool:
    """Is there a format for a file of this name?"""
    return Path(name).suffix in FORMATS


def format_of(name: str) -> tuple[Callable[[Run], bytes], Callable[[bytes], Run]]:
    """What writes and what reads a file of this name; ``RunFileError`` for another ending."""
    if not known(name):
        raise RunFileError(f"{name}: the name of a run must end in {', '.join(FORMATS)}")
    return FORMATS[Path(name).suffix]


def _head(run: Run) -> str:
    """The columns and the facts as one line of JSON."""
    columns = [[x.name, x.kind, x.unit] for x in run.columns]
    told = {"file": MARK, "columns": columns, "facts": dict(run.facts)}
    return json.dumps(told, ensure_ascii=False, sort_keys=True)


def _run(head: str, table: Any) -> Run:
    """A run from its head and numbers; ``ValueError`` where they do not belong together."""
    told = json.loads(head)
    if told["file"] != MARK:
        raise ValueError("no run")
    columns = tuple(Column(*map(str, x)) for x in told["columns"])
    table = np.asarray(table, dtype=float).reshape(-1, len(columns))
    kinds = [x.kind for x in columns]
    if kinds[:1] != ["time"] or not {*kinds} <= {*KINDS}:
        raise ValueError("no run")
    return Run(columns, table, dict(told["facts"]))


def _to_npz(run: Run) -> bytes:
    """As ``numpy.savez``, but with no date in the archive."""
    arrays = {"head": np.array(_head(run)), "table": np.ascontiguousarray(run.table)}
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            own = io.BytesIO()
            np.lib.format.write_array(own, array, allow_pickle=False)
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), own.getvalue(), zipfile.ZIP_DEFLATED)
    return file.getvalue()


def _from_npz(data: bytes) -> Run:
    with np.load(io.BytesIO(data), allow_pickle=False) as found:
        return _run(str(found["head"]), found["table"])


def _to_csv(run: Run) -> bytes:
    names = [f"{x.name} [{x.unit}]" if x.unit else x.name for x in run.columns]
    rows = (",".join(map(repr, row)) for row in run.table.tolist())
    return "\n".join([",".join(names), COMMENT + _head(run), *rows, ""]).encode()


def _from_csv(data: bytes) -> Run:
    first, second, *rows = (x.rstrip("\r") for x in data.decode().rstrip("\n").split("\n"))
    head = commented(first, second)
    return _run(head, [[float(x or "nan") for x in row.split(",")] for row in rows])


def commented(first: str, second: str) -> str:
    """What the comment of a table says, its second line, or, in files of before, its first."""
    return (first if first.startswith(COMMENT) else second).removeprefix(COMMENT)


def _to_parquet(run: Run) -> bytes:
    arrow, parquet = pyarrow()
    columns = {x.name: run.table[:, k] for k, x in enumerate(run.columns)}
    table = arrow.table(columns).replace_schema_metadata({MARK: _head(run)})
    file = io.BytesIO()
    parquet.write_table(table, file)
    return file.getvalue()


def parquet_table(file: Path | io.BytesIO, mark: str) -> tuple[str, Array]:
    """What a table of Arrow says under a mark, and its numbers; ``ValueError``, ``KeyError``."""
    arrow, parquet = pyarrow()
    try:
        found = parquet.read_table(file)
    except arrow.ArrowInvalid as error:
        raise ValueError(str(error)) from None
    head = (found.schema.metadata or {})[mark.encode()].decode()
    return head, np.column_stack([x.to_numpy() for x in found.columns])


def pyarrow() -> tuple[Any, Any]:
    """pyarrow and its parquet; ``RunFileError`` where it is not installed."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise RunFileError(
            ".parquet needs pyarrow: pip install pyarrow, or take .npz or .csv"
        ) from None
    return pyarrow, pyarrow.parquet


FORMATS: dict[str, tuple[Callable[[Run], bytes], Callable[[bytes], Run]]] = {
    ".npz": (_to_npz, _from_npz),
    ".csv": (_to_csv, _from_csv),
    ".parquet": (_to_parquet, lambda data: _run(*parquet_table(io.BytesIO(data), MARK))),
}
"""Ending → what makes the bytes of a run, and what reads them."""
