"""Emitted files read back: they equal the record exactly, and no single change of one passes."""

import ast
import os
import re
from fractions import Fraction
from functools import cache
from random import Random

import pytest

from derive.code.emit import emit
from derive.code.languages import LANGUAGES
from derive.command import emitting
from derive.command.cli import main
from derive.validate.chart import Chart
from derive.validate.compare import Agreement, FileAtPoint
from derive.validate.emission import as_text
from derive.validate.exact_points import Claims
from derive.validate.read_file import read as read_file
from derive.validate.terms import Array, CodeError, DiffersError, Literals, Machine
from tests.project.test_layers import ROOT, imported
from tests.support.code_mutations import mutants
from tests.support.emitted_files import ENDS, READ, Emission
from tests.support.engine_mutations.jobs import FUNCTIONS
from tests.support.walks import NAMES, OTHERS, record

PROBLEMS = sorted({*NAMES, *OTHERS} - {"linear", "affine", "zeitlin"})
MUTATED = ("so3", "se3", "sl3", "comet", "jelly")
ALL = "DERIVE_ALL_MUTATIONS" in os.environ
SAMPLE = {"c": 20, "python": 60, "rust": 20, "javascript": 20, "julia": 20}
"""Changes of each file, spread over all of it; `make mutants` tries every one."""
SMALL = 2**40


@cache
def emitted(name, **chosen):
    """In the languages that are read, and have the steps and the frame that are asked for."""
    framed = "frame" in chosen
    given = [x for x in READ if not framed or LANGUAGES[x].framed]
    steps = {*chosen.get("step", ())}
    return Emission(name, [x for x in given if steps <= {*LANGUAGES[x].steps}], **chosen)


def reports(name, changed=None, **chosen):
    return emitted(name, **chosen).reports(changed)


@cache
def claims(name):
    return Claims(record(name), Chart(), SMALL)


@cache
def point(name):
    return claims(name).point("one point for all changes")


def read(name, language, text, **chosen):
    file = f"{name}{ENDS[language]}"
    return read_file(file, emitted(name, **chosen).files | {file: text}, name).module


def compared(name, language, text, **chosen):
    """Holds one text of a file against the record at one exact point."""
    literals = Literals(emitted(name).program.numbers())
    module = read(name, language, text, **chosen)
    return FileAtPoint(module, claims(name), literals, point(name)).compare_all()


def meaning(name, language, text):
    """All that the functions give at numbers drawn without regard to the group."""
    module, random = read(name, language, text), Random("any numbers")
    machine = Machine(module, point(name).elementary, Literals(emitted(name).program.numbers()))
    sizes = {"p": "PARAMETERS", "x": "STATE", "u": "INPUTS", "k": "CONSTANTS"}
    given = {
        a: Array([Fraction(random.randint(1, SMALL)) for _ in range(module.sizes[size])], a)
        for a, size in sizes.items()
    } | {"t": Fraction(random.randint(1, SMALL))}
    k = machine.call("constants", given, k=module.sizes["CONSTANTS"])
    dx = machine.call("rhs", given, dx=module.sizes["STATE"])
    energy = machine.call("energy", given, value=1)
    if "project" not in module.functions:
        return k, dx, energy
    moved = machine.call("project", given, out=module.sizes["STATE"])
    return k, dx, energy, moved, machine.call("defect", given, value=1)


def text_of(name, language):
    return emitted(name).files[f"{name}{ENDS[language]}"]


# -- what is emitted equals the record ----------------------------------------------------------


@pytest.mark.parametrize("name", PROBLEMS)
def test_every_ready_made_problem_equals_its_record(name):
    c, python, *others = reports(name)
    assert c.files == (f"{name}.h", f"{name}.c")
    assert [x.files for x in others] == [(f"{name}{ENDS[x]}",) for x in READ[2:]]
    for report in (c, python, *others):
        assert report.holds, report.text
    drift = {
        "euler_poisson": "",
        "gas_cloud": "",
        "gl3": "",
        "jelly": "",
        "screw": ", project, defect (at the unit of the group)",
    }
    seen = f"constants, rhs, energy, rhs_batch{drift.get(name, ', project, defect')}"
    assert c.text.startswith(f"{seen} equal the record at 2 exact points")
    assert float(c.text.partition("below ")[2].partition(";")[0]) < 1e-40
    for other in others:
        assert other.text.startswith(
            f"{seen} equal".replace("rhs_batch, ", "").replace(", rhs_batch", "")
        )
    assert "no function reads" not in c.text + python.text


