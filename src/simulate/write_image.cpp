#include "graspd/simulate/write_image.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include <gif_lib.h>
#include <png.h>

namespace graspd {
namespace {

PlanError unwritable(const std::filesystem::path& file) {
    return {PlanErrorCode::kInternal, file.string() + " cannot be written"};
}

constexpr int kColours = 256;

/// Palette indices of all images, one after the other.
struct Indexed {
    std::array<GifColorType, kColours> palette{};
    std::vector<GifByteType> index;
};

Indexed indexed(std::span<const Image> images) {
    std::vector<GifByteType> red, green, blue;
    for (const Image& image : images) {
        for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
            red.push_back(image.rgb[i]);
            green.push_back(image.rgb[i + 1]);
            blue.push_back(image.rgb[i + 2]);
        }
    }
    Indexed result;
    result.index.resize(red.size());
    int colours = kColours;
    const auto width = images.front().width;
    GifQuantizeBuffer(width, static_cast<unsigned>(red.size() / width), &colours, red.data(),
                      green.data(), blue.data(), result.index.data(), result.palette.data());
    return result;
}

bool put_loop(GifFileType* gif) {
    constexpr std::array<GifByteType, 3> kForEver = {1, 0, 0};
    return EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
           EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0") == GIF_OK &&
           EGifPutExtensionBlock(gif, kForEver.size(), kForEver.data()) == GIF_OK &&
           EGifPutExtensionTrailer(gif) == GIF_OK;
}

bool put_image(GifFileType* gif, int width, int height, int delay, GifByteType* pixels) {
    GraphicsControlBlock control{DISPOSE_DO_NOT, false, delay, NO_TRANSPARENT_COLOR};
    std::array<GifByteType, 4> bytes{};
    const auto count = EGifGCBToExtension(&control, bytes.data());
    if (EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(count), bytes.data()) !=
            GIF_OK ||
        EGifPutImageDesc(gif, 0, 0, width, height, false, nullptr) != GIF_OK) {
        return false;
    }
    for (int row = 0; row < height; ++row, pixels += width) {
        if (EGifPutLine(gif, pixels, width) != GIF_OK) return false;
    }
    return true;
}

}  // namespace

std::optional<PlanError> write_png(const Image& image, const std::filesystem::path& file) {
    assert(image.rgb.size() == std::size_t{3} * image.width * image.height);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = image.width;
    png.height = image.height;
    png.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&png, file.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
        return unwritable(file);
    }
    return std::nullopt;
}

std::optional<PlanError> write_gif(std::span<const Image> images, double interval_s,
                                   const std::filesystem::path& file) {
    assert(!images.empty());
    Indexed colours = indexed(images);
    const auto width = static_cast<int>(images.front().width);
    const auto height = static_cast<int>(images.front().height);
    const auto delay = static_cast<int>(std::lround(interval_s * 100.0));
    int problem = 0;
    GifFileType* gif = EGifOpenFileName(file.c_str(), false, &problem);
    if (gif == nullptr) return unwritable(file);
    EGifSetGifVersion(gif, true);
    ColorMapObject* map = GifMakeMapObject(kColours, colours.palette.data());
    bool good = EGifPutScreenDesc(gif, width, height, 8, 0, map) == GIF_OK && put_loop(gif);
    for (std::size_t i = 0; i < images.size() && good; ++i) {
        const std::size_t pixels = std::size_t{images.front().width} * images.front().height;
        good = put_image(gif, width, height, delay, colours.index.data() + i * pixels);
    }
    GifFreeMapObject(map);
    good = EGifCloseFile(gif, &problem) == GIF_OK && good;
    return good ? std::nullopt : std::optional(unwritable(file));
}

}  // namespace graspd
