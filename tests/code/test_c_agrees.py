"""The emitted C of every compiler and level is the same numbers.

Without contraction (-ffp-contract=off, or no fused multiply-add in the machine) they are the same
bits; for gcc with -fno-tree-slp-vectorize, too, where the machine has one, as the vfmaddsub that
gcc 12 packs a b - c and d e + f into heeds no -ffp-contract.  With it they differ by a few units in
the last place of the sum of the magnitudes of the terms (tests/support/rounding.py): 2.4 was the
most in hundreds of states and bodies of every problem and form.
"""

import platform
from pathlib import Path

import numpy as np
import pytest

from tests.support.forms import FORMS, emit_forms, some_parameters
from tests.support.needs import need, needs
from tests.support.rounding import built, sized

ULP = 4 * 2.0**-52
STATES, BODIES = 60, 6
SAME = ("-std=c99", "-ffp-contract=off")
UNPACKED = {"gcc": ["-fno-tree-slp-vectorize"], "clang": []}
FUSED = {"default": ("-std=gnu99",), "fast": ("-std=c99", "-ffp-contract=fast")}
LEVELS = ("-O0", "-O1", "-O2", "-O3")
SOME = {
    "plain": ("so3", "sl3", "comet", "two_tops"),
    "quaternion": ("so3",),
    "tangent": ("sl3",),
    "principal": ("so3",),
}


def multiply_add():
    """The flag for the fused multiply-add of this machine; none where it has none or always."""
    flags = Path("/proc/cpuinfo")
    here = platform.machine() == "x86_64" and flags.exists() and " fma " in flags.read_text()
    return ["-mfma"] if here else []


class Compared:
    """Numbers of one build to hold others against, and the sizes of their terms."""

    def __init__(self, folder, prefixes):
        self.folder, self.prefixes = folder, prefixes
        names = {*prefixes.values()}
        values = {name: some_parameters(name) for name in sorted(names)}
        self.first = built(["gcc", "-O0", *SAME, *multiply_add()], prefixes, folder, "first.so")
        rng = np.random.default_rng(5)
        self.cases = {}
        for x, name in prefixes.items():
            size = {key: int(n) for key, n in self.first.sizes[x].items()}
            p = np.array(values[name]) * rng.uniform(0.95, 1.05, (BODIES, len(values[name])))
            k = [self.first.constants(x, each) for each in p]
            states = rng.normal(size=(STATES, size["STATE"]))
            self.cases[x] = p, k, states, rng.normal(size=(STATES, size["INPUTS"]))
        self.expected = {x: self.numbers(self.first, x) for x in prefixes}
        # the axes of a principal frame are found by turns, not by a formula with terms
        known = [x for x in prefixes if not x.endswith("principal")]
        terms = sized(known, folder)
        self.terms = {x: [n[..., 1] for n in self.numbers(terms, x)] for x in known}

    def numbers(self, functions, x):
        """Constants, rates and energies; the constants that rates are made of are the first's."""
        p, k, states, inputs = self.cases[x]
        made = [functions.constants(x, each) for each in p]
        with_k = [
            (s, k[i % BODIES], u) for i, (s, u) in enumerate(zip(states, inputs, strict=True))
        ]
        rates = [functions.rhs(x, *each) for each in with_k]
        energies = [functions.energy(x, *each[:2]) for each in with_k]
        columns = [np.ascontiguousarray(a.T) for a in (states, inputs)]
        batch = functions.rhs_batch(x, columns[0], k[0], columns[1])
        return [np.array(made), np.array(rates), np.array(energies), batch]

    def hold(self, command, fused):
        """The same bits, or within the bound where operations may be fused; the largest error."""
        name = "".join(command).replace("=", "") + ".so"
        functions, worst = built(command, self.prefixes, self.folder, name), 0.0
        for x in self.prefixes:
            found = self.numbers(functions, x)
            if not fused:
                for a, b in zip(found, self.expected[x], strict=True):
                    np.testing.assert_array_equal(a, b, err_msg=x)
            elif x in self.terms:
                for a, b, size in zip(found, self.expected[x], self.terms[x], strict=True):
                    assert np.all(np.abs(a - b) <= ULP * size), x
                    worst = max(worst, np.max(np.abs(a - b) / (ULP / 4 * np.maximum(size, 1e-300))))
        return worst


@pytest.fixture(scope="module")
def some(tmp_path_factory):
    """Every problem plainly, and one in each other form."""
    folder, prefixes = tmp_path_factory.mktemp("agrees"), {}
    for form, problems in SOME.items():
        prefixes |= emit_forms(folder, problems, [form])
    return Compared(folder, prefixes)


@pytest.mark.parametrize(("compiler", "level"), [("gcc", "-O3"), ("clang", "-O2")])
def test_bits_without_contraction(compiler, level, request):
    need(compiler, "gcc", "g++")
    flags = [*SAME, *UNPACKED[compiler], *multiply_add()]
    request.getfixturevalue("some").hold([compiler, level, *flags], False)


def test_bits_of_packed_statements(request):
    """gcc packs what it likes where there is nothing to fuse with."""
    need("gcc", "g++")
    if platform.machine() != "x86_64":
        pytest.skip("the machine may fuse")
    request.getfixturevalue("some").hold(["gcc", "-O3", *SAME], False)


@pytest.mark.parametrize(("compiler", "level"), [("gcc", "-O2"), ("clang", "-O1")])
def test_last_places_with_contraction(compiler, level, request):
    need(compiler, "gcc", "g++")
    flags = [*FUSED["default"], *multiply_add()]
    worst = request.getfixturevalue("some").hold([compiler, level, *flags], True)
    assert worst > 0 or not multiply_add()


@pytest.mark.dist
@needs("gcc", "clang", "g++")
def test_all_forms_by_all_builds(tmp_path):
    forms = [x for x in FORMS if x != "jacobian"]
    compared = Compared(tmp_path, emit_forms(tmp_path, forms=forms))
    for compiler in ("gcc", "clang"):
        for level in LEVELS:
            compared.hold([compiler, level, *SAME, *UNPACKED[compiler], *multiply_add()], False)
            found = [
                compared.hold([compiler, level, *flags, *multiply_add()], True)
                for flags in [*FUSED.values()][: 1 + (level == "-O3")]
            ]
            print(f"{compiler} {level}: {max(found):.2f} units in the last place when fused")
