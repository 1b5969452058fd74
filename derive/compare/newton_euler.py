"""What may be otherwise in the equations of Newton and Euler about the centre of mass: the mass,
that centre and the tensor of inertia in each place, masses that are not what is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..language.tree import nodes
from .balance import Balance, Term
from .cross_products import cross, hats, through, turning
from .told import SIMPLE, Hypothesis
from .users_code import Array

IN_MASS = " in the mass matrix alone"
IN_ACCELERATION = " in the acceleration of the centre of mass r"
PLACES = {
    "the mass m of F/m": ("m",),
    "the tensor of inertia about the centre of mass": ("I", "spun"),
    "the tensor of inertia about the centre of mass, in I α alone,": ("I",),
    "the tensor of inertia about the centre of mass, in ω × Iω alone,": ("spun",),
    "r × F of the moment M − r × F about the centre of mass r": ("arm",),
    f"α × r{IN_ACCELERATION}": ("swept",),
    f"ω × (ω × r){IN_ACCELERATION}": ("turned",),
    f"α × r + ω × (ω × r){IN_ACCELERATION}": ("swept", "turned"),
    "r, the centre of mass, wherever it stands,": ("arm", "swept", "turned"),
}
"""Where a quantity stands, in words."""
CENTRES = ("arm", "swept", "turned")
ALL = ("m", "I", "spun", *CENTRES)
Quantities = dict[str, Array]
"""The mass, the tensor about the centre of mass and that centre, by where they stand."""


def held(b: Balance) -> Iterator[tuple[str, Balance]]:
    """The states in which a mass is what it is at the start, in words."""
    problem = b.opened.problem
    for name in problem.stored:
        if (first := problem.parameters[name].default) is not None:
            x = b.x.copy()
            x[:, b.code.STATE.index(name)] = first
            yield f"{name} is {first:g}", replace(b, x=x)
    body = problem.body
    if body is not None and any("t" in nodes(x) for x in body.moments().trees()):
        yield "t is 0", replace(b, t=0 * b.t)


def of_masses_held(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """A mass stays what it is at the start: in all, in the mass matrix, or in one term alone."""
    own = b.values()
    for words, start in held(b):
        pairs = {"": (b.left, start.left), IN_MASS: (b.of_mass, start.of_mass)}
        said = {where: there(own) - here(own) for where, (here, there) in pairs.items()}
        for here, there in zip(terms, start.terms(), strict=True):
            for rows in ("", *b.rows) if not here.part else ():
                more = here.values - there.values
                more[:, [i for x in b.rows if rows not in ("", x) for i in b.rows[x]]] = 0
                said.setdefault(f" in {here.name(rows)} alone", more)
        for where, more in said.items():
            told = f"{words}{where}, and not what is left of it"
            yield Hypothesis(told, int(where not in ("", IN_MASS)), b.unexplained + more)


def of_newton_euler(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """A quantity is another in a place: the mass or the tensor that of the start, the centre of
    mass this, or 0, or of the other sign.  A weight is right, or has the same fault."""
    own = _quantities(b)
    if own is None:
        return
    others = [(SIMPLE[x], {y: x * own[y] for y in CENTRES}, PLACES) for x in (-1.0, 0.0)]
    for words, start in held(b):
        there = _quantities(start)
        assert there is not None
        said = f"is that of the start, where {words}"
        others.append((said, there, PLACES))
        r = own["arm"] * own["m"] / there["m"]
        other_m = _about_origin(own, there["m"], r)
        other_r = _about_origin(own, own["m"], there["arm"])
        others.append((f"{said}, in r = c/m too", other_m, {"the mass m": ALL}))
        others.append((f"{said}, in parallel axes too", other_r, {"the centre of mass r": ALL}))
    weight = sum((x.values for x in terms if x.arm is not None and x.arm.ndim == 2), 0 * b.a)
    for apart in (weight, 0 * weight) if weight.any() else (weight,):
        for words, there, places in others:
            for place, keys in places.items():
                if there.keys() >= {*keys}:
                    left = _left(b, own, {**own, **{x: there[x] for x in keys}}, apart)
                    yield Hypothesis(f"{place} {words}", 2, left)


def _quantities(b: Balance) -> Quantities | None:
    """Those of the states; none where no body moves freely."""
    m, r = b.mass_and_centre()
    if not b.is_frame or r is None:
        return None
    turns = len(b.rows["moment"])
    J = b.mass(b.values())[:, :turns, :turns]
    tensor = J - parallel(m, r)
    return {"m": m[:, None], "I": tensor, "spun": tensor, **dict.fromkeys(CENTRES, r)}


def parallel(m: Array, r: Array) -> Array:
    """m(r²1 − r r̄) at each state, in the plane m r², (N, 1, 1)."""
    if r.shape[1] == 3:
        return np.asarray(-m[:, None, None] * hats(r) @ hats(r))
    return np.asarray((m * (r * r).sum(axis=1))[:, None, None])


def _about_origin(own: Quantities, m: Array, r: Array) -> Quantities:
    """Those of a mass and a centre, where the tensor about the origin is kept."""
    tensor = own["I"] + parallel(own["m"][:, 0], own["arm"]) - parallel(m[:, 0], r)
    return {"m": m, "I": tensor, "spun": tensor, **dict.fromkeys(CENTRES, r)}


def _left(b: Balance, own: Quantities, there: Quantities, weight: Array) -> Array:
    """What is left where the quantities are ``there`` in place of our ``own``; a ``weight`` is as
    it is, apart from them."""
    w, v = b.velocities()
    turns = w.shape[1]

    def moved(q: Quantities, a: Array) -> Array:
        """The acceleration of the centre of mass, for α and dv/dt."""
        swept = turning(a[:, :turns], q["swept"]) + turning(w, turning(w, q["turned"]))
        return np.asarray(a[:, turns:] + turning(w, v) + swept)

    def spun(q: Quantities) -> Array:
        return np.cross(w, through(q["spun"], w)) if turns == 3 else 0 * w

    M = b.mass(b.values())
    a = np.asarray(np.linalg.solve(M, -b.bias(b.x, b.u)[:, :, None])[:, :, 0], float)
    fall = weight[:, turns:] / own["m"]
    force = own["m"] * (moved(own, a) - fall)
    moment = through(own["I"], a[:, :turns]) + spun(own) + cross(own["arm"] - there["arm"], force)
    try:
        alpha = np.linalg.solve(there["I"], (moment - spun(there))[:, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        return np.full_like(a, np.inf)
    still = np.hstack([alpha, 0 * v])
    other = np.hstack([alpha, force / there["m"] + fall - moved(there, still)])
    return through(M, b.a - other)
