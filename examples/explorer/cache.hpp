// Answers kept as long as they are good: each is computed once, by the first who asks, while the others wait for it.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace explorer {

template <typename Value>
class Cache {
public:
    explicit Cache(size_t entries) : most_(entries) {}

    // The value kept under `key` for this version of the store; otherwise what `compute` returns, which is then kept in
    // place of the one used longest ago. Any thread; `compute` is called without the cache's own lock.
    template <typename Compute>
    std::shared_ptr<const Value> get(const std::string &key, uint64_t version, Compute compute) {
        const std::shared_ptr<Entry> entry = find(key);
        const std::lock_guard lock(entry->mutex);
        if (entry->value == nullptr || entry->version < version) {
            entry->value = std::make_shared<const Value>(compute(entry->value.get()));
            entry->version = version;
        }
        return entry->value;
    }

private:
    struct Entry {
        std::mutex mutex; // of what follows
        uint64_t version = 0;
        std::shared_ptr<const Value> value;
        std::list<std::string>::iterator place; // in recent_
    };

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
    std::mutex mutex_; // of what follows
    std::unordered_map<std::string, std::shared_ptr<Entry>> entries_;
    std::list<std::string> recent_; // keys, the latest used first
};

} // namespace explorer
