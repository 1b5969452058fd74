"""JavaScript without a page, run by node."""

import json
import subprocess

from playground.site import OWN
from tests.support.needs import need


def printed(script):
    """What a module prints; its imports are relative to ``playground/``."""
    need("node")
    command = ["node", "--input-type=module", "-"]
    done = subprocess.run(command, cwd=OWN, input=script, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return done.stdout


def told(imports, expression, given=None):
    """The value of an expression, as JSON has it, after some imports and of what is ``given``."""
    lines = (imports, f"const given = {json.dumps(given)};")
    return json.loads(printed("\n".join((*lines, f"console.log(JSON.stringify({expression}));"))))
