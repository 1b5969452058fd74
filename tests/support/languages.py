"""A problem in every language on the same numbers, and what the C makes of these."""

import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tests.support.library import BUILDS, emission, loaded, module
from tests.support.needs import CC, need

T = 0.3
PIECES = ("cvode", "fmu")
"""Languages of one function, run by themselves."""


def command(*words, **options):
    """Run a program in a folder; its warnings are errors."""
    done = subprocess.run(words, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    assert not done.stderr, done.stderr
    return done.stdout


DIVERGED = 1e6
"""Beyond this no motion is compared: a state by chance is off the group, where forms diverge."""


@dataclass
class Case:
    """A problem with options, numbers for its arrays, and what the C makes of them in double.

    ``problem``: as of :func:`tests.support.library.problem`.
    """

    problem: object
    options: dict
    real: str = "double"
    tolerance: float = 1e-14
    prefix: str | None = None
    values: dict = field(default_factory=dict)

    def __post_init__(self):
        name, texts = self.texts("python")
        m, rng = module(name, texts[f"{name}.py"]), np.random.default_rng(5)
        p = [m.DEFAULTS.get(x, 1.0) + rng.uniform(-0.1, 0.1) for x in m.PARAMETERS]
        x, u = rng.normal(size=len(m.STATE)), rng.normal(size=len(m.INPUTS))
        self.name, self.p, self.u, self.parameters = name, np.array(p), u, m.PARAMETERS
        self.names, self.values = [*m.STATE, *m.PARAMETERS, *m.INPUTS], {"x": x}
        large = 1e200 if self.real == "double" else 1  # beyond what a float holds
        self.refused = [0 * self.p, -self.p, self.line(), large * self.p]
        for at, value in ((0, np.nan), (len(p) - 1, np.inf)):
            self.refused.append(np.where(np.arange(len(p)) == at, value, self.p))
        self.reference = dict(self.shown(loaded("c", name, self.texts("c")[1])))

    def texts(self, language, real="double"):
        """The prefix and the texts in a language, with those of C."""
        more = {} if real == "double" else {"real": real}
        languages = tuple(dict.fromkeys(("c", language)))
        return emission(self.problem, languages, self.prefix, **self.options, **more)

    def line(self):
        """A body of masses on one line through the origin where moments are parameters, else p."""
        mass, r = np.array([1, 2, 0.5]), np.outer([1, -0.7, 2], [0.3, 1.4, -3.1])
        moments = {"m": mass.sum()} | {f"c_{i + 1}": mass @ r[:, i] for i in range(3)}
        moments |= {
            f"J_{i + 1}{j + 1}": mass @ (r[:, i] * r[:, j]) for i in range(3) for j in range(i, 3)
        }
        if "J_33" not in self.parameters:
            return self.p
        pairs = zip(self.parameters, self.p, strict=True)
        return np.array([moments.get(x, y) for x, y in pairs])

    def shown(self, library):
        """All that a library says of the numbers: what, and an array."""
        status, k = library.constants(self.p)
        assert status == 0
        yield "constants", k
        yield "status", np.array([library.constants(p)[0] for p in self.refused], float)
        values = library.values(t=T, k=k, p=self.p, u=self.u, **self.values)
        for call in library.calls:
            for end, u in call.ends():
                yield from ((call.name + end, x) for x in library.shown(call, values, u))
        for step in library.steps:
            (place,) = library.follow([(step, 1 / 512, 3)], values["x"], self.p, self.u)
            yield step, np.array([place.status, place.t, place.h, *place.x])

    def compare(self, library, tolerance=None):
        """Hold a library against the C: nothing is missing, nothing differs."""
        if library.language != "c":
            assert library.names() == self.names
        shown = [*self.shown(library)]
        assert {what for what, _ in shown} == {*self.reference}
        for what, found in shown:
            expected = self.reference[what]
            assert found.shape == expected.shape, (self.name, what)
            if what == "status":
                # C++ does not say why
                expected = expected != 0 if library.language == "cpp" else expected
                assert np.array_equal(found, expected), (self.name, what, found, expected)
                continue
            if what in library.steps and np.abs(expected).max() > DIVERGED:
                continue
            worst = np.abs(found - expected).max(initial=0)
            most = (tolerance or self.tolerance) * np.abs(expected).max(initial=0)
            assert worst <= most < np.inf, (self.name, what, worst)

    def agrees(self, build, tolerance=None, **changed):
        """In a build, with some files changed, it is what the C makes of it."""
        name, texts = self.texts(BUILDS[build][0], self.real)
        self.compare(loaded(build, name, texts | changed, self.real), tolerance)


CVODE = """\
#include <nvector/nvector_serial.h>
#include <stdio.h>

#include "{name}_cvode.h"

int main(void)
{{
    double k[{name}_N_CONSTANTS + 1];
    const double p[] = {{{p}}}, x0[] = {{{x}}};
    double u[] = {{{u}}};
    SUNContext context;
    if (SUNContext_Create(NULL, &context)) return 2;
    N_Vector x = N_VNew_Serial({name}_N_STATE, context), dx = N_VClone(x);
    for (int i = 0; i < {name}_N_STATE; ++i) N_VGetArrayPointer(x)[i] = x0[i];
    if ({name}_constants(p, k)) return 3;
    {name}_data data = {{k, u}};
    if ({name}_field(0.3, x, dx, &data)) return 4;
    for (int i = 0; i < {name}_N_STATE; ++i) printf("%.17g ", N_VGetArrayPointer(dx)[i]);
    return 0;
}}
"""


def cvode(case, **changed):
    """dx/dt by the function that CVODE of SUNDIALS takes, with some files changed."""
    need("cc", "SUNDIALS")
    arrays = {"p": case.p, "x": case.values["x"], "u": case.u}
    spelt = {a: ", ".join(map(repr, map(float, values))) for a, values in arrays.items()}
    with tempfile.TemporaryDirectory() as folder:
        texts = case.texts("cvode")[1] | changed
        for name, text in (texts | {"field.c": CVODE.format(name=case.name, **spelt)}).items():
            Path(folder, name).write_text(text, encoding="utf-8")
        words = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "field.c", f"{case.name}.c"]
        linked = ["-lsundials_nvecserial", "-lm", "-ofield"]
        command(CC, "-std=c99", *words, *linked, cwd=folder)
        return np.array(command("./field", cwd=folder).split(), float)
