"""Records made wrong by rule, of which none may be read and held.

Each kind of change goes through a record of the corpus, and gives what is changed with a function:
is it held all the same?
"""

import copy
import json
import random
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import cache

from derive.check.checker import Checker, ClaimChecker
from derive.check.form import symbols
from derive.check.form.function_signatures import RATES
from derive.check.form.hypotheses_checked import missing_mass_hypotheses
from derive.check.form.well_formedness import unexplained, unused
from derive.record.as_json import from_json, step_data, to_data
from derive.record.record import ANY_GROUP, COMMENTARY, RecordError
from derive.record.vocabulary import OFF_MOTION, ROLES, VOCABULARY
from tests.support import record_forgeries, record_mutations
from tests.support.corpus import DRIVEN_ON, READY, STARS, checker, record
from tests.support.record_mutations import TWINS
from tests.support.walks import FLUIDS, SEED

Changes = Iterator[tuple[object, Callable[[], bool]]]
TEXTS = ("ready linear", "ready affine", "discrete linear", "discrete affine")
"""Whose steps about any group are those of the others."""


@cache
def data(name):
    return json.loads(json.dumps(to_data(record(name))))


def read(wrong):
    """A record from data, or ``None`` for what is no record."""
    with suppress(RecordError):
        return from_json(json.dumps(wrong))
    return None


# -- equations ------------------------------------------------------------------------------------

OF_FLUIDS = ("quadric", "pressure", "total", "circulation", "no_rotation", "potential", "force")


def shown(name):
    """The steps of a record that no other has."""
    d, road = record(name), name.split(" ")[0]
    if road in ("symmetries", "reduced"):
        return d.since({"symmetries": "symmetries", "reduced": "momentum_1"}[road])
    if road == "ellipsoid":
        return [s for s in d.steps if s.label.split(".")[1] in OF_FLUIDS]
    return [s for s in d.steps if name in TEXTS or s.scope != ANY_GROUP]


TRUE = {
    "ready coupled": ("coadjoint",),
    "ready dirichlet": ("continuum", "integrals", "body", "force"),
    "ready euler_top": ("momenta",),
    "ready gas_cloud": ("body",),
    "ready kirchhoff": ("momenta",),
    "ready lagrange_top": ("coadjoint",),
    "ready manakov": ("momenta",),
    "ready pendulum": ("exterior", "coadjoint", "kernel", "rigid", "poisson_tensor"),
    "ready rod": ("coadjoint", "null", "mass"),
    "star riemann_ellipsoid": ("integrals", "body"),
    "ready screw": ("exterior", "contraction", "kernel", "mass", "poisson_tensor"),
    "ready spherical_pendulum": ("coadjoint", "null", "mass"),
    "moved su2": ("kernel", "poisson_tensor"),
}
"""Steps that stay true where an equation is changed: c or a force is 0, two moments are equal, the
Lie algebra has dimension 1 or is that of unitary matrices, what is held is 0."""


def true_of_it(name, step, equation):
    """Is a changed equation true of this record all the same?

    Without forces AN = 0, whatever its factor; where there is no curvature, −d𝒜 is d𝒜.
    """
    if name.startswith("ellipsoid"):
        return "N" in str(equation.lhs) and equation.rhs == 0
    if step.label.endswith(".routh"):
        return "reduction.flat" in {x.kind for s in record(name).steps for x in s.claims}
    return step.label.rpartition(".")[2] in TRUE.get(name, ())


def equations(name) -> Changes:
    """Each sign, factor, term and bar."""
    for step in shown(name):
        for i, e in enumerate(step.equations):
            for kind, wrong in record_mutations.corruptions(e):
                if not true_of_it(name, step, wrong):
                    yield (step.label, kind, wrong), with_equation(name, step, i, wrong)


def with_equation(name, step, i, wrong):
    """Does a step hold with another i-th equation?"""
    changed = (*step.equations[:i], wrong, *step.equations[i + 1 :])

    def held():
        verdict = checker(name).check(replace(step, equations=changed))
        assert verdict.holds or verdict.reason
        assert "makes no sense" not in verdict.reason
        return verdict.holds

    return held


