"""One self-contained page in which a body moves: the emitted JavaScript, run by the reader.

Nothing of a problem is markup or code: its texts are data, which the page shows as text.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from ...code.emit import emit
from ...code.options import Options
from ...code.program import Program
from ...language.expression import names
from ...language.reserved import GREEK
from ...language.show import show_name
from ...language.templating import environment, folder
from ...language.tree import Tree, replaced
from ...motion.emitted_code import EmittedCode, in_words
from ...motion.first_numbers import FirstNumbers, drives, is_free, weight
from ...problem.problem import Problem
from ...record.as_json import encode
from ...record.record import Derivation
from ..answer import PLANE
from ..arrows import ORIGIN, TURNING, Arrow, arrows, drawn, legend, with_arrows
from ..html import visible
from ..language import ENGLISH, Language, labelled, told
from ..outline import capitalised, subtitle, title
from .moving_body import Data, element, moving_body

if TYPE_CHECKING:
    from ...motion.start import Start

OF_PAGE = "page:"
WORDS = {x.removeprefix(OF_PAGE): told(x) for x in labelled() if x.startswith(OF_PAGE)}
"""The words of a page, by the names that its script has for them."""

NAMES = ("PARAMETERS", "INPUTS", "begin", "gauss_to", "constants", "rhs")
KEPT = ("conserved", "defect", "multiplier")
"""What a page takes of the emitted module, and the functions that it takes where they are there."""

LENGTHS = re.compile(r"\n *if \([^{}]*\.length !==[^{}]*\) \{\s*throw new RangeError[^{}]*\}(?=\n)")
"""A check of how many numbers a function is given, which a page gives always."""
THROWN = re.compile(r'new RangeError\("[^"]*"\)')
"""What a page catches, without its words."""
COMMENT = re.compile(
    r"""("(?:[^"\\\n]|\\.)*"|`[^`]*`)|/\*.*?\*/|(?:(?<=\s)|^)//[^\n]*""", re.DOTALL | re.MULTILINE
)
"""A comment; or a text, the first group, in which there is none."""
SPACES = re.compile(
    r"""("(?:[^"\\\n]|\\.)*"|`[^`]*`)| *([][(){}=,;?:*/<>&|])(?:(?<=[\[({,;])\n| *)"""
    r"""|(?<=[\w$)\]]) ([-+]) (?=[\w$(.\[])"""
)
"""A text; or a sign, the second group, with spaces about it that a script does not need, or the end
of its line; or, the third, one between two numbers."""
NAME = re.compile(r"[^\W\d][\w$]*")
TAKEN = re.compile(r"(?:(?<![\w$.])|(?<=\.\.\.))[^\W\d][\w$]*")
"""A name that is not that of a property."""
DEFINED = re.compile(
    r"^(?:function (\w+).*?\n\}\n|const (\w+|\{[^}]*\}).*?;\n(?=\n*(?:[^\s})\]]|\Z)))",
    re.DOTALL | re.MULTILINE,
)

VELOCITIES = ("ζ", "w")

MOST, CURVES = 24, 12
"""So many numbers of the velocity have sliders; so many of the state are drawn where no body is."""

SCRIPTS = (
    *("vectors", "text", "run", "colours", "shapes", "body", "canvas", "arrows", "stage", "chart"),
    *("driven", "vorticity", "second", "polhode", "rolling", "mount"),
)
"""The files of the drawing, in templates/html/motion."""


SHOWN = "turning", "momentum"
"""The vectors of a page that stands alone, by their scales."""


def seen(record: Derivation) -> list[Arrow]:
    """The vectors that are drawn on the body of a page: how it turns, and its angular momentum."""
    return [x for x in arrows(record) if x.scale in SHOWN and len(x.entries) == 3 * len(x.parts)]


def with_seen(record: Derivation) -> Derivation:
    """The record whose code has them, as outputs behind its own."""
    return with_arrows(record, seen(record))


