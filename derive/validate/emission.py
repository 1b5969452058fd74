"""The validation of all files of one emission: which are read back, and with what result.

The code of an estimate with the covariance of its error is held to the record at exact points.
Nothing of the record's steps is taken: f is that of the problem, 𝒜 the derivative of the rates of
the error near 1, a column of G the derivative of f by one input, seen from the estimate, and Ṗ = 𝒜P
+ P𝒜ᵀ + GQGᵀ their products, with Q the densities of the problem (the checker's model).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache, cached_property, partial
from itertools import zip_longest
from random import Random
from typing import Any

from ..algebra.samplers import RandomSource
from ..check.lagrangian.kinematics_model import KinematicsModel
from ..check.trials.trial_points import TrialPoints
from ..check.values.arithmetic import EPS, nilpotent, part
from ..check.values.draws import Locus
from ..check.values.evaluate import evaluate
from ..check.values.residue import DegreeSource, degrees
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..record.as_json import decode
from ..record.record import Derivation
from .chart import Chart, Numbers, StateChart
from .compare import SIZE, Agreement, FileAtPoint, compare
from .exact_points import NAME as INTEGRALS
from .exact_points import Claims, largest
from .functions_of_state import require_defaults
from .read_file import LANGUAGES, Beside, calls_of_cpp, defaults_of_cpp, read
from .straight_line import error_checks
from .syntax import SYNTAX, tokens
from .terms import CodeError, DiffersError, Module
from .torus.torus_files import TorusClaims, compare_loops, compare_python, unread_parts


@dataclass(frozen=True)
class FilterPoint:
    """An exact point: the ``arguments`` t, x and u of a call, and what is true there: the rates of
    x, 𝒜 and G by rows; the state has no angles, and so no ``circles``."""

    parameters: Mapping[str, Any]
    arguments: Mapping[str, Any]
    rates: Numbers
    generator: Numbers
    noise: Numbers
    elementary: Any
    circles: Mapping[tuple[str, Fraction], Any] = field(default_factory=dict)


@dataclass(frozen=True)
class FilterChart(StateChart):
    """The entries of the estimate that vary, then the upper triangle of P by rows."""

    @property
    def triangle(self) -> list[tuple[int, int]]:
        """The places of P in the state, from 0."""
        d = range(self.group.dimension)
        return [(a, b) for a in d for b in d if a <= b]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the numbers of the state, in order."""
        entries = tuple(name for name, _, _ in self.entries)
        return (*entries, *(suffixed("P", a + 1, b + 1) for a, b in self.triangle))

    def numbers(self, g: Matrix, P: Matrix) -> Numbers:
        """Those of a matrix of the group's size and a symmetric one."""
        return (*(g[i][j] for _, i, j in self.entries), *(P[a][b] for a, b in self.triangle))


