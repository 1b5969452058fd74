"""How the emitted C goes into a user's program: its sizes, its flags, the order of its work; under
sanitizers, on numbers of every size: no undefined behaviour, no trap; on a Cortex-M4F in float:
built, measured, and run under qemu beside the host.
"""

import platform
import re
import subprocess

import numpy as np
import pytest

from derive import derive
from derive.code.languages import LANGUAGES
from derive.command.cli import main
from tests.support.exercise import PROBLEMS, emit_forms, some_parameters
from tests.support.exercise import program as exercise_program
from tests.support.library import STRICT, built, emission, library, module_of
from tests.support.needs import need, needs

BARE = """
name = "bare"
group = "SL(2)"

[[point]]
mass = 1
at = [1, 0]

[[point]]
mass = 1
at = [0, 1]
"""
USER = """
#include "bare.h"
#include <stdio.h>

int main(void)
{
    double p[bare_SIZE_P] = {0}, k[bare_SIZE_K], u[bare_SIZE_U] = {0}, dx[bare_N_STATE];
    const double x[bare_N_STATE] = {1, 0, 0, 1, 0, 1, 2};
    if (bare_constants(p, k) != 0) {
        return 1;
    }
    bare_rhs(0, x, k, u, dx);
    printf("%d %d %d %g %g", bare_N_PARAMETERS, bare_N_CONSTANTS, bare_N_INPUTS, dx[1], dx[2]);
    return 0;
}
"""


@pytest.mark.parametrize("form", ["source", "header"])
@pytest.mark.parametrize("compiler", ["gcc -std=c99", "g++ -std=c++17", "clang -std=c99"])
def test_arrays_of_a_problem_without_constants_and_inputs(compiler, form):
    """The counts are 0; what is declared by the sizes is an array all the same."""
    words = compiler.split()
    need(words[0])
    end = ".cpp" if words[0] == "g++" else ".c"
    texts = {f"main{end}": USER}
    for name, text in emission(BARE, ("c",), form=form)[1].items():
        texts[name if name.endswith(".h") else f"library{end}"] = text
    sources = [x for x in texts if x.endswith(end)]
    program = built([(*words, "-pedantic", *STRICT, *sources, "-o", "out", "-lm")], texts)
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    # dA/dt = A Z at A = 1
    assert done.stdout == "0 0 0 1 2"


def test_link_time_optimisation_inlines(tmp_path):
    need("gcc", "nm")
    derive("so3").emit(tmp_path, ["c"])
    (tmp_path / "main.c").write_text(
        '#include "so3.h"\n'
        "int main(void)\n{\n"
        "    double p[so3_SIZE_P] = {0}, k[so3_SIZE_K], u[so3_SIZE_U] = {0};\n"
        "    double x[so3_N_STATE] = {1}, dx[so3_N_STATE];\n"
        "    const int status = so3_constants(p, k);\n"
        "    so3_rhs(0, x, k, u, dx);\n"
        "    return status + (dx[9] > 0);\n}\n"
    )
    command = ["gcc", "-std=c99", "-O2", "-flto"]
    (tmp_path / "none.c").write_text("int main(void) { return 0; }\n")
    if subprocess.run([*command, "none.c"], cwd=tmp_path, capture_output=True).returncode:
        pytest.skip("no link-time optimisation here")
    subprocess.run([*command, "main.c", "so3.c", "-o", "main", "-lm"], cwd=tmp_path, check=True)
    symbols = subprocess.run(["nm", tmp_path / "main"], capture_output=True, text=True, check=True)
    assert "main" in symbols.stdout
    assert "so3_rhs" not in symbols.stdout


@needs("objdump")
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_batches_are_vectorised(compiler, tmp_path):
    """gcc and clang use packed multiplications in the loop over states."""
    need(compiler)
    for name in ("so3", "se3", "sl3"):
        derive(name).emit(tmp_path, ("c",))
        source, out = tmp_path / f"{name}.c", tmp_path / "batch.o"
        flags = ["-std=c99", "-O3", "-fno-math-errno", "-c", str(source), "-o", str(out)]
        subprocess.run([compiler, *flags], check=True)
        shown = subprocess.run(
            ["objdump", "-d", f"--disassemble={name}_rhs_batch", str(out)],
            check=True, capture_output=True, text=True,
        ).stdout  # fmt: skip
        packed, single = shown.count("mulpd"), shown.count("mulsd")
        if platform.machine() == "x86_64":
            assert packed > 50, (name, packed, single)


@pytest.mark.parametrize("form", ["source", "header"])
def test_the_names_are_those_of_the_files(form, tmp_path, capsys):
    """In every language; with a prefix no problem is read, without one it has its own."""
    chosen = [x for name in LANGUAGES for x in ("--lang", name)]
    assert main(["emit", "none.toml", *chosen, "--prefix", "so3", "--form", form, "--names"]) == 0
    names = capsys.readouterr().out.splitlines()
    assert sorted(names) == sorted(derive("so3").emit(None, tuple(LANGUAGES), form=form))
    assert main(["emit", "top", "--names"]) == 0
    assert capsys.readouterr().out.splitlines() == ["top.h", "top.c", "top.py"]


