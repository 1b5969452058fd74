"""`--trivialisation both`: what holds for any Lagrangian, on the left beside the right."""

import pytest

from derive.command.cli import main
from derive.command.showing import derive
from derive.pipeline import both_trivialisations
from derive.views.rendering import FORMATS, render


@pytest.fixture(scope="module", params=["gyrostat", "so3", "kirchhoff"])
def record(request):
    return derive(request.param)[1]


def test_each_step_beside_its_like(record):
    labels = [s.label for s in both_trivialisations(record).steps]
    on_left = [x for x in labels if x.startswith("left.")]
    assert len(on_left) > 8
    beside = [y for x in on_left for y in (x, x.replace("left.", "right."))]
    assert labels[: len(beside)] == beside
    assert {s.label for s in record.steps} <= {*labels}
    assert len({*labels}) == len(labels)


@pytest.mark.parametrize("form", [x for x in FORMATS if x != "json"])
@pytest.mark.parametrize("lang", ["en", "fr"])
def test_every_format(record, form, lang):
    shown = render(both_trivialisations(record), form, lang)
    assert shown.index("left.structure") < shown.index("right.structure")
    if form == "html":
        assert ("beside the right" if lang == "en" else "à gauche et à droite") in shown


def test_the_command(capsys):
    steps = ["left.structure", "right.structure"]
    assert main(["walk", "gyrostat", *steps, "--trivialisation", "both"]) == 0
    out = capsys.readouterr().out
    assert "left.structure" in out
    assert "right.structure" in out
