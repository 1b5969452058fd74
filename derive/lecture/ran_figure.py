"""The picture of a motion in the chapter on a reader's problem, as emitted code ran it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from ..language.reserved import GREEK
from ..language.show import SUBSCRIPTS, SUPERSCRIPTS
from ..views.figure.drawing import Label, Scene
from ..views.language import Language
from .body_figures import marks
from .sheets import AXES, Claims, Frame, panel

DESCRIBED = (
    "Curves over time: components of the velocity, from the start of the motion to the end of its "
    "picture."
)
RUN = "It starts as the problem says, and is run by the code that is emitted of its equations."
FLAT = "None of the numbers that a figure would show varies by one per cent."
LEVEL = 0.01
"""The part of its largest value by which a curve varies that is seen to."""
APART = 4.4
"""How far apart the letters at the ends of curves are, in millimetres."""
COLOURS = ("{name} (blue)", "{name} (black)", "{name} (red)")
ROUNDING = 1e-10
"""Less of a change, in the energy, is said no closer: it differs from machine to machine."""
LOST = 1e-3
"""More of a change, in the energy, is no error of steps."""
SPELT = str.maketrans("0123456789", "ghijklmnop")


def label_of(problem: str, kind: str = "run") -> str:
    """The label of a figure of a problem, in small letters alone."""
    return f"{kind}_{re.sub('[^a-z]', lambda x: f'_{ord(x[0]):x}'.translate(SPELT), problem)}"


@dataclass(frozen=True)
class Ran:
    """A motion: the times, one to three columns of numbers with their names in the code, the energy
    over time, empty where there is none, the numbers of the state at the ``start`` other than
    those of the identity at rest, by their letters, and the ``units`` of columns."""

    times: Sequence[float]
    curves: Sequence[tuple[str, Sequence[float]]]
    energy: Sequence[float] = ()
    start: Sequence[tuple[str, float]] = ()
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def flat(self) -> bool:
        """Is each curve constant, but for a little?"""
        return all(max(x) - min(x) <= LEVEL * max(map(abs, (*x, 0.0))) for _, x in self.curves)

    def caption(self, words: Language) -> str:
        """Which curve is which."""
        coloured = zip(COLOURS, self.curves, strict=False)
        named = ((colour, words.formula(letter_of(x))) for colour, (x, _) in coloured)
        curves = words.listed([words.word(colour, name=x) for colour, x in named])
        units = {self.units.get(x, "") for x, _ in self.curves}
        if "" in units or len(units) > 1 or self.units.get("t") != "s":
            return words.word("The curves show {curves} over time.", curves=curves)
        told = "The curves show {curves}, in {unit}, over the time in seconds."
        return words.word(told, curves=curves, unit=raised(units.pop()))

    def told(self, words: Language) -> str:
        """What made it, and what became of the energy."""
        if not self.energy:
            return words.word(RUN)
        change = max(abs(x - self.energy[0]) for x in self.energy)
        if change > LOST * max(map(abs, self.energy)):
            ends = {x: written(self.energy[k]) for x, k in (("first", 0), ("last", -1))}
            return (
                f"{words.word(RUN)} {words.word('Its energy goes from {first} to {last}.', **ends)}"
            )
        exponent = _exponent(max(change, ROUNDING * abs(self.energy[0])))
        bound = f"10{str(exponent).translate(SUPERSCRIPTS)}" if exponent < 0 else f"{10**exponent}"
        kept = "Its energy, {energy} at first, changes by less than {change}."
        energy = written(self.energy[0])
        return f"{words.word(RUN)} {words.word(kept, energy=energy, change=words.formula(bound))}"

    def picture(self, _claims: Claims) -> Scene:
        """The curves, in the colours of the axes."""
        low = min(0.0, *(min(values) for _, values in self.curves))
        high = max(0.0, *(max(values) for _, values in self.curves))
        ends = (1.1 * low, 1.1 * high) if low < high else (-1.0, 1.0)
        frame = Frame((14.0, 6.0), (92.0, 36.0), (0.0, ends[0]), (self.times[-1], ends[1]))
        strokes, labels = frame.axes(
            (Label("t"), Label("")), marks(0.0, self.times[-1]), marks(*ends)
        )
        strokes.append(frame.curve([(0, 0), (self.times[-1], 0)], "axis", "thin"))
        for role, (_, numbers) in zip(AXES, self.curves, strict=False):
            strokes.append(frame.curve(zip(self.times, numbers, strict=True), role))
        labels += self._ends(frame)
        return panel((124, 48), strokes, [x for x in labels if x.base])

    def _ends(self, frame: Frame) -> list[Label]:
        """The letters of the curves at their right ends, each above the one below it."""
        found: list[Label] = []
        least = frame.corner[1] + APART
        for last, name in sorted((values[-1], name) for name, values in self.curves):
            x, y = frame.at(self.times[-1], last)
            least = max(y, least)
            base, _, index = name.rpartition("_")
            letter = letter_of(name)
            quoted = letter.startswith("‘")
            label = Label(name, name=True) if quoted else Label(GREEK.get(base, base), index)
            found.append(replace(label, at=(x + 1.6 + label.half[0], least)))
            least += APART
        return found


def _exponent(x: float) -> int:
    """The exponent of a power of ten above a number; −12 for 0."""
    return int(f"{x:e}".partition("e")[2]) + 1 if x else -12


def raised(unit: str) -> str:
    """A unit with its exponents above the line."""
    return re.sub(r"\^(-?\d+)", lambda x: x[1].translate(SUPERSCRIPTS), unit)


def written(x: float, digits: int = 4) -> str:
    """A number with so many digits and the sign that is printed before negative ones."""
    return f"{x:.{digits}g}".replace("-", "−")


def letter_of(name: str) -> str:
    """A name of the code as the letter of the equations, or in quotes."""
    base, _, index = name.rpartition("_")
    if index.isdigit() and (base in GREEK or base == "w"):
        return f"{GREEK.get(base, base)}{index.translate(SUBSCRIPTS)}"
    return f"‘{name}’"
