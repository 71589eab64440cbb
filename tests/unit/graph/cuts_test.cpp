// Cuts along planes and meshes: which edges they disable, that closed surfaces leave no gap, and that mending undoes
// them.
#include "graph/cuts.hpp"
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;

Graph uniform(uint64_t nx, uint64_t ny, uint64_t nz, double sz = 1) {
    auto options = options_for(nx, ny, nz);
    options.spacing[2] = sz;
    options.max_seeds = 64;
    return Graph(options, std::vector<float>(nx * ny * nz, 1.0f).data());
}

// Calls visit(voxel, place, neighbour, its place) for every edge once.
template <typename Visit>
void for_each_edge(const Graph &graph, Visit &&visit) {
    for (uint64_t v = 0; v < graph.grid().voxels(); ++v) {
        const auto place = graph.grid().place(v);
        const uint32_t inside = graph.grid().inside(place);
        for (const Neighbour &to : graph.grid().neighbours())
            if (to.number >= first_forward && (inside >> to.number & 1) != 0)
                visit(v, place, to, graph.grid().place(v + static_cast<uint64_t>(to.step)));
    }
}

uint64_t count_cut(const Graph &graph) {
    uint64_t cut = 0;
    for_each_edge(graph, [&](uint64_t v, const auto &, const Neighbour &to, const auto &) {
        cut += graph.weight(v, to) == 0 ? 1 : 0;
    });
    return cut;
}

TEST(Cuts, APlaneCutsTheEdgesBetweenItsSides) {
    Graph graph = uniform(12, 9, 7, 2.5);
    const Point point = {5.3, 4.2, 7.1}, normal = {1, -0.4, 0.7};
    const uint64_t cut = cut_by_plane(graph, point, normal, graph.grid().whole());
    const auto side = [&](const std::array<uint64_t, 3> &p) {
        return (static_cast<double>(p[0]) - 5.3) - 0.4 * (static_cast<double>(p[1]) - 4.2) +
                   0.7 * (static_cast<double>(p[2]) * 2.5 - 7.1) <
               0;
    };
    uint64_t expected = 0;
    for_each_edge(graph, [&](uint64_t v, const auto &a, const Neighbour &to, const auto &b) {
        const bool apart = side(a) != side(b);
        expected += apart ? 1 : 0;
        EXPECT_EQ(graph.weight(v, to) == 0, apart);
    });
    EXPECT_EQ(cut, expected);
    EXPECT_GT(cut, 100u);
    EXPECT_EQ(cut_by_plane(graph, point, normal, graph.grid().whole()), 0u) << "cut already";
}

TEST(Cuts, ABoxBoundsAPlane) {
    Graph graph = uniform(10, 10, 10);
    const Box box{{3, 2, 2}, {5, 6, 6}};
    // Between x = 4 and 5: 6 x 6 faces, and to the diagonals that stay in the box.
    EXPECT_EQ(cut_by_plane(graph, {4.5, 0, 0}, {2, 0, 0}, box), 16u * 16u);
    EXPECT_EQ(count_cut(graph), 16u * 16u);
    const Source source{0, 0, 0};
    for (const uint64_t word : solve(LOCUS_ENGINE_BRICKS, {graph, {&source, 1}}))
        EXPECT_TRUE(graph.layout().reached(word)) << "there are ways around";
}

TEST(Cuts, AVoxelOnThePlaneLiesOnTheSideOfTheNormal) {
    Graph graph = uniform(3, 1, 1);
    cut_by_plane(graph, {1, 0, 0}, {1, 0, 0}, graph.grid().whole());
    EXPECT_EQ(graph.weight_between(0, 1), 0u);
    EXPECT_GT(graph.weight_between(1, 2), 0u);
    graph.mend_edges(graph.grid().whole());
    cut_by_plane(graph, {1, 0, 0}, {-1, 0, 0}, graph.grid().whole());
    EXPECT_GT(graph.weight_between(0, 1), 0u);
    EXPECT_EQ(graph.weight_between(1, 2), 0u);
}

struct Mesh {
    std::vector<double> vertices;
    std::vector<uint32_t> triangles;
};

// A cube of half the edge length `half` around `centre`, turned.
Mesh turned_cube(const Point &centre, double half, double angle) {
    Mesh mesh;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const double x = (corner & 1) != 0 ? half : -half, y = (corner & 2) != 0 ? half : -half,
                     z = (corner & 4) != 0 ? half : -half;
        const double u = x * std::cos(angle) - y * std::sin(angle), v = x * std::sin(angle) + y * std::cos(angle);
        const double w = v * std::cos(angle) - z * std::sin(angle), t = v * std::sin(angle) + z * std::cos(angle);
        for (const double c : {centre[0] + u, centre[1] + w, centre[2] + t})
            mesh.vertices.push_back(c);
    }
    mesh.triangles = {0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5,
                      2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return mesh;
}

