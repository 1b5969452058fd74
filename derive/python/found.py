"""What searches found, as Python holds it: integrals, equilibria, a reduction."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import sympy

from ..language.intervals import Interval
from ..language.reserved import suffixed
from ..language.show import show
from ..language.tree import Tree
from ..language.univariate import Number
from ..problem.problem import Problem
from ..record.record import Derivation
from ..search.equilibria.enclosed_points import Enclosed
from ..search.equilibria.stability import Equilibrium
from ..search.equilibria.stability_in_letters import Case, Family, inequality
from ..search.equilibria.trim import Trim
from ..search.integrals.all_integrals import Condition, IntegralsFound
from ..search.symmetries.routhian import Routhian
from .api import in_keywords
from .quoted import loaded
from .shown import Finding, SeveralFound, Shown, ShownEquation

# The relative equilibria of a problem as Python holds them, and their record.


@dataclass(frozen=True)
class Judged:
    """What is known of the stability of a relative equilibrium."""

    found: Equilibrium | Enclosed

    @property
    def verdict(self) -> str:
        """What is proved: "stable", "stable on the leaf", "unstable", or "open" for nothing."""
        return self.found.verdict

    @property
    def signature(self) -> tuple[int, int]:
        """How many squares of the energy–Casimir form on the leaf are positive and negative."""
        return self.found.signature

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About the eigenvalues of the linearised rates on the leaf, in 1/s."""
        return self.found.eigenvalues


@dataclass(frozen=True)
class Steady(Judged):
    """A relative equilibrium.  ``found``: all that is known of it."""

    found: Equilibrium

    @property
    def at(self) -> dict[str, Number]:
        """The coordinates that are not 0, by their names."""
        about = self.found.about
        pairs = zip(about.system.names, about.at, strict=True)
        return {v: x for v, x in pairs if x}

    @property
    def growth(self) -> float:
        """About the largest real part of an eigenvalue of the linearised rates, in 1/s."""
        return self.found.growth

    def __repr__(self) -> str:
        place = ", ".join(f"{x} = {v}" for x, v in self.at.items())
        return f"<{self.verdict}: {place or 'the origin'}>"


@dataclass(frozen=True)
class Near(Finding, Judged):
    """A relative equilibrium within a ``radius`` of decimals; ``record``: its derivation, which
    tells these."""

    _search = "equilibria"

    found: Enclosed
    record: Derivation

    @property
    def at(self) -> dict[str, float]:
        """The doubles nearest to its coordinates, by their names."""
        pairs = zip(self.found.about.system.names, self.found.nearest, strict=True)
        return dict(pairs)

    @property
    def radius(self) -> float:
        """How far each coordinate of the equilibrium is at most from the decimals that are told."""
        return float(self.found.radius)


@dataclass(frozen=True)
class Equilibria(SeveralFound[Steady]):
    """Relative equilibria: a sequence of :class:`Steady`; ``record``: their derivation."""

    _search, _each = "equilibria", Steady

    found: tuple[Equilibrium, ...]
    record: Derivation


@dataclass(frozen=True)
class InLetters:
    """A family of relative equilibria.  ``found``: all that is known of it."""

    found: Family

    @property
    def at(self) -> dict[str, str]:
        """The coordinates that are not 0, by their names."""
        about = self.found.about
        pairs = zip(about.system.names, about.at, strict=True)
        return {v: show(about.tree(x)) for v, x in pairs if x}

    @property
    def stable(self) -> tuple[tuple[str, ...], ...]:
        """The cases in which it is stable, each its inequalities."""
        return self._cases(self.found.stable)

    @property
    def unstable(self) -> tuple[tuple[str, ...], ...]:
        """Cases in which it is unstable, likewise."""
        return self._cases(self.found.unstable)

    @property
    def supposed(self) -> tuple[str, ...]:
        """What is supposed: that the kinetic energy is positive."""
        return self._inequalities(self.found.apart, self.found.known)

    def _cases(self, cases: Iterable[Case]) -> tuple[tuple[str, ...], ...]:
        return tuple(self._inequalities(self.found.known, x) for x in cases)

    def _inequalities(self, known: Case, case: Case) -> tuple[str, ...]:
        algebra = self.found.about.algebra
        sides = (inequality(algebra, *x) for x in case.beyond(known))
        return tuple(f"{show(a)} > {show(b)}" for a, b in sides)


