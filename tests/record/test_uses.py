"""What a step says that it uses is what its rule received: neither more nor less."""

from dataclasses import replace

import pytest

from derive import pipeline
from derive.algebra.words import Expr
from derive.check.checker import UNUSED, check
from derive.check.form.well_formedness import mentioned, unused
from derive.record.record import Equation
from derive.walk.chapter import Draft, WalkError
from derive.walk.spine import lagrangian
from tests.support.walks import NAMES, OTHERS, SEED, problem, record, repeated

WALKED = ("so3", "saff3")


def untraced(name, monkeypatch):
    """The steps with what their rules received alone: names are not looked up."""
    monkeypatch.setattr(lagrangian, "traced", lambda steps: steps)
    pipeline.general_road.cache_clear()
    try:
        return pipeline.walk(problem(name)).steps
    finally:
        pipeline.general_road.cache_clear()


@pytest.fixture
def withdraw(monkeypatch):
    """Walks in which what a step says is twice what it should be."""
    marked, whole = Expr.marked, Draft.step

    def walked(name, label):
        def wrong(e, *marks):
            right = marked(e, *marks)
            return right * 2 if label in marks else right

        def twice(draft, *given, **more):
            step = whole(draft, *given, **more)
            if step.label != label:
                return step
            doubled = (Equation(e.lhs, ("mul", 2, e.rhs), e.for_all) for e in step.equations)
            return replace(step, equations=tuple(doubled))

        with monkeypatch.context() as m:
            m.setattr(Expr, "marked", wrong)
            m.setattr(Draft, "step", twice)
            try:
                return untraced(name, m)
            except WalkError:
                return None

    return walked


NOMINAL = {
    ("kernel", "force"): "the work of the forces is carried to the right",
    ("extremal", "pullback"): "it holds of any Lagrangian on the group",
    ("extremal", "force"): "and of any forces",
    ("dalembert", "force"): "both sides are summed over the points alike",
    ("dalembert", "moments"): "both sides are summed over the points alike",
    ("motions", "gradient"): "the work of the forces is that of the acceleration",
    ("motions", "force"): "the same",
    ("geodesics", "relation"): "every skew matrix is in the Lie algebra",
    ("contraction", "dalembert"): "that the extremals are tangent to the kernel",
    ("equations", "gradient"): "the work of the forces is told by its name, dŨ",
    ("equations", "force"): "the same",
    ("multiplier", "force"): "dŨ is told by the moments of the forces, whose own step has them",
    ("elimination", "force"): "the same",
    ("mass", "force"): "the same",
    ("poisson_tensor", "force"): "the same",
    ("power", "motion"): "the balance is taken along the motion, where its inertial side is ḣ",
    ("power", "conserved"): "without what acts ḣ is 0",
    ("hat", "relation"): "only a skew matrix is a j(X)",
    ("motion", "relation"): "⟨Λ, Ż⟩ = 0 is what θ is solved from",
    ("coadjoint", "momenta"): "the momenta are told by their names",
    ("coadjoint", "relation"): "only the skew part of what pairs with ξ′ counts",
    ("motion", "mass"): "a linear system is solved by a name, M⁻¹",
    ("body", "integrals"): "the integrals are carried out on the solids of the problem",
    ("tensor", "body"): "the numbers are those of the problem",
    ("components", "body"): "the same",
    ("components", "tensor"): "that it is diagonal",
    ("unaligned", "relation"): "det A and ĀA, by which vector products are multiplied, are 1",
    ("unaligned", "action"): "places in space are told by their names, rᵢ(t)",
    ("tetrahedron", "volumes"): "Tr ξ, by which the volume varies, is 0",
    ("tetrahedron", "relation"): "det A, by which the volume is multiplied, is 1",
    ("conserved", "motion"): "along which the rates are",
    ("conserved", "potential"): "which the displacements keep",
}
"""What a rule receives without writing it, user and used, and why."""


