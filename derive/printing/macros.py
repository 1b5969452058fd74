"""The LaTeX of notes in macros, so that a preamble may restyle every symbol.

The other views keep standard commands; here each becomes a macro of ``derive.sty``, which the
notes contain and a lecturer's own preamble may change.
"""

from __future__ import annotations

import re
from functools import partial

from .notation import Notation

RENAMED = (
    (r"\\overline(?=\{)", r"\transposeof"),
    (r"\\operatorname\{Tr\}", r"\Tr"),
    (r"\\mathbf\{1\}", r"\unitmatrix"),
    (r"\\mathsf(?=\{)", r"\parameter"),
    (r"\\mathrm\{d\}", r"\dd"),
    (r"\\mathfrak\{g\}", r"\Liealgebra"),
    (r"\\mathfrak(?=\{)", r"\algebraof"),
    (r"\\varpi(?![A-Za-z])", r"\Cartanform"),
    (r"\\delta(?![A-Za-z])", r"\variation"),
    (r"\\tilde(?![A-Za-z])", r"\pulled"),
    (r"\\dot(?![A-Za-z])", r"\rate"),
)
INDEX = r"'*(?:_(?:\{[^{}]*\}|[A-Za-z0-9]))?'*"
BAR = re.compile(rf"\\bar(?:\{{((?:[^{{}}]|\{{[^{{}}]*\}})*)\}}|\s+([A-Za-z]))({INDEX})")
HAT = re.compile(r"\\hatmap\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}")
SKEW = re.compile(r"(?<![A-Za-z_\\{])j\(([^()]*)\)")

DEFINED = {
    "transpose": (
        2,
        {"bar": r"\bar{#1}#2", "top": r"{{#1#2}^{\top}}"},
        "the transpose of a letter, its prime or index",
    ),
    "transposeof": (
        1,
        {"bar": r"\overline{#1}", "top": r"{\left(#1\right)^{\top}}"},
        "the transpose of an expression",
    ),
    "hatmap": (1, {"j": "j(#1)", "wedge": r"{(#1)^{\wedge}}"}, "the skew matrix of a vector"),
    "Tr": (0, {"": r"\operatorname{Tr}"}, "the trace"),
    "unitmatrix": (0, {"": r"\mathbf{1}"}, "the identity"),
    "parameter": (1, {"": r"\mathsf{#1}"}, "a parameter of the problem"),
    "dd": (0, {"": r"\mathrm{d}"}, "the exterior derivative, a differential"),
    "Liealgebra": (0, {"": r"\mathfrak{g}"}, "the Lie algebra"),
    "algebraof": (1, {"": r"\mathfrak{#1}"}, "a classical Lie algebra"),
    "Cartanform": (0, {"": r"\varpi"}, "the Cartan form"),
    "variation": (0, {"": r"\delta"}, "a variation"),
    "pulled": (1, {"": r"\tilde{#1}"}, "pulled back to the group"),
    "rate": (1, {"": r"\dot{#1}"}, "the derivative along the motion"),
}
"""Macro → how many arguments, its definition for each notation, what it is for."""


def styled(tex: str) -> str:
    """Formulas, or a text with formulas between dollars, with macros in place of commands."""
    tex = re.sub(r"\$[^$]*\$", lambda m: SKEW.sub(r"\\hatmap{\1}", m[0]), tex)
    tex = BAR.sub(r"\\transpose{\1\2}{\3}", tex)
    for pattern, macro in RENAMED:
        tex = re.sub(rf"{pattern}(?=([A-Za-z])?)", partial(_renamed, macro), tex)
    return tex


def _renamed(macro: str, found: re.Match[str]) -> str:
    """The macro, followed by a space where a letter follows."""
    return f"{macro} " if found[1] else macro


def standard(tex: str) -> str:
    """Formulas with j(x) in place of the macro ``hatmap``: standard commands alone."""
    return HAT.sub(r"j(\1)", tex)


def definitions(notation: Notation) -> list[str]:
    """The definitions of the macros, a line each; one that a preamble has already stays."""
    chosen = {"transpose": notation.transpose, "transposeof": notation.transpose}
    chosen["hatmap"] = notation.hat
    lines = []
    for name, (count, bodies, meaning) in DEFINED.items():
        body, arguments = bodies[chosen.get(name, "")], f"[{count}]" if count else ""
        lines.append(rf"\providecommand{{\{name}}}{arguments}{{{body}}} % {meaning}")
    return lines
