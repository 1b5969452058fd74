"""Emitted code of any language as one library: its public functions on NumPy vectors, found by the
signatures of the emitted C header, and motions by commands.

What is emitted and what is compiled is kept on the disk, by the bytes and the flags that it is made
of: tests of any file and process share it.
"""

import ctypes
import json
import os
import re
import shutil
import subprocess
import tempfile
import tomllib
from dataclasses import dataclass, field
from functools import cache, cached_property
from hashlib import sha256
from pathlib import Path
from types import ModuleType

import numpy as np

import derive
from derive.code.languages import LANGUAGES
from derive.problem.toml import problem_of
from tests.support import faces
from tests.support.cached import ROOT, place, read, write
from tests.support.needs import CC, need
from tests.support.read_julia import REALS, DomainError, Module, Numbers
from tests.support.shared import text

STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Werror")
SHARED = ("-fPIC", "-shared")
BUILDS = {
    "c": ("c", (CC, "-std=c99")),
    "c of clang": ("c", ("clang", "-std=c99")),
    "c as c++": ("c", ("g++", "-std=c++11", "-xc++")),
    "python": ("python", ()),
    "julia": ("julia", ()),
    "javascript": ("javascript", ("node",)),
    "rust2021": ("rust", ("rustc", "--edition=2021")),
    "rust2024": ("rust", ("rustc", "--edition=2024")),
    "g++17": ("cpp", ("g++", "-std=c++17")),
    "g++20": ("cpp", ("g++", "-std=c++20")),
    "clang++17": ("cpp", ("clang++", "-std=c++17")),
    "clang++20": ("cpp", ("clang++", "-std=c++20")),
}
"""A language, or its compiler and standard → the language, and the words of its program."""
ONE_BUILD = {language: build for build, (language, _) in reversed(BUILDS.items())}
"""The first build of each language."""
STEPPED = ("c", "python", "javascript", "rust", "cpp")
"""Languages that have steps, but for Julia, which is read, and slow."""
OPTIMISED = {"c": ("-O1",), "rust": ("-Copt-level=1", "-Ccodegen-units=1"), "cpp": ()}
"""Where there are steps to make; to compile takes longer than to run."""


# ---------------------------------------------------------------- what is emitted, and compiled


def problem(given):
    """A problem, the name of a ready-made one, or the text of a file."""
    return problem_of(tomllib.loads(given)) if isinstance(given, str) and "\n" in given else given


DERIVED = {}
"""Text of a problem → its derivation."""


def derived(given):
    """The derivation of a problem, made once."""
    key = given if isinstance(given, str) else text(given)
    if key not in DERIVED:
        DERIVED[key] = derive.derive(problem(given))
    return DERIVED[key]


def emission(given, languages, prefix=None, **options):
    """The prefix and the emitted texts by file, of a problem as of :func:`problem`."""
    key = given if isinstance(given, str) else text(given)
    texts = {}
    for language in languages:
        path = place("emission", key, repr((language, prefix, sorted(options.items()))))
        if not path.is_file():
            d = derived(given)
            made = d.emit(None, (language,), prefix, **options)
            write(path, (prefix or d.problem.name, made))
        name, own = read(path)
        texts |= own
    return name, texts


LIBRARIES, MOST = ROOT / "build" / "libraries", 600


def built(commands, texts):
    """What the last of some commands writes to ``out`` in a folder with these texts; their warnings
    are errors."""
    key = repr((commands, sorted(texts.items()), [*map(version, {x[0] for x in commands})]))
    path = LIBRARIES / sha256(key.encode()).hexdigest()[:32]
    if path.is_file():
        os.utime(path)
        return path
    with tempfile.TemporaryDirectory(prefix="derive-") as folder:
        for name, content in texts.items():
            Path(folder, name).write_text(content, encoding="utf-8")
        for words in commands:
            done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
            assert not done.stderr, done.stderr
        LIBRARIES.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(f".{os.getpid()}")
        shutil.copy(Path(folder, "out"), unfinished)
        unfinished.replace(path)
    for old in sorted(LIBRARIES.iterdir(), key=lambda x: x.stat().st_mtime)[:-MOST]:
        old.unlink(missing_ok=True)
    return path


@cache
def version(program):
    """What tells a compiler from a later one."""
    found = Path(shutil.which(program) or program).resolve()
    return str(found), found.stat().st_mtime if found.exists() else 0


# ---------------------------------------------------------------- the functions of a header

