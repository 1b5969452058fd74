"""What is done with a file of a stranger: every command is watched, its files are looked at."""

import os
import shutil
import tempfile
import zipfile
from contextlib import contextmanager, suppress
from itertools import chain
from pathlib import Path

from derive.check.checker import Checker
from derive.code.languages import LANGUAGES
from derive.command.writing import StoppedError, time_limit
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import load
from derive.record.as_json import from_json, to_json
from derive.record.record import ANY_GROUP, RecordError
from derive.views.rendering import FORMATS, render
from tests.fuzz.mutate import SOLID, binary_stl, mesh
from tests.fuzz.outputs import wrong_with
from tests.fuzz.watch import SECONDS, judged, run, uncaught, watched
from tests.fuzz.watch import slack as slack_now
from tests.support.walks import SEED

MESH = """
name = "meshed"
group = "SE(3)"
[body]
solid = "mesh"
density = 2
file = "{}"
"""
SMALLEST = 'name = "top"\ngroup = "SO(2)"\n[[point]]\nmass = 1\nat = [1, 0]\n'
ALONE = ("c", "python", "fmu")
OTHERS = [x for name in LANGUAGES if name not in ALONE for x in ("--lang", name)]
COMMANDS = {
    "text": ("walk", "{}", "--out", "out/walk.txt"),
    "french": ("walk", "{}", "--lang", "fr", "--out", "out/walk.txt"),
    "latex": ("walk", "{}", "--format", "latex", "--out", "out/walk.tex"),
    "html": ("walk", "{}", "--format", "html", "--out", "out/walk.html"),
    "markdown": ("walk", "{}", "--format", "markdown", "--out", "out/walk.md"),
    "json": ("walk", "{}", "--format", "json", "--out", "out/walk.json"),
    "emit": ("emit", "{}", "--lang", "c", "--lang", "python", "--out", "out"),
    "others": ("emit", "{}", *OTHERS, "--out", "out"),
    "every": ("emit", "{}", "--lang", "c", "--lang", "python", *OTHERS, "--out", "out"),
    "fmu": ("emit", "{}", "--lang", "fmu", "--out", "out"),
    "framed": ("emit", "{}", "--frame", "principal", "--jacobian", "state", "--out", "out"),
    "notes": ("notes", "{}", "--out", "out/notes.tex"),
    "check": ("check", "{}", "--seconds", f"{SECONDS * 0.8}"),
}
"""Only checking may take longer than a case has, and is stopped."""
SEEN = ("text", "html", "emit", "notes")
"""What reads solids and draws them; all else that commands import, any body brings."""


@contextmanager
def folder_of(files):
    """A fresh folder with these files, its own current folder for the command."""
    home = tempfile.mkdtemp(prefix="strangers-")
    try:
        for name, content in files.items():
            path = Path(home, name)
            path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        yield home
    finally:
        shutil.rmtree(home)


def problem_files(name, content):
    """The files of a case and the one that commands get: a mesh needs a problem that names it."""
    if Path(name).suffix in (".off", ".obj", ".stl", ".ply"):
        return {name: content, "meshed.toml": MESH.format(name)}, "meshed.toml"
    return {name: content}, name


def faults_of(files, main, commands, slack=1.0, *, watch=True, refused=False):
    """What is wrong, as (command, words); ``refused``: not to be is wrong."""
    found = []
    with folder_of(files) as home:
        out, names = os.path.join(home, "out"), {*files, "out"}
        for command in commands:
            arguments = [x.format(main) if x == "{}" else x for x in COMMANDS[command]]
            result, slack = repeated(arguments, home, out, watch, slack)
            wrong = judged(result, slack, record=main.endswith(".json"))
            made = sorted(Path(out).rglob("*")) if os.path.isdir(out) else []
            for name, content in chain.from_iterable(map(members, made)):
                words = wrong_with(name, content.decode("utf-8"))
                wrong += [f"{name}: {words}"] if words else []
            if refused and result.status == 0:
                wrong.append("taken")
            if result.status == 2 and made:
                wrong.append(f"refused, and wrote {made}")
            if extra := {*os.listdir(home)} - names:
                wrong.append(f"files {extra}")
            found += [(command, words) for words in wrong]
    return found


def members(path):
    """The names and the bytes of a file that was made; an archive (an FMU) has several."""
    if not zipfile.is_zipfile(path):
        return [] if path.is_dir() else [(path.name, path.read_bytes())]
    with zipfile.ZipFile(path) as archive:
        return [(x.filename, archive.read(x)) for x in archive.infolist() if not x.is_dir()]


def repeated(arguments, home, out, watch, slack):
    """One run, and the slack it had; what is too slow has two more, and how slow the machine is
    by then is measured: other work on it is no fault of the program."""
    for _ in range(3):
        shutil.rmtree(out, ignore_errors=True)
        result = run(arguments, home, out, watch)
        if result.seconds <= SECONDS * slack:
            break
        slack = max(slack, slack_now())
    return result, slack


def own_faults(files, main):
    """What is wrong with the steps about the group itself of a problem that is accepted."""
    with folder_of(files) as home:
        try:
            problem = load(Path(home, main))
        except ProblemError:
            return []
        try:
            record = walk(problem)
            checker = Checker(from_json(to_json(record)).problem, SEED)
            verdicts = [checker.check(x) for x in record.steps if x.scope != ANY_GROUP]
        except BaseException as error:
            return [("own", uncaught(error))]
    return [("own", f"{v.label}: {v.reason}") for v in verdicts if not v.holds]


def record_faults(text):
    """What is wrong when a record is read, shown in every way and checked, step by step."""
    with folder_of({}) as home, watched(home, home) as faults:
        try:
            record = from_json(text)
        except RecordError as error:
            one = str(error)
            return [("read", repr(one))] if "\n" in one or len(one) > 800 else []
        except BaseException as error:
            return [("read", uncaught(error))]
        found = []
        for form in FORMATS:
            try:
                words = wrong_with(f"walk.{ENDINGS[form]}", render(record, form))
                found += [(form, words)] if words else []
            except BaseException as error:
                found.append((form, uncaught(error)))
        try:
            assert from_json(to_json(record)) == record
            checker = Checker(record.problem, SEED)
            own = [step for step in record.steps if step.scope != ANY_GROUP]
            with suppress(StoppedError), time_limit(SECONDS):  # it may take minutes
                for verdict in map(checker.check, own):
                    assert "\n" not in verdict.reason
        except BaseException as error:
            found.append(("check", uncaught(error)))
    return found + [("watch", x) for x in faults]


def warm():
    """Import all that commands need, unwatched: modules make their classes by compiling text."""
    record = faults_of({"warm.toml": SMALLEST}, "warm.toml", COMMANDS, 60, watch=False)
    meshed = faults_of({"warm.toml": SOLID}, "warm.toml", SEEN, 60, watch=False)
    meshed += faults_of(*problem_files("warm.stl", mesh("stl")), SEEN, 60, watch=False)
    meshed += faults_of(*problem_files("warm.off", mesh("off")), ["text"], 60, watch=False)
    meshed += faults_of(*problem_files("warm.obj", mesh("obj")), ["text"], 60, watch=False)
    meshed += faults_of(*problem_files("warm.stl", binary_stl()), ["text"], 60, watch=False)
    assert not [*record, *meshed], [*record, *meshed]


ENDINGS = {"text": "txt", "latex": "tex", "html": "html", "markdown": "md", "json": "json"}