def motion_page(
    code: EmittedCode,
    problem: Problem,
    record: Derivation,
    begin: Start | FirstNumbers,
    duration: float,
    tol: float,
    language: Language = ENGLISH,
    held: Collection[str] = (),
) -> str:
    """The page of a motion from 0 to ``duration``, to a tolerance; the code is that of the record
    :func:`.with_seen`.  Inputs go by their signals, but those that are ``held``."""
    vectors = seen(record)
    problem = replace(problem, signals=tuple(x for x in problem.signals if x.input not in held))
    about = capitalised(subtitle(record, language))
    if problem.signals:
        told = language.word("inputs in time, until they are changed here: {names}")
        about += "; " + told.format(names=", ".join(x.input for x in problem.signals))
    found = data(code, problem, record, begin, language, vectors)
    found |= {"t": duration, "tol": tol}
    found["words"]["save"] = language.word("the picture, as PNG")
    written = json.dumps(
        _with_integers(found), ensure_ascii=False, sort_keys=True, separators=(",", ":")
    )
    template = environment("html", autoescape=True).get_template("motion.html.jinja")
    return template.render(
        language=language.name,
        title=visible(title(record, language)),
        about=visible(about),
        needs_script=language.word("The motion is computed by a script."),
        style=style(),
        data=written.replace("<", "\\u003c"),
        script=script(code, record, found).replace("</", "<\\/"),
        name=code.name,
    )


def _with_integers(data: Any) -> Any:
    """The same data with whole numbers as such, 1 for 1.0, and without what is false, which a
    script takes for what is not there."""
    if isinstance(data, dict):
        return {name: _with_integers(x) for name, x in data.items() if x is not False}
    if isinstance(data, list | tuple):
        return [_with_integers(x) for x in data]
    is_integer = isinstance(data, float) and data.is_integer() and abs(data) < 1e6
    return int(data) if is_integer and str(data) != "-0.0" else data


def style() -> str:
    """The style sheet, without the spaces that it does not need."""
    text = (folder("html") / "motion.css").read_text(encoding="utf-8")
    return re.sub(r"(?<=[;{},:])\s+|;?\s+(?=[{}])|\s*\n\s*", "", text).replace(";}", "}")


def script(code: EmittedCode, record: Derivation, page: Data) -> str:
    """The emitted module, what mounts a motion, and the call of it, in few characters."""
    options = Options(step=("gauss",))
    (source,) = emit(
        code.program, record, ("javascript",), code.prefix, options, short=True
    ).values()
    program = code.program
    functions = [x for x in KEPT if x in program.functions]
    if "energy" in program.functions and "energy" not in program.conserved:
        functions.append("energy")
    names = [*NAMES, *functions, *(["CONSERVED"] * ("conserved" in functions))]
    names += ["outputs"] * bool(program.outputs)
    module = called(THROWN.sub("0", LENGTHS.sub("", source.replace("\nexport ", "\n"))), names)
    drawing = "".join(
        (folder("html") / "motion" / f"{x}.js").read_text(encoding="utf-8") for x in SCRIPTS
    )
    chosen = pieces(page)
    drawing = called(drawing, ["mount", *chosen.values(), *(["driven"] * ("signals" in page))])
    moved = "driven(emitted, page)" if "signals" in page else "emitted"
    given = ", ".join(f"{name}: {x}" for name, x in chosen.items())
    return lean(
        f'"use strict";\nconst emitted = (() => {{\n{module}'
        f"return {{ {', '.join(names)} }};\n}})();\n"
        f'{drawing}\nconst page = JSON.parse(document.getElementById("page").textContent);\n'
        'const home = document.getElementById("motion");\n'
        f"home.motion = mount(home, {{ module: {moved}, ...page }}, {{ {given} }});\n"
    )


def called(source: str, names: Sequence[str]) -> str:
    """The functions and tables of a module that are needed for some of them."""
    parts = [(NAME.findall(m[1] or m[2]), m[0]) for m in DEFINED.finditer(plain(source))]
    defined = {name: text for names_of_piece, text in parts for name in names_of_piece}
    needed, left = set[str](), [*names]
    while left:
        name = left.pop()
        if name not in needed and name in defined:
            needed.add(name)
            taken = defined[name].startswith("const {")
            left += TAKEN.findall(defined[name].partition("=")[2] if taken else defined[name])
    return "".join(
        _of(names_of_piece, text, needed)
        for names_of_piece, text in parts
        if needed & {*names_of_piece}
    )


def _of(names: Sequence[str], text: str, needed: Collection[str]) -> str:
    """A part of a module; of a pattern, the names that are needed."""
    if not text.startswith("const {"):
        return text
    return f"const {{ {', '.join(x for x in names if x in needed)} }} ={text.partition('=')[2]}"


def plain(source: str) -> str:
    """A script without its comments; our templates have no literal of a regular expression."""
    return COMMENT.sub(lambda m: m[1] or "", source)


def lean(source: str) -> str:
    """A script without comments, indentation, empty lines, and spaces about signs."""
    dense = re.sub(r"\n\s+", "\n", plain(source))
    return SPACES.sub(lambda m: m[1] or m[2] or m[3], dense)


