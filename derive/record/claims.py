"""Claims: what a sentence of a step says beside the step's equations, as data.

A claim has the key of its sentence in :mod:`derive.prose` and a value, a tree, for each place that
is filled by one; ``("row", …)`` lists several.  The sentence is its rendering, and nothing that
:data:`CLAIMS` lists is said without one: ``derive check`` computes every claim again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from ..language.show import in_sentence
from ..language.tree import Tree
from ..prose import english, messages
from . import sentence
from .sentence import Prose, Sentence

KINDS = {
    "poisson": "group advected weighted weights",
    "casimirs": "kept all all_large",
    "first_integrals": (
        "all all_large all_generic all_generic_large it it_and_casimirs these these_and_casimirs "
        "dependent complete complete_by_one complete_by_energy undecided still unknown_rank "
        "further no_further unsolved"
    ),
    "level": "multiple complete",
    "condition": "one several complete",
    "reduction": (
        "taken flat curved isotropy divided free quadrature elementary elliptic hyperelliptic "
        "elementary_squared elliptic_squared hyperelliptic_squared"
    ),
    "relation": "left_invariant",
    "tetrahedron": "affine linear",
    "symmetries": "algebra algebra_modulo none open",
    "equilibrium": (
        "at origin none orbit form stable stable_beyond stable_compact on_the_leaf indefinite "
        "point unstable unstable_beyond open undecided eigenvalues squares near"
    ),
    "enclosure": "within signs stable unstable open eigenvalues",
}
CLAIMS = frozenset(
    f"{subject}.{name}" for subject, names in KINDS.items() for name in names.split()
)
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
    def texts(self) -> dict[str, str]:
        """What stands in the places of the sentence."""
        return {name: TEXTS.get(self.kind, text)(x) for name, x in self.values}


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


def _nonzero(x: Tree) -> str:
    """Several expressions that must not vanish."""
    assert isinstance(x, tuple)
    return ", ".join(f"{in_sentence(y)} ≠ 0" for y in x[1:])


TEXTS = {
    "equilibrium.near": _coordinates,
    "equilibrium.eigenvalues": _eigenvalues,
    "enclosure.eigenvalues": _eigenvalues,
    "reduction.isotropy": _nonzero,
    "reduction.divided": _nonzero,
}
"""How the values of some kinds stand in their sentences, those of others as :func:`text` has it."""


def rendered(claim: Claim, **phrases: Sentence) -> Sentence:
    """The sentence of a claim; ``phrases`` fill the places that have no value."""
    return sentence.phrase(english(claim.kind), **(claim.texts | phrases))


def fault(prose: Prose, claims: tuple[Claim, ...]) -> str:
    """A sentence that is no message of :mod:`derive.prose`, or has words in the place of a formula,
    or is a claim and among none of these, or a claim that no sentence is; "" where they agree."""
    parts = [*_parts(prose)]
    if strange := next((x.message for x in parts if x.message not in messages()), ""):
        return f"a sentence that is none of derive's: {_quoted(strange)}"
    texts = (y for x in parts for _, y in x.places if isinstance(y, str))
    if words := next(filter(WORDS.search, texts), ""):
        return f"words in the place of a formula: {_quoted(words)}"
    keys = {english(kind): kind for kind in CLAIMS}
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
    texts = {name: y for name, y in x.places if isinstance(y, str)}
    return x.message == english(claim.kind) and texts == claim.texts


def _parts(prose: Prose) -> Iterator[Sentence]:
    """The sentences, and those in their places."""
    for x in prose:
        yield x
        yield from _parts(tuple(y for _, y in x.places if isinstance(y, Sentence)))
