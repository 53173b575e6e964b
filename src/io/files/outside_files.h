#pragma once
// Files that a scene names and that lie outside its folder. The scene's author chose them, and the
// reader of a scene from elsewhere may not expect it.

#include <string>
#include <vector>

namespace hemilux {

enum class Outside {
    reported, ///< read, the first with a warning
    refused
};

/// The part of the warning that is the same for all.
inline constexpr const char* outside_warning = " lies outside the scene's folder";

class OutsideFiles {
  public:
    /// `scene` is the path of the file that names others.
    OutsideFiles(std::string scene, Outside rule, std::vector<std::string>& warnings)
        : scene_(std::move(scene)), rule_(rule), warnings_(warnings) {}

    /// Is called before a file is read, which `where` names as a `what`: a buffer, a texture. Links
    /// are followed. Throws InputError for one that is refused.
    void check(const std::string& file, const std::string& where, const std::string& what);

  private:
    std::string scene_;
    Outside rule_;
    std::vector<std::string>& warnings_;
    bool has_warned_ = false;
};

} // namespace hemilux
