"""Moments of solids: m = ∫ρ dV, c = ∫ρ r dV, J = ∫ρ r r̄ dV, as (36)–(39).

The integrals are of monomials over a reference shape, exact; the sizes enter by stretching it. The
density is uniform, or in an ellipsoid a polynomial in the level s = ⟨r, Q r⟩.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import product
from math import factorial, gcd, lcm, prod
from typing import Any

from ..language import rational
from ..language.derivatives import quotient
from ..language.expression import LARGEST, SMALLEST
from ..language.laurent import LEVEL, Laurent, Monomial, is_layered
from ..language.limits import EXPONENT
from ..language.tree import Tree, add, coefficient, mul
from ..language.values import approximate
from ..schema.body_kinds import LAYERED, Moments, Solid
from ..schema.table import Rows
from .problem import SolidError

Row = tuple[Tree, ...]
SPAN, UNIT, TERMS = range(3), ((1, 0, 0), (0, 1, 0), (0, 0, 1)), 3
TERMS_OF_DENSITY = 40
"""A density that is multiplied out has no more."""


def joined_moments(a: Moments, b: Moments) -> Moments:
    """The moments of two bodies together, sums of theirs."""

    def total(x: Tree, y: Tree) -> Tree:
        return _flat(_terms(x) + _terms(y))

    parts = (((x.m,), x.c, *x.J) for x in (a, b))
    mass, first, *second = (tuple(map(total, *rows)) for rows in zip(*parts, strict=True))
    return Moments(m=mass[0], c=first, J=tuple(second))


def unit_moments(solid: Solid) -> Moments:
    """The moments of density 1 in the solid's own frame; :class:`SolidError`."""
    kind, sizes = solid.kind, solid.sizes
    if kind == "mesh":
        from .mesh import mesh_moments

        return mesh_moments(**sizes)
    integral = _corners(**sizes) if kind == "tetrahedron" else _about_centre(kind, sizes)
    mass, first = _tree(integral()), tuple(_tree(integral(i)) for i in SPAN)
    if coefficient(mass)[0] <= 0:
        raise SolidError(f"the volume of this {kind} is not positive; look at its sizes")
    J = tuple(tuple(_tree(integral(i, j)) for j in SPAN) for i in SPAN)
    return Moments(m=mass, c=first, J=J)


def moments(solid: Solid, relations: bool = True) -> Moments:
    """The moments of a placed solid, from V, f, S of density 1 in its own frame.

    m = ρV, c = ρ(R f + V s), J = R ϱS R̄ + ρ(R f s̄ + s f̄ R̄ + V s s̄), ρ and ϱ the means of the
    density and of that which r r̄ weighs. With ``relations``, cos² + sin² = 1 and (√q)² = q shorten
    J; without, it makes no use of them.
    """
    if "quadric" in solid.sizes:
        return _of_quadric(solid.sizes["quadric"], solid.density)
    own, (density, outer) = unit_moments(solid), means(solid.density, 3)
    R = [[_terms(x, TERMS) for x in row] for row in solid.rotation or UNIT]
    s = [_one(x) for x in solid.shift or (0, 0, 0)]
    V, f = _one(own.m), [_one(x) for x in own.c]
    S = [[_one(x) for x in row] for row in own.J]
    Rf = [sum((R[i][k] * f[k] for k in SPAN), Laurent({})) for i in SPAN]

    def second(i: int, j: int) -> Tree:
        turned = sum((R[i][k] * S[k][h] * R[j][h] for k in SPAN for h in SPAN), Laurent({}))
        J = outer * turned + density * (Rf[i] * s[j] + s[i] * Rf[j] + V * s[i] * s[j])
        return _tree(_related(J) if relations else J)

    return Moments(
        m=_tree(density * V),
        c=tuple(_tree(density * (Rf[i] + V * s[i])) for i in SPAN),
        J=tuple(tuple(second(min(i, j), max(i, j)) for j in SPAN) for i in SPAN),
    )


