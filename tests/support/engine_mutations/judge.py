"""What a changed engine made, judged: by the checker, the oracles and the validator.

They run from unchanged sources, in another process than the engine.
"""

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from derive.check.checker import Checker, checker_of
from derive.check.form.well_formedness import unexplained
from derive.language.tree import mul
from derive.record.as_json import from_json
from derive.record.record import ANY_GROUP, Derivation, RecordError, Step
from tests.oracles import general, relative_error
from tests.support.engine_mutations.engine import SEED, Output, produce, read_back
from tests.support.engine_mutations.jobs import JOBS, Job
from tests.support.states import loose

STATES, CLOSE = 3, 1e-8
DEFINED = re.compile(r"^def ([a-z]\w*)", re.MULTILINE)
"""The functions of an emitted module that are for others."""

AFFINE = {"SE": "SO", "SAff": "SL", "Aff": "GL", "Sim": "CO"}


def factor(name):
    """A basis (d, s, s) of the algebra of a named group, from the equations that define it."""
    family, number = name[:-1].split("(")
    n = int(number) * (2 if family in ("U", "SU") else 1)
    s, J = n + (family in AFFINE), np.kron([[0, 1], [-1, 0]], np.eye(n // 2))
    vanishing = {
        "SO": lambda X: X + X.T,
        "SL": np.trace,
        "GL": lambda X: 0,
        "CO": lambda X: X + X.T - 2 * np.eye(n) * np.trace(X) / n,
        "Sp": lambda X: X.T @ J + J @ X,
        "UT": np.tril,
        "U": lambda X: [X + X.T, X @ J - J @ X],
        "SU": lambda X: [X + X.T, X @ J - J @ X, np.eye(n) * np.trace(J @ X)],
    }[AFFINE.get(family, family)]
    units = np.eye(s * s).reshape(-1, s, s)
    rows = [np.append(np.ravel(vanishing(X[:n, :n])), X[n:]) for X in units]
    _, sizes, V = np.linalg.svd(np.array(rows).T)
    return V[np.sum(sizes > 1e-9) :].reshape(-1, s, s)


def algebra(group):
    """A basis (d, s, s) for a named group, a product, or a group that is given by a table."""
    if isinstance(group, dict):
        return np.array(group["basis"], float)
    parts = [factor(name) for name in group.split(" x ")]
    ends = np.cumsum([0, *(basis.shape[1] for basis in parts)])
    margins = [((0, 0), *[(ends[k], ends[-1] - ends[k + 1])] * 2) for k in range(len(parts))]
    return np.concatenate([*map(np.pad, parts, margins)])


class Verdict(NamedTuple):
    """``outcome``: one of :data:`CAUGHT`, of :data:`HARMLESS`, or "survived"; and the reason."""

    outcome: str
    why: str = ""


ANOTHER = "a_group_of_another_basis"
LATE = "no verdict in time"
CAUGHT = ("crashed", "refused", "time", "refusal", "checker", "oracle", "validator")
HARMLESS = ("same", "words", "code", "equations", "less")
"""The same output; other words or references; other code, which is right; other equations, each
of them proved; fewer of them, and the code is right."""


@cache
def of_any_group(action: str) -> Checker:
    """Claims about any group are about no problem: one checker for all of them."""
    return Checker({"group": ANY_GROUP, "n": "any", "action": action}, SEED)


def refused(step: Step, own: Any) -> str:
    """Why the checker refuses a step; empty when it holds."""
    some = of_any_group(own.problem["action"]) if step.scope == ANY_GROUP else own
    verdict = some.check(step)
    return "" if verdict.holds else f"{step.label}: {verdict.reason}"


def claims(step: Step) -> tuple[Any, ...]:
    """What a step says, but for its words and what it refers to."""
    return step.label, step.scope, step.given, step.driven, step.hypotheses, step.equations


def changed_steps(new: Derivation, old: Derivation) -> list[Step]:
    """The steps that claim something else; all of them where the problem is another."""
    known = {claims(s) for s in old.steps}
    other = new.problem != old.problem
    return [s for s in new.steps if claims(s) not in known or (other and s.scope != ANY_GROUP)]


def judged(
    job: Job, new: Output, old: Output, certain: Callable[[Job, list[str]], bool]
) -> Verdict:
    """The verdict on one job.

    ``certain``: does the checker with the same change in it refuse one of these steps as well, or,
    without steps, the validator the code?
    """
    if job.refused:
        return refusal(job, new, old)
    if new.trouble:
        return Verdict(new.trouble, new.why)
    new = new._replace(record=of_its_basis(new.record, old.record))
    if (new.record, new.files) == (old.record, old.files):
        return Verdict("same")
    found = equations(new, old) if new.record != old.record else Verdict("same")
    if found.outcome == "checker" and not certain(job, [found.why.partition(":")[0]]):
        found = Verdict("survived", f"the checker has the same fault: {found.why}")
    if found.outcome == "checker":
        return found
    coded = job.coded and (new.files, new.record) != (old.files, old.record)
    wrong = code(job, new, old) if coded else None
    if wrong and wrong.outcome == "validator" and not certain(job, []):
        return Verdict("survived", f"the validator has the same fault: {wrong.why}")
    if wrong:
        return wrong
    if found.outcome == "same":
        return Verdict("code", "; ".join(k for k in new.files if new.files[k] != old.files.get(k)))
    return found


def of_its_basis(new: str, old: str) -> str:
    """A record of a named group on another basis than the right one, as of a group of that basis.

    The checker knows the bases of the groups by their names, and has it from the same module.
    """
    data, right = json.loads(new), json.loads(old)
    name, basis = data["problem"]["group"], data["problem"]["basis"]
    if (name, basis) == (right["problem"]["group"], right["problem"]["basis"]):
        return new
    data["problem"]["group"] = ANOTHER
    for step in data["steps"]:
        step["scope"] = ANOTHER if step["scope"] == name else step["scope"]
    return json.dumps(data)


def refusal(job: Job, new: Output, old: Output) -> Verdict:
    """The verdict on a mistake in a file, which must be refused in the right words."""
    if new.trouble == "refused" and job.refused in new.why:
        return Verdict("same" if new.why == old.why else "words")
    other = new.trouble in ("crashed", "time")
    return Verdict(new.trouble if other else "refusal", new.why or "not refused")


def equations(new: Output, old: Output) -> Verdict:
    """The verdict on a record that is not the same."""
    try:
        d, right = from_json(new.record), from_json(old.record)
    except RecordError as error:
        return Verdict("checker", str(error))
    own, steps = checker_of(d.problem, SEED), changed_steps(d, right)
    try:
        for step in steps:
            if why := refused(step, own):
                return Verdict("checker", why)
    except RecordError as error:
        return Verdict("checker", str(error))
    for step, name in zip(d.steps, unexplained(d.steps, own.primitive), strict=True):
        if name:
            return Verdict("checker", f"{step.label}: nothing says what {name} is")
    if why := less(d, right, steps, own):
        return Verdict("less", why)
    said = {claims(s): s for s in right.steps}
    other = [s for s in d.steps if claims(s) not in said]
    if other:
        return Verdict("equations", ", ".join(s.label for s in other))
    other = [s for s in d.steps if said[claims(s)] != s]
    return Verdict("words", ", ".join(s.label for s in other) or "the problem or the symbols")


def less(d: Derivation, right: Derivation, steps: list[Step], own: Any) -> str:
    """What a true record leaves out: a step, equations, or what an equation says; empty if not."""
    if missing := {s.label for s in right.steps} - {s.label for s in d.steps}:
        return f"without {', '.join(sorted(missing))}"
    before = {s.label: s for s in right.steps}
    for step in steps:
        old = before.get(step.label)
        if old is None:
            continue
        if {*step.given} - {*old.given} or {*step.hypotheses} - {*old.hypotheses}:
            return f"{step.label}: it supposes more"
        if len(step.equations) < len(old.equations):
            return f"{step.label}: fewer equations"
        if idle(step, own) > idle(old, own):
            return f"{step.label}: an equation that says nothing"
    return ""


def idle(step: Step, own: Any) -> int:
    """How many equations of a true step stay true when one side is doubled, as 0 = 0 does; a side
    that is written 0 becomes 1, the left one too: 0 = x says what x = 0 does."""
    found = 0
    for k, equation in enumerate(step.equations):
        zero = next((side for side in ("rhs", "lhs") if getattr(equation, side) == 0), "")
        other = replace(equation, **({zero: 1} if zero else {"rhs": mul(2, equation.rhs)}))
        false = (*step.equations[:k], other, *step.equations[k + 1 :])
        found += not refused(replace(step, equations=false), own)
    return found


# -- code ---------------------------------------------------------------------------------------


def code(job: Job, new: Output, old: Output) -> Verdict | None:
    """The verdict on code that is wrong; ``None`` when it is right."""
    name = job.data["name"]
    before, after = ({*DEFINED.findall(x.files.get(f"{name}.py", ""))} for x in (old, new))
    if before - after:
        return Verdict("oracle", f"no {', '.join(sorted(before - after))} to call")
    asked = numbers if job.plain else in_the_frame if job.framed else None
    try:
        if asked and (why := asked(job, new.files[f"{name}.py"])):
            return Verdict("oracle", why)
    except Exception as error:
        return Verdict("oracle", f"{type(error).__name__}: {error}"[:200])
    if job.framed:
        return None
    for report in read_back(job, new):
        if not report.holds:
            return Verdict("validator", report.text[:200])
    return None


def numbers(job: Job, text: str) -> str:
    """Where emitted Python differs from Gauss's principle; empty where it does not."""
    data, space = job.seen_by_the_oracle(), run(text)
    p, given = general.parameters(data), general.parameters(job.data)
    if {k: x for k, x in space["DEFAULTS"].items() if x is not None} != {
        k: given[k] for k in space["PARAMETERS"] if k in given
    }:
        return "other defaults"
    basis = np.array(space["BASIS"], float)
    if not same_span(basis, algebra(data["group"])):
        return "BASIS is of another algebra"
    k = space["constants"]([given[x] for x in space["PARAMETERS"]])
    rng = np.random.default_rng(7)
    for _ in range(STATES):
        x = general.random_state(data, basis, rng)
        t, u = rng.normal(), rng.normal(size=len(space["INPUTS"]))
        expected = general.rhs(data, basis, p, t, x, u)
        energy = general.energy(data, basis, p, t, x)
        for what, found, right in compared(job, space, (t, x, k, u), expected, energy):
            if not relative_error(found, right) < CLOSE:
                return f"{what} differs"
    return ""


def run(text: str) -> dict[str, Any]:
    """What an emitted module defines."""
    space: dict[str, Any] = {"__name__": "emitted"}
    exec(compile(text, "emitted.py", "exec"), space)
    return space


def in_the_frame(job: Job, text: str) -> str:
    """Where emitted Python in the principal frame differs from that in the given one, unchanged."""
    space, given = run(text), run(in_the_given_frame(job.name))
    for name in ("PARAMETERS", "DEFAULTS", "STATE", "INPUTS", "BASIS"):
        if not np.array_equal(space[name], given[name]):
            return f"other {name}"
    for seed in range(STATES):
        p, x, u = loose(SimpleNamespace(**given), seed)
        t, k = float(seed), given["constants"](p)
        expected, energy = given["rhs"](t, x, k, u), given["energy"](t, x, k)
        for what, found, right in compared(
            job, space, (t, x, space["constants"](p), u), expected, energy
        ):
            if not relative_error(found, right) < CLOSE:
                return f"{what} differs"
    return ""


@cache
def in_the_given_frame(name: str) -> str:
    """The Python of a job without its frame, by the unchanged engine."""
    job = next(x for x in JOBS if x.name == name and x.framed and not x.plain)
    options = {k: x for k, x in job.options.items() if k != "frame"}
    return produce(job._replace(options=options)).files[f"{job.data['name']}.py"]


def same_span(a: Any, b: Any) -> bool:
    """Are two families of independent matrices bases of one space?"""
    if a.shape != b.shape:
        return False
    both = np.concatenate([a, b]).reshape(2 * len(a), -1)
    return np.linalg.matrix_rank(both) == np.linalg.matrix_rank(both[: len(a)]) == len(a)


def compared(
    job: Job, space: dict[str, Any], at: tuple[Any, ...], expected: Any, energy: float
) -> Iterator[tuple[str, Any, Any]]:
    """(what, found, expected): in the principal frame after the way there, and back."""
    t, x, k, u = at
    if not job.framed:
        yield "rhs", space["rhs"](t, x, k, u), expected
        yield "energy", [space["energy"](t, x, k)], [energy]
        if "turned" in space:
            yield from in_principal_axes(job, space, t, x, energy)
        return
    y = space["into_frame"](x, k)
    v = space["inputs_into_frame"](u, k) if len(u) else u
    yield "the way back", space["out_of_frame"](y, k), x
    if len(u):
        yield "the way back of inputs", space["inputs_out_of_frame"](v, k), u
    step = 1e-30j  # the way back of a rate is the derivative of the way back
    rate = space["out_of_frame"](y + step * space["rhs"](t, y, k, v), k).imag / step.imag
    yield "rhs", rate, expected
    yield "energy", [space["energy"](t, y, k)], [energy]


def in_principal_axes(
    job: Job, space: dict[str, Any], t: float, x: Any, energy: float
) -> Iterator[tuple[str, Any, Any]]:
    """(what, found, expected) of a rigid body that ``turned`` takes to its principal axes."""
    defaults = general.parameters(job.data)
    p = [defaults[name] for name in space["PARAMETERS"]]
    moments, R = space["principal_axes"](p)
    q = space["turned"](p, R)
    yield "inertia", space["inertia"](q), np.diag(moments)
    d = len(space["BASIS"])
    A, T, vectors = x[:9].reshape(3, 3) @ R, x[9:-d], x[-d:].reshape(-1, 3) @ R
    y = np.concatenate([A.ravel(), T, vectors.ravel()])
    yield "turned energy", [space["energy"](t, y, space["constants"](q))], [energy]
