"""How the tests are run."""

import json
import os
import sys
from pathlib import Path

import pytest

from derive.check import checker
from tests.support import thorough
from tests.support.cached import DictOnDisk
from tests.support.needs import left_out
from tests.support.shared import made_once  # noqa: F401  (a fixture of all tests)

ALL = "DERIVE_ALL_TESTS"
"""What was asked for, for the processes of xdist, which cannot see what was typed."""


def pytest_addoption(parser):
    """``--share=N``: every N-th of what a quick run leaves out, as well; ``--thorough``: all.

    ``--quick``: of what is named on the command line, too, no more than in a quick run.
    ``--seed``: of the choice of cases.  ``--passed``: a file for the names of those that passed;
    ``--without``: such files, of tests that are left out.  ``--order``: files in an order by
    chance, and the tests of each.  ``--costs``: a folder for the seconds of each.
    """
    told = "of the tests that a quick run leaves out"
    parser.addoption("--share", metavar="N", type=int, help=f"every N-th {told}, too")
    parser.addoption("--thorough", action="store_true", help=f"all {told}, too, as make thorough")
    parser.addoption("--quick", action="store_true", help="of what is named, too, as make test")
    parser.addoption("--seed", default=thorough.SEED, help="of the choice of cases (%(default)s)")
    parser.addoption("--passed", metavar="FILE", help="the names of tests that passed, into a file")
    parser.addoption("--without", metavar="FILE", action="append", help="leave out what passed")
    parser.addoption("--costs", metavar="FOLDER", type=Path, help="seconds of the processor")
    parser.addoption("--order", metavar="SEED", help="files and their tests in an order by chance")


def pytest_configure(config):
    """Tests that are named on the command line are run whole; texts are as wide as where nobody
    says, which xdist does by COLUMNS."""
    os.environ.pop("COLUMNS", None)
    if hasattr(config, "workerinput"):
        return
    if config.getoption("--quick"):
        os.environ.pop(ALL, None)
    elif config.args_source is not config.ArgsSource.TESTPATHS:
        os.environ[ALL] = "named"
    elif config.getoption("--thorough"):
        os.environ[ALL] = "thorough"
    elif share := config.getoption("--share"):
        os.environ[ALL] = str(share)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    """Leave out what takes long, where nothing is named; of all tests it is not measured."""
    wanted, kept = os.environ.get(ALL), {*items}
    if wanted != "named":
        _, left = thorough.split(items, config.getoption("--seed"))
        each = 1 if wanted == "thorough" else int(wanted or 0)
        more, left = thorough.share(left, each)
        for item in more:
            item.add_marker("no_cover")
        kept -= {*left}
    if before := config.getoption("--without"):
        files = (Path(x) for x in before)
        passed = {x for y in files if y.exists() for x in json.loads(y.read_text(encoding="utf-8"))}
        kept = {x for x in kept if x.nodeid not in passed}
    if left := [x for x in items if x not in kept]:
        items[:] = [x for x in items if x in kept]
        config.hook.pytest_deselected(items=left)
    if order := config.getoption("--order"):
        items[:] = thorough.shuffled(items, order)


@pytest.fixture(autouse=True, scope="session")
def known_of_any_group():
    """What held for any group is tried once for these sources, not in each process again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checker, "_UNIVERSAL", DictOnDisk())
        yield


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_protocol(item):
    """The seconds of the processor of a test, of what is made ready for it and of the processes
    that it waits for, for ``--costs``."""
    before = sum(os.times()[:4])
    done = yield
    if folder := item.config.getoption("--costs"):
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / f"{os.getpid()}.jsonl").open("a", encoding="utf-8") as stream:
            stream.write(json.dumps([item.nodeid, round(sum(os.times()[:4]) - before, 3)]) + "\n")
    return done


def pytest_sessionfinish(session):
    """The names of what passed, for ``--without``."""
    config = session.config
    if (path := config.getoption("--passed")) and not hasattr(config, "workerinput"):
        stats = config.pluginmanager.get_plugin("terminalreporter").stats
        passed = [x.nodeid for x in stats.get("passed", ()) if x.when == "call"]
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text(json.dumps(passed), encoding="utf-8")


@pytest.hookimpl(wrapper=True, trylast=True)
def pytest_runtest_call(item):
    """``no_cover`` in the processes of xdist too, where a second tracer of coverage waits.

    For long tests that run again what others run: to measure them takes three times as long.  The
    processes that they start are not measured either.
    """
    if item.get_closest_marker("no_cover") is None:
        return (yield)
    tracer = sys.gettrace()
    sys.settrace(None)
    measured = os.environ.pop("COVERAGE_PROCESS_CONFIG", None)
    try:
        return (yield)
    finally:
        sys.settrace(tracer)
        if measured is not None:
            os.environ["COVERAGE_PROCESS_CONFIG"] = measured


@pytest.hookimpl(trylast=True)
def pytest_terminal_summary(terminalreporter):
    """The seed of the choice of cases, where one was made; what was left out and what brings it, in
    the line before the last."""
    if os.environ.get(ALL) not in ("named", "thorough"):
        seed = terminalreporter.config.getoption("--seed")
        terminalreporter.write_line(f"of long tests some cases, chosen by --seed={seed}")
    skipped = terminalreporter.stats.get("skipped", [])
    if line := left_out([report.longrepr[2] for report in skipped]):
        terminalreporter.write_line(line)
