"""The algorithms of the steps in time, for one file: what is known of it, and their text."""

from __future__ import annotations

from collections.abc import Mapping
from math import comb
from typing import Any

from ...routines import text_of
from ...routines.c import C
from ...routines.javascript import JavaScript
from ...routines.julia import Julia
from ...routines.printer import Printer
from ...routines.python import Python
from ...routines.rust import Rust
from ...routines.source import Source
from ..program import Program
from .discrete_step import BASIS, STEPPING, VOLUME, DiscreteStep
from .tableaux import GROWTH, METHODS, SAFETY, Tableau


def known(p: Program, steps: Mapping[str, Any]) -> dict[str, Any]:
    """What the algorithms know of a file, whatever its language: see ``source``."""
    gauss, explicit, discrete = steps["gauss"], steps["explicit"], steps["discrete"]
    methods = {x["name"]: i for i, x in enumerate(explicit["methods"], 1)} if explicit else {}
    numbered = methods | ({"discrete": discrete["number"]} if discrete else {})
    two = len(steps["turns"]) == 2
    parts = steps["parts"]
    return {
        "DEVICE": False,
        "EVENTS": bool(p.events),
        "INPUTS": bool(p.inputs),
        "INPUT_FUNCTIONS": bool(p.inputs),
        "PROJECTS": "project" in p.functions,
        "ADAPTIVE": bool(steps["adaptive"]),
        "GAUSS": bool(gauss),
        "COARSE": "solved by Newton's method, or " * bool(gauss and gauss["modes"])
        + "made in halves",
        "KEEPS": " ".join(steps["keeps"]),
        "KINKS": " ".join(steps["kinks"]),
        "MODES": bool(gauss and gauss["modes"]),
        "EXPLICIT": bool(explicit),
        "EXTRA": bool(explicit and explicit["extra"]),
        "HELD": steps["held"],
        "METHODS": bool(explicit or discrete),
        "METHODS_SAID": ", ".join(f"{n} {x}" for x, n in {**numbered, "another": 0}.items()),
        "RK4": methods.get("rk4", 0),
        "VERN9": methods.get("vern9", 0),
        "DISCRETE": discrete["number"] if discrete else 0,
        "MOST_ROWS": explicit["rows"] if explicit else 0,
        "N_PARTS": len(parts),
        "PARTS": [*(start for start, _ in parts), len(p.state)],
        "DIRECTION": [x.direction for x in p.events],
        "SPLIT": steps["turns"][1]["start"] if two else 0,
        "HALF": len(parts) // 2 if two else 0,
        "LEAST": steps["least"],
        "EXPLICIT_GROWTH": GROWTH,
        "EXPLICIT_SAFETY": SAFETY,
        **_of_events(steps["watch"]),
        **_of_gauss(gauss),
        **(_of_discrete(p.discrete, len(p.state)) if p.discrete else {}),
        **_of_derivatives(p, implicit=bool(gauss)),
    }


CALLED = {x: x for x in ("jacobian_raw", "jacobian_raw_inputs", "jacobian_project", "variations")}
CALLED |= {"events": "events", "rhs": "rhs", "project": "projected"}
"""Function of the file → what it is called in the algorithms."""


def _called(fields: Mapping[str, Any], prefix: str = "") -> dict[str, str]:
    """What an algorithm calls a function of the file → what it is called there."""
    functions = fields["functions"]
    return {of: prefix + functions[x]["name"] for x, of in CALLED.items() if x in functions}


def _of_events(watch: Mapping[str, Any] | None) -> dict[str, Any]:
    """The numbers of the search for events."""
    if watch is None:
        return {}
    return {
        "INTERVALS": watch["parts"],
        "WIDTH": 1 / watch["parts"],
        "HALVINGS": watch["halvings"],
        "NEWTON": watch["newton"],
        "EXACT": watch["exact"],
        "SLIVER": watch["sliver"],
    }


def _of_gauss(gauss: Mapping[str, Any] | None) -> dict[str, Any]:
    """The numbers and tables of Gauss's collocation."""
    if gauss is None:
        return {}
    numbers = ("error", "sweeps", "rounding", "growth", "safety", "kept", "newton_steps")
    tables, modes = ("nodes", "weights", "legendre", "continued"), gauss["modes"]
    return {
        **{name.upper(): gauss[name] for name in (*numbers, "stalled_newton", *tables)},
        "STILL": gauss["stalled"],
        "CONTINUES": float(gauss["continues"]),
        "MANY": float(gauss["many"]),
        "MU": gauss["mu_by_columns"],
        **(
            {"MODE_VALUES": modes.values, "MODE_INTO": modes.into, "MODE_BACK": modes.back}
            if modes
            else {}
        ),
    }


