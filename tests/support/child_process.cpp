#include "support/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>

namespace graspd::test {
namespace {

constexpr std::chrono::seconds kLimit{10};

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    std::array<int, 2> out{};
    std::array<int, 2> err{};
    if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipes for " + program);
    }
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    const int failed =
        ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(out[1]);
    ::close(err[1]);
    if (failed != 0) throw std::runtime_error(program + " does not start");
    threads_.emplace_back([this, from = out[0]] { collect(from, output_); });
    threads_.emplace_back([this, from = err[0]] { collect(from, errors_); });
    threads_.emplace_back([this] { reap(); });
}

ChildProcess::~ChildProcess() {
    send_signal(SIGKILL);
}

void ChildProcess::send_signal(int signal) const {
    const std::scoped_lock lock(mutex_);
    if (pid_ > 0 && !exit_) ::kill(pid_, signal);
}

void ChildProcess::collect(int descriptor, std::string& to) {
    std::array<char, 4096> chunk{};
    for (ssize_t n = 0; (n = ::read(descriptor, chunk.data(), chunk.size())) > 0;) {
        const std::scoped_lock lock(mutex_);
        to.append(chunk.data(), static_cast<std::size_t>(n));
        changed_.notify_all();
    }
    ::close(descriptor);
}

/// Waits without reaping first: the id stays taken until nobody can signal it any more.
void ChildProcess::reap() {
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT);
    const std::scoped_lock lock(mutex_);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    changed_.notify_all();
}

bool ChildProcess::wait_for_error_text(const std::string& text) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kLimit, [&] { return errors_.find(text) != std::string::npos; });
}

std::optional<int> ChildProcess::wait_exit() {
    std::optional<int> code;
    {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, kLimit, [&] { return exit_.has_value(); });
        code = exit_;
    }
    if (code) threads_.clear();  // joins: everything that it wrote has been read
    return code;
}

std::string ChildProcess::output() const {
    const std::scoped_lock lock(mutex_);
    return output_;
}

std::string ChildProcess::errors() const {
    const std::scoped_lock lock(mutex_);
    return errors_;
}

}  // namespace graspd::test
