"""A program with its record, and the columns of what a motion of it gives: nothing is run here."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from ..code.naming import own_prefix
from ..code.program import Program
from ..language.tree import Tree, nodes, terms
from ..problem.fields import state_names
from ..problem.force_reader import BASE, LENGTH, NUMBER, TIME, Dimension, dimension, measured
from ..problem.problem import Problem
from ..record.record import Derivation

VECTORS = {
    "momentum": "linear momentum",
    "angular_momentum": "angular momentum",
    "body_momentum": "linear momentum in the body",
    "body_angular_momentum": "angular momentum in the body",
    "circulation": "circulation in the body",
}
"""What is kept and has components, by its name, in words."""
KEPT = VECTORS | {
    "orbital_angular_momentum": "orbital angular momentum",
    "screw_momentum": "screw momentum",
    "body_screw_momentum": "screw momentum in the body",
    "deformation_momentum": "momentum of the deformation",
    "body_deformation_momentum": "momentum of the deformation in the body",
    "combined_momentum": "combined momentum",
    "centre": "centre of mass, by boosts",
    "time_dependent_integral": "integral that depends on the time",
    "integral": "first integral",
    "casimir": "Casimir function",
    "trace": "moment of the vorticity",
}


def parts(name: str) -> tuple[str, int]:
    """``angular_momentum_3`` → angular_momentum and 3; 0 where there is no number."""
    base, number = re.fullmatch(r"(.*?)(?:_(\d+))?", name, re.DOTALL).groups()  # type: ignore[union-attr]
    return base, int(number or 0)


def in_order(names: Sequence[str]) -> list[int]:
    """The places of names, those with one base together, where the first of them is, by number."""
    bases = [parts(x)[0] for x in names]
    return sorted(range(len(names)), key=lambda k: (bases.index(bases[k]), parts(names[k])[1]))


def in_words(name: str, word: Callable[[str], str]) -> str:
    """``angular_momentum_3`` → angular momentum 3, in the language of ``word``."""
    base, number = re.fullmatch(r"(.*?)((?:_\d+)?)", name, re.DOTALL).groups()  # type: ignore[union-attr]
    return word(KEPT.get(base, base.replace("_", " "))) + number.replace("_", " ")


# A program with its record, and the columns of what a motion of it gives: nothing is run here.

KINDS = ("time", "state", "energy", "conserved", "defect", "multiplier", "output", "input")
"""What a column can be, in the order of a table."""

UNITS = {"time": "s", "energy": "J", "multiplier": "J", "centre": "kg m"}
UNITS |= dict.fromkeys(("momentum", "body_momentum"), "kg m/s")
UNITS |= dict.fromkeys(("angular_momentum", "body_angular_momentum"), "kg m^2/s")
"""Those of columns of a kind, and of the components of what is kept."""
ALONG = ("momentum", "body_momentum", "centre")
"""What is kept along coordinates of translations, with the unit of where these are lengths."""

UNITS_OF_OUTPUTS = {"rate": "rad/s", "momentum": "kg m/s", "tension": "N", "power": "W"}
UNITS_OF_OUTPUTS |= dict.fromkeys(("place", "distance"), "m") | {"velocity": "m/s"}
UNITS_OF_OUTPUTS |= dict.fromkeys(("acceleration", "specific_force"), "m/s^2")
"""Those of what is read off a motion, by kinds; of a direction and of expressions none is known."""

SI = re.compile("kg|m|s|A|K|mol|cd|rad|sr|Hz|N|Pa|J|W|C|V|F|Ω|ohm|S|Wb|T|H|lm|lx|Bq|Gy|Sv|kat")
"""The units of SI, which go together without factors."""

IN_SECONDS = re.compile(
    "[fpnuµμmcdhkMGTP]?(g|m|rad|A|K|mol|N|Pa|J|W|C|V|F|T)|deg|°|t|in|ft|yd|mi|lbm?|lbf|slug|oz|kgf|L|%"
)
"""Other units, of which none has a time that is not in seconds."""

FACTOR = re.compile(r"[^\W\d_⁰¹²³⁴-⁹]+|[°%]|\d[.\d]*\d")
"""A unit in a product of powers, or a number that is none of their exponents."""


@dataclass(frozen=True)
class Column:
    """A column of a run: its name, what it is (of KINDS), its unit, empty where there is none."""

    name: str
    kind: str
    unit: str = ""


def base_units(problem: Problem) -> frozenset[str]:
    """The base units in which the numbers of a problem are by those of its parameters: all of SI's
    mechanics, the second alone where others stand beside SI, none where a time may be in
    others."""
    stated = [x.unit for x in problem.parameters.values() if x.unit]
    factors = [x for unit in stated for x in FACTOR.findall(unit)]
    if not stated or not all(SI.fullmatch(x) or IN_SECONDS.fullmatch(x) for x in factors):
        return frozenset()
    return frozenset(["kg", "m", "s"] if all(map(SI.fullmatch, factors)) else ["s"])


ANGLES = ("sin", "cos", "tan")
"""Functions of angles."""


def coordinate_units(problem: Problem) -> dict[str, str]:
    """The names of the coordinates on R(n), and of their velocities, of an ℓ that no points give or
    of a motion of first order, with their units: m and m/s, rad and rad/s, where there are terms of
    ℓ that are an energy with the one, or arguments of sin, cos, tan that are an angle, and none
    with the other; empty where it is not known."""
    stated, group = problem.lagrangian or problem.kinematics, problem.group
    if stated is None or group is None or problem.advected is not None:
        return {}
    parameters = problem.parameters.items()
    units = {x: d for x, p in parameters if (d := measured(p.unit)) is not None}
    entries = state_names(group)
    places = {t: name for name, t in entries.items() if name[0] == "T"}
    found = {}
    for a, E in enumerate(group.in_user_basis.basis, 1):
        (i, j), *others = [(i, j) for i, row in enumerate(E, 1) for j, x in enumerate(row, 1) if x]
        place = ("entry", "A", i, j)
        if next(x for first, x in reversed(group.places) if first < i).vectors and not others:
            unit = _unit_of_coordinate(stated.trees(), units, place, entries[f"zeta_{a}"])
            found[places[place]] = unit
            found[f"zeta_{a}"] = unit and f"{unit}/s"
    return found


def _unit_of_coordinate(
    trees: Sequence[Tree], units: Mapping[str, Dimension], place: Tree, velocity: Tree
) -> str:
    """m or rad, of a coordinate with its velocity in expressions; else empty."""
    each = {
        unit: {**units, place: d, velocity: tuple(x - y for x, y in zip(d, TIME, strict=True))}
        for unit, d in (("m", LENGTH), ("rad", NUMBER))
    }
    listed = [(x, measured("J")) for t in trees for x in terms(t)]
    inside = [x for t in trees for x in nodes(t) if isinstance(x, tuple) and x[0] == "fun"]
    listed += [(x[2], NUMBER) for x in inside if x[1] in ANGLES]
    told = set()
    for x, wanted in listed:
        fitting = [unit for unit, known in each.items() if dimension(x, known) == wanted]
        told |= {*fitting} if len(fitting) == 1 else set()
    return told.pop() if len(told) == 1 else ""


@dataclass(frozen=True)
class EmittedCode:
    """A program, its record and its problem."""

    program: Program
    record: Derivation
    problem: Problem

    @property
    def name(self) -> str:
        """That of the problem, for messages."""
        return self.program.name

    @property
    def prefix(self) -> str:
        """That of the emitted functions."""
        return own_prefix(self.name)

    @property
    def conserved_columns(self) -> list[int]:
        """The places of what is conserved beside the energy, which has a column of its own."""
        names = self.program.conserved
        return [k for k in in_order(names) if names[k] != "energy"]

    def columns(self) -> tuple[Column, ...]:
        """The columns of a run: time, state, then what :meth:`table` adds."""
        has = self.program.functions
        names = [("t", "time"), *((x, "state") for x in self.program.state), ("energy", "energy")]
        names += [(self.program.conserved[k], "conserved") for k in self.conserved_columns]
        names += [("defect", "defect")] * ("defect" in has)
        names += [("multiplier", "multiplier")] * ("multiplier" in has)
        names += [(x, "output") for x in self.program.outputs]
        return tuple(Column(x, kind, self._unit(x, kind)) for x, kind in names)

    def _unit(self, name: str, kind: str) -> str:
        if kind == "state":
            if name in self.program.masses:
                return self.problem.parameters[name].unit
            unit = self._unit_of_state(name)
        elif kind == "output":
            kind, said = self._kinds_of_outputs[name]
            if said:
                return said
            unit = UNITS_OF_OUTPUTS.get(kind, "")
        else:
            base, k = parts(name) if kind == "conserved" else (kind, 0)
            unit = UNITS.get(base, "")
            if base in ALONG:
                told = self._coordinate_units
                own = told.get(f"T_{k}", "" if {*told.values()} & {"", "rad"} else "m")
                unit = {"m": unit, "rad": unit.replace("m", "m^2")}.get(own, "")
        made_of = zip(BASE, measured(unit) or NUMBER, strict=True)
        return unit if {x for x, power in made_of if power} <= self._base else ""

    @cached_property
    def _base(self) -> frozenset[str]:
        return base_units(self.problem)

    @cached_property
    def _kinds_of_outputs(self) -> dict[str, tuple[str, str]]:
        """Name → kind and stated unit, of the numbers that are read off the motion."""
        listed = (self.record.problem or {}).get("outputs", ())
        stated = {x["name"]: (x["kind"], x["unit"]) for x in listed}
        return {x: stated.get(x) or stated[parts(x)[0]] for x in self.program.outputs}

    @cached_property
    def _coordinate_units(self) -> dict[str, str]:
        return coordinate_units(self.problem)

    def _unit_of_state(self, name: str) -> str:
        """That of a place, of a velocity, and of ζ on an element of the basis: of one that does no
        more than shift, whose columns are those of the rows that are 0 where the state has a T,
        that of a velocity; of one that turns, whose matrix is skew, that of an angular velocity.
        Where there are no matrices, none is known."""
        if name in (found := self._coordinate_units):
            return found[name]
        if not name.startswith("zeta"):
            return {"T": "m", "w": "m/s"}.get(name[0], "")
        if self.program.state[0][0] not in "AT":
            return ""
        basis = self.program.basis
        moved = range(len(basis[0]))
        affine = any(x[0] == "T" for x in self.program.state)
        shifted = {i for i in moved if affine and not any(any(E[i]) for E in basis)}
        own = basis[int(name.rpartition("_")[2]) - 1]
        linear = [j for j in moved if j not in shifted]
        if not any(row[j] for row in own for j in linear):
            return "m/s"
        skew = all(own[i][j] == -own[j][i] for i in linear for j in linear)
        return "rad/s" if skew else "1/s"