def means(density: Tree, n: int) -> tuple[Laurent, Laurent]:
    """The means of a density in an ellipsoid of Rⁿ: over its volume, and with the weights r r̄; of a
    uniform one itself.

    ∫ sᵏ dx = V n/(n + 2k), and ∫ r r̄ sᵏ dx = V Q⁻¹/(n + 2 + 2k).
    """
    if not is_layered(density):
        return _one(density), _one(density)

    def mean(n: int) -> Laurent:
        powers = ((k, part * Fraction(n, n + 2 * k)) for k, part in by_levels(density).items())
        return sum((part for _, part in powers), Laurent({}))

    return mean(n), mean(n + 2)


def by_levels(density: Tree) -> dict[int, Laurent]:
    """The coefficients of the powers of the level in a density."""
    found: dict[int, dict[Monomial, Fraction]] = {}
    for m, q in _expanded(density).terms.items():
        rest = tuple(x for x in m if x[0] != LEVEL)
        found.setdefault(dict(m).get(LEVEL, 0), {})[rest] = q
    return {k: Laurent(found[k]) for k in sorted(found)}


def integral_above(density: Tree, *, middle: bool = False) -> Tree:
    """∫ of a density from a level to 1, as a polynomial in the level; or from the ``middle``."""
    total = Laurent({})
    for k, part in by_levels(density).items():
        below = Laurent({}) if middle else Laurent.monomial([(LEVEL, k + 1)])
        total = total + part * (1 - below) * Fraction(1, k + 1)
    return _tree(total)


def _expanded(density: Tree) -> Laurent:
    """A polynomial in the level, multiplied out; what has no level in it is one factor."""
    if not isinstance(density, tuple) or not is_layered(density):
        return _one(density)
    operator, first, *others = density
    if operator == "pow":
        others, operator = [first] * (others[0] - 1), "mul"
    total = _expanded(first)
    for x in others:
        part = _one(("div", 1, x)) if operator == "div" else _expanded(x)
        total = total + part if operator == "add" else total * part
        if len(total.terms) > TERMS_OF_DENSITY:
            raise SolidError("the density has too many terms")
    return total


def _of_quadric(Q: Rows, density: Tree) -> Moments:
    """The moments of ⟨r, Q r⟩ ≤ 1: m = ρωₙ/√det Q, ωₙ the unit ball, and J = m/(n + 2) Q⁻¹, by the
    means of the density."""
    n, entries = len(Q), [[_terms(x) for x in row] for row in Q]
    span, (inner, outer) = range(n), means(density, n)
    det = _tree(_determinant(entries))
    root = rational.root(det) if isinstance(det, (int, Fraction)) else None
    volume = _ball(*(0 for _ in span)) * _one(("div", 1, root or ("fun", "sqrt", det)))
    weighed = outer * volume

    def second(i: int, j: int) -> Tree:
        left = [row[:j] + row[j + 1 :] for k, row in enumerate(entries) if k != i]
        cofactor = _determinant(left)
        share = _one(("div", _tree(cofactor), det)) * Fraction((-1) ** (i + j), n + 2)
        return _tree(weighed * share) if cofactor.terms else 0

    return Moments(
        m=_tree(inner * volume),
        c=(0,) * n,
        J=tuple(tuple(second(min(i, j), max(i, j)) for j in span) for i in span),
    )


def quadric_about_origin(solid: Solid, n: int) -> Tree | None:
    """Q of a solid that is ⟨r, Q r⟩ ≤ 1, of one that is turned (R diag(a²) R̄)⁻¹; ``None`` of
    another."""
    if solid.kind not in LAYERED or any(x != 0 for x in solid.shift or ()):
        return None
    span = range(n)
    if "quadric" in solid.sizes:
        return ("matrix", *(("row", *row) for row in solid.sizes["quadric"]))
    turned = solid.rotation if solid.kind == "ellipsoid" else None
    axes = solid.sizes["semi_axes"] if solid.kind == "ellipsoid" else (solid.sizes["radius"],) * n
    if turned is None:
        entries = (quotient(1, ("pow", a, 2)) for a in axes)
        return (
            "matrix",
            *(("row", *(0,) * i, x, *(0,) * (n - 1 - i)) for i, x in enumerate(entries)),
        )
    R = [[_terms(x, TERMS) for x in row] for row in turned]
    squares = [_one(("pow", a, 2)) for a in axes]

    def entry(i: int, j: int) -> Tree:
        return _tree(sum((R[i][k] * R[j][k] * squares[k] for k in span), Laurent({})))

    rows = (("row", *(entry(max(i, j), min(i, j)) for j in span)) for i in span)
    return ("inv", ("matrix", *rows))


