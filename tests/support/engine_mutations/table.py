"""The figures of a run: a row for each module, and what survived."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping

from tests.support.engine_mutations.judge import CAUGHT, HARMLESS, LATE, Verdict
from tests.support.engine_mutations.operators import Mutant

COLUMNS = ("not reached", *HARMLESS, *CAUGHT, "survived")
HEAD = """\
not reached: no problem that is tried runs the line; same: nothing changes; words: names, prose or
units alone; code: another, equal to the record and to the oracle; equations: others, proved true;
less: fewer, each true, and the code is right
caught: crashed or refused in the derivation, hung (time), a mistake in a file not told (refusal),
refused by the checker, unequal to the oracle (Gauss's principle), or to the record when the code is
read back (validator)
"""


def counted(found: Iterable[tuple[Mutant, Verdict]]) -> dict[str, Counter[str]]:
    """How many of each outcome, for every module."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for mutant, verdict in found:
        counts[mutant.module][verdict.outcome] += 1
    return counts


def wrong(row: Counter[str]) -> tuple[int, int]:
    """Caught, and how many there were to catch."""
    caught = sum(row[x] for x in CAUGHT)
    return caught, caught + row["survived"]


def table(counts: Mapping[str, Counter[str]]) -> str:
    """The rows, and their sum."""
    total = sum(counts.values(), Counter[str]())
    wide = max([8, *map(len, counts)])
    lines = [HEAD, f"{'module':{wide}}   all  " + "  ".join(COLUMNS) + "  caught"]
    for name, row in [*sorted(counts.items()), ("together", total)]:
        cells = "  ".join(f"{row[x]:{len(x)}}" for x in COLUMNS)
        caught, whole = wrong(row)
        lines.append(f"{name:{wide}} {row.total():5}  {cells}  {caught}/{whole}")
    loud = sum(total[x] for x in CAUGHT if x not in ("crashed", "refused", "time"))
    lines.append("")
    lines.append(f"{'/'.join(map(str, wrong(total)))} caught, {loud} of them by what they compute")
    return "\n".join(lines)


def line(mutant: Mutant, verdict: Verdict) -> str:
    """A mutant with its verdict and the reason."""
    return f"{verdict.outcome}\t{mutant}\t{verdict.why}".replace("\n", " ")


def told(
    lines: Iterable[str], mutants: Iterable[Mutant]
) -> tuple[list[tuple[Mutant, Verdict]], list[Mutant]]:
    """Those with a verdict in some lines, and the others; no verdict in time is none."""
    known: dict[str, list[Verdict]] = defaultdict(list)
    for outcome, what, why in (x.rstrip("\n").split("\t", 2) for x in lines):
        if why != LATE:
            known[what].append(Verdict(outcome, why))
    found, left = [], []
    for m in mutants:
        if verdicts := known[str(m).replace("\n", " ")]:
            found.append((m, verdicts.pop()))
        else:
            left.append(m)
    return found, left


def remark(m: Mutant, v: Verdict) -> str:
    """What a reader of the figures should see: what survived, or leaves something out."""
    heads = {"less": "says less", "survived": "survived"}
    return f"{heads[v.outcome]}: {m}: {v.why}" if v.outcome in heads else ""
