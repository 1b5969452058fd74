"""What makes emitted code of a language callable from a test: in C, C++ and Rust one function of a
shared library, in JavaScript a process that reads calls.

``face(word, a, b, p, k, u, x, z, out)``: the word is that of a function of the emitted header, at
the time a, or a command of a motion, ``begin``, ``dense``, ``gauss`` …, of two numbers; no inputs
u is a null pointer; z is a state with a matrix in the place of a quaternion.  It returns the
status; of a motion it writes where that is, and before its state what stands in ``HEAD``.
"""

HEAD = ("event", "rising", "t", "h", "evaluations")
FIXED = ("gauss", "rk4", "vern9", "discrete")
"""Steps of one size; the others have names that end in _to."""
VARIED = "_jacobian"
"""The end of the name of a step whose derivatives, two matrices by rows, follow the state."""
UNKNOWN = -9
"""The status of a word that is not known, and of C++ whose spans say something else."""


def filled(text, **fields):
    """A text with fields @name@, as braces are those of the languages."""
    for name, value in fields.items():
        text = text.replace(f"@{name}@", str(value))
    return text


def steps_in(text, before):
    """The steps that a file has, as functions whose names stand after some words."""
    names = [f"{x}{end}" for end in ("", "_to", VARIED) for x in FIXED]
    return [x for x in names if f"{before}{x}(" in text]


# ---------------------------------------------------------------- C

C = """\
#include "@name@@header@.h"
#include "@name@@header@.h" /* alone and twice, as anyone may */
#include <string.h>
#ifdef __cplusplus
extern "C"
#endif
int face(const char *word, double a, double b, const double *P, const double *K, const double *U,
    const double *X, const double *Z, double *out);
typedef @real@ real;
static void taken(real *to, const double *from, int n)
{
    for (int i = 0; i < n; ++i) {
        to[i] = from ? (real)from[i] : (real)0;
    }
}
static void given(double *to, const real *from, int n)
{
    for (int i = 0; i < n; ++i) {
        to[i] = (double)from[i];
    }
}
@torque@
int face(const char *word, double a, double b, const double *P, const double *K, const double *U,
    const double *X, const double *Z, double *out)
{
    real p[@name@_N_PARAMETERS + 1], k[@name@_N_CONSTANTS + 1], u[@name@_N_INPUTS + 1] = {0};
    real x[@name@_N_STATE], z[@name@_N_STATE + @more@];
    const real t = (real)a, *y = x, *dzeta = z;
    int status = 0;
    taken(p, P, @name@_N_PARAMETERS);
    taken(k, K, @name@_N_CONSTANTS);
    taken(u, U, @name@_N_INPUTS);
    taken(x, X, @name@_N_STATE);
    taken(z, Z, @name@_N_STATE + @more@);
    (void)t, (void)y, (void)dzeta, (void)b, (void)p, (void)u, (void)z;
    if (!strcmp(word, "constants")) {
        status = @name@_constants(p, k);
        given(out, k, @name@_N_CONSTANTS);
        return status;
    }
@calls@
@motion@
    return -9;
}
"""
TORQUE = """\
static double torque_of[2];
static void torque(@real@ t, const @real@ *x, @real@ *u, void *data)
{
    (void)x, (void)data;
    for (int i = 1; i < @name@_N_INPUTS; ++i) {
        u[i] = 0;
    }
    u[0] = (@real@)(torque_of[0]*cos(torque_of[1]*(double)t));
}
"""
"""A first input that changes with the time: a cos(b t) by the command ``torque a b``."""
C_CALL = """\
    if (!strcmp(word, "@word@")) {
        @arrays@
        @made@@name@_@word@(@given@);
        @shown@
        return status;
    }"""
C_MOTION = """\
    static @name@_motion m;
    static real phi[@varied@*@varied@];
    static real gamma[@varied@*@name@_N_INPUTS + 1];
    if (!strcmp(word, "begin")) {
        @name@_begin(&m, t, x);
@turned@    @steps@
    } else if (strcmp(word, "dense")) {
        return -9;
    }
    out[0] = @event@;
    out[1] = @rising@;
    out[2] = (double)m.t;
    out[3] = (double)m.h;
    out[4] = (double)m.evaluations;
    if (!strcmp(word, "dense")) {
        @name@_dense(&m, t, x);
        given(out + 5, x, @name@_N_STATE);
    } else {
        given(out + 5, m.x, @name@_N_STATE);
    }
    out += 5 + @name@_N_STATE;
    if (strstr(word, "_jacobian")) {
        given(out, phi, @varied@*@varied@);
        given(out + @varied@*@varied@, gamma, @varied@*@name@_N_INPUTS);
    }
    return status;"""
