"""Ensembles as files, written part by part: no more than a part is in memory.

``.npz`` of NumPy holds ``states`` (motions, instants, columns), ``varied`` (motions, names),
``status`` (motions,), ``end`` where motions end at events, the instants ``t`` and, as JSON, the
``head``; its arrays lie there as they are in memory, so that they can be mapped.  ``.csv`` and
``.parquet`` have a row for each motion and instant; that of the first instant after the end at an
event has the time and the state of this.  The same ensemble gives the same bytes.
"""

from __future__ import annotations

import json
import math
import struct
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, Protocol

import numpy as np

from . import run
from .ensemble import Ensemble, Part
from .native import AT_EVENT, Integers
from .run import read as read_run

MARK = "derive ensemble"
"""What the head of a file begins with, by which it is known."""

BLOCK = 2**20
"""The numbers that are written at once where there is nothing to write."""


class Writer(Protocol):
    """What takes parts, in order."""

    def add(self, part: Part) -> None:
        """Write a part."""

    def close(self) -> None:
        """Write what comes after the parts."""


class _Npz:
    """An archive whose first member grows; what is small waits in memory for its end."""

    def __init__(self, file: IO[bytes], like: Ensemble):
        self.like, self.n, self.done = like, int(like.facts["motions"]), 0
        self.archive = zipfile.ZipFile(file, "w", zipfile.ZIP_STORED)
        self.rest: list[tuple[run.Array, Integers, run.Array]] = []
        self.shape = (self.n, len(like.t), len(like.names))
        self.member = self._member("states", self.shape, "<f8")

    def _member(self, name: str, shape: tuple[int, ...], kind: str) -> IO[bytes]:
        member = self.archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True)
        head = {"descr": kind, "fortran_order": False, "shape": shape}
        np.lib.format.write_array_header_1_0(member, head)
        return member

    def add(self, part: Part) -> None:
        self.member.write(np.ascontiguousarray(part.states, dtype="<f8").data)
        self.rest.append((part.varied, part.status, part.end))  # and not the states
        self.done += len(part.status)

    def close(self) -> None:
        left, width = self.n - self.done, self.shape[1] * self.shape[2]
        for first in range(0, left * width, BLOCK):  # motions that were not followed
            self.member.write(np.full(min(BLOCK, left * width - first), math.nan, "<f8").data)
        self.member.close()
        names, ends = len(self.like.varied_names), self.like.end.shape[1]
        none = (
            np.full((left, names), math.nan),
            np.full(left, -1),
            np.full((left, ends), math.nan),
        )
        varied, status, end = map(np.concatenate, zip(*self.rest, none, strict=True))
        head = np.array(_head(self.like))
        self._write("varied", varied, "<f8")
        self._write("status", status, "<i4")
        if ends:
            self._write("end", end, "<f8")
        self._write("t", self.like.t, "<f8")
        self._write("head", head, head.dtype.str)
        self.archive.close()

    def _write(self, name: str, a: np.ndarray[Any, Any], kind: str) -> None:
        with self._member(name, a.shape, kind) as member:
            member.write(np.ascontiguousarray(a, dtype=kind).tobytes())


class _Table:
    """Rows of motions and instants, as text or as a table of Arrow."""

    def __init__(self, file: IO[bytes], like: Ensemble):
        self.file, self.like, self.done = file, like, 0
        varied = [f"varied_{x}" for x in like.varied_names]
        self.names = ["motion", "status", *varied, "t", *like.names]

    def rows(self, part: Part) -> list[np.ndarray[Any, Any]]:
        """The columns of a part."""
        m, k = part.states.shape[:2]
        first, self.done = self.done, self.done + m
        t, states = np.tile(self.like.t, (m, 1)), part.states
        if part.end.size:
            ended, states = np.flatnonzero(part.status >= AT_EVENT), states.copy()
            after = ended, np.searchsorted(self.like.t, part.end[ended, 0])
            t[after], states[after] = part.end[ended, 0], part.end[ended, 1:]
        return [
            np.repeat(np.arange(first, first + m), k),
            np.repeat(part.status, k),
            *np.repeat(part.varied, k, axis=0).T,
            t.ravel(),
            *states.reshape(m * k, -1).T,
        ]


class _Csv(_Table):
    def __init__(self, file: IO[bytes], like: Ensemble):
        super().__init__(file, like)
        file.write(f"{','.join(self.names)}\n{run.COMMENT}{_head(like)}\n".encode())

    def add(self, part: Part) -> None:
        columns = [x.tolist() for x in self.rows(part)]
        lines = (",".join(map(repr, row)) for row in zip(*columns, strict=True))
        self.file.write("".join(f"{line}\n" for line in lines).encode())

    def close(self) -> None:
        pass


