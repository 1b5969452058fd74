"""A spring whose ends meet: where its natural length is a parameter that is 0, the force is −kd."""

import numpy as np
import pytest

from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.compare import compare
from derive.validate.exact_points import Claims
from derive.validate.read_file import read
from derive.validate.terms import DiffersError
from tests.support.library import ONE_BUILD, derived, emission, library, module_of

TIED = """
name = "tied"
group = "GROUP"
[parameters]
k = 2.0
LENGTH
[[point]]
mass = 1
at = [1, 0, 0.5]
[[point]]
mass = 2
at = [0, 1, 0]
[[point]]
mass = 0.5
at = [0, 0.3, 1]
[[point]]
mass = 0.7
at = [0.1, 0.3, -1]
[[potential]]
kind = "spring"
on = 1
anchor = [1, 0, 0.5]
stiffness = "k"
length = VALUE
"""
GROUPS = ("SE(3)", "SL(3)", "SAff(3)")


def text(group, length):
    """For a natural length that is a parameter l, or 0 in the file."""
    own = TIED.replace("GROUP", group).replace("LENGTH", "l = 0" if length else "")
    return own.replace("VALUE", '"l"' if length else "0")


def states(m):
    """At g = 1 the ends meet; then near and far from there; ζ is any."""
    rng = np.random.default_rng(2)
    x = np.array([float(name in ("A_11", "A_22", "A_33")) for name in m.STATE])
    free = [i for i, name in enumerate(m.STATE) if name[0] not in "AT"]
    x[free] = rng.normal(size=len(free))
    beside = np.array([float(name[0] in "AT") for name in m.STATE]) * rng.normal(size=len(x))
    return [x + size * beside for size in (0, 1e-9, 1e-3, 0.5)]


@pytest.mark.parametrize("group", GROUPS)
def test_length_0_is_that_of_a_linear_spring(group):
    m = module_of(text(group, True), jacobian=("state", "parameters"))
    plain = module_of(text(group, False), jacobian=("state",))
    k, k_plain = m.constants([2.0, 0.0]), plain.constants([2.0])
    for x in states(m):
        dx, D = m.jacobian(0, x, k)
        expected, D_plain = plain.jacobian(0, x, k_plain)
        assert np.allclose(dx, expected, rtol=1e-13, atol=1e-13)
        assert np.allclose(D, D_plain, rtol=1e-12, atol=1e-12)
        assert np.allclose(m.rhs(0, x, k), dx, rtol=1e-13, atol=1e-13)
        assert np.isclose(m.energy(0, x, k), plain.energy(0, x, k_plain), rtol=1e-13)
        assert np.isfinite(m.jacobian_parameters(0, x, np.array([2.0, 0.0]))).all()
    many = np.array(states(m))
    assert np.allclose(m.rhs(0, many, k), [m.rhs(0, x, k) for x in many], rtol=1e-14, atol=1e-14)
    lengths = m.constants(np.array([[2.0, 0.0], [2.0, 0.3]]))
    assert np.allclose(lengths[0], k, rtol=1e-15)
    assert np.allclose(lengths[1], m.constants([2.0, 0.3]), rtol=1e-15)


def test_the_slope_by_a_length_of_0():
    """Away from distance 0 it is that of any length; by steps to both sides."""
    m = module_of(text("SE(3)", True), jacobian=("parameters",))
    x, h = states(m)[-1], 1e-6
    D = m.jacobian_parameters(0, x, np.array([2.0, 0.0]))
    ends = [m.rhs(0, x, m.constants([2.0, s * h])) for s in (1, -1)]
    slope = (ends[0] - ends[1])[-6:] / (2 * h)
    assert np.allclose(D[-6:, list(m.PARAMETERS).index("l")], slope, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("group", GROUPS)
def test_a_length_has_no_direction_at_distance_0(group):
    m = module_of(text(group, True))
    k = m.constants([2.0, 0.5])
    there, near, *_ = states(m)
    with np.errstate(divide="ignore", invalid="ignore"):
        assert np.isnan(m.rhs(0, there, k)).any()
    assert np.isfinite(m.rhs(0, near, k)).all()
    texts = emission(text(group, True), ("c",))[1]
    header = " ".join(texts["tied.h"].replace(" * ", " ").split())
    assert "Where the ends of a spring meet, its natural length must be 0" in header
    assert "natural length" not in emission("so3", ("c",))[1]["so3.h"]


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("build", [x for x in ONE_BUILD.values() if x != "python"])
def test_in_other_languages(build, real):
    m, made = module_of(text("SE(3)", True)), library(build, text("SE(3)", True), real=real)
    status, k = made.constants(np.array([2.0, 0.0]))
    rhs = next(x for x in made.calls if x.name == "rhs")
    assert status == 0
    for x in states(m):
        values = made.values(t=0.0, p=np.array([2.0, 0.0]), k=k, u=np.zeros(0), x=x)
        expected = m.rhs(0, x, m.constants([2.0, 0.0]))
        for found in made.shown(rhs, values, False):
            close = {"double": 1e-13, "float": 1e-5}[real]
            assert np.allclose(found, expected, rtol=close, atol=close)


FAULTS = {
    "another length": ("1e-37*(l == 0)", "(l == 0)", "k_l/sqrt", "(k_l + slack_l)/sqrt"),
    "without it": ("", "", "k_l/sqrt", "(k_l + k_*slack_l)/sqrt"),
}


@pytest.mark.parametrize("case", FAULTS)
def test_what_holds_for_other_lengths_alone_is_refused(case):
    """Code that is right at random lengths and wrong at 0."""
    d = derived(text("SE(3)", True))
    files = d.emit(None, ["c"])
    claims = Claims(d.record, Chart(), 2**64)
    numbers = program(d.problem, d.record).numbers()
    assert compare(read("tied.c", files, "tied").module, claims, numbers).points >= 2
    old, new, before, after = FAULTS[case]
    source = files["tied.c"]
    assert old in source
    start = source.index("void tied_rhs(")
    assert before in source[start:]
    wrong = source[:start].replace(old, new) + source[start:].replace(f"{before}", after, 2)
    with pytest.raises(DiffersError):
        compare(read("tied.c", {**files, "tied.c": wrong}, "tied").module, claims, numbers)
