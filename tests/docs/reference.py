#!/usr/bin/python3
"""The reference is whole: each function of the headers has a block of its own, or shares that of the declaration right above it, which
says what the function does, which errors it returns, what may run beside it (or the header says so for all) and since when it is there."""

import re
import sys
from pathlib import Path

DECLARATION = re.compile(r"((?:/\*(?:(?!\*/).)*\*/\n)?)LOCUS_API ([^;(]*?)\b(locus_\w+)\([^;]*\) LOCUS_NOEXCEPT;\n(\n?)", re.S)
ERRORS = re.compile(r"Errors?\b|LOCUS_E_|[Cc]annot fail")
THREADS = re.compile(r"[Tt]hread|[Bb]eside|As above|as above")


def faults(header: str, text: str) -> list[str]:
    shared = ""
    found = []
    common = re.search(r"\bThreads[.:]", text.split("LOCUS_API ")[0])
    for comment, returned, name, gap in DECLARATION.findall(text):
        block = " ".join(re.sub(r"^ \*(?!/)", " ", comment, flags=re.M).split()) or shared
        shared = "" if gap else block
        wants = {"a block": block, "`Since`": re.search(r"Since \d+\.\d+\.? \*/", block)}
        if "locus_status" in returned:
            wants["its errors"] = ERRORS.search(block)
        if not name.endswith(("_destroy", "_close")):
            wants["what may run beside it"] = common or THREADS.search(block)
        found += [f"{header}: {name} lacks {want}" for want, there in wants.items() if not there]
    return found


def main() -> int:
    headers = sorted(Path("include/locus").glob("*.h"))
    texts = {header.name: header.read_text(encoding="utf-8") for header in headers}
    found = [line for name, text in texts.items() for line in faults(name, text)]
    declared = sum(text.count("LOCUS_API ") for text in texts.values()) - texts["status.h"].count("define LOCUS_API ")
    read = sum(len(DECLARATION.findall(text)) for text in texts.values())
    if read != declared:
        found.append(f"{read} of {declared} declarations were read")
    print("\n".join(found) or f"reference: {read} functions have their blocks")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