def heads(name) -> Changes:
    """What stands around a head, an argument or an index, or in a quantifier."""
    for step in shown(name):
        for i, e in enumerate(step.equations):
            for kind, what, wrong in record_forgeries.forged(e):
                yield (step.label, kind, what, wrong), with_equation(name, step, i, wrong)


def headers(name) -> Changes:
    """The group and its action, names, the basis, and symbols."""
    for what, wrong in record_forgeries.headers(record(name)):
        yield what, lambda wrong=wrong: record_forgeries.read_and_held(wrong)


# -- what is supposed -----------------------------------------------------------------------------


def holds_with(name, step):
    """Does the record hold with this step in the place of the one of its label?"""
    d = record(name)
    steps = [step if s.label == step.label else s for s in d.steps]
    own = checker(name)
    faults = (unexplained(steps, own.primitive), missing_mass_hypotheses(steps, d.problem))
    return not any(map(any, faults)) and own.check(step).holds


def without(name, key, few) -> Changes:
    """A step without one of its hypotheses, say; ``few``: of these it holds nevertheless."""
    for step in record(name).steps:
        found = getattr(step, key)
        for k, x in enumerate(found):
            if not few(step, x):
                fewer = replace(step, **{key: found[:k] + found[k + 1 :]})
                yield (step.label, x), lambda fewer=fewer: holds_with(name, fewer)


def hypotheses(name) -> Changes:
    return without(name, "hypotheses", lambda step, x: False)


def givens(name) -> Changes:
    """What is given, and that inputs act where the equations have them."""
    yield from without(name, "given", lambda step, x: False)
    for step in record(name).steps:
        if step.driven and says_input(name, step):
            still = replace(step, driven=False)
            yield (step.label, "driven"), lambda still=still: holds_with(name, still)


def says_input(name, step):
    """Do the equations of a step have an input, one of its numbers, or what is given from
    outside?"""
    d = record(name)
    said = json.dumps(step_data(step)["equations"])
    named = "".join(rf'|"{x["name"]}_\d+"' for x in d.problem["inputs"])
    return re.search(rf'"(u|f_u|N_u|F_u)"{named}', said) is not None


VARIED = {"δA", "δT", "δ′A", "δ′T", "ξ", "η", "ξ′", "η′", "Ω", "Ω′"}
"""Drawn at random all the same: without the quantifier an equation stays true."""


def quantifiers(name) -> Changes:
    """A name that an equation is no longer said to hold for, or to have; but for variations, and
    for rates where the kind of a step says already that they are any."""
    for step in record(name).steps:
        free = VARIED | ({*sum(RATES, ())} if step.kind in OFF_MOTION else set())
        for k, e in enumerate(step.equations):
            for key in ("for_all", "exists"):
                for x in (x for x in getattr(e, key) if x not in free):
                    rest = tuple(y for y in getattr(e, key) if y != x)
                    one = (*step.equations[:k], replace(e, **{key: rest}), *step.equations[k + 1 :])
                    fewer = replace(step, equations=one)
                    yield (step.label, x), lambda fewer=fewer: holds_with(name, fewer)


# -- fields ---------------------------------------------------------------------------------------

HARMLESS = {
    "default": "the equations are of the parameter, whatever its value",
    "problem.inputs.*.name": "of a force or covector whose numbers stand in no equation",
}
"""What may be changed: its equations are as true as before, and why."""
OPTIONAL = {
    "commentary": "what it lists is the same in every record",
    "steps.*.kind": "the rule says it",
    "steps.*.equations.*.key": "label and place say it",
    "steps.*.scope": "that of the chapter, by the label",
    "steps.*.remark": "what the motion uses says it",
    "steps.*.given": "an empty list",
    "steps.*.hypotheses": "an empty list",
    "steps.*.equations.*.for_all": "a claim about the variation that is drawn, for any seed",
}
"""What may be left out, and why."""


def leaves(x, path=()):
    """Every field with its path; an operator tree is one, of which a leaf is taken."""
    if isinstance(x, dict):
        for key, value in x.items():
            yield from leaves(value, (*path, key))
    elif isinstance(x, list) and x:
        for k, value in enumerate(x):
            yield from leaves(value, (*path, k))
    else:
        yield path, x


