"""From a graph to functions: what is computed where; the linearised equations."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ..language.derivatives import DERIVATIVES
from ..language.reserved import suffixed
from ..language.values import value
from .ellipsoid import BUNDLES, is_item, slopes
from .graph import PARAMETER, Graph, Node, reachable
from .naming import ClaimedNames, is_sum, sum_name
from .program import Assignment, Check, EmittedFunction, Expression, Load, Section, negated
from .state import StateSpace

ONE = Fraction(1)
Source = tuple[str, int]
"""The array that an input is read from, and its index."""


@dataclass(frozen=True)
class Scheduler:
    """What turns nodes into functions: names, and equation texts by key, of one program."""

    names: ClaimedNames
    equations: Mapping[str, str]

    def function(
        self,
        outputs: list[Node],
        inputs: Mapping[Node, tuple[str, Source]],
        checks: Iterable[tuple[Node, Node | None]] = (),
    ) -> EmittedFunction:
        """The function that computes ``outputs`` from ``inputs`` (node → name and place).

        ``checks``: nodes that must be positive, with the scales of their rounding errors.
        """
        tests = list(checks)
        roots = outputs + [x for test in tests for x in test if x is not None]
        order = reachable(roots, lambda x: () if x in inputs else x.args)
        uses = Counter(a for x in order if x not in inputs for a in x.args)
        uses.update(roots)
        uses.update(
            a for x in order if x.op == "fun" and x.data in BUNDLES for a in x.args
        )  # by their names
        builder = _Builder(self, inputs, uses, outputs)
        builder.build(order)
        loads = [Load(name, *place) for x, (name, place) in inputs.items() if x in order]
        return EmittedFunction(
            tuple(sorted(loads, key=lambda item: (item.array, item.index))),
            builder.sections(),
            tuple(builder.expression(x) for x in outputs),
            tuple(
                Check(
                    builder.expression(value), None if scale is None else builder.expression(scale)
                )
                for value, scale in tests
            ),
        )


def leaf_places(
    names: ClaimedNames, leaves: Iterable[Node], array: str
) -> dict[Node, tuple[str, Source]]:
    """Leaf → its place in an array; the local name is its own, claimed in ``names``."""
    return {x: (names.claim(x.data[1], " ".join(x.data)), (array, i)) for i, x in enumerate(leaves)}


def frontier(outputs: Iterable[Node]) -> list[Node]:
    """The nodes of the parameters alone that an output, or a node not of these alone, reads."""
    found = reachable(outputs, lambda x: () if x.stage == PARAMETER else x.args)
    return [x for x in found if x.stage == PARAMETER and x.op != "num"]


class _Builder:
    """The statements of one function, as they are made; ``uses``: how often a node is read."""

    def __init__(
        self,
        scheduler: Scheduler,
        inputs: Mapping[Node, tuple[str, Source]],
        uses: Mapping[Node, int],
        outputs: Iterable[Node],
    ):
        self.scheduler, self.inputs, self.uses = scheduler, inputs, uses
        self.outputs = set(outputs)
        self.local: dict[Node, str] = {}
        self.statements: list[tuple[str, Assignment]] = []

    def build(self, order: list[Node]) -> None:
        """Make the statements, operands before what uses them."""
        named = {x.args[0]: x for x in order if x.op == "value" and x not in self.inputs}
        for x in order:
            if x in self.inputs or x.is_atom or x in self.local:
                continue
            if self._stands_alone(x):
                value = named.get(x, x)  # what is used without its name as well has it all the same
                label = x.graph.titles[value][1] if value.op == "value" else ""
                name = self.scheduler.names.claim(self._wanted(value), f"node {value.id}")
                inner = x.args[0] if x.op == "value" else x
                self.statements.append((label, Assignment(name, self._operation(inner))))
                self.local[x] = self.local[value] = name

    def _stands_alone(self, x: Node) -> bool:
        """Is the value of a node a statement of its own?"""
        if x.op == "value" and x.args[0].op == "fun" and x.args[0].data in BUNDLES:
            return True  # it is several numbers
        if x.op == "value":
            written = _weight(x.args[0])
            if x in self.outputs and written <= 6:
                written = sum(1 + self._inline(y) for y in x.args[0].args)
            return self.uses[x] > 1 or written > 6
        negation = x.op == "add" and len(x.args) == 1 and x.data[0] == -1
        shared = self.uses[x] > 1 and not negation
        return shared and not (x.op == "mul" and _weight(x) < 1)

    def _inline(self, x: Node) -> int:
        """How many operations are written at the place of a summand."""
        return 0 if x in self.local or x in self.inputs else sum(map(self._inline, x.args)) + 1

    def _wanted(self, x: Node) -> str:
        """The name of a statement: that of the value, or made from its operands' names."""
        if x.op == "value":
            return x.graph.titles[x][0]
        parts = [self._short(a) for a in x.args]
        if not all(parts) or (x.op != "add" and any(map(is_sum, parts))):
            found = ""
        elif x.op == "abs":
            found = f"size_{parts[0]}"
        elif x.op in ("mul", "recip") and len(parts) <= 3:
            found = ("inv_" if x.op == "recip" else "") + "_".join(parts)
        else:
            found = sum_name(x.data, parts) if x.op == "add" else ""
        return found or suffixed("part", len(self.statements) + 1)

    def _short(self, x: Node) -> str:
        """The name that a node has already; else empty."""
        if x in self.inputs:
            return self.inputs[x][0]
        return self.local.get(x, "")

    def sections(self) -> tuple[Section, ...]:
        """Consecutive statements of one label; unlabelled ones go with what follows."""
        labelled: list[tuple[str, Assignment]] = []
        following = self.statements[-1][0] if self.statements else ""
        for label, statement in reversed(self.statements):
            following = label or following
            labelled.append((following, statement))
        groups: list[tuple[str, list[Assignment]]] = []
        for label, statement in reversed(labelled):
            if not groups or groups[-1][0] != label:
                groups.append((label, []))
            groups[-1][1].append(statement)
        equations = self.scheduler.equations
        return tuple(Section(label, equations.get(label, ""), tuple(v)) for label, v in groups)

    # -- expressions -------------------------------------------------------------------------

    def expression(self, x: Node) -> Expression:
        """How a node is written where it is used: its name, or its operation."""
        if x in self.inputs:
            return self.inputs[x][0]
        return self.local[x] if x in self.local else self._operation(x)

    def _operation(self, x: Node) -> Expression:
        if x.op == "num":
            number: Fraction = x.data
            return number
        if x.op == "value":
            return self.expression(x.args[0])
        if x.op == "recip":
            return ("div", ONE, self.expression(x.args[0]))
        if x.op == "fun" and x.data == "abs":
            return ("abs", self.expression(x.args[0]))
        if x.op == "fun":
            return ("fun", x.data, *map(self.expression, x.args))
        if x.op in ("abs", "none"):
            return (x.op, self.expression(x.args[0]))
        if x.op == "mul":
            return self._product(x.args)
        if x.op == "add":
            return self._sum(x)
        raise ValueError(f"no place for the input {x.data!r}")

    def _product(self, factors: tuple[Node, ...]) -> Expression:
        """A product or quotient of the factors, reciprocals below the bar."""
        above = [x for x in factors if x.op != "recip" or x in self.local or x in self.inputs]
        below = [x.args[0] for x in factors if x not in above]
        numerator = _times([self.expression(x) for x in above] or [ONE])
        return (
            ("div", numerator, _times([self.expression(x) for x in below])) if below else numerator
        )

    def _sum(self, x: Node) -> Expression:
        terms = zip(x.data, map(self.expression, x.args), strict=True)
        ordered = sorted(terms, key=lambda term: term[0] < 0)
        return ("add", *(_term(c, e) for c, e in ordered))


