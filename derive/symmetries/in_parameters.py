"""Coefficients as functions of the parameters, from their residues for many values of these.

A coefficient is sought among rational multiples of the quantities of L̃ that depend on parameters
alone (a mass, a first moment), their quotients, their linear combinations, and rational functions
of small degree.  What is found has agreed at more values than it has coefficients.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import chain, combinations, combinations_with_replacement

from ..algebra.exact_kernel import fraction_of, kernel, pivots
from ..algebra.residue_vectors import Residues
from ..language.tree import Tree, add, mul, plain
from .gradient import Tape

Samples = Residues
"""The residues of a number, one for each of the values of the parameters."""

SPARE = 6
"""So many values more than there are unknown coefficients."""

LARGEST_DEGREE = 4
"""Of the polynomials in parameters in a quotient."""

FEW = 3
"""So many parameters are tried in a quotient, any of them; then all."""

Quotient = tuple[Tree, Tree]
"""Numerator and denominator."""


def quotients_of(samples: Samples, known: dict[Tree, Samples], p: int) -> Iterator[Quotient]:
    """The expressions in known quantities that have these residues, the simplest first.

    ``known``: the residues of quantities, the simplest first, without the number 1.
    """
    for guess in (_constant, _multiple, _ratio, _linear, _rational):
        found = guess(samples, known, p)
        if found is not None:
            yield found


def constant(samples: Samples) -> bool:
    """Is it the same number for all values of the parameters?"""
    return len({*samples.values}) == 1


def _constant(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    del known
    if not constant(samples):
        return None
    x = fraction_of(samples.values[0], p)
    return None if x is None else (plain(x), 1)


def _multiple(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """c times a known quantity."""
    for t, values in known.items():
        c = _same_ratio(samples, values, p)
        if c is not None:
            return mul(plain(c), t), 1
    return None


def _ratio(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """c times a quotient of known quantities."""
    for t, values in known.items():
        if (found := _multiple(samples * values, known, p)) is not None:
            return found[0], t
    return None


def _linear(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """A linear combination of known quantities."""
    listed = [*known][: max(0, len(samples.values) - SPARE)]
    terms = _dependence([known[t] for t in listed], samples, p)
    return None if terms is None else (_combination(terms, listed), 1)


def _rational(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """A quotient of polynomials in the parameters."""
    names = [t for t in known if isinstance(t, tuple) and t[0] in ("par", "fun")]
    product = _Products(samples, known)
    few = chain.from_iterable(combinations(names, n) for n in range(1, FEW + 1))
    for some in (*few, *[names] * (len(names) > FEW)):
        for degree in range(1, LARGEST_DEGREE + 1):
            every = [*_monomials(some, degree)]
            products = [product[m] for m in every]
            independent = pivots(_rows(products), len(products), p)  # cos² + sin² = 1
            if 2 * len(independent) + SPARE > len(samples.values):
                break
            listed = [every[k] for k in independent]
            columns = [products[k] for k in independent]
            below = [-samples * x for x in columns]
            basis, _ = kernel(_rows([*columns, *below]), 2 * len(columns), p)
            numbers = [fraction_of(x, p) for x in basis[0]] if basis else [None]
            if None not in numbers:
                trees = [mul(1, *m) for m in listed]
                above, under = numbers[: len(listed)], numbers[len(listed) :]
                return _combination(above, trees), _combination(under, trees)
    return None


class _Products(dict[tuple[Tree, ...], Samples]):
    """The products of known quantities, each made when it is asked for."""

    def __init__(self, samples: Samples, known: dict[Tree, Samples]):
        self[()], self.known = samples.like([1] * len(samples.values)), known

    def __missing__(self, m: tuple[Tree, ...]) -> Samples:
        self[m] = self[m[:-1]] * self.known[m[-1]]
        return self[m]


def _monomials(names: Sequence[Tree], degree: int) -> Iterator[tuple[Tree, ...]]:
    for d in range(degree + 1):
        yield from combinations_with_replacement(names, d)


def _rows(columns: Sequence[Samples]) -> Iterator[tuple[int, ...]]:
    """A matrix by its columns."""
    return zip(*(x.values for x in columns), strict=True)


def _same_ratio(a: Samples, b: Samples, p: int) -> Fraction | None:
    """c with a = c b for all samples; ``None`` where there is none."""
    if not b.values[0]:
        return None
    c = a.values[0] * pow(b.values[0], -1, p) % p
    return fraction_of(c, p) if a == b * c else None


def _dependence(
    columns: Sequence[Samples], samples: Samples, p: int
) -> list[Fraction | None] | None:
    """Numbers x with Σ x_k column_k = samples, as few as elimination leaves."""
    if not columns:
        return None
    basis, free = kernel(_rows([*columns, samples]), len(columns) + 1, p)
    if not free or free[-1] != len(columns):
        return None
    numbers = [fraction_of(-x % p, p) for x in basis[-1][:-1]]
    return None if None in numbers else numbers


def _combination(numbers: Sequence[Fraction | None], trees: Sequence[Tree]) -> Tree:
    return add(*(mul(plain(c), t) for c, t in zip(numbers, trees, strict=True) if c))


def quantities(tape: Tape, depends_on_parameters: Callable[[Tree], bool]) -> list[Tree]:
    """The parts of an expression that depend on parameters alone and are factors or terms of what
    does not; the parameters themselves and functions of them first."""
    found: dict[Tree, None] = {}
    for t in tape.places:
        if isinstance(t, tuple) and (t[0] == "par" or t in tape.given):
            found[t] = None
    for t in tape.places:
        if not isinstance(t, tuple) or t[0] in ("par", "entry") or depends_on_parameters(t):
            continue
        inside = [
            x for x in t[1:] if not isinstance(x, (int, Fraction)) and depends_on_parameters(x)
        ]
        if t[0] == "mul" and inside:
            found[mul(1, *inside)] = None
        elif t[0] in ("add", "div"):
            found |= dict.fromkeys(inside)
    return [*found]