TEST(Cuts, AClosedMeshLeavesNoGap) {
    for (int turn = 0; turn < 12; ++turn) {
        Graph graph = uniform(21, 20, 19);
        const Point centre = {10.013 + 0.05 * turn, 9.507, 9.211};
        const Mesh mesh = turned_cube(centre, 5.3, 0.13 * turn);
        EXPECT_GT(cut_by_mesh(graph, mesh.vertices, mesh.triangles), 1000u);
        const Source source{graph.grid().index(10, 9, 9), 0, 0};
        const auto words = solve(LOCUS_ENGINE_HEAP, {graph, {&source, 1}});
        EXPECT_EQ(solve(LOCUS_ENGINE_BRICKS, {graph, {&source, 1}}), words);
        uint64_t inside = 0;
        for (uint64_t v = 0; v < words.size(); ++v) {
            if (!graph.layout().reached(words[v]))
                continue;
            ++inside;
            const auto [x, y, z] = graph.grid().place(v);
            const double dx = static_cast<double>(x) - centre[0], dy = static_cast<double>(y) - centre[1],
                         dz = static_cast<double>(z) - centre[2];
            EXPECT_LE(dx * dx + dy * dy + dz * dz, 3 * 5.3 * 5.3 + 1e-9) << "turn " << turn;
        }
        EXPECT_NEAR(static_cast<double>(inside), 10.6 * 10.6 * 10.6, 250) << "turn " << turn;
    }
}

TEST(Cuts, ALargeSquareEqualsAPlaneWhicheverWayItTurns) {
    for (const bool flipped : {false, true}) {
        Graph by_plane = uniform(9, 8, 7), by_mesh = uniform(9, 8, 7);
        cut_by_plane(by_plane, {4.27, 0, 0}, {1, 0.3, 0}, by_plane.grid().whole());
        // The same plane as two triangles: x = 4.27 - 0.3 y, far beyond the grid.
        const std::vector<double> vertices = {34.27, -100, -99, 34.27, -100, 99, -25.73, 100, -99, -25.73, 100, 99};
        const std::vector<uint32_t> triangles =
            flipped ? std::vector<uint32_t>{0, 1, 2, 1, 3, 2} : std::vector<uint32_t>{2, 1, 0, 2, 3, 1};
        cut_by_mesh(by_mesh, vertices, triangles);
        for_each_edge(by_plane, [&](uint64_t v, const auto &, const Neighbour &to, const auto &) {
            EXPECT_EQ(by_plane.weight(v, to), by_mesh.weight(v, to));
        });
    }
}

TEST(Cuts, MendingUndoesWhatHasAnEndInTheBox) {
    Graph graph = uniform(14, 9, 8);
    const uint64_t cut = cut_by_plane(graph, {6.5, 0, 0}, {1, 0, 0}, graph.grid().whole());
    const uint64_t some = graph.mend_edges({{0, 0, 0}, {7, 3, 8}});
    EXPECT_GT(some, 0u);
    EXPECT_EQ(count_cut(graph), cut - some);
    EXPECT_GT(graph.weight_between(graph.grid().index(6, 2, 4), graph.grid().index(7, 3, 4)), 0u);
    EXPECT_EQ(graph.weight_between(graph.grid().index(6, 3, 4), graph.grid().index(7, 3, 4)), 0u);
    EXPECT_EQ(graph.mend_edges(graph.grid().whole()), cut - some);
    EXPECT_EQ(count_cut(graph), 0u);
}

TEST(Cuts, BadArgumentsChangeNothing) {
    Graph graph = uniform(4, 4, 4);
    const uint64_t version = graph.version();
    const Box whole = graph.grid().whole();
    EXPECT_THROW(cut_by_plane(graph, {0, 0, NAN}, {1, 0, 0}, whole), locus::Error);
    EXPECT_THROW(cut_by_plane(graph, {0, 0, 0}, {0, 0, 0}, whole), locus::Error);
    EXPECT_THROW(cut_by_plane(graph, {0, 0, 0}, {1, 0, 0}, {{0, 0, 0}, {5, 1, 1}}), locus::Error);
    const std::vector<double> vertices = {0, 0, 0, 1, 1, 1, INFINITY, 2, 2};
    EXPECT_THROW(cut_by_mesh(graph, vertices, std::vector<uint32_t>{0, 1, 2}), locus::Error);
    EXPECT_THROW(cut_by_mesh(graph, std::vector<double>(9), std::vector<uint32_t>{0, 1, 3}), locus::Error);
    EXPECT_EQ(graph.version(), version);
}

// A cut that grows, followed step by step.
TEST(Cuts, UpdatesFollowAGrowingCut) {
    for (const uint32_t simd : {1u, 2u, 3u, 4u, 5u}) {
        if (!locus::simd_available(static_cast<locus::Simd>(simd)))
            continue;
        auto options = options_for(40, 30, 20);
        options.simd = simd;
        options.max_seeds = 8;
        Graph graph(options, random_materials(40 * 30 * 20, 1, 3, 0.05, 3).data());
        const Source sources[] = {{graph.passable(0) ? 0u : 1u, 0, 0}};
        const auto engine = make_engine(LOCUS_ENGINE_BRICKS);
        Words words;
        locus::Progress progress;
        const Problem problem{graph, sources};
        engine->solve(problem, words, progress);
        for (uint64_t depth = 4; depth <= 30; depth += 6) {
            cut_by_plane(graph, {17.5, 0, 0}, {1, 0.2, 0.1}, {{0, 0, 0}, {40, depth, 20}});
            Change change;
            engine->update(problem, words, progress, change);
            const auto got = std::visit([](const auto &w) { return std::vector<uint64_t>(w.begin(), w.end()); }, words);
            ASSERT_EQ(got, solve(LOCUS_ENGINE_HEAP, problem)) << "depth " << depth;
            EXPECT_GT(change.voxels, 0u);
        }
    }
}

} // namespace
