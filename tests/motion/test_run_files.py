"""A run, written and read: every bit, the same bytes, and what is no run."""

import json
from pathlib import Path

import numpy as np
import pytest

from derive.command import simulating
from derive.command.cli import main
from derive.command.writing import WriteError, require_place
from derive.motion.emitted_code import Column
from derive.motion.run import FORMATS, Run, RunFileError, read, written
from tests.support.needs import need

COLUMNS = (Column("t", "time", "s"), Column("A_11", "state"), Column("energy", "energy", "J"))
TABLE = np.array([[0.0, 1.0, 1 / 3], [0.1, -0.0, 5e-324], [0.2, np.inf, np.nan]])
RUN = Run(COLUMNS, TABLE, {"problem": "so3", "parameters": {"I": 2.0}, "ended": ""})


@pytest.mark.parametrize("ending", FORMATS)
def test_a_run_is_read_back_to_the_bit(tmp_path, ending):
    if ending == ".parquet":
        need("the module pyarrow")
    path = tmp_path / f"run{ending}"
    path.write_bytes(written(RUN, path.name))
    found = read(path)
    assert found.table.tobytes() == TABLE.tobytes()
    assert (found.columns, found.facts) == (COLUMNS, RUN.facts)
    assert written(found, path.name) == path.read_bytes()


def test_columns_by_name_and_kind():
    assert RUN["energy"][0] == 1 / 3
    assert list(RUN.of_kind("state")) == ["A_11"]
    assert RUN.states.shape == (3, 1)
    with pytest.raises(KeyError, match="no column 'x'; there are t, A_11, energy"):
        RUN["x"]


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a.npz", b"PK"),
        ("a.npz", b""),
        ("a.csv", b""),
        ("a.csv", b"t,x\n0,1\n"),
        ("a.csv", b"# {}\nt\n0\n"),
        ("a.csv", b"\xff\xfe"),
        ("a.csv", b'# {"file": "derive run", "columns": [["t", "time", ""]], "facts": {}}\nt\nx\n'),
        ("a.csv", b'# {"file": "derive run", "columns": [], "facts": {}}\n\n'),
        ("a.parquet", b"PAR1"),
    ],
)
def test_a_foreign_file_is_told(tmp_path, name, data):
    if name.endswith("parquet"):
        need("the module pyarrow")
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(RunFileError, match="not a run that derive simulate wrote"):
        read(path)


def test_a_pickle_is_not_loaded(tmp_path):
    path = tmp_path / "evil.npz"
    np.savez(path, head=np.array([{}], dtype=object), table=TABLE)
    with pytest.raises(RunFileError, match="not a run"):
        read(path)


def test_files_that_are_not_there_or_have_no_format(tmp_path):
    with pytest.raises(RunFileError, match=r"x\.npz: No such file"):
        read(tmp_path / "x.npz")
    with pytest.raises(RunFileError, match=r"must end in \.npz, \.csv, \.parquet"):
        written(RUN, "run.txt")


def test_the_head_of_a_csv_is_json():
    head = written(RUN, "a.csv").decode().splitlines()[1].removeprefix("# ")
    assert json.loads(head)["facts"]["problem"] == "so3"


def test_a_csv_is_a_table_for_numpy(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(written(RUN, path.name))
    table = np.genfromtxt(path, delimiter=",", names=True)
    assert table.dtype.names == ("t_s", "A_11", "energy_J")
    assert np.array_equal(table["t_s"], TABLE[:, 0])


def test_a_csv_with_its_facts_in_the_first_line_is_read(tmp_path):
    first, second, rest = written(RUN, "a.csv").decode().split("\n", 2)
    path = tmp_path / "a.csv"
    path.write_text(f"{second}\n{first}\n{rest}", encoding="utf-8")
    assert read(path).table.tobytes() == TABLE.tobytes()


@pytest.mark.parametrize("place", ["file/x.npz", "file/new/x.npz", "folder.npz"])
@pytest.mark.parametrize("options", [[], ["--ensemble", "9", "--vary", "zeta_1=0:1"]])
def test_a_place_that_cannot_be_is_told_before_the_run(
    tmp_path, capsys, monkeypatch, place, options
):
    def never(*_, **__):
        raise AssertionError("it has begun")

    for name in ("derive", "run", "command_ensemble"):
        monkeypatch.setattr(simulating, name, never)
    (tmp_path / "file").write_text("a file")
    (tmp_path / "folder.npz").mkdir()
    out = tmp_path / place
    assert main(["simulate", "so3", "--t", "1", *options, "--out", str(out)]) == 2
    text, err = capsys.readouterr()
    assert (text, err.count("\n")) == ("", 1)
    assert err.startswith(f"derive: {out}: ")
    assert "choose another --out" in err
    assert sorted(x.name for x in tmp_path.rglob("*")) == ["file", "folder.npz"]


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="there is no /proc")
@pytest.mark.parametrize("option", ["--out", "--html"])
def test_a_folder_that_takes_no_file_is_told(capsys, option):
    file = "/proc/x.npz" if option == "--out" else "/proc/x.html"
    assert main(["simulate", "so3", "--t", "1", option, file]) == 2
    text, err = capsys.readouterr()
    assert (text, err.count("\n")) == ("", 1)
    assert err.startswith(f"derive: {file}: ")


def test_a_place_that_can_be_is_left_as_it_is(tmp_path):
    (tmp_path / "old.npz").write_text("old")
    for name in ("new.npz", "new/folder/x.npz", "old.npz"):
        require_place(tmp_path / name)
    assert [x.name for x in tmp_path.iterdir()] == ["old.npz"]
    assert (tmp_path / "old.npz").read_text() == "old"
    with pytest.raises(WriteError, match="Not a directory"):
        require_place(tmp_path / "old.npz" / "x.npz")