def _determinant(m: Sequence[Sequence[Laurent]]) -> Laurent:
    """By expansion along the first row; 1 of none."""
    if not m:
        return _one(1)
    terms = (
        x * (-1) ** k * _determinant([[*row[:k], *row[k + 1 :]] for row in m[1:]])
        for k, x in enumerate(m[0])
        if x.terms
    )
    return sum(terms, Laurent({}))


def fault_of_quadric(Q: Rows, values: Mapping[str, float], whose: str = "") -> str:
    """Why ⟨r, Q r⟩ ≤ 1 is no ellipsoid, "" where it may be one: Q is symmetric, and positive
    definite where the ``values`` of parameters, which are ``whose``, tell it."""
    span = range(len(Q))
    if any(Q[i][j] != Q[j][i] for i in span for j in range(i)):
        return "the matrix of an ellipsoid must be symmetric"
    found = [[approximate(x, values) for x in row] for row in Q]
    numbers = [[Fraction(x) for x in row if x is not None] for row in found]
    if any(len(row) < len(Q) for row in numbers):
        return ""
    if rational.definite(rational.matrix(numbers)):
        return ""
    return f"the matrix of an ellipsoid must be positive definite{f' for {whose}' * bool(values)}"


def rotation_about(axis: Row, angle: Tree) -> tuple[Row, ...]:
    """The rotation by ``angle`` about an axis, 3 × 3, by Rodrigues' formula.

    1 cos φ + (1 − cos φ) n n̄ + j(n) sin φ, n the axis over its length. ``SolidError`` unless the
    axis is three numbers, not all zero; any length will do.
    """
    numbers = [Fraction(x) for x in axis if isinstance(x, (int, Fraction))]
    if len(axis) != 3 or len(numbers) != 3 or not any(numbers):
        raise SolidError("the axis of a rotation must be three numbers, not all zero")
    square = sum((x * x for x in numbers), Fraction(0))
    length = _one(rational.root(square) or ("fun", "sqrt", mul(square)))
    n = [length * (x / square) for x in numbers]
    q, rest = coefficient(angle)  # the cosine and sine of k π/2 are numbers
    if q == 0 or (rest == "π" and (2 * q).denominator == 1):
        cos, sin = (_one((1, 0, -1, 0)[(int(2 * q) + k) % 4]) for k in (0, 3))
    else:
        cos, sin = _one(("fun", "cos", angle)), _one(("fun", "sin", angle))

    def entry(i: int, j: int) -> Tree:
        side = Laurent({}) if i == j else n[3 - i - j] * (1 if (i - j) % 3 == 1 else -1)
        nn = _related(n[i] * n[j])
        return _flat(cos * UNIT[i][j] + nn + nn * cos * -1 + side * sin)

    return tuple(tuple(entry(i, j) for j in SPAN) for i in SPAN)


def rotation_by_angles(roll: Tree, pitch: Tree, yaw: Tree) -> tuple[Row, ...]:
    """R = R_z(yaw) R_y(pitch) R_x(roll), 3 × 3, of three angles in radians."""
    z, y, x = (rotation_about(e, a) for e, a in zip(UNIT[::-1], (yaw, pitch, roll), strict=True))
    return product_of(z, product_of(y, x))


def rotation_of_quaternion(q: Row) -> tuple[Row, ...]:
    """The rotation of a quaternion, scalar first, of any length: for q = (s, v), by s, v over |q|,
    (s² − |v|²) 1 + 2 v v̄ + 2 s j(v).  ``SolidError`` unless it is four numbers, not all zero."""
    numbers = [Fraction(x) for x in q if isinstance(x, (int, Fraction))]
    if len(numbers) != 4 or not any(numbers):
        raise SolidError("a quaternion must be four numbers, scalar first, not all zero")
    s, *v = numbers
    square = sum((x * x for x in numbers), Fraction(0))

    def entry(i: int, j: int) -> Fraction:
        if i == j:
            return (s * s + 2 * v[i] ** 2 - sum((x * x for x in v), Fraction(0))) / square
        side = v[3 - i - j] * (1 if (i - j) % 3 == 1 else -1)
        return 2 * (v[i] * v[j] + s * side) / square

    return tuple(tuple(entry(i, j) for j in SPAN) for i in SPAN)


