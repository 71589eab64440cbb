#!/usr/bin/python3
"""Write the declarations of locus-sys from the public headers: locus-sys/src/*.rs and locus-sys/examples/layout.rs, as rustfmt has them.

generate.py [--check]    --check writes nothing and fails where a file is not what the headers say
"""

import os
import re
import shutil
import subprocess
import sys
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.dirname(HERE))
from interface import interface_of, keep  # noqa: E402

HEADER = "// Made from the public headers by bindings/rust/generate.py: run that, do not edit.\n"
TYPES = {
    "uint64_t": "u64", "int64_t": "i64", "uint32_t": "u32", "int32_t": "i32", "uint16_t": "u16", "int16_t": "i16", "uint8_t": "u8",
    "size_t": "usize", "double": "f64", "float": "f32", "int": "c_int", "void": "c_void", "char": "c_char",
}  # fmt: skip
KEYWORDS = {"type", "box", "in", "ref", "where", "match", "move", "use", "loop"}


def name_of(name: str) -> str:
    return f"r#{name}" if name in KEYWORDS else name


def type_of(text: str) -> str:
    """The Rust type of a C type such as `const locus_seed *` or `locus_graph **`."""
    match = re.fullmatch(r"(const )?(\w+) ?(\**)", text.strip())
    if not match:
        raise SystemExit(f"generate.py: no Rust type for '{text}'")
    const, base, stars = match.groups()
    kind = TYPES.get(base, base)
    for depth in range(len(stars)):
        kind = f"*{'const' if const and depth == 0 else 'mut'} {kind}"
    return kind


def signature(one: dict[str, Any]) -> str:
    """The parameters and the result; an array parameter is a pointer."""
    parameters = []
    for text in one["parameters"]:
        match = re.fullmatch(r"(.*?[ *])(\w+)(\[\d+\])?", text)
        if not match:
            raise SystemExit(f"generate.py: cannot read the parameter '{text}'")
        parameters.append(f"{name_of(match.group(2))}: {type_of(match.group(1) + ('*' if match.group(3) else ''))}")
    result = "" if one["returns"] == "void" else f" -> {type_of(one['returns'])}"
    return f"({', '.join(parameters)}){result}"


def constant(name: str, value: int | float) -> str:
    if isinstance(value, float):
        return f"pub const {name}: f64 = {value!r};"
    if re.match(r"LOCUS_(E_|OK$|LOG_)", name):
        kind = "i32"
    elif value < 0 or value == 2**63 - 1:
        kind = "i64"
    else:
        kind = "u32" if value < 2**32 else "u64"
    return f"pub const {name}: {kind} = {value};"


def struct(name: str, fields: list[dict[str, Any]], packed: dict[str, int], callbacks: dict[str, Any]) -> list[str]:
    plain = all("*" not in field["type"] and field["type"] not in callbacks for field in fields)
    plain = plain and not any(field["type"] == "locus_polygon" for field in fields)
    lines = [f"#[repr(C{f', packed({packed[name]})' if name in packed else ''})]"]
    lines += [f"#[derive(Clone, Copy, Debug{', PartialEq' if plain else ''})]", f"pub struct {name} {{"]
    for field in fields:
        kind = "u8" if field["type"] == "char" else type_of(field["type"])  # text is bytes, not numbers with a sign
        lines.append(f"    pub {name_of(field['name'])}: {f'[{kind}; ' + str(field['count']) + ']' if field['count'] else kind},")
    return [*lines, "}", f"zeroed!({name});", ""]


def exported(version_script: str) -> set[str]:
    with open(os.path.join(ROOT, "src", version_script), encoding="utf-8") as file:
        return set(re.findall(r"^ *(locus_\w+);", file.read(), flags=re.M))


def bound(interface: dict[str, Any], version_script: str) -> dict[str, Any]:
    names = exported(version_script)
    return {name: one for name, one in interface["functions"].items() if name in names}


LIBRARY = """//! The C interface of liblocus as its headers declare it; they tell what everything means.
#![no_std]
#![allow(non_camel_case_types)]
extern crate std;
#[cfg(feature = "cold")]
mod cold;
mod constants;
mod functions;
mod structs;
#[cfg(feature = "cold")]
pub use cold::*;
pub use constants::*;
pub use functions::*;
pub use structs::*;
"""

