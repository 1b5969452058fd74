"""What a reader of the emitted files must know: heads of files, frames, titles of numbers."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..algebra.factor_charts import QUATERNION, FactorChart, factor_charts
from ..algebra.groups import Group
from ..algebra.relations import Relations, relations
from ..language import rational as q
from ..language.rational import Matrix
from ..language.show import show
from ..record.as_json import decode
from .languages import TargetLanguage, comment
from .naming import law, plain_text
from .options import Options
from .program import Program
from .reader import RecordReader
from .slots import order, still_slots
from .state import StateSpace

_LINES = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").split("\n")
TOLD = dict(x.split(": ", 1) for x in _LINES if x and x[0] != "#")


def said(label: str, /, **places: object) -> str:
    """A sentence of the text beside this file, its places filled."""
    return TOLD[label].format(**places)


def conventions(
    group: Group, problem: Mapping[str, Any], options: Options, frame: Mapping[str, Any] | None
) -> tuple[str, ...]:
    """What a reader of the emitted files must know, one sentence each, in plain ASCII."""
    inputs: Sequence[Mapping[str, Any]] = problem.get("inputs", [])
    if "advected" in problem:
        return _reduced(problem, inputs)
    places = _places(problem, several=len(group.places) > 1)
    written = "column by column" if options.layout == "col" else "row by row"
    charts = factor_charts(group.in_user_basis, options.attitude)
    lines = _factors(group, written, charts)
    lines += _still(group, charts) if options.state == "moving" else []
    if options.velocity == "tangent":
        lines += textwrap.wrap(said("tangent"), 88)
    elif (side := problem.get("lagrangian", {}).get("trivialisation")) is not None:
        moved = "g^-1 dg/dt" if side == "left" else "(dg/dt) g^-1"
        lines.append(said("coordinates", moved=moved))
        lines += _held(problem["lagrangian"].get("held", ()))
    elif group.turns_space and not group.user_basis:
        lines.append(said("angular_velocity"))
    else:
        linear = group.affine and not group.user_basis
        lines.append(said("coordinates", moved="A^-1 dA/dt" if linear else "g^-1 dg/dt"))
    if group.in_user_basis.free_translations and options.velocity == "body":
        lines.append(said("w"))
    driving = (line for x in inputs for line in _input(group, x, places))
    read = (line for x in problem.get("outputs", ()) for line in _output(x, places))
    framed = _frame(group, frame, bool(inputs)) if frame else ()
    return (
        *lines,
        *driving,
        *_acting(problem, places, group),
        *read,
        *_lengths(problem),
        *framed,
        *textwrap.wrap(_drift(group, options), 92),
    )


def _still(group: Group, charts: Mapping[int, FactorChart]) -> list[str]:
    """The sentence about entries that are no numbers of the state: those of 1 that never vary."""
    listed = order(group, False, charts)
    found = {x: y for x, y in still_slots(group).items() if x in listed}
    told = [f"{', '.join(x.name for x in found if found[x] == y)} = {y}" for y in {*found.values()}]
    text = f"Not in the state, as they never vary: {'; '.join(sorted(told))}."
    return textwrap.wrap(text, 92) if told else []


def _held(coordinates: Sequence[int]) -> list[str]:
    """The sentence about a motion on a quotient of the group."""
    if not coordinates:
        return []
    names = ", ".join(f"zeta_{a}" for a in coordinates)
    return textwrap.wrap(said("held", names=names), 92)


def _reduced(problem: Mapping[str, Any], inputs: Iterable[Mapping[str, Any]]) -> tuple[str, ...]:
    """The sentences about a state without an element of the group."""
    left = problem["lagrangian"]["trivialisation"] == "left"
    moved = "g^-1 dg/dt" if left else "(dg/dt) g^-1"
    carried = ", ".join(x["name"] for x in problem["advected"])
    text = said("reduced", moved=moved, rate="g Z" if left else "Z g")
    if carried:
        first = carried.split(", ")[0]
        text += " " + said("carried", names=carried, first=first, sign="-" * left)
    driven = (
        _of_scalar(x["name"])
        if x["kind"] == "scalar"
        else f"Input {x['name']}: a covector of the Lie algebra; its power is <{x['name']}, zeta>."
        for x in inputs
    )
    return (*textwrap.wrap(text, 92), *driven, *_acting(problem, {}, None))


def _lengths(problem: Mapping[str, Any]) -> list[str]:
    """The sentences about springs of natural length l ≠ 0, which have no direction at length 0."""
    if not any(p.get("length", 0) != 0 for p in problem.get("potentials", [])):
        return []
    return textwrap.wrap(said("lengths"), 92)


def _drift(group: Group, options: Options) -> str:
    """The sentences about ``project`` and ``defect``: what they are for, and how far they go."""
    charts = factor_charts(group.in_user_basis, options.attitude)
    several, laws, left = len(group.places) > 1, list[str](), 0
    for k, (_, factor) in enumerate(group.places, 1):
        kept, chart = relations(factor), charts.get(k - 1)
        if chart or factor.vectors:
            laws += [f"|q{chart.mark}| = 1"] if chart and chart.kind == QUATERNION else []
            left += factor.dimension
            continue
        if options.state == "moving" and all(sum(map(bool, row)) < 2 for row in kept.hull):
            kept = replace(kept, hull=())
        laws += _relations(kept, str(k) if several else "")
        left += kept.dimension
    free = charts or any(factor.vectors for _, factor in group.places)
    if not laws and (free or options.state == "moving"):
        return said("drift_none")
    if not laws:
        return said("drift_all")
    text = [said("drift", laws=", ".join(laws))]
    if left > group.dimension:
        text.append(said("drift_part", left=left))
    if options.velocity == "tangent":
        text.append(said("drift_tangent"))
    return " ".join(text)


def _relations(kept: Relations, mark: str) -> Iterator[str]:
    """The relations of one factor of the group in words; ``mark``: its number among several."""
    A, S, one = f"A{mark}", f"S{mark}", q.identity(len(kept.form))
    if kept.hull:
        yield f"{A} in the affine span of the group"
    if kept.form == one and kept.form:
        yield f"{A}^T {A} = mu 1" if kept.conformal else f"{A}^T {A} = 1"
    elif kept.form:
        law = f"{A}^T {S} {A} = {'mu ' if kept.conformal else ''}{S}"
        entries = map(" ".join, signed_entries(kept.form))
        yield f"{law} with {S} = {' '.join(entries).removeprefix('+ ')}"
    if kept.determinant:
        yield f"det {A} = 1{' over the complex numbers' if kept.complex_basis else ''}"


def _frame(group: Group, frame: Mapping[str, Any], driven: bool) -> list[str]:
    """The sentences about the principal frame: what it is, and the functions that go there."""
    place = "H (r - s), s the centre of mass" if group.affine else "H r"
    lines = ["All this in the principal frame of the body, where a point r of the file is at"]
    if frame["kind"] == "rotation":
        lines.append(f"r' = {place}, H the rotation that makes J, the matrix of moments, diagonal.")
    else:
        unit = "a multiple of 1, det H = 1" if frame["per_unit"] else "1"
        lines.append(f"r' = {place}, H such that J, the matrix of moments, is {unit}.")
    S = "S " if frame["turned"] else ""
    if frame["turned"]:
        lines.append(said("turned"))
    law = f"A' = {S}A H^-1" + (f", T' = {S}(T + A s)" if group.affine else "")
    lines.append(f"into_frame takes x there, {law}, and out_of_frame takes it back;")
    inputs = ["inputs_into_frame and inputs_out_of_frame do so with u;"] * driven
    return [*lines, *inputs, said("chosen")]


def _place(mark: str, g: Group, written: str, chart: FactorChart | None) -> str:
    """What tells where a factor takes the points of its block."""
    A, T, shift = f"A{mark}", f"T{mark}", f" + T{mark}" * g.affine
    if g.vectors:
        return f"{T} is a vector: a point r of the body stands at r{shift} in space."
    if chart is None:
        told = f"{A} is {g.n} x {g.n}, {written}"
        return f"{told}: a point r of the body stands at {A} r{shift} in space."
    if chart.kind == QUATERNION:
        q, zeta = f"q{mark}", "z" if mark else "zeta"
        also = ", z the vector of its block of Z" * bool(mark)
        return said("quaternion", q=q, shift=shift, zeta=zeta, also=also)
    X = " + ".join(
        f"{x} E_{a}" for y in chart.blocks for x, a in zip(y.names, y.members, strict=True)
    )
    turns = " and ".join(x for y in chart.blocks if y.turn for x in y.names)
    by = f"{A} the linear part of" if chart.shifted else f"{A} =" if not g.affine else "the map is"
    counted = f"; whole turns are counted in {turns}" * bool(turns)
    return said("angles", A=A, shift=shift, by=by, X=X, counted=counted)


def _factors(group: Group, written: str, charts: Mapping[int, FactorChart]) -> list[str]:
    """The sentences about the factors of a group, or the one about it."""
    several = len(group.places) > 1
    lines = ["The blocks of the product, one after the other:"] * several
    for k, (_, factor) in enumerate(group.places):
        text = _place(str(k + 1) if several else "", factor, written, charts.get(k))
        lines += textwrap.wrap(text, 92) if k in charts else [text]
    if charts:
        matrices = "the matrices of its blocks" if several else "the matrix A"
        text = f"to_matrix takes a state x to one with {matrices}, row by row"
        if all(x.kind == QUATERNION for x in charts.values()):
            first = " and ".join(x.names[0] for x in charts.values())
            text += f", and from_matrix takes it back, {first} >= 0"
        lines += textwrap.wrap(f"{text}.", 92)
    return lines


def _places(problem: Mapping[str, Any], *, several: bool) -> dict[int, str]:
    """Number of a point without mass → " at (x, y, z)" in the body, where that is plain ASCII."""
    masses = len(problem.get("body", {}).get("points", []))
    found = {}
    for k, place in enumerate(problem.get("places", []), masses + 1):
        at = ", ".join(plain_text(show(decode(x, "place"))) for x in place["at"])
        found[k] = f" at ({at})" if at.isascii() else ""
        found[k] += f" of block {place['block']}" if several else ""
    return found


def _of_scalar(name: str) -> str:
    return f"Input {name}: a number that forces of the state depend on."


def _input(group: Group, entry: Mapping[str, Any], places: Mapping[int, str]) -> list[str]:
    name, where = entry["name"], places.get(entry.get("on", 0), "")
    if entry["kind"] == "scalar":
        return [_of_scalar(name)]
    if entry["kind"] != "covector":
        what = "a torque on the body"
        if entry["kind"] == "force":
            what = f"a force on the body{where}" if where else f"a force on point {entry['on']}"
        elif len(group.factors) > 1:
            what = f"a torque on block {entry['block']}"
        vectors = {x: law(entry[x]) for x in ("direction", "moment") if x in entry}
        said = "".join(f", {name} times the {x}{told}" for x, told in vectors.items() if told)
        return textwrap.wrap(f"Input {name}: {what}{said}, in the {entry['frame']} frame.", 88)
    if group.turns_space and group.affine and not group.user_basis:
        return [
            f"Input {name}: a moment about the body's origin (its first 3 components) and a force",
            "on it (the last 3), both in the body frame; power <moment, zeta> + <force, w>.",
        ]
    if group.turns_space and not group.user_basis:
        return [f"Input {name}: a torque about the fixed point, in the body frame."]
    pair = "(zeta, w)" if group.in_user_basis.free_translations else "zeta"
    return [f"Input {name}: a covector of the Lie algebra; its power is <{name}, {pair}>."]


def _acting(
    problem: Mapping[str, Any], places: Mapping[int, str], group: Group | None
) -> Iterator[str]:
    """The sentences about forces of the state, mass that flows and damping."""

    def place(on: int) -> str:
        return f"the body{places[on]}" if places.get(on) else f"point {on}"

    def sized(name: str, data: Any) -> str:
        text = plain_text(show(decode(data, name)))
        return f", {name} = {text}" if text.isascii() else ""

    found = []
    for x in problem.get("forces", ()):
        what = "a covector of the Lie algebra"
        if "covector" not in x:
            kinds = " and ".join(
                f"a {key}{law(x[key], group)}" for key in ("force", "moment") if x.get(key)
            )
            what = f"{kinds} on {place(x['on'])}, in the {x['frame']} frame"
            what += "; v is the velocity of the place in space" * bool(re.search(r"\bv_\d", kinds))
            what += "; r is where it is" * bool(re.search(r"\br_\d", kinds))
        name = f" {x['name']}" if "name" in x else ""
        called = f"Force of the state{name}"
        if (table := x.get("table", "")).startswith("damping"):
            called = f"Damping{name}" if name else table.capitalize()
        found.append(f"{called}: {what}.")
    for x in problem.get("flows", ()):
        at = places.get(x["on"]) or f" at point {x['on']}"
        name = f" {x['name']}" if "name" in x else ""
        found += [f"Mass flows{name}{at}{sized('dm/dt', x['rate'])}."]
    for x in problem.get("damping", ()):
        on = ", ".join(map(place, x["on"]))
        found += [f"Damping: the force -kappa v on {on}{sized('kappa', x['coefficient'])}."]
    for text in found:
        yield from textwrap.wrap(text, 88)


OF_OUTPUTS = {
    "place": "where it is",
    "velocity": "the velocity",
    "acceleration": "the acceleration",
    "specific_force": "the acceleration less that of uniform gravity",
    "rate": "the angular velocity in the body",
    "direction": "a direction",
    "distance": "the distance to another point, or to a point of space",
    "momentum": "the momentum, the sum of m v",
    "tension": "the tension of a spring",
    "power": "the power",
    "expression": "a function of the state",
}
"""What is read, by kinds; of a place beside it, in a frame."""


def _output(entry: Mapping[str, Any], places: Mapping[int, str]) -> list[str]:
    """The sentence about an output."""
    kind, on = entry["kind"], int(entry.get("on", 0))
    at = f",{places[on]} of the body" if places.get(on) else f", at point {on}"
    frame = "body" if kind == "specific_force" else entry.get("frame", "")
    seen = f", in the {frame} frame" * bool(frame)
    name = f"{entry['name']}{at if on else ''}"
    whose = f" of {entry['of'] or 'all that acts'}" if kind == "power" else ""
    told = comment(entry["unit"])
    unit = f", in {told}" * bool(told and told.isascii())
    return textwrap.wrap(f"Output {name}: {OF_OUTPUTS[kind]}{whose}{seen}{unit}.", 88)


# The text of the comment at the head of a file, line by line.

BASIS = "State x and the basis E_a of the Lie algebra (e_ij: a single 1 in row i, column j):"


def heading(
    p: Program,
    language: TargetLanguage,
    parameters: Sequence[Mapping[str, str]],
    cost: Mapping[str, str],
) -> list[str]:
    """Conventions, state, basis, parameters, inputs and cost; empty lines between them.

    ``cost``: function → its operations in words; ``parameters``: name and text of each.
    """
    numbers = [
        f"  p[{i}] {x['name']}" + (f": {x['text']}" if x["text"] else "")
        for i, x in enumerate(parameters, language.first)
    ]
    if p.on_torus:
        told = ["Parameters p:", *numbers, ""] if numbers else []
        return [*p.conventions, "", *told, *_costs(language, cost)]
    none = "" if p.parameters else " none, every number is in the code."
    by_block = [*p.by_block]
    return [
        *p.conventions,
        "",
        BASIS,
        *listed("  x = (", p.state, ")", 88),
        *(listed("  y = (", p.momenta, ")", 88) if p.momenta else ()),
        *(listed("  zeta by the blocks = (", by_block, ")", 88) if by_block else ()),
        *(f"  {line}" for line in basis_lines(p)),
        "",
        f"Parameters p:{none}",
        *numbers,
        *(["", *listed("Input u = (", p.inputs, ").", 84)] if p.inputs else ()),
        "",
        *_costs(language, cost, ", besides the frame" if p.framing else ""),
    ]


def _costs(language: TargetLanguage, cost: Mapping[str, str], besides: str = "") -> list[str]:
    """What the functions cost."""
    return [
        f"Operations: constants {cost['constants']}{besides};",
        f"            rhs{language.mutates} {cost['rhs']}"
        + (f"; energy {cost['energy']}." if "energy" in cost else "."),
    ]


def listed(before: str, names: Sequence[str], after: str, width: int) -> list[str]:
    """The names with commas between ``before`` and ``after``, wrapped and aligned."""
    lines = textwrap.wrap(", ".join(names), width, break_long_words=False)
    return (before + f"\n{' ' * len(before)}".join(lines) + after).split("\n")


def basis_lines(p: Program) -> list[str]:
    """E_1, E_2, … in one line each: the entries that are not zero, counted from 1."""
    sums = (" ".join(map("".join, signed_entries(e))) for e in p.basis)
    return [f"E_{a} = {text}" for a, text in enumerate(sums, 1)]


def signed_entries(m: Matrix) -> list[tuple[str, str]]:
    """The sign and the size of each entry that is not zero, as a multiple of e_ij."""
    return [
        ("+" if x > 0 else "-", f"{'' if abs(x) == 1 else f'{abs(x)} '}e_{i}{j}")
        for i, row in enumerate(m, 1)
        for j, x in enumerate(row, 1)
        if x
    ]


# Titles of the numbers of dx/dt: which equation of the record has them on its left side.


def titles(reader: RecordReader) -> dict[int, str]:
    """Index in dx/dt at which an equation's left side begins → label and equation."""
    found = {}
    for start, names in _beginnings(reader.space).items():
        known = (reader.record.definition(name) for name in names)
        if at := next(filter(None, known), None):
            step, equation = at
            found[start] = f"{step.key(equation)}: {show(equation.lhs)} = {show(equation.rhs)}"
    return found


def _beginnings(space: StateSpace) -> dict[int, tuple[str, ...]]:
    """Index in dx/dt → the names by which the record may have what begins there."""
    if not space.has_element:
        carried = {space.group.dimension: ("Γ̇",)} if space.values["Γ"] else {}
        return {0: ("ζ̇", "Ż"), **carried}
    letters = [getattr(x, "letter", "") for x, own in space.numbers.items() for _ in own]
    first = {x: letters.index(x) for x in dict.fromkeys(letters) if x}
    if space.tangent:
        return {len(letters) + i: ({"A": "α̇", "T": "τ̇"}[x],) for x, i in first.items()}
    found: dict[int, tuple[str, ...]] = {i: ({"A": "Ȧ", "T": "Ṫ"}[x],) for x, i in first.items()}
    found[len(letters)] = ("ζ̇", "Ż")
    return found | ({len(space.names) - space.n: ("ẇ",)} if space.group.free_translations else {})
