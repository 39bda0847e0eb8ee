#!/usr/bin/env python3
"""eigenring beside CGAL: Catmull-Clark and Doo-Sabin refinement of a closed mesh.

Compiles cgal.cpp of this folder against CGAL 5 or newer, which is headers alone (Debian: libcgal-dev).
Where it is installed elsewhere, CPATH and LIBRARY_PATH say so; CXX names the compiler. Topology is part
of both times.
"""

import peers

given = peers.arguments(__doc__, levels=5)

import eigenring

mesh = peers.control(given.mesh)
program = peers.compiled("cgal", ["-lgmp", "-lmpfr"], "CGAL is not installed: Debian has libcgal-dev")
times, points = peers.run(program, mesh, given.levels, given.repeat)
print(f"eigenring {eigenring.__version__} with {given.threads} thread(s); CGAL, one thread")
report = peers.Report("CGAL")
for scheme, name in [("catmull-clark", "Catmull-Clark"), ("doo-sabin", "Doo-Sabin")]:
    [ours], [refined] = peers.timed(given.repeat, lambda: mesh.subdivide(scheme, given.levels))
    what = f"{name}, {given.levels} levels to {len(refined.vertices)} vertices"
    report.row(what, ours, times[scheme], peers.apart(refined.vertices, points[scheme]), 1e-12)
report.end()
