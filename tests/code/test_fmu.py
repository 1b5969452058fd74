"""The FMUs of a problem, of both standards, as another's importer reads and runs them (FMPy); the
emitted C in a program that integrates it by CVODE of SUNDIALS.
"""

import importlib
import re
import subprocess
import zipfile
from pathlib import Path

import numpy as np
import pytest

from derive import derive
from tests.support.library import module_of
from tests.support.needs import CC, need, needs
from tests.support.states import flow

DRONE = """
name = "drone"
group = "SE(3)"
[body]
given = { m = "m", c = [0, 0, "c_3"], J = [["J_1", 0, 0], [0, 2, 0], [0, 0, 3]] }
[parameters]
m = { default = 2, unit = "kg", meaning = "mass & more" }
c_3 = 0.1
J_1 = 1
[[potential]]
kind = "gravity"
g = [0, 0, -9.81]
[[input]]
name = "f"
kind = "force"
at = [0, 0.2, 1]
direction = [0, 0, 1]
[[output]]
name = "tip"
kind = "place"
at = [0, 0, 1]
[initial]
zeta_1 = 0.5
zeta_3 = 2
"""
OPTIONS = {"step": ("gauss",), "conserved": True}
BINARIES = {"drone.fmu": "x86_64-linux", "drone_fmi2.fmu": "linux64"}
TIME, CHANGED = 2.0, {"c_3": 0.3, "w_1": 0.25}


@pytest.fixture(scope="module")
def drone(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drone")
    (folder / "drone.toml").write_text(DRONE, encoding="utf-8")
    return derive(folder / "drone.toml")


@pytest.fixture(scope="module")
def emitted(drone, tmp_path_factory):
    """The folder of the files, with what a compiler makes of the sources of each archive."""
    need("cc")
    folder = tmp_path_factory.mktemp("emitted")
    drone.emit(folder, "fmu", **OPTIONS)
    for name, binaries in BINARIES.items():
        built(folder / name, binaries)
    return folder


def built(archive, binaries):
    """The folder of an archive, with what a compiler makes of its sources."""
    apart = archive.with_suffix("")
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(apart)
    to = apart / "binaries" / binaries
    to.mkdir(parents=True)
    flags = ("-std=c99", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fPIC", "-shared")
    sources = sorted((apart / "sources").glob("*.c"))
    library = to / f"{archive.stem.removesuffix('_fmi2')}.so"
    subprocess.run([CC, *flags, *sources, "-lm", "-o", library], check=True)
    return apart


@pytest.fixture
def fmpy():
    """The importer."""
    need("the module fmpy")
    importlib.import_module("fmpy.validation")
    return importlib.import_module("fmpy")


@pytest.fixture(params=BINARIES)
def unpacked(request, emitted):
    """The folder of an archive, with what a compiler makes of its sources."""
    return emitted / request.param.removesuffix(".fmu")


each_kind = pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])


@each_kind
def test_an_importer_follows_the_same_motion(drone, fmpy, unpacked, kind):
    """With a parameter, a start and an input that are not those of the file."""
    ours = drone.simulate(TIME, start={**CHANGED, "f": 3.0}, points=20, tol=1e-12)
    read = ("energy", "tip_1", "tip_3")
    names = (*ours.of_kind("state"), *read)
    told = {"tol": 1e-9} if kind == "CoSimulation" else {}
    found = fmpy.simulate_fmu(
        unpacked,
        fmi_type=kind,
        stop_time=TIME,
        output_interval=0.1,
        relative_tolerance=told.get("tol", 1e-10),
        start_values={**CHANGED, "f": 3.0},
        output=(*names, "f"),
    )
    assert np.allclose(found["time"], ours.t, atol=1e-12)
    bound = 1e-8 if kind == "CoSimulation" else 1e-6  # that of CVODE, after 20 000 of its errors
    for x in names:
        assert np.abs(found[x] - ours[x]).max() < bound, x
    assert (found["f"] == 3.0).all()


