"""The functions of an emitted C header as data, and their calls in every language.

A call shows all numbers that a function gives: those of the arrays that C writes, one after the
other, or what it returns.  It is made with the inputs u, and without them.
"""

import ctypes
import re
from dataclasses import dataclass

import numpy as np

from tests.support.read_julia import Numbers

T = 0.3
DECLARED = r"^(void|{real}) {prefix}_(\w+)\(([^;]*)\);"
ARGUMENT = re.compile(
    r"(?P<kept>const )?(?:double|float) (?P<array>\*(?:\w*_RESTRICT )?)?(?P<name>\w+)"
)
SIZES = {"x": "STATE", "k": "CONSTANTS", "p": "PARAMETERS", "u": "INPUTS", "dx": "STATE"}
SIZES |= {"y": "STATE", "dy": "STATE"}
MORE = 5
"""A rotation has five numbers more as a matrix than as a quaternion."""
COLUMNS = {"jacobian_inputs": "INPUTS", "jacobian_parameters": "PARAMETERS"}


STATES = {"x", "y", "z"}


@dataclass(frozen=True)
class Call:
    """``takes``: t, x, k, p, u in order; ``writes``: the arrays and how many numbers each has."""

    name: str
    takes: tuple[str, ...]
    writes: dict[str, int]
    real: str

    def kinds(self):
        """The name of what is shown → the inputs u that it has."""
        more = {f"{self.name}_unforced": ""} if "u" in self.takes and STATES & {*self.takes} else {}
        return {self.name: "u"} | more

    def given(self, words, u):
        """The arguments in words of a language, by their letters; ``u``: empty for none."""
        words = {"z": "z"} | words | {"y": words["x"]}
        inputs = {"u": words["none"]} if "u" in self.takes and not u else {}
        return [x for x in ((words | inputs)[a] for a in self.takes) if x]


def calls(header, prefix, sizes):
    """The calls of a header, but for ``constants``, for ``rhs_batch`` of many states, and for those
    that a discrete step is made of."""
    reduced = re.search(rf"{prefix}_N_REDUCED = (\d+)", header)
    sizes = {**sizes, "REDUCED": int(reduced[1]) if reduced else 0}
    real = "float" if re.search(r"\bfloat \*", header) else "double"
    kept = re.search(r"_N_CONSERVED = (\d+)", header)
    sizes = sizes | {"CONSERVED": int(kept[1]) if kept else 0}
    for kind, name, listed in re.findall(
        DECLARED.format(real=real, prefix=prefix), header, re.MULTILINE
    ):
        if name != "rhs_batch" and not name.startswith("step_"):
            found = [ARGUMENT.fullmatch(x.strip()) for x in re.split(r",\s*", listed)]
            outs = [m["name"] for m in found if m["array"] and not m["kept"]]
            assert bool(outs) == (kind == "void"), name
            takes = tuple(m["name"] for m in found if m["name"] not in outs)
            yield Call(name, takes, {a: size(a, name, sizes) for a in outs}, real)


def size(array, function, sizes):
    """How many numbers an array has that a function writes."""
    if array == "D":
        rows = sizes["STATE"] if function == "jacobian_raw" else 2 * sizes["ALGEBRA"]
        return rows * (sizes[COLUMNS[function]] if function in COLUMNS else rows)
    if function == "conserved":
        return sizes["CONSERVED"]
    if function == "poisson":
        return sizes["REDUCED"] ** 2
    if function == "to_matrix":
        return sizes["STATE"] + MORE
    if array == "out":
        return sizes["INPUTS" if function.startswith("inputs_") else "STATE"]
    return sizes[SIZES[array]]


def in_c(call, library, prefix, values):
    """What the compiled C gives; ``values``: the arrays x, k, p, u; y is x."""
    values = with_others(values)
    array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
    function = getattr(library, f"{prefix}_{call.name}")
    function.restype = None if call.writes else ctypes.c_double
    function.argtypes = [ctypes.c_double if a == "t" else array for a in call.takes]
    function.argtypes += [array for _ in call.writes]
    outs = [np.full(n, np.nan) for n in call.writes.values()]
    value = function(*(T if a == "t" else values[a] for a in call.takes), *outs)
    return np.concatenate(outs) if outs else np.array([value])


def with_others(values):
    """The arrays with those that are made of x: y, of the same numbers, and z, which is x and then
    its first numbers again."""
    x = values["x"]
    return values | {"y": x, "z": np.resize(x, len(x) + MORE)}


