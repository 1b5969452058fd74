"""The ready-made problems in every form of the emitted C, for tools that look at all of it."""

from derive import derive
from derive.code.program import LoweringError
from derive.problem.problem import ProblemError
from tests.support.library import module_of
from tests.support.states import some_body

PROBLEMS = ("so3", "se3", "sl3", "saff3", "comet", "top", "two_tops")
FORMS = {
    "plain": {},
    "quaternion": {"attitude": "quaternion"},
    "tangent": {"velocity": "tangent"},
    "principal": {"frame": "principal"},
    "jacobian": {"jacobian": ("state", "inputs", "parameters")},
}
REFUSED = {("two_tops", "principal")} | {(name, "quaternion") for name in ("sl3", "saff3")}
"""No such form: tests/command/test_emission_errors.py says with what words."""


def emit_forms(folder, problems=PROBLEMS, forms=FORMS, languages=("c",)):
    """Write NAME_FORM.h and .c for every problem and form; return the prefixes with the problem."""
    made = {}
    for name in problems:
        derived = derive(name)
        for form in forms:
            choices = dict(FORMS[form])
            if form == "jacobian" and not derived.problem.inputs:
                choices["jacobian"] = ("state", "parameters")
            try:
                derived.emit(folder, languages, f"{name}_{form}", **choices)
            except (LoweringError, ProblemError):
                assert (name, form) in REFUSED
                continue
            assert (name, form) not in REFUSED
            made[f"{name}_{form}"] = name
    return made


def some_parameters(name):
    """Values of the parameters of a problem for which there is a body, in order."""
    module = module_of(name)
    own = some_body(module.PARAMETERS) or module.DEFAULTS
    return [float(own.get(x, module.DEFAULTS.get(x, 1.25))) for x in module.PARAMETERS]
