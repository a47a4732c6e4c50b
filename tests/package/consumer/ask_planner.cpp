// Opens the client's end of the wire with a profile file that is not there: no participant starts.
#include <iostream>

#include "graspd/dds/planner_client.hpp"

int main() {
    graspd::DdsSettings settings;
    settings.profile_file = "/nowhere/loopback.xml";
    const auto client = graspd::PlannerClient::open(settings, "consumer");
    if (client.ok()) return 1;
    std::cout << client.error().detail << '\n';
}