def _times(factors: list[Expression]) -> Expression:
    """The product of expressions; of one, itself."""
    return factors[0] if len(factors) == 1 else ("mul", *factors)


def _term(c: Fraction, e: Expression) -> Expression:
    """The expression c e, as a term of a sum."""
    size = abs(c)
    if size != 1:
        factors = e[1:] if isinstance(e, tuple) and e[0] == "mul" else (e,)
        e = size if e == ONE else ("mul", size, *factors)
    return e if c > 0 else negated(e)


def _weight(x: Node) -> int:
    """How many operations a node itself takes."""
    if x.op == "add":
        return sum(1 + (y.op == "mul") * (len(y.args) - 1) for y in x.args)
    return len(x.args) - 1 if x.op == "mul" else 1


# The linearised equations: exact derivatives of the rates, on the graph.
#
# A variation of the state is δg = g η, η = Σ η_a E_a, and δζ. With δ(g⁻¹ġ) = η̇ + [Z, η]
#
# η̇ = δζ − [Z, η], δζ̇ = ∂ζ̇/∂η η + ∂ζ̇/∂ζ δζ,
#
# on the right, with δg = η g, η̇ = δζ + [Z, η]; and the same with inputs and parameters in place
# of η, δζ.  Where there is no g a variation is what its numbers change by.


