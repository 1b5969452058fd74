"""The steps of a record that tell equilibria: the rates about each, and its energy–Casimir form.

Families of equilibria in letters, and inequalities.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ...language.derivatives import power
from ...language.intervals import Interval
from ...language.tree import Tree, add, mul, neg, nodes
from ...language.univariate import (
    Number,
    Quadratic,
    polynomial_of,
    polynomial_tree,
    root,
    square_free,
)
from ...language.univariate import tree as plain
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ...walk.chapter import Chapter, Draft, say
from ..integrals.all_integrals import IntegralsFound
from ..integrals.integral_steps import rate
from ..integrals.lie_poisson import scaled
from .enclosed_points import Enclosed
from .energy_casimir import EnergyCasimirForm, combined
from .equilibrium_points import About, Expansion
from .positions import position
from .stability import Equilibrium
from .stability_in_letters import Case, Family, inequality

FROM = ("poisson", "casimirs", "first_integrals")
"""The steps of the record of the integrals that equilibria are found from."""


def _made_from(steps: Sequence[Step], c: Chapter) -> list[Step]:
    """Those of the steps of a record that equilibria are found from, that of the rates first."""
    by_label = {s.label: s for s in steps}
    return [by_label[x] for name in FROM if (x := c.label(name)) in by_label]


def told(
    whole: IntegralsFound,
    found: Sequence[Equilibrium],
    steps: Sequence[Step],
    c: Chapter,
    *,
    tried: bool,
) -> tuple[Step, ...]:
    """Two steps for each equilibrium, one where no multipliers are found; ``steps``: of the record
    of the integrals; ``tried``: were points tried, none being given?"""
    made_from = _made_from(steps, c)
    told_steps: list[Step] = []
    for k, x in enumerate(found, 1):
        rates = _rates(x, f"equilibrium_{k}", made_from[0], c, tried=tried and k == 1)
        told_steps.append(rates)
        if x.form:
            used = (*made_from, rates)
            told_steps.append(_form(whole, x, x.form, f"energy_casimir_{k}", used, c))
    return tuple(told_steps)


def told_enclosed(
    whole: IntegralsFound, x: Enclosed, steps: Sequence[Step], c: Chapter
) -> tuple[Step, ...]:
    """Two steps: the rates about the decimals, and the energy with multiples of the Casimirs."""
    made_from = _made_from(steps, c)
    draft, equations = _about_point("equilibrium_1", x.about, made_from[0], c)
    prose = position(x.about, draft, near=True)
    rates = draft.step(
        equations, prose + draft.claim("equilibrium.near", point=point_rows(x.about))
    )
    return rates, _enclosure(whole, x, (*made_from, rates), c)


def _about_point(
    label: str, about: About, reduced: Step, c: Chapter
) -> tuple[Draft, list[Equation]]:
    """A step in the making, and its rates in powers of the distance from a point."""
    draft = c.draft(label, "components", reduced)
    pairs = zip(about.system.variables, about.rates, strict=True)
    return draft, [Equation(rate(v), expanded(e, about)) for v, e in pairs]


def _with_multiples(about: About, by: Sequence[Number], kept: Iterable[Tree]) -> Tree:
    """The energy with multiples of what is kept."""
    pairs = zip(by, kept, strict=True)
    return add("h̃", *(scaled(about.tree(m), f) for m, f in pairs if m))


def _energy_with(about: About, by: Sequence[Number], kept: Sequence[Any]) -> Equation:
    """The same in powers of the distances; ``kept``: polynomials of the ring."""
    algebra = about.algebra
    expansions = [about.expansion(algebra.over_the_field(f)) for f in kept]
    energy = combined(about.expansion(algebra.hamiltonian), expansions, by)
    return Equation(_with_multiples(about, by, map(algebra.tree, kept)), expanded(energy, about))


def _enclosure(whole: IntegralsFound, x: Enclosed, made_from: Iterable[Step], c: Chapter) -> Step:
    """The Casimirs less their values on the level, and the energy with multiples of them."""
    draft = c.draft("enclosure_1", "enclosure", *made_from)
    algebra = whole.system.algebra
    kept = [*map(algebra.tree, whole.casimirs)]
    found = [x.about.expansion(algebra.over_the_field(f)) for f in whole.casimirs]
    equations = [
        Equation(add(f, neg(plain(level))), expanded(replace(e, value=e.value - level), x.about))
        for f, e, level in zip(kept, found, x.level, strict=True)
    ]
    equations.append(_energy_with(x.about, x.multipliers, whole.casimirs))
    positive, negative = x.signature
    prose = draft.claim("enclosure.within", radius=scientific(x.radius))
    prose += draft.claim("enclosure.signs", positive=positive, negative=negative)
    prose += draft.claim(f"enclosure.{x.verdict}")
    if x.verdict != "stable":
        prose += draft.claim("enclosure.eigenvalues", eigenvalues=_about(x.eigenvalues))
    return draft.step(equations, prose)


def decimal(x: Any, radius: Fraction) -> Any:
    """The decimals of an interval or a float, one more than a radius has, which is a power of ten;
    an exact number as it is."""
    if not isinstance(x, float | Interval):
        return x
    near = x.middle if isinstance(x, Interval) else Fraction(x)
    return round(near * 10 / radius) * radius / 10


def scientific(x: Fraction) -> Tree:
    """A number of one digit, at most 1, as that digit times a power of ten."""
    k = 0
    while x < 1:
        x, k = 10 * x, k + 1
    return mul(plain(x), ("pow", 10, -k))


def _rates(x: Equilibrium, label: str, reduced: Step, c: Chapter, *, tried: bool) -> Step:
    """The rates in powers of the distance from the equilibrium: none has a constant term."""
    draft, equations = _about_point(label, x.about, reduced, c)
    prose = say("equilibrium.tried") if tried else ()
    prose += _where("equilibrium", x.about, draft)
    if x.form:
        return draft.step(equations, prose)
    prose += draft.claim("equilibrium.none")
    if x.leaf.free:
        positive, negative = x.signature
        prose += draft.claim("equilibrium.orbit", positive=positive, negative=negative)
    return draft.step(equations, prose + _verdict(draft, x))


def _where(what: str, about: About, draft: Draft) -> Prose:
    """At which point an equilibrium, or a family of them, is."""
    if not any(about.at):
        return draft.claim(f"{what}.origin")
    return position(about, draft) + draft.claim(f"{what}.at", point=point_rows(about))


def point_rows(about: About) -> Tree:
    """The coordinates of a point that are not 0, each with its variable."""
    pairs = zip(about.system.variables, about.at, strict=True)
    return ("matrix", *(("row", v, about.tree(x)) for v, x in pairs if x))


def distances(about: About) -> list[Tree]:
    """The variables less their values at the point."""
    return [
        add(v, neg(about.tree(number)))
        for v, number in zip(about.system.variables, about.at, strict=True)
    ]


def linear(row: Sequence[Number], about: About) -> Tree:
    """A linear form in the distances."""
    pairs = zip(row, distances(about), strict=True)
    return add(*(scaled(about.tree(x), y) for x, y in pairs if x))


def expanded(e: Expansion, about: About) -> Tree:
    """A polynomial in powers of the distances."""
    away, shown = distances(about), about.tree
    n = len(away)
    pairs = [(i, j) for i in range(n) for j in range(i, n) if e.second[i][j]]
    squares = [
        scaled(shown(e.second[i][j] / 2), power(away[i], 2))
        if i == j
        else scaled(shown(e.second[i][j]), away[i], away[j])
        for i, j in pairs
    ]
    terms = (shown(e.value), linear(e.slope, about), *squares, *higher(e, about))
    return add(*terms)


def higher(e: Expansion, about: About) -> list[Tree]:
    """The terms above the second order."""
    away = distances(about)
    return [
        scaled(about.tree(c), *(power(y, k) for y, k in zip(away, m, strict=True) if k))
        for m, c in e.higher.items()
    ]


def _form(
    whole: IntegralsFound,
    x: Equilibrium,
    form: EnergyCasimirForm,
    label: str,
    made_from: Iterable[Step],
    c: Chapter,
) -> Step:
    """The energy with multiples of what is kept: a constant, squares, and what vanishes on the
    leaf."""
    draft = c.draft(label, "expansion", *made_from)
    kept = map(whole.system.algebra.tree, (*whole.casimirs, *whole.integrals))
    left = _with_multiples(x.about, form.multipliers, kept)
    pairs = zip(x.leaf.equations, form.mixed, strict=True)
    right = [
        plain(form.expansion.value),
        *(mul(plain(d), power(linear(row, x.about), 2)) for d, row in form.squares),
        *(_product(n, m, x.about) for n, m in pairs if any(m)),  # 0 on the tangent space
        *higher(form.expansion, x.about),
    ]
    positive, negative = form.signature
    prose = draft.claim("equilibrium.form", positive=positive, negative=negative)
    return draft.step([Equation(left, add(*right))], prose + _verdict(draft, x))


def _product(n: Sequence[Number], m: Sequence[Number], about: About) -> Tree:
    """The product of two linear forms, a square where they are proportional."""
    first = next(i for i, x in enumerate(n) if x)
    factor = m[first] / n[first]
    if all(y == factor * x for x, y in zip(n, m, strict=True)):
        return mul(plain(factor), power(linear(n, about), 2))
    return mul(linear(n, about), linear(m, about))


def _verdict(draft: Draft, x: Equilibrium) -> Prose:
    """What is proved of its stability."""
    kind, say_so = x.sentence, draft.claim
    if kind == "unstable_beyond":
        polynomial = polynomial_tree(x.characteristic_of_all, "λ")
        return say_so("equilibrium.unstable_beyond", polynomial=polynomial)
    if kind not in ("unstable", "open"):
        return say_so(f"equilibrium.{kind}")
    prose = say_so("equilibrium.indefinite")
    prose += say_so(f"equilibrium.{kind}", polynomial=polynomial_tree(x.characteristic, "λ"))
    prose += say_so("equilibrium.eigenvalues", eigenvalues=nearly(x.characteristic))
    squares = exact_squares(x.characteristic)
    return prose + (say_so("equilibrium.squares", squares=("row", *squares)) if squares else ())


def _about(values: Iterable[complex]) -> Tree:
    """Numbers that come with their opposites and conjugates, as decimals of four digits, each
    once."""
    return _listed(_rounded([(abs(round(x.real, 9)), abs(round(x.imag, 9))) for x in values], 4))


def _rounded(pairs: Iterable[Iterable[float]], digits: int) -> set[tuple[Fraction, ...]]:
    """Pairs of numbers as decimals of so many digits, each once."""
    return {tuple(Fraction(f"{y:.{digits}g}") for y in pair) for pair in pairs}


def _listed(pairs: Iterable[tuple[Fraction, ...]]) -> Tree:
    return ("matrix", *(("row", *map(plain, row)) for row in sorted(pairs, reverse=True)))


def nearly(characteristic: Sequence[Number]) -> Tree:
    """The eigenvalues as decimals that differ, each once but for its opposite and conjugate: roots
    of q(λ²), q without multiple roots."""
    from mpmath import polyroots, sqrt, workdps

    q = [*map(float, square_free(tuple(characteristic[::-2]))[::-1])]
    with workdps(30):
        found = [sqrt(x) for x in polyroots(q, maxsteps=200, extraprec=100)]
    pairs = [
        [0.0 if abs(y) < NOTHING * abs(x) else abs(float(y)) for y in (x.real, x.imag)]
        for x in found
    ]
    several = [_rounded(pairs, digits) for digits in range(4, 11)]
    return _listed(next(x for x in several if len(x) == len(several[-1])))


NOTHING = 1e-9
"""A part of a root that is so much smaller than the root is 0."""


def exact_squares(characteristic: Sequence[Number]) -> list[Tree]:
    """The squares of the eigenvalues, where these are of q(λ²), q of degree at most 2 but for
    powers of λ², and exact by square roots; else nothing."""
    q = [*characteristic[::2]]
    zeros: list[Tree] = []
    while len(q) > 1 and q[-1] == 0:
        q, zeros = q[:-1], [0]
    if len(q) == 2:
        return [plain(-q[1]), *zeros]
    if len(q) != 3 or any(isinstance(x, Quadratic) for x in q):
        return []
    b, c = Fraction(q[1]), Fraction(q[2])  # type: ignore[arg-type]
    disc = b * b / 4 - c
    if disc >= 0:
        return [*dict.fromkeys(plain(s * root(disc) - b / 2) for s in (1, -1)), *zeros]
    part = mul(plain(root(-disc)), "i")
    return [add(plain(-b / 2), part), add(plain(-b / 2), neg(part)), *zeros]


LONG = 400
"""Inequalities and polynomials of more nodes are not printed."""


def told_families(
    whole: IntegralsFound, found: Iterable[Family], steps: Sequence[Step], c: Chapter
) -> tuple[Step, ...]:
    """A step for each family, and another for its form."""
    made_from = _made_from(steps, c)
    return tuple(s for k, x in enumerate(found, 1) for s in _told(whole, x, k, made_from, c))


def _told(
    whole: IntegralsFound, x: Family, k: int, made_from: Sequence[Step], c: Chapter
) -> Iterator[Step]:
    """The rates about a family, and the energy with multiples of what is kept."""
    about = x.about
    draft, equations = _about_point(f"equilibrium_{k}", about, made_from[0], c)
    say_so = draft.claim
    prose = say("family.tried") if k == 1 else ()
    prose += _where("family", about, draft)
    for y in about.at[: about.system.momenta]:
        prose += say_so("family.letter", letter=about.tree(y)) if y else ()
    if x.multipliers is None:
        prose += say_so("family.orbit")
        yield draft.step(equations, prose + _family_verdict(draft, x))
        return
    rates = draft.step(equations, prose)
    yield rates
    draft = c.draft(f"energy_casimir_{k}", "expansion", *made_from, rates)
    equation = _energy_with(about, x.multipliers, (*whole.casimirs, *whole.integrals))
    yield draft.step([equation], draft.claim("family.form") + _family_verdict(draft, x))


def _family_verdict(draft: Draft, x: Family) -> Prose:
    """Under which inequalities it is stable, and under which it is not."""
    say_so = draft.claim
    supposed = _inequalities(x, x.apart, x.known)
    prose = say_so("family.positive", positive=supposed) if supposed != ("matrix",) else ()
    cases = _cases(x, x.stable)
    if _long(cases):
        return prose + say("family.minors_large")
    kind = "stable" if x.beyond else "stable_beyond" if x.whole else "on_the_leaf"
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
