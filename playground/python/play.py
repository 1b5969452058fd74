"""What the playground asks of the package, in a worker of the browser: the command line's own
functions on the text of a problem file.

``tell`` takes a kind of news and its JSON, as soon as there is any; what is refused is told as
``error``, with the line of the file that it concerns.
"""

from __future__ import annotations

import io
import json
import pickle
import re
import shlex
import shutil
import sys
import zipfile
from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from dataclasses import replace
from pathlib import Path
from typing import Any

from derive.command.cli import ENDING, main, refusal
from derive.command.showing import derive
from derive.language.limits import Refused
from derive.problem.motion_tables import faults
from derive.record.record import AMENDED, Derivation
from derive.views.paper.findings import PaperFinding

Tell = Callable[[str, str], None]
FOLDER = Path("/problem")
STORED = Path(__file__).with_name("amendments.pickle")
"""Where the problem file is written; what was found of the print when the site was built."""
LATER = ("mpmath", "sympy")
"""Libraries that are loaded when something asks for them."""
NAME = re.compile(r'^\s*name\s*=\s*"([A-Za-z]\w{0,60})"', re.ASCII | re.MULTILINE)
SECONDS, TOLERANCE = 20.0, 1e-9
"""Of a motion."""


class Play:
    """One problem at a time: its text, and what was derived of it."""

    def __init__(self, tell: Tell) -> None:
        self.tell_text, self.text, self.problem, self.record = tell, "", None, None
        self.path = FOLDER / "problem.toml"
        self.programs: dict[bool, Any] = {}
        self.sources: dict[bool, str] = {}

    def tell(self, kind: str, news: Any) -> None:
        """Send news."""
        self.tell_text(kind, json.dumps(news, ensure_ascii=False))

    @contextmanager
    def refusals(self) -> Iterator[None]:
        """A context that tells what is refused as the command line does."""
        out, err = io.StringIO(), io.StringIO()
        try:
            with redirect_stdout(out), redirect_stderr(err):
                yield
        except ENDING as error:  # of a module of the package, the worker loads it, and asks again
            self.fault(f"derive: {refusal(error)}")
        for line in err.getvalue().splitlines():
            self.tell("warning", line)

    def fault(self, message: str) -> None:
        """Tell what is wrong, and at which line."""
        self.tell("error", {"message": message, "line": line_of(message, self.text)})

    def read(self, text: str) -> None:
        """Write a problem file, and derive its equations unless they are there."""
        if text == self.text and self.record is not None:
            return
        self.text, self.record = text, None
        self.programs.clear()
        self.sources.clear()
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir()
        self.path = FOLDER / f"{name_of(text)}.toml"
        self.path.write_text(text, encoding="utf-8")
        with chdir(FOLDER):
            # names that the state has not are told with each walk, at their line
            self.problem, self.record = derive(self.path.name, followed=True)

    def walk(self, text: str, lang: str) -> None:
        """The equations of motion, and the walk as the HTML of ``derive walk FILE --format html
        --fragment``, piece by piece."""
        from derive.views.answer import answer_mathml
        from derive.views.arrows import arrows, legend, marks
        from derive.views.html import fragment
        from derive.views.language import language
        from derive.views.latex import anchor
        from derive.views.layout import as_read
        from derive.views.outline import system, title
        from derive.views.stations import told as road

        with self.refusals():
            self.read(text)
            words = language(lang)
            told = {"steps": len(self.record.steps), "name": self.record.name}
            about = system(self.record, words) or title(self.record, words)
            told["about"] = re.sub("[$`]", "", about).replace("^2", "²")
            seen = arrows(self.record)
            shown = answer_mathml(self.record, marks(seen), words)
            told["answer"] = [{"id": anchor(label), "shown": x} for label, x in shown]
            told["arrows"] = legend(self.record, seen, words)
            read = as_read(self.record)
            told["road"] = [*road(read, anchor)]
            self.tell("derived", told)
            found = corrections(self.record)
            for piece in fragment([read], language=words, findings=found):
                self.tell("piece", piece)
            for line in faults(self.problem):
                message = f"derive: {self.path.name}: {line}"
                self.tell("warning", {"message": message, "line": line_of(message, text)})
            self.tell("walked", {})

    def check(self, text: str) -> None:
        """A verdict on each step."""
        from derive.check.checker import fresh_seed, verdicts
        from derive.views.latex import anchor

        with self.refusals():
            self.read(text)
            for v in verdicts(self.record, fresh_seed()):
                told = {"id": anchor(v.label), "label": v.label, "holds": v.holds}
                tried = {"bound": f"{v.bound:.0e}", "count": v.tried[0], "of": v.of}
                self.tell("verdict", told | tried | {"groups": v.tried[1], "reason": v.reason})
            self.tell("checked", {})

    def files(self, text: str, words: str, added: str | None = None) -> bytes | None:
        """The files that a command writes, which are texts, of code where the file starts it, and a
        zip of them with texts that are ``added``, as JSON; ``words``: the command after its name,
        in which FILE stands for the problem file."""
        written: dict[str, bytes] = {}
        with self.refusals():
            self.read(text)
            out = FOLDER / "out"
            shutil.rmtree(out, ignore_errors=True)
            out.mkdir()
            command = [self.path.name if x == "FILE" else x for x in shlex.split(words)]
            if self.run(command) is None:
                return None
            written = {x.name: x.read_bytes() for x in sorted(out.iterdir())}
        if not written:
            return None
        self.tell("files", {x: y.decode() for x, y in written.items()})
        if words.startswith("emit "):
            self.tell("start", self.start(words))
        more = json.loads(added) if added else {}
        return zipped(written | {x: y.encode() for x, y in more.items()}) if more else None

    def start(self, words: str) -> dict[str, float]:
        """The state that the file starts with, by the names of an emission; empty where it says
        none, or the state is in another frame."""
        from derive.motion.first_numbers import first_numbers
        from derive.programs import program

        said = self.problem.initial
        chosen = emission(words.partition("FILE")[2])[1]
        if not (said.numbers or said.exp) or chosen.frame != "given":
            return {}
        try:
            made = with_numbers(program(self.problem, self.record, chosen))
            return dict(zip(made.state, first_numbers(made, self.problem, {}).x, strict=True))
        except Refused:
            return {}

    def found(self, text: str, what: str, lang: str) -> None:
        """What a command, with its options, searches of the equations, as its HTML for a page."""
        with self.refusals():
            self.read(text)
            told = ("--format", "html", "--fragment", "--lang", lang)
            page = self.run([*what.split(), self.path.name, *told])
            if page is not None:
                self.tell("found", page)

    def run(self, command: list[str]) -> str | None:
        """What a command prints; nothing where it is refused, which is told."""
        said, printed = io.StringIO(), io.StringIO()
        with chdir(FOLDER), redirect_stderr(said), redirect_stdout(printed):
            try:
                status = main(command)
            except SystemExit as ended:
                status = ended.code
        if status:
            self.fault(said.getvalue().strip().splitlines()[-1])
            return None
        return printed.getvalue()

    def refused(self, text: str, words: str) -> None:
        """Why options that are not among ``words``, those of an emission, cannot be added."""
        from derive.command.emitting import refused

        with self.refusals():
            self.read(text)
            self.tell("refused", refused(self.problem, self.record, *emission(words)))

    def motion(self, text: str, lang: str) -> None:
        """The emitted JavaScript, and what the page of a motion is told; of what it keeps the
        energy alone, so that the body moves at once."""
        from derive.views.page.motion_page import pieces

        with self.refusals():
            source, page = self.moved(text, lang, sought=False)
            chosen = pieces(page)
            if chosen.get("side") == "velocities" and len(page["adjusted"]) == 1:
                del chosen["side"]  # the graph has it
            self.tell("motion", {"source": source, "page": page, "pieces": chosen})

    def kept(self, text: str, lang: str) -> None:
        """The emitted JavaScript with all that the motion keeps, and its words; nothing where that
        is the energy alone."""
        with self.refusals():
            source, page = self.moved(text, lang, sought=True)
            if page["kept"]:
                self.tell("kept", {"source": source, "kept": page["kept"]})

    def moved(self, text: str, lang: str, *, sought: bool) -> tuple[str, dict[str, Any]]:
        """The emitted JavaScript of a motion, and what its page is told; is it ``sought`` what the
        motion keeps?"""
        from derive.motion.emitted_code import EmittedCode
        from derive.views.language import language
        from derive.views.page.motion_page import data

        self.read(text)
        source = self.source(sought=sought)
        made, begin, _, seen = self.programs[sought]
        code = EmittedCode(made, self.record, self.problem)
        page = data(code, self.problem, self.record, begin, language(lang), seen)
        page |= {"t": SECONDS, "tol": TOLERANCE}
        stated = [*page["x"]]
        page["x"] = moving(page, made)
        page["pushed"] = page["x"] != stated
        return source, page

    def source(self, *, sought: bool) -> str:
        """The emitted JavaScript of a motion, in no language of people: made once."""
        from derive.code.emit import emit
        from derive.code.options import Options
        from derive.motion.first_numbers import first_numbers
        from derive.programs import moving_program
        from derive.views.arrows import arrows, with_arrows

        if sought not in self.programs:
            seen = arrows(self.record)
            record = with_arrows(self.record, seen)
            made, _ = moving_program(self.problem, record, sought=sought)
            begin = first_numbers(with_numbers(made), self.problem, {})
            self.programs[sought] = made, begin, record, seen
        if sought not in self.sources:
            made, _, record, _ = self.programs[sought]
            chosen = Options(step=("gauss",))
            told = emit(made, record, ("javascript",), made.name, chosen)
            (self.sources[sought],) = told.values()
        return self.sources[sought]


