#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do other programs read what export_roadmap writes, and do they all see the same roadmap?

    read_exports.py EXPORT_SAMPLES

Exports are read by networkx (GraphML), SciPy (npz), zipfile, and by readers written from the formats' own rules:
DIMACS, Nav2's loader of route graphs, tables, Graphviz. The shortest paths in each must be as long as the program's.
Where networkx or SciPy is missing (Debian: python3-networkx, python3-scipy) the others read, and the exit code is 77.
"""

import csv
import heapq
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import zipfile

try:
    import networkx
except ImportError:
    networkx = None
try:
    import numpy
    import scipy.sparse
    import scipy.sparse.csgraph
except ImportError:
    scipy = None

UNSIGNED = 2**32 - 1  # Nav2's "no id"


def expect(condition, what):
    if not condition:
        raise AssertionError(what)


def dijkstra(vertices, arcs):
    """Lengths from vertex 0. arcs: {(from, to): length}."""
    rows = [[] for _ in range(vertices)]
    for (v, w), length in arcs.items():
        rows[v].append((w, length))
    lengths = [math.inf] * vertices
    lengths[0] = 0
    queue = [(0, 0)]
    while queue:
        length, v = heapq.heappop(queue)
        if length > lengths[v]:
            continue
        for w, more in rows[v]:
            if length + more < lengths[w]:
                lengths[w] = length + more
                heapq.heappush(queue, (lengths[w], w))
    return lengths


def both_ways(arcs):
    return {**arcs, **{(w, v): length for (v, w), length in arcs.items()}}


def read_tables(stem, directed):
    with open(stem + ".csv", newline="") as file:
        vertices = list(csv.DictReader(file))
    expect([int(row["id"]) for row in vertices] == list(range(len(vertices))), "ids of vertices count from 0")
    names = [name for name in vertices[0] if name not in ("id", "component")]
    states = [[float(row[name]) for name in names] for row in vertices]
    with open(stem + ".edges.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    expect({row["state"] for row in rows} <= {"free", "unchecked"}, "states of edges")
    arcs = {(int(row["from"]), int(row["to"])): float(row["length"]) for row in rows}
    expect(len(arcs) == len(rows), "no edge twice")
    unchecked = {(int(row["from"]), int(row["to"])) for row in rows if row["state"] == "unchecked"}
    return names, states, [int(row["component"]) for row in vertices], arcs if directed else both_ways(arcs), unchecked


def read_graphml(stem, names):
    graph = networkx.read_graphml(stem + ".graphml", node_type=int)
    states = [[graph.nodes[v][name] for name in names] for v in range(len(graph))]
    components = [graph.nodes[v]["component"] for v in range(len(graph))]
    arcs = {(v, w): length for v, w, length in graph.edges(data="length")}
    unchecked = {(v, w) for v, w, state in graph.edges(data="state") if state == "unchecked"}
    expect(all(state in ("free", "unchecked") for _, _, state in graph.edges(data="state")), "default of state")
    reached = networkx.single_source_dijkstra_path_length(graph, 0, weight="length")
    lengths = [reached.get(v, math.inf) for v in range(len(graph))]
    return graph.is_directed(), states, components, arcs if graph.is_directed() else both_ways(arcs), unchecked, lengths


def read_npz(stem):
    matrix = scipy.sparse.load_npz(stem + ".npz")
    expect(matrix.format == "csr" and matrix.has_canonical_format, "rows ascend")
    more = numpy.load(stem + ".npz")
    entries = matrix.tocoo()
    arcs = {(int(v), int(w)): float(x) for v, w, x in zip(entries.row, entries.col, entries.data)}
    lengths = scipy.sparse.csgraph.dijkstra(matrix, indices=0)
    states = more["edge_states"] if "edge_states" in more else numpy.ones(matrix.nnz)
    unchecked = {(int(v), int(w)) for v, w, state in zip(entries.row, entries.col, states) if state == 0}
    return more["states"].tolist(), more["component"].tolist(), arcs, unchecked, lengths.tolist()


def unit_of(comment):
    return 2.0 ** int(re.fullmatch(r"c .* in units of 2\^(-?\d+)\n", comment).group(1))


def read_dimacs(stem):
    arcs = {}
    with open(stem + ".gr") as file:
        unit = unit_of(next(file))
        kind, problem, vertices, count = next(file).split()
        expect((kind, problem) == ("p", "sp"), "the line of the problem")
        for line in file:
            letter, v, w, weight = line.split()
            expect(letter == "a" and 0 <= int(weight) < 2**31, line)
            expect(1 <= int(v) <= int(vertices) and 1 <= int(w) <= int(vertices), line)
            arcs[int(v) - 1, int(w) - 1] = int(weight)
    expect(len(arcs) == int(count) and max(arcs.values()) >= 2**30 - 1, "as many arcs as it says, in the finest unit")
    with open(stem + ".co") as file:
        place_unit = unit_of(next(file))
        expect(next(file).split() == ["p", "aux", "sp", "co", vertices], "the line of the coordinates")
        lines = [line.split() for line in file]
    expect([line[:2] for line in lines] == [["v", str(v + 1)] for v in range(int(vertices))], "all vertices")
    return unit, arcs, place_unit, [[int(x) for x in line[2:]] for line in lines]


def read_nav2(stem):
    """What GeoJsonGraphFileLoader asks of a file, and what Nav2's guide says of ids."""
    with open(stem + ".geojson") as file:
        features = json.load(file)["features"]
    nodes, edges, ids = {}, {}, set()
    for feature in features:
        properties, geometry = feature["properties"], feature["geometry"]
        number = properties["id"]
        expect(isinstance(number, int) and 0 <= number < UNSIGNED and number not in ids, f"id {number}")
        ids.add(number)
        if geometry["type"] == "Point":
            expect(properties["frame"] == "map", "frame")
            nodes[number] = geometry["coordinates"]
            for value in properties.get("metadata", {}).values():
                expect(isinstance(value, float), "a heading is a float to Nav2")
        else:
            expect(geometry["type"] == "MultiLineString" and len(geometry["coordinates"]) == 1, "geometry of an edge")
            edges[properties["startid"], properties["endid"]] = (properties["cost"], geometry["coordinates"][0])
    expect(nodes and edges, "Nav2 wants nodes and edges")
    expect(len(ids) == len(nodes) + len(edges), "no edge twice")
    for (v, w), (_, line) in edges.items():
        expect(line == [nodes[v], nodes[w]], f"line of edge {v} -> {w}")
    return [nodes[v] for v in range(len(nodes))], {arc: float(cost) for arc, (cost, _) in edges.items()}


