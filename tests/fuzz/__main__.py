"""``python -m tests.fuzz [CASES] [SEED]``: the cases with a fault are printed and kept.

Pieces of work go to as many processes as there are processors.
"""

import os
import re
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from tests.fuzz.cases import faults_of, own_faults, problem_files, record_faults, warm
from tests.fuzz.mutate import case
from tests.fuzz.watch import limited, slack

KEPT = Path("fuzz-faults")
PIECE = 500
"""Cases of one piece of work."""
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


def ready():
    """A process of 1 GB that has imported everything."""
    limited()
    warm()


def piece(work):
    """The cases of one piece: how many of each kind, what is wrong with some, which are kept."""
    seed, first, last = work
    slow, run, wrong = slack(), Counter(), []
    for k in range(first, last + 1):
        name, content, found = faults(seed, k, slow)
        run[name] += 1
        if found:
            KEPT.mkdir(exist_ok=True)
            raw = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
            Path(KEPT, f"{seed}-{k}-{name}").write_bytes(raw)
            wrong.append((f"case {k} {name}", [str(x)[:500] for x in found[:3]]))
    return run, wrong


def results(pieces):
    """What comes of each piece, as they end; one alone is done in this process."""
    if len(pieces) == 1:
        ready()
        yield piece(*pieces)
        return
    # an executor ends with an error where a multiprocessing.Pool waits for a process that has died
    with ProcessPoolExecutor(min(os.cpu_count() or 1, len(pieces)), initializer=ready) as pool:
        for done in as_completed([pool.submit(piece, work) for work in pieces]):
            yield done.result()


def main(cases, seed):
    """Count what was run; exit 1 when something was wrong."""
    run, wrong, seen, start = Counter(), 0, set(), time.time()
    pieces = [(seed, k, min(k + PIECE - 1, cases)) for k in range(1, cases + 1, PIECE)]
    for n, (counted, found) in enumerate(results(pieces), 1):
        run += counted
        wrong += len(found)
        for which, said in found:
            if (shape := re.sub("[0-9]+", "", said[0])[:80]) not in seen:
                print(f"{which}: {said}", flush=True)
            seen.add(shape)
        if n % 10 == 0:
            passed = time.time() - start
            print(f"{run.total()} cases, {wrong} with faults, {passed:.0f} s", flush=True)
    print(f"{dict(run)}: {wrong} with faults, {time.time() - start:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    CASES, SEED = (*map(int, sys.argv[1:]), *(1000, 1)[len(sys.argv) - 1 :])
    sys.exit(main(CASES, SEED))
