"""Problems that no points give: a Lagrangian, an algebra with what it carries along, the torus.

Of motions on a quotient of the group: what its directions without kinetic energy change.  Along a
direction n that keeps ℓ, g goes on to g exp(s n), on the right to exp(s n) g, with any function s
of the time: δg = s g n, δZ = ṡ n + s [Z, n], δŻ = s̈ n + ṡ [Z, n] + s [Ż, n]; on the right the
brackets change their sign.  A motion of the quotient tells what none of it changes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ..algebra import structure
from ..algebra.families import group, on_homogeneous
from ..algebra.groups import Group
from ..algebra.user_groups import carrying, group_of_basis
from ..language.derivatives import derivative
from ..language.expression import names
from ..language.limits import CARRIED, ROWS, TABLE
from ..language.rational import Matrix
from ..language.tree import Tree, add, mul, neg, nodes, plain
from ..schema import kind
from ..schema.force_kinds import CovectorInput, LaplacianDamping
from ..schema.table import Slot
from .entries_on_orbit import (
    Direction,
    EntriesOfElement,
    along,
    held,
    hessian,
    null_directions,
    vanishes,
    vanishes_on,
    with_constant_entries,
)
from .fields import coordinates, named_tables, no_entry, undeclared, used_at
from .file_reader import FileReader
from .motion_tables import KEYS as MOTION
from .motion_tables import motion_fields
from .problem import Problem, ProblemError


def quotient_of(problem: Problem) -> Quotient | None:
    """That of a Lagrangian which has such directions."""
    given, group = problem.lagrangian, problem.group
    if given is None or group is None or not given.held:
        return None
    null = null_directions(hessian(given.L, coordinates(group))) or ()
    return Quotient(group, given.trivialisation, null)


class Quotient:
    """What the directions without kinetic energy change; ``side``: the trivialisation."""

    def __init__(self, group: Group, side: str, directions: Sequence[Direction]):
        self.group, self.directions = group, directions
        self.entries = EntriesOfElement(group, side)
        self.sign = 1 if side == "left" else -1
        self.zeta: list[Tree] = coordinates(group)
        self.rates: list[Tree] = [("entry", "ζ̇", a + 1) for a in range(group.dimension)]

    def bracket(self, values: Sequence[Tree], n: Direction, *, dual: bool = False) -> list[Tree]:
        """The coordinates of [v, n], on the right of [n, v]; or, ``dual``, of the covector
        ⟨v, [n, E_a]⟩, on the right −⟨v, [n, E_a]⟩."""
        table, span = self.group.structure_constants, range(self.group.dimension)

        def term(i: int, j: int, k: int) -> Any:
            return table[j][k][i] if dual else table[i][j][k]

        return [
            add(
                *(
                    mul(plain(self.sign * x * term(i, j, k)), values[i])
                    for j, x in enumerate(n)
                    for i in span
                    if x and term(i, j, k)
                )
            )
            for k in span
        ]

    def variation(self, t: Tree, n: Direction) -> Tree:
        """That of an expression of g, ζ and ζ̇ where s is constant."""
        span = range(self.group.dimension)
        moved = along([self.entries.along(t, a) for a in span], n)
        terms = [
            mul(derivative(t, x), y)
            for values in (self.zeta, self.rates)
            for x, y in zip(values, self.bracket(values, n), strict=True)
            if y != 0
        ]
        return add(moved, *terms)

    def turned(self, t: Tree, n: Direction) -> list[Tree]:
        """Its derivatives by ṡ and by s̈."""
        by_rates = [derivative(t, x) for x in self.rates]
        ahead = zip(by_rates, self.bracket(self.zeta, n), strict=True)
        first = along([derivative(t, x) for x in self.zeta], n)
        return [add(first, *(mul(x, y) for x, y in ahead)), along(by_rates, n)]

    def keeps(self, t: Tree) -> bool:
        """Has an expression the same value for all motions of one of the quotient?"""
        return all(
            vanishes_on(self.group, x)
            for n in self.directions
            for x in (self.variation(t, n), *self.turned(t, n))
        )

    def laws(self, Q: Sequence[Tree], n: Direction) -> list[tuple[Tree, Tree]]:
        """What is so of a covector that acts on the quotient: ⟨Q, n⟩ = 0; and it goes on with g,
        δQ_a = s ⟨Q, [n, E_a]⟩, on the right −s ⟨Q, [n, E_a]⟩."""
        carried = self.bracket(Q, n, dual=True)
        return [(along(Q, n), 0), *zip([self.variation(x, n) for x in Q], carried, strict=True)]

    def bears(self, Q: Sequence[Tree]) -> bool:
        """Is a covector one of the quotient?"""
        return all(
            vanishes_on(self.group, x)
            for n in self.directions
            for x in (
                *(add(one, neg(other)) for one, other in self.laws(Q, n)),
                *(y for t in Q for y in self.turned(t, n)),
            )
        )


# The algebra of a problem file that moves no points: its brackets, and what it carries along.

GIVEN = ("of", "basis", "brackets")
"""The keys of [algebra], of which one says it."""


def group_of_algebra(data: Mapping[str, Any]) -> tuple[Group, tuple[kind.Advected, ...]]:
    """The group of [algebra], and what [[advected]] tables say it carries along."""
    reader = AlgebraReader()
    if "group" in data or "action" in data:
        raise ProblemError("give either 'group' or [algebra]")
    own = _algebra(reader.typed(kind.StatedAlgebra, data["algebra"], "algebra"), data["algebra"])
    reader.represents(own)
    listed = data.get("advected", [])
    if not isinstance(listed, list) or not all(isinstance(x, dict) for x in listed):
        raise ProblemError("key 'advected' must be tables [[advected]]")
    read = [reader.typed(kind.StatedAdvected, x, f"advected {k}") for k, x in enumerate(listed, 1)]
    for k, x in enumerate(read, 1):
        if x.name in [y.name for y in read[: k - 1]] or x.name in ("zeta", "t"):
            raise ProblemError(f"advected {k}: {x.name!r} names something else; choose another")
        try:
            structure.require_representation(x.representation, own.brackets)
        except ValueError as error:
            raise ProblemError(f"advected {k}, representation: {error}") from None
    try:
        stand = own.standard or structure.faithful(own.brackets, own.dimension)
    except ValueError as error:
        raise ProblemError(f"algebra: {error}") from None
    found = carrying(own.name, own.dimension, stand, [x.representation for x in read])
    if found.n > CARRIED:
        raise ProblemError(
            f"advected: the matrices of the algebra and of all that it carries have {found.n} "
            f"rows together; at most {CARRIED}"
        )
    return found, tuple(kind.Advected(name=x.name, size=len(x.representation[0])) for x in read)


def _algebra(given: kind.StatedAlgebra, table: Mapping[str, Any]) -> structure.Algebra:
    if len([key for key in GIVEN if key in table]) != 1:
        raise ProblemError(f"algebra: give one of {', '.join(GIVEN)}")
    if "dimension" in table and "brackets" not in table:
        raise ProblemError("algebra, dimension: it goes with 'brackets'; leave it out")
    if given.brackets or "brackets" in table:
        return _by_brackets(given)
    try:
        moved = group(given.of) if given.of else group_of_basis("G", "linear", [*given.basis])
    except ValueError as error:
        raise ProblemError(f"algebra, {'of' if given.of else 'basis'}: {error}") from None
    own = (on_homogeneous(moved) if moved.affine else moved).in_user_basis
    return structure.Algebra(own.name, own.dimension, _sparse(own.structure_constants), own.basis)


def _by_brackets(given: kind.StatedAlgebra) -> structure.Algebra:
    largest = max((i for *indices, _ in given.brackets for i in indices), default=1)
    dimension = given.dimension or largest
    if largest > dimension:
        raise ProblemError(f"algebra, brackets: E_{largest}, of {dimension} elements (dimension)")
    if dimension > TABLE:
        raise ProblemError(f"algebra: {dimension} elements; at most {TABLE}")
    try:
        brackets = structure.brackets_of(given.brackets)
        structure.require_jacobi(brackets, dimension)
    except ValueError as error:
        raise ProblemError(f"algebra, brackets: {error}") from None
    return structure.Algebra("G", dimension, brackets)


def _sparse(table: Sequence[Matrix]) -> structure.Brackets:
    """The table without what is 0."""
    return {
        (a, b): {k: x for k, x in enumerate(own) if x}
        for a, rows in enumerate(table)
        for b, own in enumerate(rows)
        if any(own)
    }


# A problem on the torus: [algebra] of = "torus", its N, and its inertia operator by name.

KEYS = ("name", "title", "parameters", "algebra", "inertia", "input", "damping", *MOTION)
"""The keys of such a file."""
INSTEAD = {
    "force": "what acts is a sum over the lattice: give an [[input]], a [[signal]], a [[damping]]",
    "output": "what is read there are the numbers of its state, columns of each run",
}
"""What to do in place of a table that others have."""


def on_torus(data: Mapping[str, Any]) -> bool:
    """Is the algebra of a file that of the torus, or of a name, with the N of a lattice?"""
    given = data.get("algebra")
    return isinstance(given, dict) and (given.get("of") == "torus" or {"of", "N"} <= {*given})


def torus_problem(
    data: Mapping[str, Any], reader: FileReader, parameters: Mapping[str, kind.Parameter]
) -> Problem:
    """The problem of a file; ``ProblemError`` for what else it says."""
    for key in data:
        if key not in KEYS:
            known = f"on the torus there are {', '.join(KEYS)} alone"
            raise ProblemError(f"key {key!r}: {known}; {INSTEAD.get(key, 'leave it out')}")
    algebra = reader.typed(kind.StatedTorus, data["algebra"], "algebra")
    if algebra.of != "torus":
        raise ProblemError(f'algebra, of: with N it is "torus", not {algebra.of[:40]!r}')
    torus = structure.TorusLattice(algebra.N)
    if "inertia" not in data:
        raise ProblemError('the torus needs its inertia: give [inertia] operator = "laplacian"')
    given = reader.typed(kind.TorusInertia, data["inertia"], "inertia")
    if given.operator != "laplacian":
        raise ProblemError('inertia, operator: on the torus it is "laplacian", |n|² on T_n')
    if given.trivialisation != "right":
        raise ProblemError('inertia, trivialisation: a fluid moves on the "right"; leave it out')
    name = reader.name_of(data)
    reader.carries(None, parameters)
    inputs, damping = _forcing(data, reader)
    title, motion = reader.title_of(data, name), motion_fields(data, reader)
    return Problem(
        name,
        None,
        title=title,
        parameters=parameters,
        inputs=inputs,
        damping=damping,
        torus=torus,
        **motion,
    )


def _forcing(
    data: Mapping[str, Any], reader: FileReader
) -> tuple[tuple[CovectorInput, ...], tuple[LaplacianDamping, ...]]:
    """What acts on the vorticity from outside dϖ: a covector, and multiples of powers of −Δ."""
    known = {CovectorInput.kind: CovectorInput}
    inputs = tuple(reader.one_of(known, x, w) for w, x in named_tables(data, "input").items())
    if len(inputs) > 1:
        raise ProblemError("key 'input': one covector holds every component; give one such table")
    reader.distinct(inputs, reader.parameters)
    own = {LaplacianDamping.kind: LaplacianDamping}
    damping = tuple(reader.one_of(own, x, w) for w, x in named_tables(data, "damping").items())
    for k, x in enumerate(damping, 1):
        where = f"damping {k}, coefficient"
        if any(isinstance(t, tuple) and t[0] == "fun" for t in nodes(x.coefficient)):
            raise ProblemError(
                f"{where}: on the torus it is made by + − * / and whole powers of parameters; "
                "give a parameter in the place of a function"
            )
        if x.power in (y.power for y in damping[: k - 1]):
            raise ProblemError(f"damping {k}: a second one of power {x.power}; add them up in one")
    return inputs, damping


# The values of the tables [algebra] and [[advected]] of a file.


class AlgebraReader(FileReader):
    """Reads these tables; those of advected quantities after the algebra is known."""

    def represents(self, algebra: structure.Algebra) -> None:
        """From here on the algebra is known."""
        self.algebra = algebra

    def elements(self, slot: Slot) -> int:
        """How many elements."""
        return self.integer(self.value(slot), 1, TABLE, slot.path)

    def brackets(self, slot: Slot) -> tuple[tuple[int, int, int, Fraction], ...]:
        """Rows [a, b, k, c], of indices from 1 and a rational number."""
        rows = self.value(slot, list)
        if len(rows) > ROWS:
            raise ProblemError(f"{slot.path}: {len(rows)} rows; at most {ROWS}")
        return tuple(self._row(row, f"{slot.path}, row {k}") for k, row in enumerate(rows, 1))

    def _row(self, row: Any, where: str) -> tuple[int, int, int, Fraction]:
        if not isinstance(row, list) or len(row) != 4:
            raise ProblemError(f"{where}: expected [a, b, k, c], of [E_a, E_b] = c E_k + …")
        a, b, k = (self.integer(x, 1, TABLE, where) for x in row[:3])
        c = self.expression(row[3], where)
        if not isinstance(c, (int, Fraction)):
            raise ProblemError(f"{where}: the coefficient must be a rational number")
        return a, b, k, Fraction(c)

    def representation(self, slot: Slot) -> tuple[Matrix, ...]:
        """By its name, 'standard' where the file leaves it out, or a matrix for each element."""
        given = slot.table.get(slot.key, "standard")
        if isinstance(given, str):
            name = self.choice(Slot({slot.key: given}, slot.key, slot.where), kind.REPRESENTATIONS)
            try:
                return tuple(self.algebra.representation(name))
            except ValueError as error:
                raise ProblemError(f"{slot.path}: {error}") from None
        if not isinstance(given, list) or len(given) != self.algebra.dimension:
            raise ProblemError(
                f"{slot.path}: expected {', '.join(kind.REPRESENTATIONS)}, or a list of "
                f"{self.algebra.dimension} matrices, one for each element of the algebra"
            )
        where = f"{slot.path}, matrix {{}}"
        found = tuple(self._matrix(e, where.format(a)) for a, e in enumerate(given, 1))
        size = len(found[0])
        for a, e in enumerate(found, 1):
            if len(e) != size or any(len(row) != size for row in e) or not size:
                raise ProblemError(f"{where.format(a)}: expected a {size} × {size} matrix")
        return found


# A Lagrangian that no points give: an expression ℓ(t, g, Z), or an inertia operator on 𝔤.
#
# In an expression t is the time, and the names of the state are what they are in emitted code:
# A_11 and so on are the entries of g (A1_11, … in a product), T_1, … its translation, zeta_1, …
# the coordinates of Z in the basis of 𝔤; of an algebra without g, those of what it carries along.


def lagrangian(data: Mapping[str, Any], group: Group, reader: FileReader) -> kind.Lagrangian:
    """The Lagrangian of the table [lagrangian] or [inertia] of a file; ``ProblemError`` where it is
    none, or its second derivative in the velocity is singular."""
    (where, own), *others = ((x, own) for x, own in kind.SECTIONS.items() if x in data)
    if others:
        raise ProblemError("give either [lagrangian] or [inertia]")
    for name in data.get("parameters", {}):
        if name in reader.state_names:
            raise ProblemError(
                f"parameter {name!r}: an entry of the state in [{where}]; choose another name"
            )
        if fault := no_entry(name, group, reader.state_names):
            raise ProblemError(f"parameter {name[:40]!r}: {fault}; choose another name")
    if not isinstance(data[where], dict):
        raise ProblemError(f"key {where!r} must be a table [{where}]")
    table = reader.typed(own, data[where], where)
    for name in (x for t in table.trees() for x in names(t)):
        if name not in reader.parameters:
            at = used_at(data, name)
            known = reader.state_names
            raise ProblemError(undeclared(name, at, reader.parameters, group, known))
    found = of_inertia(table, group) if isinstance(table, kind.Inertia) else table
    if not any(t in coordinates(group) for t in nodes(found.L)):
        raise ProblemError(f"{where}: no coordinate of the velocity, as zeta_1, so no motion")
    if reader.advected is None:
        try:
            found = replace(found, L=with_constant_entries(found.L, group))
        except ZeroDivisionError:
            raise ProblemError(
                f"{where}: it divides by an entry of g that is 0 on {group.name}"
            ) from None
    return _with_null_directions(found, group, reader, where)


def of_inertia(given: kind.Inertia, group: Group) -> kind.Lagrangian:
    """½⟨ζ, 𝕀ζ⟩ + ⟨a, ζ⟩ − U as an expression; ``ProblemError`` where 𝕀 is not symmetric."""
    zeta, rows, span = coordinates(group), given.operator, range(group.dimension)
    if any(rows[a][b] != rows[b][a] for a in span for b in range(a)):
        raise ProblemError("inertia, operator: the matrix must be symmetric")
    terms = [
        mul(Fraction(1, 2) if a == b else 1, rows[a][b], zeta[a], zeta[b])
        for a in span
        for b in span[a:]
    ]
    terms += [mul(x, z) for x, z in zip(given.momentum, zeta, strict=False)]
    return kind.Lagrangian(L=add(*terms, neg(given.U)), trivialisation=given.trivialisation)


def _with_null_directions(
    found: kind.Lagrangian, group: Group, reader: FileReader, where: str
) -> kind.Lagrangian:
    """The same with the coordinates that are held, where ∂²ℓ/∂Z² is singular in directions that
    keep ℓ; ``ProblemError`` where it is so in others, or here in some and there in others."""
    zeta = coordinates(group)
    null = null_directions(hessian(found.L, zeta))
    if null is None:
        raise ProblemError(f"{where}: ∂²L/∂Z² is singular, in directions that are not constant")
    if len(null) == len(zeta):
        raise ProblemError(
            f"{where}: L is of first order in the velocities, which the kernel of dϖ leaves free; "
            "add a kinetic energy"
        )
    quotient = Quotient(group, found.trivialisation, null)
    for direction in null:
        name = structure.as_text({k: x for k, x in enumerate(direction) if x})
        if not vanishes(along([derivative(found.L, x) for x in zeta], direction)):
            raise ProblemError(
                f"{where}: ∂²L/∂Z² is singular along {name}, and L is linear there, so that no "
                "equation tells this acceleration; add its kinetic energy"
            )
        if reader.advected is not None or not vanishes_on(
            group, quotient.variation(found.L, direction)
        ):
            raise ProblemError(
                f"{where}: ∂²L/∂Z² is singular along {name}, and that is no symmetry of L: the "
                "equations leave this velocity open; add its kinetic energy"
            )
    return replace(found, held=tuple(k + 1 for k in held(null)))
