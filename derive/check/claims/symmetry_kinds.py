"""What a symmetry is called: whether its field moves time, space or the body, and how."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from ...algebra.exact_kernel import ResidueVectorSource
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, nodes
from ...record.record import Derivation, RecordError, Step
from ...record.sentence import Claim
from .spectra_and_residues import ResidueFunctions, UnluckyError, drawn, is_parameter
from .symmetry_count import SPARE, Judge, SymmetryCount, displaced, each

MOVEMENTS = tuple(
    f"{how}_{what}"
    for what in ("space", "body")
    for how in ("translation", "rotation", "displacement", "deformation")
)
NAMES = [f"symmetries.{x}" for x in ("time", "boost", "rotation_alone", "both", "moving")]
NAMES += [f"symmetries.{x}" for x in MOVEMENTS]
FIELDS = (("δt", "δA"), ("δ′t", "δ′A"))
Numbers = Sequence[Sequence[int]]


class SymmetryField:
    """A field δt, δA, told by trees, at points modulo p: Y = δA A⁻¹ and X = A⁻¹ δA."""

    def __init__(self, found: SymmetryCount, time: Tree, displacement: Tree, p: int):
        self.changing = any(x == "t" for t in (time, displacement) for x in nodes(t))
        self.p, self.group = p, found.group
        own = [x for t in (time, displacement) for x in nodes(t) if is_parameter(x)]
        parameters = drawn(dict.fromkeys([*found.parameters, *own]), found.random, p)
        self.points = points = found.points(SPARE, parameters, p)
        functions = ResidueFunctions(
            ResidueVectorSource(p, points.count, found.seed()), roots=found.true_roots
        )
        scalar = points.scalar(parameters, functions)
        self.moved = displaced(displacement, points.g, scalar)
        self.moves_time = any(self._values(scalar(time)))
        if not all(functions.valid):
            raise UnluckyError

    @property
    def kinds(self) -> Iterator[str]:
        """All that it may be called: what turns space turns the body, too, where these commute."""
        space = self._constant(q.times(self.moved, self.points.back))
        body = self._constant(q.times(self.points.back, self.moved))
        moves = any(any(self._values(x)) for row in self.moved for x in row)
        if self.changing:
            yield "boost" if not self.moves_time and self._boosts() else "moving"
        elif self.moves_time:
            yield "both" if moves else "time"
        elif moves and space is None and body is None:
            yield "rotation_alone" if self._turns_places() else "both"
        elif moves:
            named = {"space": space, "body": body}
            yield from (f"{self._name(m)}_{x}" for x, m in named.items() if m is not None)

    def _values(self, x: object) -> list[int]:
        return each(x, self.points.count, self.p)

    def _constant(self, m: Matrix, weights: Sequence[int] | None = None) -> Numbers | None:
        """A matrix, times a number at each point, that is the same at all; else ``None``."""
        weights = weights or [1] * self.points.count
        rows = [
            [{x * w % self.p for x, w in zip(self._values(y), weights, strict=True)} for y in row]
            for row in m
        ]
        if any(len(x) > 1 for row in rows for x in row):
            return None
        return [[x.pop() for x in row] for row in rows]

    @property
    def _shifts(self) -> set[int]:
        """The columns of translations."""
        return {k + f.n for k, f in self.group.places if f.affine}

    def _name(self, m: Numbers) -> str:
        """Does a matrix translate, turn, do both, or deform?"""
        shifts = self._shifts
        places = [(i, j) for i, row in enumerate(m) for j, x in enumerate(row) if x]
        if all(j in shifts for _, j in places):
            return "translation"
        if any((m[i][j] + m[j][i]) % self.p for i, j in places if not {i, j} & shifts):
            return "deformation"
        return "displacement" if any(j in shifts for _, j in places) else "rotation"

    def _boosts(self) -> bool:
        """Is it a translation of space times the time?"""
        time = self._values(self.points.leaves[0])
        if not all(time):
            raise UnluckyError
        velocity = self._constant(
            q.times(self.moved, self.points.back), [pow(x, -1, self.p) for x in time]
        )
        return velocity is not None and self._name(velocity) == "translation"

    def _turns_places(self) -> bool:
        """Does it move translations alone, and these so that the differences of two keep their
        lengths?"""
        columns, shifts = range(len(self.moved)), self._shifts
        turned = [(i, j) for i in columns for j in columns if j not in shifts]
        if any(any(self._values(self.moved[i][j])) for i, j in turned):
            return False
        at = [(i, j) for i in columns for j in shifts]
        pairs = [(self._values(self.points.g[i][j]), self._values(self.moved[i][j])) for i, j in at]
        return not any(
            sum((x[k] - x[0]) * (y[k] - y[0]) for x, y in pairs) % self.p
            for k in range(1, self.points.count)
        )


def _kind(found: SymmetryCount, _: Derivation, step: Step, claim: Claim) -> str:
    """The fields of the step are, in this order, of the kinds that it claims."""
    given = {e.lhs: e.rhs for e in step.given}
    fields = [pair for pair in FIELDS if {*pair} <= {*given}]
    told = [c.kind.partition(".")[2] for c in step.claims if c.kind in NAMES]
    if len(fields) != len(told):
        raise RecordError(f"{len(fields)} fields have {len(told)} names")
    for (time, displacement), name in zip(fields, told, strict=True):
        kinds = found.modulo_a_prime(partial(_kinds, found, given[time], given[displacement]))
        if name not in kinds:
            return f"the field is {' or '.join(kinds) or 'none'}"
    return ""


def _kinds(found: SymmetryCount, time: Tree, displacement: Tree, p: int) -> list[str]:
    return [*SymmetryField(found, time, displacement, p).kinds]


JUDGES: dict[str, Judge] = dict.fromkeys(NAMES, _kind)
