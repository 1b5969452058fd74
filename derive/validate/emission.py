"""The validation of all files of one emission: which are read back, and with what result."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, partial
from itertools import zip_longest

from ..record.record import Derivation
from .chart import Chart
from .compare import SIZE, Agreement, compare
from .declarations import DiffersError
from .ellipsoid_integrals import NAME as INTEGRALS
from .emitted_file import Module
from .exact_points import Claims
from .read_c import read_c
from .read_python import read_python, unread_statements
from .run_time_text import loops, without_loops
from .straight_line import error_checks
from .terms import CodeError
from .torus.torus_files import TorusClaims, compare_c, compare_python

Judge = Callable[[tuple[str, ...]], Agreement]
"""The verdict on files by their names."""
UNREAD = "not validated: only C and Python are read back"
UNSTEPPED = "not validated: steps in time, which are not read back"
UNPROVED = "; not validated, for it is a loop: Carlson's duplication, which gives the integrals"
UNCHECKED = "not validated: what constants refuses"
SHOWN = 3
"""The most decimals that a report lists."""
PRINCIPAL = "not validated: the principal frame has eigenvectors, which are not rational"


@dataclass(frozen=True)
class Report:
    """The result for some files in words; ``holds`` unless they differ from the record, or cannot
    be read.

    ``read``: are they in a language that is read back?
    """

    files: tuple[str, ...]
    text: str
    holds: bool = True
    read: bool = True


@dataclass(frozen=True)
class EmittedFiles:
    """The files of one emission, ``files``: name → text; ``numbers``: what their decimals may be
    roundings of.

    ``as_given``: is the body in the frame of the file, not in its principal frame?
    ``fresh``: what is emitted now, if the files are others; the Python that is not read must equal
    it.
    """

    files: Mapping[str, str]
    prefix: str
    chart: Chart
    numbers: Collection[Fraction] = ()
    as_given: bool = True
    fresh: Mapping[str, str] | None = None

    def reports(self, d: Derivation) -> list[Report]:
        """The results, one for each file, or for a header with its source; ``MissingParserError``
        where C cannot be parsed."""
        whole = "".join(self.files.values())  # all of one emission are tried at the same points
        if "torus" in d.problem:
            on_torus = cache(lambda: TorusClaims(d, whole, self.numbers))
            judge = partial(self._on_torus, on_torus)
        else:
            judge = partial(self._compared, Claims(d, self.chart, SIZE), whole)
        return [self._report(names, judge) for names in self._groups()]

    def _groups(self) -> Iterator[tuple[str, ...]]:
        """The names of files read together: a header with its source, others one by one."""
        header, source = f"{self.prefix}.h", f"{self.prefix}.c"
        for name in self.files:
            if name == header and source in self.files:
                yield header, source
            elif name != source or header not in self.files:
                yield (name,)

    def _report(self, names: tuple[str, ...], judge: Judge) -> Report:
        if names[-1] == f"{self.prefix}_steps.h":
            return Report(names, UNSTEPPED, read=False)
        if names[-1] not in (f"{self.prefix}{end}" for end in (".h", ".c", ".py")):
            return Report(names, UNREAD, read=False)
        if not self.as_given:
            return Report(names, PRINCIPAL, read=False)
        if gone := [name for name in names if not self.files[name]]:
            return Report(names, f"cannot be read back: {gone[0]} is empty or missing", holds=False)
        try:
            verdict = judge(names)
        except DiffersError as error:
            return Report(names, f"DIFFERS: {error}", holds=False)
        except CodeError as error:
            return Report(names, f"cannot be read back: {error}", holds=False)
        except RecursionError:
            return Report(names, "cannot be read back: nested too deeply", holds=False)
        called = (f"{self.prefix}_{INTEGRALS}(", f"def _{INTEGRALS}(")
        loop = any(x in self.files[name] for x in called for name in names)
        stepped = "\nclass Motion:" in self.files[names[-1]]
        text = as_text(verdict) + UNPROVED * loop + f"; {UNSTEPPED}" * stepped
        if self.fresh is None:
            text += f"; {UNCHECKED}"
        return Report(names, text)

    def _compared(self, claims: Claims, whole: str, names: tuple[str, ...]) -> Agreement:
        return compare(self._module(names), claims, self.numbers, whole)

    def _on_torus(self, claims: Callable[[], TorusClaims], names: tuple[str, ...]) -> Agreement:
        """The verdict on a file with loops; Python is run, and so must be what is emitted."""
        name = names[-1]
        if not name.endswith(".py"):
            return compare_c(name, self.files, self.prefix, claims())
        if self.fresh is None or self.files[name] != self.fresh[name]:
            raise DiffersError("it is not what is emitted, and so it is not run")
        return compare_python(self.files[name], claims())

    def _module(self, names: tuple[str, ...]) -> Module:
        if names[-1].endswith(".py"):
            self._same_unread(names[-1])
            return read_python(names[-1], self.files[names[-1]])
        if self.fresh is not None:
            for name in names:
                here, wanted = loops(self.files[name]), loops(self.fresh[name])
                if other := next(
                    (x for x in {**wanted, **here} if here.get(x) != wanted.get(x)), ""
                ):
                    raise DiffersError(f"{other} is not read, and not what is emitted")
        module = self._read_c(names[-1], self.files)
        if self.fresh is not None and any(self.files[x] != self.fresh[x] for x in names):
            fresh = self._read_c(names[-1], self.fresh)
            both = [m.functions["constants"] for m in (module, fresh) if "constants" in m.functions]
            if len({error_checks(f) for f in both}) > 1:
                raise DiffersError("constants: its error checks are not what is emitted")
        return module

    def _read_c(self, name: str, files: Mapping[str, str]) -> Module:
        """The module in a C file without the loops that are not read."""
        read = {x: without_loops(text) for x, text in files.items()}
        return read_c(name, read, self.prefix)

    def _same_unread(self, name: str) -> None:
        """``DiffersError`` where Python that is run but not read is not what is emitted."""
        if self.fresh is None:
            return
        versions = (self.files, self.fresh)
        statements = (unread_statements(name, files[name]) for files in versions)
        for here, wanted in zip_longest(*statements):
            if here != wanted:
                shown = (here or wanted or "").split("\n")[0][:60]
                raise DiffersError(f"{shown!r} is not read, and not what is emitted")


def as_text(v: Agreement) -> str:
    """The verdict as text of a report."""
    text = (
        f"{', '.join(v.functions)} equal the record at {v.points} exact "
        f"point{'s' * (v.points > 1)}; "
        f"a false pass has probability below 1e{math.ceil(math.log10(v.bound))}"
    )
    if "velocity_step" in v.functions:
        text += "; not validated, for it is a loop: Newton's method, which repeats velocity_step"
    if v.rounded:
        shown = ", ".join(v.rounded[:SHOWN]) + (", …" if len(v.rounded) > SHOWN else "")
        one = len(v.rounded) == 1
        what = (
            "is read as the number that it rounds"
            if one
            else "are read as the numbers that they round"
        )
        text += f"; {len(v.rounded)} decimal{'s' * (not one)} {what}: {shown}"
    if v.unread:
        text += f"; not validated, for no function reads them: {', '.join(v.unread)}"
    return text
