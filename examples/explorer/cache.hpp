// Answers kept as long as they are good: each is computed once, by the first who asks, while the others wait for it.
#pragma once

#include "explorer/renewer.hpp"
#include "explorer/thrift.hpp"

#include <cstdint>
#include <exception>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

namespace explorer {

// An answer is good as long as the store has the version of which it tells. One that took long to compute is also used
// while it is young (see Thrift), and for some seconds more while the next one is computed in the background.
template <typename Value>
class Cache {
public:
    struct Made {
        Value value;
        uint64_t version = 0; // of which it tells
    };
    struct Found {
        std::shared_ptr<const Value> value;
        uint64_t version = 0;
    };

    Cache(size_t entries, Renewer &renewer, Thrift::Clock::duration usable = std::chrono::seconds(3))
        : most_(entries), renewer_(renewer), usable_(usable) {}

    // The value kept under `key`; otherwise what `compute` returns, a Made, which is then kept in place of the one used
    // longest ago. Any thread; a copy of `compute` may be called later, by another thread.
    template <typename Compute>
    Found get(const std::string &key, uint64_t version, const Compute &compute) {
        const std::shared_ptr<Entry> entry = find(key);
        const std::lock_guard lock(entry->mutex);
        const bool outdated = entry->found.value == nullptr || entry->found.version < version;
        if (!outdated || (entry->found.value != nullptr && !entry->thrift.due()))
            return entry->found;
        if (entry->found.value != nullptr && entry->thrift.costly() && entry->thrift.age() < usable_)
            renew(entry, compute);
        else
            entry->found = shared(entry->thrift.spend(compute));
        return entry->found;
    }

private:
    struct Entry {
        std::mutex mutex; // of what follows
        Found found;
        Thrift thrift;
        bool renewing = false;
        std::list<std::string>::iterator place; // in recent_
    };

    static Found shared(Made made) { return {std::make_shared<const Value>(std::move(made.value)), made.version}; }

    template <typename Compute>
    void renew(const std::shared_ptr<Entry> &entry, const Compute &compute) {
        if (std::exchange(entry->renewing, true))
            return;
        renewer_.add([entry, compute] {
            Thrift thrift;
            Found found;
            try {
                found = shared(thrift.spend(compute));
            } catch (const std::exception &) { // whoever asks when it has become too old is told
            }
            const std::lock_guard lock(entry->mutex);
            entry->renewing = false;
            if (found.value == nullptr)
                return;
            entry->thrift = thrift;
            if (found.version > entry->found.version)
                entry->found = found;
        });
    }

    std::shared_ptr<Entry> find(const std::string &key) {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<Entry> &entry = entries_[key];
        if (entry == nullptr) {
            entry = std::make_shared<Entry>();
            entry->place = recent_.insert(recent_.begin(), key);
        } else {
            recent_.splice(recent_.begin(), recent_, entry->place);
        }
        const std::shared_ptr<Entry> found = entry;
        if (entries_.size() > most_) {
            entries_.erase(recent_.back());
            recent_.pop_back();
        }
        return found;
    }

    size_t most_;
    Renewer &renewer_;
    Thrift::Clock::duration usable_; // how old a costly one may be when it is used
    std::mutex mutex_;               // of what follows
    std::unordered_map<std::string, std::shared_ptr<Entry>> entries_;
    std::list<std::string> recent_; // keys, the latest used first
};

} // namespace explorer
