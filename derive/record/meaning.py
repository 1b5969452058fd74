"""From a model to an environment: every name of the vocabulary gets the value that it means."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from ..algebra import rational as q
from ..algebra.rational import Matrix
from ..algebra.tree import Tree
from .evaluate import Environment, EvaluationError, evaluate, is_matrix
from .model import Direction, Model, derivative_in
from .nilpotent import EPS, EPS_PRIME, nilpotent, part
from .record import decode

Values = dict[str, Any]


def environment(model: Model) -> Environment:
    """The environment in which the equations of a record are claims."""
    names = (
        _times(model)
        | _bodies(model)
        | _group(model)
        | _forces(model)
        | _energies(model)
        | _motion(model)
        | _space(model)
        | _springs(model)
    )
    return Environment(model.n, names, _families(model), _functions(model), model.parameters)


def _linear(model: Model, x: Matrix) -> Matrix:
    return tuple(row[: model.n] for row in x[: model.n])


def _translation(model: Model, x: Matrix) -> Matrix:
    return tuple((row[model.n],) for row in x[: model.n])


def _parts(model: Model, linear: str, vector: str, x: Matrix) -> Values:
    values: Values = {linear: _linear(model, x)}
    if model.group.affine:
        values[vector] = _translation(model, x)
    return values


def _times(model: Model) -> Values:
    return {"t": model.t, "δt": model.first.time, "δ′t": model.second.time}


def _bodies(model: Model) -> Values:
    m, c, J = model.moments
    return {"m": m, "c": c, "J": J}


def _group(model: Model) -> Values:
    """g, ν, their variations in space and carried to the identity."""
    _, g, Z = model.family(model.first, model.second)
    nu = q.times(g, Z)
    values = _parts(model, "A", "T", model.g) | _parts(model, "α", "τ", part(nu, 0))
    for mark, mask, direction in (("δ", EPS, model.first), ("δ′", EPS_PRIME, model.second)):
        values |= _parts(model, mark + "A", mark + "T", part(g, mask))
        values |= _parts(model, mark + "α", mark + "τ", part(nu, mask))
        prime = mark[1:]
        values |= _parts(model, "ξ" + prime, "η" + prime, direction.xi)
        values |= _parts(model, mark + "Z", mark + "w", direction.velocity)
    values |= _parts(model, "Z", "w", model.Z)
    A = values["A"]
    values["C"] = q.times(q.transposed(A), A)
    return values


def _forces(model: Model) -> Values:
    pairs = list(zip(model.forces, model.points, strict=True))
    span = range(model.n)
    N = tuple(tuple(sum((f[i] * r[j] for f, r in pairs), Fraction(0)) for j in span) for i in span)
    F = tuple((sum((f[i] for f, _ in pairs), Fraction(0)),) for i in span)
    back = q.transposed(_linear(model, model.g))
    values: Values = {"N": N, "F": F, "N_b": q.times(back, N), "F_b": q.times(back, F)}
    if not model.group.affine:
        values["f"] = model.gradient
        values["F̃"] = q.times(model.g, model.gradient)
    for p in model.problem.get("potentials", []):
        if p["kind"] == "gravity" and not model.opaque:
            env = Environment(model.n, {}, parameters=model.parameters)
            values["γ"] = tuple((evaluate(decode(x, "g"), env),) for x in p["g"])
    return values


def _energies(model: Model) -> Values:
    nu = q.times(model.g, model.Z)
    value = part(model.lagrangian(model.t, model.g, nu), 0)
    potential = part(model.potential(model.t, model.moved(model.g)), 0)
    energy = part(model.energy(model.t, model.g, nu), 0)
    return {"L": value, "L̃": value, "U": potential, "Ũ": potential, "h̃": energy}


def _motion(model: Model) -> Values:
    """Rates along the motion, and the multiplier of the volume."""
    Z, Z_dot = model.Z, model.acceleration
    acceleration = q.times(model.g, q.plus(Z_dot, q.times(Z, Z)))
    values = _parts(model, "Ż", "ẇ", Z_dot)
    values |= _parts(model, "α̇", "τ̇", acceleration)
    values |= _parts(model, "Ȧ", "Ṫ", q.times(model.g, Z))
    if model.group.relations == {"unimodular"} and not model.group.affine:
        # the constraint's reaction g⁻ᵀλ: what acceleration and forces leave, traced
        J = model.moments[2]
        inertial = q.times(q.times(q.transposed(model.g), acceleration), J)
        pairs = zip(model.forces, model.points, strict=True)
        span = range(model.n)
        work = Fraction(0)
        for f, r in pairs:
            back = q.times(q.transposed(model.g), tuple((x,) for x in f))
            work += sum((back[i][0] * r[i] for i in span), Fraction(0))
        values["λ"] = (q.trace(inertial) - work) / model.n
    d = model.group.dimension
    for name, element in (("ζ", Z), ("ζ̇", Z_dot)):
        coordinates = model.group.vee(element)
        assert coordinates is not None
        values[name] = tuple((x,) for x in coordinates)
    if model.driven:
        values["u"] = tuple((x,) for x in model.input[:d])
    return values


def _space(model: Model) -> Values:
    """Vectors of R³ for rotations: Ω, ζ, φ, μ and the classical tensors of inertia."""
    if "orthogonal" not in model.group.relations or model.n != 3:
        return {}
    basis = model.group.basis
    values: Values = {}
    named = {
        "ζ": model.Z,
        "ζ̇": model.acceleration,
        "Ω": model.first.xi,
        "Ω′": model.second.xi,
        "δζ": model.first.velocity,
        "δ′ζ": model.second.velocity,
    }
    if not model.group.affine:
        named["φ"] = model.gradient
    for name, x in named.items():
        values[name] = _axial(x)
    values["μ"] = tuple((-model.work(q.times(model.g, e)),) for e in basis[:3])
    if model.driven:
        values["u"] = tuple((x,) for x in model.input[:3])
        values["f_u"] = tuple((x,) for x in model.input[3:])
    m, c, _ = model.moments
    centre = tuple(x[0] / m for x in c)
    values["I"] = _tensor(model, (Fraction(0),) * 3)
    values["I_c"] = _tensor(model, centre)
    values["J_c"] = _moments(model, centre)
    values["λ"] = tuple((values["I"][i][i],) for i in range(3))
    return values


def _axial(x: Matrix) -> Matrix:
    """The vector X of a skew matrix j(X)."""
    return ((x[2][1],), (x[0][2],), (x[1][0],))


def _tensor(model: Model, origin: tuple[Fraction, ...]) -> Matrix:
    """Σ m_i (|r|² 1 − r r̄) about an origin: the classical tensor of inertia."""
    span = range(3)
    total = [[Fraction(0)] * 3 for _ in span]
    for m, point in zip(model.masses, model.points, strict=True):
        r = [x - o for x, o in zip(point, origin, strict=True)]
        square = sum(x * x for x in r)
        for i in span:
            for j in span:
                total[i][j] += m * ((square if i == j else 0) - r[i] * r[j])
    return q.matrix(total)


def _moments(model: Model, origin: tuple[Fraction, ...]) -> Matrix:
    """Σ m_i r r̄ about an origin."""
    total = q.scaled(Fraction(0), q.identity(model.n))
    for m, point in zip(model.masses, model.points, strict=True):
        r = tuple((x - o,) for x, o in zip(point, origin, strict=True))
        total = q.plus(total, q.scaled(m, q.times(r, q.transposed(r))))
    return total


def _spring_members(model: Model) -> list[tuple[Fraction, Matrix]]:
    env = Environment(model.n, {}, parameters=model.parameters)
    members = []
    for p in model.problem.get("potentials", []):
        if p["kind"] == "spring" and not model.opaque:
            i, j = p["between"]
            ends = zip(model.points[i - 1], model.points[j - 1], strict=True)
            s = tuple((a - b,) for a, b in ends)
            members.append((evaluate(decode(p["stiffness"], "stiffness"), env), s))
    return members


def _springs(model: Model) -> Values:
    members = _spring_members(model)
    if not members:
        return {}
    total = q.scaled(Fraction(0), q.identity(model.n))
    for k, s in members:
        total = q.plus(total, q.scaled(k, q.times(s, q.transposed(s))))
    return {"K": total}


def _families(model: Model) -> dict[str, dict[tuple[int, ...], Any]]:
    nu = q.times(model.g, model.Z)

    def column(r: Any) -> Matrix:
        return tuple((x,) for x in r)

    families: dict[str, dict[tuple[int, ...], Any]] = {
        "m": {(i,): m for i, m in enumerate(model.masses, 1)},
        "r": {(i,): column(r) for i, r in enumerate(model.points, 1)},
        "v": {(i,): column(v) for i, v in enumerate(model.moved(nu), 1)},
        "F": {(i,): column(f) for i, f in enumerate(model.forces, 1)},
    }
    members = _spring_members(model)
    if members:
        families["k"] = {(e,): k for e, (k, _) in enumerate(members, 1)}
        families["s"] = {(e,): s for e, (_, s) in enumerate(members, 1)}
    return families


def _functions(model: Model) -> dict[str, Callable[..., Any]]:
    directions = {"δy": model.first, "δ′y": model.second}

    def direction(name: Tree) -> Direction:
        if name == "X":
            return model.motion
        if name in ("δx", "δ′x"):
            full = directions[str(name)[:-1] + "y"]
            return Direction(Fraction(0), full.xi, full.velocity)
        if name not in directions:
            raise EvaluationError(f"no direction {name!r}")
        return directions[str(name)]

    def tangent(arguments: tuple[Tree, ...], env: Environment) -> Matrix:
        blocks = [evaluate(x, env) for x in arguments]
        n = model.n
        if len(blocks) != 1 + model.group.affine:
            raise EvaluationError("a tangent vector has one part for A and one for T")
        if any(not is_matrix(x) and x != 0 for x in blocks):
            raise EvaluationError("a part of a tangent vector is a matrix, or 0")
        linear = blocks[0] if is_matrix(blocks[0]) else ((Fraction(0),) * n,) * n
        if not model.group.affine:
            return linear
        vector = blocks[1] if is_matrix(blocks[1]) else ((Fraction(0),),) * n
        rows = tuple((*row, x[0]) for row, x in zip(linear, vector, strict=True))
        return (*rows, (Fraction(0),) * (n + 1))

    def momentum(_: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
        nu = q.times(model.g, model.Z)
        return part(model.momentum(model.t, model.g, nu, tangent(arguments, env)), 0)

    def point(head: Any, arguments: tuple[Tree, ...], env: Environment) -> Matrix:
        if arguments != ("t",):
            raise EvaluationError("a point is a function of t")
        index = head[2] if isinstance(head[2], int) else env.indices[head[2]]
        return tuple((x,) for x in model.moved(model.g)[index - 1])

    return {
        "dŨ": lambda _, a, env: model.work(tangent(a, env)),
        "p̃": momentum,
        "ϖ": lambda _, a, env: model.cartan(direction(a[0])),
        "dϖ": lambda _, a, env: model.exterior(direction(a[0]), direction(a[1])),
        "ω": lambda _, a, env: model.exterior(direction(a[0]), direction(a[1])),
        "r": point,
        "δA": lambda _, a, env: _linear(model, q.times(model.g, direction(a[0]).xi)),
        "δT": lambda _, a, env: _translation(model, q.times(model.g, direction(a[0]).xi)),
        "ξ": lambda _, a, env: _linear(model, direction(a[0]).xi),
        "η": lambda _, a, env: _translation(model, direction(a[0]).xi),
        "Ω": lambda _, a, env: _axial(direction(a[0]).xi),
        "δ": lambda _, a, env: _varied(model, a[0], EPS, env),
        "δ′": lambda _, a, env: _varied(model, a[0], EPS_PRIME, env),
    }


def _varied(model: Model, what: Tree, mask: int, env: Environment) -> Any:
    """δ or δ′ of a moved point, or of the fields ξ, ξ′, η, η′ on the two-parameter family."""
    _, g, _ = model.family(model.first, model.second)
    if isinstance(what, tuple) and what[0] == "call":
        index = what[1][2]
        i = index if isinstance(index, int) else env.indices[index]
        return tuple((part(x, mask),) for x in model.moved(g)[i - 1])
    other = EPS_PRIME if mask == EPS else EPS
    derivative = tuple(tuple(derivative_in(x, other) for x in row) for row in g)
    field = q.times(_inverse(model, g, mask), derivative)
    value = part(field, mask)
    letter = {("ξ′", EPS): _linear, ("ξ", EPS_PRIME): _linear}
    letter |= {("η′", EPS): _translation, ("η", EPS_PRIME): _translation}
    if (what, mask) not in letter:
        raise EvaluationError(f"no variation of {what!r}")
    return letter[what, mask](model, value)  # type: ignore[index]


def _inverse(model: Model, g: Matrix, mask: int) -> Matrix:
    """g⁻¹ to first order in one parameter: (g₀ + ε g₁)⁻¹ = g₀⁻¹ − ε g₀⁻¹ g₁ g₀⁻¹."""
    base = q.inverse(part(g, 0))
    assert base is not None
    first = q.times(q.times(base, part(g, mask)), base)
    return q.minus(base, q.scaled(nilpotent(mask), first))
