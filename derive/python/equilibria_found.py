"""The relative equilibria of a problem as Python holds them, and their record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..equilibria.enclosed_points import Enclosed
from ..equilibria.equilibrium_points import coordinate
from ..equilibria.stability import Equilibrium
from ..language.quadratic import Number
from ..record.record import Derivation
from .checked import Checked


@dataclass(frozen=True)
class Judged:
    """What is known of the stability of a relative equilibrium."""

    found: Equilibrium | Enclosed

    @property
    def verdict(self) -> str:
        """What is proved: "stable", "stable on the leaf", "unstable", or "open" for nothing."""
        return self.found.verdict

    @property
    def signature(self) -> tuple[int, int]:
        """How many squares of the energy–Casimir form on the leaf are positive and negative."""
        return self.found.signature

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About the eigenvalues of the linearised rates on the leaf, in 1/s."""
        return self.found.eigenvalues


@dataclass(frozen=True)
class Steady(Judged):
    """A relative equilibrium.  ``found``: all that is known of it."""

    found: Equilibrium

    @property
    def at(self) -> dict[str, Number]:
        """The coordinates that are not 0, by their names."""
        about = self.found.about
        pairs = zip(about.system.variables, about.at, strict=True)
        return {coordinate(v): x for v, x in pairs if x}

    @property
    def growth(self) -> float:
        """About the largest real part of an eigenvalue of the linearised rates, in 1/s."""
        return self.found.growth

    def __repr__(self) -> str:
        place = ", ".join(f"{x} = {v}" for x, v in self.at.items())
        return f"<{self.verdict}: {place or 'the origin'}>"


@dataclass(frozen=True)
class Near(Checked, Judged):
    """A relative equilibrium within a ``radius`` of decimals; ``record``: its derivation."""

    found: Enclosed
    record: Derivation

    @property
    def at(self) -> dict[str, float]:
        """The decimals, by the names of the coordinates."""
        about = self.found.about
        pairs = zip(about.system.variables, about.at, strict=True)
        return {coordinate(v): float(x) for v, x in pairs}

    @property
    def radius(self) -> float:
        """How far each coordinate of the equilibrium is at most from the decimals."""
        return float(self.found.radius)


@dataclass(frozen=True)
class Equilibria(Checked):
    """Relative equilibria: a sequence of :class:`Steady`; ``record``: their derivation."""

    found: tuple[Equilibrium, ...]
    record: Derivation

    def __len__(self) -> int:
        return len(self.found)

    def __getitem__(self, k: int) -> Steady:
        return Steady(self.found[k])

    def __iter__(self) -> Iterator[Steady]:
        return map(Steady, self.found)
