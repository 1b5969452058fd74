"""Records without one of the hypotheses, the given equations or the quantifiers of a step."""

from dataclasses import replace

from derive.check.definitions import unexplained
from derive.check.necessary_hypotheses import missing_mass_hypotheses


def without_a_hypothesis(step):
    """(hypothesis, step) for each that is left out."""
    for k, x in enumerate(step.hypotheses):
        rest = step.hypotheses[:k] + step.hypotheses[k + 1 :]
        yield x, replace(step, hypotheses=rest)


def without_what_is_given(step):
    """(equation, step) for each given one that is left out; and for inputs that do not act."""
    for k, x in enumerate(step.given):
        yield x, replace(step, given=step.given[:k] + step.given[k + 1 :])
    if step.driven:
        yield "driven", replace(step, driven=False)


def without_a_quantifier(step):
    """(name, step) for each name that an equation is no longer said to hold for, or to have."""
    for k, e in enumerate(step.equations):
        for key in ("for_all", "exists"):
            for x in getattr(e, key):
                fewer = replace(e, **{key: tuple(y for y in getattr(e, key) if y != x)})
                equations = (*step.equations[:k], fewer, *step.equations[k + 1 :])
                yield x, replace(step, equations=equations)


def held(d, step, checker):
    """Does the record hold with this step in the place of the one of its label?"""
    steps = [step if s.label == step.label else s for s in d.steps]
    known = not any(unexplained(steps)) and not any(missing_mass_hypotheses(steps, d.problem))
    return known and checker.check(step).holds
