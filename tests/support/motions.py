"""Emitted steps, run: a program in each language reads commands and prints where a motion is.

A command is a word and two numbers: ``begin t 0`` starts at time t in the state that was given;
``gauss``, ``rk4``, ``vern9 h n``, ``gauss_to``, ``vern9_to t1 tol``, ``gauss_watch``, ``rk4_watch
t1 h`` … move; ``dense t 0`` asks for the state at time t.
"""

import subprocess
import tempfile
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

import derive
from derive.problem.toml import problem_of
from tests.support.emitted import import_python
from tests.support.needs import CC, need

LANGUAGES = ("c", "python", "javascript", "rust", "cpp")
FLAGS = [
    ("-O1",),
    ("-O2",),
    ("-O3", "-march=native"),
    ("-O3", "-march=native", "-mprefer-vector-width=512", "-ffp-contract=fast"),
]
QUICK = ("-C", "opt-level=1", "-C", "codegen-units=1")
"""Of Rust: to compile takes longer than to run."""
FIXED, ADAPTIVE = ("gauss", "rk4", "vern9", "discrete"), ("gauss_to", "vern9_to")

PLACE = tempfile.TemporaryDirectory(prefix="derive-steps-")
"""Of what is emitted, until the tests are over."""


@cache
def walked(problem):
    """A ready-made problem, or the text of a file, derived once."""
    return derive.derive(problem_of(tomllib.loads(problem)) if "\n" in problem else problem)


@cache
def emitted(problem, languages=LANGUAGES, **options):
    """The folder with the code of a problem, made once, and its name."""
    folder, d = Path(tempfile.mkdtemp(dir=PLACE.name)), walked(problem)
    d.emit(folder, languages, **options)
    return folder, d.problem.name


C = """\
#include "{name}_steps.h"
#include <stdio.h>
typedef {real} real;
static void given(real *values, int n)
{{
    for (int i = 0; i < n; ++i) {{
        double value = 0;
        if (scanf("%lf", &value) == 1) {{
            values[i] = (real)value;
        }}
    }}
}}
int main(void)
{{
    real p[{name}_SIZE_P], k[{name}_SIZE_K], u[{name}_SIZE_U];
    real x[{name}_N_STATE], out[{name}_N_STATE];
    char word[16];
    double a, b;
    {name}_motion m;
    given(p, {name}_N_PARAMETERS);
    given(u, {name}_N_INPUTS);
    given(x, {name}_N_STATE);
    if ({name}_constants(p, k)) {{
        return 1;
    }}
    {name}_begin(&m, 0, x);
    while (scanf("%15s %lf %lf", word, &a, &b) == 3) {{
        int status = 0;
        if (strcmp(word, "begin") == 0) {{
            {name}_begin(&m, (real)a, x);
        }}
{calls}
        memcpy(out, m.x, sizeof out);
        if (strcmp(word, "dense") == 0) {{
            {name}_dense(&m, (real)a, out);
        }}
        printf("%d %d %d %.17g %.17g", status, {event}, {rising}, (double)m.t, (double)m.h);
        for (int i = 0; i < {name}_N_STATE; ++i) {{
            printf(" %.17g", (double)out[i]);
        }}
        printf("\\n");
    }}
    return 0;
}}
"""
C_CALL = """\
        if (strcmp(word, "{step}") == 0) {{
            status = {name}_{step}(&m, k, u, (real)a, {last});
        }}"""
C_WATCH = """\
        if (strcmp(word, "{step}_watch") == 0) {{
            status = {name}_watch({name}_{step}, &m, k, u, (real)a, (real)b);
        }}"""


@dataclass(frozen=True)
class Place:
    """Where a motion is after a command: what the step returned, the event (-1 for none), is it
    reached from below, t, the last step, the state."""

    status: int
    event: int
    rising: bool
    t: float
    h: float
    x: np.ndarray


def follow(language, folder, name, commands, x, p=(), u=(), *, flags=("-O1",), real="double"):
    """The places (len(commands)) of a motion, by the code with steps that is in ``folder``."""
    if language == "python":
        return by_python(folder, name, commands, (p, u, x))
    written = {"c": in_c, "javascript": in_javascript, "rust": in_rust, "cpp": in_cpp}[language]
    program = written(Path(folder), name, flags, real)
    return printed(program, commands, (p, u, x))


def called(path, before, real, count):
    """The steps that a file has: names, and which of two words their last argument needs."""
    text = path.read_text()
    pairs = [(x, count) for x in FIXED] + [(x, real) for x in ADAPTIVE]
    return [(x, last) for x, last in pairs if f"{before}{x}(" in text]


