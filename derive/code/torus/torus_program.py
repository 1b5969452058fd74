"""The program of a fluid on the torus, by the road that is the shortest for its N.

Up to ``WRITTEN_OUT`` the sums of the record are written out.  Above, W and P are made as matrices,
from which dW/dt = (N/4πi) [W, P] has its coefficients: N³ products in place of N⁴, and loops, of
which the program says its tables alone; the templates of each language have the loops.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext
from fractions import Fraction
from typing import NamedTuple

from ...algebra.structure import Place, TorusLattice
from ...record.record import Derivation
from ..factor import factored
from ..graph import Graph, Node
from ..naming import ClaimedNames
from ..options import Options
from ..program import EmittedFunction, Load, Program
from ..requests import require_options
from ..schedule import Scheduler, Source, frontier
from ..watched_functions import EmittedEvent, table, values_of
from .lattice_state import described, names, position
from .written_out import WrittenOut

WRITTEN_OUT = 5
"""The largest N that is written out: at 7 the loops take the same time, and 4 % of the text."""
TABLE = 7
"""The largest N of which C has a table of terms: at 9 the matrices take less time."""
POWERS = (2, 3, 4)
CONSERVED = tuple(f"trace_{k}" for k in POWERS)
"""What ``conserved`` gives: Tr Wᵏ/N, in space the mean of the k-th power of the vorticity."""
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")


class Term(NamedTuple):
    """One of the terms of dω̂(n)/dt: c times the product of two coefficients, by their places in the
    state, and −1 for a conjugate."""

    first: int
    second: int
    sign: int
    other: int
    c: Fraction


@dataclass(frozen=True)
class Loops:
    """The tables of the loops for one N: cos and sin of 2πk/N; for small N the terms of each rate;
    and what the functions with loops, by ``names``, cost."""

    N: int
    names: frozenset[str]
    cosines: tuple[Fraction, ...]
    sines: tuple[Fraction, ...]
    table: tuple[tuple[Term, ...], ...]
    operations: Mapping[str, str]

    @property
    def scale(self) -> Fraction:
        """1/4π, as a double."""
        return _rounded(1 / (4 * Fraction(math.pi)))


def torus_program(
    d: Derivation,
    torus: TorusLattice,
    options: Options | None = None,
    events: Sequence[EmittedEvent] = (),
) -> Program:
    """The program of a record on the torus; ``LoweringError`` for an option that it has not.
    ``events``: what is watched on a motion."""
    chosen = options or Options()
    require_on_torus(d, chosen)
    functions, constants = _looped(torus), tuple[str, ...]()
    if not chosen.conserved:
        del functions["conserved"]
    if torus.N <= WRITTEN_OUT:
        own, constants = _written_out(d, torus)
        functions |= own
        looped = {*functions} - {*own}
    else:
        looped = {*functions} - {"constants"}
    if events:
        functions["events"] = _watched(d.name, torus, events)
    return Program(
        d.name,
        str(d.problem.get("title", "")),
        torus.name,
        torus.N**2 - 1,
        (
            f"The algebra su({torus.N}) in the basis of the torus: T_n = w^(n1 n2) g^n1 h^n2, with",
            "w = e^(2 pi i/N), g = diag(w^(2j)), h e_j = e_(j-1) the shift, n modulo N, and",
            "[T_m, T_n] = -2i sin(2 pi (m1 n2 - m2 n1)/N) T_(m+n).",
            f"dW/dt = N/(4 pi i) [W, P], N = {torus.N}, W = sum omega(n) T_n the vorticity and",
            "P = -sum omega(n)/|n|^2 T_n the stream function, in space sums of e^(i n.x);",
            "energy is the sum of |omega(n)|^2/(2 |n|^2), the mean of half the squared velocity"
            + ("; trace_k is Tr W^k/N." if chosen.conserved else "."),
            *described(torus),
            *(_scratch(torus) if torus.N > TABLE else ()),
        ),
        names(torus),
        (),
        (),
        constants,
        (),
        functions,
        conserved=CONSERVED if chosen.conserved else (),
        events=table(events),
        loops=loops(torus, looped) if looped else None,
        on_torus=True,
    )


def require_on_torus(d: Derivation, chosen: Options) -> None:
    """``LoweringError`` for an option that is not written on the torus."""
    require_options(d, chosen, "on the torus, whose state is the vorticity alone")


def _scratch(torus: TorusLattice) -> tuple[str, ...]:
    N, h = torus.N, torus.half
    row, part = -(-N // 4) * 4, -(-(h + 1) // 4) * 4  # in C rows are of a multiple of four numbers
    numbers = (
        5 * N * row + 2 * N * (h + 1) + 5 * row + 4 * (h + 1) * (h + 1 + part) + 2 * (h + 2) * part
    )
    kilobytes = -(-8 * numbers // 1024)
    return (
        f"The functions have no memory of their own: in C rhs takes {kilobytes} kB of the stack.",
    )


# -- written out ---------------------------------------------------------------------------------


def _written_out(
    d: Derivation, torus: TorusLattice
) -> tuple[dict[str, EmittedFunction], tuple[str, ...]]:
    """The functions of the record's equations, term by term, and the names of the constants."""
    graph = Graph()
    state = _leaves(graph, torus)
    out = WrittenOut(torus, graph, [*state.values()])
    motion, energy = d["motion"].equations[0].rhs, d["energy"].equations[0].rhs
    rates = [x for n in torus.half_plane for x in out.value(motion, {"𝐧": n})]
    wanted: dict[str, list[Node]] = {"rhs": rates, "energy": [out.value(energy, {}).re]}
    wanted = {name: factored(graph, found) for name, found in wanted.items()}
    claimed = ClaimedNames()
    places = _places(claimed, state)
    scheduler = Scheduler(claimed, {})
    fixed = frontier(x for found in wanted.values() for x in found)
    constants = tuple(claimed.claim(f"sine_{i}", f"node {x.id}") for i, x in enumerate(fixed, 1))
    kept = {x: (name, ("k", i)) for i, (x, name) in enumerate(zip(fixed, constants, strict=True))}
    functions = {"constants": scheduler.function(fixed, {})}
    functions |= {name: scheduler.function(x, places | kept) for name, x in wanted.items()}
    return functions, constants


