"""What the tests share: plain models to compare with."""

import heapq
import itertools
import math
import signal
import threading

import numpy as np
import pytest

# Tests that are started in the background inherit an interrupt that is ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)

OFFSETS = [offset for offset in itertools.product((-1, 0, 1), repeat=3) if any(offset)]


def dijkstra(material, sources, spacing=(1.0, 1.0, 1.0), connectivity=26):
    """Distances from voxels (x, y, z) over an array (z, y, x) of compliances: the textbook algorithm, in doubles."""
    most = {6: 1, 18: 2, 26: 3}[connectivity]
    distance = np.full(material.shape, math.inf)
    passable = np.isfinite(material) & (material >= 0)
    heap = [(start, (z, y, x)) for (x, y, z), start in sources]
    for start, voxel in heap:
        distance[voxel] = min(distance[voxel], start)
    heapq.heapify(heap)
    while heap:
        far, voxel = heapq.heappop(heap)
        if far > distance[voxel]:
            continue
        for offset in OFFSETS:
            if sum(map(abs, offset)) > most:
                continue
            other = tuple(a + b for a, b in zip(voxel, offset))
            if any(a < 0 or a >= size for a, size in zip(other, material.shape)) or not passable[other]:
                continue
            length = math.sqrt(sum((step * size) ** 2 for step, size in zip(offset, spacing[::-1])))
            reached = far + length * (float(material[voxel]) + float(material[other])) / 2
            if reached < distance[other]:
                distance[other] = reached
                heapq.heappush(heap, (reached, other))
    return distance


def metres(latitude, longitude, latitudes, longitudes):
    """Great-circle distances by the haversine formula."""
    a, b = np.radians(latitude), np.radians(latitudes)
    half = np.sin((b - a) / 2) ** 2 + np.cos(a) * np.cos(b) * np.sin(np.radians(longitudes - longitude) / 2) ** 2
    return 2 * 6371008.7714 * np.arcsin(np.minimum(1, np.sqrt(half)))


@pytest.fixture
def random():
    return np.random.default_rng(1)


NOON = 1_700_000_000 * 1_000_000


def posts(random, count, dtype, start=NOON):
    """Records all over the world, a second apart."""
    records = np.zeros(count, dtype)
    records["latitude"] = random.uniform(-90, 90, count)
    records["longitude"] = random.uniform(-180, 180, count)
    records["time"] = start + np.arange(count) * 1_000_000
    if "device" in dtype.names:
        records["device"] = random.integers(0, 5, count)
        records["spare"] = np.arange(count) % 65536
    return records


def asked_beside_the_writer(store, records, ask):
    """Insert 200 batches while two threads call `ask` all the time; whether it never returned anything true."""
    wrong, done = [], threading.Event()

    def keep_asking():
        while not done.is_set():
            if ask():
                wrong.append(1)

    threads = [threading.Thread(target=keep_asking) for _ in range(2)]
    for thread in threads:
        thread.start()
    for batch in np.split(records, 200):
        store.insert(batch, int(batch["time"].max()))
    done.set()
    for thread in threads:
        thread.join()
    return not wrong
