"""The algebra of words against plain matrices: every operation, at exact random matrices."""

from fractions import Fraction
from random import Random
from unicodedata import normalize

import pytest

from derive.algebra.calculus import (
    coefficient_of,
    derivation,
    gradient,
    map_terms,
    map_traces,
    reduce,
    substitute,
    terms_with,
    without,
)
from derive.algebra.word_trees import double, fold_double, hat, normal_form, tree_of
from derive.algebra.words import (
    Expr,
    Letter,
    inner,
    number,
    one,
    scalar_of,
    trace,
    word,
    zero,
)
from derive.language import rational as q
from derive.language.show import show

N = 3
A, B = Letter("A", N, N), Letter("B", N, N)
S, K = Letter("S", N, N, symmetry=1), Letter("K", N, N, symmetry=-1)
U, V, W = Letter("u", N), Letter("v", N), Letter("w", N)
M = Letter("m")
LETTERS = (A, B, S, K, U, V, W, M)


def printed(e):
    return show(tree_of(e))


def values(seed):
    random = Random(seed)
    table = {}
    for x in LETTERS:
        m = [[Fraction(random.randint(-9, 9)) for _ in range(x.cols)] for _ in range(x.rows)]
        if x.symmetry:
            m = q.plus(q.matrix(m), q.scaled(x.symmetry, q.transposed(q.matrix(m))))
        table[x] = q.matrix(m)
    for x in (U, V, W):
        (a,), (b,), (c,) = table[x]
        table[hat(x)] = ((0, -c, b), (c, 0, -a), (-b, a, 0))
    return table


def product_of(w, table):
    result = None
    for letter, bar in w:
        m = q.transposed(table[letter]) if bar else table[letter]
        result = m if result is None else q.times(result, m)
    return result


def value(e: Expr, table):
    """The matrix of an expression, by multiplying its words out."""
    total = None
    for (traces, w), c in e.terms.items():
        for cycle in traces:
            c = c * q.trace(product_of(cycle, table))
        m = product_of(w, table) if w else q.identity(e.rows)
        total = q.scaled(c, m) if total is None else q.plus(total, q.scaled(c, m))
    return total if total is not None else q.scaled(0, q.matrix([[1] * e.cols] * e.rows))


def random_expression(random, rows, cols, depth=3):
    """A random expression of a shape, built with every operation."""
    square = [A, B, S, K]
    if (rows, cols) == (1, 1):
        kind = random.randrange(3) if depth else 2
        if kind == 0:
            return trace(random_expression(random, N, N, depth - 1))
        if kind == 1:
            a, b = (random_expression(random, N, 1, depth - 1) for _ in range(2))
            return inner(a, b)
        return word(M) * random.randint(-3, 3)
    if cols == 1:
        if depth and random.random() < 0.7:
            left = random_expression(random, N, N, depth - 1)
            return left * word(random.choice([U, V, W]))
        return word(random.choice([U, V, W]))
    kind = random.randrange(5) if depth else 4
    a = random_expression(random, N, N, depth - 1) if kind < 4 else word(random.choice(square))
    if kind == 0:
        return a * random_expression(random, N, N, depth - 1)
    if kind == 1:
        return a + random_expression(random, N, N, depth - 1)
    if kind == 2:
        return a.bar
    if kind == 3:
        return random_expression(random, 1, 1, depth - 1) * a
    return a


@pytest.mark.parametrize("seed", range(40))
def test_operations_agree_with_matrices(seed):
    random, table = Random(seed), values(seed)
    a, b = (random_expression(random, N, N) for _ in range(2))
    v = random_expression(random, N, 1)
    assert value(a * b, table) == q.times(value(a, table), value(b, table))
    assert value(a + b, table) == q.plus(value(a, table), value(b, table))
    assert value(a - b, table) == q.minus(value(a, table), value(b, table))
    assert value(a.bar, table) == q.transposed(value(a, table))
    assert value(trace(a), table) == ((q.trace(value(a, table)),),)
    assert value(a * v, table) == q.times(value(a, table), value(v, table))


@pytest.mark.parametrize("seed", range(20))
def test_equal_values_have_equal_forms(seed):
    """Canonical forms decide equality: identities of the trace come out as equality of maps."""
    random = Random(seed)
    a, b, c = (random_expression(random, N, N, 2) for _ in range(3))
    assert trace(a * b * c) == trace(c * a * b)
    assert trace(a * b) == trace(b.bar * a.bar)
    assert (a * b).bar == b.bar * a.bar
    assert a * (b + c) - a * b - a * c == zero(N, N)
    u = word(U)
    assert inner(a * u, u) == trace(a * u * u.bar)


def test_letters_with_symmetry():
    k, s = word(K), word(S)
    assert k.bar == -k
    assert s.bar == s
    assert trace(k) == number(0)
    assert trace(k * s) == number(0)
    assert trace(s * k * s * s) == number(0)
    assert trace(word(Letter("Z", N, N, traceless=True))) == number(0)
    assert trace(one(N)) == number(3)
    assert printed(trace(one("n"))) == "n"


