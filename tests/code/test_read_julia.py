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
    "an operator that is not known": ("-sqrt(y)*", "-sqrt(y)^2*"),
    "integers": ("x[2]\n        + 1.0", "1 + 2"),
    "a loop without an end": ("    if y <= 0", "    while y <= 0\n    end\n    if y <= 0"),
    "a name of a loop after it": (
        "    y = 2.0*",
        "    for i in 1:2\n        z = 1.0\n    end\n    y = z*",
    ),
    "no syntax": ("if y <= 0", "if y <= "),
    "a keyword": ("    y = 2.0*", "    end = 1.0\n    y = 2.0*"),
    "a name twice": ("const N_INPUTS = 2\n", "const N_INPUTS = 2\nconst N_INPUTS = 2\n"),
    "a number as a condition": ("if y <= 0", "if y"),
    "another module": ("end # module m\n", "end\nmodule n\nend\n"),
    "a keyword among the arguments": ("f(x; u", "f(x, u"),
    "no value": ("    return -sqrt(y)*(x[1])\n", ""),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_no_such_julia_is_an_error(case):
    old, new = WRONG[case]
    assert old in TEXT
    with pytest.raises((JuliaError, ValueError)):
        value(TEXT.replace(old, new), 3, 2)
