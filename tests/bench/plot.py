"""Figures 3.9 and 3.10 of the thesis from a benchmark run: plot.py FILE.jsonl FOLDER; needs python3-matplotlib."""
import json
import os
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

NAMES = {"": "ring leaves", "array": "packed array, implicit", "array_explicit": "packed array, explicit", "vector_sort": "dense vector"}


def series(row, pattern):
    """(peer, sorted points) of the extras whose names match, a peer's with its name in front."""
    for peer in ["", *row["peers"]]:
        prefix = peer + "_" if peer else ""
        points = []
        for name, value in row.items():
            match = re.fullmatch(prefix + pattern, name)
            if match:
                points.append((float(match.group(1)), value))
        yield peer, sorted(points)


def radius(row, path):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), sharex=True)
    for axis, what in zip(axes, ("count", "read")):
        for peer, points in series(row, what + r"_us_(\d+)km"):
            axis.plot([x for x, _ in points], [y / 1000 for _, y in points], "o-", ms=4, label=NAMES.get(peer, peer))
        axis.set(xscale="log", yscale="log", xlabel="R, half of the square's side (km)", title=what)
        axis.grid(True, which="both", alpha=0.25)
    axes[0].set_ylabel("ms a query, thread-CPU time")
    axes[1].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def latencies(row, path):
    figure, axis = plt.subplots(figsize=(6.5, 4.5))
    for peer, points in series(row, r"p(\d+)_ms"):
        axis.plot([y for _, y in points], [x for x, _ in points], label=NAMES.get(peer, peer))
    axis.plot([row["thesis_p90_ms"]], [90], "k*", ms=9, label="the thesis' PMQ: 90 % under 4 ms")
    axis.set(xscale="log", xlabel="latency (ms)", ylabel="queries answered (%)", ylim=(0, 102), title="top-k, K = 100, R = 30 km")
    axis.grid(True, which="both", alpha=0.25)
    axis.legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


DRAW = {"thesis.fig3.9": radius, "thesis.fig3.10": latencies}
with open(sys.argv[1], encoding="utf-8") as lines:
    rows = {row["case"]: row for row in map(json.loads, lines)}
missing = [case for case in DRAW if case not in rows]
for case, draw in DRAW.items():
    if case in rows:
        path = os.path.join(sys.argv[2], case + ".png")
        draw(rows[case], path)
        print(path)
if missing:
    sys.exit(f"{sys.argv[1]} has no row {' nor '.join(missing)}: make bench ONLY='^thesis.fig3.(9|10)$'")
