"""Right-hand sides by MuJoCo: rotors are its motors, springs its tendons."""

import mujoco
import numpy as np


def model(text):
    made = mujoco.MjModel.from_xml_string(f"<mujoco>{text}</mujoco>")
    return made, mujoco.MjData(made)


def accelerations(both, q, v, u=(), more=None):
    """Of the joints, by what is applied to them ``more``."""
    data = both[1]
    data.qpos[:], data.qvel[:], data.ctrl[:] = q, v, u
    data.qfrc_applied[:] = 0
    if more:
        more(*both)
    mujoco.mj_forward(*both)
    return data.qacc.copy()


def spun(q, w):
    """The rate of a quaternion (w, x, y, z) that turns by w in the body."""
    found = np.zeros(4)
    mujoco.mju_mulQuat(found, q, np.array([0, *w]))
    return found / 2


DRONE = model("""
<option gravity="0 0 -9.81"/>
<worldbody><body><freejoint/>
  <inertial pos="0.02 -0.05 0.11" mass="1.3" fullinertia="0.31 0.42 0.55 0.012 -0.023 0.017"/>
  <site name="thrust" pos="0.23 0.04 -0.3"/><site name="side" pos="0.1 -0.2 0.15"/>
</body></worldbody>
<actuator>
  <motor site="thrust" gear="0 0 1 0 0 0"/><motor site="side" gear="0 1 0 0 0 0"/>
</actuator>""")


def dragged(made, data):
    """Of what is at a place of the body."""
    mujoco.mj_fwdPosition(made, data)
    R = data.xmat[1].reshape(3, 3)
    at = R @ [0.07, 0.03, -0.13]
    drag = -0.17 * (data.qvel[:3] + np.cross(R @ data.qvel[3:], at))
    point = data.xpos[1] + at
    mujoco.mj_applyFT(made, data, drag, np.zeros(3), point, 1, data.qfrc_applied)


def drone(x, u):
    """x: place, quaternion (w, x, y, z), velocity in space, angular velocity in the body."""
    a = accelerations(DRONE, x[:7], x[7:], u, dragged)
    return np.concatenate([x[7:10], spun(x[3:7], x[10:]), a])


def drone_mass(x):
    made, data = DRONE
    data.qpos[:], data.qvel[:] = x[:7], x[7:]
    mujoco.mj_fwdPosition(made, data)
    M = np.zeros((6, 6))
    mujoco.mj_fullM(made, data, M)
    return M


def drone_bias(x, u):
    data = DRONE[1]
    accelerations(DRONE, x[:7], x[7:], u, dragged)
    return data.qfrc_bias - data.qfrc_applied - data.qfrc_actuator


TOP = model("""
<option gravity="0 0 -9.81"/>
<worldbody><body><joint type="ball"/>
  <inertial pos="0.1 0.05 0.4" mass="1.3" fullinertia="0.3 0.4 0.5 0.01 0 0"/>
</body></worldbody>""")


def top(x):
    return np.concatenate([spun(x[:4], x[4:]), accelerations(TOP, x[:4], x[4:])])


def solid(*points):
    """What says the inertia of points: (mass, place), …; none may be 0."""
    m = sum(x for x, _ in points)
    c = sum(x * np.array(r) for x, r in points) / m
    tensor = 1e-13 * np.eye(3)
    for x, r in points:
        s = np.array(r) - c
        tensor += x * (s @ s * np.eye(3) - np.outer(s, s))
    told = [tensor[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    listed = [" ".join(map(repr, map(float, x))) for x in (c, told)]
    return f'<inertial pos="{listed[0]}" mass="{m}" fullinertia="{listed[1]}"/>'


BAR = model(f"""
<option gravity="0 -9.81 0"/>
<worldbody><site name="left" pos="-0.5 0 0"/><site name="right" pos="0.5 0 0"/>
<body><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
  <joint type="hinge" axis="0 0 1"/>
  {solid((1, [-0.5, 0, 0]), (1, [0.5, 0, 0]))}
  <site name="a" pos="-0.5 0 0"/><site name="b" pos="0.5 0 0"/>
</body></worldbody>
<tendon>
  <spatial stiffness="40" springlength="0.4"><site site="left"/><site site="a"/></spatial>
  <spatial stiffness="40" springlength="0.4"><site site="right"/><site site="b"/></spatial>
</tendon>""")


def bar(x):
    """x: A by rows, the place, the turning, the velocity in the body."""
    A, T, turn, v = x[:4].reshape(2, 2), x[4:6], x[6], x[7:]
    J = np.array([[0, -1], [1, 0]])
    angle = np.arctan2(A[1, 0], A[0, 0])
    a = accelerations(BAR, [*T, angle], [*(A @ v), turn])
    dv = A.T @ a[:2] - turn * J @ v
    return np.concatenate([(turn * A @ J).ravel(), A @ v, a[2:], dv])


PENDULUM = model(f"""
<option gravity="0 -9.81 0"/>
<worldbody><body><joint type="hinge" axis="0 0 1"/>{solid((1, [0, -0.8, 0]))}</body>
</worldbody>""")


def pendulum(x):
    a = accelerations(PENDULUM, [np.arctan2(x[2], x[0])], x[4:])
    return np.concatenate([x[4] * np.array([x[1], -x[0], x[3], -x[2]]), a])


TOPS = model(f"""
<option gravity="0 0 0"/>
<worldbody>
  <body><joint type="ball"/>
    {solid((1, [1, 0, 0]), (1, [0, 1, 0]))}<site name="a" pos="1 0 0"/>
  </body>
  <body><joint type="ball"/>
    {solid((1, [1, 0, 0.5]), (2, [0, 1, 0]))}<site name="b" pos="1 0 0.5"/>
  </body>
</worldbody>
<tendon>
  <spatial stiffness="2" springlength="0.5"><site site="a"/><site site="b"/></spatial>
</tendon>""")


def two_tops(x):
    """x: both matrices by rows, and both rates."""
    q, moved = [], []
    for R, w in ((x[:9], x[18:21]), (x[9:18], x[21:])):
        found = np.zeros(4)
        mujoco.mju_mat2Quat(found, R)
        q.append(found)
        moved.append(np.stack([np.cross(row, w) for row in R.reshape(3, 3)]).ravel())
    return np.concatenate([*moved, accelerations(TOPS, np.concatenate(q), x[18:])])
