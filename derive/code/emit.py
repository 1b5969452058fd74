"""Files from programs: fields for the templates, and writing without half-written files."""

from __future__ import annotations

import hashlib
import json
import re
from typing import Any

from .. import __version__
from ..record.record import Derivation
from ..templating import environment
from .naming import RESERVED
from .printers import PYTHON, Printer, c_printer, wrapped
from .program import TOLERANCE, Check, Function, Program

LANGUAGES = {"c": (".h", ".c"), "python": (".py",)}
TEXT = 96


class EmitError(ValueError):
    """A prefix or an option that cannot be emitted: the message says what to do."""


def emit(
    program: Program, d: Derivation, languages: tuple[str, ...], prefix: str, real: str = "double"
) -> dict[str, str]:
    """File name → text, for each language; ``EmitError`` for a prefix that is no name."""
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,63}", prefix) or prefix in RESERVED:
        raise EmitError(
            f"the prefix {prefix[:40]!r} cannot be used: give --prefix NAME, letters, digits and "
            "_, starting with a letter, at most 64, and no word that the emitted code needs"
        )
    files = {}
    for language in languages:
        templates = environment(language)
        printer = PYTHON if language == "python" else c_printer(real)
        fields = _fields(program, d, prefix, real, printer, language)
        for suffix in LANGUAGES[language]:
            template = templates.get_template(f"problem{suffix}.jinja")
            files[prefix + suffix] = template.render(fields)
    return files


def problem_hash(d: Derivation) -> str:
    """A short hash of the problem as the record states it."""
    data = json.dumps(dict(d.problem), sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(data.encode()).hexdigest()[:16]


def _fields(
    p: Program, d: Derivation, prefix: str, real: str, printer: Printer, language: str
) -> dict[str, Any]:
    return {
        "prefix": prefix,
        "guard": prefix.upper() + "_H",
        "real": real,
        "fabs": "fabsf" if real == "float" else "fabs",
        "title": comment(p.title),
        "group": p.group,
        "conventions": p.conventions,
        "version": __version__,
        "hash": problem_hash(d),
        "state": p.state,
        "inputs": p.inputs,
        "input_locals": [x.name for x in p.rhs.loads if x.array == "u"],
        "constants": p.constants,
        "dimension": p.dimension,
        "parameters": [_parameter(x) for x in p.parameters],
        "parameter_names": [x[0] for x in p.parameters],
        "turning": p.turning,
        "affine": "w_1" in p.state,
        "basis": _basis(p),
        "basis_lines": _basis_lines(p),
        "functions": {
            "constants": _function(p.compute_constants, printer, language),
            "rhs": _function(p.rhs, printer, language),
            "energy": _function(p.energy, printer, language),
            "inertia": p.inertia and _function(p.inertia, printer, language),
        },
        "tolerance": repr(TOLERANCE[real]) + ("f" if real == "float" else ""),
    }


def comment(text: str) -> str:
    """Text that is safe inside a comment or a docstring of any language."""
    plain = "".join(ch if ch.isprintable() else " " for ch in text)
    return plain.replace("*/", "* /").replace("/*", "/ *").replace('"""', "'''").replace("\\", "/")


def _parameter(x: tuple[str, float | None, str, str]) -> dict[str, str]:
    name, default, unit, meaning = x
    words = [comment(meaning), f"[{comment(unit)}]" if unit else ""]
    words.append(f"default {default!r}" if default is not None else "")
    return {"name": name, "text": ", ".join(w for w in words if w)}


def _basis(p: Program) -> list[list[list[str]]]:
    def text(x: Any) -> str:
        return str(int(x)) if x.denominator == 1 else f"{x.numerator}/{x.denominator}"

    return [[[text(x) for x in row] for row in e] for e in p.basis]


def _basis_lines(p: Program) -> list[str]:
    """E_1, E_2, … in one line each: the entries that are not zero, counted from 1."""
    lines = []
    for a, e in enumerate(p.basis, 1):
        entries = [
            f"{'+' if x > 0 else '-'}{'' if abs(x) == 1 else str(abs(x)) + ' '}e_{i}{j}"
            for i, row in enumerate(e, 1)
            for j, x in enumerate(row, 1)
            if x
        ]
        lines.append(f"E_{a} = {' '.join(entries)}")
    return lines


def _function(f: Function, printer: Printer, language: str) -> dict[str, Any]:
    ops = f.operations()
    return {
        "loads": [
            {"name": x.name, "array": x.array, "index": x.index} for x in f.loads if x.array != "t"
        ],
        "arrays": sorted({x.array for x in f.loads}),
        "sections": [
            {
                "label": s.label.partition("#")[0],
                "equation": comment(_shortened(s.equation)),
                "operations": _operations(Function((), (s,), ())),
                "statements": [
                    _statement(v.name, printer(v.expression), language) for v in s.values
                ],
            }
            for s in f.sections
        ],
        "outputs": [printer(e) for e in f.outputs],
        "checks": [_check(c, printer) for c in f.checks],
        "operations": _operations(f),
        "multiplications": ops["mul"],
    }


def _operations(f: Function) -> str:
    ops = f.operations()
    return ", ".join(f"{n} {name}" for name, n in ops.items() if n) or "none"


def _shortened(text: str) -> str:
    return text if len(text) <= 200 else text[:197] + "..."


def _statement(name: str, text: str, language: str) -> dict[str, str]:
    if language == "c":
        return {"name": name, "text": wrapped(text, TEXT - 20 - len(name), " " * 8)}
    long = len(text) + len(name) > TEXT - 8
    body = wrapped(text, TEXT - 10, " " * 8)
    return {"name": name, "text": f"(\n        {body}\n    )" if long else text}


def _check(c: Check, printer: Printer) -> dict[str, str]:
    scale = printer(c.scale) if c.scale is not None else ""
    return {"value": printer(c.value), "scale": f"({scale})" if "+" in scale else scale}
