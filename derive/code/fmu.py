"""The C of a problem as a Functional Mock-up Unit, of FMI 3.0 and of FMI 2.0 (fmi-standard.org)."""

from __future__ import annotations

import hashlib
import io
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..language.templating import environment
from .program import Program
from .requests import EmissionRequest

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
