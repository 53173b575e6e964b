// Textures of OBJ files, from the picture's file to the colours of patches and pictures.

#include "io/files/error.h"
#include "io/pictures/picture_files.h"
#include "io/scene_files/obj.h"
#include "io/textures/texture_files.h"
#include "io/textures/webp.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

using namespace hemilux;
using hemilux::test::content_of;
using hemilux::test::TemporaryFolder;

namespace {

/// A picture of two texels, red on the left, black on the right.
void write_red_and_black(const std::string& path) {
    Image image(2, 1);
    image.at(0, 0) = {1, 0, 0};
    write_png(path, image, 1);
}

const std::string square = "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
                           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

ReadResult read(const TemporaryFolder& folder, const std::string& mtl, const std::string& face,
                bool textures = true) {
    write_red_and_black(folder.path("t.png"));
    (void)folder.write("m.mtl", "newmtl m\n" + mtl);
    return read_obj(folder.write("s.obj", square + face), {}, textures);
}

} // namespace

TEST_CASE("Kd is a factor of its texture, over the face's part of it", "[textures]") {
    const TemporaryFolder folder;
    const ReadResult whole = read(folder, "Kd .5\nmap_Kd t.png\n", "f 1/1 2/2 3/3 4/4\n");
    const double red = Mesh(whole.scene).material(0u).reflectance.x;
    CHECK(red > .2); // half of the light that the tone curve leaves of 1
    CHECK(red <= .25 + 1e-9);
    CHECK(whole.scene.materials[0].reflectance.x == Approx(red));
    CHECK(whole.warnings.empty());
    // The triangle on the left has three quarters of its area in the red half.
    const ReadResult left = read(folder, "Kd .5\nmap_Kd t.png\n", "f 1/1 2/2 4/4\n");
    CHECK(Mesh(left.scene).material(0u).reflectance.x == Approx(1.5 * red));
    const ReadResult moved =
        read(folder, "map_Kd -s 2 1 1 -o 0.25 0 0 t.png\n", "f 1/1 2/2 3/3 4/4\n");
    CHECK(Mesh(moved.scene).material(0u).reflectance.x == Approx(2 * red));
    const ReadResult without = read(folder, "Kd .5\nmap_Kd t.png\n", "f 1/1 2/2 4/4\n", false);
    CHECK(Mesh(without.scene).material(0u).reflectance == Vec3(.5));
}

TEST_CASE("a lamp emits by its texture", "[textures]") {
    const TemporaryFolder folder;
    const ReadResult result =
        read(folder, "Kd 0\nKe 10 10 10\nmap_Ke t.png\n", "f 1/1 2/2 3/3 4/4\n");
    const Mesh mesh(result.scene, {.max_edge = 1});
    REQUIRE(mesh.patches().size() == 4);
    for (const Patch& patch : mesh.patches()) {
        const bool left = mesh.frame().to_world(patch.centre).x < 1;
        CHECK((mesh.material(patch).emission.x > 8) == left);
        CHECK(mesh.material(patch).emission.y == 0);
    }
}

TEST_CASE("a picture shows the texture within a patch", "[textures]") {
    const TemporaryFolder folder;
    const ReadResult result = read(folder, "map_Kd t.png\n", "f 1/1 2/2 3/3 4/4\n");
    const Mesh mesh(result.scene);
    const MadeTracer made = make_tracer(mesh, 1);
    const std::vector<Vec3> radiosity{Vec3(3) * mesh.material(0u).reflectance};
    const Camera camera{.eye = {1, 1, 5}, .target = {1, 1, 0}, .vertical_fov_degrees = 20};
    for (const bool smooth : {false, true}) {
        const Image image = render(mesh, *made.tracer, radiosity, camera,
                                   {.width = 9, .height = 9, .textures = true, .smooth = smooth});
        CHECK(image.at(2, 4).x > 2.4f);
        CHECK(image.at(4, 4).x == Approx(image.at(2, 4).x / 2).epsilon(1e-3));
        CHECK(image.at(6, 4).x == 0);
    }
}

