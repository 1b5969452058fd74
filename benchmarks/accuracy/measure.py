"""The emitted programs on a sample, and their errors against the reference."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

import derive
from derive.python.compiled import Compiled
from derive.python.derived import Derived

from .reference import Carried, Reference, Sample, applied, columns
from .terms import Array, Terms, magnitude

FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared")
ULP = 2.0**-52


@dataclass(frozen=True)
class Worst:
    """The worst error of an output: in units in the last place of the sum of the magnitudes of its
    terms, and of itself; where the first was found: body and state."""

    scaled: float
    raw: float
    where: tuple[int, int]

    @staticmethod
    def of(found: list[tuple[Array, Array]]) -> Worst:
        """Of some components; bodies without numbers do not count."""
        scaled, raw = (np.stack(x, axis=-1) for x in zip(*found, strict=True))
        b, s, _ = np.unravel_index(np.nanargmax(scaled), scaled.shape)
        return Worst(float(np.nanmax(scaled)), float(np.nanmax(raw)), (int(b), int(s)))


@dataclass(frozen=True)
class Numbers:
    """``rates`` (B, S, N), ``energies`` (B, S); NaN for a body that ``constants`` refused.

    ``carried``: out of the frame in which they are.
    """

    rates: Array
    energies: Array
    carried: Carried | None = None

    @staticmethod
    def none(sample: Sample) -> Numbers:
        """No numbers yet."""
        shape = sample.states.shape
        return Numbers(np.full(shape, np.nan), np.full(shape[:2], np.nan))


def compiled(derived: Derived, **choices: Any) -> Compiled:
    """The emitted C, without fused multiplications."""
    return derive.compile(derived, flags=FLAGS, **choices)


def module(derived: Derived) -> ModuleType:
    """The emitted Python."""
    name = f"{derived.problem.name}.py"
    made = ModuleType(derived.problem.name)
    exec(compile(derived.emit(None, ["python"])[name], name, "exec"), made.__dict__)
    return made


def by_c(f: Compiled, sample: Sample, *, framed: bool = False) -> Numbers:
    """What the emitted C computes of states, which are in its own frame."""
    rates, energies = (found := Numbers.none(sample)).rates, found.energies
    sizes = rates.shape[-1], len(f.u)
    carried = Carried(*(np.zeros((len(rates), x, x)) for x in sizes))
    for b in range(len(rates)):
        if not taken(f, sample.body(b)):
            continue
        for s, x in enumerate(sample.states[b]):
            f.u = sample.inputs[b, s]
            rates[b, s], energies[b, s] = f(0.0, x), f.energy(0.0, x)
        if framed:
            carried.state[b] = linear(f.out_of_frame, sizes[0])
            carried.inputs[b] = linear(f.inputs_out_of_frame, sizes[1]) if sizes[1] else 0
    return Numbers(rates, energies, carried if framed else None)


def by_python(m: Any, sample: Sample) -> Numbers:
    """What the emitted Python computes, all states of a body at once."""
    found = Numbers.none(sample)
    for b in range(len(found.rates)):
        body = sample.body(b)
        k = m.constants([body[name] for name in m.PARAMETERS])
        u = sample.inputs[b] if m.INPUTS else None
        found.rates[b] = m.rhs(0.0, sample.states[b], k, u)
        found.energies[b] = m.energy(0.0, sample.states[b], k)
    return found


def linear(f: Callable[[Any], Any], size: int) -> Array:
    """The matrix of a linear map."""
    return np.stack([f(e) for e in np.eye(size)], axis=-1)


def taken(f: Compiled, parameters: Mapping[str, float]) -> bool:
    """Is there a body of these parameters?"""
    try:
        f.use({x: y for x, y in parameters.items() if x in f.PARAMETERS})
    except ValueError:
        return False
    return True


def errors(found: Terms, wanted: Terms) -> tuple[Array, Array]:
    """|found − wanted| over the size of the terms, and over itself, in units in the last place.

    What is found, too, has terms where it was carried from one frame to another.
    """
    gap = magnitude(found.value - wanted.value)
    size = np.fmax(wanted.size, found.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        scaled, raw = (
            np.where(gap == 0, 0.0, gap / s / ULP) for s in (size, magnitude(wanted.value))
        )
    return scaled, raw


def compared(reference: Reference, numbers: Numbers) -> dict[str, Worst]:
    """The worst of each output."""
    found, wanted = columns(numbers.rates), reference.rates
    if numbers.carried:
        found = applied(numbers.carried.state, found)
    both = [errors(x, y) for x, y in zip(found, wanted, strict=True)]
    worst = {name: Worst.of([both[i] for i in at]) for name, at in reference.case.rows.items()}
    (energy,) = columns(numbers.energies[..., None])
    return worst | {"energy": Worst.of([errors(energy, reference.energy)])}
