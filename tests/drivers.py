"""Programs that print what emitted code computes, a line for each result; see test_languages."""

RUST_BLOCK = """
    {{
        use {name} as m;
        let [p, x, u, bad] = [0, 1, 2, 3].map(|i| lines[4 * {i} + i].as_slice());
        let (p, x, u) = (p.try_into().unwrap(), x.try_into().unwrap(), u.try_into().unwrap());
        let k = m::constants(p).unwrap();
        let mut dx = [0.0; m::N_STATE];
        let names = [&m::STATE[..], &m::PARAMETERS, &m::INPUTS].concat();
        println!("{name} names {{}}", names.join(" "));
        show("{name} constants", &k);
        m::rhs(T, x, &k, u, &mut dx);
        show("{name} rhs", &dx);
        m::rhs(T, x, &k, &[0.0; m::N_INPUTS], &mut dx);
        show("{name} unforced", &dx);
        show("{name} energy", &[m::energy(T, x, &k)]);
        let mut d = [0.0; 4 * m::N_ALGEBRA * m::N_ALGEBRA];
        m::jacobian(T, x, &k, u, &mut dx, &mut d);
        show("{name} rates", &dx);
        show("{name} jacobian", &d);
        {more}
        show("{name} singular", &[m::constants(bad.try_into().unwrap()).is_err() as u8 as {real}]);
    }}
"""
RUST_MORE = """
        let mut d = [0.0; 2 * m::N_ALGEBRA * m::N_{upper}];
        m::jacobian_{what}(T, x, {given}, u, &mut d);
        show("{name} jacobian_{what}", &d);"""
RUST = """\
{modules}
mod included {{ include!("{first}.rs"); }}
const T: {real} = 0.3;
fn show(what: &str, values: &[{real}]) {{
    print!("{{what}}");
    values.iter().for_each(|v| print!(" {{v:e}}"));
    println!();
}}
fn main() {{
    let text = std::io::read_to_string(std::io::stdin()).unwrap();
    let numbers = |line: &str| line.split_whitespace().map(|x| x.parse().unwrap()).collect();
    let lines: Vec<Vec<{real}>> = text.lines().map(numbers).collect();
    assert!(included::N_STATE > 0 && included::Refused::Singular.to_string().contains("{first}: "));
{blocks}
}}
"""
JAVASCRIPT = """\
import {{ readFileSync }} from "node:fs";
const numbers = (line) => line.split(" ").filter(Boolean).map(Number);
const lines = readFileSync(0, "utf8").split("\\n").map(numbers);
for (const [i, name] of {names}.entries()) {{
    const m = await import(`./${{name}}.mjs`);
    const [p, x, u, bad] = lines.slice(4 * i, 4 * i + 4);
    const show = (what, values) => console.log(name, what, ...Array.from(values, String));
    const k = m.constants(p), {{ dx, D }} = m.jacobian({T}, x, k, u);
    if (!(k instanceof {array} && D instanceof {array})) throw new TypeError(name);
    show("names", [...m.STATE, ...m.PARAMETERS, ...m.INPUTS]);
    show("constants", k);
    show("rhs", m.rhs({T}, x, k, u));
    show("unforced", m.rhs({T}, x, k));
    show("energy", [m.energy({T}, x, k)]);
    show("rates", dx);
    show("jacobian", D);
    if (m.jacobian_inputs) show("jacobian_inputs", m.jacobian_inputs({T}, x, k, u));
    if (m.jacobian_parameters) show("jacobian_parameters", m.jacobian_parameters({T}, x, p, u));
    let refused = 0;
    try {{ m.constants(bad); }} catch (e) {{ refused = Number(e instanceof RangeError); }}
    show("singular", [refused]);
}}
"""
JULIA = """\
{modules}
rows(D) = vec(permutedims(D))
lines = [parse.({real}, split(x)) for x in readlines(stdin)]
for (i, m) in enumerate([{list}])
    p, x, u, bad = lines[4i-3:4i]
    show(what, values) = println(join([nameof(m); what; values...], " "))
    k = m.constants(p)
    dx, D = zeros({real}, m.N_STATE), zeros({real}, 2 * m.N_ALGEBRA, 2 * m.N_ALGEBRA)
    show("names", [m.STATE..., m.PARAMETERS..., m.INPUTS...])
    show("constants", k)
    m.rhs!(dx, x, k, {real}({T}); u = u)
    show("rhs", dx)
    m.rhs!(dx, x, k, {real}({T}))
    show("unforced", dx)
    show("energy", [m.energy({real}({T}), x, k)])
    m.jacobian!(dx, D, x, k, {real}({T}); u = u)
    show("rates", dx)
    show("jacobian", rows(D))
    if isdefined(m, :jacobian_inputs!)
        D = zeros({real}, 2 * m.N_ALGEBRA, m.N_INPUTS)
        m.jacobian_inputs!(D, x, k, {real}({T}); u = u)
        show("jacobian_inputs", rows(D))
        m.driven((x, t) -> u)(dx, x, k, {real}({T}))
        show("rhs", dx)
    end
    if isdefined(m, :jacobian_parameters!)
        D = zeros({real}, 2 * m.N_ALGEBRA, m.N_PARAMETERS)
        m.jacobian_parameters!(D, x, p, {real}({T}); u = u)
        show("jacobian_parameters", rows(D))
    end
    refused = try; m.constants(bad); 0; catch e; e isa DomainError ? 1 : 0; end
    show("singular", [refused])
end
"""
CPP_BLOCK = """
    {{
        namespace m = derive::{name};
        const auto p = read<m::Parameters>();
        const auto x = read<m::State>();
        const auto u = read<m::Inputs>();
        const auto bad = read<m::Parameters>();
        std::printf("{name} names");
        for (auto n : m::state_names) std::printf(" %s", n.data());
        for (auto n : m::parameter_names) std::printf(" %s", n.data());
        for (auto n : m::input_names) std::printf(" %s", n.data());
        std::puts("");
        const auto k = m::constants(p).value();
        show("{name} constants", k);
        show("{name} rhs", m::rhs(T, x, k, u));
        show("{name} unforced", m::rhs(T, x, k));
        show("{name} energy", std::array{{m::energy(T, x, k)}});
        const auto both = m::jacobian(T, x, k, u);
        show("{name} rates", both.dx);
        show("{name} jacobian", both.D);
        {more}
        show("{name} singular", std::array{{m::Real(!m::constants(bad))}});
#if __cplusplus >= 202002L
        m::Constants again;
        auto [dx, D] = both;
        if (m::constants(bad, again) == m::constants(bad).has_value() && m::constants(p, again))
            show("{name} constants", again);
        m::rhs(T, x, k, u, dx);
        show("{name} rhs", dx);
        m::jacobian(T, std::span(x), k, u, dx, D);
        show("{name} jacobian", D);
        show("{name} energy", std::array{{m::energy(T, std::span(x), std::span(k))}});
#endif
    }}
"""
CPP_MORE = 'show("{name} jacobian_{what}", m::jacobian_{what}(T, x, {given}, u));'
CPP = """\
{modules}
#include <cstdio>
#include <iostream>
constexpr {real} T = {real}(0.3);
template <class Array> Array read()
{{
    Array out{{}};
    for (auto &x : out) std::cin >> x;
    return out;
}}
template <class Array> void show(const char *what, const Array &values)
{{
    std::printf("%s", what);
    for (const double v : values) std::printf(" %.17g", v);
    std::puts("");
}}
int main()
{{
{blocks}
}}
"""
