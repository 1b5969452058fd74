"""What each further option of an emission would be refused for, told before it is chosen.

The reasons are the command's own: those that are known before the code is made.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from ..code.emit import planned
from ..code.languages import LANGUAGES
from ..code.options import ADDED, CHOICES, DEPENDENT, REPEATED, Options
from ..language.refused import Refused
from ..pipeline import require_program
from ..problem.problem import Problem
from ..record.record import Derivation

Choice = tuple[tuple[str, ...], Options]
"""Languages and options."""


def refused(
    p: Problem, record: Derivation, languages: Sequence[str], chosen: Options
) -> dict[str, str]:
    """Option → why it cannot be chosen beside the others: ``lang julia``, ``step gauss``,
    ``momenta``; where what is chosen is refused itself, that alone, by the name ""."""
    own = (*languages,), chosen
    if reason := _reason(p, record, own):
        return {"": reason}
    reasons = {words: _reason(p, record, choice) for words, choice in further(*own)}
    return {words: reason for words, reason in reasons.items() if reason}


def further(languages: tuple[str, ...], chosen: Options) -> Iterator[tuple[str, Choice]]:
    """Each option that is not chosen, and the choice with it."""
    for name in LANGUAGES:
        if name not in languages:
            yield f"lang {name}", ((*languages, name), chosen)
    for name, (values, _) in (CHOICES | DEPENDENT).items():
        for x in values:
            if x != getattr(chosen, name):
                yield f"{name} {x}", (languages, _with(chosen, name, x))
    for name, (values, _) in REPEATED.items():
        given = getattr(chosen, name)
        for x in values:
            if x not in given:
                yield f"{name} {x}", (languages, _with(chosen, name, (*given, x)))
    for name in ADDED:
        if not getattr(chosen, name):
            yield name, (languages, _with(chosen, name, True))


def _with(chosen: Options, name: str, value: object) -> Options:
    changed: dict[str, Any] = {name: value}
    return replace(chosen, **changed)


def _reason(p: Problem, record: Derivation, choice: Choice) -> str:
    """Why a choice is refused; empty where it is not, as far as is known before it is made."""
    languages, options = choice
    try:
        require_program(p, record, options)
        planned(languages, p.name, options)
    except Refused as error:
        return str(error)
    return ""
