#include "supervisor.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>

#include "shm_segments.hpp"

namespace graspd::server {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kExitInternal = 1;
constexpr int kExitUsage = 2;
constexpr int kExitNoProgram = 127;  // as a shell's

constexpr milliseconds kStopLimit{5000};  // the participant promises two seconds
// How often the participant's shared memory is looked for: it is made in the first moments.
constexpr milliseconds kFirstLook{50};
constexpr milliseconds kLook{1000};

milliseconds to_ms(double seconds) {
    return milliseconds(static_cast<milliseconds::rep>(seconds * 1e3));
}

milliseconds since(Clock::time_point start) {
    return std::chrono::duration_cast<milliseconds>(Clock::now() - start);
}

class Supervisor {
public:
    Supervisor(const std::vector<std::string>& arguments, const SupervisorConfig& config,
               const SupervisorLog& log)
        : arguments_(arguments), config_(config), log_(log) {
        sigemptyset(&signals_);
        for (const int signal : {SIGTERM, SIGINT, SIGCHLD}) sigaddset(&signals_, signal);
        std::signal(SIGCHLD,
                    SIG_DFL);  // ignored, as some parents leave it, no child can be waited for
        sigset_t child_ended;
        sigemptyset(&child_ended);
        sigaddset(&child_ended, SIGCHLD);
        sigprocmask(SIG_BLOCK, &child_ended, nullptr);
        // Not /proc/self/exe as it stands: the process would be listed as "exe".
        program_ = std::filesystem::read_symlink("/proc/self/exe").string();
    }

    int run() {
        milliseconds wait{0};
        while (!stopping_) {
            const auto born = Clock::now();
            const int status = live();
            remove_shared_memory();
            const ExitVerdict verdict = judge_exit(status, stopping_);
            const milliseconds lifetime = since(born);
            const std::string end =
                exit_text(status) + " lifetime_ms=" + std::to_string(lifetime.count());
            if (!verdict.restart) {
                log_(verdict.exit_code != 0, "event=child_ended " + end);
                return verdict.exit_code;
            }
            wait = next_wait(wait, lifetime, config_);
            ++restarts_;
            log_(true, "event=child_died " + end + " restarts=" + std::to_string(restarts_) +
                           " backoff_ms=" + std::to_string(wait.count()));
            pause(wait);
        }
        return 0;  // told to stop while there was nobody to tell
    }

private:
    /// One life of the participant. @return its wait status
    int live() {
        ::setenv(kRestartsVariable, std::to_string(restarts_).c_str(), 1);
        const pid_t self = ::getpid();
        child_ = ::fork();
        if (child_ == 0) become_participant(self);
        if (child_ < 0) {
            log_(true, std::string("event=no_child why=\"") + std::strerror(errno) + '"');
            return W_EXITCODE(kExitInternal, 0);
        }
        log_(false, "event=child_started pid=" + std::to_string(child_) +
                        " restarts=" + std::to_string(restarts_));
        std::optional<int> status;
        milliseconds look = kFirstLook;
        std::optional<Clock::time_point> limit;
        while (!(status = reap())) {
            const int signal = wait_signal(look);
            look = std::min(2 * look, kLook);
            for (auto& file : owned_segments(child_)) segments_.insert(std::move(file));
            if (signal == SIGTERM || signal == SIGINT) {
                stopping_ = true;
                if (!limit) limit = Clock::now() + kStopLimit;
                ::kill(child_, signal);
            }
            if (limit && Clock::now() >= *limit) ::kill(child_, SIGKILL);
        }
        return *status;
    }

    /// In the child. SIGTERM and SIGINT stay blocked: one that comes early waits for main().
    [[noreturn]] void become_participant(pid_t parent) const {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(kExitInternal);  // it died before that took effect
        sigset_t child_ended;
        sigemptyset(&child_ended);
        sigaddset(&child_ended, SIGCHLD);
        sigprocmask(SIG_UNBLOCK, &child_ended, nullptr);
        std::vector<char*> argv;
        argv.reserve(arguments_.size() + 1);
        for (const std::string& word : arguments_) argv.push_back(const_cast<char*>(word.c_str()));
        argv.push_back(nullptr);
        ::execv(program_.c_str(), argv.data());
        ::_exit(kExitNoProgram);
    }

    /// Reaps whoever has ended, orphans too. @return the participant's status, if it was among them
    std::optional<int> reap() const {
        std::optional<int> ended;
        int status = 0;
        for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG)) > 0;) {
            if (pid == child_) ended = status;
        }
        return ended;
    }

    /// @return the signal that came, or a negative number after the time
    int wait_signal(milliseconds time) const {
        const timespec limit{static_cast<time_t>(time.count() / 1000),
                             static_cast<long>(time.count() % 1000 * 1'000'000)};
        return ::sigtimedwait(&signals_, nullptr, &limit);
    }

    void pause(milliseconds wait) {
        const auto end = Clock::now() + wait;
        while (!stopping_ && Clock::now() < end) {
            const auto left = std::chrono::ceil<milliseconds>(end - Clock::now());
            const int signal = wait_signal(std::max(left, milliseconds(0)));
            stopping_ = signal == SIGTERM || signal == SIGINT;
            reap();
        }
    }

    /// A participant that left by itself took its files along; of a dead one nobody holds the lock.
    void remove_shared_memory() {
        for (const auto& file : segments_) {
            if (remove_segment(file)) log_(false, "event=segment_removed file=" + file.string());
        }
        segments_.clear();
    }

    const std::vector<std::string>& arguments_;
    const SupervisorConfig& config_;
    const SupervisorLog& log_;
    std::string program_;
    sigset_t signals_{};
    pid_t child_ = -1;
    bool stopping_ = false;
    std::uint32_t restarts_ = 0;
    std::set<std::filesystem::path> segments_;  ///< lock files of the child's shared memory
};

}  // namespace

ExitVerdict judge_exit(int wait_status, bool stopping) {
    const bool exited = WIFEXITED(wait_status);
    const int code = exited ? WEXITSTATUS(wait_status) : kExitInternal;
    if (exited && (code == 0 || code == kExitUsage)) return {false, code};
    return {!stopping, stopping ? code : 0};
}

milliseconds next_wait(milliseconds previous, milliseconds lifetime,
                       const SupervisorConfig& config) {
    const bool healthy = lifetime >= to_ms(config.healthy_after_s);
    const milliseconds first = to_ms(config.first_wait_s);
    const milliseconds next = healthy || previous.count() == 0 ? first : 2 * previous;
    return std::min(next, to_ms(config.longest_wait_s));
}

std::string exit_text(int wait_status) {
    return WIFEXITED(wait_status) ? "exit_code=" + std::to_string(WEXITSTATUS(wait_status))
                                  : "signal=" + std::to_string(WTERMSIG(wait_status));
}

std::vector<std::string> participant_arguments(int argc, const char* const* argv) {
    std::vector<std::string> words(argv, argv + argc);
    std::erase(words, "--supervise");
    return words;
}

std::uint32_t restarts_from_environment() {
    const char* text = std::getenv(kRestartsVariable);  // NOLINT(concurrency-mt-unsafe)
    std::uint32_t count = 0;
    if (text == nullptr) return count;
    const std::string_view digits(text);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    return read.ec == std::errc() && read.ptr == digits.data() + digits.size() ? count : 0;
}

int supervise(const std::vector<std::string>& arguments, const SupervisorConfig& config,
              const SupervisorLog& log) {
    return Supervisor(arguments, config, log).run();
}

}  // namespace graspd::server
