#!/usr/bin/python3
"""tests/abi/cuda.py LIBRARY VERSION: liblocus_cuda.so exports its entry alone, which bears the version; it needs no library of CUDA; and
it holds machine code for compute capability 8.0 and 9.0, and PTX for newer GPUs."""
import struct
import subprocess
import sys

MAGIC = struct.pack("<I", 0xBA55ED50)  # of a fat binary: 16 bytes, then entries of a head and a payload
KINDS = {1: "PTX", 2: "machine code"}


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def fat_binaries(data):
    """What each fat binary holds: (kind, compute capability)."""
    at = data.find(MAGIC)
    while at >= 0:
        head, size = struct.unpack_from("<HQ", data, at + 6)
        place, end, held = at + head, at + head + size, set()
        while place < end:
            kind, head, payload = struct.unpack_from("<HxxIQ", data, place)
            (arch,) = struct.unpack_from("<I", data, place + 28)
            held.add((KINDS.get(kind, kind), arch))
            place += head + payload
        yield held
        at = data.find(MAGIC, end)


def main(library, version):
    failures = []
    entry = "locus_cuda_" + version.replace(".", "_")
    exported = [line.split()[2] for line in output("nm", "-D", "--defined-only", library).splitlines()]
    if exported != [entry]:
        failures.append(f"exports {exported}, not {entry} alone")
    needed = [line.split("[")[1].rstrip("]") for line in output("readelf", "-dW", library).splitlines() if "(NEEDED)" in line]
    failures += [f"needs {name}" for name in needed if "cuda" in name or "nv" in name]
    with open(library, "rb") as file:
        binaries = [held for held in fat_binaries(file.read()) if any(kind == "PTX" for kind, _ in held)]
    wanted = {("machine code", 80), ("machine code", 90), ("PTX", 90)}
    failures += [f"a fat binary lacks {sorted(wanted - held)}" for held in binaries if wanted - held]
    if not binaries:
        failures.append("holds no PTX")
    for failure in failures:
        print(f"{library} {failure}")
    if not failures:
        print(f"{library}: {entry}; {len(binaries)} fat binaries, each with {sorted(wanted)}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