def in_rust(call, name, u):
    words = {"z": "&std::array::from_fn(|i| x[i % m::N_STATE])"}
    words |= {"t": "T", "x": "x", "k": "&k", "p": "p", "u": "u", "none": "&[0.0; m::N_INPUTS]"}
    arguments = call.given(words, u)
    if not call.writes:
        return f'show("{name}", &[m::{call.name}({", ".join(arguments)})]);'
    if call.name == "project":
        return f'show("{name}", &m::{call.name}({", ".join(arguments)}));'
    made = "".join(f"let mut {a} = [0.0; {n}]; " for a, n in call.writes.items())
    arguments += [f"&mut {a}" for a in call.writes]
    shown = f"&[{', '.join(f'&{a}[..]' for a in call.writes)}].concat()"
    return f'{{ {made}m::{call.name}({", ".join(arguments)}); show("{name}", {shown}); }}'


def in_javascript(call, name, u):
    words = {"z": f"[...x, ...x.slice(0, {MORE})]"}
    words |= {"t": str(T), "x": "x", "k": "k", "p": "p", "u": "u", "none": ""}
    return f'show("{name}", flat(m.{call.name}({", ".join(call.given(words, u))})));'


def in_cpp(call, name, u):
    words = {"z": "around<m::MatrixState>(x)"}
    words |= {"t": "T", "x": "x", "k": "k", "p": "p", "u": "u", "none": ""}
    line = f'show("{name}", m::{call.name}({", ".join(call.given(words, u))}));'
    return "\n".join([line, *in_spans(call, name)]) if u else line


def in_spans(call, name):
    """The same call on spans, from C++20 on."""
    words = {"z": "m::In<m::n_matrix>(around<m::MatrixState>(x))"}
    words |= {"t": "T", "x": "std::span(x)", "k": "std::span(k)", "p": "std::span(p)", "none": ""}
    arguments = [*call.given(words | {"u": "std::span(u)"}, "u"), *call.writes]
    made = "".join(f"std::array<m::Real, {n}> {a}; " for a, n in call.writes.items())
    called = f"m::{call.name}({', '.join(arguments)})"
    shown = "".join(f"more({a}); " for a in call.writes) or f"more({called}); "
    done = f"{called}; " if call.writes else ""
    yield "#if __cplusplus >= 202002L"
    yield f'{{ {made}{done}start("{name}"); {shown}std::puts(""); }}'
    yield "#endif"


def in_python(call, module, values, u):
    """What a function of a module gives, for one state and as the second of a batch."""
    takes, values = [a for a in call.takes if a != "u" or u], with_others(values)
    function, given = getattr(module, call.name), [values[a] for a in takes]
    yield flat(function(*given))
    if STATES & {*takes}:
        batch = [
            np.stack([v + 1, v]) if a in STATES else v for a, v in zip(takes, given, strict=True)
        ]
        yield flat(function(*batch), 1)


def flat(found, *index):
    """The numbers of an array, or of several, one after the other; of one of a batch."""
    arrays = found if isinstance(found, tuple) else (found,)
    return np.concatenate([np.ravel(np.asarray(a)[index]) for a in arrays])


def in_julia(call, module, values, u):
    """What a function of a module that is read back gives: first what it writes, then x and k or
    p, then t."""
    x = values["x"].whole()
    around = Numbers(len(x) + MORE, values=[*x, *x[:MORE]])
    values = values | {"y": values["x"], "z": around}
    given = [values[a] for a in call.takes if a not in "tu"]
    time = [values["t"]] if "t" in call.takes else []
    inputs = {"u": values["u"]} if u and "u" in call.takes else {}
    if not call.writes:
        return [module.call(call.name, *time, *given, **inputs)]
    rows = module.names["N_STATE"] if call.name == "jacobian_raw" else 2 * module.names["N_ALGEBRA"]
    if call.name == "poisson":
        rows = module.names["N_REDUCED"]
    squares = ("D", "out") if call.name == "poisson" else ("D",)
    shapes = ((rows, n // rows) if a in squares else (n,) for a, n in call.writes.items())
    outs = [Numbers(*shape) for shape in shapes]
    module.call(f"{call.name}!", *outs, *given, *time, **inputs)
    return [x for out in outs for x in out.whole()]
