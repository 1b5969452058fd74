"""The reduced equations of a problem: Lie–Poisson in the momenta Π_a and the entries of g."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, NoReturn

from ...algebra.groups import Group, constant_entries
from ...language.limits import Refused
from ...language.reserved import advected_entries, suffixed
from ...language.tree import Tree, nodes, replaced
from ...language.values import arithmetic
from ...problem.entries_on_orbit import with_constant_entries
from ...problem.problem import Problem
from .lie_poisson import ONE, Exponents, LiePoisson, in_letters, plain

VARIABLES = 40
"""The most variables of a reduced system that is searched."""


FACTORS = 24
"""A block of the metric with more letters in the terms of its entries is not inverted in letters:
for a general body of SE(3), with 27, the inverse has thousands of terms."""


class NotReducedError(Refused, ValueError):
    """A problem whose reduced equations are not Lie–Poisson with a polynomial H: the message says
    why."""


def require_group(problem: Problem) -> None:
    """``NotReducedError`` for a text about any group, for a fluid and for kinematics."""
    if problem.group is None or problem.kinematics:
        raise NotReducedError(problem.unsearched)


def with_defaults(problem: Problem) -> Problem:
    """The problem with numbers for the parameters that have a default."""
    given = problem.lagrangian
    if given is None:
        return problem
    numbers = {x: y.default for x, y in problem.parameters.items() if y.default is not None}
    L = given.L
    for name, number in numbers.items():
        q = Fraction(str(number))
        L = replaced(L, ("par", name), plain(q))
    kept = {x: y for x, y in problem.parameters.items() if x not in numbers}
    return replace(problem, parameters=kept, lagrangian=replace(given, L=L))


def reduced(problem: Problem) -> LiePoisson:
    """The reduced equations of a problem whose Lagrangian is an expression, its parameters left
    open.

    ``NotReducedError`` where ℓ depends on the time, is not quadratic in ζ with a constant metric,
    is no polynomial in g, or has functions of parameters.
    """
    require_group(problem)
    group, given = problem.own_group, problem.own_lagrangian
    L = with_constant_entries(given.L, group)
    used = {*nodes(L)}
    declared = tuple(x for x in problem.parameters if ("par", x) in used)
    parameters = (*declared, "π") if "π" in used else declared
    symbolic = _Symbolic(problem.name, L, group, parameters)
    system, entries = _without_energy(problem)
    return replace(system, hamiltonian=symbolic.hamiltonian(entries), parameters=parameters)


def without_energy(problem: Problem) -> LiePoisson:
    """The brackets alone, of any Lagrangian whatever, with H = 0: they have its Casimirs."""
    return _without_energy(problem)[0]


def _without_energy(problem: Problem) -> tuple[LiePoisson, list[Place]]:
    """The brackets, and the entries of g among the variables."""
    group, given = problem.own_group, problem.own_lagrangian
    epsilon = 1 if given.trivialisation == "left" else -1
    carried = sum(x.size for x in problem.advected or ())
    brackets, entries = _brackets(
        group, epsilon, _entries(with_constant_entries(given.L, group)), carried
    )
    size = group.dimension + len(entries)
    if size > VARIABLES:
        raise NotReducedError(
            f"{problem.name}: {size} variables in the reduced equations; at most {VARIABLES}"
        )
    momenta = [("at", "Π", a) for a in range(1, group.dimension + 1)]
    letter = "A" if problem.advected is None else "Γ"
    variables = (*momenta, *(("entry", letter, *(i + 1 for i in x)) for x in entries))
    own = advected_entries({"advected": [*map(vars, problem.advected or ())]})
    on_algebra = zip(own, range(1, carried + 1), strict=True)
    named: dict[Tree, str] = {("entry", "Γ", i): name for name, i in on_algebra}
    names = tuple(named.get(x, coordinate(x)) for x in variables)
    return LiePoisson(variables, brackets, {}, (), group.dimension, names, group), entries


def coordinate(x: Tree) -> str:
    """The name of a variable at the command line: Pi_1, A_31, Gamma_2."""
    assert isinstance(x, tuple)
    return suffixed({"Π": "Pi", "Γ": "Gamma"}.get(x[1], str(x[1])), *x[2:])


def _entries(L: Tree) -> list[Place]:
    """The places of the entries of g, or of Γ, in ℓ."""
    kinds = ("entry", "A"), ("entry", "Γ")
    return sorted({_place(x) for x in nodes(L) if isinstance(x, tuple) and x[:2] in kinds})


# -- the brackets -------------------------------------------------------------------------------

Place = tuple[int, ...]
"""The row and the column of an entry of g, from 0; the row of one of Γ."""


def _brackets(
    group: Group, epsilon: int, used: list[Place], carried: int
) -> tuple[dict[tuple[int, int], dict[int, Fraction]], list[Place]]:
    """The brackets that are not 0, and the entries of g among the variables: those ``used``, and
    those into which these move; ``carried``: how many entries Γ has."""
    d, table = group.dimension, group.structure_constants

    def moved_by(place: Place, b: int) -> dict[Place | None, Fraction]:
        if len(place) == 1:
            # −ε(ρ(E_b)Γ)_i, ρ(E_b) the last block of E_b
            (i,), first = place, group.n - carried
            row = group.basis[b][first + i][first:]
            return {(j,): Fraction(-epsilon * c) for j, c in enumerate(row) if c}
        return _tangent_entry(group, epsilon, place, b)

    entries = sorted(used)
    for place in entries:
        moved = [x for b in range(d) for x in moved_by(place, b)]
        entries += [x for x in dict.fromkeys(moved) if x and x not in entries]
    entries = sorted(entries)
    index: dict[Place | None, int] = {None: ONE}
    index |= {place: d + k for k, place in enumerate(entries)}
    found = {}
    for a in range(d):
        for b in range(a + 1, d):
            found[a, b] = {k: Fraction(epsilon * c) for k, c in enumerate(table[b][a]) if c}
        for place in entries:
            moved_terms = moved_by(place, a).items()
            found[a, index[place]] = {index[x]: -c for x, c in moved_terms}
    return {ij: form for ij, form in found.items() if form}, entries


def _tangent_entry(
    group: Group, epsilon: int, place: Place, b: int
) -> dict[Place | None, Fraction]:
    """(gE_b)_ij or (E_bg)_ij: the entries of g in it, ``None`` for the number 1."""
    (i, j), e = place, group.basis[b]
    found: dict[Place | None, Fraction] = {}
    for k in range(group.size):
        c = e[k][j] if epsilon > 0 else e[i][k]
        if c and (x := entry(group, *((i, k) if epsilon > 0 else (k, j)))) != 0:
            key = x if isinstance(x, tuple) else None
            found[key] = found.get(key, Fraction(0)) + c
    return {x: c for x, c in found.items() if c}


def entry(group: Group, i: int, j: int) -> Place | int:
    """The entry of g at a place: itself, or the number, 1 or 0, that it is in all of the group."""
    return int(i == j) if (i, j) in constant_entries(group) else (i, j)


# -- the Hamiltonian ----------------------------------------------------------------------------


class _Symbolic:
    """ℓ as a polynomial in ζ and the entries of g over Q(parameters)."""

    def __init__(self, name: str, L: Tree, group: Group, parameters: tuple[str, ...]):
        from sympy import QQ

        self.name, self.L, self.group = name, L, group
        self.parameters = parameters
        names = [f"p{k}" for k, _ in enumerate(parameters)]
        self.field: Any = QQ.frac_field(*names) if names else QQ
        self.letters = dict(zip(parameters, self.field.gens if names else (), strict=True))
        if any(x == "t" for x in nodes(L)):
            self.refuse("depends on the time, so that H is no integral")

    def refuse(self, why: str) -> NoReturn:
        raise NotReducedError(f"{self.name}: the Lagrangian {why}")

    def hamiltonian(self, entries: list[Place]) -> dict[Exponents, Tree]:
        """½⟨Π − b, M⁻¹(Π − b)⟩ + U for ℓ = ½⟨ζ, Mζ⟩ + ⟨b, ζ⟩ − U, by the exponents of Π and of the
        entries of g."""
        from sympy import ring
        from sympy.polys.matrices import DomainMatrix

        d = self.group.dimension
        names = [*(f"z{a}" for a in range(d)), *(f"g{k}" for k, _ in enumerate(entries))]
        polynomials, *gens = ring(names, self.field)
        own: dict[Any, Any] = dict(zip(entries, gens[d:], strict=True))
        own |= {("ζ", a): x for a, x in enumerate(gens[:d], 1)}
        L = self.polynomial(self.L, own, polynomials)
        parts: list[Any] = [polynomials.zero] * 3
        for m, c in L.items():
            order = sum(m[:d])
            if order > 2:
                self.refuse("is not quadratic in the velocity: ∂²L/∂Z² depends on it")
            if order == 2 and any(m[d:]):
                self.refuse(
                    "has a metric ∂²L/∂Z² that depends on g: derive symmetries tells what it "
                    "keeps, derive trim whether a state is steady"
                )
            parts[order] += polynomials.from_dict({m: c})
        potential, linear, kinetic = parts
        zero = (0,) * len(names)
        slopes = [kinetic.diff(x) for x in gens[:d]]
        second = [[y.diff(x).get(zero, self.field.zero) for x in gens[:d]] for y in slopes]
        matrix = DomainMatrix(second, (d, d), self.field)
        self._require_short(second)
        if matrix.rank() < d:
            self.refuse("has a singular metric ∂²L/∂Z²")
        inverse = matrix.inv().to_list()
        shifted = [x - linear.diff(x) for x in gens[:d]]  # Π − b, with z for Π
        half = self.field.one / 2
        total = -potential
        for a in range(d):
            for b in range(d):
                if inverse[a][b]:
                    total += shifted[a] * shifted[b] * (inverse[a][b] * half)
        return {tuple(m): self.tree(c) for m, c in total.items()}

    def _require_short(self, metric: list[list[Any]]) -> None:
        """Refuse a metric whose inverse is too long in its letters."""
        for block in _blocks(metric) if self.parameters else ():
            entries = [metric[i][j] for i in block for j in block if metric[i][j]]
            factors = sum(sum(m) for x in entries for m in x.numer)
            if len(block) > 1 and factors > FACTORS:
                self.refuse(
                    "has a metric whose inverse is too long; it couples "
                    f"{len(block)} velocities by terms with {factors} letters in all: give "
                    "numbers, or --at-defaults"
                )

    def polynomial(self, t: Tree, own: Mapping[Any, Any], ring: Any) -> Any:
        """An expression in the ring of polynomials in ζ and the entries of g."""

        def at(t: Tree) -> Any:
            if isinstance(t, (int, Fraction)):
                q = Fraction(t)
                return ring(self.field.convert(q.numerator) / self.field.convert(q.denominator))
            if isinstance(t, str) or t[0] == "par":
                name = t if isinstance(t, str) else t[1]
                return ring(self.letters[name])
            if t[0] == "entry":
                return own[t[1:] if t[1] == "ζ" else _place(t)]
            if t[0] == "fun" and not any(x[0] == "entry" for x in nodes(t) if isinstance(x, tuple)):
                self.refuse(
                    f"has {t[1]} of π or parameters, and integrals are sought in fractions of "
                    "them; give the body by its moments, [body] given, with letters for such "
                    "numbers"
                )
            if t[0] == "fun":
                self.refuse(f"has a function, {t[1]}, of which no polynomial is one")
            if t[0] == "div":
                return at(t[1]) * self.reciprocal(at(t[2]))
            if t[0] == "pow":
                x = at(t[1])
                return x ** t[2] if t[2] >= 0 else self.reciprocal(x) ** -t[2]
            return arithmetic(t, at)

        return at(t)

    def reciprocal(self, x: Any) -> Any:
        """1/x of an element of the field."""
        if x == 0 or not x.is_ground:
            self.refuse("is no polynomial in the entries of g and in ζ")
        return x.ring(self.field.one / x.LC)

    def tree(self, c: Any) -> Tree:
        """An element of the field as a tree."""
        if not self.parameters:
            return plain(c)
        above, below = (in_letters(self.parameters, f) for f in (c.numer, c.denom))
        return above if below == 1 else ("div", above, below)


def _blocks(m: list[list[Any]]) -> list[set[int]]:
    """The indices of the blocks into which a symmetric matrix falls."""
    found: list[set[int]] = []
    for i, row in enumerate(m):
        own = {i, *(j for j, x in enumerate(row) if x)}
        touched = [b for b in found if b & own]
        found = [b for b in found if not b & own] + [own.union(*touched)]
    return found


def _place(t: tuple[Any, ...]) -> Place:
    """The place of an entry of g, or of Γ."""
    return tuple(i - 1 for i in t[2:])
