"""``python -m tests.fuzz.corpus``: the files of tests/corpus, and those too large for it."""

import json
import sys
import time
from pathlib import Path

from tests.fuzz.cases import COMMANDS, faults_of, own_faults, problem_files, record_faults, warm
from tests.fuzz.hostile import STRINGS
from tests.fuzz.mutate import at, paths, put, quoted, records
from tests.fuzz.watch import limited, slack

CORPUS = Path(__file__).parents[1] / "corpus"
SOME = ("text", "latex", "html", "json")
"""Commands for the files that are accepted; checking takes seconds, and each has checked steps."""
POINT = "[[point]]\nmass = 1\nat = [1, 0]\n"
TOP = f'name = "top"\ngroup = "SO(2)"\n{POINT}'
TURNED = """
name = "top"
group = "SO(2)"
title = {0}
[parameters]
k = {{ default = 1.0, unit = {0}, meaning = {0} }}
[[point]]
mass = "k"
at = [1, 0]
"""


def bombs():
    """Name → text of what grows, or nests, without bound."""
    long = "a" * 1_000_000
    keys = "".join(f"k{i} = 1\n" for i in range(100_000))
    return {
        "file.toml": TOP + "#" * 1_000_000,
        "name.toml": f'name = "{long[:900_000]}"\n{POINT}',
        "title.toml": f'name = "a"\ntitle = "{long[:900_000]}"\n{POINT}',
        "parameter.toml": f"{TOP}[parameters]\n{long[:900_000]} = 1\n",
        "expression.toml": TOP.replace("mass = 1", f'mass = "{long[:900_000]}"'),
        "file-name.toml": TOP.replace("2", "3")
        + f'[body]\nsolid = "mesh"\nfile = "{long[:900_000]}"',
        "keys.toml": keys[:900_000].rpartition("\n")[0] + "\n" + TOP,
        "parameters.toml": f"{TOP}[parameters]\n{keys[:900_000].rpartition(chr(10))[0]}\n",
        "dots.toml": TOP + "a." * 400_000 + "a = 1\n",
        "tables.toml": TOP + "[a]\n" * 200_000,
        "headers.toml": TOP + "".join(f"[a{i}.b.c.d.e.f]\n" for i in range(30_000)),
        "arrays.toml": TOP + "x = " + "[" * 400_000,
        "closed.toml": TOP + "x = " + "[" * 100_000 + "]" * 100_000,
        "inline.toml": TOP + "x = " + "{a=" * 100_000,
        "points.toml": TOP + POINT * 25_000,
        "potentials.toml": TOP + '[[potential]]\nkind = "gravity"\ng = [0, 1]\n' * 20_000,
        "floats.toml": TOP + "x = [" + "1e308," * 120_000 + "]\n",
        "basis.toml": f'name="b"\n{POINT}[group]\nname="B"\nbasis=[{"[[1]]," * 100_000}]',
        "quotes.toml": TOP + "x = '''" + "''" * 400_000,
        "digits.toml": TOP + "x = " + "9" * 800_000,
        "strings.toml": TOP + 'x = "' + "\\u202e" * 100_000 + '"\n',
        "arrays.json": "[" * 100_000,
        "objects.json": '{"a":' * 100_000,
        "closed.json": "[" * 100_000 + "]" * 100_000,
        "digits.json": "9" * 1_000_000,
        "keys.json": json.dumps({f"k{i}": i for i in range(100_000)}),
        "bytes.json": " " * 21_000_000,
    }


def long_records():
    """Name → text of a record of very many steps, or symbols."""
    record = records()[0]
    return {
        "steps.json": json.dumps({**record, "steps": record["steps"] * 2000}),
        "symbols.json": json.dumps({**record, "symbols": record["symbols"] * 20_000}),
    }


def limits():
    """What is just within the limits, and the dearest commands for it."""
    points = [f"[[point]]\nmass = {i % 7 + 1}\nat = [{i}, {i * i % 9}, 1]\n" for i in range(500)]
    turned = 'name = "top"\ngroup = "SO(3)"\n'
    force = '[[input]]\nkind = "force"\nname = "F{0}"\nat = [{0}, 1, 2]\n'
    solid = (
        '[[solid]]\nkind = "ellipsoid"\ndensity = 1\nsemi_axes = [{0}, 2, 3]\nshift = [{0}, 1, 0]\n'
    )
    solid += 'rotation = {{ axis = [1, 2, 2], angle = "{0}/7" }}\n'
    U = "*".join(f"(r{i}_x + {i})" for i in range(1, 50))
    product = f'[[potential]]\nkind = "expression"\nU = "{U}"\n'
    yield "points.toml", turned + "".join(points), ["html", "emit"]
    yield "inputs.toml", turned + "".join([*points[:4], *map(force.format, range(60))]), ["html"]
    yield "solids.toml", turned + "".join(map(solid.format, range(1, 13))), ["html", "emit"]
    yield "product.toml", turned + "".join(points[:50]) + product, ["html", "emit"]


def nodes():
    """A record with one node of another type, for every node."""
    record = records()[0]
    whole = {**record, "steps": record["steps"][:2], "symbols": record["symbols"][:1]}
    text = json.dumps({**whole, "steps": [{**x, "uses": []} for x in whole["steps"]]})
    for k, path in enumerate([x for x in paths(json.loads(text)) if x]):
        data = json.loads(text)
        others = [None, [], "x", 3, {}, -1, "t", [[]], True, "9" * 50]
        put(data, path, others[k % len(others)] if k % 3 else [at(data, path)])
        yield "/".join(map(str, path)), json.dumps(data)


def texts():
    """A problem with each hostile string where text is allowed, which every language gets."""
    for k, words in enumerate(STRINGS):
        yield f"text-{k:02}.toml", TURNED.format(quoted(words))


def main():
    """Print what is wrong; exit 1 if anything is."""
    limited()
    warm()
    start, found, count, usual = time.time(), [], 0, slack()

    def judge(name, content, commands, slow=usual):
        files, first = problem_files(name, content)
        wrong = faults_of(files, first, commands, slow)
        found.extend((name, *x) for x in wrong)
        return wrong

    for path in sorted(CORPUS.iterdir()):
        count, raw = count + 1, path.read_bytes()
        if path.suffix == ".json":
            judge(path.name, raw, ["check"])
            wrong = record_faults(raw.decode("utf-8", "replace"))
            found.extend((path.name, *x) for x in wrong)
            continue
        shown = path.name.startswith(("title", "meaning", "mesh-good"))
        judge(path.name, raw, SOME if shown else ["text"])
        if path.name.startswith("hand"):
            found.extend((path.name, *x) for x in own_faults({path.name: raw}, path.name))
    print(f"{count} files, {time.time() - start:.0f} s")
    for name, text in (bombs() | long_records()).items():
        count += 1
        judge(name, text, ["check"] if name.endswith(".json") else ["text", "emit"])
    print(f"{count} cases, {time.time() - start:.0f} s")
    for name, text, commands in limits():
        count += 1
        judge(name, text, commands, slack())
    print(f"{count} cases, {time.time() - start:.0f} s")
    for name, text in nodes():
        count += 1
        found.extend((name, *x) for x in record_faults(text))
    print(f"{count} cases, {time.time() - start:.0f} s")
    for name, text in texts():
        count += 1
        judge(name, text, ["every"])
    for fault in found:
        print(*fault, sep="  ")
    print(f"{count} cases, {len(found)} faults, {time.time() - start:.0f} s")
    assert {*SOME, "check", "every"} <= {*COMMANDS}
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
