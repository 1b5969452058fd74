"""The same as problem files, from Python: a few words that build the tables of a file.

    >>> from derive import SL, Points, Problem, Spring, derive
    >>> body = Points((1, [1, 0]), (2, [0, "a"]))
    >>> p = Problem("pair", SL(2), body, [Spring(1, 2, "k")], parameters={"a": 1.5, "k": 2})
    >>> print(derive(p)["motion"].equations[0].lhs)
    Ȧ

Everything is checked as a file is; ``ProblemError`` says in one line what is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from inspect import getmodule
from typing import Any

from ..problem import problem as mechanics
from ..problem.toml import problem_of
from ..schema.kinds import words

Number = int | float | str | Fraction
"""A number, or an expression in quotes."""


@dataclass(frozen=True)
class Group:
    """A group by its name, ``Group("SO(3)")``, or by a basis of its Lie algebra over Q.

    ``a * b`` is the product, on blocks of points.
    """

    name: str
    basis: Sequence[Sequence[Sequence[Number]]] | None = None
    action: str = "linear"

    def __mul__(self, other: Group) -> Group:
        return Group(f"{self.name} x {other.name}")

    def table(self) -> Any:
        """The value of ``group`` in a problem file: a name, or a table with a basis."""
        if self.basis is None:
            return self.name
        basis = [[[_plain(x) for x in row] for row in e] for e in self.basis]
        return {"name": self.name, "action": self.action, "basis": basis}


def SO(n: int) -> Group:
    """The rotations of Rⁿ."""
    return Group(f"SO({n})")


def SE(n: int) -> Group:
    """The displacements of Rⁿ."""
    return Group(f"SE({n})")


def SL(n: int) -> Group:
    """The linear maps of Rⁿ that keep the volume."""
    return Group(f"SL({n})")


def Sp(n: int) -> Group:
    """The symplectic maps of Rⁿ, n even."""
    return Group(f"Sp({n})")


def Sim(n: int) -> Group:
    """The similarities of Rⁿ."""
    return Group(f"Sim({n})")


def UT(n: int) -> Group:
    """The upper unitriangular maps of Rⁿ."""
    return Group(f"UT({n})")


def U(n: int) -> Group:
    """The unitary maps of Cⁿ = R²ⁿ."""
    return Group(f"U({n})")


def SU(n: int) -> Group:
    """The unitary maps of Cⁿ = R²ⁿ of determinant 1."""
    return Group(f"SU({n})")


def SAff(n: int) -> Group:
    """The affine maps of Rⁿ that keep the volume."""
    return Group(f"SAff({n})")


def GL(n: int) -> Group:
    """The invertible linear maps of Rⁿ."""
    return Group(f"GL({n})")


def Aff(n: int) -> Group:
    """The invertible affine maps of Rⁿ."""
    return Group(f"Aff({n})")


class Table:
    """A table of a problem file: its key and its fields."""

    def __init__(self, key: str, **fields: Any):
        self.key = key
        self.fields = {k: _plain(x) for k, x in fields.items() if x is not None}


def Points(*points: tuple[Any, ...]) -> list[Table]:
    """A body of points: (mass, place) for each, and in a product the block that moves it."""
    return [Table("point", mass=p[0], at=p[1], block=p[2] if len(p) > 2 else None) for p in points]


def Moments(**given: Any) -> list[Table]:
    """A body by its moments: m, c and J as given, or as parameters when none is given."""
    return [Table("body", given=given) if given else Table("body", moments="symbolic")]


def Solid(kind: str, density: Number, **sizes: Any) -> list[Table]:
    """A solid of uniform density: ``Solid("ball", "rho", radius="a")``; a sum is a mixture."""
    return [Table("solid", kind=kind, density=density, **sizes)]


def Gravity(*g: Number) -> Table:
    """Uniform gravity, U = −Σ m_i ⟨g, r_i⟩."""
    return Table("potential", kind="gravity", g=list(g))


def Spring(
    i: int | Sequence[Number], j: int | Sequence[Number], stiffness: Number, length: Number = 0
) -> Table:
    """A spring, U = ½ k (‖s‖ − length)², between points i and j; or from point i, or a place i of
    the body, to an anchor j in space."""
    if isinstance(j, int):
        ends: dict[str, Any] = {"between": [i, j]}
    else:
        ends = {"on" if isinstance(i, int) else "at": i, "anchor": j}
    return Table("potential", kind="spring", stiffness=stiffness, length=length, **ends)


def Potential(U: str) -> Table:
    """Any potential, an expression U in r1_x, r2_y, …, t and the parameters."""
    return Table("potential", kind="expression", U=U)


def __getattr__(name: str) -> Any:
    """The word of any other kind of potential: its keys are the arguments, in their order."""
    if name not in words():
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    kind = words()[name]

    def potential(*given: Any, **named: Any) -> Table:
        keys = kind.names()
        if len(given) > len(keys):
            raise mechanics.ProblemError(f"{name} takes {', '.join(keys)}, and no more")
        return Table("potential", kind=kind.kind, **dict(zip(keys, given, strict=False)), **named)

    potential.__name__ = potential.__qualname__ = name
    potential.__doc__ = (getmodule(kind) or kind).__doc__
    return potential


def Covector(name: str) -> Table:
    """An input: a covector of the Lie algebra, by its values on the basis."""
    return Table("input", kind="covector", name=name)


def Force(name: str, on: int | Sequence[Number], frame: str = "space") -> Table:
    """An input: a force on a point, or at a place of the body; its frame is "space" or "body"."""
    where = {"on": on} if isinstance(on, int) else {"at": on}
    return Table("input", kind="force", name=name, frame=frame, **where)


def Damping(
    coefficient: Number,
    on: Sequence[int] | None = None,
    at: Sequence[Number] | None = None,
) -> Table:
    """The force −κ v on points (all by default), or on a place of the body, outside dϖ."""
    return Table("damping", coefficient=coefficient, on=on, at=at)


def Problem(
    name: str,
    group: Group | str,
    body: Sequence[Table],
    forces: Sequence[Table] | Table = (),
    parameters: Mapping[str, Any] | None = None,
    title: str | None = None,
    negative_mass: bool = False,
    negative_stiffness: bool = False,
) -> mechanics.Problem:
    """A problem from its tables; ``ProblemError`` says what is wrong.

    ``negative_mass``, ``negative_stiffness``: may a mass, or the stiffness of a spring and the
    coefficient of a damping, be given as a negative number?
    """
    named = Group(group) if isinstance(group, str) else group
    data: dict[str, Any] = {"name": name, "group": named.table()}
    data["parameters"] = {k: _plain(x) for k, x in (parameters or {}).items()}
    if title is not None:
        data["title"] = title
    for table in (*_tables(body), *_tables(forces)):
        if table.key == "body":
            data["body"] = table.fields
        else:
            data.setdefault(table.key, []).append(table.fields)
    return problem_of(data, negative_mass=negative_mass, negative_stiffness=negative_stiffness)


def _tables(parts: Any) -> list[Table]:
    """The tables in nested lists of tables, or in one alone; ``ProblemError`` for anything else."""
    if isinstance(parts, Table):
        return [parts]
    if not isinstance(parts, (list, tuple)):
        raise mechanics.ProblemError(f"expected Points(…), Gravity(…) and so on, not {parts!r:.40}")
    return [table for part in parts for table in _tables(part)]


def _plain(x: Any) -> Any:
    """Plain data as a problem file has it: tuples and arrays as lists, fractions as text."""
    if hasattr(x, "tolist"):
        x = x.tolist()
    if isinstance(x, Fraction):
        return str(x)
    if isinstance(x, (list, tuple)):
        return [_plain(y) for y in x]
    return {k: _plain(y) for k, y in x.items()} if isinstance(x, dict) else x
