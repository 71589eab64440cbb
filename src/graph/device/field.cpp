#include "graph/device/field.hpp"

#include "core/team.hpp"
#include "graph/device/visit.hpp"
#include "graph/lattice.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace locus::device {

using graph::Change;
using graph::Problem;
using graph::Report;
using graph::Source;
using graph::Words;

namespace {

constexpr uint64_t bricks_at_once = 4096; // packed on the host, and copied
constexpr uint64_t first_rounds = 8;      // launched before the host looks whether there is more to do
constexpr uint64_t most_rounds = 48;
constexpr uint64_t bucket_steps = 8; // a bucket of keys is as wide as so many of the smallest weights

Layout layout_of(const graph::Grid &grid) {
    Layout layout{};
    uint64_t count = 1;
    for (size_t a = 0; a < 3; ++a) {
        layout.dims[a] = grid.dims()[a];
        const uint64_t bricks = (grid.dims()[a] + kSide - 1) / kSide;
        count *= bricks; // cannot wrap: a grid has fewer than 2^40 voxels
        if (count > uint64_t{1} << 31)
            fail(LOCUS_E_MEMORY, "the grid has too many bricks for the CUDA backend");
        layout.bricks[a] = static_cast<uint32_t>(bricks);
    }
    return layout;
}

// Call visit(voxel, position in the brick) for the voxels of a brick inside the grid.
template <typename Visit>
void for_voxels(const graph::Grid &grid, const Layout &layout, uint32_t brick, Visit &&visit) {
    int place[3];
    layout.place(brick, place);
    uint64_t begin[3], end[3];
    for (size_t a = 0; a < 3; ++a) {
        begin[a] = static_cast<uint64_t>(place[a]) * kSide;
        end[a] = std::min<uint64_t>(begin[a] + kSide, grid.dims()[a]);
    }
    for (uint64_t z = begin[2]; z < end[2]; ++z)
        for (uint64_t y = begin[1]; y < end[1]; ++y)
            for (uint64_t x = begin[0]; x < end[0]; ++x)
                visit(grid.index(x, y, z), x - begin[0] + kSide * (y - begin[1] + kSide * (z - begin[2])));
}

auto order(const Source &source) { return std::tuple(source.voxel, source.distance, source.label); }

} // namespace

template <typename Word>
Field<Word>::Field(Device &device, const graph::Graph &graph) : device_(device), graph_(graph), tables_(device, graph) {
    const uint64_t count = layout().count();
    words_ = device.allocate<Word>(count * kVoxels);
    operands_ = device.allocate<float>(count * kVoxels);
    control_ = device.allocate<Control>(1);
    border_ = device.copy_of(std::span<const BorderCell>(border_cells()));
    key_ = device.allocate<uint32_t>(count);
    waiting_ = device.allocate<uint32_t>(3 * count);
    near_ = device.allocate<uint32_t>(count);
    touched_ = device.allocate<uint32_t>(count);
    is_touched_ = device.allocate<uint32_t>(count);
    tallied_ = device.allocate<Tallied>(1);
    fill(near_, uint32_t{0});
}

template <typename Word>
uint64_t Field<Word>::bytes() const {
    return words_.bytes() + operands_.bytes() + open_.bytes() + key_.bytes() + waiting_.bytes() + near_.bytes() +
           touched_.bytes() + is_touched_.bytes() + before_.bytes();
}

template <typename Word>
Layout Field<Word>::layout() const {
    return layout_of(graph_.grid());
}

template <typename Word>
Bricks<Word> Field<Word>::bricks() const {
    const uint32_t classes = classes_of(graph_.grid());
    return {layout(), words_.get(), operands_.get(), open_.get(), neighbours_within(classes), classes, beyond_};
}

