"""Tables 3.2 and 3.3 and figures 3.8 to 3.10 of the thesis from a benchmark run: plot.py FILE.jsonl FOLDER; needs python3-matplotlib."""
import json
import os
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

NAMES = {"": "ring leaves", "array": "packed array, implicit", "array_explicit": "packed array, explicit", "array_heads": "packed array, heads",
         "vector_sort": "dense vector"}


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


STEADY = ("", "array", "array_heads")
COLOURS = dict(zip(STEADY, ("C0", "C1", "C2")))
# Milliseconds: table 3.2 by hours, table 3.3 by records a batch.
THESIS_MEAN = {3: 1.209, 6: 1.310, 9: 1.278, 12: 1.423}
THESIS_LONGEST = {3: 265.613, 6: 554.971, 9: 1007.040, 12: 1045.950}
THESIS_REMOVAL = {250: 136.97, 500: 259.33, 1000: 554.97, 2000: 1034.65, 4000: 2092.26}


def value(row, peer, name):
    return row[f"{peer}_{name}" if peer else name]


def mean(row, peer):
    return row["peers"][peer] if peer else row["ours"]


def tables(rows, path):
    """Table 3.2, mean and longest against the horizon; table 3.3, the longest call against the rate."""
    horizons = numbered(rows, r"thesis\.table3\.2\.(\d+)h")
    rates = numbered(rows, r"thesis\.fig3\.8\.b(\d+)")
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True)
    for peer in STEADY:
        style = {"color": COLOURS[peer], "label": NAMES[peer]}
        axes[0].plot(list(horizons), [mean(row, peer) for row in horizons.values()], "o-", **style)
        axes[0].plot(list(horizons), [value(row, peer, "p100_ms") for row in horizons.values()], "^:", color=COLOURS[peer])
        axes[1].plot(list(rates), [value(row, peer, "p100_ms") for row in rates.values()], "^:", **style)
    axes[0].plot(list(THESIS_MEAN), list(THESIS_MEAN.values()), "k*-", label="the thesis")
    axes[0].plot(list(THESIS_LONGEST), list(THESIS_LONGEST.values()), "k^:")
    axes[1].plot(list(THESIS_REMOVAL), list(THESIS_REMOVAL.values()), "k^:", label="the thesis")
    axes[0].set(yscale="log", xlabel="horizon (hours of 1000 records a second)", ylabel="ms a batch", title="mean and, dotted, the longest")
    axes[1].set(xscale="log", xlabel="records a batch, horizon 6 h", title="the longest call")
    for axis in axes:
        axis.grid(True, which="both", alpha=0.25)
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def steady(rows, path):
    """Figure 3.8: (a) the course of the steady phase, means of stretches; (b) how the batches' times are distributed."""
    rates = numbered(rows, r"thesis\.fig3\.8\.b(\d+)")
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True)
    for peer in STEADY:
        for batch, row in rates.items():
            prefix = peer + "_" if peer else ""
            points = sorted((int(name[len(prefix) + 4:-3]), ms) for name, ms in row.items() if re.fullmatch(prefix + r"step\d+_ms", name))
            axes[0].plot(*zip(*points), color=COLOURS[peer], lw=1, label=NAMES[peer] if batch == 250 else None)
            axes[0].annotate(str(batch), points[0], fontsize=7, ha="right")
        boxes = [{"med": value(row, peer, "p50_ms"), "q1": value(row, peer, "p25_ms"), "q3": value(row, peer, "p75_ms"),
                  "whislo": value(row, peer, "p0_ms"), "whishi": value(row, peer, "p99_ms"), "mean": mean(row, peer),
                  "fliers": [value(row, peer, "p100_ms")], "label": str(batch)} for batch, row in rates.items()]
        axes[1].bxp(boxes, positions=[i + 0.25 * (STEADY.index(peer) - 1) for i in range(len(boxes))], widths=0.2, showmeans=True,
                    boxprops={"color": COLOURS[peer]}, flierprops={"marker": "^", "ms": 4, "mec": COLOURS[peer]},
                    medianprops={"color": COLOURS[peer]}, meanprops={"marker": "D", "ms": 3, "mec": "r", "mfc": "r"})
    axes[1].set_xticks(range(len(rates)), [str(batch) for batch in rates])
    axes[0].set(yscale="log", xlabel="batch of the steady phase", ylabel="ms a batch, thread-CPU time", title="(a) means over stretches, by records a batch")
    axes[1].set(xlabel="records a batch", title="(b) whiskers to the 99th percentile, triangle the longest")
    axes[0].legend(loc="upper right")
    for axis in axes:
        axis.grid(True, which="major", alpha=0.25)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def numbered(rows, pattern):
    """The rows whose names match, by the number in the name."""
    found = {int(match.group(1)): row for name, row in rows.items() if (match := re.fullmatch(pattern, name))}
    return dict(sorted(found.items()))


# What is drawn from one row, and what from all of a family.
DRAW = {"thesis.fig3.9": lambda rows, path: radius(rows["thesis.fig3.9"], path),
        "thesis.fig3.10": lambda rows, path: latencies(rows["thesis.fig3.10"], path),
        "thesis.fig3.8": steady, "thesis.table3.2": tables}
with open(sys.argv[1], encoding="utf-8") as lines:
    rows = {row["case"]: row for row in map(json.loads, lines)}
missing = [case for case in DRAW if not any(name.startswith(case) for name in rows)]
for case, draw in DRAW.items():
    if case not in missing:
        path = os.path.join(sys.argv[2], case + ".png")
        draw(rows, path)
        print(path)
if missing:
    sys.exit(f"{sys.argv[1]} has no row {' nor '.join(missing)}: make bench ONLY='^thesis.(fig3.(8|9|10)|table3.2)'")
