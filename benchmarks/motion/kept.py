"""What a million steps leave of the group, the energy and the momenta."""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np

from ..peers.native import pointer
from ..peers.report import table
from .cases import MOTIONS, QUATERNION, TANGENT, Form, Motion
from .native import BUILDS, built

STEPS, ANGLE = 1e6, 0.9
"""How many, and the turn of one at the fastest rate."""
CONSERVED = ("--conserved",)
FORMS = {
    "heavy_top": {"matrix": CONSERVED, "quaternion": QUATERNION + CONSERVED},
    "p2": {"matrix": (), "quaternion": QUATERNION},
    "p3": {"body": CONSERVED, "tangent": TANGENT + CONSERVED},
}
"""In the frame of the parameters, where the integrals are emitted."""


def kept_table(folder: Path) -> str:
    """A row for each form of each motion."""
    folder.mkdir(exist_ok=True)
    rows = []
    for motion in MOTIONS:
        for label, options in FORMS.get(motion.name, {}).items():
            own = Motion(motion.name, 0.0, motion.rate, {label: options}, motion.start)
            form = Form(own, label, folder)
            form.emit()
            flags = (*BUILDS["native"], *(["-DCONSERVED"] if options[-1:] == CONSERVED else []))
            library = built(form, "kept.c", *flags, str(form.folder / f"{form.name}.c"))
            found, step = np.zeros(3), ctypes.c_double(ANGLE / own.rate)
            numbers = (pointer(form.x), pointer(form.k), step, ctypes.c_double(STEPS))
            code = library.kept(*numbers, pointer(found))
            momenta = f"{found[2]:.1e}" if found[2] else ""
            cells = [f"{found[0]:.1e}", f"{found[1]:.1e}", momenta, f"stopped: {code}" * bool(code)]
            rows.append([motion.name, label, *cells])
    rows.append(["aim", "", "≤ 1e-15", "≤ 3e-11", "≤ 1e-10", ""])
    head = ["motion", "form", "off the group", "energy", "momenta", ""]
    return table(f"{STEPS:.0e} steps of gauss, each {ANGLE} rad of the fastest rate", head, rows)