def test_the_archive_is_valid(fmpy, unpacked):
    assert fmpy.validation.validate_fmu(f"{unpacked}.fmu") == []


BALL = """
name = "ball"
group = "R(1)"
point = [{ mass = 1, at = [0] }]
force = [{ on = 1, force = ["-abs(v_1)*v_1/2"] }]
potential = [{ kind = "gravity", g = [-9.81] }]
initial = { zeta_1 = 10 }
"""


@needs("cc")
@pytest.mark.parametrize(("steps", "least", "most"), [("gauss", 1e-7, 1e-5), ("both", 0, 1e-9)])
def test_a_step_that_sees_where_a_force_bends_is_taken(fmpy, steps, least, most, tmp_path):
    """A ball that goes up and comes down through air, beside the formulas of both ways."""
    (tmp_path / "ball.toml").write_text(BALL, encoding="utf-8")
    ball = derive(tmp_path / "ball.toml")
    ball.emit(tmp_path, "fmu", step=("gauss", "vern9") if steps == "both" else ("gauss",))
    folder = built(tmp_path / "ball.fmu", BINARIES["drone.fmu"])
    options = {"fmi_type": "CoSimulation", "output_interval": 0.1, "relative_tolerance": 1e-9}
    found = fmpy.simulate_fmu(folder, stop_time=2.0, output=["T_1"], **options)
    rate, angle = np.sqrt(9.81 / 2), np.arctan(10 / np.sqrt(9.81 * 2))
    height = -2 * np.log(np.cos(angle)) - 2 * np.log(np.cosh(2 * rate - angle))
    assert least < abs(found["T_1"][-1] - height) < most


def test_each_rate_is_that_of_its_state(fmpy, unpacked):
    described = fmpy.read_model_description(unpacked)
    rates = [x.variable for x in described.derivatives]
    assert [x.name for x in rates] == [f"der({x.derivative.name})" for x in rates]
    assert len(rates) == 18
    mass = next(x for x in described.modelVariables if x.name == "m")
    assert (mass.unit, mass.description, mass.start) == ("kg", "mass & more", "2.0")


def test_a_coarse_integrator_is_taken_back_to_the_group(drone, fmpy, unpacked):
    names = [f"A_{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    found = fmpy.simulate_fmu(
        unpacked,
        fmi_type="ModelExchange",
        stop_time=5.0,
        relative_tolerance=1e-2,
        output=names,
    )
    A = np.array([[found[x][-1] for x in names[3 * i : 3 * i + 3]] for i in range(3)])
    assert np.abs(A.T @ A - np.eye(3)).max() < 1e-5


def test_what_is_set_between_steps_counts(drone, fmpy, unpacked):
    """A parameter, an input and a number of the state, each after a step; then start again."""
    unit = Instance(fmpy, unpacked)
    at = {x.name: x.valueReference for x in unit.described.modelVariables}
    state = [*range(1, 19)]
    unit.step(0.0, 0.25)
    x = drone.simulate(0.25, points=1, tol=1e-12)
    for k, (place, value) in enumerate([("J_1", 1.5), ("f", 2.0), ("w_3", -0.5)], 1):
        unit.write([at[place]], [value])
        unit.step(0.25 * k, 0.25)
        given = {name: float(column[-1]) for name, column in x.of_kind("state").items()}
        given |= x.facts["inputs"] | x.facts["parameters"]
        x = drone.simulate(0.25, start=given | {place: value}, points=1, tol=1e-12)
        ours = [float(column[-1]) for column in x.of_kind("state").values()]
        assert np.allclose(unit.read(state), ours, atol=1e-9), place


