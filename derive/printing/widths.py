"""The width of a LaTeX formula, estimated well enough to choose where its lines break."""

from __future__ import annotations

import re
from functools import lru_cache

WIDTHLESS = "bar|overline|tilde|dot|hat|mathrm|mathsf|mathbf|operatorname|text|textsf|ensuremath"
WIDTHS = (
    (r"\\(?:begin|end)\{[a-z]+\}(?:\{[^{}]*\{\}[^{}]*\{\}\})?", 0.6),
    (rf"\\(?:{WIDTHLESS})(?![A-Za-z])", 0),
    (r"\\[td]?frac(?![A-Za-z])", 0.3),
    (r"\\(?:langle|rangle)(?![A-Za-z])|[()\[\]]", 0.4),
    (r"\\[lr]?Vert(?![A-Za-z])", 0.52),
    (r"\\wedge(?![A-Za-z])|\\cdot(?![A-Za-z])", 1.15),
    (r"\\sum(?![A-Za-z])", 1.7),
    (r"\\(?:quad|qquad)(?![A-Za-z])", 1.5),
    (r"\\,", 0.17),
    (r"\\(?:det|hatmap|sin|cos|tan|exp|log)(?![A-Za-z])", 1.5),
    (r"\\(?:sinh|cosh|tanh|arctan)(?![A-Za-z])", 2.2),
    (r"\\[a-z]+", 0.62),
    (r"\\[A-Z][A-Za-z]*|\\\\|[A-Z]", 0.78),
    (r"[mw]", 0.85),
    (r"[a-z0-9]", 0.53),
    (r" [+-] |[+-](?=[^}])", 1.25),
    (r"[=&]", 1.35),
    (r"[,;]", 0.46),
    (r"[']", 0.32),
    (r"[{}\s^_]", 0),
    (r".", 0.7),
)  # fmt: skip
WIDTH = re.compile("|".join(f"({pattern})" for pattern, _ in WIDTHS), re.S)
SCRIPT = re.compile(r"[_^](?:\{((?:[^{}]|\{[^{}]*\})*)\}|(\\[A-Za-z]+|[^{\\]))")


MATRIX = re.compile(r"\\begin\{pmatrix\}(.*?)\\end\{pmatrix\}", re.S)


@lru_cache(4096)  # terms in terms are measured again at every depth
def measure(tex: str) -> float:
    """The estimated width of a formula in em; rather too wide than too narrow."""
    wide = sum(
        1.8 + max(map(measure, re.split(r" \\\\(?:\[2pt\])? ", m[1]))) for m in MATRIX.finditer(tex)
    )
    tex = MATRIX.sub("", tex)
    small = sum(measure(m[1] or m[2] or "") for m in SCRIPT.finditer(tex))
    tex = SCRIPT.sub("", tex)
    rest = sum(WIDTHS[(m.lastindex or 1) - 1][1] for m in WIDTH.finditer(tex))
    return wide + 0.72 * small + rest
