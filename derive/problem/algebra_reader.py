"""The values of the tables [algebra] and [[advected]] of a file."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..algebra.structure import Algebra
from ..language.limits import ROWS, TABLE
from ..language.rational import Matrix
from ..schema.algebra_kinds import REPRESENTATIONS
from ..schema.table import Slot
from .file_reader import FileReader
from .problem import ProblemError


class AlgebraReader(FileReader):
    """Reads these tables; those of advected quantities after the algebra is known."""

    def represents(self, algebra: Algebra) -> None:
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
            name = self.choice(Slot({slot.key: given}, slot.key, slot.where), REPRESENTATIONS)
            try:
                return tuple(self.algebra.representation(name))
            except ValueError as error:
                raise ProblemError(f"{slot.path}: {error}") from None
        if not isinstance(given, list) or len(given) != self.algebra.dimension:
            raise ProblemError(
                f"{slot.path}: expected {', '.join(REPRESENTATIONS)}, or a list of "
                f"{self.algebra.dimension} matrices, one for each element of the algebra"
            )
        where = f"{slot.path}, matrix {{}}"
        found = tuple(self._matrix(e, where.format(a)) for a, e in enumerate(given, 1))
        size = len(found[0])
        for a, e in enumerate(found, 1):
            if len(e) != size or any(len(row) != size for row in e) or not size:
                raise ProblemError(f"{where.format(a)}: expected a {size} × {size} matrix")
        return found
