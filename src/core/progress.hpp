// Progress and cancel: passes the caller's callback at most a few hundred calls, never a fraction smaller than the
// last.
#pragma once

#include "core/error.hpp"

namespace locus {

class Progress {
public:
    Progress() = default;
    Progress(locus_progress_fn call, void *user) : call_(call), user_(user) {}

    // Tell the caller that `fraction` of the current part is done; throws LOCUS_E_STOPPED when the answer is to stop.
    void report(double fraction) {
        if (call_ == nullptr)
            return;
        const double whole = first_ + (fraction < 1 ? fraction : 1) * (last_ - first_);
        const bool end = whole >= 1 && told_ < 1;
        if (whole < told_ + 1.0 / 256 && !end)
            return;
        told_ = whole;
        if (call_(whole, user_) != 0)
            fail(LOCUS_E_STOPPED, "stopped by the progress callback");
    }

    // What report() tells from now on covers the part first..last of the whole work.
    void part(double first, double last) {
        first_ = first;
        last_ = last;
    }

private:
    locus_progress_fn call_ = nullptr;
    void *user_ = nullptr;
    double first_ = 0;
    double last_ = 1;
    double told_ = -1;
};

} // namespace locus
