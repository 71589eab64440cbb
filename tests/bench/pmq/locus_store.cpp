// The library's own layouts behind the benchmark's store interface.
#include "tests/bench/data/records.hpp"
#include "tests/bench/harness/handles.hpp"
#include "tests/bench/pmq/store.hpp"

namespace bench {
namespace {

locus_pmq_query box_query(const locus_box &box) {
    locus_pmq_query query;
    need(locus_pmq_query_init(&query, sizeof query));
    query.region = LOCUS_REGION_BOX;
    query.box = box;
    return query;
}

uint32_t index(Layout layout) {
    return layout == Layout::array_explicit ? LOCUS_INDEX_EXPLICIT
           : layout == Layout::array_heads  ? LOCUS_INDEX_HEADS
                                            : LOCUS_INDEX_IMPLICIT;
}

template <class Record>
class LocusStore final : public TileStore<Record> {
public:
    LocusStore(Layout layout, int64_t horizon) {
        locus_pmq_options options;
        need(locus_pmq_options_init(&options, sizeof options));
        options.record = record_kind<Record>;
        options.horizon = horizon;
        options.layout = layout == Layout::ours ? LOCUS_LAYOUT_RING_LEAVES : LOCUS_LAYOUT_PACKED_ARRAY;
        options.index = index(layout);
        if (layout == Layout::array_heads)
            options.segment_slots = 64;
        pmq_ = make_pmq(options);
    }

    void insert(std::span<const Record> batch, int64_t now) override {
        need(locus_pmq_insert(pmq_.get(), batch.data(), batch.size(), now));
    }

    uint64_t count(const locus_box &box) override {
        const locus_pmq_query query = box_query(box);
        uint64_t found = 0;
        need(locus_pmq_count(pmq_.get(), &query, &found));
        return found;
    }

    std::size_t read(const locus_box &box, std::span<Record> out) override { return read(box, out, LOCUS_ORDER_ANY); }
    std::size_t read_sorted(const locus_box &box, std::span<Record> out) override {
        return read(box, out, LOCUS_ORDER_KEY);
    }

    void tile(const TileId &tile, std::vector<uint32_t> &bins) override {
        bins.resize(tile_bins);
        need(locus_pmq_tile(pmq_.get(), tile.zoom, tile.x, tile.y, 8, nullptr, bins.data(), bins.size(), nullptr));
    }

    std::vector<double> topk(const TopK &query) override {
        locus_pmq_score score;
        need(locus_pmq_score_init(&score, sizeof score)); // the thesis' parameters
        score.latitude = query.latitude;
        score.longitude = query.longitude;
        best_.resize(TopK::k);
        std::vector<double> scores(TopK::k);
        std::size_t found = 0;
        need(locus_pmq_topk(pmq_.get(), &score, nullptr, TopK::k, best_.data(), scores.data(), &found));
        scores.resize(found);
        return scores;
    }

    uint64_t size() override { return stats().records; }
    std::size_t bytes() override { return stats().bytes; }

private:
    std::size_t read(const locus_box &box, std::span<Record> out, uint32_t order) {
        locus_pmq_query query = box_query(box);
        query.order = order;
        std::size_t found = 0;
        need(locus_pmq_read(pmq_.get(), &query, out.data(), out.size(), &found));
        return found;
    }
    locus_pmq_stats stats() const {
        locus_pmq_stats stats{};
        stats.struct_size = sizeof stats;
        need(locus_pmq_get_stats(pmq_.get(), &stats));
        return stats;
    }

    Pmq pmq_;
    std::vector<Record> best_;
};

} // namespace

template <class Record>
std::unique_ptr<TileStore<Record>> make_locus(Layout layout, int64_t horizon) {
    return std::make_unique<LocusStore<Record>>(layout, horizon);
}
template std::unique_ptr<TileStore<locus_point32>> make_locus(Layout, int64_t);
template std::unique_ptr<TileStore<locus_text156>> make_locus(Layout, int64_t);

} // namespace bench
