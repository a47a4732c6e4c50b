#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "server_config.hpp"

namespace graspd::server {

/// The variable by which the supervisor tells the participant how often it was started again.
inline constexpr const char* kRestartsVariable = "GRASPD_RESTARTS";

/// What the end of the participant means.
struct ExitVerdict {
    bool restart = false;
    int exit_code = 0;  ///< of the supervisor, when there is no restart
};

/// Judges how the participant ended. 0 (it was told to stop) and 2 (bad configuration, which would
/// be as bad the next time) end the supervisor too; everything else is a crash. Whoever was told to
/// stop is never started again: then a crash is exit code 1.
/// @param wait_status  as waitpid() gives it
ExitVerdict judge_exit(int wait_status, bool stopping);

/// How long to wait before the next start.
/// @param previous  the wait before the life that just ended; zero for the first life
/// @param lifetime  how long that life was
std::chrono::milliseconds next_wait(std::chrono::milliseconds previous,
                                    std::chrono::milliseconds lifetime,
                                    const SupervisorConfig& config);

/// "signal=6" or "exit_code=1".
std::string exit_text(int wait_status);

/// The arguments of the participant: those of the supervisor without --supervise.
std::vector<std::string> participant_arguments(int argc, const char* const* argv);

/// How often the supervisor of this process started it again; 0 without a supervisor, and for a
/// variable that holds no number.
std::uint32_t restarts_from_environment();

/// Takes `event=...` lines; `fault` for those about a crash.
using SupervisorLog = std::function<void(bool fault, const std::string& line)>;

/// Runs this program again as a child, and starts it anew whenever it crashes, until it ends by
/// itself or SIGTERM or SIGINT comes, which is passed on. Removes the shared memory that a crash
/// leaves, reaps orphans when it is process 1 of a container, and takes the child along when it is
/// killed itself.
///
/// To be called from a process with one thread that blocks SIGTERM and SIGINT.
/// @param arguments  of the participant; the first is its name
/// @return the exit code
int supervise(const std::vector<std::string>& arguments, const SupervisorConfig& config,
              const SupervisorLog& log);

}  // namespace graspd::server
