"""The files of each language from a program: its templates, filled with finished strings; and the
C of a problem as a Functional Mock-up Unit, of FMI 3.0 and of FMI 2.0 (fmi-standard.org).
"""

from __future__ import annotations

import hashlib
import io
import json
import math
import re
import textwrap
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any

from .. import __version__
from ..language.limits import Refused
from ..language.reserved import did_you_mean, near_name
from ..language.templating import environment
from ..record.record import Derivation
from ..routines import PRINTERS, printer_of, text_of
from ..routines.c import C
from .conventions import heading
from .ellipsoid import BUNDLES, is_integral
from .group_functions import printed_group
from .languages import LANGUAGES, Statements, TargetLanguage, comment
from .naming import taken_prefix
from .options import Options
from .printed_integrals import integrals
from .program import TOLERANCE, Program
from .requests import EmissionRequest, hollowed, identifiers, without_collisions
from .signatures import SIZES, functions
from .step.algorithms import ALGORITHMS
from .step.step_numbers import IN_FLOAT, VARIED, steps
from .step.tableaux import METHODS
from .torus_loops import count_loops, loop_fields

STANDARDS = {"_fmu.xml": ".fmu", "_fmi2.xml": "_fmi2.fmu"}
"""How the name of a description ends → that of its archive."""

SOURCES = (".h", ".c", "_steps.h", "_fmu.c")
"""How those end that stand in an archive."""


@dataclass(frozen=True)
class Variable:
    """A variable of the unit, by its ``place`` in the list, which is its value reference.

    ``state``: of a rate, the place of what it is the rate of, else 0."""

    place: int
    name: str
    causality: str
    variability: str = "continuous"
    initial: str = ""
    start: float | None = None
    state: int = 0
    unit: str = ""
    description: str = ""


def variables(p: Program) -> list[Variable]:
    """Time, the state, its rates, parameters, inputs, what is read off the motion, the energy, what
    is conserved; the state of a unit starts where :attr:`Program.start` says."""
    x, numbers, u = p.start
    found, names = [Variable(0, "time", "independent")], {"time"}

    def add(name: str, causality: str, **more: Any) -> None:
        while name in names:  # an output may be called what a conserved quantity is
            name += "_"
        names.add(name)
        found.append(Variable(len(found), name, causality, **more))

    for name, first in zip(p.state, x, strict=True):
        add(name, "output", initial="exact", start=first)
    for i, name in enumerate(p.state, 1):
        add(f"der({name})", "local", initial="calculated", state=i)
    for (name, _, unit, meaning), first in zip(p.parameters, numbers, strict=True):
        about: dict[str, Any] = {"unit": unit, "description": meaning}
        add(name, "parameter", variability="tunable", initial="exact", start=first, **about)
    for name, first in zip(p.inputs, u, strict=True):
        add(name, "input", start=first)
    for name in (*p.outputs, *p.conserved, "energy"):
        if name == "energy" and name in names:  # one of what is conserved
            continue
        add(name, "output", initial="calculated")
    return found


def fields_of(p: Program, asked: EmissionRequest, made_of: Sequence[str]) -> dict[str, Any]:
    """What the templates have beside those of C; ``made_of``: what the heads of the files say,
    for which the token stands."""
    found, steps = variables(p), asked.options.step
    order = ("vern9", "gauss") if p.bends else ("gauss", "vern9")
    sources = [".c"] * (asked.options.form == "source") + ["_fmu.c"]
    return {
        "variables": found,
        "units": sorted({x.unit for x in found if x.unit}),
        "token": hashlib.sha256("\n".join(made_of).encode()).hexdigest()[:32],
        "tool": "derive",
        "sources": [asked.prefix + x for x in sources],
        "step": next((x for x in order if x in steps), ""),
        "first": dict(zip("xpu", p.start, strict=True)),
    }


