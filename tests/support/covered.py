"""The coverage of derive/ that was measured: python -m tests.support.covered LINES BRANCHES.

Lists the lines and branches that no test runs; exit 1 when they are fewer than so many percent.
"""

import json
import sys
from pathlib import Path

FIGURES = Path("build/coverage/figures.json")


def runs(lines):
    """1, 2, 3, 7 as "1-3 7"."""
    found = []
    for line in lines:
        if found and found[-1][1] == line - 1:
            found[-1][1] = line
        else:
            found.append([line, line])
    return " ".join(f"{a}-{b}" if b > a else f"{a}" for a, b in found)


def missing(files):
    """For each file its lines that no test runs, and the branches from lines that one does."""
    for name, found in sorted(files.items()):
        lines = {*found["missing_lines"]}
        branches = [(a, b) for a, b in found["missing_branches"] if a not in lines]
        if lines or branches:
            jumps = " ".join(f"{a}→{b if b > 0 else 'exit'}" for a, b in branches)
            yield f"{name}: {runs(sorted(lines))}{'  branches ' + jumps if jumps else ''}"


def main(of_lines, of_branches, path=FIGURES):
    """Print the figures; whether both are at least what is wanted."""
    measured = json.loads(path.read_text(encoding="utf-8"))
    print("Not run by any test:", *missing(measured["files"]), sep="\n  ")
    totals = measured["totals"]
    lines = 100 * totals["covered_lines"] / totals["num_statements"]
    branches = 100 * totals["covered_branches"] / totals["num_branches"]
    print(
        f"{lines:.2f} % of {totals['num_statements']} lines, "
        f"{branches:.2f} % of {totals['num_branches']} branches; "
        f"at least {of_lines:g} % and {of_branches:g} % are wanted"
    )
    return lines >= of_lines and branches >= of_branches


if __name__ == "__main__":
    sys.exit(not main(*map(float, sys.argv[1:])))
