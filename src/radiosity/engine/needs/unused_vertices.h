#pragma once
// Drops the vertices of a scene that no facet uses, as files of several objects or of lines and
// points have them. Each would be kept twice.

namespace hemilux {

struct Scene;

/// Keeps the order of the vertices that remain, and the numbers that they were read with
/// (Scene::read_as).
void drop_unused_vertices(Scene& scene);

} // namespace hemilux
