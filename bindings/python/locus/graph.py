"""The voxel graph: a grid of voxels, each with a compliance or impassable."""

import sys
from collections.abc import Callable
from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _callbacks as callbacks
from ._callbacks import Callbacks, Log
from ._ffi import ffi
from ._guard import Guard
from ._library import lib
from ._structs import GraphInfo
from ._values import Array, empty_struct, enum_value, filled, filled_options, pointer, readable, writable
from .constants import Backend, Material, Simd, WeightRule, Word

WeightFunction = Callable[[int, int, float], float]


class VoxelBox(NamedTuple):
    """A box of voxels: its lowest corner and its extent, both (x, y, z)."""

    origin: tuple[int, int, int]
    extent: tuple[int, int, int]

    @property
    def shape(self) -> tuple[int, int, int]:
        """The shape of an array of the box: (z, y, x)."""
        return self.extent[2], self.extent[1], self.extent[0]


Box = Union[VoxelBox, tuple[slice, slice, slice], None]


# What the library is told where the function raises is more than a word can hold: the call fails, and nothing is computed from it.
@callbacks.c_callback("double(uint64_t, uint64_t, double, void *)", error=sys.float_info.max)
def _on_weight(u: int, v: int, length: float, user: Any) -> float:
    kept = ffi.from_handle(user)
    return sys.float_info.max if kept.raised is not None else float(kept.functions["weight"](u, v, length))


def box_of(box: Box, shape: tuple[int, int, int]) -> VoxelBox:
    """A box from itself, from slices in the order of an array, or for None the whole grid of the shape (z, y, x)."""
    if box is None:
        return VoxelBox((0, 0, 0), (shape[2], shape[1], shape[0]))
    if isinstance(box, VoxelBox):
        return box
    spans = [one.indices(size) for one, size in zip(box, shape)]
    if len(box) != 3 or any(step != 1 for _, _, step in spans):
        raise ValueError(f"a box is a VoxelBox or three slices (z, y, x) of step 1, not {box}")
    spans.reverse()
    first, second, third = ((start, max(stop - start, 0)) for start, stop, _ in spans)
    return VoxelBox((first[0], second[0], third[0]), (first[1], second[1], third[1]))


def c_box(box: VoxelBox) -> Any:
    return ffi.new("locus_voxel_box *", {"origin": box.origin, "extent": box.extent})


