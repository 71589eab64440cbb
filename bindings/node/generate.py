#!/usr/bin/python3
"""Write what the package takes from the public headers: lib/interface.js, the constants, structs, functions and callbacks.

generate.py [--check]    --check writes nothing and fails where the file is not what the headers say
"""

import os
import re
import sys
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.dirname(HERE))
from interface import interface_of, keep  # noqa: E402

HEADER = "// Made from the public headers by bindings/node/generate.py: run that, do not edit.\n"
SIZES = {"char": 1, "uint16_t": 2, "int32_t": 4, "uint32_t": 4, "float": 4, "uint64_t": 8, "int64_t": 8, "double": 8}


def kind_of(interface: dict[str, Any], kind: str) -> str:
    """A field's type: a number's, a struct's name, or `pointer`."""
    return "pointer" if kind.endswith("*") or kind in interface["callbacks"] else kind


def layouts(interface: dict[str, Any]) -> dict[str, Any]:
    """Size, alignment and fields of every struct, by the rules of C on 64-bit machines."""
    made: dict[str, Any] = {}
    for name, fields in interface["structs"].items():
        most, offset, alignment = interface["packed"].get(name, 8), 0, 1
        places = {}
        for field in fields:
            kind = kind_of(interface, field["type"])
            size = 8 if kind == "pointer" else made[kind]["size"] if kind in made else SIZES[kind]
            align = min(most, made[kind]["alignment"] if kind in made else size)
            offset = (offset + align - 1) // align * align
            places[field["name"]] = (kind, offset, field["count"] or 1)
            offset += size * (field["count"] or 1)
            alignment = max(alignment, align)
        size = (offset + alignment - 1) // alignment * alignment
        made[name] = {"size": size, "alignment": alignment, "fields": places}
    return made


def koffi_type(parameter: str) -> str:
    """How koffi passes a parameter: text, an address, or the number it is."""
    parameter = parameter.strip()
    if re.match(r"const char ?\*", parameter):
        return "str"
    if "*" in parameter or "[" in parameter or re.match(r"locus_\w+_fn\b", parameter):
        return "void *"
    return parameter.split()[0].replace("locus_status", "int32_t")


def exported(version_script: str) -> list[str]:
    with open(os.path.join(ROOT, "src", version_script), encoding="utf-8") as file:
        return re.findall(r"^ *(locus_[a-z0-9_]+);", file.read(), flags=re.M)


def interface_module(interface: dict[str, Any]) -> str:
    lines = [HEADER, "/** The constants of the C headers, which tell what each means. */", "export const CONSTANTS = {"]
    for name, value in interface["constants"].items():
        big = isinstance(value, int) and abs(value) > 2**53 - 1
        lines.append(f"  {name.removeprefix('LOCUS_')}: {value}{'n' if big else ''},")
    lines += ["};", "", "/** The structs: size, and type, offset and count of each field. */", "export const STRUCTS = {"]
    for name, layout in layouts(interface).items():
        lines += [f"  {name}: {{", f"    size: {layout['size']},", "    fields: {"]
        lines += [f"      {field}: ['{kind}', {offset}, {count}]," for field, (kind, offset, count) in layout["fields"].items()]
        lines += ["    },", "  },"]
    lines += ["};", "", "/** The functions: their library, what they return and what they take. */", "export const FUNCTIONS = {"]
    maps = sorted(name for name in os.listdir(os.path.join(ROOT, "src")) if name.endswith(".map"))
    libraries = {name: one.removesuffix(".map") for one in maps for name in exported(one)}
    for name, function in interface["functions"].items():
        taken = ", ".join(f"'{koffi_type(one)}'" for one in function["parameters"])
        lines.append(f"  {name}: ['{libraries[name]}', '{koffi_type(function['returns'])}', [{taken}]],")
    lines += ["};", "", "/** The callbacks: what they return and what they are given. */", "export const CALLBACKS = {"]
    for name, callback in interface["callbacks"].items():
        taken = ", ".join(f"'{koffi_type(one)}'" for one in callback["parameters"])
        lines.append(f"  {name}: ['{koffi_type(callback['returns'])}', [{taken}]],")
    return "\n".join([*lines, "};"]) + "\n"


def main() -> int:
    return keep(HERE, {"lib/interface.js": interface_module(interface_of(os.path.join(ROOT, "include")))})


if __name__ == "__main__":
    sys.exit(main())
