"""Case k of any seed: a problem file, an expression, a mesh or a record, somewhat changed."""

import json
import struct
import tomllib
from copy import deepcopy
from functools import cache
from random import Random

from derive.language.derivatives import DERIVATIVES
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.as_json import to_data
from derive.record.record import ANY_GROUP
from tests.fuzz.hostile import NUMBERS, STRINGS, VALUES
from tests.problems import PROBLEMS
from tests.support.kinds import pages

SMALL = """
name = "small"
group = "{group}"
[parameters]
k = {{ default = 2.5, unit = "N/m", meaning = "stiffness" }}
[[point]]
mass = {mass}
at = [{at}, 0.5]
[[point]]
mass = 2
at = [0, 1]
[[potential]]
kind = "expression"
U = {U}
[[potential]]
kind = "gravity"
g = [{g}, "-9.81*k"]
"""
SOLID = """
name = "solid"
group = "SO(3)"
[parameters]
a = 0.5
[[solid]]
kind = "ellipsoid"
density = 2
semi_axes = ["a", 0.4, "2*a"]
rotation = { axis = [1, 2, 2], angle = "pi/3" }
shift = [0, "a", 1]
[[solid]]
kind = "tetrahedron"
density = 1
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
"""
GIVEN = """
name = "given"
group = "SE(3)"
[parameters]
c = 1.0
[body]
given = { m = "c", c = [0, 0, "c"], J = [[2, 0, 0], [0, 3, 0], [0, 0, 4]] }
[[input]]
name = "F"
kind = "force"
at = [1, 0, 0]
"""
SOURCES = ("SO(2)", "UT(2)", "SL(2)", "SE(2)", "screw", "weighted", "an axis", "SO(3) x SO(3)")
WORDS = ("r1_x", "r1_y", "r2_x", "r2_y", "k", "t", "pi", "1", "2", "0", "0.5")
WORDS += ("1e-3", "1e300", "3.")
SIGNS = ("+", "-", "*", "/", "^", "(", ")", ",", " ", "**", "^2", "^-1", "^64", "e5", ".", "_")
LETTERS = "[]{}()=.,'\"#\n\x00\ufeff\u202e\\"


def quoted(words):
    """A string of TOML."""
    return json.dumps(words, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml(data):
    """Any data as TOML, one table in braces after the other; ``None`` is left out."""
    return "".join(f"{line}\n" for line in _lines(data))


def _lines(data):
    """A line for each key."""
    for name, x in data.items():
        if x is not None:
            plain = name.isascii() and name.replace("_", "").isalnum()
            yield f"{name if plain else quoted(name)} = {_value(x)}"


def _value(x):
    if isinstance(x, bool):
        return str(x).lower()
    if isinstance(x, dict):
        return f"{{{', '.join(_lines(x))}}}"
    if isinstance(x, list):
        return f"[{', '.join(_value(y) for y in x if y is not None)}]"
    return quoted(x) if isinstance(x, str) else repr(x)


@cache
def sources():
    """The data of problem files to begin with."""
    texts = [*(PROBLEMS[name] for name in SOURCES), SOLID, GIVEN, small(Random(1), '"k*r1_x"')]
    return [tomllib.loads(text) for text in [*texts, *pages().values()]]


def small(random, U, mass="1.5", at='"k"', g='"k"'):
    """A small problem with four expressions."""
    group = random.choice(("SO(2)", "UT(2)", "SL(2)", "SE(2)"))
    return SMALL.format(group=group, U=U, mass=mass, at=at, g=g)


# -- expressions ---------------------------------------------------------------------------------


def expression(random, depth=4):
    """By the grammar."""
    if depth == 0 or random.random() < 0.2:
        return random.choice(WORDS)
    a, b = (expression(random, depth - 1) for _ in range(2))
    kinds = [f"{a} {sign} {b}" for sign in "+-*/"] + [f"({a}){sign}({b})" for sign in "+-*/"]
    kinds += [f"({a})^{random.randint(-3, 9)}", f"-{a}", f"{random.choice([*DERIVATIVES])}({a})"]
    return random.choice(kinds)


def changed_text(random, text):
    """Some letters left out, doubled, put in."""
    for _ in range(random.randint(1, 4)):
        i = random.randint(0, len(text))
        j = min(len(text), i + random.choice((1, 1, 2, 5, 30)))
        pieces = ["", "", text[i:j] * 2, text[i:j] * random.choice((3, 100))]
        pieces += [random.choice(x) for x in (SIGNS, WORDS, STRINGS, LETTERS)]
        piece = random.choice(pieces)
        text = text[:i] + piece + text[j:]
    return text


def expression_case(random):
    """One of the expressions of a small problem."""
    words = expression(random, random.randint(0, 6))
    if random.random() < 0.5:
        words = changed_text(random, words)
    if random.random() < 0.1:
        words = random.choice(NUMBERS)
    where = random.choice(("U", "U", "U", "mass", "at", "g"))
    fields = {"U": '"k*r1_x"'} | {where: quoted(words.replace("\ufeff", "?"))}
    return "case.toml", small(random, **fields)


# -- problem files -------------------------------------------------------------------------------


def paths(data, path=()):
    """The paths to all nodes."""
    yield path
    inside = data.items() if isinstance(data, dict) else ()
    inside = enumerate(data) if isinstance(data, list) else inside
    for key, x in inside:
        yield from paths(x, (*path, key))


def at(data, path):
    """The node at a path."""
    for key in path:
        data = data[key]
    return data


def put(data, path, value):
    """Another node there, in place."""
    at(data, path[:-1])[path[-1]] = value


def changed_data(random, data, times=3):
    """Some nodes replaced, doubled, exchanged or left out."""
    data = deepcopy(data)
    for _ in range(random.randint(1, times)):
        listed = [p for p in paths(data) if p]
        if not listed:
            return data
        path = random.choice(listed)
        old, home = at(data, path), at(data, path[:-1])
        kind = random.randrange(8)
        if kind < 3:
            put(data, path, deepcopy(random.choice(VALUES)))
        elif kind == 3:
            put(data, path, random.choice((*STRINGS, *NUMBERS)))
        elif kind == 4:
            put(data, path, deepcopy(at(data, random.choice(listed))))
        elif kind == 5 and isinstance(home, list):
            home[path[-1] :] = [deepcopy(old)] * random.choice((0, 2, 3, 20))
        elif kind == 5:
            home[random.choice((*STRINGS, path[-1] + "_"))] = home.pop(path[-1])
        elif kind == 6:
            put(data, path, random.choice(([old], {"x": old}, str(old)[:2000])))
        elif isinstance(old, str):
            put(data, path, changed_text(random, old))
    return data


def data_case(random):
    """A problem whose data are changed."""
    return "case.toml", toml(changed_data(random, random.choice(sources())))


def text_case(random):
    """A problem whose letters are changed, or whose bytes are."""
    text = changed_text(random, toml(random.choice(sources())))
    raw = bytearray(text.encode("utf-8", "replace"))
    for _ in range(random.choice((0, 0, 1, 3))):
        raw[random.randrange(len(raw))] = random.randrange(256)
    return "case.toml", bytes(raw)


# -- meshes --------------------------------------------------------------------------------------

CORNERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))