def read_dot(stem):
    arcs = {}
    with open(stem + ".dot") as file:
        for v, arrow, w, length in re.findall(r'^(\d+) (--|->) (\d+) \[len="(.*?)"', file.read(), re.M):
            arcs[int(v), int(w)] = float(length)
    return arcs if arrow == "->" else both_ways(arcs)


def check_sample(stem, directed, in_plane):
    with open(stem + ".lengths") as file:
        wanted = [float(line) for line in file]
    expect(sum(map(math.isfinite, wanted)) > len(wanted) / 3, "a sample with paths")

    def agrees(lengths, by, error=0.0):
        for v, (a, b) in enumerate(zip(lengths, wanted, strict=True)):
            expect(a == b or math.isclose(a, b, rel_tol=1e-12, abs_tol=error), f"{by}: {a} to {v}, not {b}")

    names, states, components, arcs, unchecked = read_tables(stem, directed)
    agrees(dijkstra(len(states), arcs), "tables")
    with zipfile.ZipFile(stem + ".npz") as archive:
        expect(archive.testzip() is None, "check sums")
    if networkx:
        is_directed, *same, lengths = read_graphml(stem, names)
        expect(is_directed == directed and same == [states, components, arcs, unchecked], "GraphML")
        agrees(lengths, "networkx")
    if scipy:
        *same, both_unchecked, lengths = read_npz(stem)
        expect(same == [states, components, arcs], "npz")
        expect(both_unchecked == (unchecked if directed else unchecked | {(w, v) for v, w in unchecked}), "edge_states")
        agrees(lengths, "SciPy")
    unit, weights, place_unit, places = read_dimacs(stem)
    expect(weights == {arc: math.floor(length / unit + 0.5) for arc, length in arcs.items()}, "weights")
    size = 2 if in_plane else len(names)
    for place, state in zip(places, states, strict=True):
        near = all(abs(x * place_unit - y) <= place_unit / 2 for x, y in zip(place, state))
        expect(len(place) == size and near, "coordinates")
    agrees([length * unit for length in dijkstra(len(states), weights)], "DIMACS", unit / 2 * len(states))
    if in_plane:
        nodes, costs = read_nav2(stem)
        expect(nodes == [state[:2] for state in states] and costs == arcs, "route graph")
    expect(read_dot(stem) == arcs, "dot")
    expect(len(arcs) > len(states), "more edges than vertices")
    return len(unchecked)


def check_long_zip(path):
    with zipfile.ZipFile(path) as archive:
        expect(archive.testzip() is None, "check sums of ZIP64")
        for size in (0, 99, 100, 70_000):
            expect(archive.read(f"member{size}") == b"w" * size, f"member of {size} bytes")
    with open(path, "rb") as file:
        expect(b"PK\x06\x06" in file.read(), "an end as ZIP64 has it")


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        expect(check_sample(os.path.join(folder, "point"), False, True) == 0, "free edges alone")
        expect(check_sample(os.path.join(folder, "lazy"), False, True) > 0, "unchecked edges, too")
        check_sample(os.path.join(folder, "car"), True, True)
        check_sample(os.path.join(folder, "arm"), False, False)
        check_long_zip(os.path.join(folder, "long.zip"))
    if not networkx or not scipy:
        print("networkx or SciPy is missing: their part is skipped; Debian has python3-networkx and python3-scipy")
        sys.exit(77)


main()
