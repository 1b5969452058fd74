"""Problem files: TOML read into :class:`Problem`, every key checked, errors in one line."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ..algebra.families import on_homogeneous
from ..algebra.groups import Group
from ..language.expression import names, numbers
from ..language.limits import (
    BITS,
    COMMON_BITS,
    KEY_PARTS,
    LEAVES,
    PARAMETERS,
    PROBLEM_BYTES,
    PULLS,
)
from ..language.tree import Tree
from ..language.weight import weight
from ..schema.algebra_kinds import Advected
from ..schema.body_kinds import GivenBody, MomentBody
from ..schema.declared import Parameter
from ..schema.fluid_kinds import Fluid
from ..schema.kinds import kinds
from ..schema.lagrangian_kinds import SECTIONS
from ..schema.table import Table, nearest
from . import inertia
from .bodies import body
from .fields import LIKE_A_PLACE, used_at
from .file_reader import FileReader
from .followed_names import named_twice
from .forces import forces, negative_stiffness_of
from .group import group_of
from .problem import Problem, ProblemError
from .stated_algebra import carried_group
from .stated_lagrangian import lagrangian
from .stated_motion import KEYS, named, stated_motion
from .stated_torus import on_torus, torus_problem
from .toml_faults import unread

TOP = {"name", "title", "group", "action", "parameters", "point", "body", "potential", "input"}
TOP |= {"damping", "solid", "algebra", "advected", "fluid", *SECTIONS, *KEYS}
DOTTED = re.compile(
    rb"\.(?:[ \t]*(?:[\w-]++|\"[^\"\n]*+\"|'[^'\n]*+')[ \t]*\.){%d}" % KEY_PARTS, re.ASCII
)
"""A dotted key of too many parts. Tried at dots alone, and possessive: no text is slow."""


def load(path: Path, **allowed: bool) -> Problem:
    """Read a problem file; :class:`ProblemError` names file, key and remedy.

    ``allowed``: what may be negative, as :func:`problem_of` has it.
    """
    try:
        with path.open("rb") as file:
            raw = file.read(PROBLEM_BYTES + 1)
    except OSError as error:
        raise ProblemError(f"{path}: {error.strerror}") from None
    if len(raw) > PROBLEM_BYTES:
        raise ProblemError(f"{path}: larger than {PROBLEM_BYTES} bytes")
    if DOTTED.search(raw):
        raise ProblemError(f"{path}: a key of more than {KEY_PARTS} parts; no key has so many")
    try:
        data = tomllib.loads(raw.decode("utf-8-sig"))
    except RecursionError:
        raise ProblemError(f"{path}: tables or lists nested deeper than can be read") from None
    except (tomllib.TOMLDecodeError, UnicodeError) as error:
        kind = (
            ""
            if path.suffix == ".toml"
            else "; a problem is a .toml file, and records (.json) are for check"
        )
        raise ProblemError(f"{path}: not TOML: {unread(raw, error)}{kind}") from None
    except ValueError:  # Python reads no integer of thousands of digits
        raise ProblemError(f"{path}: {HUGE}") from None
    if _huge(data):
        raise ProblemError(f"{path}: {HUGE}")
    try:
        return problem_of(data, path.parent, **allowed)
    except ProblemError as error:
        raise ProblemError(f"{path}: {error}") from None


"""What names mean in every expression."""

HUGE = "an integer of hundreds of digits; numbers go up to 1e300"


def _huge(data: Any) -> bool:
    """Is there an integer in the data that no message could show?"""
    left = [data]
    while left:
        x = left.pop()
        if isinstance(x, int) and x.bit_length() > BITS:
            return True
        left += x.values() if isinstance(x, dict) else x if isinstance(x, list) else ()
    return False


def problem_of(
    data: Mapping[str, Any],
    folder: Path = Path(),
    negative_mass: bool = False,
    negative_stiffness: bool = False,
) -> Problem:
    """A problem from the plain data of a file in a folder, where its meshes are.

    ``negative_mass``, ``negative_stiffness`` (damping included): may they be negative numbers?
    """
    reader = FileReader(folder)
    reader.known(data, TOP, "file")
    if "fluid" in data:
        return _fluid(data, reader)
    if on_torus(data):
        return torus_problem(data, reader)
    if "algebra" in data:
        return _without_points(data, *carried_group(data))
    if "advected" in data:
        raise ProblemError("key 'advected' goes with [algebra]: a group has its entries A_11, …")
    moved, action = group_of(data, reader)
    reader.moves(moved)
    name = reader.name_of(data, of_its_own=moved is not None)
    parameters = _parameters(data.get("parameters", {}), reader)
    if any(key in data for key in SECTIONS):
        return _without_points(data, moved)
    reader.parameters = parameters
    own = body(data, reader)
    if moved and own is None:
        raise ProblemError(
            "no body: give [[point]] or [[solid]] tables, or a table [body]; or a [lagrangian]"
        )
    if isinstance(own, MomentBody):
        named = {x: parameters.get(x, p) for x, p in own.parameters().items()}
        parameters = {**named, **{k: p for k, p in parameters.items() if k not in named}}
    if not negative_mass:
        _positive(inertia.negative_mass(own, parameters), "mass")
    reader.carries(own, parameters)
    potentials, inputs, damping = forces(data, reader)
    if not negative_stiffness:
        _positive(negative_stiffness_of(potentials, damping, parameters), "stiffness")
    reader.distinct(inputs, parameters)
    problem = Problem(
        name,
        moved,
        action,
        reader.title_of(data, name),
        parameters,
        own,
        potentials,
        inputs,
        tuple(reader.places),
        damping,
        signed=negative_mass,
        **stated_motion(data, reader),
    )
    _affordable(problem)
    _declared(problem, data)
    _massive(problem, negative_mass)
    return problem


def _fluid(data: Mapping[str, Any], reader: FileReader) -> Problem:
    """A fluid, which says all of its problem."""
    for key in data:
        if key not in ("name", "title", "fluid") and (key != "parameters" or data[key]):
            raise ProblemError(f"key {key!r}: [fluid] says all of the problem; leave this out")
    name = reader.name_of(data)
    if not isinstance(data["fluid"], dict):
        raise ProblemError("key 'fluid' must be a table [fluid]")
    fluid = reader.whole(Fluid, data["fluid"], "fluid")
    return Problem(name, None, title=reader.title_of(data, name), fluid=fluid)


def _without_points(
    data: Mapping[str, Any], moved: Group | None, advected: tuple[Advected, ...] | None = None
) -> Problem:
    """A problem that says all of its Lagrangian; its group acts by matrices on (r, 1), or, with
    something ``advected`` or nothing, is known by its algebra alone."""
    where = next((key for key in SECTIONS if key in data), None)
    if where is None:
        raise ProblemError("an algebra moves no points: give a [lagrangian] or an [inertia]")
    if moved is None:
        raise ProblemError(f"key {where!r}: a text about any group has no Lagrangian of its own")
    for key in ("point", "solid", "body", "potential", "damping"):
        if key in data:
            raise ProblemError(f"key {key!r}: [{where}] says all of L; leave this out")
    given = data.get("input", ())
    if any(isinstance(x, dict) and x.get("kind") == "force" for x in given):
        raise ProblemError(f"key 'input': beside [{where}] an input is a covector: no points")
    group = (on_homogeneous(moved) if moved.affine else moved).stated
    reader = FileReader()
    reader.moves(group)
    reader.advected = advected
    name = reader.name_of(data, of_its_own=moved is not None)
    parameters = _parameters(data.get("parameters", {}), reader)
    reader.carries(None, parameters)
    _, inputs, _ = forces(data, reader)
    reader.distinct(inputs, parameters)
    problem = Problem(
        name,
        group,
        title=reader.title_of(data, name),
        parameters=parameters,
        inputs=inputs,
        lagrangian=lagrangian(data, group, reader),
        advected=advected,
        **stated_motion(data, reader),
    )
    _affordable(problem)
    _declared(problem, data)
    if inputs and problem.lagrangian and problem.lagrangian.held:
        raise ProblemError(
            "input 1: L has symmetries without kinetic energy, and what pushes along them has no "
            "motion to answer; add their kinetic energy, or leave the input out"
        )
    return problem


def _positive(where: str | None, what: str) -> None:
    """``ProblemError`` that ``where`` is negative, if anywhere: no flag allows it."""
    if where:
        raise ProblemError(
            f"{where} is negative; correct it, or allow it with --allow-negative-{what} "
            f"(in Python: negative_{what}=True)"
        )


def _massive(problem: Problem, negative_mass: bool) -> None:
    """``ProblemError`` for a direction without inertia, and for masses that cannot be."""
    moved, own = problem.group, problem.body
    values = inertia.defaults(problem.parameters)
    if fault := inertia.fault_of_quadrics(own, values, "the defaults"):
        raise ProblemError(f"body: {fault}")
    if moved and own and (still := inertia.still_direction(moved, own)):
        raise ProblemError(
            f"{still} has no kinetic energy together with any motion: the metric of these masses, "
            "some of them negative, is degenerate at g = 1; change them"
            if negative_mass
            else f"{still} moves no mass of this body: its motion is open; add masses"
        )
    if moved and own and moved.free_translations and inertia.massless(own):
        raise ProblemError("body: its mass is 0, and it has no centre of mass; change the masses")
    if not moved or negative_mass or not isinstance(own, GivenBody):
        return
    fault = inertia.impossible(moved, own, problem.parameters)
    if fault and own.solids:
        raise ProblemError(
            "body: no masses have the moments of these solids: what has a negative density must be "
            "a hole inside of others; or allow it with --allow-negative-mass"
        )
    if fault and not any(names(t) for t in own.trees()):  # of defaults it is a doubt
        raise ProblemError(f"body, given: {fault}")


def _parameters(data: Any, reader: FileReader) -> dict[str, Parameter]:
    if not isinstance(data, dict):
        raise ProblemError("key 'parameters' must be a table")
    if len(data) > PARAMETERS:
        raise ProblemError(f"key 'parameters': more than {PARAMETERS}")
    found = {}
    for name, value in data.items():
        short = isinstance(value, (int, float)) and not isinstance(value, bool)
        if not short and not isinstance(value, dict):
            raise ProblemError(f"parameter {name[:40]!r}: expected a number or a table")
        found[name] = reader.parameter(name, {"default": value} if short else value)
    return found


def _declared(problem: Problem, data: Mapping[str, Any]) -> None:
    """Every name that is used is a parameter and nothing else, and every parameter is used."""
    if fault := named_twice(problem):
        raise ProblemError(fault)
    found = [*_trees(problem.points), *_moments(problem), *_forces(problem)]
    used = dict.fromkeys(x for t in found for x in names(t))
    for name in used:
        if name not in problem.parameters:
            if name == "t" or LIKE_A_PLACE.fullmatch(name):
                where = used_at(data, name, *(x for x, _ in keys_with(name)))
                raise ProblemError(f"{where}: {name!r} is known in {known_in(name)} alone")
            where, shown = used_at(data, name), name[:40]
            hint = nearest(shown, problem.parameters).removeprefix("; ")
            other = f"{hint} Else " if hint else ""
            raise ProblemError(f"{where}: {shown!r} is not declared; {other}add it to [parameters]")
    own = problem.body.parameters() if isinstance(problem.body, MomentBody) else {}
    elsewhere = {*own, *named(problem)}
    for name in data.get("parameters", {}):
        if name not in used and name not in elsewhere:
            raise ProblemError(f"parameter {name!r} is declared but not used; leave it out")


def keys_with(name: str) -> list[tuple[str, str]]:
    """Keys with the kind of their potential, whose expressions know t, or a place r1_x."""
    types = ("energy", "of_volume", "timed") if name == "t" else ("energy",)
    return [(x, k) for k, own in kinds().items() for x, y in own.keys().items() if y.type in types]


def known_in(name: str) -> str:
    """The keys whose expressions know a name, with the kinds of potentials, in words."""
    *others, last = (f"the {x!r} of a{'n' * (k[0] in 'aeiou')} {k}" for x, k in keys_with(name))
    return f"{', '.join(others)} and {last}" if others else last


def _trees(listed: Iterable[Table]) -> list[Tree]:
    return [t for x in listed for t in x.trees()]


def _moments(problem: Problem) -> list[Tree]:
    """Of a body whose moments are said, or found by integration."""
    return problem.body.given.trees() if isinstance(problem.body, GivenBody) else []


def _forces(problem: Problem) -> list[Tree]:
    own = [problem.lagrangian] if problem.lagrangian else []
    return _trees((*own, *problem.potentials, *problem.damping, *problem.places))


def _affordable(problem: Problem) -> None:
    """``ProblemError`` for too many expressions, or numbers too unlike one another."""
    solids = isinstance(problem.body, GivenBody) and problem.body.solids
    found = [*_forces(problem), *_trees(problem.points), *([] if solids else _moments(problem))]
    leaves = sum(weight(t).leaves for t in found)
    if leaves > LEAVES:
        raise ProblemError(f"{leaves} names and numbers in expressions; at most {LEAVES}")
    pulls = sum(problem.masses for p in problem.potentials if p.summed)
    if pulls > PULLS:
        raise ProblemError(f"{pulls} attractions of points; at most {PULLS}")
    common = 1
    for q in (x for t in found for x in numbers(t)):
        common = math.lcm(common, q.denominator)
        if common.bit_length() > COMMON_BITS:
            raise ProblemError("the fractions have no small common denominator; round them")
