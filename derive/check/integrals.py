"""A continuous body at its point masses: integrals over it, and functions of a place in it."""

from __future__ import annotations

from collections import ChainMap
from dataclasses import replace
from functools import reduce
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..language.tree import Tree
from .arithmetic import EvaluationError, plus, times
from .evaluate import Environment, evaluate
from .fluid_values import fluid_values, over_volume, pressure_at
from .function_signatures import PER_DENSITY
from .model import Model


def place_values(model: Model) -> dict[str, Any]:
    """The values of r, a random place in the body, of v, its velocity in space (columns), and of
    the pressure there."""
    r = q.column(model.draw() for _ in range(model.n))
    return {"r": r, "v": moved(model, model.nu, r)} | fluid_values(model, r)


def moved(model: Model, g: Matrix, r: Matrix) -> Matrix:
    """g(r) as a column, for a group element or a tangent matrix g and a column r."""
    return q.times(g, model.homogeneous(q.flatten(r)))[: model.n]


def integral(model: Model, form: Tree, env: Environment) -> Any:
    """∫ of a function of r over the body: a sum over point masses with the same moments, which is
    exact for forms of degree two, or over shells; ``EvaluationError`` where the body is none of
    solids."""
    if model.problem.get("body", {}).get("kind") != "given":
        raise EvaluationError("integrals are over solids")
    if form in PER_DENSITY:
        return over_volume(model, form[1], env.names["p_0"])  # type: ignore[index]
    terms: list[Any] = []
    for m, at in zip(model.masses, model.points, strict=True):
        r = q.column(at)
        here = {"r": r, "v": moved(model, model.nu, r)}
        if form == "p_r":
            here["p_r"] = pressure_at(r, env.names["Q_r"], env.names["p_0"])
        there = replace(env, names=ChainMap(here, env.names))  # type: ignore[arg-type]
        terms.append(times(m, evaluate(form, there)))
    return reduce(plus, terms)
