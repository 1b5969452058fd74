"""``python -m tests.fuzz.corpus``: the files of tests/corpus, those that a rule makes of hostile
strings, and those too large for a table."""

import json
import sys
import time

from tests import corpus
from tests.fuzz.__main__ import piece
from tests.fuzz.cases import COMMANDS, faults_of, own_faults, problem_files, record_faults, warm
from tests.fuzz.hostile import NUMBERS, STRINGS
from tests.fuzz.mutate import apart, at, binary_stl, mesh, paths, put, quoted, records
from tests.fuzz.watch import limited, slack

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
EXPRESSION = TOP + '[[potential]]\nkind = "expression"\nU = "{}"\n'
MESHED = 'name = "top"\ngroup = "SO(3)"\n[body]\nsolid = "mesh"\ndensity = 1\nfile = {}\n'
WHERE = {
    "expression": TOP + '[[potential]]\nkind = "expression"\nU = {}\n',
    "group": 'name = "top"\ngroup = {}\n' + POINT,
    "file": MESHED,
    "input": TOP + '[[input]]\nkind = "force"\non = 1\nname = {}\n',
    "name": 'name = {}\ngroup = "SO(2)"\n' + POINT,
    "parameter": 'name = "top"\ngroup = "SO(2)"\n[parameters]\n{} = 1.0\n' + POINT,
}
"""Where a file may have any text, or one that must be a name or an expression."""
MASS = (
    'name = "top"\ngroup = "SO(2)"\n[parameters]\nr1_x = 1.0\n[[point]]\nmass = {}\nat = [1, 0]\n'
)


def problems():
    """Name → a problem file that is refused, but for those called good: of the table, and by rule
    with each hostile string wherever there may be one."""
    yield "binary.toml", bytes(range(256))
    for kind, name in (("refused", "bad"), ("taken", "good")):
        for k, (text, *_) in enumerate(corpus.problems(kind)):
            yield f"{name}-{k}.toml", text
    for where, text in WHERE.items():
        for k, words in enumerate(map(quoted, STRINGS)):
            yield f"{where}-{k}.toml", text.format(words)
    for where, text in {"U": WHERE["expression"], "mass": MASS}.items():
        for k, words in enumerate(map(quoted, NUMBERS)):
            yield f"{where}-{k}.toml", text.format(words)


def meanings():
    """A problem with every hostile string as the unit and the meaning of a parameter."""
    names = [f"s{k}" for k in range(len(STRINGS))]
    rows = [
        f"{name} = {{ default = 1.0, meaning = {words}, unit = {words} }}\n"
        for name, words in zip(names, map(quoted, STRINGS), strict=True)
    ]
    title = quoted(" ".join(STRINGS)[:900])
    point = f'[[point]]\nmass = "{"+".join(names)}"\nat = [1, 0]\n'
    return f'name = "top"\ngroup = "SO(2)"\ntitle = {title}\n[parameters]\n{"".join(rows)}{point}'


SPOILT = {
    "self.off": ("3 0 2 1", "3 0 0 0"),
    "far.off": ("1 0 0\n0 1 0", "1e300 0 0\n0 1e-300 0"),
    "negative.off": ("4 4 6", "-4 4 6"),
    "count.off": ("4 4 6", "999999999 1 0"),
    "comment.off": ("OFF", "# \0\x1b[2J\nOFF"),
    "call.obj": ("v 0 0 0", "call /etc/passwd\nv 0 0 0"),
    "continued.obj": ("f 1 3 2", "f 1 \\\n3 \\\n2"),
    "free.obj": ("v 0 0 0", "cstype bspline\ncurv 0 1 1 2\nv 0 0 0"),
    "map.obj": ("v 0 0 0", "mtllib x.mtl\nmap_Kd |touch PWNED\nv 0 0 0"),
    "mtl.obj": ("v 0 0 0", "mtllib ../../../etc/passwd\nusemtl x\nv 0 0 0"),
    "slash.obj": ("f 1 3 2", "f 1//1 3/9/9 2/"),
    "long.obj": ("f 1 3 2", "f 1 3 2\nf" + " 1" * 3000),
}
SPOILT_STL = {
    "solid.stl": (0, b"solid "),
    "denormal.stl": (96, b"\1\0\0\0"),
    "nan.stl": (96, b"\xff\xff\xff\x7f"),
    "count.stl": (80, b"\xff\xff\xff\xff"),
}


def meshes():
    """Name → a tetrahedron in one of the formats with something odd; tests/problem/test_solids.py
    has what is refused and why."""
    yield "binary.off", b"OFF BINARY\n" + bytes(range(256))
    yield "good.off", mesh("off")
    for name, (old, new) in SPOILT.items():
        yield name, mesh(name.rpartition(".")[2]).replace(old, new, 1)
    raw = binary_stl()
    yield "good.stl", raw
    yield "short.stl", raw[:100]
    yield "zeros.stl", bytes(84)
    for name, (place, new) in SPOILT_STL.items():
        yield name, raw[:place] + new + raw[place + len(new) :]


