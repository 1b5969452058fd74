"""A fluid whose displacements keep the volume: a problem without matrices."""

from typing import Annotated

from .table import Key, Table

Density = Annotated[str, Key("density")]
"""One of DENSITIES."""

Forces = Annotated[str, Key("field_of_force")]
"""One of FORCES."""

DENSITIES = ("homogeneous", "advected")
"""Everywhere the same; or from place to place another, which the fluid carries along."""
FORCES = ("none", "potential")
"""None; or per unit mass, −grad V of any function V of the place."""
GROUP = "SDiff"
"""The displacements that keep the volume."""


class Fluid(Table):
    """An incompressible fluid in the flat space of any dimension, or a domain of it; with its
    ``density`` and the ``forces`` on it."""

    section = "fluid"
    density: Density = "homogeneous"
    forces: Forces = "none"
