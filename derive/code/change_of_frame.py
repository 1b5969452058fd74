"""The change of a state, and of inputs, to the principal frame and back: (S g h⁻¹, h Z h⁻¹)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from . import dense
from .graph import Node
from .principal_frame import PrincipalFrame
from .quaternion import conjugate, multiplied
from .reader import RecordReader
from .state import StateSpace


def frame_changes(frame: PrincipalFrame, framed: RecordReader) -> dict[str, list[Node]]:
    """Function name → outputs: ``into_frame``, ``out_of_frame``, and the same of inputs."""
    there, x = _Map.of(frame), framed.space
    back = there.inverse
    found = {"into_frame": there.image(x), "out_of_frame": back.image(x)}
    if framed.inputs:
        found["inputs_into_frame"] = _inputs(frame, there, frame.scale)
        found["inputs_out_of_frame"] = _inputs(frame, back, frame.unit)
    return found


@dataclass(frozen=True)
class _Map:
    """A change of frame r ↦ h r in the body and S in space; ``back`` = h⁻¹.

    All are of the size of the group's matrices; ``quaternions``: those of S and of h⁻¹.
    """

    S: Matrix
    h: Matrix
    back: Matrix
    quaternions: tuple[Any, ...]

    @staticmethod
    def of(frame: PrincipalFrame) -> _Map:
        """The map into the principal frame: r ↦ H(r − s) in the body, S in space."""
        num = frame.graph.num
        S = frame.S or dense.numbers(frame.graph, q.identity(frame.n))
        if not frame.affine:
            return _Map(S, frame.H, frame.back, frame.quaternions)
        shift = tuple((-x,) for (x,) in q.times(frame.H, frame.s))
        still = ((num(0),),) * frame.n
        whole = [(S, still), (frame.H, shift), (frame.back, frame.s)]
        S, h, back = (q.bordered(m, column, num(1)) for m, column in whole)
        return _Map(S, h, back, frame.quaternions)

    @property
    def inverse(self) -> _Map:
        """The map out of the frame; S is a rotation, and where G translates it fixes the origin."""
        back = tuple(conjugate(a) for a in self.quaternions)
        return _Map(q.transposed(self.S), self.back, self.h, back)

    def image(self, x: StateSpace) -> list[Node]:
        """The numbers of the state in the other frame: S g h⁻¹, then h Z h⁻¹ (or S ġ h⁻¹)."""
        element = q.times(self.S, q.times(x.element, self.back))
        if x.tangent:
            rate = q.times(self.S, q.times(x.rate, self.back))
            return [*x.entries(element), *x.entries(rate)]
        Z = q.times(q.times(self.h, x.hat(x.coordinates)), self.back)
        velocity = x.read(Z)
        if not x.quaternion:
            return [*x.entries(element), *velocity]
        left, right = self.quaternions
        turned = multiplied(multiplied(left, x.q), right)
        return [*turned, *x.entries(element), *velocity]


def _inputs(frame: PrincipalFrame, there: _Map, scale: Node) -> list[Node]:
    """The inputs in the other frame, in units of μ: forces h f (in the body) or S f (in space), and
    covectors u″ with ⟨u″, h ξ h⁻¹⟩ = ⟨u, ξ⟩."""
    old, g, n = frame.old, frame.graph, frame.n
    found: list[Node] = []
    forces = iter(old.forces)
    for entry in old.record.problem["inputs"]:
        if entry["kind"] == "covector":
            found += _coadjoint(old.space, there, old.covector)
            continue
        turn = there.h if entry["frame"] == "body" else there.S
        linear = tuple(row[:n] for row in turn[:n])
        found += q.flatten(q.times(linear, next(forces)))
    return [g.product((scale, x)) for x in found]


def _coadjoint(x: StateSpace, there: _Map, u: list[Node]) -> list[Node]:
    """The covector in the other frame: u″_a = Σ u_b (h⁻¹ E_a h)^b."""
    moved = (q.times(q.times(there.back, x.member(a)), there.h) for a in range(x.group.dimension))
    return [q.dot(u, x.read(e)) for e in moved]