class Graph:
    """A voxel graph.

    Arrays of voxels have the shape (z, y, x), in C order: that is x fastest, as the library keeps them, so they are not copied on the
    way. Positions, extents and spacings are (x, y, z). A voxel's index is ``x + nx * (y + ny * z)``, its place in ``array.ravel()``.

    Parameters
    ----------
    material : array_like, optional
        A compliance (or stiffness) per voxel, with up to three dimensions; NaN, infinite or negative: impassable. Copied by the
        library. float32 in C order is read where it lies; anything else is converted first. None makes every voxel impassable and
        needs `shape`, and `material_range` or `scale`.
    shape : tuple of int, optional
        (z, y, x), where there is no `material`.
    spacing : tuple of float
        A voxel's edge lengths (x, y, z).
    connectivity : int
        6, 18 or 26.
    weight_rule : WeightRule or str
        How an edge's weight follows from the two materials and its length.
    kind : Material or str
        What the numbers are.
    word : Word or int
        Bits of a packed word: 32, 64, or 0 for automatic.
    stiffness_exponent : float
        p of WeightRule.MEAN_STIFFNESS.
    weight : callable, optional
        ``weight(u, v, length) -> float`` for WeightRule.CALLER, u and v being voxel indices with u < v. What it raises comes out of
        the call that needed it, which then has no result.
    max_seeds : int, optional
        Seeds a diagram must be able to hold.
    scale, precision : float, optional
        Steps per unit of distance, or the largest relative rounding error of a weight wanted where the scale is chosen.
    material_range : tuple of float, optional
        The smallest and the largest passable value that edits will bring.
    threads : int
        Most threads a call may use; 0: one per core.
    backend : Backend or str
        What computes; forcing one that is not there is an error.
    simd : Simd or str
        The instruction set; likewise.
    log : callable, optional
        ``log(level, text)``.

    Raises
    ------
    ArgumentError, RangeError, UnsupportedError, OutOfMemoryError
    """

    def __init__(
        self,
        material: ArrayLike | None = None,
        *,
        shape: tuple[int, ...] | None = None,
        spacing: tuple[float, float, float] = (1.0, 1.0, 1.0),
        connectivity: int = 26,
        weight_rule: WeightRule | str = WeightRule.MEAN_COMPLIANCE,
        kind: Material | str = Material.COMPLIANCE,
        word: Word | int = Word.AUTO,
        stiffness_exponent: float = 1.0,
        weight: WeightFunction | None = None,
        max_seeds: int | None = None,
        scale: float | None = None,
        precision: float | None = None,
        material_range: tuple[float, float] | None = None,
        threads: int = 0,
        backend: Backend | str = Backend.AUTO,
        simd: Simd | str = Simd.AUTO,
        log: Log | None = None,
    ) -> None:
        values = None if material is None else np.asarray(material)
        wanted = values.shape if values is not None else shape
        if wanted is None or not 1 <= len(wanted) <= 3:
            raise ValueError(f"a graph needs material or a shape of one to three dimensions, not {wanted}")
        depth, height, width = (1,) * (3 - len(wanted)) + tuple(int(size) for size in wanted)
        self._shape = (depth, height, width)
        self._callbacks = Callbacks(weight=weight, log=log)
        self._guard = Guard("Graph")
        low, high = material_range if material_range is not None else (None, None)
        options = filled_options(
            "locus_graph_options", lib.locus_graph_options_init, dims=self._shape[::-1], spacing=spacing, connectivity=connectivity,
            weight_rule=enum_value(WeightRule, weight_rule), material=enum_value(Material, kind), word_bits=int(word),
            stiffness_exponent=stiffness_exponent, max_seeds=max_seeds, scale=scale, precision=precision, material_min=low,
            material_max=high, threads=threads, backend=enum_value(Backend, backend), simd=enum_value(Simd, simd),
        )  # fmt: skip
        if weight is not None:
            options.weight, options.weight_user = _on_weight, self._callbacks.handle
        if log is not None:
            options.log, options.log_user = callbacks.on_log, self._callbacks.handle
        array = None if values is None else readable(values, np.float32, "material")
        made = ffi.new("locus_graph **")
        status = lib.locus_graph_create(options, ffi.NULL if array is None else pointer(array, "float *"), made)
        self._handle = ffi.gc(made[0], lib.locus_graph_destroy)
        self._callbacks.settle(status)

    def __repr__(self) -> str:
        return f"<locus.Graph {' x '.join(str(size) for size in self._shape[::-1])}, {self.info.passable} passable>"

    @property
    def shape(self) -> tuple[int, int, int]:
        """The shape of an array of all voxels: (z, y, x)."""
        return self._shape

    @property
    def info(self) -> GraphInfo:
        """What the graph was made of: word width, scale, error bounds, memory."""
        info = empty_struct("locus_graph_info")
        with self._guard.reading():
            self._callbacks.settle(lib.locus_graph_get_info(self._handle, info))
        return filled(GraphInfo, info)

    def set_box(self, box: Box, values: ArrayLike) -> None:
        """Replace the materials of a box.

        Parameters
        ----------
        box : VoxelBox, tuple of slices (z, y, x), or None
            None is the whole grid.
        values : array_like
            A value per voxel, of the box's shape (z, y, x), or one value for all; NaN removes the material.
        """
        where = box_of(box, self._shape)
        if np.ndim(values) == 0:
            with self._guard.writing():
                self._callbacks.settle(lib.locus_graph_fill_box(self._handle, c_box(where), float(values)))  # type: ignore[arg-type]
            return
        array = readable(values, np.float32, "values", where.shape)
        with self._guard.writing():
            self._callbacks.settle(lib.locus_graph_set_box(self._handle, c_box(where), pointer(array, "float *")))

    def set_voxels(self, voxels: ArrayLike, values: ArrayLike) -> None:
        """Replace the materials of voxels given by their indices; `values` holds one for each."""
        indices = readable(voxels, np.uint64, "voxels")
        array = readable(values, np.float32, "values", indices.shape)
        with self._guard.writing():
            self._callbacks.settle(
                lib.locus_graph_set_voxels(self._handle, pointer(indices, "uint64_t *"), pointer(array, "float *"), indices.size)
            )

    def get_box(self, box: Box = None, out: Array | None = None) -> Array:
        """Read the materials of a box back: a float32 array (z, y, x), NaN where impassable, or into `out`."""
        where = box_of(box, self._shape)
        array = writable(out, np.float32, where.shape)
        with self._guard.reading():
            self._callbacks.settle(lib.locus_graph_get_box(self._handle, c_box(where), pointer(array, "float *"), array.size))
        return array

    def edge_weight(self, u: int, v: int) -> int:
        """The weight, in steps, of the edge between two voxels given by their indices; 0: there is no such edge."""
        steps = ffi.new("uint64_t *")
        with self._guard.reading():
            self._callbacks.settle(lib.locus_graph_edge_weight(self._handle, u, v, steps))
        return int(steps[0])

    def cut_plane(self, point: tuple[float, float, float], normal: tuple[float, float, float], box: Box = None) -> int:
        """Disable every edge that a plane separates, in units of the spacing; returns how many were whole before."""
        edges = ffi.new("uint64_t *")
        place = c_box(box_of(box, self._shape))
        with self._guard.writing():
            self._callbacks.settle(lib.locus_graph_cut_plane(self._handle, list(point), list(normal), place, edges))
        return int(edges[0])

    def cut_mesh(self, vertices: ArrayLike, triangles: ArrayLike) -> int:
        """Disable every edge that a triangle mesh separates; returns how many were whole before.

        Parameters
        ----------
        vertices : array_like
            (n, 3) coordinates (x, y, z), in units of the spacing.
        triangles : array_like
            (m, 3) indices of vertices.
        """
        corners = readable(vertices, np.float64, "vertices").reshape(-1, 3)
        faces = readable(triangles, np.uint32, "triangles").reshape(-1, 3)
        edges = ffi.new("uint64_t *")
        with self._guard.writing():
            self._callbacks.settle(
                lib.locus_graph_cut_mesh(
                    self._handle, pointer(corners, "double *"), len(corners), pointer(faces, "uint32_t *"), len(faces), edges
                )
            )
        return int(edges[0])

    def mend_box(self, box: Box = None) -> int:
        """Undo the cuts of all edges with an end in the box; returns how many they were."""
        edges = ffi.new("uint64_t *")
        with self._guard.writing():
            self._callbacks.settle(lib.locus_graph_mend_box(self._handle, c_box(box_of(box, self._shape)), edges))
        return int(edges[0])