class _Parquet(_Table):
    def __init__(self, file: IO[bytes], like: Ensemble):
        super().__init__(file, like)
        self.arrow, parquet = run.pyarrow()
        whole = [("motion", self.arrow.int64()), ("status", self.arrow.int32())]
        fields = [*whole, *((x, self.arrow.float64()) for x in self.names[2:])]
        self.schema = self.arrow.schema(fields, {MARK: _head(like)})
        self.writer = parquet.ParquetWriter(file, self.schema)

    def add(self, part: Part) -> None:
        table = self.arrow.table(dict(zip(self.names, self.rows(part), strict=True)))
        self.writer.write_table(table.cast(self.schema))

    def close(self) -> None:
        self.writer.close()


WRITERS: dict[str, type[_Npz] | type[_Csv] | type[_Parquet]] = {
    ".npz": _Npz,
    ".csv": _Csv,
    ".parquet": _Parquet,
}
"""Ending → what writes such a file."""


@contextmanager
def writer(file: IO[bytes], name: str, like: Ensemble) -> Iterator[Writer]:
    """What writes parts of an ensemble like this one into a file of a name, to its end."""
    made = WRITERS[Path(name).suffix](file, like)
    try:
        yield made
        made.close()
    except BaseException:
        if isinstance(made, _Npz):
            made.archive.fp = None  # it is not to be ended
        raise


def read(path: Path) -> Ensemble:
    """The ensemble in a file, the states of an .npz mapped, not read; ``RunFileError``."""
    try:
        if path.suffix == ".npz":
            return _from_npz(path)
        if path.suffix == ".csv":
            return _from_csv(path)
        if path.suffix == ".parquet":
            head, rows = run.parquet_table(path, MARK)
            return _of_rows(_header(head), rows)
    except run.RunFileError:
        raise
    except OSError as error:
        raise run.RunFileError(f"{path}: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):
        raise run.RunFileError(
            f"{path}: no ensemble that derive simulate wrote, or damaged"
        ) from None
    raise run.RunFileError(f"{path}: the name of an ensemble must end in {', '.join(run.FORMATS)}")


def read_either(path: Path) -> run.Run | Ensemble:
    """The run or the ensemble in a file; ``RunFileError`` where there is neither."""
    try:
        return read(path)
    except run.RunFileError:
        return read_run(path)


def _head(like: Ensemble) -> str:
    """The facts as one line of JSON."""
    told = {"file": MARK, "state": like.names, "t": like.t.tolist(), "facts": dict(like.facts)}
    return json.dumps(told, ensure_ascii=False, sort_keys=True)


def _header(head: str) -> dict[str, Any]:
    told: dict[str, Any] = json.loads(head)
    if told["file"] != MARK:
        raise ValueError("no ensemble")
    return told


def _from_npz(path: Path) -> Ensemble:
    with np.load(path, allow_pickle=False) as found:
        told = _header(str(found["head"]))
        t, varied, status = (found[x] for x in ("t", "varied", "status"))
        end = found["end"] if "end" in found.files else np.empty((len(status), 0))
    states = _mapped(path, "states.npy")
    return Ensemble(told["facts"], tuple(told["state"]), t, varied, status, states, end)


def _mapped(path: Path, name: str) -> run.Array:
    """A member of an archive, which lies there as it is, as an array on the disk."""
    with zipfile.ZipFile(path) as archive, archive.open(name) as member:
        np.lib.format.read_magic(member)
        shape, _, kind = np.lib.format.read_array_header_1_0(member)
        length = member.tell()
        start = archive.getinfo(name).header_offset
    with path.open("rb") as file:
        file.seek(start + 26)
        lengths = struct.unpack("<HH", file.read(4))
    offset = start + 30 + sum(lengths) + length
    return np.memmap(path, kind, "r", offset, shape)


def _from_csv(path: Path) -> Ensemble:
    with path.open(encoding="utf-8") as file:
        told = _header(run.commented(file.readline(), file.readline()))
        return _of_rows(told, np.loadtxt(file, delimiter=",", ndmin=2))


def _of_rows(told: dict[str, Any], rows: run.Array) -> Ensemble:
    t, names = np.array(told["t"]), tuple(told["state"])
    split = rows.reshape(-1, len(t), rows.shape[1])
    status, varied = split[:, 0, 1].astype(np.intc), split[:, 0, 2 : -1 - len(names)]
    own = split[..., -1 - len(names) :]
    end = np.full((len(status), own.shape[2] * bool(told["facts"].get("ends"))), math.nan)
    if end.size:
        ended = np.flatnonzero(status >= AT_EVENT)
        last = ended, np.isfinite(own[ended, :, 1]).sum(axis=1) - 1
        end[ended], own[last] = own[last], math.nan
    return Ensemble(told["facts"], names, t, varied, status, own[..., 1:], end)
