"""``python -m tests.fuzz [CASES] [SEED]``: the cases with a fault are printed and kept."""

import re
import sys
import time
from collections import Counter
from pathlib import Path

from tests.fuzz.cases import faults_of, own_faults, problem_files, record_faults, warm
from tests.fuzz.mutate import case
from tests.fuzz.watch import limited, slack

KEPT = Path("fuzz-faults")
WEIGHTS = {
    "text": 50, "emit": 14, "latex": 8, "html": 6, "json": 8, "markdown": 4, "french": 4,
    "notes": 2, "others": 2, "framed": 1, "check": 1, "own": 12,
}  # fmt: skip


def faults(seed, k, slow):
    """Kind, content and faults of a case: one command of a problem, every view of a record."""
    name, content, random = case(seed, k)
    if name.endswith(".json"):
        return name, content, record_faults(content)
    command = random.choices([*WEIGHTS], [*WEIGHTS.values()])[0]
    if command == "own":
        return name, content, own_faults(*problem_files(name, content))
    return name, content, faults_of(*problem_files(name, content), [command], slow)


def main(cases, seed):
    """Count what was run; exit 1 when something was wrong."""
    limited()
    run, wrong, seen = Counter(), 0, set()
    start, slow = time.time(), slack()
    warm()
    for k in range(1, cases + 1):
        name, content, found = faults(seed, k, slow)
        run[name] += 1
        if found:
            wrong += 1
            KEPT.mkdir(exist_ok=True)
            raw = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
            Path(KEPT, f"{k}-{name}").write_bytes(raw)
            if (shape := re.sub("[0-9]+", "", str(found[0]))[:80]) not in seen:
                print(f"case {k} {name}: {str(found[:3])[:500]}", flush=True)
            seen.add(shape)
        if k % 5000 == 0:
            slow = slack()
            print(f"{k} cases, {wrong} with faults, {time.time() - start:.0f} s", flush=True)
    print(f"{dict(run)}: {wrong} with faults, {time.time() - start:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    CASES, SEED = (*map(int, sys.argv[1:]), *(1000, 1)[len(sys.argv) - 1 :])
    sys.exit(main(CASES, SEED))
