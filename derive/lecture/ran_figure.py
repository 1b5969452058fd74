"""The picture of a motion in the chapter on a reader's problem, as emitted code ran it."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from ..language.reserved import GREEK
from ..language.show import SUBSCRIPTS, SUPERSCRIPTS, show
from ..language.tree import Tree, nodes, replaced
from ..language.values import approximate
from ..record.record import Derivation
from ..views.figure.drawing import Label, Scene
from ..views.language import Language, told
from .own_body import marks
from .recorded_text import AXIS, axis_letter
from .sheets import AXES, Claims, Frame, beside, panel

DESCRIBED = (
    "Curves over time: components of the velocity, from the start of the motion to the end of its "
    "picture."
)
FLAT = "None of the numbers that a figure would show varies by one per cent."
MAXIMA = 3
"""The least maxima of a curve that are counted."""
LEVEL = 0.01
"""The part of its largest value by which a curve varies that is seen to."""
APART = 4.4
"""How far apart the letters at the ends of curves are, in millimetres."""
COLOURS = ("{name} (blue)", "{name} (black)", "{name} (red)")
ROUNDING = 1e-10
"""Less of a change, in the energy, is said no closer: it differs from machine to machine."""
LOST = 1e-3
"""More of a change, in the energy, is no error of steps."""
ON_THE_RIGHT = "On the right: {letter}."
ON_THE_LINE = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
SPELT = str.maketrans("0123456789", "ghijklmnop")


def label_of(problem: str, kind: str = "run") -> str:
    """The label of a figure of a problem, in small letters alone."""
    return f"{kind}_{re.sub('[^a-z]', lambda x: f'_{ord(x[0]):x}'.translate(SPELT), problem)}"


Curves = Sequence[tuple[str, Sequence[float]]]
"""Columns of numbers, with their names."""


@dataclass(frozen=True)
class Ran:
    """A motion: the times, one to three columns of numbers with their names in the code, the energy
    over time, empty where there is none, the numbers of the state at the ``start`` other than
    those of the identity at rest, by their letters, the ``units`` of columns, the momenta that are
    ``kept``, each by what it is, its axis and its column, the ``state`` over time, by its letters,
    by how many turns a body has ``turned``, and whether it has inputs, all 0, ``undriven``."""

    times: Sequence[float]
    curves: Curves
    energy: Sequence[float] = ()
    start: Sequence[tuple[str, float]] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    kept: Mapping[tuple[str, int, str], Sequence[float]] = field(default_factory=dict)
    state: Mapping[str, Sequence[float]] = field(default_factory=dict)
    turned: float = 0.0
    undriven: bool = False

    @property
    def flat(self) -> bool:
        """Is each curve constant, but for a little?"""
        return all(max(x) - min(x) <= LEVEL * max(map(abs, (*x, 0.0))) for _, x in self.curves)

    def caption(self, words: Language, also: Sequence[str] = ()) -> str:
        """Which curve is which; ``also``: the letters of the panel on the right."""
        beside = [words.word(ON_THE_RIGHT, letter=words.formula(x)) for x in also]
        return " ".join((self._curves(words), *beside))

    def _curves(self, words: Language) -> str:
        coloured = zip(COLOURS, self.curves, strict=False)
        named = ((colour, words.formula(letter_of(x))) for colour, (x, _) in coloured)
        curves = words.listed([words.word(colour, name=x) for colour, x in named])
        units = {self.units.get(x, "") for x, _ in self.curves}
        if "" in units or len(units) > 1 or self.units.get("t") != "s":
            return words.word("The curves show {curves} over time.", curves=curves)
        told = "The curves show {curves}, in {unit}, over the time in seconds."
        return words.word(told, curves=curves, unit=raised(units.pop()))

    def told(self, words: Language, also: Sequence[str] = ()) -> str:
        """What it shows: what is constant, between which values its curves stay, with the letters
        ``also`` of the state, how often they are largest, how far the body turns."""
        curves = [*self.curves, *((x, self.state[x]) for x in also)]
        said = [self._constant(words), *(self._swing(*x, words) for x in curves)]
        if self.turned > 1:
            said.append(words.word(told("lecture:turns"), turns=written(self.turned, 3)))
        return " ".join(x for x in said if x)

    def _constant(self, words: Language) -> str:
        """The values of what is kept, at the end, and by how much they have changed at most."""
        end = self._with_unit(self.times[-1], "t")
        change = max((abs(x - self.energy[0]) for x in self.energy), default=0.0)
        seen = max((abs(x) for _, y in self.curves for x in y), default=0.0)
        if change > max(LOST * max(map(abs, self.energy), default=1.0), ROUNDING * seen):
            first, last = (written(self.energy[k]) for k in (0, -1))
            return words.word(told("lecture:lost"), end=end, first=first, last=last)
        kept = {words.word("energy"): ("energy", self.energy)} if self.energy else {}
        for (kind, k, column), numbers in self.kept.items():
            places = {"kind": words.word(kind), "axis": words.formula(axis_letter(k))}
            kept[words.word(AXIS[2 if "angular" in kind else 1], **places)] = column, numbers
        if not kept:
            return ""
        least = ROUNDING * max(abs(y[0]) for _, y in kept.values())
        largest = max(least, *(abs(x - y[0]) for _, y in kept.values() for x in y))
        # of a power of ten above it; 10⁻¹² for 0
        exponent = int(f"{largest:e}".partition("e")[2]) + 1 if largest else -12
        values = [
            f"{what} = {self._with_unit(y[0] if abs(y[0]) > least else 0.0, name)}"
            for what, (name, y) in kept.items()
        ]
        bound = words.formula(f"10{str(exponent).translate(SUPERSCRIPTS)}")
        still = told("lecture:still")
        return words.word(still, end=end, values=words.listed(values), change=bound)

    def _swing(self, name: str, values: Sequence[float], words: Language) -> str:
        """Between which values a curve stays, and how far apart its maxima are on the average."""
        ends = {x: written(f(values), 3) for x, f in (("low", min), ("high", max))}
        letter = words.formula(name if name in self.state else letter_of(name))
        inner = zip(self.times[1:], values, values[1:], values[2:], strict=False)
        at = [t for t, a, b, c in inner if a < b >= c]
        if max(values) - min(values) <= LEVEL * max(map(abs, values)):
            return ""
        if len(at) < MAXIMA:
            return words.word(told("lecture:goes"), letter=letter, **ends)
        apart = self._with_unit((at[-1] - at[0]) / (len(at) - 1), "t", 3)
        places = {"letter": letter, **ends, "apart": apart}
        return words.word(told("lecture:swings"), **places)

    def _with_unit(self, x: float, name: str, digits: int = 4) -> str:
        """A number with the unit of its column."""
        return f"{written(x, digits)} {raised(self.units.get(name, ''))}".rstrip()

    def picture(self, _claims: Claims, also: Sequence[str] = ()) -> Scene:
        """The curves, in the colours of the axes; beside them, letters ``also`` of the state."""
        if not also:
            return self._panel(self.curves, AXES, 92.0)
        left = self._panel(self.curves, AXES, 40.0)
        others = [(x, self.state[x]) for x in also]
        return beside(left, self._panel(others, ("body",), 20.0), gap=0)

    def _panel(self, curves: Curves, roles: Sequence[str], width: float) -> Scene:
        low = min(0.0, *(min(values) for _, values in curves))
        high = max(0.0, *(max(values) for _, values in curves))
        ends = (1.1 * low, 1.1 * high) if low < high else (-1.0, 1.0)
        frame = Frame((14.0, 6.0), (width, 36.0), (0.0, ends[0]), (self.times[-1], ends[1]))
        times = marks(0.0, self.times[-1])
        strokes, labels = frame.axes((Label("t"), Label("")), times, marks(*ends), 0)
        for role, (_, numbers) in zip(roles, curves, strict=False):
            strokes.append(frame.curve(zip(self.times, numbers, strict=True), role))
        labels += self._ends(frame, curves)
        return panel((width + 32, 48), strokes, [x for x in labels if x.base])

    def _ends(self, frame: Frame, curves: Curves) -> list[Label]:
        """The letters of the curves at their right ends, each above the one below it."""
        found: list[Label] = []
        least = frame.corner[1] + APART
        for last, name in sorted((values[-1], name) for name, values in curves):
            x, y = frame.at(self.times[-1], last)
            least = max(y, least)
            base, _, index = name.rpartition("_")
            if name in self.state:
                base, index = name[0], name[1:].translate(ON_THE_LINE)
            quoted = name not in self.state and letter_of(name).startswith("‘")
            label = Label(name, name=True) if quoted else Label(GREEK.get(base, base), index)
            found.append(replace(label, at=(x + 1.6 + label.half[0], least)))
            least += APART
        return found


def raised(unit: str) -> str:
    """A unit with its exponents above the line."""
    return re.sub(r"\^(-?\d+)", lambda x: x[1].translate(SUPERSCRIPTS), unit)


def written(x: float, digits: int = 4) -> str:
    """A number with so many digits and the sign that is printed before negative ones."""
    number, _, exponent = f"{x:.{digits}g}".replace("-", "−").partition("e")
    power = str(int(exponent.replace("−", "-"))).translate(SUPERSCRIPTS) if exponent else ""
    return f"{number}·10{power}" if power else number


def letter_of(name: str) -> str:
    """A name of the code as the letter of the equations, or in quotes."""
    base, _, index = name.rpartition("_")
    if index.isdigit() and (base in GREEK or base == "w"):
        return f"{GREEK.get(base, base)}{index.translate(SUBSCRIPTS)}"
    return f"‘{name}’"


def value_at_start(d: Derivation, t: Tree, ran: Ran) -> float:
    """The value of an expression at the start of a motion; not a number where it has none."""
    momenta = (s for s in d.steps if s.label == f"{d.name}.momenta")
    for e in (e for s in momenta for e in s.equations if isinstance(e.lhs, tuple)):
        assert isinstance(e.lhs, tuple)
        if e.lhs[:2] == ("at", "Π") and isinstance(e.lhs[2], int):
            t = replaced(t, e.lhs, e.rhs)
    start = dict(ran.start)
    for x in {x for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"}:
        unmoved = float(x[1] == "A" and x[2] == x[-1])
        t = replaced(t, x, Fraction(start.get(show(x), unmoved)))
    given = {x: y["default"] for x, y in d.problem["parameters"].items()}
    return value_of(t, {x: float(y) for x, y in given.items() if y is not None})


def value_of(t: Tree, parameters: Mapping[str, float]) -> float:
    """The value of an expression; not a number where it has none."""
    found = approximate(t, parameters)
    return math.nan if found is None else found
