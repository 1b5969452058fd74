"""Programs that print what emitted code computes, a line a result; see tests/support/languages.py.

Each reads lines of numbers for each problem: p, x, u, and parameters of bodies that may be refused.
The calls are those of tests/support/calls.py.
"""

RUST_BLOCK = """
    {{
        use {name} as m;
        let row = |i: usize| lines[{first} + i].as_slice();
        let (p, x) = (row(0).try_into().unwrap(), row(1).try_into().unwrap());
        let u: &[{real}; m::N_INPUTS] = row(2).try_into().unwrap();
        let k = m::constants(p).unwrap();
        let show = |what: &str, values: &[{real}]| show("{name}", what, values);
        let names = [&m::STATE[..], &m::PARAMETERS, &m::INPUTS].concat();
        println!("{name} names {{}}", names.join(" "));
        show("constants", &k);
        {calls}
        let status = |i| match m::constants(row(i).try_into().unwrap()) {{
            Ok(_) => 0.0,
            Err(m::Refused::Singular) => 1.0,
            Err(m::Refused::NotFinite) => 2.0,
        }};
        show("status", &{refused}.map(status));
    }}
"""
RUST = """\
#![forbid(unsafe_code)]
#![allow(non_snake_case)]
{modules}
mod included {{ include!("{included}.rs"); }}
const T: {real} = 0.3;
fn show(name: &str, what: &str, values: &[{real}]) {{
    print!("{{name}} {{what}}");
    values.iter().for_each(|v| print!(" {{v:e}}"));
    println!();
}}
fn main() {{
    let text = std::io::read_to_string(std::io::stdin()).unwrap();
    let numbers = |line: &str| line.split_whitespace().map(|x| x.parse().unwrap()).collect();
    let lines: Vec<Vec<{real}>> = text.lines().map(numbers).collect();
    assert!(included::N_STATE > 0);
    assert!(included::Refused::Singular.to_string().contains("{included}: "));
{blocks}
}}
"""
JAVASCRIPT_BLOCK = """
{{
    const m = await import("./{name}.mjs");
    const [p, x, u, ...bad] = lines.slice({first}, {first} + {rows});
    const show = (what, values) => console.log("{name}", what, ...Array.from(values, String));
    const k = m.constants(p);
    if (!(k instanceof {real})) throw new TypeError("{name}");
    show("names", [...m.STATE, ...m.PARAMETERS, ...m.INPUTS]);
    show("constants", k);
    {calls}
    show("status", bad.map((p) => status(() => m.constants(p), RangeError)));
}}
"""
JAVASCRIPT = """\
import {{ readFileSync }} from "node:fs";
const numbers = (line) => line.split(" ").filter(Boolean).map(Number);
const lines = readFileSync(0, "utf8").split("\\n").map(numbers);
const flat = (found) => {{
    if (typeof found === "number") return [found];
    const arrays = found.D ? [found.dx, found.D] : [found];
    if (!arrays.every((array) => array instanceof {real})) throw new TypeError("no {real}");
    return arrays.flatMap((array) => [...array]);
}};
const status = (called, refusal) => {{
    try {{ called(); }} catch (e) {{
        if (!(e instanceof refusal)) throw e;
        return /singular/.test(e.message) ? 1 : 2;
    }}
    return 0;
}};
{blocks}
"""
CPP_BLOCK = """
    {{
        namespace m = derive::{name};
        [[maybe_unused]] const auto p = read<m::Parameters>();
        const auto x = read<m::State>();
        [[maybe_unused]] const auto u = read<m::Inputs>();
        const auto start = [](const char *what) {{ std::printf("{name} %s", what); }};
        const auto show = [&](const char *what, const auto &values) {{
            start(what);
            more(values);
            std::puts("");
        }};
        start("names");
        for (auto n : m::state_names) std::printf(" %s", n.data());
        for (auto n : m::parameter_names) std::printf(" %s", n.data());
        for (auto n : m::input_names) std::printf(" %s", n.data());
        std::puts("");
        const auto k = m::constants(p).value();
        show("constants", k);
        {calls}
        start("status");
        for (int i = 0; i < {refused_count}; ++i) {{
            const auto bad = read<m::Parameters>();
            std::printf(" %d", !m::constants(bad));
#if __cplusplus >= 202002L
            m::Constants again;
            if (m::constants(bad, again) != m::constants(bad).has_value()) std::printf(" 9");
#endif
        }}
        std::puts("");
    }}
"""
CPP = """\
{modules}
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
constexpr {real} T = {real}(0.3);
template <class Array> Array read()
{{
    Array out{{}};
    std::string word;
    for (auto &x : out) {{
        std::cin >> word;
        x = {real}(std::strtod(word.c_str(), nullptr));
    }}
    return out;
}}
template <class Array, class Short> Array around(const Short &x)
{{
    Array out{{}};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = x[i % x.size()];
    return out;
}}
template <std::size_t n> void more(const std::array<{real}, n> &values)
{{
    for (const double v : values) std::printf(" %.17g", v);
}}
inline void more(double v) {{ std::printf(" %.17g", v); }}
template <class Both> auto more(const Both &both) -> decltype((void)both.dx)
{{
    more(both.dx);
    more(both.D);
}}
int main()
{{
{blocks}
}}
"""
CVODE = """\
#include <nvector/nvector_serial.h>
#include <stdio.h>

#include "{name}_cvode.h"

static void numbers(double *x, int n)
{{
    for (int i = 0; i < n; ++i)
        if (scanf("%lf", x + i) != 1) x[i] = 0;
}}

int main(void)
{{
    enum {{ P = {name}_N_PARAMETERS, K = {name}_N_CONSTANTS, U = {name}_N_INPUTS }};
    double p[P + 1], k[K + 1], u[U + 1];
    SUNContext context;
    if (SUNContext_Create(NULL, &context)) return 2;
    N_Vector x = N_VNew_Serial({name}_N_STATE, context), dx = N_VClone(x);
    numbers(p, P);
    numbers(N_VGetArrayPointer(x), {name}_N_STATE);
    numbers(u, U);
    if ({name}_constants(p, k)) return 3;
    {name}_data data = {{k, u}};
    if ({name}_field(0.3, x, dx, &data)) return 4;
    printf("{name} rhs");
    for (int i = 0; i < {name}_N_STATE; ++i) printf(" %.17g", N_VGetArrayPointer(dx)[i]);
    puts("");
    return 0;
}}
"""
