#include "io/files/outside_files.h"

#include "io/files/error.h"
#include "io/files/text_words.h"

#include <filesystem>
#include <system_error>

namespace hemilux {
namespace {

namespace fs = std::filesystem;

bool lies_outside(const std::string& file, const std::string& scene) {
    std::error_code error;
    const fs::path parent = fs::path(scene).parent_path();
    const fs::path folder = fs::canonical(parent.empty() ? fs::path(".") : parent, error);
    const fs::path inside = fs::canonical(file, error).lexically_relative(folder);
    return !error && (inside.empty() || *inside.begin() == "..");
}

} // namespace

void OutsideFiles::check(const std::string& file, const std::string& where,
                         const std::string& what) {
    if ((rule_ == Outside::reported && has_warned_) || !lies_outside(file, scene_))
        return;
    constexpr std::size_t longest_name = 100;
    const std::string text = what + " \"" + shortened(file, longest_name) + "\"" + outside_warning;
    if (rule_ == Outside::refused)
        throw InputError(where, text + ", and --no-outside-files refuses it");
    has_warned_ = true;
    warnings_.push_back(where + ": " + text + "; further ones that do are not named");
}

} // namespace hemilux
