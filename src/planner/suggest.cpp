#include "suggest.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>

#include "limits.hpp"

namespace graspd::planner_detail {
namespace {

/// A limit and what it is relaxed to.
struct Change {
    Limit limit;
    double value = 0.0;
};

std::string score_text(double score) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), score, std::chars_format::fixed, 3);
    return {text.data(), end.ptr};
}

/// "A", "A and B", "A, B and C".
std::string listed(const std::vector<std::string>& items) {
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
        text += items[i];
    }
    return text;
}

std::string changes_text(const std::vector<Change>& changes) {
    std::string text;
    for (const Change& change : changes) {
        text += (text.empty() ? "" : " and ") + change_text(change.limit, change.value);
    }
    return text;
}

std::string values_text(const std::vector<Change>& changes) {
    std::vector<std::string> values;
    for (const Change& change : changes) values.push_back(value_text(change.limit, change.value));
    return listed(values) + (changes.size() > 1 ? " together" : "");
}

/// Plans with changed limits and counts how often.
class Trials {
public:
    Trials(const PlanRequest& request, const Replan& replan) : request_(request), replan_(replan) {}

    /// @return the grasps, best first
    std::vector<Grasp> with(const std::vector<Change>& changes) {
        PlanRequest changed = request_;
        for (const Change& change : changes) relax(changed, change.limit, change.value);
        ++plans_;
        return replan_(changed);
    }
    std::uint64_t plans() const { return plans_; }
    const PlanRequest& request() const { return request_; }

private:
    const PlanRequest& request_;
    const Replan& replan_;
    std::uint64_t plans_ = 0;
};

/// Changes that give a grasp.
struct Offer {
    std::vector<Change> changes;
    std::vector<Grasp> grasps;  ///< of the plan with them, best first

    double share() const {
        return std::accumulate(
            changes.begin(), changes.end(), 0.0,
            [](double sum, const Change& c) { return sum + share_of(c.limit, c.value); });
    }
    std::string text() const {
        return "with " + changes_text(changes) + " there is a grasp of score " +
               score_text(grasps.front().score);
    }
};

std::optional<Offer> offer_of(std::vector<Change> changes, Trials& trials) {
    auto grasps = trials.with(changes);
    if (grasps.empty()) return std::nullopt;
    return Offer{std::move(changes), std::move(grasps)};
}

/// Whether a value lies strictly between two others, whichever is the greater.
bool between(double value, double a, double b) {
    return value > std::min(a, b) && value < std::max(a, b);
}

/// The value to try next between one that gives no grasp and an offer: what the offer's least
/// demanding grasp needs, else the middle.
double next_value(const Limit& limit, double too_tight, const Offer& offer,
                  const PlanRequest& request) {
    const double enough = offer.changes.front().value;
    double least = enough;
    for (const Grasp& grasp : offer.grasps) {
        const double need = needed(limit, request, grasp);
        if (share_of(limit, need) < share_of(limit, least)) least = need;
    }
    if (between(least, too_tight, enough)) return least;
    return loosened(limit, 0.5 * (too_tight + enough));
}

/// The least relaxation of one limit that gives a grasp.
std::optional<Offer> least_relaxation(const Limit& limit, std::uint32_t bisections,
                                      Trials& trials) {
    double too_tight = limit.asked;
    if (limit.hint) {
        if (auto offer = offer_of({{limit, *limit.hint}}, trials)) return offer;
        too_tight = *limit.hint;
    }
    if (too_tight == limit.loosest) return std::nullopt;
    auto best = offer_of({{limit, limit.loosest}}, trials);
    for (std::uint32_t i = 0; best && i < bisections; ++i) {
        const double value = next_value(limit, too_tight, *best, trials.request());
        if (!between(value, too_tight, best->changes.front().value)) break;
        if (auto offer = offer_of({{limit, value}}, trials)) {
            best = std::move(offer);
        } else {
            too_tight = value;
        }
    }
    return best;
}