def test_an_instance_is_kept_and_restored(fmpy, unpacked):
    """As bytes, too; and the motion goes on from there by the same bits."""
    unit = Instance(fmpy, unpacked)
    places = list(range(1, 19))
    kept = unit.get()
    saved = unit.bytes_of(kept)
    unit.step(0.0, 0.25)
    first = unit.read(places)
    for state in (kept, unit.of_bytes(saved)):
        unit.put(state)
        assert unit.read(places)[12:15] == [0.5, 0.0, 2.0]
        unit.step(0.0, 0.25)
        assert unit.read(places) == first
        unit.free(state)


@each_kind
def test_a_refused_parameter_is_said_to_the_importer(fmpy, unpacked, kind):
    """By the function for messages of either standard, once; and no number comes out."""
    heard = []
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmpy.simulate_fmu(
            unpacked,
            fmi_type=kind,
            stop_time=1.0,
            start_values={"m": -1.0},
            logger=lambda *message: heard.append(message),
        )
    (message,) = heard
    text = b" ".join(part for part in message if isinstance(part, bytes)).decode()
    assert "logStatusError" in text
    assert "the mass matrix singular or not positive" in text


class Instance:
    """A unit under co-simulation, the same for both standards."""

    def __init__(self, fmpy, folder):
        self.described = described = fmpy.read_model_description(folder)
        self.two = described.fmiVersion == "2.0"
        kind = fmpy.fmi2.FMU2Slave if self.two else fmpy.fmi3.FMU3Slave
        self.unit = kind(
            guid=described.guid if self.two else described.instantiationToken,
            unzipDirectory=str(folder),
            modelIdentifier="drone",
            instanceName="one",
        )
        self.unit.instantiate()
        if self.two:
            self.unit.setupExperiment(startTime=0.0)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()

    def step(self, t, h):
        self.unit.doStep(currentCommunicationPoint=t, communicationStepSize=h)

    def read(self, places):
        return list(self.unit.getReal(places) if self.two else self.unit.getFloat64(places))

    def write(self, places, values):
        (self.unit.setReal if self.two else self.unit.setFloat64)(places, values)

    def get(self):
        return self.unit.getFMUstate() if self.two else self.unit.getFMUState()

    def put(self, state):
        (self.unit.setFMUstate if self.two else self.unit.setFMUState)(state)

    def free(self, state):
        (self.unit.freeFMUstate if self.two else self.unit.freeFMUState)(state)

    def bytes_of(self, state):
        return (self.unit.serializeFMUstate if self.two else self.unit.serializeFMUState)(state)

    def of_bytes(self, data):
        of = self.unit.deSerializeFMUstate if self.two else self.unit.deserializeFMUState
        return of(data)


# ---------------------------------------------------------------- CVODE

MAIN = """\
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "top_cvode.h"

int main(int argc, char **argv)
{
    const double p[] = {800, 0.03, 0.05, 9.81};
    double k[top_N_CONSTANTS], t = 0;
    top_data data = {k, NULL};
    SUNContext context;
    if (top_constants(p, k) || SUNContext_Create(NULL, &context)) return 2;
    N_Vector x = N_VNew_Serial(top_N_STATE, context);
    double *at = N_VGetArrayPointer(x);
    for (int i = 0; i < top_N_STATE; ++i) at[i] = i < 9 && i % 4 == 0;
    at[top_N_STATE - 3] = 3;
    at[top_N_STATE - 1] = 100;
    void *memory = CVodeCreate(CV_BDF, context);
    if (CVodeInit(memory, top_field, 0, x) || CVodeSStolerances(memory, 1e-7, 1e-8)) return 3;
    SUNMatrix A = SUNDenseMatrix(top_N_STATE, top_N_STATE, context);
    SUNLinearSolver solver = SUNLinSol_Dense(x, A, context);
    if (CVodeSetUserData(memory, &data) || CVodeSetLinearSolver(memory, solver, A)) return 4;
    if (argc > 1 && atoi(argv[1])) {
        if (CVodeSetProjFn(memory, top_projection)) return 5;
        if (CVodeSetProjErrEst(memory, SUNFALSE)) return 6;
    }
    if (CVodeSetMaxNumSteps(memory, 100000) || CVodeSetStopTime(memory, 1)) return 7;
    if (argc > 1 && argv[1][0] == 'D') { /* the Jacobian at the start, by rows */
        top_jacobian_of_field(0, x, NULL, A, &data, NULL, NULL, NULL);
        for (int i = 0; i < top_N_STATE; ++i)
            for (int j = 0; j < top_N_STATE; ++j) printf("%.17g ", SM_ELEMENT_D(A, i, j));
        return 0;
    }
    long differences = 0; /* evaluations of the field for difference quotients */
    if (argc > 2 && CVodeSetJacFn(memory, top_jacobian_of_field)) return 8;
    if (CVode(memory, 1, x, &t, CV_NORMAL) < 0) return 9; /* at the end of a step */
    if (CVodeGetNumLinRhsEvals(memory, &differences) || (argc > 2) != !differences) return 10;
    printf("%.3e\\n", argc > 2 ? at[top_N_STATE - 3] : top_defect(at));
    return 0;
}
"""


