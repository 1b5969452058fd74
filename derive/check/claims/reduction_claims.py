"""The claims of a reduction, and of the metric that it starts from: its curvature."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from itertools import pairwise
from math import prod

from ...algebra.exact_kernel import PRIMES, ResidueVectorSource
from ...language import rational as q
from ...language.show import show
from ...language.tree import Tree, nodes, operands, terms
from ...language.univariate import (
    Coefficients,
    common_divisor,
    derivative,
    division,
    polynomial_value,
    trimmed,
)
from ...record.as_json import decode
from ...record.record import RecordError, Step, stated
from ...record.sentence import Claim
from ..form.hypotheses_checked import denominators
from ..lagrangian.lagrangian_model import LagrangianModel
from ..trials.trial_points import SIZE
from ..values.draws import Locus
from ..values.residue import Residue, random_prime
from .reduced_system import ClaimedRecord, Judge
from .spectra_and_residues import begins, drawn, value

LARGEST = 24
"""The largest degree of a right side."""
LARGEST_ON_LINE = 96
"""The largest degree of what the effective potential divides by."""
CURVATURE = "d𝒜"


def _curvature(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """Does the curvature vanish in all equations that give it, or not?"""
    values = [e.rhs for e in step.equations if _head(e.lhs) == CURVATURE]
    if not values or len(values) < len(step.equations):
        return "the equations are none of a curvature"
    flat = all(x == 0 for x in values)
    return "" if flat is (claim.kind == "reduction.flat") else "a curvature vanishes, or does not"


def _head(t: Tree) -> str:
    """The letter of a family of functions, at some arguments."""
    if isinstance(t, tuple) and t[0] == "call" and isinstance(t[1], tuple):
        return str(t[1][1])
    return ""


def _quadrature(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The right side is a polynomial of the degree in the coordinate, and the kind is that of its
    factors of odd multiplicity; that its leading coefficient is not 0 is supposed."""
    rate, f = step.equations[0].lhs, step.equations[0].rhs
    if not isinstance(rate, tuple) or rate[0] != "pow" or rate[2] != 2:
        raise RecordError("the left side is no square of a rate")
    entry: Tree = ("entry", "A", *rate[1][2:])
    p = random_prime(c.random)
    if any(entry in nodes(x) for x in _leaves(f) if x != entry):
        return "the right side is no polynomial in the coordinate"
    at = drawn(_leaves(f), c.random, p)
    found = _interpolated(lambda x: value(f, {**at, entry: x}, p), p, LARGEST)
    degree, left = len(found) - 1, _odd_degree(found)
    kind = "elementary" if left < 3 else "elliptic" if left < 5 else "hyperelliptic"
    told = {"degree": degree}
    if left < degree:
        kind, told = f"{kind}_squared", told | {"left": left}
    if claim.kind != f"reduction.{kind}" or dict(claim.values) != told:
        return f"its degree is {degree}, and {left} without squares"
    return "" if _supposed(c, step, entry, degree) else "its leading coefficient may vanish"


def _supposed(c: ClaimedRecord, step: Step, entry: Tree, degree: int) -> bool:
    """Does the leading coefficient of the right side vanish, on a random line, only where what the
    step supposes not to be 0 does?"""
    f, supposed = step.equations[0].rhs, [x.of for x in step.hypotheses if x.property == "nonzero"]
    p, there, on_line = _random_line(c, [f, *supposed])

    def leading(s: Residue) -> Residue:
        """The coefficient times all that is supposed, so that nothing is divided by."""
        here = there(s)
        whole = _interpolated(lambda x: value(f, {**here, entry: x}, p), p, LARGEST)
        below = prod((value(t, here, p) for t in supposed), start=Residue(1, p))
        return whole[degree] * below if degree < len(whole) else Residue(0, p)

    first = _interpolated(leading, p, LARGEST_ON_LINE)
    return _vanishes(first, [on_line(t) for t in supposed])


def _random_line(
    c: ClaimedRecord, trees: Sequence[Tree]
) -> tuple[int, Callable[[Residue], dict[Tree, Residue]], Callable[[Tree], Coefficients]]:
    """A prime, the values of what trees are made of at the places of a random line, and a tree as a
    polynomial along it."""
    p = random_prime(c.random)
    at, along = (drawn(_every_leaf(trees), c.random, p) for _ in range(2))

    def there(s: Residue) -> dict[Tree, Residue]:
        return {x: y + s * along[x] for x, y in at.items()}

    def on_line(t: Tree) -> Coefficients:
        return _interpolated(lambda s: value(t, there(s), p), p, LARGEST_ON_LINE)

    return p, there, on_line


