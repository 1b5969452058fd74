"""The state of a fluid on the torus: Re and Im of ω̂(n) for one of n and −n, in order."""

from __future__ import annotations

from ...algebra.structure import Place, TorusLattice


def names(torus: TorusLattice) -> tuple[str, ...]:
    """Those of the numbers of the state: re_1_0, im_1_0, …; m for a minus sign."""
    found = ("_".join(str(x).replace("-", "m") for x in n) for n in torus.half_plane)
    return tuple(f"{part}_{x}" for x in found for part in ("re", "im"))


def position(torus: TorusLattice, n: Place) -> tuple[int, bool]:
    """Where Re ω̂(n) stands in the state, Im being next to it; and is ω̂(n) the conjugate?"""
    first, second = torus.representative(n)
    turned = second < 0 or (second == 0 and first < 0)
    a, b = (-first, -second) if turned else (first, second)
    place = a - 1 if b == 0 else torus.half + (b - 1) * torus.N + a + torus.half
    return 2 * place, turned


def turned(name: str) -> str:
    """The name in the state of what a name like re_m1_0 would be the conjugate of."""
    part, *n = name.split("_")
    opposite = (x[1:] if x.startswith("m") else f"m{x}" * (x != "0") or x for x in n)
    return "_".join((part, *opposite))


def described(torus: TorusLattice) -> tuple[str, ...]:
    """The state in words, for the head of a file."""
    h = torus.half
    return (
        f"The state has {torus.N**2 - 1} numbers: number 2j and the next, from 0, are Re and Im of",
        "the coefficient omega(n) of T_n; omega(-n) is its conjugate, omega(0) = 0:",
        f"j = n1 - 1 for n2 = 0, n1 = 1 ... {h};",
        f"j = {h} + {torus.N} (n2 - 1) + n1 + {h} for n2 = 1 ... {h}, n1 = -{h} ... {h}.",
    )
