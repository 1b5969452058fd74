"""The pictures of motions in docs/pictures: python -m tests.support.motion_pictures [--runs].

They are drawn, as ``derive plot`` draws, from the runs in examples/runs; with ``--runs`` these are
made first, as ``derive simulate`` makes them, and rounded to some digits: so the pictures are the
same on every machine that has the matplotlib of requirements-dev.lock.
"""

import math
import re
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np

from derive.command.cli import main
from derive.motion import ensemble_files
from derive.motion import run as run_files
from derive.motion.ensemble import Part
from derive.motion.run import Run

ROOT = Path(__file__).parents[2]
RUNS, PICTURES = ROOT / "examples" / "runs", ROOT / "docs" / "pictures"
FACTS = ("problem", "title", "group", "parameters", "inputs", "method", "body", "potential")
"""What a committed run says of itself."""


class Made(NamedTuple):
    """A run: the words of ``derive simulate``, the columns that are kept beside the time, all whose
    names begin so, and how many digits of the largest number of each."""

    words: str
    columns: tuple[str, ...]
    digits: int


MADE = {
    "racket.csv": Made(
        "so3 --t 60 --points 240 --exp 0,0,0 "
        "--set g_3=0 --set zeta_1=0.05 --set zeta_2=1 --set zeta_3=0",
        ("zeta",),
        5,
    ),
    "top.csv": Made("top --t 1.4 --points 210 --exp 0.5,0,0 --set zeta_3=200", ("A", "energy"), 6),
    "tetrahedron.csv": Made("sl3 --t 4 --points 80", ("A",), 7),
    "vorticity.npz": Made("zeitlin --t 13 --points 1", ("re", "im"), 4),
    "satellite.csv": Made("satellite.toml --t 20 --points 100", ("zeta",), 4),
    "tether.csv": Made("tether.toml --t 62.83 --points 200", ("pull",), 4),
    "boat.csv": Made("boat.toml --t 100 --points 50 --set engine=90", ("T", "w"), 4),
    "gyroscope.csv": Made("gyroscope.toml --t 2 --points 100", ("A",), 4),
    "wheel.csv": Made("wheel.toml --t 2.6 --points 52", ("zeta_1", "zeta_2"), 4),
    "gradient.csv": Made("gradient.toml --t 12000 --points 60", ("zeta_3",), 5),
    "drone.csv": Made(
        "drone.toml --t 2 --points 40 --set right=6.03 --set left=6", ("T", "zeta"), 4
    ),
    "plane.csv": Made("plane.toml --t 6 --points 48 --set torque_1=1", ("zeta",), 4),
    "nozzle.csv": Made("nozzle.toml --t 2 --points 40 --set delta=0.05", ("T", "zeta"), 4),
    "burning.csv": Made("burning.toml --t 20 --points 40", ("w_2",), 4),
    "vehicle.csv": Made(
        "vehicle.toml --t 20 --points 60 --set zeta_2=1 --set zeta_3=0.01", ("zeta",), 4
    ),
    "car.csv": Made(
        "car.toml --t 6 --points 60 --set w_1=20 --set delta=0.02 --set drive=16.87",
        ("T", "zeta"),
        4,
    ),
    "bar.csv": Made("bar.toml --t 3 --points 60", ("zeta",), 4),
    "tops.npz": Made(
        "top --t 1 --points 48 --ensemble 50 --vary zeta_3=80:120 --vary zeta_1=normal:0:0.5",
        ("A_33",),
        4,
    ),
}
DRAWN = {
    "polhode.svg": ("racket.csv", "polhode"),
    "precession.svg": ("top.csv", "axes"),
    "potential.svg": ("top.csv", "potential"),
    "tetrahedron.svg": ("tetrahedron.csv", "body"),
    "vorticity.svg": ("vorticity.npz", "vorticity"),
    "satellite.svg": ("satellite.csv", "state"),
    "tether.svg": ("tether.csv", "outputs"),
    "boat.svg": ("boat.csv", "state"),
    "gyroscope.svg": ("gyroscope.csv", "axes"),
    "wheel.svg": ("wheel.csv", "state"),
    "gradient.svg": ("gradient.csv", "state"),
    "drone.svg": ("drone.csv", "state"),
    "plane.svg": ("plane.csv", "state"),
    "nozzle.svg": ("nozzle.csv", "state"),
    "burning.svg": ("burning.csv", "state"),
    "vehicle.svg": ("vehicle.csv", "state"),
    "car.svg": ("car.csv", "state"),
    "bar.svg": ("bar.csv", "state"),
    "spread.svg": ("tops.npz", "spread"),
}
"""Picture → the run, and ``derive plot --kind``."""


