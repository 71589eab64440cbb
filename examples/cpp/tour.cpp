// A tour of locus.hpp: a window over a stream, and the weights of two seeds in a bar that is cut. Compile it with
//   c++ -std=c++17 tour.cpp $(pkg-config --cflags --libs locus)
#include <locus/locus.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

constexpr std::int64_t second = 1000000;
constexpr std::int64_t noon = 1700000000 * second;

// The last hour of posts; what grows older comes out of the store and is counted.
void stream() {
    std::size_t gone = 0;
    locus::pmq_options<> options;
    options.horizon = 3600 * second;
    options.sink = [&](const locus_point32 &) { ++gone; };
    locus::pmq<> store(options);

    std::vector<locus_point32> posts(7200);
    for (std::size_t i = 0; i < posts.size(); ++i)
        posts[i] = {
            48.0 + double(i % 100) / 100, 2.0 + double(i % 70) / 70, noon + std::int64_t(i) * second, 0, 0, 0, 0};
    store.insert(posts, noon + 7200 * second);
    store.sweep(noon + 7200 * second);

    using query = locus::query<>;
    const auto paris = query().in(locus_circle{48.8566, 2.3522, 10000});
    const locus::snapshot moment = store.snapshot();
    std::printf("%zu posts left the window, %llu are in it, %llu of them near Paris\n", gone,
                static_cast<unsigned long long>(store.count(query().at(moment))),
                static_cast<unsigned long long>(store.count(paris)));
    const auto nearest = store.nearest(48.8566, 2.3522, 1);
    std::printf("the nearest is %.0f m away\n", nearest.values.at(0));
}

// A bar of 9 voxels with a seed at either end: the weights half way, before and after a cut.
void bar() {
    locus::graph graph(locus::graph_options(9, 1, 1), std::vector<float>(9, 1.0F));
    locus::diagram diagram(graph);
    diagram.add_seeds(std::vector<locus_seed>{{0, 0, 0, 0, 1, 0}, {8, 0, 0, 0, 2, 0}});
    diagram.solve([](double) { /* progress; return false to cancel */ });
    locus::weights weights(diagram);
    const std::uint32_t seeds[] = {1, 2};
    std::printf("half way the seeds weigh %.2f and %.2f\n", double(weights.dense(seeds).at(8)),
                double(weights.dense(seeds).at(9)));

    graph.fill_box({{3, 0, 0}, {1, 1, 1}}, NAN);
    const auto change = diagram.update();
    weights.update();
    std::printf("a cut changed %llu voxels; now they weigh %.2f and %.2f\n",
                static_cast<unsigned long long>(change.voxels), double(weights.dense(seeds).at(8)),
                double(weights.dense(seeds).at(9)));
}

// The same call by status and by exception: the texts name the argument and the value.
void errors() {
    locus::status status;
    const locus::graph none(locus::graph_options(0, 1, 1), {}, &status);
    std::printf("%s: %s\n", status.name(), status.text().c_str());
    try {
        locus::pmq<>().tile(3, 8, 0, 0);
    } catch (const locus::error &error) {
        std::printf("%s: %s\n", error.name(), error.what());
    }
}

} // namespace

int main() {
    std::printf("Locus %s\n", locus::version_text().data());
    stream();
    bar();
    errors();
    return 0;
}
