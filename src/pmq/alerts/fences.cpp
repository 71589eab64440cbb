// Covering a fence, and finding the fences of a record.
#include "pmq/alerts/fences.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace locus::pmq {

// The largest quadrants that are not wholly inside are split while there are few.
std::vector<std::pair<Quadrant, bool>> Fences::cover_of(const Region *region) {
    constexpr size_t enough = 12;
    std::vector<std::pair<Quadrant, bool>> done;
    std::vector<Quadrant> edges{{}}; // the coarsest first
    if (!region)
        return {{{}, true}};
    while (!edges.empty() && edges.size() + done.size() < enough && edges.front().level < key_levels) {
        const Quadrant split = edges.front();
        edges.erase(edges.begin());
        for (unsigned child = 0; child < 4; ++child) {
            const Relation relation = region->relate(split.child(child));
            if (relation == Relation::inside)
                done.push_back({split.child(child), true});
            else if (relation == Relation::edge)
                edges.push_back(split.child(child));
        }
    }
    for (const Quadrant &edge : edges)
        done.push_back({edge, false});
    return done;
}

void Fences::add(uint64_t id, std::unique_ptr<const Region> region, const Selection &selection) {
    require(!fences_.contains(id), "id is ", id, ", of a fence that is there already");
    const auto cover = cover_of(region.get());
    const auto fence = std::make_shared<Fence>();
    fence->id = id;
    fence->region = std::move(region);
    fence->selection = selection;
    fence->selection.region = fence->region.get();
    fence->cover.reserve(cover.size());
    fences_.emplace(id, fence);
    try {
        for (const auto &[quadrant, inside] : cover) {
            const auto [cell, made] = cells_.try_emplace(name(quadrant));
            cells_at_[quadrant.level] += made;
            fence->cover.push_back(quadrant);
            cell->second.push_back({fence, inside});
            ++entries_;
        }
    } catch (...) {
        remove(id);
        throw;
    }
}

void Fences::drop_cell(const Fence &fence, const Quadrant &quadrant) noexcept {
    const auto cell = cells_.find(name(quadrant));
    if (cell == cells_.end())
        return;
    entries_ -= std::erase_if(cell->second, [&](const Entry &entry) { return entry.fence.get() == &fence; });
    if (cell->second.empty()) {
        cells_.erase(cell);
        --cells_at_[quadrant.level];
    }
}

void Fences::remove(uint64_t id) {
    const auto found = fences_.find(id);
    require(found != fences_.end(), "id is ", id, ", of no fence");
    const std::shared_ptr<Fence> fence = found->second;
    fence->removed = true;
    for (const Quadrant &quadrant : fence->cover)
        drop_cell(*fence, quadrant);
    fences_.erase(found);
}

void Fences::find(uint64_t key, Bytes record, const RecordFormat &format, Found &found) const {
    const size_t before = found.size();
    const double latitude = format.latitude(record), longitude = format.longitude(record);
    for (unsigned level = 0; level <= key_levels; ++level) {
        if (cells_at_[level] == 0)
            continue;
        const auto cell = cells_.find(name({level, key >> 2 * (key_levels - level)}));
        if (cell == cells_.end())
            continue;
        for (const Entry &entry : cell->second)
            if (entry.fence->selection.times.contains(format.time(record)) &&
                (entry.inside || entry.fence->region->contains(latitude, longitude)))
                found.push_back(entry.fence);
    }
    std::sort(found.begin() + static_cast<ptrdiff_t>(before), found.end(),
              [](const auto &a, const auto &b) { return a->id < b->id; });
}

uint64_t Fences::bytes() const noexcept {
    return fences_.size() * (sizeof(Fence) + 64) + cells_.size() * 64 + entries_ * (sizeof(Entry) + sizeof(Quadrant));
}

} // namespace locus::pmq
