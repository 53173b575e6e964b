#include "embree_scene.h"

#include "clock.h"

#include <limits>
#include <stdexcept>

namespace hemilux::bench {
namespace {

/// What filters know of a query.
struct Context {
    RTCIntersectContext context{};
    std::span<const Ray> rays;
    const EmbreeScene* scene = nullptr;
    std::span<std::uint32_t> counts;

    explicit Context(const EmbreeScene& of) : scene(&of) { rtcInitIntersectContext(&context); }
};

bool count_memory(void* sum, ssize_t bytes, bool) {
    *static_cast<ssize_t*>(sum) += bytes;
    return true;
}

constexpr float infinity = std::numeric_limits<float>::infinity();

void fill16(std::span<const Ray> rays, std::size_t first, RTCRayHit16& packet, int* valid) {
    for (std::size_t k = 0; k < 16; ++k) {
        const bool there = first + k < rays.size();
        const RTCRayHit one = embree_ray(rays[there ? first + k : first], 0);
        valid[k] = there ? -1 : 0;
        packet.ray.org_x[k] = one.ray.org_x;
        packet.ray.org_y[k] = one.ray.org_y;
        packet.ray.org_z[k] = one.ray.org_z;
        packet.ray.dir_x[k] = one.ray.dir_x;
        packet.ray.dir_y[k] = one.ray.dir_y;
        packet.ray.dir_z[k] = one.ray.dir_z;
        packet.ray.tnear[k] = 0;
        packet.ray.tfar[k] = one.ray.tfar;
        packet.ray.time[k] = 0;
        packet.ray.mask[k] = one.ray.mask;
        packet.ray.flags[k] = 0;
        packet.ray.id[k] = static_cast<unsigned>(first + k);
        packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
}

} // namespace

EmbreeScene::EmbreeScene(const FacetSoup& soup, bool robust, RTCFilterFunctionN filter)
    : device_(rtcNewDevice("threads=1,set_affinity=0")) {
    if (!device_)
        throw std::runtime_error("Embree does not start");
    for (const Vec3& v : soup.vertices)
        for (int i = 0; i < 3; ++i)
            vertices_.push_back(static_cast<float>(v[i]));
    vertices_.push_back(0); // Embree reads sixteen bytes at the last vertex
    for (std::uint32_t f = 0; f < soup.facets.size(); ++f) {
        const FacetCorners& c = soup.facets[f];
        indices_.insert(indices_.end(), {c[0], c[1], c[2]});
        facet_.push_back(f);
        if (c[2] != c[3]) {
            indices_.insert(indices_.end(), {c[0], c[2], c[3]});
            facet_.push_back(f);
        }
    }
    ssize_t memory = 0;
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &memory);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices_.data(), 0, 12, soup.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               indices_.data(), 0, 12, facet_.size());
    if (filter) {
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene_,
                     static_cast<RTCSceneFlags>(
                         (robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                         (filter ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_NONE)));
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    const double start = cpu_seconds();
    rtcCommitScene(scene_);
    build_seconds_ = cpu_seconds() - start;
    rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
    bytes_ = static_cast<std::size_t>(memory);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

RTCRayHit embree_ray(const Ray& ray, float t_min) {
    RTCRayHit out{};
    out.ray.org_x = static_cast<float>(ray.origin.x);
    out.ray.org_y = static_cast<float>(ray.origin.y);
    out.ray.org_z = static_cast<float>(ray.origin.z);
    out.ray.dir_x = static_cast<float>(ray.direction.x);
    out.ray.dir_y = static_cast<float>(ray.direction.y);
    out.ray.dir_z = static_cast<float>(ray.direction.z);
    out.ray.tnear = t_min;
    out.ray.tfar = infinity;
    out.ray.mask = ~0u;
    out.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    out.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return out;
}

void embree_closest(const EmbreeScene& scene, std::span<const Ray> rays,
                    std::span<std::uint32_t> out) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        RTCRayHit ray = embree_ray(rays[k], 1e-6f);
        rtcIntersect1(scene.scene(), &context, &ray);
        out[k] = ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? none : ray.hit.primID;
    }
}

void embree_count(const EmbreeScene& counting, CountBy by, std::span<const Ray> rays,
                  std::span<std::uint32_t> out) {
    Context context(counting);
    context.rays = rays;
    context.counts = out;
    for (std::uint32_t& n : out)
        n = 0;
    if (by == CountBy::intersect16) {
        for (std::size_t k = 0; k < rays.size(); k += 16) {
            RTCRayHit16 packet;
            alignas(64) int valid[16];
            fill16(rays, k, packet, valid);
            rtcIntersect16(valid, counting.scene(), &context.context, &packet);
        }
        return;
    }
    for (std::size_t k = 0; k < rays.size(); ++k) {
        RTCRayHit ray = embree_ray(rays[k], 0);
        ray.ray.id = static_cast<unsigned>(k);
        if (by == CountBy::intersect1)
            rtcIntersect1(counting.scene(), &context.context, &ray);
        else
            rtcOccluded1(counting.scene(), &context.context, &ray.ray);
    }
}

void counting_filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const Context*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i)
        if (arguments->valid[i] != 0) {
            const unsigned ray = RTCRayN_id(arguments->ray, arguments->N, i);
            const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, i);
            context.counts[ray] += context.scene->facet(triangle) != context.rays[ray].from;
            arguments->valid[i] = 0;
        }
}

void starting_facet_filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const Context*>(arguments->context);
    const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    if (context.scene->facet(triangle) == context.rays[0].from)
        arguments->valid[0] = 0;
}

EmbreeHit embree_robust_hit(const EmbreeScene& scene, const Ray& ray) {
    Context context(scene);
    context.rays = {&ray, 1};
    RTCRayHit out = embree_ray(ray, 0);
    rtcIntersect1(scene.scene(), &context.context, &out);
    const bool hit = out.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    return {hit ? scene.facet(out.hit.primID) : none, out.ray.tfar};
}

} // namespace hemilux::bench
