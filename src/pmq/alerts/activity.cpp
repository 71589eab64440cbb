// Adding records, giving up nodes, and what a history leads to expect.
#include "pmq/alerts/activity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>

namespace locus::pmq {
namespace {

constexpr double most_exponent = 512;  // of a weight, in half lives: beyond, all are scaled anew
constexpr double least_past = 0.25;    // records
constexpr size_t steady_looks = 16;    // nodes looked at for each batch, and
constexpr size_t looks_per_record = 2; // for each record

double difference(int64_t a, int64_t b) noexcept { return static_cast<double>(a) - static_cast<double>(b); }

} // namespace

Activity::Activity(unsigned finest_level, int64_t half_life, int64_t history, uint64_t max_bytes)
    : finest_level_(finest_level), half_life_(static_cast<double>(half_life)), history_(static_cast<double>(history)),
      most_nodes_(static_cast<size_t>(
          std::min<uint64_t>(max_bytes / (sizeof(Region) + sizeof(Node)), std::numeric_limits<Node>::max()))),
      negligible_(least_past) {
    restart(0);
}

void Activity::restart(int64_t now) {
    nodes_.resize(1);
    touched_.clear();
    touched_.reserve(1);
    nodes_[root] = {0, 0, now, now, {none, none, none, none}, none, 0, 0, 0};
    free_ = none;
    free_count_ = 0;
    batch_ = 0;
    origin_ = now;
    cursor_ = 1;
    negligible_ = least_past;
}

void Activity::begin(int64_t now) {
    if (now_ == INT64_MIN || difference(now, now_) > history_)
        restart(now);
    now_ = now;
    if (difference(now, origin_) > most_exponent * half_life_)
        rescale(now);
    present_scale_ = std::exp2(-difference(now, origin_) / half_life_);
    past_scale_ = std::exp2(-difference(now, origin_) / history_);
    weighed_time_ = now;
    present_weight_ = 1 / present_scale_;
    past_weight_ = 1 / past_scale_;
    seconds_ = half_life_ / std::numbers::ln2 / 1e6;
    touched_.clear();
    ++batch_;
}

void Activity::rescale(int64_t now) noexcept {
    const double present = std::exp2(-difference(now, origin_) / half_life_);
    const double past = std::exp2(-difference(now, origin_) / history_);
    for (Region &region : nodes_) {
        region.present *= present;
        region.past *= past;
    }
    origin_ = now;
}

void Activity::add(uint64_t key, int64_t time) noexcept {
    if (time != weighed_time_) {
        weighed_time_ = time;
        present_weight_ = std::exp2(difference(time, origin_) / half_life_);
        past_weight_ = std::exp2(difference(time, origin_) / history_);
    }
    Node at = root;
    for (unsigned level = 0;; ++level) {
        Region &region = nodes_[at];
        region.present += present_weight_;
        region.past += past_weight_;
        if (region.batch != batch_) {
            region.batch = batch_;
            touched_.push_back(at); // reserved
        }
        if (level == finest_level_)
            return;
        const auto number = static_cast<unsigned>(key >> 2 * (key_levels - 1 - level) & 3);
        const Node child = region.children[number];
        at = child != none ? child : make(at, number);
        if (at == none)
            return;
    }
}

// Without room for a child, its parent goes on alone, and what is later made below it has no history before then.
Activity::Node Activity::make(Node parent, unsigned number) noexcept {
    const Node made = take();
    Region &above = nodes_[parent];
    if (made == none) {
        above.children_known = now_;
        return none;
    }
    const auto level = static_cast<uint8_t>(above.level + 1);
    nodes_[made] = {0, 0,     above.children_known,        above.children_known, {none, none, none, none}, parent,
                    0, level, static_cast<uint8_t>(number)};
    above.children[number] = made;
    return made;
}

Activity::Node Activity::take() noexcept {
    if (free_ != none) {
        const Node node = free_;
        free_ = nodes_[node].parent;
        --free_count_;
        return node;
    }
    if (nodes_.size() >= most_nodes_)
        return none;
    try {
        if (nodes_.size() == nodes_.capacity())
            nodes_.reserve(std::min(2 * nodes_.size(), most_nodes_));
        touched_.reserve(nodes_.capacity());
    } catch (const std::bad_alloc &) {
        return none;
    }
    nodes_.emplace_back();
    return static_cast<Node>(nodes_.size() - 1);
}

void Activity::give_up(Node node) noexcept {
    Region &region = nodes_[node];
    Region &above = nodes_[region.parent];
    above.children[region.number] = none;
    if (past(node) >= least_past)
        above.children_known = now_;
    region.level = unused;
    region.parent = free_;
    free_ = node;
    ++free_count_;
}

// When room runs short, a round over all nodes gives up twice as much as the one before.
void Activity::tend(size_t records) noexcept {
    for (size_t looks = std::min(steady_looks + looks_per_record * records, nodes_.size()); looks > 0; --looks) {
        if (cursor_ >= nodes_.size()) {
            cursor_ = 1;
            const bool short_of_room = size() > most_nodes_ - most_nodes_ / 8;
            negligible_ = short_of_room ? 2 * negligible_ : std::max(least_past, negligible_ / 2);
            continue;
        }
        const Node node = cursor_++;
        const Region &region = nodes_[node];
        if (region.level != unused && region.batch != batch_ && past(node) < negligible_ &&
            std::all_of(region.children.begin(), region.children.end(), [](Node child) { return child == none; }))
            give_up(node);
    }
}

Quadrant Activity::quadrant(Node node) const noexcept {
    Quadrant quadrant{nodes_[node].level, 0};
    for (unsigned shift = 0; node != root; node = nodes_[node].parent, shift += 2)
        quadrant.code |= uint64_t{nodes_[node].number} << shift;
    return quadrant;
}

Activity::Node Activity::find(const Quadrant &quadrant) const noexcept {
    Node node = root;
    for (unsigned level = quadrant.level; level-- > 0 && node != none;)
        node = nodes_[node].children[quadrant.code >> 2 * level & 3];
    return node;
}

// What one record a microsecond, since a time, has left by the clock.
double Activity::weight_sum(double half_life, int64_t since) const noexcept {
    const double all = half_life / std::numbers::ln2;
    return -all * std::expm1(-difference(now_, since) / all);
}

Activity::Expected Activity::expected(Node node) const noexcept {
    const auto history = [this](Node n) { return std::max(0.0, past(n) - present(n)); };
    const int64_t since = nodes_[node].known;
    const double lately = weight_sum(half_life_, since), before = weight_sum(history_, since) - lately;
    const double own = before > 0 ? lately / before : std::numeric_limits<double>::infinity();
    const double whole = history(root) > 0 ? present(root) / history(root) : 0;
    const double records = history(node), per_record = std::max(own, whole);
    return {std::isfinite(per_record) ? records * per_record : 0, (records + 3 * std::sqrt(records) + 3) * per_record};
}

uint64_t Activity::bytes() const noexcept {
    return nodes_.capacity() * sizeof(Region) + touched_.capacity() * sizeof(Node);
}

} // namespace locus::pmq
