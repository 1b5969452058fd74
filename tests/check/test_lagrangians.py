"""The checker on Lagrangians that no points give: a false sign, side, term or header is refused."""

import json

import pytest

from derive.check.checker import Checker
from derive.language.read import read
from derive.record.as_json import encode, from_json, to_json
from derive.record.record import RecordError
from tests.support.walks import SEED, record


def refused(name, change, labels):
    """Those of some steps that are refused once the data of a record are changed."""
    data = json.loads(to_json(record(name)))
    change(data)
    d = from_json(json.dumps(data))
    own = Checker(d.problem, SEED)
    return {x for x in labels if not own.check(d[x]).holds}


def step(data, label):
    return next(s for s in data["steps"] if s["label"] == label)


def put(data, label, place, text):
    step(data, label)["equations"][place]["rhs"] = encode(read(text))


def test_the_other_sign_of_the_bracket():
    label = "left.structure"
    assert refused("gyrostat", lambda d: put(d, label, 0, "−[ξ′, ξ]"), {label})


def test_the_other_side():
    """What is said on the left is not so on the right."""

    def turn(data):
        data["problem"]["lagrangian"]["trivialisation"] = "right"

    labels = {f"left.{x}" for x in ("trivialisation", "structure", "coadjoint")}
    labels |= {f"gyrostat.{x}" for x in ("coordinates", "coadjoint", "mass")}
    assert refused("gyrostat", turn, labels) == labels


@pytest.mark.parametrize(
    ("label", "place", "text"),
    [
        ("left.exterior_momentum", 0, "⟨δΠ − Φ δt, ξ′ − Z δ′t⟩ − ⟨δ′Π − Φ δ′t, ξ − Z δt⟩"),
        ("left.coadjoint", 0, "⟨Φ, ξ′⟩ − ⟨Π, [Z, ξ′]⟩"),
        ("left.energy", 0, "⟨Π, Z⟩ + L̃"),
        ("left.momenta", 0, "⟨Π, δZ⟩ + ⟨Φ, ξ⟩"),
        ("charged_body.energy", 0, "L̃"),
        ("charged_body.coadjoint", 0, "Φ₁ + ζ₂ Π₃ − ζ₃ Π₂"),
        ("charged_body.momenta", 1, "ζ₁"),
        ("charged_body.by_momenta", 0, "M⁻¹ [Π₁; Π₂; Π₃]"),
        ("charged_body.poisson_tensor", 0, "[0, Π₃, −Π₂; −Π₃, 0, Π₁; Π₂, −Π₁, 0]"),
        ("charged_body.poisson_tensor", 1, "[Φ₁; Φ₂; Φ₃] − 𝕁 [ζ₁; ζ₂; ζ₃]"),
    ],
)
def test_a_term_that_is_false(label, place, text):
    assert refused("charged_body", lambda d: put(d, label, place, text), {label})


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
