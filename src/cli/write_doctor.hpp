#pragma once

#include <string>

#include "diagnose_object.hpp"

namespace graspd::cli {

/// For people: the verdict, before and after in columns (millimetres, cubic centimetres), findings,
/// what would help.
std::string write_doctor_table(const Diagnosis& diagnosis);

/// One JSON object, schema graspd/1: metres; what is unknown is null. docs/interface.md has it.
std::string write_doctor_json(const Diagnosis& diagnosis);

}  // namespace graspd::cli
