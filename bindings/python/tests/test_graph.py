"""Graphs, diagrams and weights against textbook algorithms, and what their arrays are."""

import math

import locus
import numpy as np
import pytest
from conftest import dijkstra
from locus._ffi import ffi


def random_material(random, shape=(5, 6, 7)):
    material = random.uniform(0.5, 4, shape).astype(np.float32)
    material[random.random(shape) < 0.2] = np.nan
    return material


def passable_voxels(random, material, count):
    z, y, x = np.nonzero(np.isfinite(material))
    chosen = random.choice(len(z), count, replace=False)
    return [(int(x[i]), int(y[i]), int(z[i])) for i in chosen]


@pytest.mark.parametrize("connectivity", [6, 18, 26])
@pytest.mark.parametrize("engine", ["heap", "bucket", "relax", locus.Engine.BRICKS])
def test_distances_and_labels(random, connectivity, engine):
    material = random_material(random)
    spacing = (1.0, 0.5, 2.0)
    seeds = passable_voxels(random, material, 3)
    graph = locus.Graph(material, spacing=spacing, connectivity=connectivity)
    diagram = locus.Diagram(graph, engine=engine)
    diagram.add_seeds(seeds, ids=[7, 8, 9], distances=[0, 0.25, 0])
    diagram.solve()
    each = np.stack([dijkstra(material, [(seed, start)], spacing, connectivity) for seed, start in zip(seeds, (0, 0.25, 0))])
    wanted = each.min(axis=0)
    found = diagram.distances()
    assert found.dtype == np.float32 and found.shape == material.shape
    np.testing.assert_allclose(found, wanted, rtol=graph.info.weight_error + 1e-6)
    labels = diagram.labels()
    reached = np.isfinite(wanted)
    assert np.all(labels[~reached] == locus.NO_SEED)
    own = np.take_along_axis(each, np.where(reached, labels.astype(np.int64) - 7, 0)[None], 0)[0]
    np.testing.assert_allclose(own[reached], wanted[reached], rtol=2 * graph.info.weight_error + 1e-6)
    np.testing.assert_allclose(diagram.distances_exact()[reached] / graph.info.scale, found[reached], rtol=1e-6)
    assert diagram.cell_sizes().sum() == reached.sum() == diagram.stats.reached
    assert diagram.seeds["id"].tolist() == [7, 8, 9] and diagram.seeds["distance"].tolist() == [0, 0.25, 0]


def test_paths_go_from_voxel_to_seed(random):
    material = random_material(random)
    seeds = passable_voxels(random, material, 2)
    graph = locus.Graph(material)
    diagram = locus.Diagram(graph)
    diagram.add_seeds(seeds)
    distances = diagram.solve().distances_exact()
    for x, y, z in passable_voxels(random, material, 20):
        path = diagram.path((x, y, z))
        if diagram.labels()[z, y, x] == locus.NO_SEED:
            assert path.shape == (0, 3)
            continue
        assert tuple(path[0]) == (x, y, z) and tuple(path[-1]) in seeds
        index = path @ np.array([1, material.shape[2], material.shape[2] * material.shape[1]])
        steps = sum(graph.edge_weight(int(u), int(v)) for u, v in zip(index[:-1], index[1:]))
        assert steps == distances[z, y, x]


def test_edits_update_and_equal_a_fresh_solve(random):
    material = random_material(random, (8, 9, 10))
    graph = locus.Graph(material, material_range=(0.1, 20))
    diagram = locus.Diagram(graph)
    diagram.add_seeds(passable_voxels(random, material, 4), fixed=True)
    diagram.solve()
    before = diagram.distances_exact()
    graph.set_box(np.s_[2:5, 3:6, 4:8], 5.0)
    graph.set_box(locus.VoxelBox((0, 0, 0), (2, 1, 1)), [[[1.5, np.nan]]])
    graph.set_voxels([717, 718], [3, 4])
    cut = graph.cut_plane((4.5, 0, 0), (1, 0, 0))
    assert cut > 0
    change = diagram.update()
    after = diagram.distances_exact()
    fresh = locus.Diagram(graph, engine="heap")
    fresh.add_seeds(diagram.seeds)
    assert np.array_equal(fresh.solve().distances_exact(), after)
    changed = (before != after) | (fresh.labels() != diagram.labels())
    assert change.voxels >= np.count_nonzero(changed) > 0
    where = np.argwhere(before != after)[:, ::-1]
    assert np.all(where.min(axis=0) >= change.box.origin)
    assert np.all(where.max(axis=0) < np.add(change.box.origin, change.box.extent))
    assert graph.mend_box() == cut
    corners = [(4.5, -9, -9), (4.5, 99, -9), (4.5, 99, 99), (4.5, -9, 99)]
    assert graph.cut_mesh(corners, [(0, 1, 2), (0, 2, 3)]) == cut
    material[2:5, 3:6, 4:8] = 5
    material[0, 0, :2] = [1.5, np.nan]
    material.ravel()[[717, 718]] = [3, 4]
    np.testing.assert_array_equal(graph.get_box(), material)
    np.testing.assert_array_equal(graph.get_box(np.s_[1:2, :, 3:5]), material[1:2, :, 3:5])


