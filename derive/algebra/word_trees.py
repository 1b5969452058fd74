"""From words to trees: choosing how an expression is written.

The paper writes ``Tr α J ᾱ`` in one place and ``⟨α, α⟩_J`` in another; both are one word.
A :class:`WordNotation` says which symmetric letters are written as metrics and which letters stand
for a subtree (``δA − α δt``); the rest are fixed habits: a trace starts with a plain letter and
ends with a barred one, a word with a vector is an inner product, ``j(a) b`` is ``a ∧ b``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..language.tree import Tree, add, coefficient, mul, neg
from .words import Expr, Factor, Letter, Word, rotations, row_dim, transpose_word


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