class Directional:
    """Directional derivatives of nodes, named ``d_…_name``; ``seeds``: leaf → its derivative."""

    def __init__(self, graph: Graph, seeds: Mapping[Node, Node], name: str):
        self.graph, self.name = graph, name
        self.zero = graph.num(0)
        self._done: dict[Node, Node] = dict(seeds)

    def of(self, x: Node) -> Node:
        """The derivative of a node; leaves without a seed are constant."""
        if x not in self._done:
            self._done[x] = self._derivative(x)
        return self._done[x]

    def _derivative(self, x: Node) -> Node:
        g = self.graph
        if x.op in ("num", "leaf", "none"):
            return self.zero
        if x.op == "value":
            title, label, _ = g.titles[x]
            return g.value(self.of(x.args[0]), f"d_{title}_{self.name}", label)
        if x.op == "add":
            return g.linear((c, self.of(y)) for c, y in zip(x.data, x.args, strict=True))
        if x.op == "mul":
            return g.sum(self._factors(x.args))
        if x.op == "fun" and is_item(x.data):
            return g.sum(g.product((slope, self.of(y))) for y, slope in slopes(x))
        inner = self.of(x.args[0])
        if inner.is_zero:
            return self.zero
        if x.op == "recip":
            return g.linear([(Fraction(-1), g.product((x, x, inner)))])
        if x.op == "fun" and x.data == "abs":
            return g.product((x.args[0], inner, self._reciprocal(x)))
        if _is_norm(x):
            return g.product((g.num(Fraction(1, 2)), inner, self._reciprocal(x)))
        if x.op == "fun":
            slope = value(DERIVATIVES[x.data]("x"), {"x": x.args[0]}, None, g.function, g.num)
            return g.product((slope, inner))
        raise ValueError(f"no derivative of {x.op!r}")

    def _reciprocal(self, x: Node) -> Node:
        """1/x of a length, or at 0 any number, of which its derivative makes 0: right for ‖v‖v, and
        as good as any for ‖v‖, which has none."""
        g = self.graph
        return g.recip(x if g.has_reciprocal(x) else x + g.none(x))

    def _factors(self, factors: Sequence[Node]) -> Iterable[Node]:
        """The terms of the derivative of a product."""
        for k, y in enumerate(factors):
            varied = self.of(y)
            if not varied.is_zero:
                yield self.graph.product([*factors[:k], varied, *factors[k + 1 :]])


def _is_norm(x: Node) -> bool:
    """Is it the root of a sum of squares, with no number among them?"""
    if x.op != "fun" or x.data != "sqrt":
        return False
    inside = x.args[0].args[0] if x.args[0].op == "value" else x.args[0]
    if inside.op == "add":
        return min(inside.data) > 0 and all(map(_is_square, inside.args))
    return _is_square(inside)


def _is_square(x: Node) -> bool:
    """Is it a product in which each factor stands an even number of times?"""
    return x.op == "mul" and all(x.args.count(y) % 2 == 0 for y in x.args)