# ---------------------------------------------------------------- sanitizers

TRIALS = 900
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
NUMBERS = {"two_tops"}
"""Problems whose masses are numbers: no parameter can take their body away."""


@pytest.fixture(scope="module")
def exercise(tmp_path_factory):
    """A folder with every form, exercise.c that calls all of it, and the prefixes."""
    folder = tmp_path_factory.mktemp("exercise")
    made = emit_forms(folder)
    values = {name: some_parameters(name) for name in PROBLEMS}
    headers = {x: (folder / f"{x}.h").read_text(encoding="utf-8") for x in made}
    fixed = {x for x, name in made.items() if name in NUMBERS}
    bodies = {x: values[name] for x, name in made.items()}
    (folder / "exercise.c").write_text(
        exercise_program(headers, bodies, TRIALS, fixed), encoding="utf-8"
    )
    return folder, tuple(made)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_no_undefined_behaviour(compiler, exercise):
    need(f"sanitizers of {compiler}")
    folder, prefixes = exercise
    command = [compiler, "-std=gnu99", "-O0", "-g1", *SANITIZERS, "exercise.c"]
    command += [*(f"{x}.c" for x in prefixes), "-lm", "-o", f"exercise-{compiler}"]
    subprocess.run(command, cwd=folder, check=True)
    done = subprocess.run([folder / f"exercise-{compiler}"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-500:] + done.stderr[:3000]
    seen = {line.split()[0]: [*map(int, line.split()[1:])] for line in done.stdout.splitlines()}
    assert set(seen) == set(prefixes)
    for prefix, counts in seen.items():
        assert sum(counts) == TRIALS
        assert counts[0] > TRIALS // 3 - 1
        assert counts[2], f"{prefix}: no body was found not finite"


# ---------------------------------------------------------------- tools that read the code

SWITCHED_OFF = {
    "bugprone-easily-swappable-parameters": "x, k and u are arrays of one type; the order is said",
}
TIDY = ",".join(
    ["-*", "bugprone-*", "cert-*", "clang-analyzer-*", *(f"-{x}" for x in SWITCHED_OFF)]
)
TOOLS = {
    "gcc": ["gcc", "-std=c99", "-O2", "-Wall", "-Wextra", "-fanalyzer", "-c", "-o", "/dev/null"],
    "clang-tidy": ["clang-tidy", "--quiet", f"--checks={TIDY}", "--header-filter=.*"],
    "cppcheck": [
        "cppcheck",
        "--std=c99",
        "--quiet",
        "--enable=warning,style,performance,portability",
    ],
}
SOME = ("so3_plain", "se3_principal", "sl3_tangent", "so3_jacobian", "two_tops_plain")
"""For the slow tools: the others have the same templates, and are read by ``make dist``."""
WRONG = """\
#include <stdlib.h>
double wrong(int n);
double wrong(int n)
{
    int *p = malloc(sizeof(int));
    p[0] = n;
    const int q = p[0] / 2 + p[1];
    if (n) { free(p); }
    return q / 2;
}
"""


def told(tool, folder, prefixes):
    """What a tool says of sources, apart from counting."""
    sources = [f"{x}.c" for x in prefixes]
    runs = [[*TOOLS[tool], x] for x in sources] if tool == "gcc" else [[*TOOLS[tool], *sources]]
    if tool == "clang-tidy":
        runs[0] += ["--", "-std=c99"]
    text = ""
    for command in runs:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        text += "".join(done.stdout + done.stderr)
    return [x for x in text.splitlines() if not re.match(r"\d+ warnings? generated|Suppressed", x)]


@pytest.mark.parametrize("tool", TOOLS)
def test_nothing_to_remark(tool, tmp_path):
    need(tool)
    for prefix in SOME:
        name, _, form = prefix.rpartition("_")
        emit_forms(tmp_path, (name,), (form,))
    assert not told(tool, tmp_path, SOME)
    (tmp_path / "wrong.c").write_text(WRONG)
    assert told(tool, tmp_path, ["wrong"]), "the tool is blind"


@pytest.mark.dist
@pytest.mark.parametrize("tool", ["gcc", "clang-tidy"])
def test_nothing_to_remark_in_any_form(tool, exercise):
    need(tool)
    assert not told(tool, *exercise)


# ---------------------------------------------------------------- small machines

ARM = ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"]
IN_FLOAT = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wdouble-promotion", "-Werror", "-O2"]
STACK = {"so3": 256, "se3": 384, "sl3": 512}

# no library: the number of what constants returned and the bits of dx, by system calls of Linux
MAIN = """\
#include "{name}.h"
static const float p[] = {{{p}}}, x[] = {{{x}}}, u[] = {{{u}}};
static float k[{name}_N_CONSTANTS], dx[{name}_N_STATE];
static long call(long number, long a, long b, long c)
{{
    register long r0 __asm__("r0") = a, r1 __asm__("r1") = b, r2 __asm__("r2") = c;
    register long r7 __asm__("r7") = number;
    __asm__ volatile("svc 0" : "+r"(r0) : "r"(r1), "r"(r2), "r"(r7) : "memory");
    return r0;
}}
void _start(void);
void _start(void)
{{
    const int status = {name}_constants(p, k);
    {name}_rhs(0, x, k, u, dx);
    call(4, 1, (long)dx, sizeof dx);
    call(1, status, 0, 0);
}}
"""


def listed(values):
    return ", ".join(f"{float(np.float32(v))!r}f" for v in values) or "0"


@pytest.fixture(scope="module", params=["so3", "se3", "sl3"])
def for_arm(request, tmp_path_factory):
    """The name, the folder with the object file, and the module."""
    need("arm-none-eabi-gcc")
    name, folder = request.param, tmp_path_factory.mktemp("arm")
    derive(name).emit(folder, ["c"], real="float")
    command = ["arm-none-eabi-gcc", *ARM, *IN_FLOAT, "-fstack-usage", "-c", f"{name}.c"]
    subprocess.run(command, cwd=folder, check=True)
    return name, folder, module_of(name, real="float")


def test_stack_and_size(for_arm):
    name, folder, _ = for_arm
    usage = {
        line.split()[0].rpartition(":")[2]: int(line.split()[1])
        for line in (folder / f"{name}.su").read_text().splitlines()
    }
    sizes = subprocess.run(
        ["arm-none-eabi-size", f"{name}.o"], cwd=folder, check=True, capture_output=True, text=True
    ).stdout.splitlines()
    text, data, bss = map(int, sizes[1].split()[:3])
    print(f"{name}: {text} bytes of code, stack {usage}")
    assert usage[f"{name}_rhs"] <= STACK[name]
    assert (data, bss) == (0, 0)
    assert text < 16_000


def test_nothing_but_libm(for_arm):
    """No call of a library: no double arithmetic in software, no memory, no input or output."""
    name, folder, _ = for_arm
    wanted = subprocess.run(
        ["arm-none-eabi-nm", "-u", f"{name}.o"], cwd=folder, check=True,
        capture_output=True, text=True,
    ).stdout  # fmt: skip
    assert not wanted.split()


@needs("qemu-arm")
def test_it_computes_what_the_host_does(for_arm):
    name, folder, module = for_arm
    rng = np.random.default_rng(2)
    p = np.array([module.DEFAULTS[x] for x in module.PARAMETERS])
    for _ in range(3):
        x, u = rng.normal(size=len(module.STATE)), rng.normal(size=len(module.INPUTS))
        given = {key: listed(v) for key, v in (("p", p), ("x", x), ("u", u))}
        (folder / "main.c").write_text(MAIN.format(name=name, **given))
        command = ["arm-none-eabi-gcc", *ARM, "-std=gnu99", "-O2", "-nostartfiles", "main.c"]
        subprocess.run([*command, f"{name}.o", "-o", "main", "-lm"], cwd=folder, check=True)
        done = subprocess.run(
            ["qemu-arm", "-cpu", "max", "./main"], cwd=folder, capture_output=True
        )
        assert done.returncode == 0, done.stderr
        found = np.frombuffer(done.stdout, np.float32)
        single = [np.float32(v).astype(float) for v in (p, x, u)]
        expected = module.rhs(0.0, single[1], module.constants(single[0]), single[2])
        assert np.allclose(found, expected, rtol=2e-4, atol=2e-6 * np.abs(expected).max())


@needs("cc")
@pytest.mark.parametrize("name", ["so3", "se3"])
def test_a_ship_in_single_numbers(name):
    """Moments of 1e13 kg m²: their determinant is no float, and is not needed."""
    module, ship = module_of(name), library("c", name, real="float")
    body = {"m": 3e8, "J_11": 3e12, "J_22": 6e11, "J_33": 2e11, "J_13": 3e10, "c_3": 1e9}
    p = [body.get(x, -9.8 if x == "g_3" else 0.0) for x in module.PARAMETERS]
    rest = len(module.STATE) - 9
    velocity = [0.1, -0.2, 0.3, 1.0, 2.0, 3.0][: len(module.BASIS)]
    x = np.array([*np.eye(3).ravel(), *np.zeros(rest - len(velocity)), *velocity])
    status, k = ship.constants(np.array(p))
    assert status == 0
    found = ship.rhs(0.0, x, k, np.zeros(len(module.INPUTS)))
    expected = module.rhs(0.0, x, module.constants(p))
    np.testing.assert_allclose(found, expected, rtol=2e-4, atol=1e-5)
