"""The table of the pipeline against the functions that it names, and against what runs."""

from collections.abc import Callable
from typing import Any, get_args

import pytest

from derive import pipeline
from derive.problem.inertia import Bodies
from derive.walk.chapter import Stage
from tests.support.walks import NAMES, OTHERS, problem


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
