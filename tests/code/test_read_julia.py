"""What evaluates emitted Julia is as strict about it as Julia, and knows nothing else."""

import numpy as np
import pytest

from tests.support.read_julia import DomainError, JuliaError, Module, Numbers

TEXT = '''# a comment
module m
const N_INPUTS = 2
const NAMES = ("a", "b",)
const ZEROS = ntuple(_ -> zero(Float64), N_INPUTS)
"""
    f(x)
"""
function f(x; u = nothing)
    u = u === nothing ? ZEROS : u
    y = 2.0*(x[1] - u[1])/(x[2]
        + 1.0)
    if y <= 0
        throw(DomainError(x, "negative"))
    end
    all(isfinite, x) || throw(DomainError(x, "not finite"))
    return -sqrt(y)*(x[1])
end
g(c) = (x, t) -> f(x; u = c(t))
end # module m
'''


def value(text, *numbers, **keywords):
    return Module(text).call(
        "f", Numbers(len(numbers), values=map(np.float64, numbers)), **keywords
    )


def test_what_is_emitted_has_its_value():
    assert Module(TEXT).name == "m"
    assert Module(TEXT).names["NAMES"] == ("a", "b")
    assert value(TEXT, 3, 2) == -np.sqrt(2.0) * 3
    assert value(TEXT, 3, 2, u=(np.float64(1),)) == -np.sqrt(4 / 3) * 3
    pair = Numbers(2, values=map(np.float64, (3, 2)))
    assert Module(TEXT).call("g", lambda t: (t,))(pair, np.float64(0)) == -np.sqrt(2.0) * 3


def test_floats_stay_floats():
    text = TEXT.replace("2.0*", "2.0f0*").replace("1.0)", "1f0)")
    x = Numbers(2, values=map(np.float32, (3, 2)))
    assert type(Module(text).call("f", x, u=(np.float32(0),))) is np.float32
    assert type(Module(text).call("f", x)) is np.float64  # the zeros are of Float64


@pytest.mark.parametrize("x", [(-1, 2), (np.nan, 1), (np.inf, 1)])
def test_a_domain_error_is_told(x):
    with pytest.raises(DomainError):
        value(TEXT, *x)


STEPS = """module m
const TABLE = reshape([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3, 2)
# a comment
Base.@kwdef mutable struct Motion
    t::Float64 = 0.0 # a time
    made::Int = 0
    good::Bool = true
    x::Array{Float64, 2} = zeros(Float64, 2, 3)
    u::Any = zeros(Float64, 0)
end

function Motion(t, x)
    m = Motion()
    m.t = t
    copyto!(view(m.x, :, 2), x)
    return m
end

function turned!(m, h, n = 2; u = nothing)
    total = 0.0
    while m.made < n
        part = h / 2.0
        for i in 3:-1:1
            if !(i < 3)
                continue
            else
                m.x[1, i] += muladd(TABLE[i, 2], part, m.x[2, i])
            end
        end
        for j in 1:2:3
            total += Float64(j)
            if j == 3 && total > 7.0
                break
            end
        end
        m.made += 1
    end
    m.t -= u isa Function ? u(m) : total > 4.0 ? total : 0.0
    m.good = m.made % 2 == div(5, 2)
    return m.x[1, 2]
end
end
"""


def moved(text):
    """The module, a motion that has turned, and what this said."""
    module = Module(text)
    m = module.call("Motion", 3, Numbers(2, values=map(np.float64, (0.5, 0.25))))
    assert type(m["t"]) is np.float64
    return module, m, module.call("turned!", m, np.float64(4))


def test_loops_and_records_have_their_values():
    module, m, said = moved(STEPS)
    assert said == 0.5 + 2 * (5 * 2 + 0.25)
    assert (m["made"], m["t"], m["good"]) == (2, 3 - 8, False)
    assert [*m["x"]] == [16, 21, 0, 0, 0.25, 0]  # row by row
    module.call("turned!", m, np.float64(4), 3, u=lambda m: np.float64(0.5))
    assert (m["made"], m["t"]) == (3, -5.5)


WRONG_STEPS = {
    "a name of a loop in its next turn": ("part = h", "part = m.made == 0 ? h : part"),
    "a field that there is not": ("m.made += 1", "m.mode += 1"),
    "a field of another type": ("m.made += 1", "m.made += 0.5"),
    "an array of other numbers of indices": ("zeros(Float64, 2, 3)", "zeros(Float64, 3)"),
    "a number of indices": ("m.x[2, i]", "m.x[2, i, 1]"),
    "an index beyond that of columns": ("TABLE[i, 2]", "TABLE[i, 3]"),
    "a copy of another length": ("view(m.x, :, 2)", "view(m.x, 1, :)"),
    "a view beyond": ("view(m.x, :, 2)", "view(m.x, :, 4)"),
    "no truth": ("!(i < 3)", "!i"),
    "an index that is no integer": ("TABLE[i, 2]", "TABLE[total, 2]"),
    "no such method": ("Motion()\n    m", "Motion(t)\n    m"),
}
WRONG = {
    "an expression that ends with its line": ("(x[2]\n        + 1.0)", "x[2]\n        + 1.0"),
    "an index from 0": ("x[1]", "x[0]"),
    "an index beyond": ("x[2]", "x[3]"),
    "a number for two indices": ("x[2]", "x[1, 2]"),
    "a name without value": ("sqrt(y)", "sqrt(z)"),
    "a name that is assigned later": ("throw(DomainError(x", "y = N_INPUTS\n        throw(v(x"),
    "a local name read first": ("    y = 2.0*", "    N_INPUTS = 1.0*N_INPUTS\n    y = 2.0*"),
    "another function": ("sqrt(y)", "cbrt(y)"),
    "a product by juxtaposition": ("2.0*(x", "2.0(x"),
    "an operator that is not known": ("-sqrt(y)*", "-sqrt(y)//"),
    "a quotient of integers": ("x[2]\n        + 1.0", "1/2"),
    "a name of a loop after it": (
        "    y = 2.0*",
        "    for i in 1:2\n        z = 1.0\n    end\n    y = z*",
    ),
    "no syntax": ("if y <= 0", "if y <= "),
    "a keyword": ("    y = 2.0*", "    end = 1.0\n    y = 2.0*"),
    "a name twice": ("const N_INPUTS = 2\n", "const N_INPUTS = 2\nconst N_INPUTS = 2\n"),
    "a number as a condition": ("if y <= 0", "if y"),
    "another module": ("end # module m\n", "end\nmodule n\nend\n"),
    "no value": ("    return -sqrt(y)*(x[1])\n", ""),
}
TABLE = [(STEPS, *x) for x in WRONG_STEPS.values()] + [(TEXT, *x) for x in WRONG.values()]


@pytest.mark.parametrize(("text", "old", "new"), TABLE, ids=[*WRONG_STEPS, *WRONG])
def test_what_is_no_such_julia_is_an_error(text, old, new):
    assert old in text
    changed = text.replace(old, new)
    with pytest.raises((JuliaError, ValueError)):
        moved(changed) if text is STEPS else value(changed, 3, 2)
