"""What Python holds that has a record of its own: it is checked."""

from __future__ import annotations

from ..check.form.hypotheses_checked import Verdict
from ..record.record import Derivation


class Checked:
    """Something with a ``record``, its derivation."""

    record: Derivation

    def check(self, seed: int | None = None) -> list[Verdict]:
        """The verdicts of the checker on the record."""
        from ..check.checker import check

        return check(self.record, seed)
