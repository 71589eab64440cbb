"""The cold tier: what leaves a store goes into an SQLite database, and a query sees both (liblocus_cold)."""

import os
import threading
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from ._ffi import ffi
from ._guard import Guard
from ._library import check_cold, cold_library
from ._structs import ColdStats
from ._values import Array, empty_struct, enum_value, filled, filled_options, microseconds
from .constants import E_ARGUMENT, E_BUSY, E_STATE, ColdFull, ColdSync, Record
from .errors import error_for
from .pmq import DTYPES, Asked, Path, Query, Snapshot, Span, Store, Time


class Cold:
    """A database that takes over what leaves a store, in the background, and answers queries together with it.

    Make the tier first, then the store with ``Store(..., cold=tier)``. A question that is given the store, or a snapshot of it, is
    answered from both at one moment: each record that was inserted, and that retention has not removed, is in the answer once. Without
    a store it is the tier's alone. Any number of threads may ask. The tier ends, and writes what is queued, with the last reference to
    it and to its store; `flush` first to learn of failures.

    Parameters
    ----------
    path : path-like
        The database, which is made where there is none. One tier at a time has it open.
    record : Record or str
        The layout of the records, that of the store.
    sync : ColdSync or str
        How the file is made safe against loss of power.
    when_full : ColdFull or str
        Whether a change of the store waits while the queue is full, or raises `StoppedError`.
    max_age : int, timedelta64 or timedelta, optional
        How long a record is kept, see `sweep`; ints are microseconds.
    max_bytes : int, optional
        The file's pages in use; beyond, what came first goes.
    queue_bytes, batch_records, delay, run_records, cache_bytes : optional
        As in locus_cold_options.

    Raises
    ------
    LibraryError
        liblocus_cold, which needs SQLite, is not installed.
    IoError, FormatError, BusyError, ArgumentError
    """

    def __init__(
        self, path: Path, record: Record | str = Record.POINT32, *, sync: ColdSync | str = ColdSync.NORMAL,
        when_full: ColdFull | str = ColdFull.WAIT, max_age: Span | None = None, max_bytes: int | None = None,
        queue_bytes: int | None = None, batch_records: int | None = None, delay: Span | None = None,
        run_records: int | None = None, cache_bytes: int | None = None,
    ) -> None:  # fmt: skip
        self._cold = cold_library()
        kind = enum_value(Record, record)
        self._dtype = DTYPES[Record(kind)]
        options = filled_options(
            "locus_cold_options", self._cold.locus_cold_options_init, check_cold, record=kind, sync=enum_value(ColdSync, sync),
            when_full=enum_value(ColdFull, when_full), queue_bytes=queue_bytes, batch_records=batch_records,
            delay=None if delay is None else microseconds(delay), run_records=run_records, cache_bytes=cache_bytes,
            max_age=None if max_age is None else microseconds(max_age), max_bytes=max_bytes,
        )  # fmt: skip
        # Questions are readers; what stands alone (attaching, rewinding) is a writer.
        self._guard = Guard("Cold")
        self._inside: set[int] = set()
        self._store: Callable[[], Store | None] = lambda: None
        made = ffi.new("locus_cold **")
        check_cold(self._cold.locus_cold_open(os.fsencode(path), options, made))
        self._handle = ffi.gc(made[0], self._cold.locus_cold_close)

    def _attach(self, options: Any) -> None:
        """Be the sink of a store's options."""
        self._outside()
        with self._guard.writing():
            if self._store() is not None:
                raise error_for(E_STATE, "Cold: another store is attached", "LOCUS_E_STATE")
            check_cold(self._cold.locus_cold_attach(self._handle, options))

    def _attached(self, store: Store) -> None:
        self._store = weakref.ref(store)

    def _outside(self) -> None:
        """A function that the tier calls must not call into it, nor change its store."""
        if threading.get_ident() in self._inside:
            raise error_for(E_BUSY, "Cold: it is at work, and this is its callback", "LOCUS_E_BUSY")

    @contextmanager
    def _asking(self, store: Store | Snapshot | None, query: Query | None) -> Iterator[tuple[Asked, Any]]:
        """A question: yields the query for the call, and the store's handle."""
        self._outside()
        of = store._store if isinstance(store, Snapshot) else store
        if of is not None and of._cold is not self:
            raise error_for(E_ARGUMENT, "Cold: the store was made without this tier", "LOCUS_E_ARGUMENT")
        asked = Asked(query, None if store is None else store._snapshot, self._dtype)
        me = threading.get_ident()
        with self._guard.reading():
            self._inside.add(me)
            try:
                yield asked, ffi.NULL if of is None else of._handle
            finally:
                self._inside.discard(me)

    @property
    def dtype(self) -> np.dtype[Any]:
        """The dtype of the records: `POINT32` or `TEXT156`."""
        return self._dtype

    def count(self, store: Store | Snapshot | None = None, query: Query | None = None) -> int:
        """How many records the query selects in the store and in the tier."""
        with self._asking(store, query) as (asked, handle):
            return self._count(asked, handle)

    def _count(self, asked: Asked, store: Any) -> int:
        count = ffi.new("uint64_t *")
        asked.settle(self._cold.locus_cold_count(self._handle, store, asked.c, count), check_cold)
        return int(count[0])

    def read(self, store: Store | Snapshot | None = None, query: Query | None = None, out: Array | None = None) -> Array:
        """Copy them, in the store's order, and records of one place as they came.

        Parameters
        ----------
        store : Store or Snapshot, optional
        query : Query, optional
        out : ndarray, optional
            Memory for them, an array of the tier's dtype; too little is a `CapacityError`.

        Returns
        -------
        ndarray
            The records; with `out`, the part of it that was filled.
        """
        with self._asking(store, query) as (asked, handle):
            return asked.read(
                self._dtype, out, lambda: self._count(asked, handle),
                lambda *into: self._cold.locus_cold_read(self._handle, handle, asked.c, *into), check_cold,
            )  # fmt: skip

    def visit(
        self, visitor: Callable[[Any], object], store: Store | Snapshot | None = None, query: Query | None = None
    ) -> bool:
        """Show them to ``visitor(record)``, one by one and with bounded memory, until it returns False. True: all were shown.

        The visitor must not call into the tier or change the store: that is a `BusyError`.
        """
        with self._asking(store, query) as (asked, handle):
            return asked.visit(
                self._dtype, visitor, lambda *call: self._cold.locus_cold_visit(self._handle, handle, asked.c, *call), check_cold
            )

    def flush(self) -> None:
        """Wait until what has left the store by now is in the file. Records that cannot be written, as on a full disk, stay queued."""
        self._outside()
        check_cold(self._cold.locus_cold_flush(self._handle))

    def sweep(self, now: Time) -> None:
        """Set the tier's clock, which never runs back: records older than `max_age` are in no answer any more, and are removed."""
        self._outside()
        check_cold(self._cold.locus_cold_sweep(self._handle, microseconds(now)))

    def rewind(self, received: int) -> None:
        """Forget what was taken over when ``stats.received`` had been `received` or more: for a store that was loaded again."""
        self._outside()
        with self._guard.writing():
            check_cold(self._cold.locus_cold_rewind(self._handle, received))

    @property
    def stats(self) -> ColdStats:
        """How many records came, were written and removed; the file's and the queue's size; the latest failure."""
        self._outside()
        stats = empty_struct("locus_cold_stats")
        check_cold(self._cold.locus_cold_get_stats(self._handle, stats))
        return filled(ColdStats, stats)

    def check(self) -> None:
        """Verify the whole file."""
        self._outside()
        check_cold(self._cold.locus_cold_check(self._handle))
