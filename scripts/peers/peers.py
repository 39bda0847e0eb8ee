"""What the comparisons share: control meshes, times of both sides from one run, and how results are printed."""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


def arguments(description, *, levels=None):
    """The options of every comparison. Threads are set here: before the package is imported."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=5, help="times each side is run, in turn; the shortest counts (5)")
    parser.add_argument("--threads", type=int, default=1, help="threads of eigenring; peers have one (1)")
    if levels is not None:
        parser.add_argument("--levels", type=int, default=levels, help=f"levels of refinement ({levels})")
        parser.add_argument("--mesh", type=pathlib.Path, help="a closed control mesh: OBJ, OFF or PLY (a built-in one)")
    given = parser.parse_args()
    if given.repeat < 1 or given.threads < 1 or getattr(given, "levels", 1) < 1:
        parser.error("--repeat, --threads and --levels are 1 and above")
    os.environ["RAYON_NUM_THREADS"] = str(given.threads)
    return given


def skip(reason):
    """Ends a comparison whose other side is not there."""
    print(f"SKIPPED: {reason}")
    sys.exit(0)


def control(path):
    """The control mesh: of a file, or a closed one with vertices of valences 3, 4 and 5."""
    import eigenring

    if path is not None:
        return eigenring.Mesh.read(path)
    # three cubes in the form of an L, without the faces between them
    faces, numbers = [], {}
    cubes = {(0, 0, 0), (1, 0, 0), (0, 1, 0)}
    for cube in sorted(cubes):
        for axis in range(3):
            for side in (0, 1):
                beyond = list(cube)
                beyond[axis] += 2 * side - 1
                if tuple(beyond) in cubes:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                ring = [(0, 0), (1, 0), (1, 1), (0, 1)] if side else [(0, 0), (0, 1), (1, 1), (1, 0)]
                face = []
                for a, b in ring:
                    corner = list(cube)
                    corner[axis], corner[u], corner[v] = cube[axis] + side, cube[u] + a, cube[v] + b
                    face.append(numbers.setdefault(tuple(corner), len(numbers)))
                faces.append(face)
    return eigenring.Mesh([list(map(float, corner)) for corner in numbers], faces)


def timed(repeat, *sides):
    """The shortest time of each side and its result; sides take turns, so that what else the machine does falls on all."""
    best, found = [float("inf")] * len(sides), [None] * len(sides)
    for _ in range(repeat):
        for k, side in enumerate(sides):
            start = time.perf_counter()
            found[k] = side()
            best[k] = min(best[k], time.perf_counter() - start)
    return best, found


def apart(ours, theirs):
    """How far the points of two sets are from each other at most, in whatever order they are."""
    try:
        from scipy.spatial import cKDTree
    except ImportError:
        skip("scipy is not installed, which compares the points: pip install scipy")
    if ours.shape != theirs.shape:
        return float("inf")
    return max(cKDTree(ours).query(theirs)[0].max(), cKDTree(theirs).query(ours)[0].max())


class Report:
    """Rows of a comparison; a difference above what is allowed makes the exit code 1."""

    def __init__(self, peer):
        self.failed = False
        print(f"{'':<66} {'eigenring':>11} {peer[:11]:>11} {'ratio':>7}  difference")

    def row(self, what, ours, theirs, difference, allowed):
        wrong = not difference <= allowed
        self.failed |= wrong
        remark = f"  above {allowed:.0e}" if wrong else ""
        print(f"{what:<66} {ours:>9.5f} s {theirs:>9.5f} s {theirs / ours:>7.3g}  {difference:.1e}{remark}")

    def end(self):
        print("ratio: time of the other by time of eigenring")
        sys.exit(1 if self.failed else 0)


def compiled(name, libraries, missing):
    """A program of this folder, compiled; says what is missing where it cannot be."""
    compiler = os.environ.get("CXX") or shutil.which("c++") or skip("no C++ compiler: set CXX")
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "peers"
    target.mkdir(parents=True, exist_ok=True)
    source = pathlib.Path(__file__).parent / f"{name}.cpp"
    command = [compiler, "-O3", "-DNDEBUG", "-std=c++17", str(source), "-o", str(target / name)]
    done = subprocess.run(command + libraries, capture_output=True, text=True)
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if "error" in line or "cannot find" in line]
        skip(f"{missing} ({(lines or ['it does not compile'])[0].strip()})")
    return target / name


def run(program, mesh, levels, repeat):
    """Runs a compiled peer: its times by name, and its points by name."""
    import numpy as np

    faces = [list(face) for face in (mesh.faces.tolist() if hasattr(mesh.faces, "tolist") else mesh.faces)]
    lines = [f"{len(mesh.vertices)} {len(faces)} {levels} {repeat}"]
    lines += [" ".join(repr(x) for x in point) for point in mesh.vertices.tolist()]
    lines += [" ".join(map(str, [len(face), *face])) for face in faces]
    done = subprocess.run([program], input="\n".join(lines) + "\n", capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"error: {program} failed: {done.stderr.strip() or done.returncode}")
    times, points = {}, {}
    rows = iter(done.stdout.splitlines())
    for line in rows:
        name, seconds, count = line.split()
        times[name] = float(seconds)
        points[name] = np.array([next(rows).split() for _ in range(int(count))], dtype=float)
    return times, points