DECLARED = r"^(?:{prefix}_FUNCTION )?(void|int|double|float) {prefix}_(\w+)\(([^;{{]*)\)(?:;|\n{{)"
ARGUMENT = re.compile(
    r"(?P<kept>const )?(?:double|float) (?P<array>\*(?:\w*_RESTRICT )?)?(?P<name>\w+)"
)
LENGTHS = {"x": "STATE", "k": "CONSTANTS", "p": "PARAMETERS", "u": "INPUTS", "dx": "STATE"}
LENGTHS |= {"y": "STATE", "dy": "STATE", "Q": "ALGEBRA"}
COLUMNS = {"jacobian_inputs": "INPUTS", "jacobian_parameters": "PARAMETERS"}
COLUMNS |= {"jacobian_outputs_inputs": "INPUTS", "jacobian_outputs_raw": "STATE"}
COLUMNS |= {"mass_matrix": "ALGEBRA", "jacobian_raw_inputs": "INPUTS", "variations": "MOVES"}
OF_STATE = ("jacobian_raw", "jacobian_raw_inputs", "jacobian_project", "variations")
"""The matrices with a row for each number of the state."""
STATES = {"x", "y", "z"}
APART = ("constants", "rhs_batch", "velocity_step", "momentum_rates")


@dataclass(frozen=True)
class Call:
    """A function: what C returns, its name, t, x, k, p, u, y, z in the order in which it takes
    them, and each array that it writes with how many numbers."""

    kind: str
    name: str
    takes: tuple[str, ...]
    writes: dict[str, int]

    def ends(self):
        """What is shown: with inputs; and without, by another name."""
        yield "", True
        if "u" in self.takes and STATES & {*self.takes}:
            yield "_unforced", False

    def given(self, values, u):
        """The arguments in their order; without inputs, these are left out."""
        return [values[a] for a in self.takes if a != "u" or u]


def sizes(header, prefix):
    """Those of the enum of a header, and how many numbers it says that a variation has, and with
    the symmetries of a quotient."""
    text = re.sub(r"[\s*]+", " ", header)
    varied = re.search(
        r"A variation V [^.]*?has (\d+) numbers(?:[^.;]*; number ([\d, ]+) is)?", text
    )
    count = int(varied[1]) if varied else 0
    more = len((varied[2] or "").split()) if varied else 0
    return {"VARIATIONS": count, "MOVES": count + more} | {
        x: int(n) for x, n in re.findall(rf"\b{prefix}_N_(\w+) = (\d+)", header)
    }


def calls(header, prefix):
    """The functions of a header, but for ``constants``, for ``rhs_batch`` of many states, and for
    those that a discrete step and Newton's method are made of."""
    known = sizes(header, prefix)
    for kind, name, listed in re.findall(DECLARED.format(prefix=prefix), header, re.MULTILINE):
        if name in APART or name.startswith("step_"):
            continue
        found = [ARGUMENT.fullmatch(x.strip()) for x in re.split(r",\s*", listed)]
        if None in found:  # what a function of one header is made of
            continue
        outs = [m["name"] for m in found if m["array"] and not m["kept"]]
        assert bool(outs) == (kind in ("void", "int")), name
        takes = tuple(m["name"] for m in found if m["name"] not in outs)
        yield Call(kind, name, takes, {a: length(a, name, known) for a in outs})


def rows_of(function, known):
    """How many rows a matrix D has that a function writes."""
    if function.startswith("jacobian_outputs"):
        return known["OUTPUTS"]
    if function == "mass_matrix":
        return known["ALGEBRA"]
    return known["STATE"] if function in OF_STATE else known["VARIATIONS"]


def length(array, function, known):
    """How many numbers an array has that a function writes."""
    if array == "D":
        square = known["STATE" if function in OF_STATE[:3] else "VARIATIONS"]
        columns = known[COLUMNS[function]] if function in COLUMNS else square
        return rows_of(function, known) * columns
    if function in ("conserved", "events", "outputs"):
        return known[function.upper()]
    if function == "bias":
        return known["ALGEBRA"]
    if function == "poisson":
        return known["REDUCED"] ** 2
    if function == "to_matrix":
        return known["MATRIX"]
    if array == "out":
        return known["INPUTS" if function.startswith("inputs_") else "STATE"]
    return known[LENGTHS[array]]


# ---------------------------------------------------------------- libraries


