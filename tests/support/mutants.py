"""Everything made wrong, once at a time: records, emitted programs, printers, rules of the engine,
and what is made wrong by hand.

Of records all kinds of :mod:`tests.support.refusals`.

python -m tests.support.mutants prints what is caught of each; exit 1 when something is not.
"""

import subprocess
import sys
from collections import Counter

from tests.support import faults, printing_mutations
from tests.support.refusals import TABLE
from tests.validate.test_validation import MUTATED, READ, tried


def records():
    """A row for each kind of change and each record; whether none of them is held."""
    print("change of record                          refused  of changes")
    fine = True
    for changes, names in TABLE.items():
        for name in names:
            held = [held() for _, held in changes(name)]
            shown = f"{changes.__name__} of {name}"
            print(f"{shown:40} {held.count(False):8} {len(held):11}", flush=True)
            fine = fine and not any(held)
    print()
    return fine


def programs():
    """A row for each emitted program; whether all changes of it are seen when it is read back."""
    print("program            caught  of changes  (and change nothing)")
    total = Counter()
    for name in MUTATED:
        for language in READ:
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
    fine = [records(), programs(), printing_mutations.main(), faults.main(), rules()]
    sys.exit(not all(fine))