class NotYet(BaseException):
    """A library is not there, and can be loaded: no handler of errors stops it, so that the worker
    loads it, and asks again."""


class Later:
    """The finder of modules that is asked last."""

    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> None:
        """None; ``NotYet`` for a library that can be loaded."""
        if name in LATER:
            raise NotYet(f"No module named {name!r}")


def corrections(record: Derivation) -> list[PaperFinding]:
    """Those of the print, which are the same for every problem, and were found when this was
    built."""
    numbers = {n for step in record.steps for n in step.paper} & AMENDED
    return [x for x in pickle.loads(STORED.read_bytes()) if x.number in numbers] if numbers else []


def with_numbers(made: Any) -> Any:
    """A program whose parameters all have a number: 1 where the file gives none, as a slider can
    change it."""
    listed = tuple((x, 1.0 if v is None else v, *rest) for x, v, *rest in made.parameters)
    return replace(made, parameters=listed)


def moving(page: Any, made: Any) -> list[float]:
    """A start that moves: where the file gives no velocity, one about the last but one of its
    coordinates, with a little of the others; a tenth of it on a group that stretches, which could
    make the body flat."""
    x, at_rest = [*page["x"]], {place for _, _, place in page["entries"]}
    velocity = [k for k in range(len(x)) if k not in at_rest and made.state[k][0] in "zw"]
    if velocity and not any(x[k] for k in velocity):
        size = 0.1 if page["body"]["stretches"] else 1.0
        for k in velocity:
            x[k] = 0.1 * size
        x[velocity[min(1, len(velocity) - 1)]] = 2.0 * size
    return x


