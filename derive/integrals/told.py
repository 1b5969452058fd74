"""The steps of a record that say what integrals there are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from ..language.tree import Tree, mul, plain
from ..record.record import Equation, Step
from ..record.sentence import MONOMIALS, Prose
from ..walk.chapter import Chapter, Draft
from ..walk.wording import say
from .all_integrals import Found, OnLevel
from .degree_search import how_many
from .independence import Integrability
from .level import Level
from .told_conditions import all_conditions, told_conditions


def told(
    whole: Found, steps: Sequence[Step], c: Chapter, *, driven: bool = False
) -> tuple[Step, ...]:
    """The reduced equations, the Casimirs, the integrals, and those on levels, as steps of a
    chapter; ``steps``: of the walk of the problem, which may be ``driven`` by inputs."""
    by_label = {s.label: s for s in steps}
    made_from = [by_label[c.label(x)] for x in ("momenta", "energy", "coadjoint", "motion")]
    reduced = _reduced(whole, made_from, c, driven=driven)
    found = [reduced]
    if whole.casimirs:
        found.append(_casimirs(whole, reduced, c))
    found.append(_integrals(whole, reduced, c))
    found += [_on_level(whole, on, reduced, k, c) for k, on in enumerate(whole.levels)]
    if whole.conditions:
        found += told_conditions(whole, whole.conditions, reduced, c)
    return tuple(found)


def _reduced(whole: Found, made_from: Iterable[Step], c: Chapter, *, driven: bool) -> Step:
    """h̃ and the rates, as functions of the variables."""
    algebra, system = whole.system.algebra, whole.system
    draft = c.draft("poisson", "reduction")
    draft.depends_on(*made_from)
    equations = [Equation("h̃", algebra.field_tree(algebra.hamiltonian))]
    for i, x in enumerate(system.variables):
        equations.append(Equation(rate(x), algebra.field_tree(algebra.flow.get(i, {}))))
    only = len(system.variables) == system.momenta
    kind = "poisson.group" if only else "poisson.advected"
    prose = draft.claim(kind, dimension=len(system.variables)) + _weights(whole, draft)
    return draft.step(equations, prose + (say("poisson.undriven") if driven else ()))


def _weights(whole: Found, draft: Draft) -> Prose:
    """How degrees count, where not all variables are of degree 1."""
    momenta, weights = whole.system.momenta, whole.grading.degree
    entries = {*weights[momenta:]}
    if entries <= {1}:
        return ()
    if len(entries) == 1:
        return draft.claim("poisson.weighted", weight=plain(entries.pop()))
    return draft.claim("poisson.weights", weights=("row", *map(plain, weights[momenta:])))


def rate(x: Tree) -> Tree:
    """The rate of a variable, Π̇_a, or an entry of Ȧ or Γ̇."""
    assert isinstance(x, tuple)
    return (x[0], {"Π": "Π̇", "A": "Ȧ", "Γ": "Γ̇"}[x[1]], *x[2:])


def _kept(trees: Iterable[Tree]) -> list[Equation]:
    """The equations that say that motions keep these polynomials."""
    return [Equation(("call", "d/dt", t), 0) for t in trees]


def _casimirs(whole: Found, reduced: Step, c: Chapter) -> Step:
    draft = c.draft("casimirs", "Poisson bracket")
    draft.depends_on(reduced)
    prose = draft.claim("casimirs.kept")
    prose += draft.claim(f"casimirs.all{_large(whole)}", degree=whole.degree)
    return draft.step(_kept(map(whole.system.algebra.tree, whole.casimirs)), prose)


def _large(whole: Found) -> str:
    """How the key of a sentence ends that is not computed again for its size."""
    weights = whole.grading.degree
    return "_large" if how_many(weights, Fraction(whole.degree), exactly=False) > MONOMIALS else ""


def _integrals(whole: Found, reduced: Step, c: Chapter) -> Step:
    algebra = whole.system.algebra
    draft = c.draft("first_integrals", "Poisson bracket")
    draft.depends_on(reduced)
    trees = [algebra.field_tree(algebra.hamiltonian), *map(algebra.tree, whole.integrals)]
    prose = _said(whole, draft)
    prose += all_conditions(whole, whole.conditions, draft) if whole.conditions else ()
    return draft.step(_kept(trees), prose)


def _said(whole: Found, draft: Draft) -> Prose:
    """What is proved of the integrals."""
    several = bool(whole.integrals)
    prose = say("first_integrals.several" if several else "first_integrals.energy")
    for k, new in enumerate(whole.fresh, 2):
        prose += () if new else draft.claim("first_integrals.dependent", number=k)
    generic = "_generic" if whole.system.parameters else ""
    (these,) = draft.claim(THESE[several, bool(whole.casimirs)])
    key = f"first_integrals.all{generic}{_large(whole)}"
    prose += draft.claim(key, degree=whole.degree, these=these)
    return prose + _integrability(whole.proved, draft)


THESE = {
    (False, False): "first_integrals.it",
    (False, True): "first_integrals.it_and_casimirs",
    (True, False): "first_integrals.these",
    (True, True): "first_integrals.these_and_casimirs",
}
"""What is called so, by whether there are several integrals, and Casimirs."""


def _integrability(proved: Integrability, draft: Draft) -> Prose:
    rank, dimension, half = proved.rank, proved.dimension, proved.rank // 2
    if proved.complete and rank == 2 and proved.involution == (0,):
        return draft.claim("first_integrals.complete_by_energy", dimension=dimension)
    if proved.complete and rank == 2:
        number = proved.involution[0] + 1
        return draft.claim("first_integrals.complete_by_one", dimension=dimension, number=number)
    if rank == 0:
        return draft.claim("first_integrals.still")
    if not proved.proved:
        return draft.claim("first_integrals.unknown_rank")
    if not proved.complete:
        return draft.claim("first_integrals.undecided", rank=rank, dimension=dimension, half=half)
    numbers = ("row", *(k + 1 for k in proved.involution))
    return draft.claim(
        "first_integrals.complete", rank=rank, dimension=dimension, half=half, numbers=numbers
    )


# -- on a level ---------------------------------------------------------------------------------


def _on_level(whole: Found, on: OnLevel, reduced: Step, k: int, c: Chapter) -> Step:
    """The integrals where a Casimir vanishes: their rates are multiples of it."""
    algebra = whole.system.algebra
    draft = c.draft("level" if not k else f"level_{k + 1}", "Poisson bracket")
    draft.depends_on(reduced)
    casimir = whole.casimirs[on.casimir]
    level = Level(algebra, casimir)
    equations = []
    for f in on.integrals:
        factor = level.quotient(algebra.derivative(algebra.over_the_field(f)))
        right = mul(algebra.field_tree(factor), algebra.tree(casimir))
        equations.append(Equation(("call", "d/dt", algebra.tree(f)), right))
    prose = draft.claim("level.multiple", number=on.casimir + 1)
    if on.proved.complete:
        rank = on.proved.rank
        prose += draft.claim("level.complete", rank=rank, half=rank // 2)
    return draft.step(equations, prose)