C_STEP = """\
} else if (!strcmp(word, "@step@")) {
        status = @name@_@step@(&m, k, u, (real)a, @last@);"""
C_WATCH = """\
} else if (!strcmp(word, "@step@_watch")) {
        status = @name@_watch(@name@_@step@, &m, k, u, (real)a, (real)b);"""


C_TORQUE = """\
    } else if (!strcmp(word, "torque")) {
        torque_of[0] = a, torque_of[1] = b;
        m.inputs = torque;
"""
CPP_TORQUE = """\
    } else if (word == "torque") {
        torque_of[0] = a, torque_of[1] = b;
        motion->in_c().inputs = torque;
"""


def offsets(call):
    """Array that a function writes, how many numbers it has, where it is in all of them."""
    at = 0
    for array, n in call.writes.items():
        yield array, n, at
        at += n


def in_c(name, real, calls, steps, *, watched, driven, more):
    """The function ``face`` of C."""
    made = []
    for call in calls:
        written = [*offsets(call)]
        arrays = " ".join(f"real out_{a}[{max(n, 1)}];" for a, n, _ in written)
        shown = " ".join(f"given(out + {at}, out_{a}, {n});" for a, n, at in written)
        kind = {"void": "", "int": "status = "}.get(call.kind, "out[0] = (double)")
        given = ", ".join([*call.takes, *(f"out_{a}" for a, *_ in written)])
        fields = {"word": call.name, "arrays": arrays, "made": kind, "given": given}
        made.append(filled(C_CALL, name=name, shown=shown, **fields))
    motion = torque = ""
    if steps:
        last = {x: "(real)b" if x.endswith("_to") else "(size_t)b" for x in steps}
        last |= {x: "(size_t)b, phi, gamma" for x in steps if x.endswith(VARIED)}
        each = [filled(C_STEP, name=name, step=x, last=last[x]) for x in steps]
        if watched:
            each += [filled(C_WATCH, name=name, step=x) for x in steps if x in FIXED]
        event, rising = ("m.event", "m.rising") if watched else ("-1", "0")
        fields = {"steps": "\n    ".join(each), "event": event, "rising": rising}
        torque = filled(TORQUE * driven, name=name)
        motion = filled(C_MOTION, turned=C_TORQUE * driven, name=name, **fields)
    header = "_steps" if steps else ""
    fields = {"header": header, "calls": "\n".join(made), "motion": motion, "torque": torque}
    return filled(C, name=name, more=more, **fields, real=real)


# ---------------------------------------------------------------- C++

CPP = """\
#include "@name@.hpp"
#include <optional>
#include <string_view>
namespace m = derive::@name@;
template <class Array> Array taken(const double *from)
{
    Array out{};
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = from ? m::Real(from[i]) : m::Real(0);
    }
    return out;
}
template <class Array> auto given(double *out, const Array &values) -> decltype(values.end(), +out)
{
    for (const m::Real value : values) {
        *out++ = double(value);
    }
    return out;
}
[[maybe_unused]] static double *given(double *out, m::Real value)
{
    *out++ = double(value);
    return out;
}
template <class Both> auto given(double *out, const Both &both) -> decltype(both.D, +out)
{
    return given(given(out, both.dx), both.D);
}
template <class Found> double *given(double *out, const std::optional<Found> &found)
{
    return found ? given(out, *found) : nullptr;
}
[[maybe_unused]] static bool same(const double *out, std::size_t at, m::Real value)
{
    const double other = double(value);
    return out[at] == other || (out[at] != out[at] && other != other);
}
@torque@
extern "C" int face(const char *name, double a, [[maybe_unused]] double b,
    const double *P, const double *K, const double *U, const double *X,
    [[maybe_unused]] const double *Z, double *out)
{
    const std::string_view word = name;
    const auto p = taken<m::Parameters>(P);
    [[maybe_unused]] const auto k = taken<m::Constants>(K);
    [[maybe_unused]] const auto u = taken<m::Inputs>(U);
    const auto x = taken<m::State>(X);
    [[maybe_unused]] const auto &y = x;
    [[maybe_unused]] const m::Real t = m::Real(a);
    if (word == "constants") {
        const auto found = m::constants(p);
#if __cplusplus >= 202002L
        m::Constants again;
        if (m::constants(p, again) != found.has_value()) return 7;
#endif
        return given(out, found) ? 0 : 1;
    }
    if (word == "names") {
        char *text = reinterpret_cast<char *>(out);
        for (auto n : m::state_names) text = std::copy(n.begin(), n.end(), text), *text++ = ' ';
        for (auto n : m::parameter_names) text = std::copy(n.begin(), n.end(), text), *text++ = ' ';
        for (auto n : m::input_names) text = std::copy(n.begin(), n.end(), text), *text++ = ' ';
        *text = 0;
        return 0;
    }
@calls@
@motion@
    return -9;
}
"""
CPP_CALL = """\
    if (word == "@word@@unforced@") {
        @made@
        if (!given(out, m::@word@(@given@))) return 3;
        @spans@
        return 0;
    }"""
