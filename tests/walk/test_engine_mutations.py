"""A sample of `python -m tests.support.engine_mutations`: a wrong rule of the engine does not pass.

`make mutants` tries all of them.
"""

import ast
from dataclasses import replace

import pytest

from derive.problem.toml import problem_of
from derive.record.as_json import to_json
from derive.record.record import Equation
from tests.project.test_layers import ROOT
from tests.support.engine_mutations import ledger
from tests.support.engine_mutations.engine import Output
from tests.support.engine_mutations.jobs import JOBS
from tests.support.engine_mutations.judge import CAUGHT, LATE, Verdict, equations, numbers
from tests.support.engine_mutations.known import EXPLAINED, reason
from tests.support.engine_mutations.operators import mutants
from tests.support.engine_mutations.run import LEFT, MODULES, ROOMS, Survey, chosen, results
from tests.support.engine_mutations.table import counted, line, table, told, wrong
from tests.support.library import emission
from tests.support.walks import record

pytestmark = pytest.mark.no_cover
SAMPLE, SEED = 15, 7
WRONG = 8
FIRST = JOBS[:4]
"""The texts about any group, SL(3) by words and SO(3) by vectors, each with all its forces."""


@pytest.fixture(scope="module")
def survey():
    return Survey(MODULES, FIRST)


def changed(source):
    return {f"{m.kind}: {ast.unparse(m.changed()).strip()}" for m in mutants("x.py", source)}


def test_the_changes_of_an_expression():
    assert changed("a - b.bar") == {
        "sign: a + b.bar",
        "term: a",
        "transpose: a - b",
    }
    assert changed("add(x, neg(y))") == {
        "term: add(neg(y))",
        "term: add(x)",
        "sign: add(('mul', -1, x), neg(y))",
        "sign: add(x, ('mul', -1, neg(y)))",
        "sign: add(x, y)",
    }
    assert changed("('mul', a, ('T', b))") == {
        "factor: ('T', b)",
        "factor: a",
        "order: ('mul', ('T', b), a)",
        "sign: ('mul', -1, ('mul', a, ('T', b)))",
        "sign: ('mul', a, ('mul', -1, ('T', b)))",
        "transpose: ('mul', a, b)",
    }
    assert changed("stated('c = m⁻¹ζ̄')") == {
        "factor: stated('c = m⁻¹')",
        "factor: stated('c = ζ̄')",
        "factor: stated('c = mζ̄')",
        "order: stated('c = ζ̄m⁻¹')",
        "sign: stated('c = (−m⁻¹) ζ̄')",
        "sign: stated('c = m⁻¹(−ζ̄)')",
        "sign: stated('c = −m⁻¹ζ̄')",
        "transpose: stated('c = m⁻¹ζ')",
    }
    assert changed("x = c[i][j] if n < 2 else c[i, j]") == {
        "indices: x = c[j][i] if n < 2 else c[i, j]",
        "indices: x = c[i][j] if n < 2 else c[j, i]",
        "comparison: x = c[i][j] if n <= 2 else c[i, j]",
        "condition: x = c[i][j] if not n < 2 else c[i, j]",
        "number: x = c[i][j] if n < 3 else c[i, j]",
    }
    assert changed("def f(x: int = 1) -> 'T':\n    raise ValueError(x + 1)") == {
        "number: def f(x: int=2) -> 'T':\n    raise ValueError(x + 1)"
    }


def test_every_module_is_changed_or_left_for_a_reason():
    assert all((ROOT / room).is_dir() for room in ROOMS)
    files = {str(p.relative_to(ROOT)) for room in ROOMS for p in (ROOT / room).glob("*.py")}
    assert {x for x in files if not x.endswith("__init__.py")} <= {*MODULES, *LEFT}
    assert {module for module, _ in EXPLAINED} <= {*MODULES}


JUDGED = [x for x in JOBS if not (x.refused or x.framed) and x.coded and x.plain]


@pytest.mark.parametrize("job", JUDGED, ids=[f"{x.name} {x.options}" for x in JUDGED])
def test_the_oracle_agrees_with_what_is_not_changed(job):
    """Else any change would be caught."""
    name, texts = emission(problem_of(job.data), ("python",), **job.options)
    assert numbers(job, texts[f"{name}.py"]) == ""


RULES = [  # module, change, which of FIRST is tried
    ("algebra/forms.py", "sign: delta_prime - delta  →  delta_prime + delta", 2),
    ("algebra/words.py", "condition: not bar  →  bar", 2),
    ("algebra/calculus.py", "term: total + term  →  total", 2),
    ("walk/spine/cartan.py", "transpose: covector.bar  →  covector", 1),
    ("walk/matrices/solution.py", "factor: ('inv', x.name)  →  x.name", 2),
    ("code/lower.py", "comparison: i == j  →  i != j", 3),
]


