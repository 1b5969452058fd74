"""What the playground is built of, from the checkout and its environment: the package, the
libraries in pure Python that it needs, ``data.json``: ready-made problems, keys, options, and
``gallery.json``: their pictures, by name.

``python -m playground.stage DIR``
"""

import gzip
import importlib
import json
import pickle
import re
import shutil
import sys
import tomllib
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from itertools import repeat
from pathlib import Path
from typing import Any

from derive.algebra.families import FAMILIES, GroupFamily, group
from derive.algebra.groups import Group
from derive.check.checker import verdicts
from derive.code.languages import LANGUAGES
from derive.code.options import ADDED, CHOICES, DEPENDENT, REPEATED
from derive.command.cli import main as command
from derive.command.showing import READY, ready_made
from derive.language.limits import TABLES
from derive.problem.motion_tables import of_points
from derive.problem.toml import TOP
from derive.record.record import AMENDED, Derivation
from derive.schema.body_kinds import SOLIDS, Point
from derive.schema.force_kinds import INPUTS, Damping
from derive.schema.kind import (
    REPRESENTATIONS,
    SECTIONS,
    Fluid,
    Parameter,
    StatedAdvected,
    StatedAlgebra,
    StatedGroup,
)
from derive.schema.motion_kinds import Event, Signal
from derive.schema.potential_kinds import kinds
from derive.schema.table import Table
from derive.views.figure.drawing import Scene, svg
from derive.views.figure.scene import scene
from derive.views.language import LANGUAGES as SPOKEN
from derive.views.language import language
from derive.views.latex import anchor
from derive.views.outline import title
from derive.views.page.motion_page import SCRIPTS
from derive.views.paper.findings import amendments

HERE = Path(__file__).parent
LIBRARIES, LATER = ("jinja2", "markupsafe"), ("mpmath", "sympy")
"""Loaded at the start; when something asks for them, each in a file of its own."""
UNUSED = {
    "sympy": (
        *("benchmarks", "categories", "codegen", "crypto", "diffgeom", "holonomic", "liealgebras"),
        *("physics", "sandbox", "stats", "testing", "vector", "autolev", "fortran", "latex"),
    ),
}
"""Folders of a library that its other modules import for tasks alone that nobody has here."""


LEFT_OUT = ("compare", "comparing.py", "lecture", "lecturing.py")
"""What starts processes, which a page has not, and what it has no button for."""


def package(out: Path) -> None:
    """The package as its wheel has it, without what a page cannot do."""
    skip = shutil.ignore_patterns("__pycache__", *LEFT_OUT)
    shutil.copytree(HERE.parent / "derive", out / "derive", ignore=skip)
    shutil.copytree(HERE.parent / "templates", out / "derive" / "templates")


def library(name: str, out: Path) -> None:
    """The modules of a library, without tests and what is compiled."""
    source = Path(importlib.import_module(name).__file__ or "").parent
    skip = shutil.ignore_patterns(
        *("__pycache__", "*.so", "*.pyi", "*.c", "tests", "*.typed", *UNUSED.get(name, ()))
    )
    shutil.copytree(source, out / name, ignore=skip)


def problems(said: Mapping[str, Mapping[str, str]]) -> list[dict[str, str]]:
    """The ready-made problems in the order of the gallery: name, text; shelf, what it is as a
    thing, title and group in both languages; ``said``: what a record says of each."""
    found = []
    things = [(shelf, x) for shelf in shelves() for x in shelf["things"]]
    for own, x in things:
        told = {"name": x["name"], "text": (READY / f"{x['name']}.toml").read_text("utf-8")}
        group = x.get("group", said[x["name"]]["group"])
        for lang in SPOKEN:
            called = said[x["name"]][lang]
            told |= {lang: x[lang], f"shelf_{lang}": own[lang], f"title_{lang}": called}
            told[f"group_{lang}"] = x.get(f"group_{lang}", group)
        found.append(told)
    return found


def spoken() -> dict[str, Any]:
    """The words for keys and kinds, and the phrases of a sentence, by language."""

    def of(x: dict[str, Any], lang: str) -> Any:
        return x[lang] if lang in x else {key: of(y, lang) for key, y in x.items()}

    told = tomllib.loads((HERE / "phrases.toml").read_text(encoding="utf-8"))
    return {lang: of(told, lang) for lang in SPOKEN}


def options() -> dict[str, object]:
    """Those of ``derive emit``."""
    about = {x: y for x, (_, y) in (CHOICES | DEPENDENT | REPEATED).items()} | ADDED
    return {
        "emission": EMISSION,
        "languages": [*LANGUAGES],
        "choices": {x: [*values] for x, (values, _) in (CHOICES | DEPENDENT).items()},
        "repeated": {x: [*values] for x, (values, _) in REPEATED.items()},
        "added": [*ADDED],
        "about": {to: {x: language(to).word(y) for x, y in about.items()} for to in SPOKEN},
        "values": tomllib.loads((HERE / "values.toml").read_text(encoding="utf-8")),
    }


