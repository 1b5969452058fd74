"""Functions beside the equations, read back: of a state with a quaternion, of a discrete step, of
an estimate with the covariance of its error, outputs, the mass matrix; no change of them passes.
The velocity of a product by the names of its blocks: in files of every language, in problem files,
in runs; the record knows nothing of it."""

import re
import tomllib
from functools import cache

import numpy as np
import pytest

import derive
from derive.algebra.families import group
from derive.algebra.groups import names_by_block
from derive.command.cli import main
from derive.motion.first_numbers import first_numbers
from derive.motion.run import Column, Run
from derive.motion.run import read as read_run
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.as_json import to_json
from derive.validate.compare import FileAtPoint, compare
from derive.validate.exact_points import Claims
from derive.validate.read_file import read
from derive.validate.terms import CodeError, Literals
from tests.problems import PROBLEMS
from tests.support.code_mutations import BODIES, COMMENTS, blank, mutants, statement
from tests.support.corpus import driven
from tests.support.emitted_files import ENDS, READ, Emission
from tests.support.needs import need

SMALL = 2**40

# -- what is not read back ------------------------------------------------------------------------


def test_a_number_in_what_is_not_read_is_no_size():
    """``const N_u_22 = …`` within a step in time, beside sizes as ``N_STATE``."""
    points = "".join(
        f"[[point]]\nmass = 1\nat = {at}\nblock = {b}\n"
        for at, b in (("[0, 1]", 1), ("[1, 1]", 1), ("[1, 0]", 2))
    )
    force = '[[input]]\nname = "F"\nkind = "force"\non = 1\n[[damping]]\ncoefficient = 0.3\n'
    made = Emission(
        f'name = "own"\ngroup = "SE(2) x SO(2)"\n{points}{force}', READ, step=("gauss",)
    )
    assert made.files["own.mjs"].count("const N_u_22 = ") == 2
    assert made.refused({}) == ""


# -- to_matrix and from_matrix --------------------------------------------------------------------

OWN = ("to_matrix", "from_matrix")


@pytest.fixture(scope="module")
def with_quaternion():
    """The text of C, and of such a text its module, and whether it holds at one exact point."""
    made = Emission("so3", ("c",), attitude="quaternion")
    claims = Claims(made.record, made.chart, SMALL)
    point = claims.point("one point for all changes")

    def module(text):
        return read("so3.c", made.files | {"so3.c": text}, "so3").module

    def holds(text):
        try:
            found = FileAtPoint(module(text), claims, Literals(()), point).compare_all()
        except CodeError:
            return False
        return {*OWN} <= {*found}

    return made.files["so3.c"], module, holds


@pytest.mark.no_cover
def test_every_change_of_an_attitude_is_refused(with_quaternion):
    text, module, holds = with_quaternion
    assert holds(text)
    own = [x for x in mutants(text, "c", module(text)) if x[0] in OWN]
    assert len(own) > 100
    passed = [x for x in own if holds(x[3])]
    assert [x[1:3] for x in passed if not may_differ(text, x[2])] == []
    assert len(passed) < len(own) / 8


def may_differ(text, place):
    """May a change here give the same? Of a number that is exactly 0 either sign will do, and all
    terms of the sum whose sign is asked for have the same."""
    line = text[text.rfind("\n", 0, place) + 1 : text.index("\n", place)]
    return "part_" in line or statement(text, place, "c") == "whole_product"


def test_a_condition_is_refused(with_quaternion):
    text, _, holds = with_quaternion
    start = text.index("void so3_from_matrix")
    first = "    out[0] = "
    changed = text[start:].replace(first, f"    if (R_11 > 1e30) {{ out[0] = 2.0; }}\n{first}", 1)
    assert not holds(text[:start] + changed)


# -- a discrete step ------------------------------------------------------------------------------

TURNED = "step_turn, step_turn_little, step_newton"
KINDS = {
    **dict.fromkeys(("so3", "se3"), "step_force, step_guess, step_newton"),
    **dict.fromkeys(("sl3", "saff3"), "step_guess, step_begin, step_newton"),
    "gl3": "step_force, step_end",
    **dict.fromkeys(("heisenberg", "sim3", "so4", "screw", "SO(3)", "SE(3)", "SL(3)"), TURNED),
}
"""Problem, or group of one with inputs and damping → what is read back of its step."""


@cache
def stepped(name, layout="row"):
    text = driven(name, 0) if "(" in name else name
    return Emission(text, READ, "own", step=("discrete",), layout=layout)


@pytest.mark.parametrize("layout", ["row", "col"])
@pytest.mark.parametrize("name", KINDS)
def test_the_functions_of_a_step_are_read_back(name, layout):
    found = [x for x in stepped(name, layout).reports() if x.read]
    assert len(found) == len(READ)
    for report in found:
        assert report.holds, report.text
        assert KINDS[name] in report.text
        assert "step_momentum, step_velocity, step_force" in report.text


