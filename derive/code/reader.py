"""Reading a record for code: which names are inputs, and which equation defines the others."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, partial

from ..algebra.groups import Group
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import block_of, numbers_of_input, suffixed
from ..language.tree import Tree, nodes
from ..record.record import Derivation, Equation, Step
from . import dense
from .graph import Graph, Node
from .naming import name_of
from .options import Options
from .program import LoweringError
from .state_forms import by_velocity, state_of

Value = Node | Matrix


def scalar(value: Value) -> Node:
    """The value if it is a number, or a matrix of one entry; ``LoweringError`` for another."""
    if not isinstance(value, Node) and len(value) == 1 == len(value[0]):
        value = value[0][0]
    if not isinstance(value, Node):
        raise LoweringError("a matrix stands where a number is wanted")
    return value


def matrix(value: Value) -> Matrix:
    """The value as a matrix; a number is one of one entry, as the vectors of a line are."""
    return ((value,),) if isinstance(value, Node) else value


DROPPED = Equation(("mul", ("T", "ξ"), "C", "Z"), ("mul", ("T", "ξ"), "Z"))


class RecordReader:
    """The values of the names of one record; ``tree``: how the value of a tree is computed."""

    def __init__(
        self,
        d: Derivation,
        group: Group,
        options: Options,
        graph: Graph,
        tree: Callable[[Tree], Value],
    ):
        self.record, self.group, self.n = d, group, group.n
        self.graph, self.options, self.tree = graph, options, tree
        self.space = state_of(d.problem, graph, group, options)
        self.label = ""
        self.memo: dict[Tree, Value] = {}
        self._inputs()

    # -- inputs ------------------------------------------------------------------------------

    def _inputs(self) -> None:
        """Set the values of the state's names, and of the problem's inputs."""
        n, d = self.n, self.group.dimension
        self.state: dict[str, Value] = dict(self.space.values)
        self.memo |= {("par", name): leaf for name, leaf in self.space.stored.items()}
        self.state["t"] = self.leaf("t", "time")
        self.inputs: list[str] = []
        self.forces: list[Matrix] = []
        for entry in self.record.problem.get("inputs", []):
            name = entry["name"]
            if entry["kind"] == "scalar":
                self._given([name])
                continue
            if entry["kind"] != "covector":
                _, factor = self.group.places[block_of(self.record.problem, entry) - 1]
                named = numbers_of_input(entry, factor.n)
                self.forces.append(self._given(named))
                continue
            moved = self.group.turns_space and self.group.affine
            self.state["u"] = self._input_column(name, d - n if moved else d)
            if moved:
                self.state["f_u"] = self._input_column(name, n, d - n)
        both = [matrix(self.state[name]) for name in ("u", "f_u") if name in self.state]
        self.covector: list[Node] = [x for column in both for (x,) in column]
        if self.group.user_basis and self.covector:
            self._from_user_basis()

    def _from_user_basis(self) -> None:
        """Set u and f_u in the basis of the record, from inputs in the stated basis."""
        columns = [self.group.in_user_basis.nearest(e) for e in self.group.basis]
        rows = tuple((self.graph.linear(zip(c, self.covector, strict=True)),) for c in columns)
        self.state["u"] = rows[:3]
        if self.group.affine:
            self.state["f_u"] = rows[3:]

    @property
    def in_space(self) -> bool:
        """Does the state hold ġ, and the record have the accelerations α̇, τ̇ in space?"""
        return self.space.tangent and self.record.definition("α̇") is not None

    def _input_column(self, name: str, size: int, after: int = 0) -> Matrix:
        """A column of new inputs of the program, ``name_1`` …, counted from ``after`` + 1."""
        return self._given([suffixed(name, i) for i in range(after + 1, after + size + 1)])

    def _given(self, names: Sequence[str]) -> Matrix:
        """A column of new inputs of the program, by their names."""
        found = tuple((self.leaf(x, "input"),) for x in names)
        self.inputs += names
        self.memo |= {("par", x): leaf for x, (leaf,) in zip(names, found, strict=True)}
        return found

    def leaf(self, name: str, kind: str = "state") -> Node:
        """The leaf of a name: a state variable, an input, a parameter or the time, by ``kind``."""
        return self.graph.leaf(name, kind)

    @property
    def state_leaves(self) -> list[Node]:
        """Those of the numbers of the state, in order."""
        return [self.leaf(x) for x in self.space.names]

    @property
    def input_leaves(self) -> list[Node]:
        """Those of the inputs, in order."""
        return [self.leaf(x, "input") for x in self.inputs]

    # -- names -------------------------------------------------------------------------------

    @cached_property
    def equations(self) -> list[tuple[Step, Equation]]:
        """The equations of the record, in order, each with its step."""
        return [(step, e) for step in self.record.steps for e in step.equations]

    def name(self, name: str) -> Value:
        """The value of a name: of an input, or by the last equation that defines it."""
        if name in self.state:
            return self.state[name]
        if name not in self.memo:
            found = self.record.definition(name)
            if found is not None:
                self.memo[name] = self._defined(found, name_of(name), self._rhs(*found))
            else:
                self.memo[name] = self._entries(name)
            if name == "C":
                self.memo[name] = self._without_metric(matrix(self.memo[name]))
        return self.memo[name]

    def _without_metric(self, C: Matrix) -> Matrix:
        """C with 1 for what it is on the images of 𝔤, where the record has ξ̄CZ = ξ̄Z."""
        if not any(e == DROPPED for _, e in self.equations):
            return C
        images = tuple(column for e in self.group.basis for column in q.transposed(e))
        rank, one = q.rank(images), q.identity(self.n)
        inside = [q.rank((*images, e)) == rank for e in one]
        return tuple(
            tuple(
                self.graph.num(one[i][j]) if inside[i] and inside[j] else x
                for j, x in enumerate(row)
            )
            for i, row in enumerate(C)
        )

    def _entries(self, name: str) -> Matrix:
        """A vector or matrix that the record defines entry by entry, for any indices."""
        for step, e in self.equations:
            match e.lhs:
                case ("entry", head, *indices) if head == name:
                    if all(isinstance(i, str) for i in indices):
                        return self._table(name_of(name), step, e, indices)
        raise LoweringError(f"the record does not define {name!r}")

    def _table(self, name: str, step: Step, e: Equation, indices: list[str]) -> Matrix:
        """The vector or matrix whose entry with ``indices`` is the left side of an equation."""
        span = range(1, len(self.group.linear_basis) + 1)
        outer, self.label = self.label, step.key(e)

        def entry(*values: int) -> Node:
            value = scalar(self.tree(bound(e.rhs, dict(zip(indices, values, strict=True)))))
            return self.graph.value(value, suffixed(name, *values), self.label, recorded=True)

        columns = span if len(indices) == 2 else (None,)
        table = tuple(tuple(entry(i) if j is None else entry(i, j) for j in columns) for i in span)
        self.label = outer
        return table

    def _rhs(self, _: Step, equation: Equation) -> Tree:
        """The right side of a definition; of the energy by the velocity in space."""
        if equation.lhs != "h̃":
            return equation.rhs
        return by_velocity(equation.rhs, self.space.velocity_names)

    def _defined(self, found: tuple[Step, Equation], name: str, rhs: Tree | None = None) -> Value:
        """The value of the right side of a definition, or of what stands for it, named unless it is
        J from a given I."""
        step, equation = found
        outer, self.label = self.label, step.key(equation)
        value = self.tree(equation.rhs if rhs is None else rhs)
        # a J that comes from a given I goes back to it: its terms cancel before they are rounded
        if equation.lhs != "J" or not _sums_of_parameters(value):
            value = self.named(value, name, recorded=True)
        self.label = outer
        return value

    def named(self, value: Value, name: str, *, recorded: bool = False) -> Value:
        """The value under a name, or a matrix whose entries have names."""
        if isinstance(value, Node):
            return self.graph.value(value, name, self.label, recorded=recorded)
        return self.entries(value, name, recorded=recorded)

    def entries(self, m: Matrix, name: str, *, recorded: bool = False) -> Matrix:
        """The matrix with its entries named; those of a column have one index."""
        value = partial(self.graph.value, label=self.label, recorded=recorded)
        return dense.entrywise(m, name, value, len(m[0]) == 1)

    def member(self, t: Tree) -> Value:
        """The value of a member of a family, as E_2 or r_1, by the equation that defines it."""
        if t not in self.memo and isinstance(t, tuple) and t[1] == "E":
            basis = self.group.linear_part(self.group.basis[t[2] - 1])
            self.memo[t] = dense.numbers(self.graph, basis)
        if t not in self.memo:
            found = self.record.definition(t)
            if found is None:
                raise LoweringError(f"the record does not define {t!r}")
            self.memo[t] = self._defined(found, name_of(t))
        return self.memo[t]

    def component(self, name: str, index: int) -> Node:
        """Entry ``index``, from 1, of a vector of the record, or what it defines entry by entry."""
        found = self.record.definition(("entry", name, index))
        if found is not None and self.record.definition(name) is None:
            return scalar(self._defined(found, suffixed(name_of(name), index)))
        entry: Node = self.vector(name)[index - 1][0]
        return entry

    def vector(self, name: str) -> Matrix:
        """The value of a name that is a vector or a matrix; else ``LoweringError``."""
        return matrix(self.name(name))

    def number(self, name: str) -> Node:
        """The value of a name that is a number; else ``LoweringError``."""
        return scalar(self.name(name))

    def number_of(self, member: Tree) -> Node:
        """The value of a member of a family, as Π_2, a number."""
        return scalar(self.member(member))

    def members(self, body: Tree, index: str) -> list[int]:
        """The values of an index of a sum: the members that the record defines, from 1."""
        if any(x[1] == "E" for x in nodes(body) if isinstance(x, tuple) and x[0] == "at"):
            return [*range(1, len(self.group.linear_basis) + 1)]
        families = {
            x[1] for x in nodes(body) if isinstance(x, tuple) and x[0] == "at" and index in x[2:]
        }
        found = {
            (e.lhs[1], e.lhs[2])
            for _, e in self.equations
            if isinstance(e.lhs, tuple) and e.lhs[0] == "at" and isinstance(e.lhs[2], int)
        }
        listed = [{i for name, i in found if name == family} for family in families]
        common = set.intersection(*listed) if listed else set()
        if not common:
            raise LoweringError(f"the record does not list the members of {sorted(families)}")
        return sorted(common)

    def applied(self, t: tuple[Tree, ...]) -> Value:
        """The value of a family's member at the time, as r_i(t), by the equation for any index."""
        _, head, argument = t
        assert isinstance(head, tuple)
        for step, e in self.equations:
            match e.lhs:
                case ("call", ("at", family, index), time) if (family, time) == (head[1], argument):
                    outer, self.label = self.label, step.key(e)
                    value = self.tree(bound(e.rhs, {index: head[2]}))
                    value = self.named(value, f"place_{head[2]}")
                    self.label = outer
                    return value
        raise LoweringError(f"the record does not define {head[1]} as a function of the time")


def bound(t: Tree, values: Mapping[str, int]) -> Tree:
    """A tree with indices replaced by their values."""
    if not isinstance(t, tuple):
        return t
    if t[0] in ("at", "entry"):
        return (t[0], bound(t[1], values), *(values.get(i, i) for i in t[2:]))
    return (t[0], *(bound(x, values) for x in t[1:]))


def _sums_of_parameters(value: Value) -> bool:
    """Are all entries of a matrix atoms or sums of atoms, as ½(a + b − c), one a sum?"""
    if isinstance(value, Node):
        return False
    entries = [x for row in value for x in row]
    return any(x.op == "add" for x in entries) and all(map(_linear, entries))


def _linear(x: Node) -> bool:
    """Is it an atom, or a sum of such?"""
    return x.is_atom or (x.op == "add" and all(map(_linear, x.args)))
