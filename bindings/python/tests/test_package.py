"""The package: made from the headers as they are, finds its library, is typed, and its README runs."""

import ctypes.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import locus
import pytest

PACKAGE = Path(locus.__file__).parent
HERE = Path(__file__).resolve().parents[1]


def python(program, cwd="/", **variables):
    environment = {**os.environ, "PYTHONPATH": str(PACKAGE.parent), **variables}
    environment = {name: value for name, value in environment.items() if value is not None}
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, env=environment, cwd=cwd)


def test_the_generated_files_are_current():
    done = subprocess.run([sys.executable, HERE / "generate.py", "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_finds_the_library_where_it_is_told(tmp_path):
    library = Path(locus.LIBRARY_PATH).resolve()
    say = "import locus; print(locus.LIBRARY_PATH)"
    assert python(say, LOCUS_LIBRARY=str(library)).stdout.strip() == str(library)
    (tmp_path / "liblocus.so.0").symlink_to(library)
    assert python(say, LOCUS_LIBRARY=str(tmp_path)).stdout.strip() == str(tmp_path / "liblocus.so.0")
    assert python(say, LOCUS_LIBRARY=None, LD_LIBRARY_PATH=str(tmp_path)).stdout.strip() == "liblocus.so.0"
    shutil.copytree(PACKAGE, tmp_path / "beside" / "locus", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "beside" / "locus" / "liblocus.so.0").symlink_to(library)
    beside = python(say, LOCUS_LIBRARY=None, PYTHONPATH=str(tmp_path / "beside"))
    assert beside.stdout.strip() == str(tmp_path / "beside" / "locus" / "liblocus.so.0"), beside.stderr
    (tmp_path / "locus.pc").write_text(f"libdir={tmp_path}\nName: locus\nDescription: x\nVersion: 0.1.0\n")
    told = python(say, LOCUS_LIBRARY=None, PKG_CONFIG_PATH=str(tmp_path))
    assert told.stdout.strip() in (str(tmp_path / "liblocus.so.0"), "liblocus.so.0"), told.stderr


def test_says_when_there_is_no_library(tmp_path):
    none = python("import locus", LOCUS_LIBRARY=str(tmp_path / "none.so"))
    assert none.returncode != 0 and "LibraryError" in none.stderr and "none.so" in none.stderr
    other = python("import locus", LOCUS_LIBRARY="libm.so.6")
    assert "LibraryError: libm.so.6 is not liblocus" in other.stderr
    if ctypes.util.find_library("locus") is None:
        absent = python("import locus", LOCUS_LIBRARY=None, LD_LIBRARY_PATH=None, PKG_CONFIG_PATH=None)
        assert "liblocus.so.0 was not found" in absent.stderr and "set LOCUS_LIBRARY" in absent.stderr


@pytest.mark.parametrize("version, refused", [(0x7FFFFFFF, True), (1_00_00, True), (0, True), (99_99, False)])
def test_refuses_a_library_of_another_version(tmp_path, version, refused):
    source = tmp_path / "other.c"
    source.write_text(f"#include <stdint.h>\nuint32_t locus_version(void) {{ return {version}; }}\n")
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", tmp_path / "other.so"], check=True)
    done = python("import locus", LOCUS_LIBRARY=str(tmp_path / "other.so"))
    assert (("LibraryError" in done.stderr and "is version" in done.stderr) if refused else done.returncode == 0), done.stderr


def test_types():
    mypy = shutil.which("mypy", path="/usr/bin")
    if mypy is None:
        pytest.skip("mypy is not installed")
    done = subprocess.run([mypy, "--cache-dir", os.devnull, "--config-file", "pyproject.toml"], cwd=HERE, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_everything_named_is_documented():
    for name in locus.__all__:
        thing = getattr(locus, name)
        if not isinstance(thing, type) or issubclass(thing, int):
            continue
        assert thing.__doc__, name
        for member, value in vars(thing).items():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"


def test_the_readme_runs(tmp_path):
    text = (HERE / "README.md").read_text()
    programs = re.findall(r"^```python\n(.*?)^```\n(?:\nprints\n\n```text\n(.*?)^```)?", text, flags=re.M | re.S)
    assert programs
    for program, printed in programs:
        done = python(program, tmp_path)
        assert (done.returncode, done.stdout) == (0, printed), done.stderr
