// Progress and readable numbers.
#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace demo {
namespace {

int terminal_width() {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return 80;
    return size.ws_col;
}

std::string format(const char *pattern, double number) {
    char text[64];
    std::snprintf(text, sizeof text, pattern, number);
    return text;
}

} // namespace

Progress::Progress(std::string title)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + std::chrono::milliseconds(terminal_ ? 0 : 5000)) {}

Progress::~Progress() {
    if (open_)
        std::fputc('\n', stderr);
}

void Progress::at(double fraction, const std::string &note) {
    const Clock::time_point now = Clock::now();
    if (now < next_)
        return;
    next_ = now + std::chrono::milliseconds(terminal_ ? 100 : 5000);
    draw(fraction, note);
}

void Progress::done(const std::string &note) {
    draw(1, note);
    if (open_)
        std::fputc('\n', stderr);
    open_ = false;
}

void Progress::draw(double fraction, const std::string &note) {
    const bool known = fraction >= 0;
    const double part = std::clamp(fraction, 0.0, 1.0);
    const std::string percent = known ? format("%3.0f %%", std::floor(100 * part)) : "";
    if (!terminal_) {
        std::fprintf(stderr, "%s: %s%s%s\n", title_.c_str(), percent.c_str(), known ? "  " : "", note.c_str());
        return;
    }
    const int width = terminal_width();
    const int fixed = static_cast<int>(title_.size() + percent.size() + note.size()) + 8;
    const int bar = known ? std::clamp(width - fixed, 0, 30) : 0;
    const int full = static_cast<int>(std::lround(bar * part));
    std::string line = title_ + ' ';
    if (bar > 0) {
        line += '[';
        line.append(static_cast<size_t>(full), '#').append(static_cast<size_t>(bar - full), '.') += "] ";
    }
    line.append(percent).append("  ").append(note);
    line.resize(std::min(line.size(), static_cast<size_t>(std::max(width - 1, 1))));
    std::fprintf(stderr, "\r%s\033[K", line.c_str());
    std::fflush(stderr);
    open_ = true;
}

std::string with_commas(uint64_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0)
            text += ',';
        text += digits[i];
    }
    return text;
}

std::string bytes_text(uint64_t bytes) {
    const char *const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    double number = static_cast<double>(bytes);
    size_t unit = 0;
    for (; number >= 1024 && unit < 4; ++unit)
        number /= 1024;
    return format(unit == 0 ? "%.0f " : "%.1f ", number) + units[unit];
}

std::string duration_text(double seconds) {
    if (seconds < 1e-3)
        return format("%.1f us", seconds * 1e6);
    if (seconds < 1)
        return format("%.1f ms", seconds * 1e3);
    if (seconds < 120)
        return format("%.1f s", seconds);
    return format("%.0f min ", std::floor(seconds / 60)) + format("%.0f s", std::floor(std::fmod(seconds, 60)));
}

} // namespace demo