CPP_SPANS = """\
#if __cplusplus >= 202002L
        @arrays@
        @call@
        if (!(@same@)) return -9;
#endif"""
CPP_MOTION = """\
    static std::optional<m::Motion> motion;
    std::array<m::Real, @varied@ * @varied@> phi{};
    std::array<m::Real, @varied@ * m::n_inputs> gamma{};
    auto status = m::Status::ok;
    if (word == "begin") {
        motion.emplace(t, x);
@turned@    @steps@
    } else if (word != "dense") {
        return -9;
    }
    *out++ = @event@;
    *out++ = @rising@;
    *out++ = double(motion->t());
    *out++ = double(motion->h());
    *out++ = double(motion->in_c().evaluations);
    out = given(out, word == "dense" ? motion->dense(t) : motion->x());
    if (word.find("_jacobian") != word.npos) {
        given(given(out, phi), gamma);
    }
    return int(status);"""
CPP_STEP = """\
} else if (word == "@step@") {
        status = motion->@step@(k, u, m::Real(a), @last@);"""


def in_spans(call):
    """The same call on spans, from C++20 on, beside what the first has written."""
    if call.kind == "int":
        return ""
    words = {a: f"std::span({a})" for a in (*"xykpu", "dzeta")} | {"t": "t"}
    words["z"] = "m::In<m::n_matrix>(z)"
    written = [*offsets(call)]
    given = ", ".join([*(words[a] for a in call.takes), *(f"to_{a}" for a, *_ in written)])
    arrays = " ".join(f"std::array<m::Real, {n}> to_{a};" for a, n, _ in written)
    each = [f"same(out, {at} + i, to_{a}[i])" for a, _, at in written]
    called = f"m::{call.name}({given})"
    if not written:
        fields = {"arrays": "", "call": "", "same": f"same(out, 0, {called})"}
        return filled(CPP_SPANS, **fields)
    loops = [
        f"for (std::size_t i = 0; i < {n}; ++i) alike = alike && {check};"
        for (_, n, _), check in zip(written, each, strict=True)
    ]
    fields = {"arrays": arrays, "same": "alike"}
    return filled(CPP_SPANS, call=f"{called}; bool alike = true; {' '.join(loops)}", **fields)


def in_cpp(name, real, calls, steps, *, watched, driven, more):
    """The function ``face`` of C++."""
    made = []
    for call in calls:
        own = "const auto z = taken<m::MatrixState>(Z);" if "z" in call.takes else ""
        own = "const auto dzeta = taken<m::Rates>(Z);" if "dzeta" in call.takes else own
        for end, u in call.ends():
            given = ", ".join(a for a in call.takes if a != "u" or u)
            fields = {"word": call.name, "unforced": end, "made": own, "given": given}
            made.append(filled(CPP_CALL, spans=in_spans(call) if u else "", **fields))
    motion = torque = ""
    if steps:
        last = {x: "m::Real(b)" if x.endswith("_to") else "std::size_t(b)" for x in steps}
        last |= {x: "std::size_t(b), phi, gamma" for x in steps if x.endswith(VARIED)}
        last |= {f"{x}_watch": "m::Real(b)" for x in steps if watched and x in FIXED}
        each = [filled(CPP_STEP, step=x, last=y) for x, y in last.items()]
        event, rising = ("motion->event()", "motion->rising()") if watched else ("-1", "0")
        fields = {"steps": "\n    ".join(each), "event": event, "rising": rising}
        motion = filled(CPP_MOTION, turned=CPP_TORQUE * driven, **fields)
        torque = filled(TORQUE * driven, name=name, real="m::Real")
    return filled(CPP, name=name, calls="\n".join(made), motion=motion, torque=torque)


