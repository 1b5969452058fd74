"""What the comment of a Jacobian says of kinks: there one-sided differences of the emitted rate
differ, or are no numbers; elsewhere both are D."""

import re

import numpy as np
import pytest

from derive.command.cli import main
from tests.support.emitted_files import Emission

CASES = {
    "abs(zeta_1 - 1)*zeta_2": ("zeta_1 - 1 = 0 (abs)", [1, 0.5]),
    "zeta_1*sign(zeta_2)": ("zeta_2 = 0 (sign)", [0.5, 0]),
    "min(zeta_1, 2*zeta_2)": ("zeta_1 - 2 zeta_2 = 0 (min or max)", [1, 0.5]),
    "max(zeta_1, 3)": ("zeta_1 - 3 = 0 (min or max)", [3, 0.5]),
    "hypot(zeta_1, zeta_2)": ("zeta_1 = 0 and zeta_2 = 0 (hypot)", [0, 0]),
    "atan2(zeta_2, zeta_1 - 1)": ("zeta_2 = 0 and zeta_1 - 1 <= 0 (atan2)", [0.5, 0]),
    "sqrt(zeta_1)": ("zeta_1 = 0 (sqrt)", [0, 0.5]),
    "abs(T_1)": ("T_1 = 0 (abs)", [0.3, 0.2]),
    "sqrt(1 + zeta_1^2)": ("", [0, 0]),
    "zeta_1^3": ("", [0, 0]),
    "abs(zeta_1^2 + 1)": ("", [0, 0]),
    "abs(exp(zeta_1))": ("", [0, 0]),
    "sqrt(exp(zeta_1))": ("", [0, 0]),
    "max(zeta_1^2, -1)": ("", [0, 0]),
    "hypot(zeta_1, 2)": ("", [0, 0]),
    "atan2(zeta_1, 2)": ("", [0, 0]),
    "atan2(zeta_1, -2)": ("zeta_1 = 0 (atan2)", [0, 0.5]),
}
LANGUAGES = ("c", "cpp", "python", "rust", "julia", "javascript")


ENDINGS = (".h", ".hpp", ".py", ".rs", ".jl", ".mjs")


def emitted(data, *jacobians, **chosen):
    return Emission({"name": "test", **data}, LANGUAGES, jacobian=jacobians, **chosen)


def told(text):
    """The comment on kinks in a file, as one line."""
    line = re.sub(r"\s*\n\s*(\*|///|#|)\s*", " ", text)
    return re.findall(r"Kinks, where derivatives are one-sided or none: (.*?)\. ", line)


@pytest.mark.parametrize("law", CASES)
def test_at_kinks_and_elsewhere(law):
    locus, velocity = CASES[law]
    L = {"lagrangian": {"L": "(zeta_1^2 + zeta_2^2)/2"}}
    made = emitted({"group": "R(2)", **L, "force": [{"covector": [law, 0]}]}, "state")
    for end in ENDINGS:
        assert told(made.files[f"test{end}"]) == ([f"in force 1 {locus}"] if locus else []), end
    m = made.module
    k, h = m.constants([]), 1e-6

    def sided(x, s):
        rows = [m.rhs(0.0, x + s * h * e, k)[2] - m.rhs(0.0, x, k)[2] for e in np.eye(4)]
        return np.array(rows) / (s * h)

    with np.errstate(all="ignore"):
        at = np.array([0.0, 0, *velocity])
        jump = np.abs(sided(at, 1) - sided(at, -1)).max()
        assert (not jump < 0.1) == bool(locus)
        rng = np.random.default_rng(1)
        for _ in range(5):
            x = rng.uniform(0.2, 2, size=4)
            D = m.jacobian(0.0, x, k)[1][2]
            for s in (1, -1):
                assert np.abs(sided(x, s) - D).max() < 1e-4


POINTS = {
    "point": [
        {"mass": 1, "at": at, "block": block} for block in (1, 2) for at in ([0, 0], [1, 0], [0, 1])
    ]
}


@pytest.mark.parametrize("name", ["zeta1_1", "w1_2", "zeta2_1", "w2_2", "zeta_6", "T2_1"])
@pytest.mark.parametrize("source", ["points", "lagrangian"])
def test_in_a_product_they_have_the_names_of_the_blocks(name, source):
    """Of a body of points, whose velocity is entries of Z, and of a Lagrangian, where it is ζ."""
    energy = " + ".join(f"zeta_{k}^2/2" for k in range(1, 7))
    body = POINTS if source == "points" else {"lagrangian": {"L": energy}}
    force = {"covector": [0, 0, 0, f"abs({name})", 0, 0]}
    files = emitted({"group": "SE(2) x SE(2)", **body, "force": [force]}, "state").files
    called = {"zeta_6": "w2_2"}.get(name, name)
    for end in ENDINGS:
        assert told(files[f"test{end}"]) == [f"in force 1 {called} = 0 (abs)"], end


