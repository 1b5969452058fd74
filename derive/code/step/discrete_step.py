"""The discrete motion of a group in one step, from (g₀, ζ₀) to (g₁, ζ₁).

With the momentum p at the door, p₀ = Θ⁻(g₀, g₁) and p₁ = Θ⁺(g₀, g₁) (steps ``one_forms`` and
``balance`` of ``derive walk --discrete``), for every ξ of 𝔤

    Tr (g₁ − g₀)J (g₀ξ)‾ = h Tr g₀Z*J (g₀ξ)‾,    Z* = Z₀ + ½h Ż₀,
    Tr g₁Z′J (g₁ξ)‾ = (1/h) Tr (g₁ − g₀)J (g₁ξ)‾,    Z₁ = Z′ + ½h Ż₁,

Ż being the rate of the velocity that the forces give a body at rest at g.  Damping D adds ½hD to J
on the left of the first line, and takes it away on the right of the second.  What is solved for
depends on 𝔤: ``TURNING``, the skew 3 × 3 matrices: a unit quaternion of g₀⁻¹g₁; ``VOLUME``, those
of trace 0: the multiplier in g₁ = B + θ ḡ₀⁻¹J⁻¹, det g₁ = 1; ``WHOLE``, all matrices: nothing;
``BASIS``, any others: dim 𝔤 numbers.  H ⋉ Rⁿ is H about the centre of mass, which moves by itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...record.record import Derivation
from ..graph import Node
from ..lower import Lowering
from ..options import Options
from ..program import LoweringError
from ..slots import fixed_entries, layout
from .compositions import weights

TURNING, VOLUME, WHOLE, BASIS = "turning", "volume", "whole", "basis"

Terms = list[tuple[Fraction, int, int]]
"""The entries of a sparse matrix: coefficient, row and column."""


@dataclass(frozen=True)
class DiscreteStep:
    """What templates write the step of a group by: its ``kind``; ``n``, of its points, ``size``, of
    its matrices; ``centred``: is it seen from the centre of mass; ``damped``: is there D; the
    ``places`` (row, column) of the numbers of the state in g, and what the other entries are,
    ``fixed``; for each a the entries of E_a, ``basis``, and of ζ_a in Z, ``read``; ``order``."""

    kind: str
    n: int
    size: int
    centred: bool
    damped: bool
    places: list[tuple[int, int]]
    fixed: list[tuple[int, int, int]]
    basis: list[Terms]
    read: list[Terms]
    order: int

    @property
    def inside(self) -> int:
        """The size of the matrices that are solved for."""
        return self.size if self.kind == BASIS else self.n

    @property
    def weights(self) -> list[float]:
        """The parts of a step of which it is composed."""
        return [float(x) for x in weights(self.order)]


def discrete_step(d: Derivation, group: Group, options: Options) -> DiscreteStep | None:
    """The step of a record; ``None`` where none is asked for."""
    if "discrete" not in options.step:
        return None
    stated, n, s = group.stated, group.n, group.size
    damped = bool(d.problem.get("damping"))
    kind, centred = kind_of(group), False
    if group.affine and kind != BASIS:
        centred = group.free_translations and not damped
        kind = kind if centred else BASIS
    slots = layout(group, options.layout == "col")
    places = [(x.row, n if x.letter == "T" else x.column) for x in slots]
    ones = {**fixed_entries(group), (s - 1, s - 1): 1}
    others = [(i, j) for i in range(s) for j in range(s) if (i, j) not in places]
    span = range(group.dimension)
    return DiscreteStep(
        kind,
        n,
        s,
        centred,
        damped,
        places,
        [(i, j, ones.get((i, j), 0)) for i, j in others],
        [_terms(e) for e in stated.basis],
        [stated.coordinate_terms(a) for a in span],
        int(options.order or 2),
    )


def kind_of(group: Group) -> str:
    """How the linear parts of a group are solved for."""
    linear = len(group.linear_basis)
    if "orthogonal" in group.relations and (group.n, linear) == (3, 3):
        return TURNING
    if "unimodular" in group.relations and (group.n, linear) == (3, 8):
        return VOLUME
    return WHOLE if linear == group.n**2 else BASIS


def _terms(m: Matrix) -> Terms:
    return [(x, i, j) for i, row in enumerate(m) for j, x in enumerate(row) if x]


def refuse(d: Derivation, group: Group, options: Options) -> None:
    """``LoweringError`` for a problem without a discrete motion, and for other forms of state."""
    reason = ""
    if "lagrangian" in d.problem or "advected" in d.problem:
        reason = "is of a Lagrangian of points, and this one is not"
    elif len(group.factors) > 1:
        reason = "is not written for a product of groups"
    elif options.velocity == "tangent":
        reason = "has Z in the state, and --velocity tangent has dg/dt"
    elif options.attitude == "quaternion":
        reason = "has A in the state, and --attitude quaternion has not"
    elif options.frame != "given":
        reason = "is for the body as given, and --frame turns it"
    if reason:
        raise LoweringError(f"{d.name}: --step discrete {reason}: leave it out")


def functions(lowering: Lowering) -> dict[str, list[Node]]:
    """The functions that the step reads, as name → outputs, where one is asked for: ``moments`` J
    by rows, of the size of the group's matrices, and D where damping acts; ``from_rest`` Ż."""
    d, graph, reader = lowering.record, lowering.graph, lowering.reader
    group, options = reader.group, reader.options
    if "discrete" not in options.step:
        return {}
    whole = [x for row in _moments(lowering, group) for x in row]
    if d.problem.get("damping"):
        whole += [x for row in _damping(lowering, group) for x in row]
    rest = Lowering(d, group, options, graph)
    for name in ("ζ", "w") if group.affine else ("ζ",):
        still: Matrix = tuple((graph.num(0),) for _ in reader.space.values[name])
        rest.reader.state[name] = rest.reader.space.values[name] = still
    pushed = rest.reader.space.velocity(rest.reader.component)
    return {"moments": whole, "from_rest": pushed}


def _moments(lowering: Lowering, group: Group) -> Matrix:
    """J, or with translations [[J, c], [c̄, m]]."""
    reader = lowering.reader
    if not group.affine:
        return reader.vector("J")
    c = reader.vector("c")
    above = q.bordered(reader.vector("J"), c, reader.number("m"))[:-1]
    return (*above, (*(x for (x,) in c), reader.number("m")))


def _damping(lowering: Lowering, group: Group) -> Matrix:
    """Σ κ_i r_i r̄_i over the points, with translations of (r_i, 1)."""
    graph, reader = lowering.graph, lowering.reader
    size = range(group.size)
    total: list[list[list[Node]]] = [[[] for _ in size] for _ in size]
    for i in reader.members(("at", "κ", "i"), "i"):
        kappa, r = reader.number_of(("at", "κ", i)), reader.member(("at", "r", i))
        assert not isinstance(r, Node)
        place = [*(x for (x,) in r), graph.num(1)][: group.size]
        for a in size:
            for b in size:
                total[a][b].append(graph.product((kappa, place[a], place[b])))
    return tuple(tuple(graph.sum(x) for x in row) for row in total)
