"""The clock of the playground's worker: of what is silent, not of what is long. With a worker and a
time that the test has made."""

import json

from tests.page.test_motion_page import run_in_node
from tests.support.needs import need
from tests.support.playground_site import OWN

SCRIPT = """
let now = 0, timers = [], worker;
globalThis.performance = {{ now: () => now }};
globalThis.setTimeout = (does, after) => {{
    const timer = {{ does, at: now + after }};
    timers.push(timer);
    return timer;
}};
globalThis.clearTimeout = (timer) => {{ timers = timers.filter((x) => x !== timer); }};
globalThis.Worker = class {{
    constructor() {{ worker = this; this.hear = {{}}; this.ended = false; }}
    addEventListener(kind, does) {{ this.hear[kind] = does; }}
    postMessage(data) {{ this.asked = data; }}
    terminate() {{ this.ended = true; }}
    say(kind) {{ this.hear.message({{ data: {{ kind, id: this.asked?.id, news: {{}} }} }}); }}
}};
const settled = () => new Promise((resolve) => setImmediate(resolve));
async function until(t) {{
    for (const x of timers.filter((y) => y.at <= t).sort((a, b) => a.at - b.at)) {{
        now = x.at;
        if (timers.includes(x)) {{ clearTimeout(x); x.does(); }}
    }}
    now = t;
    await settled();
}}
const {{ Engine }} = await import({engine});
const engine = new Engine({{ seconds: 60 }}), heard = [];
let how = "";
engine.ask({{ ask: "check" }}, (kind) => heard.push(kind)).then((x) => {{ how = x; }});
await until(1000);
worker.say("ready");
await settled();
const told = [];
for (const t of {verdicts}) {{
    await until(1000 + 1000 * t);
    told.push(how);
    worker.say("verdict");
}}
{ends}
await settled();
console.log(JSON.stringify({{ told, how, heard: heard.length, clocks: timers.length }}));
"""


def clocked(tmp_path, verdicts, ends):
    """What a check says that tells a verdict at some seconds and then does something."""
    need("node")
    (tmp_path / "package.json").write_text('{"type": "module"}')
    engine = json.dumps((OWN / "src" / "engine.js").as_uri())
    text = SCRIPT.format(engine=engine, verdicts=json.dumps(verdicts), ends=ends)
    return json.loads(run_in_node(tmp_path, text))


def test_a_check_that_tells_verdicts_goes_on(tmp_path):
    """Ten minutes of a slow machine, of which none is silent."""
    verdicts = [*range(50, 650, 50)]
    found = clocked(tmp_path, verdicts, 'worker.say("end");')
    assert found == {"told": [""] * 12, "how": "end", "heard": 12, "clocks": 0}


def test_a_check_that_is_silent_ends(tmp_path):
    found = clocked(tmp_path, [50], "await until(1000 + 1000 * 109); told.push(how);")
    assert found["told"] == ["", ""]
    found = clocked(tmp_path, [50], "await until(1000 + 1000 * 111);")
    assert (found["how"], found["heard"]) == ("late", 1)
    found = clocked(tmp_path, [], "await until(1000 + 1000 * 61);")
    assert found["how"] == "late"
