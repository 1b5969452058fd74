"""``derive compare`` names what is wrong in someone's code, and nothing in right code."""

from pathlib import Path

import pytest

from derive.command.cli import main
from derive.command.writing import StoppedError
from derive.compare import comparison
from tests.compare import codes

CALLS = {x["problem"]: x["as"] for x in codes.LISTED["others"].values() if "file" not in x}
"""Problem → how its code is called."""


def compared(capsys, folder, name, *changes, table=None):
    """The exit code and what is printed of a code with some of its text changed."""
    problem, code = (getattr(codes, name.upper() + x) for x in ("", "_CODE"))
    return codes.compared(capsys, folder, problem, code, table or CALLS[name.upper()], *changes)


WIND = "the wind (relative_to of the force drag)"
FULL = (
    "    push = rate",
    """
    full = np.array([6, 2, 2, 3])
    r_0 = full @ AT / 13
    inertia = sum(q * hat(p).T @ hat(p) for q, p in zip(full, AT)) - 13 * hat(r_0).T @ hat(r_0)
    push = rate""",
)
TURNED = """    N, A = M.copy(), x[:9].reshape(3, 3)
    N[3:, 3:] = A.T @ M[3:, 3:] @ A
"""
FULL_TENSOR = "the tensor of inertia about the centre of mass is that of the start, where fuel is 6"
FAULTS = {
    "sign of a gyroscopic row": (
        "drone",
        ("GYRO = np.ones(3)", "GYRO = np.array([1, -1, 1])"),
        "ω × Iω about the centre of mass in row 2 has the other sign",
    ),
    "Coriolis of added mass": (
        "vehicle",
        (" + np.cross(v, p[3:])", ""),
        "v × p of the momenta π = ∂ℓ/∂ω, p = ∂ℓ/∂v is missing",
    ),
    "lever arm": (
        "drone",
        ("[0.23, 0.04, -0.3]", "[-0.23, -0.04, 0.3]"),
        "the lever arm (at of the input thrust) has the other sign",
    ),
    "added mass": (
        "vehicle",
        ("[0.2, 0, 0, 0, 3.9, 0]", "[0.2, 0, 0, 0, 4.4, 0]"),
        "operator_55 is 4.4, not 3.9",
    ),
    "an operator turned in its part of v": (
        "vehicle",
        ("p = M @", "p = mass(x) @"),
        ("    return M", f"{TURNED}    return N"),
        "the v-part of the operator of inertia has its numbers along the axes of space instead",
    ),
    "an operator of v, ω": (
        "vehicle",
        ("p = M @", "p = mass(x) @"),
        ("    return M", "    return np.roll(M, (3, 3), (0, 1))"),
        "the operator of inertia has v before ω",
    ),
    "coupling in the momenta": (
        "vehicle",
        ("p = M @", "p = (M * np.kron([[1, -1], [-1, 1]], np.ones((3, 3)))) @"),
        "what couples ω and v in the operator of inertia in the momenta π, p of the Coriolis terms",
    ),
    "axes of an operator": (
        "vehicle",
        ("p = M @", "p = mass(x) @"),
        ("    return M", "    J = [0, 1, 2, 3, 5, 4]\n    return M[np.ix_(J, J)]"),
        "the operator of inertia has the axes 2 and 3 exchanged, on the side of v",
    ),
    "products of inertia": (
        "drone",
        (
            "[[0.31, 0.012, -0.023], [0.012, 0.42, 0.017], [-0.023, 0.017, 0.55]]",
            "[[0.31, -0.023, 0.012], [-0.023, 0.42, 0.017], [0.012, 0.017, 0.55]]",
        ),
        "I_centre_12 and I_centre_13 are exchanged",
    ),
    "frame of ω": (
        "drone",
        ("A @ hat(w)", "hat(w) @ A"),
        "the rate of matrix is right if omega has frame 'space'",
    ),
    "frame of a thrust": (
        "drone",
        ("force + push", "force + A.T @ push"),
        "the force of all inputs has its numbers along the axes of space instead",
    ),
    "frame of gravity": (
        "drone",
        ("m * A.T @ [0, 0, -g]", "m * np.array([0, 0, -g])"),
        "the force of gravity, with its moment by the arm, has its numbers along the axes of",
    ),
    "axes that turn": ("car", ("F / 3 - r * u", "F / 3"), "ω × Mv in row 3 is missing"),
    "ω × Iω": (
        "wheel",
        ("L = I @ o + [0, 0, H]", "L = np.array([0, 0, H])"),
        "ω × Iω is missing",
    ),
    "parallel axis": (
        "top",
        ("STEINER", "0"),
        "the tensor of inertia is about another point",
    ),
    "power of the gravity gradient": (
        "satellite",
        ("N = 3.7, 1.3, np.diag([0.3, 0.4, 0.6]), 5", "N = 3.7, 1.3, np.diag([0.3, 0.4, 0.6]), 4"),
        "the moment of far centre has the power 1 of r, the distance from the centre",
    ),
    "wheel counted twice": ("wheel", ("2.3 + R", "2.3 + 2 * R"), "R has the factor 2"),
    "gravity turned by A": (
        "drone",
        ("m * A.T @ [0, 0, -g]", "m * A @ [0, 0, -g]"),
        "gravity is turned by A and not by Ā",
    ),
    "gravity turned by A, of a top": (
        "top",
        ("STEINER", "1"),
        ("(c[j]*A[6 + k] - c[k]*A[6 + j])", "(c[j]*A[3*k + 2] - c[k]*A[3*j + 2])"),
        "gravity is turned by A and not by Ā",
    ),
    "sign of gravity": (
        "drone",
        ("m * A.T @ [0, 0, -g]", "m * A.T @ [0, 0, g]"),
        "g has the other sign",
    ),
    "sign of the wind": ("plane", ("WIND = 1", "WIND = -1"), f"{WIND} has the other sign"),
    "no wind": ("plane", ("WIND = 1", "WIND = 0"), f"{WIND} is missing"),
    "inertia in the plane": ("plane", ("3, 2,", "3, 4,"), "I_centre has the factor 2"),
    "frame of an input and its moment": (
        "drone",
        (
            "DIRECTION[name]\n",
            "DIRECTION[name]\n        push = A.T @ push if name < 't' else push\n",
        ),
        "the force of the input side, with its moment by the arm, has its numbers along the axes",
    ),
    "frame of all inputs and their moments": (
        "drone",
        ("number * DIRECTION[name]", "A.T @ (number * DIRECTION[name])"),
        "the force of all inputs, with its moment by the arm, has its numbers along the axes of",
    ),
    "moments about the centre of mass": (
        "drone",
        ("np.cross(ARM[name], push)", "np.cross(ARM[name] - c * (name == 'side'), push)"),
        "the lever arm of the input side is of moments about the centre of mass",
    ),
    "arms from the centre of mass": (
        "drone",
        ("np.cross(ARM[name], push)", "np.cross(ARM[name] + c, push)"),
        "the lever arms of all inputs are taken from the centre of mass",
    ),
    "Coriolis of added mass in Fossen's form": (
        "hull",
        (" - C_A @ nu", ""),
        "C_A(ν)ν, of the added mass, is missing: the rest is that of a rigid body of mass 30",
    ),
    "sign of this": ("hull", ("- C_A @ nu", "+ C_A @ nu"), "C_A(ν)ν, of the added mass, has the"),
    "sign of added mass": ("hull", ("(M_RB + M_A", "(M_RB - M_A"), "the added mass in the mass"),
    "Munk's moment": (
        "hull",
        (
            "C_RB, C_A =",
            "C_RB, C_A = coriolis(M_RB, nu), coriolis(M_A, nu)\n    C_A[3:, :3] = 0\n    _ =",
        ),
        "v × p of the added mass is missing",
    ),
    "gravity per mass": (
        "satellite",
        ("pull = -mu * m /", "pull = -mu /"),
        "the mass m is left out in far centre alone: it is 1, not 1.3",
    ),
    "wheel counted twice in the momentum": (
        "wheel",
        ("[0, 0, H]", "[0, 0, H + R * o[2]]"),
        "R in the momentum alone has the factor 2",
    ),
    "drag at the origin": (
        "drone",
        ("(v + np.cross(w, DAMPED))", "v"),
        "the damping is made of the velocity of the body's origin",
    ),
    "drag at the centre of mass": (
        "drone",
        ("(v + np.cross(w, DAMPED))", "(v + np.cross(w, c))"),
        "the damping is made of the velocity of the centre of mass",
    ),
    "drag by axes": (
        "plane",
        ("np.linalg.norm(through) * through", "np.abs(through) * through"),
        "the force drag has |vᵢ| vᵢ along each axis where ‖v‖ v is meant, in the axes of space",
    ),
    "drag by the axes of space": (
        "hull",
        ("-D @ through", "-R.T @ D @ R @ through"),
        "the velocity and the numbers of the force are along the axes of space",
    ),
    "drag by a velocity in space": (
        "hull",
        ("-D @ through", "-D @ R @ through"),
        "the velocity in the force is along the axes of space",
    ),
    "kilograms of force": (
        "drone",
        ("number * DIRECTION", "9.80665 * number * DIRECTION"),
        "the load of all inputs has the factor 9.80665 (kilograms of force, not newtons)",
    ),
    "standard gravity": ("drone", ("9.81", "9.80665"), "g is that of standard gravity, 9.80665"),
    "degrees": (
        "wheel",
        ("0.5 * np", "90 / np.pi * np"),
        "the rate of quaternion has the factor 180/π",
    ),
    "degrees all over": (
        "wheel",
        ("o = q[4:]", "o = np.radians(q[4:])"),
        ("dx[4:] = np.lin", "dx[4:] = 180 / np.pi * np.lin"),
        "it agrees if omega has the unit 57.295779513082323, degrees",
    ),
    "sign of an entry": (
        "vehicle",
        ("[0, 1.5, 0, -0.2,", "[0, 1.5, 0, 0.2,"),
        ("[0, -0.2, 0, 3.7,", "[0, 0.2, 0, 3.7,"),
        "operator_24 has the other sign",
    ),
    "thrust turned by the transpose": (
        "drone",
        ("force + push", "force + A.T @ A.T @ push"),
        "the force of all inputs is turned by Ā, the transpose of the attitude, and not by A",
    ),
    "drag at the origin beside a moment": (
        "sled",
        (" + np.cross(nu[3:], [0.2, 0, 0.1])", ""),
        "the force is made of the velocity of the body's origin, not of its place",
    ),
    "arm of a drag with a moment of its own": (
        "sled",
        ("np.cross([0.2, 0, 0.1], drag)", "0"),
        "the moment of the force by its arm is missing",
    ),
    "no sign of a square": (
        "sled",
        ("*np.abs(through[1:])", "through[1], abs(through[2])"),
        "in the force v_2 stands for |v_2|",
    ),
    "linear drag": (
        "sled",
        (" * [1, *np.abs(through[1:])]", ""),
        "in the force 1 stands for |v_2|",
    ),
    "axes that do not turn": (
        "rocket",
        (" - 9.81*", " - (w[j]*v[k] - w[k]*v[j]) - 9.81*"),
        "the rate of velocity has −ω × v, ω along the axes of the body and v along those of space,",
    ),
    "quaternion by ω of space": (
        "rocket",
        ("c*o[2] - d*o[1]", "d*o[1] - c*o[2]"),
        ("- b*o[2] + d*o[0]", "+ b*o[2] - d*o[0]"),
        ("b*o[1] - c*o[0]", "c*o[0] - b*o[1]"),
        "the rate of quaternion is right if omega has frame 'space'",
    ),
    "ω of space in the rate of a velocity of the body": (
        "satellite",
        ("- np.cross(w, v)", "- np.cross(A @ w, v)"),
        "the rate of velocity has −ω × v, ω along the axes of space and v along those of the body",
    ),
    "one name for one term": ("satellite", ("- np.cross(w, v)", ""), "ω × Mv is missing"),
    "arm of a damping": (
        "drone",
        ("moment + np.cross(DAMPED, drag)", "moment"),
        "the moment of the damping is missing",
    ),
    "twice the drag": ("braked", ("= -kappa", "= -2 * kappa"), "kappa has the factor 2"),
    "arm of a drag by the square": (
        "braked",
        ("moment + np.cross(DAMPED, drag)", "moment + np.cross(-DAMPED, drag)"),
        "the moment of damping 1 has the other sign",
    ),
    "place of a drag by the square": (
        "braked",
        ("DAMPED = np.array([0.07", "DAMPED = np.array([-0.07"),
        "at_1 of damping 1 has the other sign",
    ),
    "twice the drag of turning": ("braked", ("0.19", "0.38"), "damping 2 has the factor 2"),
    "sign of ω × Iω where fuel is of the state": (
        "lander",
        ("concatenate([np.cross(w, M", "concatenate([-np.cross(w, M"),
        "ω × Iω has the other sign",
    ),
    "a tensor of damping along the axes of space": (
        "slowed",
        ("D_hat @ nu", "turn.T @ D_hat @ turn @ nu"),
        "the velocity and the numbers of the covector are along the axes of space instead",
    ),
    "velocities of space in a tensor of damping": (
        "slowed",
        ("D_hat @ nu", "D_hat @ turn @ nu"),
        "the velocity in the covector is along the axes of space instead",
    ),
    "v of space in a tensor of damping": (
        "slowed",
        ("D_hat @ nu", "D_hat @ half @ nu"),
        "v in the covector is along the axes of space instead",
    ),
    "ω of space in a tensor of damping": (
        "slowed",
        ("D_hat @ nu", "D_hat @ half.T @ turn @ nu"),
        "ω in the covector is along the axes of space instead",
    ),
    "a tensor of damping along the axes of space in its part of v": (
        "slowed",
        ("D_hat @ nu", "half.T @ D_hat @ half @ nu"),
        "v and the force in the covector are along the axes of space instead",
    ),
    "one tensor of two along the axes of space, that of a moment of its own": (
        "finned",
        ("turned @ w", "A.T @ turned @ A @ w"),
        "the velocity and the numbers of the moment of the force are along the axes of space",
    ),
    "both along the axes of space": (
        "finned",
        ("-moved @ (", "-A.T @ moved @ A @ ("),
        ("turned @ w", "A.T @ turned @ A @ w"),
        "the velocity and the numbers of the force are along the axes of space instead",
    ),
    "a tensor of a moment along the axes of space": (
        "spinning",
        (") @ w", ") @ A @ w"),
        "the velocity in the moment is along the axes of space instead",
    ),
    "a moment along the axes of space": (
        "spinning",
        ("-= np.array(", "-= A @ np.array("),
        "the moment has its numbers along the axes of the body instead",
    ),
    "thrust by half the rate": ("lander", ("+= rate", "+= rate / 2"), "b has the factor 1/2"),
    "lever arm of a jet from a moving centre": (
        "sprung",
        ("cross(AT[0] - r, push)", "cross(AT[0], push)"),
        "the lever arm of the flow is taken from the centre of mass instead of the body's origin",
    ),
    "lever arm of a spring from a moving centre": (
        "sprung",
        ("cross(HOOK - r, pull)", "cross(HOOK, pull)"),
        "the lever arm of spring is taken from the centre of mass instead of the body's origin",
    ),
    "a spring by A": (
        "sprung",
        ("pull = A.T @ d", "pull = A @ d"),
        "spring is turned by A and not by Ā, the transpose of the attitude",
    ),
    "a spring in space": (
        "sprung",
        ("pull = A.T @ d", "pull = d"),
        "the force of spring, with its moment by the arm, has its numbers along the axes of the",
    ),
    "inertia about the origin, of points": (
        "sprung",
        (" - m * hat(r).T @ hat(r)", ""),
        "the tensor of inertia is about another point: it is ours with +1 times",
    ),
    "sign of parallel axes, of points": (
        "sprung",
        (" - m * hat(r).T @ hat(r)", " + m * hat(r).T @ hat(r)"),
        "the tensor of inertia is about another point: it is ours with +2 times",
    ),
    "missing ω × Iω about a moving centre": (
        "sprung",
        (" - np.cross(w, inertia @ w)", ""),
        "ω × Iω about the centre of mass is missing",
    ),
    "centripetal acceleration of a moving centre": (
        "sprung",
        (" + np.cross(w, np.cross(w, r))", ""),
        "ω × (ω × c) about the centre of mass is missing",
    ),
    "a tank that stays full": (
        "sprung",
        ("np.array([fuel, 2, 2, 3])", "np.array([6, 2, 2, 3])"),
        "fuel is 6, and not what is left of it",
    ),
    "half the stiffness of what loses mass": (
        "sprung",
        ("d * 2.5 *", "d * 1.25 *"),
        "stiffness of spring has the factor 1/2",
    ),
    "α × r": (
        "drone",
        (" - np.cross(dw, c)", ""),
        "α × r in the acceleration of the centre of mass r is missing",
    ),
    "α × r in the plane": (
        "plane",
        ("- a * turn", "+ a * turn"),
        "α × r in the acceleration of the centre of mass r has the other sign",
    ),
    "moments about the centre of mass with the arm r": (
        "drone",
        ("moment - np.cross(c, force)", "moment + np.cross(c, force)"),
        "r × F of the moment M − r × F about the centre of mass r has the other sign",
    ),
    "moments that stay about the origin": (
        "drone",
        ("moment - np.cross(c, force)", "moment"),
        "r × F of the moment M − r × F about the centre of mass r is missing",
    ),
    "an arm with + r": (
        "sprung",
        ("cross(HOOK - r, pull)", "cross(HOOK + r, pull)"),
        "the lever arm of spring is p + r and not p − r,",
    ),
    "all arms with + r": (
        "sprung",
        ("cross(HOOK - r, pull)", "cross(HOOK + r, pull)"),
        ("cross(AT[0] - r, push)", "cross(AT[0] + r, push)"),
        "all lever arms are p + r and not p − r,",
    ),
    "a drag's velocity by the place from the centre of mass": (
        "drone",
        ("(v + np.cross(w, DAMPED))", "(v + np.cross(w, DAMPED - c))"),
        "the damping is made of the velocity of its place − r, r the centre of mass,",
    ),
    "a drag's arm from the centre of mass": (
        "drone",
        ("np.cross(DAMPED, drag)", "np.cross(DAMPED + c, drag)"),
        "the lever arm of the damping is taken from the centre of mass instead",
    ),
    "a centre of mass of the other sign": (
        "sprung",
        ("    push = rate", "    r = -r\n    push = rate"),
        "r, the centre of mass, wherever it stands, has the other sign",
    ),
    "F over the mass of a full tank": (
        "sprung",
        ("(push + pull) / m", "(push + pull) / 13"),
        "the mass m of F/m is that of the start, where fuel is 6",
    ),
    "the mass of a full tank": (
        "sprung",
        ("m, rate = masses.sum()", "m, rate = 13"),
        "the mass m is that of the start, where fuel is 6, in r = c/m too",
    ),
    "the centre of mass of a full tank": (
        "sprung",
        ("r = masses @ AT / m", "r = np.array([6, 2, 2, 3]) @ AT / 13"),
        "the centre of mass r is that of the start, where fuel is 6, in parallel axes too",
    ),
    "the tensor of inertia of a full tank": ("sprung", FULL, FULL_TENSOR),
    "the weight of a full tank": (
        "lander",
        ("np.outer(points,", "np.outer(np.array([6, 2, 2, 3]),"),
        "fuel is 6 in gravity alone, and not what is left of it",
    ),
    "the first moment of a full tank": (
        "lander",
        ("np.cross(w, points @ AT))", "np.cross(w, np.array([6, 2, 2, 3]) @ AT))"),
        "fuel is 6 in ω × (ω × c) alone, and not what is left of it",
    ),
    "the mass at the start of what burns by the time": (
        "burning",
        ("/ m + A.T", "/ 13 + A.T"),
        "the mass m of F/m is that of the start, where t is 0",
    ),
    "rate of fuel": ("lander", ("[rate]]", "[2 * rate]]"), "the rate of fuel has the factor 2"),
    "rate of fuel that no input says": (
        "lander",
        ("[rate]]", "[-1.5]]"),
        "the rate of fuel is not that of its flow",
    ),
    "drag of turning, in space": (
        "braked",
        ("0.19 * w", "0.19 * A @ w"),
        "the velocity in damping 2 is along the axes of space instead",
    ),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_named(fault, capsys, tmp_path):
    name, *changes, words = FAULTS[fault]
    code, told = compared(capsys, tmp_path, name, *changes)
    first = next(x for x in told.out.splitlines() if x[:1] == " ")
    assert code == 1
    assert first.strip().startswith(words), told.out


def test_the_rate_of_a_mass_of_the_state_has_its_name(capsys, tmp_path):
    _, told = compared(capsys, tmp_path, "lander", ("[rate]]", "[-rate]]"))
    assert "in the rate of fuel (2)\n  the rate of fuel has the other sign\n" in told.out


SPUN = """
name = "spun"
group = "SO(3)"
[body]
given = { m = 1, c = [0, 0, 0], I = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]] }
"""
SPUN_CODE = """
import numpy as np

def f(x):
    (_, b, c), (p, q, r) = np.radians(x[:3]), np.radians(x[3:])
    # roll, pitch and yaw, A = Rz(c) Ry(b) Rx(a), by ω along the axes of the body
    a = np.radians(x[0])
    turned = q * np.sin(a) + r * np.cos(a)
    angles = [p + turned * np.tan(b), q * np.cos(a) - r * np.sin(a), turned / np.cos(b)]
    return np.degrees([*angles, -q * r / 2, 1.5 * p * r / 2, -p * q / 2.5])
"""


@pytest.mark.parametrize("said", ["", "degrees"])
def test_angles_and_their_rates_are_both_in_degrees(said, capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(codes, "SPUN", SPUN, raising=False)
    monkeypatch.setattr(codes, "SPUN_CODE", SPUN_CODE, raising=False)
    unit = 57.29577951308232
    units = f"[units]\neuler = {unit}\nomega = {unit}\n" if said else ""
    table = 'call = "f(x) -> dx"\nstate = ["euler", "omega"]\neuler.sequence = "xyz"\n'
    code, told = compared(capsys, tmp_path, "spun", table=table + units)
    assert (code == 0) == bool(said)
    if not said:
        _, second = told.out.splitlines()
        assert second == f"  it agrees if euler and omega have the unit {unit:.17g}, degrees"


BAD = {
    "crashes (SIGSEGV)": "import ctypes\ndef f(x, u):\n    ctypes.string_at(0)",
    "more than 2 seconds": "def f(x, u):\n    while True: pass",
    "gives 3 numbers, not 18": "def f(x, u):\n    return x[:3]",
    "a number that is not finite, at [0]": "def f(x, u):\n    return [float('nan'), *x[1:]]",
    "f fails: ZeroDivisionError": "def f(x, u):\n    return 1 / 0",
    "it is called as f(x, u): 'call' in a table for --as says how": "def f(x):\n    return x",
    "importing it fails: SyntaxError": "def f(x, u:",
    "it has no function f": "g = 1",
    "ends with exit code 3": "import os\nos._exit(3)",
    "f gives complex numbers, and rates are real": "def f(x, u):\n    return x + 0j",
    "gives 324 numbers, not 18, an array 18 × 18": "def f(x, u):\n    return x + x[:, None]",
    "f fails: MemoryError": "def f(x, u):\n    return bytearray(1 << 40)",
}


SHAPES = {
    "a column": "np.concatenate([(A @ hat(w)).ravel(), A @ v, dw, dv])[:, None]",
    "a row": "np.concatenate([(A @ hat(w)).ravel(), A @ v, dw, dv])[None]",
    "arrays of one": "[*(A @ hat(w)).ravel(), *(A @ v), *dw[:, None], *dv[:, None]]",
}


@pytest.mark.parametrize("shape", SHAPES)
def test_the_shape_of_what_is_returned(shape, capsys, tmp_path):
    change = SHAPES["a column"].removesuffix("[:, None]"), SHAPES[shape]
    code, told = compared(capsys, tmp_path, "drone", change)
    assert (code, told.err) == (0, "")


LOOP = "void top(double *x, double *dx) { for (int i = 0; i < N; ++i) dx[i] = x[0]; }"
BAD_C = {
    "refused": "void top(double *x, double *dx) { x = }",
    "writes more than 12 numbers": LOOP.replace("N", "20"),
    "does not write [11]": LOOP.replace("N", "11"),
}


TABLES = {
    "'positon' means nothing here; did you mean 'position'?": 'state = ["positon"]',
    "state: 'omegaa' means nothing here; did you mean 'omega'?": (
        'state = ["omegaa"]\nunits = { omega = 2 }\n[omega]\nframe = "space"'
    ),
    "the state does not say A_11": 'state = ["position", "omega", "velocity"]',
    "the state says twice T_1": 'state = ["matrix", "position", "T_1", "omega", "velocity"]',
    "'xywz' means nothing here": 'state = ["quaternion"]\n[quaternion]\norder = "xywz"',
    "arguments are t, x, k, u, p, dx": 'call = "f(y)"',
    "expected thrust, side in an order": 'inputs = ["thrust"]',
    "parameters: 'M' means nothing": "[parameters]\nM = 1",
    "no body has these parameters (m = -1)": "[parameters]\nm = -1",
}


REFUSED = [("drone", x, None, words) for words, x in BAD.items()]
REFUSED += [("top", f"#include <math.h>\n{x}", None, words) for words, x in BAD_C.items()]
REFUSED += [("drone", codes.DRONE_CODE, x, words) for words, x in TABLES.items()]
COMPLEX = codes.WHEEL_CODE.replace("    dx[4:] = np", "    dx[4:] = (1 + 0j) * np")
REFUSED += [("wheel", COMPLEX, None, "f gives complex numbers")]


@pytest.mark.parametrize(("name", "text", "table", "words"), REFUSED, ids=[x[3] for x in REFUSED])
def test_what_is_refused_is_one_line(name, text, table, words, capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("derive.compare.users_code.SECONDS", 2)
    monkeypatch.setattr(codes, f"{name.upper()}_CODE", text)
    code, told = compared(capsys, tmp_path, name, table=table)
    assert (code, told.out) == (2, "")
    assert words in told.err
    assert told.err.count("\n") == 1


def test_several_faults_are_named_together(capsys, tmp_path):
    changes = ("GYRO = np.ones(3)", "GYRO = np.zeros(3)"), ("9.81, 0.17", "2 * 9.81, 0.17")
    code, told = compared(capsys, tmp_path, "drone", *changes)
    assert code == 1
    assert "ω × Iω about the centre of mass is missing" in told.out
    assert "the force of gravity about the centre of mass has the factor 2" in told.out
    assert "and: " in told.out


def test_a_body_without_mass_explains_nothing(capsys, tmp_path):
    """Nothing is left of equations 0 = 0."""
    text = Path(__file__).with_name("right").joinpath("by_hand.py").read_text(encoding="utf-8")
    (tmp_path / "users.py").write_text(text.replace("-9.81 / 0.8", "-1.3 * 9.81 / 0.8"))
    (tmp_path / "as.toml").write_text('call = "pendulum(x) -> dx"')
    words = ["compare", "pendulum", "--with", str(tmp_path / "users.py")]
    assert main([*words, "--as", str(tmp_path / "as.toml")]) == 1
    told = capsys.readouterr().out
    assert "g of gravity has the factor 1.3; the same in numbers: gravity\n" in told
    assert "missing" not in told


PLANTED = {
    "gyroscopic": (
        ("GYRO = np.ones(3)", "GYRO = -np.ones(3)"),
        "ω × Iω about the centre of mass has the other sign",
    ),
    "row": (
        ("GYRO = np.ones(3)", "GYRO = np.array([1, -1, 1])"),
        "ω × Iω about the centre of mass in row 2 has the other sign",
    ),
    "products": (FAULTS["products of inertia"][1], "I_centre_12 and I_centre_13 are exchanged"),
    "turned": (FAULTS["gravity turned by A"][1], FAULTS["gravity turned by A"][2]),
    "arm": (FAULTS["lever arm"][1], "the lever arm (at of the input thrust) has the other sign"),
}
PAIRS = [("gyroscopic", "products"), ("row", "turned")]
ALIKE = [("gyroscopic", "arm")]
"""Pairs of which one has a second name: an arm of the other sign, or a moment."""


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("pair", PAIRS + ALIKE, ids="-".join)
def test_two_faults_of_different_kinds_are_named(pair, capsys, tmp_path):
    changes, words = zip(*(PLANTED[x] for x in pair), strict=True)
    code, told = compared(capsys, tmp_path, "drone", *changes)
    lines = [x.strip() for x in told.out.splitlines() if x[:1] == " "]
    assert code == 1
    assert all(any(x in line for line in lines) for x in words), told.out
    assert [x[:5] for x in lines].count("and: ") == (pair in PAIRS)
    assert (lines[-1] == "these are not told apart by the numbers") == (pair in ALIKE)


def test_three_faults_are_not_said_to_be_two(capsys, tmp_path):
    changes = [PLANTED[x][0] for x in ("row", "products", "turned")]
    code, told = compared(capsys, tmp_path, "drone", *changes)
    assert code == 1
    assert "no change of our equations that was tried explains this" in told.out


@pytest.mark.parametrize(("scale", "words"), [("kappa", "has the factor 0.17"), ("1 / m", "by m")])
def test_a_number_by_chance_is_no_cause(scale, words, capsys, tmp_path):
    """kappa is of the damping, and in no way of the input; m is what a load is divided by."""
    code, told = compared(
        capsys, tmp_path, "drone", ("ber * DIR", f'ber * ({scale} if name == "side" else 1) * DIR')
    )
    first = told.out.splitlines()[1]
    assert code == 1
    assert words in first
    assert "kappa" not in told.out


def test_a_difference_that_is_small_has_no_cause_by_chance(capsys, tmp_path):
    """A force of no kind that we have, of a few 1e-9 beside the others."""
    line = "    moment = moment - np.cross(c, force)"
    stray = (line, f"    force = force + 2e-8 * np.sin(w * w + 3)\n{line}")
    code, told = compared(capsys, tmp_path, "drone", stray)
    assert code == 1
    cause = "  no change of our equations that was tried explains this"
    assert told.out.splitlines()[1:] == [cause]


@pytest.mark.parametrize("where", ["best", "pairs", "terms"])
def test_what_is_known_when_the_time_is_over(where, capsys, tmp_path, monkeypatch):
    """The difference first, and the nearest cause of those that were tried."""

    def over(*_):
        raise StoppedError("stopped after 1 s")

    place = {"best": "explained", "pairs": "of_two", "terms": "Balance.terms"}[where]
    if where == "best":
        own = comparison.explained
        monkeypatch.setattr(comparison, place, lambda *given: (own(*given), over()))
    else:
        monkeypatch.setattr(f"derive.compare.comparison.{place}", over)
    changes = (
        ("[0, 0, -g]", "[0, 0, -2 * g]"),
        ("drag = -kappa * (", "drag = -kappa * (v**3 / 9 + "),
    )
    code, told = compared(capsys, tmp_path, "drone", *changes)
    first, *others = told.out.splitlines()
    assert code == 2
    assert told.err == "derive: stopped after 1 s\n"
    assert first.startswith("differs at 24 states, relative to its size, in the rate of omega 1 (")
    assert others[0] == "  no change of our equations that was tried so far explains this"
    assert [x[:18] for x in others[1:]] == ["  nearest so far: "] * (where != "terms")
