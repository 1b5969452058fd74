"""A fluid whose displacements keep the volume: a problem without matrices."""

from typing import Annotated

from .table import Key, Table

Density = Annotated[str, Key("density")]
"""One of DENSITIES."""

DENSITIES = ("homogeneous", "advected")
"""Everywhere the same; or another at each place of the fluid, which carries it along."""
GROUP = "SDiff"
"""The displacements that keep the volume."""


class Fluid(Table):
    """An incompressible fluid without forces, in the flat space of any dimension, or a domain of
    it; with its ``density``."""

    section = "fluid"
    density: Density = "homogeneous"
