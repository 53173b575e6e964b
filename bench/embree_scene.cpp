#include "embree_scene.h"

#include "clock.h"
#include "parallel/instruction_set.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#if defined(__SSE__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace hemilux::bench {
namespace {

constexpr std::size_t rays_of_stream = 64;

/// Denormal floats count as 0 while this lives, as Embree's manual advises.
class FlushToZero {
  public:
#if defined(__SSE__)
    FlushToZero() : before_(_mm_getcsr()) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~FlushToZero() { _mm_setcsr(before_); }
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;

  private:
    unsigned before_;
#endif
};

/// One thread, with no wider instructions than hemilux may use.
std::string device_settings() {
    const std::string_view isa = chosen_instruction_set() == InstructionSet::avx512 ? "avx512"
                                 : chosen_instruction_set() == InstructionSet::avx2 ? "avx2"
                                                                                    : "sse4.2";
    return "threads=1,set_affinity=0,max_isa=" + std::string(isa);
}

/// Embree marks a ray that is occluded by this end.
constexpr float occluded_end = -std::numeric_limits<float>::infinity();

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

RTCRayHit embree_ray(const Ray& ray, float t_min, std::size_t id) {
    RTCRayHit out{};
    out.ray.org_x = static_cast<float>(ray.origin.x);
    out.ray.org_y = static_cast<float>(ray.origin.y);
    out.ray.org_z = static_cast<float>(ray.origin.z);
    out.ray.dir_x = static_cast<float>(ray.direction.x);
    out.ray.dir_y = static_cast<float>(ray.direction.y);
    out.ray.dir_z = static_cast<float>(ray.direction.z);
    out.ray.tnear = t_min;
    out.ray.tfar = static_cast<float>(ray.t_max);
    out.ray.mask = ~0u;
    out.ray.id = static_cast<unsigned>(id);
    out.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    out.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return out;
}

/// Packets of the rays; the last one is filled up with its first ray, which is not traced.
template <class Packet, std::size_t Size>
std::vector<Packet> packets_of(std::span<const RTCRayHit> ones) {
    std::vector<Packet> packets((ones.size() + Size - 1) / Size);
    for (std::size_t p = 0; p < packets.size(); ++p)
        for (std::size_t k = 0; k < Size; ++k) {
            const std::size_t at = p * Size + k;
            const RTCRay& ray = ones[at < ones.size() ? at : p * Size].ray;
            auto& to = packets[p];
            to.ray.org_x[k] = ray.org_x;
            to.ray.org_y[k] = ray.org_y;
            to.ray.org_z[k] = ray.org_z;
            to.ray.dir_x[k] = ray.dir_x;
            to.ray.dir_y[k] = ray.dir_y;
            to.ray.dir_z[k] = ray.dir_z;
            to.ray.tnear[k] = ray.tnear;
            to.ray.tfar[k] = ray.tfar;
            to.ray.time[k] = 0;
            to.ray.mask[k] = ray.mask;
            to.ray.flags[k] = 0;
            to.ray.id[k] = ray.id;
            to.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            to.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
    return packets;
}

/// `intersect` and `occluded`: Embree's functions for packets of this size.
template <std::size_t Size, class Packet, class Intersect, class Occluded>
void trace_packets(const EmbreeScene& scene, RTCIntersectContext& context, bool only_occluded,
                   const std::vector<Packet>& packets, std::span<std::uint32_t> out,
                   const Intersect& intersect, const Occluded& occluded) {
    for (std::size_t p = 0; p < packets.size(); ++p) {
        Packet packet = packets[p];
        const std::size_t there = std::min(Size, out.size() - p * Size);
        alignas(64) int valid[Size];
        for (std::size_t k = 0; k < Size; ++k)
            valid[k] = k < there ? -1 : 0;
        if (only_occluded) {
            occluded(valid, scene.scene(), &context, &packet.ray);
            for (std::size_t k = 0; k < there; ++k)
                if (packet.ray.tfar[k] == occluded_end)
                    out[p * Size + k] = 1;
            continue;
        }
        intersect(valid, scene.scene(), &context, &packet);
        for (std::size_t k = 0; k < there; ++k)
            if (packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID)
                out[p * Size + k] = packet.hit.primID[k];
    }
}

void trace_ones(const EmbreeScene& scene, RTCIntersectContext& context, bool only_occluded,
                std::span<const RTCRayHit> rays, std::span<std::uint32_t> out) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
        RTCRayHit ray = rays[k];
        if (only_occluded) {
            rtcOccluded1(scene.scene(), &context, &ray.ray);
            if (ray.ray.tfar == occluded_end)
                out[k] = 1;
            continue;
        }
        rtcIntersect1(scene.scene(), &context, &ray);
        if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID)
            out[k] = ray.hit.primID;
    }
}