# ---------------------------------------------------------------- Rust

RUST = """\
#![allow(non_snake_case)]
#[path = "@name@.rs"]
#[forbid(unsafe_code)]
mod code;
use std::ffi::{c_char, CStr};
type R = @real@;
fn taken<const N: usize>(from: *const f64) -> [R; N] {
    std::array::from_fn(|i| if from.is_null() { 0.0 } else { unsafe { *from.add(i) as R } })
}
fn given(out: *mut f64, values: &[R]) {
    for (i, v) in values.iter().enumerate() {
        unsafe { *out.add(i) = f64::from(*v) }
    }
}
#[unsafe(no_mangle)]
pub extern "C" fn face(word: *const c_char, a: f64, b: f64, p: *const f64, k: *const f64,
    u: *const f64, x: *const f64, z: *const f64, out: *mut f64) -> i32 {
    let word = unsafe { CStr::from_ptr(word) }.to_str().unwrap();
    let (p, k, u, x, t) = (&taken(p), &taken(k), &taken(u), &taken(x), a as R);
    let _: (&[R; code::N_CONSTANTS], &[R; code::N_INPUTS], &[R; code::N_STATE]) = (k, u, x);
    let _ = (b, z, t);
    match word {
        "constants" => match code::constants(p) {
            Ok(k) => given(out, &k),
            Err(code::Refused::Singular) => return 1,
            Err(code::Refused::NotFinite) => return 2,
        },
        "names" => {
            let text = [&code::STATE[..], &code::PARAMETERS, &code::INPUTS].concat().join(" ");
            for (i, byte) in text.bytes().chain([0]).enumerate() {
                unsafe { *out.cast::<u8>().add(i) = byte }
            }
        }
@calls@
        _ => { @motion@ }
    }
    0
}
"""
RUST_CALL = """\
        "@word@" => { @arrays@ @made@ @shown@ }"""
RUST_MOTION = """\
            static MOTION: std::sync::Mutex<Option<code::Motion>> = std::sync::Mutex::new(None);
            let mut kept = MOTION.lock().unwrap();
            if word == "begin" { *kept = Some(code::begin(t, x)); }
            let Some(m) = kept.as_mut() else { return -9 };
            let made = match word {
                "begin" | "dense" => Ok(()),
@steps@
                _ => return -9,
            };
            given(out, &[@event@ as R, @rising@, m.t, m.h, m.evaluations as R]);
            let state = if word == "dense" { code::dense(m, t) } else { m.x };
            given(unsafe { out.add(5) }, &state);
            return match made {
                Ok(()) => 0,
                Err(code::Stopped::NotFinite) => 2,
                Err(code::Stopped::NotConverged) => 3, @stopped@
            };"""
RUST_STEP = '                "@step@" => code::@step@(m, k, u, t, b as @last@),'
RUST_VARIED = """\
                "@step@" => {
                    let mut phi = [0.0; @varied@ * @varied@];
                    let mut gamma = [0.0; @varied@ * code::N_INPUTS];
                    let made = code::@step@(m, k, u, t, b as usize, &mut phi, &mut gamma);
                    given(unsafe { out.add(5 + code::N_STATE) }, &phi);
                    given(unsafe { out.add(5 + code::N_STATE + phi.len()) }, &gamma);
                    made
                }"""
RUST_WATCH = '                "@step@_watch" => code::watch(code::@step@, m, k, u, t, b as R),'