class FilterClaims:
    """What is true of an estimate of kinematics: names, and values at exact points; ``size``:
    random integers are within ±size."""

    outputs: tuple[str, ...] = ()

    def __init__(self, d: Derivation, size: int):
        self.record, self.size = d, size
        given = d.problem["kinematics"]
        (group,) = TrialPoints(d.problem, 0).groups(str(d.problem.get("group")))
        self.group, self.left = group, given["error"] == "left"
        self.state = FilterChart(group, Chart(state="moving"), right=not self.left)
        self.inputs = tuple(str(x) for x in given["inputs"])
        self.noise = [decode(x, "problem, noise") for x in given.get("noise", ())]

    def point(self, seed: str, zero: tuple[str, ...] = ()) -> FilterPoint:
        """The point of a seed, some parameters 0."""
        return self._point(Random(seed), zero)

    def _point(self, source: RandomSource, zero: tuple[str, ...] = ()) -> FilterPoint:
        model = KinematicsModel(self.record.problem, self.group, source, self.size, Locus())
        model.parameters |= dict.fromkeys(zero, Fraction(0))
        d, estimate = range(self.group.dimension), model.estimate
        triangle = {x: model.draw() for x in self.state.triangle}
        P = tuple(tuple(triangle[min(a, b), max(a, b)] for b in d) for a in d)
        generator = model.generator(left=self.left)
        columns = [self._column(model, x) for x in self.inputs]
        moved = q.times(generator, P)
        rate = q.plus(moved, q.transposed(moved))
        for t, column in zip(self.noise, columns, strict=False):
            square = q.times(q.column(column), (column,))
            rate = q.plus(rate, q.scaled(evaluate(t, model.expressions), square))
        return FilterPoint(
            model.parameters,
            {
                "t": model.t,
                "x": self.state.numbers(estimate, P),
                "u": tuple(model.parameters[x] for x in self.inputs),
            },
            self.state.numbers(model.velocity(estimate), rate),
            q.flatten(generator),
            q.flatten(q.transposed(q.matrix(columns))),
            model.elementary,
        )

    def _column(self, model: KinematicsModel, name: str) -> tuple[Any, ...]:
        """What a noise of 1 on an input adds to the rate of the error, on the basis."""
        ahead = {**model.parameters, name: model.parameters[name] + nilpotent(EPS)}
        slope = part(model.velocity(model.estimate, ahead), EPS)
        back = q.inverted(model.estimate)
        seen = q.times(back, slope) if self.left else q.times(slope, back)
        return self.group.nearest(seen)

    @cached_property
    def _graded(self) -> FilterPoint:
        """A point of which the degrees alone are known."""
        return self._point(DegreeSource())

    @property
    def degree(self) -> int:
        """A bound on the degree of what is true, as a function of the draws."""
        p = self._graded
        every = degrees((*p.rates, *p.generator, *p.noise))
        return max((x.total_degree for x in every), default=1)

    @property
    def entry_degree(self) -> tuple[int, int]:
        """The degrees of numerator and denominator of a number of the state."""
        return largest(degrees(self._graded.arguments["x"]))

    moment_degree = (1, 0)
    """Those of a parameter."""


class FilterComparison(FileAtPoint):
    """The comparison of the code of an estimate with the record at one exact point."""

    claims: Any
    point: Any

    def compare_all(self) -> tuple[str, ...]:
        """The names of the functions, once each has been found equal; ``CodeError`` else."""
        self.require_straight()
        arguments, point, found = self._arguments(), self.point, ["constants", "rhs"]
        self._compared("rhs", arguments, "dx", self._rates, point.rates)
        if "rhs_batch" in self.module.functions:
            self._batches(arguments)
            found.append("rhs_batch")
        for name, wanted in (("error_generator", point.generator), ("error_noise", point.noise)):
            told = [f"number {k} of D" for k, _ in enumerate(wanted)]
            found.append(self._compared(name, arguments, "D", told, wanted))
        return (*found,)


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
            judge = partial(self._compared, FileAtPoint, Claims(d, self.chart, SIZE), whole)
        return [self._report(names, judge, d) for names in self._groups()]

    def _groups(self) -> Iterator[tuple[str, ...]]:
        """The names of files read together: a header with its source, others one by one."""
        header, source = f"{self.prefix}.h", f"{self.prefix}.c"
        for name in self.files:
            if name == header and source in self.files:
                yield header, source
            elif name != source or header not in self.files:
                yield (name,)

    def _report(self, names: tuple[str, ...], judge: Judge, d: Derivation) -> Report:
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
                return Report(names, CALLED + ", ".join(self._calls(names[-1], d)), read=False)
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

    def _calls(self, name: str, d: Derivation) -> Sequence[str]:
        """The functions of C that C++ calls; ``DiffersError`` where it is not what is emitted, or
        its defaults are not those of the record."""
        found = calls_of_cpp(name, self.files[name], self.prefix)
        listed, defaults = defaults_of_cpp(name, self.files[name], self.prefix)
        require_defaults(listed, defaults, d.problem["parameters"])
        if self.fresh is not None:
            require_same(*(words_of(x[name]) for x in (self.files, self.fresh)))
        return found

    def _compared(
        self, kind: type[FileAtPoint], claims: Any, whole: str, names: tuple[str, ...]
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
