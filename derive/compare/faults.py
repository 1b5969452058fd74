"""Which change of our equations makes them the user's: hypotheses from data, tried one by one."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, combinations, product

import numpy as np

from .balance import Balance, Part, Term, exact
from .cross_products import through
from .inertia_operators import of_added_mass, of_blocks
from .left_out import left_out, of_rates_together
from .newton_euler import IN_MASS, of_masses_held, of_newton_euler, parallel
from .told import (
    ABOUT,
    NEAR,
    Changed,
    Hypothesis,
    changed,
    is_inertia,
    possible,
    stands_in,
    told,
    with_other,
)
from .users_code import Array
from .wrenches import of_axes, of_own_arms, of_sizes, of_wrenches

NEARER = 0.5
"""What a change leaves of the difference at most, to be told as the nearest."""
TURNS = 12
"""The most steps of Newton's method."""


def hypotheses(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """All that are generated from the numbers and the terms of a problem."""
    yield from of_numbers(b, {"": b.left})
    for x in of_exchanges(b):
        if (left := possible(x.balance)) is not None:
            yield Hypothesis(x.words, x.rank, left)
    yield from of_vectors(b)
    yield from of_the_point(b)
    yield from of_masses_held(b, terms)
    yield from of_newton_euler(b, terms)
    yield from of_terms(b, terms)
    yield from of_own_arms(b, terms)
    yield from of_rates_together(b, terms)
    for term in left_out(b, terms):
        yield from of_term(b, term, views(b)[0])


def of_terms(
    b: Balance, terms: list[Term], factors: tuple[float, ...] = ()
) -> Iterator[Hypothesis]:
    """All that may be otherwise in the terms by themselves; by ``factors`` alone, if there are."""
    yield from of_wrenches(b, terms)
    for view in views(b):
        for term in (*terms, *b.together()):
            yield from of_axes(b, term, view)
            yield from of_term(b, term, view, factors)


def views(b: Balance) -> list[tuple[str, Array]]:
    """M a = Σ terms as it stands, and with moments about the centre of mass: words, a matrix, or
    one for each state."""
    centred = b.about_centre()
    plain = [("", np.eye(b.a.shape[1]))]
    return plain if centred is None else [*plain, (ABOUT, centred)]


@dataclass(frozen=True)
class Explanation:
    """Changes of our equations that make them the user's, each alone or all ``together``; else
    which one is ``nearest``.  ``telling``: are none of them factors that say nothing?
    ``told_apart``: are they not several pairs of which each explains all?  ``stopped``: by what the
    search was ended, where it was."""

    changes: tuple[str, ...] = ()
    together: bool = False
    telling: bool = True
    told_apart: bool = True
    nearest: str = ""
    stopped: BaseException | None = None


def explained(
    b: Balance,
    terms: list[Term],
    tried: list[Hypothesis],
    within: Callable[[], Explanation | None] = lambda: None,
) -> Explanation:
    """What explains the whole difference, the most telling first; else what does ``within`` factors
    of a product; else what leaves the least.  What is ``tried`` is added to these."""

    def stage(generated: Iterator[Hypothesis]) -> list[Hypothesis]:
        tried.extend(x for x in generated if np.isfinite(x.left).all())
        return _exact(b, tried)

    good = stage(hypotheses(b, terms))
    if not good or good[0].rank > 2:
        good = stage(
            chain(of_numbers(b, parts_of(b, terms)), of_added_mass(b), of_blocks(b), of_sizes(b))
        )
    if good:
        return best(b, tried)
    if apart := within():
        return apart
    for found in (*(of_several(b, terms, x) for x in views(b)), of_tables(b)):
        if found:
            words = tuple(x for x, _ in found)
            return Explanation(words, together=True, telling=not any(rank for _, rank in found))
    return best(b, tried)


def _exact(b: Balance, tried: list[Hypothesis]) -> list[Hypothesis]:
    """Those that explain the whole difference, the most telling first."""
    size = b.size()
    return sorted((x for x in tried if exact(x.left, size)), key=lambda x: x.rank)


def best(b: Balance, tried: list[Hypothesis]) -> Explanation:
    """The most telling of those that explain the whole difference, or else the nearest."""
    if good := _exact(b, tried):
        least = [x.words for x in good if x.rank <= max(1, good[0].rank)]
        first = [x for x in least if ABOUT not in x or x.replace(ABOUT, "") not in least]
        return Explanation(with_other_names(dict.fromkeys(first)))
    if not tried:
        return Explanation()
    size = b.size()
    whole = float(np.abs(b.unexplained / size).max())
    nearest = min(tried, key=lambda x: float(np.abs(x.left / size).max()))
    part = float(np.abs(nearest.left / size).max()) / whole
    near = f"{nearest.words}: this would leave {part:.0%} of the difference"
    return Explanation(nearest=near if part < NEARER else "")


SAID = re.compile(r"(.*?) ((?:has|is|are|stands) .*)")
"""What is changed, and what of it is said."""


def with_other_names(changes: Iterable[str]) -> tuple[str, ...]:
    """Changes of which the same is said in one line: it is one fault with several names."""
    names: dict[str, list[str]] = {}
    for words in changes:
        found = SAID.fullmatch(words)
        subject, said = found.groups() if found else (words, "")
        names.setdefault(said, []).append(subject)
    return tuple(
        f"{first} {said}".rstrip()
        + (f"; the same in numbers: {', '.join(others)}" if others else "")
        for said, (first, *others) in names.items()
    )


Values = Mapping[str, float]


def fitted(
    b: Balance, values: Callable[[float], Values], start: float, part: Part
) -> tuple[float, Array] | None:
    """The number for which the least is left, by Newton's method, and what is left then; where it
    is another in a ``part`` of M a + b, or in the whole, ``b.left``."""
    own = part(b.values())
    try:
        found = newton(lambda x: b.unexplained + part(values(x)) - own, start)
        if found and part in (b.left, b.of_mass):
            return found[0], b.checked(found[1], b.mass(values(found[0])))
        return found
    except (ValueError, np.linalg.LinAlgError):  # no body has this number
        return None


def newton(left: Callable[[float], Array], start: float) -> tuple[float, Array] | None:
    """The number for which the least is left, and that; none where it stands in nothing."""
    value, here = start, left(start)
    for _ in range(TURNS):
        step = 1e-6 * max(abs(value), 1e-3)
        slope = (left(value + step) - left(value - step)) / (2 * step)
        square = float((slope * slope).sum())
        if not square:
            return None
        further = value - float((slope * here).sum()) / square
        there = left(further)
        if not np.abs(there).sum() < np.abs(here).sum():
            break
        value, here = further, there
    return value, here


def of_numbers(b: Balance, parts: Mapping[str, Part]) -> Iterator[Hypothesis]:
    """A parameter of the problem, or one of its numbers, is another in a part."""
    base = b.values()
    units = {x: b.opened.problem.parameters[x].unit for x in b.parameters}
    numbers: dict[str, tuple[str, Values]] = {
        x: (x, {y: b.parameters[y] for y in units if units[y] == units[x]}) for x in units
    }
    numbers |= {x.name: (b.words(x), b.alike(x)) for x in b.opened.slots}
    for (where, part), (name, (words, same)) in product(parts.items(), numbers.items()):
        own = name in b.parameters

        def values(v: float, name: str = name, own: bool = own) -> Values:
            return b.values({name: v}) if own else {**base, name: v}

        if found := fitted(b, values, base[name], part):
            entry = b.operator.get(name, 0)
            old, new = base[name] + entry, found[0] + entry
            said, rank = told(words + where, old, new, same)
            if where and abs(new - 1) <= NEAR:
                said, rank = f"{words} is left out{where}: it is 1, not {old:.6g}", 1
            rank += (not own) + bool(where) + (name in b.operator)  # whose letters say more
            yield Hypothesis(said, rank, found[1])


def parts_of(b: Balance, terms: list[Term]) -> dict[str, Part]:
    """In which part alone a number may be another, in words."""
    found = {f" in {x.name('')} alone": x.of for x in terms if x.of}
    momentum = b.of_momentum()
    return {**found, IN_MASS: b.of_mass, **({IN_MOMENTUM: momentum} if momentum else {})}


IN_MOMENTUM = " in the momentum alone"


def of_exchanges(b: Balance) -> Iterator[Changed]:
    """Two numbers of one key are exchanged, or two inputs."""
    base = b.values()
    for one, other in combinations(b.opened.slots, 2):
        if one.key == other.key and base[one.name] != base[other.name]:
            changed = {one.name: base[other.name], other.name: base[one.name]}
            words = f"{one.words} and {other.words} are exchanged"
            yield Changed(words, 0, replace(b, changed={**b.changed, **changed}))
    for one_name, other_name in combinations(b.parameters, 2):
        changed = {one_name: b.parameters[other_name], other_name: b.parameters[one_name]}
        units = [b.opened.problem.parameters[x].unit for x in changed]
        if units[0] == units[1] and len({*changed.values()}) == 2:
            words = f"{one_name} and {other_name} are exchanged"
            yield Changed(words, 0, replace(b, parameters={**b.parameters, **changed}))
    for i, j in combinations(range(b.u.shape[1]), 2):
        u = b.u.copy()
        u[:, [i, j]] = u[:, [j, i]]
        words = f"the inputs {b.code.INPUTS[i]} and {b.code.INPUTS[j]} are exchanged"
        yield Changed(words, 1, replace(b, u=u))


CALLED = {"at of the": "the lever arm", "relative_to of": "the wind"}
"""How a key begins → what it is to people."""


def named_vector(key: str) -> str:
    """A vector of the problem in words."""
    found = next((x for begins, x in CALLED.items() if key.startswith(begins)), "")
    return f"{found} ({key})" if found else key


def of_vectors(b: Balance) -> Iterator[Hypothesis]:
    """A vector of the problem, as the place where a force acts, is a multiple of itself."""
    base = b.values()
    for key, own in b.opened.vectors(base).items():

        def scaled(s: float, own: list[str] = own) -> Values:
            return {**base, **{x: s * base[x] for x in own}}

        # a wind stands under a root: from 1 alone Newton's method may end elsewhere
        several = [fitted(b, scaled, x, b.left) for x in (1.0, -1.0, 0.0)]
        if found := min(filter(None, several), key=lambda x: np.abs(x[1]).sum(), default=None):

            def related(name: str, own: list[str] = own) -> bool:
                there = with_other(b, name).values()
                return is_inertia(b, name) or any(there[x] != base[x] for x in own)

            words, rank = changed(named_vector(key), found[0], b.named, related)
            yield Hypothesis(words, rank, found[1])


def of_the_point(b: Balance) -> Iterator[Hypothesis]:
    """The tensor of inertia of a body in space is about another point: the origin, or the centre of
    mass."""
    m, r = b.mass_and_centre()
    if r is None or not r.any() or r.shape[1] != 3 or len(b.rows["moment"]) != 3:
        return
    w, d = b.x[:, b.moving][:, :3], b.a.shape[1]
    shift = np.zeros((len(m), d, d))
    shift[:, :3, :3] = parallel(m, r)
    of_mass, spun = through(shift, b.a), np.zeros_like(b.a)
    spun[:, :3] = np.cross(w, through(shift[:, :3, :3], w))
    for where, more in (("", of_mass + spun), (IN_MASS, of_mass), (" in ω × Iω alone", spun)):
        s = -float((more * b.unexplained).sum() / (more * more).sum())
        left = b.unexplained + s * more
        if more is not spun:
            left = b.checked(left, b.mass(b.values()) + s * shift)
        simple = min(abs(abs(s) - x) for x in (1, 2)) <= NEAR
        words = f"the tensor of inertia{where} is about another point: it is ours with "
        words += f"{s:+.6g} times the term of parallel axes, m(r²1 − r r̄)"
        yield Hypothesis(words.replace("-", "−"), 0 if simple else 4, left)


def of_term(
    b: Balance, term: Term, view: tuple[str, Array], factors: tuple[float, ...] = ()
) -> Iterator[Hypothesis]:
    """A term has another factor, in all rows or in some, or another power of a distance or of a
    speed; or has the ``factors`` alone, in all rows of a kind."""
    about, to = view
    here, values = through(to, b.unexplained), through(to, term.values)
    back, d = np.linalg.inv(to), here.shape[1]
    sets = {"": [*range(d)], **(b.rows if len(b.rows) > 1 else {})}
    single = {f"row {i + 1}": [i] for i in range(d)}
    seen: list[Array] = []
    for name, rows in (sets if factors else {**sets, **single}).items():
        part = np.zeros_like(here)
        part[:, rows] = values[:, rows]
        square = float((part * part).sum())
        if not square or any(np.array_equal(part, x) for x in seen):
            continue  # all of it is in the rows of which more has been said
        seen.append(part)
        # M a = Σ terms with f times this one: what is left is (f − 1) times it
        own = factors or (1 + float((part * here).sum()) / square,)
        kind = b.kind(rows)
        called = f"{term.name(kind)}{about}" + (f" in {name}" if name in single else "")
        for factor in own:
            words, rank = changed(called, factor, b.named, partial(stands_in, b, term=term))
            left = through(back, here - (factor - 1) * part)
            yield Hypothesis(words, rank + (name in single), left)
        if name in sets and not factors:
            for x in _powers(b, term, called, part, here):
                yield replace(x, left=through(back, x.left))


def _powers(b: Balance, term: Term, name: str, part: Array, here: Array) -> Iterator[Hypothesis]:
    """A term times a power of the distance from its centre, or of a speed."""
    squares = (part * part).sum(axis=1)
    if not squares.all():
        return
    factors = 1 + (part * here).sum(axis=1) / squares
    if not (factors > 0).all():
        return
    d = here.shape[1]
    turning = len(b.rows.get("moment", ())) or d
    velocity = b.x[:, b.moving]
    about = {"|ω|": velocity[:, :turning], "|v|": velocity[:, turning:]}
    if term.centre is not None:
        about = {"r, the distance from the centre": term.centre, **about}
    for words, vectors in about.items():
        if not vectors.shape[1]:
            continue
        rows = np.stack([np.log(np.linalg.norm(vectors, axis=1)), np.ones(len(vectors))], axis=1)
        (power, constant), *_ = np.linalg.lstsq(rows, np.log(factors), rcond=None)
        simple = round(2 * power) / 2
        if not simple or abs(power - simple) > NEAR:
            continue
        scaled = np.exp(rows @ np.array([simple, constant]))[:, None]
        more = "" if abs(constant) <= NEAR else f", and the factor {np.exp(constant):.6g}"
        told_as = f"{name} has the power {simple:+g} of {words}, too many{more}"
        told_as = told_as.replace("+", "").replace(", too many", " beside its own")
        yield Hypothesis(told_as, 1, here - (scaled - 1) * part)


Told = list[tuple[str, int]]
"""What is said, and how far each is from saying what happened."""


def of_several(b: Balance, terms: list[Term], view: tuple[str, Array]) -> Told:
    """Factors of several terms, row by row, where these explain all; terms that cannot be told
    apart are said to be so."""
    about, to = view
    here = through(to, b.unexplained)
    size = np.atleast_2d(through(np.abs(to), b.size())).max(axis=0)
    whole = [(x, through(to, x.values)) for x in terms if not x.part]
    found: dict[str, tuple[Term, dict[int, float]]] = {}
    stands: dict[str, int] = {}
    said: Told = []
    for row in range(here.shape[1]):
        columns = [(x, y[:, row]) for x, y in whole if np.abs(y[:, row]).max() > 1e-12 * size[row]]
        kind = b.kind([row])
        if not columns:
            if not exact(here[:, row], size[row]):
                return []
            continue
        names = [f"{x.name(kind)}{about}" for x, _ in columns]
        for name in names:
            stands[name] = stands.get(name, 0) + 1
        design = np.stack([y for _, y in columns], axis=1)
        scale = np.abs(design).max(axis=0)
        factors, _, rank, _ = np.linalg.lstsq(design / scale, here[:, row], rcond=1e-9)
        if not exact(here[:, row] - (design / scale) @ factors, size[row]):
            return []
        if rank < len(columns):
            null = np.linalg.svd(design / scale)[2][rank:]
            alike = [x for x, n in zip(names, null.T, strict=True) if np.abs(n).max() > 1e-6]
            said.append((f"cannot be told apart in row {row + 1}: {', '.join(alike)}", 1))
        for (x, _), name, factor in zip(columns, names, factors / scale, strict=True):
            if abs(factor) > NEAR:
                found.setdefault(name, (x, {}))[1][row] = 1 + float(factor)
    for name, (term, rows) in found.items():
        values, related = [*rows.values()], partial(stands_in, b, term=term)
        if max(values) - min(values) <= NEAR and len(values) == stands[name]:
            said.append(changed(name, values[0], b.named, related))
            continue
        each = (changed(f"{name} in row {i + 1}", x, b.named, related) for i, x in rows.items())
        said += [(words, 1) for words, _ in each]
    return said


def of_tables(b: Balance) -> Told:
    """Several numbers of the body, or of one force, where other values of these explain all."""
    base, size = b.values(), b.size()
    groups: dict[str, list[str]] = {}
    for x in b.opened.slots:
        groups.setdefault(x.key.partition(" of ")[2] or "body", []).append(x.name)
    groups["parameters"] = []
    words = {x.name: b.words(x) for x in b.opened.slots}
    more = {**dict.fromkeys(base, 0.0), **b.operator}
    for own in groups.values():
        values, here = dict(base), b.unexplained
        for turn in range(TURNS if own else 0):
            slopes = []
            for name in own:
                step = 1e-6 * max(abs(values[name]), 1e-3)
                up, down = (possible(b, {**values, name: values[name] + s}) for s in (step, -step))
                if up is None or down is None:
                    break
                slopes.append(((up - down) / (2 * step)).ravel())
            if len(slopes) < len(own):
                break
            change = np.linalg.lstsq(np.stack(slopes, axis=1), -here.ravel(), rcond=1e-9)[0]
            values |= {x: values[x] + float(y) for x, y in zip(own, change, strict=True)}
            there = possible(b, values)
            # near a solution each step leaves far less
            if there is None or (turn > 1 and not _halved(there, here)):
                break
            here = there
            if exact(here, size) and exact(b.checked(here, b.mass(values)), size):
                changed = [x for x in own if abs(values[x] - base[x]) > NEAR * max(abs(base[x]), 1)]
                every = {words[x]: base[x] + more[x] for x in own}
                two = {x: (base[x] + more[x], values[x] + more[x]) for x in changed}
                return [told(words[x], *two[x], every) for x in changed]
    return []


def _halved(left: Array, before: Array) -> bool:
    """Is there half as much left as before, at most?"""
    return bool(np.abs(left).sum() <= NEARER * np.abs(before).sum())
