"""Vector equations component by component: (35), and the motion with a body's own numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..language import rational as q
from ..language.laurent import Laurent, OverlongError, grouped, polynomial, written
from ..language.tree import Tree, names, replaced
from ..language.values import Value, value
from ..problem.problem import Problem
from ..record.record import Equation, Step
from ..schema.kinds.gravity import gravity
from .chapter import Chapter
from .wording import say

AXES = (1, 2, 3)
RATES = ("ζ", "w", "w_c")
"""Velocities: terms with their entries are written after those of the forces."""
UNIT = "1"
LONGEST = 8
"""A tensor with more terms than this in an entry is not written out."""

Rows = tuple[tuple[Tree, ...], ...]
Tensor = tuple[tuple[Laurent, ...], ...]


def letters(name: str) -> tuple[tuple[Laurent], ...]:
    """The 3 × 1 column of the entries of the vector ``name``, each a symbol."""
    return tuple((Laurent.symbol(("entry", name, i)),) for i in AXES)


def square(name: str) -> tuple[tuple[Laurent, ...], ...]:
    """The 3 × 3 matrix of the entries of ``name``, each a symbol."""
    return tuple(tuple(Laurent.symbol(("entry", name, i, j)) for j in AXES) for i in AXES)


def diagonal(entries: Sequence[Tree]) -> tuple[tuple[Laurent, ...], ...]:
    """The 3 × 3 matrix with these symbols on the diagonal, and 0 elsewhere."""
    zero = Laurent({})
    return tuple(
        tuple(Laurent.symbol(x) if i == j else zero for j in range(3))
        for i, x in enumerate(entries)
    )


def components(t: Tree, known: Mapping[str, Value], moments: Sequence[Tree]) -> list[Tree]:
    """The components of a vector tree; a name that is not ``known`` is a vector.

    Terms of the same velocities stand together, over the one of the ``moments`` that divides them.
    """
    vectors = {x: letters(x) for x in names(t) if x not in known}
    found = value(t, {**vectors, **known})
    return [grouped(x, {*moments}.__contains__, _is_rate) for (x,) in found]


def _is_rate(symbol: Tree) -> bool:
    return isinstance(symbol, tuple) and symbol[0] == "entry" and symbol[1] in RATES


def tensor_steps(
    problem: Problem, body: tuple[Step, ...], inertia: Step, motion: Step, c: Chapter
) -> tuple[Step, ...]:
    """The step of the entries of I, or I_c, from the numbers of the body, and where it is diagonal
    that of the motion by components; none where the entries are too long.

    ``inertia``: the step that says I, or I_c.
    """
    if not body:
        return ()
    name = "I_c" if problem.affine else "I"
    try:
        found = _tensor(problem, inertia)
    except OverlongError:
        return ()
    if found is None or max(len(x.terms) for row in found for x in row) > LONGEST:
        return ()
    diagonal_tensor = not any(found[i][j] for i in range(3) for j in range(3) if i != j)
    order = [(i, j) for i in AXES for j in AXES[i - 1 :]]
    if diagonal_tensor:  # the products of inertia, which vanish, together
        order.sort(key=lambda x: x[0] != x[1])
    entries = [Equation(("entry", name, i, j), written(found[i - 1][j - 1])) for i, j in order]
    draft = c.draft("tensor", "coordinates")
    draft.depends_on(body[-1], inertia)
    step = draft.step(entries, say("tensor.entries"))
    if not diagonal_tensor:
        return (step,)
    return step, *_motion(problem, name, found, (body[-1], step, motion), c)


def _motion(
    problem: Problem, name: str, found: Tensor, made_from: tuple[Step, Step, Step], c: Chapter
) -> tuple[Step, ...]:
    """The step of the accelerations by components; none where letters enter that are not known.

    ``made_from``: the steps of the body, of its tensor, and of the motion.
    """
    *_, motion = made_from
    try:
        numbers = _numbers(problem)
    except OverlongError:
        return ()
    moments: list[Tree] = []
    for i in range(3):  # equal moments are one, so that what they cancel is seen
        same = next(j for j in range(3) if found[j][j] == found[i][i]) + 1
        moments.append(("entry", name, same, same))
    known: dict[str, Value] = {
        "A": square("A"),
        name: diagonal(moments),
        "m": Laurent.symbol("m"),
        **{x: letters(x) for x in ("ζ", "w", "w_c", "u", "f_u", "ζ̇")},
        **numbers,
    }
    rates = [e for e in motion.equations if e.lhs in ("ζ̇", "ẇ")]
    if not all({*names(e.rhs)} <= {*known} for e in rates):
        return ()
    equations = [
        Equation(("entry", e.lhs, i), x)
        for e in rates
        for i, x in enumerate(components(e.rhs, known, moments), 1)
    ]
    driven = c.with_input() if motion.driven else c
    draft = driven.draft("components", "components")
    draft.depends_on(*made_from)
    return (draft.step(equations, say("components.principal")),)


def _numbers(problem: Problem) -> dict[str, Value]:
    """The values of γ, if there is gravity, of c, and of r_c: 0 where c is, else its entries."""
    found: dict[str, Value] = {}
    if (g := gravity(problem.potentials)) is not None:
        found["γ"] = _column(g)
    mass, first, _ = moments_of(problem)
    found["c"] = _by_mass(_column(first), polynomial(mass))
    centred = all(not x for (x,) in found["c"])
    return found | {"r_c": found["c"] if centred else letters("r_c")}


def _by_mass(c: Value, mass: Laurent) -> Value:
    """The first moment as m r_c where that is shorter: m a product, and r_c without its letters."""
    if len(mass.terms) != 1 or not any(len(m) > 1 for m in mass.terms):
        return c
    centre = [x / mass for (x,) in c]
    if any(e < 0 for x in centre for m in x.terms for _, e in m):
        return c
    return tuple((Laurent.symbol("m") * x,) for x in centre)


def _column(entries: Sequence[Tree]) -> tuple[tuple[Laurent], ...]:
    return tuple((polynomial(x),) for x in entries)


def _tensor(problem: Problem, inertia: Step) -> Tensor | None:
    """I, or I_c, in the numbers of the body, by the last equation for it; ``None`` without a
    body."""
    if problem.body is None:
        return None
    _, first, second = moments_of(problem)
    known: dict[str, Value] = {
        UNIT: q.identity(3),
        "m": Laurent.symbol("m"),
        "c": _column(first),
        "J": tuple(tuple(polynomial(x) for x in row) for row in second),
    }
    name = "I_c" if problem.affine else "I"
    for x in ("J_c", name) if problem.affine else (name,):
        rhs = [e.rhs for e in inertia.equations if e.lhs == x][-1]
        known[x] = value(replaced(rhs, ("one",), UNIT), known, number=Laurent.of)
    return known[name]  # type: ignore[no-any-return]


def moments_of(problem: Problem) -> tuple[Tree, tuple[Tree, ...], Rows]:
    """m, c (3 entries) and J (3 × 3) of all that the body is made of, as trees in the
    parameters."""
    body = problem.body
    assert body is not None
    own = body.moments()
    return own.m, own.c, own.J
