#include "graspd/dds/status_reader.hpp"

#include <map>
#include <thread>

#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_state.hpp"
#include "guarded_type.hpp"
#include "participant.hpp"

namespace graspd {

Result<std::vector<PlannerState>> read_planner_states(const DdsSettings& settings,
                                                      std::chrono::milliseconds wait) {
    using StatusType = dds::GuardedType<dds::wire::PlannerStatus_PubSubType>;
    using eprosima::fastrtps::types::ReturnCode_t;
    auto joined = dds::Participant::join(settings);
    if (!joined.ok()) return joined.error();
    const auto participant = std::move(joined).value();
    auto guard = std::make_shared<dds::PayloadGuard>();
    guard->max_payload_bytes = settings.max_payload_bytes;
    dds::Contract contract = dds::kStatusEnds;
    contract.depth = 0;  // of all planners together: with 1, one would hide another
    auto* reader = participant->create_reader(
        {settings.names.status, dds::fast::TypeSupport(new StatusType(guard)), contract}, nullptr);
    if (reader == nullptr) {
        return PlanError{PlanErrorCode::kInternal, "the middleware refused an endpoint"};
    }
    std::map<std::string, PlannerState> latest;
    const auto deadline = std::chrono::steady_clock::now() + wait;
    while (std::chrono::steady_clock::now() < deadline) {
        reader->wait_for_unread_message(eprosima::fastrtps::Duration_t{0, 50000000});
        dds::wire::PlannerStatus_ sample;
        dds::fast::SampleInfo info;
        while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
            if (info.valid_data) latest[sample.planner_id()] = dds::read_state(sample);
        }
    }
    std::vector<PlannerState> out;
    for (auto& [id, state] : latest) out.push_back(std::move(state));
    return out;
}

}  // namespace graspd
