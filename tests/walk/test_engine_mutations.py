"""A sample of `python -m tests.support.engine_mutations`: a wrong rule of the engine does not pass.

`make mutants` tries all of them.
"""

import pytest

from derive.problem.toml import problem_of
from tests.project.test_layers import ROOT
from tests.support.engine_mutations.jobs import JOBS
from tests.support.engine_mutations.judge import CAUGHT, numbers
from tests.support.engine_mutations.operators import mutants
from tests.support.engine_mutations.run import LEFT, MODULES, ROOMS, Survey, chosen, results
from tests.support.engine_mutations.table import counted, table, wrong
from tests.support.library import emission

pytestmark = pytest.mark.no_cover
SAMPLE, SEED = 15, 7
WRONG = 5
FIRST = JOBS[:4]
"""The texts about any group, SL(3) by words and SO(3) by vectors, each with all its forces."""


@pytest.fixture(scope="module")
def survey():
    return Survey(MODULES, FIRST)


def test_every_module_is_changed_or_left_for_a_reason():
    assert all((ROOT / room).is_dir() for room in ROOMS)
    files = {str(p.relative_to(ROOT)) for room in ROOMS for p in (ROOT / room).glob("*.py")}
    assert {x for x in files if not x.endswith("__init__.py")} <= {*MODULES, *LEFT}


JUDGED = [x for x in JOBS if not (x.refused or x.framed) and x.coded and x.plain]


@pytest.mark.parametrize("job", JUDGED, ids=[f"{x.name} {x.options}" for x in JUDGED])
def test_the_oracle_agrees_with_what_is_not_changed(job):
    """Else any change would be caught."""
    name, texts = emission(problem_of(job.data), ("python",), **job.options)
    assert numbers(job, texts[f"{name}.py"]) == ""


RULES = [  # module, change, which of FIRST is tried
    ("algebra/calculus.py", "sign: delta_prime - delta  →  delta_prime + delta", 2),
    ("algebra/words.py", "condition: not bar  →  bar", 2),
    ("algebra/calculus.py", "term: total + term  →  total", 2),
    ("walk/spine/cartan.py", "transpose: covector.bar  →  covector", 1),
    ("walk/spine/alphabet.py", "factor: ('inv', x.name)  →  x.name", 2),
    ("code/lower.py", "comparison: i == j  →  i != j", 3),
]


@pytest.mark.parametrize(("module", "change", "job"), RULES)
def test_a_wrong_rule_is_caught(module, change, job):
    """The structure equation, the transpose, the product rule, and others."""
    (one, *_) = [m for m in mutants(module, (ROOT / module).read_text()) if change in str(m)]
    ((_, verdict),) = results([one], Survey([module], [FIRST[job]]))
    assert verdict.outcome in CAUGHT, verdict


def test_a_sample_of_all_rules(survey):
    """Samples are drawn until enough of them are wrong: most change what these four never run."""
    found, whole = [], 0
    for seed in range(SEED, SEED + 8):
        found += results(chosen(MODULES, SAMPLE, seed), survey)
        caught, whole = map(sum, zip(*map(wrong, counted(found).values()), strict=True))
        if whole >= WRONG:
            break
    print(table(counted(found)))
    survived = [(str(m), v.why) for m, v in found if v.outcome == "survived"]
    assert not survived
    assert caught == whole >= WRONG