def test_sibson_weights_by_their_definition(random):
    material = random_material(random, (4, 5, 6))
    graph = locus.Graph(material, precision=1e-4)
    diagram = locus.Diagram(graph)
    seeds = passable_voxels(random, material, 4)
    diagram.add_seeds(seeds, ids=[3, 1, 4, 5])
    diagram.solve()
    weights = locus.Weights(diagram)
    dense = weights.volume(weights.dense())
    nearest, labels = dijkstra(material, [(seed, 0) for seed in seeds]), diagram.labels()
    for x, y, z in passable_voxels(random, material, 25):
        if not np.isfinite(nearest[z, y, x]):
            assert not dense[z, y, x].any()
            continue
        if (x, y, z) in seeds:
            continue
        mine = dijkstra(material, [((x, y, z), 0)])
        # Ties, which rounding decides, are left out.
        close = np.isclose(mine, nearest, rtol=1e-3, atol=1e-3) & np.isfinite(mine)
        stolen = np.isfinite(mine) & (mine < nearest) & ~close
        counts = np.array([np.count_nonzero(stolen & (labels == one)) for one in (3, 1, 4, 5)])
        unsure = np.count_nonzero(close)
        assert np.all(np.abs(dense[z, y, x] - counts / max(counts.sum(), 1)) <= unsure / max(counts.sum(), 1) + 1e-6)


def test_weights_in_their_forms(random):
    graph = locus.Graph(np.ones((1, 9, 9), np.float32))
    diagram = locus.Diagram(graph)
    diagram.place_seeds(4, first_id=10)
    diagram.solve()
    for method in locus.Method:
        weights = locus.Weights(diagram, method)
        rows, dense = weights.rows(), weights.dense()
        assert len(weights) == 81 and len(rows.ids) == weights.entries
        rebuilt = np.zeros((81, 4), np.float32)
        owner = np.repeat(np.arange(81), np.diff(rows.offsets.astype(np.int64)))
        rebuilt[owner, rows.ids - 10] = rows.values
        np.testing.assert_array_equal(rebuilt, dense)
        np.testing.assert_allclose(dense.sum(axis=1), 1, atol=1e-5)
        values = random.random((4, 3)).astype(np.float32)
        np.testing.assert_allclose(weights.interpolate(values), dense @ values, atol=1e-5)
        np.testing.assert_allclose(weights.interpolate(values[:, 0]), dense @ values[:, 0], atol=1e-5)
        volume = weights.volume(dense)[0, :, :, 0]
        np.testing.assert_allclose(weights.gradients(10).reshape(9, 9, 3)[:, 1:-1, 0], (volume[:, 2:] - volume[:, :-2]) / 2, atol=1e-6)
    some = locus.Weights(diagram, voxels=[40, 0], max_per_row=1)
    assert len(some) == 2 and some.entries == 2
    with pytest.raises(ValueError, match="list of voxels"):
        some.volume(np.zeros(2))
    with pytest.raises(locus.StateError):
        some.gradients(10)
    with pytest.raises(ValueError, match=r"\(3,\) instead of \(4,\)"):
        some.interpolate([1, 2, 3])
    with pytest.raises(locus.ArgumentError):
        some.rows(1, 2)
    part = locus.Weights(diagram, box=np.s_[:, 2:4, 3:8])
    np.testing.assert_array_equal(part.volume(part.dense()), locus.Weights(diagram).dense().reshape(1, 9, 9, 4)[:, 2:4, 3:8])


def test_weights_follow_their_diagram():
    graph = locus.Graph(np.ones((9, 9), np.float32))
    diagram = locus.Diagram(graph)
    diagram.add_seeds([(0, 0, 0), (8, 8, 0)])
    diagram.solve()
    weights = locus.Weights(diagram, "laplace")
    diagram.add_seeds([(8, 0, 0)])
    assert diagram.seeds["id"].tolist() == [0, 1, 2]
    diagram.update()
    assert 0 < len(weights.update()) <= 81
    np.testing.assert_array_equal(weights.dense(), locus.Weights(diagram, "laplace").dense())
    del graph, diagram
    assert weights.interpolate([1, 2, 3]).shape == (81,)


def test_seeds_move_and_go():
    diagram = locus.Diagram(locus.Graph(np.ones(5, np.float32)))
    diagram.add_seeds([(0, 0, 0), (4, 0, 0)], ids=[7, 8])
    diagram.move_seed(8, (2, 0, 0))
    assert diagram.solve().labels().tolist() == [[[7, 7, 8, 8, 8]]]
    assert diagram.cell_pairs().tolist() == [(7, 8, 1)]
    diagram.remove_seeds(7)
    assert diagram.solve().labels().tolist() == [[[8, 8, 8, 8, 8]]]
    diagram.add_seeds(np.array([(4, 0, 0, 0.5, 9, 1)], locus.SEED))
    assert diagram.solve().distances().tolist() == [[[2, 1, 0, 1, 0.5]]]


