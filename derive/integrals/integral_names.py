"""The names of Casimirs and first integrals in emitted code, and their expressions."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from ..language.refused import Refused
from ..language.telling import tell
from ..language.tree import Tree, nodes
from ..problem.problem import Problem
from .all_integrals import Found, casimirs, found
from .degree_search import TooLargeError, unknowns
from .lie_poisson import LiePoisson
from .reduced import NotReducedError, reduced, without_energy
from .weights import grading

DEGREE, UNKNOWNS = 4, 800
"""Up to which degree integrals are looked for, and in how many unknowns at once: more would keep
code waiting for minutes."""


def first_integrals(problem: Problem, *, beside_symmetries: bool = False) -> dict[str, Tree]:
    """Name → the polynomial in Π_a and the entries of Γ or of g: the energy, the Casimirs and the
    integrals; the first two alone where the equations are not such as can be searched.

    ``beside_symmetries``: only those that no symmetry gives, neither linear in the momenta nor
    Casimirs; none where the reduced equations are not such as can be searched.
    """
    try:
        system = reduced(problem)
        whole = found(system, _sought(system, problem.name))
    except (NotReducedError, TooLargeError) as error:
        return {} if beside_symmetries else _whatever_the_energy(problem, error)
    algebra = whole.system.algebra
    if beside_symmetries:
        own = [f for f in whole.integrals if nonlinear(f, whole)]
        return _numbered("integral", map(algebra.tree, own))
    return (
        {"energy": "h̃"}
        | _numbered("casimir", map(algebra.tree, whole.casimirs))
        | _numbered("integral", map(algebra.tree, whole.integrals))
    )


def _whatever_the_energy(problem: Problem, error: Refused) -> dict[str, Tree]:
    """The energy, where ℓ has no t, and the Casimirs; ``Refused`` for none of them, by what is
    in the way of a search."""
    timed = problem.lagrangian is None or "t" in nodes(problem.lagrangian.L)
    kept: dict[str, Tree] = {} if timed else {"energy": "h̃"}
    try:
        system = without_energy(problem)
        degree = _sought(system, problem.name)
        kept |= _numbered("casimir", map(system.algebra.tree, casimirs(system, degree)))
    except (NotReducedError, TooLargeError):
        pass  # too many variables
    if kept:
        return kept
    raise NotReducedError(f"{error}, and no Casimir of degree 4 or less: leave out --conserved")


def _sought(system: LiePoisson, name: str) -> int:
    """The degree up to which there are no more unknowns than may be; that it is lower is told."""
    by, degree = grading(system), DEGREE
    while degree > 1 and (count := unknowns(by, Fraction(degree))) > UNKNOWNS:
        degree -= 1
        tell(
            f"{name}: integrals of degree {degree + 1} are not sought, {count} unknowns in one "
            "linear system; derive integrals seeks them"
        )
    return degree


def _numbered(base: str, trees: Iterable[Tree]) -> dict[str, Tree]:
    """base_1, base_2, …, and the trees in order."""
    return {f"{base}_{k}": t for k, t in enumerate(trees, 1)}


def nonlinear(f: Any, whole: Found) -> bool:
    """Is a polynomial of degree 2 or more in the momenta?"""
    momenta = whole.system.momenta
    return any(sum(m[:momenta]) > 1 for m in f)
