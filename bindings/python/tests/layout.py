#!/usr/bin/python3
"""Print the size of every public struct and the offset of every field, as cffi and the numpy dtypes have them."""

import locus
from locus._ffi import ffi

DTYPES = {
    "locus_point32": locus.POINT32, "locus_text156": locus.TEXT156, "locus_seed": locus.SEED, "locus_cell_pair": locus.CELL_PAIR,
    "locus_pmq_group": locus.GROUP, "locus_alert": locus.ALERT,
}  # fmt: skip

typedefs, _, _ = ffi.list_types()
for name in typedefs:
    kind = ffi.typeof(name)
    if kind.kind != "struct" or kind.fields is None:
        continue
    dtype = DTYPES.get(name)
    print(name, ffi.sizeof(kind) if dtype is None else dtype.itemsize)
    for field, value in kind.fields:
        print(f"{name}.{field}", value.offset if dtype is None else dtype.fields[field][1])
