"""Code generators fed the equations of ``equations.py``: CasADi, SymForce, wrenfold, SymPy."""

from __future__ import annotations

import re
import sysconfig
from pathlib import Path
from typing import Any

from .cases import Array, Case, library
from .count import operations
from .equations import EQUATIONS, constants
from .native import Native, write

CPP = 'extern "C" void {0}({1})\n'
FLAT = "const double *__restrict x, const double *__restrict k, double *__restrict dx"


def headers(*names: str) -> list[str]:
    """Options for the folders of this environment that hold these headers."""
    site = Path(sysconfig.get_paths()["purelib"])
    places = [site / "cmeel.prefix/include", site / "cmeel.prefix/include/eigen3"]
    places += [site / "casadi/include/eigen3", Path(sysconfig.get_paths()["include"])]
    places += sorted(Path(sysconfig.get_paths()["data"]).glob("include/site/*"))
    chosen = []
    for name in names:
        found = [place for place in places if (place / name).exists()]
        if not found:
            raise RuntimeError(f"no header {name}")
        chosen.append(f"-isystem{found[0]}")
    return chosen


def casadi(case: Case, states: Array, folder: Path) -> Native:
    """CasADi's C from SX, after its cse."""
    ca = library("casadi")
    k = constants(case)
    x_, k_ = ca.SX.sym("x", case.size), ca.SX.sym("k", len(k))
    right = EQUATIONS[case.name](ca.vertsplit(x_), ca.vertsplit(k_))
    return casadi_native("CasADi", case, states, k, (x_, k_, ca.vertcat(*right)), folder)


def casadi_native(
    label: str, case: Case, states: Array, k: Array, graph: tuple[Any, Any, Any], folder: Path
) -> Native:
    """The generated function inlined in a wrapper, so that its tests for null pointers go."""
    ca = library("casadi")
    x, constant, right = graph
    name = f"{re.sub('[^a-z]', '', label.lower())}_{case.name}"
    generator = ca.CodeGenerator("f", {"with_header": False})
    generator.add(ca.Function("generated", [x, constant], ca.cse([right])))
    code = generator.dump()
    wrapper = (
        f"__attribute__((flatten)) void {name}({FLAT.replace('__restrict', 'restrict')})\n{{\n"
    )
    wrapper += "    const double *arg[] = {x, k};\n    double *res[] = {dx};\n"
    wrapper += "    casadi_f0(arg, res, 0, 0, 0);\n}\n"
    source = write(folder / f"{name}.c", f"{code}\n{wrapper}")
    counted = operations(code, "casadi_f0")
    return Native(label, [source], name, k, states, case.size, counted)


def symforce(case: Case, states: Array, folder: Path) -> Native:
    """SymForce's C++, its matrices of Eigen laid over the arrays."""
    library("symforce").set_epsilon_to_number()
    sf, codegen = library("symforce.symbolic"), library("symforce.codegen")
    Values = library("symforce.values").Values
    k, name = constants(case), f"symforce_{case.name}"
    inputs = Values(
        x=sf.Matrix([sf.Symbol(f"x{i}") for i in range(case.size)]),
        k=sf.Matrix([sf.Symbol(f"k{i}") for i in range(len(k))]),
    )
    right = EQUATIONS[case.name](list(inputs["x"]), list(inputs["k"]))
    outputs = Values(dx=sf.Matrix(list(right)))
    generated = codegen.Codegen(inputs, outputs, codegen.CppConfig(), name="generated")
    done = generated.generate_function(folder / name, skip_directory_nesting=True)
    code = Path(done.generated_files[0]).read_text(encoding="utf-8")
    call = f"""{{
    using X = Eigen::Matrix<double, {case.size}, 1>;
    using K = Eigen::Matrix<double, {len(k)}, 1>;
    sym::Generated<double>(*reinterpret_cast<const X *>(x), *reinterpret_cast<const K *>(k),
        reinterpret_cast<X *>(dx));
}}
"""
    text = f"#define EIGEN_MAX_ALIGN_BYTES 0\n{code}\n" + CPP.format(name, FLAT) + call
    source = write(folder / f"{name}.cpp", text)
    counted = operations(code, "Generated")
    options = headers("Eigen/Core")
    return Native("SymForce", [source], name, k, states, case.size, counted, options=options)


