#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Instructions per call of the hot functions, from a file of callgrind, as a table in Markdown."""
import re
import sys

HOT = [
    "RidgeMap::insert", "RidgeMap::update", "Lattice::refresh", "KernelSpreader::add", "makeProfile", "addChanges",
    "applyChanges", "placeCorner", "layEdge", "traceTile", "TileField::TileField", "copyNodes", "interpolateNodes",
    "makeRidgePoint", "Chains::update",
]


def read(path):
    """Calls and instructions, callees included, of every function that was called."""
    names, calls, cost, callee, count = {}, {}, {}, None, None
    with open(path, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if count is not None:  # the line behind calls= holds the cost of these calls
                calls[callee] = calls.get(callee, 0) + count
                cost[callee] = cost.get(callee, 0) + int(line.split()[1])
                count = None
            elif line.startswith(("fn=", "cfn=")):
                number, name = re.match(r"c?fn=\((\d+)\)(?: (.*))?", line).groups()
                if name:
                    names[number] = name
                callee = names[number]
            elif line.startswith("calls="):
                count = int(line[6:].split()[0])
    return calls, cost


def main():
    calls, cost = read(sys.argv[1])
    print("| function | calls | instructions per call |\n|---|---:|---:|")
    for hot in HOT:
        pattern = re.compile(r"^ridgemap::" + re.escape(hot) + r"\(")
        found = [name for name in calls if pattern.match(name)]
        n = sum(calls[name] for name in found)
        if n:
            print(f"| `{hot}` | {n} | {sum(cost[name] for name in found) / n:.0f} |")


main()
