"""A derivation as Python holds it: the record, its steps and equations, shown in a notebook too."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from ..problem.problem import Problem, ProblemError
from ..record.record import Derivation
from .api import in_keywords
from .quoted import loaded
from .shown import Answer, Page, Recorded, Shown

if TYPE_CHECKING:
    from ..motion.signals import Given
    from ..views.figure.drawing import Scene
    from .as_sympy import Translation
    from .conserved_quantities import SymmetriesOf
    from .expressions import Expressions
    from .found import Equilibria, Families, FirstIntegrals, Near, Reduced, Trimmed
    from .simulated import Simulated, SimulatedEnsemble


@dataclass(frozen=True)
class Figure:
    """The drawing of a body, which a notebook shows."""

    scene: Scene

    def __repr__(self) -> str:
        return f"<figure {self.scene.width:.0f} mm by {self.scene.height:.0f} mm>"

    def svg(self) -> str:
        """The drawing as SVG text, a file of its own or an element of a page."""
        from ..views.figure.drawing import svg

        return svg(self.scene)

    def _repr_svg_(self) -> str:
        return self.svg()


@dataclass(frozen=True)
class Derived(Recorded):
    """A derivation: the record of a problem, with methods to print, check, draw and emit it."""

    problem: Problem
    record: Derivation

    def __getitem__(self, label: str) -> Shown:
        """A step by its label, with or without the problem's name: ``d["motion"]``."""
        try:
            return Shown(self.record[label], self.record)
        except KeyError:
            known = ", ".join(self.labels)
            raise KeyError(f"no step {label!r:.60}; the steps are {known}") from None

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels of the steps, in order."""
        return tuple(step.label for step in self.record.steps)

    def __repr__(self) -> str:
        group = self.problem.group.name if self.problem.group else "any group"
        return f"<derivation {self.problem.name}: {len(self.labels)} steps, {group}>"

    @property
    def answer(self) -> Answer:
        """The equations of motion alone, and what their letters are."""
        from ..algebra.groups import names_by_block

        group = self.problem.group
        return Answer(self.record, names_by_block(group) if group else {})

    def _repr_markdown_(self) -> str:
        head = f"<details><summary>The walk: {len(self.labels)} steps</summary>"
        return f"{self.answer.markdown()}\n{head}\n\n{self.markdown()}\n</details>\n"

    def figure(self) -> Figure | None:
        """The drawing of the body; ``None`` where the problem has no body."""
        from ..views.figure.scene import scene

        drawn = scene(self.record)
        return Figure(drawn) if drawn else None

    def latex(self, lang: str = "en", transpose: str = "bar", hat: str = "j") -> str:
        """A document for pdflatex, with transposes as "bar" or "top" and hats as "j" or "wedge"."""
        return self._rendered("latex", lang, transpose=transpose, hat=hat)

    def integrals(
        self, degree: int = 4, *, at_defaults: bool = False, conditions: bool = False
    ) -> FirstIntegrals:
        """The polynomial first integrals of the reduced equations up to a degree."""
        from .found import first_integrals

        chosen = {"at_defaults": at_defaults, "conditions": conditions}
        return first_integrals(self.problem, degree, **chosen)

    def equilibria(
        self, at: Mapping[str, Fraction | int | str] | None = None, *, degree: int = 4
    ) -> Equilibria:
        """The relative equilibrium with these coordinates, the others 0, as ``{"Pi_3": 2}`` or
        ``{"Pi_1": "sqrt(3)/2"}``, or those among some points; parameters have their defaults.
        ``degree``: of the integrals that are searched.  ``ValueError`` where it is none, or for
        what is no such number."""
        from ..search.equilibria.equilibrium_points import number_from
        from ..searches import equilibria
        from .found import Equilibria

        values = {x: number_from(str(v)) for x, v in (at or {}).items()}
        return Equilibria(*equilibria(self.problem, values, degree))

    def families(self, *, degree: int = 4) -> Families:
        """The families of relative equilibria with one momentum, a letter, and at most one other
        coordinate, 1 or −1, and the inequalities in letters under which they are stable, and
        unstable.  ``degree``: of the integrals that are searched."""
        from ..searches import families
        from .found import Families

        return Families(*families(self.problem, degree))

    def equilibrium_near(self, at: Mapping[str, Fraction | int | str], *, degree: int = 4) -> Near:
        """The relative equilibrium near a point with these coordinates, on its level of the
        Casimirs up to a ``degree``, enclosed; ``ValueError`` where none is."""
        from ..search.equilibria.equilibrium_points import number_from
        from ..searches import equilibrium_near
        from .found import Near

        values = {x: number_from(str(v)) for x, v in at.items()}
        return Near(*equilibrium_near(self.problem, values, degree))

    def trim(
        self,
        at: Mapping[str, Fraction | int | str] | None = None,
        free: Sequence[str] | None = None,
        given: Mapping[str, float] | None = None,
        bounds: Mapping[str, tuple[Fraction | int | str, Fraction | int | str]] | None = None,
        along: Mapping[str, Fraction | int | str] | None = None,
    ) -> Trimmed:
        """The inputs, velocities and turns of g ``free``, else all inputs that are not given, with
        which the velocity of a state stays as it is; ``at``: numbers of the state and of inputs, as
        ``{"zeta_3": "1/2"}``, else those of g = 1, and 0, for a free velocity where it is sought;
        ``given``: parameters in place of their defaults.  ``ValueError`` where there is none, or
        there are many, or it is out of ``bounds``, as ``{"front": (0, 4)}``; ``along``: a velocity
        in space, Y of the motion exp(tY)g, which is seen from g with what is found."""
        from ..programs import trim
        from ..search.equilibria.equilibrium_points import number_from
        from .found import Trimmed

        values, turning = (
            {x: number_from(str(v)) for x, v in (some or {}).items()} for some in (at, along)
        )
        allowed = {
            x: (number_from(str(low)), number_from(str(high)))
            for x, (low, high) in (bounds or {}).items()
        }
        found, record, _ = trim(self.problem, values, free, given, allowed, turning)
        return Trimmed(found, record)

    def symmetries(self) -> SymmetriesOf:
        """All symmetries of L̃ of a kind, and what the motion keeps by each; ``ProblemError`` where
        there is no Lagrangian."""
        from ..searches import symmetries
        from .conserved_quantities import SymmetriesOf

        found = symmetries(self.problem, self.record)
        return SymmetriesOf(found.found, found.record)

    def reduction(self) -> Reduced:
        """Routh's reduction by symmetries that commute; ``ProblemError`` where there is nothing to
        reduce by."""
        from ..searches import reduction
        from .found import Reduced

        found = reduction(self.problem, self.record)
        return Reduced(found.routhian, found.record)

    @overload
    def simulate(self, t: float, *, ensemble: None = None, **chosen: Any) -> Simulated: ...

    @overload
    def simulate(self, t: float, *, ensemble: int, **chosen: Any) -> SimulatedEnsemble: ...

    @in_keywords()  # type: ignore[misc]  # the choices are those that are listed here
    def simulate(
        self,
        t: float,
        *,
        step: str = "",
        tol: float = 1e-9,
        dt: float | None = None,
        order: int | str = "",
        start: Mapping[str, float] | None = None,
        exp: Sequence[float] = (),
        points: int | None = None,
        project: bool = False,
        compiled: bool | None = None,
        inputs: Given | None = None,
        linear: bool = False,
        ensemble: int | None = None,
        vary: Mapping[str, Any] | None = None,
        seed: int | None = None,
    ) -> Simulated | SimulatedEnsemble:
        """The motion from 0 to t as a table, with what it keeps: by a ``step`` of the emitted code,
        to a tolerance ``tol``, or in steps of size ``dt``; ``order``: of the discrete step, 2, 4,
        6 or 8.

        ``start``: numbers of the state, parameters and inputs by name; ``exp``: the element of the
        group is exp of these coordinates; ``compiled``: by the C or by the Python, else by the C
        where that pays and there is a compiler; ``inputs``: in time, columns of numbers by name, t
        and those of inputs, or a .csv file of them, each row held up to the next one or, if they
        are ``linear``, joined to it by a straight line; or a function of t and the state (numbers
        in the order of the emitted code) that gives all inputs, or some by name.

        ``ensemble``: so many motions, by the C alone, each with numbers of its own for the names of
        ``vary``, drawn by (low, high) or ("normal", mean, deviation) from a ``seed`` (0); kept is
        the end, or ``points`` instants.  ``MotionError``, a ``ValueError``, says what is wrong.
        """
        from ..motion.ensemble import require_an_ensemble
        from ..motion.first_numbers import MotionError, is_weightless, require_numbers
        from ..motion.simulate import run
        from ..motion.trajectory import Method, step_of
        from ..programs import motion_of
        from .simulated import Simulated

        require_numbers(
            start, exp, t=t, tol=tol, dt=dt, points=points, ensemble=ensemble, seed=seed
        )
        begin: dict[str, Any] = {"given": start or {}, "exponent": exp, "project": project}
        if ensemble is not None:
            if inputs is not None or linear:
                raise MotionError("inputs in time are for one motion: leave out ensemble")
            how = {"step": step, "dt": dt, "order": order, "compiled": compiled}
            return self._many(ensemble, vary or {}, t, points or 1, tol, seed or 0, begin, how)
        require_an_ensemble(vary, seed)
        method = Method(step_of(self.record.problem or {}, step, dt), dt, tol, str(order))
        light = is_weightless(self.record.problem or {}, begin["given"])
        code = motion_of(self.problem, self.record, method.step, method.order, weightless=light)
        kept = 500 if points is None else points
        begin |= {"compiled": compiled, "inputs": inputs, "linear": linear}
        found = run(code, self.problem, method, t, kept, **begin)
        return Simulated.of(found)

    def _many(
        self,
        n: int,
        vary: Mapping[str, Any],
        t: float,
        points: int,
        tol: float,
        seed: int,
        begin: Mapping[str, Any],
        how: Mapping[str, Any],
    ) -> SimulatedEnsemble:
        from ..motion.ensemble import EnsembleMotions, Plan, laws, require_steps_of_an_ensemble
        from ..programs import motion_of_many
        from .simulated import SimulatedEnsemble

        require_steps_of_an_ensemble(**how)
        plan = Plan(n, laws(vary), t, points, tol, seed, **begin)
        many = EnsembleMotions(motion_of_many(self.problem, self.record), self.problem, plan)
        return SimulatedEnsemble.of(many.joined([*many.parts()]))

    @in_keywords()
    def motion_page(
        self,
        t: float,
        *,
        tol: float = 1e-9,
        start: Mapping[str, float] | None = None,
        exp: Sequence[float] = (),
        project: bool = False,
        language: str = "en",
    ) -> Page:
        """A page of HTML, a ``str`` that a notebook shows in a frame, in which the body moves from
        0 to t, from a start as of ``simulate``; in English or in French (``fr``)."""
        from ..motion.first_numbers import require_numbers
        from ..motion.simulate import beginning
        from ..motion.trajectory import Method, instants
        from ..programs import motion_of
        from ..views.language import language as named
        from ..views.page.motion_page import motion_page, with_seen

        require_numbers(start, exp, t=t, tol=tol)
        moves = replace(self.problem, events=())
        code = motion_of(moves, with_seen(self.record), weightless=True)
        begin = beginning(code, self.problem, given=start or {}, exponent=exp, project=project)
        instants(Method(tol=tol), t, 1)
        shown, held = named(language), start or {}
        page = motion_page(code, self.problem, self.record, begin, t, tol, shown, held)
        return Page(page)

    @cached_property
    def translation(self) -> Translation:
        """From the trees of the record to SymPy."""
        from .as_sympy import Translation

        return Translation(self.record)

    def sympy(self, formula: str) -> Any:
        """What a formula is in SymPy, written as the walk prints it: ``d.sympy("ζ")``;
        ``ValueError`` for any other text."""
        return self.translation.read(formula)

    def expressions(self) -> Expressions:
        """The equations of motion in coordinates, as SymPy expressions."""
        from ..programs import program
        from .expressions import expressions

        found = program(self.problem, self.record)
        if found.loops:
            raise ProblemError(
                f"{self.problem.name}: its equations are sums over a lattice, too many to be "
                "written out; take a smaller N"
            )
        return expressions(found)

    @in_keywords()
    def emit(
        self,
        out: str | Path | None = None,
        languages: Sequence[str] | str = ("c", "python"),
        prefix: str | None = None,
        **choices: Any,
    ) -> dict[str, str]:
        """The emitted files by name, written to the folder ``out`` if there is one.

        ``choices``: those of :class:`derive.code.options.Options`, as ``real="float"``.
        ``EmitError`` says what is wrong.
        """
        from ..code.emit import EmitError
        from ..code.options import options_of
        from ..code.requests import EmissionRequest
        from ..command.emitting import allowances, made, packed
        from ..command.writing import write

        own = self.problem
        try:
            options = options_of(choices, "languages", "prefix")
        except ValueError as error:
            raise EmitError(f"emit: {error}") from None
        named = (languages,) if isinstance(languages, str) else tuple(languages)
        asked = EmissionRequest(own.name, prefix or own.name, named, options, allowances(own))
        files = made(own, self.record, asked)[1]
        if out is not None:
            write(packed(asked, files), Path(out))
        return files


def derive(problem: Problem | str | Path, *, discrete: bool = False) -> Derived:
    """The derivation of a problem, of a problem file, or of a ready-made problem; ``ProblemError``
    says in one line what is wrong.  ``discrete``: its motion in steps of time h, without inputs."""
    from .. import pipeline

    problem = loaded(problem)
    return Derived(problem, pipeline.discrete(problem) if discrete else pipeline.walk(problem))
