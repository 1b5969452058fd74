"""Problems that are reduced by symmetries which commute, and their reductions."""

from functools import cache

from derive.command.showing import ready_made
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.searches import reduction
from tests.support.walks import problem, record

AXIS = {"name": "Turn", "action": "linear", "basis": [[[0, -1], [1, 0]]]}
OWN = {
    # a symmetric solid that nothing acts on
    "free": {
        "group": "SO(3)",
        "parameters": {"I1": {}, "I3": {}},
        "lagrangian": {"L": "(I1*(zeta_1^2 + zeta_2^2) + I3*zeta_3^2)/2"},
    },
    # the velocity in space, an inertia that depends on the attitude
    "spatial": {
        "group": "SO(3)",
        "lagrangian": {
            "L": "zeta_1^2 + zeta_2^2 + (2 + A_33^2)*zeta_3^2 + A_33*zeta_3 - A_33",
            "trivialisation": "right",
        },
    },
    # charges in a field along the vertical, their mean motion as the momentum of a turn about it
    "turned": {
        "group": "SO(3)",
        "parameters": {"b": {}},
        "lagrangian": {
            "L": "zeta_1^2 + zeta_2^2 + 2*zeta_3^2 - A_33"
            " + b*(A_31*zeta_1 + A_32*zeta_2 + A_33*zeta_3)",
        },
    },
    # a wheel: no freedom is left
    "wheel": {"group": AXIS, "parameters": {"I": {}}, "lagrangian": {"L": "I*zeta_1^2/2"}},
    # a potential that is no polynomial, in a field that changes in time
    "tipped": {
        "group": "SO(3)",
        "parameters": {"k": {}},
        "lagrangian": {"L": "zeta_1^2 + zeta_2^2 + 2*zeta_3^2 - k*sqrt(2 + A_33)*cos(t)"},
    },
    # an integral of each kind
    "flat": {
        "group": "SO(3)",
        "lagrangian": {"L": "zeta_1^2 + zeta_2^2 + 2*zeta_3^2"},
    },
    "steep": {
        "group": "SO(3)",
        "lagrangian": {"L": "zeta_1^2 + zeta_2^2 + 2*zeta_3^2 - A_33^4"},
    },
    # the square of an entry that grows is a factor under the root
    "grown": {
        "group": {
            "name": "Grow",
            "action": "linear",
            "basis": [[[1, 0], [0, 0]], [[0, 0], [0, 1]]],
        },
        "lagrangian": {"L": "zeta_1^2 + zeta_2^2 - A_11"},
    },
}
FILES = (*OWN, "lagrange_top", "top", "spherical_pendulum", "charged_body", "gyrostat", "rod")
LONG = ("coupled", "kirchhoff", "heisenberg", "so3", "se3", "two_tops", "comet", "su2", "hammer")
assert {*FILES, *LONG} <= {*OWN, *ready_made()}


@cache
def reduced(name):
    """The reduction of one of these problems, or of a ready-made one."""
    if name not in OWN:
        return reduction(problem(name), record(name))
    own = problem_of({"name": name, **OWN[name]})
    return reduction(own, walk(own))
