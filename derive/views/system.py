"""The system of a record in words: its group, its body, and what acts on it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..record.record import Derivation
from ..record.sentence import Sentence, listed, phrase
from ..schema.kinds import kinds
from .language import Language
from .outline import group


def system(d: Derivation, language: Language) -> str:
    """What moves, by which group, and what acts on it; empty where the record has no body."""
    basis, body = d.problem.get("basis"), d.problem.get("body")
    if not isinstance(basis, list) or not basis or not isinstance(body, Mapping):
        return ""
    moved = language.word(
        "The group {group}, of dimension {d}, moves {body}.",
        group=group(d),
        d=str(len(basis)),
        body=language.sentence(_body(body)),
    )
    acting = [*_acting(d.problem)]
    if not acting:
        return " ".join((moved, language.word("Nothing acts.")))
    forces = language.sentence(listed("{first}, {second}", acting))
    return " ".join((moved, language.word("What acts: {forces}.", forces=forces)))


def _body(body: Mapping[str, Any]) -> Sentence:
    points, solids = _many(body.get("points")), _many(body.get("solids"))
    if points and solids:
        return phrase("a body of points and solids")
    if points:
        return phrase("{n} points", n=str(points)) if points > 1 else phrase("one point")
    if solids:
        return phrase("a body of {n} solids", n=str(solids)) if solids > 1 else phrase("a solid")
    return phrase("a body given by its moments")


def _acting(problem: Mapping[str, Any]) -> Iterator[Sentence]:
    potentials, inputs = problem.get("potentials"), problem.get("inputs")
    present = [p.get("kind") for p in potentials] if isinstance(potentials, list) else []
    for kind, about in kinds().items():
        count = present.count(kind)
        if count > 1 and about.several:
            yield phrase(about.several, n=str(count))
        elif count:
            yield phrase(about.phrase)
    if _many(problem.get("damping")):
        yield phrase("viscous damping")
    for x in inputs if isinstance(inputs, list) else []:
        yield phrase("the input {name}", name=str(x.get("name")))


def _many(x: Any) -> int:
    """The length of a list; 0 for anything else."""
    return len(x) if isinstance(x, list) else 0
