"""(35): a vector equation component by component, in axes where I is diagonal."""

from __future__ import annotations

from fractions import Fraction

from ..algebra.laurent import Laurent, Monomial
from ..algebra.tree import Tree, add, mul, names
from ..record.evaluate import Environment, evaluate

AXES = (1, 2, 3)
MOMENTS = "λ"
VELOCITY = "ζ"


def principal_components(t: Tree) -> list[Tree]:
    """The three components of a vector tree in I and vectors, for I = diag(λ₁, λ₂, λ₃).

    Terms of the same velocities stand together, over the moment that divides them all.
    """
    moments = [_entry(MOMENTS, i) for i in AXES]
    inertia = tuple(
        tuple(moments[i] if i == j else Laurent({}) for j in range(3)) for i in range(3)
    )
    vectors = {x: tuple((_entry(x, i),) for i in AXES) for x in names(t)}
    value = evaluate(t, Environment(3, {**vectors, "I": inertia}))
    return [_gathered(x) for (x,) in value]


def _entry(name: str, i: int) -> Laurent:
    return Laurent.symbol(f"{name}_{i}")


def _gathered(p: Laurent) -> Tree:
    """Σ (sum of moments)/(their divisor) · other symbols, what has no velocity first."""
    groups: dict[Monomial, dict[Monomial, Fraction]] = {}
    for m, q in p.terms.items():
        rest = tuple(x for x in m if not x[0].startswith(MOMENTS))
        moments = tuple(x for x in m if x[0].startswith(MOMENTS))
        groups.setdefault(rest, {})[moments] = q
    order = sorted(groups, key=lambda m: (any(s.startswith(VELOCITY) for s, _ in m), m))
    return add(*(mul(_quotient(groups[m]), _monomial(m)) for m in order))


def _quotient(terms: dict[Monomial, Fraction]) -> Tree:
    """A sum of quotients over the moments that divide every term of it."""
    below = {s: e for m in terms for s, e in m if e < 0}
    common = tuple(sorted((s, -e) for s, e in below.items()))
    lifted = (Laurent(terms) * Laurent({common: Fraction(1)})).terms
    # what is added before what is taken away
    order = sorted(lifted, key=lambda m: (lifted[m] < 0, m))
    above = add(*(mul(_number(lifted[m]), _monomial(m)) for m in order))
    return ("div", above, _monomial(common)) if common else above


def _number(q: Fraction) -> Tree:
    return int(q) if q.denominator == 1 else q


def _monomial(m: Monomial) -> Tree:
    factors: list[Tree] = []
    for symbol, e in m:
        name, _, index = symbol.rpartition("_")
        entry: Tree = ("entry", name, int(index))
        factors.append(entry if e == 1 else ("pow", entry, e))
    return mul(1, *factors)