def pattern(path):
    return ".".join("*" if isinstance(x, int) else x for x in path)


def sampled(name, count=2):
    """A few fields of each kind, the same at every run."""
    kinds = {}
    for path, value in leaves(data(name)):
        if not {*path} & {*COMMENTARY}:
            deep = next((k for k, x in enumerate(path) if x in ("lhs", "rhs", "type")), len(path))
            kinds.setdefault(pattern(path[: deep + 1]), []).append((path, value))
    chance = random.Random(SEED)
    for kind, found in kinds.items():
        yield kind, chance.sample(found, min(count, len(found)))


def others(value):
    if isinstance(value, bool):
        return (not value,)
    if isinstance(value, (int, float)):
        return (value + 1,)
    return (1.5,) if value is None else (f"{value}x", "Z")


def held_with_field(name, path, value):
    """Is a record read, and in its symbols and steps held, with another value at a path, or with
    none?"""
    found = copy.deepcopy(data(name))
    *inside, last = path
    there = found
    for key in inside:
        there = there[key]
    if value is None:
        del there[last]
    else:
        there[last] = value
    if (d := read(found)) is None:
        return False
    if path[0] == "problem":
        own = Checker(d.problem, SEED)
        return all(own.check(step).holds for step in d.steps if step.scope != ANY_GROUP)
    own = checker(name)
    if path[0] == "steps" and (any(unexplained(d.steps)) or any(unused(d.steps))):
        return False
    if not own.symbols(d).holds or path[0] != "steps":
        return own.symbols(d).holds
    step = d.steps[path[1]]
    return own.check(step).holds and not ClaimChecker(d, str(SEED)).fault(step)


def fields(name) -> Changes:
    """Another value of a field; of those in HARMLESS that it is held is right."""
    for kind, found in sampled(name):
        for path, value in found:
            free = kind in HARMLESS or path[-1] in HARMLESS
            for other in (x for x in others(value) if x != value):
                yield (
                    (path, other),
                    lambda p=path, x=other, y=free: held_with_field(name, p, x) != y,
                )


def left_out(name) -> Changes:
    """A field left out; of those in OPTIONAL that it is held is right."""
    for _, found in sampled(name, 1):
        for path, value in found:
            end = next((k for k, x in enumerate(path) if x in ("lhs", "rhs", "type")), None)
            cut = path if end is None else path[: end + 1]
            while isinstance(cut[-1], int):
                cut = cut[:-1]
            # α̇ is that of X where an equation or its kind says so, else that of the motion
            rate = value in [*sum(RATES, ())]
            off_motion = rate and data(name)["steps"][path[1]]["kind"] in OFF_MOTION
            free = pattern(cut) in OPTIONAL and (off_motion or not rate)
            yield cut, lambda cut=cut, free=free: held_with_field(name, cut, None) != free


# -- symbols --------------------------------------------------------------------------------------

TYPES = (
    *("scalar", "variation", "variation at one time", "", ["function"], ["family"], ["nothing", 3]),
    *(["vector", x] for x in ("n", 3, 8)),
    *(["matrix", *x] for x in (("n", "n"), (3, 3), (3, 1))),
    ["algebra"],
    ["family", "points", "scalar"],
    ["family", "springs", ["vector", 3]],
    ["family", "basis", ["matrix", 3, 3]],
    ["function", "variation", "scalar"],
    ["function", ["matrix", "n", "n"], "scalar"],
    ["function", ["matrix", "n", "n"], ["vector", "n"], "scalar"],
    ["function", ["algebra"], ["matrix", "n", "n"]],
)


def wrong_uses(use, keys):
    """Every change of one field of what is said of a use."""
    for other in TYPES:
        if other != use["type"]:
            yield {**use, "type": other}
    for role in (*ROLES, "hero"):
        if role != use["role"]:
            yield {**use, "role": role}
    for key in ("", keys[0], keys[-1], "so3", 1):
        if key != use.get("defined", ""):
            yield {**use, "defined": key}
    for key in use:
        yield {k: x for k, x in use.items() if k != key}