@dataclass(frozen=True)
class Place:
    """Where a motion is after a command: what the step returned, the event (-1 for none), is it
    reached from below, t, the last step, evaluations of the rates, the state; and the derivatives
    of a step, phi and gamma by rows, where those were asked for."""

    status: int
    event: int
    rising: bool
    t: float
    h: float
    evaluations: int
    x: np.ndarray
    slopes: np.ndarray = field(default_factory=lambda: np.zeros(0))


class Library:
    """The code of one problem in one language; the C header is among the texts in any case."""

    def __init__(self, build, name, texts, real="double", flags=()):
        self.language, self.words = BUILDS[build]
        need(*(["Rust 2024"] if build == "rust2024" else self.words[:1]))
        self.name, self.texts, self.real, self.flags = name, texts, real, tuple(flags)
        self.sizes = sizes(texts[f"{name}.h"], name)
        self.calls = [*calls(texts[f"{name}.h"], name)]
        steps = texts.get(f"{name}_steps.h", "")
        self.steps = [x for x in faces.FIXED if f"{name}_{x}(" in steps]

    @property
    def slopes(self):
        """How many numbers the derivatives of a step are."""
        varied = self.sizes["VARIATIONS"]
        return varied * (varied + self.sizes["INPUTS"])

    def values(self, **values):
        """The arrays p, k, u, x by their letters, with y, which is x, and z, which is x and then
        its first numbers again, as for a matrix; dzeta are its first numbers."""
        x = np.asarray(values["x"], float)
        z = np.resize(values.get("dzeta", x), len(x) + self.more)
        return values | {"y": x, "z": z, "dzeta": z[: self.sizes["ALGEBRA"]]}

    @property
    def more(self):
        """How many numbers a state has more with matrices than with quaternions and angles."""
        return self.sizes.get("MATRIX", self.sizes["STATE"]) - self.sizes["STATE"]

    def shown(self, call, values, u):
        """All that a function says, one array or, where it is asked in more than one way, more."""
        raise NotImplementedError

    def places(self, commands, k, u, x):
        """Those of a motion, after each command."""
        raise NotImplementedError

    def said(self, name, x, t=0.0, **arrays):
        """What one function says: t, x, and k, p, u, dzeta by their letters."""
        (call,) = (c for c in self.calls if c.name == name)
        values = self.values(x=x, t=t, **dict.fromkeys("kpu") | arrays)
        return self.shown(call, values, values["u"] is not None)[0]

    def rhs(self, t, x, k, u=None):
        """dx/dt."""
        return self.said("rhs", x, t, k=k, u=u)

    def energy(self, t, x, k):
        """A number."""
        return self.said("energy", x, t, k=k)[0]

    def follow(self, commands, x, p=(), u=()):
        """The places of a motion, after each command, which is a word and two numbers: ``begin t
        0``; ``gauss``, ``rk4``, ``vern9 h n``, ``gauss_to t1 tol``, ``rk4_watch t1 h``;
        ``dense t 0`` asks for the state at a time; ``torque a b``, but in Rust, makes a cos(b t)
        the first input."""
        p, u, x = (np.array(values, float) for values in (p, u, x))
        status, k = self.constants(p)
        assert status == 0
        first, *found = self.places([("begin", 0.0, 0.0), *commands], k, u, x)
        assert first.t == 0
        return found


