"""The findings about the paper's print, as text and as JSON."""

from __future__ import annotations

import json
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from ..paper.finding import VERDICTS, Finding
from ..printing.line_breaking import WIDTH
from .language import ENGLISH, Language

TOTAL = (
    "{confirmed} confirmed, {sign} in another sign convention, {omission} with an omission, "
    "{misprint} misprinted, {definition} definitions"
)
HEADS = ("printed", "derived", "holds", "but for", "remark")


def as_json(findings: Sequence[Finding]) -> str:
    """The findings as JSON: a list of objects, one for each numbered equation."""
    data = [
        {
            "number": f.number,
            "verdict": f.verdict,
            "printed": f.printed,
            "derived": f.derived,
            "holds": f.holds,
            "counterexample": f.counterexample,
            "remark": f.remark or None,
        }
        for f in findings
    ]
    return json.dumps(data, ensure_ascii=False, indent=1) + "\n"


def as_text(findings: Sequence[Finding], language: Language = ENGLISH, width: int = WIDTH) -> str:
    """The findings as text, a paragraph each, its lines of ``width`` columns at most; what is false
    with its correction."""
    lines, word = [], language.word
    heads = [word(x) for x in HEADS]
    wide = max(map(len, heads))
    for f in findings:
        lines.append(f"({f.number}) {word(f.verdict)}")
        derived = f.derived if f.verdict != "definition" else None
        example = _example(f, language) if f.counterexample else None
        holds = word(f.holds) if f.holds else None
        texts = (f.printed, derived, holds, example, word(f.remark))
        for head, text in zip(heads, texts, strict=True):
            lines += _indented(f"{head:{wide}}  ", text, width) if text else []
    counts = Counter(f.verdict for f in findings)
    numbers = {x.split()[0]: str(counts[x]) for x in VERDICTS}
    return "\n".join([*lines, "", *textwrap.wrap(word(TOTAL, **numbers), width)]) + "\n"


def _example(f: Finding, language: Language) -> str:
    """The values at which a printed equation is false, and its two sides there."""
    *point, (_, left), (_, right) = (f.counterexample or {}).items()
    values = ",  ".join(" = ".join(x) for x in grouped(point))
    template = "{values}: the left side is {left}, the printed right side {right}"
    return language.word(template, values=values, left=left, right=right)


def grouped(values: Iterable[tuple[str, str]]) -> Iterator[tuple[str, ...]]:
    """Names and their values; names that are 0, or 1, together before that value."""
    together: dict[str, list[str]] = {"1": [], "0": []}
    others = []
    for name, value in values:
        short = _short(value)
        together.get(short, []).append(name)
        if short not in together:
            others.append((name, value))
    yield from others
    yield from ((*equal, value) for value, equal in together.items() if equal)


def _short(value: str) -> str:
    """0 or 1 for a matrix that is zero or the identity; else the value."""
    if not value.startswith("["):
        return value
    rows = [row.split(", ") for row in value[1:-1].split("; ")]
    if all(x == "0" for row in rows for x in row):
        return "0"
    square = all(len(row) == len(rows) for row in rows)
    one = [["1" if i == j else "0" for j in range(len(rows))] for i in range(len(rows))]
    return "1" if square and rows == one else value


def _indented(head: str, text: str, width: int) -> list[str]:
    return textwrap.wrap(
        text,
        width,
        initial_indent=f"     {head}",
        subsequent_indent=" " * (5 + len(head)),
        break_long_words=False,
    )
