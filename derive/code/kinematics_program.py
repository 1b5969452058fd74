"""The program of kinematics of first order: the estimate g with the covariance P of its error.

dg/dt = f(g) and dP/dt = 𝒜P + P𝒜ᵀ + G Q Gᵀ, by the equations of the record; P by the rows of its
upper triangle.  The update by an observation is among the functions of the group.
"""

from __future__ import annotations

import textwrap

from ..algebra.groups import Group
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..language.tree import Tree, nodes, replaced
from ..language.values import value
from ..record.as_json import decode
from ..record.record import Derivation
from .conventions import said
from .factor import factored
from .graph import Graph, Node
from .group_functions import GroupFunctions
from .naming import ClaimedNames
from .options import Options
from .program import LoweringError, Program
from .requests import require_options
from .schedule import Scheduler, frontier, leaf_places
from .slots import layout, still_slots

SIDES = {"left": "L", "right": "R"}
"""The side of an error, as the names of the record have it."""


def kinematics_program(d: Derivation, group: Group, options: Options | None = None) -> Program:
    """The program of a record; ``LoweringError`` for an option that it has not, or where the errors
    do not move by themselves."""
    chosen = options or Options()
    require_kinematics(d, chosen)
    filtering = _Filter(d, group)
    graph, names = filtering.graph, filtering.names
    wanted = {
        "rhs": [*filtering.rates(), *filtering.covariance_rates()],
        "error_generator": list(q.flatten(filtering.generator)),
        "error_noise": list(q.flatten(filtering.noise)),
    }
    wanted = {name: factored(graph, found) for name, found in wanted.items()}
    claimed = ClaimedNames()
    places = leaf_places(claimed, (graph.leaf(x, "state") for x in names), "x")
    places |= leaf_places(claimed, (graph.leaf(x, "input") for x in filtering.inputs), "u")
    fixed = frontier(x for found in wanted.values() for x in found)
    known = d.problem["parameters"]
    from_p = leaf_places(claimed, (graph.leaf(x, "parameter") for x in known), "p")
    constants = [
        claimed.claim(x.data[1] if x.op == "leaf" else suffixed("constant", i), f"constant {i}")
        for i, x in enumerate(fixed)
    ]
    kept = {x: (name, ("k", i)) for i, (x, name) in enumerate(zip(fixed, constants, strict=True))}
    scheduler = Scheduler(claimed, {})
    functions = {"constants": scheduler.function(fixed, from_p)}
    functions |= {name: scheduler.function(x, places | kept) for name, x in wanted.items()}
    right = filtering.side == "right"
    return Program(
        d.name,
        str(d.problem.get("title", "")),
        group.name,
        group.dimension,
        _conventions(filtering),
        tuple(names),
        tuple((x, p["default"], p["unit"], p["meaning"]) for x, p in known.items()),
        tuple(filtering.inputs),
        tuple(constants),
        group.basis,
        functions,
        variation="eta g" if right else "g eta",
        group_functions=filtering.functions if chosen.exponential else None,
    )


def require_kinematics(d: Derivation, chosen: Options) -> None:
    """``LoweringError`` for an option that is not written, and where the velocity is not
    group-affine."""
    if not any(x.label == f"{d.name}.affine" for x in d.steps):
        raise LoweringError(
            f"{d.name}: its velocity is not group-affine, so that the errors do not move by "
            f"themselves and there is no filter: step {d.name}.counterexample"
        )
    require_options(d, chosen, "for kinematics of first order", "exponential")
    if chosen.conserved:
        raise LoweringError(f"{d.name}: --conserved is of a Lagrangian, which kinematics have not")


