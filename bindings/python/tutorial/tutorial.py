#!/usr/bin/python3
"""Tutorial: a head CT and a stream of posts, computed with Locus and drawn with matplotlib.

tutorial.py VOLUME FOLDER    VOLUME: the head CT of `make tutorial-python`, 256 x 256 x 108 numbers of 16 bits
"""

import sys
from pathlib import Path

import locus
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.colors import ListedColormap, LogNorm


def compliance_of(ct):
    """Hounsfield units to compliances: bone carries a wave fast, soft tissue slowly, air not at all."""
    compliance = np.full(ct.shape, np.nan, np.float32)
    compliance[ct >= -300] = 1.0
    compliance[ct >= 226] = 0.1
    return compliance


def head(path, folder):
    # 1. Read. The file has no header, so we say how its numbers lie; `keep` leaves them int16, and the array is the
    #    library's own memory. Its rows run from the back to the front: turned here.
    spacing = (0.957, 0.957, 1.5)
    volume = locus.read_volume(path, raw=locus.Raw((108, 256, 256), "<i2", spacing=spacing), keep=True)
    ct = volume.data[:, ::-1, :]
    print(f"head CT: {ct.shape} voxels (z, y, x) of {ct.dtype}, {ct.min()} to {ct.max()}")

    # 2. A graph of the material, and 60 seeds that the library places on it: far from each other, each in the middle
    #    of its cell.
    graph = locus.Graph(compliance_of(ct), spacing=spacing)
    diagram = locus.Diagram(graph)
    diagram.place_seeds(60, lloyd_iterations=3, progress=lambda done: print(f"\rplacing seeds {done:4.0%}", end="", flush=True))
    diagram.solve()
    print(f"\n{graph}, solved in {diagram.stats.seconds_solve * 1000:.0f} ms; {diagram.stats.reached} voxels have a seed")

    # 3. Labels and distances come back as arrays of the volume's shape; a slice is numpy's.
    z = 54
    here = np.s_[z : z + 1, :, :]
    labels = diagram.labels(here)[0].astype(float)
    labels[labels == locus.NO_SEED] = np.nan
    distances = diagram.distances(here)[0]
    distances[np.isinf(distances)] = np.nan
    extent = (0, 256 * spacing[0], 0, 256 * spacing[1])
    draw = {"origin": "upper", "extent": extent, "interpolation": "nearest"}
    colours = ListedColormap(np.random.default_rng(2).uniform(0.2, 1, (60, 3)))
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.6), constrained_layout=True)
    axes[0].imshow(ct[z], cmap="gray", vmin=-200, vmax=900, **draw)
    axes[0].set_title("head CT, slice 54")
    axes[1].imshow(labels, cmap=colours, vmin=-0.5, vmax=59.5, **draw)
    axes[1].set_title("cells of 60 seeds in the whole head")
    shown = axes[2].imshow(distances, cmap="viridis", **draw)
    axes[2].set_title("distance to the nearest seed")
    figure.colorbar(shown, ax=axes[2], label="distance (mm of soft tissue)", shrink=0.8)
    for axis in axes:
        axis.set_xlabel("mm")
    figure.savefig(folder / "diagram.png", dpi=110)

    # 4. Sibson weights of a slice: how much each seed counts there. At half the resolution, with the same seeds.
    half = locus.Graph(compliance_of(ct[::2, ::2, ::2]), spacing=tuple(2 * size for size in spacing))
    seeds = diagram.seeds
    places = np.stack([seeds[axis] // 2 for axis in "xyz"], axis=-1)
    passable = np.isfinite(half.get_box())
    inside = passable[places[:, 2], places[:, 1], places[:, 0]]
    coarse = locus.Diagram(half)
    coarse.add_seeds(places[inside], ids=seeds["id"][inside])
    coarse.solve()
    box = np.s_[z // 2 : z // 2 + 1, 20:108, 20:108]
    weights = locus.Weights(coarse, "sibson", box=box, progress=lambda done: print(f"\rweights {done:4.0%}", end="", flush=True))
    dense = weights.volume(weights.dense())[0]
    sums = dense.sum(axis=-1)[passable[z // 2, 20:108, 20:108]]
    print(f"\n{weights}: rows sum to {sums.min():.4f} .. {sums.max():.4f}")
    strongest = np.argsort(dense.sum(axis=(0, 1)))[::-1][:3]
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.6), constrained_layout=True)
    draw["extent"] = (40 * spacing[0], 216 * spacing[0], (256 - 216) * spacing[1], (256 - 40) * spacing[1])
    for axis, seed in zip(axes, strongest):
        empty = dense.sum(axis=-1) == 0
        shown = axis.imshow(np.where(empty, np.nan, dense[:, :, seed]), cmap="magma", vmin=0, vmax=1, **draw)
        axis.set_facecolor("0.8")
        axis.set_title(f"weight of seed {weights.seed_ids[seed]}")
        axis.set_xlabel("mm")
    figure.colorbar(shown, ax=axes[-1], label="Sibson weight", shrink=0.8)
    figure.savefig(folder / "weights.png", dpi=110)


def stream(folder):
    # 1. A day of posts around some cities, most of them in the evening, in batches of a minute.
    random = np.random.default_rng(4)
    cities = np.array([(48.86, 2.35), (51.5, -0.12), (52.52, 13.4), (40.42, -3.7), (41.9, 12.5), (45.5, 9.19), (50.85, 4.35)])
    start = np.datetime64("2024-06-01T00:00", "us")

    # 2. A window of six hours; what leaves it goes through `sink` as arrays.
    gone = []
    store = locus.Store(horizon=np.timedelta64(6, "h"), sink=lambda records: gone.append(len(records)))
    for minute in range(24 * 60):
        count = random.poisson(150 * (1.2 + np.sin((minute / 720 - 0.9) * np.pi)))
        posts = np.zeros(count, locus.POINT32)
        near = cities[random.integers(0, len(cities), count)] + random.normal(0, 0.35, (count, 2)) * random.exponential(1, (count, 1))
        posts["latitude"], posts["longitude"] = near.T
        now = start + np.timedelta64(minute + 1, "m")
        posts["time"] = now.astype(int) - random.integers(0, 60_000_000, count)
        store.insert(posts, now)
    print(f"{store}, {sum(gone)} have left; longest pause {store.stats.longest_pause_ns / 1e6:.2f} ms")
    paris = store.read(locus.Query(circle=(48.86, 2.35, 20_000), since=now - np.timedelta64(1, "h")))
    print(f"{len(paris)} posts within 20 km of Paris in the last hour")

    # 3. A heat map straight from the store: one tile of 256 x 256 bins, and a closer one.
    figure, axes = plt.subplots(1, 2, figsize=(11.5, 5.4), constrained_layout=True)
    for axis, (zoom, x, y), title in zip(axes, ((4, 8, 5), (7, 64, 44)), ("western Europe", "around Paris")):
        bins = store.tile(zoom, x, y, 8).astype(float)
        shown = axis.imshow(np.where(bins > 0, bins, np.nan), cmap="inferno", norm=LogNorm(1, max(bins.max(), 10)))
        axis.set_facecolor("#101018")
        axis.set_title(f"{title}: tile {zoom}/{x}/{y}, {int(bins.sum())} posts")
        axis.set_xticks([])
        axis.set_yticks([])
        figure.colorbar(shown, ax=axis, label="posts of the last 6 hours per bin", shrink=0.85)
    figure.savefig(folder / "heat_map.png", dpi=110)


def main():
    path, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    print(f"Locus {locus.version()}")
    head(path, folder)
    stream(folder)
    print(f"pictures are in {folder}")


if __name__ == "__main__":
    main()
