// One generator after the other.
#include "explorer/demo_source.hpp"

namespace explorer {
namespace {

constexpr int64_t hour_us = int64_t{3600} * 1'000'000;
constexpr size_t bursts_an_hour = 12;

} // namespace

DemoSource::DemoSource(const demo::World &world, double rate, int64_t start, uint64_t seed)
    : world_(world), rate_(rate), hour_(start), seed_(seed) {
    begin_hour();
}

void DemoSource::begin_hour() {
    const demo::GeneratorSettings settings{seed_++, rate_ * 3600, hour_, hour_us, bursts_an_hour};
    generator_ = std::make_unique<demo::Generator>(world_, settings);
    hour_ += hour_us;
}

void DemoSource::next(std::vector<locus_text156> &batch, size_t count) {
    for (;;) {
        generator_->next(batch, count);
        if (!batch.empty())
            return;
        begin_hour();
    }
}

} // namespace explorer
