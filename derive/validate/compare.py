"""The functions of an emitted file against the record: equal at exact points, without tolerance.

A rational function that is not zero vanishes at a random point with probability at most
degree / size (Schwartz–Zippel); points are added until all of them at once are improbable enough.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from random import Random
from typing import Any

from ..record.record import to_json
from .exact_points import Claims, Point
from .jacobians import Varied
from .literals import Literals
from .measured import Measured, Opaque
from .module import Machine, Module
from .names import DiffersError, compare_names
from .projection import compare_drift
from .straight_line import asked, straight, summands
from .terms import Array, CodeError, run

SIZE = 2**128
"""The random integers of a point are of at most this absolute value."""

BOUND, FEWEST, MOST = 1e-40, 2, 20
"""Points are added until a false pass is less probable than BOUND: at least FEWEST, at most
MOST."""


SLOPE = 16
"""Times the size of the group, this bounds what a derivative and its way to coordinates add to a
degree, as a factor."""


@dataclass(frozen=True)
class Verdict:
    """The names of the ``functions`` that equal the record at so many ``points``; ``bound`` on the
    probability of a false pass.

    ``rounded``: the decimals that stand for the number that they are nearest to. ``unread``: the
    constants that none of the functions reads, so that nothing is known of them.
    """

    functions: tuple[str, ...]
    points: int
    bound: float
    rounded: tuple[str, ...]
    unread: tuple[str, ...]


def compare(
    module: Module,
    claims: Claims,
    exact: Iterable[Fraction] = (),
    text: str = "",
    bound: float = BOUND,
) -> Verdict:
    """The verdict on a module whose functions equal the record; ``CodeError`` where it cannot be
    read, or differs.

    ``exact``: the numbers that decimals may stand for. The points are drawn from a hash of the
    record and of ``text``, that of the files: they are the same at every run, and whoever writes a
    file cannot aim it at them.
    """
    compare_names(module, claims)
    literal = Literals(exact)
    told = to_json(claims.record) + text
    digest = hashlib.sha256(told.encode("utf-8", "surrogatepass")).hexdigest()
    first = Comparison(module, claims, literal, claims.point(f"{digest} 0"), measured=True)
    functions = first.all()
    one, points = min(1.0, first.degree / claims.size), 1
    while points < FEWEST or one**points >= bound:
        if points == MOST:
            raise CodeError("its degree is too large for a proof")
        Comparison(module, claims, literal, claims.point(f"{digest} {points}")).all()
        points += 1
    for zero in _zeros(module):
        _at_zero(module, claims, literal, digest, zero)
    size = module.sizes.get("CONSTANTS", 0)
    unread = tuple(f"k[{i}]" for i in range(size) if i not in first.read)
    return Verdict(functions, points, one**points, tuple(sorted(literal.rounded)), unread)


def _zeros(module: Module) -> list[tuple[str, ...]]:
    """The sets of parameters to be tried as 0, where the code branches on that: each that it tests
    alone, and all at once."""
    found = sorted({i for f in module.functions.values() for i in asked(f)})
    names = tuple((module.parameters or ())[i] for i in found)
    return list(dict.fromkeys([*((x,) for x in names), names])) if names else []


def _at_zero(
    module: Module, claims: Claims, literal: Literals, seed: str, zero: tuple[str, ...]
) -> None:
    """Compare at a point where these parameters are 0, if the record has values there."""
    try:
        point = claims.point(f"{seed} zero", zero)
    except CodeError:
        return
    Comparison(module, claims, literal, point).all()


class Comparison:
    """The comparison of one module with the record at one exact point; ``measured``: its degrees
    are found as well."""

    def __init__(
        self,
        module: Module,
        claims: Claims,
        literal: Literals,
        point: Point,
        *,
        measured: bool = False,
    ):
        self.module, self.claims, self.literal = module, claims, literal
        self.measured, self.point = measured, point
        self.random = Random(str(point.energy))
        self.opaque = Opaque(self.point.elementary)
        values = self.opaque if measured else self.point.elementary
        self.machine = Machine(module, values, literal)
        self.read: set[int] = set()
        self.largest = 0

    @property
    def degree(self) -> int:
        """A bound on the degree of a difference, and of what makes two arguments of elementary
        functions equal by chance."""
        record = self.claims.degree
        pairs = self.opaque.calls * len(self.point.elementary.values)
        own = SLOPE * self.claims.group.size * self.largest
        return own + record + pairs * (self.opaque.largest + record)

    def all(self) -> tuple[str, ...]:
        """The names of the module's functions, once each has been found equal to the record's;
        ``CodeError`` else."""
        for f in self.module.functions.values():
            straight(f)
        given, point, found = self._given(), self.point, ["constants", "rhs", "energy"]
        rates = self._call("rhs", given, dx=len(point.rates))["dx"]
        self._same("rhs", self._rates, rates, point.rates)
        energy = self._call("energy", given, value=1)["value"]
        self._same("energy", ("the energy",), energy, (point.energy,))
        if "rhs_batch" in self.module.functions:
            for count in (1, self.random.randint(2, 3), self.random.randint(4, 9)):
                self._batch(given, count)
            found.append("rhs_batch")
        if "inertia" in self.module.functions:
            names = tuple(f"I_{i}{j}" for i in range(1, 4) for j in range(i, 4))
            tensor = self._call("inertia", given, value=6)["value"]
            self._same("inertia", names, tensor, point.inertia)
            found.append("inertia")
        if "project" in self.module.functions:
            alone = partial(self._alone, given)
            found.append(compare_drift(alone, self._draw, self.claims.state, point))
        return (*found, *self._jacobians(given))

    @property
    def _rates(self) -> tuple[str, ...]:
        return tuple(f"the rate of {x}" for x in self.claims.state.names)

    def _given(self) -> dict[str, Any]:
        """The arguments that the functions may take at the point: t, x, u, p and the constants k
        that the module computes."""
        given, listed = self.point.given, self.module.parameters or ()
        p = self._array([self.point.parameters[x] for x in listed], "p", self.claims.moment_degree)
        k = self._call("constants", {"p": p}, k=self.module.sizes.get("CONSTANTS", 0))["k"]
        return {
            "t": self._lifted([given["t"]], (1, 0))[0],
            "x": self._array(given["x"], "x", self.claims.entry_degree),
            "u": self._array(given["u"], "u", (1, 0)),
            "p": p,
            "k": Array(k, "k"),
        }

    def _lifted(self, values: Iterable[Any], degrees: tuple[int, int]) -> list[Any]:
        return [Measured(x, *degrees) if self.measured else x for x in values]

    def _array(self, values: Iterable[Any], name: str, degrees: tuple[int, int]) -> Array:
        return Array(self._lifted(values, degrees), name)

    def _call(self, name: str, given: Mapping[str, Any], **sizes: int) -> dict[str, list[Any]]:
        """The arrays that a function writes, or returns, as lists by name."""
        try:
            found = self.machine.call(name, given, **sizes)
        except CodeError as error:
            raise CodeError(f"{name}: {error}") from None
        if "k" in given:
            self.read |= given["k"].read
        self._measure([x for values in found.values() for x in values])
        return found

    def _measure(self, values: Iterable[Any]) -> None:
        """Take the degrees of these values into account."""
        degrees = (x.degree for x in values if isinstance(x, Measured))
        self.largest = max([self.largest, *degrees])

    def _batch(self, given: Mapping[str, Any], count: int) -> None:
        """Compare ``rhs_batch`` with ``rhs`` on ``count`` states: that of the point, and random
        ones.

        An index is made of n and s by sums and products alone, so three counts tell two apart.
        """
        size, degrees = len(self.point.rates), {"x": self.claims.entry_degree, "u": (1, 0)}
        states = [dict(given) for _ in range(count)]
        for other in states[1:]:
            for name, d in degrees.items():
                drawn = [self._draw() for _ in given[name].values]
                other[name] = self._array(drawn, name, d)
        both = dict(given) | {"n": len(states)}
        for name in degrees:
            rows = zip(*(x[name].values for x in states), strict=True)
            both[name] = Array([x for row in rows for x in row], name)
        found = self._call("rhs_batch", both, dx=len(states) * size)["dx"]
        self._same("rhs_batch", self._rates, found[:: len(states)], self.point.rates)
        for s, other in enumerate(states[1:], 1):
            rates = self._call("rhs", other, dx=size)["dx"]
            self._same("rhs_batch", self._rates, found[s :: len(states)], rates)

    def _alone(self, given: Mapping[str, Any], name: str, x: Sequence[Any]) -> Sequence[Any]:
        """The numbers that ``project`` returns at the state x, or the summands of which ``defect``
        adds the sizes."""
        exact = all(isinstance(y, Fraction) for y in x)
        state = self._array(x, "x", self.claims.entry_degree) if exact else Array(x, "x")
        given, function = {**given, "x": state}, self.module.functions.get("defect")
        if name == "project":
            found = self._call(name, given, out=len(x))["out"]
        elif function is None:
            raise CodeError("defect: there is no such function")
        else:
            elementary, literal = self.machine.elementary, self.machine.literal
            found = run(summands(function), given, elementary, literal)
            self._measure(found)
        return [getattr(y, "value", y) for y in found]

    def _draw(self) -> Fraction:
        return Fraction(self.random.randint(1, self.claims.size))

    def _jacobians(self, given: Mapping[str, Any]) -> list[str]:
        """The names of the module's Jacobians, each found equal to exact derivatives of ``rhs``."""
        plain = Machine(self.module, self.point.elementary, self.literal)
        p, k = ([getattr(x, "value", x) for x in given[a].values] for a in ("p", "k"))
        wanted = Varied(plain, self.claims.state, self.point, p, k).wanted
        found = [name for name in wanted if name in self.module.functions]
        for name in found:
            D = wanted[name]()
            rates = {"dx": len(self.point.rates)} if name == "jacobian" else {}
            values = self._call(name, given, **rates, D=len(D))
            if rates:
                self._same(name, self._rates, values["dx"], self.point.rates)
            self._same(name, [f"entry {i} of D" for i in range(len(D))], values["D"], D)
        return found

    def _same(
        self, function: str, names: Sequence[str], found: Sequence[Any], wanted: Sequence[Any]
    ) -> None:
        """``DiffersError`` where numbers of a function are not those of the record; ``names``: what
        each is."""
        if len(found) != len(wanted):
            raise DiffersError(f"{function}: {len(found)} numbers, the record has {len(wanted)}")
        for name, x, y in zip(names, found, wanted, strict=True):
            if x != y:
                values = " and ".join(brief(v) for v in (x, y))
                if brief(x) == brief(y):
                    off = getattr(x, "value", x) - getattr(y, "value", y)
                    values += f", {brief(off)} apart"
                raise DiffersError(f"{function}: {name} differs from the record's: {values}")


def brief(x: Any) -> str:
    """A number as short text by its first six digits; another with the same text may differ from it
    in later ones."""
    value = Fraction(getattr(x, "value", x))
    return f"{float(value):.6g} …" if abs(value) < Fraction(10) ** 300 else "a large number"