def short(label):
    return label.rpartition(".")[2]


@pytest.mark.no_cover
@pytest.mark.parametrize("name", WALKED)
def test_a_rule_misses_what_is_withdrawn(name, monkeypatch, withdraw):
    """What a step says is doubled: all that use it change, and nothing else does by itself."""
    with monkeypatch.context() as m:
        right = untraced(name, m)
    judged = 0
    for used in right:
        wrong = withdraw(name, used.label)
        if wrong is None or [x.label for x in wrong] != [x.label for x in right]:
            continue  # the walk ends there, or goes elsewhere: it is missed
        judged += 1
        changed = {a.label for a, b in zip(right, wrong, strict=True) if a.equations != b.equations}
        for step in right:
            nominal = (short(step.label), short(used.label)) in NOMINAL
            if used.label in step.uses and not nominal:
                assert step.label in changed, f"{step.label} does not need {used.label}"
            if step.label in changed - {used.label}:
                assert {*step.uses} & {used.label, *changed}, f"{step.label}, by {used.label}"
    assert judged > 0.7 * len(right)


@pytest.mark.parametrize("name", WALKED)
def test_names_come_from_what_is_used(name):
    """The checker refuses a step without one of the steps from which alone it has a name."""
    d = record(name)
    for k, step in enumerate(d.steps):
        spoken = {u: {*_names(d[u])} for u in step.uses}
        for u in step.uses:
            others = set().union(*(spoken[x] for x in step.uses if x != u))
            alone = {x for x in {*_names(step)} & spoken[u] if x not in others}
            if alone:
                uses = tuple(x for x in step.uses if x != u)
                assert _verdict(d, k, uses) == UNUSED.format(min(alone)), (step.label, u)
        if any(spoken.values()) and any({*_names(step)} & x for x in spoken.values()):
            assert not _holds(d, k, ()), step.label


def _names(step):
    return (x for e in step.equations for side in (e.lhs, e.rhs) for x in mentioned(side))


def _verdict(d, k, uses):
    steps = (*d.steps[:k], replace(d.steps[k], uses=uses), *d.steps[k + 1 :])
    name = [*unused(steps)][k]
    return UNUSED.format(name) if name else ""


def _holds(d, k, uses):
    return not _verdict(d, k, uses)


@pytest.mark.parametrize("name", repeated(NAMES))
def test_an_emptied_list_is_refused_by_the_command(name):
    """As a whole record, by the checker that `derive check` runs."""
    d = record(name)
    *others, motion = d.steps
    *_, verdict = check(replace(d, steps=(*others, replace(motion, uses=()))), SEED)
    assert "no step that this one uses speaks of it" in verdict.reason


def ancestors(d, label):
    """All that a step rests on."""
    found, left = set(), [label]
    while left:
        for used in d[left.pop()].uses:
            if used not in found:
                found.add(used)
                left.append(used)
    return found


ROAD = (
    "lagrangian",
    "velocity",
    "force",
    "cartan",
    "exterior",
    "second_order",
    "kernel",
    "momenta",
)
OF_ANY = ("trivialisation", "momenta", "structure", "exterior_momentum", "coadjoint")
"""Of a Lagrangian that no points give."""


@pytest.mark.parametrize("name", [*NAMES[2:], *OTHERS])
def test_the_road_runs_through(name):
    """L → L̃ → ϖ → dϖ → kernel, of any group and of this one, to the motion."""
    d = record(name)
    below = ancestors(d, f"{name}.motion")
    if "lagrangian" in d.problem:
        side, own = d.problem["lagrangian"]["trivialisation"], ("lagrangian", "momenta")
        assert {f"{side}.{x}" for x in OF_ANY} | {f"{name}.{x}" for x in own} <= below
        return
    general, own = d.problem["action"], ("cartan", "exterior", "kernel")
    assert {f"{general}.{x}" for x in ROAD} | {f"{name}.{x}" for x in own} <= below