def by_state(space: StateSpace, second: list[Node]) -> list[Node]:
    """The matrix, by rows, of V ↦ V̇ for variations V of the state; ``second``: the rates of what is
    varied after η, ζ̇ (and ẇ), masses, or all numbers where there is no η.

    On a quotient V stands for all variations that differ from it by symmetries: what η̇ has along
    them is taken away with the δζ that belongs to it.
    """
    g, free, masses = space.graph, space.free, len(space.stored)
    turning = [
        [*(row[b] if space.right else -row[b] for b in free)]
        + [g.num(int(a == b)) for b in free]
        + [g.num(0)] * masses
        for a, row in enumerate(_adjoint(space) if free else ())
    ]
    varied = variations(space)
    rows = [turning[a] for a in free] + [[v.of(x) for v in varied] for x in second]
    for k, (n, moved) in zip(space.held, infinitesimal_symmetries(space), strict=True):
        own = [g.num(n[a]) for a in free] + [moved[a] for a in free]
        rows = [
            [x - y * along for x, along in zip(row, turning[k - 1], strict=True)]
            for row, y in zip(rows, own, strict=True)
        ]
    return [x for row in rows for x in row]


def variations(space: StateSpace) -> list[Directional]:
    """The derivatives along a basis of the variations of the state."""
    return [Directional(space.graph, seeds, name) for name, seeds in space.variations().items()]


def infinitesimal_symmetries(space: StateSpace) -> list[tuple[Sequence[Fraction], list[Node]]]:
    """Of each symmetry of a quotient its η = n, constant, and its δζ = [ζ, n], on the right
    [n, ζ], as far as it is not along symmetries, where ζ is held."""
    g, ad, found = space.graph, _adjoint(space) if space.null else [], []
    for n in space.null:
        side = -1 if space.right else 1
        moved = [g.linear((side * n[b], x) for b, x in enumerate(row) if n[b]) for row in ad]
        along = [(moved[k - 1], m) for k, m in zip(space.held, space.null, strict=True)]
        found.append(
            (n, [g.sum([y, *(x * -m[a] for x, m in along if m[a])]) for a, y in enumerate(moved)])
        )
    return found


def symmetries(space: StateSpace) -> list[Directional]:
    """The derivatives along these."""
    g, found = space.graph, []
    for n, moved in infinitesimal_symmetries(space):
        seeds: dict[Node, list[Node]] = {space.coordinates[a]: [moved[a]] for a in space.free}
        for a, x in enumerate(n):
            for leaf, y in space.along(a).items() if x else ():
                seeds.setdefault(leaf, []).append(y * x)
        found.append(Directional(g, {x: g.sum(y) for x, y in seeds.items()}, "symmetry"))
    return found


def of_velocity(space: StateSpace) -> list[Directional]:
    """Those along δζ alone."""
    g, span = space.graph, range(space.group.dimension)
    return [Directional(g, space.faster(a), f"zeta_{a + 1}") for a in span]


def by_leaves(space: StateSpace, second: list[Node], leaves: Sequence[Node]) -> list[Node]:
    """∂V̇/∂leaves by rows, for inputs or parameters: 0 for η, then those of ``by_state``."""
    zeros = [space.graph.num(0)] * (len(space.free) * len(leaves))
    return zeros + by_numbers(space.graph, second, leaves)


def by_numbers(graph: Graph, rates: list[Node], state: Sequence[Node]) -> list[Node]:
    """∂ẋ/∂x by rows, of the numbers of the state as they are stored, on the group and off it."""
    varied = [Directional(graph, {x: graph.num(1)}, str(x.data[1])) for x in state]
    return [v.of(x) for x in rates for v in varied]


def _adjoint(space: StateSpace) -> list[list[Node]]:
    """The matrix of ad_Z = [Z, ·] in the basis: Σ_c ζ_c [E_c, E_b]ᵃ."""
    g, d = space.graph, space.group.dimension
    constants, zeta = space.group.structure_constants, space.coordinates
    return [
        [
            g.linear((constants[c][b][a], zeta[c]) for c in range(d) if constants[c][b][a])
            for b in range(d)
        ]
        for a in range(d)
    ]
