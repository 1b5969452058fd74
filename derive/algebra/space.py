"""R³ ≅ so(3): the relations of the operator j on words.

``j(X) Y = X ∧ Y`` is the paper's footnote.  The rules bring every word to a normal form without
two neighbouring j's, so that identities of the vector product are decided by comparison.
"""

from __future__ import annotations

from .calculus import PairRule, map_traces, reduce
from .words import Expr, Factor, Key, Letter, Word, inner, one, scalar_of, word, zero


def hat(vector: Letter) -> Letter:
    """The skew letter j(X) of a vector letter X."""
    return Letter(f"j({vector.name})", 3, 3, symmetry=-1, axis=vector)


def _is_vector(letter: Letter) -> bool:
    return letter.cols == 1 and letter.rows != 1


def antisymmetry(left: Factor, right: Factor) -> Expr | None:
    """The rule ``x ∧ y = −y ∧ x``: the lesser name goes inside j, from the left and from the right
    alike.

    Both sides must choose the same way: a transpose turns one into the other.
    """
    (a, a_bar), (b, b_bar) = left, right
    if a.axis is not None and _is_vector(b) and not b_bar:
        if a.axis == b:
            return zero(3, 1)
        if b.name < a.axis.name:
            return -(word(hat(b)) * word(a.axis))
    if b.axis is not None and _is_vector(a) and a_bar:
        if b.axis == a:
            return zero(1, 3)
        if a.name < b.axis.name:
            return -(word(b.axis).bar * word(hat(a)))
    return None


def double(left: Factor, right: Factor) -> Expr | None:
    """The rule ``j(x) j(y) = y x̄ − ⟨x, y⟩ 1``: the double vector product."""
    x, y = left[0].axis, right[0].axis
    if x is None or y is None:
        return None
    return word(y) * word(x).bar - inner(word(x), word(y)) * one(3)


RULES: tuple[PairRule, ...] = (antisymmetry, double)
"""The rules of the normal form: no two neighbouring j's, and j(x)y with x before y."""


def normal_form(e: Expr) -> Expr:
    """An expression by :data:`RULES`, in which two that are equal have the same terms."""
    return reduce(e, *RULES)


def fold_inertia(e: Expr, moments: Letter, inertia: Expr) -> Expr:
    """A scalar with ``⟨x, y⟩_I`` for each trace ``Tr j(x) J j(y)‾``; J and I are ``moments``,
    ``inertia``."""

    def metric(cycle: Word) -> Expr:
        axes = [x.axis for x, _ in cycle if x.axis is not None]
        if len(cycle) == 3 and len(axes) == 2 and any(x == moments for x, _ in cycle):
            return -inner(word(axes[0]), word(axes[1]), inertia)
        return scalar_of((cycle,))

    return map_traces(e, metric)


def fold_double(e: Expr) -> Expr:
    """A vector with ``x ∧ (z ∧ y)`` for two terms ``⟨x, y⟩ z − ⟨x, z⟩ y``, wherever they stand
    together."""
    terms = dict(e.terms)
    folded = zero(e.rows, e.cols)
    for key, c in e.terms.items():
        for x, y, others in _inner_factors(key) if c > 0 and key in terms else ():
            (z, _) = key[1][0]
            twin = next(iter((word(x).bar * word(z) * others * word(y)).terms))
            if y != z and terms.get(twin) == -c:
                del terms[key], terms[twin]
                folded = folded + others * c * word(hat(x)) * word(hat(z)) * word(y)
                break
    return e.like(terms) + folded


def _inner_factors(key: Key) -> list[tuple[Letter, Letter, Expr]]:
    """The (x, y, others) for which a term that ends in the vector z is  ⟨x, y⟩ · others · z."""
    traces, w = key
    if len(w) != 1:
        return []
    found = []
    for k, cycle in enumerate(traces):
        letters = [letter for letter, _ in cycle]
        if len(cycle) == 2 and all(map(_is_vector, letters)):
            others = scalar_of(traces[:k] + traces[k + 1 :])
            found += [(x, y, others) for x, y in (letters, letters[::-1])]
    return found
