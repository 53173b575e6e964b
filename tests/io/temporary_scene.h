#pragma once
// A folder for the files of one test, removed at its end.

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace hemilux::test {

class TemporaryScene {
  public:
    TemporaryScene() {
        static std::atomic<int> count{0};
        folder_ = std::filesystem::temp_directory_path() /
                  ("hemilux-scene-" + std::to_string(getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(folder_);
    }
    ~TemporaryScene() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TemporaryScene(const TemporaryScene&) = delete;
    TemporaryScene& operator=(const TemporaryScene&) = delete;

    [[nodiscard]] std::string path(const std::string& name) const {
        return (folder_ / name).string();
    }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, std::string_view content) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return path(name);
    }

  private:
    std::filesystem::path folder_;
};

} // namespace hemilux::test