template <typename Word>
Rounds Field<Word>::rounds(bool record) const {
    const uint64_t count = layout().count();
    const auto width = static_cast<unsigned>(std::bit_width(bucket_steps * graph_.smallest_weight())) - 1;
    uint32_t *const waiting = waiting_.get();
    return {control_.get(),
            key_.get(),
            {waiting, waiting + count, waiting + 2 * count},
            near_.get(),
            record ? touched_.get() : nullptr,
            is_touched_.get(),
            std::min<uint32_t>(width + graph_.layout().label_bits, std::numeric_limits<Word>::digits - 1),
            at_once_};
}

template <typename Word>
Launch Field<Word>::launch(Kernel kernel) const {
    Launch launch{};
    launch.kernel = kernel;
    launch.word_bits = graph_.layout().bits;
    return launch;
}

template <typename Word>
template <typename T>
void Field<Word>::fill(const Memory<T> &to, T value) {
    Launch with = launch(Kernel::fill_words);
    with.word_bits = 8 * sizeof(T);
    device_.launch(with, Fill<T>{to.get(), value, to.count()}, to.count());
}

template <typename Word>
std::vector<float> Field<Word>::operands(std::span<const uint32_t> list) const {
    const Operands operand(graph_);
    std::vector<float> packed(list.size() * kVoxels, operand.impassable());
    parallel_for(graph_.threads(), list.size(), 64, [&](uint64_t begin, uint64_t end) {
        for (uint64_t i = begin; i < end; ++i)
            for_voxels(graph_.grid(), layout(), list[i],
                       [&](uint64_t voxel, uint64_t position) { packed[i * kVoxels + position] = operand(voxel); });
    });
    return packed;
}

template <typename Word>
std::vector<uint32_t> Field<Word>::open_edges(std::span<const uint32_t> list) const {
    std::vector<uint32_t> packed(list.size() * kVoxels);
    parallel_for(graph_.threads(), list.size(), 64, [&](uint64_t begin, uint64_t end) {
        for (uint64_t i = begin; i < end; ++i)
            for_voxels(graph_.grid(), layout(), list[i], [&](uint64_t voxel, uint64_t position) {
                packed[i * kVoxels + position] = graph_.open_edges(voxel);
            });
    });
    return packed;
}

template <typename Word>
void Field<Word>::import() {
    if (imported_ == graph_.version())
        return;
    import_operands();
    if (graph_.cuts() != nullptr)
        import_open_edges();
    imported_ = graph_.version();
}

// The materials as the graph has them, which the device makes operands of, in parts that need little room there.
template <typename Word>
void Field<Word>::import_operands() {
    const graph::Grid &grid = graph_.grid();
    const Layout bricks = layout();
    const uint64_t plane = grid.nx() * grid.ny();
    const uint64_t planes = kSide * std::clamp<uint64_t>((uint64_t{1} << 24) / (plane * kSide), 1, bricks.bricks[2]);
    const auto part = device_.allocate<float>(plane * std::min(planes, grid.nz()));
    for (uint64_t z = 0; z < grid.nz(); z += planes) {
        const uint64_t voxels = plane * std::min(planes, grid.nz() - z);
        device_.upload(part.get(), std::span<const float>(graph_.materials() + z * plane, voxels), graph_.threads());
        const uint64_t first = z / kSide * bricks.bricks[0] * bricks.bricks[1];
        const uint64_t last =
            std::min<uint64_t>(first + planes / kSide * bricks.bricks[0] * bricks.bricks[1], bricks.count());
        const Import body{bricks, graph_.operand(), Operands(graph_).impassable(), part.get(), z, operands_.get(),
                          first,  last - first};
        device_.launch(launch(Kernel::import), body, body.count());
    }
}