TEST_CASE("broken pictures are refused, other kinds are reported", "[textures]") {
    const TemporaryFolder folder;
    const std::string png =
        (write_red_and_black(folder.path("whole.png")), content_of(folder.path("whole.png")));
    const std::string start = png.substr(0, 8);
    for (const std::string& bytes :
         {start, png.substr(0, 40), png.substr(0, png.size() / 2), std::string("\xff\xd8\xff\xe0"),
          // 16384 x 16384 pixels
          start + std::string("\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0\x08\x02\0\0\0", 21),
          // a chunk of 1 GiB, for which no memory is to be reserved
          png.substr(0, 33) + std::string("\x40\0\0\0IDAT", 8) + png.substr(41),
          // a Huffman table with 4080 codes, which stb_image writes beyond its own
          "\xff\xd8\xff\xc4\xff\xff" + std::string(1, '\0') + std::string(600, '\xff')})
        CHECK_THROWS_AS(decode_texture(bytes, "t.png"), InputError);
    // Two texels, and megabytes that they unpack to. stb_image checks no checksums.
    const std::string data = zlib_compressed(std::vector<unsigned char>(std::size_t{1} << 22));
    const auto length = static_cast<char>(data.size() >> 8);
    CHECK_THROWS_AS(decode_texture(png.substr(0, 33) + std::string("\0\0", 2) + length +
                                       static_cast<char>(data.size() & 255) + "IDAT" + data +
                                       "crc." + png.substr(png.size() - 12),
                                   "t.png"),
                    InputError);
    (void)folder.write("t.tga", "no picture that is read");
    (void)folder.write("m.mtl", "newmtl m\nmap_Kd t.tga\n");
    const ReadResult result = read_obj(folder.write("s.obj", square + "f 1/1 2/2 3/3\n"));
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("1 texture is not found, or neither PNG, JPEG nor TGA") !=
          std::string::npos);
    CHECK(Mesh(result.scene).material(0u).reflectance == Vec3(.5));
}

TEST_CASE("a picture of very many scans is refused before they are decoded", "[textures]") {
    const auto with_scans = [](unsigned count) {
        const std::string scan("\xff\xda\0\x08\x01\x01\0\0\0\x10", 10); // one more bit of each mean
        std::string bytes("\xff\xd8\xff\xc2\0\x0b\x08\0\x08\0\x08\x01\x01\x11\0", 15);
        for (unsigned k = 0; k < count; ++k)
            bytes += scan;
        return bytes + "\xff\xd9";
    };
    CHECK(decode_texture(with_scans(100), "t.jpg").width() == 8);
    CHECK_THROWS_WITH(decode_texture(with_scans(101), "t.jpg"),
                      Catch::Contains("more than 100 scans"));
}

TEST_CASE("texture coordinates that are no numbers are reported", "[textures]") {
    const TemporaryFolder folder;
    (void)folder.write("m.mtl", "newmtl m\n");
    const ReadResult result =
        read_obj(folder.write("s.obj", square + "vt nan 0\nvt 1 1e7\nf 1/1 2/5 3/6\n"));
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("2 texture coordinates are no numbers within 1e6") !=
          std::string::npos);
}

TEST_CASE("TGA is read by the extension of its name", "[texture]") {
    const test::TemporaryFolder folder;
    std::string tga(18, '\0');
    tga[2] = 2;  // colours, not packed
    tga[12] = 2; // 2 x 1 texels of 24 bits
    tga[14] = 1;
    tga[16] = 24;
    tga += std::string("\x00\x00\xff\xff\x00\x00", 6); // red, then blue
    const std::function<void(double)> guard;
    TextureFiles files(guard);
    const auto texture = files.read(folder.write("a.TGA", tga));
    REQUIRE(texture);
    CHECK(texture->mean() == Vec3(.5, 0, .5));
    CHECK_FALSE(files.read(folder.write("a.bin", tga)));
    CHECK_FALSE(files.read(folder.write("b.tga", tga.substr(0, 9))));
}

TEST_CASE("WebP is read where hemilux was built with libwebp", "[texture]") {
    // Red, then blue, without loss.
    const std::string webp("RIFF\x1e\0\0\0WEBPVP8L\x11\0\0\0\x2f\x01\0\0\0\x0f\x10\xf3\xbf\xff\xf3"
                           "\x1f\x0e\x32\xa2\xff\x01\0",
                           38);
    const test::TemporaryFolder folder;
    const std::function<void(double)> guard;
    TextureFiles files(guard);
    const auto texture = files.read(folder.write("a.webp", webp));
    CHECK(bool(texture) == is_readable_webp(webp));
    if (!is_readable_webp(webp))
        return;
    CHECK(texture->mean() == Vec3(.5, 0, .5));
    CHECK(texture->texel_at({.25, .5}, {}) == Vec3(1, 0, 0));
    CHECK_THROWS_AS(decode_texture(webp.substr(0, 16), "t.webp"), InputError);
    CHECK_THROWS_AS(decode_texture(webp.substr(0, 30), "t.webp"), InputError);
}
