"""What acts from outside on a fluid on the torus, as its program reads it; and the loops of one for
large N: their tables, what they cost, and their bodies, which the printers of routines write."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple

import mpmath

from ..algebra.structure import Place, TorusLattice
from ..language.derivatives import derivative
from ..language.expression import names
from ..language.show import show
from ..language.tree import Tree
from ..language.values import value
from ..record.as_json import decode
from ..record.record import Derivation
from ..routines import PRINTERS, printer_of, text_of
from .graph import Graph
from .languages import Statements
from .naming import ClaimedNames, plain_text
from .options import Options
from .program import EmittedFunction, Load, Program
from .schedule import Scheduler, leaf_places

TABLE = 7
"""The largest N of which C has a table of terms: at 9 the matrices take less time."""
POWERS = (2, 3, 4)
CONSERVED = tuple(f"trace_{k}" for k in POWERS)
"""What ``conserved`` gives: Tr Wᵏ/N, in space the mean of the k-th power of the vorticity."""
DIGITS = 60
"""To so many cosines and pi are known before they are rounded: the same on every machine."""


@dataclass(frozen=True)
class EmittedForcing:
    """What acts from outside in a record: the names of the numbers of its input; ``damping``: a
    coefficient for each power of |n|², 0 where there is none; ``parameters``: those in these."""

    inputs: tuple[str, ...]
    damping: tuple[Tree, ...]
    parameters: tuple[str, ...]

    @staticmethod
    def of(d: Derivation, torus: TorusLattice) -> EmittedForcing:
        """That of a record."""
        told = {x["power"]: decode(x["coefficient"], "damping") for x in d.problem["damping"]}
        inputs = (f"{x['name']}_{y}" for x in d.problem["inputs"] for y in torus.coefficients)
        used = {name for t in told.values() for name in names(t)}
        return EmittedForcing(
            tuple(inputs),
            tuple(told.get(p, 0) for p in range(max(told, default=-1) + 1)),
            tuple(x for x in d.problem["parameters"] if x in used),
        )

    @property
    def damping_slopes(self) -> tuple[Tree, ...]:
        """The derivatives of the coefficients of damping by the parameters, power by power."""
        leaves = [("par", x) for x in self.parameters]
        return tuple(derivative(t, x) for t in self.damping for x in leaves)

    def function(self, wanted: Sequence[Tree], claimed: ClaimedNames) -> EmittedFunction:
        """A function of the parameters alone."""
        graph = Graph()
        known = {x: graph.leaf(x, "parameter") for x in self.parameters}
        given = leaf_places(claimed, known.values(), "p")
        found = [value(t, {}, known, graph.function, graph.num) for t in wanted]
        return Scheduler(claimed, {}).function(found, given)

    def described(self) -> tuple[str, ...]:
        """In words, for the head of a file."""
        found = ["and F = sum f(n) T_n is what acts from outside, where f(n) has"]
        if self.inputs:
            name = self.inputs[0].removesuffix("_re_1_0")
            found.append(
                f"the input {name}: Re and Im of its coefficients, in the order of the state;"
            )
        if self.damping:
            size = {0: ""} | {p: f" |n|^{2 * p}" for p in range(1, len(self.damping))}
            coefficients = ((p, plain_text(show(t))) for p, t in enumerate(self.damping) if t != 0)
            told = [f"({t if t.isascii() else 'a number'}){size[p]}" for p, t in coefficients]
            found += textwrap.wrap(f"the damping -({' + '.join(told)}) omega(n);", 88)
        return tuple(found) if self.inputs or self.damping else ()


class ConvolutionTerm(NamedTuple):
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
    and what the functions with loops, by ``names``, cost.  ``driven``: is there an input?
    ``damping``: so many constants are coefficients of powers of |n|², by so many ``parameters``."""

    N: int
    names: frozenset[str]
    cosines: tuple[Fraction, ...]
    sines: tuple[Fraction, ...]
    table: tuple[tuple[ConvolutionTerm, ...], ...]
    operations: Mapping[str, str]
    driven: bool = False
    damping: int = 0
    parameters: int = 0

    @property
    def scale(self) -> Fraction:
        """1/4π, as a double."""
        return _rounded(1 / (4 * Fraction(math.pi)))