template <typename Word>
void Field<Word>::import_open_edges() {
    const uint32_t count = layout().count();
    if (open_.count() == 0)
        open_ = device_.allocate<uint32_t>(uint64_t{count} * kVoxels);
    std::vector<uint32_t> list;
    for (uint32_t first = 0; first < count; first += static_cast<uint32_t>(list.size())) {
        list.resize(std::min<uint64_t>(bricks_at_once, count - first));
        std::iota(list.begin(), list.end(), first);
        device_.upload(open_.get() + uint64_t{first} * kVoxels, std::span<const uint32_t>(open_edges(list)),
                       graph_.threads());
    }
}

// The bricks of a list alone. The first cut of a graph concerns all of them.
template <typename Word>
void Field<Word>::import(std::span<const uint32_t> list) {
    if (graph_.cuts() != nullptr && open_.count() == 0) {
        imported_.reset();
        return import();
    }
    for (size_t first = 0; first < list.size(); first += bricks_at_once) {
        const auto part = list.subspan(first, std::min<size_t>(bricks_at_once, list.size() - first));
        const auto where = device_.copy_of(part);
        const auto packed = device_.copy_of(std::span<const float>(operands(part)));
        const Scatter<float> scatter{operands_.get(), packed.get(), where.get(), part.size()};
        device_.launch(launch(Kernel::scatter_operands), scatter, scatter.count());
        Memory<uint32_t> packed_open;
        if (graph_.cuts() != nullptr) {
            packed_open = device_.copy_of(std::span<const uint32_t>(open_edges(part)));
            device_.launch(launch(Kernel::scatter_open),
                           Scatter<uint32_t>{open_.get(), packed_open.get(), where.get(), part.size()},
                           scatter.count());
        }
        device_.finish(); // before the memory goes
    }
    imported_ = graph_.version();
}

template <typename Word>
void Field<Word>::take(const Words &words) {
    solved_ = false;
    import();
    beyond_ = static_cast<Word>(graph_.layout().unreached());
    const auto &dense = std::get<std::vector<Word>>(words);
    const Layout bricks = layout();
    std::vector<Word> packed;
    for (uint64_t first = 0; first < bricks.count(); first += bricks_at_once) {
        const uint64_t count = std::min<uint64_t>(bricks_at_once, bricks.count() - first);
        packed.assign(count * kVoxels, beyond_);
        parallel_for(graph_.threads(), count, 64, [&](uint64_t begin, uint64_t end) {
            for (uint64_t i = begin; i < end; ++i)
                for_voxels(graph_.grid(), bricks, static_cast<uint32_t>(first + i),
                           [&](uint64_t voxel, uint64_t position) { packed[i * kVoxels + position] = dense[voxel]; });
        });
        device_.upload(words_.get() + first * kVoxels, std::span<const Word>(packed));
    }
}

template <typename Word>
void Field<Word>::set_sources(std::span<const Source> sources) {
    const Layout bricks = layout();
    std::vector<std::pair<uint64_t, Word>> seeds;
    for (const Source &source : sources) {
        const auto [x, y, z] = graph_.grid().place(source.voxel);
        seeds.emplace_back(bricks.address(x, y, z),
                           static_cast<Word>(graph_.layout().pack(source.distance, source.label)));
    }
    std::sort(seeds.begin(), seeds.end());
    std::vector<uint64_t> addresses;
    std::vector<Word> words;
    for (const auto &[address, word] : seeds) {
        addresses.push_back(address);
        words.push_back(word);
    }
    seed_address_ = device_.copy_of(std::span<const uint64_t>(addresses));
    seed_word_ = device_.copy_of(std::span<const Word>(words));
    sources_.assign(sources.begin(), sources.end());
}

// Empty lists, nothing touched.
template <typename Word>
void Field<Word>::begin_rounds() {
    Control control{};
    for (Round &round : control.round)
        round.least = kNoBucket;
    device_.upload(control_.get(), std::span<const Control>(&control, 1));
    fill(key_, kNoBucket);
    fill(is_touched_, uint32_t{0});
    round_ = 0;
    work_ = {};
}

