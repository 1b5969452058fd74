"""The steps of a record that say what integrals there are, and under which conditions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

from ...language.limits import Refused, tell
from ...language.tree import Tree, add, mul, neg, nodes, plain
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import MONOMIALS, Prose
from ...walk.chapter import Chapter, Draft, say
from .all_integrals import (
    Condition,
    Integrability,
    IntegralsFound,
    OnLevel,
    ParameterConditions,
    casimirs,
    found,
)
from .degree_search import TooLargeError, how_many, unknowns
from .lie_poisson import Level, LiePoisson, PoissonPolynomials
from .parameter_cases import Stratum, grading
from .reduced import NotReducedError, reduced, without_energy

# The steps of a record that say what integrals there are.


def told(
    result: IntegralsFound, steps: Sequence[Step], c: Chapter, *, driven: bool = False
) -> tuple[Step, ...]:
    """The reduced equations, the Casimirs, the integrals, and those on levels, as steps of a
    chapter; ``steps``: of the walk of the problem, which may be ``driven`` by inputs."""
    by_label = {s.label: s for s in steps}
    made_from = [by_label[c.label(x)] for x in ("momenta", "energy", "coadjoint", "motion")]
    reduced = _reduced(result, made_from, c, driven=driven)
    found = [reduced]
    if result.casimirs:
        found.append(_casimirs(result, reduced, c))
    found.append(_integrals(result, reduced, c))
    found += [_on_level(result, on, reduced, k, c) for k, on in enumerate(result.levels)]
    if under := result.conditions:
        for k, x in enumerate(under.conditions, 1):
            found.append(_under(result, under, x, reduced, f"condition_{k}", c))
    return tuple(found)


def _reduced(
    result: IntegralsFound, made_from: Iterable[Step], c: Chapter, *, driven: bool
) -> Step:
    """h̃ and the rates, as functions of the variables."""
    algebra, system = result.system.algebra, result.system
    draft = c.draft("poisson", "reduction", *made_from)
    equations = [Equation("h̃", algebra.field_tree(algebra.hamiltonian))]
    for i, x in enumerate(system.variables):
        equations.append(Equation(rate(x), algebra.field_tree(algebra.flow.get(i, {}))))
    only = len(system.variables) == system.momenta
    kind = "poisson.group" if only else "poisson.advected"
    prose = draft.claim(kind, dimension=len(system.variables)) + _weights(result, draft)
    own = any(isinstance(x, tuple) and x[1] == "A" for x in system.variables)
    if own and any(x.linear_basis and x.relations for _, x in system.group.places):
        prose += say("poisson.independent")
    return draft.step(equations, prose + (say("poisson.undriven") if driven else ()))


def _weights(result: IntegralsFound, draft: Draft) -> Prose:
    """How degrees count, where not all variables are of degree 1."""
    momenta, weights = result.system.momenta, result.grading.degree
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


def _conserved(trees: Iterable[Tree]) -> list[Equation]:
    """The equations that say that motions keep these polynomials."""
    return [Equation(("call", "d/dt", t), 0) for t in trees]


def _casimirs(result: IntegralsFound, reduced: Step, c: Chapter) -> Step:
    draft = c.draft("casimirs", "Poisson bracket", reduced)
    prose = draft.claim("casimirs.kept")
    prose += draft.claim(f"casimirs.all{_large(result)}", degree=result.degree)
    return draft.step(_conserved(map(result.system.algebra.tree, result.casimirs)), prose)


def _large(result: IntegralsFound) -> str:
    """How the key of a sentence ends that is not computed again for its size."""
    weights = result.grading.degree
    return "_large" if how_many(weights, Fraction(result.degree), exactly=False) > MONOMIALS else ""


def _integrals(result: IntegralsFound, reduced: Step, c: Chapter) -> Step:
    algebra = result.system.algebra
    draft = c.draft("first_integrals", "Poisson bracket", reduced)
    trees = [algebra.field_tree(algebra.hamiltonian), *map(algebra.tree, result.integrals)]
    prose = _said(result, draft)
    prose += all_conditions(result, result.conditions, draft) if result.conditions else ()
    return draft.step(_conserved(trees), prose)


def _said(result: IntegralsFound, draft: Draft) -> Prose:
    """What is proved of the integrals."""
    several = bool(result.integrals)
    prose = say("first_integrals.several" if several else "first_integrals.energy")
    for k, new in enumerate(result.fresh, 2):
        prose += () if new else draft.claim("first_integrals.dependent", number=k)
    generic = "_generic" if result.system.parameters else ""
    (these,) = draft.claim(THESE[several, bool(result.casimirs)])
    key = f"first_integrals.all{generic}{_large(result)}"
    prose += draft.claim(key, degree=result.degree, these=these)
    return prose + _integrability(result.proved, draft)


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


def _on_level(result: IntegralsFound, on: OnLevel, reduced: Step, k: int, c: Chapter) -> Step:
    """The integrals where a Casimir vanishes: their rates are multiples of it."""
    algebra = result.system.algebra
    draft = c.draft("level" if not k else f"level_{k + 1}", "Poisson bracket", reduced)
    casimir = result.casimirs[on.casimir]
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


# The steps of a record that say under which conditions on the parameters there is more.
#
# d/dt F is a sum of multiples of p − s for the letters p that are solved, s being their values:
# it vanishes in the case p = s.


def _under(
    result: IntegralsFound,
    found: ParameterConditions,
    x: Condition,
    reduced: Step,
    label: str,
    c: Chapter,
) -> Step:
    draft = c.draft(label, "Poisson bracket", reduced)
    equations = [
        Equation(("call", "d/dt", x.system.algebra.tree(f)), _rate(result, found, x, f))
        for f in x.integrals
    ]
    several = "condition.several" if len(x.integrals) > 1 else "condition.one"
    prose = draft.claim(several, condition=case_tree(result.system.algebra, x.case))
    if x.proved.complete:
        rank = x.proved.rank
        prose += draft.claim("condition.complete", rank=rank, half=rank // 2)
    return draft.step(equations, prose)


def _rate(result: IntegralsFound, found: ParameterConditions, x: Condition, f: Any) -> Tree:
    """The rate for all parameters, as a sum of multiples of what vanishes in the case."""
    algebra, special = result.system.algebra, x.system.algebra
    terms = {
        e: algebra.number(special.number_tree(c)) for e, c in special.over_the_field(f).items()
    }
    left, summed = algebra.derivative(terms), []
    for j, value in x.case.solved:
        there = found.cases.polynomial_at(Stratum(((j, value),)), left)
        zero = algebra.field.gens[j] - value
        quotient = {
            e: (left.get(e, algebra.field.zero) - there.get(e, algebra.field.zero)) / zero
            for e in left
        }
        quotient = {e: y for e, y in quotient.items() if y}
        letter, number = solved_letter(algebra, j, value)
        summed.append(mul(add(letter, neg(number)), algebra.field_tree(quotient)))
        left = there
    assert not left
    return add(*summed)


def solved_letter(algebra: PoissonPolynomials, j: int, value: Any) -> tuple[Tree, Tree]:
    """A letter and its value, as trees."""
    name = algebra.system.parameters[j]
    return name if name == "π" else ("par", name), algebra.number_tree(value)


def case_tree(algebra: PoissonPolynomials, case: Stratum, *others: Any) -> Tree:
    """The equations of a case: letters, each with its value; and others ``beside``, that vanish."""
    rows = [solved_letter(algebra, j, value) for j, value in case.solved]
    rows += [(algebra.number_tree(algebra.field(f)), 0) for f in others]
    return ("matrix", *(("row", *x) for x in rows))


def all_conditions(result: IntegralsFound, found: ParameterConditions, draft: Draft) -> Prose:
    """What is said of all conditions together."""
    algebra, degree = result.system.algebra, result.degree
    cases = [case_tree(algebra, x.case) for x in found.conditions]
    if cases:
        prose = draft.claim("first_integrals.further", degree=degree, conditions=("row", *cases))
    else:
        prose = draft.claim("first_integrals.no_further", degree=degree)
    if not found.unsolved:
        return prose
    unsolved = (case_tree(algebra, case, f) for case, f in found.unsolved)
    return prose + draft.claim("first_integrals.unsolved", conditions=("row", *unsolved))


# The names of Casimirs and first integrals in emitted code, and their expressions.

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
        result = found(system, _sought(system, problem.name))
    except (NotReducedError, TooLargeError) as error:
        return {} if beside_symmetries else _whatever_the_energy(problem, error)
    algebra = result.system.algebra
    if beside_symmetries:
        others = [f for f in result.integrals if nonlinear(f, result)]
        return _numbered("integral", map(algebra.tree, others))
    return (
        {"energy": "h̃"}
        | _numbered("casimir", map(algebra.tree, result.casimirs))
        | _numbered("integral", map(algebra.tree, result.integrals))
    )


def _whatever_the_energy(problem: Problem, error: Refused) -> dict[str, Tree]:
    """The energy, where ℓ has no t, and the Casimirs; ``Refused`` for none of them, by what is
    in the way of a search."""
    timed = problem.lagrangian is None or "t" in nodes(problem.lagrangian.L)
    quantities: dict[str, Tree] = {} if timed else {"energy": "h̃"}
    try:
        system = without_energy(problem)
        degree = _sought(system, problem.name)
        quantities |= _numbered("casimir", map(system.algebra.tree, casimirs(system, degree)))
    except (NotReducedError, TooLargeError):
        pass  # too many variables
    if quantities:
        return quantities
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


def nonlinear(f: Any, result: IntegralsFound) -> bool:
    """Is a polynomial of degree 2 or more in the momenta?"""
    momenta = result.system.momenta
    return any(sum(m[:momenta]) > 1 for m in f)
