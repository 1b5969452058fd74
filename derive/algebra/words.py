"""The algebra of words: sums of  coefficient · traces · word  in a few matrix letters.

A *word* is a product of letters, each plain or barred (transposed): ``α J ᾱ``.  A *scalar* is a
polynomial in traces of words, a 1×1 letter (``δt``, ``m``) being its own trace.  Everything is one
type, :class:`Expr`: a finite map  (traces, word) → rational.  Keys are canonical, so two
expressions are equal exactly when their maps are:

* a bar on a symmetric letter is dropped, on a skew one it becomes a sign;
* a word is cut wherever the inner dimension is 1: ``a b̄ c d̄ = ⟨b, c⟩ a d̄``;
* a trace is the least of its cyclic shifts and of those of its transpose, and vanishes when it is
  its own opposite.

Relations of a group (``ĀA = 1``) are rewriting rules on adjacent letters, see ``calculus.reduce``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

Dim = int | str
"""A dimension: a number, or the name of one (``"n"``)."""


@dataclass(frozen=True, slots=True)
class Letter:
    """A matrix (rows × cols), vector (n × 1) or scalar (1 × 1) symbol.

    ``symmetry`` is +1 (``x̄ = x``), −1 (``x̄ = −x``) or 0; ``axis`` is the vector letter ``X`` when
    this letter is the skew matrix ``j(X)`` of the paper's footnote; ``along`` the vector letter
    ``c`` when it is the operator ``∇_c``, the derivative of vector fields along c.
    """

    name: str
    rows: Dim = 1
    cols: Dim = 1
    symmetry: int = 0
    traceless: bool = False
    axis: Letter | None = None
    along: Letter | None = None


Factor = tuple[Letter, bool]
"""A letter, and whether it is barred."""
Word = tuple[Factor, ...]
Traces = tuple[Word, ...]
Key = tuple[Traces, Word]
"""Of a term: the words whose traces are multiplied, and the word outside them."""
Terms = dict[Key, Fraction]
UNITY = Fraction(1)


def _order(word: Word) -> tuple[int, tuple[tuple[str, bool], ...]]:
    return len(word), tuple((letter.name, bar) for letter, bar in word)


def row_dim(factor: Factor) -> Dim:
    """The number of rows of a factor: of a barred letter, its columns."""
    return factor[0].cols if factor[1] else factor[0].rows


def col_dim(factor: Factor) -> Dim:
    """The number of columns of a factor: of a barred letter, its rows."""
    return factor[0].rows if factor[1] else factor[0].cols


def transpose_word(word: Word) -> tuple[int, Word]:
    """The sign and the word of the transpose, ``(x y)‾ = ȳ x̄``; skew letters leave the sign."""
    sign = 1
    factors: list[Factor] = []
    for letter, bar in reversed(word):
        if letter.symmetry:
            sign *= letter.symmetry
            factors.append((letter, False))
        else:
            factors.append((letter, not bar))
    return sign, tuple(factors)


def rotations(word: Word) -> Iterator[Word]:
    """The cyclic shifts of a word."""
    for k in range(len(word)):
        yield word[k:] + word[:k]


@lru_cache(2**14)
def canonical_trace(word: Word) -> tuple[int, Word]:
    """The sign and the least word of ``Tr word`` among those of equal or opposite trace; sign 0
    when it vanishes."""
    if len(word) == 1 and (word[0][0].traceless or word[0][0].symmetry < 0):
        return 0, ()
    best = min(rotations(word), key=_order)
    sign, opposite = transpose_word(word)
    other = min(rotations(opposite), key=_order)
    if other == best:
        return (1, best) if sign > 0 else (0, ())
    return (1, best) if _order(best) < _order(other) else (sign, other)


def _cut(word: Word) -> tuple[list[Word], Word]:
    """The scalars of a word, which is split where the inner dimension is 1, and the word that is
    left."""
    pieces: list[Word] = []
    start = 0
    for k in range(1, len(word) + 1):
        if k == len(word) or row_dim(word[k]) == 1:
            pieces.append(word[start:k])
            start = k
    scalars = [p for p in pieces if row_dim(p[0]) == 1 == col_dim(p[-1])]
    rest = tuple(f for p in pieces if not (row_dim(p[0]) == 1 == col_dim(p[-1])) for f in p)
    return scalars, rest


def _cut_cycle(word: Word) -> list[Word]:
    """The scalars whose product is ``Tr word``."""
    for k, factor in enumerate(word):
        if row_dim(factor) == 1:
            return _cut(word[k:] + word[:k])[0]
    return [word]


def _collect(items: Iterable[tuple[Fraction, list[Word], Word]]) -> Terms:
    """The canonical terms of a sum; each item is coefficient, words under a trace, open word."""
    total: Terms = {}
    for coefficient, traced, word in items:
        scalars, rest = _cut(word)
        monomial: list[Word] = []
        for cycle in [part for w in traced for part in _cut_cycle(w)] + scalars:
            sign, canonical = canonical_trace(cycle)
            if sign < 0:
                coefficient = -coefficient
            elif not sign:
                break
            monomial.append(canonical)
        else:
            key = (tuple(sorted(monomial, key=_order)), rest)
            total[key] = total[key] + coefficient if key in total else coefficient
    return {key: c for key, c in total.items() if c}


Lineage = frozenset[str]
NONE: Lineage = frozenset()


@dataclass(frozen=True, slots=True, eq=False)
class Expr:
    """A sum of words of one shape, rows × cols; immutable, comparable, not hashable.

    ``lineage``: marks of what it was made from, which every operation hands on; equality and
    arithmetic do not see it.
    """

    rows: Dim
    cols: Dim
    terms: Terms
    lineage: Lineage = NONE

    def marked(self, *marks: str) -> Expr:
        """The same expression with these marks, and no others, as its lineage."""
        return Expr(self.rows, self.cols, self.terms, frozenset(marks))

    def like(self, terms: Terms) -> Expr:
        """An expression of the same shape and lineage with other terms."""
        return Expr(self.rows, self.cols, terms, self.lineage)

    def of(self, *others: Expr) -> Expr:
        """The same expression, its lineage extended by that of others."""
        lineage = self.lineage.union(*(x.lineage for x in others))
        return Expr(self.rows, self.cols, self.terms, lineage)

    @property
    def is_scalar(self) -> bool:
        """Is the shape 1 × 1?"""
        return self.rows == 1 == self.cols

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Expr):
            return NotImplemented
        if not self.terms and not other.terms:
            return True
        return (self.rows, self.cols) == (other.rows, other.cols) and self.terms == other.terms

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: Expr) -> Expr:
        if (self.rows, self.cols) != (other.rows, other.cols):
            raise ValueError(
                f"shapes {self.rows}×{self.cols} and {other.rows}×{other.cols} do not add"
            )
        total = dict(self.terms)
        for key, c in other.terms.items():
            total[key] = total[key] + c if key in total else c
        lineage = _both(self.lineage, other.lineage)
        return Expr(self.rows, self.cols, {k: c for k, c in total.items() if c}, lineage)

    def __neg__(self) -> Expr:
        return self.like({k: -c for k, c in self.terms.items()})

    def __sub__(self, other: Expr) -> Expr:
        return self + (-other)

    def __mul__(self, other: Expr | int | Fraction) -> Expr:
        if not isinstance(other, Expr):
            q = Fraction(other)
            return self.like({k: c * q for k, c in self.terms.items() if q})
        if not self.is_scalar and not other.is_scalar and self.cols != other.rows:
            raise ValueError(
                f"shapes {self.rows}×{self.cols} and {other.rows}×{other.cols} do not multiply"
            )
        rows, cols = (self.rows, other.cols)
        if self.is_scalar:
            rows, cols = other.rows, other.cols
        elif other.is_scalar:
            rows, cols = self.rows, self.cols
        items = (
            (c1 * c2, [*m1, *m2], w1 + w2)
            for (m1, w1), c1 in self.terms.items()
            for (m2, w2), c2 in other.terms.items()
        )
        return Expr(rows, cols, _collect(items), _both(self.lineage, other.lineage))

    def __rmul__(self, other: int | Fraction) -> Expr:
        return self * other

    @property
    def bar(self) -> Expr:
        """The transpose of the expression, written with a bar in the paper."""
        items = []
        for (traces, word), c in self.terms.items():
            sign, turned = transpose_word(word)
            items.append((c * sign, list(traces), turned))
        return Expr(self.cols, self.rows, _collect(items), self.lineage)

    def letters(self) -> set[Letter]:
        """The letters that occur, plain or barred, inside or outside a trace."""
        found: set[Letter] = set()
        for traces, word in self.terms:
            for w in (*traces, word):
                found.update(letter for letter, _ in w)
        return found


def _both(a: Lineage, b: Lineage) -> Lineage:
    return a | b if a and b and a is not b else a or b


def word(*letters: Letter) -> Expr:
    """The product of letters, plain, as an expression."""
    product = Expr(letters[0].rows, letters[0].cols, _collect([_single(letters[0])]))
    for letter in letters[1:]:
        product = product * Expr(letter.rows, letter.cols, _collect([_single(letter)]))
    return product


def _single(letter: Letter) -> tuple[Fraction, list[Word], Word]:
    return Fraction(1), [], ((letter, False),)


def zero(rows: Dim = 1, cols: Dim = 1) -> Expr:
    """The zero of a shape, rows × cols."""
    return Expr(rows, cols, {})


def number(value: int | Fraction) -> Expr:
    """A rational number as a 1 × 1 expression."""
    return Expr(1, 1, {((), ()): Fraction(value)} if value else {})


def scalar_of(traces: Traces, times: Fraction = UNITY) -> Expr:
    """The product of traces of words, in their canonical form and order, times a number."""
    return Expr(1, 1, {(traces, ()): times})


def one(n: Dim) -> Expr:
    """The identity matrix of size n."""
    return Expr(n, n, {((), ()): Fraction(1)})


def trace(e: Expr) -> Expr:
    """The trace ``Tr e`` of a square expression, ``ValueError`` for any other; that of 1 is its
    size."""
    if e.rows != e.cols:
        raise ValueError(f"no trace of a {e.rows}×{e.cols} expression")
    size = Fraction(e.rows) if isinstance(e.rows, int) else None
    items: list[tuple[Fraction, list[Word], Word]] = []
    for (traces, w), c in e.terms.items():
        if w:
            items.append((c, [*traces, w], ()))
        elif size is not None:
            items.append((c * size, list(traces), ()))
        else:
            items.append((c, [*traces, ((Letter(str(e.rows)), False),)], ()))
    return Expr(1, 1, _collect(items), e.lineage)


def inner(a: Expr, b: Expr, metric: Expr | None = None) -> Expr:
    """The scalar ``⟨a, b⟩ = Tr a b̄`` of matrices, ``ā b`` of vectors, with a metric in between if
    there is one."""
    if a.cols == 1:
        return a.bar * b if metric is None else a.bar * metric * b
    return trace(a * b.bar if metric is None else a * metric * b.bar)


def expr_of_word(w: Word) -> Expr:
    """The expression whose only term is a word, not empty."""
    return Expr(row_dim(w[0]), col_dim(w[-1]), _collect([(UNITY, [], w)]))
