"""The FMUs of a problem, of both standards, as another's importer reads and runs them (FMPy)."""

import subprocess
import zipfile

import numpy as np
import pytest

import derive
from tests.support.needs import CC, need, needs

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
    return derive.derive(folder / "drone.toml")


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


def pushed(t):
    return 3.0 * np.ones_like(t)


@needs("the module fmpy")
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("name", BINARIES)
def test_an_importer_follows_the_same_motion(drone, emitted, name, kind):
    """With a parameter, a start and an input that are not those of the file."""
    import fmpy

    ours = drone.simulate(TIME, start={**CHANGED, "f": 3.0}, points=20, tol=1e-12)
    read = ("energy", "tip_1", "tip_3")
    names = (*ours.of_kind("state"), *read)
    told = {"tol": 1e-9} if kind == "CoSimulation" else {}
    found = fmpy.simulate_fmu(
        emitted / name.removesuffix(".fmu"),
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


BALL = """
name = "ball"
group = "R(1)"
point = [{ mass = 1, at = [0] }]
force = [{ on = 1, force = ["-abs(v_1)*v_1/2"] }]
potential = [{ kind = "gravity", g = [-9.81] }]
initial = { zeta_1 = 10 }
"""


@needs("cc", "the module fmpy")
@pytest.mark.parametrize(("steps", "least", "most"), [("gauss", 1e-7, 1e-5), ("both", 0, 1e-9)])
def test_a_step_that_sees_where_a_force_bends_is_taken(steps, least, most, tmp_path):
    """A ball that goes up and comes down through air, beside the formulas of both ways."""
    import fmpy

    (tmp_path / "ball.toml").write_text(BALL, encoding="utf-8")
    ball = derive.derive(tmp_path / "ball.toml")
    ball.emit(tmp_path, "fmu", step=("gauss", "vern9") if steps == "both" else ("gauss",))
    folder = built(tmp_path / "ball.fmu", BINARIES["drone.fmu"])
    options = {"fmi_type": "CoSimulation", "output_interval": 0.1, "relative_tolerance": 1e-9}
    found = fmpy.simulate_fmu(folder, stop_time=2.0, output=["T_1"], **options)
    rate, angle = np.sqrt(9.81 / 2), np.arctan(10 / np.sqrt(9.81 * 2))
    height = -2 * np.log(np.cos(angle)) - 2 * np.log(np.cosh(2 * rate - angle))
    assert least < abs(found["T_1"][-1] - height) < most


@needs("the module fmpy")
@pytest.mark.parametrize("name", BINARIES)
def test_the_archive_is_valid(emitted, name):
    from fmpy import validation

    assert validation.validate_fmu(str(emitted / name)) == []


@needs("the module fmpy")
@pytest.mark.parametrize("name", BINARIES)
def test_each_rate_is_that_of_its_state(emitted, name):
    import fmpy

    described = fmpy.read_model_description(emitted / name)
    rates = [x.variable for x in described.derivatives]
    assert [x.name for x in rates] == [f"der({x.derivative.name})" for x in rates]
    assert len(rates) == 18
    mass = next(x for x in described.modelVariables if x.name == "m")
    assert (mass.unit, mass.description, mass.start) == ("kg", "mass & more", "2.0")


@needs("the module fmpy")
@pytest.mark.parametrize("name", BINARIES)
def test_a_coarse_integrator_is_taken_back_to_the_group(drone, emitted, name):
    import fmpy

    names = [f"A_{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    found = fmpy.simulate_fmu(
        emitted / name.removesuffix(".fmu"),
        fmi_type="ModelExchange",
        stop_time=5.0,
        relative_tolerance=1e-2,
        output=names,
    )
    A = np.array([[found[x][-1] for x in names[3 * i : 3 * i + 3]] for i in range(3)])
    assert np.abs(A.T @ A - np.eye(3)).max() < 1e-5


@needs("the module fmpy")
@pytest.mark.parametrize("name", BINARIES)
def test_what_is_set_between_steps_counts(drone, emitted, name):
    """A parameter, an input and a number of the state, each after a step; then start again."""
    import fmpy

    unit = Instance(fmpy, emitted / name.removesuffix(".fmu"))
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


@needs("the module fmpy")
@pytest.mark.parametrize("name", BINARIES)
def test_an_instance_is_kept_and_restored(emitted, name):
    """As bytes, too; and the motion goes on from there by the same bits."""
    import fmpy

    unit = Instance(fmpy, emitted / name.removesuffix(".fmu"))
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


@needs("the module fmpy")
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("name", BINARIES)
def test_a_refused_parameter_is_said_to_the_importer(emitted, name, kind):
    """By the function for messages of either standard, once; and no number comes out."""
    import fmpy

    heard = []
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmpy.simulate_fmu(
            emitted / name.removesuffix(".fmu"),
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
