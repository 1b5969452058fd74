"""A body thrown: a free top about its centre, which gravity, a force that changes with the time and
an input move; all of it in closed form."""

import numpy as np

from tests.oracles import free_top

MOMENTS, ENERGY, MOMENTUM = (1.25, 2.0, 2.75), 1.0, 2.2
MASSES = (7 / 8, 1 / 2, 1 / 8)
MASS = 2 * sum(MASSES)
PULL, PUSH = 2.5, (0.4, -0.3, 1.2)
GRAVITY = 9.81
PARAMETERS = (*MASSES, PULL, GRAVITY)
"""In the order of the emitted code."""
PLACES = ("[{}, 0, 0]", "[0, {}, 0]", "[0, 0, {}]")
POINTS = "".join(
    f'[[point]]\nmass = "m_{i}"\nat = {place.format(sign)}\n'
    for i, place in enumerate(PLACES, 1)
    for sign in (1, -1)
)
TEXT = f"""
name = "thrown"
group = "SE(3)"
[parameters]
m_1 = {MASSES[0]}
m_2 = {MASSES[1]}
m_3 = {MASSES[2]}
f = {PULL}
g = {GRAVITY}
{POINTS}[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
[[potential]]
kind = "expression"
U = "-f*sin(3*t)*(r1_x + r2_x)/2"
[[input]]
name = "F"
kind = "force"
at = [0, 0, 0]
"""
HEIGHT, SPEED = 3.0, np.array([0.5, -0.3, 0.0])


def state(t, phase=0.0, start=0.0):
    """The state at a time that begins at ``start`` in a phase of the top, A, T, ζ, w."""
    A, W = free_top.motion(phase + t - start, MOMENTS, ENERGY, MOMENTUM)
    pushed, past = np.array(PUSH) / MASS - [0, 0, GRAVITY], t - start
    turned = PULL / MASS / 3
    T = [0, 0, HEIGHT] + SPEED * past + pushed * past**2 / 2
    T[0] += turned * (np.cos(3 * start) * past - (np.sin(3 * t) - np.sin(3 * start)) / 3)
    v = SPEED + pushed * past
    v[0] += turned * (np.cos(3 * start) - np.cos(3 * t))
    return np.concatenate([A.ravel(), T, W, A.T @ v])


EVENTS = """
[[event]]
name = "ground"
when = "T_3"
terminal = true
[[event]]
name = "half"
when = "T_3 - 3/2"
direction = "falling"
[[event]]
name = "also"
when = "3/2 - T_3"
direction = "rising"
[[event]]
name = "up"
when = "T_3 - 3/2"
direction = "rising"
[[event]]
name = "pulled"
when = "sin(3*t) - F_1"
[[event]]
name = "turned"
when = "A_12 - 1/5"
[[event]]
name = "never"
when = "(T_3 - 3/4)^2"
"""
