"""How large the degree of a claim is, as a rational function of the random parameters.

Both sides of an equation are rational functions of the parameters of the random point.  A name has
a numerator degree and a denominator: powers of a few fixed polynomials (the Cayley determinant, the
determinant of the kinetic metric, the mass).  Sums go over the least common denominator, so the
bound stays small; it is what Schwartz–Zippel asks for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..algebra.tree import OPERATORS, Tree
from ..record.record import Equation, decode
from .arithmetic import LARGEST_POWER
from .draws import SPARE
from .heads import SHARED


@dataclass(frozen=True)
class Degree:
    """Numerator degree over  Π poly^power; ``den``: a polynomial's (name, degree) → power."""

    num: int
    den: tuple[tuple[tuple[str, int], int], ...] = ()

    @property
    def denominator(self) -> int:
        """The degree of the denominator."""
        return sum(p[1] * k for p, k in self.den)

    def __mul__(self, other: Degree) -> Degree:
        powers = dict(self.den)
        for p, k in other.den:
            powers[p] = powers.get(p, 0) + k
        return Degree(self.num + other.num, tuple(sorted(powers.items())))

    def __pow__(self, n: int) -> Degree:
        return Degree(self.num * n, tuple((p, k * n) for p, k in self.den))

    def __add__(self, other: Degree) -> Degree:
        powers = dict(self.den)
        for p, k in other.den:
            powers[p] = max(powers.get(p, 0), k)
        den = tuple(sorted(powers.items()))
        whole = sum(p[1] * k for p, k in den)
        lifted = (x.num + whole - x.denominator for x in (self, other))
        return Degree(max(lifted), den)

    def inverse(self, size: int, tag: str) -> Degree:
        """The inverse of a matrix of this degree, by cofactors; its determinant is a polynomial."""
        whole = (f"det {tag}", self.num * size)
        return Degree(self.num * max(size - 1, 0), ((whole, 1),)) * Degree(self.denominator)


COPIES = ("copies of a point", 1)
"""What divides the mass of a point and the force on it, where all copies of it have one together;
a sum over the points has that of each of them."""

MOMENTS = 12
"""Times n: the degree of a body of points among which some make J diagonal (4 n) of cubes."""


def bound(
    equation: Equation, group: Group, problem: Mapping[str, Any], *, principal: bool = False
) -> int:
    """The degree of the numerator of  lhs − rhs; ``principal``: for a body with diagonal J."""
    least = MOMENTS * group.n if principal else 1
    table = _table(group, max(least, body_degree(problem)))
    count, body = point_count(group, problem), problem.get("body", {})
    quotients = principal or body.get("kind") == "given"
    table |= {"points": Degree(count), "quotients": Degree(count if quotients else 1)}
    total = _degree(equation.lhs, table, group) + _degree(equation.rhs, table, group)
    return total.num + total.denominator


def body_degree(problem: Mapping[str, Any]) -> int:
    """The largest degree of a mass, a coordinate or a coefficient of a force in the parameters.

    A body of given moments is realised by points, some anywhere, the others with masses and places
    that are quotients of minors of the n × n moments that are left: 4 n times the degree of these,
    cubes where the moments are none, is more than enough.
    """
    body = problem.get("body", {})
    forces = [problem.get(key, []) for key in ("potentials", "places", "damping")]
    own = max([1, *map(_size, _trees([body.get("points", []), *forces]))])
    given = [*map(_size, _trees([body.get("given", []), body.get("solids", [])]))]
    n = len(body.get("given", {}).get("c", ()))
    return max([own, 4 * n * max([3, *given])])


def point_count(group: Group, problem: Mapping[str, Any]) -> int:
    """At least as many as the points of a model: listed ones and some more of any moments."""
    listed = len(problem.get("body", {}).get("points", [])) + len(problem.get("places", []))
    return listed + 2 * group.n + 1 + SPARE


def _trees(data: Any) -> Iterator[Tree]:
    """The expressions anywhere in the data of a problem: operator lists; names are words there."""
    if isinstance(data, dict):
        for x in data.values():
            yield from _trees(x)
    elif isinstance(data, list) and data and isinstance(data[0], str) and data[0] in OPERATORS:
        yield decode(data, "problem")
    elif isinstance(data, list):
        for x in data:
            yield from _trees(x)


FUNCTION = 8
"""More than the degree of a function and its first three derivatives in its unknown value."""


def _size(t: Tree) -> int:
    """A bound on numerator plus denominator degree of an expression of parameters."""
    if not isinstance(t, tuple):
        return int(t == "π")
    if t[0] == "par":
        return 1
    if t[0] == "pow":
        return int(_size(t[1]) * abs(int(t[2])))
    own = FUNCTION if t[0] == "fun" else 0
    return own + sum(_size(x) for x in t[1:])


def digits(t: Tree) -> int:
    """About how many bits the numbers written in a tree have together once it is evaluated."""
    if isinstance(t, (int, Fraction)):
        return abs(t.numerator).bit_length() + t.denominator.bit_length()
    if not isinstance(t, tuple):
        return 0
    if t[0] == "pow":
        return digits(t[1]) * abs(int(t[2]))
    return sum(digits(x) for x in t[1:])