def test_what_is_wrong_only_where_a_parameter_is_0_is_refused():
    text = text_of("two_tops", "c")
    assert "k_l/sqrt(" in text
    changed = text.replace("k_l/sqrt(", "(k_l + slack_l)/sqrt(")  # slack_l: 0 but for l = 0
    c, *_ = reports("two_tops", {"two_tops.c": changed})
    assert c.text.startswith("DIFFERS: rhs: the rate of ")


DRAGGED = """
name = "drag"
group = "SE(2)"
damping = [{ kind = "quadratic", coefficient = 0.4 }]
point = [{ mass = 1, at = [1, 0] }, { mass = 2, at = [0, 1] }]
"""


def test_a_divisor_kept_off_0_is_read_and_no_other_question_about_the_state():
    """``x + (x == 0)`` below a line is x wherever x divides; anywhere else it could hide a term."""
    drag = Emission(DRAGGED, ["c"], "drag", jacobian=("state",))
    whole = drag.files["drag.c"]
    old, *_ = re.findall(r"\((\w+) \+ \(\1 == 0\)\)", whole)
    for new, holds in {f"({old} + ({old} == 0))": True, f"({old} + 2*({old} == 0))": False}.items():
        text = whole.replace(f"({old} + ({old} == 0))", new)
        (report,) = drag.reports({"drag.c": text})
        assert report.holds == holds, report.text


def test_the_principal_frame_is_said_not_to_be_validated():
    assert all("not validated" in r.text and r.holds for r in reports("so3", frame="principal"))


def test_one_decimal_is_told_as_one():
    told = as_text(Agreement(("rhs",), 1, 1e-30, ("0.5",), ()))
    assert told.endswith("; 1 decimal is read as the number that it rounds: 0.5")


def test_a_rounded_decimal_is_read_as_what_it_rounds_and_no_other_is():
    text = text_of("ellipsoid", "c")
    assert "0.8377580409572781*" in text  # 4π/15
    assert "; 2 decimals are read as the numbers that they round" in reports("ellipsoid")[0].text
    c, *_ = reports(
        "ellipsoid", {"ellipsoid.c": text.replace("0.837758040957278", "0.8377580409572780")}
    )
    assert not c.holds
    assert c.text.startswith("DIFFERS: rhs: the rate of zeta_2 differs from the record's: ")


# -- no change passes ---------------------------------------------------------------------------


@pytest.mark.no_cover
@pytest.mark.parametrize("language", READ)
@pytest.mark.parametrize("name", MUTATED)
def test_every_change_of_the_code_is_refused(name, language):
    """What is spelt otherwise and is the same function of all numbers is no change of it."""
    kinds, total, same, passed = tried(name, language, 0 if ALL else SAMPLE[language])
    told = f"{name}, {language}: {total - len(passed)} of {total} caught, {same} change nothing"
    print(told)
    assert not passed, f"{told}; not {passed}"
    assert kinds >= {"sign", "term", "product", "name"}


