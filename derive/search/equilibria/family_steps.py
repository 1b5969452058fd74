"""The steps of a record that tell families of equilibria in letters, and inequalities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...language.tree import Tree, add, nodes
from ...language.univariate import polynomial_of
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ...walk.chapter import Chapter, Draft, say
from ..integrals.all_integrals import IntegralsFound
from ..integrals.integral_steps import rate
from ..integrals.lie_poisson import scaled
from .energy_casimir import combined
from .equilibrium_steps import distances, expanded, point_rows
from .stability_in_letters import Case, Family, inequality

LONG = 400
"""Inequalities and polynomials of more nodes are not printed."""


def told_families(
    whole: IntegralsFound, found: Iterable[Family], steps: Sequence[Step], c: Chapter
) -> tuple[Step, ...]:
    """A step for each family, and another for its form."""
    by_label = {s.label: s for s in steps}
    made_from = [by_label[x] for n in FROM if (x := c.label(n)) in by_label]
    return tuple(s for k, x in enumerate(found, 1) for s in _told(whole, x, k, made_from, c))


FROM = ("poisson", "casimirs", "first_integrals")


def _told(
    whole: IntegralsFound, x: Family, k: int, made_from: Sequence[Step], c: Chapter
) -> Iterator[Step]:
    """The rates about a family, and the energy with multiples of what is kept."""
    draft = c.draft(f"equilibrium_{k}", "components")
    draft.depends_on(made_from[0])
    about, say_so = x.about, draft.claim
    away, variables = distances(about), about.system.variables
    equations = [
        Equation(rate(v), expanded(e, away, about.tree))
        for v, e in zip(variables, about.rates, strict=True)
    ]
    prose = say("family.tried") if k == 1 else ()
    prose += (
        say_so("family.at", point=point_rows(about)) if any(about.at) else say_so("family.origin")
    )
    for y in about.at[: about.system.momenta]:
        prose += say_so("family.letter", letter=about.tree(y)) if y else ()
    if x.multipliers is None:
        prose += say_so("family.orbit")
        yield draft.step(equations, prose + _verdict(draft, x))
        return
    rates = draft.step(equations, prose)
    yield rates
    draft = c.draft(f"energy_casimir_{k}", "expansion")
    draft.depends_on(*made_from, rates)
    algebra = whole.system.algebra
    conserved = (*whole.casimirs, *whole.integrals)
    energy = about.expansion(algebra.hamiltonian)
    kept = [about.expansion(algebra.over_the_field(f)) for f in conserved]
    form = combined(energy, kept, x.multipliers)
    pairs = zip(x.multipliers, map(algebra.tree, conserved), strict=True)
    left = add("h̃", *(scaled(about.tree(m), f) for m, f in pairs if m))
    equation = Equation(left, expanded(form, away, about.tree))
    yield draft.step([equation], draft.claim("family.form") + _verdict(draft, x))


def _verdict(draft: Draft, x: Family) -> Prose:
    """Under which inequalities it is stable, and under which it is not."""
    say_so = draft.claim
    supposed = _inequalities(x, x.apart, x.known)
    prose = say_so("family.positive", positive=supposed) if supposed != ("matrix",) else ()
    cases = _cases(x, x.stable)
    if _long(cases):
        return prose + say("family.minors_large")
    kind = "stable" if x.beyond else "on_the_leaf"
    always = () in (y.beyond(x.known) for y in x.stable)
    if always or not x.stable:
        prose += say_so(f"family.{kind}_always" if always else "family.indefinite")
    else:
        prose += say_so(f"family.{kind}", cases=cases)
    prose += _roots(draft, x)
    said = any(y.kind in ("family.unstable_always", "family.imaginary") for y in draft.claims)
    return prose if always or (said and not x.stable) else prose + say("family.open")


def _roots(draft: Draft, x: Family) -> Prose:
    """Under which inequalities the characteristic polynomial has roots that leave."""
    polynomial = polynomial_of([*map(x.about.tree, x.characteristic)], "λ")
    short = tuple(y for y in x.unstable if not _long(_cases(x, (y,))))
    complete = x.counted and len(short) == len(x.unstable)
    if _long(polynomial) or not (short or complete):
        return say("family.roots_large")
    if not short:
        return draft.claim("family.imaginary", polynomial=polynomial)
    if () in (y.beyond(x.known) for y in short):
        return draft.claim("family.unstable_always", polynomial=polynomial)
    kind = "family.unstable" if complete else "family.unstable_large"
    return draft.claim(kind, polynomial=polynomial, cases=_cases(x, short))


def _long(t: Tree) -> bool:
    return len(nodes(t)) > LONG


def _cases(x: Family, cases: Iterable[Case]) -> Tree:
    """Several cases, each a matrix of inequalities."""
    return ("row", *(_inequalities(x, x.known, y) for y in cases))


def _inequalities(x: Family, known: Case, case: Case) -> Tree:
    """The inequalities of a case beyond what is known, rows of a matrix: the greater side first."""
    return ("matrix", *(("row", *inequality(x.about.algebra, *y)) for y in case.beyond(known)))