@dataclass(frozen=True)
class Families(SeveralFound[InLetters]):
    """Families of relative equilibria: a sequence of :class:`InLetters`; ``record``: their
    derivation."""

    _search, _each = "equilibria", InLetters

    found: tuple[Family, ...]
    record: Derivation


@dataclass(frozen=True)
class Trimmed(Finding):
    """An equilibrium under inputs.  ``found``: all that is known of it, exact numbers or narrow
    bounds; ``record``: its derivation, with fewer decimals and their radius."""

    _search = "trim"

    found: Trim
    record: Derivation

    @property
    def x(self) -> list[float]:
        """The state, in the order of the emitted code, each number the nearest double."""
        return [*map(float, self.found.state.values())]

    @property
    def u(self) -> list[float]:
        """All inputs, in that order, likewise."""
        return [*map(float, self.found.inputs.values())]

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", "unstable", or "open" for nothing."""
        return self.found.verdict

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About those of the equations linearised along the group, in 1/s."""
        return self.found.eigenvalues

    def __repr__(self) -> str:
        numbers = zip(self.found.inputs.items(), self.u, strict=True)
        inputs = ", ".join(f"{x} = {v if isinstance(y, Interval) else y}" for (x, y), v in numbers)
        return f"<trim, {self.verdict}: {inputs or 'no inputs'}>"


# The reduction of a problem as Python holds it, and its record.


@dataclass(frozen=True)
class Reduced(Finding):
    """Routh's reduction by symmetries that commute.  ``found``: all that is known of it;
    ``record``: its derivation."""

    _search = "reduction"

    found: Routhian
    record: Derivation

    @property
    def kinds(self) -> tuple[str, ...]:
        """What the symmetries are called, in the order of the momenta: "rotation_space" …"""
        return tuple(x.kind for x in self.found.chosen)

    @property
    def freedom(self) -> int:
        """How many degrees of freedom are left."""
        return self.found.freedom

    def __getitem__(self, label: str) -> Shown:
        """A step by its label, with or without the problem's name: "locked", "effective" …"""
        return Shown(self.record[label], self.record)

    def _equation(self, label: str, lhs: Tree) -> ShownEquation:
        step = self.record[label]
        found = next(e for e in step.equations if e.lhs == lhs)
        return ShownEquation(found, self.record)

    @property
    def locked_inertia(self) -> ShownEquation:
        """𝕀 as a function of g."""
        return self._equation("locked", "𝕀")

    @property
    def effective_potential(self) -> ShownEquation:
        """𝒱 as a function of g and the momenta."""
        return self._equation("effective", "𝒱")

    @property
    def quadrature(self) -> ShownEquation | None:
        """The square of the rate of the coordinate that is left, by the energy and the momenta;
        ``None`` where more than one is left, or one that is no entry of g."""
        told = [s for s in self.record.steps if s.label.endswith(".quadrature")]
        return self._equation("quadrature", told[0].equations[0].lhs) if told else None


# The first integrals of a problem as Python holds them: SymPy expressions, and the record.


@dataclass(frozen=True)
class PolynomialIntegral:
    """A polynomial in the momenta Π_a and the entries of g that motions keep.

    ``tree``: as an operator tree (:mod:`derive.language.tree`).
    """

    tree: Tree
    _expression: Any

    def sympy(self) -> sympy.Expr:
        """The polynomial in the symbols of :attr:`FirstIntegrals.x` and ``p``."""
        return self._expression()

    def __str__(self) -> str:
        from ..language.show import show

        return show(self.tree)

    def __repr__(self) -> str:
        return f"<conserved {self}>"


@dataclass(frozen=True)
class Special:
    """What there is for special parameters: ``values``, symbol → expression in the others;
    ``integrals``, beside the generic ones; ``integrable``: is complete integrability proved?"""

    values: Mapping[sympy.Symbol, sympy.Expr]
    integrals: tuple[PolynomialIntegral, ...]
    integrable: bool


