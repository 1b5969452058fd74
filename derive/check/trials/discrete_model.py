"""The discrete road at exact points: three elements of the group, and L_d from the points alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..values.arithmetic import (
    EPS,
    EPS_PRIME,
    ETA,
    EvaluationError,
    derivative_in,
    derivative_of,
    nilpotent,
    part,
    wedge,
)
from ..values.evaluate import Environment
from . import meaning
from .meaning import NameValues, Values, parts_of
from .model import Model
from .point_masses import AnyPotential, damping_members, outer_sum, scaled_each

ENDS = (0, 1)


class DiscreteModel(Model):
    """A model with g₁ = g, and g₀, g₂ a time h before and after it."""

    h: Any
    g_0: Matrix
    next: Matrix
    directions: Mapping[str, tuple[Matrix, ...]]
    anywhere: Sequence[AnyPotential | None]
    aside: Matrix

    def draw_more(self) -> None:
        """h, the elements before and after g, and variations of two of them."""
        self.h = self.draw(positive=True)
        self.g_0, self.next = (self.group.sample(self.random, self.size) for _ in range(2))
        self.directions = {
            mark: tuple(self.algebra() for _ in ENDS) for mark in ("δ", "δ′", "mixed")
        }
        self.quaternions = [self._unit_quaternion() for _ in ENDS]
        if self.group.turns_space and not self.generic:
            self._by_quaternions()
        self.anywhere = [
            AnyPotential(self, self.t, self.images(g)) if self.generic else None
            for g in (self.g_0, self.g, self.next)
        ]
        self.aside = tuple(tuple(self.draw() for _ in range(self.s)) for _ in range(self.n))

    def _unit_quaternion(self) -> tuple[Any, Matrix]:
        """A random rational unit quaternion, its real part and the others, by the stereographic
        projection."""
        v = self.place() if self.n == 3 else (Fraction(0),)
        square = q.dot(v, v)
        return (1 - square) / (1 + square), q.scaled(2 / (1 + square), q.column(v))

    def _by_quaternions(self) -> None:
        """g₀ and g₂ such that the steps between the elements turn by the quaternions."""
        before, after = (_rotation(*x) for x in self.quaternions)
        linear = self.group.linear_part(self.g)
        self.g_0 = self._with_linear(self.g_0, q.times(linear, q.transposed(before)))
        self.next = self._with_linear(self.next, q.times(linear, after))

    def _with_linear(self, g: Matrix, linear: Matrix) -> Matrix:
        """An element of the group with another linear part."""
        if not self.group.affine:
            return linear
        return q.bordered(linear, self.group.translation_part(g), Fraction(1))

    def energy_at(self, k: int, g: Matrix) -> Any:
        """U at the k-th time, for the body moved by g."""
        chosen, places = self.anywhere[k], self.images(g)
        if chosen:
            return chosen.energy(self.t, places)
        return self.applied.potential(self.time(k), places, self.masses)

    def time(self, k: int) -> Any:
        """The k-th time, t₁ being t."""
        return self.t + (k - 1) * self.h

    def forces_at(self, k: int) -> list[Any]:
        """The forces on the points at the k-th time."""
        if chosen := self.anywhere[k]:
            return chosen.forces
        return self.applied.forces(self.time(k), self.images(self.element(k)), self.masses)

    def element(self, k: int) -> Matrix:
        """g₀, g₁ or g₂."""
        return (self.g_0, self.g, self.next)[k] if k < 2 or not self.at.stepping else self.g_2

    def lagrangian_of(self, first: int, a: Matrix, b: Matrix) -> Any:
        """L_d(a, b), by the points: h (T − ½(U + U′)), the step being the ``first`` of two."""
        across = q.minus(b, a)
        kinetic = self.pairing(across, across) * Fraction(1, 2) / self.h
        ends = self.energy_at(first, a) + self.energy_at(first + 1, b)
        return kinetic - ends * Fraction(1, 2) * self.h

    @cached_property
    def family_of_steps(self) -> tuple[Matrix, ...]:
        """g₀ and g₁ on a two-parameter family, to first order in each."""
        e, f = nilpotent(EPS), nilpotent(EPS_PRIME)
        marks = (e, "δ"), (f, "δ′"), (e * f, "mixed")
        turned = (self.displaced(*((x, self.directions[y][k]) for x, y in marks)) for k in ENDS)
        return tuple(q.times(g, h) for g, (h, _) in zip((self.g_0, self.g), turned, strict=True))

    def one_form(self, end: int, mask: int) -> Any:
        """Θ⁺ (``end`` 1) or Θ⁻ (0) on the derivative of the family in one parameter, a function of
        the other."""
        pair = [*self.family_of_steps]
        pair = [_without(g, mask) for g in pair]
        shift = q.scaled(nilpotent(ETA), derivative_of(self.family_of_steps[end], mask))
        pair[end] = q.plus(pair[end], shift)
        value = derivative_in(self.lagrangian_of(0, *pair), ETA)
        return value if end else -value

    def form(self, end: int, mark: str) -> Any:
        """Θ⁺ or Θ⁻ of a variation at the point."""
        return part(self.one_form(end, MASKS[mark]), 0)

    def derivative(self, end: int, first: str, second: str) -> Any:
        """dΘ(δ, δ′) = δ[Θ(δ′)] − δ′[Θ(δ)]."""
        one, two = MASKS[first], MASKS[second]
        return part(self.one_form(end, two), one) - part(self.one_form(end, one), two)

    @cached_property
    def g_2(self) -> Matrix:
        """A matrix g₂ for which L_d(g₀, g₁) + L_d(g₁, g₂) is stationary on g₁𝔤: any one, and an
        element of g₁𝔤 that is found by solving."""
        row = (*([Fraction(0)] * self.s),)
        aside = (*self.aside, *([row] if self.group.affine else []))
        start = q.plus(self.next, aside)
        along = (q.times(self.g, e) for e in self.group.basis)
        covector = [self.slope(start, e) * self.h for e in along]
        xi = self.solved(self.damped_metric, covector)
        return q.plus(start, q.times(self.g, self.as_letter(xi)))

    @cached_property
    def central(self) -> Matrix:
        """The moments of the body about its centre of mass, or the origin of a linear action."""
        arms = self.images(self.about_centre(q.identity(self.n)))
        return outer_sum(scaled_each(self.masses, arms), arms)

    @cached_property
    def free_motion(self) -> Matrix:
        """The linear part of a g₂ for which the sum of two steps is stationary at g₁ along all
        matrices about the centre."""
        axes = range(self.n)
        rows = [[self.about_centre(q.unit(self.n, i, j)) for j in axes] for i in axes]
        slopes = tuple(tuple(self.slope(self.next, e) * self.h for e in row) for row in rows)
        back = q.inverse(self.damped)
        if back is None:
            raise ZeroDivisionError("the moments are singular at this point")
        return q.plus(self.group.linear_part(self.next), q.times(slopes, back))

    def slope(self, after: Matrix, e: Matrix) -> Any:
        """The derivative of L_d(g₀, g) + L_d(g, ``after``) at g₁ along a matrix e, and the work of
        inputs and damping there: what vanishes on the motion, by d'Alembert's principle."""
        moved = q.plus(self.g, q.scaled(nilpotent(ETA), e))
        total = self.lagrangian_of(0, self.g_0, moved) + self.lagrangian_of(1, moved, after)
        free = part(derivative_in(total, ETA), 0)
        return free + self.work_from_outside(after, e) if self.at.driven else free

    def work_from_outside(self, after: Matrix, e: Matrix) -> Any:
        """The work of inputs in a time h, and of a damping half of which is that of each step."""
        across = q.minus(after, self.g_0)
        drag = self.pairing(across, e, self.dampings) * Fraction(1, 2)
        return self.work_of_inputs(e) * self.h - drag

    def work_of_inputs(self, e: Matrix) -> Any:
        """The work of force inputs and of a covector on a displacement e at g₁."""
        work = self.work_of(self.given_forces, e)
        if any(self.covector) or any(q.flatten(self.couple)):
            xi = q.times(q.inverted(self.g), e)
            dual = self.group.covector_matrix(self.covector)
            work += q.dot(q.flatten(dual), q.flatten(xi)) + self.work_of_couple(xi)
        return work

    @cached_property
    def dampings(self) -> list[Any]:
        """κ_i of each point; 0 where nothing acts from outside."""
        damped = damping_members(self) if self.at.driven else {}
        return [damped.get(i, Fraction(0)) for i in range(1, len(self.points) + 1)]

    @property
    def nonpotential_forces(self) -> list[Any]:
        """Those of inputs: what damps is told apart, by two steps."""
        return self.given_forces

    @cached_property
    def damped_metric(self) -> Matrix:
        """The metric of the kinetic energy on g₁𝔤, and h/2 times that of damping."""
        along = [q.times(self.g, e) for e in self.group.basis]
        drag = self.metric_matrix(along, self.dampings)
        return q.plus(self.metric, q.scaled(self.h * Fraction(1, 2), drag))

    @cached_property
    def damped(self) -> Matrix:
        """The moments of the body about its centre or a fixed point, and h/2 times those of
        damping."""
        weighted = scaled_each(self.dampings, self.points)
        D = outer_sum(weighted, self.points)
        return q.plus(self.central, q.scaled(self.h * Fraction(1, 2), D))

    def moments_of_forces(self, k: int) -> Matrix:
        """N_k = Σ F_i r̄_i, as large as the matrices of the group."""
        arms = [q.flatten(self.homogeneous(r)) for r in self.points]
        rows = outer_sum(self.forces_at(k), arms)
        return (*rows, *([(Fraction(0),) * self.s] if self.group.affine else []))


MASKS = {"δ": EPS, "δ′": EPS_PRIME}


def _without(g: Matrix, mask: int) -> Matrix:
    """A matrix with one parameter put to 0."""
    return q.minus(g, q.scaled(nilpotent(mask), derivative_of(g, mask)))


def environment(model: DiscreteModel) -> Environment:
    """The environment of the names of the discrete road; those of a body and of its potential at
    one time mean what they do at (t₁, g₁)."""
    known = meaning.environment(model)
    families = dict(known.families)
    if model.group.affine:
        families["r̂"] = {(i,): model.homogeneous(r) for i, r in enumerate(model.points, 1)}
    families["E"] = {(a,): e for a, e in enumerate(model.group.basis, 1)}
    own = NameValues(model, [_elements, _moments, _in_blocks, _momenta, *meaning.GROUPS])
    return replace(
        known, names=own, families=families, functions={**known.functions, **_functions(model)}
    )


def _elements(model: DiscreteModel) -> Values:
    """h, the elements and their variations."""
    hat = HAT * model.group.affine
    values: Values = {"h": model.h, f"ξ{hat}": model.directions["δ"][1]}
    values |= {f"g_{k}": model.element(k) for k in range(3)}
    for mark in MASKS:
        for k in ENDS:
            moved = q.times(model.element(k), model.directions[mark][k])
            values[f"{mark}g_{k}"] = moved
    return values


def _moments(model: DiscreteModel) -> Values:
    """J, N, U and L_d."""
    arms = [q.flatten(model.homogeneous(r)) for r in model.points]
    weighted = [tuple(m * x for x in r) for m, r in zip(model.masses, arms, strict=True)]
    affine = model.group.affine
    values: Values = {"Ĵ" if affine else "J": outer_sum(weighted, arms)}
    values |= {f"N{HAT * affine}_{k}": model.moments_of_forces(k) for k in ENDS}
    values |= {f"U_{k}": part(model.energy_at(k, model.element(k)), 0) for k in ENDS}
    damping = scaled_each(model.dampings, arms)
    values["D̂" if affine else "D"] = outer_sum(damping, arms)
    values["J_D"] = model.damped
    if model.at.driven:
        values["u"] = q.column(model.covector)
    values["L_d"] = part(model.lagrangian_of(0, model.g_0, model.g), 0)
    return values


HAT = "\u0302"


def _in_blocks(model: DiscreteModel) -> Values:
    """The blocks of an affine group: of its elements, of a displacement, of the forces; and where
    the centre of mass is."""
    if not model.group.affine:
        return {}
    one = q.identity(model.s)
    values: Values = {"ι": tuple(row[:-1] for row in one), "o": tuple(row[-1:] for row in one)}
    values |= parts_of(model, "ξ", "η", model.directions["δ"][1])
    values |= parts_of(model, "N_1", "f_1", model.moments_of_forces(1))
    m, c, _ = model.moments
    centre = q.column((*(x / m for (x,) in c), Fraction(1)))
    for k in range(3):
        g = model.element(k)
        values |= parts_of(model, f"A_{k}", f"T_{k}", g)
        values[f"R_{k}"] = q.times(g, centre)[:-1]
    return values


def _momenta(model: DiscreteModel) -> Values:
    """The steps W, their momenta M by L_d without forces, and the multiplier θ."""
    values: Values = {}
    linear = model.group.linear_part
    for k in ENDS:
        one, two = model.element(k), model.element(k + 1)
        values[f"W_{k}"] = q.times(q.transposed(linear(one)), linear(two))
        values[f"M_{k}"] = _momentum(model, one, q.minus(two, one))
        values |= _in_space(model, k, two, q.minus(two, one))
    if model.group.turns_space:
        for k, (real, x) in enumerate(model.quaternions):
            values |= {f"q_{k}": real, f"x_{k}": x}
        found = []
        for e in model.group.basis[:3]:
            along = q.times(model.g, model.about_centre(model.group.linear_part(e)))
            found.append(model.work_of(model.forces_at(1), along) + model.work_of_inputs(along))
        values["μ_1"] = q.column(found)
    return values | _multiplier(model)


def _in_space(model: DiscreteModel, k: int, g: Matrix, across: Matrix) -> Values:
    """The momenta of a step in space, Σ m (v r̄ − r v̄) and Σ m v, by the places at its end."""
    speeds = scaled_each(model.masses, model.images(q.scaled(1 / model.h, across)))
    half = outer_sum(speeds, model.images(g))
    whole = q.minus(half, q.transposed(half))
    return {f"ℓ_{k}": whole, f"p_{k}": outer_sum(speeds, model.units)}


def _rotation(real: Any, x: Matrix) -> Matrix:
    """The rotation of a unit quaternion: v ↦ v + 2q x ∧ v + 2x ∧ (x ∧ v)."""
    columns = []
    for e in q.identity(3):
        once = wedge(x, q.column(e))
        twice = wedge(x, once)
        turned = q.plus(q.column(e), q.scaled(2 * real, once))
        columns.append(q.flatten(q.plus(turned, q.scaled(2, twice))))
    return q.transposed(tuple(columns))


def _momentum(model: DiscreteModel, g: Matrix, across: Matrix) -> Matrix:
    """Twice the skew matrix of which the pairing with ξ is Σ m ⟨(g′ − g)r, gξr⟩ / h, about the
    centre of mass of an affine action."""
    axes = range(model.n)

    def paired(i: int, j: int) -> Any:
        turned = model.about_centre(q.unit(model.n, i, j))
        return model.pairing(across, q.times(g, turned)) / model.h

    return tuple(tuple(paired(i, j) - paired(j, i) for j in axes) for i in axes)


def _multiplier(model: DiscreteModel) -> Values:
    """What there is on SL(n): θ, what the multiples of 1 feel of the sum of two steps, times −h/n;
    H, where the linear parts would go if all matrices were tangent; and Y."""
    whole = len(model.group.linear_basis) == model.n**2 - 1
    if not whole or "unimodular" not in model.group.relations or not model.at.stepping:
        return {}
    along = q.times(model.g, model.about_centre(q.identity(model.n)))
    theta = -model.slope(model.g_2, along) * model.h / model.n
    H, linear = model.free_motion, model.group.linear_part(model.g)
    return {"θ": theta, "H": H, "Y": q.times(q.times(H, model.damped), q.transposed(linear))}


def _functions(model: DiscreteModel) -> dict[str, Any]:
    """Θ⁺, Θ⁻, their derivatives, and δ of L_d, U₀, U₁."""

    def mark(name: Tree) -> str:
        if name not in ("δy", "δ′y"):
            raise EvaluationError("Θ⁺ and Θ⁻ are of variations of two elements")
        return str(name).removesuffix("y")

    def varied(_: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
        pair = [_without(g, EPS_PRIME) for g in model.family_of_steps]
        what = arguments[0]
        if what == "L_d":
            return part(model.lagrangian_of(0, *pair), EPS)
        if what not in ("U_0", "U_1"):
            raise EvaluationError("δ is of L_d, U_0 or U_1")
        k = int(str(what)[-1])
        return part(model.energy_at(k, pair[k]), EPS)

    found: dict[str, Any] = {"δ": varied}
    for end, name in ((1, "Θ⁺"), (0, "Θ⁻")):
        found[name] = lambda _, a, env, end=end: model.form(end, mark(a[0]))
        found[f"d{name}"] = lambda _, a, env, end=end: model.derivative(end, *map(mark, a))
    return found
