"""The steps behind the ticks of a page: each once, as a walk shows it, with what tells that it
holds and the calculations that end in it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ..check.checker import verdicts
from ..check.form.hypotheses_checked import Verdict
from ..language.show import show
from ..record.record import Derivation
from ..views.html import articles, escaped
from ..views.language import Language
from ..views.layout import as_read
from ..views.rendering import corrections
from .back_matter import printing, sources
from .lecture_text import Chapter, LectureError

HOLDS = (
    "Checked: its equations hold at random exact points; a false one passes with probability "
    "below {bound}."
)
CHECKED_BY = "To check it: {commands}"


def judged(
    chapters: Sequence[Chapter], records: Mapping[str, Derivation], seed: int | None = None
) -> dict[str, Verdict]:
    """The verdicts on the steps that ticks name; ``LectureError`` for one that does not hold."""
    homes, found = sources(chapters, records), dict[str, Verdict]()
    for name in dict.fromkeys(key for key, _ in homes.values()):
        labels = {x for x, (key, _) in homes.items() if key == name}
        of_steps = (v for v in verdicts(records[name], seed, labels) if v.of == "equation")
        found |= {v.label: v for v in of_steps}
    for v in found.values():
        if not v.holds:
            raise LectureError(f"{v.label} does not hold: {v.reason}")
    return found


def ticked(
    chapters: Sequence[Chapter],
    records: Mapping[str, Derivation],
    language: Language,
    judgements: Mapping[str, Verdict],
    calculations: Mapping[str, Sequence[str]],
) -> str:
    """The markup of the steps, in the order of the text; ``judgements``: those that are known;
    ``calculations``: label → links to those that end in this step."""
    behind = {}
    for label, (_, called) in sources(chapters, records).items():
        found = judgements.get(label)
        told = _verdict(found, language) if found else _command(called, language)
        lines = [told, *calculations.get(label, ())]
        behind[label] = "".join(f'<p class="check">{x}</p>\n' for x in lines)
    read = [*map(as_read, records.values())]
    return articles(read, behind, language, corrections(read))


def _verdict(v: Verdict, language: Language) -> str:
    """That a step holds, and how likely a false one is to pass."""
    power = show(("pow", 10, math.ceil(math.log10(v.bound))))
    return "✓ " + escaped(language.word(HOLDS, bound=power))


def _command(called: str, language: Language) -> str:
    """The command that checks the steps of a record; what is found of a problem is saved first."""
    problem, _, search = called.partition(":")
    typed = [f"derive check {problem}"]
    if search:
        file = f"{problem}_{search}.json"
        typed = [f"{printing(called)} --format json --out {file}", f"derive check {file}"]
    commands = ", ".join(f"<code>{escaped(x)}</code>" for x in typed)
    return escaped(language.word(CHECKED_BY)).format(commands=commands)
