"""Exceptions: a class for each status of the library, all of them `Error`, each also the built-in exception it is a kind of."""

from . import constants


class LibraryError(ImportError):
    """The shared library was not found, or is of a version this package cannot work with."""


class Error(Exception):
    """A call of the library failed; the text names the function, the argument and the offending value.

    Attributes
    ----------
    status : int
        The status, a ``LOCUS_E_`` constant of the C interface.
    name : str
        Its name, such as ``LOCUS_E_RANGE``.
    """

    status: int = 0
    name: str = ""


class ArgumentError(Error, ValueError):
    """An argument is out of its range or contradicts another one."""


class RangeError(Error, OverflowError):
    """A value cannot be represented in the words the object was created with."""


class CapacityError(Error):
    """The caller's memory is too small."""


class StateError(Error, RuntimeError):
    """The object is not in a state that allows the call."""


class UnsupportedError(Error, NotImplementedError):
    """Not available in this build or on this machine."""


class StoppedError(Error):
    """A callback asked to stop, or the work was cancelled."""


class BusyError(Error):
    """Another thread, or the call that a callback was called from, is inside a call that excludes this one."""


class StaleError(Error):
    """The snapshot outlived its memory budget."""


class OutOfMemoryError(Error, MemoryError):
    """Out of memory."""


class IoError(Error, OSError):
    """The operating system refused to read or write."""


class FormatError(Error, ValueError):
    """Bytes from outside are not what they claim to be."""


class DeviceError(Error):
    """The GPU or its driver reported an error."""


class InternalError(Error):
    """A defect in Locus; please report the text."""


CLASSES: dict[int, type[Error]] = {
    constants.E_ARGUMENT: ArgumentError,
    constants.E_RANGE: RangeError,
    constants.E_CAPACITY: CapacityError,
    constants.E_STATE: StateError,
    constants.E_UNSUPPORTED: UnsupportedError,
    constants.E_STOPPED: StoppedError,
    constants.E_BUSY: BusyError,
    constants.E_STALE: StaleError,
    constants.E_MEMORY: OutOfMemoryError,
    constants.E_IO: IoError,
    constants.E_FORMAT: FormatError,
    constants.E_DEVICE: DeviceError,
    constants.E_INTERNAL: InternalError,
}


def error_for(status: int, text: str, name: str) -> Error:
    """The exception of a status; `Error` itself for one that a later library has added."""
    error = CLASSES.get(status, Error)(text)
    error.status, error.name = status, name
    return error