@pytest.mark.parametrize(("factor", "outcome"), [(2, "equations"), (3, "checker")])
def test_a_fluid_is_judged_by_its_own_checker(factor, outcome):
    """The one for matrices refuses true equations of fluids as well."""
    d = record("ideal_fluid")
    step = d["energy_kept"]
    other = Equation(("mul", factor, "h̃"), ("norm2", "u"))
    changed = replace(step, equations=(other, *step.equations[1:]))
    new = replace(d, steps=tuple(changed if x is step else x for x in d.steps))
    assert equations(*(Output(to_json(x)) for x in (new, d))).outcome == outcome


def test_a_wrong_letter_is_tried_on_what_uses_it():
    """Loading runs its line for every job; of two, one runs more of the module."""
    module, names = "walk/fluid/circulation.py", ("linear", "ideal_fluid")
    survey = Survey([module], [x for name in names for x in JOBS if x.name == name])
    skew, *_ = (m for m in mutants(module, (ROOT / module).read_text()) if "sign: -1" in str(m))
    assert survey.reaching(skew) == [1]


def test_a_run_goes_on_where_it_ended():
    """With what has a verdict; a change that stands twice on a line is two."""
    some = list(mutants("x.py", "def f(x):\n    return g(x, 1), g(x, 1), x + 2"))
    done = [*some[:3], some[-1]]
    lines = [line(m, Verdict("same", str(k))) for k, m in enumerate(done)]
    lines.append(line(some[4], Verdict("survived", LATE)))
    found, left = told(lines, some)
    assert sorted(map(str, left)) == sorted(map(str, some[3:-1]))
    assert len(found) == len(done)


def test_the_ledger(tmp_path, monkeypatch):
    """A module is in it until its text changes; what survived is told with it."""
    monkeypatch.setattr(ledger, "FILE", tmp_path / "figures.json")
    one, two, three = list(mutants("pipeline.py", "x = f(a - b, 1)"))[:3]
    other = two._replace(module="walk/spine/cartan.py")
    found = [(one, Verdict("checker")), (two, Verdict("survived", "why")), (other, Verdict("same"))]
    ledger.save("pipeline.py", [*found, (three, Verdict("checker"))])
    ledger.save("walk/spine/cartan.py", found)
    kept = ledger.load()
    assert kept["pipeline.py"] == ({"checker": 2, "survived": 1}, [f"survived: {two}: why"])
    assert kept["walk/spine/cartan.py"] == ({"same": 1}, [])
    monkeypatch.setattr(ledger, "digest", lambda module: module)
    assert ledger.load() == {}


def test_what_was_judged_whole():
    """Each module with all its changes, and none that nothing notices."""
    kept = ledger.load()
    for module, row in kept.items():
        assert row.outcomes.total() == len(list(mutants(module, (ROOT / module).read_text())))
        assert not [x for x in row.told if x.startswith("survived")]
    assert {*kept} <= {*MODULES}


@pytest.mark.parametrize(("module", "change", "job"), RULES)
def test_a_wrong_rule_is_caught(module, change, job):
    """The structure equation, the transpose, the product rule, and others."""
    (one, *_) = [m for m in mutants(module, (ROOT / module).read_text()) if change in str(m)]
    ((_, verdict),) = results([one], Survey([module], [FIRST[job]]))
    assert verdict.outcome in CAUGHT, verdict


def test_another_basis_of_the_same_algebra_is_no_fault(survey):
    """Transposed units are one of SL(3): all that is derived is true of it, and so is the code."""
    module, change = "algebra/families.py", "order: q.unit(n, i, j)  →  q.unit(n, j, i)"
    found = [m for m in mutants(module, (ROOT / module).read_text()) if change in str(m)]
    one = found[1]  # the first is in so_basis
    ((_, verdict),) = results([one], survey)
    assert verdict.outcome == "equations", verdict


def test_a_sample_of_all_rules(survey):
    """Samples are drawn until enough of them are wrong: most change what these four never run."""
    found, whole = [], 0
    for seed in range(SEED, SEED + 8):
        found += results(chosen(MODULES, SAMPLE, seed), survey)
        caught, whole = map(sum, zip(*map(wrong, counted(found).values()), strict=True))
        if whole >= WRONG:
            break
    print(table(counted(found)))
    survived = [(str(m), v.why) for m, v in found if v.outcome == "survived" and not reason(m)]
    assert not survived
    assert caught == whole >= WRONG
