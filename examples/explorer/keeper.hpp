// Keeps a store's folder small: saves the store anew from time to time, which lets go of its log, and at the end.
#pragma once

#include <locus/pmq.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace explorer {

class Keeper {
public:
    // Every `seconds`. `store` has a folder, and outlives the keeper.
    Keeper(locus_pmq *store, double seconds);
    ~Keeper() { stop(); }
    Keeper(const Keeper &) = delete;
    Keeper &operator=(const Keeper &) = delete;

    void stop();                 // after a last save
    std::string failure() const; // why the latest save failed; empty: it did not

private:
    void run(double seconds);
    void save();

    locus_pmq *store_;
    mutable std::mutex mutex_; // of what follows
    std::condition_variable end_;
    bool stopping_ = false;
    std::string failure_;
    std::thread thread_;
};

} // namespace explorer
