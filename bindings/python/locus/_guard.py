"""Keep calls apart that the library does not allow beside each other.

The interpreter's lock is released while the library works, so another thread, or a callback, could call into an object that is at
work. Instead of a crash that is a `BusyError`.
"""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from . import constants
from .errors import error_for


class Guard:
    """Any number of readers, or one writer, of what `name` says."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._lock = threading.Lock()
        self._readers = 0
        self._writing = False

    def _refuse(self) -> None:
        text = f"{self._name}: another call is at work on it that excludes this one"
        raise error_for(constants.E_BUSY, text, "LOCUS_E_BUSY")

    @contextmanager
    def reading(self) -> Iterator[None]:
        with self._lock:
            if self._writing:
                self._refuse()
            self._readers += 1
        try:
            yield
        finally:
            with self._lock:
                self._readers -= 1

    @contextmanager
    def writing(self) -> Iterator[None]:
        with self._lock:
            if self._writing or self._readers:
                self._refuse()
            self._writing = True
        try:
            yield
        finally:
            with self._lock:
                self._writing = False
