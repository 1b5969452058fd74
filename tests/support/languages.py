"""Emitted problems in every language, run on the same numbers, and what the C makes of these."""

import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from derive import derive
from derive.code.languages import LANGUAGES
from tests.support import calls, drivers
from tests.support.calls import T
from tests.support.emitted import compile_c, import_python
from tests.support.needs import CC, need
from tests.support.read_julia import REALS, DomainError, Module, Numbers

REFUSED = 6
"""How many bodies that may be refused each driver is given."""
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
RUSTC = "rustc"


def command(*words, **options):
    """Run a program in a folder; its warnings are errors."""
    done = subprocess.run(words, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    assert not done.stderr, done.stderr
    return done.stdout


def known(build, words):
    """Leave out a test where the program of a build is absent, or knows too little."""
    need(*(["Rust 2024"] if build == "rust2024" else words[:1]))


@dataclass
class Emitted:
    """One problem in a folder in several languages, with numbers for its arrays.

    ``languages``: C and Python, then others, alone of ``real`` numbers.  ``reference``: what the C
    makes of the numbers, in double, by the names of what is shown.
    """

    name: str
    problem: object
    folder: Path
    languages: tuple
    options: dict
    real: str = "double"
    tolerance: float = 1e-14
    calls: list = field(default_factory=list)

    def __post_init__(self):
        self.derived, name = derive(self.problem), self.name
        self.files = self.derived.emit(self.folder, self.languages, name, **self.options)
        m, rng = import_python(name, self.folder), np.random.default_rng(5)
        p = [m.DEFAULTS.get(x, 1.0) + rng.uniform(-0.1, 0.1) for x in m.PARAMETERS]
        self.p, self.x = np.array(p), rng.normal(size=len(m.STATE))
        self.u, self.names = rng.normal(size=len(m.INPUTS)), [*m.STATE, *m.PARAMETERS, *m.INPUTS]
        large = 1e200 if self.real == "double" else 1  # beyond what a float holds
        self.refused = [0 * self.p, -self.p, self._line(m.PARAMETERS), large * self.p]
        for at, value in ((0, np.nan), (len(p) - 1, np.inf)):
            self.refused.append(np.where(np.arange(len(p)) == at, value, self.p))
        self.reference = self.said_by(compile_c(CC, name, self.folder, self.folder))
        if self.real != "double":
            others = self.languages[2:]
            self.derived.emit(self.folder, others, name, **self.options, real=self.real)

    def _line(self, names):
        """A body of masses on one line through the origin where moments are parameters, else p."""
        mass, r = np.array([1, 2, 0.5]), np.outer([1, -0.7, 2], [0.3, 1.4, -3.1])
        moments = {"m": mass.sum()} | {f"c_{i + 1}": mass @ r[:, i] for i in range(3)}
        moments |= {
            f"J_{i + 1}{j + 1}": mass @ (r[:, i] * r[:, j]) for i in range(3) for j in range(i, 3)
        }
        if "J_33" not in names:
            return self.p
        return np.array([moments.get(x, y) for x, y in zip(names, self.p, strict=True)])

    def statuses(self, constants, error):
        """0 for each body, or why it is refused, as C tells it; from a function that raises."""

        def status(p):
            try:
                constants(p)
            except error as why:
                return 1 if "singular" in str(why) else 2
            return 0

        return "status", [status(p) for p in self.refused]

    def lines(self):
        """p, x, u and the bodies that may be refused, a line each."""
        rows = (self.p, self.x, self.u, *self.refused)
        spelt = {"nan": "NaN", "inf": "Infinity"}
        words = ([repr(float(v)) for v in row] for row in rows)
        return "".join(" ".join(spelt.get(w, w) for w in row) + "\n" for row in words)

    def said_by(self, library):
        """What the compiled C shows."""
        status, k = library.constants(self.p)
        assert status == 0
        found = {"constants": k}
        found["status"] = np.array([library.constants(p)[0] for p in self.refused], float)
        self.calls = list(calls.calls(self.files[f"{self.name}.h"], self.name, library.sizes))
        for call in self.calls:
            for shown, u in call.kinds().items():
                given = {"x": self.x, "k": k, "p": self.p, "u": self.u if u else 0 * self.u}
                found[shown] = calls.in_c(call, library.library, self.name, given)
        return found

    def compare(self, shown, tolerance=None, *, told=True):
        """Hold (what, words) against the C: none is missing, none differs.

        ``told``: does the language say why a body is refused?
        """
        assert {what for what, _ in shown} == {"names", *self.reference}, self.name
        for what, words in shown:
            if what == "names":
                assert words == self.names
                continue
            found, expected = np.array(words, float), self.reference[what]
            assert found.shape == expected.shape, (self.name, what)
            if what == "status":
                expected = expected if told else expected != 0
                assert np.array_equal(found, expected), (self.name, what, found, expected)
                continue
            worst = np.abs(found - expected).max(initial=0)
            most = (tolerance or self.tolerance) * np.abs(expected).max(initial=0)
            assert worst <= most, (self.name, what, worst)


# -- programs that are compiled -----------------------------------------------------------------


def filled(kind, module, emitted, called, **fields):
    """The text of a driver that has a block for each problem; ``called``: a call as source."""
    frame, block = getattr(drivers, kind), getattr(drivers, f"{kind}_BLOCK")
    rows, refused = 3 + REFUSED, [*range(3, 3 + REFUSED)]
    fields |= {"rows": rows, "refused": refused, "refused_count": REFUSED}
    blocks = []
    for i, x in enumerate(emitted):
        lines = (called(c, shown, u) for c in x.calls for shown, u in c.kinds().items())
        blocks.append(block.format(name=x.name, first=rows * i, calls="\n".join(lines), **fields))
    modules = "\n".join(module.format(name=x.name) for x in emitted)
    first = emitted[0].name
    return frame.format(modules=modules, blocks="".join(blocks), included=first, **fields)


def printed(program, folder, emitted):
    """What a program prints, by problem: (what, words) of each line."""
    out = command(*program, cwd=folder, input="".join(x.lines() for x in emitted))
    found = {x.name: [] for x in emitted}
    for line in out.splitlines():
        name, what, *words = line.split(" ")
        found[name].append((what, words))
    return found


def rust(folder, emitted, real, words):
    module = '#[path = "{name}.rs"]\nmod {name};'
    real = LANGUAGES["rust"].reals[real]
    source = filled("RUST", module, emitted, calls.in_rust, real=real)
    (folder / "main.rs").write_text(source)
    command(*words, "-Dwarnings", "-odrive-rs", "main.rs", cwd=folder)
    return printed(["./drive-rs"], folder, emitted)


def cpp(folder, emitted, real, words):
    module = '#include "{name}.hpp"'
    source = filled("CPP", module, emitted, calls.in_cpp, real=LANGUAGES["cpp"].reals[real])
    (folder / "main.cpp").write_text(source)
    sources = [f"{x.name}.c" for x in emitted if (folder / f"{x.name}.c").exists()]
    objects = [f"{source[:-1]}o" for source in sources]
    if sources:
        command(CC, "-c", "-O1", *sources, cwd=folder)
    command(*words, *STRICT, "main.cpp", *objects, "-odrive-cpp", "-lm", cwd=folder)
    return printed(["./drive-cpp"], folder, emitted)


def javascript(folder, emitted, real, words):
    real = LANGUAGES["javascript"].reals[real]
    source = filled("JAVASCRIPT", "", emitted, calls.in_javascript, real=real)
    (folder / "main.mjs").write_text(source)
    return printed([*words, "main.mjs"], folder, emitted)


def cvode(folder, x):
    """dx/dt by the function that CVODE of SUNDIALS takes."""
    need("cc", "SUNDIALS")
    (folder / "field.c").write_text(drivers.CVODE.format(name=x.name))
    linked = ["-lsundials_nvecserial", "-lm", "-odrive-cvode"]
    command(CC, "-std=c99", *STRICT, "field.c", f"{x.name}.c", *linked, cwd=folder)
    ((_, words),) = printed(["./drive-cvode"], folder, [x])[x.name]
    return np.array(words, float)


# -- modules that are run here ------------------------------------------------------------------


def python(folder, emitted, real, words):
    found = {}
    for x in emitted:
        m = import_python(x.name, folder)
        k = m.constants(x.p)
        found[x.name] = [*listed(vars(m)), ("constants", k), x.statuses(m.constants, ValueError)]
        values = {"t": T, "x": x.x, "k": k, "p": x.p, "u": x.u}
        for call in x.calls:
            for shown, u in call.kinds().items():
                found[x.name] += [(shown, y) for y in calls.in_python(call, m, values, u)]
    return found


def julia(folder, emitted, real, words):
    found, number = {}, REALS[LANGUAGES["julia"].reals[real]]

    def vector(values):
        return Numbers(len(values), values=map(number, values))

    for x in emitted:
        m = Module((folder / f"{x.name}.jl").read_text(encoding="utf-8"))
        k = m.call("constants", vector(x.p))
        status = x.statuses(lambda p, m=m: m.call("constants", vector(p)), DomainError)
        found[x.name] = [*listed(m.names), ("constants", k.whole()), status]
        values = {a: vector(v) for a, v in {"x": x.x, "p": x.p, "u": x.u}.items()}
        values |= {"t": number(T), "k": k}
        for call in x.calls:
            for shown, u in call.kinds().items():
                found[x.name].append((shown, calls.in_julia(call, m, values, u)))
        if len(x.u):
            dx, field = Numbers(len(x.x)), m.call("driven", lambda x, t, u=values["u"]: u)
            field(dx, values["x"], k, number(T))
            found[x.name].append(("rhs", dx.whole()))
    return found


def listed(names):
    """The names of state, parameters and inputs, as a module has them."""
    yield "names", [n for which in ("STATE", "PARAMETERS", "INPUTS") for n in names[which]]


BUILDS = {
    "python": ("python", python, []),
    "julia": ("julia", julia, []),
    "javascript": ("javascript", javascript, ["node"]),
    "rust2021": ("rust", rust, [RUSTC, "--edition=2021"]),
    "rust2024": ("rust", rust, [RUSTC, "--edition=2024"]),
} | {
    f"{compiler}{year}": ("cpp", cpp, [compiler, f"-std=c++{year}"])
    for compiler in ("g++", "clang++")
    for year in (17, 20)
}
"""A language, or its compiler and standard → the language, how it is run, and with which words."""
REFERENCE, PIECES = ("c", "python"), {"cvode": cvode}
"""What every case is emitted in, and languages of one function, run by themselves."""
OTHERS = tuple(x for x in LANGUAGES if x not in (*REFERENCE, *PIECES))
ONE_BUILD = {language: build for build, (language, *_) in reversed(BUILDS.items())}
"""The first build of each language."""


def built(*, but=()):
    """Those first builds, but for some languages."""
    return [build for language, build in reversed(ONE_BUILD.items()) if language not in but]


def run(build, folder, emitted, real="double"):
    """name of a problem → (what, words) of all that it shows."""
    _, function, words = BUILDS[build]
    known(build, words)
    return function(folder, emitted, real, words)


def agree(build, folder, emitted, real="double", tolerance=None):
    """All that a build shows of the problems equals what the C makes of them."""
    found = run(build, folder, emitted, real)
    for x in emitted:
        x.compare(found[x.name], tolerance, told=BUILDS[build][0] != "cpp")
