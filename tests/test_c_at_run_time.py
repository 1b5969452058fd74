"""The emitted C under sanitizers, on numbers of every size: no undefined behaviour, no trap."""

import re
import shutil
import subprocess

import pytest

from tests.exercise import program
from tests.forms import PROBLEMS, emit_forms, some_parameters

TRIALS = 900
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
NUMBERS = {"two_tops"}
"""Problems whose masses are numbers: no parameter can take their body away."""


@pytest.fixture(scope="module")
def exercise(tmp_path_factory):
    """A folder with every form, exercise.c that calls all of it, and the prefixes."""
    folder = tmp_path_factory.mktemp("exercise")
    made = emit_forms(folder)
    values = {name: some_parameters(name, folder) for name in PROBLEMS}
    headers = {x: (folder / f"{x}.h").read_text(encoding="utf-8") for x in made}
    fixed = {x for x, name in made.items() if name in NUMBERS}
    bodies = {x: values[name] for x, name in made.items()}
    (folder / "exercise.c").write_text(program(headers, bodies, TRIALS, fixed), encoding="utf-8")
    return folder, tuple(made)


def sanitized(compiler):
    """Whether this compiler is here with its sanitizers."""
    if shutil.which(compiler) is None:
        return False
    command = [compiler, *SANITIZERS, "-x", "c", "-", "-o", "/dev/null"]
    return not subprocess.run(command, input=b"int main(void){return 0;}", stderr=-3).returncode


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_no_undefined_behaviour(compiler, exercise):
    if not sanitized(compiler):
        pytest.skip(f"no {compiler} with sanitizers")
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