def _of_discrete(d: DiscreteStep, state: int) -> dict[str, Any]:
    """The numbers of the discrete step."""
    return {
        **{f"N_{name}": n for name, n in d.sizes.items()},
        "N_GROUP": d.group,
        "N_VELOCITY": state - d.group,
        "N_SUBSTEPS": len(d.weights),
        "SUBSTEPS": d.weights,
        "COMPOSED": d.order > 2,
        "ORDER": d.order,
        "TURNS": bool(d.turns),
        "BEGUN": bool(d.begun),
        "BASIS": d.kind == BASIS,
        "VOLUME": d.kind == VOLUME,
        "NORM": float(d.norm),
        "EXTRAPOLATED": EXTRAPOLATED,
    }


def _of_derivatives(p: Program, *, implicit: bool) -> dict[str, Any]:
    """The sizes of what the derivatives of steps work with."""
    state, varied, moves = len(p.state), *p.literal.values()
    columns, equations = varied + len(p.inputs), 8 * state
    return {
        "N_VARIATIONS": varied,
        "N_MOVES": moves,
        "N_COLUMNS": columns,
        "N_ENTRIES": state * columns,
        "N_EQUATIONS": equations,
        "SYSTEM_ROWS": equations if implicit else state,
        "SYSTEM_COLUMNS": max(equations * implicit, moves) + columns,
    }


EXTRAPOLATED = [[float((-1) ** i * comb(n, i + 1)) for i in range(5)] for n in range(6)]
"""The next value of a polynomial after n of them, by these, the last first."""


def _of_method(method: Tableau, number: int, *, device: bool) -> dict[str, Any]:
    """The numbers of an explicit method; on a device without the stages of dense output alone."""

    def terms(row: Any) -> list[float]:
        return [float(x) for x in row]

    stages = method.stages
    rows = stages if device else len(method.legendre)
    columns = len(method.legendre[0])
    return {
        "PAIR": bool(method.embedded),
        "DENSE_STAGES": rows > stages,
        "STAGES": stages,
        "ROWS": rows,
        "COLUMNS": columns,
        "MOST_COLUMNS": max(columns, 2),
        "LAST_COLUMN": columns - 1,
        "NUMBER": number,
        "INVERSE_ORDER": 1 / method.order,
        "IS_EXTRA": [i >= stages for i in range(rows)],
        "A": [*map(terms, method.a)],
        "B": terms(method.b),
        "C": terms(method.c),
        "E": terms(method.error) if method.embedded else [],
        "DENSE": [*map(terms, zip(*method.legendre, strict=True))],
    }


def source_of(given: dict[str, Any], steps: Mapping[str, Any]) -> Source:
    """The algorithms that some steps need; the tables of the explicit ones are given then."""
    source = Source()
    source.read(text_of("motion"), given)
    if given["GAUSS"]:
        if given["MODES"]:
            source.read(text_of("newton"), given)
        source.read(text_of("gauss"), given)
        _read_derivative(source, "gauss", given, steps)
    for number, x in enumerate(steps["explicit"]["methods"] if steps["explicit"] else (), 1):
        name = x["name"]
        method = _of_method(METHODS[name][0](), number, device=given["DEVICE"])
        source.read(text_of("runge_kutta").replace("METHOD", name), {**given, **method})
        given[f"{name}_DENSE"] = method["DENSE"]
        _read_derivative(source, name, {**given, **method}, steps)
    if given["DISCRETE"]:
        source.read(text_of("variational_step"), given)
    if given["EVENTS"]:
        source.read(text_of("event_search"), given)
    return source


def _read_derivative(
    source: Source, name: str, given: dict[str, Any], steps: Mapping[str, Any]
) -> None:
    """Add the derivative of a step, where that is asked for."""
    if name in steps.get("varied", ()):
        own = given | {"OF_STAGES": name in METHODS}
        source.read(text_of("step_jacobian").replace("METHOD", name), own)


def roots(steps: Mapping[str, Any]) -> list[str]:
    """The functions of a file that others call."""
    found = ["begin", "dense"] if steps["names"] else []
    for name in steps["names"]:
        found += [name, f"{name}_to"]
    found += [f"{name}_jacobian" for name in steps["varied"]]
    if steps["adaptive"]:
        found.append("towards")
    if steps["ensemble"]:
        found += ["fault_of", "first_of"]
    if steps["watch"]:
        found.append("watch")
    return found


