"""The prose of the walk as data: messages with places, what stands in the places; and claims.

A message is an English sentence, or a part of one, with places ``{name}``; views have it in other
languages under that very text.  A claim is what a sentence of a step says beside the step's
equations: it has the key of its sentence in :mod:`derive.record.prose` and a value, a tree, for
each place that is filled by one; ``("row", …)`` lists several.  The sentence is its rendering, and
nothing that :data:`CLAIMS` has is said without one: ``derive check`` computes every claim again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import Any

from ..language.limits import SENTENCE
from ..language.show import in_sentence
from ..language.tree import Tree
from .prose import LISTS, marked, message, messages

PLACE = re.compile(r"\{([a-z]+)\}")


@dataclass(frozen=True)
class Sentence:
    """A message and what fills its places: sentences, or text that is the same in every language.

    Without places the message is taken to the letter, braces and all.
    """

    message: str
    places: tuple[tuple[str, Sentence | str], ...] = ()

    def __str__(self) -> str:
        return filled(self.message, {name: str(x) for name, x in self.places})


Prose = tuple[Sentence, ...]
"""Sentences one after the other."""


def filled(message: str, places: Mapping[str, str]) -> str:
    """The text of a message with each place ``{name}`` replaced by its value."""
    return PLACE.sub(lambda found: places[found[1]], message) if places else message


def phrase(message: str, **places: Sentence | str) -> Sentence:
    """A sentence, or a part of one to stand in a place, from a message and its places' values."""
    return Sentence(message, tuple(places.items()))


def say(message: str, **places: Sentence | str) -> Prose:
    """Prose of a single sentence, from its message and the values of its places."""
    return (phrase(message, **places),)


def listed(message: str, items: Sequence[Sentence]) -> Sentence:
    """Many sentences as one, two by two, by a message with the places ``first`` and ``second``."""
    if len(items) < 2:
        return items[0] if items else phrase("")
    half = len(items) // 2
    first, second = listed(message, items[:half]), listed(message, items[half:])
    return phrase(message, first=first, second=second)


def enumerated(items: Sequence[Sentence]) -> Sentence:
    """Parts of a sentence, at least one, with commas and an "and" before the last."""
    *before, last = items
    first = listed("{first}, {second}", before)
    return phrase("{first} and {second}", first=first, second=last) if before else last


def english(prose: Prose) -> str:
    """The prose as English text, its sentences separated by spaces."""
    return " ".join(map(str, prose))


def plain(prose: Prose) -> bool:
    """Is the prose one sentence without places, which its English text alone identifies?"""
    return len(prose) == 1 and not prose[0].places


def to_data(prose: Prose) -> list[dict[str, Any]]:
    """The prose as plain data: for each sentence its message and the values of its places."""
    return [_data(sentence) for sentence in prose]


def _data(x: Sentence) -> dict[str, Any]:
    places = {name: y if isinstance(y, str) else _data(y) for name, y in x.places}
    return {"message": x.message, "places": places}


def of_data(data: Any, where: str) -> Prose:
    """The inverse of :func:`to_data`; ``ValueError`` says what is wrong, and ``where``."""
    if not isinstance(data, list):
        raise ValueError(f"{where}: key 'sentences' must be a list")
    return tuple(_sentence(x, f"{where}, sentence {k}", 0) for k, x in enumerate(data, 1))


def _sentence(data: Any, where: str, depth: int) -> Sentence:
    """One sentence from its data, at some depth of sentences in places of others."""
    if depth > SENTENCE:
        raise ValueError(f"{where}: sentences nested deeper than {SENTENCE}")
    if not isinstance(data, dict) or set(data) != {"message", "places"}:
        raise ValueError(f"{where}: expected an object with the keys 'message' and 'places'")
    message, places = data["message"], data["places"]
    if not isinstance(message, str) or not isinstance(places, dict):
        raise ValueError(f"{where}: 'message' must be a str and 'places' a dict")
    # each once: what repeats a place could grow without bound when it is filled
    if places and sorted(PLACE.findall(message)) != sorted(places):
        raise ValueError(f"{where}: 'places' must be those of the message, each in it once")
    read = (x if isinstance(x, str) else _sentence(x, where, depth + 1) for x in places.values())
    return Sentence(message, tuple(zip(places, read, strict=True)))