@needs("cc", "SUNDIALS")
def test_cvode_projects_each_step(tmp_path):
    derive("top").emit(tmp_path, ["cvode"], jacobian=["raw"])
    (tmp_path / "main.c").write_text(MAIN)
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O2"]
    kinds = ("cvode", "nvecserial", "sunlinsoldense", "sunmatrixdense")
    libraries = [f"-lsundials_{x}" for x in kinds]
    command = [CC, *strict, "main.c", "top.c", "-o", "main", *libraries, "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)

    def run(*how):
        done = subprocess.run(["./main", *how], cwd=tmp_path, capture_output=True, check=True)
        return np.array(done.stdout.split(), float)

    alone, kept = run("0"), run("1")
    assert kept < 1e-12 < 1e-6 < alone
    start = np.concatenate([np.eye(3).ravel(), [3, 0, 100]])
    code = module_of("top", jacobian=("raw",))
    k = code.constants([800, 0.03, 0.05, 9.81])
    exact = flow(code, k, start, [0, 1])[-1, 9]
    assert abs(run("1", "J") - exact) < 1e-3
    expected = code.jacobian_raw(0.0, start, k)
    found = run("D").reshape(expected.shape)
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()
    assert np.abs(found - found.T).max() > 1


@needs("cc", "SUNDIALS")
@pytest.mark.parametrize(("real", "precision"), [("double", "DOUBLE"), ("float", "SINGLE")])
def test_sundials_of_another_precision_is_refused(real, precision, tmp_path):
    """Its headers say what they were built with; the numbers would be read as the other kind."""
    config = Path("/usr/include/sundials/sundials_config.h")
    built = re.search(r"(?m)^#define SUNDIALS_(\w+)_PRECISION 1", config.read_text())[1]
    derive("top").emit(tmp_path, ["cvode"], real=real)
    (tmp_path / "user.c").write_text('#include "top_cvode.h"\nint user(void) { return 0; }\n')
    strict = [CC, "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "user.c"]
    for here in ("DOUBLE", "SINGLE"):
        # as if SUNDIALS had been built so
        as_built = f"#undef SUNDIALS_{built}_PRECISION\n#define SUNDIALS_{here}_PRECISION 1\n"
        (tmp_path / "as.h").write_text(f"#include <sundials/sundials_config.h>\n{as_built}")
        done = subprocess.run(
            [*strict, "-include", "as.h"], cwd=tmp_path, capture_output=True, text=True
        )
        assert (done.returncode == 0) == (here == precision), done.stderr
        if here != precision:
            other = {"double": "float", "float": "double"}[real]
            told = f"use SUNDIALS of {precision.lower()} precision, or derive emit --real {other}"
            assert told in done.stderr