def in_c(p: Program, fields: Mapping[str, Any]) -> dict[str, str]:
    """The records, tables and routines of the steps in C, for these fields of the templates."""
    steps, prefix = fields["steps"], fields["prefix"]
    given = known(p, steps) | {
        **_called(fields, f"{prefix}_"),
        "prefix": prefix,
        "real": fields["real"],
        "fabs": fields["fabs"],
        "inline": fields["inline"],
        "ENOUGH": f"{prefix}_ENOUGH",
        "NO_EVENT": -1,
    }
    more = INPUTS_IN_C.format(real=fields["real"]) if p.inputs else ""
    many = {"many": in_lanes(given)} if steps["ensemble"] else {}
    if many and fields["header"]:
        many["device"] = on_a_device(given)
    return many | _texts(C, given, steps, more)


def in_lanes(given: Mapping[str, Any]) -> str:
    """Eight motions, one in each lane, and a step of each by rk4 and vern9."""
    prefix, source = given["prefix"], Source()
    each = {name: _of_method(METHODS[name][0](), 0, device=True) for name in ("rk4", "vern9")}
    own = {
        **given,
        "ENDS": given["PARTS"][1:],
        "MOST_ROWS": max(x["ROWS"] for x in each.values()),
        "inline": "static inline",
        "projected_each": f"{given.get('projected', prefix)}_each",
    }
    for name, method in each.items():
        source.read(text_of("ensemble_lanes").replace("METHOD", name), {**own, **method})
    printer = C(source, own)
    parts = [*map("\n".join, map(printer.record, source.records))]
    return "\n\n".join([*parts, printer.text(["entered", "rk4_each", "vern9_each"])])


def on_a_device(given: Mapping[str, Any]) -> str:
    """The motion of one thread of a graphics card, moved by rk4 and vern9, with loops unrolled: so
    the state and the rates are in registers."""
    prefix = given["prefix"]
    none = ("GAUSS", "MODES", "METHODS", "EXPLICIT", "DISCRETE", "EXTRA", "HELD", "EVENTS")
    names = ("N_STATE", "N_CONSTANTS", "N_INPUTS", "NOT_FINITE", "NOT_CONVERGED")
    own = {
        **{x: f"{prefix}_{x}" for x in names},
        **given,
        **dict.fromkeys((*none, "INPUT_FUNCTIONS"), False),
        "ADAPTIVE": True,
        "DEVICE": True,
        "pragma": "#pragma unroll",
        "prefix": f"{prefix}_thread",
        "inline": "static __device__ __forceinline__",
    }
    methods = [{"name": x} for x in ("rk4", "vern9")]
    printer = C(source_of(own, {"explicit": {"methods": methods}}), own)
    parts = [*map("\n".join, map(printer.record, printer.source.records))]
    return "\n\n".join([*parts, printer.text(["begin", "rk4", "vern9_to"])])


INPUTS_IN_C = """\
    /* the inputs at a time and a state, if they are not held: by default a null pointer */
    void (*inputs)({real} t, const {real} *x, {real} *u, void *data);
    void *data;"""


def _given(p: Program, fields: Mapping[str, Any]) -> dict[str, Any]:
    """What the printers of other languages than C are given, but where they say it otherwise."""
    steps, functions = fields["steps"], fields["functions"]
    return known(p, steps) | {
        **_called(fields),
        "project": functions["project"]["name"] if "project" in functions else "",
        "real": fields["real"],
        "ENOUGH": steps["gauss"]["enough"] if steps["gauss"] else 0,
        "NO_EVENT": -1,
        "public": {*roots(steps)} - {"towards", "begin", "dense"},
        "begin": "begin_at",
        "dense": "dense_at",
    }


def _sizes(p: Program) -> dict[str, int]:
    """The sizes of a file, as numbers."""
    named = {f"N_{x}": p.sizes[x] for x in ("STATE", "CONSTANTS", "INPUTS", "EVENTS")}
    return named | {"SIZE_U": named["N_INPUTS"], "SIZE_K": named["N_CONSTANTS"]}


def in_rust(p: Program, fields: Mapping[str, Any]) -> dict[str, str]:
    """The same in Rust."""
    steps, given = fields["steps"], _given(p, fields)
    given |= {
        **{f"N_{x}": f"N_{x}" for x in (p.discrete.sizes if p.discrete else ())},
        "INPUT_FUNCTIONS": False,
        "NO_EVENT": 0,
        "public": given["public"]
        | {"t", "t_low", "x", "low", "h", "start", "evaluations", "event", "rising"},
        "item": [
            "#[allow(dead_code, non_snake_case, unused, clippy::all, clippy::pedantic)]",
            "#[rustfmt::skip]",
        ],
    }
    return _texts(Rust, given, steps)


