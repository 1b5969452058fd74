"""Operator trees: the one language in which equations are recorded, shown, checked and lowered."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import chain
from typing import Any, TypeVar

V = TypeVar("V")
Tree = str | int | Fraction | tuple[Any, ...]

OPERATORS: dict[str, tuple[int, int | None]] = {
    "add": (2, None),  # sum
    "mul": (2, None),  # product, in this order
    "div": (2, 2),  # quotient by a scalar
    "pow": (2, 2),  # integer power
    "T": (1, 1),  # transpose, a bar in the paper
    "tr": (1, 1),  # trace
    "det": (1, 1),  # determinant
    "inv": (1, 1),  # inverse
    "one": (0, 0),  # identity matrix
    "inner": (2, 2),  # ⟨a, b⟩
    "metric": (3, 3),  # ⟨a, b⟩_M = Tr a M b̄, for vectors ā M b
    "norm2": (1, 2),  # ‖a‖², or ‖a‖²_M with the metric first
    "bracket": (2, 2),  # [a, b] = ab − ba
    "wedge": (2, 2),  # a ∧ b in R³
    "hat": (1, 1),  # j(a)
    "nabla": (1, 1),  # ∇_a, the derivative of fields along the field a
    "sum": (2, 2),  # sum over an index
    "at": (2, 3),  # an indexed family: r_i, k_ij
    "entry": (2, 3),  # entry of a vector or a matrix, counted from 1
    "matrix": (1, None),  # rows
    "row": (1, None),  # entries of a row
    "call": (2, None),  # a function at arguments
    "fun": (2, 2),  # an elementary function, by its name, at a number
    "par": (1, 1),  # a parameter of the problem, by its own name
}


def add(*summed: Tree) -> Tree:
    """The sum of trees, flattened, with zeros dropped."""
    kept = [x for t in summed for x in terms(t) if x != 0]
    return 0 if not kept else kept[0] if len(kept) == 1 else ("add", *kept)


def mul(*factors: Tree) -> Tree:
    """The product of trees, in order, with numbers in front as one, products flattened and a zero
    absorbing."""
    flat: list[Tree] = []
    for f in factors:
        flat.extend(f[1:] if isinstance(f, tuple) and f[0] == "mul" else (f,))
    if any(f == 0 for f in flat):
        return 0
    numeric = Fraction(1)
    rest: list[Tree] = []
    for f in flat:
        if isinstance(f, (int, Fraction)):
            numeric *= f
        else:
            rest.append(f)
    lead: list[Tree] = [] if numeric == 1 and rest else [plain(numeric)]
    kept = lead + rest
    return kept[0] if len(kept) == 1 else ("mul", *kept)


def plain(q: Fraction) -> int | Fraction:
    """A number as a tree: an integer where it is whole."""
    return int(q) if q.denominator == 1 else q


def sized(t: Tree) -> Tree | None:
    """The tree x where a tree is |x|, which is recorded as √(x²); else ``None``."""
    match t:
        case ("fun", "sqrt", ("pow", x, 2)):
            found: Tree = x
            return found
    return None


def neg(t: Tree) -> Tree:
    """The opposite of a tree, a product with −1."""
    return mul(-1, t)


def coefficient(t: Tree) -> tuple[Fraction, Tree]:
    """The rational number q and the tree t with q · t equal to a tree; (1, t) where it has none in
    front."""
    if isinstance(t, (int, Fraction)):
        return Fraction(t), 1
    if isinstance(t, tuple) and t[0] == "mul" and isinstance(t[1], (int, Fraction)):
        rest = t[2:]
        return Fraction(t[1]), rest[0] if len(rest) == 1 else ("mul", *rest)
    return Fraction(1), t


def terms(t: Tree) -> tuple[Tree, ...]:
    """The terms of a sum; any other tree is one term."""
    return t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)


def operands(t: Tree) -> tuple[Tree, ...]:
    """The trees of which a tree is made; a parameter's name, a function's and an exponent are
    none."""
    if not isinstance(t, tuple) or t[0] == "par":
        return ()
    return t[2:] if t[0] == "fun" else t[1:2] if t[0] == "pow" else t[1:]


def fold(at: Callable[..., V]) -> Callable[[Tree], V]:
    """The function of trees with the value at(tree, *values on its operands)."""

    def of(t: Tree) -> V:
        return at(t, *map(of, operands(t)))

    return of


@fold
def nodes(t: Tree, *inside: list[Tree]) -> list[Tree]:
    """All subtrees of a tree, itself first, in reading order."""
    return [t, *chain.from_iterable(inside)]


def names(t: Tree) -> Iterator[str]:
    """Every name that occurs in a tree, in reading order, with repetitions; not the parameters."""
    return (x for x in nodes(t) if isinstance(x, str))


def replaced(t: Tree, old: Tree, new: Tree) -> Tree:
    """The tree with ``new`` for every occurrence of the subtree ``old``."""
    if t == old:
        return new
    return (t[0], *(replaced(part, old, new) for part in t[1:])) if isinstance(t, tuple) else t
