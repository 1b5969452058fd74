"""What whole modules came to, kept from run to run: figures.json, beside this file.

A module is judged again when its text has changed, or all of them with ``--again``.
"""

import hashlib
import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from tests.support.engine_mutations.engine import source
from tests.support.engine_mutations.judge import Verdict
from tests.support.engine_mutations.known import reason
from tests.support.engine_mutations.operators import Mutant
from tests.support.steps import rows as written

FILE = Path(__file__).parent / "figures.json"


class Row(NamedTuple):
    """How many of each outcome, and the remarks."""

    outcomes: Counter[str]
    told: list[str]


def digest(module: str) -> str:
    """Of the text that is made wrong."""
    return hashlib.sha256(source(module).encode()).hexdigest()[:16]


def load() -> dict[str, Row]:
    """Each module that is as it was when it was judged whole."""
    text = FILE.read_text(encoding="utf-8") if FILE.exists() else "{}"
    return {
        module: Row(Counter(row["outcomes"]), row["told"])
        for module, row in json.loads(text).items()
        if row["digest"] == digest(module)
    }


def save(module: str, found: Iterable[tuple[Mutant, Verdict]]) -> None:
    """One more module judged whole."""
    rows = json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {}
    own = [(m, v) for m, v in found if m.module == module]
    rows[module] = {
        "digest": digest(module),
        "outcomes": dict(sorted(Counter(v.outcome for _, v in own).items())),
        "told": sorted(filter(None, (remark(*x) for x in own))),
    }
    FILE.write_text(written(dict(sorted(rows.items()))), encoding="utf-8")


def remark(m: Mutant, v: Verdict) -> str:
    """What a reader of the figures should see: what survived, and why, or leaves something out."""
    if v.outcome == "less":
        return f"says less: {m}: {v.why}"
    if v.outcome == "survived":
        return f"explained: {m}: {reason(m)}" if reason(m) else f"survived: {m}: {v.why}"
    return ""