# Claims.

SIGNED = "_signed"
"""The end of the key of what is said where masses may be negative."""
CONDITIONS = marked("(condition)")
"""The claims of the walk, whose values, names and numbers, stand in their sentences."""
CLAIMS = CONDITIONS | marked("(claim)")
"""The keys of the sentences that are claims."""

MONOMIALS = 10_000
"""That there are no more polynomials up to a degree is computed again of so many monomials at most;
of more, the sentence says that it is not."""

WORDS = re.compile(r"[A-Za-z]{2}\s+[A-Za-z]{2}")
"""Two words, as no text has that is the same in all languages: names are in quotes."""
SHOWN = 120
"""The most letters of a sentence that a message quotes."""


@dataclass(frozen=True)
class Claim:
    """What the sentence of a key, ``kind``, says with these values in its places."""

    kind: str
    values: tuple[tuple[str, Tree], ...] = ()

    def __getitem__(self, name: str) -> Tree:
        """The value of a place; ``KeyError`` for none."""
        return dict(self.values)[name]

    @property
    def texts(self) -> dict[str, Sentence | str]:
        """What stands in the places of the sentence."""
        by_kind = TEXTS.get(self.kind, text)
        return {name: TEXTS.get(f"{self.kind}.{name}", by_kind)(x) for name, x in self.values}


def text(x: Tree) -> str:
    """A value as it stands in a sentence: several with commas, rows of a matrix as equations, and
    several matrices with numbers."""
    if isinstance(x, tuple) and x[0] == "matrix":
        return ", ".join(" = ".join(map(in_sentence, row[1:])) for row in x[1:])
    several = x[1:] if isinstance(x, tuple) and x[0] == "row" else (x,)
    if several and all(isinstance(y, tuple) and y[0] == "matrix" for y in several):
        return "; ".join(f"({k}) {text(y)}" for k, y in enumerate(several, 1))
    return ", ".join(map(in_sentence, several))


def _decimal(x: Tree) -> str:
    assert isinstance(x, (int, Fraction))
    return f"{float(x):.15g}".replace("-", "−")


def _coordinates(x: Tree) -> str:
    """Rows of a matrix, each a name and a number, as decimals."""
    assert isinstance(x, tuple)
    return ", ".join(f"{in_sentence(name)} ≈ {_decimal(y)}" for _, name, y in x[1:])


def _eigenvalues(x: Tree) -> str:
    """Rows of a matrix, the real and the imaginary part of numbers, which come with their opposites
    and conjugates, as decimals."""
    assert isinstance(x, tuple)
    pairs = ((row[1:], ("", "i")) for row in x[1:])
    parts = ([f"±{_decimal(y)}{i}" for y, i in zip(*two, strict=True) if y] for two in pairs)
    return ", ".join(" ".join(x) or "0" for x in parts)


def _complex(x: Tree) -> str:
    """The same of numbers that come with their conjugates."""
    assert isinstance(x, tuple)
    pairs = ((_decimal(re), _decimal(im)) for _, re, im in x[1:])
    return ", ".join(re if im == "0" else f"{re} ± {im}i" for re, im in pairs)


def _nonzero(x: Tree) -> str:
    """Several expressions that must not vanish."""
    assert isinstance(x, tuple)
    return ", ".join(f"{in_sentence(y)} ≠ 0" for y in x[1:])


*_, AND, OR = LISTS


def _inequalities(x: Tree) -> Sentence | str:
    """Rows of a matrix, two sides of which the first is the greater; of several such the rows of
    each with an "and", and an "or" between them."""
    assert isinstance(x, tuple)
    if x[0] == "row":
        cases = ([*map(_inequality, y[1:])] for y in x[1:] if isinstance(y, tuple))
        return _two_by_two(OR, [_two_by_two(AND, y) for y in cases if y])
    if x[0] != "matrix":
        return in_sentence(x)
    return ", ".join(map(_inequality, x[1:]))


