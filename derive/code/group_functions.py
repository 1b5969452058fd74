"""The functions of the group, in a file of their own: exponential, logarithm, their derivatives,
and steps from state to state; in closed form on groups whose factors turn a plane or space and
shift it, by series and roots of matrices on all others.

Such a factor is a block [[R, S], [0, 1]]: R turns its first rows, 2 or 3, or is 1; S has any number
of columns.  So are SO(2), SO(3), SE(2), SE(3), Rⁿ, their products, SE_2(3) as a group of one's own
basis, and groups inside of these.
"""

from __future__ import annotations

import ast
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import factorial
from typing import Any

from ..algebra.factor_charts import QUATERNION, FactorChart, factor_charts
from ..algebra.groups import Group
from ..language.rational import Matrix, identity
from ..record.record import Derivation
from ..routines import printer_of, text_of
from .conventions import basis_lines, listed, said
from .options import Options
from .program import Program, refuse_first
from .slots import OfElement, StateSlot
from .state import StateSpace

FUNCTIONS: dict[str, tuple[tuple[str, ...], str]] = {
    "exp": (("eta",), "g"),
    "log": (("g",), "eta"),
    "exp_jacobian": (("eta",), "J"),
    "log_jacobian": (("g",), "J"),
    "retract": (("x", "eta"), "y"),
    "local": (("x", "y"), "eta"),
}
"""Function → what it takes, and what it writes."""

OF_FILTER: dict[str, tuple[tuple[str, ...], str]] = {
    **{x: FUNCTIONS[x] for x in ("exp", "log", "exp_jacobian", "log_jacobian")},
    **dict.fromkeys(("update_left", "update_right"), (("x", "o", "Y", "N"), "y")),
    "update": (("x", "z", "H", "N"), "y"),
}
"""The same where the state is an estimate with the covariance of its error."""

FLOATS = ("float", "f32", "Float32")
"""What single numbers are called, but in JavaScript, where this work is of doubles."""

TERMS = 14
"""Terms of a series in −t²: for t² < 4 the next one is below 1e-18 of the first."""


@dataclass(frozen=True)
class Factor:
    """Rows and columns from ``start`` to ``end`` of the matrix, of which the first ``rows`` move,
    and the first ``turns``, 2, 3 or none, turn; ``members``: which E_a are in it, from 0."""

    start: int
    rows: int
    end: int
    turns: int
    members: tuple[int, ...]