def rounded(a: np.ndarray, digits: int) -> np.ndarray:
    """Columns with so many digits of the largest number of each."""
    largest = np.nanmax(np.abs(a), axis=tuple(range(a.ndim - 1)), initial=0.0)
    places = [digits - 1 - math.floor(math.log10(x)) if x > 0 else 0 for x in largest.tolist()]
    split = np.moveaxis(a, -1, 0)
    return np.stack([np.round(x, n) for x, n in zip(split, places, strict=True)], -1) + 0.0


def short(told: object, digits: int = 6) -> object:
    """Facts whose numbers have so many digits."""
    if isinstance(told, Mapping):
        return {name: short(x, digits) for name, x in told.items()}
    if isinstance(told, list | tuple):
        return [short(x, digits) for x in told]
    return float(f"{told:.{digits}g}") if isinstance(told, float) else told


def simulated(made: Made, path: Path) -> None:
    """The file of a run, as the command writes it; a problem may be a file of docs/systems.md."""
    name, *words = made.words.split()
    if name.endswith(".toml"):
        page = (ROOT / "docs" / "systems.md").read_text(encoding="utf-8")
        files = re.findall(r"^```toml\n(.*?)^```$", page, re.M | re.S)
        (text,) = (x for x in files if x.startswith(f'name = "{name[:-5]}"\n'))
        path.with_name(name).write_text(text, encoding="utf-8")
        name = str(path.with_name(name))
    assert main(["simulate", name, *words, "--out", str(path)]) == 0


def kept(made: Made, name: str) -> bool:
    """Is a column kept?"""
    return any(name == x or name.startswith(f"{x}_") for x in made.columns)


def small_run(run: Run, made: Made) -> Run:
    """The columns of a run that are kept, rounded; of a fluid the last instant alone."""
    places = [k for k, x in enumerate(run.columns) if x.kind == "time" or kept(made, x.name)]
    table = run.table[:, places] if "re" not in made.columns else run.table[-1:, places]
    facts = {x: run.facts[x] for x in FACTS}
    told = short(facts) | {"potential": short(facts["potential"], 8)}  # its well is shallow
    columns = tuple(run.columns[k] for k in places)
    return Run(columns, rounded(table, made.digits), told)


def small_ensemble(e: ensemble_files.Ensemble, made: Made) -> ensemble_files.Ensemble:
    """The columns of an ensemble that are kept, rounded."""
    places = [k for k, x in enumerate(e.names) if kept(made, x)]
    states, varied = (
        rounded(np.asarray(x), made.digits) for x in (e.states[..., places], e.varied)
    )
    names = tuple(e.names[k] for k in places)
    return replace(e, names=names, states=states, varied=varied)


def remade(name: str, folder: Path) -> bytes:
    """The bytes of a run of MADE."""
    made, path, out = MADE[name], folder / f"whole_{name}", folder / name
    simulated(made, path)
    if "--ensemble" not in made.words:
        return run_files.written(small_run(run_files.read(path), made), name)
    e = small_ensemble(ensemble_files.read(path), made)
    with out.open("wb") as file, ensemble_files.writer(file, name, e) as writer:
        writer.add(Part(e.varied, e.status, e.states, e.end))
    return out.read_bytes()


def drawn(name: str, folder: Path) -> bytes:
    """The bytes of a picture of DRAWN."""
    run, kind = DRAWN[name]
    out = folder / name
    assert main(["plot", str(RUNS / run), "--kind", kind, "--out", str(out)]) == 0
    return out.read_bytes()


def unlike() -> list[str]:
    """What draws, and is here in another version than in requirements-dev.lock."""
    text = (ROOT / "requirements-dev.lock").read_text(encoding="utf-8")
    wanted = re.findall(r"^([\w-]+==\S+)", text, re.M)  # for some Pythons each
    return [x for x in ("matplotlib", "numpy", "pillow") if f"{x}=={version(x)}" not in wanted]


if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    RUNS.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        for run in MADE if "--runs" in sys.argv[1:] else ():
            (RUNS / run).write_bytes(remade(run, Path(temporary)))
        for picture in DRAWN:
            (PICTURES / picture).write_bytes(drawn(picture, Path(temporary)))
