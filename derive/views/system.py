"""The system of a record in words: its group, its body, and what acts on it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..language.tree import names
from ..record.as_json import decode
from ..record.record import Derivation
from ..record.sentence import Sentence, listed, phrase
from ..schema.kinds import kinds
from .language import Language
from .outline import given, group


def system(d: Derivation, language: Language) -> str:
    """What moves, by which group, or where a Lagrangian is given, and what acts; empty where the
    record has neither."""
    stated = given(d.problem)
    moved = language.sentence(_stated(d)) if stated else _moved(d, language)
    acting = [*_acting(d.problem)] if moved else []
    if acting:
        forces = language.sentence(listed("{first}, {second}", acting))
        return " ".join((moved, language.word("What acts: {forces}.", forces=forces)))
    if stated or not moved:
        return moved
    return " ".join((moved, language.word("Nothing acts.")))


def _moved(d: Derivation, language: Language) -> str:
    """What moves, by which group; empty where the record has no body."""
    basis, body = d.problem.get("basis"), d.problem.get("body")
    if not isinstance(basis, list) or not basis or not isinstance(body, Mapping):
        return ""
    return language.word(
        "The group {group}, of dimension {d}, moves {body}.",
        group=group(d),
        d=str(len(basis)),
        body=language.sentence(_body(body)),
    )


def _stated(d: Derivation) -> Sentence:
    """Where the Lagrangian is given, and what it depends on."""
    torus, basis = d.problem.get("torus"), d.problem.get("basis")
    if isinstance(torus, Mapping):
        return phrase(
            "The group {group}, of dimension {d}, stands for the maps of the torus that keep the "
            "area. Its Lagrangian is given: the kinetic energy of a fluid.",
            group=group(d),
            d=str(torus["N"] ** 2 - 1),
        )
    *before, last = _depends(d.problem)
    what = last
    if before:
        what = phrase(
            "{first} and {second}", first=listed("{first}, {second}", before), second=last
        )
    dimension = str(_many(basis))
    if d.problem.get("advected") is not None:
        return phrase(
            "The Lagrangian is given on a Lie algebra of dimension {d}, and depends {what}; "
            "the state has no element of a group.",
            d=dimension,
            what=what,
        )
    return phrase(
        "The Lagrangian is given on the group {group}, of dimension {d}, and depends {what}.",
        group=group(d),
        d=dimension,
        what=what,
    )


def _depends(problem: Mapping[str, Any]) -> Iterator[Sentence]:
    used = {*names(decode(problem["lagrangian"]["L"], "lagrangian"))}
    yield phrase("on the velocity")
    if used - {"ζ", "t", "Γ"}:
        yield phrase("on the element of the group")
    if "Γ" in used:
        yield phrase("on what the algebra carries along")
    if "t" in used:
        yield phrase("on the time")


def _body(body: Mapping[str, Any]) -> Sentence:
    points, solids = _many(body.get("points")), _many(body.get("solids"))
    if points and solids:
        return phrase("a body of points and solids")
    if points:
        return phrase("{n} points", n=str(points)) if points > 1 else phrase("one point")
    if solids == 1 and body["solids"][0].get("kind") == "ellipsoid":
        return phrase("a homogeneous ellipsoid")
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