def in_javascript(p: Program, fields: Mapping[str, Any]) -> dict[str, str]:
    """The same in JavaScript."""
    steps, prefix = fields["steps"], fields["prefix"]
    lengths = {"k": len(p.constants)} | ({"u": len(p.inputs)} if p.inputs else {})
    wrong = " || ".join(f"{x}.length !== {n}" for x, n in lengths.items())
    right = ", ".join(f"{x} has {n} numbers" for x, n in lengths.items())
    given = _given(p, fields) | _sizes(p)
    if fields["short"]:  # a page shows what is kept: there the iteration goes to rounding
        given["ENOUGH"] = 0.0
    given |= {
        "status": "OK, or why not: then the motion stands where the last good step ended",
        "entry": [
            *["    u ??= ZERO_INPUTS;"] * bool(p.inputs),
            f"    if ({wrong}) {{",
            f'        throw new RangeError("{prefix}: {right}");',
            "    }",
        ],
        "tags": {
            "m": "m what begin gave",
            "k": "{ArrayLike<number>} k what constants(p) gave",
            "u": "{?ArrayLike<number>} u "
            + ("the inputs, held; zero when null" if p.inputs else "not read: there are no inputs"),
            "steps": "{Function} steps",
            **{x: f"{{{fields['real']}}} {x} where to write" for x in ("phi", "gamma")},
        },
    }
    inputs = "        inputs: null, // or a function of t and x that gives the inputs\n" * bool(
        p.inputs
    )
    work = "        work: [], // the arrays that routines work with"
    return _texts(JavaScript, given, steps, inputs + work)


def in_julia(p: Program, fields: Mapping[str, Any]) -> dict[str, str]:
    """The same in Julia."""
    steps, functions, prefix = fields["steps"], fields["functions"], fields["prefix"]
    counts = {"k": len(p.constants), "u": len(p.inputs)}
    right = [f"length({x}) == {n}" for x, n in counts.items() if n]
    if p.inputs:
        right[-1] = f"(u isa Function || {right[-1]})"
    said = ", ".join(f"{x} has {n} numbers" for x, n in counts.items() if n)
    lengths = [
        f"    {' && '.join(right)} ||",
        f'        throw(DimensionMismatch("{prefix}: {said}"))',
    ]
    given = _given(p, fields) | {
        "functions": _called(fields) | {x: x for x in functions if x.startswith(STEPPING)},
        **{f"{x}_jacobian": f"{x}_varied!" for x in steps["varied"]},
        "KINKS": "",  # which the function around it says
        "begin": "begin_at!",
        "dense": "dense_at!",
        "status": "`OK`, or why not: then `m` is as it was after the last good step.",
        "entry": [
            *["    u = u === nothing ? ZERO_INPUTS : u"] * bool(p.inputs),
            *lengths * bool(right),
        ],
    }
    return _texts(Julia, given, steps)


def in_python(p: Program, fields: Mapping[str, Any]) -> dict[str, str]:
    """The same in Python."""
    steps, functions = fields["steps"], fields["functions"]
    given = _given(p, fields) | {
        **_sizes(p),
        "returned": {of: f"{name}(" for of, name in _called(fields).items()}
        | {x: f"_of_numbers(_{x}, " for x in functions if x.startswith(STEPPING)},
        "ENOUGH": "ENOUGH",
        "NO_EVENT": "None",
        "named": {"towards", "gauss_step", "vern9_step", "first_step"},
        **{f"{x}_jacobian": f"_{x}_jacobian" for x in steps["varied"]},
        "KINKS": "",  # which the function around it says
        "begin": "_begin_at",
        "dense": "_dense_at",
        "fault_here": "fault_of",
        "entry": ["    k, u = _given(k, u)"],
        "status": "OK, or why not, with m as it was after the last good step.",
        # which NumPy has in much less time
        "left": ("factored", "lu_solve", "solved", "multiplied"),
    }
    return _texts(Python, given, steps)


def _texts(
    language: type[Printer], given: dict[str, Any], steps: Mapping[str, Any], more: str = ""
) -> dict[str, str]:
    """Records, tables and routines, as text; ``more``: fields of a motion that no algorithm
    reads."""
    source = source_of(given, steps)
    source.leave(*given.get("left", ()))
    printer = language(source, given)
    records = (printer.record(x, more * (x == "Motion")) for x in source.records)
    return {
        "records": "\n\n".join(map("\n".join, records)),
        "tables": "\n".join(printer.tables()),
        "routines": printer.text(roots(steps)),
    }


ALGORITHMS = {
    "c": in_c,
    "rust": in_rust,
    "javascript": in_javascript,
    "julia": in_julia,
    "python": in_python,
}
"""Language → the text of the algorithms of its steps."""
