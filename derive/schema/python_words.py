"""The words of Python: each says a table of a problem file."""

from __future__ import annotations

from .body_kinds import Moments, Point, Solid
from .force_kinds import INPUTS, Damping, Flow, StatedCovector, StatedForce
from .kind import (
    SECTIONS,
    Fluid,
    Kinematics,
    StatedAdvected,
    StatedAlgebra,
    StatedTorus,
    TorusInertia,
)
from .motion_kinds import Event, ExpressionOutput, Signal
from .potential_kinds import kinds
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
        Flow,
        StatedForce,
        StatedCovector,
        ExpressionOutput,
        Event,
        Signal,
        Fluid,
        Kinematics,
        Point,
        Moments,
        Solid,
    )
    return {x.called or x.__name__: x for x in listed}
