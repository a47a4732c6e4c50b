#include <gmock/gmock.h>
#include <net/if.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "graspd/dds/planner_client.hpp"
#include "graspd/dds/planner_port.hpp"
#include "participant.hpp"
#include "stub_planner.hpp"
#include "support/dds_domain.hpp"
#include "support/plan_samples.hpp"

namespace graspd {
namespace {

using test::loopback_settings;
using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr const char* kRequestReader = "<data_reader profile_name=\"/graspd/grasp_request";
constexpr const char* kRequestWriter = "<data_writer profile_name=\"/graspd/grasp_request";
constexpr const char* kReplyReader = "<data_reader profile_name=\"/graspd/ranked_grasps";
constexpr const char* kReplyWriter = "<data_writer profile_name=\"/graspd/ranked_grasps";

std::string loopback_text() {
    std::ifstream file(loopback_settings().profile_file);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Each test is a process of its own: the middleware keeps the profiles that it has read.
class Profiles : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(directory_); }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    /// The loopback profile with one piece of text replaced, every time it occurs.
    std::string edited(const std::string& from, const std::string& to) {
        std::string text = loopback_text();
        std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        for (; at != std::string::npos; at = text.find(from, at + to.size())) {
            text.replace(at, from.size(), to);
        }
        return write(text);
    }
    /// The loopback profile with text replaced after the first place where `after` stands.
    std::string edited_after(const std::string& after, const std::string& from,
                             const std::string& to) {
        std::string text = loopback_text();
        const std::size_t at = text.find(from, text.find(after));
        EXPECT_NE(at, std::string::npos) << from;
        return write(text.replace(at, from.size(), to));
    }
    std::string write(const std::string& text) {
        const auto file = directory_ / "profile.xml";
        std::ofstream(file) << text;
        return file.string();
    }
    /// The error of opening a port with a profile file.
    static PlanError error_of(const std::string& file) {
        DdsSettings settings = loopback_settings();
        settings.profile_file = file;
        auto port = PlannerPort::open(settings, [](auto) {});
        EXPECT_FALSE(port.ok()) << file;
        return port.ok() ? PlanError{} : port.error();
    }