class _Filter:
    """The numbers of a filter as nodes: ``A``, the estimate; ``P``, the covariance; ``generator``,
    𝒜 on the side of the error; ``noise``, G, d × inputs."""

    def __init__(self, d: Derivation, group: Group):
        self.d, self.group, self.graph = d, group, Graph()
        given = d.problem["kinematics"]
        self.side, self.inputs = str(given["error"]), [str(x) for x in given["inputs"]]
        still = still_slots(group)
        self.slots = [x for x in layout(group) if x not in still]
        self.functions = GroupFunctions.of_group(
            group, self.slots, still, right=self.side == "right", covariance=True
        )
        num, d_ = self.graph.num, range(group.dimension)
        self.names = [x.name for x in self.slots]
        leaves = [self._leaf(x) for x in self.names]
        rows = [[num(x) for x in row] for row in self.functions.origin]
        for x, leaf in zip(self.slots, leaves, strict=True):
            rows[x.row][x.column] = leaf
        self.A: Matrix = tuple(map(tuple, rows))
        triangle = {(a, b): suffixed("P", a + 1, b + 1) for a in d_ for b in d_ if a <= b}
        self.names += triangle.values()
        self.P: Matrix = tuple(
            tuple(self._leaf(triangle[min(a, b), max(a, b)]) for b in d_) for a in d_
        )
        self.triangle = [*triangle]
        side = SIDES[self.side]
        self.generator = self.matrix(self._definition("log_linear", f"𝒜_{side}"))
        self.noise = q.transposed(tuple(self._column(j) for j in range(len(self.inputs))))
        self.densities = [self.number(decode(x, "problem, noise")) for x in given.get("noise", ())]

    def _leaf(self, name: str) -> Node:
        return self.graph.leaf(name, "state")

    def _definition(self, step: str, name: Tree) -> Tree:
        """What an equation of a step says that a name, or f(A), is."""
        return next(e.rhs for e in self.d[step].equations if e.lhs == name)

    # -- trees ---------------------------------------------------------------------------------

    def tree(self, t: Tree, **known: Matrix) -> object:
        """The value of a tree in the entries of A, inputs and parameters, and matrices by name."""
        for x in {*nodes(t)}:
            if isinstance(x, tuple) and x[:2] in (("entry", "A"), ("entry", "Â")):
                t = replaced(t, x, ("par", f"{x[2]} {x[3]}"))
        kinds = dict.fromkeys(self.d.problem["parameters"], "parameter")
        kinds |= dict.fromkeys(self.inputs, "input")
        leaves = {x: self.graph.leaf(x, kind) for x, kind in kinds.items()}
        span = range(self.group.size)
        leaves |= {f"{i + 1} {j + 1}": self.A[i][j] for i in span for j in span}
        return value(t, known, leaves, self.graph.function, self.graph.num)

    def number(self, t: Tree) -> Node:
        """The value of one that is a number."""
        found = self.tree(t)
        assert isinstance(found, Node)
        return found

    def matrix(self, t: Tree, **known: Matrix) -> Matrix:
        """The value of one that is a matrix."""
        found = self.tree(t, **known)
        assert isinstance(found, tuple)
        return found

    def _column(self, j: int) -> tuple[Node, ...]:
        """The coordinates of W for a noise of 1 on one input, from 0."""
        names = {f"W_{x}": self._definition("noise", f"W_{x}") for x in SIDES.values()}
        wanted = names[f"W_{SIDES[self.side]}"]
        for name, t in names.items():  # one is told by the other
            wanted = replaced(wanted, name, t)
        for i in range(len(self.inputs)):
            wanted = replaced(wanted, ("entry", "ς", i + 1), int(i == j))
        back = replaced(wanted, ("inv", "Â"), "back")
        W = self.matrix(back, **{"Â": self.A, "back": self._back()} if back != wanted else {})
        return tuple(
            self.graph.linear((c, W[i][k]) for c, i, k in self.group.coordinate_terms(a))
            for a in range(self.group.dimension)
        )

    def _back(self) -> Matrix:
        """A⁻¹, of factors [[R, S], [0, 1]]: R̄, and −R̄S beside it."""
        if not self.functions.factors:
            raise LoweringError(
                f"{self.d.name}: the noise depends on the estimate, by an inverse that is written "
                "for SO(2), SO(3), SE(2), SE(3), translations, groups inside of these and products"
            )
        rows = [[self.graph.num(x) for x in row] for row in q.identity(self.group.size)]
        for f in self.functions.factors:
            turned = range(f.start, f.start + f.rows)
            for i in turned:
                for j in turned:
                    rows[i][j] = self.A[j][i]
                for j in range(f.start + f.rows, f.end):
                    rows[i][j] = -self.graph.sum([self.A[k][i] * self.A[k][j] for k in turned])
        return tuple(map(tuple, rows))

    # -- rates ---------------------------------------------------------------------------------

    def rates(self) -> list[Node]:
        """Those of the entries of the estimate."""
        found = self.matrix(self._definition("kinematics", ("call", "ℱ", "A")))
        return [found[x.row][x.column] for x in self.slots]

    def covariance_rates(self) -> list[Node]:
        """Those of the upper triangle of P."""
        moved = q.times(self.generator, self.P)
        scaled = [
            tuple(x * density for x in column)
            for column, density in zip(q.transposed(self.noise), self.densities, strict=False)
        ]
        columns = q.transposed(self.noise)
        return [
            self.graph.sum(
                (
                    moved[a][b],
                    moved[b][a],
                    *(x[a] * y[b] for x, y in zip(scaled, columns, strict=False)),
                )
            )
            for a, b in self.triangle
        ]


def _conventions(x: _Filter) -> tuple[str, ...]:
    """What a reader of the files must know, in lines."""
    moved = "g exp(xi)" if x.side == "left" else "exp(xi) g"
    text = said("filter", group=x.group.name, moved=moved, side=x.side)
    return (*textwrap.wrap(text, 92),)
