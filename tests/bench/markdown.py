"""The rows of a benchmark run as a Markdown table: markdown.py FILE.jsonl [REGEX on the case name]."""
import json
import re
import sys


def short(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}"


def cell(row, peer):
    goal = row.get("goals", {}).get(peer)
    return f"{peer} {short(row['ratio'][peer])}" + (f" ({short(goal)})" if goal else "")


only = re.compile(sys.argv[2] if len(sys.argv) > 2 else "")
latest = {}
for line in open(sys.argv[1], encoding="utf-8"):
    row = json.loads(line)
    if only.search(row["case"]):
        latest[row["case"]] = row
print("| case | unit | T | ours | min | times ours (goal) |")
print("|---|---|---|---|---|---|")
for row in latest.values():
    peers = ", ".join(cell(row, peer) for peer in row["peers"])
    note = "" if row["checked"] else " **not checked**"
    print(f"| `{row['case']}`{note} | {row['unit']} | {row['threads']} | {short(row['ours'])} | {short(row['min'])} | {peers} |")