def _inequality(row: Tree) -> str:
    assert isinstance(row, tuple)
    greater, less = map(in_sentence, row[1:])
    return f"{less} < 0" if greater == "0" else f"{greater} > {less}"


def _two_by_two(by: str, parts: Sequence[Sentence | str]) -> Sentence | str:
    return reduce(lambda x, y: phrase(by, first=x, second=y), parts) if parts else ""


FAMILIES = ("positive", "stable", "stable_beyond", "on_the_leaf", "unstable", "unstable_large")
TEXTS = dict.fromkeys((f"family.{x}" for x in FAMILIES), _inequalities) | {
    "equilibrium.near": _coordinates,
    **dict.fromkeys((f"trim.near_{x}.near" for x in ("rest", "steady", "along")), _coordinates),
    "trim.near_turned.entries": _coordinates,
    "trim.near_turned_on_the_left.entries": _coordinates,
    "trim.near_velocity.entries": _coordinates,
    "trim.near_eigenvalues.eigenvalues": _complex,
    "equilibrium.eigenvalues": _eigenvalues,
    "enclosure.eigenvalues": _eigenvalues,
    "reduction.isotropy": _nonzero,
    "reduction.divided": _nonzero,
}
"""How the values of some kinds, or of some of their places, stand in their sentences, those of
others as :func:`text` has it."""


def rendered(claim: Claim, **phrases: Sentence) -> Sentence:
    """The sentence of a claim; ``phrases`` fill the places that have no value."""
    return phrase(message(claim.kind), **(claim.texts | phrases))


def conditions(prose: Prose) -> Iterator[Claim]:
    """The claims of sentences that alone tell them."""
    keys = {message(kind): kind for kind in CONDITIONS}
    for x in _parts(prose):
        if kind := keys.get(x.message):
            texts = ((name, y) for name, y in x.places if isinstance(y, str))
            yield Claim(kind, tuple((name, int(y) if y.isdigit() else y) for name, y in texts))


def fault(prose: Prose, claims: tuple[Claim, ...]) -> str:
    """A sentence that is no message of :mod:`derive.record.prose`, or has words in the place of a
    formula, or is a claim and among none of these, or a claim that no sentence is; "" where they
    agree."""
    parts = [*_parts(prose)]
    if strange := next((x.message for x in parts if x.message not in messages()), ""):
        return f"a sentence that is none of derive's: {_quoted(strange)}"
    texts = (y for x in parts for _, y in x.places if isinstance(y, str))
    if words := next(filter(WORDS.search, texts), ""):
        return f"words in the place of a formula: {_quoted(words)}"
    keys = {message(kind): kind for kind in CLAIMS}
    said = [x for x in parts if x.message in keys]
    for claim in claims:
        if not any(_says(x, claim) for x in said):
            return f"the claim {claim.kind} is not what the sentences say"
    for x in said:
        if not any(_says(x, claim) for claim in claims):
            return f"the sentence {keys[x.message]} is a claim, and the step has none such"
    return ""


def _quoted(words: str) -> str:
    """The first letters of words, on one line."""
    line = " ".join(words.split())
    return f"“{line if len(line) <= SHOWN else line[:SHOWN] + ' …'}”"


def _says(x: Sentence, claim: Claim) -> bool:
    """Is a sentence the rendering of a claim, up to its phrases?"""
    told = claim.texts
    texts = {name: y for name, y in x.places if isinstance(y, str) or name in told}
    return x.message == message(claim.kind) and texts == told


def _parts(prose: Prose) -> Iterator[Sentence]:
    """The sentences, and those in their places."""
    for x in prose:
        yield x
        yield from _parts(tuple(y for _, y in x.places if isinstance(y, Sentence)))