@cache
def claims(name):
    return Claims(stepped(name).record, stepped(name).chart, 2**64)


def compared(name, language, text):
    """Compare a changed file with the record."""
    made, file = stepped(name), f"own{ENDS[language]}"
    module = read(file, {**made.files, file: text}, "own").module
    compare(module, claims(name), made.program.numbers(), "", 1e-3)
    return module


def transposed(text):
    """A text in which an entry of Y² and that of its transpose are one: Y is skew on SO(n)."""
    return re.sub(r"power_2_(\d)(\d)", lambda m: "power_2_" + "".join(sorted(m.groups())), text)


@pytest.mark.no_cover
@pytest.mark.parametrize("language", READ)
@pytest.mark.parametrize("name", ["so3", "se3", "sl3", "gl3", "so4", "SE(3)"])
def test_a_change_of_a_function_of_a_step_is_refused(name, language):
    text = stepped(name).files[f"own{ENDS[language]}"]
    module = compared(name, language, text)
    found = [*mutants(text, language, module, r"step_\w+")]
    assert {x for x, *_ in found} >= {"step_momentum", "step_force", "step_end", "step_velocity"}
    passed = []
    for function, kind, place, changed in found[:: max(1, len(found) // 25)]:
        if name == "so4" and transposed(changed) == transposed(text):
            continue
        try:
            compared(name, language, changed)
        except CodeError:
            continue
        passed.append((function, kind, text.count("\n", 0, place) + 1))
    assert not passed


# -- an estimate ----------------------------------------------------------------------------------

RATE = [["A_12*w", "-A_11*w", "A_11*u"], ["A_22*w", "-A_21*w", "A_21*u"], [0, 0, 0]]
WHEEL = {"inputs": ["u", "w"], "rate": RATE, "noise": ["2*q", "q^2"]}


@cache
def estimate(side="right"):
    own = {"kinematics": WHEEL | {"error": side}, "parameters": {"q": 0.01}}
    return Emission({"name": "wheel", "group": "SE(2)", **own}, READ)


@pytest.mark.parametrize("side", ["left", "right"])
def test_an_estimate_is_read_back_in_all_languages(side):
    found = estimate(side).reports()
    assert len(found) == len(ENDS)
    for x in found:
        assert (x.holds, x.read) == (True, True), x.text
        assert "rhs, " in x.text
        assert "error_generator, error_noise equal the record" in x.text


@pytest.mark.parametrize("language", ENDS)
def test_no_change_of_an_operator_passes(language):
    """Some of those of each function, spread over it."""
    file = f"wheel{ENDS[language]}"
    text, names = estimate().files[file], "rhs|error_generator|error_noise"
    for body in re.finditer(BODIES[language].format(names), text, re.MULTILINE | re.DOTALL):
        code = blank(COMMENTS[language], body[2])
        places = [body.start(2) + x.start() for x in re.finditer(r"(?<=\w)(\*| [-+] )(?=\w)", code)]
        for at in places[:: max(1, len(places) // 4)]:
            k = at + (text[at] == " ")
            changed = text[:k] + {"*": "+", "+": "-", "-": "+"}[text[k]] + text[k + 1 :]
            assert estimate().refused({file: changed}), (body[1], text[k - 60 : k + 30])


def test_the_noise_of_the_inputs_enters_by_a_column_for_each():
    """G of a unicycle whose error is (turn, ahead, aside) on the left, whatever the state is."""
    f = estimate("left").module
    x = np.concatenate([[0.6, -0.8, 0.8, 0.6, 2, 3], np.eye(3)[np.triu_indices(3)]])
    D = f.error_noise(0.0, x, f.constants([0.01]))
    assert np.array_equal(D, [[0, 1], [1, 0], [0, 0]])


# -- outputs, their derivatives, the mass matrix and the bias -------------------------------------

FUNCTIONS = ("outputs", "jacobian_outputs", "jacobian_outputs_raw", "mass_matrix", "bias")
FUNCTIONS += ("inverse", "jacobian_outputs_inputs")
PUSHED = '[[input]]\nname = "push"\nkind = "force"\non = 2\ndirection = [1, 0]\n'


@cache
def with_outputs():
    """Of a small problem with one input."""
    options = {"jacobian": ("outputs", "raw"), "dynamics": True}
    return Emission(PROBLEMS["SO(2) outputs"] + PUSHED, prefix="test", **options)


def test_outputs_equal_the_record():
    for report in with_outputs().reports():
        assert report.holds, report.text
        assert all(f" {x}" in report.text for x in FUNCTIONS), report.text


@pytest.mark.parametrize("name", FUNCTIONS)
def test_numbers_all_over_are_compared(name):
    text = with_outputs().files["test.c"]
    start = text.index(f"void test_{name}(")
    end = text.index("\n}\n", start)
    stored = sorted({*re.findall(r"^    \w+\[\d+\] = ([^;]*);", text[start:end], re.M)})
    for old in stored[:: 1 + len(stored) // 4]:
        changed = text[start:end].replace(f"] = {old};", f"] = 1.0 + ({old});", 1)
        told = with_outputs().refused({"test.c": text[:start] + changed + text[end:]})
        assert f"{name}: " in told, old


SWAPPED = '    "place_1",\n    "place_2",', '    "place_2",\n    "place_1",'
LISTS = [
    ("test.py", *SWAPPED, "names of outputs"),
    ("test.c", *SWAPPED, "outputs"),
    ("test.h", "test_Y_place_1 = 0", "test_Y_place_2 = 0", "places of the names of outputs"),
    ("test.h", "test_N_OUTPUTS = ", "test_N_OUTPUTS = 1", "size OUTPUTS"),
]


@pytest.mark.parametrize(("file", "old", "new", "reason"), LISTS, ids=[x[3] for x in LISTS])
def test_a_wrong_list_of_outputs_is_refused(file, old, new, reason):
    text = with_outputs().files[file]
    assert old in text
    assert reason in with_outputs().refused({file: text.replace(old, new)})


# ---------------------------------------------------------------- names by block

PAIR = """
name = "pair"
group = "SO(2) x SE(2)"

[lagrangian]
L = "(2*zeta1_1^2 + 3*zeta2_1^2 + w2_1^2 + w2_2^2)/2 - zeta1_1*w2_2/5"

[[force]]
covector = ["-zeta2_1", 0, "-w2_1", 0]

[initial]
w2_2 = 3

[[event]]
name = "slow"
when = "w2_2 - 1"
"""
RUNNING = {"zeta1_1": "zeta_1", "zeta2_1": "zeta_2", "w2_1": "zeta_3", "w2_2": "zeta_4"}
LANGUAGES = ("c", "cpp", "python", "rust", "julia", "javascript")


@cache
def emitted():
    return Emission(PAIR, LANGUAGES)


def test_each_has_the_name_that_its_block_has_alone():
    known = names_by_block(group("SO(2) x SE(2)"))
    assert {own: x for x, own in known.items()} == RUNNING
    assert names_by_block(group("SE(3)")) == {}


def test_a_file_may_say_them_and_the_record_is_the_same():
    text = PAIR
    for own, name in RUNNING.items():
        text = text.replace(own, name)
    other = problem_of(tomllib.loads(text))
    assert to_json(walk(other)) == to_json(emitted().record)
    assert (other.initial, other.events) == (emitted().problem.initial, emitted().problem.events)


def test_one_number_has_one_start():
    with pytest.raises(ProblemError, match="w2_2: the same number as zeta_4"):
        problem_of(tomllib.loads(PAIR.replace("w2_2 = 3", "zeta_4 = 1\nw2_2 = 3")))


def test_a_number_of_a_file_and_what_varies_have_either_name(tmp_path):
    need("cc")
    for name, x in (("pair.toml", PAIR), ("start.toml", "zeta_3 = 2")):
        (tmp_path / name).write_text(x, encoding="utf-8")
    path, out = str(tmp_path / "pair.toml"), str(tmp_path / "run.npz")
    start = ["--state", str(tmp_path / "start.toml"), "--set", "w2_1=7"]
    assert main(["simulate", path, "--t", "0.1", *start, "--out", out]) == 0
    assert read_run(tmp_path / "run.npz")["w2_1"][0] == 7
    many = derive.derive(path).simulate(0.01, ensemble=3, vary={"w2_1": (0, 1)}, points=2)
    assert np.array_equal(many["w2_1"][:, 0], many.varied[:, 0])
    assert len(set(many.varied[:, 0])) == 3


def test_a_start_and_a_column_are_found_by_them():
    compiled, problem = emitted().program, emitted().problem
    found = first_numbers(compiled, problem, {"zeta2_1": 0.25})
    assert found.x[compiled.state.index("zeta_2")] == 0.25
    assert found.x[compiled.state.index("zeta_4")] == 3
    columns = tuple(Column(x, "state", "") for x in compiled.state)
    table = [[float(k) for k in range(len(columns))]]
    run = Run(columns, np.array(table), {"by_block": compiled.by_block})
    assert all(run[own] == run[name] for own, name in RUNNING.items())


def test_every_language_lists_them():
    files = emitted().files
    assert "pair_X_w2_1 = pair_X_zeta_3," in files["pair.h"]
    for end in (".hpp", ".py", ".rs", ".jl", ".mjs"):
        words = " ".join(files[f"pair{end}"].split())
        assert '"zeta1_1", "zeta2_1", "w2_1", "w2_2",' in words, end


@pytest.mark.parametrize("end", [".h", ".py", ".rs", ".jl", ".mjs"])
def test_they_are_read_back_and_exchanged_ones_are_seen(end):
    file = f"pair{end}"
    text = emitted().files[file]
    other = text.replace("w2_1", "@@").replace("w2_2", "w2_1").replace("@@", "w2_2")
    assert not emitted().refused({file: text})
    assert "the names of state_by_block are not" in emitted().refused({file: other})
