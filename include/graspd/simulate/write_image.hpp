#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "graspd/base/result.hpp"
#include "graspd/simulate/render_frames.hpp"

namespace graspd {

/// Writes a PNG file. @return nothing, or kInternal naming the file that could not be written
std::optional<PlanError> write_png(const Image& image, const std::filesystem::path& file);

/// Writes an animated GIF that repeats for ever, with one palette of 256 colours for all images.
/// @param images      at least one, all of one size
/// @param interval_s  [s] between two images, to the hundredth
/// @return nothing, or kInternal naming the file that could not be written
std::optional<PlanError> write_gif(std::span<const Image> images, double interval_s,
                                   const std::filesystem::path& file);

}  // namespace graspd