def schema() -> dict[str, object]:
    """The keys of a problem file: at the top, of its tables, of the kinds of some; what is a list;
    the values of keys that have few; groups with what they move, and how their velocity is
    called; a small problem to begin with."""
    many = {*TABLES, "advected"}
    single = {"parameters", "body", "algebra", "group", "fluid", "initial", *SECTIONS}
    potentials, inputs = kinds(), dict(INPUTS)
    own = [*potentials.values(), *inputs.values(), *SOLIDS.values(), *(x for _, x in STATED)]
    few = {k: x.words for table in own for k, x in table.keys().items() if x.words}
    return {
        "top": sorted(TOP),
        "single": sorted(single),
        "many": sorted(many),
        "tables": {x: [*own.names()] for x, own in STATED},
        "potential": {x: [*own.names()] for x, own in potentials.items()},
        "input": {x: [*own.names()] for x, own in inputs.items()},
        "solid": {x: [*own.names()] for x, own in SOLIDS.items()},
        "lists": sorted({x for table in own for x in vectors(table)}),
        "values": few | OTHERS,
        "named": [x for _, x in named_groups()],
        "groups": {x: moved(group(x), f.meaning) for f, x in named_groups()},
        "scaffold": (HERE / "scaffold.toml").read_text(encoding="utf-8"),
    }


STATED: tuple[tuple[str, type[Table]], ...] = (
    *(("parameters", Parameter), ("group", StatedGroup), ("algebra", StatedAlgebra)),
    *(("advected", StatedAdvected), ("point", Point), ("damping", Damping), ("event", Event)),
    *(("signal", Signal), ("fluid", Fluid), *SECTIONS.items()),
)
"""The tables of one kind."""
OTHERS = {"moments": ("symbolic",), "representation": REPRESENTATIONS}
"""The values of keys that have few, but in no table."""


def vectors(own: type[Table]) -> set[str]:
    """The keys of a table whose values are lists of numbers or expressions."""
    found = {x: k for x, k in own.keys().items() if k.depth == 1}
    apart = {x for x, k in found.items() if k.keys is not None}
    return {*found} - apart | ({"at"} if apart or "at" in own.names() else set())


def named_groups() -> Iterator[tuple[GroupFamily, str]]:
    """Every named group, by its family and its name."""
    for name, family in FAMILIES.items():
        for n in range(family.least, family.most + 1):
            if n % family.step == 0:
                yield family, f"{name}({n})"


def moved(g: Group, meaning: str) -> dict[str, object]:
    """The dimension of the space that a group moves, that of its algebra, and how many numbers of
    the velocity of a body of points are called w."""
    w = sum(x.startswith("w_") for x in of_points(g))
    return {"n": g.n, "d": g.dimension, "w": w, "meaning": meaning}


def stored(out: Path) -> dict[str, dict[str, str]]:
    """What the worker tells of the ready-made problems, so that these are read, and move, before
    there is Python; returned is what their records say of themselves."""
    folder = out.with_name("stored")
    folder.mkdir()
    with ProcessPoolExecutor() as pool:
        said = pool.map(stored_of, ready_made(), repeat(out), repeat(folder))
        return dict(zip(ready_made(), said, strict=True))


def stored_of(name: str, out: Path, folder: Path) -> dict[str, str]:
    """A file of a problem in each language, with the news of the worker in their order; returned
    are its title by language, its group and its picture."""
    sys.path.insert(0, str(HERE / "python"))
    import play

    play.FOLDER, play.STORED = folder / name, out.with_name("first") / "amendments.pickle"
    heard: list[tuple[str, Any]] = []
    played = play.Play(lambda kind, news: heard.append((kind, json.loads(news))))
    text = (READY / f"{name}.toml").read_text(encoding="utf-8")
    for lang in SPOKEN:
        told: dict[str, list[tuple[str, Any]]] = {}
        for ask in STORED:
            heard.clear()
            getattr(played, ask)(text, lang)
            told[ask] = [*heard]
            for kind, news in heard:
                if kind == "derived":
                    ticked(news["road"], played.record)
                if kind == "kept":  # its code has that of the motion in it: it stands once
                    played.sources[False] = news.pop("source")
        made = json.dumps(told, ensure_ascii=False, separators=(",", ":")).encode()
        (out / f"{name}.{lang}.json.gz").write_bytes(gzip.compress(made, 9, mtime=0))
    heard.clear()
    played.files(text, EMISSION)
    code = json.dumps({"files": heard}, ensure_ascii=False).encode()
    (out / f"{name}.code.json.gz").write_bytes(gzip.compress(code, 9, mtime=0))
    record: Derivation = played.record
    titles = {x: title(record, language(x)).replace("^2", "²") for x in SPOKEN}
    group = str(record.problem.get("group") or "").replace(" x ", " × ")
    return {**titles, "group": group, "picture": picture(record)}


