// Where records come from.
#pragma once

#include <locus/pmq.h>

#include <cstdint>
#include <string>
#include <vector>

namespace demo {

class Source {
public:
    virtual ~Source() = default;

    // Replace `batch` by the next records, at most `count`; none: the end. Throws std::runtime_error.
    virtual void next(std::vector<locus_text156> &batch, size_t count) = 0;

    // How much of it is read, 0..1; negative: unknown.
    virtual double fraction() const = 0;

    // What there is to say at the end, line by line (bad lines and so on).
    virtual std::vector<std::string> remarks() const = 0;
};

} // namespace demo
