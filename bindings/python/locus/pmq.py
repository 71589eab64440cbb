"""The PMQ: the live window of a stream of geo-located records, in memory, sorted along the Z-curve."""

import datetime
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _callbacks as callbacks
from ._callbacks import Callbacks, Log, Progress, c_callback, progress_call
from ._ffi import ffi
from ._library import check, lib
from ._structs import PmqFileInfo, PmqLogStats, PmqRecovery, PmqStats
from ._values import Array, dtype_of, empty_struct, enum_value, filled, filled_options, microseconds, pointer, readable, writable
from .constants import E_BUSY, E_CAPACITY, ORDER_ANY, REGION_BOX, REGION_CIRCLE, REGION_POLYGON, Field, Future, Index, Layout, Record, Sync
from .errors import error_for

if TYPE_CHECKING:
    from .cold import Cold

#: A record of 32 bytes. Times are microseconds since 1970-01-01 UTC: ``records["time"].view("datetime64[us]")`` is no copy.
POINT32 = dtype_of("locus_point32")
#: A record of 156 bytes with a text of at most 140 bytes of UTF-8.
TEXT156 = dtype_of("locus_text156")

DTYPES = {Record.POINT32: POINT32, Record.TEXT156: TEXT156}

Time = Union[int, "np.integer[Any]", np.datetime64, datetime.datetime]
Span = Union[int, "np.integer[Any]", np.timedelta64, datetime.timedelta]
Path = Union[str, "os.PathLike[str]"]
Predicate = Callable[[Any], bool]


class Box(NamedTuple):
    """A box in degrees, borders included; west > east crosses the antimeridian."""

    south: float
    west: float
    north: float
    east: float


class Circle(NamedTuple):
    """The places within `radius` metres along the great circle."""

    latitude: float
    longitude: float
    radius: float


@dataclass(frozen=True)
class Query:
    """What to look for: everything, until it is narrowed.

    Parameters
    ----------
    box : Box or tuple (south, west, north, east), optional
    circle : Circle or tuple (latitude, longitude, radius), optional
    polygon : sequence of array_like, optional
        Rings, each (n, 2) as latitude, longitude; the even-odd rule makes a ring within another a hole.
    since, until : int, datetime64 or datetime, optional
        Times, both included; ints are microseconds since 1970.
    filter : callable, optional
        ``filter(record) -> bool``; the record is valid during the call only.
    expired : bool
        Records that have expired and have not left the store yet, too. Not for `Store.erase`.
    any_order : bool
        Records need not come in the store's order, which is quicker.
    """

    box: Box | tuple[float, float, float, float] | None = None
    circle: Circle | tuple[float, float, float] | None = None
    polygon: Sequence[ArrayLike] | None = None
    since: Time | None = None
    until: Time | None = None
    filter: Predicate | None = None
    expired: bool = False
    any_order: bool = False


#: How often a value of a field occurs, and the newest time among those records.
GROUP = dtype_of("locus_pmq_group")


class Ranked(NamedTuple):
    """Records, best first, and what they scored, or how far they are in metres."""

    records: Array
    values: Array


@c_callback("int32_t(void *, void *)", error=0)
def _on_filter(record: Any, user: Any) -> int:
    kept = ffi.from_handle(user)
    return 0 if kept.raised is not None else bool(kept.functions["filter"](kept.functions["record"].at(record)))


@c_callback("int32_t(void *, void *)", error=1)
def _on_visit(record: Any, user: Any) -> int:
    kept = ffi.from_handle(user)
    return kept.functions["visitor"](kept.functions["record"].at(record).copy()) is False


@c_callback("int32_t(void *, void *)", error=-1)
def _on_remove(record: Any, user: Any) -> int:
    kept = ffi.from_handle(user)
    return bool(kept.functions["remove"](kept.functions["record"].at(record)))


