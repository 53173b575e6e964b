#pragma once
// The readers open files by their paths: a file that always holds the present input.

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace hemilux::fuzz {

class InputFile {
  public:
    explicit InputFile(const std::string& name)
        : folder_(memory() / ("hemilux-fuzz-" + std::to_string(::getpid()))),
          path_((folder_ / name).string()) {
        std::filesystem::create_directories(folder_);
    }
    ~InputFile() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Its path, once it holds the bytes.
    const std::string& with(const std::uint8_t* data, std::size_t size) const {
        std::ofstream file(path_, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
        return path_;
    }

  private:
    static std::filesystem::path memory() {
        const std::filesystem::path shared("/dev/shm");
        return std::filesystem::is_directory(shared) ? shared
                                                     : std::filesystem::temp_directory_path();
    }
    std::filesystem::path folder_;
    std::string path_;
};

} // namespace hemilux::fuzz