def product_of(a: Rows, b: Rows) -> tuple[Row, ...]:
    """The product of two square matrices of one size, multiplied out."""
    span = range(len(a))

    def entry(i: int, j: int) -> Tree:
        return _flat(sum((_terms(a[i][k]) * _terms(b[k][j]) for k in span), Laurent({})))

    return tuple(tuple(entry(i, j) for j in span) for i in span)


# ∫ xᵃ yᵇ zᶜ dV over a reference shape

Integrals = Callable[..., Laurent]


def _gamma(n: int) -> tuple[Fraction, int]:
    """Γ(n/2) = q √π^k, as (q, k)."""
    if n <= 2:
        return Fraction(1), n % 2
    q, k = _gamma(n - 2)
    return q * Fraction(n - 2, 2), k


def _ball(*exponents: int) -> Laurent:
    """∫ Π xᵢ^aᵢ over the unit ball: Π Γ((aᵢ + 1)/2) / Γ(1 + Σ (aᵢ + 1)/2) (Dirichlet)."""
    if any(a % 2 for a in exponents):
        return Laurent({})
    tops = [_gamma(a + 1) for a in exponents]
    q, k = _gamma(2 + sum(exponents) + len(exponents))
    power = (sum(x for _, x in tops) - k) // 2
    return Laurent.monomial([("π", power)], prod((x for x, _ in tops), start=Fraction(1)) / q)


def _simplex(*a: int) -> Fraction:
    """∫ λ₀ᵃ λ₁ᵇ … = a! b! … / (a + b + … + d)! over the simplex with corners 0, e₁, …, e_d."""
    return Fraction(prod(map(factorial, a)), factorial(sum(a) + len(a) - 1))


ROUND = ("radius", "radius", "height")
SHAPES: dict[str, tuple[Integrals, tuple[str, ...]]] = {
    "ball": (_ball, ("radius",) * 3),
    "ellipsoid": (_ball, ("semi_axes",)),
    "box": (lambda *e: prod(map(_ball, e), start=_one(Fraction(1, 2 ** (sum(e) + 3)))), ("sides",)),
    "cylinder": (lambda a, b, c: _ball(a, b) * _ball(c) * Fraction(1, 2 ** (c + 1)), ROUND),
    "cone": (lambda a, b, c: _ball(a, b) * _simplex(a + b + 2, c), ROUND),  # at z the disc 1 − z
}
"""Kind → ∫ xᵃ yᵇ zᶜ dV over the reference shape, and the sizes that stretch it along x, y, z."""


def _about_centre(kind: str, sizes: Mapping[str, Any]) -> Integrals:
    """The integrals of 1, r_i, r_i r_j over a stretched shape, as functions of the axes i, j."""
    if kind == "hollow_ball":
        outer, inner = (_about_centre("ball", {"radius": sizes[k]}) for k in ("outer", "inner"))
        return lambda *axes: outer(*axes) + inner(*axes) * -1
    reference, names = SHAPES[kind]
    scales = [sizes[name] for name in names] if len(names) == 3 else sizes[names[0]]

    def integral(*axes: int) -> Laurent:
        powers = [axes.count(i) for i in SPAN]
        stretch = (("pow", s, a + 1) for s, a in zip(scales, powers, strict=True))
        return reference(*powers) * _one(("mul", *stretch))

    return integral


def _corners(vertices: Sequence[Row]) -> Integrals:
    """The integrals over a tetrahedron: the simplex mapped by λ ↦ Σ λ_k v_k, of determinant D.

    D is taken positive where numbers tell its sign, or where every parameter being positive does;
    elsewhere the vertices must be given in an order that makes it positive.
    """
    p = [[_one(x) for x in vertex] for vertex in vertices]
    x, y, z = ([v[i] + p[0][i] * -1 for i in SPAN] for v in p[1:])
    signed = (x[i] * y[(i + s) % 3] * z[(i - s) % 3] * s for i in SPAN for s in (1, -1))
    D = sum(signed, Laurent({}))
    D = D * -1 if all(q < 0 for q in D.terms.values()) else D
    volume = _one(_tree(D))

    def integral(*axes: int) -> Laurent:
        corners = product(range(4), repeat=len(axes))
        weights = ((c, _one(_simplex(*map(c.count, range(4))))) for c in corners)
        terms = (prod((p[k][i] for k, i in zip(c, axes, strict=True)), start=w) for c, w in weights)
        return volume * _one(_tree(sum(terms, Laurent({}))))

    return integral


