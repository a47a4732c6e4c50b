#include "text_table.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace graspd::cli {

std::string print_table(const TextTable& table) {
    std::vector<std::size_t> widths;
    for (const auto& row : table.rows) {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : table.rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const bool left = i < table.align_left.size() && table.align_left[i];
            const std::string pad(widths[i] - row[i].size(), ' ');
            line += (i > 0 ? "  " : "") + (left ? row[i] + pad : pad + row[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string fixed(double value, int decimals, double factor) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << value * factor;
    const std::string printed = text.str();
    const bool zero = printed.find_first_not_of("-0.") == std::string::npos;
    return zero && printed.front() == '-' ? printed.substr(1) : printed;
}

}  // namespace graspd::cli
