"""The Voronoi diagram of a voxel graph: every voxel's nearest seed and its distance."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _callbacks as callbacks
from ._callbacks import Progress, progress_call
from ._ffi import ffi
from ._guard import Guard
from ._library import check, lib
from ._structs import DiagramStats
from ._values import Array, dtype_of, empty_struct, enum_value, filled, filled_options, pointer, readable, writable
from .constants import E_CAPACITY, OK, Engine, Metric
from .graph import Box, Graph, VoxelBox, box_of, c_box

#: A seed: x, y, z, the distance it starts at, its id, and whether placement leaves it where it is.
SEED = dtype_of("locus_seed")
#: Two cells that touch: the ids a and b, and the number of graph edges between them.
CELL_PAIR = dtype_of("locus_cell_pair")


class Change(NamedTuple):
    """What an update changed."""

    box: VoxelBox  #: the smallest box around it, with extents 0 where nothing changed
    voxels: int  #: how many voxels


def seeds_of(positions: ArrayLike, ids: ArrayLike | None = None, distances: ArrayLike = 0.0, fixed: ArrayLike = False) -> Array:
    """Seeds from positions (n, 3) as x, y, z, with ids (0, 1, ... by default), starting distances, and which are fixed."""
    places = np.atleast_2d(np.asarray(positions))
    if places.shape[1:] != (3,) or (places.size > 0 and places.min() < 0):
        raise ValueError(f"positions must have the shape (n, 3) and no negative number, not {places.tolist()}")
    seeds = np.zeros(len(places), SEED)
    for axis, name in enumerate("xyz"):
        seeds[name] = places[:, axis]
    seeds["id"] = np.arange(len(places)) if ids is None else ids
    seeds["distance"] = distances
    seeds["fixed"] = fixed
    return seeds


class Diagram:
    """The Voronoi diagram of a graph, without seeds and unsolved at first.

    Parameters
    ----------
    graph : Graph
        Kept alive; later edits are seen when the diagram is solved or updated again.
    engine : Engine or str
        What solves; all give the same bits.
    record_trace : bool
        Keep the active voxels per iteration for `trace`.
    max_distance : float
        Voxels farther than this stay unreached.
    grain : tuple of int, optional
        A grain's voxels (x, y, z), each 1 to 1024, for Engine.COMPACT of the CUDA backend.
    stream : int, optional
        The address of the ``cudaStream_t`` that the CUDA backend puts all work on, such as ``stream.ptr`` of a CuPy stream; it must
        outlive the diagram and its weights. By default streams of the library's own.
    on_device : bool
        The CUDA backend leaves results in the GPU's memory until something reads them on the host: see `labels_on_device`.
    """

    def __init__(
        self, graph: Graph, *, engine: Engine | str = Engine.AUTO, record_trace: bool = False, max_distance: float = math.inf,
        grain: tuple[int, int, int] | None = None, stream: int | None = None, on_device: bool = False,
    ) -> None:  # fmt: skip
        if grain is not None and len(grain) != 3:
            raise ValueError(f"grain must be three numbers (x, y, z), not {grain}")
        options = filled_options(
            "locus_diagram_options", lib.locus_diagram_options_init, engine=enum_value(Engine, engine), record_trace=record_trace,
            max_distance=max_distance, grain=grain, stream=None if stream is None else ffi.cast("void *", stream),
            on_device=on_device,
        )  # fmt: skip
        self._graph = graph
        self._guard = Guard("Diagram")
        made = ffi.new("locus_diagram **")
        with graph._guard.reading():
            check(lib.locus_diagram_create(graph._handle, options, made))
        self._handle = ffi.gc(made[0], lib.locus_diagram_destroy)

    def __repr__(self) -> str:
        return f"<locus.Diagram of {self._graph!r}, {len(self.seeds)} seeds>"

    @property
    def graph(self) -> Graph:
        """The graph it is of."""
        return self._graph

    def add_seeds(
        self, positions: ArrayLike, ids: ArrayLike | None = None, *, distances: ArrayLike = 0.0, fixed: ArrayLike = False
    ) -> None:
        """Add seeds.

        Parameters
        ----------
        positions : array_like
            (n, 3) positions (x, y, z), or an array of the dtype `SEED`, which is taken as it is.
        ids : array_like, optional
            What names each seed in every result; by default 0, 1, ... after those that are there.
        distances : array_like
            What each starts at, in units of distance.
        fixed : array_like
            Which ones `place_seeds` leaves where they are.
        """
        if isinstance(positions, np.ndarray) and positions.dtype == SEED:
            seeds = readable(positions, SEED, "positions")
        else:
            seeds = seeds_of(positions, ids, distances, fixed)
            if ids is None and len(known := self.seeds) > 0:
                seeds["id"] += known["id"].max() + 1
        with self._writing():
            check(lib.locus_diagram_add_seeds(self._handle, pointer(seeds, "locus_seed *"), len(seeds)))

    def remove_seeds(self, ids: ArrayLike) -> None:
        """Remove the seeds with these ids."""
        gone = readable(np.atleast_1d(np.asarray(ids)), np.uint32, "ids")
        with self._writing():
            check(lib.locus_diagram_remove_seeds(self._handle, pointer(gone, "uint32_t *"), len(gone)))

    def move_seed(self, seed: int, position: tuple[int, int, int]) -> None:
        """Move the seed with this id to a position (x, y, z)."""
        with self._writing():
            check(lib.locus_diagram_move_seed(self._handle, seed, *position))

    @property
    def seeds(self) -> Array:
        """The seeds in the order they were added, an array of the dtype `SEED`."""
        return self._listed(SEED, "locus_seed *", lib.locus_diagram_get_seeds)

    def place_seeds(
        self, count: int = 0, *, first_id: int | None = None, lloyd_iterations: int | None = None,
        metric: Metric | str = Metric.COMPLIANCE, progress: Progress | None = None,
    ) -> None:  # fmt: skip
        """Add `count` seeds by farthest-point sampling, then move all free ones to the centres of their cells (Lloyd).

        Parameters
        ----------
        count : int
            Seeds to add; 0 only moves those that are there.
        first_id : int, optional
            The id of the first added seed; by default one more than the largest there is.
        lloyd_iterations : int, optional
            Most rounds of Lloyd.
        metric : Metric or str
            Distances of the graph, or those of the uniform grid.
        progress : callable, optional
            ``progress(fraction)``; returning False cancels.
        """
        if first_id is None:
            known = self.seeds
            first_id = int(known["id"].max()) + 1 if len(known) else 0
        call = progress_call(progress, self._graph._callbacks)
        options = filled_options(
            "locus_place_options", lib.locus_place_options_init, count=count, first_id=first_id, lloyd_iterations=lloyd_iterations,
            metric=enum_value(Metric, metric), progress=callbacks.on_progress, progress_user=call.handle,
        )  # fmt: skip
        with self._writing():
            call.settle(lib.locus_diagram_place_seeds(self._handle, options))

    def solve(self, progress: Progress | None = None) -> "Diagram":
        """Compute the diagram anew; Ctrl-C cancels it, as does a `progress` that returns False. Returns the diagram itself."""
        call = progress_call(progress, self._graph._callbacks)
        with self._writing():
            call.settle(lib.locus_diagram_solve(self._handle, callbacks.on_progress, call.handle))
        return self

    def update(self, progress: Progress | None = None) -> Change:
        """Bring the diagram up to date with all that was changed since, recomputing only what has to be."""
        call = progress_call(progress, self._graph._callbacks)
        box, voxels = ffi.new("locus_voxel_box *"), ffi.new("uint64_t *")
        with self._writing():
            call.settle(lib.locus_diagram_update(self._handle, box, voxels, callbacks.on_progress, call.handle))
        (x, y, z), (nx, ny, nz) = box.origin, box.extent
        return Change(VoxelBox((x, y, z), (nx, ny, nz)), int(voxels[0]))

    def labels(self, box: Box = None, out: Array | None = None) -> Array:
        """The nearest seed's id per voxel of the box: a uint32 array (z, y, x), `NO_SEED` where none reaches."""
        return self._read(lib.locus_diagram_labels, np.uint32, "uint32_t *", box, out)

    def distances(self, box: Box = None, out: Array | None = None) -> Array:
        """The distance to it: a float32 array (z, y, x), infinite where none reaches."""
        return self._read(lib.locus_diagram_distances, np.float32, "float *", box, out)

    def distances_exact(self, box: Box = None, out: Array | None = None) -> Array:
        """The distance in steps: a uint64 array (z, y, x); divide by ``graph.info.scale``."""
        return self._read(lib.locus_diagram_distances_exact, np.uint64, "uint64_t *", box, out)

    def labels_on_device(self, out: Any, box: Box = None) -> None:
        """`labels` into an array on the GPU that solved the diagram: a uint32 array (z, y, x) of CuPy, PyTorch, Numba or whatever has
        ``__cuda_array_interface__``. With a `stream` the work is put there and not waited for."""
        self._read_on_device(lib.locus_diagram_labels_on_device, np.uint32, box, out)

    def distances_on_device(self, out: Any, box: Box = None) -> None:
        """`distances` into a float32 array on the GPU."""
        self._read_on_device(lib.locus_diagram_distances_on_device, np.float32, box, out)

    def distances_exact_on_device(self, out: Any, box: Box = None) -> None:
        """`distances_exact` into a uint64 array on the GPU."""
        self._read_on_device(lib.locus_diagram_distances_exact_on_device, np.uint64, box, out)

    def path(self, position: tuple[int, int, int]) -> Array:
        """The shortest path from (x, y, z) to its seed, as (n, 3) positions, both ends included; empty where no seed reaches."""

        def fill(handle: Any, into: Any, room: int, count: Any) -> int:
            return int(lib.locus_diagram_path(handle, *position, into, room, count))

        voxels = self._listed(np.dtype(np.uint64), "uint64_t *", fill)
        z, y, x = np.unravel_index(voxels.astype(np.intp), self._graph.shape)
        return np.stack([x, y, z], axis=-1)

    def cell_sizes(self) -> Array:
        """The number of voxels of each seed's cell, in the order of `seeds`."""
        return self._listed(np.dtype(np.uint64), "uint64_t *", lib.locus_diagram_cell_sizes)

    def cell_pairs(self) -> Array:
        """The pairs of cells that touch, an array of the dtype `CELL_PAIR`."""
        return self._listed(CELL_PAIR, "locus_cell_pair *", lib.locus_diagram_cell_pairs)

    @property
    def stats(self) -> DiagramStats:
        """What the latest solve did."""
        stats = empty_struct("locus_diagram_stats")
        with self._guard.reading():
            check(lib.locus_diagram_get_stats(self._handle, stats))
        return filled(DiagramStats, stats)

    def trace(self) -> Array:
        """The active voxels of each iteration of the latest solve; needs `record_trace` and an engine that iterates."""
        return self._listed(np.dtype(np.uint64), "uint64_t *", lib.locus_diagram_trace)

    @contextmanager
    def _writing(self) -> Iterator[None]:
        """No other call on the diagram, none that changes the graph."""
        with self._graph._guard.reading(), self._guard.writing():
            yield

    def _read(self, function: Callable[..., int], dtype: Any, kind: str, box: Box, out: Array | None) -> Array:
        where = box_of(box, self._graph.shape)
        array = writable(out, dtype, where.shape)
        with self._guard.reading():
            check(function(self._handle, c_box(where), pointer(array, kind), array.size))
        return array

    def _read_on_device(self, function: Callable[..., int], dtype: Any, box: Box, out: Any) -> None:
        where = box_of(box, self._graph.shape)
        about = out.__cuda_array_interface__
        address, read_only = about["data"]
        if np.dtype(about["typestr"]) != dtype or tuple(about["shape"]) != where.shape or about.get("strides") is not None or read_only:
            raise ValueError(f"out must be a writable C-contiguous {np.dtype(dtype)} array of shape {where.shape} on the GPU")
        with self._guard.reading():
            check(function(self._handle, c_box(where), ffi.cast("void *", address), math.prod(where.shape)))

    def _listed(self, dtype: np.dtype[Any], kind: str, function: Callable[..., int]) -> Array:
        """A list whose length the library tells: asked for with no room first, then with what it needs."""
        count = ffi.new("size_t *")
        with self._graph._guard.reading(), self._guard.reading():
            status = function(self._handle, ffi.NULL, 0, count)
            array = np.empty(count[0] if status in (OK, E_CAPACITY) else 0, dtype)
            if len(array) > 0:
                status = function(self._handle, pointer(array, kind), len(array), count)
            check(status)
        return array
