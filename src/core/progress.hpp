// Progress and cancel: passes the caller's callback at most a few hundred calls, never a fraction smaller than the
// last.
#pragma once

#include "core/error.hpp"

namespace locus {

class Progress {
public:
    Progress() = default;
    Progress(locus_progress_fn call, void *user) : call_(call), user_(user) {}

    // Tell the caller that `fraction` of the work is done; throws LOCUS_E_STOPPED when the answer is to stop.
    void report(double fraction) {
        if (call_ == nullptr || fraction < next_)
            return;
        const double bounded = fraction < 1.0 ? fraction : 1.0;
        next_ = bounded + 1.0 / 256;
        if (call_(first_ + bounded * (last_ - first_), user_) != 0)
            fail(LOCUS_E_STOPPED, "stopped by the progress callback");
    }

    // What report() tells from now on covers the part first..last of the whole work.
    void part(double first, double last) {
        first_ = first;
        last_ = last;
        next_ = 0;
    }

    bool wanted() const { return call_ != nullptr; }

private:
    locus_progress_fn call_ = nullptr;
    void *user_ = nullptr;
    double first_ = 0;
    double last_ = 1;
    double next_ = 0;
};

} // namespace locus