SPAN = """#include <wrenfold/span.h>
template <typename T>
struct Flat { T *data; };
template <typename Dimensions, typename T>
struct wf::convert_to_span<Dimensions, Flat<T>> {
    constexpr auto convert(const Flat<T> &flat) const noexcept
    {
        return wf::make_span(flat.data, Dimensions{}, wf::make_constant_value_pack<1, 1>());
    }
};
"""


def wrenfold(case: Case, states: Array, folder: Path) -> Native:
    """wrenfold's C++ over spans of the arrays."""
    code_generation, sym = library("wrenfold.code_generation"), library("wrenfold.sym")
    type_info = library("wrenfold.type_info")
    k, name = constants(case), f"wrenfold_{case.name}"
    description = code_generation.FunctionDescription("generated")
    x_ = description.add_input_argument("x", type_info.MatrixType(case.size, 1))
    k_ = description.add_input_argument("k", type_info.MatrixType(len(k), 1))
    right = EQUATIONS[case.name]([x_[i] for i in range(case.size)], [k_[i] for i in range(len(k))])
    description.add_output_argument("dx", False, sym.vector(*right))
    tree = code_generation.transpile(description)
    code = code_generation.CppGenerator().generate(definition=tree)
    call = """{
    Flat<double> out{dx};
    generated<double>(Flat<const double>{x}, Flat<const double>{k}, out);
}
"""
    source = write(folder / f"{name}.cpp", SPAN + code + "\n" + CPP.format(name, FLAT) + call)
    counted = operations(code, "generated")
    options = headers("wrenfold/span.h")
    return Native("wrenfold", [source], name, k, states, case.size, counted, options=options)


def sympy_native(
    label: str, case: Case, states: Array, k: Array, graph: tuple[Any, Any, Any], folder: Path
) -> Native:
    """C of expressions of SymPy after its cse, one line each."""
    sp = library("sympy")
    x, constant, right = graph
    name = f"{re.sub('[^a-z]', '', label.lower())}_{case.name}"
    shared, last = sp.cse(list(right), symbols=sp.numbered_symbols("part"), order="none")
    lines = [f"const double {s} = x[{i}];" for i, s in enumerate(x)]
    lines += [f"const double {s} = k[{i}];" for i, s in enumerate(constant)]
    lines += [f"const double {s} = {ccode(e)};" for s, e in shared]
    lines += [f"dx[{i}] = {ccode(e)};" for i, e in enumerate(last)]
    head = f"void {name}({FLAT.replace('__restrict', 'restrict')})"
    text = f"#include <math.h>\n{head}\n{{\n    " + "\n    ".join(lines) + "\n}\n"
    source = write(folder / f"{name}.c", text)
    return Native(label, [source], name, k, states, len(last), operations(text, name))


def ccode(expression: Any) -> str:
    """C of an expression, its squares as products."""
    sp = library("sympy")
    squares = expression.replace(
        lambda e: e.is_Pow and e.exp == 2,
        lambda e: sp.Mul(e.base, e.base, evaluate=False),
    )
    return str(sp.ccode(squares))


def sympy(case: Case, states: Array, folder: Path) -> Native:
    """The same equations through SymPy's cse and ccode."""
    sp = library("sympy")
    k = constants(case)
    x_, k_ = sp.symbols(f"x:{case.size}"), sp.symbols(f"k:{len(k)}")
    right = EQUATIONS[case.name](x_, k_)
    return sympy_native("SymPy", case, states, k, (x_, k_, right), folder)
