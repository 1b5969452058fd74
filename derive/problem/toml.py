"""Problem files: TOML read into :class:`Problem`, every key checked, errors in one line."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..algebra.families import on_homogeneous
from ..algebra.groups import Group
from ..language.derivatives import derivative, weight
from ..language.expression import names, numbers
from ..language.limits import BITS, COMMON_BITS, KEY_PARTS, LEAVES, PARAMETERS, PROBLEM_BYTES, PULLS
from ..language.tree import Tree, nodes
from ..schema.body_kinds import Body, GivenBody, MomentBody
from ..schema.kind import SECTIONS, Advected, Fluid, Parameter
from ..schema.motion_kinds import OF_MASSES, OUTPUTS, ExpressionOutput, fault_of_gravity
from ..schema.table import ATTACHED, Table
from . import fields, inertia
from .bodies import as_forces, body, forces, group_of, negative_stiffness_of, outputs, require_known
from .entries_on_orbit import hessian, vanishes
from .file_reader import FileReader
from .flows import flows_of, require_bodies_own
from .inertia import doubt_of_metric, impossible, negative_mass
from .lagrangian_tables import group_of_algebra, lagrangian, on_torus, torus_problem
from .motion_tables import KEYS, faults, kinematics_problem, motion_fields, named, named_twice
from .problem import Problem, ProblemError

TOP = {"name", "title", "group", "action", "parameters", "point", "body", "potential", "input"}
TOP |= {"damping", "flow", "force", "output", "solid", "algebra", "advected", "fluid", "kinematics"}
TOP |= {*SECTIONS, *KEYS}
DOTTED = re.compile(
    rb"\.(?:[ \t]*(?:[\w-]++|\"[^\"\n]*+\"|'[^'\n]*+')[ \t]*\.){%d}" % KEY_PARTS, re.ASCII
)
"""A dotted key of too many parts. Tried at dots alone, and possessive: no text is slow."""


KNOWN = (
    "the 'U' of an expression",
    "potentials, masses, flows, forces of the state and what is read off a motion",
)
"""Where a place r1_x, and where t, is known."""


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
        raise ProblemError(f"{path}: not TOML: {fields.unread(raw, error)}{kind}") from None
    except ValueError:  # Python reads no integer of thousands of digits
        raise ProblemError(f"{path}: {HUGE}") from None
    if _huge(data):
        raise ProblemError(f"{path}: {HUGE}")
    try:
        return problem_of(data, path.parent, **allowed)
    except ProblemError as error:
        raise ProblemError(f"{path}: {error}") from None


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
    if found := _without_group(data, reader, negative_stiffness):
        return found
    moved, action = group_of(data, reader)
    reader.moves(moved)
    name = reader.name_of(data, of_its_own=moved is not None)
    parameters = _parameters(data.get("parameters", {}), reader)
    if "kinematics" in data or any(key in data for key in SECTIONS):
        return _without_points(data, moved, negative_stiffness=negative_stiffness)
    reader.parameters = parameters
    its_body = body(data, reader)
    if moved and its_body is None:
        raise ProblemError(
            "no body: give [[point]] or [[solid]] tables, or a table [body]; or a [lagrangian]"
        )
    parameters = _with_moments(its_body, parameters)
    if not negative_mass:
        _positive(inertia.negative_mass(its_body, parameters), "mass")
    reader.carries(its_body, parameters)
    potentials, inputs, damping, stated = forces(data, reader)
    if not negative_stiffness:
        _positive(negative_stiffness_of(potentials, damping, parameters), "stiffness")
    linear, damped = as_forces(damping, reader)
    flows, pushed = flows_of(data, its_body, reader, inputs)
    require_known(inputs, (*stated, *flows))
    reader.knows_acting(inputs, (*stated, *damped, *pushed), linear)
    observed = outputs(data, reader, inputs, (*stated, *damped, *pushed), potentials)
    problem = Problem(
        name,
        moved,
        action,
        reader.title_of(data, name),
        parameters,
        its_body,
        potentials,
        inputs,
        tuple(reader.places),
        linear,
        (*stated, *damped, *pushed),
        observed,
        flows=flows,
        signed=negative_mass,
        **motion_fields(data, reader),
    )
    _declared(problem, data)
    require_bodies_own(problem)
    inertia.require_masses(problem, any_sign=negative_mass)
    return problem


def _without_group(
    data: Mapping[str, Any], reader: FileReader, negative_stiffness: bool
) -> Problem | None:
    """A fluid, or what moves on an algebra; ``None`` for the problem of a group."""
    if "fluid" in data:
        return _fluid(data, reader)
    if on_torus(data):
        found = torus_problem(data, reader, _parameters(data.get("parameters", {}), reader))
        if not negative_stiffness:
            _positive(negative_stiffness_of((), found.damping, found.parameters), "stiffness")
        _declared(found, data)
        return found
    if "algebra" in data:
        return _without_points(data, *group_of_algebra(data))
    if "advected" in data:
        raise ProblemError("key 'advected' goes with [algebra]: a group has its entries A_11, …")
    return None


def _with_moments(its_body: Body | None, parameters: dict[str, Parameter]) -> dict[str, Parameter]:
    """The parameters, those before them that symbolic moments are."""
    if not isinstance(its_body, MomentBody):
        return parameters
    named = {x: parameters.get(x, p) for x, p in its_body.parameters().items()}
    return {**named, **{k: p for k, p in parameters.items() if k not in named}}


def _fluid(data: Mapping[str, Any], reader: FileReader) -> Problem:
    """A fluid, which says all of its problem."""
    for key in data:
        if key not in ("name", "title", "fluid") and (key != "parameters" or data[key]):
            acts = key in ("input", "force", "damping", "potential")
            raise ProblemError(
                f"key {key!r}: [fluid] says all of the problem; leave this out"
                + '; a force is forces = "potential" there, or "given"' * acts
                + '; forcing and damping are on the torus, [algebra] of = "torus"'
                * (key in ("input", "damping"))
            )
    name = reader.name_of(data)
    if not isinstance(data["fluid"], dict):
        raise ProblemError("key 'fluid' must be a table [fluid]")
    fluid = reader.typed(Fluid, data["fluid"], "fluid")
    return Problem(name, None, title=reader.title_of(data, name), fluid=fluid)


def _require_readable(data: Mapping[str, Any], where: str, on_algebra: bool) -> None:
    """``ProblemError`` for an output of what a problem without points has not."""
    others = [x for x in OUTPUTS if x not in (*OF_MASSES, ExpressionOutput.kind)]
    for k, x in enumerate(fields.tables(data, "output"), 1):
        placed = "y" not in x or {*ATTACHED} & {*x}
        if placed and (on_algebra or x.get("kind") in OF_MASSES):
            raise ProblemError(
                f"output {k}: beside [{where}] are no points: give expressions 'y' of the state"
                + ("" if on_algebra else f", or one of {', '.join(others)}")
            )
        if wrong := fault_of_gravity(x, pointless=True):
            raise ProblemError(f"output {k}: {wrong}")


def _know_velocity(data: Mapping[str, Any], said: Any, reader: FileReader) -> None:
    """Let the reader know the side of Z, and, on the left, velocities of translation by what points
    call them, w, too, unless an input is called so."""
    reader.on_the_right = isinstance(said, dict) and said.get("trivialisation") == "right"
    inputs = (str(x.get("name")).partition("_")[0] for x in fields.tables(data, "input"))
    if reader.advected is None and not reader.on_the_right and "w" not in inputs:
        reader.by_block |= {w: zeta for zeta, w in fields.by_points(reader.moving()).items()}


def _without_points(
    data: Mapping[str, Any],
    moved: Group | None,
    advected: tuple[Advected, ...] | None = None,
    negative_stiffness: bool = False,
) -> Problem:
    """A problem that says all of its Lagrangian; its group acts by matrices on (r, 1), or, with
    something ``advected`` or nothing, is known by its algebra alone."""
    if "kinematics" in data and advected is None:
        known = _parameters(data.get("parameters", {}), FileReader())
        return kinematics_problem(data, moved, known)
    where = next((key for key in SECTIONS if key in data), None)
    if where is None:
        raise ProblemError("an algebra moves no points: give a [lagrangian] or an [inertia]")
    if moved is None:
        raise ProblemError(f"key {where!r}: a text about any group has no Lagrangian of its own")
    for key in ("point", "solid", "body", "potential", "flow", "kinematics"):
        if key in data:
            other = "; say it as a [[force]], or in the L of a [lagrangian]" * (key == "potential")
            raise ProblemError(f"key {key!r}: [{where}] says all of L; leave this out{other}")
    if advected is not None:
        _require_covectors(data)
    group = (on_homogeneous(moved) if moved.affine else moved).in_user_basis
    (reader := FileReader()).moves(group)
    reader.advected, reader.pointless = advected, True
    said = data[where]
    _know_velocity(data, said, reader)
    name = reader.name_of(data, of_its_own=moved is not None)
    parameters = _parameters(data.get("parameters", {}), reader)
    reader.carries(None, parameters)
    _, inputs, damping, of_state = forces(data, reader)
    require_known(inputs, of_state)
    if not negative_stiffness:
        _positive(negative_stiffness_of((), damping, parameters), "stiffness")
    stated = (*of_state, *as_forces(damping, reader)[1])
    _require_readable(data, where, advected is not None)
    reader.knows_acting(inputs, stated)
    observed = outputs(data, reader, inputs, stated)
    problem = Problem(
        name,
        group,
        title=reader.title_of(data, name),
        parameters=parameters,
        inputs=inputs,
        places=tuple(reader.places),
        forces=stated,
        outputs=observed,
        lagrangian=lagrangian(data, group, reader),
        advected=advected,
        **motion_fields(data, reader),
    )
    _declared(problem, data)
    return problem


def _require_covectors(data: Mapping[str, Any]) -> None:
    """``ProblemError`` where something acts at a place, which an algebra does not move."""
    for key, x in fields.named_tables(data, "force", "input", "damping").items():
        if "covector" not in x and x.get("kind") not in ("covector", "scalar"):
            other = "[[force]] covector" if key.startswith("damping") else "a covector"
            raise ProblemError(f"{key}: an algebra moves no places: give {other}")


def _positive(where: str | None, what: str) -> None:
    """``ProblemError`` that ``where`` is negative, if anywhere: no flag allows it."""
    if where:
        raise ProblemError(
            f"{where} is negative; correct it, or allow it with --allow-negative-{what} "
            f"(in Python: negative_{what}=True)"
        )


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
    """Every name that is used is a parameter and nothing else, and every parameter is used, in
    expressions that are not too many."""
    _affordable(problem)
    if fault := named_twice(problem):
        raise ProblemError(fault)
    rest = replace(problem, forces=(), outputs=())
    found = [*_trees(problem.points), *_moments(problem), *_forces(rest)]
    used = dict.fromkeys(x for t in found for x in names(t))
    given = {x for y in problem.inputs for x in problem.numbers_of(y)} if problem.group else ()
    stated = (
        x for t in _trees((*problem.forces, *problem.flows, *problem.outputs)) for x in names(t)
    )
    used |= dict.fromkeys(x for x in stated if x not in given)
    for name in used:
        if name not in problem.parameters:
            if name == "t" or fields.LIKE_A_PLACE.fullmatch(name):
                known, timed = KNOWN[name == "t"], () if name != "t" else ("potential",)
                where = fields.used_at({k: x for k, x in data.items() if k not in timed}, name, "U")
                raise ProblemError(f"{where}: {name!r} is known in {known} alone")
            if numbers := _numbers_of(problem, name):
                where = fields.used_at({k: x for k, x in data.items() if k != "input"}, name)
                raise ProblemError(
                    f"{where}: {name!r} is an input of {', '.join(numbers)}; one number "
                    'that forces alone know is an [[input]] of kind = "scalar"'
                )
            where, shown = fields.used_at(data, name), name[:40]
            if problem.group and problem.lagrangian:
                own = fields.known_in_lagrangian(problem.group, problem.advected)
                raise ProblemError(
                    fields.undeclared(name, where, problem.parameters, problem.group, own)
                )
            acts = where.startswith(("force", "output")) and problem.group
            of_state = fields.names_in_forces(acts) if acts else []
            if shown in of_state:  # which forces and moments know
                where = fields.used_at(data, name, "force", "moment")
            if fault := fields.out_of_place(problem, shown, where, of_state):
                raise ProblemError(f"{where}: {shown!r} {fault}")
            listed = [*problem.parameters, *of_state]
            hint = fields.called_here(shown, of_state, problem.group, listed, ".").removeprefix(
                "; "
            )
            other = f"{hint} Else " if hint else ""
            raise ProblemError(f"{where}: {shown!r} is not declared; {other}add it to [parameters]")
    moments = problem.body.parameters() if isinstance(problem.body, MomentBody) else {}
    elsewhere = {*moments, *named(problem)}
    for name in data.get("parameters", {}):
        if name not in used and name not in elsewhere:
            raise ProblemError(f"parameter {name!r} is declared but not used; leave it out")


def _numbers_of(problem: Problem, name: str) -> list[str]:
    """The numbers of the input of a name that none of them has."""
    numbers = (problem.numbers_of(x) for x in problem.inputs if x.name == name)
    return [x for listed in numbers if name not in listed for x in listed]


def _trees(listed: Iterable[Table]) -> list[Tree]:
    return [t for x in listed for t in x.trees()]


def _moments(problem: Problem) -> list[Tree]:
    """Of a body whose moments are said, or found by integration."""
    return problem.body.given.trees() if isinstance(problem.body, GivenBody) else []


def _forces(problem: Problem) -> list[Tree]:
    lagrangian = [problem.lagrangian] if problem.lagrangian else []
    outside = (*problem.inputs, *problem.damping, *problem.forces)
    return _trees((*lagrangian, *problem.potentials, *outside, *problem.outputs, *problem.places))


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


# What may be meant otherwise in a problem that is good: said, not refused.


def doubts(p: Problem, given: Mapping[str, float], *, followed: bool = False) -> Iterator[str]:
    """Each in words, as the values of the parameters have it that are ``given``, or by default;
    ``followed``: without the names of [initial] and [[event]], which a motion refuses."""
    values = {k: replace(x, default=given.get(k, x.default)) for k, x in p.parameters.items()}
    negative = (
        negative_mass(p.body, values),
        negative_stiffness_of(p.potentials, p.damping, values),
    )
    yield from (f"{where} is negative" for where in negative if where)
    if p.group and not p.signed and (why := impossible(p.group, p.body, values)):
        yield f"body: {why}"
    if p.group and p.lagrangian:
        L = p.lagrangian.L
        second = hessian(L, fields.coordinates(p.group))
        doubt = "" if p.signed else doubt_of_metric(second, values)
        yield from (doubt,) * bool(doubt)
        slopes = (derivative(x, "t") for row in second for x in row if "t" in nodes(L))
        if not all(map(vanishes, slopes)):
            yield (
                "the metric ∂²L/∂Z² depends on the time: if by a mass m(t), the equations are "
                "d(mv)/dt = F, of what comes from rest or is left at rest in space; a rocket has "
                "m dv/dt = F + dm/dt c, with c the velocity relative to it of what leaves it"
            )
    yield from () if followed else faults(p)