def _odd_degree(c: Coefficients) -> int:
    """The degree of the factors of odd multiplicity, each once.

    Divisors with the derivative lower all multiplicities by 1: of these steps every second adds the
    degree of the factors that are left.
    """
    degrees = [len(c) - 1]
    while len(c) > 1:
        c = common_divisor(c, derivative(c))
        degrees.append(len(c) - 1)
    steps = (a - b for a, b in pairwise(degrees))
    return sum(x * (-1) ** k for k, x in enumerate(steps))


def _interpolated(f: Callable[[Residue], Residue], p: int, largest: int) -> Coefficients:
    """The coefficients of a polynomial, by its values; ``RecordError`` for more than the largest
    degree, or what is no polynomial."""
    zero, one = Residue(0, p), Residue(1, p)
    found, base = [zero], [one]  # ∏ (x − j), j < k
    for k in (Residue(k, p) for k in range(largest + 3)):
        step = (f(k) - polynomial_value(found, k)) / polynomial_value(base, k)
        found = [a + step * b for a, b in zip(found, base, strict=True)] + [zero]
        base = [a - k * b for a, b in zip([zero, *base], [*base, zero], strict=True)]
    whole = trimmed(found)
    if len(whole) > largest + 1:
        raise RecordError("the right side is no polynomial in the coordinate")
    return whole


def _leaves(t: Tree) -> list[Tree]:
    """What a function is made of: letters, entries, parameters, and functions of these."""
    if isinstance(t, tuple) and t[0] in ("add", "mul", "div", "pow"):
        return [x for y in operands(t) for x in _leaves(y)]
    return [] if isinstance(t, (int, Fraction)) else [t]


# -- where the effective potential is defined ----------------------------------------------------


def missing(step: Step) -> str:
    """What a step must claim and does not: whether there is curvature, or what the effective
    potential divides by; "" for nothing."""
    kinds = {x.kind for x in step.claims}
    curvatures = [_head(e.lhs) == CURVATURE for e in step.equations]
    if curvatures and all(curvatures) and not kinds & {"reduction.flat", "reduction.curved"}:
        return "it gives curvatures, and no claim says whether they vanish"
    told = kinds & {"reduction.isotropy", "reduction.divided"}
    found = () if told else [*filter(_varies, _divisors(step))]
    return f"it divides by {show(found[0])[:80]}, which no claim says" if found else ""


def _divisors(step: Step) -> tuple[Tree, ...]:
    """What the terms of 𝒱 with momenta divide by."""
    summed = (x for e in step.equations if e.lhs == "𝒱" for x in terms(e.rhs))
    squares = (x for x in summed if any(begins(y, "at", "𝒥") for y in nodes(x)))
    return tuple(dict.fromkeys(t for x in squares for t in denominators(x)))


def _varies(t: Tree) -> bool:
    """Has a function entries of g, or of 𝕀, in its own functions too?"""
    return any(begins(x, "entry") for x in nodes(t))


