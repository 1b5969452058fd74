"""A fluid in every view: which accelerations its equations hold for, its letters, references."""

import re

import pytest

from derive.views.outline import assumed, moving
from derive.views.rendering import FORMATS, render
from tests.support.walks import FLUIDS, record

ON_MOTIONS = {"energy_kept": 1, "circulation": 1, "kelvin": 2}
"""Of the equations that say something of the acceleration, how many hold on motions alone."""
EVERY = {"en": "for every", "fr": "pour tout"}
ALONG = {"en": "along the motion", "fr": "le long du mouvement"}

CLAUSES = {
    "text": re.compile(r"(?m)^ {6}.*\S  (\w.*)$"),
    "latex": re.compile(r"\\text\{([^}]*)\}"),
    "markdown": re.compile(r"\\text\{([^}]*)\}"),
    "html": re.compile("<mtext>([^<]*)</mtext>"),
}
"""Format → what stands at the end of an equation."""


@pytest.mark.parametrize("name", FLUIDS)
def test_which_equations_hold_along_the_motion_alone(name):
    for step in record(name).steps:
        short = step.label.removeprefix(f"{name}.")
        found = moving(step.equations)
        assert len(found) == ON_MOTIONS.get(short, 0), step.label
        assert not any(e.for_all for e in found)
        free = any("u̇" in e.for_all or "ν̇" in e.for_all for e in step.equations)
        assert ("for any acceleration" in assumed(step)) == (free and not found), step.label


@pytest.mark.parametrize("lang", EVERY)
@pytest.mark.parametrize("form", [x for x in FORMATS if x != "json"])
def test_every_view_says_it_beside_the_equation(form, lang):
    d = record("inhomogeneous_fluid")
    for short, others in ON_MOTIONS.items():
        shown = render(d, form, lang, steps=[d[short]])
        clauses = [x.replace("\u00a0", " ").strip() for x in CLAUSES[form].findall(shown)]
        free = sum(bool(e.for_all) for e in d[short].equations)
        assert sum(x.startswith(EVERY[lang]) for x in clauses) == free
        assert clauses.count(ALONG[lang]) == others
        assert "any acceleration" not in shown
        assert "accélération quelconque" not in shown