class Native(Library):
    """A shared library of C, C++ or Rust, compiled without a warning."""

    def __init__(self, build, name, texts, real="double", flags=()):
        super().__init__(build, name, texts, real, flags)
        compiled = {"c": self.of_c, "cpp": self.of_cpp, "rust": self.of_rust}[self.language]
        self.shared = ctypes.CDLL(str(compiled()))
        self.face = self.shared.face
        self.face.restype = ctypes.c_int
        pointers = [ctypes.c_void_p] * 6
        self.face.argtypes = [ctypes.c_char_p, ctypes.c_double, ctypes.c_double, *pointers]
        self.room = (
            64
            + 16 * sum(self.sizes.values())
            + sum(sum(call.writes.values()) for call in self.calls)
            + self.slopes
        )

    def source(self, ending, write, before):
        """The text of ``face`` and the steps that there are."""
        main = self.texts.get(f"{self.name}{ending}", "")
        found = faces.steps_in(main, before)
        real = LANGUAGES[self.language].reals[self.real]
        watched = self.sizes.get("EVENTS", 0) > 0
        kinds = {"watched": watched, "driven": self.sizes["INPUTS"] > 0}
        made = write(self.name, real, self.calls, found, **kinds, more=self.more)
        made = made.replace("@varied@", str(self.sizes["VARIATIONS"] or 1))
        return made, OPTIMISED[self.language] if found else ()

    def of_c(self):
        made, quick = self.source("_steps.h", faces.in_c, f"{self.name}_")
        flags = (*STRICT, *(self.flags or quick), *SHARED)
        sources = ["face.c", *(x for x in (f"{self.name}.c",) if x in self.texts)]
        unused = () if len(sources) > 1 else ("-Wno-unused-function",)
        command = (*self.words, *flags, *unused, *sources, "-o", "out", "-lm")
        return built([command], self.of("h", "c") | {"face.c": made})

    def of_cpp(self):
        made, quick = self.source(".hpp", faces.in_cpp, "Status ")
        objects = []
        if f"{self.name}.c" in self.texts:
            command = (CC, "-std=c99", "-O1", "-fPIC", "-c", f"{self.name}.c", "-o", "out")
            objects = [str(built([command], self.of("h", "c")))]
        # constants of one name in two libraries are not one
        unique = ("-fno-gnu-unique",) if self.words[0] == "g++" else ()
        flags = (*STRICT, *self.flags, *quick, *unique, *SHARED)
        command = (*self.words, *flags, "face.cpp", *objects, "-o", "out", "-lm")
        return built([command], self.of("h", "hpp") | {"face.cpp": made})

    def of_rust(self):
        made, quick = self.source(".rs", faces.in_rust, "pub fn ")
        command = (*self.words, "-Dwarnings", "--crate-type=cdylib", *quick, "-oout", "face.rs")
        return built([command], self.of("rs") | {"face.rs": made})

    def of(self, *endings):
        """The texts of files that end so."""
        return {x: text for x, text in self.texts.items() if x.rpartition(".")[2] in endings}

    def ask(self, word, a=0.0, b=0.0, **arrays):
        """The status of one call, and all the room that it may write to."""
        out = np.full(self.room, np.nan)
        given = [arrays.get(x) for x in "pkuxz"]
        kept = [None if x is None else np.ascontiguousarray(x, float) for x in given]
        at = [None if x is None else x.ctypes.data for x in (*kept, out)]
        return self.face(word.encode(), a, b, *at), out

    def rhs_batch(self, t, x, k, u=None):
        """dx/dt of the columns of x (N, n), with inputs (M, n), by the function of C for many."""
        x, k = (np.ascontiguousarray(a, float) for a in (x, k))
        dx, u = np.full(x.shape, np.nan), np.ascontiguousarray(0.0 if u is None else u, float)
        at = [ctypes.c_void_p(a.ctypes.data) for a in (x, k, u, dx)]
        count, time = ctypes.c_size_t(x.shape[1]), ctypes.c_double(t)
        getattr(self.shared, f"{self.name}_rhs_batch")(count, time, *at)
        return dx

    def names(self):
        _, out = self.ask("names")
        return out.tobytes().partition(b"\0")[0].decode().split()

    def constants(self, p):
        status, out = self.ask("constants", p=p)
        return status, out[: self.sizes["CONSTANTS"]]

    def shown(self, call, values, u):
        arrays = {a: values[a] for a in "pkxz"} | {"u": values["u"] if u else None}
        bare = self.language == "cpp" and not u and "u" in call.takes
        end = "_unforced" if bare else ""
        status, out = self.ask(call.name + end, values["t"], **arrays)
        count = sum(call.writes.values()) or 1
        assert np.isnan(out[count:]).all()
        return [out[:count] if status == 0 else np.full(count, np.nan)]

    def places(self, commands, k, u, x):
        n, head = self.sizes["STATE"], len(faces.HEAD)
        for word, a, b in commands:
            status, out = self.ask(word, a, b, k=k, u=u, x=x)
            assert status != faces.UNKNOWN, word
            event, rising, t, h, evaluations = out[:head]
            own = int(event), bool(rising), t, h, int(evaluations)
            yield Place(status, *own, out[head : head + n], out[head + n :][: self.slopes])


