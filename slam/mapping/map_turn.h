#pragma once

#include <functional>

namespace slam {

/// Runs a piece of work on the map while nobody else works on it. Mapping between frames has
/// the map for itself; mapping beside tracking must ask for each piece, and must not touch the
/// map outside of them.
using MapTurn = std::function<void(const std::function<void()>& work)>;

/// For whoever has the map for himself.
inline void AtOnce(const std::function<void()>& work) { work(); }

}  // namespace slam
