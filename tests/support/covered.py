"""The coverage of derive/ that was measured: tests.support.covered LINES BRANCHES FILE ...

Lists the lines and branches that no test runs in any of the runs whose figures are in the files of
SlipCover; exit 1 when those that are run are fewer than so many percent.
"""

import json
import sys
from collections import defaultdict
from pathlib import Path


def runs(lines):
    """1, 2, 3, 7 as "1-3 7"."""
    found = []
    for line in lines:
        if found and found[-1][1] == line - 1:
            found[-1][1] = line
        else:
            found.append([line, line])
    return " ".join(f"{a}-{b}" if b > a else f"{a}" for a, b in found)


def together(measured):
    """For each file what is run in one of the measured runs, and all that there is."""
    run, every = defaultdict(set), defaultdict(set)
    for name, found in (x for one in measured for x in one["files"].items()):
        for kind in ("lines", "branches"):
            executed = {*map(hashable, found[f"executed_{kind}"])}
            run[name, kind] |= executed
            every[name, kind] |= executed | {*map(hashable, found[f"missing_{kind}"])}
    return run, every


def hashable(place):
    """A line, or a branch: from line, to line (0: the end of a function)."""
    return tuple(place) if isinstance(place, list) else place


def missing(run, every):
    """For each file its lines that no test runs, and the branches from lines that one does."""
    for name in sorted({name for name, _ in every}):
        lines = every[name, "lines"] - run[name, "lines"]
        branches = sorted(every[name, "branches"] - run[name, "branches"])
        jumps = " ".join(f"{a}→{b or 'exit'}" for a, b in branches if a not in lines)
        if lines or jumps:
            yield f"{name}: {runs(sorted(lines))}{'  branches ' + jumps if jumps else ''}"


def main(of_lines, of_branches, *paths):
    """Print the figures; whether both are at least what is wanted."""
    run, every = together([json.loads(Path(x).read_text(encoding="utf-8")) for x in paths])
    print("Not run by any test:", *missing(run, every), sep="\n  ")
    enough = True
    for kind, wanted in (("lines", float(of_lines)), ("branches", float(of_branches))):
        count = sum(len(x) for (_, of), x in run.items() if of == kind)
        whole = sum(len(x) for (_, of), x in every.items() if of == kind)
        print(f"{100 * count / whole:.2f} % of {whole} {kind}; at least {wanted:g} % are wanted")
        enough &= 100 * count >= wanted * whole
    return enough


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
