#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include <gif_lib.h>
#include <png.h>

#include "graspd/simulate/render_frames.hpp"
#include "graspd/simulate/render_views.hpp"
#include "graspd/simulate/write_image.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using Colour = std::array<std::uint8_t, 3>;

/// A file in a directory of this process's own.
std::filesystem::path file_named(const std::string& name) {
    const auto place = std::filesystem::path(testing::TempDir()) /
                       ("graspd_pictures_" + std::to_string(::getpid()));
    std::filesystem::create_directories(place);
    return place / name;
}

/// The left half in one colour, the right half in another.
Image two_halves(const Colour& left, const Colour& right) {
    Image image{6, 4, {}};
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const Colour& colour = x < 3 ? left : right;
            image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
        }
    }
    return image;
}

TEST(WriteImage, PngReadsBackTheSame) {
    const Image image = two_halves({255, 0, 7}, {1, 128, 254});
    const auto file = file_named("halves.png");
    ASSERT_FALSE(write_png(image, file));
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&png, file.c_str()), 0);
    ASSERT_EQ(png.width, image.width);
    ASSERT_EQ(png.height, image.height);
    png.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
    ASSERT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(pixels, image.rgb);
}

// Four colours fit in a palette, to the five bits that giflib sorts colours by.
TEST(WriteImage, GifReadsBackImagesDelayAndColours) {
    const Image images[] = {two_halves({248, 0, 0}, {0, 248, 0}),
                            two_halves({0, 0, 248}, {248, 248, 248})};
    const auto file = file_named("halves.gif");
    ASSERT_FALSE(write_gif(images, 0.08, file));
    int problem = 0;
    GifFileType* gif = DGifOpenFileName(file.c_str(), &problem);
    ASSERT_NE(gif, nullptr);
    ASSERT_EQ(DGifSlurp(gif), GIF_OK);
    ASSERT_EQ(gif->ImageCount, 2);
    for (int i = 0; i < 2; ++i) {
        GraphicsControlBlock control;
        ASSERT_EQ(DGifSavedExtensionToGCB(gif, i, &control), GIF_OK);
        EXPECT_EQ(control.DelayTime, 8);
        for (std::size_t pixel = 0; pixel < 24; ++pixel) {
            const auto& got = gif->SColorMap->Colors[gif->SavedImages[i].RasterBits[pixel]];
            const std::uint8_t* wanted = images[i].rgb.data() + 3 * pixel;
            EXPECT_NEAR(got.Red, wanted[0], 8);
            EXPECT_NEAR(got.Green, wanted[1], 8);
            EXPECT_NEAR(got.Blue, wanted[2], 8);
        }
    }
    DGifCloseFile(gif, &problem);
}

TEST(WriteImage, SaysWhichFileCannotBeWritten) {
    const Image image = two_halves({0, 0, 0}, {9, 9, 9});
    const auto png = write_png(image, "/no/such/place.png");
    ASSERT_TRUE(png);
    EXPECT_NE(png->detail.find("/no/such/place.png"), std::string::npos);
    const auto gif = write_gif(std::span(&image, 1), 0.1, "/no/such/place.gif");
    ASSERT_TRUE(gif);
    EXPECT_NE(gif->detail.find("/no/such/place.gif"), std::string::npos);
}

bool is_finger(const std::uint8_t* pixel) {  // orange
    return pixel[0] > pixel[2] + 60;
}
bool is_palm(const std::uint8_t* pixel) {  // dark
    return pixel[0] < 110 && pixel[1] < 110 && pixel[2] < 140;
}

/// Mean row of the pixels that a test picks; -1 without any.
double mean_row(const Image& image, bool (*pick)(const std::uint8_t*)) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < image.rgb.size() / 3; ++i) {
        if (!pick(image.rgb.data() + 3 * i)) continue;
        sum += static_cast<double>(i / image.width);
        count += 1.0;
    }
    return count > 0.0 ? sum / count : -1.0;
}

