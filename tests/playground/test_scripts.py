"""The JavaScript of the playground that needs no page, by node: the clock of the worker, what is
completed, numbers and names of a text, the notebook."""

import json
import runpy
import subprocess
import sys
import tomllib

import pytest

from derive import derive as derived
from derive.code.options import CHOICES, REPEATED
from derive.command.showing import ready_made
from playground.site import ROOT, built
from playground.stage import options, schema
from tests.support import in_node, walks
from tests.support.library import module_of
from tests.support.needs import need
from tests.support.played import PENDULUM, text_of

# ---- the clock: of what is silent, not of what is long

CLOCK = """
let now = 0, timers = [], worker;
globalThis.performance = { now: () => now };
globalThis.setTimeout = (does, after) => {
    const timer = { does, at: now + after };
    timers.push(timer);
    return timer;
};
globalThis.clearTimeout = (timer) => { timers = timers.filter((x) => x !== timer); };
globalThis.Worker = class {
    constructor() { worker = this; this.hear = {}; this.ended = false; }
    addEventListener(kind, does) { this.hear[kind] = does; }
    postMessage(data) { this.asked = data; }
    terminate() { this.ended = true; }
    say(kind) { this.hear.message({ data: { kind, id: this.asked?.id, news: {} } }); }
};
const settled = () => new Promise((resolve) => setImmediate(resolve));
async function until(t) {
    for (const x of timers.filter((y) => y.at <= t).sort((a, b) => a.at - b.at)) {
        now = x.at;
        if (timers.includes(x)) { clearTimeout(x); x.does(); }
    }
    now = t;
    await settled();
}
const { Engine } = await import("./src/engine.js");
const engine = new Engine({ seconds: 60 }), heard = [];
let how = "";
engine.ask({ ask: "check" }, (kind) => heard.push(kind)).then((x) => { how = x; });
await until(1000);
worker.say("ready");
await settled();
const told = [];
"""
"""A worker and a time that are made here; what was told, how the question ended."""


@pytest.mark.parametrize(
    ("verdicts", "end", "told", "how", "clocks"),
    [
        (range(50, 650, 50), "end", [""] * 12, "end", 0),
        ([50], 109, ["", ""], "", 1),
        ([50], 111, ["", "late"], "late", 0),
        ([], 61, ["late"], "late", 0),
    ],
)
def test_a_check_ends_where_it_is_silent(verdicts, end, told, how, clocks):
    """It tells verdicts at some seconds, and ends, or nothing is heard until others."""
    seconds = [*verdicts, *([end] if end != "end" else [])]
    run = f"""
        for (const t of {seconds}) {{
            await until(1000 + 1000 * t);
            told.push(how);
            if (t !== {json.dumps(end)}) worker.say("verdict");
        }}
        if ({json.dumps(end)} === "end") worker.say("end");
        await settled();
        const clocks = timers.length;
        console.log(JSON.stringify({{ told, how, heard: heard.length, clocks }}));
    """
    found = json.loads(in_node.printed(CLOCK + run))
    assert found == {"told": told, "how": how, "heard": len(verdicts), "clocks": clocks}


# ---- where Back goes


def test_an_entry_is_gone_to_where_it_was_left():
    """And to the step of its address where nobody was before."""
    there = {"id": "so3.kernel", "by": -20}
    run = f"""
        globalThis.history = {{ state: null, replaceState(state) {{ this.state = state; }} }};
        const {{ Places }} = await import("./src/history.js");
        const places = new Places({{ at: () => ({json.dumps(there)}) }});
        const told = [places.aim("so3.kernel")];
        places.stands = true;
        places.keep();
        console.log(JSON.stringify([...told, places.aim("so3.kernel")]));
    """
    assert json.loads(in_node.printed(run)) == [{"step": "so3.kernel"}, there]


# ---- numbers, names and words