@c_callback("uint64_t(void *, void *)", error=0)
def _on_group(record: Any, user: Any) -> int:
    kept = ffi.from_handle(user)
    return 0 if kept.raised is not None else int(kept.functions["group"](kept.functions["record"].at(record)))


@c_callback("double(void *, void *)", error=float("nan"))
def _on_weight(record: Any, user: Any) -> float:
    kept = ffi.from_handle(user)
    return float(kept.functions["weight"](kept.functions["record"].at(record)))


@c_callback("int32_t(void *, void *)", error=1)
def _on_sink(record: Any, user: Any) -> int:
    return ffi.from_handle(user).functions["sink"].take(record)  # type: ignore[no-any-return]


class OneRecord:
    """Memory for the record that a callback is shown."""

    def __init__(self, dtype: np.dtype[Any]) -> None:
        self._memory = np.empty(1, dtype)
        self._pointer = pointer(self._memory)

    def at(self, record: Any) -> Any:
        ffi.memmove(self._pointer, record, self._memory.itemsize)
        return self._memory[0]


class _Sink:
    """Collects the records that leave and hands them on in arrays. One that the caller's function has not taken, for it raised,
    is handed over again first, with the next call."""

    ROOM = 4096

    def __init__(self, function: Callable[[Array], object], dtype: np.dtype[Any]) -> None:
        self._function = function
        self._dtype = dtype
        self._waiting: Array | None = None
        self._renew()

    def _renew(self) -> None:
        self._memory = np.empty(self.ROOM, self._dtype)
        self._pointer = pointer(self._memory, "char *")
        self._count = 0

    def take(self, record: Any) -> int:
        size = self._memory.itemsize
        ffi.memmove(self._pointer + self._count * size, record, size)
        self._count += 1
        if self._count == self.ROOM:
            self.flush()
        return 0

    def flush(self) -> None:
        """Hand over what is there."""
        if self._count > 0:
            whole, count = self._memory, self._count
            fresh = whole[:count] if count == self.ROOM else whole[:count].copy()
            if count == self.ROOM:
                self._renew()
            else:
                self._count = 0
            self._waiting = fresh if self._waiting is None else np.concatenate([self._waiting, fresh])
        if self._waiting is not None:
            self._function(self._waiting)
            self._waiting = None


class Asked:
    """A query for one call of the C interface."""

    def __init__(self, query: Query | None, snapshot: Any, dtype: np.dtype[Any]) -> None:
        asked = query if query is not None else Query()
        if sum(one is not None for one in (asked.box, asked.circle, asked.polygon)) > 1:
            raise ValueError("a query has one region: a box, a circle or a polygon")
        self.c = filled_options("locus_pmq_query", lib.locus_pmq_query_init)
        self.callbacks: Callbacks | None = None
        self._keep: list[Any] = []
        self.c.expired = asked.expired
        if snapshot is not None:
            self.c.snapshot = snapshot
        if asked.since is not None:
            self.c.time_from = microseconds(asked.since)
        if asked.until is not None:
            self.c.time_to = microseconds(asked.until)
        if asked.any_order:
            self.c.order = ORDER_ANY
        if asked.filter is not None:
            self.callbacks = Callbacks(filter=asked.filter, record=OneRecord(dtype))
            self.c.filter, self.c.filter_user = _on_filter, self.callbacks.handle
        if asked.box is not None:
            self.c.region, self.c.box = REGION_BOX, tuple(asked.box)
        elif asked.circle is not None:
            self.c.region, self.c.circle = REGION_CIRCLE, tuple(asked.circle)
        elif asked.polygon is not None:
            self._polygon(asked.polygon)

    def _polygon(self, rings: Sequence[ArrayLike]) -> None:
        each = [readable(ring, np.float64, "a ring of the polygon").reshape(-1, 2) for ring in rings]
        vertices = np.concatenate(each) if each else np.empty((0, 2))
        sizes = np.array([len(ring) for ring in each], np.uint64)
        self._keep = [vertices, sizes]
        self.c.region = REGION_POLYGON
        self.c.polygon = (pointer(vertices, "locus_position *"), pointer(sizes, "uint64_t *"), len(each))

    def settle(self, status: int, checked: Callable[[int], None] = check) -> None:
        if self.callbacks is not None:
            self.callbacks.settle(status, checked)
        else:
            checked(status)

    def read(
        self, dtype: np.dtype[Any], out: Array | None, room: Callable[[], int], fill: Callable[[Any, int, Any], int],
        checked: Callable[[int], None] = check,
    ) -> Array:  # fmt: skip
        """What ``fill(memory, capacity, count)`` reads into `out`, or into memory for ``room()`` records, which grows where more came."""
        array = np.empty(room(), dtype) if out is None else writable(out, dtype, (out.size,))
        count = ffi.new("size_t *")
        while True:
            status = fill(pointer(array), len(array), count)
            if status != E_CAPACITY or out is not None:
                break
            array = np.empty(count[0], dtype)
        self.settle(status, checked)
        return array[: count[0]]

    def visit(
        self, dtype: np.dtype[Any], visitor: Callable[[Any], object], show: Callable[[Any, Any], int],
        checked: Callable[[int], None] = check,
    ) -> bool:  # fmt: skip
        """Let ``show(callback, user)`` show records to the visitor until that returns False. True: all were shown."""
        stopped = [False]

        def shown(record: Any) -> bool:
            stopped[0] = visitor(record) is False
            return not stopped[0]

        call = Callbacks(visitor=shown, record=OneRecord(dtype))
        call.also = self.callbacks
        status = show(_on_visit, call.handle)
        if call.raised is None and stopped[0]:
            return False
        call.settle(status, checked)
        return True


