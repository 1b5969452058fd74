"""Make each rule of the engine wrong, once at a time: python -m tests.engine_mutations."""

import argparse
import os
import sys
import time
from pathlib import Path

from tests.engine_mutations import known
from tests.engine_mutations.jobs import JOBS
from tests.engine_mutations.run import MODULES, Survey, chosen, results
from tests.engine_mutations.table import counted, line, table


def main() -> int:
    """0 when all are caught but those that are explained."""
    parser = argparse.ArgumentParser(prog="python -m tests.engine_mutations", description=__doc__)
    parser.add_argument("modules", nargs="*", metavar="MODULE", help="like walk/cartan.py")
    parser.add_argument("--sample", type=int, help="so many mutants, in place of all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=Path, help="every mutant with its verdict is appended to it")
    args = parser.parse_args()
    modules = args.modules or MODULES
    if unknown := {*modules} - {*MODULES}:
        parser.error(f"not among the modules: {', '.join(sorted(unknown))}")
    start = time.monotonic()
    survey = Survey(modules, JOBS)
    mutants = chosen(modules, args.sample, args.seed)
    print(
        f"{len(survey.jobs)} problems surveyed, {time.monotonic() - start:.0f} s", file=sys.stderr
    )
    found = []
    for k, result in enumerate(results(mutants, survey, args.processes), 1):
        found.append(result)
        if args.out:
            with args.out.open("a", encoding="utf-8") as out:
                print(line(*result), file=out)
        if k % 50 == 0 or k == len(mutants):
            print(f"{k} of {len(mutants)}, {time.monotonic() - start:.0f} s", file=sys.stderr)
    print(table(counted(found)))
    for m, v in found:
        if v.outcome == "less":
            print(f"says less: {m}: {v.why}")
    left = [(m, v) for m, v in found if v.outcome == "survived"]
    explained = [x for x in left if known.reason(x[0])]
    for m, v in left:
        print(f"survived: {m}: {known.reason(m) or v.why}")
    return int(len(left) > len(explained))


if __name__ == "__main__":
    sys.exit(main())
