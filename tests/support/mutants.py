"""Everything made wrong, once at a time: records, emitted programs, printers, rules of the engine,
and what is made wrong by hand.

Of records the equations, and the heads, arguments, indices, quantifiers and headers.

python -m tests.support.mutants prints what is caught of each; exit 1 when something is not.
"""

import subprocess
import sys
from collections import Counter

from derive.check.checker import Checker, checker_of
from derive.record.contract import ANY_GROUP
from tests.support import faults, printing_mutations, record_forgeries, record_mutations
from tests.support.walks import FLUIDS, NAMES, OTHERS, SEED, record
from tests.validate.test_validation import MUTATED, tried

TEXTS = ("linear", "affine")
"""Whose steps about any group are those of the others."""


COMMUTES = {"screw": 6}
"""A group of dimension 1: its ξ, ξ′ and Z are multiples of one matrix, so more terms cancel."""


def records():
    """A row for each record; whether all changes of its steps are refused, but for true ones.

    What is true of a special body is false of its twin in general position, which has a row, too.
    """
    print("record              steps  refused  true of it  of changes")
    total, fine = Counter(), True
    for name in dict.fromkeys((*NAMES, *OTHERS, *FLUIDS)):
        special = COMMUTES.get(name, 0)
        rows = {name: record(name)}
        if name in record_mutations.TWINS:
            rows[f"{name}, moved"] = record_mutations.twin(name)
        for shown, d in rows.items():
            steps = [s for s in d.steps if name in TEXTS or s.scope != ANY_GROUP]
            checker = checker_of(d.problem, SEED)
            holds = [v.holds for s in steps for _, _, v in record_mutations.tried(s, checker)]
            refused, true = holds.count(False), holds.count(True)
            total.update(steps=len(steps), refused=refused, true=true, all=len(holds))
            print(f"{shown:17} {len(steps):7} {refused:8} {true:11} {len(holds):11}", flush=True)
        fine = fine and true == special
    row = (total[x] for x in ("steps", "refused", "true", "all"))
    print("{:17} {:7} {:8} {:11} {:11}\n".format("together", *row))
    return fine


def forgeries():
    """A row for each record; whether all that has no meaning, or is not so, is refused."""
    print("record           forged  refused")
    fine = True
    for name in dict.fromkeys((*NAMES, *OTHERS)):
        d = record(name)
        steps = [s for s in d.steps if name in TEXTS or s.scope != ANY_GROUP]
        checker = Checker(d.problem, SEED)
        held = [v.holds for s in steps for *_, v in record_forgeries.tried(s, checker)]
        held += [record_forgeries.read_and_held(data) for _, data in record_forgeries.headers(d)]
        print(f"{name:16} {len(held):6} {held.count(False):8}", flush=True)
        fine = fine and not any(held)
    print()
    return fine


def programs():
    """A row for each emitted program; whether all changes of it are seen when it is read back."""
    print("program            caught  of changes  (and change nothing)")
    total = Counter()
    for name in MUTATED:
        for language in ("c", "python"):
            _, whole, same, passed = tried(name, language)
            total.update(caught=whole - len(passed), all=whole, same=same)
            shown = f"{name}, {language}"
            print(f"{shown:16} {whole - len(passed):8} {whole:11} {same:11}", flush=True)
    print(f"{'together':16} {total['caught']:8} {total['all']:11} {total['same']:11}\n")
    return total["caught"] == total["all"]


def rules():
    """The rules of the engine, by a process that has changed nothing yet."""
    command = [sys.executable, "-m", "tests.support.engine_mutations", *sys.argv[1:]]
    return subprocess.run(command).returncode == 0


if __name__ == "__main__":
    fine = [records(), forgeries(), programs(), printing_mutations.main(), faults.main(), rules()]
    sys.exit(not all(fine))
