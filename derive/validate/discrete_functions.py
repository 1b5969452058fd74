"""The functions of a discrete step against what they mean, at exact points.

The momentum of a change of g is what the masses have on the basis of 𝔤; on rotations of space about
the centre of mass; or, of groups of all matrices or those of trace 0, the change itself, modulo
what keeps the volume.  A step is any matrix here, as the equations are polynomials in it: h times
the momentum before it is that of the change from g, after it that of the change seen from its end.
Newton's step must be 0 there, and along a change of the step that change, to first order.  Forces
are those of ``rhs`` on a body at rest.  No word of the discrete record is used.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from ..check.trials.model import Model
from ..check.trials.point_masses import damping_members
from ..check.values.arithmetic import EPS, hat, part
from ..language import rational as q
from ..language.rational import Matrix
from .chart import EPSILON, axis
from .functions_of_state import FunctionsCalled, slopes
from .terms import Array

ORDER = 12
"""The powers of X in the exponential of a turn."""
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class DiscreteFunctions(FunctionsCalled):
    """The comparison at one point; ``measured``: makes the numbers of an array of arguments."""

    measured: Callable[[Sequence[Any], str], Array]

    def compare(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """The names of the functions, each found right."""
        g, Z, zeta = self.point.g, self.point.Z, self._velocity(self.point.arguments["x"])
        moving = q.times(g, Z)
        momentum = self._momentum(moving)
        found = self._run("step_momentum", arguments, len(momentum))
        self._same("step_momentum", found, momentum)
        free = self._multiple()
        loaded = [a + b for a, b in zip(momentum, free, strict=True)]
        self._same("step_velocity", self._velocity_of_momentum(arguments, loaded), zeta)
        self._forces(arguments)
        names = ["step_momentum", "step_velocity", "step_force"]
        if self._has("step_guess"):
            half = [x * HALF for x in axis(Z)]
            guessed = [0] if self._has("step_begin") else zeta if self._on_basis else half
            given = self._loaded(arguments, momentum, 0)
            self._same("step_guess", self._run("step_guess", given, len(guessed)), guessed)
            names.append("step_guess")
        for name in ("step_turn", "step_turn_little") if self._on_basis else ():
            self._turn(name)
            names.append(name)
        return (*names, *self._step(arguments))

    # -- what is compared ------------------------------------------------------------------------

    def _forces(self, arguments: Mapping[str, Any]) -> None:
        """What the forces add in a unit of time is told as the rate of the velocity from rest."""
        still = q.scaled(Fraction(0), self.point.Z)
        x = self.chart.values(self.point.g, still)
        at_rest = {**arguments, "x": self.measured(x, "x")}
        rates = self.call("rhs", at_rest, dx=len(x))["dx"]
        force = self._run("step_force", arguments, len(self._momentum(still)))
        self._same("step_force", self._velocity_of_momentum(at_rest, force), self._velocity(rates))

    def _step(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """Newton's step, what it needs before, and what a step gives."""
        h = self.draw()
        if self._has("step_begin"):
            return self._volume(arguments, h)
        if not self._has("step_newton"):
            return self._end(arguments, h, self._any_momentum(), (), None)
        z = [self.draw() for _ in (self.places if self._on_basis else range(3))]
        W = self._turned(z)
        load = self._load(h, W)
        given = {**self._loaded(arguments, load, h), "v": self.measured(z, "v")}
        given |= {"b": self.measured((), "b")}
        turns = self.chart.group.dimension if self._on_basis else 3
        *change, det = self._run("step_newton", given, turns + 1)
        self._same("step_newton", change, [0] * turns)
        rows = []
        for b in range(turns):
            varied = self._varied_step(z, b)
            *moved, _ = self.plain.numbers(
                "step_newton", {**self.given, "q": [*load, h], "v": varied, "b": ()}, turns + 1
            )
            self._same("step_newton", slopes(moved), [a == b for a in range(turns)])
            rows.append(slopes(self._load(h, self._turned(varied))))
        self._same("step_newton", [det], [q.determinant(q.matrix(rows))])
        return ("step_newton", *self._end(arguments, h, load, z, W))

    def _volume(self, arguments: Mapping[str, Any], h: Any) -> tuple[str, ...]:
        """The same where a multiplier keeps the volume."""
        load, theta = self._any_momentum(), self.draw()
        given = self._loaded(arguments, load, h)
        begun = self._run("step_begin", given, 4)
        end = q.plus(self._linear(self.point.g), self._first(load))
        off = q.determinant(self._along(end, theta + EPSILON)) - 1
        there = {**given, "b": Array(begun, "b"), "v": self.measured([theta], "v")}
        wanted = [part(off, 0) / part(off, EPS), part(off, EPS)]
        self._same("step_newton", self._run("step_newton", there, 2), wanted)
        return ("step_begin", "step_newton", *self._end(arguments, h, load, [theta], None))

    def _end(
        self,
        arguments: Mapping[str, Any],
        h: Any,
        load: Sequence[Any],
        z: Sequence[Any],
        W: Matrix | None,
    ) -> tuple[str, ...]:
        """What a step adds to the element, and h times the momentum after it."""
        if W is None:
            linear = self._along(self._first(load), z[0]) if z else self._first(load)
            moved = self._with_centre(linear, load)
            after = self._momentum(moved)
        else:
            moved = q.times(self.point.g, q.minus(W, q.identity(len(W))))
            if not self._on_basis and self.chart.group.affine:
                moved = self._with_centre(self._linear(moved), load)
            after = self._after(h, W, load)
        given = {**self._loaded(arguments, load, h), "v": self.measured(z, "v")}
        wanted = [*(moved[i][j] for _, i, j in self.chart.entries), *after]
        self._same("step_end", self._run("step_end", given, len(wanted)), wanted)
        return ("step_end",)

    def _turn(self, name: str) -> None:
        """1 + V before a turn, times 1 + X; or the exponential up to a power, or Cayley's transform
        where X³ is in 𝔤 and has no trace, so that this is in the group."""
        group = self.chart.group
        z, s = ([self.draw() for _ in range(n)] for n in (len(self.places), group.dimension))
        X, one = group.hat(s), q.identity(group.size)
        cube = q.times(X, q.times(X, X))
        if name == "step_turn_little":
            total = q.plus(one, X)
        elif group.vee(cube) is None or q.trace(X):
            power = total = one
            for k in range(1, ORDER + 1):
                power = q.scaled(Fraction(1, k), q.times(power, X))
                total = q.plus(total, power)
        else:
            half = q.scaled(HALF, X)
            total = q.times(q.inverted(q.minus(one, half)), q.plus(one, half))
        after = q.minus(q.times(self._turned(z), total), one)
        given = {"v": self.measured(z, "v"), "s": self.measured(s, "s")}
        wanted = [after[i][j] for i, j in self.places]
        self._same(name, self._run(name, given, len(wanted)), wanted)

    # -- what it means ---------------------------------------------------------------------------

    @property
    def _model(self) -> Model:
        found = getattr(self.point.named.names, "model", None)
        assert isinstance(found, Model)
        return found

    def _has(self, name: str) -> bool:
        return name in self.plain.module.functions

    @property
    def _on_basis(self) -> bool:
        """Is a step solved for on a basis of 𝔤? Else of 3 × 3 matrices that turn, by a quaternion,
        or by matrices."""
        return self._has("step_turn")

    @cached_property
    def places(self) -> list[tuple[int, int]]:
        """Where the matrices of a step less 1 may have entries: the sums and products of 𝔤."""
        group = self.chart.group
        size = range(group.size)
        seen = [[any(e[i][j] for e in group.basis) for j in size] for i in size]
        for k in size:
            for i in size:
                for j in size:
                    seen[i][j] = seen[i][j] or (seen[i][k] and seen[k][j])
        return [(i, j) for i in size for j in size if seen[i][j]]

    def _turned(self, z: Sequence[Any]) -> Matrix:
        """g⁻¹ times the end of a step: 1 + V, or 1 + 2q j(x) + 2 j(x)² with q the root that the
        code has for 1 − |x|²."""
        size = self.chart.group.size
        if self._on_basis:
            entries = dict(zip(self.places, z, strict=True))
            span = range(size)
            return tuple(tuple(entries.get((i, j), 0) + (i == j) for j in span) for i in span)
        real = self.plain.elementary("sqrt", 1 - sum(x * x for x in z))
        j = hat(q.column(z))
        turn = q.plus(q.scaled(2 * real, j), q.scaled(2, q.times(j, j)))
        return q.plus(q.identity(size), self._in_one_matrix(turn))

    def _varied_step(self, z: Sequence[Any], b: int) -> list[Any]:
        """A step varied by E_b behind it, or by one of its three numbers."""
        if not self._on_basis:
            return [x + EPSILON * (a == b) for a, x in enumerate(z)]
        moved = q.times(self._turned(z), self.chart.group.basis[b])
        return [x + EPSILON * moved[i][j] for x, (i, j) in zip(z, self.places, strict=True)]

    def _load(self, h: Any, W: Matrix) -> list[Any]:
        """h times the momentum before a step."""
        g = self.point.g
        moved = q.times(g, q.minus(W, q.identity(len(W))))
        if not self._on_basis:
            return [*(self._on_arm(moved, q.times(g, x)) for x in self._arms), *self._drawn]
        arms = [q.times(g, e) for e in self._arms]
        return [self._on_arm(moved, x) + h * HALF * self._damped(moved, x) for x in arms]

    def _after(self, h: Any, W: Matrix, load: Sequence[Any]) -> list[Any]:
        """h times the momentum after a step; of a quaternion as it is seen from there, where W̄ is
        what it came from."""
        g, one = self.point.g, q.identity(len(W))
        if not self._on_basis:
            back = self._in_one_matrix(q.transposed(self._linear(q.minus(W, one))))
            came = q.scaled(Fraction(-1), back)
            return [*(self._on_arm(came, x) for x in self._arms), *load[3:]]
        moved = q.times(g, q.minus(W, one))
        arms = [q.times(q.times(g, W), e) for e in self._arms]
        return [self._on_arm(moved, x) - h * HALF * self._damped(moved, x) for x in arms]

    def _momentum(self, moved: Matrix) -> list[Any]:
        """The momentum of a change of g, without damping."""
        g = self.point.g
        if self._on_basis:
            return [self._on_arm(moved, q.times(g, x)) for x in self._arms]
        centre = self._centre_of(moved)
        if self._has("step_newton") and not self._has("step_begin"):
            return [*(self._on_arm(moved, q.times(g, x)) for x in self._arms), *centre]
        return [*q.flatten(self._linear(moved)), *centre]

    @cached_property
    def _arms(self) -> list[Matrix]:
        """The basis; or the turns about the three axes through the centre of mass."""
        if self._on_basis:
            return [*self.chart.group.basis]
        return [self._model.about_centre(hat(q.column(e))) for e in q.identity(3)]

    @cached_property
    def _centre(self) -> Matrix:
        m, c, _ = self._model.moments
        return q.scaled(1 / m, c)

    def _centre_of(self, moved: Matrix) -> list[Any]:
        """How the centre of mass moves, where a step is seen from it."""
        if not self.chart.group.affine or self._on_basis:
            return []
        group = self.chart.group
        own = q.times(group.linear_part(moved), self._centre)
        return [x for (x,) in q.plus(own, group.translation_part(moved))]

    def _with_centre(self, linear: Matrix, load: Sequence[Any]) -> Matrix:
        """The change of g of this linear part by which the centre of mass moves as it is told."""
        if not self.chart.group.affine:
            return linear
        n = self.chart.group.n
        shift = q.minus(tuple((x,) for x in load[-n:]), q.times(linear, self._centre))
        return q.bordered(linear, shift, Fraction(0))

    @cached_property
    def _drawn(self) -> list[Any]:
        """Any change of the centre of mass."""
        affine = self.chart.group.affine and not self._on_basis
        return [self.draw() for _ in range(self.chart.group.n if affine else 0)]

    def _any_momentum(self) -> list[Any]:
        return [*(self.draw() for _ in range(self.chart.group.n**2)), *self._drawn]

    def _on_arm(self, a: Matrix, b: Matrix) -> Any:
        return self._model.pairing(a, b)

    def _damped(self, a: Matrix, b: Matrix) -> Any:
        damped, points = damping_members(self._model), len(self._model.points)
        weights = [damped.get(i, Fraction(0)) for i in range(1, points + 1)]
        return self._model.pairing(a, b, weights)

    def _multiple(self) -> list[Any]:
        """Any multiple of what keeps the volume, which a momentum may have without meaning."""
        if not self._has("step_begin"):
            return [Fraction(0)] * len(self._momentum(self.point.g))
        return [*q.flatten(q.scaled(self.draw(), self._dual)), *[Fraction(0)] * len(self._drawn)]

    @cached_property
    def _dual(self) -> Matrix:
        """ḡ⁻¹J⁻¹ about the centre of mass, for a linear part g."""
        m, c, J = self._model.moments
        if self.chart.group.affine:
            J = q.minus(J, q.scaled(1 / m, q.times(c, q.transposed(c))))
        back, inverse = q.inverted(self._linear(self.point.g)), q.inverted(J)
        return q.times(q.transposed(back), inverse)

    def _along(self, m: Matrix, theta: Any) -> Matrix:
        return q.plus(m, q.scaled(theta, self._dual))

    def _linear(self, m: Matrix) -> Matrix:
        found: Matrix = self.chart.group.linear_part(m)
        return found

    def _in_one_matrix(self, linear: Matrix) -> Matrix:
        if not self.chart.group.affine:
            return linear
        return q.bordered(linear, ((Fraction(0),),) * len(linear), Fraction(0))

    def _first(self, load: Sequence[Any]) -> Matrix:
        """The linear part of a momentum that is a change of g."""
        n = self.chart.group.n
        return tuple(tuple(load[n * i : n * i + n]) for i in range(n))

    def _velocity(self, x: Sequence[Any]) -> list[Any]:
        return [*x[len(self.chart.entries) :]]

    # -- calls -----------------------------------------------------------------------------------

    def _loaded(self, arguments: Mapping[str, Any], load: Sequence[Any], h: Any) -> dict[str, Any]:
        return {**arguments, "q": self.measured([*load, h], "q")}

    def _velocity_of_momentum(
        self, arguments: Mapping[str, Any], momentum: Sequence[Any]
    ) -> list[Any]:
        """The velocity that a momentum tells."""
        given = {**arguments, "q": Array([*momentum, Fraction(0)], "q")}
        return self._run("step_velocity", given, self.chart.group.dimension)

    def _run(self, name: str, arguments: Mapping[str, Any], size: int) -> list[Any]:
        return self.call(name, arguments, out=size)["out"]