def _leaves(graph: Graph, torus: TorusLattice) -> dict[str, Node]:
    return {x: graph.leaf(x, "state") for x in names(torus)}


def _places(claimed: ClaimedNames, state: Mapping[str, Node]) -> dict[Node, tuple[str, Source]]:
    return {x: (claimed.claim(name, name), ("x", i)) for i, (name, x) in enumerate(state.items())}


def _watched(name: str, torus: TorusLattice, events: Sequence[EmittedEvent]) -> EmittedFunction:
    """What becomes 0 at each event."""
    graph, claimed = Graph(), ClaimedNames()
    state = _leaves(graph, torus)
    found = values_of(name, events, graph, state)
    places = {**_places(claimed, state), graph.leaf("t", "time"): ("t", ("t", 0))}
    return Scheduler(claimed, {}).function(found, places)


# -- loops ---------------------------------------------------------------------------------------


def loops(torus: TorusLattice, looped: Collection[str]) -> Loops:
    """The tables for one N."""
    N, h = torus.N, torus.half
    turn, product = 4 * h * (h + 1) ** 2, 4 * N**3
    by_three = 3 * N**3  # products of complex numbers by three real ones
    whole, least = 3 * turn + product, 3 * turn + by_three
    table = tuple(_terms(torus, n) for n in torus.half_plane) if N <= TABLE else ()
    terms = sum(map(len, table))
    return Loops(
        N,
        frozenset(looped) | ({"rhs_batch"} if "rhs" in looped else set()),
        tuple(_rounded(_cosine(Fraction(k, N))) for k in range(N)),
        tuple(_rounded(_cosine(Fraction(k, N) - Fraction(1, 4))) for k in range(N)),
        table,
        {
            "rhs": f"{whole} mul, {whole} add, and {6 * N * N} of less order",
            "rhs by table": f"{8 * terms} mul, {4 * terms} add",
            "rhs by three": f"{least} mul, {least} add, and {9 * N * N} of less order",
            "energy": f"{N * N - 1} mul, {N * N - 1} add, {(N * N - 1) // 2} div",
            "conserved": f"{turn + product} mul, {turn + product} add",
            "conserved by three": f"{turn + by_three} mul, {turn + by_three} add",
        },
    )


def _terms(torus: TorusLattice, n: Place) -> tuple[Term, ...]:
    """The terms of dω̂(n)/dt, m and n − m together: their sines are opposite."""
    found = []
    for m in torus.places:
        other = torus.representative((n[0] - m[0], n[1] - m[1]))
        weight = Fraction(1, _square(m)) - Fraction(1, _square(other)) if any(other) else 0
        crossed = (m[0] * n[1] - m[1] * n[0]) % torus.N
        if m < other and weight and crossed:
            (i, turned), (j, turned_too) = position(torus, m), position(torus, other)
            sine = _cosine(Fraction(crossed, torus.N) - Fraction(1, 4))
            c = -_rounded(sine * weight * torus.N / (2 * Fraction(PI)))
            found.append(Term(i, j, -1 if turned else 1, -1 if turned_too else 1, c))
    return tuple(found)


def _square(n: Place) -> int:
    return n[0] ** 2 + n[1] ** 2


def _rounded(x: Fraction) -> Fraction:
    """The double next to x."""
    return Fraction(float(x))


def _cosine(turns: Fraction) -> Fraction:
    """cos 2π·turns to 60 digits: the same on every machine."""
    turns = abs(turns) % 1
    turns = min(turns, 1 - turns)
    if turns == Fraction(1, 4):
        return Fraction(0)
    with localcontext() as context:
        context.prec = 60
        x = 2 * PI * turns.numerator / turns.denominator
        total = term = Decimal(1)
        for k in range(1, 40):
            term *= -x * x / ((2 * k - 1) * (2 * k))
            total += term
        return Fraction(total)


def _looped(torus: TorusLattice) -> dict[str, EmittedFunction]:
    """Functions of which only what they read and how much they write is said here."""

    def hollow(count: int) -> EmittedFunction:
        return EmittedFunction((Load("x", "x", 0),) * bool(count), (), (Fraction(0),) * count)

    sizes = {"constants": 0, "rhs": torus.N**2 - 1, "energy": 1, "conserved": len(POWERS)}
    return {name: hollow(count) for name, count in sizes.items()}
