"""``derive compare``: products of groups by both names of a velocity, and angles for A."""

import pytest

from derive.command.cli import main

CART = """
name = "cart"
group = "R(1) x SO(2)"
[parameters]
M = 2.5
m = 0.6
l = 0.9
g = 9.81
c = 0.3
[lagrangian]
L = "(M + m)*zeta_1^2/2 + m*l*A2_11*zeta_1*zeta_2 + m*l^2*zeta_2^2/2 + m*g*l*A2_11"
[[force]]
name = "hinge"
covector = ["0", "-c*zeta_2"]
"""
POLE = """
import numpy as np
M, m, l, g, c = 2.5, 0.6, 0.9, 9.81, 0.3

def by_angle(x):
    place, angle, v, w = x
    mass = np.array([[M + m, m*l*np.cos(angle)], [m*l*np.cos(angle), m*l*l]])
    b = [m*l*np.sin(angle)*w*w, -m*g*l*np.sin(angle) - c*w]
    return np.array([v, w, *np.linalg.solve(mass, b)])

def in_degrees(x):
    return np.degrees(by_angle(np.radians(x)))

def turning_in_degrees(x):
    unit = np.degrees([np.pi/180, 1, np.pi/180, 1])
    return unit * by_angle(x / unit)

def by_matrix(x):
    place, C, a, S, b, v, w = x
    rates = by_angle([place, np.arctan2(S, C), v, w])
    return np.array([v, -S*w, -C*w, C*w, -S*w, *rates[2:]])
"""
MATRIX = '["T1_1", "A2_11", "A2_12", "A2_21", "A2_22", "zeta1_1", "zeta2_1"]'


def compared(capsys, folder, problem, code, table):
    """The exit code and what is printed."""
    for name, text in (("problem.toml", problem), ("users.py", code), ("as.toml", table)):
        (folder / name).write_text(text, encoding="utf-8")
    words = ["compare", str(folder / "problem.toml"), "--with", str(folder / "users.py")]
    return main([*words, "--as", str(folder / "as.toml")]), capsys.readouterr()


STATES = {
    "by_matrix": MATRIX,
    "by_angle": '["T1_1", "theta_2", "zeta1_1", "zeta2_1"]',
    "by_angle with names of the state": '["T1_1", "theta_2", "zeta_1", "zeta_2"]',
}


@pytest.mark.parametrize("said", STATES)
def test_a_product_by_blocks_and_by_angles(said, capsys, tmp_path):
    table = f'call = "{said.split()[0]}(x) -> dx"\nstate = {STATES[said]}'
    code, told = compared(capsys, tmp_path, CART, POLE, table)
    assert (code, told.err) == (0, "")
    wrong = POLE.replace("- c*w]", "+ c*w]")
    code, told = compared(capsys, tmp_path, CART, wrong, table)
    assert code == 1
    name = "zeta2_1" if "zeta2_1" in STATES[said] else "zeta_2"
    assert f", {name} (" in told.out.splitlines()[0]
    assert "c has the other sign" in told.out
    assert not (tmp_path / "__pycache__").exists()


def test_an_angle_and_its_rate_are_in_degrees(capsys, tmp_path):
    table = f'call = "turning_in_degrees(x) -> dx"\nstate = {STATES["by_angle"]}\n'
    code, told = compared(capsys, tmp_path, CART, POLE, table)
    unit = "57.295779513082323"
    assert code == 1
    assert f"it agrees if theta_2 and zeta2_1 have the unit {unit}, degrees" in told.out
    units = f"[units]\ntheta_2 = {unit}\nzeta2_1 = {unit}\n"
    assert compared(capsys, tmp_path, CART, POLE, table + units)[0] == 0


CAR = """
name = "car"
group = "SE(2)"
[parameters]
m = 2.0
g = 9.81
[body]
given = { m = "m", centre = [0.1, 0], J = [[0.3, 0], [0, 0.4]] }
[[potential]]
kind = "gravity"
g = [0, "-g"]
"""
SLID = """
import numpy as np
m, r, g, I = 2.0, 0.1, 9.81, 0.7

def f(x):
    X, Y, angle, u, v, w = x
    c, s = np.cos(angle), np.sin(angle)
    # about the body's origin, along its axes; the centre of mass at (r, 0)
    mass = np.array([[m, 0, 0], [0, m, m*r], [0, m*r, I]])
    force = [m*w*v + m*r*w*w - m*g*s, -m*w*u - m*g*c, -m*r*w*u - m*r*g*c]
    return np.array([c*u - s*v, s*u + c*v, w, *np.linalg.solve(mass, force)])
"""


def test_a_body_of_the_plane_by_its_angle(capsys, tmp_path):
    table = 'call = "f(x) -> dx"\nstate = ["T_1", "T_2", "theta_1", "w_1", "w_2", "zeta_1"]'
    code, told = compared(capsys, tmp_path, CAR, SLID, table)
    assert (code, told.err) == (0, ""), told.out


@pytest.mark.parametrize(
    ("state", "words"),
    [
        ('["theta"]', "'theta' means nothing here; did you mean 'theta_2'? known: theta_2, "),
        ('["position"]', "blocks are of SO(3) and SE(3); give names: theta_2, T1_1, "),
        ('["T1_1", "theta_2", "A2_11", "zeta_1", "zeta_2"]', "the state says twice A2_11"),
        ('["T1_1", "theta_2", "zeta_1", "zeta1_1"]', "the state says twice zeta_1"),
        ('["T1_1", "theta_2", "zeta_1"]', "the state does not say zeta_2"),
    ],
)
def test_what_the_state_does_not_say(state, words, capsys, tmp_path):
    code, told = compared(
        capsys, tmp_path, CART, POLE, f'call = "by_angle(x) -> dx"\nstate = {state}'
    )
    assert (code, told.out) == (2, "")
    assert words in told.err
