#pragma once
// The workers stand below the tree builder, which uses them too.

#include "geometry/workers.h"
