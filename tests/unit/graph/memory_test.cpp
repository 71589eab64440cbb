// Every allocation of every call fails once: the call says LOCUS_E_MEMORY, the objects stay as they were and go on
// working.
#include "tests/unit/graph/api.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <initializer_list>
#include <new>

namespace {

std::atomic<long> allocations_left{-1}; // negative: all succeed; any thread may count down

void *allocate(std::size_t size) {
    for (long left = allocations_left; left >= 0;) {
        if (left == 0)
            return nullptr;
        if (allocations_left.compare_exchange_weak(left, left - 1))
            break;
    }
    return std::malloc(size == 0 ? 1 : size);
}

} // namespace

void *operator new(std::size_t size) {
    if (void *memory = allocate(size))
        return memory;
    throw std::bad_alloc();
}
void *operator new[](std::size_t size) { return operator new(size); }
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete[](void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void *memory, std::size_t) noexcept { std::free(memory); }

namespace {

using namespace api;

// Let the first, second, ... allocation of call() fail until it succeeds; unchanged() is asked after each failure.
template <typename Call, typename Unchanged>
int fail_each(Call &&call, Unchanged &&unchanged) {
    for (int n = 0;; ++n) {
        allocations_left = n;
        const locus_status status = call();
        allocations_left = -1;
        if (status == LOCUS_OK)
            return n;
        EXPECT_STREQ(locus_status_name(status), "LOCUS_E_MEMORY") << locus_last_error() << " at allocation " << n;
        unchanged();
        if (testing::Test::HasFailure() || n > 100000)
            return n;
    }
}

TEST(Memory, EveryFailureLeavesTheObjectsUsable) {
    auto o = options(6, 5, 4);
    o.material_min = 0.5;
    o.material_max = 4;
    o.max_seeds = 8;
    const std::vector<float> material(120, 1);
    locus_graph *made = nullptr;
    EXPECT_GT(
        fail_each([&] { return locus_graph_create(&o, material.data(), &made); }, [&] { EXPECT_EQ(made, nullptr); }),
        1);
    const Graph g(made);
    const auto materials = [&] {
        std::vector<float> all(120);
        EXPECT_STATUS(locus_graph_get_box(g.get(), nullptr, all.data(), 120), LOCUS_OK);
        return all;
    };
    const locus_voxel_box box{{1, 1, 1}, {2, 2, 2}};
    const std::vector<float> two(8, 2);
    fail_each([&] { return locus_graph_set_box(g.get(), &box, two.data()); },
              [&] { EXPECT_EQ(materials(), material); });
    const auto edited = materials();
    const uint64_t list[3] = {0, 7, 100};
    fail_each([&] { return locus_graph_set_voxels(g.get(), list, two.data(), 3); },
              [&] { EXPECT_EQ(materials(), edited); });

    for (const uint32_t engine : std::initializer_list<uint32_t>{LOCUS_ENGINE_AUTO, LOCUS_ENGINE_HEAP,
                                                                 LOCUS_ENGINE_BUCKET, LOCUS_ENGINE_RELAX}) {
        locus_diagram_options how;
        EXPECT_STATUS(locus_diagram_options_init(&how, sizeof how), LOCUS_OK);
        how.engine = engine;
        locus_diagram *new_diagram = nullptr;
        fail_each([&] { return locus_diagram_create(g.get(), &how, &new_diagram); },
                  [&] { EXPECT_EQ(new_diagram, nullptr); });
        const Diagram d(new_diagram);
        const locus_seed first[3] = {{0, 0, 0, 0, 11, 0}, {5, 4, 3, 0.5, 12, 1}, {2, 2, 2, 0, 13, 0}};
        fail_each([&] { return locus_diagram_add_seeds(d.get(), first, 3); }, [&] { EXPECT_EQ(seeds(d).size(), 0u); });
        uint32_t label = 0;
        const locus_voxel_box one{{0, 0, 0}, {1, 1, 1}};
        fail_each([&] { return locus_diagram_solve(d.get(), nullptr, nullptr); },
                  [&] { EXPECT_STATUS(locus_diagram_labels(d.get(), &one, &label, 1), LOCUS_E_STATE); });
        const auto solved = labels(d, 120);
        const auto steps = exact(d, 120);
        const uint32_t gone = 12;
        fail_each([&] { return locus_diagram_remove_seeds(d.get(), &gone, 1); },
                  [&] { EXPECT_EQ(seeds(d).size(), 3u); });
        const locus_seed more[6] = {{1, 0, 0, 0, 1, 0}, {2, 0, 0, 0, 2, 0}, {3, 0, 0, 0, 3, 0}, {4, 0, 0, 0, 4, 0},
                                    {5, 0, 0, 0, 5, 0}, {5, 1, 0, 0, 6, 0}}; // slots run out: renumbered
        fail_each([&] { return locus_diagram_add_seeds(d.get(), more, 6); }, [&] { EXPECT_EQ(seeds(d).size(), 2u); });
        fail_each([&] { return locus_diagram_move_seed(d.get(), 11, 0, 1, 0); }, [&] { EXPECT_EQ(seeds(d)[0].y, 0u); });
        fail_each([&] { return locus_diagram_solve(d.get(), nullptr, nullptr); },
                  [&] {
                      EXPECT_EQ(labels(d, 120), solved);
                      EXPECT_EQ(exact(d, 120), steps);
                  });
        size_t count = 0;
        std::vector<uint64_t> path(120);
        std::vector<locus_cell_pair> pairs(120);
        fail_each([&] { return locus_diagram_path(d.get(), 5, 4, 3, path.data(), 120, &count); }, [] {});
        fail_each([&] { return locus_diagram_cell_sizes(d.get(), path.data(), 120, &count); }, [] {});
        fail_each([&] { return locus_diagram_cell_pairs(d.get(), pairs.data(), 120, &count); }, [] {});
        const uint32_t spare[6] = {1, 2, 3, 4, 5, 6};
        EXPECT_STATUS(locus_diagram_remove_seeds(d.get(), spare, 6), LOCUS_OK);
        locus_place_options place;
        EXPECT_STATUS(locus_place_options_init(&place, sizeof place), LOCUS_OK);
        place.count = 3;
        place.first_id = 100;
        place.lloyd_iterations = 3;
        place.metric = LOCUS_PLACE_UNIFORM;
        fail_each([&] { return locus_diagram_place_seeds(d.get(), &place); },
                  [&] {
                      EXPECT_EQ(seeds(d).size(), 2u);
                      EXPECT_EQ(seeds(d)[0].y, 1u);
                  });
        EXPECT_EQ(seeds(d).size(), 5u);
        solve(d);
    }
}

} // namespace
