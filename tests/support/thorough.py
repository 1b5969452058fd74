"""What a quick run leaves out: the long ones that try the tests themselves (mutations, forgeries),
random problems, and most cases of what has many.  ``make rest`` has a sixteenth of these, a case of
each test of which a quick run has none among them, ``make coverage`` half, ``make thorough`` all.
Which cases are run with the others, a hash of their names and of a seed says: at least one of each
language and of each other kind.

A test that is named on the command line, by its file or folder, is run whole, or by ``--quick`` as
in a quick run.

    pytest -n 2 --costs FOLDER; python -m tests.support.thorough FOLDER

measures the seconds of the processor of each test, and writes ``long.txt`` anew by these.
"""

import json
import re
import sys
from collections import Counter, defaultdict
from hashlib import sha256
from pathlib import Path
from random import Random

SEED = "1"
"""Of the choice, unless ``--seed`` has another: the same tree is tested alike."""

LIST = Path(__file__).with_name("long.txt")
"""Test, and how many of its cases are run with the others, and more where it has more kinds of
them: a second of the processor or so, none where one case takes longer.  A ``!`` behind: by hand,
for what ``make text`` asks, or where nothing else that is quick sees a fault of ``faults.toml``."""
ROWS = [x.split() for x in LIST.read_text(encoding="utf-8").splitlines()]
KEPT = {name: int(count) for name, count, *_ in ROWS}
BY_HAND = {name for name, _, *by_hand in ROWS if by_hand}
SECONDS, LONGEST = 1.0, 1.3
"""Of the processor: for all cases of a test, and for its only one."""

WORDS = (
    "c cpp python javascript rust julia jax gauss vern rk discrete left right plain quaternion "
    "tangent columns col header float attraction expression far_centre field gravity "
    "harmonic self_gravity spring torsion volume damping"
)
KINDS = frozenset(WORDS.split(" "))
"""What no test leaves out that has cases of it: languages, steps, forms of the state, energies."""
SPELT = {"g++": "cpp", "clang++": "cpp"}


def kinds(item):
    """The kinds that the name of a case has: ``so3-rust2021`` is one of Rust; what stands before a
    colon is its own kind, as in ``discrete: so3``."""
    case = item.nodeid.partition("[")[2].lower()
    words = re.split(r"[^\w+/.]+", case)
    plain = (x.rstrip("0123456789") for x in words)
    named = re.match(r"(\w+(?: of \w+)?): ", case)
    return (KINDS & {SPELT.get(x, x) for x in plain}) | ({named[1]} if named else set())


def chosen(cases, count, seed):
    """So many cases of a test by a hash, the first of each kind before the others; no kind is
    missing unless all are."""
    drawn = sorted(cases, key=lambda x: sha256(f"{seed} {x.nodeid}".encode()).digest())
    seen, first, rest = set(), [], []
    for case in drawn:
        (rest if kinds(case) <= seen else first).append(case)
        seen |= kinds(case)
    return [*first, *rest][: count and max(count, len(first))]


def share(items, n):
    """Every n-th one of some items, and the rest; for 0 none.  Of a test of which a quick run has
    no case it begins with the first, of others with the last of n: one case has been run."""
    seen, run, rest = Counter(), [], []
    for item in items:
        name = item.nodeid.removeprefix("tests/").partition("[")[0]
        first = n - 1 if KEPT.get(name) else 0
        (rest if n == 0 or seen[name] % n != first else run).append(item)
        seen[name] += 1
    return run, rest


def split(items, seed=SEED):
    """The items of pytest that are run, and those that are left."""
    cases = defaultdict(list)
    for item in items:
        cases[item.nodeid.removeprefix("tests/").partition("[")[0]].append(item)
    run = {x for name, own in cases.items() for x in chosen(own, KEPT.get(name, len(own)), seed)}
    return [x for x in items if x in run], [x for x in items if x not in run]


def shuffled(items, seed):
    """The items in an order by chance, those of one file one after the other."""
    order = Random(seed)
    files = defaultdict(list)
    for item in order.sample(items, len(items)):
        files[item.path].append(item)
    return [x for path in order.sample(sorted(files), len(files)) for x in files[path]]


def measured(folder):
    """The seconds of each case, by the files that the processes of a run with ``--costs`` left."""
    lines = [x for path in Path(folder).iterdir() for x in path.read_text().splitlines()]
    return dict(json.loads(x) for x in lines)


def counted(costs):
    """The rows of LIST by the costs of cases: what was left out of the run stays as it was."""
    cases = defaultdict(list)
    for case, seconds in costs.items():
        cases[case.removeprefix("tests/").partition("[")[0]].append(seconds)
    rows = dict(KEPT)
    for name, own in cases.items():
        each = sum(own) / len(own)
        if name in BY_HAND or sum(own) <= SECONDS:
            continue
        few = int(SECONDS // each) if each <= SECONDS else int(each <= LONGEST)
        rows[name] = min(few, KEPT.get(name, few))
    return rows


if __name__ == "__main__":
    found = sorted(counted(measured(sys.argv[1])).items())
    lines = (f"{name} {count}{' !' * (name in BY_HAND)}\n" for name, count in found)
    LIST.write_text("".join(lines), encoding="utf-8")
