"""The program of a fluid on the torus, by the road that is the shortest for its N.

The state is Re and Im of ω̂(n) for one of n and −n, in order.  Up to ``WRITTEN_OUT`` the sums of
the record over the lattice are written out, term by term.  Above, W and P are made as matrices,
from which dW/dt = (N/4πi) [W, P] has its coefficients: N³ products in place of N⁴, and loops, of
which the program says its tables alone; each language has the loops as functions of a file.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

from ..algebra.structure import Place, TorusLattice
from ..language.limits import SLOPES_IN_LOOPS
from ..language.tree import Tree, mul
from ..record.record import Derivation
from .assemble import parameter
from .dense import Complex
from .factor import factored
from .graph import Graph, Node
from .naming import ClaimedNames
from .options import Options
from .program import EmittedFunction, LoweringError, Program
from .requests import require_columns, require_options
from .schedule import Scheduler, by_numbers, frontier, leaf_places
from .state_forms import of_plain_variations
from .torus_loops import CONSERVED, TABLE, EmittedForcing, looped, loops
from .watched_functions import EmittedEvent, table, values_of


def turned(name: str) -> str:
    """The name in the state, or of an input, of what one like re_m1_0 is the conjugate of."""
    *part, first, second = ("", *name.split("_"))
    n = (first, second)
    opposite = (x[1:] if x.startswith("m") else f"m{x}" * (x != "0") or x for x in n)
    return "_".join((*part[1:], *opposite))


def described(torus: TorusLattice) -> tuple[str, ...]:
    """The state in words, for the head of a file."""
    h = torus.half
    return (
        f"The state has {torus.N**2 - 1} numbers: number 2j and the next, from 0, are Re and Im of",
        "the coefficient omega(n) of T_n; omega(-n) is its conjugate, omega(0) = 0:",
        f"j = n1 - 1 for n2 = 0, n1 = 1 ... {h};",
        f"j = {h} + {torus.N} (n2 - 1) + n1 + {h} for n2 = 1 ... {h}, n1 = -{h} ... {h}.",
    )


class WrittenOut:
    """Trees of the record as pairs of nodes; ``leaves``: the numbers of the state; ``inputs``:
    those of the input."""

    def __init__(
        self, torus: TorusLattice, graph: Graph, leaves: list[Node], inputs: Sequence[Node] = ()
    ):
        self.torus, self.graph, self.leaves, self.inputs = torus, graph, leaves, inputs
        self.pi = graph.product((graph.num(4), graph.function("atan", graph.num(1))))

    def value(self, t: Tree, at: Mapping[str, Place]) -> Complex:
        """The value of a tree where its indices are bound."""
        g = self.graph
        if isinstance(t, (int, Fraction)):
            return Complex(g.num(t), g.num(0))
        if t == "π":
            return Complex(self.pi, g.num(0))
        if not isinstance(t, tuple):
            raise LoweringError(f"no number {t!r} of the torus")
        op, *parts = t
        if op == "call" and parts[0] in ("ω̂", "f̂"):
            given = self.leaves if parts[0] == "ω̂" else self.inputs
            return self.coefficient(given, self.place(parts[1], at))
        if op == "par":
            return Complex(g.leaf(parts[0], "parameter"), g.num(0))
        if op == "pow":
            return reduce(Complex.__mul__, [self.value(parts[0], at)] * int(parts[1]))
        if op == "norm2":
            return self.value(sum(x * x for x in self.place(parts[0], at)), at)
        if op == "fun" and parts[0] == "sin":
            return Complex(self.sine(self.turns(parts[1], at)), g.num(0))
        if op == "sum":
            return self.total(parts[1], [{**at, parts[0]: n} for n in self.torus.places])
        found = [self.value(x, at) for x in parts]
        if op in ("mul", "add"):
            return reduce(Complex.__mul__ if op == "mul" else Complex.__add__, found)
        if op == "div" and found[1].im.is_zero:
            below = g.recip(found[1].re)
            return Complex(g.product((found[0].re, below)), g.product((found[0].im, below)))
        raise LoweringError(f"no {op!r} of numbers on the torus")

    def total(self, term: Tree, places: list[dict[str, Place]]) -> Complex:
        """A sum over places, the terms with the same sine together."""
        g, groups = self.graph, defaultdict[Node, list[Complex]](list)
        factors = term[1:] if isinstance(term, tuple) and term[0] == "mul" else (term,)
        sines = [x for x in factors if isinstance(x, tuple) and x[:2] == ("fun", "sin")]
        rest = mul(*(x for x in factors if x not in sines))
        for at in places:
            sine = self.value(mul(*sines), at).re
            sign, least = sine.split
            there = Complex(g.num(sign), g.num(0)) * self.value(rest, at)
            groups[least].append(there)
        parts = [
            [g.product((sine, g.sum(part))) for part in zip(*found, strict=True)]
            for sine, found in groups.items()
        ]
        return Complex(*(g.sum(x) for x in zip(*parts, strict=True)))

    def coefficient(self, given: Sequence[Node], n: Place) -> Complex:
        """That of n, ω̂(n) by the state or f̂(n) by the input."""
        if self.torus.representative(n) == (0, 0):
            return Complex(self.graph.num(0), self.graph.num(0))
        j, conjugate = self.torus.position(n)
        return Complex(given[j], -given[j + 1] if conjugate else given[j + 1])

    def sine(self, k: int) -> Node:
        """sin 2πk/N, by those of 0 < k < N/2."""
        g, k = self.graph, k % self.torus.N
        if not k:
            return g.num(0)
        least, sign = (k, 1) if k <= self.torus.half else (self.torus.N - k, -1)
        angle = g.product((g.num(Fraction(2 * least, self.torus.N)), self.pi))
        return g.product((g.num(sign), g.function("sin", angle)))

    def turns(self, angle: Tree, at: Mapping[str, Place]) -> int:
        """The k of an angle 2π k/N, k = m ∧ n."""
        match angle:
            case ("div", ("mul", 2, "π", ("wedge", m, n)), self.torus.N):
                (a, b), (c, d) = self.place(m, at), self.place(n, at)
                return a * d - b * c
        raise LoweringError("an angle of another form")

    def place(self, t: Tree, at: Mapping[str, Place]) -> Place:
        """A point of the lattice."""
        if isinstance(t, str):
            return at[t]
        found: list[Any] = [x if isinstance(x, int) else self.place(x, at) for x in t[1:]]  # type: ignore[index]
        if t[0] == "mul":  # type: ignore[index]
            return found[0] * found[1][0], found[0] * found[1][1]
        return sum(x for x, _ in found), sum(y for _, y in found)


WRITTEN_OUT = 5
"""The largest N that is written out: at 7 the loops take the same time, and 4 % of the text."""


def torus_program(
    d: Derivation,
    torus: TorusLattice,
    options: Options | None = None,
    events: Sequence[EmittedEvent] = (),
) -> Program:
    """The program of a record on the torus; ``LoweringError`` for an option that it has not.
    ``events``: what is watched on a motion."""
    chosen = options or Options()
    require_on_torus(d, torus, chosen)
    forcing = EmittedForcing.of(d, torus)
    functions = looped(torus, forcing, chosen)
    if torus.N <= WRITTEN_OUT:
        own, constants = _written_out(d, torus, forcing, chosen)
    else:
        own, constants = _constants(forcing)
    functions |= own
    with_loops = {*functions} - {*own}
    acting = forcing.described()
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
            f"dW/dt = N/(4 pi i) [W, P]{' + F' * bool(acting)}, N = {torus.N}, "
            "W = sum omega(n) T_n the vorticity and",
            "P = -sum omega(n)/|n|^2 T_n the stream function, in space sums of e^(i n.x);",
            *acting,
            "energy is the sum of |omega(n)|^2/(2 |n|^2), the mean of half the squared velocity"
            + ("; trace_k is Tr W^k/N." if chosen.conserved else "."),
            *described(torus),
            *([of_plain_variations(torus.N**2 - 1)] * bool(chosen.jacobian)),
            *(_scratch(torus) if torus.N > TABLE else ()),
        ),
        torus.coefficients,
        tuple(parameter(d, x) for x in forcing.parameters),
        forcing.inputs,
        constants,
        (),
        functions,
        conserved=CONSERVED if chosen.conserved else (),
        events=table(events),
        loops=loops(torus, with_loops, forcing) if with_loops else None,
        on_torus=True,
        varied=torus.N**2 - 1 if chosen.jacobian else 0,
    )


def require_on_torus(d: Derivation, torus: TorusLattice, chosen: Options) -> None:
    """``LoweringError`` for an option that is not written on the torus."""
    where = "on the torus, whose state is the vorticity alone (--jacobian state is ∂(dx/dt)/∂x)"
    require_options(d, chosen, where, "state", "inputs", "parameters")
    require_columns(d, chosen)
    if "parameters" in chosen.jacobian and not EmittedForcing.of(d, torus).parameters:
        raise LoweringError(f"{d.name}: there are no parameters to linearise in")
    if "state" in chosen.jacobian and (entries := (torus.N**2 - 1) ** 2) > SLOPES_IN_LOOPS:
        raise LoweringError(
            f"{d.name}: --jacobian state is a matrix of {entries} entries, at most "
            f"{SLOPES_IN_LOOPS}: leave it out; its product with v is (rhs(x + v) - rhs(x - v))/2"
        )


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


def _constants(forcing: EmittedForcing) -> tuple[dict[str, EmittedFunction], tuple[str, ...]]:
    """The coefficients of damping that loops read, power by power, and their names."""
    claimed = ClaimedNames()
    made, powers = forcing.function(forcing.damping, claimed), range(len(forcing.damping))
    constants = tuple(claimed.claim(f"damping_{p}", f"power {p}") for p in powers)
    return {"constants": made}, constants


def _written_out(
    d: Derivation, torus: TorusLattice, forcing: EmittedForcing, chosen: Options
) -> tuple[dict[str, EmittedFunction], tuple[str, ...]]:
    """The functions of the record's equations, term by term, and the names of the constants."""
    graph = Graph()
    state = _leaves(graph, torus)
    inputs = [graph.leaf(x, "input") for x in forcing.inputs]
    out = WrittenOut(torus, graph, [*state.values()], inputs)
    motion, energy = d["motion"].equations[0].rhs, d["energy"].equations[0].rhs
    rates = [x for n in torus.half_plane for x in out.value(motion, {"𝐧": n})]
    wanted: dict[str, list[Node]] = {"rhs": rates, "energy": [out.value(energy, {}).re]}
    known = [graph.leaf(x, "parameter") for x in forcing.parameters]
    leaves = {"state": [*state.values()], "inputs": inputs, "parameters": known}
    slopes = {by: by_numbers(graph, rates, leaves[by]) for by in chosen.jacobian}
    if "state" in slopes:
        wanted["jacobian"] = [*rates, *slopes["state"]]
    if "inputs" in slopes:
        wanted["jacobian_inputs"] = slopes["inputs"]
    wanted = {name: factored(graph, found) for name, found in wanted.items()}
    claimed = ClaimedNames()
    places = leaf_places(claimed, state.values(), "x") | leaf_places(claimed, inputs, "u")
    given = leaf_places(claimed, known, "p")
    scheduler = Scheduler(claimed, {})
    fixed = frontier(x for found in wanted.values() for x in found)
    constants = tuple(claimed.claim(f"sine_{i}", f"node {x.id}") for i, x in enumerate(fixed, 1))
    kept = {x: (name, ("k", i)) for i, (x, name) in enumerate(zip(fixed, constants, strict=True))}
    functions = {"constants": scheduler.function(fixed, given)}
    functions |= {name: scheduler.function(x, places | kept) for name, x in wanted.items()}
    if "parameters" in slopes:
        found = factored(graph, slopes["parameters"])
        functions["jacobian_parameters"] = scheduler.function(found, places | given)
    return functions, constants


def _leaves(graph: Graph, torus: TorusLattice) -> dict[str, Node]:
    return {x: graph.leaf(x, "state") for x in torus.coefficients}


def _watched(name: str, torus: TorusLattice, events: Sequence[EmittedEvent]) -> EmittedFunction:
    """What becomes 0 at each event."""
    graph, claimed = Graph(), ClaimedNames()
    state = _leaves(graph, torus)
    found = values_of(name, events, graph, state)
    time = {graph.leaf("t", "time"): ("t", ("t", 0))}
    places = leaf_places(claimed, state.values(), "x") | time
    return Scheduler(claimed, {}).function(found, places)
