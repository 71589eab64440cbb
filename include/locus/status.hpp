/* locus/status.hpp - what the C++ types of Locus share: errors, spans, callbacks. C++17, on the C interface alone.
 *
 * Every function that can fail takes a `status *` as its last argument. Without one, the default, a failure throws
 * locus::error; with one, it is stored there, nothing is thrown, and what the function returns is empty. Exceptions
 * that a callback of yours throws stop the call where it can stop, and come out of it in either case. Programs compiled
 * without exceptions pass a status everywhere: a failure that nobody looks at ends them. */
#ifndef LOCUS_STATUS_HPP
#define LOCUS_STATUS_HPP

#include <locus/status.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace locus {

/* A failed call: what() is the library's text, which names the function, the argument and the offending value. */
class error : public std::runtime_error {
public:
    error(locus_status code, const std::string &text) : std::runtime_error(text), code_(code) {}
    locus_status code() const noexcept { return code_; } /* LOCUS_E_ */
    const char *name() const noexcept { return locus_status_name(code_); }

private:
    locus_status code_;
};

/* What a call came to, for callers who do not want exceptions. */
class status {
public:
    bool ok() const noexcept { return code_ == LOCUS_OK; }
    locus_status code() const noexcept { return code_; } /* LOCUS_OK or LOCUS_E_ */
    const char *name() const noexcept { return locus_status_name(code_); }
    const std::string &text() const noexcept { return text_; } /* "" when ok */
    void set(locus_status code, std::string_view text) {
        code_ = code;
        text_ = text;
    }

private:
    locus_status code_ = LOCUS_OK;
    std::string text_;
};

/* The loaded library's version, as LOCUS_VERSION and as text. */
inline std::uint32_t version() noexcept { return locus_version(); }
inline std::string_view version_text() noexcept { return locus_version_text(); }

/* A pointer and a size: converts from arrays, vectors, std::array, std::span and whatever else has data() and size().
 */
template <class T>
class span {
public:
    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t N>
    constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    template <class Container,
              class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<Container &>().data()), T *>>>
    constexpr span(Container &&container) noexcept : data_(container.data()), size_(container.size()) {}
    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const noexcept { return data_[index]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/* A callback, usually a lambda. Where it answers a bool, true means yes or go on, and a lambda that returns nothing
 * always goes on. */
template <class Signature>
class callback;
template <class Result, class... Arguments>
class callback<Result(Arguments...)> {
public:
    callback() = default;
    template <class Function, class = std::enable_if_t<!std::is_same_v<std::decay_t<Function>, callback> &&
                                                       std::is_invocable_v<Function &, Arguments...>>>
    callback(Function function) {
        using Returned = std::invoke_result_t<Function &, Arguments...>;
        if constexpr (std::is_void_v<Returned> && std::is_same_v<Result, bool>) {
            function_ = [inner = std::move(function)](Arguments... arguments) mutable {
                inner(std::forward<Arguments>(arguments)...);
                return true;
            };
        } else {
            static_assert(std::is_same_v<Returned, Result> || !std::is_same_v<Result, bool>,
                          "this callback returns bool (true: go on) or nothing");
            function_ = std::move(function);
        }
    }
    explicit operator bool() const noexcept { return static_cast<bool>(function_); }
    Result operator()(Arguments... arguments) const { return function_(std::forward<Arguments>(arguments)...); }

private:
    std::function<Result(Arguments...)> function_;
};

/* Told the fraction done, 0..1; false cancels. */
using progress = callback<bool(double fraction)>;
/* Told a level, LOCUS_LOG_, and one line of text. */
using log = callback<void(std::int32_t level, std::string_view text)>;

namespace detail {

[[noreturn]] inline void raise(locus_status code, const std::string &text) {
#if defined(__cpp_exceptions)
    throw error(code, text);
#else
    static_cast<void>(code), static_cast<void>(text);
    std::abort();
#endif
}

/* Hand a call's result to the caller's status, or throw it. True: the call worked. */
inline bool settle(locus_status code, status *result, std::string_view text) {
    if (result != nullptr)
        result->set(code, code == LOCUS_OK ? std::string_view() : text);
    else if (code != LOCUS_OK)
        raise(code, std::string(text));
    return code == LOCUS_OK;
}
inline bool settle(locus_status code, status *result) { return settle(code, result, locus_last_error()); }

/* Refuse an array of another size than is needed, as the library cannot see sizes. True: it is right. */
inline bool has_size(const char *what, std::size_t found, std::uint64_t wanted, status *result) {
    if (found == wanted)
        return true;
    return settle(LOCUS_E_ARGUMENT, result,
                  std::string(what) + " holds " + std::to_string(found) + " elements instead of " +
                      std::to_string(wanted));
}

/* The first exception of some callbacks, kept while the C library is on the stack. */
class thrown {
public:
    bool any() const noexcept { return any_.load(std::memory_order_acquire); }
    /* Call `function`; where it throws, or something has been thrown before, the answer is `otherwise`. */
    template <class Result, class Function>
    Result guard(Result otherwise, Function &&function) noexcept {
#if defined(__cpp_exceptions)
        if (any())
            return otherwise;
        try {
            return function();
        } catch (...) {
            const std::lock_guard<std::mutex> hold(mutex_);
            if (!first_)
                first_ = std::current_exception();
            any_.store(true, std::memory_order_release);
            return otherwise;
        }
#else
        static_cast<void>(otherwise);
        return function();
#endif
    }
    void rethrow() {
        if (!any())
            return;
        std::exception_ptr first;
        {
            const std::lock_guard<std::mutex> hold(mutex_);
            first = std::exchange(first_, nullptr);
            any_.store(false, std::memory_order_release);
        }
        if (first)
            std::rethrow_exception(first);
    }

private:
    std::atomic<bool> any_{false};
    std::mutex mutex_;
    std::exception_ptr first_;
};

/* A progress function during one call. What the call meets in `also`, an object's own callbacks, stops it as well. */
class progress_call {
public:
    explicit progress_call(const progress &function, const thrown *also = nullptr) : function_(function), also_(also) {}
    static std::int32_t at(double fraction, void *user) noexcept {
        auto &call = *static_cast<progress_call *>(user);
        if (call.also_ != nullptr && call.also_->any())
            return 1;
        return call.thrown_.guard(std::int32_t{1}, [&] { return !call.function_ || call.function_(fraction) ? 0 : 1; });
    }
    void rethrow() { thrown_.rethrow(); }

private:
    const progress &function_;
    const thrown *also_;
    thrown thrown_;
};

/* Make a handle's deleter from its destroy function. */
template <auto destroy>
struct ended_by {
    template <class Handle>
    void operator()(Handle *handle) const noexcept {
        destroy(handle);
    }
};

} // namespace detail
} // namespace locus
#endif
