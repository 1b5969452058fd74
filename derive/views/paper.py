"""The findings about the paper's print, as text and as JSON."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Sequence

from ..record.paper import Finding

WIDTH = 100


def as_json(findings: Sequence[Finding]) -> str:
    """A list of objects, one for each numbered equation."""
    data = [
        {
            "number": f.number,
            "verdict": f.verdict,
            "printed": f.printed,
            "derived": f.derived,
            "counterexample": f.counterexample,
            "remark": f.remark or None,
        }
        for f in findings
    ]
    return json.dumps(data, ensure_ascii=False, indent=1) + "\n"


def as_text(findings: Sequence[Finding]) -> str:
    """One paragraph for each equation; corrections and counterexamples for the misprints."""
    lines = []
    for f in findings:
        lines.append(f"({f.number}) {f.verdict}")
        lines += _indented("printed  ", f.printed)
        if f.derived and f.verdict != "definition":
            lines += _indented("derived  ", f.derived)
        if f.counterexample:
            shown = ",  ".join(f"{k} = {v}" for k, v in f.counterexample.items())
            lines += _indented("at       ", shown)
        if f.remark:
            lines += _indented("remark   ", f.remark)
    counts = {
        v: sum(f.verdict == v for f in findings) for v in ("confirmed", "misprinted", "definition")
    }
    lines.append("")
    lines.append(
        f"{counts['confirmed']} confirmed, {counts['misprinted']} misprinted, "
        f"{counts['definition']} definitions"
    )
    return "\n".join(lines) + "\n"


def _indented(head: str, text: str) -> list[str]:
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=f"     {head}",
        subsequent_indent=" " * (5 + len(head)),
        break_long_words=False,
    )
