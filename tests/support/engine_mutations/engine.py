"""A changed engine at work: its modules loaded anew in a process of its own, its records and code.

What is imported from ``derive`` inside a function here is what the process has at that moment.
"""

import ast
import importlib
import importlib.util
import os
import pickle
import resource
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.machinery import ModuleSpec, SourceFileLoader
from multiprocessing import Pipe
from pathlib import Path
from typing import Any, NamedTuple

from coverage import Coverage

from tests.project.test_layers import ROOT, imported
from tests.support.engine_mutations.jobs import Job
from tests.support.engine_mutations.operators import Mutant

SEED = 20
"""Of the checker: the same changes get the same verdicts."""

SECONDS, MEMORY = 60, 4 << 30
"""What one job may take of the processor, and one engine of memory."""
REFUSALS = (
    "derive.",
    "builtins.ValueError",
    "builtins.AssertionError",
    "builtins.ZeroDivisionError",
)
"""Errors by which the engine refuses; others are crashes."""


class Output(NamedTuple):
    """What became of a job: ``trouble`` is empty, or "refused", "crashed", "time", with ``why``."""

    record: str = ""
    files: Any = ()
    numbers: tuple[Any, ...] = ()
    trouble: str = ""
    why: str = ""


def produce(job: Job) -> Output:
    """The record of a problem and its code, by the engine that this process has."""
    from derive.code.emit import emit
    from derive.code.options import Options
    from derive.pipeline import walk
    from derive.problem.toml import problem_of
    from derive.programs import program
    from derive.record.as_json import to_json

    problem = problem_of(job.data)
    record = found(job.sought, problem) if job.sought else walk(problem)
    if not job.coded:
        return Output(to_json(record))
    options = Options(**job.options)
    compiled = program(problem, record, options)
    files = emit(compiled, record, ("c", "python"), problem.name, options)
    return Output(to_json(record), dict(files), tuple(compiled.numbers()))


def found(sought: str, problem: Any) -> Any:
    """The record of what is found of a problem beside its walk."""
    from derive.pipeline import walk
    from derive.searches import equilibria, integrals, reduction, symmetries

    if sought in ("symmetries", "reduction"):
        return (symmetries if sought == "symmetries" else reduction)(problem, walk(problem)).record
    return (integrals(problem) if sought == "integrals" else equilibria(problem, {}))[1]


class OutOfTimeError(BaseException):
    """A job that hangs: no handler of the engine stops it."""


