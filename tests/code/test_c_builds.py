"""How the emitted C goes into a user's program: its sizes, its flags, and the order of its work."""

import itertools
import platform
import re
import shutil
import subprocess

import pytest

from derive import derive
from derive.code.languages import LANGUAGES, blocks, names
from derive.code.options import Options
from derive.command.cli import main
from derive.programs import program
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
STRICT = ["-pedantic", "-Wall", "-Wextra", "-Werror"]


@pytest.mark.parametrize("form", ["source", "header"])
@pytest.mark.parametrize("compiler", ["gcc -std=c99", "g++ -std=c++17", "clang -std=c99"])
def test_arrays_of_a_problem_without_constants_and_inputs(compiler, form, tmp_path):
    """The counts are 0; what is declared by the sizes is an array all the same."""
    command = compiler.split()
    need(command[0])
    (tmp_path / "bare.toml").write_text(BARE)
    derive(tmp_path / "bare.toml").emit(tmp_path, ["c"], form=form)
    end = ".cpp" if command[0] == "g++" else ".c"
    (tmp_path / f"main{end}").write_text(USER)
    sources = [f"main{end}"]
    if form == "source":
        shutil.copy(tmp_path / "bare.c", tmp_path / f"library{end}")
        sources.append(f"library{end}")
    subprocess.run([*command, *STRICT, *sources, "-o", "main", "-lm"], cwd=tmp_path, check=True)
    done = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True)
    # dA/dt = A Z at A = 1
    assert done.stdout == "0 0 0 1 2"


@pytest.mark.parametrize("name", ["so3", "se3", "sl3", "hammer"])
def test_no_file_overrides_the_flags_of_a_project(name):
    """An option of the compiler in a file would also keep link-time optimisation from inlining."""
    for form, frame in itertools.product(("source", "header"), ("given", "principal")):
        if frame == "principal" and name == "hammer":
            continue
        framed = [x for x, language in LANGUAGES.items() if language.framed or frame == "given"]
        files = derive(name).emit(languages=framed, form=form, frame=frame)
        assert files
        for file, text in files.items():
            found = re.findall(r"#\s*pragma\s+(?:GCC|clang)\s+optim\w*|optimize\s*\(|optnone", text)
            assert not found, f"{file}: {found}"


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


ROADS = [
    ("top", {}),
    ("se3", {}),
    ("sl3", {"velocity": "tangent"}),
    ("so3", {"frame": "principal"}),
]


@pytest.mark.parametrize(("name", "options"), ROADS)
def test_blocks_hold_all_of_a_function_in_a_possible_order(name, options):
    d = derive(name)
    f = program(d.problem, d.record, Options(**options)).functions["rhs"]
    known, outputs = set(), []
    for block in blocks(f):
        known |= {x.name for x in block.loads}
        for value in block.section.values:
            assert names([value.expression]) <= known
            assert value.name not in known
            known.add(value.name)
        known |= {x.name for x in block.output_loads}
        assert names([f.outputs[i] for i in block.outputs]) <= known
        outputs += block.outputs
    assert sorted(outputs) == list(range(len(f.outputs)))
    assert known == {x.name for x in f.loads} | {v.name for s in f.sections for v in s.values}


def test_rates_stand_early_and_loads_late():
    """dA/dt right after what else reads A, before the accelerations; each load where it is used."""
    text = derive("so3").emit(languages=["c"])["so3.c"]
    body = text.partition("void so3_rhs(")[2].partition("\n}\n")[0]
    order = [
        "A_T_gravity_3 =",
        "dx[0] =",
        "dx[8] =",
        "J_12 =",
        "balance_1 =",
        "inv_I_11 =",
        "dx[9] =",
    ]
    places = [body.index(x) for x in order]
    assert places == sorted(places)


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
    assert main(["emit", "so3", "--lang", "rust", "--form", "header", "--names"]) == 2
    assert "--form header is one of c" in capsys.readouterr().err
