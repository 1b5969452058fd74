"""What the playground is built of, from the checkout and its environment: the wheel unpacked, the
libraries in pure Python that it needs, and ``data.json``: ready-made problems, keys, options.

``python -m playground.stage DIR``
"""

import importlib
import json
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import derive
from derive.algebra.families import FAMILIES
from derive.code.languages import LANGUAGES
from derive.code.options import ADDED, CHOICES, DEPENDENT, REPEATED
from derive.command.cli import READY, ready_made
from derive.page.motion_page import SCRIPTS
from derive.problem.toml import TOP
from derive.schema.body_kinds import Point
from derive.schema.declared import Parameter
from derive.schema.kinds import kinds
from derive.schema.solid_kinds import SOLIDS
from derive.views.language import language
from derive.views.outline import title
from derive.views.system import system

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


def wheel(out: Path) -> None:
    """The wheel of the checkout, unpacked as an installer would."""
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    made = out.with_name("wheel")
    shutil.rmtree(made, ignore_errors=True)
    subprocess.run([*pip, "wheel", "--no-deps", "-w", str(made), str(HERE.parent)], check=True)
    (file,) = made.glob("*.whl")
    with zipfile.ZipFile(file) as archive:
        names = [x for x in archive.namelist() if x.startswith("derive/")]
        archive.extractall(out, names)


def library(name: str, out: Path) -> None:
    """The modules of a library, without tests and what is compiled."""
    source = Path(importlib.import_module(name).__file__ or "").parent
    skip = shutil.ignore_patterns(
        *("__pycache__", "*.so", "*.pyi", "*.c", "tests", "*.typed", *UNUSED.get(name, ()))
    )
    shutil.copytree(source, out / name, ignore=skip)


def problems() -> list[dict[str, str]]:
    """The ready-made problems: name, group, text; title and sentence in both languages."""
    found = []
    for name in ready_made():
        record = derive.derive(name).record
        told = {"name": name, "text": (READY / f"{name}.toml").read_text(encoding="utf-8")}
        for lang in ("en", "fr"):
            words = language(lang)
            told[f"title_{lang}"] = title(record, words)
            told[f"about_{lang}"] = plain(system(record, words))
        found.append(told | {"group": str(record.problem.get("group") or "")})
    return found


def plain(text: str) -> str:
    """A sentence without the marks of its formulas."""
    return text.replace("$", "").replace("`", "")


def options() -> dict[str, object]:
    """Those of ``derive emit``."""
    return {
        "languages": [*LANGUAGES],
        "choices": {x: [*values] for x, (values, _) in (CHOICES | DEPENDENT).items()},
        "repeated": {x: [*values] for x, (values, _) in REPEATED.items()},
        "added": [*ADDED],
        "about": {x: y for x, (_, y) in (CHOICES | DEPENDENT | REPEATED).items()} | ADDED,
    }


def schema() -> dict[str, object]:
    """The keys of a problem file: at the top, and of its tables; kinds with their keys."""
    return {
        "top": sorted(TOP),
        "tables": {"point": [*Point.names()], "parameters": [*Parameter.names()]},
        "potential": {x: [*own.names()] for x, own in kinds().items()},
        "solid": {x: [*own.names()] for x, own in SOLIDS.items()},
        "groups": {x: [f.least, f.most, f.meaning] for x, f in FAMILIES.items()},
    }


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
    wheel(first)
    for name in LIBRARIES:
        library(name, first)
    for name in LATER:
        library(name, later / name)
    for module in ("play", "places"):
        shutil.copy(HERE / "python" / f"{module}.py", first)
    told = {"version": derive.__version__, "problems": problems(), **options(), "schema": schema()}
    (out / "motion.js").write_text(drawing(), encoding="utf-8")
    (out / "data.json").write_text(json.dumps(told, ensure_ascii=False, sort_keys=True))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