// The hand comes from above: its palm is over its fingers in the picture, and 0.1 m higher it is
// higher in the picture.
TEST(RenderFrames, ShowsTheHandWhereItIs) {
    SimulatedFrame low;
    low.X_FG.linear().col(1) = -Vector3d::UnitY();
    low.X_FG.linear().col(2) = -Vector3d::UnitZ();
    low.opening_m = 0.05;
    SimulatedFrame high = low;
    high.X_FG.translation().z() = 0.1;
    RenderConfig config;
    config.width = 160;
    config.height = 120;
    const auto images =
        render_frames(test::box({0.04, 0.04, 0.04}), Gripper{}, 0.04, {low, high}, config);
    ASSERT_TRUE(images.ok()) << images.error().detail;
    ASSERT_EQ(images.value().size(), 2u);
    for (const Image& image : images.value()) {
        ASSERT_EQ(image.rgb.size(), 160u * 120u * 3u);
        ASSERT_GE(mean_row(image, is_finger), 0.0);
        ASSERT_GE(mean_row(image, is_palm), 0.0);
        EXPECT_LT(mean_row(image, is_palm), mean_row(image, is_finger));
    }
    EXPECT_LT(mean_row(images.value()[1], is_finger) + 10.0,
              mean_row(images.value()[0], is_finger));
}

TEST(RenderFrames, NothingToDrawIsNoImage) {
    const auto images = render_frames(test::box({1, 1, 1}), Gripper{}, 0.04, {}, {});
    ASSERT_TRUE(images.ok());
    EXPECT_TRUE(images.value().empty());
}

int count_of(const Image& image, bool (*pick)(int red, int green, int blue)) {
    int count = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        count += pick(image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]) ? 1 : 0;
    }
    return count;
}
bool is_blue(int red, int /*green*/, int blue) {
    return blue > red + 60;
}
bool is_red(int red, int green, int blue) {
    return red > green + 60 && red > blue + 60;
}
bool is_green(int red, int green, int blue) {
    return green > red + 60 && green > blue + 60;
}
bool is_orange(int red, int green, int blue) {
    return red > blue + 60 && red < green + 80;
}

/// A block that is blue at its left end and red at its right one; the hand above it.
RestingScene block() {
    RestingScene scene;
    scene.mesh_F = test::box({0.08, 0.04, 0.04}, 12);
    for (const Vector3d& vertex : scene.mesh_F.vertices) {
        scene.shares.push_back(vertex.x() > 0.0 ? 1.0 : 0.0);
    }
    scene.X_FG.linear().col(1) = -Vector3d::UnitY();
    scene.X_FG.linear().col(2) = -Vector3d::UnitZ();
    scene.X_FG.translation().z() = 0.05;
    scene.width_m = 0.04;
    return scene;
}

TEST(RenderViews, ShowsWhatEachViewAsksFor) {
    const PictureDot dot{{0.0, -0.02, 0.02}, {0.0F, 1.0F, 0.0F}};
    RestingScene scene = block();
    scene.dot_m = 0.01;
    RenderConfig config;
    config.width = config.height = 160;
    const auto images = render_views(
        scene, {{}, {true, false, {}}, {false, true, {}}, {false, false, {dot}}}, config);
    ASSERT_TRUE(images.ok()) << images.error().detail;
    const auto& views = images.value();
    ASSERT_EQ(views.size(), 4u);
    for (const auto pick : {is_blue, is_red, is_green}) EXPECT_EQ(count_of(views[0], pick), 0);
    EXPECT_GT(count_of(views[1], is_blue), 100);
    EXPECT_GT(count_of(views[1], is_red), 100);
    EXPECT_EQ(count_of(views[0], is_orange), 0);
    EXPECT_GT(count_of(views[2], is_orange), 100);
    EXPECT_EQ(count_of(views[2], is_blue), 0);
    EXPECT_GT(count_of(views[3], is_green), 10);
    EXPECT_EQ(count_of(views[3], is_orange), 0);
}

TEST(RenderViews, SharesThatAreNoneLieOnTheHull) {
    RestingScene scene = block();
    std::ranges::fill(scene.shares, std::numeric_limits<double>::quiet_NaN());
    const auto images = render_views(scene, {{true, false, {}}}, {});
    ASSERT_TRUE(images.ok()) << images.error().detail;
    EXPECT_GT(count_of(images.value()[0], is_blue), 1000);
    EXPECT_EQ(count_of(images.value()[0], is_red), 0);
}

TEST(RenderViews, OneShareForEachVertex) {
    RestingScene scene = block();
    scene.shares.pop_back();
    const auto images = render_views(scene, {{}}, {});
    ASSERT_FALSE(images.ok());
    EXPECT_EQ(images.error().code, PlanErrorCode::kInvalidInput);
    const std::string vertices = std::to_string(scene.mesh_F.vertices.size()) + " vertices";
    EXPECT_NE(images.error().detail.find(vertices), std::string::npos) << images.error().detail;
}

}  // namespace
}  // namespace graspd