def watched(path):
    """Has a file events?"""
    return "N_EVENTS" in path.read_text()


def steps_of(found):
    """The names among those that are called of steps of one size."""
    return [x for x, _ in found if x in FIXED]


def in_c(folder, name, flags, real):
    """The program in C, strictly compiled with ``flags``, once."""
    need("cc")
    program = folder / "-".join(("drive", *(x.strip("-") for x in flags)))
    if not program.exists():
        found = called(folder / f"{name}_steps.h", f"{name}_", "(real)b", "(size_t)b")
        calls = [C_CALL.format(name=name, step=x, last=last) for x, last in found]
        source = folder / "drive.c"
        event, rising = "-1", "0"
        if watched(folder / f"{name}.h"):
            event, rising = "m.event", "m.rising"
            calls += [C_WATCH.format(name=name, step=x) for x in steps_of(found)]
        more = {"event": event, "rising": rising, "calls": "\n".join(calls)}
        text = C.format(name=name, real=real, **more)
        source.write_text(text)
        strict = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror"]
        command = [CC, *strict, *flags, str(source), str(folder / f"{name}.c"), "-o", str(program)]
        subprocess.run([*command, "-lm"], check=True)
    return [str(program)]


JAVASCRIPT = """\
import {{ readFileSync }} from "node:fs";
import * as code from "./{name}.mjs";
const lines = readFileSync(0, "utf8").split("\\n");
const vector = (line) => line.split(" ").filter(Boolean).map(Number);
const [p, u, x] = lines.splice(0, 3).map(vector);
const k = code.constants(p);
let m = code.begin(0, x);
for (const line of lines.filter(Boolean)) {{
    const [word, ...numbers] = line.replace("inf", "Infinity").split(" ");
    const [a, b] = numbers.map(Number);
    let status = 0, state = m.x;
    if (word === "begin") {{
        m = code.begin(a, x);
        state = m.x;
    }} else if (word === "dense") {{
        state = code.dense(m, a);
    }} else {{
        const step = word.replace("_watch", "");
        status = step === word ? code[word](m, k, u, a, b) : code.watch(code[step], m, k, u, a, b);
    }}
    console.log([status, m.event ?? -1, Number(m.rising ?? 0), m.t, m.h, ...state].join(" "));
}}
"""


def in_javascript(folder, name, flags, real):
    """The program in JavaScript."""
    need("node")
    (folder / "drive.mjs").write_text(JAVASCRIPT.format(name=name))
    return ["node", str(folder / "drive.mjs")]


RUST = """\
#[path = "{name}.rs"]
mod {name};
use {name} as code;
use std::io::Read;
fn vector<const N: usize>(line: &str) -> [{real}; N] {{
    let found: Vec<{real}> = line.split_whitespace().map(|x| x.parse().unwrap()).collect();
    found.try_into().unwrap()
}}
fn main() {{
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).unwrap();
    let mut lines = text.lines();
    let k = code::constants(&vector(lines.next().unwrap())).unwrap();
    let u = vector(lines.next().unwrap());
    let x = vector(lines.next().unwrap());
    let mut m = code::begin(0.0, &x);
    for line in lines {{
        let words: Vec<&str> = line.split(' ').collect();
        let (a, b): ({real}, {real}) = (words[1].parse().unwrap(), words[2].parse().unwrap());
        let mut made = Ok(());
        let mut state = None;
        match words[0] {{
            "begin" => m = code::begin(a, &x),
            "dense" => state = Some(code::dense(&m, a)),
{calls}
            _ => panic!(),
        }}
        let status = match made {{
            Ok(()) => 0,
            Err(code::Stopped::NotFinite) => 2,
            Err(code::Stopped::NotConverged) => 3,{at_event}
        }};
        print!("{{status}} {{}} {{}} {{:e}} {{:e}}", {event}, {rising}, m.t, m.h);
        for value in state.unwrap_or(m.x) {{
            print!(" {{value:e}}");
        }}
        println!();
    }}
}}
"""


