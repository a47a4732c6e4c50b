#pragma once

namespace graspd::server {

/// From here on an abort ends the process with an exit code, told on standard error, instead of as
/// a crash. For the time when all is answered and the middleware alone is at work: Debian's Fast
/// DDS 2.9 keeps its assertions, and one of them fails when, with security, a message is on its way
/// to the last participant just as that leaves (SecurityManager::encode_rtps_message, an empty
/// receiving list).
void exit_on_abort(int code);

}  // namespace graspd::server
