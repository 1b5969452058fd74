"""How many equations each step of each ready-made problem has, in steps.json.

python -m tests.support.steps writes it.

A rule that leaves out what is true says nothing false: this table notices it.
"""

import json
from pathlib import Path

from tests.support.walks import ESTIMATES, FLUIDS, NAMES, OTHERS, record

TABLE = Path(__file__).with_name("steps.json")


def counted(name):
    """Label → equations."""
    return {step.label: len(step.equations) for step in record(name).steps}


def table():
    """Of all problems, with the number of steps; what they share stands with the first of them."""
    found, seen = {}, {}
    for name in dict.fromkeys((*NAMES, *OTHERS, *FLUIDS, *ESTIMATES)):
        counts = counted(name)
        own = {x: k for x, k in counts.items() if seen.get(x) != k}
        found[name] = {"steps": len(counts), **own}
        seen |= counts
    return found


def rows(found):
    """The JSON of a table, a row on a line."""
    shown = (f"{json.dumps(x)}: {json.dumps(row)}" for x, row in found.items())
    return "{\n" + ",\n".join(shown) + "\n}\n"


if __name__ == "__main__":
    TABLE.write_text(rows(table()), encoding="utf-8")
