"""The kinds of pictures in a line each, for the help of the command line: nothing is drawn here."""

KINDS = {
    "state": "the state against time",
    "outputs": "what is read off the motion, against time",
    "energy": "relative errors of the energy and of what is conserved",
    "axes": "tips of the body's axes on the sphere",
    "polhode": "the velocity on the ellipsoid of inertia",
    "body": "the body at several instants",
    "potential": "the effective potential, with the run in it",
    "spheroid": "semi-axes, pressure and sections of a fluid ellipsoid",
    "vorticity": "vorticity and enstrophy of a fluid on the torus",
}
ENSEMBLE_KINDS = {
    "spread": "median and quantiles of an ensemble in time",
    "ends": "the ends of an ensemble against what is varied",
}
OVERVIEW, PRECISION = "overview", "precision"
"""One sheet with all kinds that fit; a diagram of several runs (:mod:`.precision`)."""


def described_kinds() -> str:
    """The kinds with what they are."""
    several = {PRECISION: "work against error, of several runs or of a table"}
    listed = KINDS | ENSEMBLE_KINDS | {OVERVIEW: "all that fit"} | several
    return "; ".join(f"{name}: {about}" for name, about in listed.items())
