"""Conventions that someone may have chosen, at random, and our code in them."""

import json
import random
import shutil
from pathlib import Path

from derive.compare.user_states import SIZES, WORDS
from tests.support.library import ONE_BUILD, library, module_of

WRITTEN = Path(__file__).with_name("written_otherwise.py")
UNITS = (1.0, 57.3, 0.001)


def drawn(seed, state, inputs=(), in_blocks=True):
    """What someone may have chosen of a state by our names; ``in_blocks``: of a rotation, and
    maybe of a place."""
    chosen = random.Random(seed)
    names = [*state]
    if in_blocks:
        moving = ["position", "velocity"] * ("T_1" in state)
        names = [["quaternion", "euler", "matrix"][seed % 3], "omega", *moving]
    chosen.shuffle(names)
    said = {x: {k: chosen.choice(y) for k, y in WORDS[x].items()} for x in names if x in WORDS}
    plain = [x for x in names if x not in SIZES and x != "euler"]
    units = {x: chosen.choice(UNITS) for x in plain if in_blocks or not x.startswith("A")}
    order = [*range(len(inputs))]
    chosen.shuffle(order)
    sizes = [(x, SIZES.get(x, 3) if x in WORDS else 1) for x in names]
    found = {"state": sizes, "said": said, "units": units, "inputs": order, "options": {}}
    return found | {"names": [*state]}


def table(choices, inputs=()):
    """The same as a table for ``--as``."""
    state, order = [x for x, _ in choices["state"]], [inputs[i] for i in choices["inputs"]]
    lines = ['call = "f(t, x, u) -> dx"', f"state = {json.dumps(state)}"]
    lines += [f"inputs = {json.dumps(order)}"] * bool(order)
    lines += ["[units]", *(f"{x} = {y}" for x, y in choices["units"].items())]
    for name, words in choices["said"].items():
        lines += [f"[{name}]", *(f"{k} = {json.dumps(x)}" for k, x in words.items())]
    return "\n".join(lines)


def written(folder, problem, language, choices):
    """Our code of a problem, a name or a text, in these conventions: a file."""
    build = ONE_BUILD[language]
    library(build, problem, **choices["options"])  # kept on the disk for the process of the code
    defaults = module_of(problem).DEFAULTS
    said = {"BUILD": build, "PROBLEM": problem, "CHOICES": choices}
    said["DEFAULTS"] = [*defaults.values()]
    lines = [f"{name} = {x!r}" for name, x in said.items()]
    (folder / "choices.py").write_text("\n".join(lines), encoding="utf-8")
    return shutil.copy(WRITTEN, folder / "users.py")
