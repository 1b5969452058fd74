"""The torus of a record's problem, and its group."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import Source
from ...algebra.torus import Torus
from ...language.rational import Matrix
from ..arithmetic import EvaluationError


def torus_of(problem: Mapping[str, Any]) -> Torus:
    """The torus of a record's problem."""
    return Torus(problem["torus"]["N"])


def group_of_torus(torus: Torus) -> Group:
    """SU(N) by its name and size, without a table of a basis, or elements."""

    def none(random: Source, size: int) -> Matrix:
        raise EvaluationError(f"no elements of {torus.name} are drawn")

    return Group(torus.name, torus.N, "linear", (), none)
