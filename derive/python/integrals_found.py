"""The first integrals of a problem as Python holds them: SymPy expressions, and the record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import sympy

from ..check.form.hypotheses_checked import Verdict
from ..integrals.all_integrals import Condition, Found
from ..language.suffixed import suffixed
from ..language.tree import Tree
from ..problem.problem import Problem
from ..record.record import Derivation
from .doubted import loaded
from .keywords import in_keywords


@dataclass(frozen=True)
class Conserved:
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
    integrals: tuple[Conserved, ...]
    integrable: bool


@dataclass(frozen=True)
class FirstIntegrals:
    """The Casimirs and the polynomial integrals of the reduced equations of a problem up to a
    degree, with its record, whose last steps tell them.

    >>> from derive import first_integrals
    >>> found = first_integrals("lagrange_top")
    >>> found.integrals[1].sympy(), found.integrable
    (Pi_3, True)
    """

    found: Found
    record: Derivation

    def __repr__(self) -> str:
        return f"<first integrals of {self.record.name}: {len(self.integrals)}>"

    def __str__(self) -> str:
        return self._rendered("text")

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
    def energy(self) -> Conserved:
        """The energy as a function of the variables, the first of the integrals."""
        algebra = self.found.system.algebra

        def expression() -> Any:
            terms = algebra.hamiltonian.items()
            return sum(self._number(c) * _monomial(self.x, e) for e, c in terms)

        return Conserved(algebra.field_tree(algebra.hamiltonian), expression)

    @cached_property
    def casimirs(self) -> tuple[Conserved, ...]:
        """The Casimirs."""
        return tuple(map(self._conserved, self.found.casimirs))

    @cached_property
    def integrals(self) -> tuple[Conserved, ...]:
        """The energy, and the integrals that are no polynomials in it and the Casimirs."""
        return (self.energy, *map(self._conserved, self.found.integrals))

    @cached_property
    def levels(self) -> Mapping[int, tuple[Conserved, ...]]:
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
        kept = (Conserved(algebra.tree(f), partial(f.as_expr, *own)) for f in x.integrals)
        return Special(values, (*kept,), x.proved.complete)

    @cached_property
    def rates(self) -> tuple[sympy.Expr, ...]:
        """The rates of the variables as SymPy expressions: ẋ_i = {x_i, H}."""
        flow = self.found.system.algebra.flow
        images = (flow.get(i, {}) for i, _ in enumerate(self.x))
        return tuple(
            sum((self._number(c) * _monomial(self.x, e) for e, c in f.items()), _zero())
            for f in images
        )

    def _conserved(self, f: Any) -> Conserved:
        tree = self.found.system.algebra.tree(f)
        return Conserved(tree, lambda: f.as_expr(*self.x, *self.p))

    def _number(self, c: Any) -> Any:
        if self.p:
            return c.as_expr(*self.p)
        return sympy.Rational(int(c.numerator), int(c.denominator))

    # -- the record ----------------------------------------------------------------------------

    def check(self, seed: int | None = None) -> list[Verdict]:
        """A verdict for the symbols and every step, as :meth:`Derived.check` gives them."""
        from ..check.checker import check

        return check(self.record, seed)

    def markdown(self, lang: str = "en") -> str:
        """The steps that tell the integrals in Markdown."""
        return self._rendered("markdown", lang)

    def latex(self, lang: str = "en") -> str:
        """The same as a document for pdflatex."""
        return self._rendered("latex", lang)

    def _repr_markdown_(self) -> str:
        return self.markdown()

    def _rendered(self, form: str, lang: str = "en") -> str:
        from ..command.showing import told_steps
        from ..views.rendering import render

        return render(self.record, form, lang, steps=told_steps(self.record))


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
    from ..pipeline import integrals

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


def _zero() -> Any:
    return sympy.Integer(0)
