"""The emitted C in float on a Cortex-M4F: built, measured, and run under qemu beside the host."""

import subprocess

import numpy as np
import pytest

from derive import derive
from tests.support.library import module_of
from tests.support.needs import CC, need, needs

ARM = ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"]
STRICT = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wdouble-promotion", "-Werror", "-O2"]
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
def built(request, tmp_path_factory):
    """The name, the folder with the object file, and the module."""
    need("arm-none-eabi-gcc")
    name, folder = request.param, tmp_path_factory.mktemp("arm")
    derive(name).emit(folder, ["c"], real="float")
    command = ["arm-none-eabi-gcc", *ARM, *STRICT, "-fstack-usage", "-c", f"{name}.c"]
    subprocess.run(command, cwd=folder, check=True)
    return name, folder, module_of(name, real="float")


def test_stack_and_size(built):
    name, folder, _ = built
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


def test_nothing_but_libm(built):
    """No call of a library: no double arithmetic in software, no memory, no input or output."""
    name, folder, _ = built
    wanted = subprocess.run(
        ["arm-none-eabi-nm", "-u", f"{name}.o"], cwd=folder, check=True,
        capture_output=True, text=True,
    ).stdout  # fmt: skip
    assert not wanted.split()


@needs("qemu-arm")
def test_it_computes_what_the_host_does(built):
    name, folder, module = built
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
def test_a_ship_in_single_numbers(name, tmp_path):
    """Moments of 1e13 kg m²: their determinant is no float, and is not needed."""
    derive(name).emit(tmp_path, ["c"], real="float")
    module = module_of(name)
    body = {"m": 3e8, "J_11": 3e12, "J_22": 6e11, "J_33": 2e11, "J_13": 3e10, "c_3": 1e9}
    p = [body.get(x, -9.8 if x == "g_3" else 0.0) for x in module.PARAMETERS]
    values = ", ".join(f"{v!r}f" for v in p)
    zeta = len(module.STATE) - len(module.BASIS)
    x = [float(i % 4 == 0 and i < 9) for i in range(zeta)]
    x += [0.1, -0.2, 0.3, 1.0, 2.0, 3.0][: len(module.BASIS)]
    (tmp_path / "main.c").write_text(
        f'#include "{name}.h"\n#include <stdio.h>\n'
        f"int main(void) {{ const float p[] = {{{values}}}, x[] = {{{listed(x)}}}, "
        f"u[{name}_N_INPUTS] = {{0}}; float k[{name}_N_CONSTANTS], dx[{name}_N_STATE];\n"
        f"if ({name}_constants(p, k)) return 1; {name}_rhs(0, x, k, u, dx);\n"
        f'for (int i = 0; i < {name}_N_STATE; ++i) printf("%.9g ", (double)dx[i]); return 0; }}\n'
    )
    command = [CC, "-std=c99", "main.c", f"{name}.c", "-lm", "-o", "main"]
    subprocess.run(command, cwd=tmp_path, check=True)
    done = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True)
    expected = module.rhs(0.0, np.array(x), module.constants(p))
    np.testing.assert_allclose([*map(float, done.stdout.split())], expected, rtol=2e-4, atol=1e-5)
