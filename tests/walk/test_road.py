"""One road: from the Lagrangian to the motion by every step between, and no equation lost."""

import hashlib
import json
from pathlib import Path

import pytest

from derive.algebra.words import word
from derive.pipeline import general_road
from derive.walk.alphabet import Alphabet
from derive.walk.restriction import restrict
from tests.support.walks import NAMES, OTHERS, record

SHOWN = json.loads((Path(__file__).parents[1] / "support" / "shown.json").read_text())
"""Equations of steps, as digests, that were shown before the road was one.

Terms of a sum and the two sides of a product of vectors may change places.
"""

REWRITTEN = {"so4.exterior", "su2.exterior", "two_tops.exterior", "top.components"}
REWRITTEN |= {f"{x}.potential" for x in ("jelly", "comet", "two_tops", "ellipsoid")}
"""Tr ξJZξ̄′ − Tr ξ′JZξ̄ is now the bracket, Tr [ξ′, ξ] JZ̄, the top has m g l, and U is
told by U_Q; all else is as it was."""

RENAMED = {"θ": "λ"}
"""The multiplier had the letter of the principal moments."""

LOST_C = {f"screw.{x}" for x in ("cartan", "exterior", "mass", "energy")}
"""Screws keep lengths: C is 1 between elements of the Lie algebra, and no longer written there."""

GENERAL = [
    "lagrangian",
    "velocity",
    "moments",
    "pullback",
    "force",
    "momentum",
    "energy",
    "cartan",
    "exterior",
    "contraction",
    "vertical",
    "second_order",
    "kernel",
    "trivialisation",
    "cartan_trivialised",
    "structure",
    "momenta",
    "cartan_momentum",
    "exterior_momentum",
]
OWN = ["cartan", "exterior", "kernel"]
IN_SPACE = [
    "hat",
    "inertia",
    "momenta",
    "exterior_vector",
    "contraction",
    "vertical",
    "second_order",
    "coadjoint",
]


@pytest.mark.parametrize("name", [x for x in (*NAMES, *OTHERS) if x not in ("linear", "affine")])
def test_every_step_leads_to_the_motion(name):
    d = record(name)
    general = d.steps[0].label.split(".")[0]
    own = [*OWN, *(IN_SPACE if f"{name}.hat" in {s.label for s in d.steps} else [])]
    uses = {s.label: s.uses for s in d.steps}
    found, left = set(), [f"{name}.motion"]
    while left:
        label = left.pop()
        if label not in found:
            found.add(label)
            left += uses[label]
    expected = {f"{general}.{x}" for x in GENERAL} | {f"{name}.{x}" for x in own}
    if "lagrangian" in d.problem:
        expected = {s.label for s in d.steps} - {
            f"{name}.energy",
            f"{name}.explicit",
            f"{name}.by_momenta",
            f"{name}.poisson_tensor",
            f"{name}.conserved",
            f"{general}.moment_map",
            f"{general}.kks",
        }
    assert expected <= found


def test_no_equation_is_lost():
    """Those of all ready-made problems; what they say of any group stands in each."""
    now = {}
    for name in (*NAMES, *OTHERS):
        for step in record(name).steps:
            chapter = step.label.split(".")[0]
            now.setdefault(chapter, set()).update(digest(e) for e in step.equations)
    gone = {x for x, found in SHOWN.items() if not {*found} <= now[x.split(".")[0]]}
    assert gone == REWRITTEN | LOST_C


def test_a_momentum_that_moves_with_the_group_is_not_restricted_in_silence():
    """Its variation would be lost: a gyroscopic term N̄A, say."""
    a = Alphabet("n", affine=False)
    form = general_road(affine=False)["momenta"].form
    values = {a.Pi.momentum: word(a.N).bar * word(a.A.position), a.Pi.force: word(a.N_body)}
    with pytest.raises(ValueError, match=r"Π has [AN], whose variation is not known"):
        restrict(form, values, a)


def digest(equation):
    return hashlib.sha256(f"{normal(equation.lhs)} = {normal(equation.rhs)}".encode()).hexdigest()[
        :16
    ]


def normal(t):
    """A tree with the terms of its sums and inner products in one order."""
    if not isinstance(t, tuple):
        return RENAMED.get(t, str(t))
    head, *args = t[0], *map(normal, t[1:])
    if head == "metric":
        args[1:] = sorted(args[1:])
    return f"({head} {' '.join(sorted(args) if head in ('add', 'inner') else args)})"