def test_numbers_in_a_text_and_what_has_no_place_in_it():
    text = """name = "x"
[parameters]
m = 1.5 # mass
k = { meaning = "default", default = 1e-3 }
[initial]
exp = [0.3, 0, 0]
"""
    numbers = {
        "initial": {"zeta_1": 2, "zeta_2": 0},
        "parameters": {"m": -2, "k": 4, "q": 1},
        "exp": [1, 0, 0],
    }
    call = "written(given.text, given.numbers)"
    given = {"text": text, "numbers": numbers}
    told = in_node.told('import { written } from "./src/declared.js";', call, given)
    found = tomllib.loads(told["text"])
    assert found["parameters"] == {"m": -2, "k": {"meaning": "default", "default": 4}}
    assert found["initial"] == {"zeta_1": 2, "exp": [0.3, 0, 0]}
    assert told["left"] == ["q", "θ"]


@pytest.mark.parametrize("name", [x for x in ready_made() if x != "imu" and walks.problem(x).group])
def test_names_of_the_velocity_are_the_emitted_ones(name):
    """Of what the page offers, where the group is a named one, but for coordinates that are held
    at 0, which only a derivation finds; tests/problem has those that are told with the walk."""
    problem = walks.problem(name)
    given = {"schema": schema(), "text": text_of(name)}
    call = "velocity(given.schema, given.text)"
    found = in_node.told('import { velocity } from "./src/completion.js";', call, given)
    factors = [x.name for x in problem.group.factors] or [problem.group.name]
    held = {f"zeta_{a}" for a in (problem.lagrangian.held if problem.lagrangian else ())}
    velocity = [x for x in module_of(name).STATE if x.startswith(("zeta_", "w_"))]
    named = {*factors} <= {*schema()["groups"]}
    assert [x for x in found if x not in held] == (velocity if named else [])


def test_values_are_told_in_words_in_both_languages():
    words, values = options()["values"], CHOICES | REPEATED
    assert {x: [*y] for x, y in words.items()} == {x: [*values[x][0]] for x in words}
    assert {"jacobian", "step", "frame", "velocity"} <= {*words}
    said = [x for y in words.values() for x in y.values()]
    assert all(x["en"] and x["fr"] for x in said)
    assert all(x["en"] != x["fr"] for y in ("jacobian", "step") for x in words[y].values())


# ---- the notebook

NOTEBOOK = 'import { literal, notebook } from "./src/notebook.js";'
HOSTILE = [
    PENDULUM,
    "",
    "a",
    "'''",
    '"""',
    "x = '''a''' # \"\"\"b\"\"\"",
    "'edge'",
    '"edge"',
    "ends in '",
    'ends in "',
    "ends in \\",
    "\\n \\' \\\" \\\\ \\u0041 {x} %s $HOME",
    "x'''\n\"\"\"\\",
    "\"\"\"\"'''''",
    "'''\r\r\n\t\0\x7f\x85\ufeff\u202e\u2028\U000e0041é∑𝔤",
]


def test_a_text_of_any_kind_is_a_literal_of_python():
    """Read by Python, and whole in the source that a notebook would run."""
    for text, shown in zip(
        HOSTILE, in_node.told(NOTEBOOK, "given.map(literal)", HOSTILE), strict=True
    ):
        found = {}
        exec(f"x = {shown}", found)
        assert found["x"] == text
        assert shown.count("\n") == text.count("\n")
        if text == PENDULUM:
            assert shown == f"r'''{text}'''"


@pytest.fixture(scope="module")
def book():
    """The notebook of so3, as JSON."""
    given = {"text": text_of("so3"), "title": "A body, *fixed*"}
    return in_node.told(NOTEBOOK, 'notebook("so3", given.text, given.title)', given)


def test_a_notebook_derives_its_problem_and_writes_over_no_file(book, tmp_path, monkeypatch):
    title, problem, *_ = ("".join(x["source"]) for x in json.loads(book)["cells"])
    assert title.startswith("# A body, \\*fixed\\*\n")
    assert "in a clone of its repository: `pip install .`" in title
    monkeypatch.chdir(tmp_path)
    ran = {}
    exec(problem, ran)
    assert ran["problem"] == text_of("so3")
    assert f"problem = r'''{text_of('so3')}'''\n" in problem
    assert ran["d"].labels == derived("so3").labels
    assert not [*tmp_path.iterdir()]


