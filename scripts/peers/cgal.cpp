// Catmull-Clark and Doo-Sabin refinement by CGAL, one thread. Reads a control mesh, prints times and points.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Refine> static void timed(char const *name, Mesh const &control, int repeat, Refine refine) {
    double best = 1e300;
    Mesh found;
    for (int run = 0; run < repeat; ++run) {
        Mesh mesh = control;
        double start = now();
        refine(mesh);
        best = std::min(best, now() - start);
        found = mesh;
    }
    std::printf("%s %.9f %zu\n", name, best, std::size_t(found.number_of_vertices()));
    for (Mesh::Vertex_index v : found.vertices()) {
        Kernel::Point_3 const &p = found.point(v);
        std::printf("%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    }
}

int main() {
    int vertices, faces, levels, repeat;
    if (std::scanf("%d %d %d %d", &vertices, &faces, &levels, &repeat) != 4) return 1;
    Mesh control;
    for (int i = 0; i < vertices; ++i) {
        double x, y, z;
        if (std::scanf("%lf %lf %lf", &x, &y, &z) != 3) return 1;
        control.add_vertex(Kernel::Point_3(x, y, z));
    }
    for (int i = 0; i < faces; ++i) {
        int size;
        if (std::scanf("%d", &size) != 1) return 1;
        std::vector<Mesh::Vertex_index> corners;
        for (int k = 0, corner; k < size; ++k) {
            if (std::scanf("%d", &corner) != 1) return 1;
            corners.push_back(Mesh::Vertex_index(corner));
        }
        control.add_face(corners);
    }
    auto iterations = CGAL::parameters::number_of_iterations(levels);
    timed("catmull-clark", control, repeat, [&](Mesh &mesh) {
        CGAL::Subdivision_method_3::CatmullClark_subdivision(mesh, iterations);
    });
    timed("doo-sabin", control, repeat, [&](Mesh &mesh) {
        CGAL::Subdivision_method_3::DooSabin_subdivision(mesh, iterations);
    });
}
