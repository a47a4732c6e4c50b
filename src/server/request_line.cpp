#include "request_line.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace graspd::server {
namespace {

bool is_plain(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("._-:/").find(c) != std::string_view::npos;
}

bool is_printable(char c) {
    return c >= ' ' && c <= '~';
}

}  // namespace

std::string log_value(const std::string& text) {
    if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += is_printable(c) ? c : '?';
    }
    return out + '"';
}

std::string request_line(const Answer& answer) {
    const RequestIdentity& identity = answer.out.to->identity();
    const PlanReply& reply = answer.out.reply;
    std::ostringstream line;
    line << std::fixed << std::setprecision(2) << "id=" << log_value(identity.request_id)
         << " client=" << log_value(identity.client_id) << " status=" << to_string(reply.status)
         << " attempt=" << answer.out.attempt << " written=" << (answer.written ? "yes" : "no")
         << " points=" << answer.work.points << " grasps=" << reply.grasps.size()
         << " total_ms=" << answer.total_ms << " queue_ms=" << answer.work.queue_ms
         << " convert_ms=" << answer.work.convert_ms << " plan_ms=" << answer.work.plan_ms;
    for (const StageReport& stage : reply.report.stages) {
        line << ' ' << stage.name << "_ms=" << stage.ms;
    }
    if (!reply.message.empty()) line << " message=" << log_value(reply.message);
    return line.str();
}

}  // namespace graspd::server