template <typename Word>
void Field<Word>::plant(bool record) {
    device_.launch(launch(Kernel::plant), Plant<Word>{bricks(), rounds(record), seeds(), round_}, sources_.size());
}

// Launch rounds until none is left to do; the host looks at their state once for many.
template <typename Word>
void Field<Word>::run_rounds(bool raise, bool record, Progress &progress) {
    const auto run = [&]<typename Rule, typename Cells>(const Rule &rule, const Launch &kernel, Cells) {
        const auto with = [&]<bool raising>(std::bool_constant<raising>) {
            Visit<Word, Rule, Cells, raising> visit{
                bricks(), rounds(record), rule, border_.get(), seeds(), graph_.layout().label_bits, round_, 0};
            Launch visiting = kernel;
            visiting.kernel = raising ? Kernel::raise : Kernel::lower;
            const uint64_t blocks = std::min<uint64_t>(device_.resident(visiting, visit), layout().count());
            at_once_ = visit.blocks = static_cast<uint32_t>(blocks);
            visit.rounds = rounds(record);
            uint64_t batch = first_rounds;
            for (;;) {
                for (uint64_t i = 0; i < batch; ++i) {
                    const Select select{rounds(record), round_};
                    visit.round = round_;
                    device_.launch(launch(Kernel::select), select, uint64_t{layout().count()} + 1);
                    device_.launch(visiting, visit, blocks);
                    round_ = (round_ + 1) % 3;
                }
                work_.launched += batch;
                const auto control = device_.download(control_.get());
                work_.rounds = control.rounds;
                work_.visits = control.visits;
                work_.vain = control.vain;
                work_.passes = control.passes;
                if (control.round[round_].waiting == 0)
                    return;
                const auto done = static_cast<double>(work_.launched);
                progress.report(done / (done + 64));
                batch = std::min(batch + batch / 4, most_rounds);
            }
        };
        raise ? with(std::true_type{}) : with(std::false_type{});
    };
    with_rule_of<Word>(graph_, tables_, [&]<typename Rule>(const Rule &rule, const Launch &kernel) {
        if constexpr (Rule::kind == RuleKind::half_sum)
            if (kernel.simple != 0)
                return run(rule, kernel, HalfSumCells<Word>{});
        run(rule, kernel, EdgeCells<Word, Rule>{});
    });
}

// Make before_ the words that the latest solve or update left, or none.
template <typename Word>
void Field<Word>::remember(const Problem &problem) {
    const bool anew = problem.anew || !solved_;
    if (remembered_ && !anew)
        return;
    if (before_.count() == 0)
        before_ = device_.allocate<Word>(words_.count());
    fill(before_, beyond_);
    if (!anew)
        tally(true);
    remembered_ = true;
}

// Look at all words; `compare` them with before_, too, which they become.
template <typename Word>
Tallied Field<Word>::tally(bool compare) {
    const Tallied nothing = Tallied::nothing();
    device_.upload(tallied_.get(), std::span<const Tallied>(&nothing, 1));
    Tally<Word> body{bricks(), compare ? before_.get() : nullptr, 0, tallied_.get()};
    const Launch with = launch(Kernel::tally);
    body.blocks = std::min<uint64_t>(device_.resident(with, body), layout().count());
    device_.launch(with, body, body.blocks);
    return device_.download(tallied_.get());
}

// The words stay on the device; what is known of them.
template <typename Word>
void Field<Word>::keep(Change *change, Report &report) {
    const Tallied tallied = tally(change != nullptr);
    remembered_ = change != nullptr;
    reached_ = tallied.reached;
    report.kept = {tallied.reached, graph_.layout().distance(tallied.largest)};
    if (change != nullptr)
        *change = graph::change_between(tallied.changed, tallied.first, tallied.last);
}