/// Of the limits by which candidates fell, the one that has to give way least.
std::optional<Offer> one_limit(std::vector<Limit> limits, std::uint32_t bisections,
                               Trials& trials) {
    const auto least_share = [](const Limit& limit) {
        if (limit.kind == LimitKind::kSources) return 1.0;
        return limit.hint ? share_of(limit, *limit.hint) : 0.0;
    };
    std::erase_if(limits, [](const Limit& limit) { return !limit.felled; });
    std::ranges::stable_sort(limits, {}, least_share);
    std::optional<Offer> best;
    for (const Limit& limit : limits) {
        if (best && least_share(limit) >= best->share()) break;
        auto offer = least_relaxation(limit, bisections, trials);
        if (offer && (!best || offer->share() < best->share())) best = std::move(offer);
    }
    return best;
}

/// From an offer that relaxes everything: only what is needed, by no more than the best grasp
/// needs.
Offer fewest(Offer offer, Trials& trials) {
    for (std::size_t i = offer.changes.size(); i-- > 0 && offer.changes.size() > 1;) {
        std::vector<Change> fewer = offer.changes;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        if (auto without = offer_of(std::move(fewer), trials)) offer = std::move(*without);
    }
    std::vector<Change> tighter = offer.changes;
    for (Change& change : tighter) {
        const double need = needed(change.limit, trials.request(), offer.grasps.front());
        if (need != change.limit.asked) change.value = need;
    }
    if (auto less = offer_of(std::move(tighter), trials)) return *less;
    return offer;
}

std::string what_gives_a_grasp(const std::vector<Limit>& limits, std::uint32_t bisections,
                               Trials& trials) {
    if (limits.empty()) return "no grasp, and the request sets no limit that could be relaxed";
    if (const auto offer = one_limit(limits, bisections, trials)) return offer->text();
    std::vector<Change> all;
    for (const Limit& limit : limits) all.push_back({limit, limit.loosest});
    auto offer = offer_of(all, trials);
    if (!offer) return "no grasp even with " + values_text(all);
    const Offer least = fewest(std::move(*offer), trials);
    return (least.changes.size() > 1 ? "no single limit is enough: " : "") + least.text();
}

/// One limit relaxed until a grasp has at least the score wanted: as far as the best grasp of the
/// loosest plan needs, when that is enough.
std::optional<Offer> better_with(const Limit& limit, double wanted_score, Trials& trials) {
    const auto good = [&](const std::optional<Offer>& offer) {
        return offer && offer->grasps.front().score >= wanted_score;
    };
    auto offer = offer_of({{limit, limit.loosest}}, trials);
    if (!good(offer)) return std::nullopt;
    const double need = needed(limit, trials.request(), offer->grasps.front());
    if (need == limit.asked) return std::nullopt;  // not kept out by this limit, but found by luck
    if (need == limit.loosest) return offer;
    auto less = offer_of({{limit, need}}, trials);
    return good(less) ? less : offer;
}

std::string what_raises_the_score(std::vector<Limit> limits, double score, double least_gain,
                                  Trials& trials) {
    std::erase_if(limits, [](const Limit& limit) {
        return !limit.felled || limit.kind == LimitKind::kFriction;
    });
    std::optional<Offer> best;
    double best_score = score + least_gain;
    std::vector<std::string> tried;
    for (const Limit& limit : limits) {
        tried.push_back(value_text(limit, limit.loosest));
        auto offer = better_with(limit, best_score, trials);
        if (!offer) continue;
        best_score = offer->grasps.front().score;
        best = std::move(offer);
    }
    if (best) {
        return "with " + changes_text(best->changes) + " the best score is " +
               score_text(best_score) + " instead of " + score_text(score);
    }
    return "no limit keeps out a grasp that is better by " + score_text(least_gain) + " than " +
           score_text(score) + ": " +
           (tried.empty() ? "no candidate fell by one" : "tried " + listed(tried));
}

}  // namespace

Suggestion suggest(const Verdict& verdict, const SuggestConfig& config, const Replan& replan) {
    Trials trials(verdict.request, replan);
    const auto limits = limits_of(verdict.request, verdict.rejections,
                                  {verdict.widest_m, config.greatest_friction});
    std::string text = verdict.grasps.empty()
                           ? what_gives_a_grasp(limits, config.bisections, trials)
                           : what_raises_the_score(limits, verdict.grasps.front().score,
                                                   config.least_gain, trials);
    return {std::move(text), trials.plans()};
}

}  // namespace graspd::planner_detail