# at which line of a problem file is what a message tells

LINE = re.compile(r"\(at line (\d+)")
TABLE = re.compile(r"(?:derive: )?\S+\.toml: (?:in )?\[*(\w+)\]* (\d+|'[^']*')")
SECTION = re.compile(r"(?:derive: )?\S+\.toml: (\w+), ")
LONG = 40
"""Of a longer name messages show so many letters."""
KEYS = (
    re.compile(r"(?:unknown )?key '([^']{1,80})'"),
    re.compile(r"(?:\d+|'[^']*'), (\w+):"),
    re.compile(r"\.toml: \w+, (\w+)\b"),
    re.compile(r"\.toml: \[?(\w+)\]?[,:]"),
)


def line_of(message: str, text: str) -> int:
    """The line, from 1; 1 where the message is of the whole file."""
    if found := LINE.search(message):
        return int(found[1])
    lines = text.splitlines()
    first, last = span(message, lines)
    for pattern in KEYS:
        if found := pattern.search(message):
            key = named(found[1])
            alone = rf"\s*(?:[\"']?{key}[\"']?\s*=|\[+[\w.]*\b{key}\]+)"
            wanted = re.compile(rf"{alone}|.*[{{,]\s*{key}\s*=")
            for k in range(first, last):
                if wanted.match(lines[k]):
                    return k + 1
    return min(first, max(len(lines) - 1, 0)) + 1


def span(message: str, lines: list[str]) -> tuple[int, int]:
    """The lines, from 0, of the table that a message names; all where it names none."""
    found = TABLE.search(message)
    if not found:
        return alone(message, lines)
    word, which = found.groups()
    if which.isdecimal():
        header = re.compile(rf"\s*\[\[\s*(?:\w+\.)?{re.escape(word)}s?\s*\]\]")
        at = [k for k, line in enumerate(lines) if header.match(line)]
        number = int(which) - 1
        if not 0 <= number < len(at):
            return 0, len(lines)
        return at[number], end(at[number], lines)
    name = named(which.strip("'"))
    entry = re.compile(rf"\s*[\"']?{name}[\"']?\s*=|\s*\[\w+\.{name}\]")
    start = next((k for k, line in enumerate(lines) if entry.match(line)), 0)
    return start, len(lines)


def alone(message: str, lines: list[str]) -> tuple[int, int]:
    """The same of a table that stands once; all where there is none."""
    found = SECTION.search(message)
    if found is None:
        return 0, len(lines)
    header = re.compile(rf"\s*\[\s*{re.escape(found[1])}\s*\]")
    start = next((k for k, line in enumerate(lines) if header.match(line)), None)
    return (0, len(lines)) if start is None else (start, end(start, lines))


def end(start: int, lines: list[str]) -> int:
    """Where a table ends that begins at a line."""
    ends = (k for k in range(start + 1, len(lines)) if lines[k].lstrip().startswith("["))
    return next(ends, len(lines))


def named(name: str) -> str:
    """What matches a name of which a message shows the beginning."""
    return re.escape(name) + (r"\w*" if len(name) == LONG else "")


def name_of(text: str) -> str:
    """The name of a problem, for its file, as the page tells it."""
    found = NAME.search(text)
    return found[1] if found else "problem"


def emission(words: str) -> tuple[tuple[str, ...], Any]:
    """The languages and the options that the words of an emission ask for."""
    from derive.command.arguments import parser
    from derive.command.cli import COMMANDS
    from derive.command.emitting import languages, options

    args = parser(COMMANDS, None).parse_args(["emit", "FILE", *shlex.split(words)])
    return languages(args), options(args)


def zipped(files: dict[str, bytes]) -> bytes:
    """Files as a zip, without dates."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return out.getvalue()


sys.setrecursionlimit(max(sys.getrecursionlimit(), 1000))
if sys.platform == "emscripten":
    sys.meta_path.append(Later())  # type: ignore[arg-type]
