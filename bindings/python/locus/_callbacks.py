"""Python functions as callbacks of the library.

The library gets one C function per kind of callback and a handle to a `Callbacks`, which holds the Python functions. What a Python
function raises (KeyboardInterrupt too) is kept there, stops the call where the call can stop, and is raised when the call is back.
"""

from collections.abc import Callable
from typing import Any

from ._ffi import ffi
from ._library import check, text

Progress = Callable[[float], bool | None]
Log = Callable[[int, str], None]


class Callbacks:
    """The Python functions of one object or one call, and the first exception that one of them raised."""

    def __init__(self, **functions: Any) -> None:
        self.raised: BaseException | None = None
        self.also: Callbacks | None = None
        self.handle = ffi.new_handle(self)
        self.functions = functions

    def settle(self, status: int, checked: Callable[[int], None] = check) -> None:
        """Raise what a callback has raised, else what the status says."""
        for one in (self.also, self):
            if one is not None and one.raised is not None:
                raised, one.raised = one.raised, None
                raise raised
        checked(status)


def _keep(_kind: Any, value: BaseException, traceback: Any) -> None:
    """Called by cffi with what a callback raised."""
    callbacks: Callbacks = ffi.from_handle(traceback.tb_frame.f_locals["user"])
    if callbacks.raised is None:
        callbacks.raised = value


def c_callback(kind: str, error: Any = None) -> Callable[[Callable[..., Any]], Any]:
    """Make a function the C callback of a kind, with what it answers where it raises."""
    return ffi.callback(kind, error=error, onerror=_keep)  # type: ignore[no-any-return]


@c_callback("int32_t(double, void *)", error=1)
def on_progress(fraction: float, user: Any) -> int:
    """Also where nobody asked for progress: here the interpreter notices an interrupt."""
    callbacks = ffi.from_handle(user)
    if callbacks.also is not None and callbacks.also.raised is not None:
        return 1
    function = callbacks.functions["progress"]
    return 1 if function is not None and function(fraction) is False else 0


@c_callback("void(int32_t, const char *, void *)")
def on_log(level: int, line: Any, user: Any) -> None:
    callbacks = ffi.from_handle(user)
    callbacks.functions["log"](level, text(line))


def progress_call(progress: Progress | None, also: Callbacks | None = None) -> Callbacks:
    """The callbacks of one call that reports progress; what `also`, an object's own callbacks, raise stops it too."""
    callbacks = Callbacks(progress=progress)
    callbacks.also = also
    return callbacks
