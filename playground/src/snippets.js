/* Short programs that call the code as it was emitted, by its own names: the rates of a state, in each language that has one. */

const plain = (text) => text.split("\n").map((x) => x.replace(/^\s*(\/\*+|\*\/?|\/\/+|#)?\s*/, "").trimEnd()).join("\n");
const number = (v) => (/[.en]/.test(v) ? v : `${v}.0`);

/* what a file says of itself: the names of its state, the parameters with their defaults, its operations */
export function about(text) {
  const told = plain(text);
  const state = (told.match(/^x = \(([^)]*)\)/m) ?? told.match(/^STATE = \(([^)]*)\)/m))?.[1].match(/\w+/g) ?? [];
  const listed = told.match(/^Parameters p:\n((?:.+\n)*)/m)?.[1].split(/^p\[\d+\] /m).slice(1) ?? [];
  const parameters = listed.map((x) => [x.match(/^\w+/)[0], number(x.match(/default\s+(\S+)\s*$/)?.[1] ?? "1")]);
  const operations = told.match(/^Operations: ([^.]*)\./m)?.[1].replace(/\s+/g, " ") ?? "";
  return { state, parameters, operations, real: /--real float/.test(told.replace(/\s+/g, " ")) ? "float" : "double" };
}

/* where the file says no start: the element of the group at 1, its velocity and all else that moves at 0.1 */
function start(name) {
  const [, letter, digits = ""] = name.match(/^(.*?)_(\d*)$/) ?? [];
  if (letter === "q") return digits === "0" ? "1.0" : "0.0";
  if (/^(zeta|w)$/.test(letter) || digits.length % 2 || !digits) return "0.1";
  return digits.slice(digits.length / 2) === digits.slice(0, digits.length / 2) ? "1.0" : "0.0";
}

const rows = (list) => list.join(", ").replace(/(.{50,64}), /g, "$1,\n        ");

const PROGRAMS = {
  h: (n, p, x, real) => ["main.c", `/* cc -std=c99 main.c ${n}.c -lm -o main && ./main */
#include "${n}.h"
#include <stdio.h>

int main(void)
{
    const ${real} p[${n}_SIZE_P] = {${p || 0}};
    const ${real} x[${n}_N_STATE] = {${x}};
    const ${real} u[${n}_SIZE_U] = {0};
    ${real} k[${n}_SIZE_K], dx[${n}_N_STATE];

    if (${n}_constants(p, k) != 0) return 1; /* no body has these parameters */
    ${n}_rhs(0, x, k, u, dx);
    for (int i = 0; i < ${n}_N_STATE; ++i) printf("%s %.9g\\n", ${n}_state_names[i], (double)dx[i] + 0.0); /* no -0 */
    return 0;
}
`],
  hpp: (n, p, x) => ["main.cpp", `// cc -std=c99 -c ${n}.c && c++ -std=c++17 main.cpp ${n}.o -lm -o main && ./main
#include "${n}.hpp"
#include <cstdio>

int main()
{
    namespace body = derive::${n};
    const auto k = body::constants({${p}});
    if (!k) return 1; // no body has these parameters
    const body::State x{${x}};
    const auto dx = body::rhs(0, x, *k);
    for (std::size_t i = 0; i < body::n_state; ++i) std::printf("%s %.9g\\n", body::state_names[i].data(), double(dx[i]) + 0.0);
}
`],
  py: (n, p, x) => ["main.py", `# pip install numpy && python3 main.py
import ${n} as body

k = body.constants([body.DEFAULTS.get(name, 1.0) for name in body.PARAMETERS])
x = [${x}]
dx = body.rhs(0.0, x, k, [0.0] * len(body.INPUTS))
for name, rate in zip(body.STATE, dx):
    print(f"{name} {rate + 0.0:.9g}")
`],
  mjs: (n, p, x) => ["main.mjs", `// node main.mjs
import * as body from "./${n}.mjs";

const k = body.constants(body.PARAMETERS.map((name) => body.DEFAULTS[name] ?? 1));
const x = [${x}];
const dx = body.rhs(0, x, k, body.INPUTS.map(() => 0));
body.STATE.forEach((name, i) => console.log(name, dx[i] + 0));
`],
  rs: (n, p, x, real) => ["main.rs", `// rustc --edition=2021 main.rs && ./main
#[path = "${n}.rs"]
mod body;

fn main() {
    let k = body::constants(&[${p}]).expect("a body");
    let x = [${x}];
    let mut dx = [0.0; body::N_STATE];
    body::rhs(0.0, &x, &k, &[0.0; body::N_INPUTS], &mut dx);
    for (name, rate) in body::STATE.iter().zip(dx) {
        println!("{name} {}", rate + 0.0);
    }
}
`],
  jl: (n, p, x) => ["main.jl", `# julia main.jl
include("${n}.jl")

k = ${n}.constants([${p}])
x = [${x}]
dx = similar(x)
${n}.rhs!(dx, x, k, 0.0; u = zeros(${n}.N_INPUTS))
for (name, rate) in zip(${n}.STATE, dx)
    println(name, " ", rate + 0)
end
`],
};

/* of a header that is all there is, which has no table of names */
const alone = (program, name, state) => program.replace(` ${name}.c`, "").replace(`${name}_state_names`, "names")
  .replace("int main", `static const char *const names[] = {${state.map((x) => `"${x}"`).join(", ")}};\n\nint main`);

/* files: [[name, text]], of one emission → [name, text] of programs that call them; given: what the problem file starts with, by names */
export function snippets(files, given = {}) {
  return files.flatMap(([file, text]) => {
    const [, name, end] = file.match(/^(\w+)\.(\w+)$/) ?? [], { state, parameters, real } = about(text);
    if (!PROGRAMS[end] || !state.length || (end === "h" && name.endsWith("_cvode"))) return [];
    const [called, program] = PROGRAMS[end](name, rows(parameters.map(([, v]) => v)), rows(state.map((x) => (x in given ? number(String(given[x])) : start(x)))), real);
    return [[called, end === "h" && !files.some(([x]) => x === `${name}.c`) ? alone(program, name, state) : program]];
  });
}
