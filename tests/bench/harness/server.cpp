// Server processes.
#include "tests/bench/harness/server.hpp"

#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bench {

std::vector<std::string> as_user(const std::string &user) {
    // Changing the user clears the signal that the constructor asked for: setpriv asks for it again.
    std::vector<std::string> words{"setpriv", "--pdeathsig", "INT"};
    if (geteuid() == 0) {
        words.insert(words.end(), {"--reuid", user, "--regid", user, "--clear-groups"});
    }
    return words;
}

Server::Server(const std::vector<std::string> &command) {
    std::vector<char *> words;
    for (const std::string &word : command) {
        words.push_back(const_cast<char *>(word.c_str()));
    }
    words.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) {
        throw std::runtime_error("cannot start " + command.front());
    }
    if (pid_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGINT);
        const int quiet = open("/dev/null", O_WRONLY);
        dup2(quiet, STDOUT_FILENO);
        dup2(quiet, STDERR_FILENO);
        execvp(words.front(), words.data());
        _exit(127);
    }
}

Server::~Server() {
    kill(pid_, SIGINT);
    waitpid(pid_, nullptr, 0);
}

} // namespace bench