@contextmanager
def limited() -> Iterator[None]:
    """What is inside ends after so many seconds of processor time, with :class:`OutOfTimeError`."""

    def late(*_: object) -> None:
        raise OutOfTimeError

    signal.signal(signal.SIGPROF, late)
    signal.setitimer(signal.ITIMER_PROF, SECONDS, 1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def attempted(job: Job) -> Output:
    """The same, whatever goes wrong."""
    try:
        with limited():
            return produce(job)
    except (OutOfTimeError, MemoryError):
        return Output(trouble="time", why=f"more than {SECONDS} s, or {MEMORY >> 30} GiB")
    except Exception as error:
        kind = type(error)
        name = f"{kind.__module__}.{kind.__qualname__}"
        meant = name.startswith(REFUSALS) and "values to unpack" not in str(error)
        trouble = "refused" if meant else "crashed"
        return Output(trouble=trouble, why=f"{name}: {error}"[:400])


# -- the mutant in place of its module ----------------------------------------------------------


class Changed(SourceFileLoader):
    """Loads the changed syntax tree in place of the source."""

    def __init__(self, name: str, path: str, tree: ast.Module):
        super().__init__(name, path)
        self.tree = tree

    def get_code(self, fullname: str) -> Any:
        return compile(self.tree, self.path, "exec")


class Finder:
    """Finds one module as its mutant."""

    def __init__(self, mutant: Mutant):
        self.name, path = dotted(mutant.module), str(ROOT / mutant.module)
        self.loader = Changed(self.name, path, mutant.changed())

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        if name != self.name:
            return None
        path = self.loader.path
        return importlib.util.spec_from_file_location(name, path, loader=self.loader)


def dotted(path: str) -> str:
    """The module of a file of ``derive``."""
    return "derive." + path.removesuffix(".py").replace("/", ".").removesuffix(".__init__")


def install(mutant: Mutant, graph: dict[str, set[str]]) -> None:
    """Forget the module and all that imports it, directly or not; what comes next is the mutant."""
    for name in [x for x in sys.modules if x.split(".")[0] == "derive"]:
        if name == "derive" or mutant.module in graph.get(name, ()):
            del sys.modules[name]
            parent, _, last = name.rpartition(".")
            if parent in sys.modules:
                vars(sys.modules[parent]).pop(last, None)
    sys.meta_path.insert(0, Finder(mutant))


def imports() -> dict[str, set[str]]:
    """Module → the files of all that it imports, itself among them."""
    return {
        dotted(str(p.relative_to(ROOT))): {str(x.relative_to(ROOT)) for x in imported(p)}
        for p in ROOT.rglob("*.py")
    }


# -- processes ----------------------------------------------------------------------------------


class Process:
    """A process of its own in which a module is its mutant."""

    def __init__(self, mutant: Mutant, graph: dict[str, set[str]]):
        self.connection, other = Pipe()
        self.child = os.fork()
        if not self.child:
            try:
                most = MEMORY + addressed()  # what other tests have loaded is there already
                resource.setrlimit(resource.RLIMIT_AS, (most, most))
                serve(mutant, graph, other)
            finally:
                os._exit(0)
        other.close()

    def output(self, job: Job) -> Output:
        """What becomes of a job; one that ends its process has crashed."""
        try:
            self.connection.send((job, None))
            return self.connection.recv()
        except (EOFError, OSError):
            return Output(trouble="crashed", why="the process died")

    def refuses(self, job: Job, labels: list[str]) -> bool:
        """Does a checker that has the change too refuse one of these steps of the last output?

        Without labels, the validator its code.
        """
        try:
            self.connection.send((job, labels))
            return self.connection.recv()
        except (EOFError, OSError):
            return True

    def stop(self) -> None:
        """End it."""
        self.connection.close()
        os.kill(self.child, signal.SIGKILL)
        os.waitpid(self.child, 0)


def serve(mutant: Mutant, graph: dict[str, set[str]], connection: Any) -> None:
    """Answer with outputs, and with what the checker of this process says of the last of them."""
    broken, last = Output(), Output()
    try:
        install(mutant, graph)
        importlib.import_module("derive.programs")
    except BaseException as error:  # it cannot even be imported
        broken = Output(trouble="crashed", why=f"{type(error).__name__}: {error}"[:400])
    while True:
        job, labels = connection.recv()
        if labels is None:
            last = broken if broken.trouble else attempted(job)
            connection.send(last)
        else:
            connection.send(refuses(job, last, labels))


def refuses(job: Job, output: Output, labels: list[str]) -> bool:
    """Does this process refuse one of these steps, or the code, or break on it, or hang?"""
    from derive.check.checker import checker_of
    from derive.record.as_json import from_json

    try:
        with limited():
            d = from_json(output.record)
            if not labels:
                return any(not r.holds for r in read_back(job, output))
            checker = checker_of(d.problem, SEED)
            return not all(checker.check(s).holds for s in d.steps if s.label in labels)
    except (Exception, OutOfTimeError):
        return True


def read_back(job: Job, output: Output) -> list[Any]:
    """What the validator says of emitted code."""
    from derive.record.as_json import from_json
    from derive.validate.chart import Chart
    from derive.validate.emission import EmittedFiles

    chosen = {k: x for k, x in job.options.items() if k in Chart.__dataclass_fields__}
    name, record = job.data["name"], from_json(output.record)
    return EmittedFiles(output.files, name, Chart(**chosen), output.numbers).reports(record)


# -- what a job runs ----------------------------------------------------------------------------


def reached(job: Job | None, files: set[str]) -> dict[str, set[int]]:
    """The lines of some files of ``derive`` that a job runs, loading included if it is derived; for
    ``None`` those that loading alone runs."""
    for name in [
        x for x in sys.modules if x.split(".")[0] == "derive" and not (job and job.refused)
    ]:
        del sys.modules[name]
    watch = Coverage(data_file=None, config_file=False, include=[str(ROOT / x) for x in files])
    watch.set_option("run:disable_warnings", ["no-data-collected"])
    watch.start()
    try:
        if job is None:
            importlib.import_module("derive.programs")
        else:
            attempted(job)
    finally:
        watch.stop()
    data = watch.get_data()
    return {x: {*(data.lines(str(ROOT / x)) or ())} for x in files}


def addressed() -> int:
    """The bytes of addresses of this process; 0 where that is not told."""
    told = Path("/proc/self/statm")
    pages = int(told.read_text(encoding="ascii").split()[0]) if told.exists() else 0
    return pages * resource.getpagesize()


def in_a_process(task: Any) -> Any:
    """The value of ``task()``, from a fork."""
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        try:
            with os.fdopen(writing, "wb") as out:
                pickle.dump(task(), out)
        finally:
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        value = pickle.load(stream)
    os.waitpid(child, 0)
    return value


def source(path: str) -> str:
    """The text of a file of ``derive``."""
    return (Path(ROOT) / path).read_text(encoding="utf-8")
