"""The discrete motion of a group in one step, from (g₀, ζ₀) to (g₁, ζ₁), by the momentum p.

From p₀, that of ζ₀ with half of the work of the forces, g₁ is found, as hp₀ is hΘ⁻(g₀, g₁) without
them; then p₁ = Θ⁺(g₀, g₁), the other half, and ζ₁.  What is solved for depends on 𝔤: ``TURNING``,
the skew 3 × 3 matrices: a unit quaternion of g₀⁻¹g₁; ``VOLUME``, those of trace 0: the multiplier θ
of g₁; ``WHOLE``, all matrices: nothing; ``BASIS``, any others, and all with damping: dim 𝔤 numbers.
H ⋉ Rⁿ is H about the centre of mass, which moves by itself.
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
from ..program import refuse_first
from .discrete_basis import basis, pattern
from .discrete_ends import Ends
from .discrete_special import turning, volume, whole
from .tableaux import weights

TURNING, VOLUME, WHOLE, BASIS = "turning", "volume", "whole", "basis"

STEPPING = "step_"
"""How the names of the functions of a step begin."""

Leaves = dict[str, list[Node]]
"""Array → the numbers in it: ``q``, h times a momentum, or the momentum itself where a velocity is
told by it, then the step h; ``v``, the unknowns; ``b``, what is computed before they are found;
``s``, coordinates by which an element is turned."""


@dataclass(frozen=True)
class DiscreteStep:
    """What templates write the step of a group by.

    ``kind``; how many ``momenta``, ``unknowns``, numbers ``begun`` and ``turns``, what Newton's
    method finds, there are; ``group``: the numbers of the state that tell g; ``order``; ``norm``:
    the largest sum of a row of an E_a, by size.
    """

    kind: str
    momenta: int
    unknowns: int
    begun: int
    turns: int
    group: int
    order: int
    norm: Fraction

    @property
    def sizes(self) -> dict[str, int]:
        """How many numbers the arrays of its functions have, by their names in a signature."""
        return {
            "MOMENTA": self.momenta,
            "LOADED": self.momenta + 1,
            "BEGUN": self.begun,
            "UNKNOWNS": self.unknowns,
            "TURNS": self.turns,
            "CORRECTED": self.turns + 1,
            "MOVED": self.group + self.momenta,
        }

    @property
    def weights(self) -> list[float]:
        """The parts of a step of which it is composed."""
        return [float(x) for x in weights(self.order)]


@dataclass(frozen=True)
class Lowered:
    """The record of a step, the step, its functions as name → outputs, and the leaves that they
    read beside those of others."""

    record: Derivation
    step: DiscreteStep
    functions: dict[str, list[Node]]
    leaves: Leaves


def lowered(here: Lowering, record: Derivation) -> Lowered:
    """The step of the discrete motion that a record tells; ``here``: the lowering of the motion in
    time of its problem."""
    e = Ends(here, record)
    group, damped = e.group, bool(record.problem.get("damping"))
    kind = kind_of(here.reader.group, damped=damped)
    shift = group.n if group.affine else 0
    counts = {
        TURNING: (3 + shift, 3, 0, 0),
        VOLUME: (group.n**2 + shift, 1, 4, 0),
        WHOLE: (group.n**2 + shift, 0, 0, 0),
        BASIS: (group.dimension, len(pattern(group.basis, group.size)), 0, group.dimension),
    }[kind]
    names = {"q": "momentum", "v": "unknown", "b": "begun", "s": "turn"}
    leaves = {x: e.leaves(name, n) for (x, name), n in zip(names.items(), counts, strict=True)}
    q, z, b, s = leaves.values()
    if kind == TURNING:
        found = turning(e, q, z)
    elif kind == VOLUME:
        found = volume(e, q, b, z)
    elif kind == WHOLE:
        found = whole(e, q)
    else:
        moments, damping = _moments(here, group), _damping(e) if damped else None
        found = basis(e, moments, damping, q, z, s)
    turns = counts[1] if kind in (TURNING, VOLUME) else counts[3]
    slots = len(here.reader.space.slots)
    norm = max(sum(map(abs, row)) for m in group.basis for row in m)
    order = int(here.reader.options.order or 2)
    step = DiscreteStep(kind, *counts[:3], turns, slots, order, Fraction(norm))
    return Lowered(record, step, found, leaves | {"q": [*q, e.h]})


def kind_of(group: Group, *, damped: bool = False) -> str:
    """How a group is solved for."""
    linear = len(group.linear_basis)
    if damped or (group.affine and not group.free_translations):
        return BASIS
    if "orthogonal" in group.relations and (group.n, linear) == (3, 3):
        return TURNING
    if "unimodular" in group.relations and (group.n, linear) == (3, 8):
        return VOLUME
    return WHOLE if linear == group.n**2 else BASIS


def refuse(d: Derivation, group: Group, options: Options) -> None:
    """``LoweringError`` for a problem without a discrete motion, and for other forms of state."""
    other, attitude = {"lagrangian", "advected"} & {*d.problem}, options.attitude
    reasons = (
        (other, "is of a Lagrangian of points, and this one is not"),
        (len(group.factors) > 1, "is not written for a product of groups"),
        (options.velocity == "tangent", "has Z in the state, and --velocity tangent has dg/dt"),
        (attitude != "matrix", f"has A in the state, and --attitude {attitude} has not"),
        (options.frame != "given", "is for the body as given, and --frame turns it"),
    )
    refuse_first(d.name, *((on, f"--step discrete {why}") for on, why in reasons))


def _moments(lowering: Lowering, group: Group) -> Matrix:
    """J, or with translations [[J, c], [c̄, m]]."""
    reader = lowering.reader
    if not group.affine:
        return reader.vector("J")
    c = reader.vector("c")
    above = q.bordered(reader.vector("J"), c, reader.number("m"))[:-1]
    return (*above, (*(x for (x,) in c), reader.number("m")))


def _damping(e: Ends) -> Matrix:
    """Σ κ_i r_i r̄_i over the points, with translations of (r_i, 1)."""
    graph, reader = e.graph, e.lowering.reader
    size = range(e.group.size)
    total: list[list[list[Node]]] = [[[] for _ in size] for _ in size]
    for i in reader.members(("at", "κ", "i"), "i"):
        kappa, r = reader.number_of(("at", "κ", i)), reader.member(("at", "r", i))
        assert not isinstance(r, Node)
        place = [*(x for (x,) in r), graph.num(1)][: e.group.size]
        for a in size:
            for b in size:
                total[a][b].append(graph.product((kappa, place[a], place[b])))
    return tuple(tuple(graph.sum(x) for x in row) for row in total)
