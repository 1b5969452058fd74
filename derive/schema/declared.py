"""What a problem declares before its body: its parameters, and a group of its own."""

from .table import Action, Basis, Default, Letters, Table, Text


class Parameter(Table):
    """A free name, with what a reader of the emitted code wants to know."""

    default: Default = None
    unit: Text = ""
    meaning: Text = ""


class StatedGroup(Table):
    """A group by a ``basis`` of its Lie algebra, matrices over Q; those of an affine one have a
    last row of zeros."""

    name: Letters
    action: Action = "linear"
    basis: Basis
