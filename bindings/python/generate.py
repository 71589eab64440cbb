#!/usr/bin/python3
"""Write what the package takes from the public headers: locus/_ffi.py (cffi), locus/constants.py and locus/_structs.py.

generate.py [--check]    --check writes nothing and fails where a file is not what the headers say
"""

import contextlib
import io
import os
import re
import sys
import tempfile

import cffi

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.dirname(HERE))
from interface import interface_of, keep  # noqa: E402

# Prefixes of constants that become an IntEnum; a constant with another prefix is a plain number.
ENUMS = {
    "LOG": "LogLevel", "ALERT": "AlertKind", "WEIGHT": "WeightRule", "MATERIAL": "Material", "WORD": "Word", "BACKEND": "Backend", "SIMD": "Simd",
    "ENGINE": "Engine", "PLACE": "Metric", "METHOD": "Method", "RECORD": "Record", "LAYOUT": "Layout", "INDEX": "Index",
    "FUTURE": "Future", "FIELD": "Field", "SYNC": "Sync", "RECORDS": "RecordsFormat", "TIME": "TimeUnit", "BAD_LINES": "BadLines", "VOXEL": "Voxel",
    "VOLUME": "VolumeFormat", "COLD_SYNC": "ColdSync", "COLD_FULL": "ColdFull",
}  # fmt: skip
# Structs that calls fill in: frozen dataclasses without the size and the spare fields.
FILLED = re.compile(r"locus_(\w+_(?:info|stats|recovery))$")
HEADER = "# Made from the public headers by bindings/python/generate.py: run that, do not edit.\n"
PYTHON_TYPES = {"double": "float", "float": "float"}


def ffi_module(interface: dict) -> str:  # type: ignore[type-arg]
    """The declarations as cffi keeps them for its ABI mode: no compiler and no parser is needed to import them."""
    ffi = cffi.FFI()
    declarations = interface["declarations"]
    # cffi knows no other packing in a module; where another one would lay fields out otherwise, tests/bindings/layout.sh sees it.
    for name in interface["packed"]:
        found = re.search(rf"typedef struct {name} \{{[^}}]*\}} {name};", declarations)
        assert found, name
        ffi.cdef(found.group(0), pack=1)
        declarations = declarations.replace(found.group(0), "")
    ffi.cdef(declarations)
    ffi.set_source("locus._ffi", None)
    with tempfile.TemporaryDirectory() as work:
        path = os.path.join(work, "_ffi.py")
        with contextlib.redirect_stdout(io.StringIO()):
            ffi.emit_python_code(path)
        with open(path, encoding="utf-8") as file:
            return HEADER + file.read()


def constants_module(interface: dict) -> str:  # type: ignore[type-arg]
    """The LOCUS_ constants without their prefix, those that belong together as an IntEnum."""
    groups: dict[str, list[tuple[str, int]]] = {}
    plain: list[str] = []
    for name, value in interface["constants"].items():
        short = name.removeprefix("LOCUS_")
        prefix = next((one for one in sorted(ENUMS, key=len, reverse=True) if short.startswith(one + "_")), None)
        if prefix:
            member = short.removeprefix(prefix + "_")
            groups.setdefault(prefix, []).append((f"BITS_{member}" if member[0].isdigit() else member, value))
        else:
            plain.append(f"{short}: Final = {value!r}")
    lines = [HEADER + '"""The constants of the C headers, which tell what each means."""', "", "from enum import IntEnum"]
    lines += ["from typing import Final", "", *plain]
    for prefix, members in groups.items():
        lines += ["", "", f"class {ENUMS[prefix]}(IntEnum):", f'    """LOCUS_{prefix}_."""', ""]
        lines += [f"    {member} = {value}" for member, value in members]
    return "\n".join(lines) + "\n"


def structs_module(interface: dict) -> str:  # type: ignore[type-arg]
    """A frozen dataclass for every struct that calls fill in."""
    lines = [HEADER + '"""What calls report, as dataclasses; the C headers tell what each field means."""', ""]
    lines += ["from dataclasses import dataclass"]
    for struct, fields in interface["structs"].items():
        match = FILLED.match(struct)
        if not match:
            continue
        name = "".join(part.capitalize() for part in match.group(1).split("_"))
        lines += ["", "", "@dataclass(frozen=True)", f"class {name}:", f'    """{struct}."""', ""]
        for field in fields:
            if field["name"] == "struct_size" or field["name"].startswith("reserved"):
                continue
            kind = PYTHON_TYPES.get(field["type"], "int")
            if field["type"] not in ("double", "float", "uint64_t", "int64_t", "uint32_t", "int32_t"):
                raise SystemExit(f"generate.py: no Python type for {field['type']} {struct}.{field['name']}")
            lines.append(f"    {field['name']}: {f'tuple[{kind}, ...]' if field['count'] else kind}")
    return "\n".join(lines) + "\n"


def main() -> int:
    interface = interface_of(os.path.join(ROOT, "include"))
    return keep(HERE, {
        "locus/_ffi.py": ffi_module(interface),
        "locus/constants.py": constants_module(interface),
        "locus/_structs.py": structs_module(interface),
    })


if __name__ == "__main__":
    sys.exit(main())
