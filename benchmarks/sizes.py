"""How the cost of deriving and emitting grows with the group: SO(n) and SL(n), n = 2 … 8.

python -m benchmarks.sizes [rounds]
"""

from __future__ import annotations

import statistics
import sys
import tempfile
from pathlib import Path

from derive import Group, Moments, Problem, derive
from derive.code.assemble import assemble

from .road import seconds

GROUPS = [(family, n) for family in ("SO", "SL") for n in range(2, 9)]
AIM = 15.0
TEXT = 'name = "{name}"\ngroup = "{group}"\n[body]\nmoments = "symbolic"\n'


def operations(group: str) -> tuple[int, int, int]:
    """dim 𝔤 and the operations of constants and of rhs."""
    d = derive(Problem("size", Group(group), Moments()))
    assert d.problem.group is not None
    program = assemble(d.record, d.problem.group)
    counted = (program.functions["constants"], program.functions["rhs"])
    return (program.dimension, *(sum(f.operations().values()) for f in counted))  # type: ignore[return-value]


def main() -> None:
    """Print the table."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    times: dict[str, list[float]] = {}
    size = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(rounds):
            times.setdefault("import sympy", []).append(seconds(["-c", "import sympy"]))
            for family, n in GROUPS:
                name = f"{family}{n}".lower()
                path = Path(folder) / f"{name}.toml"
                path.write_text(TEXT.format(name=name, group=f"{family}({n})"), encoding="utf-8")
                command = ["-m", "derive", "emit", str(path), "--lang", "c", "--out", folder]
                times.setdefault(name, []).append(seconds(command))
                size[name] = len((Path(folder) / f"{name}.c").read_bytes())
    unit = statistics.median(times["import sympy"])
    print(f"derive + emit, whole process, over `import sympy` ({unit:.2f} s); aim {AIM:g}")
    print(f"{'group':8}{'dim':>4}{'constants':>11}{'rhs':>7}{'bytes of C':>12}{'s':>7}{'ratio':>7}")
    for family, n in GROUPS:
        name = f"{family}{n}".lower()
        t = statistics.median(times[name])
        d, constants, rhs = operations(f"{family}({n})")
        row = f"{family}({n})".ljust(8) + f"{d:4}{constants:11}{rhs:7}{size[name]:12}"
        print(f"{row}{t:7.2f}{t / unit:7.1f}")


if __name__ == "__main__":
    main()
