"""All mutants of some modules, each with its verdict."""

import multiprocessing
import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from random import Random

from tests.project.test_layers import ROOT, imported
from tests.support.engine_mutations.engine import (
    Output,
    Process,
    attempted,
    imports,
    in_a_process,
    reached,
    source,
)
from tests.support.engine_mutations.jobs import Job
from tests.support.engine_mutations.judge import CAUGHT, HARMLESS, LATE, Verdict, judged
from tests.support.engine_mutations.operators import Mutant, mutants

ROOMS = (
    *("language", "algebra", "problem", "code", "walk"),
    *(f"walk/{x}" for x in ("spine", "given", "matrices", "lie", "fluid")),
    *(f"search/{x}" for x in ("integrals", "symmetries", "equilibria")),
)
LEFT = {
    "language/show.py": "prints trees",
    "algebra/samplers.py": "the checker's alone",
    "problem/mesh.py": "reads files of meshes, for which the oracle has no reader",
    "code/languages.py": "how the languages are written, compared with C by their own tests",
    "code/conventions.py": "words of comments, at the head of a file too",
    "code/naming.py": "names of intermediate numbers",
    "code/options.py": "names of choices",
    "code/requests.py": "the same in the head of a file",
    "code/signatures.py": "arguments of functions, compared with C by the tests of languages",
    "code/emit.py": "fills templates",
    "python/expressions.py": "the same program for SymPy, compared with it by its own tests",
}
"""Modules that hold none of the mathematics of a record or of its code."""
MODULES = [
    *(
        path
        for room in ROOMS
        for path in sorted(str(p.relative_to(ROOT)) for p in (ROOT / room).glob("*.py"))
        if path not in LEFT and not path.endswith("__init__.py")
    ),
    "pipeline.py",
    "searches.py",
    "programs.py",
]
MOST = 5
"""Jobs on which one mutant is tried, of those that reach it."""
PATIENCE = 900
"""Seconds for one mutant, its verdict included."""
WORST = (*HARMLESS, "survived")


class Survey:
    """What the unchanged engine makes of the jobs, and the lines that each of them runs."""

    def __init__(self, modules: Sequence[str], jobs: Sequence[Job]):
        self.jobs = jobs
        self.graph = imports()
        self.shared = {str(p.relative_to(ROOT)) for p in imported(ROOT / "check" / "checker.py")}
        self.outputs: list[Output] = [attempted(job) for job in jobs]
        for job, output in zip(jobs, self.outputs, strict=True):
            assert job.refused in output.why, (job.name, output.why)
            assert output.trouble == ("refused" if job.refused else ""), (job.name, output.why)
        files = {*modules}
        self.lines = [in_a_process(lambda job=job: reached(job, files)) for job in jobs]
        self.loaded: dict[str, set[int]] = in_a_process(lambda: reached(None, files))

    def reaching(self, m: Mutant) -> list[int]:
        """The jobs that run a line that is changed: what is made wrong where the module is loaded,
        a letter say, shows in those that run more of it, if there are any."""
        span = range(m.lines[0], m.lines[1] + 1)
        found = [i for i, x in enumerate(self.lines) if not x[m.module].isdisjoint(span)]
        return [i for i in found if self.lines[i][m.module] - self.loaded[m.module]] or found

    def verdict(self, m: Mutant) -> Verdict:
        """The first that catches it, or the worst of what it does unnoticed."""
        jobs = self.reaching(m)[:MOST]
        if not jobs:
            return Verdict("not reached")
        process, worst = Process(m, self.graph), Verdict("same")
        try:
            for i in jobs:
                job, old = self.jobs[i], self.outputs[i]
                new = process.output(job)
                certain = process.refuses if m.module in self.shared else lambda job, labels: True
                found = judged(job, new, old, certain)
                if found.outcome in CAUGHT:
                    return found._replace(why=f"{job.name}: {found.why}")
                if WORST.index(found.outcome) > WORST.index(worst.outcome):
                    worst = found._replace(why=f"{job.name}: {found.why}")
        except TimeoutError:
            return Verdict("survived", LATE)
        finally:
            process.stop()
        return worst


def chosen(modules: Sequence[str], sample: int | None, seed: int) -> list[Mutant]:
    """All mutants of some modules, or a sample in which every module has its share."""
    listed = [list(mutants(path, source(path))) for path in modules]
    if sample is None:
        return [m for group in listed for m in group]
    random = Random(seed)
    drawn = [m for group in listed for m in random.sample(group, len(group))[: sample + 1]]
    random.shuffle(drawn)
    return sorted(drawn[:sample], key=lambda m: modules.index(m.module))


def results(
    found: list[Mutant], survey: Survey, processes: int = 1
) -> Iterator[tuple[Mutant, Verdict]]:
    """Every mutant with its verdict, as they come."""

    def one(k: int) -> tuple[int, Verdict]:
        def late(*_: object) -> None:
            raise TimeoutError

        signal.signal(signal.SIGALRM, late)
        signal.alarm(PATIENCE)
        try:
            return k, survey.verdict(found[k])
        except TimeoutError:
            return k, Verdict("survived", LATE)
        except Exception as error:  # the judge has to be mended; the run goes on
            return k, Verdict("survived", f"no verdict: {type(error).__name__}: {error}"[:200])
        finally:
            signal.alarm(0)

    global _one
    _one = one
    fork = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(processes, mp_context=fork) as pool:
        for done in as_completed([pool.submit(_call, k) for k in range(len(found))]):
            k, verdict = done.result()
            yield found[k], verdict


def _call(k: int) -> tuple[int, Verdict]:
    return _one(k)