def test_traces_and_infos():
    diagram = locus.Diagram(locus.Graph(np.ones((9, 9), np.float32)), engine="relax", record_trace=True, max_distance=3)
    diagram.add_seeds([(4, 4, 0)])
    diagram.solve()
    assert len(diagram.trace()) == diagram.stats.iterations and diagram.trace()[0] >= 1
    assert np.isinf(diagram.distances()[0, 0, 0])
    info = locus.Graph(shape=(2, 3, 4), material_range=(1, 2), spacing=(1, 2, 3)).info
    assert info.dims == (4, 3, 2) and info.spacing == (1, 2, 3) and info.passable == 0 and math.isfinite(info.scale)
    assert "4 x 3 x 2" in repr(locus.Graph(shape=(2, 3, 4), material_range=(1, 2)))
    assert "1 seeds" in repr(diagram)


def test_arrays_are_not_copied():
    diagram = locus.Diagram(locus.Graph(np.ones((3, 4, 5), np.float32)))
    diagram.add_seeds([(0, 0, 0)])
    diagram.solve()
    out = np.empty((3, 4, 5), np.float32)
    assert diagram.distances(out=out) is out and out[0, 0, 1] == 1
    whole = np.zeros((5, 4, 5), np.float32)
    assert np.shares_memory(diagram.distances(out=whole[1:4]), whole) and whole[1, 0, 2] == 2
    for bad in (np.empty((3, 4, 5)), np.empty((3, 4), np.float32), np.empty((3, 4, 10), np.float32)[:, :, ::2]):
        with pytest.raises(ValueError, match="C-contiguous"):
            diagram.distances(out=bad)
    weights = locus.Weights(diagram)
    assert np.shares_memory(weights.volume(values := weights.interpolate([2])), values)


class OnDevice:
    """What an array on a GPU says of itself; this one is the host's."""

    def __init__(self, array, **other):
        about = {"shape": array.shape, "typestr": array.dtype.str, "data": (array.ctypes.data, False), "version": 3}
        self.__cuda_array_interface__ = about | other


@pytest.mark.parametrize(
    "name, dtype", [("labels_on_device", "uint32"), ("distances_on_device", "float32"), ("distances_exact_on_device", "uint64")]
)
def test_results_on_the_device(monkeypatch, name, dtype):
    diagram = locus.Diagram(locus.Graph(np.ones((2, 3, 4)), backend="cpu"), on_device=True)
    diagram.add_seeds([[0, 0, 0]])
    read, array = getattr(diagram.solve(), name), np.zeros((2, 3, 4), dtype)
    with pytest.raises(locus.UnsupportedError, match="solved on the CPU"):
        read(OnDevice(array))
    for bad in (OnDevice(array[1:]), OnDevice(array, typestr="<f8"), OnDevice(array, strides=(1, 2, 3)), OnDevice(array, data=(1, True))):
        with pytest.raises(ValueError, match=f"C-contiguous {dtype} array of shape .2, 3, 4."):
            read(bad)
    library, asked = locus.diagram.lib, []

    class Watched:
        def __getattr__(self, function):
            return lambda *arguments: asked.append((function, *arguments)) or 0

    monkeypatch.setattr(locus.diagram, "lib", Watched())
    read(OnDevice(array))
    monkeypatch.setattr(locus.diagram, "lib", library)
    (function, _, _, address, capacity), = asked
    assert (function, int(ffi.cast("uintptr_t", address)), capacity) == ("locus_diagram_" + name, array.ctypes.data, 24)


def test_options_of_the_cuda_backend(monkeypatch):
    graph, seen = locus.Graph(np.ones(3)), []

    class Watched:
        def __getattr__(self, name):
            return getattr(library, name)

        def locus_diagram_create(self, graph, options, made):
            seen.append((tuple(options.grain), int(ffi.cast("uintptr_t", options.stream)), options.engine, options.on_device))
            return library.locus_diagram_create(graph, options, made)

    library = locus.diagram.lib
    monkeypatch.setattr(locus.diagram, "lib", Watched())
    locus.Diagram(graph)
    locus.Diagram(graph, grain=(16, 2, 1), stream=0x7F00, on_device=True)
    assert seen == [((8, 4, 4), 0, locus.Engine.AUTO, 0), ((16, 2, 1), 0x7F00, locus.Engine.AUTO, 1)]
    with pytest.raises(locus.UnsupportedError):
        locus.Diagram(locus.Graph(np.ones(3), backend="cpu"), engine="compact", grain=(8, 4, 4))
    with pytest.raises(ValueError, match="grain must be three numbers"):
        locus.Diagram(graph, grain=(1, 2))
    with pytest.raises(OverflowError):
        locus.Diagram(graph, grain=(-1, 2, 3))
