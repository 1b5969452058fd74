"""The emitted C under sanitizers, on numbers of every size: no undefined behaviour, no trap."""

import re
import subprocess

import pytest

from tests.support.exercise import program
from tests.support.forms import PROBLEMS, emit_forms, some_parameters
from tests.support.needs import need

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
    (folder / "exercise.c").write_text(program(headers, bodies, TRIALS, fixed), encoding="utf-8")
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
