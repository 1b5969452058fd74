"""The kinds of solids and their sizes."""

from __future__ import annotations

SOLIDS: dict[str, dict[str, tuple[int, ...] | None]] = {
    "ball": {"radius": ()},
    "box": {"sides": (3,)},  # full lengths; centred
    "ellipsoid": {"semi_axes": (3,)},
    "cylinder": {"radius": (), "height": ()},  # about z; centred
    "cone": {"radius": (), "height": ()},  # about z; base in the plane z = 0, apex at z = height
    "hollow_ball": {"outer": (), "inner": ()},
    "tetrahedron": {"vertices": (4, 3)},
    "mesh": {"file": None},
}
"""``()`` is one tree, ``(3,)`` a tuple of three, ``(4, 3)`` four of three, ``None`` a file name,
of which the record has ``vertices`` and ``faces``."""
