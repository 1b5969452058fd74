"""The list of groups and ready-made problems that ``derive list`` prints."""

from __future__ import annotations

from collections.abc import Mapping

from ..algebra.families import FAMILIES
from ..problem.problem import Problem


def listing(problems: Mapping[str, Problem]) -> str:
    """The text of the list: groups with their sizes, then problems by name."""
    lines = ["groups"]
    for name, family in FAMILIES.items():
        sizes = f"n = {family.least} … {family.most}"
        lines.append(f"  {name + '(n)':8} {sizes}  {family.meaning}")
    lines.append('  products of these, "SO(3) x SE(3)", and any group given by a basis')
    lines.append("problems")
    groups = {name: p.group_name for name, p in problems.items()}
    widest, wider = (max(map(len, x)) for x in (groups, groups.values()))
    for name, p in problems.items():
        lines.append(f"  {name:{widest}}  {groups[name]:{wider}}  {p.title}")
    return "\n".join(lines)
