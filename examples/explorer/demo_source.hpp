// The demo stream: simulated posts hour by hour, without end, with a burst every few minutes.
#pragma once

#include "common/generator.hpp"

#include <memory>

namespace explorer {

class DemoSource : public demo::Source {
public:
    // `rate` posts a second from `start` on, microseconds since the epoch. `world` must outlive the source.
    DemoSource(const demo::World &world, double rate, int64_t start, uint64_t seed);

    void next(std::vector<locus_text156> &batch, size_t count) override;
    double fraction() const override { return -1; }
    std::vector<std::string> remarks() const override { return {}; }

private:
    void begin_hour();

    const demo::World &world_;
    double rate_;
    int64_t hour_; // where the next one begins
    uint64_t seed_;
    std::unique_ptr<demo::Generator> generator_;
};

} // namespace explorer
