"""Two changes of our equations at once, where none alone makes them the user's."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from .balance import Balance, Term, exact
from .cross_products import through
from .faults import NEARER, Explanation, named_vector, of_exchanges, of_terms, views
from .told import ABOUT, FACTORS, NEAR, Changed, changed, possible, told
from .users_code import Array
from .wrenches import of_all_wrenches, of_axes, of_wrench


def of_two(b: Balance, terms: list[Term]) -> Explanation | None:
    """The pair that explains the whole difference, or those that do and are not told apart."""
    found = pairs(b, terms)
    if len(found) == 1:
        return Explanation(found[0], together=True)
    words = tuple(f"{x}, and {y}" for x, y in found)
    return Explanation(words, told_apart=False) if found else None


def pairs(b: Balance, terms: list[Term]) -> list[tuple[str, str]]:
    """The pairs that explain the whole difference, the most telling alone, in words: a number that
    is another with any change of a term, whose own numbers follow; two numbers; two terms."""
    size, found = b.size(), dict[frozenset[str], tuple[int, tuple[str, str]]]()
    numbers = [x for x in of_numbers(b) if _is_body(b, x.balance)]

    def noted(one: Changed, words: str, rank: int, is_all: bool) -> None:
        if is_all and words != one.words:
            found.setdefault(frozenset((one.words, words)), (one.rank + rank, (one.words, words)))

    known: Apart = {}
    for i, one in enumerate(numbers):
        for other in numbers[:i]:
            # what each changes by itself is about what both do: most need no more
            rest = one.balance.unexplained + other.balance.unexplained - 2 * b.unexplained
            if np.abs(rest + b.unexplained).sum() > NEARER * np.abs(b.unexplained).sum():
                continue
            left = possible(_both(b, one.balance, other.balance))
            noted(one, other.words, other.rank, left is not None and exact(left, size))
        own = [*one.balance.terms()]
        reached = Reach(one.balance, own, known).has(one.balance)
        for x in of_terms(one.balance, own) if reached else ():
            noted(one, x.words, x.rank, exact(x.left, size))
    reach = Reach(b, terms, known)
    for one in of_wholes(b, terms):
        for x in of_terms(one.balance, terms) if reach.has(one.balance) else ():
            noted(one, x.words, x.rank, exact(x.left, size))
    least = min((rank for rank, _ in found.values()), default=0)
    kept = [words for rank, words in found.values() if rank == least]
    return [x for x in kept if _plain(x) == {*x} or _plain(x) not in map(set, kept)]


def _plain(words: tuple[str, str]) -> set[str]:
    """The same about the origin."""
    return {x.replace(ABOUT, "") for x in words}


DIGITS = 9
"""So many digits say whether the numbers of a term are those of another."""
Apart = dict[tuple[bytes, ...], list[Array]]
"""By the numbers of a term, of its arm and of the centre of mass: what turns it otherwise."""


class Reach:
    """What one change of a term can explain, in all at once: ``along``, multiples of the terms in
    some rows, each of length 1; ``apart``, terms turned otherwise less what they are.  Most numbers
    of a body stand in few terms: what is ``known`` of the others is that of one before."""

    def __init__(self, b: Balance, terms: list[Term], known: Apart):
        values, d = np.stack([x.values for x in terms]), b.a.shape[1]
        rows = [[*range(d)], *b.rows.values(), *([i] for i in range(d))]
        along, both, seen_from = [], [*b.together()], views(b)
        for view in seen_from:
            to = view[1]
            masks = [np.isin(range(d), own) for own in rows]
            seen, back = through(to, values), np.linalg.inv(to)
            along += [through(back, seen * mask) for mask in masks]
        r = b.centre()

        def key(several: Sequence[Term]) -> tuple[bytes, ...]:
            # a term is a difference: what else is in it leaves its rounding
            arrays = (y for x in several for y in (x.values, x.arm))
            every = ((y, np.abs(y).max(initial=1e-9)) for y in (r, *arrays) if y is not None)
            return tuple(
                np.append(np.round(y / size, DIGITS) + 0.0, float(f"{size:.{DIGITS}g}")).tobytes()
                for y, size in every
            )

        turned: list[Array] = []
        for i, term in enumerate((*terms, *both)):
            if (own := key([term])) not in known:
                found = [x for view in seen_from for x in of_axes(b, term, view)]
                found += of_wrench(b, term) if i < len(terms) else ()
                known[own] = [(b.unexplained - x.left).ravel() for x in found]
            turned += known[own]
        placed = [x for x in terms if x.is_input or x.arm is not None]
        if (own := key(placed)) not in known:
            found = [*of_all_wrenches(b, terms)]
            known[own] = [(b.unexplained - x.left).ravel() for x in found]
        self.apart = np.array(turned + known[own])
        every = np.concatenate(along).reshape(-1, values[0].size)
        lengths = np.linalg.norm(every, axis=1)
        self.along = every[lengths > 0] / lengths[lengths > 0, None]

    def has(self, b: Balance) -> bool:
        """Is what is left in there, about?"""
        left = b.unexplained.ravel()
        enough = NEAR * float(left @ left)
        rest = left @ left - (self.along @ left) ** 2
        apart = ((self.apart - left) ** 2).sum(axis=1) if len(self.apart) else rest
        return bool((rest <= enough).any() or (apart <= enough).any())


def _is_body(b: Balance, other: Balance) -> bool:
    """Has a body the numbers of another balance, one that moves?"""
    left = possible(other)
    try:
        if left is None:
            return False
        return bool(np.isfinite(b.checked(left, other.mass(other.values()))).all())
    except np.linalg.LinAlgError:
        return False


def _both(b: Balance, one: Balance, other: Balance) -> Balance:
    """Our equations ``b`` with the numbers of two that have others."""
    parameters = {k: x for k, x in other.parameters.items() if x != b.parameters[k]}
    return replace(
        one,
        changed={**one.changed, **other.changed},
        parameters={**one.parameters, **parameters},
        u=one.u if other.u is b.u else other.u,
    )


def of_numbers(b: Balance) -> Iterator[Changed]:
    """Numbers exchanged, or times one of the factors: a parameter, one of a table, a vector."""
    yield from of_exchanges(b)
    base = b.values()
    for factor in FACTORS:
        for name, old in b.parameters.items():
            if old:
                words, rank = told(name, old, factor * old, {})
                other = {**b.parameters, name: factor * old}
                yield Changed(words, rank, replace(b, parameters=other))
        for slot in b.opened.slots:
            if old := base[slot.name]:
                words, rank = told(slot.words, old, factor * old, {})
                yield Changed(words, rank + 1, replace(b, changed={slot.name: factor * old}))
        for key, own in b.opened.vectors(base).items():
            if len(own) > 1:
                words, rank = changed(named_vector(key), factor, {})
                yield Changed(words, rank, replace(b, changed={x: factor * base[x] for x in own}))


def of_wholes(b: Balance, terms: list[Term]) -> Iterator[Changed]:
    """A term, or all its rows of a kind, times one of the factors, or turned otherwise."""
    for x in of_terms(b, terms, FACTORS[:2]):
        yield Changed(x.words, x.rank, replace(b, more=x.left - b.unexplained))