class Asked(Library):
    """JavaScript, which one process runs for all tests."""

    def ask(self, word, *given):
        """The status and the numbers of one call."""
        real = LANGUAGES["javascript"].reals[self.real]
        listed = [x.tolist() if isinstance(x, np.ndarray) else x for x in given]
        line = json.dumps([self.path, real, word, listed])
        process = server()
        process.stdin.write(f"{line}\n")
        process.stdin.flush()
        status, *numbers = process.stdout.readline().split() or server.cache_clear() or ["-9"]
        assert status != "-9", process.stderr.read()
        return int(status), numbers

    @cached_property
    def path(self):
        """Of the module, by its text."""
        content = self.texts[f"{self.name}.mjs"]
        path = files_of_javascript() / f"{sha256(content.encode()).hexdigest()}.mjs"
        path.write_text(content, encoding="utf-8")
        return str(path)

    def names(self):
        return self.ask("names")[1]

    def constants(self, p):
        status, k = self.ask("constants", np.asarray(p))
        return status, np.array(k, float)

    def shown(self, call, values, u):
        status, found = self.ask(call.name, *call.given(values, u))
        count = sum(call.writes.values()) or 1
        return [np.array(found, float) if status == 0 else np.full(count, np.nan)]

    def places(self, commands, k, u, x):
        for word, a, b in commands:
            status, found = self.ask(f"motion {word}", float(a), float(b), k, u, x)
            event, rising, t, h, count, *state = map(float, found)
            own = int(event), bool(rising), t, h, int(count)
            n = self.sizes["STATE"]
            yield Place(status, *own, np.array(state[:n]), np.array(state[n:]))


PLACE = tempfile.TemporaryDirectory(prefix="derive-libraries-")
"""Of modules, until the tests are over."""


@cache
def files_of_javascript():
    return Path(tempfile.mkdtemp(dir=PLACE.name))


@cache
def server():
    """The process of JavaScript."""
    main = files_of_javascript() / "main.mjs"
    main.write_text(faces.JAVASCRIPT, encoding="utf-8")
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    return subprocess.Popen(["node", str(main)], text=True, **pipes)


@cache
def module(name, content):
    """The Python module of a text."""
    made = ModuleType(f"emitted_{name}")
    exec(compile(content, f"{name}.py", "exec"), made.__dict__)
    return made


def listed(names):
    """The names of state, parameters and inputs, as a module has them."""
    return [n for which in ("STATE", "PARAMETERS", "INPUTS") for n in names[which]]


def status_of(constants, error):
    """What ``constants`` tells by its message: singular, not finite; and its value."""
    try:
        return 0, constants()
    except error as why:
        return (1 if "singular" in str(why) else 2), np.zeros(0)


def flat(found, *index):
    """The numbers of an array, or of several, one after the other; of one of a batch."""
    arrays = found if isinstance(found, tuple) else (found,)
    return np.concatenate([np.ravel(np.asarray(a)[index]) for a in arrays])


class Imported(Library):
    """Python; each function for one state, and as the second of a batch."""

    @property
    def module(self):
        return module(self.name, self.texts[f"{self.name}.py"])

    def names(self):
        return listed(vars(self.module))

    def constants(self, p):
        """Of one body, and the same of the second of two."""
        status, k = status_of(lambda: self.module.constants(np.asarray(p)), ValueError)
        if status == 0:
            both = self.module.constants(np.stack([p, p]))[1]
            assert np.allclose(both, k, rtol=1e-12, atol=1e-12 * np.abs(k).max(initial=0))
        return status, k

    def shown(self, call, values, u):
        function, given = getattr(self.module, call.name), call.given(values, u)
        takes = [a for a in call.takes if a != "u" or u]
        try:
            found = [flat(function(*given))]
        except ArithmeticError:
            return [np.full(sum(call.writes.values()), np.nan)]
        if STATES & {*takes}:
            both = zip(takes, given, strict=True)
            batch = [np.stack([v + 1, v]) if a in STATES else v for a, v in both]
            found.append(flat(function(*batch), 1))
        return found

    def places(self, commands, k, u, x):
        code, m = self.module, None
        for word, a, b in commands:
            status, slopes = 0, ()
            if word == "begin":
                m = code.begin(a, x)
            elif word == "torque":
                rest = [0.0] * (len(u) - 1)
                u = lambda t, x, a=a, b=b, rest=rest: [a * np.cos(b * t), *rest]  # noqa: E731
            elif word.endswith("_watch"):
                status = code.watch(getattr(code, word.removesuffix("_watch")), m, k, u, a, b)
            elif word.endswith(faces.VARIED):
                status, *slopes = getattr(code, word)(m, k, u, a, b)
            elif word != "dense":
                status = getattr(code, word)(m, k, u, a, b)
            at = code.dense(m, a) if word == "dense" else m.x.copy()
            event, rising = getattr(m, "event", None), getattr(m, "rising", False)
            own = -1 if event is None else event, rising, m.t, m.h, m.evaluations
            yield Place(status, *own, at, flat(tuple(slopes)) if slopes else np.zeros(0))