def mesh(ending):
    """A tetrahedron in one of the formats."""
    if ending == "off":
        points = "\n".join(" ".join(map(str, p)) for p in CORNERS)
        return f"OFF\n4 4 6\n{points}\n" + "".join("3 {} {} {}\n".format(*f) for f in FACES)
    if ending == "obj":
        points = "".join("v {} {} {}\n".format(*p) for p in CORNERS)
        return points + "".join("f {} {} {}\n".format(*(i + 1 for i in f)) for f in FACES)
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*CORNERS[i]) for i in f)
        + "endloop\nendfacet\n"
        for f in FACES
    )
    return f"solid x\n{facets}endsolid x\n"


def binary_stl():
    """The same as bytes."""
    facets = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in CORNERS[i]), 0) for f in FACES
    )
    return bytes(80) + struct.pack("<I", len(FACES)) + facets


ODD = ("nan", "inf", "-inf", "1e999", "1e308", "1e-320", "0x1", "99999999", "-1", "4", "0")
ODD += ("1/2", "", "a")


def mesh_case(random):
    """A mesh with a number or some bytes changed."""
    ending = random.choice(("off", "obj", "stl", "stlb"))
    if ending == "stlb":
        raw = bytearray(binary_stl())
        for _ in range(random.randint(0, 6)):
            raw[random.randrange(80, len(raw))] = random.choice((0, 1, 127, 128, 255))
        return "case.stl", bytes(raw[: random.choice((len(raw), len(raw), 83, 84, 200))])
    text = mesh(ending)
    for _ in range(random.randint(0, 3)):
        words = text.split(" ")
        if random.random() < 0.6:
            words[random.randrange(len(words))] = random.choice(ODD)
            text = " ".join(words)
        else:
            text = changed_text(random, text)
    return f"case.{ending}", text


# -- records -------------------------------------------------------------------------------------


@cache
def records():
    """Records without the steps about any group."""
    return [own_record(data) for data in sources()]


def own_record(data):
    """What is written of the walk of a problem, without the steps about any group."""
    record = to_data(walk(problem_of(data)))
    own = [x for x in record["steps"] if x["scope"] != ANY_GROUP]
    labels = {x["label"] for x in own}
    for x in own:
        x["uses"] = [y for y in x["uses"] if y in labels]
    return json.loads(json.dumps(record | {"steps": own}))


def apart(steps):
    """Steps that use no others, so that none of them is a remark."""
    return [{k: x for k, x in step.items() if k != "remark"} | {"uses": []} for step in steps]


def record_case(random):
    """A record with a few of its steps, changed."""
    data = random.choice(records())
    start = random.randrange(len(data["steps"]))
    steps = deepcopy(apart(data["steps"][start : start + 2]))
    symbols = random.sample(data["symbols"], min(2, len(data["symbols"])))
    own = {"problem": deepcopy(data["problem"]), "symbols": symbols, "steps": steps}
    text = json.dumps(changed_data(random, own), ensure_ascii=random.random() < 0.9)
    if random.random() < 0.1:
        text = changed_text(random, text)
    return "case.json", text


KINDS = {expression_case: 40, data_case: 15, text_case: 15, mesh_case: 15, record_case: 15}
"""Of a hundred cases."""


def case(seed, k):
    """Name and content of case k, and the numbers that choose what is done with it."""
    random = Random(f"{seed} {k}")
    make = random.choices([*KINDS], [*KINDS.values()])[0]
    return *make(random), random
