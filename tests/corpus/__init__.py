"""Bad input as data: problem files, command lines and records that are good but for a change."""

import tomllib
from copy import deepcopy
from pathlib import Path

from tests.fuzz.mutate import toml

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