def in_rust(folder, name, flags, real):
    """The program in Rust, without a warning, once."""
    need("rustc")
    program = folder / "drive-rs"
    if not program.exists():
        numbers = {"double": "f64", "float": "f32"}[real]
        found = called(folder / f"{name}.rs", "pub fn ", numbers, "usize")
        calls = [
            f'            "{x}" => made = code::{x}(&mut m, &k, &u, a, b as {last}),'
            for x, last in found
        ]
        at_event, event, rising = "", "-1", "0"
        if "NoSolution" in (folder / f"{name}.rs").read_text():
            at_event = " Err(code::Stopped::NoSolution) => 5,"
        if watched(folder / f"{name}.rs"):
            at_event, event = f"{at_event} Err(code::Stopped::AtEvent) => 4,", "m.event"
            rising = "i32::from(m.rising)"
            calls += [
                f'            "{x}_watch" => made = code::watch(code::{x}, &mut m, &k, &u, a, b),'
                for x in steps_of(found)
            ]
        more = {"at_event": at_event, "event": event, "rising": rising}
        source = RUST.format(name=name, real=numbers, calls="\n".join(calls), **more)
        (folder / "drive.rs").write_text(source)
        command = ["rustc", "--edition", "2021", *QUICK, "-Dwarnings", "-o", str(program)]
        subprocess.run([*command, str(folder / "drive.rs")], check=True)
    return [str(program)]


CPP = """\
#include "{name}.hpp"
#include <cstdlib>
#include <iostream>
#include <string>
using namespace derive::{name};
template <std::size_t N> std::array<Real, N> vector()
{{
    std::array<Real, N> found{{}};
    std::string word;
    for (Real &value : found) {{
        std::cin >> word;
        value = Real(std::strtod(word.c_str(), nullptr));
    }}
    return found;
}}
int main()
{{
    const Parameters p = vector<n_parameters>();
    const Inputs u = vector<n_inputs>();
    const State x = vector<n_state>();
    const Constants k = *constants(p);
    Motion m(0, x);
    std::cout.precision(17);
    for (std::string word; std::cin >> word;) {{
        const auto [a, b] = vector<2>();
        Status status = Status::ok;
        if (word == "begin") {{
            m = Motion(a, x);
        }}
{calls}
        std::cout << int(status) << " " << {event} << " " << {rising};
        std::cout << " " << m.t() << " " << m.h();
        for (const Real value : word == "dense" ? m.dense(a) : m.x()) {{
            std::cout << " " << value;
        }}
        std::cout << std::endl;
    }}
}}
"""
CPP_CALL = """\
        if (word == "{step}") {{
            status = m.{step}(k, u, a, {last});
        }}"""


def in_cpp(folder, name, flags, real):
    """The program in C++17 with the C beside it, without a warning, once."""
    need("g++")
    program = folder / "drive-cpp"
    if not program.exists():
        found = called(folder / f"{name}.hpp", "Status ", "b", "std::size_t(b)")
        calls = [CPP_CALL.format(step=x, last=last) for x, last in found]
        source, compiled = folder / "drive.cpp", folder / f"{name}.o"
        event, rising = "-1", "0"
        if watched(folder / f"{name}.hpp"):
            event, rising = "m.event()", "m.rising()"
            calls += [CPP_CALL.format(step=f"{x}_watch", last="b") for x in steps_of(found)]
        more = {"event": event, "rising": rising, "calls": "\n".join(calls)}
        source.write_text(CPP.format(name=name, **more))
        subprocess.run(
            [CC, "-O2", "-c", str(folder / f"{name}.c"), "-o", str(compiled)], check=True
        )
        command = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O0"]
        subprocess.run([*command, str(source), str(compiled), "-o", str(program)], check=True)
    return [str(program)]


def printed(program, commands, given):
    """What a program of ours says to the commands."""
    lines = [" ".join(repr(float(v)) for v in values) for values in given]
    lines += [f"{word} {float(a)!r} {float(b)!r}" for word, a, b in commands]
    text = "\n".join(lines) + "\n"
    done = subprocess.run(program, input=text, capture_output=True, text=True, check=True)
    assert not done.stderr, done.stderr
    found = [line.split() for line in done.stdout.splitlines()]
    assert len(found) == len(commands)
    return [
        Place(int(status), int(event), rising == "1", float(t), float(h), np.array(x, float))
        for status, event, rising, t, h, *x in found
    ]


def by_python(folder, name, commands, given):
    """Imported."""
    code = import_python(name, folder)
    p, u, x = (np.array(values, float) for values in given)
    k, m, places = code.constants(p), code.begin(0.0, x), []
    for word, a, b in commands:
        status = 0
        if word == "begin":
            m = code.begin(a, x)
        elif word.endswith("_watch"):
            status = code.watch(getattr(code, word.removesuffix("_watch")), m, k, u, a, b)
        elif word != "dense":
            status = getattr(code, word)(m, k, u, a, b)
        at = code.dense(m, a) if word == "dense" else m.x.copy()
        event, rising = getattr(m, "event", None), getattr(m, "rising", False)
        places.append(Place(status, -1 if event is None else event, rising, m.t, m.h, at))
    return places