@pytest.mark.parametrize("seed", range(20))
def test_derivation_is_the_directional_derivative(seed):
    random, table = Random(seed), values(seed)
    e = random_expression(random, 1, 1, 3)
    varied = derivation(e, {A: word(B), U: word(V)}.get)
    # a polynomial in h of degree < 9: its derivative at 0 from exact values at 9 points
    points = [Fraction(h) for h in range(-4, 5)]
    samples = []
    for h in points:
        moved = dict(table)
        moved[A] = q.plus(table[A], q.scaled(h, table[B]))
        moved[U] = q.plus(table[U], q.scaled(h, table[V]))
        samples.append(value(e, moved)[0][0])
    powers = q.matrix([[h**k for k in range(9)] for h in points])
    coefficients = q.solve(powers, tuple((x,) for x in samples))
    assert value(varied, table)[0][0] == coefficients[1][0]


@pytest.mark.parametrize("seed", range(20))
def test_gradient_and_substitution(seed):
    random, table = Random(seed), values(seed)
    a = random_expression(random, N, N, 2)
    a = substitute(a, {A: word(B), U: word(V)})
    e = trace(a * word(A)) + inner(a * word(V), word(U))
    assert inner(gradient(e, A), word(A)) + inner(gradient(e, U), word(U)) == e
    image = word(B) * word(S)
    moved = dict(table)
    moved[A] = value(image, table)
    assert value(substitute(e, {A: image}), table) == value(e, moved)


def test_coefficients_and_terms():
    """e = M v + (terms without v), also where v stands in a scalar; and so for a scalar letter."""
    u, v, w, m = (word(x) for x in (U, V, W, M))
    rest = inner(u, w) * w + m * u
    e = m * (word(A) * v) + inner(v, w) * u + 2 * (word(S) * v) + rest
    matrix = coefficient_of(e, V)
    assert matrix == m * word(A) + u * w.bar + 2 * word(S)
    assert matrix * v + without(e, V) == e
    assert terms_with(e, V) == matrix * v
    assert without(e, V) == rest
    assert m * coefficient_of(e, M) + without(e, M) == e


def test_terms_and_traces_are_mapped():
    e = trace(word(A) * word(B)) * word(A) + word(M) * word(S)
    again = map_terms(e, lambda traces, w, c: e.like({(traces, w): 2 * c}))
    assert again == 2 * e
    assert map_traces(e, lambda cycle: scalar_of((cycle,))) == e
    assert map_traces(e, lambda cycle: number(len(cycle))) == 2 * word(A) + word(S)
    assert map_terms(e, lambda traces, w, c: scalar_of(traces, c), zero()) == (
        trace(word(A) * word(B)) + word(M)
    )


def test_gradient_of_a_skew_letter_is_skew():
    g = gradient(trace(word(A) * word(K)), K)
    assert g == -g.bar
    assert inner(g, word(K)) == trace(word(A) * word(K))


@pytest.mark.parametrize("seed", range(10))
def test_vector_product_rules(seed):
    table = values(seed)
    u, v, w = word(U), word(V), word(W)
    ju, jv, jw = word(hat(U)), word(hat(V)), word(hat(W))
    assert normal_form(ju * v + jv * u) == zero(N, 1)
    assert normal_form(ju * u) == zero(N, 1)
    jacobi = ju * jv * w + jv * jw * u + jw * ju * v
    assert normal_form(jacobi) == zero(N, 1)
    assert normal_form(inner(ju * v, w) - inner(jv * w, u)) == number(0)
    for e in (ju * jv * w, jw * word(S) * ju * v, ju * jv * jw):
        assert value(normal_form(e), table) == value(e, table)
    twice = ju * jv * w * 2 + jw * ju * w - ju * v
    folded = fold_double(normal_form(twice))
    assert value(folded, table) == value(twice, table)
    assert len(folded.terms) == 3
    assert reduce(ju * jv, double) == v * u.bar - inner(u, v) * one(N)


def test_shapes_are_checked():
    with pytest.raises(ValueError, match="do not multiply"):
        word(U) * word(A)
    with pytest.raises(ValueError, match="do not add"):
        word(U) + word(A)
    with pytest.raises(ValueError, match="no trace"):
        trace(word(U))


def test_prints_as_the_paper():
    n = "n"
    alpha, J = Letter("α", n, n), Letter("J", n, n, symmetry=1)
    tau, c, m = Letter("τ", n), Letter("c", n), Letter("m")
    a, t = word(alpha), word(tau)
    e = Fraction(1, 2) * trace(a * word(J) * a.bar) + inner(a * word(c), t)
    e = e + Fraction(1, 2) * word(m) * inner(t, t)
    assert normalize("NFD", printed(e)) == normalize("NFD", "½ Tr αJᾱ + ⟨αc, τ⟩ + ½m ‖τ‖²")
    assert printed(word(hat(U)) * word(V)) == "u ∧ v"


def test_powers_of_powers_have_brackets():
    assert show(("pow", ("pow", "x", 2), 3)) == "(x²)³"
    assert show(("inv", ("pow", "x", 2))) == "(x²)⁻¹"
    assert show(("pow", ("norm2", "x"), 2)) == "(‖x‖²)²"
