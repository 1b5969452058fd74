"""The functions of a fluid on the torus that have loops, for one file: their text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...routines.source import Source
from ..step.algorithms import PRINTERS, real_of_work, text_of
from .torus_program import Loops

OF_MATRICES = ("rhs", "conserved")


def printed_sums(language: str, loops: Loops, fields: Mapping[str, Any]) -> dict[str, Any]:
    """The bodies of these functions by their names; the tables and functions that they need."""
    N, prefix = loops.N, fields["prefix"]
    M = N // 2 + 1
    # in C rows of a multiple of four numbers, which compilers take several at a time
    pad = 4 if language == "c" else 1
    given = {
        "N": N,
        "M": M,
        "HALF": N // 2,
        "ROW": -(-N // pad) * pad,
        "COLUMNS": -(-M // pad) * pad,
        "PADDED": pad > 1,
        "FOURS": N - N % 4,
        "SIZE": float(N),
        "SCALE": float(loops.scale),
        "COSINES": [*map(float, loops.cosines)],
        "SINES": [*map(float, loops.sines)],
        "prefix": prefix,
        "real": real_of_work(language, fields["real"]),
        "inline": f"{prefix}_FUNCTION" if fields["header"] else "static",
        "public": (),
        "generic": True,
        "item": ["#[allow(clippy::all, clippy::pedantic)]", "#[rustfmt::skip]"],
    }
    source = Source()
    source.read(text_of("torus_sums"), given)
    printer = PRINTERS[language](source, given)
    by_table = {"rhs"} if loops.table and language == "c" else set()
    named = loops.names & {*fields["functions"]} & {*source.routines} - by_table
    of_matrices = bool({*OF_MATRICES} & named)
    tables = [*printer.tables()] if of_matrices else []
    bodies = {}
    for x in sorted(named):
        bodies[x] = "\n".join(printer.body(source.routines[x]))
        tables += printer.before
    return {
        "bodies": bodies,
        "tables": "\n".join(tables),
        "functions": printer.text(["waves", "matrix_of", "added", "row"]) if of_matrices else "",
    }