@dataclass(frozen=True)
class FirstIntegrals(Finding):
    """The Casimirs and the polynomial integrals of the reduced equations of a problem up to a
    degree, with its record, whose last steps tell them.

    >>> from derive import first_integrals
    >>> found = first_integrals("lagrange_top")
    >>> found.integrals[1].sympy(), found.integrable
    (Pi_3, True)
    """

    _search = "integrals"
    found: IntegralsFound
    record: Derivation

    def __repr__(self) -> str:
        return f"<first integrals of {self.record.name}: {len(self.integrals)}>"

    @property
    def degree(self) -> int:
        """The degree up to which all are found."""
        return self.found.degree

    @property
    def integrable(self) -> bool:
        """Is complete integrability, Liouville's, proved?  False where it is left open."""
        return self.found.proved.complete

    @property
    def rank(self) -> int:
        """The rank of the Poisson tensor."""
        return self.found.proved.rank

    @cached_property
    def x(self) -> tuple[sympy.Symbol, ...]:
        """The symbols of the variables: Pi_1 …, and A_11 … for the entries of g."""
        return tuple(map(_symbol, map(_name, self.found.system.variables)))

    @cached_property
    def p(self) -> tuple[sympy.Symbol, ...]:
        """The symbols of the parameters that occur."""
        return tuple(map(_symbol, self.found.system.parameters))

    @cached_property
    def energy(self) -> PolynomialIntegral:
        """The energy as a function of the variables, the first of the integrals."""
        algebra = self.found.system.algebra

        def expression() -> Any:
            terms = algebra.hamiltonian.items()
            return sum(self._number(c) * _monomial(self.x, e) for e, c in terms)

        return PolynomialIntegral(algebra.field_tree(algebra.hamiltonian), expression)

    @cached_property
    def casimirs(self) -> tuple[PolynomialIntegral, ...]:
        """The Casimirs."""
        return tuple(map(self._conserved, self.found.casimirs))

    @cached_property
    def integrals(self) -> tuple[PolynomialIntegral, ...]:
        """The energy, and the integrals that are no polynomials in it and the Casimirs."""
        return (self.energy, *map(self._conserved, self.found.integrals))

    @cached_property
    def levels(self) -> Mapping[int, tuple[PolynomialIntegral, ...]]:
        """The number of a Casimir, from 0 → what motions keep where that vanishes alone."""
        return {x.casimir: tuple(map(self._conserved, x.integrals)) for x in self.found.levels}

    @cached_property
    def conditions(self) -> tuple[Special, ...]:
        """The conditions on the parameters under which there are more, where they were searched."""
        whole = self.found.conditions
        return tuple(map(self._special, whole.conditions if whole else ()))

    def _special(self, x: Condition) -> Special:
        algebra = x.system.algebra
        values = {self.p[j]: y.as_expr(*self.p) for j, y in x.case.solved}
        own = (*self.x, *map(_symbol, x.system.parameters))
        kept = (PolynomialIntegral(algebra.tree(f), partial(f.as_expr, *own)) for f in x.integrals)
        return Special(values, (*kept,), x.proved.complete)

    @cached_property
    def rates(self) -> tuple[sympy.Expr, ...]:
        """The rates of the variables as SymPy expressions: ẋ_i = {x_i, H}."""
        flow = self.found.system.algebra.flow
        images = (flow.get(i, {}) for i, _ in enumerate(self.x))
        return tuple(
            sympy.Add(*(self._number(c) * _monomial(self.x, e) for e, c in f.items()))
            for f in images
        )

    def _conserved(self, f: Any) -> PolynomialIntegral:
        tree = self.found.system.algebra.tree(f)
        return PolynomialIntegral(tree, lambda: f.as_expr(*self.x, *self.p))

    def _number(self, c: Any) -> Any:
        if self.p:
            return c.as_expr(*self.p)
        return sympy.Rational(int(c.numerator), int(c.denominator))


@in_keywords()
def first_integrals(
    problem: Problem | str | Path,
    degree: int = 4,
    *,
    at_defaults: bool = False,
    conditions: bool = False,
) -> FirstIntegrals:
    """The polynomial integrals of a problem, of a problem file, or of a ready-made problem, up to
    a degree; momenta are of degree 1.

    ``at_defaults``: parameters have their default values; else they stay letters, and what is found
    is for generic values of them; ``conditions``: special values with more are found, too.
    ``ProblemError``, ``NotReducedError`` say what is wrong.
    """
    from ..searches import integrals

    problem = loaded(problem)
    chosen = {"at_defaults": at_defaults, "conditions": conditions}
    return FirstIntegrals(*integrals(problem, degree, **chosen))


def _name(x: Tree) -> str:
    """The name of a variable as a symbol of SymPy."""
    assert isinstance(x, tuple)
    return suffixed({"Π": "Pi"}.get(x[1], str(x[1])), *x[2:])


def _symbol(name: str) -> Any:
    return sympy.pi if name == "π" else sympy.Symbol(name, real=True)


def _monomial(x: tuple[Any, ...], e: tuple[int, ...]) -> Any:
    return sympy.Mul(*(y**k for y, k in zip(x, e, strict=True)))