class _Reader:
    """The questions to a store or a snapshot of it; each is answered from one moment, beside the writer too."""

    _handle: Any
    _snapshot: Any = None
    _dtype: np.dtype[Any]

    @property
    def dtype(self) -> np.dtype[Any]:
        """The dtype of the records: `POINT32` or `TEXT156`."""
        return self._dtype

    def _asked(self, query: Query | None) -> Asked:
        return Asked(query, self._snapshot, self._dtype)

    def __len__(self) -> int:
        return self.count()

    def count(self, query: Query | None = None) -> int:
        """How many live records the query selects."""
        asked, count = self._asked(query), ffi.new("uint64_t *")
        asked.settle(lib.locus_pmq_count(self._handle, asked.c, count))
        return int(count[0])

    def read(self, query: Query | None = None, out: Array | None = None) -> Array:
        """Copy the live records that the query selects, in the store's order.

        Parameters
        ----------
        query : Query, optional
        out : ndarray, optional
            Memory for them, an array of the store's dtype; too little is a `CapacityError`.

        Returns
        -------
        ndarray
            The records; with `out`, the part of it that was filled.
        """
        asked = self._asked(query)
        return asked.read(
            self._dtype, out, lambda: self.count(query), lambda *into: lib.locus_pmq_read(self._handle, asked.c, *into)
        )

    def visit(self, visitor: Callable[[Any], object], query: Query | None = None) -> bool:
        """Show the same records to ``visitor(record)``, one by one, until it returns False. True: all were shown."""
        asked = self._asked(query)
        return asked.visit(self._dtype, visitor, lambda *call: lib.locus_pmq_visit(self._handle, asked.c, *call))

    def pages(self, size: int = 65536, query: Query | None = None) -> Iterator[Array]:
        """Read the same records page by page, in the store's order.

        While the store changes from page to page, no record is shown twice, and one that is there all along is shown once.

        Parameters
        ----------
        size : int
            Most records of a page; it grows where one place holds more. Pages of a snapshot keep it.
        query : Query, optional

        Yields
        ------
        ndarray
        """
        asked, count = self._asked(query), ffi.new("size_t *")
        cursor = ffi.new("locus_pmq_cursor *")
        while True:
            page = np.empty(size, self._dtype)
            status = lib.locus_pmq_read_page(self._handle, asked.c, cursor, pointer(page), len(page), count)
            if status == E_CAPACITY:
                size = int(count[0])
                continue
            asked.settle(status)
            if count[0] == 0:
                return
            yield page[: count[0]]

    def groups(self, field: Field | str | Callable[[Any], int], query: Query | None = None) -> Array:
        """Count the records that the query selects by a field, or by what ``field(record)`` says of each.

        Returns
        -------
        ndarray
            Of the dtype `GROUP`, the largest group first.
        """
        asked, count = self._asked(query), ffi.new("size_t *")
        call = Callbacks(group=field, record=OneRecord(self._dtype))
        call.also = asked.callbacks
        kind = Field.CALLER if callable(field) else enum_value(Field, field)
        groups = np.empty(64, GROUP)
        while True:
            status = lib.locus_pmq_groups(
                self._handle, asked.c, kind, _on_group if callable(field) else ffi.NULL, call.handle,
                pointer(groups, "locus_pmq_group *"), len(groups), count,
            )  # fmt: skip
            if status != E_CAPACITY or call.raised is not None:
                break
            groups = np.empty(count[0], GROUP)
        call.settle(status)
        return groups[: count[0]]

    def tile(self, zoom: int, x: int, y: int, log2_bins: int = 8, query: Query | None = None, out: Array | None = None) -> Array:
        """Count the live records per bin of the Web-Mercator tile: a uint32 array of 2^log2_bins bins a side, north-west first."""
        side = 1 << log2_bins if 0 <= log2_bins <= 8 else 1
        bins = writable(out, np.uint32, (side, side))
        asked = self._asked(query)
        asked.settle(lib.locus_pmq_tile(self._handle, zoom, x, y, log2_bins, asked.c, pointer(bins, "uint32_t *"), bins.size, ffi.NULL))
        return bins

    def weighted_tile(
        self, weight: Callable[[Any], float], zoom: int, x: int, y: int, log2_bins: int = 8, query: Query | None = None,
        out: Array | None = None,
    ) -> Array:  # fmt: skip
        """The same with each record counted as ``weight(record)``, a finite number: a float64 array of sums."""
        side = 1 << log2_bins if 0 <= log2_bins <= 8 else 1
        bins = writable(out, np.float64, (side, side))
        asked = self._asked(query)
        call = Callbacks(weight=weight, record=OneRecord(self._dtype))
        call.also = asked.callbacks
        call.settle(
            lib.locus_pmq_weighted_tile(
                self._handle, zoom, x, y, log2_bins, asked.c, _on_weight, call.handle, pointer(bins, "double *"), bins.size, ffi.NULL
            )
        )
        return bins

    def topk(
        self, k: int, latitude: float, longitude: float, *, radius: float | None = None, alpha: float | None = None,
        period: Span | None = None, query: Query | None = None,
    ) -> Ranked:  # fmt: skip
        """The k records with the lowest scores ``alpha * distance / radius + (1 - alpha) * age / period``, lowest first."""
        score = filled_options(
            "locus_pmq_score", lib.locus_pmq_score_init, latitude=latitude, longitude=longitude, radius=radius, alpha=alpha,
            period=None if period is None else microseconds(period),
        )  # fmt: skip
        return self._best(k, query, lambda asked, *into: lib.locus_pmq_topk(self._handle, score, asked, k, *into))

    def nearest(self, k: int, latitude: float, longitude: float, query: Query | None = None) -> Ranked:
        """The k records nearest to a place, and their distances in metres."""
        return self._best(
            k, query, lambda asked, *into: lib.locus_pmq_nearest(self._handle, latitude, longitude, asked, k, *into)
        )

    def save(self, path: Path, progress: Progress | None = None) -> None:
        """Save the records as a file, which replaces an older one whole or not at all."""
        call = progress_call(progress)
        moment = ffi.NULL if self._snapshot is None else self._snapshot
        call.settle(lib.locus_pmq_save(self._handle, moment, os.fsencode(path), callbacks.on_progress, call.handle))

    def _best(self, k: int, query: Query | None, ask: Callable[..., int]) -> Ranked:
        asked, count = self._asked(query), ffi.new("size_t *")
        records, values = np.empty(max(k, 0), self._dtype), np.empty(max(k, 0), np.float64)
        asked.settle(ask(asked.c, pointer(records), pointer(values, "double *"), count))
        return Ranked(records[: count[0]], values[: count[0]])