// All words to dense memory, in parts that need little room on the device.
template <typename Word>
void Field<Word>::give(Words &words) {
    const graph::Grid &grid = graph_.grid();
    const auto unreached = static_cast<Word>(graph_.layout().unreached());
    const uint64_t plane = grid.nx() * grid.ny();
    const uint64_t planes = std::clamp<uint64_t>((uint64_t{1} << 26) / plane, 1, grid.nz());
    const auto packed = device_.allocate<Word>(plane * planes);
    std::vector<Word> dense = graph::memory_of<Word>(words, grid.voxels());
    for (uint64_t z = 0; z < grid.nz(); z += planes) {
        const Export<Word> body{bricks(), packed.get(), unreached, z, std::min(planes, grid.nz() - z)};
        device_.launch(launch(Kernel::export_words), body, body.count());
        device_.download(std::span<Word>(dense).subspan(z * plane, body.count()), packed.get(), graph_.threads());
    }
    words = std::move(dense);
}

template <typename Word>
void Field<Word>::write(const graph::Reading &reading, void *to) {
    device_.check_writable(to);
    if (reading.told == graph::Told::ids && !has_ids_) {
        ids_ = device_.copy_of(reading.ids);
        has_ids_ = true;
    }
    Read<Word> body{bricks(), graph_.layout(), reading.told, {}, {}, ids_.get(), reading.scale, to};
    std::copy_n(reading.box.origin, 3, body.origin);
    std::copy_n(reading.box.extent, 3, body.extent);
    device_.launch(launch(Kernel::read), body, body.count());
}

template <typename Word>
Report Field<Word>::solve(const Problem &problem, Words *words, Progress &progress, Change *change) {
    graph::Stopwatch watch;
    Report report;
    beyond_ = beyond_of<Word>(graph_, problem.limit());
    if (change != nullptr)
        remember(problem);
    solved_ = remembered_ = has_ids_ = false;
    import();
    set_sources(problem.sources);
    report.seconds_import = watch.lap();

    fill(words_, beyond_);
    begin_rounds();
    plant(false);
    run_rounds(false, false, progress);
    report.iterations = work_.visits;
    report.relaxations = work_.passes * kVoxels * graph_.grid().connectivity();
    report.seconds_solve = watch.lap();

    if (words != nullptr) {
        reached_ = tally(false).reached;
        give(*words);
    } else {
        keep(change, report);
    }
    report.clipped = reached_ < graph_.passable_voxels();
    solved_ = true;
    report.seconds_export = watch.lap();
    return report;
}

template <typename Word>
bool Field<Word>::can_update(const Problem &problem, const Words *words) const {
    const auto *dense = words != nullptr ? std::get_if<std::vector<Word>>(words) : nullptr;
    const bool has_words = words == nullptr || (dense != nullptr && dense->size() == graph_.grid().voxels());
    return solved_ && imported_ && !problem.anew && has_words && beyond_ == beyond_of<Word>(graph_, problem.limit()) &&
           graph_.edits_since(*imported_).has_value();
}

// The bricks of all voxels that look at an edited one, and those of the seeds that are gone.
template <typename Word>
std::vector<uint32_t> Field<Word>::edited_bricks(std::span<const Source> sources) const {
    const Layout bricks = layout();
    std::vector<uint32_t> list;
    const std::span<const graph::Box> edits = *graph_.edits_since(*imported_);
    for (const graph::Box &box : edits) {
        int first[3], last[3];
        for (size_t a = 0; a < 3; ++a) {
            first[a] = static_cast<int>((box.origin[a] - std::min<uint64_t>(box.origin[a], 1)) / kSide);
            last[a] = static_cast<int>(std::min(box.origin[a] + box.extent[a], graph_.grid().dims()[a] - 1) / kSide);
        }
        for (int z = first[2]; z <= last[2]; ++z)
            for (int y = first[1]; y <= last[1]; ++y)
                for (int x = first[0]; x <= last[0]; ++x)
                    list.push_back(bricks.index(x, y, z));
    }
    std::vector<Source> before = sources_, after(sources.begin(), sources.end()), gone;
    const auto less = [](const Source &a, const Source &b) { return order(a) < order(b); };
    std::sort(before.begin(), before.end(), less);
    std::sort(after.begin(), after.end(), less);
    std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(gone), less);
    for (const Source &source : gone) {
        const auto [x, y, z] = graph_.grid().place(source.voxel);
        list.push_back(static_cast<uint32_t>(bricks.address(x, y, z) / kVoxels));
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
}

