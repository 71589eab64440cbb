"""Shape functions: how much each seed of a Voronoi diagram weighs at a voxel."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _callbacks as callbacks
from ._callbacks import Progress, progress_call
from ._ffi import ffi
from ._guard import Guard
from ._library import check, lib
from ._values import Array, enum_value, filled_options, pointer, readable, writable
from .constants import E_CAPACITY, Method
from .diagram import Diagram
from .graph import Box, VoxelBox, box_of, c_box


class Rows(NamedTuple):
    """Rows of weights: row i has the entries ``offsets[i]:offsets[i + 1]`` of `ids` and `values`, by falling weight.

    With seed ids 0, 1, ... this is what ``scipy.sparse.csr_matrix((values, ids, offsets))`` takes.
    """

    offsets: Array
    ids: Array
    values: Array


class Weights:
    """The interpolation weights of the voxels of a box, or of a list of voxels, from a solved diagram.

    Parameters
    ----------
    diagram : Diagram
        Solved, or updated, since its graph and seeds were changed.
    method : Method or str
        Sibson, Laplace or distance ratio.
    box : VoxelBox or tuple of slices (z, y, x), optional
        The voxels that get rows, in the order of an array of the box; by default the whole grid.
    voxels : array_like, optional
        Their indices, instead of a box; one row each.
    max_per_row : int
        Keep only this many largest weights of a row; 0 keeps all.
    batch_bytes : int, optional
        Most scratch memory.
    progress : callable, optional
        ``progress(fraction)``; returning False cancels. Kept for `update`.
    """

    def __init__(
        self, diagram: Diagram, method: Method | str = Method.SIBSON, *, box: Box = None, voxels: ArrayLike | None = None,
        max_per_row: int = 0, batch_bytes: int | None = None, progress: Progress | None = None,
    ) -> None:  # fmt: skip
        if box is not None and voxels is not None:
            raise ValueError("weights are of a box or of a list of voxels, not of both")
        self._diagram = diagram
        self._guard = Guard("Weights")
        self._callbacks = progress_call(progress, diagram.graph._callbacks)
        self._box: VoxelBox | None = None if voxels is not None else box_of(box, diagram.graph.shape)
        options = filled_options(
            "locus_weights_options", lib.locus_weights_options_init, method=enum_value(Method, method), max_per_row=max_per_row,
            batch_bytes=batch_bytes, progress=callbacks.on_progress, progress_user=self._callbacks.handle,
        )  # fmt: skip
        made = ffi.new("locus_weights **")
        with diagram.graph._guard.reading(), diagram._guard.reading():
            if self._box is not None:
                status = lib.locus_weights_create(diagram._handle, options, c_box(self._box), made)
            else:
                listed = readable(voxels if voxels is not None else [], np.uint64, "voxels").ravel()
                status = lib.locus_weights_create_for(diagram._handle, options, pointer(listed, "uint64_t *"), listed.size, made)
            self._handle = ffi.gc(made[0], lib.locus_weights_destroy)
            self._callbacks.settle(status)
        self._seeds: Array = diagram.seeds["id"]

    def __repr__(self) -> str:
        return f"<locus.Weights, {len(self)} rows, {self.entries} entries>"

    def _size(self) -> tuple[int, int]:
        rows, entries = ffi.new("uint64_t *"), ffi.new("uint64_t *")
        with self._guard.reading():
            check(lib.locus_weights_size(self._handle, rows, entries))
        return int(rows[0]), int(entries[0])

    def __len__(self) -> int:
        """The number of rows."""
        return self._size()[0]

    @property
    def entries(self) -> int:
        """The number of entries in all rows."""
        return self._size()[1]

    @property
    def seed_ids(self) -> Array:
        """The ids of the seeds the weights were made of, in their order."""
        return self._seeds

    def _span(self, first: int, count: int | None) -> tuple[int, int]:
        if first < 0 or (count is not None and count < 0):
            raise ValueError(f"first is {first}, count {count}: neither may be negative")
        rows = len(self)
        return first, max(rows - first, 0) if count is None else count

    def rows(self, first: int = 0, count: int | None = None) -> Rows:
        """Rows from `first` on, by default all, as sparse rows."""
        first, count = self._span(first, count)
        # The library refuses rows that are not there; no memory is taken for them.
        offsets = np.zeros(count + 1 if first + count <= len(self) else 1, np.uint64)
        ids, values = np.empty(0, np.uint32), np.empty(0, np.float32)
        entries = ffi.new("uint64_t *")
        with self._guard.reading():
            places = pointer(offsets, "uint64_t *")
            status = lib.locus_weights_rows(self._handle, first, count, places, ffi.NULL, ffi.NULL, 0, entries)
            if status == E_CAPACITY:
                ids, values = np.empty(entries[0], np.uint32), np.empty(entries[0], np.float32)
                status = lib.locus_weights_rows(
                    self._handle, first, count, places, pointer(ids, "uint32_t *"), pointer(values, "float *"), len(ids), ffi.NULL
                )
            check(status)
        return Rows(offsets, ids, values)

    def dense(self, ids: ArrayLike | None = None, first: int = 0, count: int | None = None, out: Array | None = None) -> Array:
        """Rows as a dense float32 array (rows, ids): the weight of each of the seed ids (by default all seeds) at each row."""
        first, count = self._span(first, count)
        wanted = readable(self._seeds if ids is None else ids, np.uint32, "ids").ravel()
        array = writable(out, np.float32, (count, len(wanted)))
        with self._guard.reading():
            check(
                lib.locus_weights_dense(
                    self._handle, first, count, pointer(wanted, "uint32_t *"), len(wanted), pointer(array, "float *"), array.size
                )
            )
        return array

    def interpolate(self, values: ArrayLike, first: int = 0, count: int | None = None, out: Array | None = None) -> Array:
        """Interpolate values given at the seeds.

        Parameters
        ----------
        values : array_like
            A number, or a line of numbers, per seed, in the order of `seed_ids`: (seeds,) or (seeds, components).
        first, count : int
            Which rows; by default all.
        out : ndarray, optional
            Where the result goes.

        Returns
        -------
        ndarray
            float32, (rows,) or (rows, components); NaN for an empty row.
        """
        first, count = self._span(first, count)
        given = readable(values, np.float32, "values")
        if given.ndim not in (1, 2) or len(given) != len(self._seeds):
            raise ValueError(f"values has the shape {given.shape} instead of ({len(self._seeds)},) or ({len(self._seeds)}, components)")
        array = writable(out, np.float32, (count, *given.shape[1:]))
        components = given.shape[1] if given.ndim == 2 else 1
        with self._guard.reading():
            check(
                lib.locus_weights_interpolate(
                    self._handle, first, count, pointer(given, "float *"), components, pointer(array, "float *"), array.size
                )
            )
        return array

    def gradients(self, seed: int, first: int = 0, count: int | None = None, out: Array | None = None) -> Array:
        """The gradient (d/dx, d/dy, d/dz) of one seed's weight at each row: float32 (rows, 3); needs weights of a box."""
        first, count = self._span(first, count)
        array = writable(out, np.float32, (count, 3))
        with self._guard.reading():
            check(lib.locus_weights_gradients(self._handle, first, count, seed, pointer(array, "float *"), array.size))
        return array

    def update(self) -> Array:
        """Follow the diagram after it was solved or updated again; returns the numbers of the rows recomputed, rising."""
        changed = np.empty(len(self), np.uint64)
        count = ffi.new("size_t *")
        with self._diagram.graph._guard.reading(), self._diagram._guard.reading(), self._guard.writing():
            status = lib.locus_weights_update(self._handle, pointer(changed, "uint64_t *"), len(changed), count)
            self._callbacks.settle(status)
        self._seeds = self._diagram.seeds["id"]
        return changed[: count[0]].copy()

    def volume(self, values: Array) -> Array:
        """Values per row, such as those of `interpolate`, as an array (z, y, x, ...) of the box; the same memory."""
        if self._box is None:
            raise ValueError("these are weights of a list of voxels, not of a box")
        return values.reshape(self._box.shape + values.shape[1:])
