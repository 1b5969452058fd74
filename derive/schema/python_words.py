"""The words of Python: each says a table of a problem file."""

from __future__ import annotations

from . import kind
from .body_kinds import Moments, Point, Solid
from .force_kinds import INPUTS, Damping, Flow, StatedCovector, StatedForce
from .motion_kinds import Event, ExpressionOutput, Signal
from .potential_kinds import kinds
from .table import Table


def words() -> dict[str, type[Table]]:
    """Every table that has a word, by it."""
    listed = (
        *kinds().values(),
        *kind.SECTIONS.values(),
        *INPUTS.values(),
        kind.StatedAlgebra,
        kind.StatedAdvected,
        kind.StatedTorus,
        kind.TorusInertia,
        Damping,
        Flow,
        StatedForce,
        StatedCovector,
        ExpressionOutput,
        Event,
        Signal,
        kind.Fluid,
        kind.Kinematics,
        Point,
        Moments,
        Solid,
    )
    return {x.called or x.__name__: x for x in listed}
