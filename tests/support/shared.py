"""What the engine makes of a problem, made once for the tests of a room: its record, and, on the
disk, its programs, what its motion keeps, and what is compiled; all else is made of these."""

import pickle
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import derive.command.emitting
import derive.command.simulating
import derive.python.compiled  # noqa: F401  (all that name a function of the pipeline, before it is another)
from derive import pipeline, programs, searches
from derive.motion import native
from derive.problem.problem import Problem
from derive.record.as_json import to_json
from derive.record.record import Derivation
from derive.walk.spine.head import problem_data
from tests.support.cached import place, read, write

TESTS = Path(__file__).parents[1]
RECORDS = {}
"""id → a record and its text, that no other record has its id."""
MADE = {}


def text(x):
    """All of an argument that what is made depends on."""
    if isinstance(x, Problem):
        followed = x.parameters, x.title, x.events, x.initial, x.signed, x.frame
        return repr((problem_data(x), followed))
    if isinstance(x, Derivation):
        if id(x) not in RECORDS:
            RECORDS[id(x)] = x, to_json(x)
        return RECORDS[id(x)][1]
    return repr(x)


def once(make, *, on_disk):
    """A function of the pipeline whose results for equal arguments are made once; what is refused
    is refused again."""

    def found(*given, **chosen):
        told = repr((make.__name__, [*map(text, given)], sorted(chosen.items())))
        path = place(told)
        if path not in MADE:
            if on_disk and path.is_file():
                MADE[path] = pickle.loads(path.read_bytes())
            else:
                MADE[path] = make(*given, **chosen)
                if on_disk:
                    write(path, MADE[path])
        return MADE[path]

    return found


KEPT_ON_DISK = {pipeline.walk: False, pipeline.discrete: True, programs.motion_of: False}
KEPT_ON_DISK |= {programs.one_degree: True, programs.program: True}
KEPT_ON_DISK |= {searches.conserved_quantities: True}
OWN = {make.__name__: make for make in KEPT_ON_DISK}
ONCE = {name: once(make, on_disk=KEPT_ON_DISK[make]) for name, make in OWN.items()}


def compiled_once(folder, source, what, compiler=None):
    """The library of C, made once for all processes; with fewer optimisations where no test names
    its own, as to compile takes longer than to run.  What has headers of its own is made anew."""
    compiler, target = compiler or native._compiler(source.compiler), folder / f"{source.name}.so"
    if "-I" in source.flags:
        return OWN["compiled_into"](folder, source, what, compiler)
    quick = replace(source, flags=tuple("-O1" if x == "-O3" else x for x in source.flags))
    kept = place("library", compiler, repr(quick))
    if not kept.is_file():
        write(kept, OWN["compiled_into"](folder, quick, what, compiler).read_bytes())
    target.write_bytes(read(kept))
    return target


OWN["compiled_into"], ONCE["compiled_into"] = native.compiled_into, compiled_once

ROOMS = ("code", "command", "motion", "page", "plot", "python", "validate", "walk")
CHANGED = "code/test_c_agrees code/test_generated walk/lie/test_torus"
CHANGED = (*CHANGED.split(" "), "walk/test_any_problem", "walk/test_fluid", "walk/test_stages")


@pytest.fixture(autouse=True, scope="module")
def made_once(request):
    """In these rooms of tests, wherever the engine has a name of the pipeline, what it makes is
    shared, in the others what is compiled alone; nothing in a file that changes the engine."""
    file = request.path.relative_to(TESTS).with_suffix("").as_posix()
    names = ONCE if file.partition("/")[0] in ROOMS else ["compiled_into"]
    with pytest.MonkeyPatch.context() as patch:
        if file not in CHANGED:
            modules = [x for name, x in sys.modules.items() if name.startswith("derive.")]
            for module in (*modules, request.module):
                for name in names:
                    if vars(module).get(name) is OWN[name]:
                        patch.setattr(module, name, ONCE[name])
        yield
