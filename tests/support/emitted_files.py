"""The emitted files of a problem, held against its record by the validator."""

import tomllib
from functools import cached_property
from types import ModuleType

from derive.code.emit import emit
from derive.code.naming import own_prefix
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.support import walks

READ = ("c", "python", "rust", "javascript", "julia")
"""The languages that are read back whole."""
ENDS = dict(zip(READ, (".c", ".py", ".rs", ".mjs", ".jl"), strict=True))


class Emission:
    """What is emitted of a problem, ``given``: a ready-made one by its name, the text of a file, or
    its data, or itself."""

    def __init__(self, given, languages=("c", "python"), prefix=None, **options):
        ready = isinstance(given, str) and "\n" not in given
        data = tomllib.loads(given) if isinstance(given, str) and not ready else given
        data = problem_of(data) if isinstance(data, dict) else data
        self.problem = walks.problem(given) if ready else data
        self.record = walks.record(given) if ready else walk(self.problem)
        self.name, self.options = prefix or own_prefix(self.problem.name), Options(**options)
        self.program = program(self.problem, self.record, self.options)
        self.files = emit(self.program, self.record, languages, self.name, self.options)
        self.chart = Chart(*(options.get(x, y) for x, y in vars(Chart()).items()))

    def reports(self, changed=None, fresh=None, files=None):
        """What is said of the files, some changed; ``fresh``: what they should be."""
        files = (self.files if files is None else files) | (changed or {})
        given = self.options.frame == "given"
        numbers = self.program.numbers()
        found = EmittedFiles(files, self.name, self.chart, numbers, given, fresh)
        return found.reports(self.record)

    def refused(self, changed):
        """What is said where the files do not hold; "" where they all do."""
        return " ".join(x.text for x in self.reports(changed) if not x.holds)

    @cached_property
    def module(self):
        """The Python that is emitted, as a module."""
        made = ModuleType(self.name)
        exec(compile(self.files[f"{self.name}.py"], f"{self.name}.py", "exec"), vars(made))
        return made
