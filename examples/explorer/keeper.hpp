// Keeps a store's folder small: saves the store anew from time to time, which lets go of its log, and at the end.
#pragma once

#include "explorer/older.hpp"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace explorer {

class Keeper {
public:
    // Every `seconds`. `store` has a folder, and outlives the keeper, as does `older` (null: there is none) with what
    // has left it. Whoever changes the store holds `changing`: so does the keeper for the moment that is saved.
    Keeper(locus_pmq *store, Older *older, std::mutex &changing, double seconds);
    ~Keeper() { stop(); }
    Keeper(const Keeper &) = delete;
    Keeper &operator=(const Keeper &) = delete;

    void stop();                 // after a last save
    std::string failure() const; // why the latest save failed; empty: it did not

private:
    void run(double seconds);
    void save();
    std::string checkpoint();

    locus_pmq *store_;
    Older *older_;
    std::mutex &changing_;
    mutable std::mutex mutex_; // of what follows
    std::condition_variable end_;
    bool stopping_ = false;
    std::string failure_;
    std::thread thread_;
};

} // namespace explorer
