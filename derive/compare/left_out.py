"""Terms that a derivation by hand may lose: what two bodies of a product make of each other's
rates, as a wheel and what carries it; the rate of a momentum at rest, as of a current that is seen
from a body that turns; what mass that flows makes of momenta."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ..algebra.groups import Group
from ..language.derivatives import derivative, product, rate
from ..language.expression import names
from ..language.tree import Tree, add, replaced
from ..language.values import value
from ..problem.fields import state_names
from ..schema.body_kinds import by_block
from .balance import EXACT, Balance, Term
from .cross_products import cross, through, turning
from .users_code import Array


def left_out(b: Balance) -> Iterator[Term]:
    """All that there are, each as it stands in M a = Σ terms."""
    if b.opened.problem.group is None or b.a.shape[1] < 1:
        return
    if not b.block:
        yield from _of_factors(b)
        yield from _of_momentum_at_rest(b)
    yield from _of_flows(b)


def _of_factors(b: Balance) -> Iterator[Term]:
    """Of factors of a product whose mass matrix M couples them: M_ij a_j in the equations of i,
    which those of j may know by M_ji M_ii⁻¹; and the velocity of i in the momenta of j, as the
    rate of the body in those of a wheel, where they turn in i."""
    group, first = b.opened.problem.group, 0
    assert group is not None
    if len(group.places) < 2 or b.a.shape[1] < group.dimension:
        return
    M, velocity, parts = b.mass(b.values()), b.x[:, b.moving], list[slice]()
    for _, factor in group.places:
        parts.append(slice(first, first := first + factor.dimension))
    d, every = b.a.shape[1], [np.arange(b.a.shape[1])[x] for x in parts]
    for i, own in enumerate(every):
        single = {f"block {j + 1}": x for j, x in enumerate(every) if j != i}
        rest = {"all other blocks": np.setdiff1d(np.arange(d), own)} if len(single) > 1 else {}
        for called, other in {**single, **rest}.items():
            of_own, of_other = (M[:, x][:, :, x] for x in (own, other))
            couples = M[:, own][:, :, other]
            if np.abs(couples).max() <= EXACT * np.abs(M).max():
                continue
            pulled = through(couples, b.a[:, other])
            back = through(couples.transpose(0, 2, 1), _solved(of_own, pulled))
            for known in (0, 1):
                values = np.zeros_like(b.a)
                values[:, own], values[:, other] = -pulled, -known * back
                words = f"the acceleration of {called} in the equations of block {i + 1}"
                words += " (of a wheel, aω̇)"
                yield Term(values, _said(words), part=True)
            carried = through(couples.transpose(0, 2, 1), velocity[:, own])
            momenta = through(couples, _solved(of_other, carried))
            turned = _turned(group.places[i][1], velocity[:, own], momenta)
            if turned is not None:
                values = np.zeros_like(b.a)
                values[:, own] = -turned
                words = (
                    f"the velocity of block {i + 1} in the momenta of {called} that turn with it"
                )
                words += " (of a wheel, the aω of J(Ω + aω))"
                yield Term(values, _said(words), part=True)


def _solved(M: Array, vectors: Array) -> Array:
    """M⁻¹ of vectors, at each state."""
    return np.asarray(np.linalg.solve(M, vectors[..., None])[..., 0], float)


def _turned(factor: Group, velocity: Array, momenta: Array) -> Array | None:
    """What momenta make in the equations of a factor by Kirchhoff's equations; none where it is no
    body that turns."""
    if factor.name not in ("SO(3)", "SE(3)", "SE(2)"):
        return None
    turns = factor.dimension - factor.n * factor.affine
    (w, v), (spin, p) = (np.split(x, [turns], axis=1) for x in (velocity, momenta))
    turned = np.cross(w, spin) if turns == 3 else 0 * spin
    return np.hstack([turned + cross(v, p), turning(w, p)]) if factor.affine else turned


def _of_momentum_at_rest(b: Balance) -> Iterator[Term]:
    """d/dt of p = ∂ℓ/∂ζ at ζ = 0, a function of g and t."""
    problem = b.opened.given
    if not (problem.lagrangian and problem.group) or b.a.shape[1] < problem.group.dimension:
        return
    L, d = problem.lagrangian.L, problem.group.dimension
    where = {name: i for i, name in enumerate(b.code.STATE)}
    for name, t in state_names(problem.group).items():
        if isinstance(t, tuple) and t[1] != "ζ":
            L = replaced(L, t, ("par", name))
    moving = b.code.rhs(b.t, b.x, b.k(b.values()), b.u)
    rates: list[Array] = []
    try:
        for a in range(1, d + 1):
            p = derivative(L, ("entry", "ζ", a))
            for c in range(1, d + 1):
                p = replaced(p, ("entry", "ζ", c), 0)
            varying = {x: ("par", x) for x in names(p) if x in where}
            found = _numbers(b, derivative(p, "t"), {})
            for x, letter in varying.items():
                found = found + _numbers(b, derivative(p, letter), {}) * moving[:, where[x]]
            rates.append(found)
    except (ArithmeticError, ValueError):
        return
    words = "the rate of the momentum p = ∂ℓ/∂ζ at rest, as it is seen from where ζ is,"
    yield Term(-np.stack(rates, axis=1), _said(words), part=True)


def _numbers(b: Balance, t: Tree, more: Mapping[str, Any]) -> Array:
    """A tree of numbers at all states."""
    known: dict[str, Any] = {**b.values(), **more}
    known |= {x: b.x[:, i] for i, x in enumerate(b.code.STATE)}
    known |= {x: b.u[:, i] for i, x in enumerate(b.code.INPUTS)}
    function = {"atan": np.arctan}
    found = value(
        t,
        {"π": math.pi, "t": b.t},
        known,
        lambda name, x: function.get(name, getattr(np, name, None))(x),  # type: ignore[misc]
        float,
    )
    return np.broadcast_to(np.asarray(found, float), (len(b.x),))


def _of_flows(b: Balance) -> Iterator[Term]:
    """What stands in the rates of m v + ω × c + p and Iω + c × v, p = ċ − Σ ṁ r of what flows
    inside, less what leaves at r with v + ω × r + u."""
    problem = b.opened.given
    bodies = by_block(problem.body) if problem.body else {}
    if not problem.flows or not b.is_frame or (b.block or 1) not in bodies:
        return
    own, listed = bodies[b.block or 1].moments(), list[Any]((*problem.points, *problem.places))
    flows = [x for x in problem.flows if listed[x.on - 1].block == (b.block or 1)]
    rates: dict[Tree, Tree] = {"t": 1, **{("par", x): t for x, t in problem.stored.items()}}
    exits = [(x.rate, listed[x.on - 1].at) for x in flows]
    p = [
        add(rate(c, rates), *(product(-1, x, r[k]) for x, r in exits)) for k, c in enumerate(own.c)
    ]

    def numbers(trees: Any) -> Array:
        return np.stack([_numbers(b, t, {}) for t in trees], axis=-1)

    (w, v), m_rate = b.velocities(), _numbers(b, rate(own.m, rates), {})[:, None]
    c_rate, inside = numbers(rate(t, rates) for t in own.c), numbers(p)
    J = np.stack([numbers(rate(t, rates) for t in row) for row in own.J], axis=1)
    trace = np.trace(J, axis1=1, axis2=2)[:, None]
    spun = trace * w - through(J, w) if w.shape[1] == 3 else trace * w
    still, none = np.zeros_like(w), np.zeros_like(v)
    gone = [(_numbers(b, x, {})[:, None], numbers(at)) for x, at in exits]
    swept = [(r, lost * turning(w, r)) for lost, r in gone]
    unsteady = numbers(0 if any(x.steady for x in flows) else rate(t, rates) for t in p)
    of_p = "the momentum p of what flows inside, in the momentum m v + ω × c + p,"
    terms = {
        "İω of the tensor of inertia that changes": (-spun, none),
        "ċ × v of the first moment c that changes": (-cross(c_rate, v), none),
        "ω × ċ of the first moment c that changes": (still, -turning(w, c_rate)),
        "ṁ v of the mass that changes": (still, -m_rate * v),
        of_p: (-cross(v, inside), -turning(w, inside) - unsteady),
        "ω × r in the velocity of what leaves at r": (
            sum((cross(r, x) for r, x in swept), still),
            sum((x for _, x in swept), none),
        ),
    }
    if unsteady.any():
        terms[f"{of_p} but for ṗ,"] = (-cross(v, inside), -turning(w, inside))
    for words, (moment, force) in terms.items():
        values = np.hstack([moment, force])
        if np.abs(values).max() > 0:
            yield Term(values, _said(words), part=True)


def _said(words: str) -> Any:
    """The words of a term, whatever its rows."""
    return lambda _: words
