"""The table of the pipeline against the functions that it names, and against what runs."""

import types
from collections.abc import Callable
from typing import Any, get_args, get_type_hints

import pytest

from derive import pipeline
from derive.algebra.groups import Group
from derive.problem.inertia import Bodies
from derive.problem.problem import Problem
from derive.record.record import Step
from derive.walk.chapter import Chapter, Stage
from derive.walk.spine.alphabet import Alphabet
from tests.support.walks import NAMES, OTHERS, problem

ROADS = {
    "any group": pipeline.ANY_GROUP,
    "matrices": pipeline.MATRICES,
    "vectors": pipeline.VECTORS,
}
START = {"a": Alphabet, "c": Chapter, "c_u": Chapter, "problem": Problem, "group": Group}


def said(hint):
    """A type as the table says it, without None."""
    hint = present(hint)
    if hint == Bodies:
        return "Bodies"
    return "Steps" if hint == tuple[Step, ...] else getattr(hint, "__name__", str(hint))


def may_be_missing(hint):
    return types.NoneType in get_args(hint)


def present(hint):
    """A type without None."""
    if not may_be_missing(hint):
        return hint
    (found,) = (x for x in get_args(hint) if x is not types.NoneType)
    return found


def given(stage):
    """The type of what a stage gives, as its function has it."""
    if isinstance(stage.run, type):
        return tuple[Step, ...] if stage.run is tuple else stage.run
    return get_type_hints(stage.run)["return"]


def field(of, name):
    member = getattr(of, name, None)
    if isinstance(member, property):
        return get_type_hints(member.fget)["return"]
    return get_type_hints(of)[name]


def takes(stage, known):
    """Name and type of all that a stage takes."""
    for path in stage.takes.split():
        name, *fields = path.rstrip("?").split(".")
        found = known[name]
        for x in fields:
            found = field(found, x)
        yield path, found


def rows():
    for name, road in ROADS.items():
        known = dict(START)
        for other in () if road is pipeline.ANY_GROUP else pipeline.ANY_GROUP:
            known[other.name] = given(other)
        for stage in road:
            yield pytest.param(stage, dict(known), id=f"{name}-{stage.name}-{stage.on}")
            known[stage.name] = present(given(stage))


@pytest.mark.parametrize(("stage", "known"), [*rows()])
def test_a_row_says_what_its_function_takes_and_gives(stage: Stage, known: dict[str, Any]):
    assert said(given(stage)) == stage.gives
    if stage.run is tuple:
        return
    hints = get_type_hints(stage.run.__init__ if isinstance(stage.run, type) else stage.run)
    wanted = [x for name, x in hints.items() if name != "return"]
    found = dict(takes(stage, known))
    assert len(found) == len(stage.takes.split())
    for (path, hint), want in zip(found.items(), wanted, strict=False):
        assert said(want) in (said(hint), "Mapping") or want is Any, path
        assert may_be_missing(want) or not path.endswith("?"), path
    defaults = (stage.run.__defaults__ or ()) if isinstance(stage.run, types.FunctionType) else ()
    assert len(wanted) - len(defaults) <= len(found) <= len(wanted)


@pytest.mark.parametrize("name", dict.fromkeys((*NAMES, *OTHERS)))
def test_what_runs_is_what_the_table_says(name, monkeypatch):
    ran, asked = [], problem(name)
    run: Callable[..., Any] = Stage.value

    def told(stage, values):
        found = run(stage, values)
        ran.append((stage, found))
        return found

    monkeypatch.setattr(Stage, "value", told)
    roads = (pipeline.general_road, pipeline.lagrangian_road)
    for road in roads:
        road.cache_clear()
    pipeline.walk(asked)
    for road in roads:
        road.cache_clear()
    group = asked.group
    special = (
        () if group is None else (pipeline.VECTORS if group.turns_space else pipeline.MATRICES)
    )
    order = [*pipeline.ANY_GROUP, *special]
    if asked.lagrangian:
        order = [*pipeline.ANY_LAGRANGIAN, *pipeline.EXPRESSED]
    if asked.torus:
        order = [*pipeline.ANY_LAGRANGIAN, *pipeline.ON_THE_TORUS]
    places = [order.index(stage) for stage, _ in ran]
    assert places == sorted(places)
    for stage, found in ran:
        kind = "Steps" if isinstance(found, tuple) else type(found).__name__
        kind = "Bodies" if found in get_args(Bodies) else kind
        assert kind in (stage.gives, "NoneType"), stage.name