@pytest.mark.parametrize("law", ["-abs(v_1)*v_1", "-v_1"])
def test_the_derivatives_of_steps_say_them_and_gauss_what_it_does_not_see(law):
    """That is, each of the two steps, in each language; and no file of a problem without one."""
    data = {
        "group": "R(1)",
        "point": [{"mass": 1, "at": [0]}],
        "force": [{"name": "drag", "on": 1, "force": [law]}],
    }
    steps = ("gauss", "rk4")
    files = emitted(data, "step", step=steps).files
    bent = "abs" in law
    for end in ("_steps.h", *ENDINGS[1:]):
        text = files[f"test{end}"]
        raw = end != "_steps.h"  # the derivative of the rates, which a step's is made of
        wanted = ["in force drag v_1 = 0 (abs)"] * (len(steps) + raw) * bent
        assert told(text) == wanted, end
        seen = re.sub(r"\s*\n\s*(\*|///|#|)\s*", " ", text)
        assert ("the estimate of gauss does not see" in seen) == (bent and end != ".hpp"), end


def test_the_names_are_those_of_the_file():
    """A velocity along the axes of the body is v_1; what is carried along, and points, have their
    own; outputs that have all that acts have its kinks, and others not."""
    force = {"name": "drag", "at": [0, 0], "frame": "body", "force": ["-abs(v_1)*v_1", 0]}
    data = {
        "group": "SE(2)",
        "point": [{"mass": 1, "at": [1, 0]}, {"mass": 1, "at": [0, 1]}],
        "force": [force],
        "potential": [{"kind": "expression", "U": "abs(r2_y)^3"}],
        "output": [{"name": "y", "y": ["max(zeta_1, w_1)"]}],
    }
    acting = "in potential 1 r2_2 = 0 (abs); in force drag v_1 = 0 (abs)"
    own = "in output y zeta_1 - w_1 = 0 (min or max)"
    assert told(emitted(data, "state", "outputs").files["test.h"]) == [acting, own]
    felt = {"name": "f", "kind": "specific_force", "at": [0, 0]}
    made = emitted(data | {"output": [*data["output"], felt]}, "outputs")
    assert told(made.files["test.h"]) == [f"{acting}; {own}"]
    spun = {
        "algebra": {"of": "SO(3)"},
        "advected": [{"name": "up", "representation": "coadjoint"}],
        "lagrangian": {"L": "(zeta_1^2 + zeta_2^2 + zeta_3^2)/2"},
        "force": [{"covector": ["abs(up_2)", 0, 0]}],
    }
    assert told(emitted(spun, "raw").files["test.h"]) == ["in force 1 up_2 = 0 (abs)"]


@pytest.mark.parametrize("frame", ["body", "space"])
def test_the_velocity_less_that_of_a_wind_is_that_of_the_file(frame):
    force = {"name": "drag", "at": [0, 0], "frame": frame, "relative_to": ["abs(t - 1) + e", 0]}
    data = {
        "group": "SE(2)",
        "parameters": {"e": {"default": 1.0}},
        "point": [{"mass": 1, "at": [1, 0]}, {"mass": 1, "at": [0, 1]}],
        "force": [force | {"force": ["-abs(v_1)*v_1", "-hypot(v_1 - 2, v_2)"]}],
    }
    inside = ("v_1 = 0 (abs)", "v_1 - 2 = 0 and v_2 = 0 (hypot)", "t - 1 = 0 (abs)")
    says = "; ".join(f"in force drag {x}" for x in inside)
    assert told(emitted(data, "state").files["test.h"]) == [says]


def test_by_the_command_they_are_told(tmp_path, capsys):
    """Once, and only where a Jacobian is asked for."""
    file = tmp_path / "rubbed.toml"
    file.write_text(
        'name = "rubbed"\ngroup = "SO(2)"\npoint = [{ mass = 1, at = [1, 0] }]\n'
        'force = [{ name = "rub", moment = ["-sign(zeta_1)"], at = [0, 0] }]\n',
        encoding="utf-8",
    )
    at = ["--out", str(tmp_path)]
    assert main(["emit", str(file), *at]) == 0
    assert "Kinks" not in capsys.readouterr().err
    assert main(["emit", str(file), "--jacobian", "state", "--jacobian", "raw", *at]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line == (
        "derive: note: rubbed: Kinks, where derivatives are one-sided or none: "
        "in force rub zeta_1 = 0 (sign)."
    )