// Raise what nothing supports any more, then lower from there on, from the edits and from new seeds; see
// graph/bricks/update.cpp.
template <typename Word>
Report Field<Word>::update(const Problem &problem, Words *words, Progress &progress, Change &change) {
    graph::Stopwatch watch;
    Report report;
    if (words == nullptr)
        remember(problem);
    solved_ = has_ids_ = false;
    const std::vector<uint32_t> edited = edited_bricks(problem.sources);
    import(edited);
    set_sources(problem.sources);
    const auto list = device_.copy_of(std::span<const uint32_t>(edited));
    const auto taken = device_.copy_of(std::span<const uint32_t>(std::array<uint32_t, 1>{0}));
    report.seconds_import = watch.lap();

    begin_rounds();
    device_.launch(launch(Kernel::wake_list), WakeList{rounds(true), list.get(), edited.size(), round_}, edited.size());
    progress.part(0, 0.5);
    run_rounds(true, true, progress);
    const Resume<Word> resume{bricks(), rounds(true), border_.get(), taken.get(), round_};
    const Launch resuming = launch(Kernel::resume);
    device_.launch(resuming, resume, std::min<uint64_t>(device_.resident(resuming, resume), layout().count()));
    plant(true);
    progress.part(0.5, 1);
    run_rounds(false, true, progress);
    report.iterations = work_.visits;
    report.relaxations = work_.passes * kVoxels * graph_.grid().connectivity();
    report.seconds_solve = watch.lap();

    if (words != nullptr)
        change = give_touched(*words);
    else
        keep(&change, report);
    report.clipped = reached_ < graph_.passable_voxels();
    solved_ = true;
    report.seconds_export = watch.lap();
    return report;
}

// The words of the bricks that were touched, and what is different about them.
template <typename Word>
Change Field<Word>::give_touched(Words &words) {
    auto &dense = std::get<std::vector<Word>>(words);
    const graph::Grid &grid = graph_.grid();
    const Layout bricks = layout();
    const auto unreached = static_cast<Word>(graph_.layout().unreached());
    std::vector<uint32_t> list(device_.download(control_.get()).touched);
    device_.download(std::span<uint32_t>(list), touched_.get());
    std::vector<Word> values(list.size() * kVoxels);
    const auto packed = device_.allocate<Word>(values.size());
    device_.launch(launch(Kernel::gather), Gather<Word>{packed.get(), words_.get(), touched_.get(), list.size()},
                   values.size());
    device_.download(std::span<Word>(values), packed.get());

    uint64_t changed = 0;
    std::array<uint64_t, 3> first = grid.dims(), last{};
    for (size_t i = 0; i < list.size(); ++i)
        for_voxels(grid, bricks, list[i], [&](uint64_t voxel, uint64_t position) {
            const Word stored = values[i * kVoxels + position];
            const Word word = stored < beyond_ ? stored : unreached;
            if (word == dense[voxel])
                return;
            ++changed;
            reached_ += dense[voxel] == unreached ? 1 : 0;
            reached_ -= word == unreached ? 1 : 0;
            dense[voxel] = word;
            const auto place = grid.place(voxel);
            for (size_t a = 0; a < 3; ++a) {
                first[a] = std::min(first[a], place[a]);
                last[a] = std::max(last[a], place[a]);
            }
        });
    return graph::change_between(changed, first, last);
}

template class Field<uint32_t>;
template class Field<uint64_t>;

} // namespace locus::device