def archives(prefix: str, files: Mapping[str, str]) -> dict[str, bytes]:
    """Name → archive, of the emitted files, for each standard that is described among them; the
    same bytes at any time."""
    sources = {x: files[x] for y in SOURCES if (x := prefix + y) in files}
    compiled = [x for x in sources if x.endswith(".c")]
    build = environment("fmu").get_template("build_description.xml.jinja")
    found = {}
    for described, ending in STANDARDS.items():
        inside = {"modelDescription.xml": files[prefix + described]}
        inside |= {f"sources/{x}": text for x, text in sources.items()}
        inside["sources/buildDescription.xml"] = build.render(prefix=prefix, sources=compiled)
        to = io.BytesIO()
        with zipfile.ZipFile(to, "w") as archive:
            for name, text in inside.items():
                archive.writestr(zipfile.ZipInfo(name), text)
        found[prefix + ending] = to.getvalue()
    return found


class EmitError(Refused, ValueError):
    """A prefix or an option that cannot be emitted: the message says what to do."""


def emit(
    program: Program,
    d: Derivation,
    languages: Sequence[str],
    prefix: str,
    options: Options | None = None,
    allowed: Sequence[str] = (),
    *,
    short: bool = False,
) -> dict[str, str]:
    """File name → text, for each language; ``EmitError`` for a prefix that is no name.

    ``allowed``: what may be negative in the problem, ``mass`` or ``stiffness``; ``short``: as an
    ``EmissionRequest`` has it.
    """
    chosen = options or Options()
    asked = EmissionRequest(d.name, prefix, tuple(languages), chosen, tuple(allowed), short)
    places = planned(languages, prefix, chosen)
    if chosen.ensemble and program.loops:
        raise EmitError(f"{d.name}: --ensemble is not written for loops on the torus: leave it out")
    files: dict[str, str] = {}
    for name in dict.fromkeys(language for language, _ in places.values()):
        own = {file: template for file, (language, template) in places.items() if language == name}
        language = LANGUAGES[name]
        skeleton = "\n".join(_rendered(hollowed(program), d, asked, language, own).values())
        words = identifiers(skeleton, language)
        named = without_collisions(program, words, caseless=language.caseless)
        files |= _rendered(named, d, asked, language, own)
    return files


def planned(languages: Sequence[str], prefix: str, chosen: Options) -> dict[str, tuple[str, str]]:
    """File name → its language and template; ``EmitError`` for a prefix that is no name, a
    language that there is not, a form, a frame or a step that one does not have."""
    form = chosen.form
    if unknown := next((x for x in languages if x not in LANGUAGES), ""):
        near = did_you_mean(near_name(unknown.lower(), LANGUAGES), "; ")
        raise EmitError(f"no language {unknown[:40]!r}{near}; there are {', '.join(LANGUAGES)}")
    needed = [x for x in (LANGUAGES[name].needs for name in languages) if x]
    well_formed = re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,63}", prefix)
    if what := taken_prefix(prefix, [*languages, *needed]) if well_formed else "no name":
        raise EmitError(
            f"the prefix {prefix[:40]!r} cannot be used, it is {what}: give --prefix NAME, "
            "letters, digits and _, starting with a letter, at most 64"
        )
    forms = {name: x for name, x in LANGUAGES.items() if x.files["header"] != x.files["source"]}
    if form == "header" and not any(name in forms or LANGUAGES[name].needs for name in languages):
        raise EmitError(
            f"--form header is one of {', '.join(forms)}: add --lang {next(iter(forms))}"
        )
    plain = [name for name in languages if not LANGUAGES[name].framed]
    if chosen.frame == "principal" and plain:
        framed = ", ".join(name for name, x in LANGUAGES.items() if x.framed)
        raise EmitError(f"--frame principal is written in {framed}, not in {', '.join(plain)}")
    of_double = [f"--step {x}" for x in chosen.step if x not in IN_FLOAT]
    of_double += ["--ensemble"] * chosen.ensemble
    of_double += ["--lang fmu"] * ("fmu" in languages)
    if chosen.real == "float" and of_double:
        raise EmitError(f"{of_double[0]} is of doubles: leave out --real float")
    if chosen.ensemble and not {"c"} & {x for y in languages for x in (y, LANGUAGES[y].needs)}:
        raise EmitError("--ensemble is written in C: add --lang c")
    if "step" in chosen.jacobian and not {*VARIED} & {*chosen.step}:
        raise EmitError(f"--jacobian step is that of --step {', '.join(VARIED)}: add one of these")
    if chosen.order and "discrete" not in chosen.step:
        raise EmitError(
            "--order is that of --step discrete; other steps have one of their own: leave it out"
        )
    for step in chosen.step:
        if without := [name for name in languages if step not in LANGUAGES[name].steps]:
            known = ", ".join(name for name, x in LANGUAGES.items() if step in x.steps)
            others = ", ".join(without)
            remedy = f"; emit {others} apart, without it" if {*without} < {*languages} else ""
            raise EmitError(f"--step {step} is written for {known}, not for {others}{remedy}")
    places = {}
    for name in dict.fromkeys([*needed, *languages]):
        apart = LANGUAGES[name].step_files if chosen.moves else ()
        for file in (*LANGUAGES[name].files[form], *apart):
            source, _, suffix = file.rpartition(":")
            places[prefix + suffix] = name, f"problem{source or suffix}.jinja"
        if chosen.exponential and not LANGUAGES[name].needs:
            suffix = "_group" + LANGUAGES[name].files["source"][0]
            places[prefix + suffix] = name, f"problem{suffix}.jinja"
    return places


