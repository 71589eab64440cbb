#!/usr/bin/python3
"""The C interface as the public headers declare it: functions, structs and constants, for generators and tests of the bindings.

interface.py [--layout] HEADER_FOLDER   the interface as JSON; with --layout a C program that prints the layout of every struct
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from typing import Any


def text_of(folder: str) -> str:
    """All public C headers, each after those it includes, without comments and preprocessor lines but #define and #pragma pack."""
    seen: list[str] = []

    def visit(name: str) -> None:
        if name in seen:
            return
        with open(os.path.join(folder, "locus", name), encoding="utf-8") as file:
            text = file.read()
        for included in re.findall(r"#include <locus/([a-z_]+\.h)>", text):
            visit(included)
        if name not in seen:
            seen.append(name)

    for name in sorted(os.listdir(os.path.join(folder, "locus"))):
        if name.endswith(".h"):
            visit(name)
    parts = []
    for name in seen:
        with open(os.path.join(folder, "locus", name), encoding="utf-8") as file:
            parts.append(f"/* {name} */\n" + re.sub(r"/\*.*?\*/|//[^\n]*", " ", file.read(), flags=re.S))
    return "\n".join(parts)


def constants_of(text: str, folder: str) -> dict[str, int | float]:
    """The values of the LOCUS_ constants, from the C compiler."""
    names = [
        name
        for name in re.findall(r"^#define (LOCUS_[A-Z0-9_]+)[ \t]+\S", text, flags=re.M)
        if name not in ("LOCUS_API", "LOCUS_NOEXCEPT")
    ]
    program = ["#include <stdio.h>", *includes(folder), "int main(void) {"]
    for name in names:
        program.append(
            f'    _Generic(({name}), double: printf("{name} %.17g\\n", (double)({name})),'
            f' uint64_t: printf("{name} %llu\\n", (unsigned long long)({name})),'
            f' default: printf("{name} %lld\\n", (long long)({name})));'
        )
    printed = run_c("\n".join([*program, "}"]), folder)
    values: dict[str, int | float] = {}
    for line in printed.splitlines():
        name, value = line.split()
        values[name] = float(value) if re.search(r"[.e]", value) else int(value)
    return values


def includes(folder: str) -> list[str]:
    names = sorted(name for name in os.listdir(os.path.join(folder, "locus")) if name.endswith(".h"))
    return [f"#include <locus/{name}>" for name in names]


def run_c(program: str, folder: str) -> str:
    """What a C program prints."""
    with tempfile.TemporaryDirectory() as work:
        source, binary = os.path.join(work, "program.c"), os.path.join(work, "program")
        with open(source, "w", encoding="utf-8") as file:
            file.write(program)
        compiler = os.environ.get("CC", "cc")
        subprocess.run([compiler, "-std=c11", "-w", "-I", folder, source, "-o", binary], check=True)
        return subprocess.run([binary], check=True, capture_output=True, text=True).stdout


def declarations_of(text: str) -> str:
    """The declarations alone: no preprocessor lines, no C++, no attributes; what a C parser without a preprocessor takes."""
    text = re.sub(r"^#ifdef __cplusplus.*?^#endif$", "", text, flags=re.M | re.S)
    text = re.sub(r"^\s*#.*$", "", text, flags=re.M)
    text = re.sub(r"\bLOCUS_API\b|\bLOCUS_NOEXCEPT\b", "", text)
    text = re.sub(r"\s+", " ", text)
    return re.sub(r" ([;,)])", r"\1", text).strip()