class Read(Library):
    """Julia, read by tests/support/read_julia.py."""

    @cached_property
    def module(self):
        return Module(self.texts[f"{self.name}.jl"])

    @property
    def number(self):
        return REALS[LANGUAGES["julia"].reals[self.real]]

    def vector(self, values):
        return Numbers(len(values), values=map(self.number, values))

    def names(self):
        return listed(self.module.names)

    def constants(self, p):
        made = lambda: np.array(self.module.call("constants", self.vector(p)).whole())  # noqa: E731
        return status_of(made, DomainError)

    def shown(self, call, values, u):
        """First what it writes, then x and k or p, then t; and rhs by a function of inputs."""
        m, t = self.module, self.number(values["t"])
        arrays = {a: self.vector(x) for a, x in values.items() if a != "t" and x is not None}
        given = [arrays[a] for a in call.takes if a not in "tu"]
        time, inputs = [t] * ("t" in call.takes), {}
        if u and "u" in call.takes:
            inputs = {"u": arrays["u"]}
        if not call.writes:
            return [np.array([m.call(call.name, *time, *given, **inputs)])]
        counted = {x.removeprefix("N_"): n for x, n in m.names.items() if x.startswith("N_")}
        rows = rows_of(call.name, self.sizes | counted)
        if call.name == "poisson":
            rows = m.names["N_REDUCED"]
        square = "out" if call.name == "poisson" else "D"
        shapes = ((rows, n // rows) if a == square else (n,) for a, n in call.writes.items())
        outs = [Numbers(*shape) for shape in shapes]
        good = m.call(f"{call.name}!", *outs, *given, *time, **inputs)
        found = [np.array([x for out in outs for x in out.whole()], float)]
        if call.kind == "int" and good is not True:
            return [np.full(len(found[0]), np.nan)]
        if call.name == "rhs" and u and len(values["u"]):
            dx = Numbers(len(values["x"]))
            m.call("driven", lambda x, t: arrays["u"])(dx, arrays["x"], arrays["k"], t)
            found.append(np.array(dx.whole()))
        return found

    def places(self, commands, k, u, x):
        """Events count from 1, and 0 is none."""
        call, m = self.module.call, None

        def torque(first):
            return self.vector([first, *[0.0] * (len(u) - 1)])

        given = {"u": self.vector(u)} if len(u) else {}
        k, x = self.vector(k), self.vector(x)
        for word, a, b in commands:
            status, slopes, a = 0, (), np.float64(a)
            if word == "begin":
                m = call("Motion", a, x)
            elif word == "torque":
                given = {"u": lambda x, t, a=a, b=b: torque(a * np.cos(b * t))}
            elif word.endswith("_watch"):
                step = self.module.names[f"{word.removesuffix('_watch')}!"]
                status = call("watch!", step, m, k, a, np.float64(b), **given)
            elif word.endswith(faces.VARIED):
                status, *slopes = call(f"{word}!", m, k, a, int(b), **given)
            elif word != "dense":
                count = np.float64(b) if word.endswith("_to") else int(b)
                status = call(f"{word}!", m, k, a, count, **given)
            at = call("dense", m, a) if word == "dense" else m["x"]
            event, rising = m.values.get("event", 0) - 1, m.values.get("rising", False)
            own = event, rising, m["t"], m["h"], m["evaluations"]
            shown = np.array([x for part in slopes for x in part.whole()], float)
            yield Place(status, *own, np.array(at.whole(), float), shown)


KINDS = {"python": Imported, "julia": Read, "javascript": Asked}


@cache
def _library(build, name, texts, real, flags):
    return KINDS.get(BUILDS[build][0], Native)(build, name, dict(texts), real, flags)


def loaded(build, name, texts, real="double", flags=()):
    """The library of some texts, loaded once."""
    return _library(build, name, tuple(sorted(texts.items())), real, tuple(flags))


def library(build, given, flags=(), **options):
    """The library of a problem with some options."""
    language = BUILDS[build][0]
    wanted = ("c",) if language == "c" else ("c", language)
    name, texts = emission(given, wanted, **options)
    return loaded(build, name, texts, options.get("real", "double"), flags)


def module_of(given, **options):
    """The Python module of a problem with some options."""
    name, texts = emission(given, ("python",), **options)
    return module(name, texts[f"{name}.py"])


def arrange(module, values):
    """The parameters, named in ``values``, in the order that the module states."""
    return np.array([values[key] for key in module.PARAMETERS], float)