def _conditions(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The conditions vanish, on a random line, only where 𝒱 divides by 0, and one does wherever
    that varies with g; of isotropy: det 𝕀 is their product, but for what is the same at all g."""
    stated = operands(claim["conditions"])
    below = _divisors(step)
    _, _, on_line = _random_line(c, [*stated, *below])
    every = {t: on_line(t) for t in (*stated, *below)}
    fixed = [t for t in below if not _varies(t)]
    pairs = [(stated, below), ([t for t in below if _varies(t)], [*stated, *fixed])]
    if len({*stated}) < len(stated) or not all(
        _varies(x) and _vanishes(every[x], [every[y] for y in others])
        for listed, others in pairs
        for x in listed
    ):
        return "the conditions are not what its equations divide by"
    if claim.kind == "reduction.divided" or _determined(c, stated):
        return ""
    return "the determinant of the locked inertia is not the product of the conditions"


def _every_leaf(trees: Iterable[Tree]) -> list[Tree]:
    return [*dict.fromkeys(x for t in trees for x in _leaves(t))]


def _vanishes(x: Coefficients, others: Sequence[Coefficients]) -> bool:
    """Is one of some polynomials 0 wherever one is?  Then it divides a power of their product."""
    if len(x) < 2:
        return bool(x[0])
    power: Coefficients = (x[0] * 0 + 1,)
    for y in others:
        power = division(_product(power, y), x)[1]
    for _ in range(LARGEST_ON_LINE.bit_length()):
        power = division(_product(power, power), x)[1]
    return not any(power)


def _product(a: Coefficients, b: Coefficients) -> Coefficients:
    found = [a[0] * 0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            found[i + j] += x * y
    return trimmed(found)


def _determined(c: ClaimedRecord, stated: Sequence[Tree]) -> bool:
    """Is det 𝕀 over the product of the conditions the same at random elements of the group?"""
    (locked,) = (e.rhs for e in c.record["locked"].equations)
    rows = [operands(row) for row in operands(locked)]
    p, ratios = PRIMES[0], set()
    letters = _every_leaf([*stated, *(x for row in rows for x in row)])
    at = drawn((x for x in letters if not begins(x, "entry")), c.random, p)
    for _ in range(3):
        source = ResidueVectorSource(p, 1, c.random.getrandbits(64))
        g = c.group.sample_inside(source, 1)
        for i, row in enumerate(g, 1):
            for j, x in enumerate(row, 1):
                at["entry", "A", i, j] = Residue((source.constant(0) + x).values[0], p)
        for x in letters:
            if begins(x, "fun") and any(begins(y, "entry") for y in nodes(x)):
                at[x] = Residue(c.random.randrange(1, p), p)
        values = tuple(tuple(value(x, at, p) for x in row) for row in rows)
        at |= {
            ("entry", "𝕀", i, j): x for i, row in enumerate(values, 1) for j, x in enumerate(row, 1)
        }
        product = prod((value(x, at, p) for x in stated), start=Residue(1, p))
        ratios.add((q.determinant(values) / product).n)
    return len(ratios) == 1


# -- the symmetries -------------------------------------------------------------------------------


def _taken(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """As many fields as are claimed, each with its momentum, and each two commute."""
    fields = [decode(x, "problem, symmetries") for x in c.record.problem["symmetries"]]
    if claim["count"] != len(fields):
        return f"there are {len(fields)}"
    wanted = {f"momentum_{k}": [x] for k, x in enumerate(fields, 1)}
    wanted |= {
        f"momentum_{j}_and_{k}": [fields[j - 1], fields[k - 1]]
        for k, _ in enumerate(fields, 1)
        for j in range(1, k)
    }
    for label, moved in wanted.items():
        given = [e for s in c.record.steps if s.label.endswith(f".{label}") for e in s.given]
        if [e.rhs for e in given if e.lhs in ("δA", "δ′A")] != moved:
            return f"no step {label} is of these fields"
    return ""


def _free(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """Nothing is held, and all fields are Yg, or all gX, and independent: δA g⁻¹, or g⁻¹δA, is the
    same at a random g and at g²."""
    model = LagrangianModel(c.record.problem, c.group, c.random, SIZE, Locus())
    if model.held:
        return "coordinates are held"
    elements = [(g, q.inverted(g)) for g in (model.g, q.times(model.g, model.g))]
    moved = [[x.at(model, model.t, g)[1] for x in model.symmetries] for g, _ in elements]
    pairs = [*zip(moved, elements, strict=True)]
    right = [[q.times(x, back) for x in fields] for fields, (_, back) in pairs]
    left = [[q.times(back, x) for x in fields] for fields, (_, back) in pairs]
    if right[0] != right[1] and left[0] != left[1]:
        return "the symmetries do not all act on one side"
    rank = q.rank(tuple(map(q.flatten, moved[0])))
    return "" if rank == len(model.symmetries) else "the fields depend on one another"


def _entry(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The coordinate is the one whose rate the equation gives."""
    rate = step.equations[0].lhs
    given = isinstance(rate, tuple) and rate[0] == "pow" and begins(rate[1], "entry", "Ȧ")
    own = ("entry", "A", *rate[1][2:]) if given else None  # type: ignore[index]
    return "" if own == claim["entry"] else "the equation is of another coordinate"


def _left_invariant(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """C drops out of the metric of this body, which the equation says, and is not 1."""
    (wanted,) = stated("Tr ξJZ̄C = Tr ξJZ̄")
    if wanted not in step.equations:
        return "the equation that says so is missing"
    return "C is 1" if "orthogonal" in c.group.relations else ""


JUDGES: dict[str, Judge] = {
    "reduction.taken": _taken,
    "reduction.free": _free,
    "reduction.flat": _curvature,
    "reduction.curved": _curvature,
    "reduction.isotropy": _conditions,
    "reduction.divided": _conditions,
    "reduction.quadrature": _entry,
    **dict.fromkeys(
        (
            f"reduction.{kind}{squared}"
            for kind in ("elementary", "elliptic", "hyperelliptic")
            for squared in ("", "_squared")
        ),
        _quadrature,
    ),
    "relation.left_invariant": _left_invariant,
}
