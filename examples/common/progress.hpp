// A progress bar on a terminal, plain lines elsewhere; and numbers as people read them.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace demo {

class Progress {
public:
    // `title` leads the line. Writes to standard error.
    explicit Progress(std::string title);
    ~Progress(); // ends the line
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    // How far it is, 0..1 (negative: unknown), and a short note. Draws at most ten times a second on a terminal, and a
    // line every five seconds elsewhere; cheap to call in between.
    void at(double fraction, const std::string &note);
    void done(const std::string &note);

private:
    void draw(double fraction, const std::string &note);

    using Clock = std::chrono::steady_clock;
    std::string title_;
    bool terminal_;
    bool open_ = false; // the bar's line is not ended yet
    Clock::time_point next_;
};

std::string with_commas(uint64_t number);  // 1,234,567
std::string bytes_text(uint64_t bytes);    // 1.5 GiB
std::string duration_text(double seconds); // 12.3 us, 4.5 ms, 6.7 s, 2 min 5 s

} // namespace demo
