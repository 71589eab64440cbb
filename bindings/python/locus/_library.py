"""Find and open liblocus, liblocus_io and liblocus_cold, and turn their statuses into exceptions."""

import glob
import os
import shutil
import subprocess
from functools import lru_cache
from typing import Any

from . import constants
from ._ffi import ffi
from .errors import LibraryError, error_for

_SONAME = f".so.{constants.VERSION_MAJOR}"


def _pkg_config_folder(name: str) -> str | None:
    """The folder of libraries that pkg-config names for the package `name`."""
    tool = shutil.which("pkg-config")
    if tool is None:
        return None
    found = subprocess.run([tool, "--variable=libdir", name], capture_output=True, text=True, check=False)
    return found.stdout.strip() or None if found.returncode == 0 else None


def _open(name: str, variable: str, folder: str | None = None) -> tuple[Any, str]:
    """Open lib<name> from where the environment variable says, else from the folder, from beside this file, by the loader, or
    from where pkg-config says. Returns the library and the path or name it was opened by."""
    named = os.environ.get(variable)
    if named:
        path = os.path.join(named, f"lib{name}{_SONAME}") if os.path.isdir(named) else named
        try:
            return ffi.dlopen(path), path
        except OSError as error:
            raise LibraryError(f"{variable} is {named}: {error}") from None
    tried = []
    for place in filter(None, (folder, os.path.dirname(os.path.abspath(__file__)))):
        for path in sorted(glob.glob(os.path.join(place, f"lib{name}{_SONAME}"))):
            try:
                return ffi.dlopen(path), path
            except OSError as error:
                tried.append(f"{path} ({error})")
        tried.append(place)
    path = f"lib{name}{_SONAME}"
    try:
        return ffi.dlopen(path), path
    except OSError as error:
        tried.append(f"the loader ({error})")
    told = _pkg_config_folder(name)
    if told is not None and os.path.exists(os.path.join(told, path)):
        path = os.path.join(told, path)
        return ffi.dlopen(path), path
    tried.append("pkg-config")
    raise LibraryError(
        f"lib{name}{_SONAME} was not found; looked in {', '.join(tried)}. Install Locus (make install), or set {variable} to the "
        "path of the library or of its folder."
    )


def _check_version(library: Any, path: str) -> None:
    try:
        version = library.locus_version()
    except (AttributeError, ffi.error):
        raise LibraryError(f"{path} is not liblocus: it has no locus_version") from None
    major, minor = version // 10000, version // 100 % 100
    if major != constants.VERSION_MAJOR or minor < constants.VERSION_MINOR:
        raise LibraryError(
            f"{path} is version {major}.{minor}.{version % 100}; this package needs {constants.VERSION_MAJOR}."
            f"{constants.VERSION_MINOR} or a later {constants.VERSION_MAJOR}.x"
        )


lib, LIBRARY_PATH = _open("locus", "LOCUS_LIBRARY")
_check_version(lib, LIBRARY_PATH)


@lru_cache(maxsize=None)
def _other(name: str, variable: str) -> Any:
    """A library beside liblocus, opened when it is first needed."""
    folder = os.path.dirname(LIBRARY_PATH) if os.sep in LIBRARY_PATH else None
    return _open(name, variable, folder)[0]


def io_library() -> Any:
    """liblocus_io, the file formats."""
    return _other("locus_io", "LOCUS_IO_LIBRARY")


def cold_library() -> Any:
    """liblocus_cold, the cold tier, which needs SQLite."""
    return _other("locus_cold", "LOCUS_COLD_LIBRARY")


def text(pointer: Any) -> str:
    """The text of a `const char *` of the library."""
    return ffi.string(pointer).decode("utf-8", "replace")  # type: ignore[no-any-return]


def check(status: int) -> None:
    """Raise the exception of a failed call of liblocus."""
    if status:
        raise error_for(status, text(lib.locus_last_error()), text(lib.locus_status_name(status)))


def check_io(status: int) -> None:
    """Raise the exception of a failed call of liblocus_io."""
    if status:
        raise error_for(status, text(io_library().locus_io_last_error()), text(lib.locus_status_name(status)))


def check_cold(status: int) -> None:
    """Raise the exception of a failed call of liblocus_cold."""
    if status:
        raise error_for(status, text(cold_library().locus_cold_last_error()), text(lib.locus_status_name(status)))


def version() -> str:
    """The loaded library's version and what was built into it, such as ``0.1.0 simd=highway cuda=no``."""
    return text(lib.locus_version_text())