def tried(name, language, some=0):
    """The kinds of changes, how many of all or some change something, how many do not; those that
    pass, of the former."""
    text = text_of(name, language)
    compared(name, language, text)
    found = list(mutants(text, language, read(name, language, text)))
    taken = found[:: max(1, len(found) // some) if some else 1]
    passed, same = [], 0
    for function, kind, place, changed in taken:
        try:
            compared(name, language, changed)
        except CodeError:
            continue
        if meaning(name, language, changed) == meaning(name, language, text):
            same += 1
        else:
            passed.append((function, kind, text.count("\n", 0, place) + 1))
    return {kind for _, kind, _, _ in found}, len(taken) - same, same, passed


def test_every_elementary_function_has_its_slope():
    for report in Emission(FUNCTIONS, jacobian=("state",)).reports():
        assert report.holds, report.text
        assert "jacobian" in report.text


@pytest.mark.no_cover
@pytest.mark.parametrize("chosen", ["state", "inputs", "parameters", "step"])
def test_a_change_of_a_jacobian_is_refused(chosen):
    """Those for the derivative of a step, too: of ``project`` off the group, of x by variations."""
    options = {"jacobian": (chosen,), "step": ("rk4",) * (chosen == "step")}
    text = emitted("so3", **options).files["so3.c"]
    start = text.index("void so3_jacobian")
    outputs = re.findall(r"^    D\[\d+\] = ([^;]*);", text[start:], re.MULTILINE)
    for old in {x for x in outputs if x != "0.0"}:
        wrong = text[:start] + text[start:].replace(f"] = {old};", f"] = 2.0*({old});", 1)
        with pytest.raises(DiffersError, match=r"jacobian|variations"):
            compared("so3", "c", wrong, **options)


DRIFT = {
    "a sign": ("-0.5*left_11", "0.5*left_11", "not taken back"),
    "half a step": ("-0.5*left_11", "-0.25*left_11", "not taken back"),
    "another state": ("out[9] = zeta_1", "out[9] = zeta_2", "a state of the group is changed"),
    "in place": ("out[9] = zeta_1", "out[9] = x[9]", "cannot work in place"),
    "left out": (" + fabs(left_22)", "", "does not see all"),
    "hidden": (" + fabs(left_22)", " - fabs(left_22)", "no sum of sizes"),
    "no size": ("fabs(left_22)", "left_22*left_22", "no sum of sizes"),
    "elsewhere": ("fabs(left_22)", "fabs(left_22 - 1.0)", "does not vanish"),
}


@pytest.mark.parametrize("case", DRIFT)
def test_a_change_of_project_or_defect_is_refused(case):
    old, new, reason = DRIFT[case]
    text = text_of("so3", "c")
    start = text.index("void so3_project")
    assert old in text[start:]
    with pytest.raises(CodeError, match=reason):
        compared("so3", "c", text[:start] + text[start:].replace(old, new, 1))


LISTS = [
    ("so3.py", '    "A_12",\n    "A_13",', '    "A_13",\n    "A_12",', "names of state"),
    ("so3.c", '    "A_12",\n    "A_13",', '    "A_13",\n    "A_12",', "names of state"),
    ("so3.c", '    "c_1",\n    "c_2",', '    "c_2",\n    "c_1",', "parameters"),
    ("so3.py", '    "u_1",\n', "", "names of inputs"),
    ("so3.py", '"c_3": 0.2', '"c_3": 0.3', "defaults"),
    *((f"so3.{x}", " 0.0, 0.2, ", " 0.0, 0.3, ", "defaults") for x in ("c", "rs", "jl")),
    ("so3.c", ", -9.81,\n", ", NAN,\n", "defaults"),
    ("so3.jl", ", -9.81,\n", ",\n", "the defaults are not a number"),
    ("so3.py", "[[0, 0, 0], [0, 0, -1]", "[[0, 0, 0], [0, 0, 1]", "basis"),
    ("so3.h", "so3_N_INPUTS = 3", "so3_N_INPUTS = 4", "so3_SIZE_U is 3, not 4"),
    ("so3.h", "so3_N_CONSTANTS = 20", "so3_N_CONSTANTS = 21", "so3_SIZE_K is 20, not 21"),
    ("so3.h", "so3_SIZE_U = 3", "so3_SIZE_U = 2", "so3_SIZE_U is 2, not 3"),
    ("so3.h", "so3_SIZE_K = 20", "so3_SIZE_K = 19", "so3_SIZE_K is 19, not 20"),
]


@pytest.mark.parametrize(("file", "old", "new", "reason"), LISTS, ids=str)
def test_a_wrong_list_or_size_is_refused(file, old, new, reason):
    text = emitted("so3").files[file]
    assert old in text
    found = [r for r in reports("so3", {file: text.replace(old, new)}) if not r.holds]
    assert len(found) == 1
    assert reason in found[0].text


BARE = """
name = "bare"
group = "SO(2)"
[parameters]
a = {}
b = 0.1
[[point]]
mass = "a"
at = ["b", 0.3]
"""
ABSENT = {"c": "NAN", "cpp": "NAN", "rust": "f64::NAN", "julia": "Float64(NaN)"}


@pytest.mark.parametrize("language", ABSENT)
def test_a_parameter_without_a_default_is_none_in_the_table(language):
    made = Emission(BARE, [language])
    file = f"bare{ENDS.get(language, '.hpp')}"
    table = f"    {ABSENT[language]}, 0.1,\n"
    assert not made.refused({})
    for other in (table.replace(ABSENT[language], "0.0"), f"    0.1, {ABSENT[language]},\n"):
        assert table in made.files[file]
        changed = made.files[file].replace(table, other)
        assert "the defaults of the parameters are not those" in made.refused({file: changed})


SIZES = [
    ("N_INPUTS|SIZE_U", 3, 4, "size INPUTS"),
    ("N_CONSTANTS|SIZE_K", 20, 21, "k[20] is"),
    ("N_CONSTANTS|SIZE_K", 20, 19, "k[19] is outside"),
]


@pytest.mark.parametrize(("sizes", "right", "wrong", "reason"), SIZES)
def test_a_count_wrong_with_its_size_is_refused(sizes, right, wrong, reason):
    text = emitted("so3").files["so3.h"]
    text, count = re.subn(rf"({sizes}) = {right}\b", rf"\1 = {wrong}", text)
    assert count == 2
    found = [r for r in reports("so3", {"so3.h": text}) if not r.holds]
    assert len(found) == 1
    assert reason in found[0].text


# -- files that cannot be read ------------------------------------------------------------------

UNREAD = {
    "c": [
        ("so3_rhs(double t", "so3_rhs(double k", "other arguments"),
        ("const double *so3_RESTRICT u", "double *so3_RESTRICT u", "other arguments"),
        ("I_22 - I_11*I_l_21*I_l_21", "pow(I_22, 2)", "the function pow"),
        ("I_22 - I_11*I_l_21*I_l_21", "cbrt(I_22)", "cbrt"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22 ? I_33 : J_23", "'?'"),
        ("I_22 - I_11*I_l_21*I_l_21", "(int)I_22", "'I_22'"),
        ("I_22 - I_11*I_l_21*I_l_21", "fabs(I_22)", "depends on a size"),
        ("I_22 - I_11*I_l_21*I_l_21", "size_I_1", "has no value"),
        (
            "    (void)t;\n",
            "    if (t > 1e40) {\n        return 1;\n    }\n",
            "condition",
        ),
        ("    k[0] = J_12;\n", "    if (p[0] > 0) { k[0] = J_12; }\n", "condition"),
        ("I_22 - I_11*I_l_21*I_l_21", "(k[0] = 1.0)", "'='"),
        ("1.0/I_d_3", "1/2/I_d_3", "quotient of integers"),
        ("1.0/I_d_3", "1.0f/I_d_3", "1.0f"),
        ("1.0/I_d_3", "0x1p0/I_d_3", "0x1p0"),
        ("const double I_11 =", "double I_11 =", "'double'"),
        ("const double I_11 =", "const float I_11 =", "'const'"),
        ("const double I_22 =", "const double I_11 =", "set twice"),
        ("    k[0] = J_12;\n", "", "k[0] is read before it is written"),
        ("    k[0] = J_12;\n", "    while (1) k[0] = J_12;\n", "'while'"),
        ("    k[0] = J_12;\n", "    k[0] += J_12;\n", "'+='"),
        ("    k[0] = J_12;\n", "    k[20] = J_12;\n", "outside"),
        ("    k[0] = J_12;\n", "    p[0] = J_12;\n", "input"),
        ("    k[0] = J_12;\n", "#ifdef __GNUC__\n    k[0] = J_12;\n#endif\n", "the directive"),
        ("    k[0] = J_12;\n", "#define J_12 J_13\n    k[0] = J_12;\n", "the directive"),
        ("    k[0] = J_12;\n", "    k[0] = J_1\\\n2;\n", "backslash"),
        ("#include <math.h>", "#include <complex.h>", "complex.h"),
        ("#include <math.h>", "double fabs(double x) { return x; }", "'double'"),
        ("#include <math.h>", "static double c_1 = 1.0;", "'static'"),
        ("#include <math.h>", "enum { I_22 = 3 };", "'I_22'"),
        ("#include <math.h>", "enum { so3_N_STATE = 12 };", "'so3_N_STATE'"),
        ("#include <math.h>", "extern const double so3_k[4];", "'extern'"),
        ("I_22 = ", "so3_N_STATE = ", "'so3_N_STATE'"),
    ],
    "python": [
        ("def _rhs(xp, t, x, k, u)", "def _rhs(xp, t, x, u, k)", "other arguments"),
        ("def _rhs(", "@cache\ndef _rhs(", "not defined for itself"),
        ("\n\ndef _inertia(", "\n\n_rhs = None\n\ndef _inertia(", ""),
        (
            "\n\ndef _inertia(",
            "\n\ndef _rhs(xp, t, x, k, u):\n    return x\n\ndef _inertia(",
            "twice",
        ),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22**2", "'**'"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22 if I_33 else 0.0", "'if'"),
        ("I_22 - I_11*I_l_21*I_l_21", "print(I_22)", "'('"),
        ("    return [\n        J_12", "    return [\n        abs(J_12)", "depends on a size"),
        ("    return [\n        J_12", "    return [\n        size_I_1", "depends on a size"),
        ("I_22 - I_11*I_l_21*I_l_21", "xp.cbrt(I_22)", "the function cbrt"),
        ("I_22 - I_11*I_l_21*I_l_21", "(lambda: I_22)()", ""),
        ("1.0/I_d_3", "1e9999/I_d_3", "1e9999"),
        ("1.0/I_d_3", "1.0/(I_d_3 - I_d_3)", "division by zero"),
        ("    I_d_2 = ", "    import os\n    I_d_2 = ", "'os'"),
        ("    I_d_2 = ", "    abs = ", "'abs'"),
        ("    I_22 = ", "    I_11 = ", "set twice"),
    ],
    "rust": [
        ("x: &[f64; N_STATE],\n    k:", "k: &[f64; N_STATE],\n    x:", "other arguments"),
        ("let I_22: f64 =", "let mut I_22: f64 =", "'I_22'"),
        ("let I_22: f64 =", "let I_22: f32 =", "':'"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22.powi(2)", "'.'"),
        ("I_22 - I_11*I_l_21*I_l_21", "if I_22 > 0.0 { I_33 } else { J_23 }", "'I_22'"),
        ("I_22 - I_11*I_l_21*I_l_21", "abs(I_22)", "depends on a size"),
        ("1.0/I_d_3", "1/2/I_d_3", "the number '1' is not read"),
        ("1.0/I_d_3", "1.0_f64/I_d_3", "the number '1.0_f64' is not read"),
        ("1.0/I_d_3", "/* 2.0* */1.0/I_d_3", "'/'"),
        ("    let I_22:", "    if I_11 > 0.0 { I_11 = 1.0; }\n    let I_22:", "'I_11'"),
        ("    Ok(k)", "    Ok(p)", "'p'"),
        ("let _ = t;", "let _ = (dx[0] = 0.0);", "'_'"),
        ("N_STATE: usize = 12", "N_STATE: usize = 13", "N_STATE is 13, not 12"),
        ("        J_12,\n", "", "k[19] is not written"),
    ],
    "javascript": [
        ("rhs(t, x, k, u", "rhs(t, k, x, u", "other arguments"),
        ("const I_22 =", "let I_22 =", "'let'"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22**2", "'**'"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22 ? I_33 : J_23", "'?'"),
        ("I_22 - I_11*I_l_21*I_l_21", "Math.cbrt(I_22)", "the function cbrt"),
        ("    const I_22", "    if (I_11 > 0) { k[0] = 1.0; }\n    const I_22", "'k'"),
        ("if (x.length !== 12", "if ((k[0] = 1.0) || x.length !== 12", "= in an error check"),
        ("if (x.length !== 12", "if (swap(k) || x.length !== 12", "swap in an error check"),
        ("    u ??= ZERO_INPUTS;", "    u = ZERO_INPUTS;", "'u'"),
        ("    return dx;", "    return x;", "'x'"),
        ("dx = new Float64Array(12)", "dx = new Float64Array(k[0] = 1)", "other arguments"),
        ("    c_1: 0.0,", "    c_1: c_2,", "','"),
        ("    return dx;", "    return\n    dx;", "in another line"),
        ("    return dx;\n", "", "not returned"),
        ("        J_12,\n", "", "k[19] is not written"),
    ],
    "julia": [
        ("function rhs!(dx, x, k", "function rhs!(dx, k, x", "other arguments"),
        ("    I_22 = ", "    I_11 = ", "set twice"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22^2", "'^'"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22 > 0 ? I_33 : J_23", "'>'"),
        ("I_22 - I_11*I_l_21*I_l_21", "abs(I_22)", "depends on a size"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22 -\n    I_11*I_l_21*I_l_21 + 2I_33", "not read"),
        ("I_22 - I_11*I_l_21*I_l_21", "I_22\n    - I_11*I_l_21*I_l_21", "'-'"),
        ("1.0/I_d_3", "1/2/I_d_3", "the number '1' is not read"),
        ("1.0/I_d_3", "1.0f0/I_d_3", "the number '1.0f0' is not read"),
        ("    I_22 = ", "    #= I_22 = 0.0 =#\n    I_22 = ", "'#'"),
        ("    I_22 = ", "    if c_1 > 0\n        k[1] = 1.0\n    end\n    I_22 = ", "'k'"),
        ("    k[1] = J_12\n", "", "k[0] is not written"),
        ("    k[1] = J_12\n", "    k[0] = J_12\n", "no place"),
        ("    k[1] = J_12\n", "    k[1] = J_12\n    return k\n", "after the last"),
        ("    return k\n", "    return p\n", "'p'"),
        ("const N_STATE = 12", "const N_STATE = (12,)", "no size"),
        ("function rhs!(", "@inline function rhs!(", "not defined for itself"),
    ],
}
BROKEN = [(language, *case) for language, cases in UNREAD.items() for case in cases]


@pytest.mark.parametrize(("language", "old", "new", "reason"), BROKEN, ids=str)
def test_what_is_not_known_is_an_error(language, old, new, reason):
    text = text_of("so3", language)
    assert old in text
    with pytest.raises(CodeError) as caught:
        compared("so3", language, text.replace(old, new, 1))
    assert reason in str(caught.value)


@pytest.mark.parametrize("language", READ)
def test_a_truncated_file_is_an_error(language):
    text = text_of("so3", language)
    for place in range(0, text.rindex("h_tilde"), len(text) // 40):
        with pytest.raises(CodeError) as caught:
            compared("so3", language, text[:place])
        assert str(caught.value)


# -- the command --------------------------------------------------------------------------------


def test_nothing_that_differs_is_written(tmp_path, capsys, monkeypatch):
    def wrong(*given):
        files = emit(*given)
        return files | {"so3.c": files["so3.c"].replace("J_13*zeta_1 + J_23", "J_13*zeta_1 - J_23")}

    monkeypatch.setattr(emitting, "emit", wrong)
    assert main(["emit", "so3", "--validate", "--out", str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert "so3.h, so3.c: DIFFERS: rhs: the rate of zeta_1 differs from the record's" in err
    assert os.listdir(tmp_path) == []


def test_the_validator_shares_nothing_with_what_makes_the_files():
    """Neither directly nor through what it imports; and it runs none of their text."""
    names = {str(p.relative_to(ROOT)) for p in imported(ROOT / "validate" / "emission.py")}
    assert "check/trials/model.py" in names
    assert not any(n.startswith(("walk/", "code/", "views/", "problem/")) for n in names)
    for path in (ROOT / "validate").rglob("*.py"):
        if path.name != "torus_files.py":  # which runs what is emitted, word for word
            calls = [x for x in ast.walk(ast.parse(path.read_text())) if isinstance(x, ast.Call)]
            assert not {ast.unparse(x.func) for x in calls} & {
                "exec",
                "eval",
                "compile",
                "__import__",
            }


HIDDEN = {
    "public function": ("return _evaluated(_rhs, ", "return -_evaluated(_rhs, "),
    "default": ("def rhs(t, x, k, u=None)", "def rhs(t, x, k, u=print())"),
    "data": ("ZEROS = (0.0,)", "ZEROS = (1.0,)"),
    "data of steps": (
        "OK, NOT_FINITE, NOT_CONVERGED = 0, 2",
        "OK, NOT_FINITE, NOT_CONVERGED = 0, 1",
    ),
    "number of a method": ("h * (0.5 * f[0])", "h * (0.25 * f[0])"),
    "annotation": ("def _energy(xp, t, x, k, u):", "def _energy(xp, t, x, k, u: print()):"),
    "encoding": ('"""', '# coding: unicode_escape\n"""'),
    "carriage return": ("import math\n", "import math  #\rk = 1\n"),
}


@pytest.mark.parametrize("case", HIDDEN)
def test_python_that_is_run_and_not_read_must_be_what_is_emitted(case):
    made = emitted("so3", step=("rk4",))
    files = {"so3.py": made.files["so3.py"]}
    old, new = HIDDEN[case]
    assert old in files["so3.py"]
    for text, holds in ((files["so3.py"].replace(old, new, 1), False), (files["so3.py"], True)):
        (found,) = made.reports({"so3.py": text}, files, {})
        assert found.holds == holds


BESIDE = [
    ("so3.py", "1e-13*size_I_1", "1e-3*size_I_1", "error checks"),
    ("so3.rs", "1e-13*size_I_1", "1e-3*size_I_1", "error checks"),
    ("so3.rs", "(x.to_bits() << 1) >> 1", "x.to_bits()", "not read, and not what is emitted"),
    ("so3.rs", "margin <= 0.0", "margin < 0.0", "not read, and not what is emitted"),
    ("so3.mjs", "if (x.length !== 12", "if (x.length === 12", "not what is emitted"),
    ("so3.mjs", "    u ??= ZERO_INPUTS;\n", "", "not what is emitted"),
    ("so3.mjs", "new Float64Array(12)", "new Float64Array(11)", "not what is emitted"),
    ("so3.jl", "length(x) == 12", "length(x) >= 12", "not read, and not what is emitted"),
    ("so3.jl", "rhs!(dx, x, k, t; u = control(x, t))", "rhs!(dx, x, k, t)", "not what is emitted"),
    ("so3.jl", "oftype(float(x), NaN)", "Base.sqrt(-x)", "not what is emitted"),
    ("so3.jl", "h * (0.5 * f[s, 1])", "h * (0.25 * f[s, 1])", "not what is emitted"),
    ("so3.jl", "    m.t_low = rest", "    m.t_low = -rest", "not what is emitted"),
    ("so3.hpp", "k.data(), u.data(), dx", "u.data(), k.data(), dx", "so3_rhs is not given what"),
    ("so3.hpp", "return dx;", "return x;", "not what is emitted"),
]


@cache
def beside():
    return Emission("so3", (*READ, "cpp"), step=("rk4", "discrete"))


@pytest.mark.parametrize(("file", "old", "new", "reason"), BESIDE)
def test_what_is_not_read_must_be_what_is_emitted(file, old, new, reason):
    made = beside()
    assert old in made.files[file]
    for text in (made.files[file], made.files[file].replace(old, new, 1)):
        found = made.reports({file: text}, made.files)
        report = next(x for x in found if file in x.files)
        assert report.holds == (text == made.files[file]), report.text
    assert reason in report.text


def test_c_with_events_is_read_back(tmp_path, capsys):
    """What is said of events is no claim of the record, and must be what is emitted."""
    path = tmp_path / "so3.toml"
    event = '\n[[event]]\nname = "level"\nwhen = "A_33 - 1/5"\n'
    path.write_text((ROOT / "problems" / "so3.toml").read_text() + event, encoding="utf-8")
    command = ["emit", str(path), "--step", "rk4", "--validate", "--out", str(tmp_path)]
    assert main([x for x in command if x not in ("--step", "rk4")]) == main(command) == 0
    c = tmp_path / "so3.c"
    changed = c.read_text(encoding="utf-8").replace("A_33 - 0.2", "A_33 - 0.3")
    c.write_text(changed, encoding="utf-8")
    capsys.readouterr()
    assert main([*command, "--check"]) == 1
    assert "so3.c: DIFFERS: 'events' is not read, and not what" in capsys.readouterr().err


REFUSING = {
    "all of them": ("if (so3_margin_1 <= 0*so3_margin_1)", "if (so3_margin_1 > 0*so3_margin_1)"),
    "without asking": ("if (!(p[i] - p[i] == 0))", "if (p[i] - p[i] == 0)"),
    "at the end": ("return 0;\n}", "return 1;\n}"),
}
"""Of the C of so3: what refuses every body."""
CHECKS = REFUSING | {
    "a margin": ("I_11 - 1e-13*size_I_1", "I_11 - 1e-3*size_I_1"),
    "a size": ("size_J_22 + size_J_33;", "size_J_22 - size_J_33;"),
    "a check": ("if (so3_margin_2 <= 0*so3_margin_2)", "if (so3_margin_1 <= 0*so3_margin_1)"),
    "a reason": ("return so3_NOT_FINITE;", "return so3_SINGULAR;"),
}
"""And what refuses others than it should.  The points of the comparison have numbers of any size,
which code in doubles may refuse: whether it takes them says nothing."""


@pytest.mark.parametrize("case", CHECKS)
def test_what_constants_refuses_is_compared_or_not_told_as_compared(case):
    files, (old, new) = emitted("so3").files, CHECKS[case]
    assert old in files["so3.c"]
    changed = {"so3.c": files["so3.c"].replace(old, new, 1)}

    def told(fresh):
        found = emitted("so3").reports(changed, fresh)
        return next(r for r in found if "so3.c" in r.files)

    alone, other = told(None), told(files)
    assert alone.holds
    assert "not validated: what constants refuses" in alone.text
    assert not other.holds
    assert "its error checks are not what is emitted" in other.text


@pytest.mark.parametrize("old", ["*n + s] =", "s < n"])
def test_batches_are_tried_with_several_sizes(old):
    text = text_of("so3", "c")
    changed = {"so3.c": text.replace(old, old.replace("n", "3"))}
    assert changed["so3.c"] != text
    c, *_ = reports("so3", changed)
    assert not c.holds


LATER = {
    "the velocity of the first": ("= x[9*n + s];", "= x[9*n];"),
    "an input of the first": ("= u[2*n + s];", "= u[2*n];"),
    "more than its own": ("= x[9*n + s];", "= x[9*n + s] + (u[1*n + s] - u[1*n]);"),
    "right in the first two": ("= x[4*n + s];", "= x[4*n + s*s];"),
    "another constant": ("= k[12];", "= k[12 + s];"),
    "what another state has": ("zeta_2*I_0_zeta_3", "x[10*n]*I_0_zeta_3"),
}
"""Changes of ``rhs_batch`` that leave the first of its states right."""


@pytest.mark.parametrize("case", LATER)
def test_every_state_of_a_batch_is_compared(case):
    """And each with its own state and inputs, one by one."""
    old, new = LATER[case]
    before, mark, batch = text_of("so3", "c").partition("so3_rhs_batch(")
    assert old in batch
    c, *_ = reports("so3", {"so3.c": before + mark + batch.replace(old, new, 1)})
    assert c.text.startswith("DIFFERS: rhs_batch: the rate of ")


def test_nothing_validated_is_no_success(tmp_path, capsys):
    command = ["emit", "so3", "--frame", "principal", "--validate", "--out", str(tmp_path / "new")]
    assert main(command) == 1
    assert "nothing of this can be validated" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_what_is_not_read_back_is_told_and_the_other_files_decide(tmp_path, capsys):
    """Also where it is an emission of its own."""
    emit = ["emit", "so3", "--out", str(tmp_path)]
    assert main([*emit, "--lang", "cvode", "--lang", "python", "--exponential"]) == 0
    assert main([*emit, "--exponential", "--check", "--validate"]) == 0
    told = capsys.readouterr().err
    for file in ("so3_cvode.h", "so3_group.h", "so3_group.py"):
        assert f"{file}: not validated: such a file is not read back" in told
    assert "nothing of this" not in told


def test_a_header_in_the_place_of_the_library_is_told(tmp_path, capsys):
    command = ["emit", "so3", "--out", str(tmp_path)]
    assert main(command) == 0
    (tmp_path / "math.h").write_text("#define sqrt cbrt\n", encoding="utf-8")
    assert main([*command, "--check"]) == 1
    assert "math.h: would be read in place of" in capsys.readouterr().out


def test_files_on_disk_are_read_back_too(tmp_path, capsys):
    """`emit --check --validate` judges what someone has changed since."""
    command = ["emit", "so3", "--out", str(tmp_path), "--check", "--validate"]
    assert main(command[:4]) == 0
    assert main(command) == 0
    lines = capsys.readouterr().err.splitlines()
    assert [x.partition(": ")[0] for x in lines] == ["so3.h, so3.c", "so3.py"]
    assert all("a false pass has probability below 1e-6" in line for line in lines)
    path = tmp_path / "so3.c"
    text = path.read_text(encoding="utf-8")
    path.write_text(f"/* mine */\n{text}", encoding="utf-8")
    assert main(command) == 1
    told = capsys.readouterr()
    assert "so3.c: not current from line 1 on" in told.out
    assert "so3.c: constants, rhs, energy, rhs_batch, project, defect equal the record" in told.err
    changed = text.replace("I_0_11*zeta_1 - J_12", "I_0_11*zeta_1 + J_12", 1)
    assert changed != text
    path.write_text(changed, encoding="utf-8")
    assert main(command) == 1
    assert "so3.h, so3.c: DIFFERS: rhs: the rate of zeta_1" in capsys.readouterr().err
    (tmp_path / "so3.h").unlink()
    assert main(command) == 1
    assert "so3.h, so3.c: cannot be read back: so3.h is empty or missing" in capsys.readouterr().err
