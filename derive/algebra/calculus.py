"""Calculus on words: derivations, substitutions, relations of a group, determinants, forms."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from fractions import Fraction
from itertools import groupby

from .words import (
    Expr,
    Factor,
    Letter,
    Traces,
    Word,
    expr_of_word,
    number,
    one,
    rotations,
    scalar_of,
    trace,
    transpose_word,
    word,
)

Image = Callable[[Letter], Expr | None]
"""The value of a derivation on a letter; ``None`` for a constant."""


def map_terms(
    e: Expr, image: Callable[[Traces, Word, Fraction], Expr], shape: Expr | None = None
) -> Expr:
    """Σ image(traces, word, coefficient) over the terms of an expression; ``shape``: a zero of the
    shape of the images, where that is another."""
    total = (e if shape is None else shape.of(e)).like({})
    for (traces, w), c in e.terms.items():
        total = total + image(traces, w, c)
    return total


def map_traces(e: Expr, image: Callable[[Word], Expr]) -> Expr:
    """An expression with image(word) for the trace of each word, images being scalars."""

    def mapped(traces: Traces, w: Word, c: Fraction) -> Expr:
        term = Expr(e.rows, e.cols, {((), w): c})
        for cycle in traces:
            term = image(cycle) * term
        return term

    return map_terms(e, mapped)


def _between(before: Word, image: Expr, after: Word) -> Expr:
    """The product of a word, an expression and a word, either of which may be empty."""
    result = expr_of_word(before) * image if before else image
    return result * expr_of_word(after) if after else result


def _apply_at(w: Word, k: int, image: Expr) -> Expr:
    """The word with its k-th factor replaced; ``image``: of the plain letter."""
    return _between(w[:k], image.bar if w[k][1] else image, w[k + 1 :])


def leibniz(w: Word, delta: Image) -> Expr | None:
    """δw of a word w, by the product rule; ``None`` when all its letters are constant."""
    total: Expr | None = None
    for k, (letter, _) in enumerate(w):
        image = delta(letter)
        if image is not None:
            term = _apply_at(w, k, image)
            total = term if total is None else total + term
    return total


def derivation(e: Expr, delta: Image) -> Expr:
    """``δe`` for the derivation whose value on letters is ``delta`` (``None`` for constants)."""
    total = e.like({})
    for (traces, w), c in e.terms.items():
        for k, cycle in enumerate(traces):
            varied = leibniz(cycle, delta)
            if varied is not None:
                others = Expr(e.rows, e.cols, {(traces[:k] + traces[k + 1 :], w): c})
                total = total + trace(varied) * others
        if w:
            varied = leibniz(w, delta)
            if varied is not None:
                total = total + scalar_of(traces, c) * varied
    return total


def substitute(e: Expr, images: Mapping[Letter, Expr]) -> Expr:
    """An expression with its letters replaced by ``images``: a homomorphism, bars go along."""

    def of(w: Word) -> Expr:
        result: Expr | None = None
        for moves, run in groupby(w, lambda factor: factor[0] in images):
            factors = tuple(run)
            if moves:
                pieces = [images[x].bar if bar else images[x] for x, bar in factors]
            else:
                pieces = [expr_of_word(factors)]
            for piece in pieces:
                result = piece if result is None else result * piece
        assert result is not None
        return result

    def image(traces: Traces, w: Word, c: Fraction) -> Expr:
        if not _occurs(images, traces, w):
            return e.like({(traces, w): c})
        product = number(c)
        for cycle in traces:
            product = product * trace(of(cycle))
        return product * (of(w) if w else one(e.rows))

    return map_terms(e, image)


def substitute_trace(e: Expr, old: Expr, new: Expr) -> Expr:
    """An expression with a trace, of one word, replaced by a scalar."""
    ((traces, _),) = old.terms
    total = e * 0
    for (found, w), k in e.terms.items():
        if traces[0] in found:
            left = tuple(x for i, x in enumerate(found) if i != found.index(traces[0]))
            total = total + e.like({(left, w): k}) * new
        else:
            total = total + e.like({(found, w): k})
    return total


PairRule = Callable[[Factor, Factor], Expr | None]
"""A relation: what an adjacent pair of factors is equal to, or ``None``."""


def reduce(e: Expr, *rules: PairRule) -> Expr:
    """Rewrite adjacent pairs, also across the seam of a trace, until no rule applies."""
    work = e
    while True:
        total, changed = work.like({}), False
        for (traces, w), c in work.terms.items():
            rewritten = _rewrite_term(traces, w, c, rules, work)
            changed = changed or rewritten is not None
            total = total + (
                rewritten if rewritten is not None else Expr(e.rows, e.cols, {(traces, w): c})
            )
        if not changed:
            return work
        work = total


def _rewrite_term(
    traces: Traces, w: Word, c: Fraction, rules: tuple[PairRule, ...], shape: Expr
) -> Expr | None:
    for k, cycle in enumerate(traces):
        closed = _rewrite_cycle(cycle, rules)
        if closed is not None:
            return closed * Expr(shape.rows, shape.cols, {(traces[:k] + traces[k + 1 :], w): c})
    opened = _rewrite_word(w, rules)
    return None if opened is None else scalar_of(traces, c) * opened


def _rewrite_word(w: Word, rules: tuple[PairRule, ...]) -> Expr | None:
    for k in range(len(w) - 1):
        for rule in rules:
            image = rule(w[k], w[k + 1])
            if image is not None:
                return _between(w[:k], image, w[k + 2 :])
    return None


def _rewrite_cycle(cycle: Word, rules: tuple[PairRule, ...]) -> Expr | None:
    if len(cycle) < 2:
        return None
    for turned in rotations(cycle):
        image = _rewrite_word(turned, rules)
        if image is not None:
            return trace(image)
    return None


def gradient(e: Expr, letter: Letter) -> Expr:
    """The ``G`` with ``e = Tr x̄ G + (terms without x)``, for a scalar ``e`` linear in the letter
    x; ``ValueError`` where it is not.

    For a symmetric or skew letter only that part of G is determined, and it is what is returned.
    """
    total = Expr(letter.rows, letter.cols, {}, e.lineage)
    for (traces, _), c in e.terms.items():
        for k, cycle in enumerate(traces):
            places = [i for i, (x, _) in enumerate(cycle) if x == letter]
            if not places:
                continue
            if len(places) > 1:
                raise ValueError(f"not linear in {letter.name}")
            rest = cycle[places[0] + 1 :] + cycle[: places[0]]
            sign = 1
            if not cycle[places[0]][1]:
                sign, rest = transpose_word(rest)
            others = scalar_of(traces[:k] + traces[k + 1 :], c * sign)
            total = total + others * (expr_of_word(rest) if rest else one(letter.rows))
    if letter.symmetry and total.rows == total.cols:
        return Fraction(1, 2) * (total + letter.symmetry * total.bar)
    return total


def coefficient_of(e: Expr, x: Letter) -> Expr:
    """The ``M`` with ``e = M x + (terms without x)``, for a vector ``e`` linear in the vector x, or
    any ``e`` linear in the scalar x."""
    scalar, ending = x.rows == 1 == x.cols, (x, False)

    def coefficient(traces: Traces, w: Word, c: Fraction) -> Expr:
        if w[-1:] == (ending,):
            return nothing.like({(traces, w[:-1]): c})
        for k, cycle in enumerate(traces):
            if any(y == x for y, _ in cycle):
                others = e.like({(traces[:k] + traces[k + 1 :], w): c})
                return others if scalar else others * gradient(scalar_of((cycle,)), x).bar
        return nothing

    nothing = Expr(e.rows, e.cols if scalar else x.rows, {})
    return map_terms(e, coefficient, nothing)


def without(e: Expr, *letters: Letter) -> Expr:
    """The sum of the terms in which none of the letters occurs."""
    return e.like({key: c for key, c in e.terms.items() if not _occurs(letters, *key)})


def terms_with(e: Expr, *letters: Letter) -> Expr:
    """The sum of the terms in which at least one of the letters occurs."""
    return e.like({key: c for key, c in e.terms.items() if _occurs(letters, *key)})


def _occurs(letters: Container[Letter], traces: Traces, w: Word) -> bool:
    return any(x in letters for part in (*traces, w) for x, _ in part)


# Determinants and adjugates of words: det (xy) = det x det y, det x̄ = det x, and the theorem of
# Cayley and Hamilton for 3 × 3 matrices.


def determinant_letter(x: Letter) -> Letter:
    """The scalar letter det x; that of the letter x⁻¹ is (det x)⁻¹."""
    return Letter(f"det_{x.name}")


def determinant(e: Expr) -> Expr:
    """det e of one term, n × n for a number n; ``ValueError`` for a sum."""
    if len(e.terms) != 1 or not isinstance(e.rows, int):
        raise ValueError("the determinant of a sum is no product")
    ((traces, w), c), total = next(iter(e.terms.items())), number(1)
    for x, _ in w:
        total = total * word(determinant_letter(x))
    for _ in range(e.rows):
        total = total * scalar_of(traces, c)
    return total


def adjugate(e: Expr) -> Expr:
    """adj e of a 3 × 3 expression, e² − (Tr e) e + ½((Tr e)² − Tr e²)1; ``ValueError`` for another
    size."""
    if (e.rows, e.cols) != (3, 3):
        raise ValueError("the adjugate of a 3 × 3 matrix")
    first, square = trace(e), e * e
    return square - first * e + Fraction(1, 2) * (first * first - trace(square)) * one(3)


def power_of(e: Expr, x: Letter, k: int) -> Expr:
    """The coefficient of the k-th power of a scalar letter in an expression."""

    def kept(traces: Traces, w: Word, c: Fraction) -> Expr:
        others = tuple(y for y in traces if y != ((x, False),))
        return e.like({(others, w): c} if len(traces) - len(others) == k else {})

    return map_terms(e, kept)


# Forms on a group: the structure equation and the exterior derivative.
#
# Convention, fixed here once: dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] for two commuting variations, and the
# left trivialisation δg = gξ where no other is said.


def exterior(form: Expr, prime: Mapping[Letter, Letter], delta: Image, delta_prime: Image) -> Expr:
    """``dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)]`` of a one-form given as the scalar ϖ(δ).

    ``prime`` sends each variation letter (δA) to its primed twin (δ′A); the two derivations must
    agree on second variations, δ(δ′A) = δ′(δA), or differ by the structure equation.
    """
    primed = substitute(form, {x: word(y) for x, y in prime.items()})
    return derivation(primed, delta) - derivation(form, delta_prime)


Trivialisation = Callable[[Expr, Expr], Expr]
"""From g and an element ξ of 𝔤 to the tangent vector δg that it stands for."""


def left(g: Expr, xi: Expr) -> Expr:
    """δg = g ξ: the left trivialisation, ξ = g⁻¹δg."""
    return g * xi


def right(g: Expr, xi: Expr) -> Expr:
    """δg = ξ g: the right trivialisation, ξ = δg g⁻¹."""
    return xi * g


def structure_equation(
    g: Letter,
    xi: Letter,
    xi_prime: Letter,
    eta: Letter,
    eta_prime: Letter,
    moved: Trivialisation = left,
) -> Expr:
    """The value of ``δη′ − δ′η`` when  δg = g ξ  and  δx = g η  (so ``[ξ′, ξ]`` for η = ξ).

    From δ(δ′x) = δ′(δx): the terms in which g is varied must balance it.
    ``moved``: the trivialisation; the right one gives ``[ξ, ξ′]``.
    """
    element = word(g)
    delta = derivation(moved(element, word(eta_prime)), {g: moved(element, word(xi))}.get)
    delta_prime = derivation(moved(element, word(eta)), {g: moved(element, word(xi_prime))}.get)
    side = "left" if moved is left else "right"
    return strip(delta_prime - delta, g, side=side)


def strip(e: Expr, g: Letter, *, side: str = "left") -> Expr:
    """The expression y with e = g y, or on the right e = y g, for an invertible letter g that each
    word of e begins with, or ends with; ``ValueError`` where one does not."""
    first, rest = (0, slice(1, None)) if side == "left" else (-1, slice(-1))
    terms = {}
    for (traces, w), c in e.terms.items():
        if not w or w[first] != (g, False):
            raise ValueError(f"{g.name} is not a common {side} factor")
        terms[traces, w[rest]] = c
    return e.like(terms)