def _log_options(
    sync: Sync | str, redeliver: bool, interval: Span | None, sync_bytes: int | None, keep: int | None, repair: bool
) -> Any:
    return filled_options(
        "locus_pmq_log_options", lib.locus_pmq_log_options_init, sync=enum_value(Sync, sync), redeliver=redeliver,
        sync_interval=None if interval is None else microseconds(interval), sync_bytes=sync_bytes, keep=keep, repair=repair,
    )  # fmt: skip


class Snapshot(_Reader):
    """One moment of a store, for several questions; made by `Store.snapshot`. A stale one raises `StaleError`."""

    def __init__(self, store: "Store") -> None:
        made = ffi.new("locus_pmq_snapshot **")
        check(lib.locus_pmq_snapshot_create(store._handle, made))
        self._store = store
        self._handle, self._dtype = store._handle, store._dtype
        self._snapshot = ffi.gc(made[0], lib.locus_pmq_snapshot_destroy)


class Store(_Reader):
    """The live window of a stream.

    One thread at a time changes a store (a second one gets a `BusyError`); any number of threads may ask at the same time.

    Parameters
    ----------
    record : Record or str
        The layout of the records: ``"point32"`` or ``"text156"``.
    horizon : int, timedelta64 or timedelta, optional
        How long a record lives; ints are microseconds.
    max_records, max_bytes : int, optional
        Limits; beyond, the oldest records go.
    layout : Layout or str
        How records lie in memory.
    index : Index or str
        Of the packed array.
    future : Future or str
        Whether times after `now` are refused or clamped.
    remove : callable, optional
        ``remove(record) -> bool``: may this record go? The record is valid during the call only.
    sink : callable, optional
        ``sink(records)`` takes over, as an array, the records that left. Where it raises, the array is handed over again with the
        next insert, sweep or erase.
    cold : Cold, optional
        The tier that takes over, instead of a `sink`, the records that left; for one store at a time.
    log : callable, optional
        ``log(level, text)``.
    segment_slots, rho_leaf, tau_leaf, rho_root, tau_root, snapshot_bytes : optional
        As in locus_pmq_options.
    """

    def __init__(
        self, record: Record | str = Record.POINT32, *, horizon: Span | None = None, max_records: int | None = None,
        max_bytes: int | None = None, layout: Layout | str = Layout.RING_LEAVES, index: Index | str = Index.IMPLICIT,
        future: Future | str = Future.REFUSE, remove: Predicate | None = None, sink: Callable[[Array], object] | None = None,
        cold: "Cold | None" = None, log: Log | None = None, segment_slots: int | None = None, rho_leaf: float | None = None, tau_leaf: float | None = None,
        rho_root: float | None = None, tau_root: float | None = None, snapshot_bytes: int | None = None,
        _create: Callable[[Any, Any], None] | None = None,
    ) -> None:  # fmt: skip
        kind = enum_value(Record, record)
        self._dtype = DTYPES[Record(kind)]
        self._sink = None if sink is None else _Sink(sink, self._dtype)
        self._callbacks = Callbacks(remove=remove, sink=self._sink, log=log, record=OneRecord(self._dtype))
        options = filled_options(
            "locus_pmq_options", lib.locus_pmq_options_init, record=kind, layout=enum_value(Layout, layout),
            index=enum_value(Index, index), future=enum_value(Future, future),
            horizon=None if horizon is None else microseconds(horizon), max_records=max_records, max_bytes=max_bytes,
            segment_slots=segment_slots, rho_leaf=rho_leaf, tau_leaf=tau_leaf, rho_root=rho_root, tau_root=tau_root,
            snapshot_bytes=snapshot_bytes,
        )  # fmt: skip
        for name, function, given in (("remove", _on_remove, remove), ("sink", _on_sink, sink), ("log", callbacks.on_log, log)):
            if given is not None:
                setattr(options, name, function)
                setattr(options, f"{name}_user", self._callbacks.handle)
        self._cold = cold
        if cold is not None:
            if sink is not None:
                raise ValueError("a store has a sink or a cold tier, not both")
            cold._attach(options)
        # What watches the store (locus.Alerts), and the lock that keeps its end and an insert of another thread apart.
        self._watchers: list[Any] = []
        self._watching = threading.RLock()
        made = ffi.new("locus_pmq **")
        if _create is not None:
            _create(options, made)
        else:
            check(lib.locus_pmq_create(options, made))
        # The tier ends behind its store.
        self._handle = ffi.gc(made[0], lambda handle, _tier=cold: lib.locus_pmq_destroy(handle))
        if cold is not None:
            cold._attached(self)
        self._recovery: PmqRecovery | None = None

    @classmethod
    def load(cls, path: Path, *, progress: Progress | None = None, **options: Any) -> "Store":
        """Make a store from a saved file.

        Parameters
        ----------
        path : path-like
        progress : callable, optional
            ``progress(fraction)``; returning False cancels.
        **options
            Those of `Store`; by default the file's record layout.
        """
        options.setdefault("record", file_info(path).record)
        call = progress_call(progress)

        def create(plain: Any, made: Any) -> None:
            call.settle(lib.locus_pmq_load(os.fsencode(path), plain, callbacks.on_progress, call.handle, made))

        return cls(**options, _create=create)

    @classmethod
    def open(
        cls, folder: Path, *, sync: Sync | str = Sync.BATCH, redeliver: bool = True, sync_interval: Span | None = None,
        sync_bytes: int | None = None, keep: int | None = None, repair: bool = False, progress: Progress | None = None,
        **options: Any,
    ) -> "Store":  # fmt: skip
        """Recover the store of a folder, or make a new one, and log every change before it is acknowledged.

        Parameters
        ----------
        folder : path-like
        sync : Sync or str
            When the log is flushed to the disk.
        redeliver : bool
            Hand what left since the last save to the sink again.
        sync_interval, sync_bytes, keep, repair : optional
            As in locus_pmq_log_options.
        progress : callable, optional
            ``progress(fraction)``; returning False cancels.
        **options
            Those of `Store`.

        Returns
        -------
        Store
            Its `recovery` tells what was found.
        """
        logging = _log_options(sync, redeliver, sync_interval, sync_bytes, keep, repair)
        call, recovery = progress_call(progress), empty_struct("locus_pmq_recovery")

        def create(plain: Any, made: Any) -> None:
            name = os.fsencode(folder)
            call.settle(lib.locus_pmq_open(name, plain, logging, callbacks.on_progress, call.handle, recovery, made))

        store = cls(**options, _create=create)
        store._recovery = filled(PmqRecovery, recovery)
        return store

    @property
    def recovery(self) -> PmqRecovery | None:
        """What `open` found; None for other stores."""
        return self._recovery

    def attach(
        self, folder: Path, *, sync: Sync | str = Sync.BATCH, redeliver: bool = True, sync_interval: Span | None = None,
        sync_bytes: int | None = None, keep: int | None = None, repair: bool = False, progress: Progress | None = None,
    ) -> None:  # fmt: skip
        """Give a store that has no log a folder that has no store; the parameters are those of `open`."""
        logging = _log_options(sync, redeliver, sync_interval, sync_bytes, keep, repair)
        call = progress_call(progress)
        call.settle(lib.locus_pmq_attach(self._handle, os.fsencode(folder), logging, callbacks.on_progress, call.handle))

    def checkpoint(self, progress: Progress | None = None) -> None:
        """Save the present moment into the store's folder and begin a new log."""
        call = progress_call(progress)
        call.settle(lib.locus_pmq_checkpoint(self._handle, callbacks.on_progress, call.handle))

    def sync(self) -> None:
        """Flush the log to the disk."""
        check(lib.locus_pmq_sync(self._handle))

    @property
    def log_stats(self) -> PmqLogStats:
        """The log's figures; zeros without one."""
        stats = empty_struct("locus_pmq_log_stats")
        check(lib.locus_pmq_get_log_stats(self._handle, stats))
        return filled(PmqLogStats, stats)

    def __repr__(self) -> str:
        return f"<locus.Store of {self.count()} records>"

    def _outside(self) -> None:
        """A function that the cold tier calls must not change the store."""
        if self._cold is not None:
            self._cold._outside()

    def _changed(self, status: int) -> None:
        """After a change: the sink gets what left, then what a callback raised, or the status, is raised."""
        if self._sink is not None and self._callbacks.raised is None:
            self._sink.flush()
        for watcher in list(self._watchers):
            for callbacks_of_it in watcher._raised():
                callbacks_of_it.settle(status)
        self._callbacks.settle(status)

    def insert(self, records: Array, now: Time) -> None:
        """Insert a batch and set the store's clock.

        Parameters
        ----------
        records : ndarray
            Of the store's dtype, in any order; read where it lies.
        now : int, datetime64 or datetime
            The clock, which never runs back.
        """
        if not isinstance(records, np.ndarray) or records.dtype != self._dtype:
            raise ValueError(f"records must be an array of the dtype {self._dtype}, not {getattr(records, 'dtype', type(records))}")
        array = readable(records, self._dtype, "records")
        self._outside()
        if not self._watching.acquire(blocking=False):
            raise error_for(E_BUSY, "Store.insert: another thread changes the store", "LOCUS_E_BUSY")
        try:
            self._changed(lib.locus_pmq_insert(self._handle, pointer(array), array.size, microseconds(now)))
        finally:
            self._watching.release()

    def sweep(self, now: Time) -> int:
        """Set the clock and evict everything that may go; returns how many records left."""
        self._outside()
        evicted = ffi.new("uint64_t *")
        self._changed(lib.locus_pmq_sweep(self._handle, microseconds(now), evicted))
        return int(evicted[0])

    def erase(self, query: Query | None = None) -> int:
        """Remove the live records that the query selects and hand them to the sink; returns how many they were."""
        self._outside()
        asked, erased = self._asked(query), ffi.new("uint64_t *")
        status = lib.locus_pmq_erase(self._handle, asked.c, erased)
        if asked.callbacks is not None and asked.callbacks.raised is not None:
            asked.settle(status)
        self._changed(status)
        return int(erased[0])

    def snapshot(self) -> Snapshot:
        """Keep the present moment for several questions."""
        return Snapshot(self)

    @property
    def stats(self) -> PmqStats:
        """Counts, memory, density, the longest pause."""
        stats = empty_struct("locus_pmq_stats")
        check(lib.locus_pmq_get_stats(self._handle, stats))
        return filled(PmqStats, stats)

    def check(self) -> None:
        """Verify every invariant of the store."""
        check(lib.locus_pmq_check(self._handle))


def file_info(path: Path) -> PmqFileInfo:
    """What a saved file says of itself."""
    info = empty_struct("locus_pmq_file_info")
    check(lib.locus_pmq_get_file_info(os.fsencode(path), info))
    return filled(PmqFileInfo, info)


def pmq_key(latitude: float, longitude: float) -> int:
    """The key of a place: the Morton code of its Web-Mercator tile at zoom 25."""
    key = ffi.new("uint64_t *")
    check(lib.locus_pmq_key(latitude, longitude, key))
    return int(key[0])
