/* locus/alerts.hpp - locus::alerts, the owner of a locus_alerts. Each member is the C function of its name: see
 * locus/alerts.h for units, ranges, threads and errors. */
#ifndef LOCUS_ALERTS_HPP
#define LOCUS_ALERTS_HPP

#include <locus/alerts.h>
#include <locus/pmq.hpp>

namespace locus {

/* The C options with their defaults; the callbacks are lambdas. What they throw comes out of pmq::insert. */
template <class Record = locus_point32>
struct alerts_options : locus_alerts_options {
    alerts_options() noexcept { locus_alerts_options_init(this, sizeof(locus_alerts_options)); }
    callback<bool(const locus_alert &)> alert;                 /* false stops */
    callback<bool(std::uint64_t fence, const Record &)> fence; /* false stops */
};

template <class Record = locus_point32>
class alerts {
public:
    explicit alerts(pmq<Record> &store, const alerts_options<Record> &options = {}, status *result = nullptr)
        : kept_(std::make_unique<kept>()) {
        kept_->alert = options.alert;
        kept_->fence = options.fence;
        if (store.callbacks_ != nullptr)
            kept_->thrown = store.callbacks_->thrown;
        locus_alerts_options plain = options;
        plain.alert = options.alert ? kept::on_alert : nullptr;
        plain.fence = options.fence ? kept::on_fence : nullptr;
        plain.alert_user = plain.fence_user = kept_.get();
        locus_alerts *made = nullptr;
        const locus_status code = locus_alerts_create(store.get(), &plain, &made);
        handle_.reset(made);
        detail::settle(code, result);
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_alerts *get() const noexcept { return handle_.get(); }

    /* The active alerts, the latest first. */
    std::vector<locus_alert> active(status *result = nullptr) const {
        std::vector<locus_alert> found(256);
        std::size_t count = 0;
        locus_status code;
        while ((code = locus_alerts_active(get(), found.data(), found.size(), &count)) == LOCUS_E_CAPACITY)
            found.resize(count);
        found.resize(code == LOCUS_OK ? count : 0);
        detail::settle(code, result);
        return found;
    }
    /* The query's filter is kept as long as the object, for an insert of another thread may still ask it. */
    void add_fence(std::uint64_t id, const query<Record> &where, status *result = nullptr) {
        auto fence = std::make_unique<fenced>(where, kept_ != nullptr ? kept_->thrown.get() : nullptr);
        const locus_status code = locus_alerts_add_fence(get(), id, fence->asked.get());
        if (code == LOCUS_OK && fence->asked.get()->filter != nullptr)
            kept_->filters.push_back(std::move(fence));
        detail::settle(code, result);
    }
    void remove_fence(std::uint64_t id, status *result = nullptr) {
        detail::settle(locus_alerts_remove_fence(get(), id), result);
    }
    locus_alerts_stats stats(status *result = nullptr) const {
        locus_alerts_stats stats{};
        stats.struct_size = sizeof stats;
        detail::settle(locus_alerts_get_stats(get(), &stats), result);
        return stats;
    }

private:
    struct fenced {
        fenced(const query<Record> &where, detail::thrown *thrown) : what(where), asked(what, thrown) {}
        query<Record> what;
        typename query<Record>::asked asked;
    };
    struct kept {
        callback<bool(const locus_alert &)> alert;
        callback<bool(std::uint64_t, const Record &)> fence;
        std::shared_ptr<detail::thrown> thrown;
        std::vector<std::unique_ptr<fenced>> filters;

        static std::int32_t on_alert(const locus_alert *alert, void *user) noexcept {
            auto &self = *static_cast<kept *>(user);
            return self.thrown->guard(std::int32_t{1}, [&] { return self.alert(*alert) ? 0 : 1; });
        }
        static std::int32_t on_fence(std::uint64_t fence, const void *record, void *user) noexcept {
            auto &self = *static_cast<kept *>(user);
            return self.thrown->guard(std::int32_t{1},
                                      [&] { return self.fence(fence, *static_cast<const Record *>(record)) ? 0 : 1; });
        }
    };

    /* In this order: the handle ends before what its callbacks use. */
    std::unique_ptr<kept> kept_;
    std::unique_ptr<locus_alerts, detail::ended_by<locus_alerts_destroy>> handle_;
};

} // namespace locus
#endif