def included(languages: Iterable[str]) -> tuple[str, ...]:
    """The headers of the C library that the files of these languages include."""
    compiled = [x for name in languages for x in (name, LANGUAGES[name].needs)]
    return ("math.h", "stddef.h") if "c" in compiled else ()


def problem_hash(d: Derivation) -> str:
    """The first 16 hexadecimal digits of SHA-256 of the problem as the record states it."""
    data = json.dumps(dict(d.problem), sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(data.encode()).hexdigest()[:16]


def _rendered(
    p: Program,
    d: Derivation,
    asked: EmissionRequest,
    language: TargetLanguage,
    places: Mapping[str, str],
) -> dict[str, str]:
    """File name → text, of one language; ``places``: file name → template."""
    templates, fields = environment(language.name), _fields(p, d, asked, language)
    templates.globals |= {"lines": lines, "sections": sections, "prefixed": prefixed}
    templates.globals |= {"quoted": quoted, "listed": listed}
    return {file: templates.get_template(x).render(fields) for file, x in places.items()}


def prefixed(before: str, found: Iterable[str], after: str = "") -> str:
    """Lines one below the other, each with what stands before and after it."""
    return "".join(f"{before}{x}{after}".rstrip() + "\n" for x in found)


def lines(found: Iterable[str]) -> str:
    """Statements and comments of a function, one below the other."""
    return prefixed("    ", found)


def quoted(names: Iterable[str], width: int) -> str:
    """Names between quotation marks on lines of their own; nothing where there are none."""
    return listed((f'"{x}"' for x in names), width)


def listed(items: Iterable[str], width: int) -> str:
    """Items on lines of their own, a comma after each; nothing where there are none."""
    rows = textwrap.wrap(" ".join(f"{x}," for x in items), width, break_long_words=False)
    return "\n" + lines(rows) if rows else ""


def sections(f: Mapping[str, Any]) -> str:
    """Those of the sections of a function, an empty line before each."""
    return "".join("\n" + lines(s["comment"] + s["statements"]) for s in f["sections"])


def _fields(
    p: Program, d: Derivation, asked: EmissionRequest, language: TargetLanguage
) -> dict[str, Any]:
    """What the templates of a language are filled with, by the names they use."""
    prefix, real = asked.prefix, asked.options.real
    explicit_alone = {*asked.options.step} <= {*METHODS}  # what devices have
    printer = language.printer(real)
    own = p.sizes
    sizes = {a: prod(own[x] for x in of) for a, of in SIZES.items() if {*of} <= {*own}}
    if p.framing:
        sizes["axes"] = sum(n + n * n for n, _ in p.framing.matrices)
        sizes["frame"] = len(p.framing.numbers.outputs)
    written = Statements(language, real, sizes, prefix)
    called = {x for f in p.all_functions() for x in f.calls()}
    parameters = [_parameter(x) for x in p.parameters]
    known = functions(p, written)
    if p.loops:
        count_loops(p.loops, known, language.needs or language.name)
    made_of = f"Generated by derive {__version__} from problem {problem_hash(d)}; do not edit."
    generated = [made_of, *asked.option_lines]
    cost = {name: f["operations"] for name, f in known.items()}
    fields = {
        **vars(p),
        "prefix": prefix,
        "guard": prefix.upper() + "_H",
        "header": (header := asked.options.form == "header"),
        "inline": f"{prefix}_FUNCTION" if header and explicit_alone else "static inline",
        "real": language.reals[real],
        "fabs": printer.absolute,
        "title": comment(p.title),
        "generated": generated,
        "short": asked.short,
        "parameters": parameters,
        **_lists(p),
        **_defaults(p, language, real),
        "affine": p.translates,
        "heading": [*generated, "", *heading(p, language, parameters, cost)],
        "functions": known,
        "framing": _framing(p, written, sizes),
        **{x: getattr(p, x) for x in ("literal", "asks_for_zero", "momentum_range")},
        "calls": sorted({"sqrt" if is_integral(x) else x for x in called}),
        "integrals": integrals(written, language, prefix, [x for x in BUNDLES if x in called]),
        "tolerance": printer.number(Fraction(TOLERANCE[real])),
        "loops": p.loops,
        "steps": steps(p, written, asked.options) if asked.options.moves else None,
    }
    fields["axes_routine"] = _axes(TOLERANCE[real], fields) if p.framing else ""
    fields["newton"] = _newton(p, language.needs or language.name, SMALL_CHANGE[real], fields)
    if fields["steps"] and asked.short:
        fields["steps"]["turns"] = []
    if fields["steps"] and language.name in ALGORITHMS:
        fields["steps"]["algorithms"] = ALGORITHMS[language.name](p, fields)
    if p.group_functions and not language.needs:
        fields["maps"] = printed_group(language.name, p, fields)
    if language.name == "fmu":
        fields |= fields_of(p, asked, generated)
    if p.loops:
        fields["loops"] = loop_fields(p, language.name, written, fields)
    return fields


def _defaults(p: Program, language: TargetLanguage, real: str) -> dict[str, Any]:
    """Those of the parameters by name, of those that have one; and of all, in a language."""
    written, absent = language.printer(real), language.nan.format(real=language.reals[real])
    given = [(name, x) for name, x, *_ in p.parameters]
    every = [absent if x is None else written.number(Fraction(repr(x))) for _, x in given]
    named = [(name, repr(x)) for name, x in given if x is not None]
    return {"defaults": named, "every_default": every}


def _lists(p: Program) -> dict[str, Any]:
    """The names of parameters, and the lists of names of a file, those of state, parameters and
    inputs also where they are empty; what they are called in C and C++."""
    own, events = [x[0] for x in p.parameters], [x.name for x in p.events]
    further = {"CONSERVED": p.conserved, "OUTPUTS": p.outputs, "EVENTS": events}
    lists = [
        ("STATE", p.state),
        *([("STATE_BY_BLOCK", p.state_by_block)] if p.state_by_block else ()),
        ("PARAMETERS", own),
        ("INPUTS", p.inputs),
        *((x, names) for x, names in further.items() if names),
    ]
    called = {}
    for x, _ in lists:  # as parameter_names, state_names_by_block
        what, by, which = x.lower().partition("_")
        called[x] = f"{what.removesuffix('s')}_names{by}{which}"
    return {"parameter_names": own, "lists": lists, "names_of": called}


NEWTON_STEPS, SMALL_CHANGE = 60, {"double": 1e-10, "float": 1e-4}
"""The most steps of Newton's method for the velocity of momenta; and the last of them, by the type
of numbers: as the error is squared by a step, the next would be below rounding."""


def _newton(
    p: Program, language: str, small: float, fields: Mapping[str, Any]
) -> dict[str, Any] | None:
    """The template fields of Newton's method, where momenta do not tell the velocity by a formula:
    in languages of plain numbers its ``text``, and in C the ``heads`` of its functions."""
    if "velocity_step" not in p.functions:
        return None
    (first, end), prefix = p.momentum_range, fields["prefix"]
    told = {"NEWTON_STEPS": NEWTON_STEPS, "SMALL": small, "FIRST": first, "END": end}
    if language not in PRINTERS:
        return told
    functions = ["velocity", *["momentum_rhs"] * (language in ("c", "rust"))]
    given: dict[str, Any] = {
        **told,
        "fabs": fields["fabs"],
        "inline": f"{prefix}_FUNCTION" if fields["header"] else "",
        "public": functions if language == "rust" else (),
        "item": ["#[allow(dead_code, unused, clippy::all, clippy::pedantic)]", "#[rustfmt::skip]"],
        **({"N_STATE": len(p.state)} if language == "javascript" else {}),
        **WITHOUT_STATUS.get(language, {}),
    }
    texts = [text_of("velocity_of_momenta")]
    found = printer_of(language, texts, given, prefix, fields["real"])
    heads = found.heads(functions) if isinstance(found, C) else ""
    # where there are steps in time, Rust has their faults beside this one
    text = found.text(functions).replace("Stopped::NotConverged", "NotConverged")
    return told | {"text": text.replace("Stopped", "NotConverged"), "heads": heads}


WITHOUT_STATUS: dict[str, dict[str, Any]] = {
    "javascript": {"velocity": "velocity_into", "OK": "true", "NOT_CONVERGED": "false"},
    "julia": {
        "velocity": "velocity_into!",
        "functions": {"velocity_step": "velocity_step"},
        "typed": "out",
        "OK": "true",
        "NOT_CONVERGED": "false",
    },
}
"""What the routine is called where a function of the file stands about it, and what it returns."""


def _framing(p: Program, written: Statements, sizes: Mapping[str, int]) -> dict[str, Any] | None:
    """The template fields of the principal frame: matrices, where their axes go, the numbers."""
    if p.framing is None:
        return None
    matrices, start = [], 0
    for n, f in p.framing.matrices:
        matrices.append({"n": n, "start": start, **written.function(f)})
        start += n + n * n
    largest = max(n for n, _ in p.framing.matrices)
    return {
        "matrices": matrices,
        "numbers": written.function(p.framing.numbers),
        "largest": largest,
        "axes": sizes["axes"],
        "count": sizes["frame"],
    }


def _axes(tolerance: float, fields: Mapping[str, Any]) -> str:
    """The routine in C that finds the axes of a matrix; rows of equal values are led by the first
    unit vector of which so large a share, in the mean, is in their span."""
    prefix = fields["prefix"]
    given = {
        "TOLERANCE": tolerance,
        "SHARE": 0.618,
        "PI": math.pi,
        "fabs": fields["fabs"],
        "inline": f"{prefix}_FUNCTION" if fields["header"] else "static",
    }
    found = printer_of("c", [text_of("axes_of_matrix")], given, prefix, fields["real"])
    return found.text(["axes"])


def _parameter(x: tuple[str, float | None, str, str]) -> dict[str, str]:
    """A parameter as a comment says it: meaning, unit, default."""
    name, default, unit, meaning = x
    words = [comment(meaning), f"[{comment(unit)}]" if unit else ""]
    words.append(f"default {default!r}" if default is not None else "")
    return {"name": name, "text": ", ".join(w for w in words if w)}
