#!/usr/bin/env python3
"""eigenring beside OpenSubdiv: Catmull-Clark refinement, and limit positions of its vertices.

Compiles opensubdiv.cpp of this folder against OpenSubdiv 3.5 or newer (Debian: libosd-dev). Where it
is installed elsewhere, CPATH, LIBRARY_PATH and LD_LIBRARY_PATH say so; CXX names the compiler.
Topology is part of both times.
"""

import peers

given = peers.arguments(__doc__, levels=6)

import eigenring
import numpy as np

mesh = peers.control(given.mesh)
program = peers.compiled("opensubdiv", ["-losdCPU"], "OpenSubdiv is not installed: Debian has libosd-dev")
times, points = peers.run(program, mesh, given.levels, given.repeat)
[ours], [refined] = peers.timed(given.repeat, lambda: mesh.subdivide("catmull-clark", given.levels))
print(f"eigenring {eigenring.__version__} with {given.threads} thread(s); OpenSubdiv's Far, one thread")
report = peers.Report("OpenSubdiv")
what = f"Catmull-Clark, {given.levels} levels to {len(refined.vertices)} vertices"
report.row(what, ours, times["refined"], peers.apart(refined.vertices, points["refined"]), 1e-12)
# each vertex of a refined mesh is a corner of some face: parameters 0 or 1
coarse = mesh.subdivide("catmull-clark", 3)
_, first = np.unique(coarse.faces.ravel(), return_index=True)
face, place = first // 4, first % 4
u, v = np.isin(place, (1, 2)).astype(float), np.isin(place, (2, 3)).astype(float)
times, points = peers.run(program, mesh, 3, given.repeat)
[ours], [found] = peers.timed(given.repeat, lambda: coarse.limit("catmull-clark", face, u, v))
what = f"{len(face)} limit positions at vertices (ours: derivatives and curvatures too)"
report.row(what, ours, times["limits"], peers.apart(found.points, points["limits"]), 1e-12)
report.end()
