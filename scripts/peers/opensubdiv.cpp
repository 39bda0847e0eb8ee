// Catmull-Clark refinement by OpenSubdiv's Far, one thread. Reads a control mesh, prints times and points.
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

using namespace OpenSubdiv;

struct Point {
    double x[3];
    void Clear(void * = nullptr) { x[0] = x[1] = x[2] = 0; }
    void AddWithWeight(Point const &other, double weight) {
        for (int k = 0; k < 3; ++k) x[k] += weight * other.x[k];
    }
};

static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

static void print(char const *name, double seconds, std::vector<Point> const &points) {
    std::printf("%s %.9f %zu\n", name, seconds, points.size());
    for (Point const &p : points) std::printf("%.17g %.17g %.17g\n", p.x[0], p.x[1], p.x[2]);
}

int main() {
    int vertices, faces, levels, repeat;
    if (std::scanf("%d %d %d %d", &vertices, &faces, &levels, &repeat) != 4) return 1;
    std::vector<Point> control(vertices);
    for (Point &p : control)
        if (std::scanf("%lf %lf %lf", &p.x[0], &p.x[1], &p.x[2]) != 3) return 1;
    std::vector<int> sizes(faces), corners;
    for (int &size : sizes) {
        if (std::scanf("%d", &size) != 1) return 1;
        for (int k = 0, corner; k < size; ++k) {
            if (std::scanf("%d", &corner) != 1) return 1;
            corners.push_back(corner);
        }
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = vertices;
    descriptor.numFaces = faces;
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = corners.data();
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    typedef Far::TopologyRefinerFactory<Far::TopologyDescriptor> Factory;
    double best = 1e300, best_limit = 1e300;
    std::vector<Point> points, limits;
    for (int run = 0; run < repeat; ++run) {
        double start = now();
        std::unique_ptr<Far::TopologyRefiner> refiner(
            Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
        Far::TopologyRefiner::UniformOptions uniform(levels);
        uniform.fullTopologyInLastLevel = true;
        refiner->RefineUniform(uniform);
        Far::PrimvarRefinerReal<double> primvar(*refiner);
        points = control;
        for (int level = 1; level <= levels; ++level) {
            std::vector<Point> finer(refiner->GetLevel(level).GetNumVertices());
            primvar.Interpolate(level, points, finer);
            points.swap(finer);
        }
        best = std::min(best, now() - start);
        start = now();
        limits.assign(points.size(), Point());
        primvar.Limit(points, limits);
        best_limit = std::min(best_limit, now() - start);
    }
    print("refined", best, points);
    print("limits", best_limit, limits);
}