    const std::filesystem::path directory_ =
        std::filesystem::temp_directory_path() / ("graspd_profiles_" + std::to_string(::getpid()));
};

void expect_unreadable(const PlanError& error, const std::string& says) {
    EXPECT_EQ(error.code, PlanErrorCode::kUnreadableFile);
    EXPECT_THAT(error.detail, AllOf(HasSubstr("profile.xml"), HasSubstr(says)));
}

/// Whether there is no network here but loopback (scripts/test makes it so). Profiles that reach
/// out are tried nowhere else.
bool is_isolated() {
    bool isolated = true;
    auto* const all = ::if_nameindex();
    for (auto* one = all; one != nullptr && one->if_index != 0; ++one) {
        isolated = isolated && std::string(one->if_name) == "lo";
    }
    ::if_freenameindex(all);
    return isolated;
}

/// Planner and client with one profile file: a request gets its answer.
void expect_answer(const std::string& profile) {
    DdsSettings settings = loopback_settings();
    settings.profile_file = GRASPD_SOURCE_DIR "/profiles/dds/" + profile;
    test::StubPlanner planner(
        [](const test::SharedRequest& request) {
            return test::verdict(request, PlanStatus::kNoGrasp, "through");
        },
        settings);
    auto client = PlannerClient::open(settings, "client");
    ASSERT_TRUE(client.ok()) << client.error().detail;
    const auto reply = client.value()->request(test::small_request(), 10s, 1);
    ASSERT_TRUE(reply.ok()) << reply.error().detail;
    EXPECT_EQ(reply.value().message, "through");
}

TEST_F(Profiles, LoopbackCarriesARequest) {
    expect_answer("loopback.xml");
}

TEST_F(Profiles, LargeMeshesCarriesARequest) {
    expect_answer("large_meshes.xml");
}

TEST_F(Profiles, LanCarriesARequest) {
    if (!is_isolated()) GTEST_SKIP() << "it would reach out of this machine";
    expect_answer("lan.xml");
}

TEST_F(Profiles, ContainerCarriesARequest) {
    if (!is_isolated()) GTEST_SKIP() << "it would reach out of this machine";
    expect_answer("container.xml");
}

/// A discovery server as `fast-discovery-server -i INDEX -l 127.0.0.1 -p PORT` starts it.
class DiscoveryServer {
public:
    DiscoveryServer(const char* prefix, std::uint32_t port) {
        using namespace eprosima::fastrtps::rtps;  // NOLINT(google-build-using-namespace)
        dds::fast::DomainParticipantQos qos;
        auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
        udp->interfaceWhiteList = {"127.0.0.1"};
        qos.transport().use_builtin_transports = false;
        qos.transport().user_transports = {udp};
        std::istringstream(prefix) >> qos.wire_protocol().prefix;
        auto& builtin = qos.wire_protocol().builtin;
        builtin.discovery_config.discoveryProtocol = DiscoveryProtocol_t::SERVER;
        Locator_t locator(LOCATOR_KIND_UDPv4, port);
        IPLocator::setIPv4(locator, "127.0.0.1");
        builtin.metatrafficUnicastLocatorList.push_back(locator);
        server_ = factory().create_participant(test::test_domain(), qos);
        EXPECT_NE(server_, nullptr);
    }
    ~DiscoveryServer() { factory().delete_participant(server_); }
    DiscoveryServer(const DiscoveryServer&) = delete;
    DiscoveryServer& operator=(const DiscoveryServer&) = delete;

private:
    static dds::fast::DomainParticipantFactory& factory() {
        return *dds::fast::DomainParticipantFactory::get_instance();
    }
    dds::fast::DomainParticipant* server_ = nullptr;
};

// One server is enough when the other is away.
TEST_F(Profiles, DiscoveryServerCarriesARequest) {
    const DiscoveryServer second("44.53.01.5f.45.50.52.4f.53.49.4d.41", 11812);
    expect_answer("discovery_server.xml");
}

// A segment that /dev/shm cannot hold ends the process by SIGBUS (as in containers, which get 64
// MB).
TEST_F(Profiles, SharedMemoryCarriesARequest) {
    struct statvfs shm {};
    const bool known = ::statvfs("/dev/shm", &shm) == 0;
    if (!known || shm.f_bavail * shm.f_frsize < (std::uint64_t{320} << 20)) {
        GTEST_SKIP() << "/dev/shm has no room for two segments of 64 MB with their queues";
    }
    expect_answer("shm.xml");
}

TEST_F(Profiles, MissingFileIsNamed) {
    const auto error = error_of("/no/such/profile.xml");
    EXPECT_EQ(error.code, PlanErrorCode::kUnreadableFile);
    EXPECT_THAT(error.detail, HasSubstr("/no/such/profile.xml"));
    EXPECT_EQ(error_of("").code, PlanErrorCode::kUnreadableFile);
    EXPECT_EQ(error_of("/tmp").code, PlanErrorCode::kUnreadableFile);
}

TEST_F(Profiles, FileThatIsNotXmlIsRefused) {
    expect_unreadable(error_of(write("domain: 7\n")), "not a valid profile file");
}

TEST_F(Profiles, CutFileIsRefused) {
    const std::string text = loopback_text();
    expect_unreadable(error_of(write(text.substr(0, text.size() / 2))), "not a valid profile file");
}

TEST_F(Profiles, UnknownElementIsRefused) {
    error_of(edited("interfaceWhiteList", "interfaceWhitelist"));
}

TEST_F(Profiles, WrongValueIsRefused) {
    error_of(edited_after(kReplyWriter, "TRANSIENT_LOCAL", "TRANSIENT_LOCALLY"));
}

class LackingProfiles : public Profiles, public testing::WithParamInterface<const char*> {};

// A profile of that name for the other kind of endpoint is no help.
TEST_P(LackingProfiles, AreRefusedByName) {
    const std::string tag = GetParam();
    const std::string name = tag.substr(tag.find('"') + 1);
    expect_unreadable(error_of(edited(tag + "\"", tag.substr(0, tag.find('"')) + "\"other\"")),
                      name);
}
INSTANTIATE_TEST_SUITE_P(Profiles, LackingProfiles,
                         testing::Values("<participant profile_name=\"graspd_participant",
                                         kRequestReader, kRequestWriter, kReplyReader,
                                         kReplyWriter));

TEST_F(Profiles, BestEffortRequestsAreRefused) {
    expect_unreadable(error_of(edited_after(kRequestReader, "RELIABLE", "BEST_EFFORT")),
                      "data_reader /graspd/grasp_request must be RELIABLE");
}

TEST_F(Profiles, ForgettingRequestsAreRefused) {
    expect_unreadable(error_of(edited_after(kRequestReader, "KEEP_ALL", "KEEP_LAST")),
                      "data_reader /graspd/grasp_request must be KEEP_ALL");
}

TEST_F(Profiles, VolatileRepliesAreRefused) {
    expect_unreadable(error_of(edited_after(kReplyWriter, "TRANSIENT_LOCAL", "VOLATILE")),
                      "data_writer /graspd/ranked_grasps must be TRANSIENT_LOCAL");
}

/// 192.0.2.0/24 is for documentation (RFC 5737): nobody has such an address.
constexpr const char* kAbsentAddress = "192.0.2.77";

// The middleware would make a participant that never hears of anybody.
TEST_F(Profiles, AbsentInterfaceIsNamed) {
    const auto error = error_of(edited("127.0.0.1", kAbsentAddress));
    EXPECT_EQ(error.code, PlanErrorCode::kInternal) << "a supervisor shall try again";
    EXPECT_THAT(error.detail, AllOf(HasSubstr("profile.xml"), HasSubstr(kAbsentAddress)));
}

TEST_F(Profiles, OneInterfaceOfSeveralIsEnough) {
    DdsSettings settings = loopback_settings();
    settings.profile_file =
        edited("<interfaceWhiteList>",
               "<interfaceWhiteList><address>" + std::string(kAbsentAddress) + "</address>");
    EXPECT_TRUE(PlannerPort::open(settings, [](auto) {}).ok());
}

TEST_F(Profiles, InterfaceThatComesUpIsTaken) {
    if (!is_isolated() || ::geteuid() != 0) GTEST_SKIP() << "no network of its own to change";
    DdsSettings settings = loopback_settings();
    settings.profile_file = edited("127.0.0.1", kAbsentAddress);
    ASSERT_FALSE(PlannerPort::open(settings, [](auto) {}).ok());
    const auto address = [](const std::string& change) {
        return std::system(("ip address " + change + " 192.0.2.77/32 dev lo").c_str());
    };
    if (address("add") != 0) GTEST_SKIP() << "the address cannot be added here";
    const auto port = PlannerPort::open(settings, [](auto) {});
    EXPECT_TRUE(port.ok()) << port.error().detail;
    EXPECT_EQ(address("del"), 0);
}

// The middleware would keep the first file's profiles and say nothing.
TEST_F(Profiles, SecondFileInOneProcessIsRefused) {
    ASSERT_TRUE(PlannerPort::open(loopback_settings(), [](auto) {}).ok());
    const auto error = error_of(write(loopback_text()));
    EXPECT_EQ(error.code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(error.detail, AllOf(HasSubstr("profile.xml"), HasSubstr("loopback.xml")));
}

TEST_F(Profiles, BadSettingsAreRefused) {
    DdsSettings settings = loopback_settings();
    settings.domain = 233;
    const auto port = PlannerPort::open(settings, [](auto) {});
    ASSERT_FALSE(port.ok());
    EXPECT_EQ(port.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(port.error().detail, HasSubstr("domain = 233"));
    settings = loopback_settings();
    settings.max_payload_bytes = 0;
    EXPECT_THAT(PlannerPort::open(settings, [](auto) {}).error().detail,
                HasSubstr("max_payload_bytes = 0"));
}

// A profile file in the working folder, which the middleware would load by itself, changes nothing.
TEST_F(Profiles, FileInTheWorkingFolderIsNotRead) {
    std::ofstream(directory_ / "DEFAULT_FASTRTPS_PROFILES.xml")
        << edited_after(kRequestReader, "KEEP_ALL", "KEEP_LAST");
    std::filesystem::current_path(directory_);
    EXPECT_TRUE(PlannerPort::open(loopback_settings(), [](auto) {}).ok());
    std::filesystem::current_path("/");
}

// Every address that the participant announces, and so listens on, is the loopback interface's.
TEST_F(Profiles, LoopbackProfileStaysOnLoopback) {
    auto joined = dds::Participant::join(loopback_settings());
    ASSERT_TRUE(joined.ok());
    auto& factory = *dds::fast::DomainParticipantFactory::get_instance();
    dds::fast::DomainParticipantQos qos;
    ASSERT_EQ(factory.get_participant_qos_from_profile(dds::kParticipantProfile, qos),
              eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK);
    EXPECT_FALSE(qos.transport().use_builtin_transports);
    ASSERT_EQ(qos.transport().user_transports.size(), 1u);
    const auto* udp = dynamic_cast<const eprosima::fastdds::rtps::UDPv4TransportDescriptor*>(
        qos.transport().user_transports[0].get());
    ASSERT_NE(udp, nullptr);
    EXPECT_THAT(udp->interfaceWhiteList, testing::ElementsAre("127.0.0.1"));
}

}  // namespace
}  // namespace graspd
