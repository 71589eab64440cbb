// The benchmark program: every case in a process of its own, one table on the terminal, one JSON object a line in a
// file.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <sys/wait.h>
#include <unistd.h>

namespace bench {

std::string data_file(const std::string &path) {
    const char *folder = std::getenv("LOCUS_DATA");
    const std::filesystem::path file = std::filesystem::path(folder != nullptr ? folder : "../shared/data") / path;
    if (!std::filesystem::exists(file)) {
        throw Missing(file.string() + " is not there (set LOCUS_DATA to the data folder)");
    }
    return file.string();
}

namespace {

constexpr int left_out = 77;                // exit status of a child whose case cannot run here
constexpr const char *small_suffix = ".4k"; // marks the row without huge pages
constexpr const char *huge_tunable = "glibc.malloc.hugetlb=1";

struct Arguments {
    std::string only = ".*", out, row;
    bool quick = false, list = false;
};

Cases all_cases() {
    Cases cases;
    add_pmq_insert(cases);
    add_pmq_window(cases);
    add_pmq_readers(cases);
    add_pmq_queries(cases);
    add_pmq_storage(cases);
    add_pmq_topk(cases);
    add_pmq_cold(cases);
    add_voronoi(cases);
    add_voronoi_large(cases);
    add_updates(cases);
    add_weights(cases);
    add_thesis_chapter2(cases);
    add_thesis_weights(cases);
    add_gpu(cases);
    add_thesis_chapter3(cases);
    add_thesis_steady(cases);
    add_thesis_queries(cases);
    add_thesis_databases(cases);
    return cases;
}

/// The child's part: run one row and write "JSON\nline\n" to the pipe behind descriptor 3.
int run_row(const Arguments &arguments) {
    const bool small = arguments.row.ends_with(small_suffix);
    const std::string name =
        small ? arguments.row.substr(0, arguments.row.size() - std::strlen(small_suffix)) : arguments.row;
    for (const Case &entry : all_cases()) {
        if (entry.name != name) {
            continue;
        }
        Row row;
        row.name = arguments.row;
        row.unit = entry.unit;
        row.goals = small ? std::map<std::string, double>{} : entry.goals;
        row.quick = arguments.quick;
        const char *tunables = std::getenv("GLIBC_TUNABLES");
        row.huge_pages = tunables != nullptr && std::strstr(tunables, huge_tunable) != nullptr;
        row.target = build_target();
        try {
            entry.run(row);
        } catch (const Missing &reason) {
            std::fprintf(stderr, "%s left out: %s\n", row.name.c_str(), reason.what());
            return left_out;
        } catch (const std::exception &error) {
            std::fprintf(stderr, "%s failed: %s\n", row.name.c_str(), error.what());
            return EXIT_FAILURE;
        }
        for (const std::string &failure : row.failures) {
            std::fprintf(stderr, "%s differs from the oracle: %s\n", row.name.c_str(), failure.c_str());
        }
        const std::string text = row.json() + "\n" + row.line() + "\n";
        const bool written = write(3, text.data(), text.size()) == static_cast<ssize_t>(text.size());
        return written && row.checked() ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    std::fprintf(stderr, "no case %s\n", name.c_str());
    return EXIT_FAILURE;
}

/// Start this program again for one row, with or without huge pages; its text comes back through a pipe.
int spawn_row(const std::string &name, bool huge, bool quick, std::string &text) {
    int ends[2];
    if (pipe(ends) != 0) {
        std::perror("bench: pipe");
        std::exit(EXIT_FAILURE);
    }
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        dup2(ends[1], 3);
        if (ends[1] != 3) {
            close(ends[1]);
        }
        huge ? setenv("GLIBC_TUNABLES", huge_tunable, 1) : unsetenv("GLIBC_TUNABLES");
        execl("/proc/self/exe", "bench", "--row", name.c_str(), quick ? "--quick" : nullptr, nullptr);
        _exit(127);
    }
    close(ends[1]);
    char buffer[4096];
    for (ssize_t got; (got = read(ends[0], buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<std::size_t>(got));
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

/// Run the selected cases; the number of rows that failed.
int run_all(const Arguments &arguments) {
    const std::regex only(arguments.only);
    std::ofstream out(arguments.out, std::ios::trunc);
    if (!arguments.out.empty() && !out) {
        std::fprintf(stderr, "bench: cannot write %s\n", arguments.out.c_str());
        return 1;
    }
    int failed = 0, rows = 0;
    for (const Case &entry : all_cases()) {
        for (const bool small : {false, true}) {
            const std::string name = entry.name + (small ? small_suffix : "");
            if ((small && entry.pages == Pages::any) || !std::regex_search(name, only)) {
                continue;
            }
            if (arguments.list) {
                std::cout << name << '\n';
                continue;
            }
            if (rows++ == 0) {
                std::cout << Row::heading() << std::endl;
            }
            std::string text;
            const int status = spawn_row(name, !small, arguments.quick, text);
            failed += status != EXIT_SUCCESS && status != left_out;
            if (const std::size_t end = text.find('\n'); end != std::string::npos) {
                out << text.substr(0, end + 1) << std::flush;
                std::cout << text.substr(end + 1) << std::flush;
            } else if (status != left_out) {
                std::fprintf(stderr, "%s ended without a result (status %d)\n", name.c_str(), status);
            }
        }
    }
    return failed;
}

Arguments parse(int count, char **words) {
    Arguments arguments;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--quick") {
            arguments.quick = true;
        } else if (word == "--list") {
            arguments.list = true;
        } else if (i + 1 < count && word == "--only") {
            arguments.only = words[++i];
        } else if (i + 1 < count && word == "--out") {
            arguments.out = words[++i];
        } else if (i + 1 < count && word == "--row") {
            arguments.row = words[++i];
        } else {
            std::fprintf(stderr, "usage: bench [--only REGEX] [--out FILE] [--quick] [--list]\n");
            std::exit(2);
        }
    }
    return arguments;
}

} // namespace
} // namespace bench

int main(int count, char **words) {
    const bench::Arguments arguments = bench::parse(count, words);
    if (!arguments.row.empty()) {
        return bench::run_row(arguments);
    }
    const int failed = bench::run_all(arguments);
    if (failed > 0) {
        std::fprintf(stderr, "bench: %d row(s) failed\n", failed);
    }
    return failed > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
