"""The motion on the torus mode by mode, for small N: the sums over the lattice, written out.

[W, P] is the sum of a(m) b(k) [T(m), T(k)], which is on T(m + k); the sines of m∧k and of k∧m are
opposite, so that each pair {m, k} is one term, and terms with the same sine stand together.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from fractions import Fraction

from ...algebra.torus import Place, Torus
from ...language.tree import Tree, add, mul
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..wording import say
from .lattice import M, N, Phase, Unit
from .lattice_forms import Coefficient

LARGEST = 5
"""The largest N of which the modes are written out, as 12 equations of 11 terms."""
Pair = tuple[Place, Place]
Terms = Mapping[int, Mapping[Pair, Fraction]]
"""Of one mode: by k of sin 2πk/N, 0 < k < N/2, the number before each pair of coefficients."""


def modes(phase: Phase, stream: Coefficient, rate: Unit, motion: Step, c: Chapter) -> Step:
    """dω̂(n)/dt for one of n and −n, of Ẇ = rate · [W, P]; ``stream``: P by ω̂."""
    draft = c.draft("modes", "evaluation")
    draft.depends_on(motion)
    torus, found = Torus(phase.N), commutator(Torus(phase.N), stream.power)
    unit = rate * stream.unit * phase.bracket(M, N)[0]
    told = [
        Equation(("call", "d/dt", at(n)), total(phase, unit, found[n])) for n in torus.half_plane
    ]
    return draft.step(told, say("modes.torus"))


def commutator(torus: Torus, power: int) -> Mapping[Place, Terms]:
    """What stands before ω̂(m) ω̂(k) in Σ sin(2π m∧k/N) ω̂(m) |k|²ᵖ ω̂(k) T(m + k), by m + k."""
    found: dict[Place, dict[int, dict[Pair, Fraction]]] = {}
    for m in torus.places:
        for k in torus.places:
            turns = torus.representative((m[0] * k[1] - m[1] * k[0], 0))[0]
            there = torus.representative((m[0] + k[0], m[1] + k[1]))
            terms = found.setdefault(there, defaultdict(lambda: defaultdict(Fraction)))
            sign = (turns > 0) - (turns < 0)
            terms[abs(turns)][min(m, k), max(m, k)] += sign * Fraction(_square(k)) ** power
    return found


def _square(n: Place) -> int:
    return n[0] ** 2 + n[1] ** 2


def total(phase: Phase, unit: Unit, terms: Terms) -> Tree:
    """The sum of the terms of a mode, times a number."""
    groups = []
    for k, pairs in sorted(terms.items()):
        products = [mul(x, at(m), at(n)) for (m, n), x in sorted(pairs.items()) if x]
        if k and products:
            groups.append(unit.times(phase.sine(k), add(*products)))
    return add(*groups)


def at(n: Place) -> Tree:
    """ω̂ at a place."""
    return ("call", "ω̂", *n)
