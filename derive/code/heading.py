"""The text of the comment at the head of a file, line by line."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

from ..language.rational import Matrix
from .languages import TargetLanguage
from .program import Program

BASIS = "State x and the basis E_a of the Lie algebra (e_ij: a single 1 in row i, column j):"


def heading(
    p: Program,
    language: TargetLanguage,
    parameters: Sequence[Mapping[str, str]],
    cost: Mapping[str, str],
) -> list[str]:
    """Conventions, state, basis, parameters, inputs and cost; empty lines between them.

    ``cost``: function → its operations in words; ``parameters``: name and text of each.
    """
    if p.on_torus:
        return [*p.conventions, "", *_costs(language, cost)]
    none = "" if p.parameters else " none, every number is in the code."
    return [
        *p.conventions,
        "",
        BASIS,
        *listed("  x = (", p.state, ")", 88),
        *(listed("  y = (", p.momenta, ")", 88) if p.momenta else ()),
        *(f"  {line}" for line in basis_lines(p)),
        "",
        f"Parameters p:{none}",
        *(
            f"  p[{i}] {x['name']}" + (f": {x['text']}" if x["text"] else "")
            for i, x in enumerate(parameters, language.first)
        ),
        *(["", *listed("Input u = (", p.inputs, ").", 84)] if p.inputs else ()),
        "",
        *_costs(language, cost, ", besides the frame" if p.framing else ""),
    ]


def _costs(language: TargetLanguage, cost: Mapping[str, str], besides: str = "") -> list[str]:
    """What the functions cost."""
    return [
        f"Operations: constants {cost['constants']}{besides};",
        f"            rhs{language.mutates} {cost['rhs']}; energy {cost['energy']}.",
    ]


def listed(before: str, names: Sequence[str], after: str, width: int) -> list[str]:
    """The names with commas between ``before`` and ``after``, wrapped and aligned."""
    lines = textwrap.wrap(", ".join(names), width, break_long_words=False)
    return (before + f"\n{' ' * len(before)}".join(lines) + after).split("\n")


def basis_lines(p: Program) -> list[str]:
    """E_1, E_2, … in one line each: the entries that are not zero, counted from 1."""
    sums = (" ".join(map("".join, signed_entries(e))) for e in p.basis)
    return [f"E_{a} = {text}" for a, text in enumerate(sums, 1)]


def signed_entries(m: Matrix) -> list[tuple[str, str]]:
    """The sign and the size of each entry that is not zero, as a multiple of e_ij."""
    return [
        ("+" if x > 0 else "-", f"{'' if abs(x) == 1 else f'{abs(x)} '}e_{i}{j}")
        for i, row in enumerate(m, 1)
        for j, x in enumerate(row, 1)
        if x
    ]