def loops(torus: TorusLattice, names: Collection[str], forcing: EmittedForcing) -> Loops:
    """The tables for one N."""
    N, h = torus.N, torus.half
    turn, product = 4 * h * (h + 1) ** 2, 4 * N**3
    by_three = 3 * N**3  # products of complex numbers by three real ones
    whole, least = 3 * turn + product, 3 * turn + by_three
    driven, damping = bool(forcing.inputs), len(forcing.damping)
    by_table = N <= TABLE and not (driven or damping)
    table = tuple(_terms(torus, n) for n in torus.half_plane) if by_table else ()
    few = (N * N - 1) * (driven + (damping + 1) * bool(damping))  # of what acts from outside
    terms, pairs = sum(map(len, table)), ((N * N - 1) // 2) ** 2
    return Loops(
        N,
        frozenset(names) | ({"rhs_batch"} if "rhs" in names else set()),
        tuple(_rounded(_cosine(Fraction(k, N))) for k in range(N)),
        tuple(_rounded(_cosine(Fraction(k, N) - Fraction(1, 4))) for k in range(N)),
        table,
        {
            "rhs": f"{whole} mul, {whole} add, and {6 * N * N + few} of less order",
            "rhs by table": f"{8 * terms} mul, {4 * terms} add",
            "rhs by three": f"{least} mul, {least} add, and {9 * N * N + few} of less order",
            "jacobian": f"{11 * pairs} mul, {10 * pairs} add, and {6 * N * N + few} of less order",
            "jacobian_inputs": "none",
            "jacobian_parameters": f"{(damping + 2) * (N * N - 1)} mul for each parameter",
            "energy": f"{N * N - 1} mul, {N * N - 1} add, {(N * N - 1) // 2} div",
            "conserved": f"{turn + product} mul, {turn + product} add",
            "conserved by three": f"{turn + by_three} mul, {turn + by_three} add",
        },
        driven,
        damping,
        len(forcing.parameters),
    )


def _terms(torus: TorusLattice, n: Place) -> tuple[ConvolutionTerm, ...]:
    """The terms of dω̂(n)/dt, m and n − m together: their sines are opposite."""
    found = []
    with mpmath.workdps(DIGITS):
        pi = Fraction(str(mpmath.pi))
    for m in torus.places:
        other = torus.representative((n[0] - m[0], n[1] - m[1]))
        weight = Fraction(1, _square(m)) - Fraction(1, _square(other)) if any(other) else 0
        crossed = (m[0] * n[1] - m[1] * n[0]) % torus.N
        if m < other and weight and crossed:
            (i, turned), (j, turned_too) = torus.position(m), torus.position(other)
            sine = _cosine(Fraction(crossed, torus.N) - Fraction(1, 4))
            c = -_rounded(sine * weight * torus.N / (2 * pi))
            found.append(ConvolutionTerm(i, j, -1 if turned else 1, -1 if turned_too else 1, c))
    return tuple(found)


def _square(n: Place) -> int:
    return n[0] ** 2 + n[1] ** 2


def _rounded(x: Fraction) -> Fraction:
    """The double next to x."""
    return Fraction(float(x))


def _cosine(turns: Fraction) -> Fraction:
    """cos 2π·turns."""
    with mpmath.workdps(DIGITS):
        half_turns = mpmath.mpf(2 * turns.numerator) / turns.denominator
        return Fraction(str(mpmath.cospi(half_turns)))


def looped(
    torus: TorusLattice, forcing: EmittedForcing, chosen: Options
) -> dict[str, EmittedFunction]:
    """Functions of which only what they read and how much they write is said here, that not of
    Jacobians, and of that by parameters the derivatives of the coefficients of damping."""

    def hollow(count: int, reads: str = "x") -> EmittedFunction:
        return EmittedFunction(tuple(Load(x, x, 0) for x in reads), (), (Fraction(0),) * count)

    of_rates = "x" + "u" * bool(forcing.inputs) + "k" * bool(forcing.damping)
    found = {"rhs": hollow(torus.N**2 - 1, of_rates), "energy": hollow(1)}
    if chosen.conserved:
        found["conserved"] = hollow(len(POWERS))
    if "state" in chosen.jacobian:
        found["jacobian"] = hollow(0, of_rates)
    if "inputs" in chosen.jacobian:
        found["jacobian_inputs"] = hollow(0, "")
    if "parameters" in chosen.jacobian:
        slopes = forcing.function(forcing.damping_slopes, ClaimedNames())
        found["jacobian_parameters"] = replace(slopes, loads=(Load("x", "x", 0), *slopes.loads))
    return found


# What the templates are filled with.


def count_loops(loops: Loops, known: Mapping[str, dict[str, Any]], language: str) -> None:
    """Say what the functions with loops cost."""
    for name in loops.names & {*known}:
        of = known[name]["of"] or name
        if language in PRINTERS:
            by = "by table" if language == "c" and loops.table and of == "rhs" else "by three"
            of = f"{of} {by}" if f"{of} {by}" in loops.operations else of
        known[name]["operations"] = loops.operations[of]


def loop_fields(
    p: Program, language: str, written: Statements, fields: Mapping[str, Any]
) -> dict[str, Any]:
    """The template fields of the loops: N, (N − 1)/2, cos and sin of 2πk/N; or the functions that
    have them."""
    tables, printer = p.loops, written.printer
    varied = "jacobian_parameters" in tables.names
    slopes = written.part(p.functions["jacobian_parameters"], "p") if varied else {}
    printed = _printed_sums(language, tables, fields, slopes) if language in PRINTERS else {}
    return printed | {
        "N": tables.N,
        "half": tables.N // 2,
        "names": tables.names,
        "table": [[(*x[:4], printer.number(x.c)) for x in row] for row in tables.table],
        "cosines": [printer.number(x) for x in tables.cosines],
        "sines": [printer.number(x) for x in tables.sines],
        "scale": printer.number(tables.scale),
        "driven": tables.driven,
        "damping": tables.damping,
        "by_parameters": tables.parameters,
    }


OF_MATRICES = ("rhs", "conserved")


def _printed_sums(
    language: str, loops: Loops, fields: Mapping[str, Any], slopes: Mapping[str, Any]
) -> dict[str, Any]:
    """The bodies of these functions by their names; the tables and functions that they need.
    ``slopes``: what ``jacobian_parameters`` has of the parameters alone."""
    N, prefix = loops.N, fields["prefix"]
    size = N * N - 1
    # Julia has the columns of a matrix one after the other, others the rows
    by_columns = language == "julia"
    M = N // 2 + 1
    # in C rows of a multiple of four numbers, which compilers take several at a time
    pad = 4 if language == "c" else 1
    array = "jacobian_parameters_slopes" if language == "javascript" else "slopes"  # as hoisted
    stored = (
        f"{array}[{i + by_columns}] = {x}{PRINTERS[language].end}"
        for i, x in enumerate(slopes.get("outputs", ()))
    )
    given = {
        "written": {"slopes": [*slopes.get("statements", ()), *stored]},
        "N": N,
        "M": M,
        "HALF": N // 2,
        "ROW": -(-N // pad) * pad,
        "COLUMNS": -(-M // pad) * pad,
        "PADDED": pad > 1,
        "DRIVEN": loops.driven,
        "DAMPED": loops.damping > 0,
        "POWERS": loops.damping,
        "PARAMETERS": loops.parameters,
        "SLOPES": loops.damping * loops.parameters,
        "WIDTH": size,
        "DOWN": 1 if by_columns else size,
        "DOWN_PARAMETERS": 1 if by_columns else loops.parameters,
        "ALONG": size if by_columns else 1,
        "FOURS": N - N % 4,
        "SIZE": float(N),
        "SCALE": float(loops.scale),
        "COSINES": [*map(float, loops.cosines)],
        "SINES": [*map(float, loops.sines)],
        "inline": f"{prefix}_FUNCTION" if fields["header"] else "static",
        "item": ["#[allow(clippy::all, clippy::pedantic)]", "#[rustfmt::skip]"],
    }
    printer = printer_of(language, [text_of("torus_sums")], given, prefix, fields["real"])
    routines = printer.source.routines
    by_table = {"rhs"} if loops.table and language == "c" else set()
    named = loops.names & {*fields["functions"]} & {*routines} - by_table
    of_matrices = bool({*OF_MATRICES} & named)
    tables, bodies = list[str](), {}
    for x in sorted(named):
        bodies[x] = "\n".join(printer.body(routines[x]))
        tables += printer.before
    if of_matrices or "jacobian" in named:
        only = () if of_matrices else ("sines",)
        tables = [*printer.tables(*only), *tables]
    return {
        "bodies": bodies,
        "tables": "\n".join(tables),
        "functions": printer.text(["waves", "matrix_of", "added", "row"]) if of_matrices else "",
    }