def structs_of(declarations: str) -> dict[str, list[dict[str, Any]]]:
    """The public structs with their fields in order: name, type, and how many for an array."""
    structs: dict[str, list[dict[str, Any]]] = {}
    for body, name in re.findall(r"typedef struct locus_[a-z0-9_]+ \{(.*?)\} (locus_[a-z0-9_]+);", declarations):
        fields: list[dict[str, Any]] = []
        for line in filter(None, (part.strip() for part in body.split(";"))):
            match = re.fullmatch(r"((?:const )?[a-z0-9_]+ ?\**) ?(.*)", line)
            if not match:
                raise SystemExit(f"interface.py: cannot read the field '{line}' of {name}")
            for field in match.group(2).split(","):
                stars, bare, count = re.fullmatch(r"\s*(\**)(\w+)(?:\[(\w+)\])?", field).groups()  # type: ignore[union-attr]
                kind = (match.group(1).strip() + stars).replace(" *", "*")
                fields.append({"name": bare, "type": kind, "count": int(count) if count else None})
        structs[name] = fields
    return structs


def packed_of(text: str) -> dict[str, int]:
    """The structs between #pragma pack lines, and their alignment."""
    regions = re.findall(r"#pragma pack\(push, (\d+)\)(.*?)#pragma pack\(pop\)", text, flags=re.S)
    return {name: int(pack) for pack, body in regions for name in re.findall(r"\} (locus_\w+);", body)}


def functions_of(declarations: str) -> dict[str, dict[str, Any]]:
    """The functions: what they return and their parameters."""
    functions: dict[str, dict[str, Any]] = {}
    bare = re.sub(r"typedef [^;{]*;|typedef struct \w+ \{[^}]*\} \w+;", "", declarations)
    for result, name, parameters in re.findall(r"([\w ]+?[ *]+)(locus_\w+)\(([^()]*)\)", bare):
        functions[name] = {
            "returns": result.strip(),
            "parameters": [] if parameters.strip() == "void" else [one.strip() for one in parameters.split(",")],
        }
    return functions


def callbacks_of(declarations: str) -> dict[str, dict[str, Any]]:
    found = re.findall(r"typedef ([\w ]+?)\(\*(locus_\w+)\)\(([^()]*)\)", declarations)
    return {
        name: {"returns": result.strip(), "parameters": [one.strip() for one in parameters.split(",")]}
        for result, name, parameters in found
    }


def layout_program(structs: dict[str, list[dict[str, Any]]], folder: str) -> str:
    """A C (and C++) program that prints `struct size` and `struct.field offset` lines."""
    lines = ["#include <stddef.h>", "#include <stdio.h>", *includes(folder), "int main(void) {"]
    for struct, fields in structs.items():
        lines.append(f'    printf("{struct} %zu\\n", sizeof({struct}));')
        for field in fields:
            name = field["name"]
            lines.append(f'    printf("{struct}.{name} %zu\\n", offsetof({struct}, {name}));')
    return "\n".join([*lines, "    return 0;", "}"]) + "\n"


def interface_of(folder: str) -> dict[str, Any]:
    text = text_of(folder)
    declarations = declarations_of(text)
    return {
        "declarations": declarations,
        "constants": constants_of(text, folder),
        "structs": structs_of(declarations),
        "packed": packed_of(text),
        "functions": functions_of(declarations),
        "callbacks": callbacks_of(declarations),
    }


def keep(folder: str, files: dict[str, str]) -> int:
    """Write generated files, names to texts, below a binding's folder; with --check compare them: 1 where one is stale. Its generate.py ends with it."""
    stale = 0
    binding = os.path.basename(folder)
    for name, text in files.items():
        path = os.path.join(folder, name)
        if "--check" not in sys.argv:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            continue
        with open(path, encoding="utf-8") as file:
            if file.read() != text:
                print(f"bindings/{binding}/{name} is not what the headers say: run bindings/{binding}/generate.py")
                stale = 1
    return stale


def main() -> None:
    arguments = sys.argv[1:]
    layout = "--layout" in arguments
    folder = [one for one in arguments if one != "--layout"][0]
    if layout:
        sys.stdout.write(layout_program(structs_of(declarations_of(text_of(folder))), folder))
    else:
        json.dump(interface_of(folder), sys.stdout, indent=1)


if __name__ == "__main__":
    main()
