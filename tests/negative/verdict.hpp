#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd::test {

/// A finding that must be there: its value, worked by hand, within a tolerance.
struct ExpectedFinding {
    std::string code;
    double value = 0.0;
    double tolerance = 0.0;
};

/// What must come of a broken input: an error whose text names what is wrong, or findings.
struct Verdict {
    std::optional<PlanErrorCode> code;  ///< absent: it is repaired
    std::vector<std::string> says;      ///< parts of the error's text
    std::vector<ExpectedFinding> findings;
};

Verdict refused(PlanErrorCode code, std::vector<std::string> says);
/// refused() as the readers of files do it.
Verdict unreadable(std::vector<std::string> says);
Verdict repaired(std::vector<ExpectedFinding> findings);

/// What came of it.
struct Outcome {
    std::optional<PlanError> error;
    std::vector<Finding> findings;
};

/// Closes an object as a plan does.
Outcome close(const std::variant<TriangleMesh, PointCloud>& object);
/// Reads an object file, then closes it.
Outcome read_and_close(const std::filesystem::path& file);

void expect_verdict(const Outcome& outcome, const Verdict& verdict);

/// A folder of its own, removed at the end.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& bytes) const;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// A broken file: a name for the test, the file's own name, its bytes, and what must come of it.
struct BadFile {
    std::string name;
    std::string file;
    std::string bytes;
    Verdict verdict;
};
void PrintTo(const BadFile& row, std::ostream* out);
/// Writes an object file, reads and closes it, and compares.
void expect_verdict(const BadFile& object);

/// The name of a row's test.
inline constexpr auto kName = [](const auto& row) { return row.param.name; };

}  // namespace graspd::test
