"""Make each rule of the engine wrong, once at a time: python -m tests.support.engine_mutations."""

import argparse
import os
import sys
import time
from pathlib import Path

from tests.support.engine_mutations.jobs import JOBS
from tests.support.engine_mutations.judge import Verdict
from tests.support.engine_mutations.operators import Mutant
from tests.support.engine_mutations.run import MODULES, Survey, chosen, results
from tests.support.engine_mutations.table import counted, line, remark, table
from tests.support.engine_mutations.table import told as judged_before


def main() -> int:
    """0 when all are caught."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.support.engine_mutations", description=__doc__
    )
    parser.add_argument("modules", nargs="*", metavar="MODULE", help="like walk/spine/cartan.py")
    parser.add_argument("--sample", type=int, help="so many mutants, in place of all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    parser.add_argument(
        "--out",
        type=Path,
        help="file of all verdicts; those it has from before are not sought again",
    )
    args = parser.parse_args()
    modules = args.modules or MODULES
    if unknown := {*modules} - {*MODULES}:
        parser.error(f"not among the modules: {', '.join(sorted(unknown))}")
    start = time.monotonic()
    found = run(modules, args, start)
    print(table(counted(found)))
    told = [*filter(None, (remark(*x) for x in found))]
    print("\n".join(told))
    return int(any(x.startswith("survived") for x in told))


def run(modules: list[str], args: argparse.Namespace, start: float) -> list[tuple[Mutant, Verdict]]:
    """All mutants of some modules, each with its verdict."""
    survey = Survey(modules, JOBS)
    mutants = chosen(modules, args.sample, args.seed)
    before = args.out.read_text(encoding="utf-8") if args.out and args.out.exists() else ""
    found, mutants = judged_before(before.split("\n")[:-1], mutants)
    print(
        f"{len(survey.jobs)} problems surveyed, {time.monotonic() - start:.0f} s", file=sys.stderr
    )
    for k, result in enumerate(results(mutants, survey, args.processes), 1):
        found.append(result)
        if args.out:
            with args.out.open("a", encoding="utf-8") as out:
                print(line(*result), file=out)
        if k % 50 == 0 or k == len(mutants):
            print(f"{k} of {len(mutants)}, {time.monotonic() - start:.0f} s", file=sys.stderr)
    return found


if __name__ == "__main__":
    sys.exit(main())
