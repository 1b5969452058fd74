"""Rotations as a problem file says them: by axis and angle, roll, pitch and yaw, a quaternion, or
rows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..schema.table import Rows, Slot
from ..schema.table_reader import TableReader
from .moments import SolidError
from .problem import ProblemError
from .solids import rotation_about, rotation_by_angles, rotation_of_quaternion

TURNS: dict[str, tuple[int, Callable[..., Rows]]] = {
    "rpy": (3, rotation_by_angles),
    "quaternion": (4, lambda *x: rotation_of_quaternion(x)),
}
"""Key of a rotation of R³ → of how many numbers, and the rows that they give."""
KEYS = ("rotation", *TURNS)
"""The keys of a table that is turned."""


def turn_in(table: Mapping[str, Any], where: str) -> tuple[str, Any]:
    """Under which of KEYS a table says a rotation, and what it says; "" where it says none."""
    said = [x for x in KEYS if x in table]
    if len(said) > 1:
        raise ProblemError(f"{where}: give one of {said[0]} and {said[1]}")
    if not said:
        return "", None
    (name,) = said
    return name, table[name] if name == "rotation" else {name: table[name]}


def rotation(value: Any, n: int, where: str, reader: TableReader) -> Rows:
    """{ axis, angle }, { rpy } or { quaternion } in R³, or a matrix of numbers that is a rotation
    of Rⁿ."""
    if isinstance(value, dict):
        if n != 3:
            name = next((x for x in TURNS if x in value), "axis")
            told = "[[c, -s], [s, c]] with numbers" if n == 2 else f"{n} rows of {n} numbers"
            raise ProblemError(f"{where}: {name!r} is of R^3; give rotation = {told}")
        try:
            return _in_words(value, where, reader)
        except SolidError as error:
            raise ProblemError(f"{where}: {error}") from None
    words = ("{ axis, angle }", *(f"{{ {x} }}" for x in TURNS)) if n == 3 else ()
    other, exact = (f", or {words[0]}", f"; {words[0]} is exact") if words else ("", "")
    if not isinstance(value, list) or len(value) != n:
        listed = f"{', '.join(words)} or " if words else ""
        raise ProblemError(f"{where}: expected {listed}a list of {n} rows")
    if not all(isinstance(row, list) for row in value):
        raise ProblemError(f"{where}: expected {n} rows of {n} numbers{other}")
    rows = reader.rows(value, n, n, where)
    if not all(isinstance(x, (int, Fraction)) for row in rows for x in row):
        raise ProblemError(
            f"{where}: the entries must be numbers{other.replace(', or', '; else give')}"
        )
    R = tuple(tuple(Fraction(str(x)) for x in row) for row in rows)
    off = q.minus(q.times(R, q.transposed(R)), q.identity(n))
    if max(abs(x) for x in q.flatten(off)) > Fraction(1, 10**6):
        raise ProblemError(f"{where}: the rows are not orthogonal unit vectors{exact}")
    if q.determinant(R) < 0:
        raise ProblemError(f"{where}: a reflection; change the sign of one row")
    return rows


def _in_words(table: Mapping[str, Any], where: str, reader: TableReader) -> Rows:
    """A rotation of R³ by a key of TURNS, or by its axis and angle."""
    name = next((x for x in TURNS if x in table), "")
    reader.known(table, {name} if name else {"axis", "angle"}, where)
    if name:
        size, rows_of = TURNS[name]
        return rows_of(*reader.listed(table[name], size, f"{where}, {name}"))
    axis = reader.listed(reader.value(Slot(table, "axis", where)), 3, f"{where}, axis")
    return rotation_about(axis, reader.scalar(Slot(table, "angle", where)))
