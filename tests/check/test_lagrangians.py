"""The checker on Lagrangians that no points give: a false sign, side, term or header is refused."""

import json

import pytest

from derive.check.checker import Checker
from derive.record.as_json import from_json, to_json
from derive.record.record import RecordError
from tests.support.walks import SEED, record


def refused(name, change, labels):
    """Those of some steps that are refused once the data of a record are changed."""
    data = json.loads(to_json(record(name)))
    change(data)
    d = from_json(json.dumps(data))
    own = Checker(d.problem, SEED)
    return {x for x in labels if not own.check(d[x]).holds}


def test_the_other_side():
    """What is said on the left is not so on the right."""

    def turn(data):
        data["problem"]["lagrangian"]["trivialisation"] = "right"

    labels = {f"left.{x}" for x in ("trivialisation", "structure", "coadjoint")}
    labels |= {f"gyrostat.{x}" for x in ("coordinates", "coadjoint", "mass")}
    assert refused("gyrostat", turn, labels) == labels


HEADERS = {
    "a body beside": lambda p: p["body"].update(kind="any"),
    "no Lagrangian": lambda p: p.pop("lagrangian"),
    "another side": lambda p: p["lagrangian"].update(trivialisation="both"),
    "no tree": lambda p: p["lagrangian"].update(L=["at", "Π", 1]),
    "an entry outside": lambda p: p["lagrangian"].update(L=["entry", "A", 4, 1]),
    "a coordinate outside": lambda p: p["lagrangian"].update(L=["entry", "ζ", 4]),
    "a potential": lambda p: p["potentials"].append({"kind": "gravity", "g": [0, 0, 1]}),
}


@pytest.mark.parametrize("name", HEADERS)
def test_a_header_that_makes_no_sense(name):
    data = json.loads(to_json(record("gyrostat")))
    HEADERS[name](data["problem"])
    with pytest.raises(RecordError):
        from_json(json.dumps(data))