STRUCTS = """//! The types, those of liblocus_io and liblocus_cold too.
use std::os::raw::{c_char, c_void};

macro_rules! zeroed {
    ($name:ident) => {
        impl Default for $name {
            /// All zero.
            fn default() -> Self {
                // SAFETY: numbers, pointers and optional functions, for which zero is a value.
                unsafe { core::mem::zeroed() }
            }
        }
    };
}

pub type locus_status = i32;
"""


def types(interface: dict[str, Any], functions: dict[str, Any]) -> str:
    structs, callbacks = interface["structs"], interface["callbacks"]
    lines = [HEADER + STRUCTS]
    words = set(re.findall(r"\blocus_\w+", " ".join(str(one) for one in functions.values()) + str(structs) + str(callbacks)))
    for name in sorted(words - set(structs) - set(callbacks) - set(functions) - {"locus_status"}):
        lines += ["#[repr(C)]", f"pub struct {name} {{", "    _opaque: [u8; 0],", "    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,", "}", ""]
    lines += [f"pub type {name} = Option<unsafe extern \"C\" fn{signature(one)}>;" for name, one in callbacks.items()] + [""]
    for name, fields in structs.items():
        lines += struct(name, fields, interface["packed"], callbacks)
    return "\n".join(lines) + "\n"


def functions_of(functions: dict[str, Any], library: str) -> str:
    imports = ["use crate::structs::*;", "use std::os::raw::{c_char, c_void};", ""]
    declared = [f"pub fn {name}{signature(one)};" for name, one in functions.items()]
    return "\n".join([HEADER + f"//! The functions of {library}.", *imports, 'extern "C" {', *declared, "}"]) + "\n"


def formatted(text: str, rustfmt: str) -> str:
    """As rustfmt has it."""
    command = [rustfmt, "--edition", "2021", "--config-path", HERE, "--emit", "stdout"]
    return subprocess.run(command, input=text, check=True, capture_output=True, text=True).stdout


def constants(interface: dict[str, Any]) -> str:
    lines = [constant(name, value) for name, value in interface["constants"].items()]
    return "\n".join([HEADER + "//! The constants of the C headers, which tell what each means.", *lines]) + "\n"


def layout(interface: dict[str, Any]) -> str:
    """An example that prints `struct size` and `struct.field offset` lines, for tests/bindings/layout.sh."""
    lines = [HEADER + "//! Prints how the structs lie in memory.", "use locus_sys::*;", "", "macro_rules! offset {"]
    lines += ["    ($kind:ident, $field:ident) => {{", "        let whole = core::mem::MaybeUninit::<$kind>::uninit();", "        let start = whole.as_ptr();"]
    lines += ["        // SAFETY: only the address is taken.", "        unsafe { core::ptr::addr_of!((*start).$field) as usize - start as usize }", "    }};", "}", "", "fn main() {"]
    for name, fields in interface["structs"].items():
        lines.append(f'    println!("{name} {{}}", core::mem::size_of::<{name}>());')
        for field in fields:
            lines.append(f'    println!("{name}.{field["name"]} {{}}", offset!({name}, {name_of(field["name"])}));')
    return "\n".join([*lines, "}"]) + "\n"


def main() -> int:
    rustfmt = shutil.which("rustfmt")
    if rustfmt is None:
        print("generate.py: needs rustfmt, which is not there")
        return 0 if "--check" in sys.argv else 1
    interface = interface_of(os.path.join(ROOT, "include"))
    core, cold = bound(interface, "liblocus.map"), bound(interface, "liblocus_cold.map")
    files = {
        "locus-sys/src/lib.rs": HEADER + LIBRARY,
        "locus-sys/src/structs.rs": types(interface, {**core, **cold}),
        "locus-sys/src/functions.rs": functions_of(core, "liblocus"),
        "locus-sys/src/cold.rs": functions_of(cold, "liblocus_cold"),
        "locus-sys/src/constants.rs": constants(interface),
        "locus-sys/examples/layout.rs": layout(interface),
    }
    return keep(HERE, {name: formatted(text, rustfmt) for name, text in files.items()})


if __name__ == "__main__":
    sys.exit(main())
