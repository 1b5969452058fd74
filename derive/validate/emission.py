"""The validation of all files of one emission: which are read back, and with what result."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, partial
from itertools import zip_longest
from typing import Any

from ..record.record import Derivation
from .chart import Chart
from .compare import SIZE, Agreement, Comparison, compare
from .exact_points import NAME as INTEGRALS
from .exact_points import Claims
from .filter_functions import FilterClaims, FilterComparison
from .read_file import LANGUAGES, Beside, calls_of_cpp, read
from .straight_line import error_checks
from .syntax import SYNTAX, tokens
from .terms import CodeError, DiffersError, Module
from .torus.torus_files import (
    TorusClaims,
    compare_loops,
    compare_python,
    unread_parts,
)

Judge = Callable[[tuple[str, ...]], Agreement]
"""The verdict on files by their names."""
UNREAD = "not validated: such a file is not read back"
CALLED = "the C that it calls is given what it takes: "
STEPPED = re.compile(
    r"^(class Motion:|pub struct Motion|export function begin\(|.* mutable struct Motion)",
    re.MULTILINE,
)
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
    ``fresh``: what is emitted now, if the files are others; what of them is not read must equal it.
    """

    files: Mapping[str, str]
    prefix: str
    chart: Chart
    numbers: Collection[Fraction] = ()
    as_given: bool = True
    fresh: Mapping[str, str] | None = None

    def reports(self, d: Derivation) -> list[Report]:
        """The results, one for each file, or for a header with its source."""
        whole = "".join(self.files.values())  # all of one emission are tried at the same points
        if "kinematics" in d.problem:
            judge: Judge = partial(self._compared, FilterComparison, FilterClaims(d, SIZE), whole)
        elif "torus" in d.problem:
            on_torus = cache(lambda: TorusClaims(d, whole, self.numbers))
            judge = partial(self._on_torus, on_torus)
        else:
            judge = partial(self._compared, Comparison, Claims(d, self.chart, SIZE), whole)
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
        ending = names[-1].removeprefix(self.prefix)
        language = LANGUAGES.get(ending)
        unread = {"_steps.h": UNSTEPPED}.get(ending, "" if language else UNREAD)
        if not self.as_given:
            unread = unread or PRINCIPAL
        if unread:
            return Report(names, unread, read=False)
        if gone := [name for name in names if not self.files[name]]:
            return Report(names, f"cannot be read back: {gone[0]} is empty or missing", holds=False)
        try:
            if language == "cpp":
                return Report(names, CALLED + ", ".join(self._calls(names[-1])), read=False)
            verdict = judge(names)
        except DiffersError as error:
            return Report(names, f"DIFFERS: {error}", holds=False)
        except CodeError as error:
            return Report(names, f"cannot be read back: {error}", holds=False)
        except RecursionError:
            return Report(names, "cannot be read back: nested too deeply", holds=False)
        text = as_text(verdict)
        loop = re.compile(rf"\b({self.prefix}|def |fn |function )_?{INTEGRALS}\(")
        if any(loop.search(self.files[name]) for name in names):
            text += UNPROVED
        if STEPPED.search(self.files[names[-1]]):
            text += f"; {UNSTEPPED}"
        if self.fresh is None:
            text += f"; {UNCHECKED}"
        return Report(names, text)

    def _calls(self, name: str) -> Sequence[str]:
        """The functions of C that C++ calls; ``DiffersError`` where it is not what is emitted."""
        found = calls_of_cpp(name, self.files[name], self.prefix)
        if self.fresh is not None:
            require_same(*(words_of(x[name]) for x in (self.files, self.fresh)))
        return found

    def _compared(
        self, kind: type[Comparison], claims: Any, whole: str, names: tuple[str, ...]
    ) -> Agreement:
        return compare(self._module(names), claims, self.numbers, whole, kind=kind)

    def _on_torus(self, claims: Callable[[], TorusClaims], names: tuple[str, ...]) -> Agreement:
        """The verdict on a file with loops; Python is run, and so must be what is emitted."""
        name = names[-1]
        if not name.endswith(".py"):
            if self.fresh is not None and self.files[name] != self.fresh[name]:
                require_same(
                    *(unread_parts(name, x, self.prefix) for x in (self.files, self.fresh))
                )
            return compare_loops(name, self.files, self.prefix, claims())
        if self.fresh is None or self.files[name] != self.fresh[name]:
            raise DiffersError("it is not what is emitted, and so it is not run")
        return compare_python(self.files[name], claims())

    def _module(self, names: tuple[str, ...]) -> Module:
        """The module in files, of which what is not read must be what is emitted."""
        found = read(names[-1], self._parts(names, self.files), self.prefix)
        if self.fresh is None or all(self.files[x] == self.fresh[x] for x in names):
            return found.module
        wanted = read(names[-1], self._parts(names, self.fresh), self.prefix)
        require_same(found.unread, wanted.unread)
        both = [m.functions.get("constants") for m in (found.module, wanted.module)]
        if len({f and error_checks(f) for f in both}) > 1:
            raise DiffersError("constants: its error checks are not what is emitted")
        return found.module

    @staticmethod
    def _parts(names: tuple[str, ...], files: Mapping[str, str]) -> dict[str, str]:
        return {x: files[x] for x in names}


def words_of(text: str) -> Beside:
    """The words of C++, without comments."""
    return [(x.text, x.text) for x in tokens(SYNTAX["c"], text, "")]


def require_same(found: Beside, wanted: Beside) -> None:
    """``DiffersError`` where what is not read is not what is emitted."""
    for (shown, here), (other, there) in zip_longest(found, wanted, fillvalue=("", None)):
        if here != there:
            told = f"{(shown or other)[:60]!r} is not read, and not what is emitted"
            raise DiffersError(told)


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
