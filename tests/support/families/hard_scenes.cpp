#include "support/families/families.h"

#include <map>
#include <mutex>
#include <utility>

namespace hemilux::test {

const std::vector<HardSceneEntry>& hard_scenes() {
    static const std::vector<HardSceneEntry> all = [] {
        std::vector<HardSceneEntry> entries;
        for (const auto family : {lamps_over_ground, suns, pinholes, windows, spheres, sealed_rooms,
                                  channels, tiny_emitters, corridors, controls})
            for (HardSceneEntry& entry : family())
                entries.push_back(std::move(entry));
        return entries;
    }();
    return all;
}

const HardScene& hard_scene(const HardSceneEntry& entry) {
    static std::mutex mutex;
    static std::map<std::pair<std::string, std::string>, HardScene> made;
    const std::lock_guard lock(mutex);
    const auto key = std::pair(entry.family, entry.name);
    if (const auto found = made.find(key); found != made.end())
        return found->second;
    return made.emplace(key, entry.make()).first->second;
}

} // namespace hemilux::test
