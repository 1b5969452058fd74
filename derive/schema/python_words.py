"""The words of Python: each says a table of a problem file."""

from __future__ import annotations

from .algebra_kinds import StatedAdvected, StatedAlgebra, StatedTorus, TorusInertia
from .body_kinds import Moments, Point
from .fluid_kinds import Fluid
from .followed import Event
from .kinds import kinds
from .lagrangian_kinds import SECTIONS
from .outside import INPUTS, Damping
from .solid_kinds import Solid
from .table import Table


def words() -> dict[str, type[Table]]:
    """Every table that has a word, by it."""
    listed = (
        *kinds().values(),
        *SECTIONS.values(),
        *INPUTS.values(),
        StatedAlgebra,
        StatedAdvected,
        StatedTorus,
        TorusInertia,
        Damping,
        Event,
        Fluid,
        Point,
        Moments,
        Solid,
    )
    return {x.called or x.__name__: x for x in listed}
