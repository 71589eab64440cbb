"""Records for a store from CSV or newline-delimited JSON, zstd-compressed or not (liblocus_io)."""

import os
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ._callbacks import Callbacks, c_callback
from ._ffi import ffi
from ._guard import Guard
from ._library import check_io, io_library, text
from ._structs import RecordsStats
from ._values import Array, empty_struct, enum_value, filled, filled_options, pointer
from .constants import BadLines, Record, RecordsFormat, TimeUnit
from .pmq import DTYPES


@c_callback("void(uint64_t, const char *, void *)")
def _on_bad_line(line: int, reason: Any, user: Any) -> None:
    kept = ffi.from_handle(user)
    if kept.raised is None:
        kept.functions["bad_line"](line, text(reason))


class Records:
    """A reader of rows: iterating over it gives arrays of at most `batch` records, in the order of the rows.

    Parameters
    ----------
    source : path-like or int
        A file, or an open descriptor such as 0 for standard input, which stays the caller's.
    record : Record or str
        The layout of the records.
    batch : int
        Most records of an array.
    format : RecordsFormat or str
    time_unit : TimeUnit or str
        What numbers in the time column are.
    separator : str
        Of CSV fields.
    max_line : int, optional
        Bytes; a longer line is a bad one.
    time_column, latitude_column, longitude_column, text_column : str, optional
        By default the usual names.
    refuse_bad_lines : bool
        A bad line is a `FormatError` instead of being counted.
    bad_line : callable, optional
        ``bad_line(line, reason)`` is told each bad line.
    """

    def __init__(
        self, source: str | os.PathLike[str] | int, record: Record | str = Record.TEXT156, *, batch: int = 65536,
        format: RecordsFormat | str = RecordsFormat.AUTO, time_unit: TimeUnit | str = TimeUnit.AUTO, separator: str = ",",
        max_line: int | None = None, time_column: str | None = None, latitude_column: str | None = None,
        longitude_column: str | None = None, text_column: str | None = None, refuse_bad_lines: bool = False,
        bad_line: Callable[[int, str], object] | None = None,
    ) -> None:  # fmt: skip
        self._io = io_library()
        kind = enum_value(Record, record)
        self._dtype, self._batch = DTYPES[Record(kind)], batch
        self._guard = Guard("Records")
        self._callbacks = Callbacks(bad_line=bad_line)
        columns = {"time": time_column, "latitude": latitude_column, "longitude": longitude_column, "text": text_column}
        names = {f"{name}_column": ffi.new("char[]", given.encode()) for name, given in columns.items() if given is not None}
        options = filled_options(
            "locus_records_options", self._io.locus_records_options_init, check_io, record=kind,
            format=enum_value(RecordsFormat, format), time_unit=enum_value(TimeUnit, time_unit), separator=ord(separator),
            max_line=max_line, bad_lines=BadLines.REFUSE if refuse_bad_lines else BadLines.COUNT, **names,
        )  # fmt: skip
        if bad_line is not None:
            options.bad_line, options.bad_line_user = _on_bad_line, self._callbacks.handle
        made = ffi.new("locus_records **")
        if isinstance(source, int):
            check_io(self._io.locus_records_open_fd(source, f"descriptor {source}".encode(), options, made))
        else:
            check_io(self._io.locus_records_open(os.fsencode(source), options, made))
        self._handle = ffi.gc(made[0], self._io.locus_records_close)

    def read(self, most: int | None = None) -> Array:
        """Read at most so many records (by default `batch`); an empty array is the end."""
        array = np.empty(self._batch if most is None else most, self._dtype)
        count = ffi.new("size_t *")
        with self._guard.writing():
            status = self._io.locus_records_next(self._handle, pointer(array), len(array), count)
            self._callbacks.settle(status, check_io)
        return array[: count[0]]

    def __iter__(self) -> Iterator[Array]:
        while len(array := self.read()) > 0:
            yield array

    @property
    def stats(self) -> RecordsStats:
        """How far the reader is."""
        stats = empty_struct("locus_records_stats")
        with self._guard.reading():
            check_io(self._io.locus_records_get_stats(self._handle, stats))
        return filled(RecordsStats, stats)
