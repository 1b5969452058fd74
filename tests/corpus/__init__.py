"""Bad input as data: problem files, command lines and records that are good but for a change."""

import json
import tomllib
from copy import deepcopy
from functools import cache
from pathlib import Path

from tests.fuzz.mutate import apart, own_record, put, toml

HERE = Path(__file__).parent


def table(name):
    """One of the tables beside this file."""
    return tomllib.loads((HERE / f"{name}.toml").read_text(encoding="utf-8"))


def repeated(parts):
    """A text of parts, where a number repeats the part before it."""
    found = []
    for part in parts:
        if isinstance(part, int):
            found[-1] *= part
        else:
            found.append(part)
    return "".join(found)


def changed(base, change):
    """The text of a problem file; its data where the change is one of data, else ``None``."""
    changes = change if isinstance(change, list) else [change]
    if not isinstance(changes[0], dict):
        return toml(base) + repeated(changes), None
    data = deepcopy(base)
    for other in changes:
        data |= other
    return toml(data), data


def problems(kind):
    """What is ``refused`` or ``taken``: the text, the data or ``None``, what is said."""
    found = table("problems")
    for base, rows in found[kind].items():
        for change, *words in rows:
            yield *changed(found["base"][base], change), words


@cache
def good_record(base):
    """Of the walk of one of the bases: its first two steps about the group and its first symbol."""
    whole = own_record(table("records")["base"][base])
    return whole | {"steps": apart(whole["steps"][:2]), "symbols": whole["symbols"][:1]}


def record(base, path, value):
    """The text of a record where something else stands at a place, as in ``steps.0.rule``."""
    data = deepcopy(good_record(base))
    put(data, [int(x) if x.isdigit() else x for x in path.split(".")], value)
    return json.dumps(data)


def records():
    """The text of each changed record."""
    for base, rows in table("records")["changed"].items():
        for path, value in rows:
            yield record(base, path, value)


def commands():
    """The words of each command that is refused, the files of its folder, what is said."""
    found = table("commands")
    files = {x: y if isinstance(y, str) else toml(y) for x, y in found["file"].items()}
    rows = found["refused"]
    for about in ("words", "emit", "simulate", "search", "page"):
        for words, *said in rows[about]:
            yield words.split(), files, said
    for words, *said in rows["trim"]:
        yield ["trim", *words.split()], files, said
    motion = ["simulate", "so3", "--t", "1", "--ensemble"]
    for words, *said in rows["ensemble"]:
        yield [*motion, *words.split()], files, said
    spin = found["file"]["spin.toml"]
    for when, *said in rows["event"]:
        held = {"initial": {"zeta_3": "w"}, "event": [{"name": "e", "when": when}]}
        yield ["simulate", "event.toml", "--t", "1"], {"event.toml": toml(spin | held)}, said
    driven = spin | {"initial": {"zeta_3": "w"}, "input": [{"name": "u", "kind": "covector"}]}
    for signal, *said in rows["signal"]:
        text = toml(driven | {"signal": [{"input": "u_1"} | signal]})
        yield ["simulate", "signal.toml", "--t", "1"], {"signal.toml": text}, said
    for initial, *said in rows["start"]:
        start = toml(spin | {"initial": initial})
        yield ["simulate", "start.toml", "--t", "1"], {"start.toml": start}, said