def ticked(road: list[dict[str, Any]], record: Derivation) -> None:
    """Add to stations the verdicts on their steps, as a check in the page tells them."""
    at = {x["id"]: x for x in road}
    labels = {x.label for x in record.steps if anchor(x.label) in at}
    for v in verdicts(record, labels=labels):
        if v.label in labels:
            at[anchor(v.label)] |= {"holds": v.holds, "bound": f"{v.bound:.0e}"}


THING = ("name", "en", "fr", "like", "group", "group_fr")
"""What is said of a thing, the last three of few."""
MARGIN = 1.0
"""Around a picture, in millimetres."""
UNDRAWN = ("gravity", "force")
"""What a small picture has not, beside the letters."""


def shelves() -> list[dict[str, Any]]:
    """Those of the file, in order: titles in both languages, things by the names of their problems
    and their own; ``like``: the problem whose picture it has; ``group``, where it is called
    otherwise than in the problem, and in French otherwise still."""
    shelf_of = tomllib.loads((HERE / "gallery.toml").read_text(encoding="utf-8"))["shelf"]
    return [
        x | {"things": [dict(zip(THING, y, strict=False)) for y in x["things"]]} for x in shelf_of
    ]


def picture(record: Derivation) -> str:
    """The figure of a record's body as a small SVG, without letters and for the eye alone; empty
    where it has none."""
    found = scene(record)
    if found is None:
        return ""
    drawn = svg(_cropped(found))
    drawn = re.sub(r"<title>.*?</title>\n|<g [^>]*>\n</g>\n", "", drawn)
    drawn = re.sub(
        r' width="[\d.]*mm"| height="[\d.]*mm"| role="img"| style="max-[^"]*"', "", drawn
    )
    return drawn.replace("<svg ", '<svg aria-hidden="true" ').replace("\n", "")


def _cropped(found: Scene) -> Scene:
    """A scene without letters and what acts, as large as the rest."""
    strokes = [s for s in found.strokes if s.role not in UNDRAWN]
    reach = [p for s in strokes for p in s.points]
    reach += [(d.at[0] + s * d.radius, d.at[1] + s * d.radius) for d in found.dots for s in (1, -1)]
    xs, ys = zip(*reach, strict=True)
    left, low = min(xs) - MARGIN, min(ys) - MARGIN
    return replace(
        found,
        width=max(xs) - left + MARGIN,
        height=max(ys) - low + MARGIN,
        strokes=tuple(
            replace(s, points=tuple((x - left, y - low) for x, y in s.points)) for s in strokes
        ),
        dots=tuple(replace(d, at=(d.at[0] - left, d.at[1] - low)) for d in found.dots),
        labels=(),
    )


def pictures(said: Mapping[str, Mapping[str, str]]) -> dict[str, str]:
    """Of the things that have one."""
    things = [x for shelf in shelves() for x in shelf["things"]]
    drawn = {x["name"]: said[x.get("like", x["name"])]["picture"] for x in things}
    return {name: x for name, x in drawn.items() if x}


EMISSION = "emit FILE --lang c --lang python --out out"
"""The code that is shown before anything is chosen."""
STORED = ("walk", "kept", "motion")
"""What is asked of a ready-made problem before it is changed."""


def drawing() -> str:
    """What moves a body, and its functions by name."""
    folder = HERE.parent / "templates" / "html" / "motion"
    source = "".join((folder / f"{x}.js").read_text(encoding="utf-8") for x in SCRIPTS)
    names = re.findall(r"^(?:function|const) (\w+)", source, re.MULTILINE)
    return f"{source}\nglobalThis.drawing = {{ {', '.join(names)} }};\n"


def main(out: Path) -> None:
    """Stage everything in a folder."""
    shutil.rmtree(out, ignore_errors=True)
    first, later = out / "first", out / "later"
    first.mkdir(parents=True)
    later.mkdir()
    package(first)
    for name in LIBRARIES:
        library(name, first)
    for name in LATER:
        library(name, later / name)
    shutil.copy(HERE / "python" / "play.py", first)
    (first / "amendments.pickle").write_bytes(pickle.dumps(amendments(AMENDED)))
    (out / "ready").mkdir()
    said = stored(out / "ready")
    told = {
        "problems": problems(said),
        **options(),
        "schema": schema(),
        "spoken": spoken(),
    }
    for lang in SPOKEN:
        command(["lecture", "--lang", lang, "--out", str(out / f"lecture.{lang}.html")])
    (out / "motion.js").write_text(drawing(), encoding="utf-8")
    (out / "gallery.json").write_text(json.dumps(pictures(said)))
    (out / "data.json").write_text(json.dumps(told, ensure_ascii=False, sort_keys=True))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