ALGEBRA = (
    *("Z", "w", "ξ", "ξ′", "η", "η′", "δZ", "δ′Z", "δw", "δ′w"),
    *("ζ", "Ω", "Ω′", "δζ", "δ′ζ", "u", "f_u"),
)
"""Names whose entries are drawn at random."""


def _table(group: Group, body: int) -> dict[str, Degree]:
    """Degrees of the names, from the degrees of mass, place, group element and algebra element."""
    d = group.dimension
    A = Degree(group.sampler.degree, group.sampler.denominators)
    mass = place = Degree(body)
    one = Degree(1)
    velocity, variation = A * one, A * one * one
    J = mass * place * place
    force = (A * place + one) * (A * place + one) * (A * place + one) * place
    entry = A * A * J
    metric = (("metric", entry.num * d), 1)
    covector = entry * one * one + force * A * place + one
    solved = Degree(entry.num * (d - 1) + covector.num, ((metric[0], 1), *covector.den))
    twice = solved * one + one * one
    energy = mass * velocity * velocity * place * place + force * place
    scalars = {"t": one, "δt": one, "δ′t": one, "m": mass, "c": mass * place, "J": J}
    group_names = {"A": A, "T": one, "Ȧ": velocity, "Ṫ": velocity, "C": A * A}
    group_names |= dict.fromkeys(("α", "τ"), velocity)
    algebra = dict.fromkeys(ALGEBRA, one)
    spatial = dict.fromkeys(["δA", "δ′A", "δT", "δ′T", "δα", "δ′α", "δτ", "δ′τ"], variation)
    forces = dict.fromkeys(["N", "F", "N_b", "F_b", "μ", "γ", "K", "k", "s"], force * A)
    centre = Degree(mass.num + place.num, ((("mass of a factor", mass.num), 1),))
    motion = dict.fromkeys(["Ż", "ẇ", "ζ̇", "f", "φ"], solved) | {"ψ": solved * centre}
    motion |= dict.fromkeys(("α̇", "τ̇", "F̃"), A * twice)
    energies = dict.fromkeys(["L", "L̃", "U", "Ũ", "h̃"], energy)
    inertia = {
        "I": J,
        **dict.fromkeys(("I_c", "J_c"), J + Degree(2 * J.num, ((("mass", mass.num), 2),))),
    }
    momentum = A * A * J * one
    motion |= dict.fromkeys(("Π", "p_b", "δΠ", "δp_b", "δ′Π", "δ′p_b", "ℓ_b"), momentum * one)
    motion |= dict.fromkeys(("Π̇", "ṗ_b", "ℓ̇_b"), A * A * J * twice)
    motion["Φ"] = momentum * one + force * A + A * A * solved * J
    algebra |= {"Z_c": one * centre, "S": centre, "c_c": mass * place * centre}
    multiplier = {"λ": A * A * twice * J + force * A * place}
    values = scalars | group_names | algebra | spatial | forces | motion | energies | inertia
    values |= multiplier
    values |= {
        "M": entry,
        "β": covector,
        "B": entry * one + force * A,
        "N_c": force * A,
        "E": Degree(0),
    }
    values["par"] = J
    values[""] = energy * A * twice * one * one  # the value of a form or a function
    return values


def _degree(t: Tree, table: Mapping[str, Degree], group: Group) -> Degree:
    if isinstance(t, str):
        return table.get(t, table[""])
    if not isinstance(t, tuple):
        return Degree(0)
    op = t[0]
    if op in ("call", "par", "at"):
        found = table["par"] if op == "par" else table.get(str(t[1]), table[""])
        return found * Degree(0, ((COPIES, 1),)) if op == "at" and t[1] in SHARED else found
    if op == "sum":
        return _over_points(_degree(t[2], table, group), table)
    if op == "pow":
        result = _degree(t[1], table, group) ** min(abs(int(t[2])), LARGEST_POWER)
        return result if int(t[2]) > 0 else result.inverse(1, str(t[1]))
    parts = [_degree(x, table, group) for x in t[1:]]
    return _combined(op, t, parts or [Degree(0)], group)


def _combined(op: str, t: tuple[Any, ...], parts: list[Degree], group: Group) -> Degree:
    if op in ("add", "matrix", "row"):
        total = parts[0]
        for x in parts[1:]:
            total = total + x
        return total
    if op == "inv":
        return parts[0].inverse(group.dimension if t[1] == "M" else group.n, repr(t[1]))
    if op == "div":
        return parts[0] * parts[1].inverse(1, repr(t[2]))
    if op == "det":
        return parts[0] ** group.n
    if op == "norm2":
        return _product([*parts, parts[-1]])
    if op == "entry":
        return parts[0]
    return _product(parts)


def _over_points(x: Degree, table: Mapping[str, Degree]) -> Degree:
    """A sum of terms, each times the copies of its point, over all that they have; and where masses
    and places are quotients, over the denominators of each."""
    count, power = table["points"].num, dict(x.den).get(COPIES, 0)
    others = tuple((p, k) for p, k in x.den if p != COPIES)
    every = ((("copies of all points", count), power),) if power else ()
    num = x.num * table["quotients"].num + 1 + power * (count - 1)
    return Degree(num, others) * Degree(0, every)


def _product(parts: list[Degree]) -> Degree:
    total = parts[0]
    for x in parts[1:]:
        total = total * x
    return total
