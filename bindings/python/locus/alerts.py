"""What happens in a stream: regions where more arrives than their history leads to expect, and records inside fences."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ._callbacks import Callbacks, c_callback
from ._ffi import ffi
from ._library import check, lib
from ._structs import AlertsStats
from ._values import Array, dtype_of, empty_struct, filled, filled_options, microseconds, pointer
from .constants import E_CAPACITY
from .pmq import Asked, OneRecord, Query, Span, Store

#: An alert: its number, kind (`AlertKind`), tile, box, time, and the numbers that made it one.
ALERT = dtype_of("locus_alert")


@c_callback("int32_t(locus_alert *, void *)", error=1)
def _on_alert(alert: Any, user: Any) -> int:
    kept = ffi.from_handle(user).functions
    return kept["alert"](kept["shown"].at(alert).copy()) is False


@c_callback("int32_t(uint64_t, void *, void *)", error=1)
def _on_fence(fence: int, record: Any, user: Any) -> int:
    kept = ffi.from_handle(user).functions
    return kept["fence"](fence, kept["record"].at(record).copy()) is False


def _span(span: Span | None) -> int | None:
    return None if span is None else microseconds(span)


class Alerts:
    """Watches what is inserted into a store, from now on until `close`.

    The callbacks are called within `Store.insert`, after the batch is stored; what they raise comes out of it. They may ask the store,
    add and remove fences, and close this object.

    Parameters
    ----------
    store : Store
    alert : callable, optional
        ``alert(region)`` is told, once, of a region that stands out, a scalar of the dtype `ALERT`; returning False stops.
    fence : callable, optional
        ``fence(id, record)`` is shown each record that arrives inside a fence; returning False stops.
    zoom_from, zoom_to : int, optional
        The coarsest and the finest regions reported.
    half_life, history, cool_down : int, timedelta64 or timedelta, optional
        The half lives of the present and of the history, and how long a region then stays silent; ints are microseconds.
    minimum, factor, rate, share : float, optional
        When a region stands out.
    max_bytes : int, optional
        Most memory.
    """

    def __init__(
        self, store: Store, *, alert: Callable[[Any], object] | None = None, fence: Callable[[int, Any], object] | None = None,
        zoom_from: int | None = None, zoom_to: int | None = None, half_life: Span | None = None, history: Span | None = None,
        cool_down: Span | None = None, minimum: float | None = None, factor: float | None = None, rate: float | None = None,
        share: float | None = None, max_bytes: int | None = None,
    ) -> None:  # fmt: skip
        self._store = store
        self._callbacks = Callbacks(alert=alert, fence=fence, shown=OneRecord(ALERT), record=OneRecord(store.dtype))
        # The filters of fences, also of removed ones: an insert of another thread may still ask them.
        self._asked: list[Asked] = []
        options = filled_options(
            "locus_alerts_options", lib.locus_alerts_options_init, zoom_from=zoom_from, zoom_to=zoom_to, minimum=minimum,
            factor=factor, rate=rate, share=share, max_bytes=max_bytes, half_life=_span(half_life), history=_span(history),
            cool_down=_span(cool_down),
        )  # fmt: skip
        for name, function, given in (("alert", _on_alert, alert), ("fence", _on_fence, fence)):
            if given is not None:
                setattr(options, name, function)
                setattr(options, f"{name}_user", self._callbacks.handle)
        made = ffi.new("locus_alerts **")
        with store._watching:
            check(lib.locus_alerts_create(store._handle, options, made))
            self._handle = ffi.gc(made[0], lib.locus_alerts_destroy)
            store._watchers.append(self)

    def close(self) -> None:
        """Stop watching; the callbacks are called no more. Waits for an insert of another thread."""
        with self._store._watching:
            if self in self._store._watchers:
                self._store._watchers.remove(self)
                handle, self._handle = self._handle, ffi.NULL
                ffi.release(handle)

    def active(self) -> Array:
        """The active alerts, the latest first: an array of the dtype `ALERT`."""
        alerts, count = np.empty(256, ALERT), ffi.new("size_t *")
        while (status := lib.locus_alerts_active(self._handle, pointer(alerts, "locus_alert *"), len(alerts), count)) == E_CAPACITY:
            alerts = np.empty(count[0], ALERT)
        check(status)
        return alerts[: count[0]]

    def add_fence(self, number: int, query: Query) -> None:
        """Add a fence under an id of yours: the records that the query selects."""
        asked = Asked(query, None, self._store.dtype)
        check(lib.locus_alerts_add_fence(self._handle, number, asked.c))
        if asked.callbacks is not None:
            self._asked.append(asked)

    def remove_fence(self, number: int) -> None:
        """Remove a fence."""
        check(lib.locus_alerts_remove_fence(self._handle, number))

    @property
    def stats(self) -> AlertsStats:
        """Regions, fences, alerts raised, memory."""
        stats = empty_struct("locus_alerts_stats")
        check(lib.locus_alerts_get_stats(self._handle, stats))
        return filled(AlertsStats, stats)

    def _raised(self) -> list[Callbacks]:
        """The callbacks that have something to raise."""
        each = [self._callbacks, *(asked.callbacks for asked in self._asked)]
        return [one for one in each if one is not None and one.raised is not None]