def pieces(page: Data) -> dict[str, str]:
    """What draws a body of :func:`.moving_body`, its vectors, what is read off its motion: names
    of the drawing's functions, by what they are for; a function that is not named, nor called by
    one that is, is no part of the page."""
    body, turned = page["body"], {"turned_start": "turned_start"}
    readings = {"side": "readings"} if page.get("outputs") else {}
    turned |= {"arrows": "arrows_of"} if page.get("arrows") else {}
    if not body["parts"]:
        on_torus = {"stage": "vorticity_stage", "side": "coefficients"}
        return (on_torus if "waves" in body else {"stage": "chart_stage"}) | readings | turned
    solids = [x for part in body["parts"] for x in part["solids"]]
    names = {x["shape"] for x in solids if "shape" in x}
    names |= {"quadric" for x in solids if "quadric" in x}
    names |= {"of_moments" for part in body["parts"] if part["moments"]}
    names |= {"of_inertia" for part in body["parts"] if "turning" in part}
    if body["springs"] or any(part["anchors"] for part in body["parts"]):
        names.add("spring")
    if body["stretches"]:
        names.add("flattened")
    side = {"side": "polhode" if body["polhode"] else "velocities"} | readings
    if body["turns"] and not readings:
        names.add("rolling")
    return {"stage": "solid_stage"} | side | turned | {x: x for x in sorted(names)}


def _unsaid(made: Program, body: Mapping[str, Any], element: bool, lost: bool) -> set[str]:
    """The words for what this motion has not; ``lost``: something acts by which energy goes."""
    unsaid = {"ellipsoid", "now", "velocities" if body["polhode"] else "polhode"}
    unsaid |= {x for x in ("defect", "multiplier") if x not in made.functions}
    unsaid |= set() if lost or "multiplier" in made.functions else {"others"}
    there = {"flat": body["stretches"], "inputs": made.inputs, "element": element}
    there |= {"coefficients": "waves" in body, "rolls": body["turns"] and not made.outputs}
    there |= {"turned": element, "within": body["parts"] and not body["parts"][0]["deforms"]}
    unsaid |= {x for x, has in there.items() if not has}
    unsaid |= {"velocities", "polhode"} if made.outputs else {"readings"}
    return unsaid


def _words(
    made: Program, body: Data, record: Derivation, language: Language, unsaid: Collection[str]
) -> dict[str, str]:
    """The words of a page, but for those that are ``unsaid``."""
    words = {x: language.word(WORDS[x]) for x in WORDS if x not in unsaid}
    if "waves" in body:
        words["stage"] = language.word("vorticity")
    if body["turns"] and not made.outputs:
        words["polhode"] = language.word(WORDS["ellipsoid" if is_free(record.problem) else "now"])
    if made.inputs:
        words["kept"] = language.word("What is kept without inputs")
    return words


def data(
    code: EmittedCode,
    problem: Problem,
    record: Derivation,
    begin: Start | FirstNumbers,
    language: Language,
    vectors: Sequence[Arrow] = (),
) -> dict[str, Any]:
    """What the script is told of the motion, as JSON has it; of its code the last outputs are the
    entries of ``vectors``."""
    code, told = _apart(code, record, vectors, language)
    made = code.program
    group = problem.group if problem.advected is None else None
    state = made.state_by_block or made.state
    entries = element(group, made.state)
    velocity = [s for s in range(len(made.state)) if s not in {at for *_, at in entries}]
    largest = sorted(range(len(made.state)), key=lambda s: -abs(float(begin.x[s])))[:CURVES]
    units = {x.name: _unit(x.unit) for x in code.columns()}
    body = moving_body(record.problem, group, made.state, {x for x in units if units[x] == "rad"})
    adjusted, curves = velocity[:MOST], [] if body["parts"] else sorted(largest)
    if "waves" in body:  # most others stay as small as they begin
        curves = [s for s in curves if begin.x[s]] or curves
    basis, heavy = made.basis if entries else (), weight(record.problem or {})
    lost = bool(drives(record.problem, {}))
    said = {x: _meaning(x, record, language, _turns(body, record)) for x in made.state}
    of_state = [(y, said[x], units[x]) for x, y in zip(made.state, state, strict=True)]
    words = _words(made, body, record, language, _unsaid(made, body, bool(entries), lost))
    if group is not None and group.name.startswith(("SL(", "SAff(")) and "defect" in words:
        words["defect"] += " |det A − 1|"
    return {
        **{x: [*map(float, getattr(begin, x))] for x in ("x", "p", "u")},
        "entries": entries,
        "basis": [
            [[i, j, float(v)] for i, row in enumerate(E) for j, v in enumerate(row) if v]
            for E in basis
        ],
        "order": len(basis[0]) if basis else 0,
        "names": {s: state[s] for s in {*adjusted, *curves}},
        "adjusted": adjusted,
        **({"lost": True} if lost else {}),
        "curves": curves,
        **(_readings(made.outputs, units) if made.outputs else {}),
        **({"signals": _signals(problem, made, begin.parameters)} if problem.signals else {}),
        **told,
        "body": body,
        "labels": {
            **_labels([(x, meaning, unit) for x, _, unit, meaning in made.parameters], language),
            **_labels(of_state, language),
        },
        "kept": {
            x: (in_words(x, language.word), units[x]) for x in made.conserved if x != "energy"
        },
        **({"weightless": made.weightless, "weight": heavy} if made.weightless else {}),
        "units": {x: units.get(x, "") for x in ("t", "energy")},
        "words": words,
        "comma": language.name == "fr",
    }


