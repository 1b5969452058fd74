"""Terms that a derivation by hand may lose: what two bodies of a product make of each other's
rates and loads, as a wheel and what carries it; Coriolis and centrifugal terms one by one; the rate
of a momentum at rest, as of a current that is seen from a body that turns; what mass that flows
makes of momenta."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import permutations, product
from typing import Any

import numpy as np

from ..algebra.groups import Group
from ..language.derivatives import derivative, rate
from ..language.expression import names
from ..language.tree import Tree, add, mul, replaced
from ..language.values import value
from ..problem.fields import state_names
from ..schema.body_kinds import by_block
from .balance import EXACT, Balance, Term
from .cross_products import coadjoint, cross, through, turning
from .opened import ENTRIES
from .told import Hypothesis
from .users_code import Array


def left_out(b: Balance, terms: list[Term]) -> Iterator[Term]:
    """All that there are, each as it stands in M a = Σ terms."""
    if b.opened.problem.group is None or b.a.shape[1] < 1:
        return
    yield from _of_momenta(b)
    if not b.block:
        yield from _of_factors(b, terms)
        yield from _of_momentum_at_rest(b)
    yield from _of_flows(b)
    yield from _by_coordinates(b)


def _factors(b: Balance) -> list[tuple[int, Group, Any]]:
    """The factors of the group with their numbers and their rows; none where ζ is held in part."""
    group, first, found = b.opened.problem.group, 0, list[tuple[int, Group, Any]]()
    assert group is not None
    if b.block:
        return [(b.block, group.places[b.block - 1][1], np.arange(b.a.shape[1]))]
    for k, (_, factor) in enumerate(group.places, 1):
        found.append((k, factor, np.arange(first, first := first + factor.dimension)))
    return found if first == b.a.shape[1] else []


def _of_momenta(b: Balance) -> Iterator[Term]:
    """What the momenta of a body make in its equations by Kirchhoff's."""
    factors, ζ = _factors(b), b.x[:, b.moving]
    momenta = through(b.mass(b.values()), ζ)
    for k, factor, own in factors:
        if factor.name in ("SE(2)", "SE(3)"):
            turns = len(own) - factor.n
            said = "of the momenta π = ∂ℓ/∂ω, p = ∂ℓ/∂v" + f" of block {k}" * (len(factors) > 1)
            for letters, load in coadjoint(ζ[:, own], momenta[:, own], turns).items():
                yield _only(b, f"{letters} {said}", {k: (own, -load)})


def _only(b: Balance, words: str, parts: Mapping[int, tuple[Array, Any]]) -> Term:
    """A term in some rows alone."""
    values = np.zeros_like(b.a)
    for rows, of in parts.values():
        values[:, rows] = of
    return Term(values, lambda _: words, part=True)


def _of_factors(b: Balance, terms: list[Term]) -> Iterator[Term]:
    """Of factors of a product whose mass matrix M couples them: M_ij a_j in the equations of i,
    which those of j may know by M_ji M_ii⁻¹, and what the loads of j are there; what j adds to the
    inertia of i, in M or in the momenta that turn with i, as a wheel's in the body's."""
    factors, ζ = _factors(b), b.x[:, b.moving]
    if len(factors) < 2:
        return
    M, d = b.mass(b.values()), b.a.shape[1]
    for i, factor, own in factors:
        single = {f"block {j}": x for j, _, x in factors if j != i}
        rest = {"all other blocks": np.setdiff1d(np.arange(d), own)} if len(single) > 1 else {}
        for called, other in {**single, **rest}.items():
            of_own, of_other = (M[:, x][:, :, x] for x in (own, other))
            couples = M[:, own][:, :, other]
            if np.abs(couples).max() <= EXACT * np.abs(M).max():
                continue
            back = couples.transpose(0, 2, 1)
            pulled = through(couples, b.a[:, other])
            words = f"the acceleration of {called} in the equations of block {i} (of a wheel, aω̇)"
            for known in (0, 1):
                reached = -known * through(back, _solved(of_own, pulled))
                yield _only(b, words, {0: (own, -pulled), 1: (other, reached)})

            def added(x: Array, to: Array, couples: Array = couples, M: Array = of_other) -> Array:
                """What the other one's equations say of M_ij times what they are solved for."""
                return through(couples, _solved(M, through(to, x)))

            gained = added(b.a[:, own], back)
            words = f"what {called} adds to the inertia of block {i} (of a wheel, about its axis)"
            yield _only(b, words, {0: (own, -gained)})
            if factor.name in ("SO(3)", "SE(3)", "SE(2)"):
                turns = factor.dimension - factor.n * factor.affine
                carried = added(ζ[:, own], back)
                turned = sum(coadjoint(ζ[:, own], carried, turns).values())
                said = f"the velocity of block {i} in the momenta of {called} that turn with it"
                said += " (of a wheel, the aω of J(Ω + aω))"
                yield _only(b, said, {0: (own, -turned)})
                yield _only(b, f"{words}, and to its momenta", {0: (own, -gained - turned)})
            one = np.eye(len(other))
            for term in terms:
                load = term.values[:, other]
                if not term.part and np.abs(load).max() > EXACT * np.abs(term.values).max():
                    words = f"the reaction of {term.name('')} of {called} on block {i}"
                    yield _only(b, words, {0: (own, -added(load, one))})


