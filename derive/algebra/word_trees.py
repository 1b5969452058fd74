"""From words to trees: choosing how an expression is written; vectors of R³ and fields on words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..language.tree import Tree, add, coefficient, mul, neg
from .calculus import PairRule, map_traces, reduce
from .words import (
    Expr,
    Factor,
    Key,
    Letter,
    Terms,
    Word,
    inner,
    one,
    rotations,
    row_dim,
    scalar_of,
    transpose_word,
    word,
    zero,
)

# R³ ≅ so(3): the relations of the operator j on words.
#
# ``j(X) Y = X ∧ Y`` is the paper's footnote. The rules bring every word to a normal form without
# two neighbouring j's, so that identities of the vector product are decided by comparison.


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


# Vector fields as vectors: letters ∇_c for the derivative of fields along a field c.
#
# ∇_c is linear in c. On fields c that are divergence-free and tangent to the boundary it is skew,
# by Stokes' theorem: ⟨∇_c a, b⟩ + ⟨a, ∇_c b⟩ is the integral of the divergence of ⟨a, b⟩c.


def along(field: Letter) -> Letter:
    """The operator ∇_c of a letter c for a field that is divergence-free and tangent to the
    boundary."""
    return Letter(f"∇_{field.name}", field.rows, field.rows, symmetry=-1, along=field)


def derivative_along(field: Expr) -> Expr:
    """∇_c of a sum c of scalar multiples of letters; ``ValueError`` for another expression."""
    terms: Terms = {}
    for (traces, w), factor in field.terms.items():
        if len(w) != 1 or w[0][1]:
            raise ValueError("∇ is linear in letters of fields alone")
        terms[traces, ((along(w[0][0]), False),)] = factor
    return Expr(field.rows, field.rows, terms, field.lineage)


def with_derivatives(images: Mapping[Letter, Expr]) -> dict[Letter, Expr]:
    """Images of letters for fields, and with them those of the operators along these."""
    return {**images, **{along(x): derivative_along(e) for x, e in images.items()}}


# From words to trees: choosing how an expression is written.
#
# The paper writes ``Tr α J ᾱ`` in one place and ``⟨α, α⟩_J`` in another; both are one word. A
# WordNotation says which symmetric letters are written as metrics and which letters stand for a
# subtree (``δA − α δt``); the rest are fixed habits: a trace starts with a plain letter and ends
# with a barred one, a word with a vector is an inner product, ``j(a) b`` is ``a ∧ b``.


@dataclass(frozen=True)
class WordNotation:
    """How expressions are written: ``metrics``: letters written as ⟨·,·⟩_M; ``display``: trees that
    letters stand for.

    ``covectors``: letters whose traces with another are written ⟨·,·⟩.
    """

    metrics: frozenset[str] = frozenset()
    display: Mapping[Letter, Tree] = field(default_factory=dict)
    covectors: frozenset[Letter] = frozenset()


PLAIN = WordNotation()

READING = [
    *("Π̇", "ṗ_b", "δΠ", "δp_b", "δ′Π", "δ′p_b", "Π", "p_b", "Φ", "K_a"),
    "α",
    "τ",
    "F̃",
    "N",
    "F",
    "N_b",
    "F_b",
    "μ",
    "φ",
    "f",
    "ν̇",
    "[ξ′,ξ]",
    "δ′A",
    "δ′T",
    "δA",
    "δT",
    "ξ′",
    "ξ",
    "Ω′",
    "Ω",
    "ζ",
    "Z",
]
"""The letters in the order in which they begin a product that may be read from either end."""


def _rank(letter: Letter) -> int:
    name = letter.name.replace(" ", "")
    return READING.index(name) if name in READING else len(READING)


def metrics(*names: str, display: Mapping[Letter, Tree] | None = None) -> WordNotation:
    """The notation that writes the named letters as metrics."""
    return WordNotation(frozenset(names), display or {})


def tree_of(e: Expr, notation: WordNotation = PLAIN) -> Tree:
    """The tree of an expression, positive terms first, otherwise in order of derivation."""
    terms: list[tuple[bool, Tree]] = []
    for (traces, w), c in e.terms.items():
        scalars = _group_powers(sorted((_scalar(t, notation) for t in traces), key=_weight))
        before = [f for f in scalars if _weight(f) < 2]
        after = [f for f in scalars if _weight(f) == 2]
        matrix: list[Tree] = [] if e.is_scalar else [_product(w, notation) if w else ("one",)]
        term = mul(c, *before, *matrix, *after)
        terms.append((coefficient(term)[0] < 0, term))
    return add(*(t for _, t in sorted(terms, key=lambda item: item[0])))


def _weight(t: Tree) -> int:
    """0 for a single letter, 1 for a trace, 2 for a variation as δt: the order of the factors of a
    term."""
    if isinstance(t, str):
        return 2 if t.startswith("δ") else 0
    return 1


def _group_powers(factors: list[Tree]) -> list[Tree]:
    grouped: list[Tree] = []
    k = 0
    while k < len(factors):
        same = 1
        while k + same < len(factors) and factors[k + same] == factors[k]:
            same += 1
        grouped.append(factors[k] if same == 1 else ("pow", factors[k], same))
        k += same
    return grouped


def _factor(f: Factor, notation: WordNotation) -> Tree:
    letter, bar = f
    shown: Tree = notation.display.get(letter, letter.name)
    if letter.axis is not None and letter not in notation.display:
        shown = ("hat", notation.display.get(letter.axis, letter.axis.name))
    if letter.along is not None and letter not in notation.display:
        shown = ("nabla", notation.display.get(letter.along, letter.along.name))
    return ("T", shown) if bar else shown


def _product(w: Word, notation: WordNotation) -> Tree:
    """The tree of a word; with a vector at its right end it is folded from there, so that j(a) b
    reads a ∧ b."""
    if row_dim(w[0]) == 1:
        sign, column = transpose_word(w)
        shown = ("T", _product(column, notation))
        return shown if sign > 0 else neg(shown)
    if w[-1][0].cols != 1 or w[-1][1]:
        return mul(*_group_powers([_factor(f, notation) for f in w]))
    tail: Tree = _factor(w[-1], notation)
    for letter, bar in reversed(w[:-1]):
        if letter.axis is not None:
            tail = ("wedge", notation.display.get(letter.axis, letter.axis.name), tail)
        else:
            tail = mul(_factor((letter, bar), notation), tail)
    return tail


def _scalar(w: Word, notation: WordNotation) -> Tree:
    seams = [turned for turned in rotations(w) if row_dim(turned[0]) == 1]
    if seams:
        return _scalar_product(seams[0], notation)
    return _trace(w, notation)


def _scalar_product(w: Word, notation: WordNotation) -> Tree:
    if len(w) == 1:
        return _factor(w[0], notation)
    sign, w = min(((1, w), transpose_word(w)), key=lambda item: _inner_order(item[1]))
    left = _factor((w[0][0], False), notation)
    if len(w) == 3 and w[1][0].name in notation.metrics:
        return _signed(sign, _metric(w[1][0].name, left, _factor(w[2], notation)))
    right = _product(w[1:], notation)
    if left == right:
        return _signed(sign, ("norm2", left))
    c, right = coefficient(right)
    return mul(c, _signed(sign, ("inner", right, left) if len(w) > 2 else ("inner", left, right)))


def _inner_order(w: Word) -> tuple[object, ...]:
    """The key of the ways to write ⟨a, b⟩, least first: few bars, the body's own vector innermost,
    ⟨Zc, η⟩."""
    return _bars(w), len(w) > 2 and w[-1][0].name != "c", _rank(w[0][0]), _names(w)


def _metric(name: str, a: Tree, b: Tree) -> Tree:
    return ("norm2", name, a) if a == b else ("metric", name, a, b)


def _signed(sign: int, t: Tree) -> Tree:
    return t if sign > 0 else neg(t)


def _bars(w: Word) -> int:
    return sum(bar for _, bar in w)


def _names(w: Word) -> tuple[str, ...]:
    return tuple(letter.name for letter, _ in w)


def _reading_order(w: Word) -> tuple[object, ...]:
    first, last = w[0], w[-1]
    symmetric_second = len(w) > 1 and w[1][0].symmetry > 0
    return (
        first[1] or first[0].symmetry > 0,
        not symmetric_second,
        not (last[1] or last[0].symmetry),
        _bars(w),
        _rank(first[0]),
        _names(w),
    )


def _paired(candidates: list[tuple[int, Word]], notation: WordNotation) -> Tree | None:
    """The tree ⟨P, x⟩ for Tr P x̄, where P is a covector; ``None`` where there is none."""
    for sign, ((left, barred), right) in candidates:
        if left in notation.covectors and not barred and (right[1] or right[0].symmetry < 0):
            pair = (_factor((x, False), notation) for x in (left, right[0]))
            return _signed(sign if right[1] else -sign, ("inner", *pair))
    return None


def _trace(w: Word, notation: WordNotation) -> Tree:
    sign, other = transpose_word(w)
    candidates = [(1, turned) for turned in rotations(w)]
    candidates += [(sign, turned) for turned in rotations(other)]
    if len(w) == 2 and (pair := _paired(candidates, notation)):
        return pair
    best_sign, best = min(candidates, key=lambda item: _reading_order(item[1]))
    if len(best) == 3 and best[1][0].name in notation.metrics:
        a, metric, b = best
        if not a[1] and (b[1] or b[0].symmetry < 0):
            left = _factor(a, notation)
            right = _factor((b[0], False), notation)
            sign = best_sign if b[1] else best_sign * b[0].symmetry
            return _signed(sign, _metric(metric[0].name, left, right))
    if len(best) > 1 and best[-1][0].symmetry < 0:
        # Z̄ = −Z: a skew letter at the end is written barred, as it is for any group
        last: Tree = ("T", _factor(best[-1], notation))
        body = [_factor(f, notation) for f in best[:-1]]
        return _signed(-best_sign, ("tr", mul(*_group_powers(body), last)))
    return _signed(best_sign, ("tr", mul(*_group_powers([_factor(f, notation) for f in best]))))
