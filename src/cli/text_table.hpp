#pragma once

#include <string>
#include <vector>

namespace graspd::cli {

/// Rows of cells to be printed in aligned columns; the first row is the heading.
struct TextTable {
    std::vector<std::vector<std::string>> rows;
    std::vector<bool> align_left;  ///< per column; columns beyond its end are aligned right
};

/// The table as lines of text, columns two blanks apart, no blanks at the ends of lines.
std::string print_table(const TextTable& table);

inline constexpr double kMillimetres = 1e3;  ///< a metre in what people read

/// A number with a fixed count of decimals: fixed(0.0345, 1, 1e3) == "34.5".
std::string fixed(double value, int decimals, double factor = 1.0);

}  // namespace graspd::cli