def of_rates_together(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """A force of the velocity of one factor that is made of what another adds to it, too, as a
    friction of the absolute rate of a wheel, Ω + aω for Ω; or the other way round."""
    if b.block or b.opened.problem.group is None:
        return
    factors, ζ = _factors(b), b.x[:, b.moving]
    M = b.mass(b.values())
    for (i, _, own), (j, _, other) in permutations(factors, 2):
        couples = M[:, other][:, :, own]
        more = _solved(M[:, other][:, :, other], through(couples, ζ[:, own]))
        for term, sign in product((x for x in terms if x.at and not x.part), (1, -1)):
            x = b.x.copy()
            x[:, b.moving][:, other] += sign * more
            assert term.at is not None
            link, mark = ("and", "+") if sign > 0 else ("less", "−")
            words = f"{term.name('')} is made of the velocity of block {j} {link} what block {i} "
            words += f"adds to it (of a wheel, Ω {mark} aω)"
            yield Hypothesis(words, 0, b.unexplained - (term.at(x) - term.values))


def _by_coordinates(b: Balance) -> Iterator[Term]:
    """What is quadratic in the velocity, by each pair of its coordinates, of a group with few."""
    rest, d = b.bare(), b.a.shape[1]
    if rest is None or b.is_frame or not 1 < d <= ENTRIES:
        return
    code, none = rest, 0 * b.u

    def square(*of: int) -> Array:
        up, down, still = (b.moved(list(of), s) for s in (1.0, -1.0, 0.0))
        at = [b.bias(x, none, code) for x in (up, down, still)]
        return at[2] - (at[0] + at[1]) / 2

    names, alone = b.code.STATE[b.moving], [square(i) for i in range(d)]
    for i, name in enumerate(names):
        yield _only(b, f"the centrifugal term by {name}²", {0: (np.arange(d), alone[i])})
        for j in range(i):
            both = square(i, j) - alone[i] - alone[j]
            yield _only(b, f"the Coriolis term by {names[j]} {name}", {0: (np.arange(d), both)})


def _solved(M: Array, vectors: Array) -> Array:
    """M⁻¹ of vectors, at each state."""
    return np.asarray(np.linalg.solve(M, vectors[..., None])[..., 0], float)


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
            found = _numbers(b, derivative(p, "t"))
            for x, letter in varying.items():
                found = found + _numbers(b, derivative(p, letter)) * moving[:, where[x]]
            rates.append(found)
    except (ArithmeticError, ValueError):
        return
    words = "the rate of the momentum p = ∂ℓ/∂ζ at rest, as it is seen from where ζ is,"
    yield Term(-np.stack(rates, axis=1), _said(words), part=True)


def _numbers(b: Balance, t: Tree) -> Array:
    """A tree of numbers at all states."""
    known: dict[str, Any] = dict(b.values())
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
    p = [add(rate(c, rates), *(mul(-1, x, r[k]) for x, r in exits)) for k, c in enumerate(own.c)]

    def numbers(trees: Any) -> Array:
        return np.stack([_numbers(b, t) for t in trees], axis=-1)

    (w, v), m_rate = b.velocities(), _numbers(b, rate(own.m, rates))[:, None]
    c_rate, inside = numbers(rate(t, rates) for t in own.c), numbers(p)
    J = np.stack([numbers(rate(t, rates) for t in row) for row in own.J], axis=1)
    trace = np.trace(J, axis1=1, axis2=2)[:, None]
    spun = trace * w - through(J, w) if w.shape[1] == 3 else trace * w
    still, none = np.zeros_like(w), np.zeros_like(v)
    gone = [(_numbers(b, x)[:, None], numbers(at)) for x, at in exits]
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