def changed_records():
    """Name → a record with a thing changed, or what is none."""
    good = json.dumps(corpus.good_record("plane"))
    others = {"list": "[]", "number": "1", "trailing": good + "x", "bom": "\ufeff" + good}
    others |= {"nan": '{"problem": NaN}', "duplicate": '{"problem": {"name": 1, "name": 2}}'}
    others |= {"integer": f'{{"problem": {"9" * 5000}}}', "nested": good.replace("[", "[" * 300)}
    for k, text in enumerate([good, *corpus.records(), *others.values()]):
        yield f"{k}.json", text
    yield "utf16.json", good.encode("utf-16")


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
        "sum.toml": EXPRESSION.format("1+" * 500_000 + "1"),
        "brackets.toml": EXPRESSION.format("(" * 10_000 + "1" + ")" * 10_000),
        "power.toml": EXPRESSION.format("(r1_x+1)^9^9"),
        "hole.off": holed_sphere(),
    }


def holed_sphere():
    """An OFF file of nearly the largest size, a grid on a sphere that lacks one triangle."""
    n = 141
    grid = [(i, j) for i in range(n) for j in range(n)]
    points = [f"{i} {j} {(i * j) % 7}" for i, j in grid]
    corners = [(i * n + j, i * n + j + 1, (i + 1) * n + j) for i, j in grid if max(i, j) < n - 1]
    faces = [f"3 {a} {b} {c}\n3 {b} {c + 1} {c}" for a, b, c in corners]
    count = 2 * len(faces)
    return "\n".join([f"OFF\n{len(points)} {count} 0", *points, *faces, ""])


def long_records():
    """Name → text of a record of very many steps, or symbols."""
    record = records()[0]
    return {
        "steps.json": json.dumps({**record, "steps": record["steps"] * 2000}),
        "symbols.json": json.dumps({**record, "symbols": record["symbols"] * 20_000}),
    }


LARGEST = 2
"""How many times longer what is just within the limits may take: alone and on a quiet machine it
takes 1.2 to 1.7 of the two seconds, and beside other work twice that was measured."""


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
    text = json.dumps({**whole, "steps": apart(whole["steps"])})
    for k, path in enumerate([x for x in paths(json.loads(text)) if x]):
        data = json.loads(text)
        others = [None, [], "x", 3, {}, -1, "t", [[]], True, "9" * 50]
        put(data, path, others[k % len(others)] if k % 3 else [at(data, path)])
        yield "/".join(map(str, path)), json.dumps(data)


def texts():
    """A problem with each hostile string where text is allowed, which every language gets."""
    for k, words in enumerate(STRINGS):
        yield f"text-{k:02}.toml", TURNED.format(quoted(words))


MUTATED = 60
"""How many of the first cases that ``make fuzz`` runs are run here, where all is imported."""


def main():
    """Print what is wrong; exit 1 if anything is."""
    limited()
    warm()
    start, found, count, usual = time.time(), [], 0, slack()

    def judge(name, content, commands, slow=usual):
        files, first = problem_files(name, content)
        bad = name.startswith("bad")
        found.extend((name, *x) for x in faults_of(files, first, commands, slow, refused=bad))

    for name, content in problems():
        count += 1
        judge(name, content, ["emit" if name.startswith("bad") else "text"])
        if name.startswith("good"):
            found.extend((name, *x) for x in own_faults({name: content}, name))
    for name, content in (*meshes(), ("meaning.toml", meanings())):
        count += 1
        judge(name, content, SOME if name.startswith(("meaning", "good")) else ["text"])
    for name, content in changed_records():
        count += 1
        judge(name, content, ["check"])
        if isinstance(content, str):
            found.extend((name, *x) for x in record_faults(content))
    print(f"{count} files, {time.time() - start:.0f} s")
    for name, text in (bombs() | long_records()).items():
        count += 1
        judge(name, text, ["check"] if name.endswith(".json") else ["text", "emit"])
    print(f"{count} cases, {time.time() - start:.0f} s")
    for name, text, commands in limits():
        count += 1
        judge(name, text, commands, LARGEST * slack())
    print(f"{count} cases, {time.time() - start:.0f} s")
    for name, text in nodes():
        count += 1
        found.extend((name, *x) for x in record_faults(text))
    print(f"{count} cases, {time.time() - start:.0f} s")
    for name, text in texts():
        count += 1
        judge(name, text, ["every"])
    found.extend(("fuzz", *x) for x in piece((1, 1, MUTATED))[1])
    for fault in found:
        print(*fault, sep="  ")
    print(f"{count} cases, {len(found)} faults, {time.time() - start:.0f} s")
    assert {*SOME, "check", "every"} <= {*COMMANDS}
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