@dataclass(frozen=True)
class GroupFunctions:
    """What the algorithms know of a group and its state.

    ``entries``: row and column of each number of an element that is an entry of its matrix, and
    which number it is; ``quaternions``: the first number of each, and the first of the three rows
    that it turns; ``origin``: the matrix of the identity, with what never varies; ``read``: of each
    coordinate the terms (coefficient, row, column) that it is read by; ``brackets``: the
    coordinates of [E_a, E_b]; ``right``: is a variation δg = η g, and Z = ġ g⁻¹? ``covariance``: is
    an element followed in the state by the upper triangle of a covariance, not by a velocity?
    ``masses``: how many follow the velocity.
    There are no ``factors`` where one does something else than turn and shift.
    """

    entries: tuple[tuple[int, int, int], ...]
    quaternions: tuple[tuple[int, int], ...]
    origin: Matrix
    read: tuple[tuple[tuple[Fraction, int, int], ...], ...]
    brackets: tuple[Matrix, ...]
    factors: tuple[Factor, ...]
    right: bool
    covariance: bool = False
    masses: int = 0

    @classmethod
    def of(cls, space: StateSpace) -> GroupFunctions:
        """Those of a state that :func:`refuse` does not refuse."""
        found = cls.of_group(space.group, space.held_of_g, space.still, right=space.right)
        return replace(found, masses=len(space.stored))

    @classmethod
    def of_group(
        cls,
        group: Group,
        held: Sequence[OfElement],
        still: Mapping[StateSlot, Fraction],
        *,
        right: bool,
        covariance: bool = False,
    ) -> GroupFunctions:
        """Those of an element as a state has it, ``held``, without what is ``still``."""

        def place(x: Any) -> tuple[int, int]:
            return x.row, group.n if x.letter == "T" else x.column

        origin = [[*row] for row in identity(group.size)]
        for x, value in still.items():
            i, j = place(x)
            origin[i][j] = value
        entries, quaternions, number = list[tuple[int, int, int]](), list[tuple[int, int]](), 0
        for y in held:
            if isinstance(y, FactorChart):
                quaternions.append((number, y.offset))
            else:
                entries.append((*place(y), number))
            number += len(y.names) if isinstance(y, FactorChart) else 1
        return cls(
            tuple(entries),
            tuple(quaternions),
            tuple(map(tuple, origin)),
            tuple(tuple(group.coordinate_terms(a)) for a in range(group.dimension)),
            group.structure_constants,
            tuple(_factors(group)),
            right,
            covariance,
        )

    @property
    def functions(self) -> dict[str, tuple[tuple[str, ...], str]]:
        """Function → what it takes, and what it writes."""
        return OF_FILTER if self.covariance else FUNCTIONS

    @property
    def numbers(self) -> int:
        """How many numbers an element has."""
        return len(self.entries) + 4 * len(self.quaternions)

    @property
    def observed(self) -> list[int]:
        """The rows of a matrix of the group that vary."""
        return sorted({i for i, _, _ in self.entries})

    def count(self, function: str, argument: str) -> int:
        """How many numbers an argument of a function has."""
        element, d, seen = self.numbers, len(self.read), len(self.observed)
        added = d + self.masses
        state = element + (d * (d + 1) // 2 if self.covariance else added)
        twice = argument == "eta" and "x" in self.functions[function][0]  # with a velocity
        return {
            **{"g": element, "x": state, "y": state, "eta": d + added if twice else d, "J": d * d},
            **{"o": len(self.origin), "Y": seen, "z": seen, "N": seen * seen, "H": seen * d},
        }[argument]


def refuse(d: Derivation, group: Group, chosen: Options) -> None:
    """``LoweringError`` for a state for which these functions are not written."""
    charts = factor_charts(group.in_user_basis, chosen.attitude).values()
    others = any(x.kind != QUATERNION for x in charts)
    reasons = (
        (others, f"written for matrices and quaternions, not with --attitude {chosen.attitude}"),
        (chosen.velocity == "tangent", "not written with --velocity tangent"),
        ("advected" in d.problem, "of elements of a group, and on an algebra the state has none"),
        (
            bool(d.problem.get("lagrangian", {}).get("held")),
            "of errors in all of g and its velocity, and on a quotient they are modulo symmetries",
        ),
    )
    refuse_first(d.name, *((on, f"--exponential is {why}") for on, why in reasons))


def _factors(group: Group) -> list[Factor]:
    """The factors; none where one does something else than turn and shift, or an element of the
    basis is in several."""
    found, members = list[Factor](), list[int]()
    for start, factor in group.places:
        span = range(start, start + factor.size)
        own = [a for a, e in enumerate(group.basis) if any(e[i][j] for i in span for j in span)]
        inside = [group.basis[a] for a in own]
        moved = [i for i in span if any(e[i][j] for e in inside for j in span)]
        turning = range(start, moved[-1] + 1 if moved else start)
        pairs = [(e[i][j], e[j][i]) for e in inside for i in turning for j in turning]
        turns = len(turning) if any(x for x, _ in pairs) else 0
        if any(x != -y for x, y in pairs) or turns not in (0, 2, 3):
            return []
        found.append(Factor(start, len(turning), span.stop, turns, tuple(own)))
        members += own
    return found if sorted(members) == [*range(group.dimension)] else []


def _series() -> list[list[float]]:
    """The series of ``turning`` in −t²: of a, b and c, of the slopes of b and c, of that of b's."""

    def derived(order: int, times: int) -> list[float]:
        rows = range(times, times + TERMS)
        factors = [factorial(m) // factorial(m - times) for m in rows]
        terms = (Fraction(x, factorial(2 * m + order)) for m, x in zip(rows, factors, strict=True))
        return [*map(float, terms)]

    return [derived(*x) for x in ((1, 0), (2, 0), (3, 0), (2, 1), (3, 1), (2, 2))]


def _sparse(name: str, terms: Iterable[tuple[int, int, int, Any]]) -> dict[str, Any]:
    """A table of terms: three indices, and the number of each."""
    found = [*terms] or [(0, 0, 0, 0)]
    places, values = [[*x[:3]] for x in found], [float(x[3]) for x in found]
    return {f"N_{name}": len(found), f"{name}_PLACES": places, f"{name}_VALUES": values}


def _entries(matrices: Sequence[Matrix]) -> list[tuple[int, int, int, Any]]:
    """Row, column, number of the matrix and value of all that is not 0."""
    cells = (
        (a, i, j) for a, m in enumerate(matrices) for i in range(len(m)) for j in range(len(m))
    )
    return [(i, j, a, matrices[a][i][j]) for a, i, j in cells if matrices[a][i][j]]


def known(p: Program) -> dict[str, Any]:
    """What the algorithms know, whatever the language."""
    f: GroupFunctions = p.group_functions
    d, element = p.dimension, f.numbers
    turned = [row for _, row in f.quaternions]
    terms = ((a, x) for a, found in enumerate(f.read) for x in found)
    return {
        "SIZE": len(f.origin),
        "WIDE": max(len(f.origin), d),
        "MOST": 40,
        "N_ELEMENT": element,
        "N_ALGEBRA": d,
        "N_STATE": f.count("exp", "x"),
        "N_OBSERVED": len(f.observed),
        "N_NOISE": len(f.observed) ** 2,
        "N_JACOBIAN_OBSERVED": len(f.observed) * d,
        "OBSERVED": f.observed,
        "N_TANGENT": 2 * d + f.masses,
        "N_ADDED": d + f.masses,
        "N_MASSES": f.masses,
        "N_JACOBIAN": d * d,
        "N_FACTORS": len(f.factors),
        "N_ENTRIES": len(f.entries),
        "ENTRIES": [[*x] for x in f.entries],
        "N_QUATERNIONS": len(turned),
        "QUATERNIONS": [at for at, _ in f.quaternions],
        "TURNED": turned,
        "N_LOGARITHMS": len(turned) if f.factors else 0,
        "ORIGIN": [[*map(float, row)] for row in f.origin],
        **_sparse("HAT", _entries(p.basis)),
        **_sparse("READ", ((i, j, a, c) for a, (c, i, j) in terms)),
        # ad of E_a has the coordinates of [E_a, E_b] in column b
        **_sparse("BRACKET", ((c, b, *x) for b, c, *x in _entries(f.brackets))),
        "FACTOR_OF": [k for a in range(d) for k, x in enumerate(f.factors) if a in x.members],
        "STARTS": [x.start for x in f.factors],
        "ROWS": [x.rows for x in f.factors],
        "ENDS": [x.end for x in f.factors],
        "IN_PLANE": [x.turns == 2 for x in f.factors],
        "IN_SPACE": [x.turns == 3 for x in f.factors],
        "BY_QUATERNION": [x.start in turned for x in f.factors],
        "TERMS": TERMS,
        "SERIES": _series(),
        "RIGHT": f.right,
        "LEFT": not f.right,
        "SIGN": 1.0 if f.right else -1.0,
        "BACK": -0.5 if f.right else 0.5,
        "JACOBIAN": f"exp(eta + d) = {'exp(J d) exp(eta)' if f.right else 'exp(eta) exp(J d)'}",
        "DOMAIN": "turning by at most pi" if f.factors else "of eigenvalues a + bi with |b| < pi",
        "INVERSE": f"{'exp(d) g' if f.right else 'g exp(d)'} = exp(log(g) + J d)",
        "PRODUCT": "exp(eta) g" if f.right else "g exp(eta)",
    }


def _conventions(p: Program) -> list[str]:
    """What a reader of the file must know, in lines."""
    f: GroupFunctions = p.group_functions
    element = f.numbers
    if f.covariance:
        rows = ", ".join(str(i + 1) for i in f.observed)
        found = said("estimate", element=element, origin=len(f.origin), rows=rows)
    else:
        masses, own = " and to masses" * bool(f.masses), {"varied": p.varied}
        found = said("states", element=element, masses=masses, variation=p.variation, **own)
    text = f"{said('exponential')} {found}"
    if not f.factors:
        text += " " + said("general")
    if any(x.turns for x in f.factors):
        turning = "log turns" if f.covariance else "log and local turn"
        text += " " + said("turns", turning=turning)
    return [
        *textwrap.wrap(text, 92),
        *listed("  g = (", p.state[:element], ")", 88),
        *(f"  {line}" for line in basis_lines(p)),
    ]


def printed_group(language: str, p: Program, fields: Mapping[str, Any]) -> dict[str, Any]:
    """The tables and routines of the file of a language, with what its template says of them."""
    f: GroupFunctions = p.group_functions
    given = known(p) | {
        "fabs": fields["fabs"],
        "SMALL": 1e-7 if fields["real"] in FLOATS else 1e-16,
        "public": {*f.functions} if language == "rust" else (),
        "item": ["#[allow(dead_code, non_snake_case, unused, clippy::all)]", "#[rustfmt::skip]"],
        # JavaScript has functions of these names that make what they write
        **({name: f"{name}_into" for name in f.functions} if language == "javascript" else {}),
    }
    parts = ["group_elements", "group_turns" if f.factors else "group_series", "group_maps"]
    parts += ["invariant_update"] * f.covariance
    own = fields["prefix"], fields["real"]
    printer = printer_of(language, map(text_of, parts), given, *own)
    told = []
    for name, (takes, writes) in f.functions.items():
        doc = printer.with_numbers(ast.get_docstring(printer.source.routines[name]) or "")
        told.append(
            {
                "name": name,
                "takes": [(x, f.count(name, x)) for x in takes],
                "writes": writes,
                "count": f.count(name, writes),
                "doc": doc,
            }
        )
    return {
        "tables": "\n".join(printer.tables()),
        "routines": printer.text([*f.functions]),
        "functions": told,
        "size": p.dimension,
        "conventions": _conventions(p),
    }
