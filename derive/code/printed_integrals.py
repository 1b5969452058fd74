"""The functions of integrals over an ellipsoid, for one file: the fields of their templates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..routines.printer import Printer
from ..routines.source import Source, Type
from .duplication import CONVERGED, DUPLICATIONS, NEWTON_STEPS, SMALL_Y, Duplication
from .ellipsoid import BUNDLES, SLOPES
from .languages import Statements, TargetLanguage
from .step.algorithms import PRINTERS, real_of_work, text_of

REAL = Type("real")


def integrals(
    written: Statements, language: TargetLanguage, prefix: str, called: Sequence[str]
) -> dict[str, Any] | None:
    """The template fields of these functions; ``None`` without any."""
    if not called:
        return None
    found: list[dict[str, Any]] = []
    for name in called:
        d = Duplication(second=name == SLOPES)
        parts: dict[str, Any] = {x: written.part(f) for x, f in d.functions().items()}
        parts |= {"name": name, "of": BUNDLES[name], "second": d.second, "carried": d.back_names}
        if language.name in PRINTERS:
            parts |= _printed(parts, language, prefix, written.real)
        found.append(parts)
    most = max(len(f["whole"]["outputs"]) for f in found)
    return {
        "duplications": DUPLICATIONS,
        "newton": NEWTON_STEPS,
        "most": most,
        "functions": found,
    }


def _printed(
    f: Mapping[str, Any], language: TargetLanguage, prefix: str, real: str
) -> dict[str, Any]:
    """What stands before a function, and its body."""
    lines: dict[str, list[str]] = {}
    given = {
        "DUPLICATIONS": DUPLICATIONS,
        "NEWTON_STEPS": NEWTON_STEPS,
        "SMALL_Y": float(-SMALL_Y),
        "CONVERGED": float(CONVERGED),
        "prefix": prefix,
        "real": real_of_work(language.name, language.reals[real]),
        "written": lines,
        "public": (),
        "generic": True,
    }
    source = Source()
    source.read(text_of("carlson").replace("METHOD", f["name"]), given)
    printer = PRINTERS[language.name](source, given)
    lines |= {part: [*_lines(f, part, printer)] for part in ("end", "back", "whole")}
    body = printer.body(source.routines[f["name"]])
    return {"before": printer.before, "body": "\n".join(body)}


def _lines(f: Mapping[str, Any], part: str, printer: Printer) -> Iterator[str]:
    """The statements of a part, and what is kept of what it computes."""
    yield from f[part]["statements"]
    outputs = f[part]["outputs"]
    if part == "end":
        value, *slopes = outputs
        if not f["second"]:
            yield printer.declared("value", REAL, value) + printer.end
        for name, x in zip(f["carried"], slopes, strict=True):
            yield printer.declared(name, Type("real", (), True), x) + printer.end
    elif part == "back":
        for name, x in zip(f["carried"], outputs, strict=True):
            yield printer.declared(f"next_{name}", REAL, x) + printer.end
        for name in f["carried"]:
            yield f"{name} = next_{name}{printer.end}"