def test_the_notebook_runs(book, tmp_path):
    need("the module nbclient", "the module nbformat", "the module ipykernel")
    import nbclient
    import nbformat

    read = nbformat.reads(book, as_version=4)
    nbformat.validate(read)
    runs = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(read, timeout=120, kernel_name="python3", resources=runs).execute()
    shown = {x.id: str(x.get("outputs", "")) for x in read.cells}
    assert "ζ" in shown["walk"] or "zeta" in shown["walk"]
    assert "every step holds" in shown["check"]
    assert "run of so3" in shown["motion"]
    assert "so3.c" in shown["code"]


# ---- what is completed

COMPLETED = """
import { CompletionContext } from "@codemirror/autocomplete";
import { EditorState } from "@codemirror/state";
import { completions } from "./src/completion.js";
const offered = (doc) => completions(given.schema)(
    new CompletionContext(EditorState.create({ doc }), doc.length, true));
"""
OFFERED = {
    'group = "SO(3)"\n[initial]\n': {"zeta_1", "zeta_3", "exp"},
    'group = "SE(3)"\n[initial]\n': {"zeta_3", "w_1", "w_3", "exp"},
    'group = "SE(3)"\n[lagrangian]\nL = "1"\n[initial]\n': {"zeta_6"},
    "[group]\n": {"name", "action", "basis"},
    "[algebra]\n": {"of", "basis", "brackets", "dimension"},
    "[inertia]\n": {"operator", "momentum", "U"},
    "[lagrangian]\n": {"L", "trivialisation"},
    "[fluid]\n": {"density", "forces"},
    "[[advected]]\n": {"name", "representation"},
    "[[event]]\n": {"when", "terminal"},
    "[[signal]]\n": {"input", "times", "values", "u"},
    "[[damping]]\n": {"coefficient", "on"},
    '[[potential]]\nkind = "spring"\nsti': {"stiffness"},
    '[[input]]\nkind = "force"\n': {"frame", "on"},
    "group = ": {"SO(2)", "SO(3)", "SO(8)", "Sp(4)", "U(4)"},
    '[[input]]\nkind = "': {"covector", "force"},
    '[[event]]\ndirection = "': {"rising", "falling", "both"},
    "[bo": {"body"},
    "[[poi": {"point"},
}
"""Text → some of what is offered at its end."""
NEVER = {"[bo": {"point"}, "[[poi": {"body"}, "group = ": {"linear"}}


def test_what_may_stand_there_is_offered():
    need("npm")
    built()
    found = in_node.told(
        COMPLETED,
        "given.texts.map((x) => offered(x)?.options.map((y) => y.label) ?? [])",
        {"schema": schema(), "texts": [*OFFERED]},
    )
    for (text, expected), labels in zip(OFFERED.items(), found, strict=True):
        assert expected <= {*labels}, text
        assert not ({"Sp(3)", "U(5)", "on = "} | NEVER.get(text, set())) & {*labels}, text


# ---- the addresses of problems


def test_the_pages_of_the_site_have_its_addresses():
    """What docs/conf.py packs, the playground unpacks, and what it packs itself is no shorter."""
    conf = runpy.run_path(str(ROOT / "docs" / "conf.py"))
    text = text_of("top") + "# Föppl, ζ and 🙂\n"
    imports = 'const { unpacked, packed } = await import("./src/link.js");'
    both = "[await unpacked(given[0]), await packed(given[1])]"
    read, own = in_node.told(imports, both, [conf["packed"](text), text])
    assert read == text
    assert len(conf["packed"](text)) <= len(own)


def test_help_is_printed_and_nothing_done():
    """By its module and by its file."""
    for how in (["-m", "playground.site"], [str(ROOT / "playground" / "site.py")]):
        done = subprocess.run(
            [sys.executable, *how, "--help"], cwd=ROOT, capture_output=True, text=True, timeout=30
        )
        assert done.returncode == 0
        assert done.stdout.startswith("usage:")
