#include "painter.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "graspd/base/stop.hpp"
#include "server_fakes.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

// Pictures: which plans get one, and that nobody waits for them.

namespace graspd::server {
namespace {

using test::Watched;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Ids = std::vector<std::string>;

/// An answer whose plan is to be drawn.
Answer drawable(const std::string& id) {
    Answer answer;
    answer.out.reply.request_id = id;
    answer.work.drawable = std::make_shared<const PlanSubject>();
    return answer;
}

/// Draws by noting the id; the first picture takes until it is let go.
struct SlowHand {
    Watched<Ids> begun;
    Watched<bool> released;

    PainterParts parts() {
        return {[this](const Answer& answer) {
                    begun.change([&](Ids& ids) { ids.push_back(answer.out.reply.request_id); });
                    if (begun.copy().size() == 1) released.wait([](bool let_go) { return let_go; });
                },
                [](const Answer&, const std::string&) {}};
    }
    bool wait_for(std::size_t count) {
        return begun.wait([&](const Ids& ids) { return ids.size() >= count; });
    }
};

// "second" gives way to "third": a viewer shows one picture.
TEST(Painter, DrawsTheNewestPlanNext) {
    SlowHand hand;
    Painter painter(hand.parts());
    painter.answered(drawable("first"));
    ASSERT_TRUE(hand.wait_for(1));
    painter.answered(drawable("second"));
    painter.answered(drawable("third"));
    hand.released.change([](bool& let_go) { let_go = true; });
    ASSERT_TRUE(hand.wait_for(2));
    painter.stop();
    EXPECT_THAT(hand.begun.copy(), ElementsAre("first", "third"));
}

TEST(Painter, LeavesPlansAloneThatAreNotToBeDrawn) {
    SlowHand hand;
    hand.released.change([](bool& let_go) { let_go = true; });
    Painter painter(hand.parts());
    Answer plain = drawable("plain");
    plain.work.drawable = nullptr;
    painter.answered(plain);
    painter.answered(drawable("drawn"));
    ASSERT_TRUE(hand.wait_for(1));
    painter.stop();
    EXPECT_THAT(hand.begun.copy(), ElementsAre("drawn"));
}

// A picture that would never be finished, and one that waits behind it.
TEST(Painter, StopsWithinAPicture) {
    Watched<int> begun;
    Watched<Ids> failures;
    Painter painter({[&](const Answer&) {
                         begun.change([](int& count) { ++count; });
                         while (true) stop_point();
                     },
                     [&](const Answer&, const std::string& what) {
                         failures.change([&](Ids& list) { list.push_back(what); });
                     }});
    painter.answered(drawable("endless"));
    ASSERT_TRUE(begun.wait([](int count) { return count == 1; }));
    painter.answered(drawable("waits"));
    painter.stop();
    EXPECT_EQ(begun.copy(), 1);
    EXPECT_THAT(failures.copy(), IsEmpty());
}

TEST(Painter, TellsWhyThereIsNoPictureAndGoesOn) {
    Watched<Ids> failures;
    Painter painter({[](const Answer& answer) {
                         throw std::runtime_error("no paint for " + answer.out.reply.request_id);
                     },
                     [&](const Answer&, const std::string& what) {
                         failures.change([&](Ids& list) { list.push_back(what); });
                     }});
    for (const char* id : {"one", "two"}) {
        painter.answered(drawable(id));
        ASSERT_TRUE(failures.wait([&](const Ids& list) {
            return !list.empty() && list.back() == std::string("no paint for ") + id;
        }));
    }
}

/// A service whose answers end up in a list; its planner finds nothing in a box, or refuses it.
class Drawn {
public:
    explicit Drawn(const std::string& markers, PlanStatus status = PlanStatus::kNoGrasp)
        : service_(config_with(markers),
                   {{},
                    [this, status](const PlanRequest& problem, PreparedObjectPtr& object,
                                   const StopQuery&) {
                        let_go_.wait([](bool go) { return go; });
                        object = box_;
                        PlanReply reply;
                        reply.request_id = problem.request_id;
                        reply.status = status;
                        return reply;
                    },
                    [](const OutgoingReply&) { return true; },
                    [this](const Answer& answer) {
                        answers_.change([&](auto& list) { list.push_back(answer); });
                    }}) {
        service_.start();
    }
    void ask(const std::string& id, bool markers) {
        auto request = test::request(1, id);
        request->problem.options.want_markers = markers;
        request->problem.X_FO.translation().x() = 4.0;
        request->problem.grippers.emplace_back().name = "hand";
        service_.handle(std::move(request));
    }
    std::vector<Answer> wait_for(std::size_t count) {
        let_go_.change([](bool& go) { go = true; });
        EXPECT_TRUE(answers_.wait([&](const auto& list) { return list.size() >= count; }));
        return answers_.copy();
    }
    const PreparedObjectPtr& box() const { return box_; }

private:
    static ServerConfig config_with(const std::string& markers) {
        ServerConfig config;
        config.workers = 1;
        config.markers = markers;
        return config;
    }
    const PreparedObjectPtr box_ = prepare(graspd::test::box({0.04, 0.06, 0.08}), {}).value();
    Watched<bool> let_go_;
    Watched<std::vector<Answer>> answers_;
    PlannerService service_;  // last: its threads use the rest
};

TEST(PlannerServiceMarkers, ARequestSaysWhetherItsPlanIsDrawn) {
    Drawn drawn("on_request");
    drawn.ask("plain", false);
    drawn.ask("drawn", true);
    const auto answers = drawn.wait_for(2);
    ASSERT_THAT(answers, SizeIs(2));
    EXPECT_EQ(answers[0].work.drawable, nullptr);
    ASSERT_NE(answers[1].work.drawable, nullptr);
    EXPECT_EQ(answers[1].work.drawable->object, drawn.box());
    EXPECT_EQ(answers[1].work.drawable->X_FO.translation().x(), 4.0);
    ASSERT_THAT(answers[1].work.drawable->grippers, SizeIs(1));
    EXPECT_EQ(answers[1].work.drawable->grippers[0].name, "hand");
}

TEST(PlannerServiceMarkers, AlwaysDrawsWhatNobodyAskedFor) {
    Drawn drawn("always");
    drawn.ask("plain", false);
    EXPECT_NE(drawn.wait_for(1).at(0).work.drawable, nullptr);
}

TEST(PlannerServiceMarkers, NeverRefusesTheRequestByName) {
    Drawn drawn("never");
    drawn.ask("drawn", true);
    const auto answers = drawn.wait_for(1);
    EXPECT_EQ(answers.at(0).out.reply.status, PlanStatus::kInvalidRequest);
    EXPECT_EQ(answers.at(0).out.reply.message,
              "options[0].markers = true, but server.markers = never");
    EXPECT_EQ(answers.at(0).work.drawable, nullptr);
    drawn.ask("plain", false);
    EXPECT_EQ(drawn.wait_for(2).at(1).out.reply.status, PlanStatus::kNoGrasp);
}

TEST(PlannerServiceMarkers, ARefusedRequestIsNotDrawn) {
    Drawn drawn("always", PlanStatus::kInvalidRequest);
    drawn.ask("refused", true);
    EXPECT_EQ(drawn.wait_for(1).at(0).work.drawable, nullptr);
}

// The retry comes while the request is planned: two answers, one picture.
TEST(PlannerServiceMarkers, ARetryIsNotDrawnAgain) {
    Drawn drawn("on_request");
    drawn.ask("drawn", true);
    drawn.ask("drawn", true);
    const auto answers = drawn.wait_for(2);
    ASSERT_THAT(answers, SizeIs(2));
    EXPECT_NE(answers[0].work.drawable, nullptr);
    EXPECT_EQ(answers[1].work.drawable, nullptr);
}

}  // namespace
}  // namespace graspd::server