@cache
def judge(name):
    return symbols.judge(record(name).steps, checker(name).environments)


def symbol_held(name, changed):
    """Is one symbol of a record read, and what it says held?"""
    d = read({**data(name), "symbols": [changed], "steps": data(name)["steps"][:1]})
    return d is not None and not judge(name).fault_of(d.symbols[0])


def symbols_held(name, listed):
    d = read({**data(name), "symbols": listed})
    return d is not None and checker(name).symbols(d).holds


def uses_of_symbols(name) -> Changes:
    """The types, roles and definitions of symbols, one use less, and one twice."""
    keys = [key for step in record(name).steps for key in step.keys]
    for symbol in data(name)["symbols"]:
        own = {x: symbol[x] for x in ("type", "role", "defined") if x in symbol}
        rest, also = {x: symbol[x] for x in symbol if x not in own}, symbol.get("also", [])
        changes = [{**rest, **x} for x in wrong_uses(own, keys)]
        for i, use in enumerate(also):
            listed = [[*also[:i], x, *also[i + 1 :]] for x in wrong_uses(use, keys)]
            changes += [{**symbol, "also": x} for x in [*listed, also[:i] + also[i + 1 :]]]
        for changed in [*changes, {**symbol, "also": [*also, own]}]:
            yield changed, lambda changed=changed: symbol_held(name, changed)


def symbols_listed(name) -> Changes:
    """A symbol too few, twice, or by another name; and one that no step uses."""
    listed = data(name)["symbols"]
    known = {x["name"] for x in listed}
    lists = [listed[:k] + listed[k + 1 :] for k in range(len(listed))]
    lists += [[*listed, symbol] for symbol in listed]
    for k, symbol in enumerate(listed):
        for other in {"A", "Λ", "0", ""} - {symbol["name"]}:
            latex = VOCABULARY[other].latex if other in VOCABULARY else ""
            for more in ({"name": other}, {"name": other, "latex": latex}):
                lists.append([*listed[:k], {**symbol, **more}, *listed[k + 1 :]])
    for spare in {"Λ", "I_D", "κ"} - known:
        lists.append([*listed, {**listed[0], "name": spare, "latex": VOCABULARY[spare].latex}])
    for changed in lists:
        names_now = [x["name"] for x in changed]
        yield names_now, lambda changed=changed: symbols_held(name, changed)


# -- all ------------------------------------------------------------------------------------------

SUPPOSING = ("ready so3", "ready se3", "ready sl3", "ready saff3", "ready comet", "ready sim3")
SUPPOSING += ("signed SL(2)", "signed SAff(2)")
SPECIAL = ("ready so3", "ready se3", "ready sl3")
TABLE = {
    equations: (
        *(
            f"ready {x}" for x in READY if x not in (*TWINS, *FLUIDS, *STARS, "hung_bar")
        ),  # in a plane
        *(f"fluid {x}" for x in FLUIDS),
        *(f"star {x}" for x in STARS),
        *(f"moved {x}" for x in TWINS),
        *(f"discrete {x}" for x in ("so3", "se3", "sl3", "gl3", "saff3", *DRIVEN_ON)),
        *(f"ellipsoid {x}" for x in ("in space", "in a plane", "in layers", "turned")),
        *("ellipsoid in layers of a plane", "torus 3", "torus stirred"),
        "points SE(3) powers outputs",
        *(f"symmetries {x}" for x in ("free", "planet", "driven", "landau", "spatial")),
        *(f"reduced {x}" for x in ("lagrange_top", "charged_body", "spatial")),
    ),
    heads: ("ready so3", "ready affine", "ready screw"),
    headers: ("ready so3", "ready se3", "ready screw", "ready jelly"),
    **dict.fromkeys((hypotheses, givens), (*SUPPOSING, *(f"fluid {x}" for x in FLUIDS))),
    quantifiers: SUPPOSING,
    **dict.fromkeys((fields, left_out), ("ready so3", "ready sl3")),
    **dict.fromkeys((uses_of_symbols, symbols_listed), SPECIAL),
}
"""Kind of change → the records that a run of the tests tries it on."""