def in_rust(name, real, calls, steps, *, watched, driven, more):
    """The function ``face`` of Rust."""
    made = []
    for call in calls:
        words = {"y": "x", "z": "&taken(z)", "dzeta": "&taken(z)"} | {a: a for a in "txkpu"}
        given = [words[a] for a in call.takes]
        arrays, shown = "", ""
        if not call.writes:
            one = f"given(out, &[code::{call.name}({', '.join(given)})]);"
        elif call.name == "project":
            one = f"given(out, &code::project({', '.join(given)}));"
        else:
            written = [*offsets(call)]
            arrays = "".join(f"let mut to_{a} = [0.0; {n}]; " for a, n, _ in written)
            given += [f"&mut to_{a}" for a, *_ in written]
            one = f"code::{call.name}({', '.join(given)})"
            one = f"if {one}.is_err() {{ return 3 }}" if call.kind == "int" else f"{one};"
            shown = "".join(f"given(unsafe {{ out.add({at}) }}, &to_{a}); " for a, _, at in written)
        made.append(filled(RUST_CALL, word=call.name, arrays=arrays, made=one, shown=shown))
    motion = "return -9;"
    if steps:
        last = {x: "R" if x.endswith("_to") else "usize" for x in steps}
        each = [
            filled(RUST_VARIED if x.endswith(VARIED) else RUST_STEP, step=x, last=y)
            for x, y in last.items()
        ]
        stopped = "Err(code::Stopped::NoSolution) => 5," * ("discrete" in steps)
        event, rising = "-1", "0.0"
        if watched:
            each += [filled(RUST_WATCH, step=x) for x in steps if x in FIXED]
            stopped += " Err(code::Stopped::AtEvent) => 4,"
            event, rising = "m.event", "u8::from(m.rising) as R"
        fields = {"event": event, "rising": rising, "stopped": stopped}
        motion = filled(RUST_MOTION, steps="\n".join(each), **fields)
    return filled(RUST, name=name, real=real, calls="\n".join(made), motion=motion)


# ---------------------------------------------------------------- JavaScript

JAVASCRIPT = """\
import { createInterface } from "node:readline";
const motions = new Map();
const flat = (found, real) => {
    if (typeof found === "number") return [found];
    const arrays = found.D ? [found.dx, found.D] : [found];
    if (!arrays.every((array) => array.constructor.name === real)) throw new TypeError(real);
    return arrays.flatMap((array) => [...array]);
};
const moved = (code, path, word, [a, b, k, u, x]) => {
    if (word === "begin") motions.set(path, code.begin(a, x));
    const m = motions.get(path);
    if (word === "torque") {
        m.inputs = (t) => Array.from(code.INPUTS, (_, i) => (i ? 0 : a*Math.cos(b*t)));
        return [0, -1, 0, m.t, m.h, m.evaluations, ...m.x];
    }
    const step = word.replace("_watch", "");
    let status = 0, state = m.x;
    const moves = code.STATE.filter((x) => /^(zeta|w)/.test(x)).length;
    const inside = code.STATE.some((x) => /^([AT][0-9]*_|q|theta|s_)/.test(x));
    // and a mass of the state
    const varied = inside ? 2*moves + code.STATE.includes("fuel") : code.STATE.length;
    const phi = new Float64Array(varied**2);
    const gamma = new Float64Array(varied*code.INPUTS.length);
    if (word === "dense") {
        state = code.dense(m, a);
    } else if (word.endsWith("_jacobian")) {
        status = code[word](m, k, u, a, b, phi, gamma);
        state = [...m.x, ...phi, ...gamma];
    } else if (word !== "begin") {
        status = step === word ? code[word](m, k, u, a, b) : code.watch(code[step], m, k, u, a, b);
        state = m.x;
    }
    return [status, m.event ?? -1, Number(m.rising ?? 0), m.t, m.h, m.evaluations, ...state];
};
const answer = (code, path, real, word, given) => {
    if (word === "names") return [0, ...code.STATE, ...code.PARAMETERS, ...code.INPUTS];
    if (word.startsWith("motion ")) return moved(code, path, word.slice(7), given);
    try {
        return [0, ...flat(code[word](...given), real)];
    } catch (error) {
        if (!(error instanceof RangeError)) throw error;
        return [word !== "constants" ? 3 : /singular/.test(error.message) ? 1 : 2];
    }
};
for await (const line of createInterface({ input: process.stdin })) {
    const [path, real, word, given] = (0, eval)(`(${line})`);
    console.log(answer(await import(path), path, real, word, given).join(" "));
}
"""
