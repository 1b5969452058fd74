"""The head of a record: its problem as plain data, and the names that its steps use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from ...algebra.groups import Group
from ...language.show import in_sentence
from ...problem.problem import Problem, data
from ...record import sentence, vocabulary
from ...record.as_json import encode
from ...record.record import CONVENTIONS, Derivation, Step, Symbol
from ...record.uses import of_steps
from ...record.vocabulary import DISCRETE, Name
from ..chapter import say
from ..given.inputs import numbers
from .lagrangian import completed

SHOWN = 3
"""So many numbers of an input are told one by one."""


def recorded(problem: Problem, steps: Iterable[Step], **more: object) -> Derivation:
    """The record of a problem by its steps; ``more``: what its data have beside the problem's."""
    data, done = problem_data(problem) | more, completed(steps)
    return Derivation(data, _symbols(done, problem, data), done)


def problem_data(problem: Problem) -> dict[str, object]:
    """The problem as JSON data: trees encoded."""

    def plain(x: object) -> object:
        if isinstance(x, dict):
            return {k: plain(v) for k, v in x.items()}
        if isinstance(x, list):
            return [plain(v) for v in x]
        return encode(x) if isinstance(x, (tuple, Fraction)) else x

    basis = problem.group.in_user_basis.basis if problem.group else ()
    rows = [[[str(x) for x in row] for row in e] for e in basis]
    n = problem.group.n if problem.group else problem.torus.N if problem.torus else "any"
    found = data(problem) | {"n": n, "basis": rows, "conventions": list(CONVENTIONS)}
    return {k: plain(v) for k, v in found.items()}


def _symbols(
    steps: tuple[Step, ...], problem: Problem, data: Mapping[str, Any]
) -> tuple[Symbol, ...]:
    """The names that the steps use, in the order in which they appear."""
    meant, group = _meant(problem), problem.group
    discrete = "discrete" in data
    if discrete:
        meant = vocabulary.VOCABULARY | DISCRETE[problem.action]
    sizes = _sizes(group) if group else {}
    if problem.torus:
        sizes = {"n": problem.torus.N, "lattice": 2}
    sizes["inputs"] = len(problem.kinematics.inputs) if problem.kinematics else 0
    sizes["fields"] = len(data.get("symmetries", ()))
    sizes["carried"] = sum(x.size for x in problem.advected or ())
    sizes["reduced"] = sizes["carried"] + sizes.get("dim", 0)
    meanings = {x: sentence.say(about.meaning) for x, about in meant.items()}
    if problem.covector and group:
        for x in ("u", "f_u"):
            given = _given(problem, x, discrete)
            meanings[x] = say("input.numbers", meaning=meanings[x][0], numbers=given)
    used = of_steps(steps, meant, sizes)
    return tuple(Symbol(x, meanings[x], meant[x].latex, uses) for x, uses in used.items())


def _sizes(group: Group) -> dict[str, int]:
    """What n, d and dim are for a group; and ``block``, where all its factors are of one size."""
    sizes = {"n": group.n, "d": len(group.linear_basis), "dim": group.dimension, "size": group.size}
    blocks = {factor.n for _, factor in group.places}
    return sizes | ({"block": blocks.pop()} if len(blocks) == 1 else {})


def _meant(problem: Problem) -> dict[str, Name]:
    """The vocabulary of a problem, name → its meanings there: of all problems, of turning, of
    products."""
    group, own = problem.group, dict[str, Name]()
    if problem.fluid:
        own = vocabulary.FLUID
    elif problem.kinematics:
        own = vocabulary.KINEMATICS
    elif problem.torus:
        own = vocabulary.LAGRANGIANS["right"] | vocabulary.ON_THE_TORUS
    elif problem.lagrangian:
        carried = vocabulary.CARRYING if problem.advected else {}
        own = vocabulary.LAGRANGIANS[problem.lagrangian.trivialisation] | carried
    elif group:
        turned = vocabulary.DISPLACEMENTS if group.affine else vocabulary.ROTATIONS
        blocks = vocabulary.PRODUCTS if len(group.factors) > 1 else {}
        own = (turned if group.turns_space else {}) | blocks
    return vocabulary.VOCABULARY | own


def _given(problem: Problem, letter: str, discrete: bool) -> str:
    """The numbers of the covector that are the entries of u or of f_u, by the user's names."""
    given = numbers(problem, discrete=discrete).items()
    told = [in_sentence(x) for t, x in given if isinstance(t, tuple) and t[1] == letter]
    return ", ".join(told if len(told) <= SHOWN else (told[0], "…", told[-1]))