READ = 9
"""As many curves has a picture of what is read off the motion."""


def _signals(problem: Problem, made: Program, numbers: Mapping[str, float]) -> list[Data]:
    """The inputs in time, by their places: trees, in which what is no parameter of the code has its
    number."""
    known = {x for x, *_ in made.parameters}
    stand = {x: y for x, y in numbers.items() if x not in known}

    def told(t: Tree) -> Data:
        for name in {*names(t)} & {*stand}:
            t = replaced(t, ("par", name), Fraction(stand[name]))
        return encode(t)

    return [
        {"i": made.inputs.index(x.input)}
        | ({"u": told(x.u)} if x.u is not None else {})
        | {"held": x.hold}
        | {k: [*map(told, ts)] for k, ts in (("times", x.times), ("values", x.samples)) if ts}
        for x in problem.signals
    ]


def _apart(
    code: EmittedCode, record: Derivation, vectors: Sequence[Arrow], language: Language
) -> tuple[EmittedCode, dict[str, Any]]:
    """The code with its own outputs alone, and what draws the vectors that the others are."""
    outputs = code.program.outputs
    own = outputs[: len(outputs) - sum(len(x.entries) for x in vectors)]
    meanings = [x["meaning"] for x in legend(record, vectors, language)]
    told = {"arrows": drawn(record, vectors, len(own)), "meanings": meanings} if vectors else {}
    return EmittedCode(replace(code.program, outputs=own), record, code.problem), told


def _turns(body: Data, record: Derivation) -> bool:
    """Are the coordinates of Z those of a turn?"""
    return bool(body["polhode"]) or record.problem.get("group") in PLANE


def _meaning(name: str, record: Derivation, language: Language, turning: bool) -> str:
    """What the letter of a velocity, or of what is advected, means; empty for any other; of
    coordinates in the Lie algebra, as the walk has them, whether they are of a turn."""
    stem = name.partition("_")[0].rstrip("0123456789")
    letter = GREEK.get(stem, stem)
    meanings = [x.meaning for x in record.symbols if x.name == letter and letter in VELOCITIES]
    said = ENGLISH.of(meanings[0]) if meanings else ""
    if said.startswith("coordinates of Z"):
        return language.word(TURNING if turning else "velocity along the basis of the group")
    return language.word(ORIGIN) if said == "A⁻¹τ" else language.of(meanings[0]) if said else ""


def _unit(text: str) -> str:
    """A unit as it is shown."""
    return visible(text).replace("^2", "²").replace("^3", "³")


def _readings(outputs: Sequence[str], units: Mapping[str, str]) -> dict[str, Any]:
    """The names of what is read off the motion, and the places of those of one unit, some of each,
    which have a picture of their own."""
    of = {u: [i for i, x in enumerate(outputs) if units[x] == u] for u in map(units.get, outputs)}
    names = [_reading(x, units[x]) for x in outputs]
    return {"outputs": names, "panels": [x[:READ] for x in of.values()]}


def _reading(name: str, unit: str) -> str:
    """What is read off the motion, as its curve is called: with its unit, if there is one."""
    return f"{show_name(name).replace('_', ' ')}, {unit}" if unit else name


def _labels(rows: Iterable[tuple[str, str, str]], language: Language) -> dict[str, tuple[str, str]]:
    """Name → meaning and unit; a meaning that is that of the name before is not said again."""
    found, before = {}, ""
    for name, meaning, unit in rows:
        label = visible(language.word(meaning)) if meaning and meaning != before else ""
        if label or unit:
            found[name] = label, _unit(unit)
        before = meaning
    return found