void trace_streams(const EmbreeScene& scene, RTCIntersectContext& context, bool only_occluded,
                   std::span<const RTCRayHit> rays, std::span<std::uint32_t> out) {
    alignas(64) RTCRayHit stream[rays_of_stream];
    for (std::size_t begin = 0; begin < rays.size(); begin += rays_of_stream) {
        const std::size_t n = std::min(rays_of_stream, rays.size() - begin);
        std::copy_n(rays.begin() + std::ptrdiff_t(begin), n, stream);
        if (only_occluded) {
            rtcOccluded1M(scene.scene(), &context, &stream[0].ray, static_cast<unsigned>(n),
                          sizeof(RTCRayHit));
            for (std::size_t k = 0; k < n; ++k)
                if (stream[k].ray.tfar == occluded_end)
                    out[begin + k] = 1;
            continue;
        }
        rtcIntersect1M(scene.scene(), &context, stream, static_cast<unsigned>(n),
                       sizeof(RTCRayHit));
        for (std::size_t k = 0; k < n; ++k)
            if (stream[k].hit.geomID != RTC_INVALID_GEOMETRY_ID)
                out[begin + k] = stream[k].hit.primID;
    }
}

} // namespace

EmbreeScene::EmbreeScene(const FacetSoup& soup, const EmbreeBuild& how)
    : device_(rtcNewDevice(device_settings().c_str())) {
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
        if (how.quads)
            indices_.push_back(c[3]);
        else if (c[2] != c[3]) {
            indices_.insert(indices_.end(), {c[0], c[2], c[3]});
            facet_.push_back(f);
        }
    }
    ssize_t memory = 0;
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &memory);
    RTCGeometry geometry =
        rtcNewGeometry(device_, how.quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices_.data(), 0, 12, soup.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                               how.quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3, indices_.data(), 0,
                               how.quads ? 16 : 12, facet_.size());
    if (how.filter) {
        rtcSetGeometryIntersectFilterFunction(geometry, how.filter);
        rtcSetGeometryOccludedFilterFunction(geometry, how.filter);
    }
    rtcCommitGeometry(geometry);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_,
                            how.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(
                    (how.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                    (how.filter ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_NONE)));
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

std::string name_of(const EmbreeQuery& query) {
    using By = EmbreeQuery::By;
    const std::string call = query.occluded ? "occluded" : "intersect";
    const char* const suffix = query.by == By::one            ? "1"
                               : query.by == By::packets_of_4 ? "4"
                               : query.by == By::packets_of_8 ? "8"
                               : query.by == By::streams      ? "1M"
                                                              : "16";
    return call + suffix + (query.coherent ? " coherent" : "");
}

EmbreeRays::EmbreeRays(std::span<const Ray> of, float t_min) : rays(of) {
    for (std::size_t k = 0; k < of.size(); ++k)
        ones.push_back(embree_ray(of[k], t_min, k));
    fours = packets_of<RTCRayHit4, 4>(ones);
    eights = packets_of<RTCRayHit8, 8>(ones);
    sixteens = packets_of<RTCRayHit16, 16>(ones);
}

void embree_trace(const EmbreeScene& scene, const EmbreeQuery& query, const EmbreeRays& rays,
                  std::span<std::uint32_t> out) {
    const FlushToZero faster;
    Context context(scene);
    context.context.flags = query.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                           : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context.rays = rays.rays;
    context.counts = out;
    std::ranges::fill(out, 0u);
    switch (query.by) {
    case EmbreeQuery::By::one:
        return trace_ones(scene, context.context, query.occluded, rays.ones, out);
    case EmbreeQuery::By::packets_of_4:
        return trace_packets<4>(scene, context.context, query.occluded, rays.fours, out,
                                rtcIntersect4, rtcOccluded4);
    case EmbreeQuery::By::packets_of_8:
        return trace_packets<8>(scene, context.context, query.occluded, rays.eights, out,
                                rtcIntersect8, rtcOccluded8);
    case EmbreeQuery::By::packets_of_16:
        return trace_packets<16>(scene, context.context, query.occluded, rays.sixteens, out,
                                 rtcIntersect16, rtcOccluded16);
    case EmbreeQuery::By::streams:
        return trace_streams(scene, context.context, query.occluded, rays.ones, out);
    }
}

void counting_filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const Context*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i)
        if (arguments->valid[i] != 0) {
            const unsigned ray = RTCRayN_id(arguments->ray, arguments->N, i);
            const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, i);
            context.counts[ray] += context.scene->facet(primitive) != context.rays[ray].from;
            arguments->valid[i] = 0;
        }
}

void starting_facet_filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const Context*>(arguments->context);
    const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, 0);
    if (context.scene->facet(primitive) == context.rays[0].from)
        arguments->valid[0] = 0;
}

EmbreeHit embree_robust_hit(const EmbreeScene& scene, const Ray& ray) {
    Context context(scene);
    context.rays = {&ray, 1};
    RTCRayHit out = embree_ray(ray, 0, 0);
    rtcIntersect1(scene.scene(), &context.context, &out);
    const bool hit = out.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    return {hit ? scene.facet(out.hit.primID) : none, out.ray.tfar};
}

} // namespace hemilux::bench
