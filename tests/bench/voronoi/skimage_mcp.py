"""Distances on a cube by scikit-image: skimage_mcp.py FOLDER SIDE.

Reads compliance.raw (float32, x fastest) and starts.raw (int64 triples z, y, x), prints the CPU milliseconds of
find_costs and writes costs.raw (float64). MCP_Geometric's edge costs are the default weight rule: length * mean cost.
"""
import sys
import time

import numpy
from skimage.graph import MCP_Geometric

folder, side = sys.argv[1], int(sys.argv[2])
compliance = numpy.fromfile(folder + "/compliance.raw", numpy.float32).reshape(side, side, side)
starts = numpy.fromfile(folder + "/starts.raw", numpy.int64).reshape(-1, 3)
paths = MCP_Geometric(compliance, fully_connected=True)
start = time.process_time()
costs, _ = paths.find_costs([tuple(place) for place in starts])
print(1e3 * (time.process_time() - start))
costs.tofile(folder + "/costs.raw")
