// A progress bar for a call of the library: Call::at and its address are the call's callback.
#pragma once

#include "common/progress.hpp"

#include <cstdint>
#include <string>

namespace volume {

struct Call {
    explicit Call(const std::string &title) : bar(title) {}
    static int32_t at(double fraction, void *call) {
        static_cast<Call *>(call)->bar.at(fraction, "");
        return 0;
    }
    demo::Progress bar;
};

} // namespace volume
