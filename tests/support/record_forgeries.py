"""Records that say what has no meaning, or of their problem what is not so.

Around every head, at every argument and index, in every quantifier; in the header and the symbols.
Nothing of it may be read or held.
"""

import copy
import json
from dataclasses import replace

from derive.check.checker import check
from derive.language.tree import mul, neg
from derive.record.as_json import from_json, to_data
from derive.record.record import RecordError
from tests.support.record_mutations import replace_at, subtrees

ABOUT = {
    "opposite": neg,
    "inverse": lambda x: ("inv", x),
    "bar": lambda x: ("T", x),
    "square": lambda x: ("pow", x, 2),
    "sum": lambda x: ("add", x, 7),
    "product": lambda x: ("mul", x, "m"),
    "hat": lambda x: ("hat", x),
    "member": lambda x: ("at", x, "i"),
    "entry": lambda x: ("entry", x, 1),
    "function": lambda x: ("fun", "sin", x),
    "call": lambda x: ("call", x, "t"),
    "trace": lambda x: ("tr", x),
}
"""What may stand about a head, and about an argument."""
HEADS = ("L", "δy", "t", "v", "r", "0 = 1", "Ω̄", "ϖ ", "ω̃")
ARGUMENTS = (5, 0, 1, "t", "m", "A", "Z", "δZ", "c", "δ′x", "X", "r", ("mul", "A", "C"))
INDICES = ("0 = 1", "t", "n", "і", "i′", "π", "∞", 0, -1)
"""And letters that look like an index, or are something else."""
ABOUT_ONE = {"default": 1.0, "unit": "", "meaning": ""}
QUANTIFIED = ("ζ̇", "t", "L", "0 = 1", "Z", "A", "ξ‴", "ϖ")


def forged(equation):
    """(kind, what, equation) for every change of a head, an argument, an index, a quantifier."""
    for side in ("lhs", "rhs"):
        tree = getattr(equation, side)
        for path, t in subtrees(tree):
            for kind, what, wrong in _changes(t) if isinstance(t, tuple) else ():
                changed = replace_at(tree, path, lambda _, wrong=wrong: wrong)
                yield kind, what, replace(equation, **{side: changed})
    for name in QUANTIFIED:
        yield "quantifier", name, replace(equation, for_all=(*equation.for_all, name))


def _changes(t):
    if t[0] == "call":
        head, arguments = t[1], t[2:]
        for what, about in ABOUT.items():
            yield "head", what, ("call", about(head), *arguments)
        for other in HEADS:
            yield "head", other, ("call", other, *arguments)
        for k, x in enumerate(arguments):
            before, after = arguments[:k], arguments[k + 1 :]
            for what, about in (*ABOUT.items(), ("double", lambda x: mul(2, x))):
                if about(x) != x:
                    yield "argument", what, ("call", head, *before, about(x), *after)
            for other in ARGUMENTS:
                if other != x:
                    yield "argument", str(other), ("call", head, *before, other, *after)
            if before or after:
                yield "argument", "left out", ("call", head, *before, *after)
        for more in ("δ′y", "X", 5, arguments[-1]):
            yield "argument", f"and {more}", (*t, more)
    elif t[0] in ("at", "entry"):
        for k in range(2, len(t)):
            for other in INDICES:
                yield "index", str(other), (*t[:k], other, *t[k + 1 :])
        yield "index", "twice", (*t, t[-1]) if len(t) == 3 else t[:3]
    elif t[0] == "sum":
        for other in INDICES[:7]:
            yield "index", other, ("sum", other, t[2])


def headers(d):
    """(what, data of a record) for every change of the header and the symbols that is not so."""
    problem = d.problem
    changes = {
        "name": ("0 = 1", "ѕо3", "so 3", ""),
        "group": (
            problem["group"].replace("S", "Ѕ"),
            problem["group"] + " ",
            "SO(03)",
            "SL(3), say",
        ),
        "action": ({"linear": "affine", "affine": "linear"}[problem["action"]],),
        "homogeneous": (not problem["homogeneous"],),
        "basis": (problem["basis"][1:], problem["basis"][::-1], [*problem["basis"], [["1"]]]),
        "conventions": (problem["conventions"][1:],),
        "parameters": [{**problem["parameters"], x: ABOUT_ONE} for x in ("0 = 1", "а", "a b", "")],
        "inputs": ([{"kind": "covector", "name": "u = 0"}],),
    }
    for key, values in changes.items():
        for value in (x for x in values if x != problem[key]):
            data = copy.deepcopy(to_data(d))
            data["problem"][key] = value
            yield f"{key} {value!r:.40}", data
    for k, symbol in enumerate(d.symbols):
        for key in ("name", "latex"):
            data = copy.deepcopy(to_data(d))
            data["symbols"][k][key] = "0 = 1"
            yield f"{key} of {symbol.name}", data


def read_and_held(data):
    """Is a record read, and every step of it held?"""
    try:
        return all(v.holds for v in check(from_json(json.dumps(data))))
    except RecordError:
        return False
