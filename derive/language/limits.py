"""What a file of a stranger may cost, errors for people, a word to whoever waits."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar

# Errors for people: their message is one line, which says what is wrong, where, what to do.


class Refused(Exception):  # noqa: N818
    """Bad input, or something missing on the machine; on the command line exit 2, no traceback."""

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows: the message alone."""
        return [f"{type(self).__name__}: {self}"]


# A word to whoever waits, from what may take long: to nobody, unless a command listens.

LISTENER: ContextVar[Callable[[str], None]] = ContextVar("LISTENER")


def tell(text: str) -> None:
    """Say one line to the listener, if there is one."""
    if listener := LISTENER.get(None):
        listener(text)


# -- problem files ------------------------------------------------------------------------------

PROBLEM_BYTES = 500_000
"""Bytes of a problem file, whose TOML is then parsed within a second."""
KEY_PARTS = 20
"""Parts of a dotted key: the parser takes the square of their number."""
TABLES = {
    "point": 500,
    "solid": 12,
    "potential": 100,
    "input": 60,
    "force": 60,
    "damping": 100,
    "flow": 20,
    "event": 50,
    "output": 60,
    "signal": 60,
}
"""Tables of each kind in a file. Of more points the moments are better given ([body] given);
moments of solids have products that grow with the square of their number; each other table is a
term of every view."""
SAMPLES = 1000
"""Rows of a signal in a file; of more there are tables apart, .csv."""
PULLS = 150
"""Points times attractions, each of which is a sum with a root in the emitted code."""
PARAMETERS = 1000
"""Parameters of a problem, each of which may be one of the emitted functions."""
BASIS, MATRIX = 64, 9
"""Matrices of a basis of one's own, as many as gl(8) has, and their rows."""
TABLE, ROWS, CARRIED = 100, 4000, 128
"""Elements of an algebra by a table of brackets, and its rows: so(14) has 91 and 2184; and rows of
the matrices of an algebra with those of all that it carries along, of which the checker takes
products."""
TORUS = 101
"""The largest N of the algebra of the torus: its equations take N³ products."""
HYPERVISCOSITY = 8
"""The largest power of the Laplacian in a damping on the torus."""
TEXT = 1000
"""Letters of a title, a unit, a meaning, which stand in the head of every output."""

# -- expressions --------------------------------------------------------------------------------

EXPRESSION = 10_000
"""Characters of an expression."""
NESTING, DEPTH = 40, 60
"""Parentheses, and operations, in one another: recursion is bounded, and derivatives by the chain
rule are as long as that."""
SLOPE = 5_000
"""Operands of all first derivatives of an expression: those of a product of k factors have k²."""
LEAVES = 5_000
"""Names and numbers in all the expressions of one file."""
EXPONENT = 64
"""The largest exponent: powers are written as products."""
DIGITS = 40
"""Characters of a number; a double has 17 digits."""
MAGNITUDE, BITS = 10**300, 1100
"""What a double holds, and the bits of a numerator or denominator: 1e300 has 997."""
COMMON_BITS = 1100
"""Bits of the common denominator of all the numbers of a file: sums over the body have that cubed,
and more than 4300 digits are not written by Python."""
LAYERS = 16
"""The degree of a density in the level: its moments have as many terms, or more where it has
parameters."""
DEGREE = 1000
"""The degree of an expression, with which the checker's bound on a false pass grows."""

# -- emitted code -------------------------------------------------------------------------------

OPERANDS = 300_000
"""Operands of all values of one program. Sp(8) has 158656, of which 66436 operations are left: gcc
takes half a minute and 0.5 GB for them."""
SLOPES = 4000
"""Entries of the linearised equations by the state: 3600 are those of Aff(5)."""
SLOPES_IN_LOOPS = 10**6
"""The same where loops write them, on the torus for N of 31 at most: 7 MB."""
SLOPES_BY_PARAMETERS = 2000
"""Entries of the linearised equations by parameters: Aff(5) with symbolic moments has 1260, and
takes seconds."""

# -- motions ------------------------------------------------------------------------------------

STEPS_OF_A_MOTION = 10**9
"""Steps of one size of a motion. That many of gauss take the C hours, of rk4 minutes: more are a
size that was mistyped."""

# -- meshes -------------------------------------------------------------------------------------

MESH_BYTES, MESH_LINES, MESH_LINE = 50_000_000, 2_000_000, 20_000
"""Bytes and lines of a file, characters of a line of OFF: read whole into memory."""
TRIANGLES = 40_000
"""Triangles of a mesh: the exact sums over them take one second."""
COORDINATE_BITS = 256
"""Bits of a coordinate over the common denominator of all: the sums have five times as many."""

# -- records ------------------------------------------------------------------------------------

RECORD_BYTES = 20_000_000
"""Bytes of a record: one of a mesh with as many triangles as there may be has half of it."""
TREE, SENTENCE = 200, 30
"""Operators and sentences in one another: recursion is bounded."""

# -- what is told -------------------------------------------------------------------------------

MESSAGE = 1000
"""Letters of one message: it may quote a file."""