def _one(tree: Tree) -> Laurent:
    """A tree as one monomial: products, quotients, powers taken apart, a sum is one factor."""
    factors: list[tuple[Any, int]] = []
    q, stack = Fraction(1), [(tree, 1)]
    while stack:
        t, k = stack.pop()
        if abs(k) > EXPONENT:
            raise SolidError(f"the moments need a power above {EXPONENT}")
        match t:
            case int() | Fraction():
                q *= Fraction(t) ** k
            case ("mul", *parts):
                stack += [(x, k) for x in parts]
            case ("div", a, b):
                stack += [(a, k), (b, -k)]
            case ("pow", a, int(n)):
                stack.append((a, k * n))
            case _:
                factors.append((t, k))
    return Laurent.monomial(factors, q)


def _terms(tree: Tree, most: int | None = None) -> Laurent:
    """A tree as a sum of monomials, if it has no more terms than ``most``; else as one."""
    if isinstance(tree, tuple) and tree[0] == "add" and len(tree) - 1 <= (most or len(tree)):
        return sum(map(_one, tree[1:]), Laurent({}))
    return _one(tree)


def _related(p: Laurent) -> Laurent:
    """The polynomial reduced by (√q)² = q, and by cos² + sin² = 1 where both terms are there."""
    squares = ((m, q, atom) for m, q in p.terms.items() for atom, k in m if k >= 2)
    for m, q, atom in squares:
        if isinstance(atom, tuple) and atom[0] == "fun":
            _, name, inside = atom
            rest = Laurent.monomial((*m, (atom, -2)), q)
            if name == "sqrt" and not isinstance(inside, (str, tuple)):
                return _related(p + Laurent({m: -q}) + rest * inside)
            partner = rest * _one(("pow", ("fun", "sin", inside), 2))
            if name == "cos" and partner.terms.keys() <= p.terms.keys():
                return _related(p + Laurent({m: -q}) + rest + partner * -1)
    return p


def _flat(p: Laurent) -> Tree:
    """A polynomial as a tree, term by term."""
    return add(*(_term(m, q) for m, q in p.terms.items()))


def _tree(p: Laurent) -> Tree:
    """A polynomial as a tree, what its terms have in common in front."""
    if len(p.terms) < 2:
        return _flat(p)
    over, under = ([getattr(q, x) for q in p.terms.values()] for x in ("numerator", "denominator"))
    content = Fraction(gcd(*over) if over[0] > 0 else -gcd(*over), lcm(*under))
    columns = {a: [dict(m).get(a, 0) for m in p.terms] for a, _ in next(iter(p.terms))}
    common = {a: min(k) if min(k) > 0 else min(max(k), 0) for a, k in columns.items()}
    inside = p * Laurent.monomial(((a, -k) for a, k in common.items()), 1 / content)
    return _term((*((a, k) for a, k in common.items() if k), (_flat(inside), 1)), content)


def _term(m: Monomial, q: Fraction) -> Tree:
    """A monomial as a tree: numbers, π, low powers, high powers, sums; over the negative powers."""
    if not SMALLEST < abs(q) < LARGEST or any(abs(k) > EXPONENT for _, k in m):
        raise SolidError(f"the moments need a power above {EXPONENT} or a number beyond 1e±300")

    def place(factor: tuple[Tree, int]) -> tuple[bool, bool, int, str]:
        t, k = factor
        return t != "π", isinstance(t, tuple) and t[0] == "add", k, repr(t)

    ordered = sorted(m, key=place)
    top, bottom = (
        mul(x, *(a if k == s else ("pow", a, s * k) for a, k in ordered if s * k > 0))
        for s, x in ((1, q), (-1, 1))
    )
    return top if bottom == 1 else ("div", top, bottom)
